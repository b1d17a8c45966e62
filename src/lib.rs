//! Chromascope's window, as a library for its tests, with the [workbench](chromascope_workbench) that it shows.
//!
//! ```text
//! files                        the document and the user's files
//! theme  paint  workspaces     colors and sizes; figures on screen; arrangement of panes
//! view ─► command              the view state; requests of keys, menus and panes
//! panes                        show answers, and request changes
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

pub use chromascope_workbench::{
    action, atomic, catalog, cli, document, export, figures, help, jobs, palette, plot_item, profiler, render_service,
    report, results, scene, terminal,
};

use chromascope_workbench::format;

pub mod app;
pub mod command;
pub mod files;
pub mod paint;
pub mod panes;
pub mod theme;
pub mod view;
pub mod workspaces;
