//! Chromascope's window and command line, as a library for its tests.
//!
//! ```text
//! format  terminal  palette    text for display, standard error, colors of figures
//! atomic                       files written whole or not at all
//! document ─► action           the comparison and its conditions; its changes, and undo
//! results ─► jobs              answers, the only cache; computations in the background
//! catalog ─► scene             data sets; names become data, choices become queries
//! files  export                the document and the user's files; pictures and tables out
//! plot_item                    items of marks
//! render_service  profiler     pictures of meshes; run time against error
//! figures ─► report            answers become figures; the paper's figures and claims
//! cli                          the command line
//! theme  paint  workspaces     colors and sizes; figures on screen; arrangement of panes
//! view ─► command              the view state; requests of keys, menus and panes
//! panes                        show them, and request changes
//! app                          the window
//! ```
//!
//! Each module uses only modules before it (`tests/app/architecture.rs` has the order and holds it), and no circle of files is
//! larger than two.

#![allow(
    clippy::missing_errors_doc,
    reason = "each function returns one small error enum whose variants are documented"
)]
#![allow(missing_docs, reason = "what the name and type of a field say is not said again")]

pub mod action;
pub mod app;
pub mod atomic;
pub mod catalog;
pub mod cli;
pub mod command;
pub mod document;
pub mod export;
pub mod figures;
pub mod files;
mod format;
pub mod help;
pub mod jobs;
pub mod paint;
pub mod palette;
pub mod panes;
pub mod plot_item;
pub mod profiler;
pub mod render_service;
pub mod report;
pub mod results;
pub mod scene;
pub mod terminal;
pub mod theme;
pub mod view;
pub mod workspaces;
