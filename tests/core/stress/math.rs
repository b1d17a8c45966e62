//! Interpolation, polynomials, Gauss rules, fits, products.

use chromascope_math::chebyshev::{coefficients, evaluate, nodes};
use chromascope_math::dot::{dot, dot_each};
use chromascope_math::double::Double;
use chromascope_math::exp::exp;
use chromascope_math::gauss::{gauss_rule, interpolatory_rule};
use chromascope_math::interpolation::{Sprague, linear};
use chromascope_math::least_squares::matrix_keeping;
use chromascope_math::ln::{ln, ln_1p};
use glam::DVec3;

use super::draw::{Case, Draw, case};
use super::walk::{Verdict, Walk};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "exp", promise: 4e-16, share: 40.0, draw: |d| case([d.signed(1e-300, 1e300)]), check: exponential },
    Walk {
        name: "exp usual",
        promise: 4e-16,
        share: 40.0,
        draw: |d| case([d.within(-700.0, 700.0)]),
        check: exponential,
    },
    Walk { name: "Double", promise: 1e-29, share: 2.0, draw: draw_double, check: double },
    Walk {
        name: "Double anywhere",
        promise: 0.0,
        share: 2.0,
        draw: |d| case([d.anything(), d.anything()]),
        check: ends,
    },
    Walk { name: "dot", promise: 1.0, share: 10.0, draw: draw_many, check: products },
    Walk { name: "ln", promise: 4.5e-16, share: 1.0, draw: draw_logarithm, check: logarithm },
    Walk { name: "chebyshev", promise: 2e-13, share: 20.0, draw: draw_many, check: polynomial },
    Walk { name: "linear", promise: 0.0, share: 20.0, draw: draw_table, check: straight },
    Walk { name: "Sprague", promise: 1e-13, share: 20.0, draw: draw_table, check: sprague },
    Walk { name: "Sprague::new", promise: 0.0, share: 20.0, draw: draw_spacing, check: spacing },
    Walk { name: "gauss_rule", promise: 2e-13, share: 4.0, draw: draw_measure, check: gauss },
    Walk { name: "interpolatory_rule", promise: 1e-10, share: 4.0, draw: draw_measure, check: interpolatory },
    Walk { name: "matrix_keeping", promise: 1e-13, share: 10.0, draw: draw_fit, check: fit },
];

fn exponential(&[x, ..]: &Case, v: &mut Verdict) {
    let value = exp(x);
    v.normal(value);
    let held = x.clamp(-700.0, 700.0);
    if held.abs() < 600.0 {
        v.relative(value, Double::from(held).exp().value(), 0.0);
    } else {
        // The standard library's, itself within half a unit.
        v.relative(value, held.exp(), f64::EPSILON / 2.0);
    }
}

fn draw_double(d: &mut Draw) -> Case {
    case([d.signed(1e-90, 1e90), d.signed(1e-90, 1e90), d.signed(1e-12, 600.0)])
}

/// Checks double-double functions by their inverses: relative, or absolute below `at_least`.
fn double(&[x, y, power, ..]: &Case, v: &mut Verdict) {
    let one = Double::ONE;
    let (third, half) = (Double::new(x) / Double::new(3.0), Double::new(0.5));
    let mut same = |a: Double, b: Double, at_least: f64| {
        v.all_finite([a.value(), a.low(), b.value(), b.low()]);
        let off = (a - b).value().abs();
        v.error(if off == 0.0 { 0.0 } else { off / b.value().abs().max(at_least) });
    };
    same(third * y.into() / y.into(), third, 0.0);
    same([third, third + third].into_iter().sum(), third * Double::new(3.0), 0.0);
    same(third.abs().sqrt() * third.abs().sqrt(), third.abs(), 0.0);
    same(third.abs().ln() + third.abs().ln(), (third * third).ln(), 1.0);
    let d = Double::from(power) + half * power.into() * f64::EPSILON.into();
    same(d.exp() * (-d).exp(), one, 0.0);
    let less = (d * half).exp_m1();
    same(d.exp_m1(), less * (less + one + one), 0.0);
    let near = third.value().next_up();
    v.holds("the sign of an error", third.error_of(near) > 0.0 && third.error_of(third.value().next_down()) < 0.0);
}

/// Requires only that all functions return, and that magnitudes and even powers are not negative.
fn ends(&[x, y, ..]: &Case, v: &mut Verdict) {
    let (x, y) = (Double::new(x), Double::new(y));
    let all = [x + y, x - y, x * y, x / y, x.sqrt(), x.exp(), x.exp_m1(), x.ln()];
    v.holds("a magnitude below 0", all.into_iter().all(|d| d.abs().value().is_nan() || d.abs().value() >= 0.0));
    let even = x.powi(u32::MAX - 1).value();
    v.holds("an even power below 0", even.is_nan() || even >= 0.0);
}

fn draw_logarithm(d: &mut Draw) -> Case {
    case([d.log(1e-320, 1e308)])
}

/// Against the standard library, itself within a unit.
fn logarithm(&[x, ..]: &Case, v: &mut Verdict) {
    for (value, right) in [(ln(x), x.max(f64::MIN_POSITIVE).ln()), (ln_1p(x), x.ln_1p())] {
        v.finite(value);
        v.relative(value, right, f64::EPSILON / 2.0);
    }
}

fn draw_many(d: &mut Draw) -> Case {
    case([d.key(), d.pick(42), d.log(1e-100, 1e100), d.pick(5)])
}

/// Numbers of both signs about a size: even, one spike, over many magnitudes, nearly cancelling, zeros.
fn many<const N: usize>(key: f64, size: f64, kind: f64) -> [f64; N] {
    let mut d = Draw::new(key as u64, "many", 0);
    let spike = d.pick(N as u32) as usize;
    std::array::from_fn(|i| {
        size * match kind as u32 {
            0 => d.within(-1.0, 1.0),
            1 => f64::from(u8::from(i == spike)),
            2 => d.signed(1e-60, 1e60),
            3 => 1.0 - 2.0 * (i % 2) as f64 + 1e-9 * d.unit(),
            _ => 0.0,
        }
    })
}

fn products(&[key, length, size, kind, ..]: &Case, v: &mut Verdict) {
    const N: usize = 41;
    let n = (length.max(0.0) as usize).min(N);
    let a = [0.0, 1.0, 2.0].map(|i| many::<N>(key + i, size, kind));
    let b = many::<N>(key + 3.0, 1.0, (kind + 1.0) % 5.0);
    let value = dot(&a[0][..n], &b);
    v.finite(value);
    let (mut exact, mut unsigned) = (Double::from(0.0), 0.0);
    for (x, y) in a[0].iter().zip(b).take(n) {
        exact = exact + Double::from(*x) * y.into();
        unsigned += (x * y).abs();
    }
    let bound = (n as f64 / 8.0 + 3.0) * f64::EPSILON * unsigned;
    let off = (exact.value() - value).abs();
    v.error(if off == 0.0 { 0.0 } else { off / bound });
    let each = dot_each([&a[0], &a[1], &a[2]], &b);
    v.holds("not as dot", [0, 1, 2].into_iter().all(|c: usize| each[c].to_bits() == dot(&a[c], &b).to_bits()));
}

fn polynomial(&[key, _, size, kind, ..]: &Case, v: &mut Verdict) {
    const N: usize = 9;
    let values = many::<N>(key, size, kind);
    let c = coefficients(values);
    v.all_finite(c);
    let largest = values.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (t, value) in nodes::<N>().into_iter().zip(values) {
        let off = (evaluate(&c, t) - value).abs();
        v.error(if off == 0.0 { 0.0 } else { off / largest });
    }
}

fn draw_table(d: &mut Draw) -> Case {
    case([d.key(), d.pick(20), d.log(1e-100, 1e100), d.pick(5), d.number(), d.within(-5.0, 30.0)])
}

fn straight(&[key, length, size, kind, far, near, ..]: &Case, v: &mut Verdict) {
    const N: usize = 20;
    let n = (length.max(0.0) as usize).min(N);
    let mut d = Draw::new(key as u64, "places", 0);
    let mut place = 0.0;
    let places: [f64; N] = std::array::from_fn(|_| {
        place += d.log(1e-6, 10.0);
        place
    });
    let values = many::<N>(key, size, kind);
    let low = values[..n].iter().fold(f64::INFINITY, |m, x| m.min(*x));
    let high = values[..n].iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x));
    for x in [far, near] {
        let y = linear(&places[..n], &values, x);
        v.finite(y);
        let slack = 4.0 * f64::EPSILON * low.abs().max(high.abs());
        v.holds("outside the data", n == 0 && y == 0.0 || (low - slack..=high + slack).contains(&y));
    }
    for (x, y) in places[..n].iter().zip(values) {
        v.holds("not the sample", linear(&places[..n], &values, *x) == y);
    }
}

/// Quartics, where all neighbors are samples; samples themselves; ends beyond.
fn sprague(&[key, length, size, kind, far, near, ..]: &Case, v: &mut Verdict) {
    const N: usize = 26;
    let n = 6 + (length.max(0.0) as usize).min(20);
    let values = many::<N>(key, size, kind);
    let Some(table) = Sprague::new(380.0, 5.0, &values[..n]) else { return v.refuse() };
    v.all_finite([table.at(far), table.at(380.0 + 5.0 * near)]);
    v.holds("not the sample", (0..n).all(|i| table.at(380.0 + 5.0 * i as f64) == values[i]));
    let c = many::<5>(key + 1.0, 1.0, 0.0);
    let quartic = |x: f64| c.iter().fold(0.0, |sum, c| sum * (x / 25.0) + c);
    let samples: [f64; N] = std::array::from_fn(|i| quartic(i as f64));
    let table = Sprague::new(0.0, 1.0, &samples).expect("samples and a step");
    let x = near.clamp(2.0, (N - 3) as f64);
    v.error((table.at(x) - quartic(x)).abs());
}

fn draw_spacing(d: &mut Draw) -> Case {
    case([d.anything(), d.anything(), d.anything(), d.log(1e-300, 1e300), d.pick(9)])
}

fn spacing(&[start, step, x, size, count, ..]: &Case, v: &mut Verdict) {
    let values = many::<8>(1.0, size.abs(), 0.0);
    match Sprague::new(start, step, &values[..(count.max(0.0) as usize).min(8)]) {
        Some(table) if !x.is_nan() => v.finite(table.at(x)),
        Some(_) => {}
        None => v.refuse(),
    }
}

fn draw_measure(d: &mut Draw) -> Case {
    case([d.key(), 1.0 + d.pick(12), d.log(1e-100, 1e100), d.pick(5), d.pick(3)])
}

/// Places from 380 to 780 and masses; `kind` 0 as they come, 1 in reverse, 2 with each place twice.
fn measure(key: f64, size: f64, shape: f64, kind: f64) -> ([f64; 60], [f64; 60]) {
    let masses = many::<60>(key, size, shape);
    let step = 400.0 / 59.0;
    let points = std::array::from_fn(|i| match kind as u32 {
        0 => 380.0 + step * i as f64,
        1 => 780.0 - step * i as f64,
        _ => 380.0 + 2.0 * step * (i / 2) as f64,
    });
    (points, masses)
}

/// Moments of a rule against those of the measure, over Legendre-like powers of t in −1…1, relative to all of the mass.
fn moments(rule: (&[f64], &[f64]), points: &[f64], masses: &[f64], degree: u32, v: &mut Verdict) {
    let total: f64 = masses.iter().map(|m| m.abs()).sum();
    let unit = |nm: f64| (nm - 580.0) / 200.0;
    for power in 0..=degree {
        let sum = |x: &[f64], w: &[f64]| {
            x.iter().zip(w).map(|(x, w)| w / total * unit(*x).powi(power.cast_signed())).sum::<f64>()
        };
        if total > 0.0 {
            v.error((sum(rule.0, rule.1) - sum(points, masses)).abs());
        }
    }
}

fn gauss(&[key, count, size, shape, kind, ..]: &Case, v: &mut Verdict) {
    let (points, masses) = measure(key, size, shape, kind);
    let positive = masses.map(|m| m.max(0.0));
    let n = (count.max(1.0) as usize).min(16);
    let rule = gauss_rule(&points, &masses, n);
    v.all_finite(rule.nodes.iter().chain(&rule.weights).copied());
    v.holds("a weight below 0", rule.weights.iter().all(|w| *w >= 0.0));
    v.holds("a node outside", rule.nodes.iter().all(|x| (379.999..=780.001).contains(x)));
    moments((&rule.nodes, &rule.weights), &points, &positive, 2 * n as u32 - 1, v);
}

fn interpolatory(&[key, count, size, shape, kind, ..]: &Case, v: &mut Verdict) {
    let (points, masses) = measure(key, size, shape, kind);
    let n = (count.max(1.0) as usize).min(16);
    let nodes = gauss_rule(&points, &masses.map(f64::abs), n).nodes;
    let rule = interpolatory_rule(&nodes, &points, &masses);
    v.all_finite(rule.weights.iter().copied());
    if !nodes.is_empty() {
        moments((&rule.nodes, &rule.weights), &points, &masses, nodes.len() as u32 - 1, v);
    }
}

fn draw_fit(d: &mut Draw) -> Case {
    case([d.key(), d.number(), d.number(), d.number(), d.signed(1e-100, 1e100), d.pick(5), d.pick(30)])
}

fn fit(&[key, x, y, z, size, kind, count, ..]: &Case, v: &mut Verdict) {
    let vectors = |key: f64, kind: f64| -> Vec<DVec3> {
        let numbers = many::<90>(key, size, kind);
        numbers.as_chunks::<3>().0.iter().map(|&n| DVec3::from_array(n)).take(count as usize).collect()
    };
    let (white, image) = (DVec3::new(x, y, z), DVec3::new(0.9, 1.0, 1.1));
    let Ok(matrix) = matrix_keeping(&vectors(key, kind), &vectors(key + 1.0, 0.0), white, image) else {
        return v.refuse();
    };
    v.holds("not finite", matrix.is_finite());
    let kept = matrix * white;
    let scale = matrix.to_cols_array().iter().fold(0.0_f64, |m, x| m.max(x.abs())) * white.abs().max_element();
    v.error((kept - image).abs().max_element() / scale.max(1.0));
}
