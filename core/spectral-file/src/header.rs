//! Header above the numbers: comments, names of columns, units.

mod own_heads;

pub(super) use own_heads::{head_tail, quantity_of_light};

use chromascope_text::unguarded;

use crate::clues::{self, Clues};
use crate::decision::{Delimiter, Medium, Orientation, Quantity, Role, Values, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::Layout;
use crate::error::MAX_CURVES;
use crate::header_terms::{self, XUnit};
use crate::text::{Lines, Section, comment, is_one};
use crate::{uncertainty_terms, unit_text, units};

const MAX_COMMENTS: usize = 1000;

/// Most lines with text between the names or units and the numbers.
const NEAR: usize = 6;

#[derive(Debug, Default)]
pub(super) struct Header {
    pub(super) comments: Vec<(String, String)>,
    /// The lines of the comments, where they are known.
    pub(super) noted: Vec<u32>,
    pub(super) line: Option<usize>,
    pub(super) names: Vec<String>,
    pub(super) units: Vec<String>,
    pub(super) units_line: Option<usize>,
    /// True if the line of names omits that of the wavelengths.
    pub(super) shifted: bool,
    pub(super) x_unit: Option<(usize, XUnit)>,
    pub(super) values: Option<(usize, Values)>,
    pub(super) quantity: Option<(usize, Quantity)>,
    pub(super) unit: Option<String>,
    pub(super) photons: Option<usize>,
    pub(super) per_photon: Option<usize>,
    pub(super) medium: Option<(usize, Medium)>,
    /// Coverage factor k of the uncertainties in the table.
    pub(super) coverage: Option<(usize, f64)>,
    /// True if the table is one of calibration coefficients, which no word makes spectra.
    pub(super) calibration: bool,
    pub(super) role: Option<(usize, Role)>,
    /// Role that free text mentions; only good for a guess.
    pub(super) mentioned: Option<(usize, Role)>,
    /// The one mentioned before it.
    pub(super) earlier: Option<(usize, Role)>,
    pub(super) clues: Clues,
}

impl Header {
    pub(super) fn name(&self, column: usize) -> Option<&str> {
        // A line of units such as `nm,R%` or `nm,leaf %R` may be all there is.
        let unit = || self.units.get(column).filter(|unit| unit.contains('%') && !unit.starts_with('%'));
        let name = self.names.get(column).or_else(|| unit().filter(|_| self.names.is_empty()));
        name.map(String::as_str).filter(|name| !name.is_empty())
    }

    pub(super) fn label(&self, column: usize) -> String {
        let unit = self.units.get(column).map_or("", String::as_str);
        let name = self.name(column).filter(|name| *name != unit).unwrap_or_default();
        // In brackets, the sign of percent behind `T8` is the unit that it is.
        if unit.starts_with('%') && !name.is_empty() {
            return format!("{name} ({unit})");
        }
        format!("{name} {unit}").trim().to_owned()
    }

    pub(super) fn unit(&self, column: usize) -> Option<String> {
        let whole = |cell: &&String| cell.starts_with(['[', '(']);
        let cell = self.units.get(column);
        let cell = cell.and_then(|cell| {
            unit_text::unit(cell).or_else(|| Some(cell).filter(whole).and_then(|cell| unit_text::unit_cell(cell)))
        });
        cell.or_else(|| self.name(column).and_then(unit_text::unit)).or_else(|| self.unit.clone())
    }

    /// Stores a comment; line 0 means none.
    pub(super) fn note(&mut self, line: usize, key: &str, value: &str) {
        if self.comments.len() < MAX_COMMENTS && !value.is_empty() {
            self.comments.push((key.to_owned(), value.to_owned()));
            self.noted.push(line as u32);
        }
    }

    pub(super) fn comment(&self, key: &str) -> Option<&str> {
        self.comments.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)).map(|(_, value)| value.as_str())
    }
}

pub(super) fn read(section: Section<'_>, layout: &Layout) -> Header {
    let mut header = Header::default();
    let mut near: Vec<(usize, &str)> = Vec::with_capacity(NEAR + 1);
    let mut lines = Lines::of(section).take_while(|(number, _)| *number < layout.header_end());
    while let Some((number, line)) = lines.next() {
        if line.trim().is_empty() {
            continue;
        }
        if header.take_fields(number, line, layout).is_some() {
            continue;
        }
        let (line, body) = (unmarked(line), comment(line));
        let line = body.map_or_else(|| whole(section, line, layout.dialect(), &mut lines), |_| line);
        if let Some((key, value)) = body.and_then(|body| body.split_once(':')) {
            header.take_comment(number, key.trim(), value.trim());
            continue;
        }
        header.take_prose(number, body.unwrap_or(line));
        near.push((number, line));
        if near.len() > NEAR {
            near.remove(0);
        }
    }
    if layout.orientation.value == Orientation::Down {
        if header.names.is_empty() {
            header.take_names(&near, layout, &|| has_row_names(section, layout));
        }
        own_heads::take_heads(&mut header);
    }
    header
}

impl Header {
    pub(super) fn take_comment(&mut self, line: usize, key: &str, value: &str) {
        /// Keys of what the values are, if a quantity and a unit stand behind them.
        const MEASURED_TOO: &str = "data|data type|value|values|y|signal|spectrum|spectra|column|columns";
        let lower = key.to_ascii_lowercase();
        if is_one(&lower, "k|coverage factor|coverage|uncertainty|uncertainties|note") {
            self.take_coverage(line, &format!("{key}: {value}"));
        }
        if is_one(&lower, "unit|units|y unit|y units|yunit|yunits") {
            self.take_value_unit(line, value);
            self.unit = unit_text::unit_cell(value).filter(|unit| unit != "1").or(self.unit.take());
        } else if lower == "quantity"
            || is_title_with_unit(value) && (is_one(&lower, clues::MEASURED) || is_one(&lower, MEASURED_TOO))
        {
            self.take_value_unit(line, value);
            let unit = unit_text::unit(value).filter(|_| unit_text::without_unit(value) != value);
            self.unit = unit.or(self.unit.take());
        }
        if is_one(&lower, "response|title|description") {
            self.mentioned = self.mentioned.or_else(|| header_terms::role(value).map(|role| (line, role)));
            self.take_photons(line, value);
            self.clues.mention(line, value);
        }
        // `wavelength_unit`, `x unit` and the like; a plain `unit` is that of the values.
        let about_x = header_terms::x_unit_in_prose(&format!("{} {value}", lower.replace('_', " ")));
        if let Some(unit) = about_x.filter(|_| lower.starts_with(['w', 'x'])) {
            self.x_unit = Some((line, unit));
        }
        if self.comments.len() < MAX_COMMENTS {
            self.comments.push((key.to_owned(), value.to_owned()));
            self.noted.push(line as u32);
        }
    }

    fn take_photons(&mut self, line: usize, text: &str) {
        self.per_photon = self.per_photon.or_else(|| unit_text::says_per_photon(text).then_some(line));
        self.photons = self.photons.or_else(|| unit_text::said_in_prose(text).then_some(line));
    }

    fn take_value_unit(&mut self, line: usize, text: &str) {
        self.take_photons(line, text);
        self.photons = self.photons.or_else(|| unit_text::names_photons(text).then_some(line));
        let plain_after_other = |values: &Values| *values == Values::Plain && self.values.is_some();
        if let Some(values) = header_terms::values(text).filter(|values| !plain_after_other(values)) {
            self.values = Some((line, values));
        }
        self.take_role(line, text);
        self.quantity = match (header_terms::quantity(text), self.quantity) {
            (Some(Quantity::Relative), Some(known)) => Some(known),
            (found, known) => found.map(|quantity| (line, quantity)).or(known),
        };
    }

    fn take_coverage(&mut self, line: usize, text: &str) {
        const LONGEST: usize = 400;
        if text.len() <= LONGEST && (text.contains(['k', 'K']) || text.contains("overage")) {
            let found = uncertainty_terms::coverage(&text.to_lowercase());
            self.coverage = found.map(|k| (line, k)).or(self.coverage);
        }
    }

    fn take_role(&mut self, line: usize, text: &str) {
        // Lights have other units: `radiance paint (%)` is a sample.
        let sample = self.values.is_some_and(|(_, values)| values == Values::Percent);
        let role = header_terms::role(text).filter(|role| !(self.calibration || sample && *role == Role::Illuminant));
        self.role = role.map(|role| (line, role)).or(self.role);
    }

    fn take_prose(&mut self, line: usize, text: &str) {
        const ABOUT_Y: &str = "y unit|yunit|yaxisunit|unit:|units:|unit,|units,|unit=|unit =|units=|units =";
        if let Some(unit) = header_terms::x_unit_in_prose(text) {
            self.x_unit = Some((line, unit));
        }
        self.take_coverage(line, text);
        self.medium = header_terms::medium(text).map(|medium| (line, medium)).or(self.medium);
        self.take_photons(line, text);
        let start = text.trim_start().as_bytes();
        let begins =
            |word: &str| start.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word.as_bytes()));
        let about_y = ABOUT_Y.split('|').any(begins);
        // As a sign of a comment it is no unit.
        let text = text.trim_start().trim_start_matches('%');
        if about_y || is_title_with_unit(text) {
            self.take_value_unit(line, text);
            let unit = text.split_once([':', ';', ',', '=']).and_then(|(_, value)| unit_text::unit(value));
            self.unit = unit.or_else(|| unit_text::unit(bare_title(text))).or(self.unit.take());
        }
        // A line such as `Mode/Unit-->,Irradiance[µWatt/cm²]`.
        if let Some((_, value)) = text.split_once("Unit-->") {
            let value = value.trim_start_matches([',', ';', '\t', ' ']);
            self.take_value_unit(line, value);
            self.unit = unit_text::unit(value).or(self.unit.take());
        }
        self.calibration |= header_terms::says_calibration(text);
        if let Some(role) = header_terms::role_in_prose(text).filter(|_| !self.calibration) {
            (self.mentioned, self.earlier) = (Some((line, role)), self.mentioned);
        }
        self.clues.take(line, text);
    }

    /// The names, and units below them, from the lines just above the numbers.
    fn take_names(&mut self, near: &[(usize, &str)], layout: &Layout, row_names: &dyn Fn() -> bool) {
        let mut rows = near.iter().rev();
        while let Some(&(number, line)) = rows.next() {
            let is_comment = comment(line).is_some();
            let line = comment(line).unwrap_or(line);
            let mut cells = split(layout.dialect(), line);
            let other = cells.len() != layout.width || cells.first().is_some_and(|cell| cell.ends_with(','));
            if other && let Some(names) = split_otherwise(layout, line, is_comment) {
                cells = names;
            }
            // A rule, or the key of a section such as `[LAMPDATA]`, between names and numbers.
            let key = |cell: &String| cell.starts_with('[') && cell.ends_with(']') && !is_unit(cell);
            let rule = cells.len() > 1
                && cells.iter().all(|cell| cell.bytes().all(|byte| matches!(byte, b'-' | b'_' | b'=' | b':')));
            if rule || cells.len() == 1 && key(&cells[0]) {
                continue;
            }
            let headed = |cells: &[String]| cells.iter().any(|name| header_terms::names_wavelengths(name));
            // R's names of rows have no head.
            if cells.len() > 1 && cells.len() + 1 == layout.width && headed(&cells) && row_names() {
                cells.insert(0, String::new());
                self.shifted = true;
            }
            let exact = is_comment || layout.delimiter.value == Delimiter::Spaces;
            if cells.len() < 2 || (exact && cells.len() != layout.width) {
                let unit_alone = cells.len() == 1 && self.units.is_empty() && is_unit(&cells[0]);
                if unit_alone {
                    self.x_unit = header_terms::x_unit(&cells[0]).map(|unit| (number, unit));
                    self.units_line = Some(number);
                }
                // Rows that are named themselves go on above one of units, or one left empty.
                if unit_alone && keyed(layout, rows.clone()).next().is_some()
                    || cells.len() == 1 && row_key(&cells[0]).is_some()
                {
                    continue;
                }
                self.take_joined(number, line);
                return;
            }
            let mut number = number;
            if row_key(&cells[0]).is_some_and(|key| key != RowKey::Name)
                && let Some(named) = keyed(layout, rows.clone())
                    .find(|(_, cells)| cells.len() > 1 && row_key(&cells[0]) == Some(RowKey::Name))
            {
                (number, cells) = named;
            }
            if is_key_and_value(layout, &cells) {
                return;
            }
            if self.units.is_empty() && is_unit_row(&cells) {
                self.take_unit_cell(number, &cells, layout);
                self.units = cells;
                self.units_line = Some(number);
                continue;
            }
            if is_measured(layout, &cells) {
                continue;
            }
            if self.units.is_empty() || self.x_unit.is_none() {
                self.take_unit_cell(number, &cells, layout);
            }
            self.names = cells;
            self.line = Some(number);
            // Names of samples say less than a line above them.
            let above = self.earlier.filter(|_| self.mentioned.is_some_and(|(line, _)| line == number));
            self.mentioned = above.or(self.mentioned);
            // Some programs name only the curves.
            if self.names.len() + 1 == layout.width && row_key(&self.names[0]).is_none() && !headed(&self.names) {
                self.names.insert(0, String::new());
                self.shifted = true;
            }
            if self.units.is_empty() && !is_comment {
                self.take_samples(rows.next(), rows.next().is_none() && self.comments.is_empty(), layout);
            }
            return;
        }
    }

    /// Takes the names of samples from the line above one that only says what was measured, `Wavelength (nm),%T,Wavelength (nm),%T`:
    /// each above its values, or above its wavelengths.
    fn take_samples(&mut self, above: Option<&(usize, &str)>, first: bool, layout: &Layout) {
        let Some(&(number, line)) = above.filter(|(_, line)| comment(line).is_none()) else { return };
        let is_axis = |name: &String| header_terms::names_axis(name);
        let columns = |axes: bool| {
            let names =
                self.names.iter().enumerate().filter(move |(_, name)| is_axis(name) == axes && !name.is_empty());
            names.map(|(column, _)| column).collect::<Vec<_>>()
        };
        let (axes, values) = (columns(true), columns(false));
        // Neither does one name of all.
        let alike = values.len() > 1 && values.iter().all(|&column| self.names[column] == self.names[values[0]]);
        let measure = |column: &usize| alike || says_only_measure(&self.names[*column]);
        if axes.is_empty() || values.is_empty() || !values.iter().all(measure) {
            return;
        }
        let cells = split(layout.dialect(), line);
        let mut above: Vec<String> = vec![String::new(); self.names.len()];
        // Shimadzu names its only curve so.
        if let [title] = cells.as_slice()
            && let (Some(name), [column]) = (title.strip_suffix(" - RawData"), values.as_slice())
        {
            name.clone_into(&mut above[*column]);
        } else {
            let filled: Vec<usize> = (0..cells.len()).filter(|&column| !cells[column].is_empty()).collect();
            let split = layout.dialect().cells(line).count();
            let names = filled.iter().all(|&column| layout.dialect().parse(&cells[column]) == Cell::Text);
            let over_axes = filled.first() == axes.first() && filled.iter().all(|column| axes.contains(column));
            let title = layout.width == 2 && !first;
            if !names || title || split < 2 || !(over_axes || filled == values) {
                return;
            }
            let mut name = "";
            for (column, above) in above.iter_mut().enumerate() {
                name = if over_axes && axes.contains(&column) { "" } else { name };
                name = cells.get(column).filter(|cell| !cell.is_empty()).map_or(name, String::as_str);
                if values.contains(&column) {
                    name.clone_into(above);
                }
            }
        }
        self.units_line = self.line.replace(number);
        self.units = vec![String::new(); self.names.len()];
        for (column, name) in above.into_iter().enumerate().filter(|(_, name)| !name.is_empty()) {
            self.units[column] = std::mem::replace(&mut self.names[column], name);
        }
    }

    /// Names that do not split into the columns of the table still say something about it as a whole.
    fn take_joined(&mut self, number: usize, line: &str) {
        if header_terms::names_wavelengths(line) && self.values.is_none() {
            self.line = self.line.or(Some(number));
            if let Some(values) = header_terms::values(line).filter(|values| *values != Values::Plain) {
                self.values = Some((number, values));
            }
            self.take_role(number, line);
            let quantity = header_terms::quantity(line).filter(|_| !self.calibration);
            self.quantity = quantity.map(|quantity| (number, quantity)).or(self.quantity);
        }
    }

    /// Takes names or units of all columns from a line of `SeaBASS`: `/fields=wavelength,Es`.
    fn take_fields(&mut self, number: usize, line: &str, layout: &Layout) -> Option<()> {
        let (key, list) = line.trim_start().strip_prefix('/')?.split_once('=')?;
        let cells: Vec<String> = list.split(',').map(|cell| cell.trim().to_owned()).collect();
        match key {
            _ if cells.len() != layout.width => return None,
            "fields" => (self.names, self.line) = (cells, Some(number)),
            "units" => {
                self.take_unit_cell(number, &cells, layout);
                (self.units, self.units_line) = (cells, Some(number));
            }
            _ => return None,
        }
        Some(())
    }

    fn take_unit_cell(&mut self, number: usize, cells: &[String], layout: &Layout) {
        let chosen = layout.wavelength_column.map(|column| column.saturating_sub(1));
        let column = chosen.or_else(|| header_terms::axis(cells)).unwrap_or(0);
        if let Some(unit) = cells.get(column).and_then(|cell| header_terms::x_unit(cell)) {
            self.x_unit = Some((number, unit));
        }
    }
}

/// Names that other signs separate than the numbers below: tabs, commas or wide gaps above columns between blanks or in a comment, and
/// single blanks above columns between tabs.
fn split_otherwise(layout: &Layout, line: &str, is_comment: bool) -> Option<Vec<String>> {
    let (line, signs) = match layout.delimiter.value {
        delimiter if is_comment || delimiter == Delimiter::Spaces => (line.to_owned(), &["\t", ",", ";", "  "][..]),
        Delimiter::Tab => (line.replace('\t', " "), &[" "][..]),
        _ => return None,
    };
    signs.iter().find_map(|sign| {
        let cells = line.split(sign).map(str::trim).filter(|cell| !cell.is_empty());
        let names: Vec<String> = cells.take(layout.width + 1).map(str::to_owned).collect();
        let worded = names.len() > 1 && names.iter().all(|name| name.contains(char::is_alphabetic));
        (worded && names.len() == layout.width && header_terms::names_axis(&names[0])).then_some(names)
    })
}

/// A line of names without the sign of a comment that no blank follows: `%Wavelength, leaf`.
fn unmarked(line: &str) -> &str {
    let names = line.trim_start().strip_prefix('%').filter(|names| names.to_lowercase().starts_with("wavelength"));
    names.unwrap_or(line)
}

/// Returns whether the first rows begin with a name or with their number, as R writes.
fn has_row_names(section: Section<'_>, layout: &Layout) -> bool {
    const LOOK: usize = 3;
    let rows = Lines::of(section).skip_while(|(number, _)| *number < layout.first_line);
    let rows = rows.filter(|(_, line)| !line.trim_ascii().is_empty() && comment(line).is_none()).take(LOOK);
    let mut firsts = rows.map(|(_, line)| layout.dialect().cells(line).next().unwrap_or_default()).zip(1..);
    firsts.all(|(cell, count)| match layout.dialect().parse(cell) {
        Cell::Number(number) => number == f64::from(count),
        Cell::Text => layout.texts & 1 == 1,
        Cell::Gap => false,
    })
}

/// Returns whether a name says what was measured and nothing of which sample: `%T`, `Abs`, `Reflectance (%)`.
fn says_only_measure(name: &str) -> bool {
    let bare = unit_text::without_unit(name).to_lowercase();
    let bare = bare.trim_matches(|c: char| !c.is_alphanumeric());
    is_one(bare, "|r|t|a|abs|refl|trans|transmission") || header_terms::is_quantity(bare)
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum RowKey {
    Name,
    Number,
    Time,
}

fn row_key(cell: &str) -> Option<RowKey> {
    match cell.trim().trim_end_matches(':').to_ascii_lowercase().as_str() {
        "name" | "names" | "sample" | "sample name" | "label" => Some(RowKey::Name),
        "index" | "no" | "no." | "nr" | "number" | "id" => Some(RowKey::Number),
        "time" | "date" | "date/time" | "timestamp" => Some(RowKey::Time),
        _ => None,
    }
}

/// Rows that are named themselves.
fn keyed<'a>(
    layout: &Layout,
    rows: impl Iterator<Item = &'a (usize, &'a str)>,
) -> impl Iterator<Item = (usize, Vec<String>)> {
    let rows = rows.map(|(number, line)| (*number, split(layout.dialect(), line)));
    rows.take_while(|(_, cells)| cells.first().is_some_and(|cell| row_key(cell).is_some()))
}

/// A line that is a title, without separators that fill it up.
fn bare_title(text: &str) -> &str {
    text.trim_matches([' ', '\t', ',', ';', '"'])
}

/// Returns whether a line stands alone and names a quantity with its unit in brackets: `Irradiance [µW/cm2/nm],`.
fn is_title_with_unit(text: &str) -> bool {
    const LONGEST: usize = 80;
    let title = bare_title(text);
    title.len() <= LONGEST
        && !title.contains([',', ';', '='])
        && title.ends_with([']', ')'])
        && unit_text::without_unit(title) != title
        && (header_terms::quantity(title).is_some()
            || unit_text::unit(title).is_some_and(|unit| units::parse(&unit).is_some()))
}

/// Returns whether a line above two columns is a setting of the instrument, such as `LUX 695`, and no pair of names.
fn is_key_and_value(layout: &Layout, cells: &[String]) -> bool {
    if layout.width != 2 || cells.len() != 2 {
        return false;
    }
    let key = cells[0].to_ascii_lowercase();
    let numeric = matches!(layout.dialect().parse(&cells[1]), Cell::Number(_));
    ["xaxis", "yaxis", "x unit", "y unit"].iter().any(|start| key.starts_with(start))
        || (numeric && !header_terms::names_wavelengths(&cells[0]))
}

/// Returns whether a line above several curves gives a number of each, such as a chromaticity, and no names: names have no fractions.
fn is_measured(layout: &Layout, cells: &[String]) -> bool {
    let Some((key, values)) = cells.split_first().filter(|(key, _)| !key.is_empty()) else { return false };
    let number = |cell: &String| match layout.dialect().parse(cell) {
        Cell::Number(value) => Some(value),
        _ => None,
    };
    let mut numbers = values.iter().map(number);
    layout.width > 2
        && !header_terms::names_wavelengths(key)
        && number(key).is_none()
        && numbers.all(|value| value.is_some())
        && values.iter().filter_map(number).any(|value| value.fract() != 0.0)
}

/// A line with those below it into which a cell in quotes goes on.
fn whole<'a>(
    section: Section<'a>,
    line: &'a str,
    dialect: Dialect,
    lines: &mut (impl Iterator<Item = (usize, &'a str)> + Clone),
) -> &'a str {
    const MOST: usize = 8;
    if !line.contains('"') || dialect.closes_quotes(line) {
        return line;
    }
    let mut ahead = lines.clone();
    let start = line.as_ptr() as usize - section.text.as_ptr() as usize;
    for _ in 0..MOST {
        let Some((_, next)) = ahead.next() else { break };
        let end = next.as_ptr() as usize - section.text.as_ptr() as usize + next.len();
        if dialect.closes_quotes(&section.text[start..end]) {
            *lines = ahead;
            return &section.text[start..end];
        }
    }
    line
}

/// The cells of a header line, unescaped, without empty ones at the end.
pub(super) fn split(dialect: Dialect, line: &str) -> Vec<String> {
    let plain = |cell: &str| {
        let cell = unguarded(cell).replace("\"\"", "\"");
        if cell.contains(['\n', '\r']) { unit_text::tidy(&cell) } else { cell }
    };
    let mut cells: Vec<String> = dialect.cells(line).take(MAX_CURVES + 1).map(plain).collect();
    while cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
}

fn is_unit(cell: &str) -> bool {
    let bare = cell.trim_start_matches(['[', '(']).trim_end_matches([']', ')']);
    WavelengthUnit::from_symbol(bare).is_some() || header_terms::x_unit(bare) == Some(XUnit::Other)
}

fn is_unit_row(cells: &[String]) -> bool {
    let bracketed = cells.iter().filter(|cell| cell.starts_with(['[', '('])).count();
    bracketed * 2 >= cells.len() || (is_unit(&cells[0]) && cells[1..].iter().all(|cell| looks_like_unit(cell)))
}

/// Returns whether a cell begins with a number that no unit begins with, as names do: `10% gray`, `5R 4/14`.
fn begins_with_figure(cell: &str) -> bool {
    let inverse = cell.strip_prefix('1').is_some_and(|rest| rest.trim_start().starts_with('/'));
    cell.starts_with(|c: char| c.is_ascii_digit()) && !inverse && !cell.contains("10^")
}

fn looks_like_unit(cell: &str) -> bool {
    // `leaf (%)` is a name with its unit, `(%)` a unit.
    let named = !cell.starts_with(['[', '(']) && cell.contains(['[', '(']);
    !named
        && (cell.is_empty()
            || cell.starts_with(['[', '('])
            || (cell.contains(['%', '/']) && !begins_with_figure(cell))
            || is_one(&cell.to_ascii_lowercase(), "a.u.|counts|1|-"))
}
