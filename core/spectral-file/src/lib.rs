//! Spectral tables from text: bytes in, curves with units and provenance out.
//!
//! [`read`] takes the bytes of a file and returns [`SpectralFile`]: curves over wavelength in nanometers, the [`Role`] they
//! seem to play, and a [`ReadReport`] that tells what was decided on the way and how sure each decision is. Anything
//! decided can be overruled through [`ReadOptions`] by reading again.
//!
//! Input: numbers in columns (wavelengths down the first column, or across a header row), separated by commas,
//! semicolons, tabs or spaces; points or commas as decimal marks; UTF-8, UTF-16, Shift-JIS or Windows-1252; any line ends;
//! comments (`# key: value`), headers, units in headers, gaps (`NaN`, `---`, empty, −999 and its kin where they stand out), any
//! order of wavelengths.
//!
//! Lights counted in photons (µmol m⁻² s⁻¹ nm⁻¹), per frequency or per wave number become energies per nanometer, as the decision
//! "Spectral unit" says with the factor.
//!
//! Families with a grammar of their own are recognized by content and read too: CGATS (Argyll, X-Rite), JCAMP-DX, XML
//! (TM-27, `CxF`), JSON (rawtoaces, dcamprof with comments, Wasatch ENLIGHTEN), lamp meters that write wavelengths into labels, files
//! that put wavelengths and values on alternate lines, Spectra Vista `.sig`, and ASCII of `PerkinElmer`.
//!
//! Not read: binary files, and XML or JSON of other layouts. The error names them, with a remedy.
//!
//! Reading is total: it does not panic, takes time proportional to the input, and needs a few times its memory, most of it
//! the samples themselves (16 bytes each). The limits are [`MAX_BYTES`], [`MAX_CURVES`] and [`MAX_SAMPLES`].
//!
//! ```
//! use spectral_file::{read, ReadOptions, Role};
//!
//! let leaf = read("nm;Reflectance (%)\n400;5,5\n410;6,0\n".as_bytes(), &ReadOptions::default())?;
//! assert_eq!(leaf.role.value, Role::Reflectance);
//! assert_eq!(leaf.curves[0].wavelengths_nm, [400.0, 410.0]);
//! assert_eq!(leaf.curves[0].values, [0.055, 0.06]);
//! # Ok::<(), spectral_file::ReadError>(())
//! ```
//!
//! Stages of reading, in order: `text` (bytes to text), `formats` (choice of the reader), for numbers in columns `sniff`
//! (separators, first row of numbers), `header` (names, units, comments), `columns` or `wide` (text to numbers), then
//! `wavelengths` (unit, order, repeats), `gaps`, `no_curve`, `uncertainty`, `scale` (role, percent), `quantity` (photons to energies), and in `read` the
//! curves. Another format is one file in `formats` and its line in `FORMATS`: it fills the same `Grid`, and all after it is shared.

#![cfg_attr(
    not(all(feature = "encodings", feature = "json", feature = "xml")),
    allow(dead_code, reason = "some items serve one format only")
)]

mod bands;
mod beside;
mod binary;
mod clues;
mod columns;
mod covariance;
mod decimal;
mod decision;
mod dialect;
mod dialect_trial;
mod error;
mod formats;
mod grid;
mod header;
mod header_terms;
mod heads;
mod instrument;
mod no_curve;
mod options;
mod preview;
mod quantity;
mod read;
mod report;
mod scale;
mod sniff;
mod text;
mod uncertainty;
mod uncertainty_terms;
mod unit_text;
mod units;
mod warning;
mod watch;
mod wavelengths;
mod wide;
pub mod write;

pub use beside::{METADATA, Source};
pub use binary::BinaryKind;
pub use chromascope_text::{cell, guarded, lowered, on_one_line, quoted, turns_text};
pub use covariance::COVARIANCE;
pub use decision::{
    Certainty, Decided, DecimalMark, Decision, Delimiter, Dropped, Effect, Encoding, Family, Medium, Orientation, Part,
    Quantity, Reader, Role, Values, WavelengthUnit,
};
pub use error::{MAX_BYTES, MAX_CURVES, MAX_SAMPLES, NearMiss, ReadError};
pub use options::ReadOptions;
pub use preview::{LONGEST_LINE, LeftOut, Mark, Marker, Preview, Shown, What};
pub use read::{read, read_marked, read_watched};
pub use report::{Covariance, Curve, DroppedRow, ReadReport, SpectralFile, Steps, Uncertainty};
pub use warning::{LineList, Sentinel, Warning};
pub use watch::Watch;

/// The example of the README, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
