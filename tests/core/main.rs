//! The core against independent references: published tables, 50-digit arithmetic, laws, and a second way of computing.
//!
//! Reads the program's own data under `assets` and the figures under `tests/core/reference`; each of those says in its
//! first lines what made it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]
#![allow(clippy::disallowed_methods, reason = "the tests read the data that the core is given")]

mod accuracy;
mod batch;
mod camera;
mod channel_ratio;
mod chart_grid;
mod chart_search;
mod colorimetry;
mod correction;
mod double;
mod examples;
mod filters;
mod light;
mod locus_table;
mod math;
mod metamers;
mod metrics;
mod query;
mod recorded;
mod recovery;
mod reflectance;
mod render;
mod rendition;
mod scene;
mod spectral;
mod spectral_image;
mod stress;
mod support;
mod temperature;
mod uncertainty;
