//! Tables: typed columns, and cells with uncertainties and reasons, as aligned text, CSV and text for the clipboard.

use std::borrow::Borrow;

use chromascope_text::cell;

use crate::number::{aligned, behind, decimals_by, number, rounded, shortest, whole};

/// A column: how it is called in files and on screen, and how its cells are written.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Column {
    /// Name in files, with its unit, such as `temperature_k` or `time (s)`.
    pub key: String,
    /// Name on screen, without unit.
    pub name: String,
    /// Unit; empty for none.
    pub unit: String,
    /// Explanation under the pointer.
    pub hint: String,
    /// Heading over it in a menu of columns; empty for none.
    pub group: String,
    /// Decimals of its numbers; none for as many as the largest needs.
    pub decimals: Option<usize>,
    /// The largest number is the best: first where rows are sorted by it.
    pub largest_first: bool,
    /// Gray behind its numbers, darker for worse ones.
    pub shaded: bool,
    /// Hidden until the user shows it.
    pub starts_hidden: bool,
    /// Name in files of the column behind it with the uncertainties of its numbers; empty for none.
    pub uncertainty: String,
    /// Least width in characters of aligned text.
    pub width: usize,
}

impl Column {
    /// A quantity with its name in files, its name or symbol on screen, and its unit.
    pub fn quantity(key: impl Into<String>, name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { key: key.into(), name: name.into(), unit: unit.into(), ..Self::default() }
    }

    /// A quantity that files call `name (unit)`.
    pub fn in_unit(name: &str, unit: &str) -> Self {
        Self::quantity(format!("{name} ({unit})"), name, unit)
    }

    /// Name with unit, for screen readers and the pointer.
    pub fn full_name(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.unit) }
    }
}

impl From<&str> for Column {
    fn from(name: &str) -> Self {
        Self::quantity(name, name, "")
    }
}

impl From<String> for Column {
    fn from(name: String) -> Self {
        Self::quantity(name.clone(), name, "")
    }
}

impl From<&Self> for Column {
    fn from(column: &Self) -> Self {
        column.clone()
    }
}

/// By its name in files.
impl PartialEq<str> for Column {
    fn eq(&self, key: &str) -> bool {
        self.key == key
    }
}

/// A column together with its cell of a row `R`: a table of such rows has a column more for each entry of a list.
#[derive(Debug, Clone, Copy)]
pub struct Field<R: ?Sized> {
    /// Name in files.
    pub key: &'static str,
    /// Name on screen, without unit.
    pub name: &'static str,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Decimals of its numbers; none for as many as the largest needs.
    pub decimals: Option<usize>,
    /// The cell of a row.
    pub cell: fn(&R) -> Cell,
}

impl<R: ?Sized> Field<R> {
    /// A column with one name for files and screen.
    pub const fn new(key: &'static str, cell: fn(&R) -> Cell) -> Self {
        Self::quantity([key, key, ""], cell)
    }

    /// A quantity with its name in files, its name or symbol on screen, and its unit.
    pub const fn quantity([key, name, unit]: [&'static str; 3], cell: fn(&R) -> Cell) -> Self {
        Self { key, name, unit, decimals: None, cell }
    }
}

impl<R: ?Sized> From<&Field<R>> for Column {
    fn from(field: &Field<R>) -> Self {
        Self { decimals: field.decimals, ..Self::quantity(field.key, field.name, field.unit) }
    }
}

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Cell {
    /// A number. One that is not finite is written as an empty cell.
    Number(f64),
    /// Text.
    Text(String),
    /// Nothing, for a reason.
    Missing(String),
    /// A cell with more than its value.
    Noted(Box<(Cell, Note)>),
    /// Nothing.
    #[default]
    Empty,
}

/// What a cell is apart from its note.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CellValue<'a> {
    /// A number.
    Number(f64),
    /// Text.
    Text(&'a str),
    /// Nothing.
    Nothing,
}

/// What is known about a cell besides its value: uncertainty, appearance, explanation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Note {
    /// Standard uncertainty in the value's unit; the value ends where it ends.
    pub uncertainty: Option<f64>,
    /// The uncertainty is extrapolated: a dagger behind it.
    pub is_extrapolated: bool,
    /// Written in gray: a difference within the uncertainty.
    pub is_gray: bool,
    /// Decimals without an uncertainty, where the cell has others than its column.
    pub decimals: Option<usize>,
    /// Two colors in sRGB side by side in place of the text, which names them.
    pub swatch: Option<[[u8; 3]; 2]>,
    /// Words in place of the number, such as a range of ranks.
    pub words: Option<String>,
    /// Explanation under the pointer, such as the reason for a missing value.
    pub hint: String,
}

impl Note {
    const NONE: &'static Self = &Self {
        uncertainty: None,
        is_extrapolated: false,
        is_gray: false,
        decimals: None,
        swatch: None,
        words: None,
        hint: String::new(),
    };

    /// Decimals of the cell, where they are its own: of its uncertainty, else its own.
    pub fn own_decimals(&self) -> Option<i32> {
        self.uncertainty.and_then(decimals_by).or(self.decimals.map(whole))
    }

    /// The uncertainty as it is written behind the number: `± 0.12`.
    pub fn behind(&self) -> Option<String> {
        behind(self.uncertainty?, self.is_extrapolated)
    }
}

impl Cell {
    /// The cell with its note edited.
    #[must_use]
    pub fn with(self, edit: impl FnOnce(&mut Note)) -> Self {
        let mut noted = if let Self::Noted(noted) = self { noted } else { Box::new((self, Note::default())) };
        edit(&mut noted.1);
        Self::Noted(noted)
    }

    /// The value without a note.
    pub fn value(&self) -> CellValue<'_> {
        match self {
            Self::Number(value) => CellValue::Number(*value),
            Self::Text(text) => CellValue::Text(text),
            Self::Noted(noted) => noted.0.value(),
            Self::Missing(_) | Self::Empty => CellValue::Nothing,
        }
    }

    /// The note; an empty one for none.
    pub fn note(&self) -> &Note {
        if let Self::Noted(noted) = self { &noted.1 } else { Note::NONE }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        if let CellValue::Number(value) = self.value() { Some(value) } else { None }
    }

    /// The text, if it is one.
    pub fn text(&self) -> Option<&str> {
        if let CellValue::Text(text) = self.value() { Some(text) } else { None }
    }

    /// Text, or number with its uncertainty by its own decimals; a dash for nothing.
    pub fn in_words(&self) -> String {
        let note = self.note();
        let value = self.written(|value| note.own_decimals().map_or_else(|| number(value), |own| rounded(value, own)));
        note.behind().map_or(value.clone(), |behind| format!("{value} {behind}"))
    }

    /// Its words or text, its number as it is to be written, or a dash for nothing.
    fn written(&self, number: impl Fn(f64) -> String) -> String {
        match (&self.note().words, self.value()) {
            (Some(words), _) => words.clone(),
            (None, CellValue::Number(value)) => number(value),
            (None, CellValue::Text(text)) => text.to_owned(),
            (None, CellValue::Nothing) => "–".to_owned(),
        }
    }

    /// Explanation, or the reason that there is nothing; empty for none.
    pub fn hint(&self) -> &str {
        match self {
            Self::Missing(reason) => reason,
            Self::Noted(noted) if noted.1.hint.is_empty() => noted.0.hint(),
            cell => &cell.note().hint,
        }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Empty, Self::Number)
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// Columns and rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// Rows. One shorter than the header is filled up with empty cells, one longer is cut.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub fn new(columns: impl IntoIterator<Item = impl Into<Column>>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// A table of rows by their columns.
    pub fn of<R>(fields: &[Field<R>], rows: impl IntoIterator<Item = impl Borrow<R>>) -> Self {
        let row = |row| fields.iter().map(|field| (field.cell)(Borrow::borrow(&row))).collect();
        Self { columns: fields.iter().map(Into::into).collect(), rows: rows.into_iter().map(row).collect() }
    }

    /// Appends a row.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        self.rows.push(row.into_iter().collect());
    }

    /// Place of a column by its name in files.
    pub fn place(&self, key: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == key)
    }

    /// The cell of a row in a column; an empty one where the row is shorter.
    pub fn cell(&self, row: usize, column: usize) -> &Cell {
        self.rows.get(row).and_then(|row| row.get(column)).unwrap_or(&Cell::Empty)
    }

    /// Inserts a column with a cell for each row.
    pub fn insert(&mut self, place: usize, column: impl Into<Column>, cells: impl IntoIterator<Item = Cell>) {
        let width = self.columns.len();
        let mut cells = cells.into_iter();
        for row in &mut self.rows {
            row.resize(width, Cell::Empty);
            row.insert(place, cells.next().unwrap_or_default());
        }
        self.columns.insert(place, column.into());
    }

    /// The table with columns at the end that hold the same text in every row, such as the conditions it was made under.
    #[must_use]
    pub fn with_constants<C: Into<Column>>(mut self, constants: impl IntoIterator<Item = (C, String)>) -> Self {
        for (column, text) in constants {
            let cells = vec![Cell::Text(text); self.rows.len()];
            self.insert(self.columns.len(), column, cells);
        }
        self
    }

    /// These columns of these rows, in this order.
    #[must_use]
    pub fn part(&self, columns: &[usize], rows: &[usize]) -> Self {
        let row = |&row: &usize| columns.iter().map(|&column| self.cell(row, column).clone()).collect();
        let heads = columns.iter().map(|&column| self.columns[column].clone());
        Self { columns: heads.collect(), rows: rows.iter().map(row).collect() }
    }

    /// Names in files of all columns, those with uncertainties among them.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        let keys = self.columns.iter().flat_map(|column| [column.key.as_str(), &column.uncertainty]);
        keys.enumerate().filter(|(at, key)| at % 2 == 0 || !key.is_empty()).map(|(_, key)| key)
    }

    /// Values of a row under [`Table::keys`].
    pub fn values(&self, row: usize) -> impl Iterator<Item = CellValue<'_>> {
        self.columns.iter().enumerate().flat_map(move |(place, column)| {
            let cell = self.cell(row, place);
            let by = cell.note().uncertainty.map_or(CellValue::Nothing, CellValue::Number);
            std::iter::once(cell.value()).chain((!column.uncertainty.is_empty()).then_some(by))
        })
    }

    /// The table as comma-separated values (RFC 4180, but with `\n`): a header line, then the rows. Numbers are
    /// written with as many digits as it takes to read the same double back, at most 17.
    pub fn to_csv(&self) -> String {
        self.csv(shortest)
    }

    /// The table as comma-separated values with numbers as they are to be written.
    pub fn csv(&self, number: fn(f64) -> String) -> String {
        self.head(',') + &self.body(',', number)
    }

    /// The table separated by tabs, for the clipboard.
    pub fn to_tsv(&self) -> String {
        self.head('\t') + &self.body('\t', shortest)
    }

    /// The header line of the table in cells between separators.
    pub fn head(&self, separator: char) -> String {
        line(self.keys().map(|key| cell(key, separator)), separator)
    }

    /// The rows of the table in cells between separators, with numbers as they are to be written.
    pub fn body(&self, separator: char, number: fn(f64) -> String) -> String {
        let written = |value: CellValue<'_>| match value {
            CellValue::Number(value) if value.is_finite() => number(value),
            CellValue::Text(text) => cell(text, separator),
            _ => String::new(),
        };
        (0..self.rows.len()).map(|row| line(self.values(row).map(written), separator)).collect()
    }

    /// Aligned columns for reading: texts to the left; numbers to the right with decimal points and uncertainties below
    /// each other; a dash for nothing.
    pub fn to_text(&self) -> String {
        let length = |cell: &String| cell.chars().count();
        let columns: Vec<(bool, Vec<String>)> = (0..self.columns.len()).map(|place| self.aligned(place)).collect();
        let widths = self.columns.iter().zip(&columns);
        let widths: Vec<usize> =
            widths.map(|(column, (_, cells))| cells.iter().map(length).fold(column.width, usize::max)).collect();
        let mut text = String::new();
        for row in 0..=self.rows.len() {
            let start = text.len();
            for (width, (is_text, cells)) in widths.iter().zip(&columns) {
                let cell = &cells[row];
                let padding = " ".repeat(width.saturating_sub(length(cell)));
                let [left, right] = if *is_text { ["", &*padding] } else { [&*padding, ""] };
                text.extend([left, cell, right, "  "]);
            }
            text.truncate(start + text[start..].trim_end().len());
            text.push('\n');
        }
        text
    }

    /// Head and cells of a column as aligned text, and whether it is of texts.
    fn aligned(&self, place: usize) -> (bool, Vec<String>) {
        let column = &self.columns[place];
        let cells = || (0..self.rows.len()).map(|row| self.cell(row, place));
        let own = |cell: &Cell| cell.note().own_decimals().or(column.decimals.map(whole));
        let ends = cells().filter(|cell| cell.number().is_some()).filter_map(own).max().unwrap_or(0).max(0) as usize;
        let behind = |cell: &Cell| cell.note().behind().unwrap_or_default();
        let width = cells().map(|cell| behind(cell).chars().count()).max().unwrap_or(0);
        let written = |cell: &Cell| {
            let number = |value| own(cell).map_or_else(|| number(value), |own| aligned(value, own, ends));
            let value = cell.written(number);
            if column.uncertainty.is_empty() { value } else { format!("{value} {:width$}", behind(cell)) }
        };
        let head =
            if column.unit.is_empty() { column.name.clone() } else { format!("{} [{}]", column.name, column.unit) };
        let is_text = cells().any(|cell| cell.text().is_some());
        (is_text, std::iter::once(head).chain(cells().map(written)).collect())
    }
}

fn line(cells: impl Iterator<Item = String>, separator: char) -> String {
    let mut line = cells.enumerate().fold(String::new(), |mut line, (place, cell)| {
        if place > 0 {
            line.push(separator);
        }
        line.push_str(&cell);
        line
    });
    line.push('\n');
    line
}
