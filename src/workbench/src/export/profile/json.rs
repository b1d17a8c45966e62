//! Color corrections as JSON, with all digits.

use chromascope_core::correction::RgbTransform;
use chromascope_core::correction::root_polynomial::RootPolynomial;
use chromascope_core::query::ErrorSummary;
use chromascope_core::query::correction::CorrectionUnder;
use serde_json::{Value, json};

use super::{CorrectionFile, rows};

const VERSION: u32 = 1;

impl CorrectionFile {
    /// One object: matrices, rows first, and errors under each light. What depends on the channel ratio is null without a credible one.
    pub fn json(&self) -> String {
        let has_ratio = self.has_ratio().is_ok();
        let idt = self.idt.as_ref().ok().map(|idt| {
            let balance = has_ratio.then_some(idt.balance);
            json!({ "balance": balance, "aces_from_rgb": rows(idt.matrix), "errors": self.summary(
                ErrorSummary::new(&idt.errors.iter().copied().map(Some).collect::<Vec<_>>())) })
        });
        let all = json!({
            "format": "chromascope-correction",
            "version": VERSION,
            "camera": self.of.camera,
            "correction": self.of.correction,
            "channel_ratio": self.ratio.to_string(),
            "metric": self.of.metric,
            "lights": self.unders().map(|(light, under)| self.light(light, under, has_ratio)).collect::<Vec<_>>(),
            "idt": idt,
        });
        format!("{all:#}\n")
    }

    fn light(&self, light: &str, under: &CorrectionUnder, has_ratio: bool) -> Value {
        let report = &under.report;
        let (matrix, terms) = match &report.transform {
            RgbTransform::Matrix(matrix) => (Some(rows(*matrix)), None),
            RgbTransform::RootPolynomial(polynomial) => {
                let coefficients = polynomial.coefficients().iter().enumerate();
                let term = |(index, c): (usize, &glam::DVec3)| json!({ "term": RootPolynomial::term_name(index), "xyz": c.to_array() });
                (None, Some(coefficients.map(term).collect::<Vec<_>>()))
            }
        };
        let dng = self.dng_matrices(under).map(|dng| {
            json!({ "forward_matrix": rows(dng.forward), "color_matrix": has_ratio.then(|| rows(dng.color)),
                    "neutral": has_ratio.then(|| dng.neutral().to_array()) })
        });
        let white = report.adopted_white;
        json!({
            "light": light,
            "cct_k": under.temperature.map(chromascope_core::units::Kelvin::get),
            "xyz_from_rgb": matrix,
            "root_polynomial": terms,
            "adopted_white": [white.x, white.y, white.z],
            "errors": { "uncorrected": self.summary(report.before), "training": self.summary(report.training),
                        "leave_one_out": self.summary(report.left_out) },
            "dng": dng,
        })
    }

    fn summary(&self, of: Option<ErrorSummary>) -> Value {
        of.map_or(Value::Null, |ErrorSummary { mean, p95, max, worst }| {
            let worst = self.of.training.patches().get(worst).map(|patch| &patch.name);
            json!({ "mean": mean, "p95": p95, "max": max, "worst": worst })
        })
    }
}
