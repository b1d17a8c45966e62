//! The Python module `chromascope`: arrays in, arrays out, over the core and the command line.
//!
//! ```text
//! arrays       array-likes → numbers; numbers → NumPy arrays
//! spectra      anything with wavelengths and values → curves
//! commands     keywords → arguments of a command; its output, files and remarks
//! sets         data sets and files
//! color        colorimetry of arrays
//! computed     commands whose answers are objects: metrics, matrix, light, locus, patches, identify, recover
//! drawn        figures and pictures
//! ```
//!
//! Nothing is computed here: a function converts its arguments, calls the crates below without the interpreter's lock, and converts the
//! answer.

#![allow(
    clippy::needless_pass_by_value,
    reason = "arguments of functions for Python are owned, as the macro that extracts them makes them"
)]

mod arrays;
mod color;
mod commands;
mod computed;
mod drawn;
mod sets;
mod spectra;

use pyo3::prelude::*;

/// Cameras, lights and color from spectra, with the digits of the program's command line.
///
/// Wavelengths are in nanometers, temperatures in kelvins, reflectances fractions; the last axis of an array holds channels or
/// coordinates. Functions that are named like a command of the program take its options as keywords (`white_balance` is
/// `--white-balance`), lists where an option may be repeated, and in place of a file or name any object with `wavelengths` and `values`.
/// Wrong input raises `ValueError` with the command line's sentence; its remarks are warnings.
#[pymodule(name = "chromascope")]
mod module {
    #[pymodule_export]
    use crate::color::{cct_duv, chromaticities, delta_e, planckian_locus, responses};
    #[pymodule_export]
    use crate::computed::{identify, light, locus, matrix, metrics, patches, profile, recover, run};
    #[pymodule_export]
    use crate::drawn::{Figure, figure, render};
    #[pymodule_export]
    use crate::sets::{cameras, charts, filters, illuminants, materials, observers, open};

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "a name that Python prescribes")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
