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

    /// The rectangle around points.
    pub fn around(points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let nothing = Self { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] };
        points.into_iter().fold(nothing, |Self { min, max }, at| Self {
            min: [min[0].min(at[0]), min[1].min(at[1])],
            max: [max[0].max(at[0]), max[1].max(at[1])],
        })
    }

    /// Width in points.
    pub fn width(&self) -> f64 {
        self.max[0] - self.min[0]
    }

    /// Height in points.
    pub fn height(&self) -> f64 {
        self.max[1] - self.min[1]
    }

    /// The rectangle with a margin on each side.
    #[must_use]
    pub fn enlarged(&self, by: f64) -> Self {
        Self { min: self.min.map(|v| v - by), max: self.max.map(|v| v + by) }
    }

    /// The rectangle shifted by so many points.
    #[must_use]
    pub fn moved(&self, [x, y]: [f64; 2]) -> Self {
        Self { min: [self.min[0] + x, self.min[1] + y], max: [self.max[0] + x, self.max[1] + y] }
    }

    /// True if a point lies inside or on an edge.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        (0..2).all(|axis| (self.min[axis]..=self.max[axis]).contains(&point[axis]))
    }

    /// True if all of another rectangle lies inside.
    pub fn holds(&self, other: &Self) -> bool {
        self.contains(other.min) && self.contains(other.max)
    }

    /// True if two rectangles have an area in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.min[axis] < other.max[axis] && other.min[axis] < self.max[axis])
    }
}
