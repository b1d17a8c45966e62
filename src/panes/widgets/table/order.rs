//! Visible rows and columns, and their order.

use chromascope_figure::{Cell, Column, Table};

use crate::view::TableLook;

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
    if let Some(sorting) = &look.sorting {
        sorting.sort(table, &mut order);
    }
    order
}

fn contains(row: &[Cell], words: &[String]) -> bool {
    words.iter().all(|word| row.iter().filter_map(Cell::text).any(|text| text.to_lowercase().contains(word.as_str())))
}
