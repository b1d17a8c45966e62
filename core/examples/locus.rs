//! Chromaticity of a blackbody at 5500 K through a Nikon D70 (Eq 15 and 13, equal energy).
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use chromascope_core::prelude::*;

/// Prints x and y.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let camera = data::camera("Nikon D70 (2007 figure)")?;
    let signals = LocusEvaluator::new(&camera, RadiationConstants::Paper).raw(Kelvin::new(5500.0)?);
    let xyz = Rendering::under_equal_energy(&camera)?.blackbody(signals);
    let xy = xyz.chromaticity().ok_or("chromaticity undefined")?;
    println!("{:.4} {:.4}", xy.x, xy.y);
    Ok(())
}
