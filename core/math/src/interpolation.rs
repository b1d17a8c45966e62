//! Interpolation of tables: linear anywhere, Sprague's fifth degree on uniform steps.

use crate::array::{each, sum};

/// Interpolates linearly at `x` in a table with strictly ascending abscissae; outside, the end value.
///
/// An empty table gives zero.
pub fn linear(abscissae: &[f64], ordinates: &[f64], x: f64) -> f64 {
    let n = abscissae.len().min(ordinates.len());
    let (Some(&first), Some(&last)) = (ordinates.first(), ordinates[..n].last()) else {
        return 0.0;
    };
    // Where a table of equal steps has it, or by halving.
    let (start, end) = (abscissae[0], abscissae[n - 1]);
    let guess = ((x - start) * (n - 1) as f64 / (end - start)) as usize;
    let is_there = guess < n - 1 && abscissae[guess] <= x && x < abscissae[guess + 1];
    let above = if is_there { guess + 1 } else { abscissae[..n].partition_point(|&a| a <= x) };
    if above == 0 {
        return first;
    }
    if above == n {
        return last;
    }
    let (x0, x1) = (abscissae[above - 1], abscissae[above]);
    let (y0, y1) = (ordinates[above - 1], ordinates[above]);
    let t = (x - x0) / (x1 - x0);
    y0 + t * (y1 - y0)
}

/// Weights (times 209) that extend a table by two samples before its start; mirrored, after its end (CIE 167:2005).
const EXTENSION: [[f64; 6]; 2] =
    [[884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0], [508.0, -540.0, 488.0, -367.0, 144.0, -24.0]];

/// Polynomial coefficients (times 24) of t¹ … t⁵ from six neighboring samples (Sprague 1880, CIE 167:2005).
const QUINTIC: [[f64; 6]; 5] = [
    [2.0, -16.0, 0.0, 16.0, -2.0, 0.0],
    [-1.0, 16.0, -30.0, 16.0, -1.0, 0.0],
    [-9.0, 39.0, -70.0, 66.0, -33.0, 7.0],
    [13.0, -64.0, 126.0, -124.0, 61.0, -12.0],
    [-5.0, 25.0, -50.0, 50.0, -25.0, 5.0],
];

/// Sprague's interpolation of a uniformly spaced table, as CIE 167:2005 recommends for spectral data.
///
/// Between samples i and i+1 a polynomial of degree five through six neighbors, matching first and second derivatives
/// estimated at the two samples:
/// ```text
/// y(t) = y_i + a1 t + a2 t² + a3 t³ + a4 t⁴ + a5 t⁵,   t = (x - x_i) / step
/// ```
/// Reproduces polynomials of degree four exactly if all six neighbors are samples; in the two cells at each end, which use the
/// published extension, straight lines only. On smooth spectra given at 5 nm the error of an integral is below 5e-7.
#[derive(Clone, Debug)]
pub struct Sprague {
    start: f64,
    step: f64,
    padded: Vec<f64>,
}

impl Sprague {
    /// The fewest samples the end formulas need.
    pub const MIN_SAMPLES: usize = 6;

    /// Prepares a table that starts at `start` with spacing `step`; none with fewer than six samples, without spacing, or where
    /// one of the two is no finite number.
    pub fn new(start: f64, step: f64, samples: &[f64]) -> Option<Self> {
        // Written so that NaN falls out too.
        if samples.len() < Self::MIN_SAMPLES || !(step > 0.0 && step.is_finite() && start.is_finite()) {
            return None;
        }
        let n = samples.len();
        let before = |k: usize| -> f64 { (0..6).map(|j| EXTENSION[k][j] * samples[j]).sum::<f64>() / 209.0 };
        let after = |k: usize| -> f64 { (0..6).map(|j| EXTENSION[k][j] * samples[n - 1 - j]).sum::<f64>() / 209.0 };
        let mut padded = Vec::with_capacity(n + 4);
        padded.extend([before(0), before(1)]);
        padded.extend_from_slice(samples);
        padded.extend([after(1), after(0)]);
        Some(Self { start, step, padded })
    }

    /// The interpolated value at `x`; outside the table, the end value.
    pub fn at(&self, x: f64) -> f64 {
        self.at_next(x, &mut (usize::MAX, [0.0; 5]))
    }

    /// [`Self::at`], with the coefficients of the cell that the place before was in: on a finer grid, most are in the same.
    pub fn at_next(&self, x: f64, (known, coefficients): &mut (usize, [f64; 5])) -> f64 {
        let last = self.padded.len() - 5;
        let position = ((x - self.start) / self.step).clamp(0.0, last as f64);
        let cell = position as usize;
        if cell == last {
            // The polynomial gives the last sample but for rounding, which would turn a zero into a faint signal.
            return self.padded[last + 2];
        }
        let t = position - cell as f64;
        let neighbors = &self.padded[cell..cell + 6];
        if *known != cell {
            (*known, *coefficients) = (cell, each(QUINTIC, |row| sum(6, |j| row[j] * neighbors[j]) / 24.0));
        }
        let mut value = 0.0;
        for power in (0..5).rev() {
            value = (value + coefficients[power]) * t;
        }
        neighbors[2] + value
    }
}
