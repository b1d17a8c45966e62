//! The diffuse sum S(g, b) against the same sum term by term in two doubles.

use std::sync::LazyLock;

use chromascope_core::reflectance::regimes::{Regime, diffuse_sum_by_regimes};
use chromascope_core::reflectance::{Precision, diffuse_sum, diffuse_sums_into, ln_diffuse_sum};
use chromascope_math::double::Double;

use super::draw::{Case, Draw, case};
use super::walk::{Verdict, Walk};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "diffuse_sum coarse", promise: 1e-6, share: 10.0, draw, check: |c, v| sum(c, Precision::Coarse, v) },
    Walk { name: "diffuse_sum fine", promise: 1e-10, share: 10.0, draw, check: |c, v| sum(c, Precision::Fine, v) },
    Walk { name: "diffuse_sum full", promise: 1e-13, share: 20.0, draw, check: |c, v| sum(c, Precision::Full, v) },
    Walk { name: "diffuse_sum ends", promise: 0.0, share: 20.0, draw: draw_anything, check: ends },
    Walk { name: "diffuse_sum order", promise: 1e-13, share: 40.0, draw, check: order },
    Walk { name: "diffuse_sums_into", promise: 0.0, share: 20.0, draw: draw_anything, check: many },
    Walk { name: "diffuse_sum_by_regimes", promise: 1e-13, share: 20.0, draw: draw_anything, check: regimes },
];

/// g, and b as far as the sum is above 1e-300 and further.
fn draw(d: &mut Draw) -> Case {
    let g = d.log(1e-12, 1e12);
    let kind = d.pick(6) as u32;
    // Where e^-b would be all of it, b counts; where many terms weigh, b/g.
    let reach = 700.0 * g.max(1.0);
    let b = match kind {
        0 => 0.0,
        1 => d.log(1e-300, 1e24),
        2 => d.within(0.0, reach),
        _ => d.log(1e-6, reach),
    };
    case([g, b])
}

fn draw_anything(d: &mut Draw) -> Case {
    case([d.anything(), d.anything()])
}

/// ln S: the terms around the largest, each from its neighbor, the largest itself in two doubles.
pub(super) fn reference(g: f64, b: f64) -> Double {
    let ratio = |n: f64| g * (n / ((n + 1.0) * (n + 1.0))) * (b / n / (n + 1.0)).exp();
    // The largest term is where the ratio falls below one.
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    while ratio(high) >= 1.0 {
        (low, high) = (high, 2.0 * high);
    }
    while high - low > 1.0 {
        let middle = f64::midpoint(low, high).floor();
        if ratio(middle) >= 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let top = high;
    let (gd, n) = (Double::from(g), Double::from(top));
    let largest = n * gd.ln() - ln_factorial(top) - n.ln() - Double::from(b) / n - gd;
    let rest = if top <= 3000.0 { by_neighbors(top, ratio) } else { by_strides(g, b, top) };
    largest + Double::from(rest).ln()
}

fn by_neighbors(top: f64, ratio: impl Fn(f64) -> f64) -> f64 {
    let (mut rest, mut term, mut n) = (1.0, 1.0, top);
    while term > 1e-20 {
        term *= ratio(n);
        rest += term;
        n += 1.0;
    }
    let (mut term, mut n) = (1.0, top);
    while term > 1e-20 && n > 1.0 {
        n -= 1.0;
        term /= ratio(n);
        rest += term;
    }
    rest
}

/// With so many terms every k-th gives the sum, by Poisson's formula: k at most half of the bell's width.
fn by_strides(g: f64, b: f64, top: f64) -> f64 {
    let width = (1.0 / (1.0 / top + 2.0 * (b / top) / top / top)).sqrt();
    let stride = (width / 2.0).floor().max(1.0);
    let ln_top = ln_term(g, b, top);
    let mut rest = 1.0;
    for direction in [1.0, -1.0] {
        let mut n = top + direction * stride;
        loop {
            let term = (ln_term(g, b, n) - ln_top).value().exp();
            rest += term;
            n += direction * stride;
            if term < 1e-20 || n < 1.0 {
                break;
            }
        }
    }
    rest * stride
}

/// ln n! for n up to the length.
static LN_FACTORIALS: LazyLock<Vec<Double>> = LazyLock::new(|| {
    let mut sum = Double::from(0.0);
    let next = |n: u32| {
        sum = sum + Double::from(f64::from(n.max(1))).ln();
        sum
    };
    (0..=200).map(next).collect()
});

/// ln n! for an integer n: added up, or by Stirling's series.
fn ln_factorial(n: f64) -> Double {
    /// `B_2k / (2k (2k − 1))`.
    const STIRLING: [[f64; 2]; 8] = [
        [1.0, 12.0],
        [-1.0, 360.0],
        [1.0, 1260.0],
        [-1.0, 1680.0],
        [1.0, 1188.0],
        [-691.0, 360_360.0],
        [1.0, 156.0],
        [-3617.0, 122_400.0],
    ];
    if n <= 200.0 {
        return LN_FACTORIALS[n as usize];
    }
    let (x, half) = (Double::from(n), Double::from(0.5));
    let inverse = Double::from(1.0) / x;
    let mut series = Double::from(0.0);
    for [above, below] in STIRLING.into_iter().rev() {
        series = series * inverse * inverse + Double::from(above) / below.into();
    }
    let ln_tau = Double::from(1.837_877_066_409_345_6) + (-7.756_588_316_134_483e-17).into();
    (x + half) * x.ln() - x + half * ln_tau + series * inverse
}

fn ln_term(g: f64, b: f64, n: f64) -> Double {
    let x = Double::from(n);
    x * Double::from(g).ln() - ln_factorial(n) - x.ln() - Double::from(b) / x
}

fn sum(&[g, b, ..]: &Case, precision: Precision, v: &mut Verdict) {
    let (value, ln) = (diffuse_sum(g, b, precision), ln_diffuse_sum(g, b, precision));
    v.normal(value);
    v.finite(ln);
    let exact = reference(g, b);
    let truth = exact.value();
    let rounding = truth.abs() * f64::EPSILON;
    if value > 0.0 {
        // For S < 1e-200 as much again.
        let excused = if truth < -460.0 { 2.0 * rounding } else { rounding };
        v.relative(value, exact.exp().value(), excused);
    } else {
        v.holds("0 above 1e-300", truth < -690.0);
    }
    // The absolute error here: below the larger of the precision and a few |ln S| ε.
    v.error((exact - ln.into()).value().abs() - 4.0 * rounding);
}

fn ends(&[g, b, ..]: &Case, v: &mut Verdict) {
    for precision in [Precision::Coarse, Precision::Fine, Precision::Full] {
        let (value, ln) = (diffuse_sum(g, b, precision), ln_diffuse_sum(g, b, precision));
        v.normal(value);
        v.holds("not from 0 to 1", (0.0..=1.0).contains(&value));
        v.holds("ln S is no number", !ln.is_nan() && ln < 0.1);
        if !(g > 0.0 && g.is_finite() && b < f64::INFINITY) {
            v.holds("S without g", value == 0.0 && ln == f64::NEG_INFINITY);
        } else if b < 0.0 {
            v.holds("b below 0", value == diffuse_sum(g, 0.0, precision));
        }
    }
}

/// S falls with b; beyond its error it may not rise.
fn order(&[g, b, ..]: &Case, v: &mut Verdict) {
    let further = b * (1.0 + 1e-6) + 1e-9;
    let (near, far) = (ln_diffuse_sum(g, b, Precision::Full), ln_diffuse_sum(g, further, Precision::Full));
    v.error((far - near) - 8.0 * f64::EPSILON * near.abs());
}

/// Many at once, with others beside them, are the same bits.
fn many(&[g, b, ..]: &Case, v: &mut Verdict) {
    let (gs, bs) = ([g, 3.0, g.abs().sqrt()], [b, b, 7.0]);
    for precision in Precision::ALL {
        let mut sums = [0.0; 3];
        diffuse_sums_into(&gs, &bs, precision, &mut sums);
        for i in 0..3 {
            v.normal(sums[i]);
            v.holds("S of many", sums[i].to_bits() == diffuse_sum(gs[i], bs[i], precision).to_bits());
        }
    }
}

fn regimes(&[g, b, ..]: &Case, v: &mut Verdict) {
    let value = diffuse_sum_by_regimes(g, b);
    v.normal(value);
    v.holds("not from 0 to 1", (0.0..=1.0).contains(&value));
    if value == 0.0 {
        return;
    }
    let b = b.max(0.0);
    match Regime::of(g) {
        // One term in two doubles.
        Regime::Slight => {
            let exponent = -(Double::from(g) + b.into());
            if exponent.value() > -600.0 {
                v.relative(value, (Double::from(g) * exponent.exp()).value(), b * f64::EPSILON);
            }
        }
        // Ten of the sum's positive terms.
        Regime::Moderate => v.holds("more than the sum", value <= diffuse_sum(g, b, Precision::Full) * (1.0 + 1e-12)),
        Regime::Rough => v.relative(value * g, (-b / g).exp(), 0.0),
    }
}

#[test]
fn logarithms_of_factorials_are_continued() {
    let off = ln_factorial(201.0) - Double::from(201.0).ln() - LN_FACTORIALS[200];
    assert!((off / LN_FACTORIALS[200]).value().abs() < 1e-29, "{off:?}");
}
