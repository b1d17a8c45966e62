//! The built-in meshes, the readers of mesh files and the shadow tree.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]

mod fern;
mod head;
mod mesh_reading;
