//! Stub.

use crate::scene::Scene;
use crate::view::View;
use chromascope_core::figure::Figure;

/// The figure.
pub fn figure(_scene: &Scene<'_>, _view: &View) -> Figure {
    Figure::new("stub", [400.0, 300.0])
}
