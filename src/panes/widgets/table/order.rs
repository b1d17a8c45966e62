//! Visible rows and columns, and their order.

use std::cmp::Ordering;

use chromascope_figure::{Cell, CellValue, Column, Table};

use crate::view::{Sorting, TableLook};

/// Columns that are shown, the first always.
pub(super) fn columns(columns: &[Column], look: &TableLook) -> Vec<usize> {
    let is_shown = |(index, column): &(usize, &Column)| {
        *index == 0 || look.columns.get(&column.name).copied().unwrap_or(!column.starts_hidden)
    };
    columns.iter().enumerate().filter(is_shown).map(|(index, _)| index).collect()
}

/// Rows that contain the filter's words, sorted. Equal rows keep the order as given; empty cells come last.
pub(super) fn rows(table: &Table, look: &TableLook) -> Vec<usize> {
    let words: Vec<String> = look.filter.split_whitespace().map(str::to_lowercase).collect();
    let mut order: Vec<usize> = (0..table.rows.len()).filter(|&row| contains(&table.rows[row], &words)).collect();
    let by =
        |sorting: &Sorting| Some((table.columns.iter().position(|c| c.name == sorting.column)?, sorting.descending));
    if let Some((column, descending)) = look.sorting.as_ref().and_then(by) {
        order.sort_by(|&a, &b| compare(table.cell(a, column).value(), table.cell(b, column).value(), descending));
    }
    order
}

fn contains(row: &[Cell], words: &[String]) -> bool {
    words.iter().all(|word| row.iter().filter_map(Cell::text).any(|text| text.to_lowercase().contains(word.as_str())))
}

/// Numbers by value, before texts by letters, before nothing.
fn compare(a: CellValue<'_>, b: CellValue<'_>, descending: bool) -> Ordering {
    let turned = |order: Ordering| if descending { order.reverse() } else { order };
    let rank = |cell: CellValue<'_>| match cell {
        CellValue::Number(value) if !value.is_nan() => 0,
        CellValue::Text(_) => 1,
        _ => 2,
    };
    match (a, b) {
        (CellValue::Number(a), CellValue::Number(b)) if !a.is_nan() && !b.is_nan() => turned(a.total_cmp(&b)),
        (CellValue::Text(a), CellValue::Text(b)) => turned(a.to_lowercase().cmp(&b.to_lowercase())),
        _ => rank(a).cmp(&rank(b)),
    }
}
