//! Single causes of residuals, to first order: light, one channel's wavelengths, one patch.

use super::RecordedPatch;
use super::two_way::Grid;
use crate::spectral::Sensor;
use crate::spectral::grid::{COUNT, STEP_NM, wavelength_nm};

/// Link of the chain light × surface × sensor that may be at fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LinkKind {
    /// The light is tilted: `L (1 + ε (λ − 580 nm) / 100 nm)`; the amount is ε.
    Light,
    /// A channel's sensitivity lies at other wavelengths; the amount is the shift in nanometers, positive towards the red.
    Channel(usize),
    /// One patch's spectrum or recorded values; the amount is the root mean square of its residuals.
    Patch(usize),
}

/// One cause and how much it would explain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Link of the chain.
    pub kind: LinkKind,
    /// Amount that explains most, to first order.
    pub amount: f64,
    /// Share of `Σ r²` that it explains, from 0 to 1.
    pub share: f64,
}

/// Wavelength in nanometers about which a light is tilted.
const PIVOT_NM: f64 = 580.0;
/// Unit of the tilt in nanometers.
const TILT_NM: f64 = 100.0;

/// Causes by the share of the residuals' squares that each explains alone.
pub(super) fn links(
    patches: &[RecordedPatch],
    sensor: &Sensor,
    grid: &Grid,
    residuals: &[[Option<f64>; 3]],
) -> Vec<Link> {
    let all: f64 = residuals.iter().flatten().flatten().map(|r| r * r).sum();
    if all < f64::MIN_POSITIVE {
        return Vec::new();
    }
    let columns: Vec<[[f64; 3]; 2]> = patches.iter().map(|patch| sensitivities(patch, sensor)).collect();
    let explained = |kind: LinkKind, entry: &dyn Fn(&[[f64; 3]; 2], usize) -> f64| {
        let at = |(row, column): (&[Option<f64>; 3], &[[f64; 3]; 2])| {
            [0, 1, 2].map(|c: usize| row[c].map(|_| entry(column, c)))
        };
        let column: Vec<[Option<f64>; 3]> = residuals.iter().zip(&columns).map(at).collect();
        // What gains and brightness would take up of it explains nothing.
        let column = grid.fit_column(&column).residuals;
        let pairs = || column.iter().flatten().flatten().zip(residuals.iter().flatten().flatten());
        let (square, product) = pairs().fold((0.0, 0.0), |(s, p), (t, r)| (s + t * t, p + t * r));
        let amount = if square > 1e-24 { product / square } else { 0.0 };
        Link { kind, amount, share: (amount * product / all).clamp(0.0, 1.0) }
    };
    let mut links = vec![explained(LinkKind::Light, &|column, c| column[0][c])];
    links.extend([0, 1, 2].map(|channel| {
        explained(LinkKind::Channel(channel), &move |column, c| if c == channel { column[1][c] } else { 0.0 })
    }));
    let worst = residuals.iter().enumerate().map(|(patch, row)| (patch, row.iter().flatten())).map(|(patch, row)| {
        let (count, sum) = row.fold((0_usize, 0.0), |(n, sum), r| (n + 1, sum + r * r));
        Link { kind: LinkKind::Patch(patch), amount: (sum / count.max(1) as f64).sqrt(), share: (sum / all).min(1.0) }
    });
    links.extend(worst.max_by(|a, b| a.share.total_cmp(&b.share)));
    links.sort_by(|a, b| b.share.total_cmp(&a.share));
    links
}

/// Derivatives of the logarithm of a patch's responses: by the light's tilt, and by each channel's shift in nanometers.
fn sensitivities(patch: &RecordedPatch, sensor: &Sensor) -> [[f64; 3]; 2] {
    let values = patch.radiance.values();
    let mut tilted = [0.0; COUNT];
    let mut slope = [0.0; COUNT];
    for index in 0..COUNT {
        tilted[index] = values[index] * (wavelength_nm(index) - PIVOT_NM) / TILT_NM;
        // ∫ C(λ − δ) f(λ) dλ = ∫ C(λ) f(λ + δ) dλ.
        let (before, after) = (index.saturating_sub(1), (index + 1).min(COUNT - 1));
        slope[index] = (values[after] - values[before]) / ((after - before) as f64 * STEP_NM);
    }
    let response = sensor.integrate(values);
    let relative = |column: &[f64; COUNT]| {
        let derivative = sensor.integrate(column);
        [0, 1, 2].map(|c: usize| if response[c].is_normal() { derivative[c] / response[c] } else { 0.0 })
    };
    [relative(&tilted), relative(&slope)]
}
