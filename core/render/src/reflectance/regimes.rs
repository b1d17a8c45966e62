//! The paper's three cases of the diffuse sum, retained to show their error.

/// The paper's case of roughness that a value of g belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Regime {
    /// g < 0.1: the first term of Eq 2.
    Slight,
    /// 0.1 ≤ g ≤ 10: ten terms of Eq 2.
    Moderate,
    /// g > 10: Eq 4.
    Rough,
}

/// Number of terms of the paper's middle case.
const TERMS: u32 = 10;

impl Regime {
    /// The case of `g = σ² v_z²`.
    ///
    /// The paper's conditions are g ≪ 1, g ≈ 1 and g ≫ 1; the limits 0.1 and 10 are this program's.
    pub fn of(g: f64) -> Self {
        if g > 10.0 {
            Self::Rough
        } else if g >= 0.1 {
            Self::Moderate
        } else {
            Self::Slight
        }
    }
}

/// S(g, b) by the paper's three cases: one term, ten terms, or Eq 4.
///
/// ```text
/// Slight     g e^(-g-b)
/// Moderate   e^-g Σ_{n=1}^{10} gⁿ/(n! n) e^(-b/n)
/// Rough      e^(-b/g) / g
/// ```
/// At g = 0.1 one term is wrong by −2.5 % for b = 0, −16 % for 4 and −99 % for 16; at g = 10 ten terms are by −29 % for b = 0
/// and −96 % for 100, Eq 4 by −12 % and −78 %. [`super::diffuse_sum`] is the remedy. 0 where g is not
/// positive and below 1e-300.
pub fn diffuse_sum_by_regimes(g: f64, b: f64) -> f64 {
    // Written so that NaN falls out too.
    if !(g > 0.0 && g.is_finite() && b < f64::INFINITY) {
        return 0.0;
    }
    let b = b.max(0.0);
    let value = match Regime::of(g) {
        Regime::Slight => g * (-g - b).exp(),
        Regime::Moderate => moderate(g, b),
        Regime::Rough => (-b / g).exp() / g,
    };
    if value < super::sum::SMALLEST { 0.0 } else { value }
}

fn moderate(g: f64, b: f64) -> f64 {
    let (mut weight, mut sum) = ((-g).exp(), 0.0);
    for n in (1..=TERMS).map(f64::from) {
        weight *= g / n;
        sum += weight / n * (-b / n).exp();
    }
    sum
}
