//! JSON as rawtoaces, dcamprof and Wasatch ENLIGHTEN write it, and any other of wavelengths and values, with or without comments.

mod document;
mod walk;

use crate::decimal;
use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Family, Part, Reader, Role, Values, WavelengthUnit};
use crate::error::{MAX_PARTS, ReadError};
use crate::formats::Format;
use crate::formats::json::document::{Members, Value, without_comments};
use crate::formats::json::walk::{Around, Walk};
use crate::formats::spectra::{self, Found};
use crate::grid::Grid;
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::excerpt;
use crate::watch::Log;
use crate::{header_terms, no_curve, unit_text};

impl Reader {
    /// JSON of rawtoaces.
    pub const RAWTOACES: Self = Self::new("rawtoaces", "rawtoaces JSON", "rawtoaces");
    /// JSON of dcamprof, with or without comments.
    pub const DCAMPROF: Self = Self::new("dcamprof", "dcamprof JSON", "dcamprof");
    /// JSON of Wasatch ENLIGHTEN.
    pub const ENLIGHTEN: Self = Self::new("enlighten", "Wasatch ENLIGHTEN JSON", "Wasatch ENLIGHTEN");
    /// JSON of wavelengths and values, of any layout.
    pub const JSON: Self = Self::new("json", "JSON of wavelengths and values", "JSON");
}

pub(super) const RAWTOACES: Format = Format { reader: Reader::RAWTOACES, fits: |head| head.is(Family::Json), read };
pub(super) const DCAMPROF: Format = Format { reader: Reader::DCAMPROF, ..RAWTOACES };
pub(super) const ENLIGHTEN: Format = Format { reader: Reader::ENLIGHTEN, ..RAWTOACES };
pub(super) const JSON: Format = Format { reader: Reader::JSON, ..RAWTOACES };

/// The fewest bytes for each quotation mark in a file of spectra.
const FEWEST_BYTES: usize = 4;

/// Content of a layout: its curves, and the decisions that only it needs.
type Content = (Grid, Decided<Reader>, Vec<Decision>);

fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    // Every list and every text has a name of its own; hostile text, which has nothing else, would need many times its size.
    if text.bytes().filter(|byte| *byte == b'"').count() > text.len() / FEWEST_BYTES + 1000 {
        return Err(ReadError::Unsupported(Family::Json));
    }
    let bare = without_comments(text, log)?;
    log.look(0)?;
    let whole = Value::whole(&bare);
    let members = if whole.written.starts_with('[') { Members::none(whole) } else { whole.members()? };
    let document = Document { text, whole, members, options };
    let (mut grid, reader, notes) = document.layout(log).map_err(|error| match error {
        ReadError::WrongCount { name, found, expected, .. } => {
            ReadError::WrongCount { line: document.line(&name), name, found, expected }
        }
        other => other,
    })?;
    if reader.value != Reader::JSON {
        grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "The layout prescribes it"));
    }
    // Each wavelength has one value for every curve.
    grid.rows = grid.wavelengths.len();
    let unit = grid.header.unit.clone();
    for curve in &mut grid.curves {
        curve.unit = unit_text::unit(&curve.label).or_else(|| unit.clone());
    }
    let first_line =
        ["data", "ssf_bands", "bands", "processed"].iter().find_map(|name| document.line_of(name)).unwrap_or(1);
    let dialect = (Delimiter::Comma, DecimalMark::Point);
    Ok(Found::fixed(grid, reader, (dialect, first_line, "JSON prescribes it"), notes))
}

/// A document, and what is asked of it.
struct Document<'a> {
    text: &'a str,
    whole: Value<'a>,
    members: Members<'a>,
    options: &'a ReadOptions,
}

impl<'a> Document<'a> {
    fn layout(&self, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let curves = self.members.get("spectrum").filter(|spectrum| spectrum.written.starts_with('{'));
        if let Some(data) = self
            .members
            .get("spectral_data")
            .and_then(|data| data.members().ok())
            .filter(|data| data.get("data").is_some())
        {
            self.aces(&data, log)
        } else if let Some(curves) = curves.filter(|_| self.members.get("spectrometerSettings").is_some()) {
            self.enlighten(curves, log)
        } else {
            self.any(log)
        }
    }

    /// The line in which a name stands between quotes, if it does.
    fn line_of(&self, name: &str) -> Option<usize> {
        let at = self.text.find(&format!("\"{name}\""))?;
        Some(1 + self.text[..at].bytes().filter(|byte| *byte == b'\n').count())
    }

    fn line(&self, name: &str) -> usize {
        self.line_of(name).unwrap_or(1)
    }

    /// Evidence: the line that has a member of this name.
    fn says(&self, name: &str) -> String {
        let line = self.line_of(name);
        line.map_or_else(|| format!("The document has “{name}”"), |line| format!("Line {line} has “{name}”"))
    }

    /// Stores the remarks on the values, in the words of this program's own files.
    fn note_remarks<'r>(&self, header: &mut Header, remarks: impl Iterator<Item = &'r str>) {
        for (key, value) in remarks.filter_map(|remark| remark.split_once(": ")) {
            if matches!(key, "quantity" | "unit" | "response") {
                header.take_comment(self.line("comments"), key, value);
            }
        }
    }

    /// Wavelengths are the keys of one object, each with a value for every name of the index.
    fn aces(&self, data: &Members<'a>, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let mut walk = Walk::new(self, log);
        let mut around = Around { alone: true, ..Around::default() };
        walk.hear(&self.members, &mut around);
        let (mut header, mut notes) = (std::mem::take(&mut walk.header), Vec::new());
        if let Some(remarks) = header.comment("comments").map(str::to_owned) {
            self.note_remarks(&mut header, remarks.split("; "));
        }
        self.title(&mut header, &mut notes);
        if let Some(units) = data.read::<String>("units")?.filter(|units| !units.is_empty()) {
            let line = self.line("units");
            header.note(0, "unit", &units);
            header.unit = unit_text::unit_cell(&units);
            header.values = header_terms::values(&units).map(|values| (line, values));
            header.quantity = header_terms::quantity(&units).map(|quantity| (line, quantity));
            notes.push(Decision::certain("Unit", units, self.says("units")));
        }
        let groups = data.members("data")?.ok_or(ReadError::Unsupported(Family::Json))?;
        let parts: Vec<Part> = groups.each().take(MAX_PARTS).map(|(name, group)| self.part(name, group)).collect();
        let first = groups.each().position(|(name, _)| *name == "main").map_or(1, |index| index + 1);
        let part = self.options.part.unwrap_or(first);
        let group = part.checked_sub(1).and_then(|at| groups.each().nth(at));
        let (name, group) = group.ok_or(match parts.len() {
            0 => ReadError::NoNumbers,
            parts => ReadError::NoSuchPart { part, parts },
        })?;
        let index = data.members("index")?;
        // Another name than the group's is better than none.
        let named =
            index.as_ref().and_then(|index| index.get(name).or_else(|| index.each().next().map(|(_, names)| names)));
        let names: Vec<String> = named.map(Value::read).transpose()?.unwrap_or_default();
        let title = header.comment("title").unwrap_or_default().to_owned();
        let group = group.members()?;
        (around.name, around.columns) = (title, names.clone().into());
        let read = walk.keyed(&group, &around, true)?;
        if let Some(text) = walk.left.pop().or_else(|| Some(excerpt(group.each().next()?.0)).filter(|_| !read)) {
            return Err(ReadError::NotANumber { line: 1, column: 1, text });
        }
        let spectra = std::mem::take(&mut walk.spectra);
        let mut grid = spectra::grid(spectra, header, log)?;
        if names == ["power"] {
            grid.role = Some(Decided::certain(Role::Illuminant, format!("{} as its only value", self.says("power"))));
        } else if names == ["R", "G", "B"] {
            grid.role = Some(Decided::certain(Role::Camera, "By channels, rawtoaces holds sensitivities of cameras"));
        }
        let part = Decided::certain(part, format!("{} groups of data, of which “main” comes first", parts.len()));
        (grid.parts, grid.part) = (parts, Some(part));
        Ok((grid, Decided::certain(Reader::RAWTOACES, self.says("spectral_data")), notes))
    }

    fn part(&self, name: &str, group: Value<'a>) -> Part {
        let rows = group.members().ok();
        let first = rows.as_ref().and_then(|rows| rows.each().next());
        let curves = first.map_or(0, |(_, values)| values.pieces().count());
        let rows = rows.as_ref().map_or(0, |rows| rows.each().len());
        Part { line: self.line(name), name: name.to_owned(), curves, rows }
    }

    /// The name of what was measured: a camera's maker and model, a light's type, else its description.
    fn title(&self, header: &mut Header, notes: &mut Vec<Decision>) {
        let (what, key, title) = match (header.comment("manufacturer"), header.comment("model")) {
            (Some(maker), Some(model)) => ("Camera", "model", format!("{maker} {model}")),
            (None, Some(model)) => ("Camera", "model", model.to_owned()),
            _ => match (header.comment("type"), header.comment("description")) {
                (Some(kind), _) => ("Name", "type", kind.to_owned()),
                (None, Some(description)) => ("Name", "description", description.to_owned()),
                (None, None) => return,
            },
        };
        notes.push(Decision::certain(what, title.clone(), self.says(key)));
        header.note(0, "title", &title);
    }

    /// Wavelengths and values wherever they stand, and what only dcamprof writes beside them.
    fn any(&self, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let mut walk = Walk::new(self, log);
        walk.take(self.whole, Around { alone: true, ..Around::default() })?;
        let Walk { mut spectra, mut header, mut notes, evidence, .. } = walk;
        let some = spectra.iter().any(|spectrum| spectrum.samples.len() > 1);
        let (key, named) = evidence.filter(|_| some).ok_or(ReadError::Unsupported(Family::Json))?;
        let camera = key == "ssf_bands";
        let light = key == "bands" && self.members.get("spectrum").is_some();
        if !camera && !light {
            let reader = if named {
                Decided::certain(Reader::JSON, self.says(&key))
            } else {
                Decided::guess(Reader::JSON, format!("Numbers such as {key} go with others as wavelengths do"))
            };
            return Ok((spectra::grid(spectra, header, log)?, reader, notes));
        }
        let comments = self.members.get("comments").map_or_else(Vec::new, Value::texts);
        self.note_remarks(&mut header, comments.iter().map(String::as_str));
        if let Some(name) = self.members.read::<String>("camera_name")? {
            notes.push(Decision::certain("Camera", &name, self.says("camera_name")));
            header.note(0, "title", &name);
        }
        for spectrum in &mut spectra {
            let channel = [("red_ssf", "R"), ("green_ssf", "G"), ("blue_ssf", "B")];
            let short = channel.iter().find(|(long, _)| *long == spectrum.label).filter(|_| camera);
            spectrum.label = short.map_or_else(String::new, |(_, short)| (*short).to_owned());
            spectrum.name = short.map(|(_, short)| (*short).to_owned()).or(spectrum.name.take());
        }
        if let Some(scale) = self.members.read::<f64>("scale")?.filter(|scale| *scale > 0.0 && *scale != 1.0) {
            let samples = spectra.iter_mut().flat_map(|spectrum| &mut spectrum.samples);
            samples.for_each(|sample| sample.value = decimal::divided(sample.value, scale));
            notes.push(Decision::certain("Scale", format!("divided by {scale}"), self.says("scale")));
        }
        let mut grid = spectra::grid(spectra, header, log)?;
        grid.role = camera.then(|| Decided::certain(Role::Camera, self.says("red_ssf")));
        Ok((grid, Decided::certain(Reader::DCAMPROF, self.says(&key)), notes))
    }

    /// A measurement of Wasatch ENLIGHTEN: curves by name, wavelengths among them or among the settings of the spectrometer. The
    /// processed curve is read, or all of them where raw ones are requested.
    fn enlighten(&self, spectrum: Value<'a>, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let mut walk = Walk::new(self, log);
        let mut around = Around { alone: true, ..Around::default() };
        walk.hear(&self.members, &mut around);
        let settings = self.members.members("spectrometerSettings")?;
        if let Some(list) = settings.and_then(|settings| settings.get("wavelengths")) {
            around.wavelengths = walk.axis("wavelengths", list)?.unwrap_or_default().into();
        }
        walk.take(spectrum, around)?;
        let Walk { spectra, mut header, mut notes, .. } = walk;
        if spectra.is_empty() {
            return Err(ReadError::NoWavelengths(self.line("spectrum")));
        }
        let label = header.comment("Label").unwrap_or_default().to_owned();
        header.note(0, "title", &label);
        let role = self.technique(&mut header);
        let mut grid = Grid { role, ..spectra::grid(spectra, header, log)? };
        notes.extend(no_curve::leave_out_raw(&mut grid, self.options));
        if let [only] = grid.curves.as_mut_slice()
            && !label.is_empty()
        {
            only.name = label;
        }
        Ok((grid, Decided::certain(Reader::ENLIGHTEN, self.says("spectrometerSettings")), notes))
    }

    fn technique(&self, header: &mut Header) -> Option<Decided<Role>> {
        let technique = header.comment("Technique")?.to_owned();
        let line = self.line("Technique");
        let why = format!("Line {line} says {technique}");
        match technique.to_lowercase().as_str() {
            "absorbance" => {
                header.values = Some((line, Values::Absorbance));
                Some(Decided::guess(Role::Transmittance, why))
            }
            "scope" | "raman" | "fluorescence" => Some(Decided::certain(Role::Unknown, why)),
            other => header_terms::role(other).map(|role| Decided::certain(role, why)),
        }
    }
}
