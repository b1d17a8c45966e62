//! Chromascope's window and command line, as a library for its tests.
//!
//! ```text
//! catalog + document   ground state: data sets, and what is compared under what
//!        │ scene       names become data, choices become questions
//!        ▼
//!     results          answers, the only cache
//!        │ figures     answers become figures
//!        ▼
//!     panes, cli       show them, and push commands, which change the document
//! ```

pub mod action;
pub mod app;
pub mod catalog;
pub mod cli;
pub mod command;
pub mod document;
pub mod export;
pub mod figures;
pub mod files;
pub mod format;
pub mod help;
pub mod jobs;
pub mod paint;
pub mod panes;
pub mod plot_item;
pub mod profiler;
pub mod render_service;
pub mod results;
pub mod scene;
pub mod terminal;
pub mod theme;
pub mod view;
pub mod workspaces;
