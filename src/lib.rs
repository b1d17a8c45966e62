//! Chromascope's window and command line, as a library for its tests.
//!
//! ```text
//! format  terminal  theme      text for display, standard error, colors and sizes
//! document ─► action           the comparison and its conditions; its changes, and undo
//! results ─► jobs              answers, the only cache; computations in the background
//! catalog ─► scene             data sets; names become data, choices become queries
//! files  export                the document and the user's files; pictures and tables out
//! plot_item  paint  workspaces items of marks; figures on screen; arrangement of panes
//! render_service  bench  profiler   pictures of meshes; run time against error
//! view ─► command              the view state; requests of keys, menus and panes
//! figures ─► report            answers become figures; the paper's figures and claims
//! panes  cli                   show them, and request changes
//! app                          the window
//! ```
//!
//! Each module uses only modules before it (`tests/app/architecture.rs` has the order and holds it), and no circle of files is
//! larger than two.

#![allow(
    clippy::missing_errors_doc,
    reason = "each function returns one small error enum whose variants say in a message what is wrong"
)]
#![allow(missing_docs, reason = "what the name and type of a field say is not said again")]

pub mod action;
pub mod app;
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
