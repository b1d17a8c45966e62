//! Number of terms of S(g, b), to determine the savings of closed forms and tables.

use std::f64::consts::LN_2;

/// A term matters from this share of the largest on.
const SHARE: f64 = 1e-13;

/// Up to this m terms are looked at one by one.
const FEW: f64 = 64.0;

/// The terms of S(g, b) that matter: those above 1e-13 of the largest. Those beyond the last are together below 1e-13 of S.
///
/// Whole numbers, as doubles since they can be larger than any integer type holds. Above 64 they are near by: within 1 %.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeriesTerms {
    /// The last relevant term: the number of terms of a plain sum that begins with the first.
    pub last: f64,
    /// Number of terms that matter.
    pub weighing: f64,
}

/// Counts the terms of S(g, b), of which [`super::diffuse_sum`] adds few or, in closed form, none.
///
/// Relative to the term at `n = m` (see there), all obey
/// ```text
/// ln(t_n/t_m) = -m [ x ln x - x + 1 + δ (x - 1)²/x ] - 3/2 ln x,  x = n/m
/// ```
/// but for the rest of Stirling's series, below 1/(12 m). Arguments are understood as by [`super::diffuse_sum`]; where S is 0
/// by them there are no terms.
///
/// ```
/// use chromascope_core::reflectance::series_terms;
/// let terms = series_terms(100.0, 50.0);
/// assert!((182.0..186.0).contains(&terms.last));
/// assert_eq!(series_terms(1e-9, 0.0).last, 2.0);
/// ```
pub fn series_terms(g: f64, b: f64) -> SeriesTerms {
    // Written so that NaN falls out too.
    if !(g > 0.0 && g.is_finite() && b < f64::INFINITY) {
        return SeriesTerms::default();
    }
    let b = b.max(0.0);
    let delta = delta(g, b);
    let m = if delta > 1.0 { (b / delta).sqrt() } else { g * delta.exp() };
    if m < FEW { one_by_one(g, b) } else { by_bell(m, delta) }
}

/// δ of `δ e^(2δ) = b/g²`: Newton's steps on `w + ln w = ln(2b/g²)`, w = 2δ, which come from below, as the left side is concave.
fn delta(g: f64, b: f64) -> f64 {
    let ln_z = LN_2 + b.ln() - 2.0 * g.ln();
    if ln_z < -36.0 {
        return 0.5 * ln_z.exp();
    }
    let mut w = if ln_z > 1.0 { ln_z - ln_z.ln() } else { ln_z.exp() / (1.0 + ln_z.exp()) };
    for _ in 0..6 {
        w += w / (1.0 + w) * (ln_z - w - w.ln());
    }
    0.5 * w
}

/// From the first on, each term from the one before it.
fn one_by_one(g: f64, b: f64) -> SeriesTerms {
    let (ln_g, ln_share) = (g.ln(), SHARE.ln());
    // Relative to the first; the ratio falls with n, so that there is one largest.
    let (mut ln_terms, mut ln_term, mut largest) = (vec![0.0], 0.0_f64, 0.0_f64);
    while ln_term >= largest + ln_share {
        let n = ln_terms.len() as f64;
        ln_term += ln_g + b / (n * (n + 1.0)) + (n / ((n + 1.0) * (n + 1.0))).ln();
        largest = largest.max(ln_term);
        ln_terms.push(ln_term);
    }
    let last = ln_terms.len() - 1;
    let before = ln_terms.iter().take_while(|ln| **ln < largest + ln_share).count();
    SeriesTerms { last: last as f64, weighing: (last - before) as f64 }
}

/// By where the bell has fallen to the share on both sides.
fn by_bell(m: f64, delta: f64) -> SeriesTerms {
    let depth = -SHARE.ln();
    // u = x − 1; near 0 by powers, since the logarithm's would cancel.
    let fallen = |u: f64| {
        let entropy = if u.abs() < 1e-3 { u * u * (0.5 - u / 6.0 + u * u / 12.0) } else { (1.0 + u) * u.ln_1p() - u };
        m * (entropy + delta * u * u / (1.0 + u)) + 1.5 * u.ln_1p()
    };
    let edge = |mut outer: f64| {
        let mut inner = 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (inner + outer);
            if fallen(middle) < depth { inner = middle } else { outer = middle }
        }
        inner
    };
    // Four times the half-width that a bell of this variance has: beyond its own skewness, from m = 64 on.
    let beyond = 4.0 * (2.0 * depth / m / (1.0 + 2.0 * delta)).sqrt();
    let (above, below) = (edge(beyond), edge(-beyond.min(1.0 - 1.0 / m)));
    SeriesTerms { last: (m * (1.0 + above)).floor(), weighing: (m * (above - below)).ceil().max(1.0) }
}
