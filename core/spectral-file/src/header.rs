//! Header above the numbers: comments, names of columns, units.

mod legend;
mod names;

use std::collections::BTreeSet;

use chromascope_text::unguarded;

use crate::clues::{self, Clues};
use crate::decision::{Medium, Orientation, Quantity, Role, Values, WavelengthUnit};
use crate::dialect::Dialect;
use crate::dialect_trial::Layout;
use crate::error::MAX_CURVES;
use crate::header_terms::{self, XUnit};
use crate::text::{Lines, Section, comment, has_word, is_one, lower};
use crate::{heads, uncertainty_terms, unit_text, units};

const MAX_COMMENTS: usize = 1000;

/// Most lines with text between the names or units and the numbers.
const NEAR: usize = 8;

#[derive(Debug, Default)]
pub(super) struct Header {
    pub(super) comments: Vec<(String, String)>,
    /// The lines of the comments, where they are known.
    pub(super) noted: Vec<u32>,
    pub(super) line: Option<usize>,
    pub(super) names: Vec<String>,
    pub(super) units: Vec<String>,
    pub(super) units_line: Option<usize>,
    /// Names of samples, by column, in a row of its own.
    pub(super) samples: Vec<String>,
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
    /// True if a line speaks of Raman scattering, whose spectra are over differences of wave numbers.
    pub(super) raman: bool,
    /// True if the table is one of calibration coefficients, which no word makes spectra.
    pub(super) calibration: bool,
    pub(super) role: Option<(usize, Role)>,
    /// Role that free text mentions; only good for a guess.
    pub(super) mentioned: Option<(usize, Role)>,
    /// The one mentioned before it.
    pub(super) earlier: Option<(usize, Role)>,
    /// Light or fractions of light, as a quantity in free text says, and the other of the two.
    pub(super) measured: [Option<(usize, Role)>; 2],
    /// Units that comments give to columns by their names.
    pub(super) named_units: Vec<(usize, String, String)>,
    pub(super) clues: Clues,
    /// In the program's own tables, for each column behind that of the wavelengths: the coverage factor, if it holds uncertainties.
    pub(super) own: Vec<Option<f64>>,
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
    let mut named_above = None;
    let mut described = Vec::new();
    let mut lines = Lines::of(section).take_while(|(number, _)| *number < layout.header_end());
    while let Some((number, line)) = lines.next() {
        if line.trim().is_empty() {
            continue;
        }
        if header.take_fields(number, line, layout).is_some() {
            continue;
        }
        if let Some((key, value)) = comment(line).and_then(card) {
            header.take_comment(number, key, value);
            continue;
        }
        if let Some((key, value)) = braced(line) {
            if key == "Units, Wavelength Units" && layout.width == legend::GLAZING.len() {
                named_above = Some((number, legend::GLAZING.map(str::to_owned).to_vec()));
            }
            header.take_comment(number, key, value);
            continue;
        }
        header.take_name_row(line, layout);
        let (line, body) = (unmarked(line), comment(line));
        if let Some((name, unit)) = body.and_then(legend::ecsv_column) {
            header.named_units.push((number, name.to_owned(), unit.to_owned()));
            continue;
        }
        // Two are prose, unless each has a unit.
        let united = |names: &str| names.ends_with([')', ']']);
        let text = body.unwrap_or(line);
        header.take_of_program(number, text, &near);
        if let Some((unit, names)) = legend::names_of_program(text, layout).filter(|_| named_above.is_none()) {
            header.x_unit = unit.map(|unit| (number, unit)).or(header.x_unit);
            named_above = Some((number, names));
        }
        if named_above.is_none() && (layout.width > 2 || united(text)) {
            let names = names::split_otherwise(layout, text).filter(|names| layout.width > 2 || united(&names[0]));
            named_above = names.map(|names| (number, names));
        }
        if let Some(name) = legend::described_column(text, described.len() + 1) {
            described.push(name.replace('\t', " "));
            if described.len() == layout.width {
                named_above = named_above.or_else(|| Some((number, described.clone())));
            }
            if !text.contains([':', '=']) {
                continue;
            }
        }
        let line = body.map_or_else(|| whole(section, line, layout.dialect(), &mut lines), |_| line);
        if let Some((key, value)) = body.and_then(|body| body.split_once(':')) {
            named_above = named_above.or_else(|| Some((number, legend::listed_names(key, value, layout)?)));
            header.take_comment(number, key.trim(), value.trim());
            continue;
        }
        header.take_prose(number, body.unwrap_or(line));
        // A rule between the names and the numbers.
        if body.is_some_and(|body| !body.is_empty() && header_terms::is_sign(body)) {
            continue;
        }
        near.push((number, line));
        if near.len() > NEAR {
            near.remove(0);
        }
    }
    if layout.orientation.value == Orientation::Down {
        if header.names.is_empty() {
            header.take_names(&near, layout, section);
        }
        if let Some((line, names)) = named_above.filter(|_| header.names.is_empty()) {
            header.take_unit_cell(line, &names, layout);
            (header.line, header.names) = (Some(line), names);
        }
        header.settle(layout);
        heads::take(&mut header);
    }
    header
}

/// Keys of comments on the columns, or on wavelengths among them.
const ABOUT_COLUMNS: &str = "columns|column|fields|starting wavelength|start wavelength|first wavelength|mean wavelength|\
    central wavelength|effective wavelength|pivot wavelength";

/// The name of the sample that a setting gives: `Sample name: leaf 3`, `TITLE<tab>leaf 3`.
fn stated_name(line: &str) -> Option<&str> {
    const KEYS: &str = "title|sample|sample name|sample id|name|data name|spectrum name|label|labels";
    let (key, value) = line.split_once([':', ';', '=', '\t', ','])?;
    let value = bare_title(value);
    let is_name = value.contains(char::is_alphabetic) && !value.contains([',', ';', '\t', '=']);
    let is_key = is_one(&lower(bare_title(key)), KEYS);
    (is_key && is_name && value.len() <= 100 && !header_terms::is_quantity(value)).then_some(value)
}

/// Key and value of a line as that database writes them: `{ Thickness } 3.048`, `{ Type: Monolithic }`.
fn braced(line: &str) -> Option<(&str, &str)> {
    let (inner, rest) = line.trim().strip_prefix("{ ")?.split_once('}')?;
    let (key, value) = inner.split_once(':').unwrap_or((inner, rest));
    Some((key.trim(), value.trim()))
}

/// Key and text of a line of a FITS header in a comment: `XUNITS  = 'um      ' / x units`.
fn card(body: &str) -> Option<(&str, &str)> {
    let (key, rest) = body.split_once('=')?;
    let key = match key.trim_end() {
        "XUNITS" => "x units",
        "YUNITS" => "y units",
        key => key,
    };
    let is_key = key.len() <= 8 && !key.is_empty() && !key.contains(char::is_whitespace) || key.contains(" units");
    let (value, _) = rest.trim_start().strip_prefix('\'')?.split_once('\'')?;
    Some((key, value.trim())).filter(|(_, value)| is_key && !value.is_empty())
}

/// The unit of wavelengths that a list of units begins with, and the rest: `μm, W/m2/μm`, `Angstroms (A) and erg s-1 cm-2 A-1`.
fn listed_unit(list: &str) -> Option<(WavelengthUnit, &str)> {
    let (unit, rest) = list.split_once(',').or_else(|| list.split_once(" and "))?;
    Some((WavelengthUnit::from_symbol(unit.split('(').next()?.trim())?, rest.split(',').next()?.trim()))
}

/// The unit of wavelengths in the first brackets of a line of units: `[Angstrom] [erg/cm^2/s/A]`.
fn first_unit(body: &str) -> Option<WavelengthUnit> {
    let (unit, rest) = body.trim_start().strip_prefix('[')?.split_once(']')?;
    WavelengthUnit::from_symbol(unit.trim()).filter(|_| rest.trim_start().starts_with('['))
}

/// A line of names without the sign of a comment that no blank follows: `%Wavelength, leaf`.
fn unmarked(line: &str) -> &str {
    let names = line.trim_start().strip_prefix('%').filter(|names| names.to_lowercase().starts_with("wavelength"));
    names.unwrap_or(line)
}

impl Header {
    /// Takes what only lines of some programs and databases say.
    fn take_of_program(&mut self, number: usize, text: &str, near: &[(usize, &str)]) {
        // LabSpec's wave numbers are shifts.
        self.raman |= has_word(&lower(text), "raman") || text.starts_with("AxisUnit[1]=");
        if let Some(name) = text.strip_prefix("Data from ").and_then(|rest| rest.trim_end().strip_suffix(" Node")) {
            self.note(number, "title", name.trim_end_matches(".txt"));
        }
        // CRAIC's program writes the sample, and what was measured, above its settings.
        if text.starts_with("SciMode:")
            && let [(_, sample), _] = near
        {
            self.note(number, "title", sample);
        }
        // The database's spectra are over Raman shifts, wave numbers of the infrared or angles.
        if text.contains("rruff.info") {
            self.x_unit = Some((number, XUnit::Other));
        }
    }

    pub(super) fn take_comment(&mut self, line: usize, key: &str, value: &str) {
        /// Keys of what the values are, if a quantity and a unit stand behind them.
        const MEASURED_TOO: &str = "data|data type|value|values|y|signal|spectrum|spectra|column|columns";
        let lower = key.to_ascii_lowercase().replace('_', " ");
        if is_one(&lower, "k|coverage factor|coverage|uncertainty|uncertainties|note") {
            self.take_coverage(line, &format!("{key}: {value}"));
        }
        // An object of YAML is no unit of the values.
        if is_one(&lower, "unit|units|y unit|y units|yunit|yunits") && !value.starts_with(['!', '{']) {
            let first = listed_unit(value);
            self.x_unit = first.map(|(unit, _)| (line, XUnit::Wavelength(unit))).or(self.x_unit);
            let value = first.map_or(value, |(_, rest)| rest);
            self.take_value_unit(line, value);
            self.unit = unit_text::unit_cell(value).filter(|unit| unit != "1").or(self.unit.take());
        } else if lower == "quantity"
            || is_title_with_unit(value) && (is_one(&lower, clues::MEASURED) || is_one(&lower, MEASURED_TOO))
        {
            self.take_value_unit(line, value);
            let unit = unit_text::unit(value).filter(|_| unit_text::without_unit(value) != value);
            self.unit = unit.or(self.unit.take());
        }
        let is_new = lower != "title" && self.comment("title").is_none();
        if let Some(name) = stated_name(&format!("{key}: {value}")).filter(|_| is_new) {
            self.note(line, "title", name);
        }
        if is_one(&lower, "response|title|description") {
            self.mentioned = self.mentioned.or_else(|| header_terms::role(value).map(|role| (line, role)));
            self.take_photons(line, value);
            self.clues.mention(line, value);
        }
        // `wavelength_unit`, `x unit` and the like; a plain `unit` is that of the values.
        let about_x = header_terms::x_unit_in_prose(&format!("{lower} {value}"));
        let about_columns = is_one(unit_text::bare(&lower), ABOUT_COLUMNS);
        if let Some(unit) = about_x.filter(|_| lower.starts_with(['w', 'x']) || about_columns) {
            self.x_unit = Some((line, unit));
        } else if let Some(name) = lower.strip_suffix(" unit").or_else(|| lower.strip_suffix(" units")) {
            self.named_units.push((line, name.to_owned(), value.to_owned()));
        }
        if self.comments.len() < MAX_COMMENTS {
            self.comments.push((key.to_owned(), value.to_owned()));
            self.noted.push(line as u32);
        }
    }

    /// Takes the names of the samples in a row that is headed so, wherever it stands: `Name,apple,,orange`.
    fn take_name_row(&mut self, line: &str, layout: &Layout) {
        let mut cells = layout.dialect().cells(line);
        if layout.width > 2 && cells.next().is_some_and(|key| is_one(&lower(key), "name|names|sample name|channel")) {
            self.samples = std::iter::once(String::new()).chain(cells.map(str::to_owned)).collect();
        }
    }

    /// Settles names, units and what they say of the values.
    fn settle(&mut self, layout: &Layout) {
        self.settle_names();
        // UV WinLab writes `A` where others write `Abs`.
        if let [axis, values] = &self.names[..]
            && axis == "nm"
            && values == "A"
        {
            self.clues.absorbance = self.clues.absorbance.or(self.line);
        }
        self.settle_units(layout);
        if let Some((line, XUnit::Wavelength(WavelengthUnit::Wavenumber))) = self.x_unit.filter(|_| self.raman) {
            self.x_unit = Some((line, XUnit::Other));
        }
    }

    /// Tells columns of one head apart by the names of their samples.
    fn settle_names(&mut self) {
        let named = |column: usize| self.samples.get(column).is_some_and(|name| !name.is_empty());
        let columns: Vec<usize> = (1..self.names.len()).filter(|column| named(*column)).collect();
        let heads: Vec<&str> = columns.iter().map(|column| &*self.names[*column]).collect();
        let told: BTreeSet<&str> = columns.iter().map(|column| &*self.samples[*column]).collect();
        let alike = heads.iter().all(|head| *head == heads[0] && !head.is_empty());
        let are_numbers = |names: &[&str]| names.iter().all(|name| name.parse::<f64>().is_ok());
        let numbered = are_numbers(&heads) && !are_numbers(&told.iter().copied().collect::<Vec<_>>());
        if heads.len() < 2 || !(alike || numbered) || told.len() < columns.len() {
            return;
        }
        self.units.resize(self.units.len().max(self.names.len()), String::new());
        for column in columns {
            let head = std::mem::replace(&mut self.names[column], self.samples[column].clone());
            if self.units[column].is_empty() {
                self.units[column] = head;
            }
        }
    }

    /// Gives columns the units that comments give to their names; in a table of one curve to that.
    fn settle_units(&mut self, layout: &Layout) {
        let bare = |name: &str| lower(name).replace(['_', '-'], " ");
        for (line, name, unit) in std::mem::take(&mut self.named_units) {
            let column = self.names.iter().position(|own| bare(own) == bare(&name));
            if column == Some(0) || column.is_none() && header_terms::names_axis(&name) {
                self.x_unit = header_terms::x_unit(&unit).map(|unit| (line, unit)).or(self.x_unit);
            } else if let Some(column) = column {
                self.units.resize(self.units.len().max(column + 1), String::new());
                let own = &mut self.units[column];
                *own = if own.is_empty() { format!("[{unit}]") } else { std::mem::take(own) };
            } else if layout.width == 2 {
                self.take_value_unit(line, &format!("{name} [{unit}]"));
                self.unit = unit_text::unit_cell(&unit).or(self.unit.take());
            }
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
        if text.contains(['k', 'K']) || text.contains("overage") {
            self.coverage = uncertainty_terms::coverage(&lower(text)).map(|k| (line, k)).or(self.coverage);
        }
    }

    fn take_role(&mut self, line: usize, text: &str) {
        // Lights have other units: `radiance paint (%)` is a sample.
        let sample = self.values.is_some_and(|(_, values)| values == Values::Percent);
        let role = header_terms::role(text).filter(|role| !(self.calibration || sample && *role == Role::Illuminant));
        self.role = role.map(|role| (line, role)).or(self.role);
    }

    fn take_prose(&mut self, line: usize, text: &str) {
        const ABOUT_Y: &str = "y unit|y-unit|yunit|yaxisunit|unit:|units:|unit,|units,|unit=|unit =|units=|units =";
        // A setting such as `Wavenumber correction,0` gives no unit.
        let number = || text.split_once([',', ';', '\t']).is_some_and(|(_, value)| value.trim().parse::<f64>().is_ok());
        let setting = |unit: &XUnit| *unit == XUnit::Wavelength(WavelengthUnit::Wavenumber) && !text.contains("cm");
        if let Some(unit) = header_terms::x_unit_in_prose(text).filter(|unit| !(setting(unit) && number())) {
            self.x_unit = Some((line, unit));
        }
        if let Some(unit) = first_unit(text).filter(|_| self.x_unit.is_none()) {
            self.x_unit = Some((line, XUnit::Wavelength(unit)));
        }
        // Woollam's files have the unit in a line of its own.
        let alone = WavelengthUnit::from_symbol(text.trim()).map(XUnit::Wavelength);
        // `Hbar Omega (eV)  Decay rate`
        let begins_with_energy = |(name, _): (&str, &str)| {
            name.split_whitespace().count() <= 2 && !name.contains(',') && !lower(text).contains("wavelength")
        };
        let energy = text.split_once("(eV)").filter(|parts| begins_with_energy(*parts)).map(|(name, _)| name);
        let energy = energy.or_else(|| text.trim().eq_ignore_ascii_case("ev").then_some(""));
        let alone = alone.or_else(|| header_terms::x_unit(&format!("{} (eV)", energy?)));
        self.x_unit = self.x_unit.or(alone.map(|unit| (line, unit)));
        if let Some(name) = stated_name(text).filter(|_| self.comment("title").is_none()) {
            self.note(line, "title", name);
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
            let unit = text.split_once([':', ';', ',', '=']).and_then(|(_, value)| unit_text::unit(bare_title(value)));
            self.unit = unit.or_else(|| unit_text::unit(bare_title(text))).or(self.unit.take());
        }
        // A line such as `Mode/Unit-->,Irradiance[µWatt/cm²]`.
        if let Some((_, value)) = text.split_once("Unit-->") {
            let value = value.trim_start_matches([',', ';', '\t', ' ']);
            self.take_value_unit(line, value);
            self.unit = unit_text::unit(value).or(self.unit.take());
        }
        self.calibration |= header_terms::says_calibration(text);
        // ASD's files are named after what was meant to be measured; `0=Reflectance, 1=…` are all the types there are.
        let has = |start: &str| text.split([' ', ',', ';', '\t', '(']).any(|part| part.starts_with(start));
        let is_other = text.contains(".asd") || has("0=") && has("1=");
        if let Some(role) = header_terms::role_in_prose(text).filter(|_| !self.calibration && !is_other) {
            (self.mentioned, self.earlier) = (Some((line, role)), self.mentioned);
            let told = role == Role::Illuminant || role.is_fraction();
            if header_terms::quantity(text).is_some() && told && self.measured[1].is_none() {
                let other = self.measured[0].is_some_and(|(_, first)| first.is_fraction() != role.is_fraction());
                self.measured[usize::from(other)].get_or_insert((line, role));
            }
        }
        self.clues.take(line, text);
    }
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

/// A line with those below it into which a cell in quotes goes on.
fn whole<'a>(
    section: Section<'a>,
    line: &'a str,
    dialect: Dialect,
    lines: &mut (impl Iterator<Item = (usize, &'a str)> + Clone),
) -> &'a str {
    const LONGEST: usize = 4096;
    if !line.contains('"') || dialect.closes_quotes(line) {
        return line;
    }
    let mut ahead = lines.clone();
    let start = line.as_ptr() as usize - section.text.as_ptr() as usize;
    let mut quotes = line.matches('"').count();
    while let Some((_, next)) = ahead.next() {
        let end = next.as_ptr() as usize - section.text.as_ptr() as usize + next.len();
        quotes += next.matches('"').count();
        let text = &section.text[start..end];
        if text.len() > LONGEST || quotes.is_multiple_of(2) && !dialect.closes_quotes(text) {
            break;
        } else if quotes.is_multiple_of(2) {
            *lines = ahead;
            return text;
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
