//! `ColorChecker` patches under D65 through a camera fitted to CIE 1931, with their difference from that observer.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use chromascope_core::colorimetry::delta_e_2000;
use chromascope_core::prelude::*;

/// Prints name, xy and ΔE*00 of each patch.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (camera, reference) = (data::camera("Nikon D850")?, data::observer("CIE 1931 2°")?);
    let (light, chart) = (data::illuminant("D65")?, data::chart("ColorChecker 24 (Ohta 1997)")?);
    let training = data::chart("Training reflectances (190)")?;
    let transform =
        ColorTransform::Observer { reference: &reference, training: &training, correction: Correction::default() };
    let renderings = [&camera, &reference].map(|sensor| {
        Rendering::new(sensor, &light, WhiteBalanceTarget::UNITY, transform).map(|rendering| (sensor, rendering))
    });
    let [camera, reference] = renderings;
    let sensors = [camera?, reference?];
    for patch in chart.patches() {
        let [(xyz, lab), (_, reference_lab)] = sensors.each_ref().map(|(sensor, rendering)| {
            let product: Vec<f64> = patch.grid.values().iter().zip(light.values()).map(|(s, l)| s * l).collect();
            let raw = sensor.integrate(product.as_slice().try_into().expect("both are on the grid"));
            let xyz = rendering.xyz(rendering.patch_signals(raw));
            (xyz, rendering.lab(xyz))
        });
        let xy = xyz.chromaticity().ok_or("chromaticity undefined")?;
        let difference = lab.zip(reference_lab).map(|(a, b)| delta_e_2000(a, b)).ok_or("no L*a*b*")?;
        println!("{:<14} {:.4} {:.4}  ΔE*00 {difference:.2}", patch.name, xy.x, xy.y);
    }
    Ok(())
}
