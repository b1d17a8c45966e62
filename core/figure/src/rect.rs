//! Rectangles.

/// An axis-parallel rectangle in points, `min` is the upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Upper left corner.
    pub min: [f64; 2],
    /// Lower right corner.
    pub max: [f64; 2],
}

impl Rect {
    /// The rectangle from its upper left corner and its size.
    pub fn from_min_size(min: [f64; 2], size: [f64; 2]) -> Self {
        Self { min, max: [min[0] + size[0], min[1] + size[1]] }
    }

    /// Width in points.
    pub fn width(&self) -> f64 {
        self.max[0] - self.min[0]
    }

    /// Height in points.
    pub fn height(&self) -> f64 {
        self.max[1] - self.min[1]
    }
}
