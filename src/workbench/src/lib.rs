//! Chromascope without its window: document, history, data sets, scene, figures, export, report and command line.
//!
//! ```text
//! format  hosted               text for display; streams and files of commands inside another program
//! terminal  palette            standard error, colors of figures
//! atomic                       files written whole or not at all
//! document ─► action           the comparison and its conditions; its changes, and undo
//! results ─► jobs              answers, the only cache; computations in the background
//! catalog ─► scene             data sets; names become data, choices become queries
//! help  export                 help pages; pictures and tables out
//! plot_item                    items of marks
//! render_service  profiler     pictures of meshes; run time against error
//! figures ─► report            answers become figures; the paper's figures and claims
//! cli                          the command line
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
pub mod atomic;
pub mod catalog;
pub mod cli;
pub mod document;
pub mod export;
pub mod figures;
pub mod format;
pub mod help;
pub mod hosted;
pub mod jobs;
pub mod names;
pub mod palette;
pub mod plot_item;
pub mod profiler;
pub mod render_service;
pub mod report;
pub mod results;
pub mod scene;
pub mod terminal;
