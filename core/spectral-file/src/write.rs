//! The way out: spectral curves as text in the formats that other programs open.
//!
//! [`write()`] takes borrowed curves with what is known about them ([`Sheet`]) and gives the text of a file, together with
//! [`Note`]s on all that differs from the curves as they were given: another grid, a shorter range, another scale. CSV begins with
//! its header, as other programs expect; title, source and the like are in [`Metadata`] for a file beside it, which is read back. A
//! column of uncertainties stands behind its curve, and a covariance goes into a file beside ([`Beside`]); other formats have no place
//! for either.
//!
//! Numbers are the shortest decimals that read back as the same double. Reflectances and transmittances are fractions.
//!
//! Resampling follows the convention that the program computes with (CIE 167:2005; CIE 15:2018):
//! Sprague's interpolation in even tables with steps of 5 nm or more of anything but a light, linear in all others. The
//! new wavelengths are whole multiples of the step; where one falls on a sample (to 1e-6 nm), the sample is kept to the last
//! bit, and nothing is ever written beyond a curve's own range. A step coarser than that of the curve picks samples without
//! averaging, which loses narrow lines; a [`Note`] says so, and [`Grid::Average`] keeps them:
//!
//! ```text
//! V_k = 1/Δ ∫ v(λ) dλ    over |λ − kΔ| ≤ Δ/2
//! ```
//!
//! with v the linear interpolant of the samples, whose integral is taken exactly (to rounding): the average of a curve that is
//! linear between its samples. Bands that a curve does not cover as a whole are not written. Largest errors of points on the way to 1 nm of a bell with σ = 30 nm and
//! height 1 that a table cuts off at 0.2:
//!
//! | from | Sprague | in the two cells at each end | linear |
//! |---|---|---|---|
//! | 5 nm | 4e-6 | 6e-4 | 3.5e-3 |
//! | 10 nm | 1.2e-4 | 2.5e-3 | 1.4e-2 |
//!
//! ```
//! use spectral_file::write::{Content, Format, Grid, Sheet, Trace, write};
//!
//! let leaf = Trace { name: "leaf", wavelengths_nm: &[400.0, 410.0], values: &[0.055, 0.06], uncertainty: None };
//! let sheet = Sheet { title: "Leaf", content: Content::Reflectance, curves: &[leaf], ..Sheet::default() };
//! let written = write(&sheet, Format::Csv, Grid::Native)?;
//! assert_eq!(written.text, "wavelength_nm,leaf [reflectance factor in 1]\n400,0.055\n410,0.06\n");
//! assert!(written.beside.metadata.is_some_and(|metadata| metadata.text("leaf.csv").contains(r#""dc:title": "Leaf""#)));
//! assert!(written.notes.is_empty());
//! # Ok::<(), spectral_file::write::WriteError>(())
//! ```

mod base;
mod cgats;
mod csv;
mod format;
mod json;
mod sheet;

pub use csv::{Beside, Metadata, Prepared};
pub use format::{Format, Grid, Note, WriteError};
pub use sheet::{Content, Sheet, Trace};

impl Format {
    /// Returns whether curves of this kind and number can be written in this format, whatever their wavelengths.
    ///
    /// # Errors
    /// [`WriteError`] for curves that are none, of other kinds or in another number than the format holds.
    pub fn fits(self, sheet: &Sheet<'_>) -> Result<(), WriteError> {
        sheet.check()?;
        let found = sheet.curves.len();
        let wanted = match (self, sheet.content) {
            (Self::ArgyllCmf, Content::Reflectance | Content::Transmittance | Content::Illuminant) => {
                return Err(WriteError::OtherContent(self));
            }
            // The three channels of a camera are among its curves, or the check of the sheet would have failed.
            (_, Content::Camera { .. }) => None,
            (Self::ArgyllCmf, _) | (Self::RawtoacesJson, Content::Observer) => Some(3),
            (Self::DcamprofJson, _) | (Self::RawtoacesJson, Content::Illuminant) => Some(1),
            _ => None,
        };
        match wanted.filter(|&wanted| wanted != found) {
            Some(wanted) => Err(WriteError::Count { format: self, found, wanted }),
            None => Ok(()),
        }
    }
}

/// The text of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The text, with a line feed after each line.
    pub text: String,
    /// What is known about the curves and is not in the text, for files beside it.
    pub beside: Beside,
    /// Differences from the curves as they were given.
    pub notes: Vec<Note>,
}

/// Writes curves in a format, at their own wavelengths or resampled.
///
/// Deterministic: equal curves give equal text. Limits are those of reading: [`crate::MAX_CURVES`] and
/// [`crate::MAX_SAMPLES`].
///
/// # Errors
/// [`WriteError`] for curves that are none, or that the format cannot hold on such a grid.
pub fn write(sheet: &Sheet<'_>, format: Format, grid: Grid) -> Result<Written, WriteError> {
    format.fits(sheet)?;
    base::check(grid)?;
    if format.is_csv() {
        let (mut prepared, mut text) = (Prepared::new(sheet, grid)?, String::new());
        let put = &mut |part: &str| {
            text.push_str(part);
            true
        };
        if format == Format::Csv {
            prepared.table(put);
        } else {
            prepared.with_comments(put);
        }
        let beside = prepared.beside(format == Format::Csv);
        return Ok(Written { text, beside, notes: prepared.notes() });
    }
    let mut draft = base::Draft::new(sheet, format, grid)?;
    let text = match format {
        Format::RawtoacesJson => json::rawtoaces(&mut draft),
        Format::DcamprofJson => json::dcamprof(&mut draft),
        _ => cgats::write(&mut draft),
    };
    Ok(Written { text, beside: Beside::default(), notes: draft.notes })
}
