//! Values that fractions of light and sensitivities cannot have.

use crate::grid::Grid;
use crate::role::Role;
use crate::scale::decision::Scale;
use crate::scale::evidence::VISIBLE_NM;
use crate::warning::Warning;
use crate::watch::Log;

/// Warns of reflectances that cannot be, and of values further below zero than noise, also of lights.
pub(crate) fn warn(scale: &Scale, grid: &Grid, log: &mut Log<'_>) {
    const LARGEST_FRACTION: f64 = 2.0;
    // Photons on a square meter in a second and a nanometer stay below 1e22.
    const LARGEST: f64 = 1e30;
    const NOISE: f64 = 0.05;
    let role = scale.role.value;
    let light = role == Role::Illuminant;
    if !role.is_fraction() && role != Role::Camera && !light {
        return;
    }
    // Outside, instruments are noisy.
    let all = !light && !grid.wavelengths.iter().any(|w| VISIBLE_NM.contains(w));
    let (mut bright, mut below) = (0, 0);
    let (mut first_bright, mut first_below) = (None, None);
    for curve in &grid.curves {
        let mut lowest = (f64::INFINITY, 0);
        let mut max = f64::NEG_INFINITY;
        for (at, (w, &value)) in grid.wavelengths.iter().zip(&curve.values).enumerate() {
            if (all || VISIBLE_NM.contains(w)) && !value.is_nan() {
                max = max.max(value);
                lowest = if value < lowest.0 { (value, at) } else { lowest };
            }
        }
        if (role.is_fraction() && max > LARGEST_FRACTION && !all) || max > LARGEST {
            bright += 1;
            first_bright.get_or_insert((curve, max));
        }
        if lowest.0 < -NOISE * max.max(0.0) && lowest.0 < 0.0 {
            below += 1;
            first_below.get_or_insert((curve, lowest));
        }
    }
    if let Some((curve, max)) = first_bright {
        log.push(Warning::NotReflectances { count: bright, first: curve.description(), max });
    }
    if let Some((curve, (min, at))) = first_below {
        let line = (grid.lines.len() == grid.wavelengths.len()).then(|| grid.line(at));
        log.push(Warning::BelowZero { count: below, first: curve.description(), min, line });
    }
}
