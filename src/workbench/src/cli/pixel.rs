//! Conditions of figures of merit that `compare` and `figure` share.

use clap::Args;

use super::error::CliError;
use crate::document::Pixel;

/// Temperature in kelvins of the locus metrics unless another is named.
pub(super) const LOCUS_K: f64 = 2856.0;
/// A pixel of the cameras.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct PixelArguments {
    /// Full-well capacity of a pixel in electrons, for gray-snr
    #[arg(long, value_name = "ELECTRONS")]
    full_well: Option<f64>,
    /// Read noise of a pixel in electrons (RMS)
    #[arg(long, value_name = "ELECTRONS", default_value_t = 0.0, requires = "full_well")]
    read_noise: f64,
}

impl PixelArguments {
    /// The pixel, if its full well is named.
    pub(super) fn pixel(self) -> Result<Option<Pixel>, CliError> {
        let pixel = self.full_well.map(|full_well| Pixel { full_well, read_noise: self.read_noise });
        let valid = pixel.map_or(Ok(()), |pixel| pixel.electrons().map(drop));
        valid.map_err(|error| CliError::Argument { argument: "--full-well", reason: error.to_string() })?;
        Ok(pixel)
    }
}
