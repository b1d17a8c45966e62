//! Stub.

use chromascope_core::figure::Figure;
use crate::scene::Scene;
use crate::view::View;

/// The figure.
pub fn figure(_scene: &Scene<'_>, _view: &View) -> Figure {
    Figure::new("stub", [400.0, 300.0])
}
