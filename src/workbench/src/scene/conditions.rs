//! Conditions of numbers, in words, for tables and pictures.

use chromascope_core::query::CameraMetric;
use chromascope_core::query::metrics::MetricGroup;
use chromascope_figure::Column;

use super::Scene;
use crate::document::{CHART, FIVE, SetKind, Subset, TransformChoice, WhiteBalanceChoice};

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
    /// Columns at the end of every table with the conditions of its numbers, with the light named as it is to be called.
    pub fn conditions_under(&self, illuminant: &str) -> Vec<(Column, String)> {
        let transform = match &self.document.transform {
            TransformChoice::Paper => "paper matrix (Eq 13)".to_owned(),
            TransformChoice::Observer(target) => self.document.correction.describe(target),
        };
        let preset = self.document.start.key().to_owned();
        let all = [
            ("reference", self.document.reference.clone()),
            ("illuminant", illuminant.to_owned()),
            ("white_balance", self.document.white.name()),
            ("transform", transform),
            ("preset", preset),
        ];
        all.map(|(key, value)| (key.into(), value)).into()
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

    /// Further conditions of figures of merit; the locus is compared at a temperature in kelvins.
    pub fn metrics_constants(&self, temperature_k: f64) -> Vec<(Column, String)> {
        let temperature = Column::quantity("temperature_k", "temperature", "K");
        let mut all = vec![("chart".into(), self.chart_name()), (temperature, temperature_k.to_string())];
        if let Some(pixel) = self.document.pixel {
            let numbers = [("full_well_electrons", pixel.full_well), ("read_noise_electrons", pixel.read_noise)];
            all.extend(numbers.map(|(key, number)| (key.into(), number.to_string())));
        }
        all
    }

    /// Conditions of figures of merit that no other figure has, in sentences.
    pub fn metrics_words(&self, metrics: &[CameraMetric]) -> String {
        let pixel = self.document.pixel.map_or_else(String::new, |pixel| format!(" Pixel: {}.", pixel.describe()));
        let compared = self.document.compared.iter().filter(|of| of.kind == SetKind::Camera);
        let refused = self.refused_uncertainties(compared.map(|of| of.name.as_str()));
        let has_loci = metrics.iter().any(|metric| metric.group == MetricGroup::Locus);
        let locus =
            if has_loci { format!("Locus metrics at {} K.", self.document.temperature_k) } else { String::new() };
        format!("{locus}{pixel} {}", refused.join(" ")).trim().to_owned()
    }

    /// Columns with the conditions of a table under the document's light.
    pub fn conditions(&self) -> Vec<(Column, String)> {
        self.conditions_under(&self.light_name())
    }
}
