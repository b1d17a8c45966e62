//! Tests of the app: reducer, results, panes, rules, pictures, the command line.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

mod architecture;
mod assets;
mod cli;
mod cli_render;
mod cpu_renderer;
mod exports;
mod figure;
mod import;
mod inspector;
mod library;
mod meshes;
mod own_data;
mod recompute;
mod reducer;
mod render;
mod screenshots;
mod theme;
