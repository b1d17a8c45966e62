//! Role of the curves and scale of their values.
//!
//! `role` decides what the curves are: what the file says, else what its settings suggest, else what the numbers look like.
//! `values` decides for each curve what its numbers stand for, by the header, else by `evidence` of its own. `convert` makes plain
//! numbers of what is written, and `check` warns of what cannot be. Where nothing decides between scales that differ by a factor,
//! the decision is [`Certainty::Open`] and the numbers stay as written.

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
    let said = role::said(grid, options);
    let from_file = said.is_some();
    let found = said.unwrap_or_else(|| role::suggested(grid, &evidence));
    let role = Decided::or_chosen(options.role, || found);
    let (values, columns) = values::decide(grid, options, &role, from_file, &evidence, log);
    Scale { role, values, columns }
}
