//! IES TM-27: spectra of light sources in XML, one element for each sample.

use crate::decision::{Decided, Part, Quantity, Reader, Role};
use crate::error::{MAX_PARTS, ReadError, check_curves};
use crate::formats::Format;
use crate::formats::spectra::{Found, Sample, Spectrum};
use crate::formats::xml::{self, Element, Step, Walk};
use crate::header::Header;
use crate::header_terms;
use crate::options::ReadOptions;
use crate::text::is_one;
use crate::warning::Warning;
use crate::watch::Log;

impl Reader {
    /// XML of IES TM-27 (`.spdx`).
    pub const TM27: Self = Self::new("tm27", "IES TM-27", "IES TM-27");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::TM27, fits: |head| xml::fits(head, |root| root.starts_with("IESTM27")), read };

/// Reads all spectra of a document. Only local names are compared: the namespace differs between editions.
fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut walk = Walk::new(text);
    let mut content = Content::default();
    while let Some(step) = walk.next(log)? {
        let inside = walk.innermost().map_or("", Element::name);
        match step {
            Step::Open if inside == "SpectralDistribution" => content.current = Some(Spectrum::default()),
            Step::Open => {}
            Step::Close(element) => content.take(&element, inside, log)?,
        }
    }
    let parts = content.parts();
    let quantity = content.take_part(&parts, options.part, log)?;
    let Content { header, spectra: all, .. } = content;
    let reader = Decided::certain(Reader::TM27, format!("The root element is “{}”", walk.root()));
    let mut found = xml::found(all, header, (reader, "TM-27 prescribes it"), log)?;
    let grid = &mut found.grid;
    let said = quantity.as_ref().and_then(|quantity| Some((quantity.value.role()?, quantity.why.clone())));
    // Most such files are of lamps, but "relative" and "other" do not say so.
    let guess = || Decided::guess(Role::Illuminant, "TM-27 is mostly used for lamps");
    grid.role = Some(said.map_or_else(guess, |(role, why)| Decided::certain(role, why)));
    grid.quantity = quantity;
    if parts.len() > 1 {
        grid.part = Some(Decided::guess(1, format!("The spectra are of {} quantities", parts.len())));
        grid.parts = parts;
    }
    Ok(found)
}

#[derive(Default)]
struct Content {
    header: Header,
    spectra: Vec<Spectrum>,
    quantities: Vec<Option<Decided<Quantity>>>,
    quantity: Option<Decided<Quantity>>,
    current: Option<Spectrum>,
}

impl Content {
    /// Takes an element that is complete, and the name of the one around it.
    fn take(&mut self, element: &Element<'_>, inside: &str, log: &mut Log<'_>) -> Result<(), ReadError> {
        if inside == "Header" {
            self.header.note(element.line, element.name(), element.content());
        }
        match element.name() {
            // The description is the title, whatever the rest of the header.
            "Header" => {
                if let Some(description) = self.header.comment("Description").map(str::to_owned) {
                    self.header.note(0, "title", &description);
                }
            }
            "SpectralQuantity" => self.quantity(element),
            "SpectralData" => self.sample(element, log)?,
            "SpectralDistribution" => {
                let quantity = self.quantity.take();
                if let Some(spectrum) = self.current.take().filter(|spectrum| !spectrum.samples.is_empty()) {
                    self.spectra.push(spectrum);
                    self.quantities.push(quantity);
                }
                check_curves(self.spectra.len(), element.line)?;
            }
            _ => {}
        }
        Ok(())
    }

    fn quantity(&mut self, element: &Element<'_>) {
        let quantity = element.content();
        if let Some(spectrum) = self.current.as_mut().filter(|spectrum| spectrum.label.is_empty()) {
            quantity.clone_into(&mut spectrum.label);
            self.header.note(element.line, "quantity", quantity);
            let why = format!("Line {} says {quantity}", element.line);
            self.quantity = named(quantity).map(|quantity| Decided::certain(quantity, why));
        }
    }

    /// The quantities that spectra are of, in the order of the file, each a part of it.
    fn parts(&self) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        for spectrum in &self.spectra {
            let name = spectrum.label.to_lowercase();
            let rows = spectrum.samples.len();
            let line = spectrum.samples.first().map_or(1, |sample| sample.line);
            if let Some(part) = parts.iter_mut().find(|part| part.name == name) {
                (part.curves, part.rows) = (part.curves + 1, part.rows + rows);
            } else if parts.len() < MAX_PARTS {
                parts.push(Part { line, name, curves: 1, rows });
            }
        }
        parts
    }

    /// Leaves the spectra of one quantity, the first if none was chosen, and returns it.
    fn take_part(
        &mut self,
        parts: &[Part],
        chosen: Option<usize>,
        log: &mut Log<'_>,
    ) -> Result<Option<Decided<Quantity>>, ReadError> {
        if parts.is_empty() {
            return Ok(None);
        }
        let part = chosen.unwrap_or(1);
        let wanted = part.checked_sub(1).and_then(|at| parts.get(at));
        let wanted = wanted.ok_or(ReadError::NoSuchPart { part, parts: parts.len() })?;
        if let Some(other) = parts.get(1).filter(|_| chosen.is_none()) {
            log.push(Warning::MoreTables(other.line));
        }
        let is_wanted = |spectrum: &Spectrum| spectrum.label.to_lowercase() == wanted.name;
        let first = self.spectra.iter().position(is_wanted).unwrap_or(0);
        self.spectra.retain(is_wanted);
        Ok(std::mem::take(&mut self.quantities).into_iter().nth(first).flatten())
    }

    fn sample(&mut self, element: &Element<'_>, log: &mut Log<'_>) -> Result<(), ReadError> {
        let Some(spectrum) = &mut self.current else { return Ok(()) };
        let line = element.line;
        let missing = || ReadError::NotANumber { line, column: 1, text: String::new() };
        let wavelength = element.number_attribute("wavelength")?.ok_or_else(missing)?;
        let value = element.number()?;
        if !wavelength.is_nan() && !value.is_nan() {
            let place = element.pair("wavelength", log);
            spectrum.samples.push(Sample { wavelength, value, line, place });
        }
        Ok(())
    }
}

/// A quantity of the standard's list, if it is only one thing.
fn named(quantity: &str) -> Option<Quantity> {
    const AS_EVERYWHERE: &str =
        "irradiance|exitance|radiance|reflectance|r-factor|transmittance|t-factor|absorptance|relative";
    match quantity.to_ascii_lowercase().as_str() {
        "flux" => Some(Quantity::RadiantFlux),
        "intensity" => Some(Quantity::RadiantIntensity),
        other => header_terms::quantity(other).filter(|_| is_one(other, AS_EVERYWHERE)),
    }
}
