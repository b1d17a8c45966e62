//! IES TM-27: spectra of light sources in XML, one element for each sample.

use roxmltree::Node;

use super::super::header::Header;
use super::super::sniff::Layout;
use super::super::{Decided, DecimalMark, Delimiter, Orientation, ReadError, Reader, Role, Warning, WavelengthUnit};
use super::Found;
use super::spectra::{self, Sample, Spectrum};
use super::xml::{self, LineIndex, content, elements};

/// Reads all spectra of a document. Only local names are compared: the namespace differs between editions.
pub(super) fn read(text: &str, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
    let document = xml::parse(text)?;
    let lines = LineIndex::new(text);
    let root = document.root_element();
    let mut header = header(root);
    let mut all = Vec::new();
    for distribution in elements(root, "SpectralDistribution") {
        let spectrum = spectrum(distribution, &lines, &mut header)?;
        if !spectrum.samples.is_empty() {
            all.push(spectrum);
        }
    }
    let first_line = all.first().and_then(|spectrum| spectrum.samples.first()).map(|sample| sample.line);
    let first_line = first_line.ok_or(ReadError::NoNumbers)?;
    let mut grid = spectra::grid(all, header, warnings)?;
    // Most such files are of lamps, but "relative" and "other" do not say so.
    grid.role = Some(Decided::guess(Role::Illuminant, "TM-27 is mostly used for lamps"));
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "TM-27 prescribes it"));
    let dialect = (Delimiter::Elements, DecimalMark::Point);
    let layout = Layout::fixed(dialect, Orientation::Down, first_line, "TM-27 prescribes it");
    let why = format!("The root element is “{}”", root.tag_name().name());
    Ok(Found { grid, layout, reader: Decided::certain(Reader::Tm27, why), notes: Vec::new() })
}

/// The entries of the document's header as comments, with the description as title.
fn header(root: Node) -> Header {
    let mut header = Header::default();
    let entries = elements(root, "Header").flat_map(|node| node.children()).filter(Node::is_element);
    for entry in entries {
        header.note(entry.tag_name().name(), content(entry));
    }
    if let Some(description) = header.comment("Description").map(str::to_owned) {
        header.note("title", &description);
    }
    header
}

fn spectrum(node: Node, lines: &LineIndex, header: &mut Header) -> Result<Spectrum, ReadError> {
    let quantity = elements(node, "SpectralQuantity").next();
    if let Some(quantity) = quantity {
        let line = lines.line(quantity);
        header.note("quantity", content(quantity));
        header.role = header.role.or_else(|| role(content(quantity)).map(|role| (line, role)));
    }
    let mut samples = Vec::new();
    for data in elements(node, "SpectralData") {
        let line = lines.line(data);
        let written = data.attribute("wavelength").ok_or_else(|| ReadError::NotANumber {
            line,
            column: 1,
            text: String::new(),
        })?;
        let (wavelength, value) = (xml::number(written, line)?, xml::number(content(data), line)?);
        if !wavelength.is_nan() && !value.is_nan() {
            samples.push(Sample { wavelength, value, line });
        }
    }
    Ok(Spectrum { name: None, label: quantity.map(content).unwrap_or_default().to_owned(), samples })
}

/// What a quantity of the standard's list is, if it is only one thing.
fn role(quantity: &str) -> Option<Role> {
    match quantity.to_ascii_lowercase().as_str() {
        "flux" | "intensity" | "irradiance" | "radiance" | "exitance" => Some(Role::Illuminant),
        "reflectance" | "transmittance" | "absorptance" | "r-factor" | "t-factor" => Some(Role::Reflectance),
        _ => None,
    }
}
