//! JSON as rawtoaces, dcamprof and Wasatch ENLIGHTEN write it, with or without comments.

mod document;

use crate::decimal::{self, clean};
use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Family, Part, Reader, Role, Values, WavelengthUnit};
use crate::error::{MAX_PARTS, MAX_SAMPLES, ReadError, check_curves, check_samples};
use crate::formats::Format;
use crate::formats::json::document::{Members, Value, without_comments};
use crate::formats::spectra::{self, Found, Sample, Spectrum};
use crate::grid::{Grid, RawCurve};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::excerpt;
use crate::watch::{Log, PlaceId, PlaceKind, Places};
use crate::{header_terms, unit_text};

impl Reader {
    /// JSON of rawtoaces.
    pub const RAWTOACES: Self = Self::new("rawtoaces", "rawtoaces JSON", "rawtoaces");
    /// JSON of dcamprof, with or without comments.
    pub const DCAMPROF: Self = Self::new("dcamprof", "dcamprof JSON", "dcamprof");
    /// JSON of Wasatch ENLIGHTEN.
    pub const ENLIGHTEN: Self = Self::new("enlighten", "Wasatch ENLIGHTEN JSON", "Wasatch ENLIGHTEN");
}

pub(super) const RAWTOACES: Format = Format { reader: Reader::RAWTOACES, fits: |head| head.is(Family::Json), read };
pub(super) const DCAMPROF: Format = Format { reader: Reader::DCAMPROF, ..RAWTOACES };
pub(super) const ENLIGHTEN: Format = Format { reader: Reader::ENLIGHTEN, ..RAWTOACES };

/// The fewest bytes for each quotation mark in a file of spectra.
const FEWEST_BYTES: usize = 5;

/// Content of a layout: its curves, and the decisions that only it needs.
type Content = (Grid, Decided<Reader>, Vec<Decision>);

fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    // Every list and every text has a name of its own; hostile text, which has nothing else, would need many times its size.
    if text.bytes().filter(|byte| *byte == b'"').count() > text.len() / FEWEST_BYTES + 1000 {
        return Err(ReadError::Unsupported(Family::Json));
    }
    let bare = without_comments(text, log)?;
    log.look(0)?;
    let document = Document { text, members: Value::whole(&bare).members()?, options };
    let (mut grid, reader, notes) = document.layout(log).map_err(|error| match error {
        ReadError::WrongCount { name, found, expected, .. } => {
            ReadError::WrongCount { line: document.line(&name), name, found, expected }
        }
        other => other,
    })?;
    if log.places.is_some() {
        note_lines(text, &mut grid.header);
    }
    grid.unit = Some(Decided::certain(WavelengthUnit::Nanometer, "The layout prescribes it"));
    // Each wavelength has one value for every curve.
    grid.rows = grid.wavelengths.len();
    let unit = grid.header.unit.clone();
    grid.curves.iter_mut().for_each(|curve| curve.unit.clone_from(&unit));
    let first_line =
        ["data", "ssf_bands", "bands", "processed"].iter().find_map(|name| document.line_of(name)).unwrap_or(1);
    let dialect = (Delimiter::Comma, DecimalMark::Point);
    Ok(Found::fixed(grid, reader, (dialect, first_line, "JSON prescribes it"), notes))
}

/// A document, and what is asked of it.
struct Document<'a> {
    text: &'a str,
    members: Members<'a>,
    options: &'a ReadOptions,
}

impl Document<'_> {
    fn layout(&self, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let members = &self.members;
        let spectrum = members.get("spectrum");
        let lists = ["ssf_bands", "red_ssf", "green_ssf", "blue_ssf"].map(|name| members.get(name));
        if let Some(data) = members.get("spectral_data") {
            self.aces(data, log)
        } else if let [Some(bands), Some(r), Some(g), Some(b)] = lists {
            self.camera(bands, [r, g, b], log)
        } else if let Some(curves) = spectrum.filter(|spectrum| spectrum.written.starts_with('{')) {
            self.enlighten(&curves.members()?, log)
        } else if let (Some(bands), Some(values)) = (members.get("bands"), spectrum) {
            self.light(bands, values, log)
        } else {
            Err(ReadError::Unsupported(Family::Json))
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
    fn aces(&self, aces: Value<'_>, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let data = aces.members()?;
        let (mut header, mut notes) = (Header::default(), Vec::new());
        if let Some(comments) = self.members.members("header")? {
            comments.texts().for_each(|(key, value)| header.note(0, key, &value));
            if let Some((_, remarks)) = comments.texts().find(|(key, _)| *key == "comments") {
                self.note_remarks(&mut header, remarks.split("; "));
            }
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
        let groups = data.members("data")?.ok_or_else(|| aces.lacks_member())?;
        let mut all = Vec::with_capacity(groups.each().len());
        for (name, group) in groups.each() {
            all.push((name, group, Rows::of(group, log)?));
        }
        let list = all.iter().take(MAX_PARTS).map(|(name, _, rows)| Part {
            line: self.line(name),
            name: name.to_string(),
            curves: rows.width,
            rows: rows.wavelengths.len(),
        });
        let parts: Vec<Part> = list.collect();
        let first = all.iter().position(|(name, ..)| *name == "main").map_or(1, |index| index + 1);
        let part = self.options.part.unwrap_or(first);
        let group = part.checked_sub(1).and_then(|at| all.into_iter().nth(at));
        let (name, group, rows) = group.ok_or(match parts.len() {
            0 => ReadError::NoNumbers,
            parts => ReadError::NoSuchPart { part, parts },
        })?;
        if let Some(places) = &mut log.places {
            record_rows(&group.members()?, group, places);
        }
        let names: Vec<String> = match data.members("index")? {
            // Another name than the group's is better than none.
            Some(index) => {
                let named = index.get(name).or_else(|| index.each().next().map(|(_, names)| names));
                named.map(Value::read).transpose()?.unwrap_or_default()
            }
            None => Vec::new(),
        };
        let mut grid = rows.grid(&names, header, log)?;
        if names == ["power"] {
            grid.role = Some(Decided::certain(Role::Illuminant, format!("{} as its only value", self.says("power"))));
        } else if names == ["R", "G", "B"] {
            grid.role = Some(Decided::certain(Role::Camera, "By channels, rawtoaces holds sensitivities of cameras"));
        }
        let part = Decided::certain(part, format!("{} groups of data, of which “main” comes first", parts.len()));
        (grid.parts, grid.part) = (parts, Some(part));
        Ok((grid, Decided::certain(Reader::RAWTOACES, self.says("spectral_data")), notes))
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

    fn camera(&self, bands: Value<'_>, lists: [Value<'_>; 3], log: &mut Log<'_>) -> Result<Content, ReadError> {
        let (wavelengths, note) = self.wavelengths(&bands.numbers(false, log)?, "ssf_bands")?;
        let mut header = Header::default();
        let mut notes = vec![note];
        let name = self.members.read::<String>("camera_name")?;
        if let Some(name) = &name {
            notes.push(Decision::certain("Camera", name, self.says("camera_name")));
        }
        header.note(0, "title", &name.unwrap_or_default());
        self.note_remarks(&mut header, self.comments().iter().map(String::as_str));
        let mut all = Vec::with_capacity(3);
        for (list, (short, long)) in lists.iter().zip([("R", "red_ssf"), ("G", "green_ssf"), ("B", "blue_ssf")]) {
            let spectrum = on(&wavelengths, &list.numbers(false, log)?, long)?;
            all.push(Spectrum { name: Some(short.to_owned()), label: short.to_owned(), ..spectrum });
        }
        record_lists(bands, &lists, log);
        let mut grid = spectra::grid(all, header, log)?;
        grid.role = Some(Decided::certain(Role::Camera, self.says("red_ssf")));
        Ok((grid, Decided::certain(Reader::DCAMPROF, self.says("ssf_bands")), notes))
    }

    fn comments(&self) -> Vec<String> {
        self.members.get("comments").map_or_else(Vec::new, Value::texts)
    }

    fn light(&self, bands: Value<'_>, list: Value<'_>, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let (wavelengths, note) = self.wavelengths(&bands.numbers(false, log)?, "bands")?;
        let mut values = list.numbers(false, log)?;
        let mut header = Header::default();
        self.note_remarks(&mut header, self.comments().iter().map(String::as_str));
        let mut notes = vec![note];
        if let Some(scale) = self.members.read::<f64>("scale")?.filter(|scale| *scale > 0.0 && *scale != 1.0) {
            for value in &mut values {
                *value = decimal::divided(*value, scale);
            }
            notes.push(Decision::certain("Scale", format!("divided by {scale}"), self.says("scale")));
        }
        let spectrum = on(&wavelengths, &values, "spectrum")?;
        let names = self.members.get("name").map_or_else(Vec::new, Value::texts);
        header.note(0, "title", names.first().map_or("", String::as_str));
        record_lists(bands, &[list], log);
        let grid = spectra::grid(vec![spectrum], header, log)?;
        Ok((grid, Decided::certain(Reader::DCAMPROF, self.says("spectrum")), notes))
    }

    /// Three numbers are the ends of a range and its step, unless the third goes on from the second.
    fn wavelengths(&self, bands: &[f64], key: &str) -> Result<(Vec<f64>, Decision), ReadError> {
        let said = self.says(key);
        let (grid, value, why) = match *bands {
            [first, last, step] if step <= last && step > 0.0 => (
                range(bands).ok_or(ReadError::NoWavelengths(1))?,
                format!("{first} to {last} nm in steps of {step}"),
                format!("{said}, and three numbers are a range"),
            ),
            _ => (bands.to_vec(), format!("{} wavelengths", bands.len()), said),
        };
        Ok((grid, Decision::certain("Grid", value, why)))
    }

    /// A measurement of Wasatch ENLIGHTEN: curves by name, wavelengths among them or among the settings of the spectrometer. The
    /// processed curve is read, or all of them where raw ones are requested.
    fn enlighten(&self, spectrum: &Members<'_>, log: &mut Log<'_>) -> Result<Content, ReadError> {
        let mut curves: Vec<(String, Vec<f64>)> = Vec::new();
        for (name, list) in spectrum.each().filter(|(_, list)| list.written != "null") {
            curves.push((name.to_string(), list.numbers(true, log)?));
        }
        let at = curves.iter().position(|(name, _)| name.to_lowercase().starts_with("wavelength"));
        let settings = self.members.members("spectrometerSettings")?;
        let wavelengths = match (at, settings.and_then(|settings| settings.get("wavelengths"))) {
            (Some(at), _) => curves.remove(at).1,
            (None, Some(list)) => list.numbers(false, log)?,
            (None, None) => Vec::new(),
        };
        if wavelengths.is_empty() {
            return Err(ReadError::NoWavelengths(self.line("spectrum")));
        }
        let mut header = Header::default();
        if let Some(metadata) = self.members.members("metadata")? {
            metadata.texts().for_each(|(key, value)| header.note(0, key, &value));
        }
        let mut notes = vec![Decision::certain("Program", "a file of Wasatch ENLIGHTEN", self.says("spectrum"))];
        let label = header.comment("Label").map(str::to_owned);
        header.note(0, "title", label.as_deref().unwrap_or_default());
        let role = self.technique(&mut header);
        let processed = curves.iter().position(|(name, _)| name.eq_ignore_ascii_case("processed"));
        if let Some(processed) = processed.filter(|_| self.options.raw != Some(true)) {
            let left: Vec<String> = curves.iter().map(|(name, _)| format!("“{name}”")).collect();
            let left: Vec<String> = left.into_iter().filter(|name| name != "“processed”").collect();
            curves = vec![curves.swap_remove(processed)];
            if !left.is_empty() {
                let why = format!("{} are raw counts", left.join(", "));
                let decided = Decided::or_chosen(self.options.raw.map(|_| "“processed”"), || {
                    Decided::certain("“processed”", why)
                });
                notes.push(Decision::new("Columns", &decided));
            }
        }
        let label = label.filter(|_| curves.len() == 1);
        let named = |(name, values): (String, Vec<f64>)| {
            let spectrum = on(&wavelengths, &values, &name)?;
            Ok(Spectrum { name: Some(label.clone().unwrap_or(name)), ..spectrum })
        };
        let all: Result<Vec<Spectrum>, ReadError> = curves.into_iter().map(named).collect();
        let grid = Grid { role, ..spectra::grid(all?, header, log)? };
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

/// Lines of a header's members, each sought behind the one before.
fn note_lines(text: &str, header: &mut Header) {
    let (mut from, mut line) = (0, 1);
    for ((key, _), noted) in header.comments.iter().zip(&mut header.noted) {
        let Some(at) = text[from..].find(&format!("\"{key}\"")) else { continue };
        line += text[from..from + at].bytes().filter(|byte| *byte == b'\n').count();
        from += at;
        *noted = line as u32;
    }
}

#[derive(Debug, Default)]
struct Rows {
    wavelengths: Vec<f64>,
    /// The values of one wavelength after those of the other, NaN for a gap.
    values: Vec<f64>,
    /// Number of values at the first wavelength.
    width: usize,
    /// Error of the first row that does not go with the others.
    fault: Option<ReadError>,
}

impl Rows {
    fn of(group: Value<'_>, log: &Log<'_>) -> Result<Self, ReadError> {
        let mut rows = Self::default();
        for (key, values) in group.members()?.each() {
            let before = rows.values.len();
            rows.values.extend(values.numbers(true, log)?);
            rows.take(key, before);
        }
        Ok(rows)
    }

    fn take(&mut self, key: &str, before: usize) {
        let found = self.values.len() - before;
        self.width = if self.wavelengths.is_empty() { found } else { self.width };
        let fault = match key.trim().parse().ok().filter(|value: &f64| value.is_finite()) {
            Some(wavelength) => {
                self.wavelengths.push(wavelength);
                let (name, expected) = (wavelength.to_string(), self.width);
                (found != expected).then_some(ReadError::WrongCount { line: 1, name, found, expected })
            }
            None => Some(ReadError::NotANumber { line: 1, column: 1, text: excerpt(key) }),
        };
        // A row that matches no other is discarded, so that all have the same width.
        if fault.is_some() {
            self.values.truncate(before);
            self.wavelengths.truncate(before / self.width.max(1));
        }
        self.fault = self.fault.take().or(fault);
    }

    /// Rows as their grid; wavelengths at which no curve has a value are omitted.
    fn grid(self, names: &[String], header: Header, log: &Log<'_>) -> Result<Grid, ReadError> {
        let Self { wavelengths, values, width, fault } = self;
        fault.map_or(Ok(()), Err)?;
        check_curves(width, 1)?;
        check_samples(values.len(), 1)?;
        let gaps: Vec<bool> = values.chunks(width.max(1)).map(|row| row.iter().all(|value| value.is_nan())).collect();
        let single = width == 1;
        let title = header.comment("title").filter(|_| single).map(str::to_owned);
        let mut curves = Vec::with_capacity(width);
        let mut all = Some(values);
        for column in 0..width {
            log.look(usize::MAX)?;
            let values = match all.as_deref() {
                Some(values) if !single => values.iter().skip(column).step_by(width).copied().collect(),
                _ => all.take().unwrap_or_default(),
            };
            // A single curve is named by the title, which is more specific than "power".
            let given = names.get(column).filter(|_| !single).cloned().or_else(|| title.clone());
            let name = given.clone().unwrap_or_else(|| format!("Spectrum {}", column + 1));
            let label = names.get(column).cloned().unwrap_or_default();
            curves.push(RawCurve {
                name,
                named: given.is_some(),
                label,
                values,
                origin: column,
                ..RawCurve::default()
            });
        }
        drop(all);
        let mut grid = Grid { wavelengths, lines: vec![1], curves, header, own_wavelengths: true, ..Grid::default() };
        if gaps.contains(&true) && width > 0 {
            grid.remove(&gaps);
        }
        Ok(grid)
    }
}

/// A curve of as many values as there are wavelengths, gaps among neither.
fn on(wavelengths: &[f64], values: &[f64], name: &str) -> Result<Spectrum, ReadError> {
    if values.len() != wavelengths.len() {
        let (found, expected) = (values.len(), wavelengths.len());
        return Err(ReadError::WrongCount { line: 1, name: name.to_owned(), found, expected });
    }
    let present = wavelengths.iter().zip(values).filter(|(wavelength, value)| !wavelength.is_nan() && !value.is_nan());
    let sample = |(&wavelength, &value)| Sample { wavelength, value, line: 1, place: PlaceId::default() };
    Ok(Spectrum { samples: present.map(sample).collect(), ..Spectrum::default() })
}

/// The wavelengths of a range, given by its ends and its step.
fn range(bands: &[f64]) -> Option<Vec<f64>> {
    let &[first, last, step] = bands else { return None };
    let steps = ((last - first) / step).round();
    let some = (1.0..=MAX_SAMPLES as f64).contains(&steps);
    some.then(|| (0..=steps as usize).map(|i| clean(first + step * i as f64)).collect())
}

/// Records lists of values and of their wavelengths, which may be a range.
fn record_lists(bands: Value<'_>, lists: &[Value<'_>], log: &mut Log<'_>) {
    let Some(places) = &mut log.places else { return };
    let parsed: Vec<f64> = bands.pieces().filter_map(|band| band.parse().ok()).collect();
    let listed = parsed.len() == lists.first().map_or(0, |list| list.pieces().count());
    let wavelengths = if listed { parsed } else { range(&parsed).unwrap_or_default() };
    let own = (wavelengths.len() == bands.pieces().count()).then_some((PlaceKind::Wavelength, 0, bands));
    let values = lists.iter().enumerate().map(|(curve, list)| (PlaceKind::Value, curve, *list));
    for (kind, curve, list) in own.into_iter().chain(values) {
        for (piece, wavelength) in list.pieces().zip(&wavelengths) {
            record(list, piece, kind, (curve, *wavelength), places);
        }
    }
}

/// Records wavelengths that are keys, each before a number for each curve.
fn record_rows(rows: &Members<'_>, group: Value<'_>, places: &mut Places<'_>) {
    for (key, row) in rows.each() {
        let Ok(wavelength) = key.trim().parse() else { continue };
        if row.pieces().next().is_some() && matches!(key, std::borrow::Cow::Borrowed(_)) {
            record(group, key, PlaceKind::Wavelength, (0, wavelength), places);
        }
        for (curve, piece) in row.pieces().enumerate() {
            record(row, piece, PlaceKind::Value, (curve, wavelength), places);
        }
    }
}

fn record(value: Value<'_>, piece: &str, kind: PlaceKind, (curve, nm): (usize, f64), places: &mut Places<'_>) {
    if piece != "null" {
        let place = places.add_at(kind, value.offset(piece), piece.len());
        places.assign(place, curve, nm);
    }
}
