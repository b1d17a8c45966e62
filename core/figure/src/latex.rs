//! Tables as LaTeX, for the package `booktabs`.

use std::fmt::Write as _;

use super::number::{rounded, whole};
use super::table::{Cell, Table};

impl Table {
    /// The table as a LaTeX `table` of the package `booktabs`: texts to the left, numbers to the right with `±` and one standard
    /// uncertainty. Columns with the same value in all rows are part of the caption; those of uncertainties stand in the cells.
    pub fn to_latex(&self, title: &str) -> String {
        let columns: Vec<usize> = (0..self.columns.len()).collect();
        let (conditions, rest): (Vec<usize>, Vec<usize>) = columns.into_iter().partition(|&at| self.is_constant(at));
        let shown: Vec<usize> = rest.into_iter().filter(|&at| !self.is_uncertainty(at)).collect();
        let told = conditions.iter().map(|&at| format!("{}: {}.", self.columns[at].full_name(), self.words(0, at)));
        let caption = std::iter::once(format!("{title}.")).chain(told).collect::<Vec<_>>().join(" ");
        let is_text = |at: usize| (0..self.rows.len()).any(|row| self.cell(row, at).text().is_some());
        let align: String = shown.iter().map(|&at| if is_text(at) { 'l' } else { 'r' }).collect();
        let line = |cells: &mut dyn Iterator<Item = String>| {
            let cells: Vec<String> = cells.map(|cell| escaped(&cell)).collect();
            format!("{} \\\\\n", cells.join(" & "))
        };
        let mut out =
            format!("% Needs \\usepackage{{booktabs}}.\n\\begin{{table}}\n\\caption{{{}}}\n", escaped(&caption));
        let head = line(&mut shown.iter().map(|&at| self.columns[at].full_name()));
        let _ = write!(out, "\\begin{{tabular}}{{{align}}}\n\\toprule\n{head}\\midrule\n");
        for row in 0..self.rows.len() {
            out.push_str(&line(&mut shown.iter().map(|&at| self.words(row, at))));
        }
        out.push_str("\\bottomrule\n\\end{tabular}\n\\end{table}\n");
        out
    }

    /// True if a column holds one value in all of several rows.
    fn is_constant(&self, column: usize) -> bool {
        let first = self.cell(0, column);
        let is_known = first.text().is_some() || first.number().is_some();
        self.rows.len() > 1 && is_known && (1..self.rows.len()).all(|row| self.cell(row, column) == first)
    }

    /// True for a column of the uncertainties of another.
    fn is_uncertainty(&self, column: usize) -> bool {
        let of = self.columns[column].key.strip_suffix(" uncertainty");
        of.is_some_and(|of| self.columns.iter().any(|column| column.name == of))
    }

    fn words(&self, row: usize, column: usize) -> String {
        let cell = self.cell(row, column);
        match (cell.number(), self.columns[column].decimals) {
            (None, _) if *cell == Cell::Empty => String::new(),
            (Some(value), Some(decimals)) if cell.note().own_decimals().is_none() => rounded(value, whole(decimals)),
            _ => cell.in_words(),
        }
    }
}

/// Text with the characters that LaTeX reads as commands, and those that its fonts lack, as its own commands.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        let command = match c {
            '\\' => "\\textbackslash{}",
            '~' => "\\textasciitilde{}",
            '^' => "\\textasciicircum{}",
            'Δ' => "$\\Delta$",
            'Ψ' => "$\\Psi$",
            'σ' => "$\\sigma$",
            'τ' => "$\\tau$",
            'µ' | 'μ' => "$\\mu$",
            '′' => "$'$",
            '−' => "$-$",
            '±' => "$\\pm$",
            '×' => "$\\times$",
            '≥' => "$\\geq$",
            '≠' => "$\\neq$",
            '°' => "$^\\circ$",
            '†' => "$\\dagger$",
            '–' => "--",
            '…' => "\\ldots{}",
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                out.push('\\');
                out.push(c);
                continue;
            }
            _ => {
                out.push(c);
                continue;
            }
        };
        out.push_str(command);
    }
    out
}
