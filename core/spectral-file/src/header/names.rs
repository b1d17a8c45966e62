//! Names of the columns, and the units below them, in the lines above the numbers.

use std::collections::BTreeSet;

use super::{Header, split};
use crate::decision::{Delimiter, Values, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::Layout;
use crate::header_terms::{self, XUnit};
use crate::text::{Lines, Section, comment, has_part, is_one, lower};
use crate::{uncertainty_terms, unit_text, wavelengths};

impl Header {
    /// The names, and units below them, from the lines just above the numbers.
    pub(super) fn take_names(&mut self, near: &[(usize, &str)], layout: &Layout, section: Section<'_>) {
        let mut axis = String::new();
        let mut rows = near.iter().rev();
        while let Some(&(number, line)) = rows.next() {
            let is_comment = comment(line).is_some();
            let mut cells = unmarked(cells(layout, line, section), is_comment);
            // The name of wavelengths alone, below those of the curves.
            let filled_up = cells.len() == 1 && layout.dialect().cells(line).count() == layout.width;
            if filled_up && header_terms::names_axis(&cells[0]) && !is_unit(&cells[0]) && axis.is_empty() {
                self.take_joined(number, line);
                axis = cells.swap_remove(0);
                continue;
            }
            if cells.first().is_some_and(String::is_empty) {
                axis.clone_into(&mut cells[0]);
            }
            if is_rule(&cells) {
                continue;
            }
            join_unit(&mut cells, layout);
            let headed = |cells: &[String]| cells.iter().any(|name| header_terms::names_wavelengths(name));
            // R's names of rows have no head.
            let short = cells.len() > 1 && cells.len() + 1 == layout.width;
            if short && headed(&cells) && has_row_names(section, layout) {
                cells.insert(0, String::new());
                self.shifted = true;
            }
            let quoted = short && line.trim_start().starts_with('"');
            let exact = is_comment || layout.delimiter.value == Delimiter::Spaces && !quoted;
            let is_source = is_comment && has_part(line, "://|www.|ftp.");
            if cells.len() < 2 || exact && cells.len() != layout.width || is_source {
                let unit_alone = self.take_unit_alone(number, &cells);
                // Rows that are named themselves go on above one of units, or one left empty.
                if unit_alone && keyed(layout, rows.clone()).next().is_some()
                    || cells.len() == 1 && is_row_key(&cells[0])
                {
                    continue;
                }
                self.take_joined(number, line);
                return;
            }
            let mut number = number;
            if is_row_key(&cells[0])
                && !names_row(&cells[0])
                && let Some(named) =
                    keyed(layout, rows.clone()).find(|(_, cells)| cells.len() > 1 && names_row(&cells[0]))
            {
                (number, cells) = named;
            }
            if is_key_and_value(layout, &cells) {
                return;
            }
            let is_below_names =
                || alike(&cells) && rows.clone().next().is_some_and(|row| has_names(layout, row.1, section));
            if self.units.is_empty() && (is_unit_row(&cells) || is_below_names()) {
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
            name_gain(&mut cells, layout);
            // Some programs name only the curves.
            if cells.len() + 1 == layout.width && !is_row_key(&cells[0]) && !headed(&cells) {
                cells.insert(0, String::new());
                self.shifted = true;
            }
            self.set_names(number, with_other_axis(cells, layout, rows.clone().next()));
            self.take_times(near, layout);
            if self.units.is_empty() && !is_comment {
                self.take_samples(rows.next(), rows.next().is_none() && self.comments.is_empty(), layout);
            }
            return;
        }
    }

    /// Takes the unit of the wavelengths from a line that has nothing else.
    fn take_unit_alone(&mut self, number: usize, cells: &[String]) -> bool {
        let unit_alone = cells.len() == 1 && self.units.is_empty() && is_unit(&cells[0]);
        if unit_alone {
            self.x_unit = header_terms::x_unit(&cells[0]).map(|unit| (number, unit));
            self.units_line = Some(number);
        }
        unit_alone
    }

    fn set_names(&mut self, number: usize, names: Vec<String>) {
        (self.names, self.line) = (names, Some(number));
        // Names of samples say less than a line above them.
        let above = self.earlier.filter(|_| self.mentioned.is_some_and(|(line, _)| line == number));
        self.mentioned = above.or(self.mentioned);
        self.measured = self.measured.map(|measured| measured.filter(|(line, _)| *line != number));
    }

    /// Takes the names of samples from the line above one that only says what was measured, `Wavelength (nm),%T,Wavelength (nm),%T`:
    /// each above its values, or above its wavelengths; also from above `X,Y,X,Y`, as digitizers of plots write.
    fn take_samples(&mut self, above: Option<&(usize, &str)>, first: bool, layout: &Layout) {
        // Cary WinUV says so of a spectrum without a name.
        let is_new =
            |line: &str| line.starts_with("Created as New Dataset") || line.starts_with("Erstellt als neuer Datensatz");
        let is_name = |line: &str| comment(line).is_none() && !is_new(line);
        let Some(&(number, line)) = above.filter(|(_, line)| is_name(line)) else { return };
        let cells = split(layout.dialect(), line);
        let is_axis = |column: usize| {
            let own = self.names.get(column).filter(|name| !name.is_empty());
            let is_axis = |name: &String| header_terms::names_axis(name) || header_terms::is_x(name);
            own.or(cells.get(column)).is_some_and(is_axis)
        };
        let columns: Vec<usize> =
            (0..self.names.len()).filter(|&column| is_axis(column) || !self.names[column].is_empty()).collect();
        let (axes, values): (Vec<usize>, Vec<usize>) = columns.into_iter().partition(|&column| is_axis(column));
        let is_statistic = |column: &&usize| uncertainty_terms::is_statistic(&self.names[**column]);
        let statistics = values.iter().filter(is_statistic).count();
        // Nor does one name of all.
        let alike = values.len() > 1 && values.iter().all(|&column| self.names[column] == self.names[values[0]]);
        let digitized = |name: &str| header_terms::is_x(&self.names[0]) && name.eq_ignore_ascii_case("y");
        let says_nothing = |name: &str| says_only_measure(name) || digitized(name);
        let measure = |column: &usize| alike || is_statistic(&column) || says_nothing(&self.names[*column]);
        if axes.is_empty() || values.is_empty() || !values.iter().all(measure) {
            self.take_groups(&cells, &values, layout);
            return;
        }
        let mut above: Vec<String> = vec![String::new(); self.names.len()];
        // Shimadzu names its only curve so; a code in the first line is a name, too.
        let in_code = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
        let is_code = |title: &&str| {
            first
                && title.chars().all(in_code)
                && [char::is_numeric, char::is_alphabetic].iter().all(|kind| title.contains(kind))
        };
        if let [title] = cells.as_slice()
            && let Some(name) = title.strip_suffix(" - RawData").or(Some(title.as_str()).filter(is_code))
            && let [column] = values.as_slice()
        {
            name.clone_into(&mut above[*column]);
        } else {
            let nameless = |column: usize| self.names.get(column).is_some_and(String::is_empty);
            // A name over both columns of a pair is that of the values.
            let is_twice = |column: usize| cells.get(column + 1) == cells.get(column);
            let is_own = |column: &usize| !(is_axis(*column) && (nameless(*column) || is_twice(*column)));
            let filled: Vec<usize> =
                (0..cells.len()).filter(|column| !cells[*column].is_empty()).filter(is_own).collect();
            let split = layout.dialect().cells(line).count();
            let names = filled.iter().all(|&column| layout.dialect().parse(&cells[column]) == Cell::Text);
            let over_axes = filled.first() == axes.first() && filled.iter().all(|column| axes.contains(column));
            let title = !first && (layout.width == 2 || split < layout.width);
            // A name over its mean and its uncertainty.
            let over_first = statistics > 1 && filled.first() == values.first();
            let over_values = over_first && filled.iter().all(|column| values.contains(column));
            // An instrument's number over the wavelengths.
            let numbered = alike && filled.first() == axes.first() && filled[1..] == values[..];
            if !names || title || split < 2 || !(over_axes || over_values || numbered || filled == values) {
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
        if let Some(axis) = cells.first().filter(|_| self.names[0].is_empty()) {
            axis.clone_into(&mut self.names[0]);
        }
        self.units_line = self.line.replace(number);
        self.units = vec![String::new(); self.names.len()];
        for (column, name) in above.into_iter().enumerate().filter(|(_, name)| !name.is_empty()) {
            let name = name.trim_end_matches(" - RawData");
            let own = std::mem::take(&mut self.names[column]);
            let uncertain = uncertainty_terms::term(unit_text::without_unit(&own), &own).is_some();
            self.names[column] = if uncertain { format!("{name} {own}") } else { name.to_owned() };
            self.units[column] = if uncertain || own.eq_ignore_ascii_case("y") { String::new() } else { own };
        }
    }

    /// Tells curves of one name apart by dates and times in rows above them.
    fn take_times(&mut self, near: &[(usize, &str)], layout: &Layout) {
        let alike = self.names.len() > 2 && self.names[1..].iter().all(|name| *name == self.names[1]);
        let rows = near.iter().map(|(_, line)| split(layout.dialect(), line));
        let is_time = |cells: &Vec<String>| is_one(&lower(&cells[0]), "date|time") && cells.len() == self.names.len();
        let rows: Vec<Vec<String>> = rows.filter(|cells| !cells.is_empty()).filter(is_time).collect();
        if !alike || rows.is_empty() {
            return;
        }
        let when = |column: usize| rows.iter().map(|cells| cells[column].as_str()).collect::<Vec<_>>().join(" ");
        let times: BTreeSet<String> = (1..self.names.len()).map(when).collect();
        if times.len() + 1 == self.names.len() {
            self.units = std::mem::take(&mut self.names);
            self.names = (0..self.units.len())
                .map(|column| if column == 0 { self.units[0].clone() } else { when(column) })
                .collect();
            self.units[0].clear();
        }
    }

    /// Completes names that repeat by those of groups above them, each above the first of its columns: `Subject 1,,,Subject 2`.
    fn take_groups(&mut self, above: &[String], values: &[usize], layout: &Layout) {
        let filled: Vec<usize> = (0..above.len()).filter(|&column| !above[column].is_empty()).collect();
        let are_names = filled.iter().all(|&column| layout.dialect().parse(&above[column]) == Cell::Text);
        let over_values = filled.first() == values.first() && filled.iter().all(|column| values.contains(column));
        let own: BTreeSet<&str> = values.iter().map(|&column| self.names[column].as_str()).collect();
        let are_names = are_names && own.iter().all(|name| layout.dialect().parse(name) == Cell::Text);
        if filled.len() < 2 || !are_names || !over_values || own.len() == values.len() {
            return;
        }
        let group = |column: usize| filled.iter().rev().find(|start| **start <= column).map(|start| &above[*start]);
        let full = |column: &usize| Some(format!("{} {}", group(*column)?, self.names[*column]));
        let names: Vec<String> = values.iter().filter_map(full).collect();
        if names.len() == values.len() && names.iter().collect::<BTreeSet<_>>().len() == names.len() {
            values.iter().zip(names).for_each(|(&column, name)| self.names[column] = name);
        }
    }

    /// Takes names or units of all columns from a line of `SeaBASS`: `/fields=wavelength,Es`.
    pub(super) fn take_fields(&mut self, number: usize, line: &str, layout: &Layout) -> Option<()> {
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

    pub(super) fn take_unit_cell(&mut self, number: usize, cells: &[String], layout: &Layout) {
        let chosen = layout.wavelength_column.map(|column| column.saturating_sub(1));
        let column = chosen.or_else(|| header_terms::axis(cells)).unwrap_or(0);
        if let Some(unit) = cells.get(column).and_then(|cell| header_terms::x_unit(cell)) {
            self.x_unit = Some((number, unit));
        }
    }
}

/// Joins `Wavelength, nm,R`, which lacks quotes.
fn join_unit(cells: &mut Vec<String>, layout: &Layout) {
    if cells.len() == layout.width + 1 && WavelengthUnit::from_symbol(cells[1].trim()).is_some() {
        let unit = cells.remove(1);
        cells[0] = format!("{} ({})", cells[0], unit.trim());
    }
}

/// Returns whether all columns behind the first, of at least two, have one head.
fn alike(cells: &[String]) -> bool {
    cells.len() > 2 && !cells[1].is_empty() && cells[1..].iter().all(|cell| *cell == cells[1])
}

/// Returns whether a line names each column otherwise, the first as wavelengths.
fn has_names(layout: &Layout, line: &str, section: Section<'_>) -> bool {
    let names = cells(layout, line, section);
    let told = names.iter().collect::<BTreeSet<_>>().len() == names.len();
    names.len() == layout.width && told && header_terms::names_axis(&names[0]) && !names.contains(&String::new())
}

/// Returns whether a line is a rule, or the key of a section such as `[LAMPDATA]`, between names and numbers.
fn is_rule(cells: &[String]) -> bool {
    match cells {
        [] => false,
        [key] => key.starts_with('[') && key.ends_with(']') && !is_unit(key),
        _ => cells.iter().all(|cell| cell.bytes().all(|byte| b"-_=:".contains(&byte))),
    }
}

/// The cells of a line above the numbers. Names of wavelengths and curves may be separated by other signs than these, and be one for
/// each column that is not empty in the first row.
fn cells(layout: &Layout, line: &str, section: Section<'_>) -> Vec<String> {
    let (line, is_comment) = comment(line).map_or((line, false), |line| (line, true));
    let cells = split(layout.dialect(), line);
    let blanks = layout.delimiter.value == Delimiter::Spaces;
    let other = cells.len() != layout.width || cells.first().is_some_and(|cell| cell.ends_with(','));
    if (is_comment || blanks)
        && let Some(names) = split_otherwise(layout, line).filter(|_| other)
    {
        return names;
    }
    if cells.len() >= layout.width && !blanks || is_comment {
        return cells;
    }
    let row = first_rows(section, layout).next().unwrap_or_default();
    let filled = layout.dialect().cells(row).take(layout.width).enumerate().filter(|(_, cell)| !cell.is_empty());
    let filled: Vec<usize> = filled.map(|(column, _)| column).collect();
    let others = [Delimiter::Tab, Delimiter::Semicolon, Delimiter::Comma, Delimiter::Spaces].into_iter();
    let others = others.filter(|delimiter| *delimiter != layout.delimiter.value);
    let mut others = others.map(|delimiter| split(Dialect { delimiter, ..layout.dialect() }, line));
    let fit = |names: &Vec<String>| [layout.width, filled.len()].contains(&names.len()) && names.len() > 1;
    let Some(names) = others.find(|names| fit(names) && header_terms::names_axis(&names[0])) else { return cells };
    if names.len() == layout.width {
        return names;
    }
    let mut cells = vec![String::new(); layout.width];
    filled.into_iter().zip(names).for_each(|(column, name)| cells[column] = name);
    cells
}

/// Names that tabs, commas or wide gaps separate above columns between blanks, or in a comment.
pub(super) fn split_otherwise(layout: &Layout, line: &str) -> Option<Vec<String>> {
    ["\t", ",", ";", "  "].iter().find_map(|sign| {
        let cells = line.split(sign).map(str::trim).filter(|cell| !cell.is_empty());
        let names: Vec<String> = cells.take(layout.width + 1).map(str::to_owned).collect();
        let worded = names.len() > 1 && names.iter().all(|name| name.contains(char::is_alphabetic));
        (worded && names.len() == layout.width && header_terms::names_axis(&names[0])).then_some(names)
    })
}

fn first_rows<'a>(section: Section<'a>, layout: &Layout) -> impl Iterator<Item = &'a str> {
    let rows = Lines::of(section).skip_while(|(number, _)| *number < layout.first_line);
    rows.filter(|(_, line)| !line.trim_ascii().is_empty() && comment(line).is_none()).map(|(_, line)| line)
}

/// Returns whether the first rows begin with a name or with their number, as R writes.
fn has_row_names(section: Section<'_>, layout: &Layout) -> bool {
    const LOOK: usize = 3;
    let rows = first_rows(section, layout).take(LOOK);
    let mut firsts = rows.map(|line| layout.dialect().cells(line).next().unwrap_or_default()).zip(1..);
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

/// Returns whether a cell says that the names of the curves stand beside it.
fn names_row(cell: &str) -> bool {
    is_one(lower(cell).trim().trim_end_matches(':'), "name|names|sample|sample name|label")
}

/// Returns whether a cell says what stands beside it: names, numbers or times of the curves.
fn is_row_key(cell: &str) -> bool {
    const KEYS: &str = "index|no|no.|nr|number|id|time|date|date/time|timestamp|gps";
    names_row(cell) || is_one(lower(cell).trim().trim_end_matches(':'), KEYS)
}

/// Rows that are named themselves.
fn keyed<'a>(
    layout: &Layout,
    rows: impl Iterator<Item = &'a (usize, &'a str)>,
) -> impl Iterator<Item = (usize, Vec<String>)> {
    let rows = rows.map(|(number, line)| (*number, split(layout.dialect(), line)));
    rows.take_while(|(_, cells)| cells.first().is_some_and(|cell| is_row_key(cell)))
}

/// Returns whether a line above two columns is a setting of the instrument, such as `LUX 695`, and no pair of names.
fn is_key_and_value(layout: &Layout, cells: &[String]) -> bool {
    if layout.width != 2 || cells.len() != 2 {
        return false;
    }
    let key = cells[0].to_ascii_lowercase();
    let numeric = matches!(layout.dialect().parse(&cells[1]), Cell::Number(_));
    let wavelength = layout.dialect().parse_label(&cells[1]).is_some();
    key.ends_with('=')
        || (wavelength && !header_terms::begins_with_wavelengths(&cells[0]))
        || ["xaxis", "yaxis", "x unit", "y unit"].iter().any(|start| key.starts_with(start))
        || (numeric && !header_terms::names_wavelengths(&cells[0]))
}

/// Returns whether a line above several curves gives a number of each, such as a chromaticity, and no names: names have no fractions.
/// Nor are numbers names that are more than the columns, such as those of a date.
fn is_measured(layout: &Layout, cells: &[String]) -> bool {
    let Some((key, values)) = cells.split_first().filter(|(key, _)| !key.is_empty()) else { return false };
    let number = |cell: &String| match layout.dialect().parse(cell) {
        Cell::Number(value) => Some(value),
        _ => None,
    };
    if cells.len() > layout.width && cells.iter().all(|cell| number(cell).is_some()) {
        return true;
    }
    let mut numbers = values.iter().map(number);
    layout.width > 2
        && !header_terms::names_wavelengths(key)
        && number(key).is_none()
        && numbers.all(|value| value.is_some())
        && values.iter().filter_map(number).any(|value| value.fract() != 0.0)
}

/// Names the last column of Optronic Laboratories' spectroradiometers, which is the exponent of the gain behind each value.
fn name_gain(cells: &mut Vec<String>, layout: &Layout) {
    if let ([key, name], 3) = (cells.as_slice(), layout.width)
        && key == "Line0"
    {
        *cells = vec![String::new(), name.clone(), "gain".to_owned()];
    }
}

/// The cells of a comment that marks each name as one.
fn unmarked(mut cells: Vec<String>, is_comment: bool) -> Vec<String> {
    for cell in cells.iter_mut().filter(|cell| is_comment && cell.len() > 1 && cell.starts_with('#')) {
        cell.remove(0);
    }
    cells
}

/// Cells that begin empty, with the name of an axis of other quantities than wavelengths that the row above begins with.
fn with_other_axis(mut cells: Vec<String>, layout: &Layout, above: Option<&(usize, &str)>) -> Vec<String> {
    let above =
        above.filter(|_| cells[0].is_empty()).and_then(|(_, line)| split(layout.dialect(), line).into_iter().next());
    if let Some(axis) = above.filter(|axis| wavelengths::names_other_axis(axis)) {
        cells[0] = axis;
    }
    cells
}

fn is_unit(cell: &str) -> bool {
    let bare = cell.trim_start_matches(['[', '(']).trim_end_matches([']', ')']);
    WavelengthUnit::from_symbol(bare).is_some() || header_terms::x_unit(bare) == Some(XUnit::Other)
}

fn is_unit_row(cells: &[String]) -> bool {
    // A name that begins so goes on in a bracket of its own: `[x] [transmittance in 1]`.
    let bracketed = cells.iter().filter(|cell| cell.starts_with(['[', '(']) && !cell.contains(" [")).count();
    let of_axis = is_unit(&cells[0]) || is_one(&cells[0], "s|ms|min|h") && !cells.iter().any(String::is_empty);
    bracketed * 2 >= cells.len() || (of_axis && cells[1..].iter().all(|cell| looks_like_unit(cell)))
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
            || unit_text::is_quotient(cell)
            || cell.starts_with("cm-1")
            || is_one(&cell.to_ascii_lowercase(), "a.u.|counts|1|-|dimensionless|unitless"))
}
