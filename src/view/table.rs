//! View settings of tables: order, columns, filter.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use crate::figures::look::Sorting;
use crate::plot_item::PlotItem;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct TableLook {
    /// Column that rows are sorted by; none for the order as given.
    pub sorting: Option<Sorting>,
    /// Columns that the user shows or hides, by name; others keep the table's default.
    pub columns: BTreeMap<String, bool>,
    /// Words that a row must contain. Not saved between runs.
    #[serde(skip)]
    pub filter: String,
    /// Row with the keyboard cursor where rows have no items, in the given order.
    #[serde(skip)]
    pub cursor: Option<usize>,
    /// Selection that the table was scrolled to.
    #[serde(skip)]
    pub seen: Option<PlotItem>,
}

impl TableLook {
    /// Sorts by a column that was clicked: in its preferred direction, then in the other, then as given.
    pub fn sort_by(&mut self, column: &str, largest_first: bool) {
        self.sorting = match self.sorting.take() {
            Some(now) if now.column == column && now.descending == largest_first => {
                Some(Sorting { descending: !largest_first, ..now })
            }
            Some(now) if now.column == column => None,
            _ => Some(Sorting { column: column.to_owned(), descending: largest_first }),
        };
    }
}
