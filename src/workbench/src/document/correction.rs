//! The document's color correction: with a fitted color transform, how it is fitted.

use chromascope_core::correction::classes::{ClassWeights, ColorClass};
use chromascope_core::correction::{Correction, CorrectionMethod};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

/// The reflectances that transforms are fitted over unless the user says otherwise.
pub const TRAINING: &str = "Training reflectances (190)";

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct CorrectionChoice {
    #[serde(with = "method_id")]
    pub method: CorrectionMethod,
    pub keeps_white: bool,
    pub training: String,
    /// Weights of neutrals, skin, foliage and sky.
    pub weights: [f64; 4],
    /// Illuminant of a second calibration light in profiles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_light: Option<String>,
}

impl Default for CorrectionChoice {
    fn default() -> Self {
        let (method, training) = (CorrectionMethod::default(), TRAINING.to_owned());
        Self { method, keeps_white: true, training, weights: [1.0; 4], second_light: None }
    }
}

impl CorrectionChoice {
    /// True for what sessions were fitted by before there was a choice.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// True for the default fit, whatever the second light of profiles.
    pub fn is_default_fit(&self) -> bool {
        Self { second_light: None, ..self.clone() }.is_default()
    }

    pub fn correction(&self) -> Correction {
        Correction { method: self.method, keeps_white: self.keeps_white, weights: ClassWeights::new(self.weights) }
    }

    /// Brings weights that a file could have spoiled back into their range.
    pub fn mend(&mut self) {
        let weights = ClassWeights::new(self.weights);
        self.weights = ColorClass::ALL.map(|class| weights.of(class));
    }

    pub fn describe(&self, target: &str) -> String {
        let mut words = match self.method {
            CorrectionMethod::LeastSquares => format!("3x3 fitted to {target}"),
            CorrectionMethod::None => return format!("no correction (RGB as sRGB), beside {target}"),
            method => format!("{} fitted to {target}", method.label()),
        };
        if !self.keeps_white {
            words += "; white free";
        }
        if self.training != TRAINING {
            let _ = write!(words, "; training {}", self.training);
        }
        if self.weights != [1.0; 4] {
            let [neutrals, skin, foliage, sky] = self.weights;
            let _ = write!(words, "; weights neutrals {neutrals} skin {skin} foliage {foliage} sky {sky}");
        }
        words
    }
}

mod method_id {
    use chromascope_core::correction::CorrectionMethod;
    use serde::{Deserialize as _, Deserializer, Serializer, de::Error as _};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde calls")]
    pub(super) fn serialize<S: Serializer>(method: &CorrectionMethod, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(method.id())
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<CorrectionMethod, D::Error> {
        let id = String::deserialize(deserializer)?;
        let unknown = || D::Error::custom(format!("no color correction is named {id}"));
        CorrectionMethod::by_id(&id).ok_or_else(unknown)
    }
}
