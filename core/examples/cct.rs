//! Correlated color temperature and Duv of a million colors near the Planckian locus (Ohno's definition: nearest point in
//! CIE 1960 u, v).
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use chromascope_core::colorimetry::Uv60;
use chromascope_core::prelude::*;

/// Prints how many colors have a correlated color temperature, and the mean of it.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let locus = PlanckianLocus::new(&data::observer("CIE 1931 2°")?, RadiationConstants::Paper)?;
    let side = 1000_u32;
    let step = |i: u32, from: f64, to: f64| from + (to - from) * f64::from(i) / f64::from(side - 1);
    let colors: Vec<Uv60> =
        (0..side * side).map(|i| Uv60 { u: step(i % side, 0.18, 0.30), v: step(i / side, 0.27, 0.36) }).collect();
    let temperatures: Vec<f64> = locus.ccts(&colors).into_iter().flatten().map(|cct| cct.temperature.get()).collect();
    let mean = temperatures.iter().sum::<f64>() / temperatures.len().max(1) as f64;
    println!("{} of {} colors have a CCT; mean {mean:.0} K", temperatures.len(), colors.len());
    Ok(())
}
