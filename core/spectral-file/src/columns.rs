//! Reads tables whose wavelengths run down a column.

pub(super) mod axes;

use crate::decision::{Decision, Delimiter, Dropped, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::Layout;
use crate::error::{MAX_CURVES, MAX_SAMPLES, ReadError, check_curves, check_samples};
use crate::grid::{Grid, RawCurve};
use crate::header::{self, Header};
use crate::no_curve::{FEWEST_ROWS, is_empty};
use crate::text::{Lines, Section, comment, excerpt, has_word, is_one, lower};
use crate::warning::{LineList, Warning};
use crate::watch::Log;
use crate::{header_terms, unit_text, wavelengths};

pub(super) struct Read {
    pub(super) grid: Grid,
    /// The line after it, if another table follows.
    pub(super) next: Option<usize>,
    pub(super) bytes: usize,
    pub(super) note: Option<Decision>,
}

/// Names of columns of notes.
const NOTES: &str = "note|notes|comment|comments|remark|remarks|feature|features|label|labels|description|\
    reference|reference text|details";

pub(super) fn read(section: Section<'_>, layout: &Layout, log: &mut Log<'_>) -> Result<Read, ReadError> {
    let header = header::read(section, layout);
    let chosen = layout.wavelength_column.map(|column| column.saturating_sub(1));
    let mut columns = Columns::new(layout, chosen.or_else(|| header_terms::axis(&header.names)));
    // A column with a name of its own holds no notes, unless that says so.
    let is_curve = |column: &usize| header.name(*column).is_some_and(|name| !is_one(&name.to_lowercase(), NOTES));
    let named = (0..128).filter(is_curve);
    columns.ended = section.text.ends_with(char::is_whitespace);
    columns.notes.gaps = named.fold(layout.gaps, |gaps, column| gaps & !(1 << column));
    let header_line = header.line.and_then(|names| Lines::of(section).find(|(number, _)| *number == names));
    let header_line = header_line.map(|(_, line)| line);
    let mut commented = LineList::default();
    let head = table_head(section, layout);
    let mut read = section.byte;
    for (number, line) in Lines::of(section).skip_while(|(number, _)| *number < layout.first_line) {
        read += line.len() + 1;
        log.work(line.len() + 1, read)?;
        if comment(line).is_some() {
            let again = head.is_some_and(|head| head != line && without_last_word(head) == without_last_word(line));
            if !again && columns.is_marked_row(line) {
                commented.add(number);
            } else {
                columns.comment = Some(again || columns.comment == Some(true));
            }
        } else if header_line.is_some_and(|header| header == line) {
            columns.take_header(number);
        } else if !line.trim_ascii().is_empty() {
            if columns.lines.is_empty() {
                columns.expected_rows = section.text.len() / (line.len() + 1) + 1;
            }
            columns.take(number, line)?;
            if columns.next.is_some() {
                columns.broken = None;
                break;
            }
        }
    }
    if let Some(broken) = columns.broken.take() {
        // A row that begins like a row is a row gone wrong; anything else is text below the table.
        if broken.first.is_some() {
            return Err(broken.error);
        }
        log.push(Warning::TextBelow(broken.line));
    }
    if !commented.is_empty() {
        log.push(Warning::CommentedRows(commented));
    }
    if !columns.repeated_headers.is_empty() {
        log.push(Warning::RepeatedHeader(std::mem::take(&mut columns.repeated_headers)));
    }
    let found = columns.finish(header, layout, log)?;
    Ok(Read { bytes: read - section.byte, ..found })
}

/// The comment above a table that names it as one of several.
pub(super) fn table_head<'a>(section: Section<'a>, layout: &Layout) -> Option<&'a str> {
    const ONE_OF: &str = "band|channel|filter|sample|spectrum|curve|table";
    let above = Lines::of(section).take_while(|(number, _)| *number < layout.first_line);
    let mut comments = above.filter(|(_, line)| comment(line).is_some());
    comments.find(|(_, line)| has_word(&lower(without_last_word(line)), ONE_OF)).map(|(_, line)| line)
}

fn without_last_word(text: &str) -> &str {
    text.trim_end().rsplit_once([' ', '\t']).map_or("", |(before, _)| before)
}

/// Steps of wavelengths within which a number goes on with them.
const NEAR_STEPS: f64 = 3.0;

struct Broken {
    line: usize,
    /// The number that it begins with.
    first: Option<f64>,
    has_numbers: bool,
    is_header: bool,
    /// Rows of numbers below it that do not fit this table.
    others: usize,
    error: ReadError,
}

#[derive(Default)]
struct Columns {
    dialect: Dialect,
    texts: Texts,
    notes: Notes,
    /// The most cells of a row, filled or not.
    most_cells: usize,
    /// Rows must have this many cells; a row with more must not have been preceded by one with fewer.
    width: usize,
    fewest_cells: usize,
    cells: Vec<Vec<f64>>,
    lines: Vec<usize>,
    /// True if a blank or a line end stands behind the last row, which is then not torn within a number.
    ended: bool,
    /// Rows that end before the last columns, as spreadsheets write them where only gaps would follow: each with its cells.
    short: Vec<(usize, usize)>,
    row: Vec<f64>,
    expected_rows: usize,
    named: Option<usize>,
    label_unit: Option<WavelengthUnit>,
    broken: Option<Broken>,
    repeated_headers: LineList,
    /// True if a comment since the last row is the head of the table but for its last word; `None` without a comment.
    comment: Option<bool>,
    /// The line after the last row, once another table is seen.
    next: Option<usize>,
}

enum Row {
    Blank,
    Numbers { cells: usize, filled: usize },
    Broken(Broken),
}

impl Columns {
    fn new(layout: &Layout, named: Option<usize>) -> Self {
        Self {
            dialect: layout.dialect(),
            texts: Texts::new(layout.texts),
            notes: Notes { width: layout.width, ..Notes::default() },
            width: layout.width,
            fewest_cells: usize::MAX,
            cells: vec![Vec::new(); layout.width.min(MAX_CURVES + 1)],
            named,
            ..Self::default()
        }
    }

    fn take(&mut self, number: usize, line: &str) -> Result<(), ReadError> {
        let row = self.parse(number, line);
        // Below a comment, wavelengths that start again are those of another table, and so are all below its head.
        if let (Row::Numbers { .. }, Some(headed)) = (&row, self.comment) {
            self.comment = None;
            if (headed || self.restarts()) && self.lines.len() >= FEWEST_ROWS {
                self.end(true);
                return Ok(());
            }
        }
        match row {
            Row::Blank => Ok(()),
            Row::Broken(broken) => {
                self.broken.get_or_insert(broken);
                Ok(())
            }
            Row::Numbers { cells, filled } => match self.broken.take() {
                None => self.push(number, cells, filled),
                // Numbers without a wavelength, below text: it goes on.
                Some(broken) if broken.first.is_none() && self.is_without_wavelength() => {
                    self.broken = Some(broken);
                    Ok(())
                }
                Some(mut broken) if cells != self.width && filled != self.width => {
                    broken.others += usize::from(cells > 1);
                    let second = broken.others > 1;
                    self.broken = Some(broken);
                    self.end(second);
                    Ok(())
                }
                Some(broken) if !broken.has_numbers && self.restarts() => {
                    self.end(true);
                    Ok(())
                }
                Some(broken) if broken.is_header => {
                    self.repeated_headers.add(broken.line);
                    self.push(number, cells, filled)
                }
                Some(broken) => Err(broken.error),
            },
        }
    }

    /// Takes the line of names, which some programs print again on every page.
    fn take_header(&mut self, line: usize) {
        let error = ReadError::NotANumber { line, column: 1, text: String::new() };
        let nothing = Broken { line, first: None, has_numbers: false, is_header: true, others: 0, error };
        let broken = self.broken.get_or_insert(nothing);
        // What stands between a table and the same names is the title of another, unless it goes on as a row of this one.
        let goes_on = |next: f64| match self.cells.first().map(Vec::as_slice) {
            Some([.., before, last]) => (next - last).abs() <= NEAR_STEPS * (last - before).abs(),
            _ => true,
        };
        broken.has_numbers &= broken.first.is_some_and(goes_on);
    }

    /// Returns whether a comment is a row that was commented out, or one that begins with `#` for another reason.
    fn is_marked_row(&self, line: &str) -> bool {
        let cells = self.dialect.cells(line.trim_start().trim_start_matches('#')).take(MAX_CURVES + 2);
        let (mut count, mut numbers) = (0, 0);
        for cell in cells {
            count += 1;
            numbers += usize::from(matches!(self.dialect.parse(cell), Cell::Number(_)));
        }
        count == self.width && numbers > 0
    }

    fn end(&mut self, second: bool) {
        self.next = self.lines.last().filter(|_| second).map(|line| line + 1);
    }

    fn parse(&mut self, number: usize, line: &str) -> Row {
        self.row.clear();
        let (mut cells, mut filled, mut numbers) = (0, 0, 0);
        let mut noted = None;
        for cell in self.dialect.cells(line).take(MAX_CURVES + 2) {
            let value = match self.dialect.parse(cell) {
                _ if self.texts.contains(cells) => self.texts.take(cells, self.dialect, cell),
                Cell::Number(value) => value,
                Cell::Gap => f64::NAN,
                Cell::Text => match self.dialect.parse_label(cell).filter(|_| cells == self.named.unwrap_or(0)) {
                    Some((value, unit)) if self.label_unit.is_none_or(|known| known == unit) => {
                        self.label_unit = Some(unit);
                        value
                    }
                    _ if self.notes.may_stand(cells, self.lines.len(), self.dialect) => {
                        noted = noted.or(Some((cells, cell)));
                        f64::NAN
                    }
                    _ => return Row::Broken(self.broken(number, line, cells, cell)),
                },
            };
            cells += 1;
            numbers += usize::from(!value.is_nan());
            filled = if cell.is_empty() { filled } else { cells };
            self.row.push(value);
        }
        if let Some((column, cell)) = noted {
            if numbers < 2 {
                return Row::Broken(self.broken(number, line, column, cell));
            }
            self.row.truncate(self.notes.width);
            (cells, filled) = (self.row.len(), filled.min(self.row.len()));
            self.notes.rows += 1;
            self.notes.first = Some(self.notes.first.map_or(column, |first| first.min(column)));
        }
        if numbers == 0 { Row::Blank } else { Row::Numbers { cells, filled } }
    }

    fn broken(&self, line: usize, text: &str, column: usize, cell: &str) -> Broken {
        let error = ReadError::NotANumber { line, column: column + 1, text: excerpt(cell) };
        let mut cells = self.dialect.cells(text).take(MAX_CURVES + 2);
        let first = self.row.first().copied().filter(|value| !value.is_nan());
        let has_numbers = cells.any(|cell| matches!(self.dialect.parse(cell), Cell::Number(_)));
        Broken { line, first, has_numbers, is_header: false, others: 0, error }
    }

    /// Returns whether the row just parsed goes back over wavelengths that were there before.
    fn restarts(&self) -> bool {
        let wavelengths = &self.cells[self.named.unwrap_or(0).min(self.cells.len() - 1)];
        let (Some(&first), Some(&last)) = (wavelengths.first(), wavelengths.last()) else { return false };
        self.row.get(self.named.unwrap_or(0)).is_some_and(|&value| (value - last) * (last - first) <= 0.0)
    }

    fn is_without_wavelength(&self) -> bool {
        self.row.get(self.named.unwrap_or(0)).is_none_or(|value| value.is_nan())
    }

    fn push(&mut self, number: usize, cells: usize, filled: usize) -> Result<(), ReadError> {
        let rows = self.lines.len();
        if filled > self.width {
            if rows > 0 && self.fewest_cells < filled {
                return Err(ReadError::UnevenRow { line: number, found: filled, expected: self.width });
            }
            self.width = filled;
        }
        if cells < self.width {
            if rows == 0 || cells < 2 || self.dialect.delimiter == Delimiter::Spaces {
                return Err(ReadError::UnevenRow { line: number, found: cells, expected: self.width });
            }
            self.short.push((rows, cells));
            self.row.resize(self.width, f64::NAN);
        }
        check_curves(self.width - 1, number)?;
        check_samples((rows + 1) * (self.width - 1), number)?;
        if rows == 0 {
            self.reserve();
        }
        while self.cells.len() < self.width {
            self.cells.push(vec![f64::NAN; rows]);
        }
        self.fewest_cells = self.fewest_cells.min(cells);
        self.most_cells = self.most_cells.max(cells);
        for (column, value) in self.cells.iter_mut().zip(&self.row) {
            column.push(*value);
        }
        self.lines.push(number);
        Ok(())
    }

    /// Refuses short rows that may be torn: all but those at the end of the table, each as short as the one before or shorter, and
    /// runs beside a row with a gap, as where columns of several wavelengths are merged.
    fn check_short(&self, at: usize) -> Result<(), ReadError> {
        const MERGED: usize = 3;
        let rows = self.lines.len();
        let short = &self.short[..self.short.partition_point(|(row, _)| *row < rows)];
        let nm = |row: usize| self.cells[at][row];
        let gap = |row: usize| row < rows && self.cells.iter().any(|column| column[row].is_nan());
        let sound = |run: &[(usize, usize)]| {
            let (first, last) = (run[0].0, run[run.len() - 1].0);
            let ordered = |(row, cells): &(usize, usize)| {
                (nm(*row) - nm(row - 1)) * (nm(rows - 1) - nm(0)) > 0.0 && *cells > at + 1
            };
            let ends =
                (run.len() > 1 || self.ended) && last + 1 == rows && run.windows(2).all(|pair| pair[1].1 <= pair[0].1);
            run.iter().all(ordered) && (ends || short.len() >= MERGED && (gap(first - 1) || gap(last + 1)))
        };
        match short.chunk_by(|a, b| a.0 + 1 == b.0).find(|run| !sound(run)) {
            Some(&[(row, found), ..]) => {
                Err(ReadError::UnevenRow { line: self.lines[row], found, expected: self.width })
            }
            _ => Ok(()),
        }
    }

    /// Makes room for the rows still to come if they are as long as the first.
    fn reserve(&mut self) {
        let rows = self.expected_rows.min(MAX_SAMPLES / self.width.max(1));
        for column in &mut self.cells {
            column.reserve_exact(rows);
        }
        self.lines.reserve_exact(rows);
    }

    fn finish(mut self, mut header: Header, layout: &Layout, log: &mut Log<'_>) -> Result<Read, ReadError> {
        let columns = self.cells.len();
        if let Some(column) = layout.wavelength_column
            && column.checked_sub(1).and_then(|at| self.cells.get(at)).is_none_or(|column| is_empty(column))
        {
            return Err(ReadError::NotWavelengthColumn { column, columns });
        }
        let surplus = has_surplus(&header, self.most_cells.max(self.width));
        let at = self.named.filter(|&at| at < columns && !surplus);
        let bare = header.names.is_empty() && header.units.is_empty() && !layout.every_column;
        let at = at.or_else(|| axes::after_count(&self.cells).filter(|_| bare));
        let at = at.or_else(|| self.cells.iter().position(|column| !is_empty(column))).unwrap_or(0);
        // Rows that go over the same wavelengths again are left to the next table.
        if let Some(rows) = wavelengths::second_pass(&self.cells[at]) {
            self.next = Some(self.lines[rows - 1] + 1);
            self.lines.truncate(rows);
            self.cells.iter_mut().for_each(|column| column.truncate(rows));
        }
        self.check_short(at)?;
        if let Some(column) = self.notes.first {
            let name = header.name(column).unwrap_or_default().to_owned();
            log.push(Warning::TextColumns { count: 1, column: column + 1, name });
        } else {
            let filled = self.cells.iter().rposition(|column| !is_empty(column)).map_or(0, |last| last + 1);
            warn_of_names(&header, [filled, columns], surplus, log);
            if surplus {
                header.names.truncate(at + 1);
                header.units.truncate(at + 1);
            }
        }
        let (next, rows, label_unit) = (self.next, self.lines.len(), self.label_unit);
        let values = self.cells.split_off(at + 1);
        let wavelengths = self.cells.pop().unwrap_or_default();
        if bare && values.len() > 1 && axes::may_count(&wavelengths, &values[0]) {
            log.push(Warning::MayCount([at + 1, at + 2]));
        }
        let find = || axes::find(&header, at, &wavelengths, &self.cells, &values);
        let is_told = layout.every_column || !header.own.is_empty();
        let axes = if is_told { axes::Axes::default() } else { find() };
        let texts = self.texts.columns.iter().filter(|text| text.other || text.unit.is_none()).map(|text| text.column);
        let texts: Vec<usize> = texts.filter(|&column| column < columns && column != at).collect();
        // Behind no others, the chosen wavelengths are those of the columns before them.
        let last = layout.wavelength_column.is_some() && values.iter().all(|values| is_empty(values));
        let is_left = |(column, values): &(usize, Vec<f64>)| {
            axes.more.is_empty()
                && !is_empty(values)
                && header.name(*column).map_or(last, |name| !header_terms::is_count(name))
        };
        let before = std::mem::take(&mut self.cells).into_iter().enumerate();
        let (left, skipped): (Vec<_>, Vec<_>) =
            before.filter(|(column, _)| !(texts.contains(column) || axes.left.contains(column))).partition(is_left);
        if skipped.iter().any(|(_, column)| !is_empty(column)) {
            log.push(Warning::SkippedColumns(at + 1));
        }
        axes.warn(&header, at, &wavelengths, &values, log);
        if let Some(&first) = texts.first() {
            let name = header.name(first).unwrap_or_default().to_owned();
            log.push(Warning::TextColumns { count: texts.len(), column: first + 1, name });
        }
        let (mut grid, note) = if axes.more.is_empty() {
            let is_curve = |column: &usize| !(texts.contains(column) || axes.left.contains(column));
            let after = (at + 1..).zip(values).filter(|(column, _)| is_curve(column));
            let all: Vec<_> = left.into_iter().chain(after).collect();
            let only = all.len() == 1;
            let curve = |(column, values)| self.texts.united(raw_curve(&header, column, only, values), column);
            let curves = all.into_iter().map(curve).collect();
            (Grid { wavelengths, lines: self.lines, curves, header, ..Grid::default() }, None)
        } else {
            axes::read_pairs(header, at, wavelengths, values, &axes, &self.lines, log)?
        };
        grid.label_unit = label_unit;
        grid.rows = rows;
        grid.wavelength_column = Some(at + 1);
        drop_without_wavelength(&mut grid, log);
        Ok(Read { grid, next, bytes: 0, note })
    }
}

fn raw_curve(header: &Header, column: usize, only: bool, values: Vec<f64>) -> RawCurve {
    let titles = ["title", "name", "sample", "sample name"].into_iter().filter(|_| only);
    let title = titles.filter_map(|key| header.comment(key)).find(|title| !title.is_empty());
    // What is measured names no sample, where there is only one.
    let named =
        header.name(column).map(unit_text::without_unit).filter(|name| !(only && header_terms::is_quantity(name)));
    let is_unit = |name: &str| name.starts_with('[') && name.ends_with(']') && unit_text::unit(name).is_some();
    let given = named.filter(|name| !(header_terms::is_sign(name) || is_unit(name))).or(title);
    let name = given.map_or_else(|| format!("Column {}", column + 1), str::to_owned);
    let (named, label, unit) = (given.is_some(), header.label(column), header.unit(column));
    RawCurve { name, named, column: Some(column + 1), origin: column, label, unit, values, ..RawCurve::default() }
}

/// Returns whether names are several too many for all rows: nothing says which column has which. Notes stand behind them, and
/// settings, `Bias (V):,0.5`.
fn has_surplus(header: &Header, width: usize) -> bool {
    let is_setting = |name: &str| name.ends_with(':') || name.parse::<f64>().is_ok();
    let surplus = header.names.iter().skip(width);
    surplus.filter(|name| !(is_one(&name.to_lowercase(), NOTES) || is_setting(name))).count() > 1
}

/// Warns where names are not one for each column: of too many, which are not used if they are a surplus, or of too few for the columns
/// up to the last that is filled.
fn warn_of_names(header: &Header, [filled, width]: [usize; 2], surplus: bool, log: &mut Log<'_>) {
    /// Columns behind the last name that are no doubt of the names before it.
    const FEW_UNNAMED: usize = 1;
    let count = header.names.len();
    if surplus || count > 1 && count + FEW_UNNAMED < filled {
        return log.push(Warning::NamesDiffer { names: count, columns: filled });
    }
    // A named column that is empty in every row is no column of the rows, but its absence is reported.
    let mut names = header.names.iter().enumerate().skip(width).filter(|(_, name)| !name.is_empty());
    if let Some((column, first)) = names.next() {
        let first = format!("“{first}” (column {})", column + 1);
        log.push(Warning::EmptyCurves { count: 1 + names.count(), first });
    }
}

fn drop_without_wavelength(grid: &mut Grid, log: &mut Log<'_>) {
    let marked: Vec<bool> = grid.wavelengths.iter().map(|value| value.is_nan()).collect();
    let mut list = LineList::default();
    // Numbers in order above curves without names, such as wavelengths of excitation, name them.
    let heads = || grid.curves.iter().map(|curve| curve.values.first().copied().unwrap_or(f64::NAN));
    let unnamed =
        marked.first() == Some(&true) && grid.curves.len() > 2 && !grid.curves.iter().any(|curve| curve.named);
    let are_names = unnamed && heads().is_sorted_by(|a, b| a < b);
    for curve in grid.curves.iter_mut().filter(|_| are_names) {
        (curve.name, curve.named) = (curve.values[0].to_string(), true);
    }
    for (index, _) in marked.iter().enumerate().filter(|(_, marked)| **marked) {
        if index > 0 || !are_names {
            list.add(grid.line(index));
        }
        grid.drop_row(grid.line(index), Dropped::NoWavelength);
    }
    if are_names || !list.is_empty() {
        grid.remove(&marked);
    }
    if !list.is_empty() {
        log.push(Warning::NoWavelength(list));
    }
}

/// Notes beside rows: texts in columns that are empty but for them, or right of the table beside its first rows.
#[derive(Debug, Default)]
struct Notes {
    gaps: u128,
    width: usize,
    rows: usize,
    /// The first column of notes in a row, over all rows.
    first: Option<usize>,
}

impl Notes {
    fn may_stand(&self, column: usize, row: usize, dialect: Dialect) -> bool {
        let beside = column >= self.width && row == self.rows && dialect.delimiter != Delimiter::Spaces;
        beside || column < 128 && self.gaps >> column & 1 == 1
    }
}

#[derive(Debug, Default)]
struct Texts {
    mask: u128,
    columns: Vec<Text>,
}

#[derive(Debug)]
struct Text {
    column: usize,
    /// The unit of all cells until now.
    unit: Option<String>,
    /// True if a cell was not a number with that unit.
    other: bool,
}

impl Texts {
    fn new(mask: u128) -> Self {
        let columns = (0..128).filter(|column| mask >> column & 1 == 1);
        Self { mask, columns: columns.map(|column| Text { column, unit: None, other: false }).collect() }
    }

    #[inline]
    fn contains(&self, column: usize) -> bool {
        column < 128 && self.mask >> column & 1 == 1
    }

    /// Processes a cell of such a column: its number, or NaN.
    fn take(&mut self, column: usize, dialect: Dialect, cell: &str) -> f64 {
        let Some(text) = self.columns.iter_mut().find(|text| text.column == column) else { return f64::NAN };
        if dialect.parse(cell) == Cell::Gap {
            return f64::NAN;
        }
        let Some((value, unit)) = dialect.parse_united(cell).filter(|_| !text.other) else {
            text.other = true;
            return f64::NAN;
        };
        text.other = text.unit.get_or_insert_with(|| unit.to_owned()) != unit;
        value
    }

    /// A curve with the unit that stands beside each of its values, where the header names none.
    fn united(&self, mut curve: RawCurve, column: usize) -> RawCurve {
        let text = self.columns.iter().find(|text| text.column == column && !text.other);
        if let Some(unit) = text.and_then(|text| text.unit.as_deref()).filter(|_| curve.unit.is_none()) {
            let before = if curve.label.is_empty() { "" } else { " " };
            curve.label = format!("{}{before}{unit}", curve.label);
            curve.unit = Some(unit.to_owned());
        }
        curve
    }
}
