//! Writes a DCP file with the matrices of one light to standard output.
#![allow(clippy::disallowed_methods, reason = "an example writes its result")]

use chromascope_profile::dcp::{Calibration, CalibrationIlluminant, Dcp};
use std::io::Write as _;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let calibration = Calibration {
        illuminant: CalibrationIlluminant::Exif(23),
        color: [[0.9, -0.3, -0.1], [-0.4, 1.2, 0.2], [-0.1, 0.2, 0.6]],
        forward: [[0.7, 0.2, 0.0643], [0.3, 0.8, -0.1], [0.0, -0.1, 0.9251]],
    };
    let dcp = Dcp {
        camera: "Example camera".to_owned(),
        name: "Example profile".to_owned(),
        copyright: String::new(),
        calibrations: vec![calibration],
    };
    Ok(std::io::stdout().write_all(&dcp.to_bytes()?)?)
}
