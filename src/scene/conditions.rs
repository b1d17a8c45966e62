//! Conditions of numbers, in words, for tables and pictures.

use super::Scene;
use crate::document::{TransformChoice, WhiteBalanceChoice};

/// Heads of the columns with a table's conditions.
pub const CONDITIONS: [&str; 5] = ["reference", "illuminant", "white_balance", "transform", "preset"];

impl WhiteBalanceChoice {
    /// The white-balance target in words.
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

    /// The cells under [`CONDITIONS`].
    pub fn conditions(&self) -> [String; 5] {
        self.conditions_under(&self.light_name())
    }
}
