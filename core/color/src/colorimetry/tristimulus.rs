//! Tristimulus values and the three chromaticity diagrams.

use glam::DVec3;

/// CIE tristimulus values; Y = 1 for a perfect white unless said otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Xyz {
    /// X.
    pub x: f64,
    /// Y, the luminance.
    pub y: f64,
    /// Z.
    pub z: f64,
}

/// Chromaticity coordinates of the CIE 1931 diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Xy {
    /// x.
    pub x: f64,
    /// y.
    pub y: f64,
}

/// Chromaticity coordinates of the CIE 1976 uniform diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvPrime {
    /// u′.
    pub u: f64,
    /// v′.
    pub v: f64,
}

/// Chromaticity coordinates of the CIE 1960 diagram, in which color temperatures are defined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uv60 {
    /// u.
    pub u: f64,
    /// v.
    pub v: f64,
}

/// Below this share of the largest magnitude a denominator is no more than rounding, and there is no chromaticity.
const NO_SUM: f64 = 1e-12;

impl Xyz {
    /// From three numbers.
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The chromaticity, or none where the three sum to nothing: a black, or signals that cancel.
    ///
    /// ```text
    /// x = X / (X + Y + Z),   y = Y / (X + Y + Z)
    /// ```
    /// Scaled by the largest magnitude first, so that no finite input overflows. Coordinates are those of a projective map
    /// and may be any finite number for imaginary colors (negative values).
    ///
    /// ```
    /// use chromascope_core::colorimetry::Xyz;
    /// let white = Xyz::new(0.9505, 1.0, 1.089).chromaticity().unwrap();
    /// assert!((white.x - 0.3127).abs() < 1e-4 && (white.y - 0.3290).abs() < 1e-4);
    /// assert_eq!(Xyz::new(0.0, 0.0, 0.0).chromaticity(), None);
    /// ```
    pub fn chromaticity(self) -> Option<Xy> {
        let v = self.normalized()?;
        let sum = v.x + v.y + v.z;
        (sum.abs() > NO_SUM).then(|| Xy { x: v.x / sum, y: v.y / sum })
    }

    /// The chromaticity in the 1976 diagram, or none as for [`Xyz::chromaticity`].
    ///
    /// ```text
    /// u′ = 4X / (X + 15Y + 3Z),   v′ = 9Y / (X + 15Y + 3Z)
    /// ```
    pub fn uv_prime(self) -> Option<UvPrime> {
        let v = self.normalized()?;
        let sum = v.x + 15.0 * v.y + 3.0 * v.z;
        (sum.abs() > NO_SUM).then(|| UvPrime { u: 4.0 * v.x / sum, v: 9.0 * v.y / sum })
    }

    /// Tristimulus values as a vector, for matrices.
    pub const fn to_vector(self) -> DVec3 {
        DVec3::new(self.x, self.y, self.z)
    }

    /// From a vector of X, Y, Z.
    pub const fn from_vector(v: DVec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }

    /// Divided by the largest magnitude; none for a zero or where a component is not finite.
    fn normalized(self) -> Option<Self> {
        let scale = self.x.abs().max(self.y.abs()).max(self.z.abs());
        let finite = self.x.is_finite() && self.y.is_finite() && self.z.is_finite();
        (finite && scale > f64::MIN_POSITIVE).then(|| Self::new(self.x / scale, self.y / scale, self.z / scale))
    }
}

impl Xy {
    /// Tristimulus values of this chromaticity with Y = 1, or none where y is zero or a number would overflow.
    pub fn with_unit_luminance(self) -> Option<Xyz> {
        let xyz = Xyz::new(self.x / self.y, 1.0, (1.0 - self.x - self.y) / self.y);
        (self.y.abs() > NO_SUM && xyz.to_vector().is_finite()).then_some(xyz)
    }

    /// Chromaticity in the 1976 diagram: u′ = 4x / (−2x + 12y + 3), v′ = 9y / (−2x + 12y + 3).
    pub fn uv_prime(self) -> Option<UvPrime> {
        let d = -2.0 * self.x + 12.0 * self.y + 3.0;
        let uv = UvPrime { u: 4.0 * self.x / d, v: 9.0 * self.y / d };
        (d.abs() > NO_SUM && uv.u.is_finite() && uv.v.is_finite()).then_some(uv)
    }

    /// The straight distance in the diagram.
    pub fn distance(self, other: Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }
}

impl UvPrime {
    /// Chromaticity in the 1960 diagram: u = u′, v = 2v′/3.
    pub fn uv60(self) -> Uv60 {
        Uv60 { u: self.u, v: self.v * 2.0 / 3.0 }
    }

    /// Chromaticity in the 1931 diagram: x = 9u′ / (6u′ − 16v′ + 12), y = 4v′ / (6u′ − 16v′ + 12).
    pub fn xy(self) -> Option<Xy> {
        let d = 6.0 * self.u - 16.0 * self.v + 12.0;
        let xy = Xy { x: 9.0 * self.u / d, y: 4.0 * self.v / d };
        (d.abs() > NO_SUM && xy.x.is_finite() && xy.y.is_finite()).then_some(xy)
    }

    /// The straight distance in the diagram.
    pub fn distance(self, other: Self) -> f64 {
        (self.u - other.u).hypot(self.v - other.v)
    }
}
