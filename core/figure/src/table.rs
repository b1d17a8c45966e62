//! The numbers beside a figure.

use chromascope_text::cell;

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Cell {
    /// A number. One that is not finite is written as an empty cell.
    Number(f64),
    /// Text.
    Text(String),
    /// Nothing.
    #[default]
    Empty,
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

/// Named columns and rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Names of the columns with their units, such as `wavelength (nm)`.
    pub columns: Vec<String>,
    /// Rows. One shorter than the header is filled up with empty cells, one longer is cut.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub fn new(columns: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Appends a row.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        self.rows.push(row.into_iter().collect());
    }

    /// The table with columns at the end that hold the same text in every row, such as the conditions it was made under.
    #[must_use]
    pub fn with_constants(mut self, columns: &[(&str, String)]) -> Self {
        let width = self.columns.len();
        self.columns.extend(columns.iter().map(|(name, _)| (*name).to_owned()));
        for row in &mut self.rows {
            row.resize(width, Cell::Empty);
            row.extend(columns.iter().map(|(_, text)| Cell::Text(text.clone())));
        }
        self
    }

    /// The table as comma-separated values (RFC 4180, but with `\n`): a header line, then the rows. Numbers are
    /// written with as many digits as it takes to read the same double back, at most 17.
    pub fn to_csv(&self) -> String {
        self.delimited(',')
    }

    /// The table separated by tabs, for the clipboard.
    pub fn to_tsv(&self) -> String {
        self.delimited('\t')
    }

    fn delimited(&self, separator: char) -> String {
        let mut out = String::new();
        push_line(&mut out, self.columns.iter().map(|name| cell(name, separator)), separator);
        for row in &self.rows {
            let cells = (0..self.columns.len()).map(|i| match row.get(i) {
                Some(Cell::Number(value)) if value.is_finite() => number(*value),
                Some(Cell::Text(text)) => cell(text, separator),
                _ => String::new(),
            });
            push_line(&mut out, cells, separator);
        }
        out
    }
}

fn push_line(out: &mut String, cells: impl Iterator<Item = String>, separator: char) {
    for (i, cell) in cells.enumerate() {
        if i > 0 {
            out.push(separator);
        }
        out.push_str(&cell);
    }
    out.push('\n');
}

fn number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-5..1e15).contains(&magnitude) { format!("{value:e}") } else { format!("{value}") }
}
