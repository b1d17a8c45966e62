//! Result of reading: curves with their report.

use crate::error::ReadError;
use crate::report::{Certainty, Decided, Decision, ReadReport};
use crate::role::{Role, Values};
use crate::warning::Warning;

/// One curve: values over wavelength, in the order of wavelength.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name from the header, the title of the file, or `Column 2` and `Row 1`.
    pub name: String,
    /// True if the name is from the file; where it is not, the name of the file may say more.
    pub named: bool,
    /// Wavelengths in nanometers: finite, strictly ascending, at least two.
    pub wavelengths_nm: Vec<f64>,
    /// Values, one for each wavelength: finite; percent are already divided by 100.
    pub values: Vec<f64>,
    /// Number of wavelengths of the table without a value in this curve. They are omitted, not filled.
    pub missing: usize,
    /// The unit of the values as the file names it, such as `W/m²/nm` or `counts`.
    pub unit: Option<String>,
}

/// Curves of a file, with the report of how it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralFile {
    /// The curves, in the order of the file; at least one.
    pub curves: Vec<Curve>,
    /// Role of the curves.
    pub role: Decided<Role>,
    /// Decisions made while reading.
    pub reading: ReadReport,
    /// Doubts to check before the curves are trusted.
    pub warnings: Vec<Warning>,
}

impl SpectralFile {
    /// This file, unless it holds values that no quantity of its role has: fractions of light far from 0 to 1, and numbers beyond any
    /// unit. A scale that is open, or that was chosen to be as written, is not judged.
    ///
    /// # Errors
    /// [`ReadError::ImpossibleValues`], with the first of them.
    pub fn usable(self) -> Result<Self, ReadError> {
        const NOISE: f64 = 0.05;
        let values = &self.reading.values;
        let asked = values.certainty == Certainty::Open || self.role.certainty == Certainty::Open;
        if asked || (values.certainty, values.value) == (Certainty::Chosen, Values::Plain) {
            return Ok(self);
        }
        let impossible = self.warnings.iter().find(|warning| match warning {
            Warning::NotReflectances { .. } => true,
            Warning::BelowZero { min, .. } => self.role.value.is_fraction() && *min < -NOISE,
            _ => false,
        });
        match impossible {
            Some(warning) => Err(ReadError::ImpossibleValues { line: warning.line(), what: warning.to_string() }),
            None => Ok(self),
        }
    }

    /// Every decision made on reading, the role first, ready to be listed for the user.
    pub fn decisions(&self) -> Vec<Decision> {
        let mut all = vec![Decision::new("Role", &self.role)];
        all.extend(self.reading.decisions());
        all
    }
}
