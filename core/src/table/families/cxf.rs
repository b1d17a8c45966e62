//! `CxF3`: spectra of named objects in XML, as lists of values or as single points.

use roxmltree::Node;

use super::super::header::Header;
use super::super::reading::clean;
use super::super::sniff::Layout;
use super::super::{
    Decided, DecimalMark, Delimiter, MAX_SAMPLES, Orientation, ReadError, Reader, Warning, WavelengthUnit,
};
use super::Found;
use super::spectra::{self, Sample, Spectrum};
use super::xml::{self, LineIndex, content, elements};

/// Reads the spectra of all objects of a document.
pub(super) fn read(text: &str, warnings: &mut Vec<Warning>) -> Result<Found, ReadError> {
    let document = xml::parse(text)?;
    let lines = LineIndex::new(text);
    let root = document.root_element();
    let mut header = Header::default();
    for entry in elements(root, "FileInformation").flat_map(|node| node.children()).filter(Node::is_element) {
        header.note(entry.tag_name().name(), content(entry));
    }
    let grids = grids(root, &lines)?;
    let mut all = Vec::new();
    let mut total = 0;
    for object in elements(root, "Object") {
        for node in object.descendants().filter(is_spectrum) {
            let mut spectrum = spectrum(node, &grids, &lines)?;
            spectrum.name = object.attribute("Name").or(object.attribute("Id")).map(str::to_owned);
            total += spectrum.samples.len();
            if total > MAX_SAMPLES {
                return Err(ReadError::TooManySamples { line: lines.line(node) });
            }
            all.push(spectrum);
        }
    }
    let first_line = all.iter().find_map(|spectrum: &Spectrum| spectrum.samples.first()).map(|sample| sample.line);
    let first_line = first_line.ok_or(ReadError::NoNumbers)?;
    let mut grid = spectra::grid(all, header, warnings)?;
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "CxF prescribes it"));
    let dialect = (Delimiter::Elements, DecimalMark::Point);
    let layout = Layout::fixed(dialect, Orientation::Down, first_line, "CxF prescribes it");
    let reader = Decided::certain(Reader::Cxf, "The root element is “CxF”");
    Ok(Found { grid, layout, reader, notes: Vec::new() })
}

fn is_spectrum(node: &Node) -> bool {
    node.is_element() && node.tag_name().name().ends_with("Spectrum")
}

/// Where the values of a list begin and how far apart they are.
struct Range<'a> {
    id: &'a str,
    start: Option<f64>,
    step: Option<f64>,
}

/// The ranges of wavelengths that the color specifications declare.
fn grids<'a>(root: Node<'a, '_>, lines: &LineIndex) -> Result<Vec<Range<'a>>, ReadError> {
    let mut all = Vec::new();
    for specification in elements(root, "ColorSpecification") {
        let (Some(id), Some(range)) =
            (specification.attribute("Id"), elements(specification, "WavelengthRange").next())
        else {
            continue;
        };
        all.push(Range { id, start: attribute(range, "StartWL", lines)?, step: attribute(range, "Increment", lines)? });
    }
    Ok(all)
}

fn attribute(node: Node, name: &str, lines: &LineIndex) -> Result<Option<f64>, ReadError> {
    node.attribute(name).map(|text| xml::number(text, lines.line(node))).transpose()
}

fn spectrum(node: Node, grids: &[Range], lines: &LineIndex) -> Result<Spectrum, ReadError> {
    let kind = node.tag_name().name().trim_end_matches("Spectrum");
    let label = if kind == "Emissive" { "Emission" } else { kind.trim_start_matches("Custom") }.to_owned();
    let mut samples = Vec::new();
    for point in elements(node, "SpectralPoint") {
        let line = lines.line(point);
        let wavelength = attribute(point, "WL", lines)?.unwrap_or(f64::NAN);
        push(&mut samples, wavelength, xml::number(content(point), line)?, line);
    }
    let list = content(node);
    if samples.is_empty() && !list.is_empty() {
        let line = lines.line(node);
        let declared = node.attribute("ColorSpecification").and_then(|id| grids.iter().find(|range| range.id == id));
        let start = attribute(node, "StartWL", lines)?.or(declared.and_then(|range| range.start));
        let step = attribute(node, "Increment", lines)?.or(declared.and_then(|range| range.step));
        let (Some(start), Some(step)) = (start, step) else {
            return Err(ReadError::NoWavelengths { line });
        };
        for (index, value) in list.split_ascii_whitespace().enumerate() {
            push(&mut samples, clean(start + step * index as f64), xml::number(value, line)?, line);
        }
    }
    Ok(Spectrum { name: None, label, samples })
}

fn push(samples: &mut Vec<Sample>, wavelength: f64, value: f64, line: usize) {
    if wavelength.is_finite() && value.is_finite() {
        samples.push(Sample { wavelength, value, line });
    }
}
