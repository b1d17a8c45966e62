//! Reads tables whose wavelengths run across a header row: every row is a curve.

use std::collections::{BTreeMap, BTreeSet};

use crate::bands::Group;
use crate::decision::{Decided, Orientation, Part, Quantity, Role, Values};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::{Across, Layout};
use crate::error::{MAX_PARTS, ReadError, check_curves, check_samples};
use crate::grid::{Grid, RawCurve};
use crate::header::{self, Header};
use crate::text::{Lines, Section, comment, excerpt, has_word, is_one, listed};
use crate::warning::{LineList, Warning};
use crate::watch::Log;
use crate::{header_terms, no_curve, uncertainty_terms, unit_text};

/// The table, and the line of the next header of wavelengths.
pub(super) fn read(
    section: Section<'_>,
    layout: &Layout,
    log: &mut Log<'_>,
) -> Result<(Grid, Option<usize>), ReadError> {
    debug_assert_eq!(layout.orientation.value, Orientation::Across);
    let Some(across) = &layout.across else { return Err(ReadError::NoNumbers) };
    let mut lines = Lines::of(section).skip_while(|(number, _)| *number < across.line);
    let Some((_, header_line)) = lines.next() else { return Err(ReadError::NoNumbers) };
    let dialect = layout.dialect();
    let group = across.group();
    let heads = across.heads(dialect.cells(header_line));
    let leading = &heads[..group.start.min(heads.len())];
    let mut header = header::read(section, layout);
    let named_unit =
        leading.iter().filter(|cell| header_terms::names_wavelengths(cell)).find_map(|cell| header_terms::x_unit(cell));
    header.x_unit = named_unit.map(|unit| (across.line, unit)).or(header.x_unit);
    header.line = Some(across.line);
    header.clues.take(across.line, header_line);
    let mut rows = Rows::new(dialect, across, leading, suspects(dialect, &heads, across));
    let next = rows.take_all(lines, (header_line, section.byte), &mut header, log)?;
    rows.warn(&heads, log)?;
    header.mentioned = rows.mentioned.or(header.mentioned);
    let count = rows.curves.len();
    // What an underscore sets apart is a word.
    let unit = Some(&group.suffix).filter(|suffix| !suffix.starts_with('_'));
    for curve in &mut rows.curves {
        group.suffix.clone_into(&mut curve.label);
        curve.unit = unit.and_then(|unit| unit_text::unit_cell(unit)).or_else(|| header.unit.clone());
    }
    let parts = across.groups.iter().filter(|_| across.groups.len() > 1).map(|group| Part {
        line: across.first_row,
        name: group_name(dialect, &heads, group),
        curves: count,
        rows: count,
    });
    let mut parts: Vec<Part> = parts.take(MAX_PARTS).collect();
    let mut part = None;
    // Where columns are parts, only the first quantity of the rows can be read.
    let wanted = if parts.is_empty() { across.part } else { 0 };
    let kinds = settle_kinds(&mut rows.curves, &rows.labels, wanted, &mut header);
    rows.tell_apart(leading);
    if !kinds.is_empty() && !parts.is_empty() {
        log.push(Warning::MoreQuantities { taken: kinds[0].name.clone(), others: other_names(&kinds, 0) });
    } else if !kinds.is_empty() {
        let why = format!("The rows are of {} quantities", kinds.len());
        (parts, part) = (kinds, Some(Decided::guess(wanted + 1, why)));
    }
    let count = rows.curves.len();
    let mut grid = Grid {
        wavelengths: group.wavelengths.clone(),
        lines: vec![across.line],
        curves: rows.curves,
        header,
        label_unit: group.unit,
        rows: count,
        role: role_of(group),
        parts,
        part,
        ..Grid::default()
    };
    let bad: Vec<bool> = grid.wavelengths.iter().map(|wavelength| wavelength.is_nan()).collect();
    if bad.contains(&true) {
        grid.remove(&bad);
    }
    Ok((grid, next))
}

/// The role that the names of the bands suggest.
fn role_of(group: &Group) -> Option<Decided<Role>> {
    let specular = header_terms::says_specular(&group.prefix).then_some(Role::Reflectance);
    let role = specular.or_else(|| header_terms::role_of_bands(&group.prefix));
    let role = role.or_else(|| header_terms::role_of_bands(&group.suffix).filter(|_| group.prefix.is_empty()));
    role.map(|role| Decided::guess(role, format!("The bands are named {}", group.prefix)))
}

/// The name of a group: what its wavelengths have in common, what stands before them, or its columns.
fn group_name(dialect: Dialect, heads: &[&str], group: &Group) -> String {
    let before =
        group.start.checked_sub(1).and_then(|at| heads.get(at)).filter(|cell| dialect.parse(cell) == Cell::Text);
    let suffix = group.suffix.trim_start_matches('_');
    match (group.prefix.as_str(), before) {
        (prefix, _) if !prefix.is_empty() && !suffix.is_empty() => format!("{prefix}_{suffix}"),
        ("", _) if !suffix.is_empty() => suffix.to_owned(),
        ("", Some(name)) if group.start > 1 => (*name).to_owned(),
        ("", _) => format!("columns {} to {}", group.start + 1, group.end()),
        (prefix, _) => prefix.to_owned(),
    }
}

/// Columns, from 0 and in order, at whose heads a wavelength should stand and none does.
fn suspects(dialect: Dialect, heads: &[&str], across: &Across) -> Vec<(usize, bool)> {
    let group = across.group();
    let next = across.groups.iter().map(|other| other.start).filter(|start| *start > group.start).min();
    let until = next.unwrap_or(heads.len()).min(heads.len());
    let from = if group.start > 1 { group.start - 1 } else { group.start };
    let is_bad = |at: &usize| {
        let wavelength = at.checked_sub(group.start).and_then(|at| group.wavelengths.get(at));
        let begun = heads[*at].starts_with(|c: char| c.is_ascii_digit());
        match wavelength {
            Some(wavelength) => wavelength.is_nan(),
            None => begun || dialect.parse(heads[*at]) == Cell::Gap,
        }
    };
    (from..until).filter(is_bad).map(|at| (at, false)).collect()
}

fn description(heads: &[&str], at: usize) -> String {
    if heads[at].is_empty() {
        format!("column {} (empty)", at + 1)
    } else {
        format!("column {} (“{}”)", at + 1, excerpt(heads[at]))
    }
}

/// Returns whether a cell below a head states the type or the use of its column, as Orange and `SCiO` write them: `continuous`, `float`.
fn names_type(cell: &str) -> bool {
    const TYPES: &str =
        "|c|d|s|t|i|continuous|discrete|string|text|time|class|meta|ignore|int|float|str|unicode|datetime|NoneType|GPS";
    is_one(cell, TYPES)
}

const NAMES: [&str; 7] = ["name", "sample", "label", "patch", "color", "tag", "id"];

/// Returns whether the head of a column has one of the words for names.
fn is_headed(head: &str, wanted: &str) -> bool {
    match wanted {
        // `humidity` and `voltage` hold them.
        "tag" | "id" => head.ends_with(wanted) || has_word(&head.replace('_', " "), wanted),
        _ => head.contains(wanted),
    }
}

/// The leading column that best names a row: one headed so, else the first.
pub(super) fn name_column(leading: &[&str]) -> usize {
    let headed = |wanted: &&str| leading.iter().position(|cell| is_headed(&cell.to_lowercase(), wanted));
    NAMES.iter().find_map(headed).unwrap_or(0)
}

pub(super) fn other_names(parts: &[Part], but: usize) -> String {
    let others = parts.iter().enumerate().filter(|(at, _)| *at != but);
    listed(&others.map(|(_, part)| format!("“{}”", part.name)).collect::<Vec<_>>())
}

struct Rows<'a> {
    dialect: Dialect,
    across: &'a Across,
    name_column: usize,
    /// The head of the column of the names, which tells what numbers there are: `octane`.
    property: Option<String>,
    curves: Vec<RawCurve>,
    gaps: usize,
    gap_lines: LineList,
    mentioned: Option<(usize, Role)>,
    /// A line that is no row: its number, the error it makes if rows follow, and whether it is an error by itself.
    broken: Option<(usize, ReadError, bool)>,
    /// Columns without a wavelength at their heads, and whether they hold numbers.
    suspects: Vec<(usize, bool)>,
    /// Quantity of each curve, by a cell before its values, and the column of those cells.
    labels: Vec<Option<Label>>,
    kind_column: Option<usize>,
    /// Rows that hold no spectrum but another scale, in words.
    scales: Vec<String>,
    /// The lines of the curves by their numbers.
    lines: BTreeMap<usize, &'a str>,
}

impl<'a> Rows<'a> {
    fn new(dialect: Dialect, across: &'a Across, leading: &[&str], suspects: Vec<(usize, bool)>) -> Self {
        let name_column = name_column(leading);
        let is_property = |head: &&&str| {
            head.contains(char::is_alphabetic)
                && !NAMES.iter().any(|name| is_headed(&head.to_lowercase(), name))
                && !(header_terms::is_count(head)
                    || header_terms::is_label(head)
                    || header_terms::names_wavelengths(head))
        };
        let property = leading.get(name_column).filter(is_property).map(|head| excerpt(head));
        Self {
            property,
            suspects,
            labels: Vec::new(),
            kind_column: kind_column(leading),
            scales: Vec::new(),
            lines: BTreeMap::new(),
            dialect,
            across,
            name_column,
            curves: Vec::new(),
            gaps: 0,
            gap_lines: LineList::default(),
            mentioned: None,
            broken: None,
        }
    }

    /// Takes the rows, up to the next header of wavelengths; returns its line.
    fn take_all(
        &mut self,
        lines: impl Iterator<Item = (usize, &'a str)>,
        (header_line, start): (&str, usize),
        header: &mut Header,
        log: &mut Log<'_>,
    ) -> Result<Option<usize>, ReadError> {
        let group = self.across.group();
        let mut read = start;
        for (number, line) in lines {
            read += line.len() + 1;
            log.at(read)?;
            // Names of samples may begin with `#` too.
            let is_row = || comment(line).is_none() || self.parse(number, line).is_ok_and(|row| row.is_some());
            let is_types = || self.curves.is_empty() && self.dialect.cells(line).all(names_type);
            // Units and the end of the header in `SeaBASS` files, whose names of columns are a line of it.
            if let Some(units) = line.strip_prefix('/').filter(|_| self.curves.is_empty()) {
                let unit = units.strip_prefix("units=").and_then(|units| self.dialect.cells(units).nth(group.start));
                header.unit = unit.and_then(unit_text::unit_cell).or(header.unit.take());
            } else if !line.trim_ascii().is_empty() && line != header_line && is_row() && !is_types() {
                match group.is_like(self.dialect, line) {
                    true if self.curves.is_empty() => log.push(Warning::OtherHeader(number)),
                    true => return Ok(Some(number)),
                    false => self.take(number, line)?,
                }
            }
        }
        Ok(None)
    }

    /// Reports omitted lines; a line among the rows that is none is an error.
    fn warn(&mut self, heads: &[&str], log: &mut Log<'_>) -> Result<(), ReadError> {
        if let Some((line, error, is_row)) = self.broken.take() {
            if is_row {
                return Err(error);
            }
            log.push(Warning::TextBelow(line));
        }
        if self.gaps > 0 {
            let lines = std::mem::take(&mut self.gap_lines);
            log.push(Warning::Gaps { cells: self.gaps, lines, sentinel: None });
        }
        if !self.scales.is_empty() {
            log.push(Warning::OtherAxes { named: listed(&self.scales), wavelength_column: None });
        }
        let filled = self.suspects.iter().filter(|(_, filled)| *filled);
        let named: Vec<String> = filled.map(|(at, _)| description(heads, *at)).collect();
        if !named.is_empty() {
            log.push(Warning::BadWavelengths { line: self.across.line, named: listed(&named) });
        }
        Ok(())
    }

    /// Completes names that several rows have by the first column that tells these apart; what counts the rows comes last.
    fn tell_apart(&mut self, leading: &[&str]) {
        let mut rows: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (index, curve) in self.curves.iter().enumerate().filter(|(_, curve)| curve.named) {
            rows.entry(&curve.name).or_default().push(index);
        }
        rows.retain(|_, rows| rows.len() > 1);
        if rows.keys().any(|name| uncertainty_terms::term(name, name).is_some()) {
            return;
        }
        let cell = |row: usize, column: usize| {
            self.dialect.cells(self.lines[&self.curves[row].origin]).nth(column).unwrap_or_default()
        };
        let tells = |column: &usize| {
            rows.values().all(|rows| {
                let cells: BTreeSet<&str> = rows.iter().map(|row| cell(*row, *column)).collect();
                cells.len() == rows.len() && !cells.contains("")
            })
        };
        let columns = (0..leading.len()).partition::<Vec<_>, _>(|column| !header_terms::is_count(leading[*column]));
        let Some(column) = columns.0.into_iter().chain(columns.1).find(tells) else { return };
        let told = |row: usize| (row, format!("{} ({})", self.curves[row].name, cell(row, column)));
        for (row, name) in rows.values().flatten().map(|row| told(*row)).collect::<Vec<_>>() {
            self.curves[row].name = name;
        }
    }

    fn take(&mut self, number: usize, line: &'a str) -> Result<(), ReadError> {
        match self.parse(number, line) {
            Err((error, is_row)) => {
                self.broken.get_or_insert((number, error, is_row));
                Ok(())
            }
            Ok(None) => Ok(()),
            Ok(Some(mut curve)) => {
                if let Some((_, error, _)) = self.broken.take() {
                    return Err(error);
                }
                let leading = || self.dialect.cells(line).take(self.across.group().start);
                if no_curve::is_scale_row(leading(), &self.across.group().wavelengths, &curve) {
                    self.scales.push(format!("line {number} (“{}”)", excerpt(&curve.name)));
                    return Ok(());
                }
                // `leaf, sd, …` below `leaf, mean, …`.
                let is_other = |cell: &&str| *cell != curve.name && uncertainty_terms::term(cell, cell).is_some();
                if let Some(cell) = leading().find(is_other).filter(|_| curve.named) {
                    curve.name = format!("{} {cell}", curve.name);
                }
                let specular = |cell: &str| header_terms::says_specular(cell).then_some(Role::Reflectance);
                let role = leading().find_map(|cell| header_terms::role(cell).or_else(|| specular(cell)));
                let role = role.map(|role| (number, role));
                let label = match self.kind_column {
                    Some(column) => leading().nth(column).map(|cell| Label::of(cell, number)),
                    None => leading().map(|cell| Label::of(cell, number)).find(Label::is_said),
                };
                self.mentioned = self.mentioned.or(role);
                self.lines.insert(number, line);
                self.labels.push(label);
                if !self.suspects.is_empty() {
                    self.look_at_suspects(line, &curve.name);
                }
                self.push(number, curve)
            }
        }
    }

    /// A row as a curve; `None` for a row of empty cells; an error, and whether the line looks like a row at all.
    fn parse(&self, number: usize, line: &str) -> Result<Option<RawCurve>, (ReadError, bool)> {
        let Group { start, wavelengths, .. } = self.across.group();
        let (start, width) = (*start, self.across.group().end());
        let mut values = Vec::with_capacity(wavelengths.len());
        let (mut cells, mut filled) = (0, 0);
        let mut names: (&str, &str) = ("", "");
        for cell in self.dialect.cells(line) {
            if cells < start {
                names.0 = if cells == self.name_column { cell } else { names.0 };
                names.1 = if names.1.is_empty() { cell } else { names.1 };
            } else if cells < width {
                values.push(match self.dialect.parse(cell) {
                    _ if wavelengths[cells - start].is_nan() => f64::NAN,
                    Cell::Number(value) => value,
                    Cell::Gap => f64::NAN,
                    Cell::Text => {
                        let error = ReadError::NotANumber { line: number, column: cells + 1, text: excerpt(cell) };
                        let is_row =
                            values.iter().any(|value: &f64| !value.is_nan()) || cells == start && self.is_long(line);
                        return Err((error, is_row));
                    }
                });
            }
            cells += 1;
            filled = if cell.is_empty() { filled } else { cells };
        }
        if filled == 0 {
            return Ok(None);
        }
        if cells < width || filled > self.across.cells {
            let found = if cells < width { cells } else { filled };
            let error = ReadError::UnevenRow { line: number, found, expected: width };
            return Err((error, values.iter().any(|value| !value.is_nan())));
        }
        let name = if names.0.is_empty() { names.1 } else { names.0 };
        let named = !name.is_empty();
        let count = self.curves.len() + 1;
        let name = match self.property.as_ref().filter(|_| name.contains(['.', ','])) {
            Some(property) if matches!(self.dialect.parse(name), Cell::Number(_)) => format!("{property} {name}"),
            _ if named => name.replace("\"\"", "\""),
            _ => format!("Row {count}"),
        };
        Ok(Some(RawCurve { name, named, values, origin: number, ..RawCurve::default() }))
    }

    fn is_long(&self, line: &str) -> bool {
        let width = self.across.group().end();
        self.dialect.cells(line).take(width).count() == width
    }

    /// Looks for numbers in the suspects of a row, but for its name.
    fn look_at_suspects(&mut self, line: &str, name: &str) {
        for (column, cell) in self.dialect.cells(line).enumerate().filter(|(_, cell)| *cell != name) {
            if let Ok(at) = self.suspects.binary_search_by_key(&column, |(column, _)| *column) {
                self.suspects[at].1 |= matches!(self.dialect.parse(cell), Cell::Number(_));
            }
        }
    }

    fn push(&mut self, number: usize, curve: RawCurve) -> Result<(), ReadError> {
        let wavelengths = &self.across.group().wavelengths;
        let at = wavelengths.iter().zip(&curve.values).filter(|(wavelength, _)| !wavelength.is_nan());
        let missing = at.filter(|(_, value)| value.is_nan()).count();
        if missing > 0 {
            self.gaps += missing;
            self.gap_lines.add(number);
        }
        check_curves(self.curves.len() + 1, number)?;
        check_samples((self.curves.len() + 1) * wavelengths.len(), number)?;
        self.curves.push(curve);
        Ok(())
    }
}

#[derive(Debug, Clone, PartialEq)]
struct Label {
    text: String,
    line: usize,
    quantity: Option<Quantity>,
    /// True if it is an absorbance, which is no quantity of its own.
    absorbance: bool,
}

impl Label {
    fn of(cell: &str, line: usize) -> Self {
        let alone = !cell.trim().contains(|c: char| !c.is_alphabetic());
        let absorbance = alone && header_terms::values(cell) == Some(Values::Absorbance);
        let quantity = header_terms::quantity(cell).filter(|_| alone && !absorbance);
        Self { text: excerpt(cell), line, quantity, absorbance }
    }

    fn is_said(&self) -> bool {
        self.quantity.is_some() || self.absorbance
    }

    fn goes_with(&self, other: &Self) -> bool {
        (self.quantity, self.absorbance) == (other.quantity, other.absorbance)
    }

    fn tell(&self, header: &mut Header) {
        header.mentioned = None;
        header.role = self.quantity.and_then(Quantity::role).map(|role| (self.line, role)).or(header.role);
        header.quantity = self.quantity.map(|quantity| (self.line, quantity)).or(header.quantity);
        header.values = self.absorbance.then_some((self.line, Values::Absorbance)).or(header.values);
    }
}

/// The column before the values with the kind of each row, if its header says so.
fn kind_column(leading: &[&str]) -> Option<usize> {
    const HEADS: [&str; 8] =
        ["mode", "technique", "quantity", "measurement", "measurement type", "measurement mode", "data type", "type"];
    leading.iter().position(|head| HEADS.iter().any(|wanted| head.trim().eq_ignore_ascii_case(wanted)))
}

/// Selects the rows of one quantity if there are several: the first, or the requested one. Returns all as parts.
fn settle_kinds(curves: &mut Vec<RawCurve>, labels: &[Option<Label>], wanted: usize, header: &mut Header) -> Vec<Part> {
    let Some(labels) = labels.iter().cloned().collect::<Option<Vec<Label>>>() else { return Vec::new() };
    if !labels.iter().any(Label::is_said) || labels.len() != curves.len() {
        return Vec::new();
    }
    let mut kinds: Vec<(&Label, usize)> = Vec::new();
    for label in &labels {
        match kinds.iter_mut().find(|(kind, _)| kind.goes_with(label)) {
            Some((_, count)) => *count += 1,
            None => kinds.push((label, 1)),
        }
    }
    let taken = kinds.get(wanted).map_or(kinds[0].0, |(label, _)| label);
    taken.tell(header);
    if kinds.len() < 2 {
        return Vec::new();
    }
    let mut rows = labels.iter();
    curves.retain(|_| rows.next().is_none_or(|label| label.goes_with(taken)));
    let part = |(label, count): &(&Label, usize)| Part {
        line: label.line,
        name: label.text.clone(),
        curves: *count,
        rows: *count,
    };
    kinds.iter().map(part).collect()
}
