//! Conditions of numbers, in words, for tables and pictures.

use super::Scene;
use crate::document::{CHART, FIVE, Subset, TransformChoice, WhiteBalanceChoice};

/// Heads of the columns with a table's conditions.
pub const CONDITIONS: [&str; 5] = ["reference", "illuminant", "white_balance", "transform", "preset"];

impl WhiteBalanceChoice {
    pub fn name(&self) -> String {
        match self {
            Self::Unity => "unity".to_owned(),
            Self::Light(name) => name.clone(),
            Self::Daylight(kelvin) => format!("daylight {kelvin} K"),
            Self::BlackBody(kelvin) => format!("blackbody {kelvin} K"),
        }
    }
}

impl Scene<'_> {
    /// The cells under [`CONDITIONS`], with the light named as it is to be called.
    pub fn conditions_under(&self, illuminant: &str) -> [String; 5] {
        let transform = match &self.document.transform {
            TransformChoice::Paper => "paper matrix (Eq 13)".to_owned(),
            TransformChoice::Observer(target) => self.document.correction.describe(target),
        };
        let preset = self.document.start.key().to_owned();
        [self.document.reference.clone(), illuminant.to_owned(), self.document.white.name(), transform, preset]
    }

    /// The name of the patches that are compared.
    pub fn chart_name(&self) -> String {
        let chart = &self.document.chart;
        match self.document.subset {
            Subset::Five if chart == CHART => FIVE.to_owned(),
            Subset::Five if self.has_five() => format!("{chart}, five"),
            _ => chart.clone(),
        }
    }

    /// Conditions of figures of merit beside [`CONDITIONS`], by their heads in files; the locus is compared at a temperature in kelvins.
    pub fn metrics_constants(&self, temperature_k: f64) -> Vec<(&'static str, String)> {
        let mut all = vec![("chart", self.chart_name()), ("temperature_k", temperature_k.to_string())];
        if let Some(pixel) = self.document.pixel {
            let numbers = [("full_well_electrons", pixel.full_well), ("read_noise_electrons", pixel.read_noise)];
            all.extend(numbers.map(|(head, number)| (head, number.to_string())));
        }
        all
    }

    /// Conditions of figures of merit that no other figure has, in sentences.
    pub fn metrics_words(&self) -> String {
        let pixel = self.document.pixel.map_or_else(String::new, |pixel| format!(" Pixel: {}.", pixel.describe()));
        format!("Locus metrics at {} K.{pixel}", self.document.temperature_k)
    }

    pub fn conditions(&self) -> [String; 5] {
        self.conditions_under(&self.light_name())
    }
}
