//! Role of the curves and scale of their values.
//!
//! `role` decides the role of the curves: as stated in the file, else as suggested by its settings, else by the numbers. `values`
//! decides for each curve the meaning of its numbers, by the header, else by its own `evidence`. `convert` converts them to plain
//! numbers, and `check` warns of invalid ones. If nothing decides between scales that differ by a factor, the decision is
//! [`Certainty::Open`] and the numbers stay as written.

mod camera;
mod check;
mod convert;
mod decision;
mod evidence;
mod role;
mod values;

pub(super) use camera::camera_columns;
pub(super) use check::warn;
pub(super) use convert::convert;

use crate::grid::Grid;
use crate::options::ReadOptions;
use crate::report::Decided;
use crate::scale::decision::Scale;
use crate::watch::Log;

/// Decides what the curves are and what the values of each stand for.
pub(super) fn decide(grid: &Grid, options: &ReadOptions, log: &mut Log<'_>) -> Scale {
    let evidence = evidence::Evidence::of(grid);
    let said = role::said(grid, options.values.filter(|_| options.role.is_none()));
    let from_file = said.is_some();
    let content = said.unwrap_or_else(|| role::suggested(grid, &evidence));
    let role = Decided::or_chosen(options.role, || content.clone());
    let (values, columns) = values::decide(grid, options, &role, from_file, &evidence, log);
    Scale { role, content, values, columns }
}
