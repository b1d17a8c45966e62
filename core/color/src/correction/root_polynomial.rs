//! Root polynomials: color correction that does not depend on exposure.

use glam::{DMat3, DVec3};

/// Degree of a root polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Degree {
    /// 6 terms.
    Two,
    /// 13 terms.
    Three,
    /// 22 terms.
    Four,
}

/// Exponents of r, g and b of each term over a common denominator: the first 6, 13 or all 22 belong to a degree.
///
/// All monomials up to degree 4 under the root of their degree, each once (Finlayson, Mackiewicz & Hurlbert 2015, table 1).
const TERMS: [([u8; 3], u8); 22] = [
    ([1, 0, 0], 1),
    ([0, 1, 0], 1),
    ([0, 0, 1], 1),
    ([1, 1, 0], 2),
    ([0, 1, 1], 2),
    ([1, 0, 1], 2),
    ([1, 2, 0], 3),
    ([0, 1, 2], 3),
    ([1, 0, 2], 3),
    ([2, 1, 0], 3),
    ([0, 2, 1], 3),
    ([2, 0, 1], 3),
    ([1, 1, 1], 3),
    ([3, 1, 0], 4),
    ([3, 0, 1], 4),
    ([1, 3, 0], 4),
    ([0, 3, 1], 4),
    ([1, 0, 3], 4),
    ([0, 1, 3], 4),
    ([2, 1, 1], 4),
    ([1, 2, 1], 4),
    ([1, 1, 2], 4),
];

impl Degree {
    /// Number of terms.
    pub const fn count(self) -> usize {
        match self {
            Self::Two => 6,
            Self::Three => 13,
            Self::Four => 22,
        }
    }

    /// Terms of balanced RGB; a negative signal counts as zero under a root, and as itself where it stands alone.
    pub fn terms(self, rgb: DVec3) -> Vec<f64> {
        let mut terms = vec![0.0; self.count()];
        self.fill(rgb, &mut terms);
        terms
    }

    fn fill(self, rgb: DVec3, terms: &mut [f64]) {
        let signals = rgb.to_array();
        let positive = signals.map(|v| v.max(0.0));
        let (square, fourth) = (positive.map(f64::sqrt), positive.map(|v| v.sqrt().sqrt()));
        let cube = if self == Self::Two { [0.0; 3] } else { positive.map(f64::cbrt) };
        for (value, (powers, root)) in terms.iter_mut().zip(TERMS) {
            let roots = match root {
                1 => &signals,
                2 => &square,
                3 => &cube,
                _ => &fourth,
            };
            *value = (0..3).map(|c| roots[c].powi(i32::from(powers[c]))).product();
        }
    }
}

/// Root polynomial from balanced RGB to XYZ.
///
/// ```text
/// XYZ = Σⱼ cⱼ tⱼ(r, g, b),   t = r, g, b, √(rg), √(gb), √(rb), ∛(rg²), …
/// ```
/// Homogeneous of degree 1: k times the light gives k times the XYZ. Defined for signals that are not negative.
#[derive(Clone, Debug, PartialEq)]
pub struct RootPolynomial {
    degree: Degree,
    coefficients: Vec<DVec3>,
}

impl RootPolynomial {
    /// Takes the coefficients of XYZ for each term; missing ones count as zero.
    pub fn new(degree: Degree, mut coefficients: Vec<DVec3>) -> Self {
        coefficients.resize(degree.count(), DVec3::ZERO);
        Self { degree, coefficients }
    }

    /// Coefficients of XYZ for each term.
    pub fn coefficients(&self) -> &[DVec3] {
        &self.coefficients
    }

    /// XYZ of balanced RGB.
    pub fn xyz(&self, rgb: DVec3) -> DVec3 {
        let mut terms = [0.0; TERMS.len()];
        self.degree.fill(rgb, &mut terms[..self.degree.count()]);
        self.coefficients.iter().zip(terms).map(|(c, term)| *c * term).sum()
    }

    /// Derivative at (1, 1, 1): the matrix that is exact for colors next to white, and for white itself (Euler).
    pub fn at_white(&self) -> DMat3 {
        let column = |channel: usize| -> DVec3 {
            let weights = TERMS.iter().map(|(powers, root)| f64::from(powers[channel]) / f64::from(*root));
            self.coefficients.iter().zip(weights).map(|(c, weight)| *c * weight).sum()
        };
        DMat3::from_cols(column(0), column(1), column(2))
    }

    /// Name of a term, as in `∛(r g²)`.
    pub fn term_name(index: usize) -> String {
        let Some((powers, root)) = TERMS.get(index) else { return String::new() };
        let factor = |(name, power): (&str, &u8)| match power {
            0 => None,
            1 => Some(name.to_owned()),
            power => Some(format!("{name}{}", ["²", "³"][usize::from(*power).clamp(2, 3) - 2])),
        };
        let factors: Vec<String> = ["r", "g", "b"].into_iter().zip(powers).filter_map(factor).collect();
        match root {
            1 => factors.concat(),
            root => format!("{}({})", ["√", "∛", "∜"][usize::from(*root).clamp(2, 4) - 2], factors.join(" ")),
        }
    }
}
