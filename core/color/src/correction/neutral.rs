//! Camera RGB of a neutral, as raw files state it.

use crate::units::{bits, hash_by};
use glam::DVec3;
use std::str::FromStr;

/// Reason that numbers are no neutral.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum NeutralError {
    #[error("expected three positive numbers R,G,B, as 0.5,1,0.7")]
    Numbers,
    /// White-balance multipliers, whose least is green's.
    #[error(
        "green is the smallest, as in white-balance multipliers; AsShotNeutral holds their reciprocals (2,1,1.5 is 0.5,1,0.667)"
    )]
    Multipliers,
}

/// Camera RGB of a neutral under a light (`AsShotNeutral`, DNG 1.6, chapter 4), the largest 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neutral([f64; 3]);

hash_by!(Neutral, |of| of.0.map(bits));

impl Neutral {
    /// Takes camera RGB at any scale.
    ///
    /// # Errors
    /// [`NeutralError`] for a number that is not positive and finite, and where green is less than both others, which no sensor's green
    /// is under a light that people photograph in.
    pub fn new(rgb: [f64; 3]) -> Result<Self, NeutralError> {
        let scaled = rgb.map(|v| v / rgb.into_iter().fold(0.0, f64::max));
        if !rgb.iter().chain(&scaled).all(|v| v.is_normal() && *v > 0.0) {
            return Err(NeutralError::Numbers);
        }
        if rgb[1] < rgb[0] && rgb[1] < rgb[2] {
            return Err(NeutralError::Multipliers);
        }
        Ok(Self(scaled))
    }

    /// The three numbers, the largest 1.
    pub fn to_vector(self) -> DVec3 {
        DVec3::from_array(self.0)
    }
}

impl FromStr for Neutral {
    type Err = NeutralError;

    fn from_str(text: &str) -> Result<Self, NeutralError> {
        let numbers = text.split([',', ' ']).filter(|part| !part.is_empty()).map(str::parse);
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().map_err(|_| NeutralError::Numbers)?;
        Self::new(<[f64; 3]>::try_from(numbers).map_err(|_| NeutralError::Numbers)?)
    }
}
