//! Comparison of the values with what the header announces.

use crate::error::ReadError;
use crate::formats::jcamp::block::{Block, Form};
use crate::warning::Warning;

impl Block {
    /// Compares the announced ends, the first, the smallest and the largest value with the data.
    pub(super) fn check(&mut self) -> Result<(), ReadError> {
        self.found = self.samples.len();
        let (Some(first), Some(last)) = (self.samples.first(), self.samples.last()) else { return Ok(()) };
        let (first_x, last_x, first_y) = (first.wavelength, last.wavelength, first.value);
        let whole = self.points.1.is_none_or(|points| points == self.found);
        let values = || self.samples.iter().map(|sample| sample.value);
        let (min, max) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let mut differing = Vec::new();
        // Missing lines at an end are detected by the number of values.
        let ends = [("FIRSTX", first_x), ("LASTX", last_x)];
        let reversed = self.written == Form::Pairs && self.is_near("FIRSTX", last_x) && self.is_near("LASTX", first_x);
        for (label, found) in ends.into_iter().filter(|_| whole && !reversed) {
            differing.extend(self.differs(label, found).filter(|_| !self.is_near(label, found)));
        }
        let factor = self.factor("YFACTOR");
        let mut scales = Vec::new();
        let first_y = if reversed { self.samples.last().map_or(first_y, |last| last.value) } else { first_y };
        for (label, found) in [("FIRSTY", first_y), ("MINY", min), ("MAXY", max)] {
            let Some((line, announced)) = self.number(label) else { continue };
            // Ordinates that are whole numbers were rounded to such.
            let whole = self.written == Form::Ordinates && (found / factor).fract().abs() < 1e-9;
            let slack = announced.digit + if whole { factor.abs() / 2.0 } else { 0.0 } + 1e-6 * found.abs();
            let near = (announced.value - found).abs() <= slack;
            let raw = (announced.value - found / factor).abs() <= announced.digit + 1e-6 * (found / factor).abs();
            if !near {
                differing.extend(self.differs(label, found));
            }
            let power = (announced.value / found).log10();
            let is_power = power.is_finite() && (power - power.round()).abs() < 1e-3 && power.round() != 0.0;
            scales.push((
                near || raw || !is_power,
                ReadError::ScaleContradicts { line, label, announced: announced.value, found },
            ));
        }
        // Where all that is announced is another power of ten, the factor is wrong.
        if scales.iter().all(|(fits, _)| !fits)
            && let Some((_, error)) = scales.into_iter().next()
        {
            return Err(error);
        }
        self.warnings.append(&mut differing);
        Ok(())
    }

    fn is_near(&self, label: &str, found: f64) -> bool {
        let Some((_, announced)) = self.number(label) else { return true };
        let step = self.samples.windows(2).map(|pair| (pair[1].wavelength - pair[0].wavelength).abs());
        let step = step.fold(f64::INFINITY, f64::min);
        (announced.value - found).abs() <= announced.digit.min(step) + 1e-6 * found.abs()
    }

    fn differs(&self, label: &'static str, found: f64) -> Option<Warning> {
        let (line, announced) = self.number(label)?;
        Some(Warning::HeaderDiffers { line, label, announced: announced.value, found })
    }
}
