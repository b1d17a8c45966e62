//! Glass catalogs of lens design programs (Zemax `.agf`): for each glass a line `NM` with its name, and lines `IT` with a wavelength
//! in micrometers, the internal transmittance there, and the thickness in millimeters that it is of.

use std::collections::BTreeMap;

use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Quantity, Reader, WavelengthUnit};
use crate::error::{ReadError, check_curves, check_samples};
use crate::formats::Format;
use crate::formats::spectra::{self, Found, Sample, Spectrum};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::{Lines, excerpt};
use crate::watch::Log;

impl Reader {
    /// Glass catalogs of lens design programs.
    pub const AGF: Self = Self::new("agf", "glass catalog (AGF)", "Glass catalog .agf");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::AGF, fits: |head| head.is_plain() && recognize(head.text), read };

/// Lines in which a catalog has the name of its first glass.
const LOOK: usize = 100;

/// Returns whether a text begins with remarks or a glass, and the glass with its name, its dispersion and other lines of two letters.
fn recognize(text: &str) -> bool {
    let mut keys = Lines::new(text).take(LOOK).filter_map(|(_, line)| line.split_whitespace().next());
    keys.by_ref().find(|key| *key != "CC") == Some("NM") && keys.take(3).any(|key| matches!(key, "ED" | "CD"))
}

fn read(text: &str, _: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut header = Header::default();
    let mut glass = "";
    let mut known = BTreeMap::new();
    let (mut spectra, mut count) = (Vec::<Spectrum>::new(), 0);
    for (line, text) in Lines::new(text) {
        let mut cells = text.split_whitespace();
        match cells.next() {
            Some("CC") => header.note(line, "description", text.trim_start()[2..].trim()),
            Some("NM") => glass = cells.next().unwrap_or_default(),
            Some("IT") => {
                count += 1;
                check_samples(count, line)?;
                log.work(text.len(), 0)?;
                let cells: Vec<&str> = cells.collect();
                let [wavelength, value, thickness, ..] = cells[..] else {
                    return Err(ReadError::UnevenRow { line, found: 1 + cells.len(), expected: 4 });
                };
                let number = |at: usize| {
                    let number = cells[at].parse().ok().filter(|number: &f64| number.is_finite());
                    number.ok_or_else(|| ReadError::NotANumber { line, column: at + 2, text: excerpt(cells[at]) })
                };
                let (nm, transmittance, millimeters) = (number(0)?, number(1)?, number(2)?);
                let index = *known.entry((glass, thickness)).or_insert(spectra.len());
                if index == spectra.len() {
                    check_curves(index + 1, line)?;
                    let name = Some(format!("{glass} ({millimeters} mm)"));
                    spectra.push(Spectrum { name, label: "internal transmittance".to_owned(), samples: Vec::new() });
                }
                let place = log.places.as_mut().map(|places| places.pair(wavelength, value)).unwrap_or_default();
                spectra[index].samples.push(Sample { wavelength: nm, value: transmittance, line, place });
            }
            _ => {}
        }
    }
    // One wavelength is no spectrum.
    spectra.retain(|spectrum| spectrum.samples.len() > 1);
    let first_line = spectra.first().map(|spectrum| spectrum.samples[0].line).ok_or(ReadError::NoNumbers)?;
    let why = "Lines IT are of internal transmittances";
    let mut grid = spectra::grid(spectra, header, log)?;
    grid.unit = Some(Decided::certain(WavelengthUnit::Micrometer, "Glass catalogs prescribe it"));
    grid.quantity = Some(Decided::certain(Quantity::Transmittance, why));
    let notes = vec![Decision::certain("Left out", "the dispersion and other properties of the glasses", why)];
    let dialect = (Delimiter::Spaces, DecimalMark::Point);
    Ok(Found::fixed(grid, Decided::certain(Reader::AGF, why), (dialect, first_line, why), notes))
}
