//! Numbers of two doubles, 31 digits, as the second method: slow, and made of the textbook's operations alone (Dekker 1971).

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

#[derive(Clone, Copy, Debug)]
pub(super) struct Double {
    high: f64,
    low: f64,
}

pub(super) const LN_2: Double = Double { high: std::f64::consts::LN_2, low: 2.319_046_813_846_299_6e-17 };
/// ln 2π.
pub(super) const LN_TAU: Double = Double { high: 1.837_877_066_409_345_6, low: -7.756_588_316_134_483e-17 };
/// π/2.
pub(super) const QUARTER: Double = Double { high: std::f64::consts::FRAC_PI_2, low: 6.123_233_995_736_766e-17 };

fn sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let part = high - a;
    Double { high, low: (a - (high - part)) + (b - part) }
}

/// The same where |a| ≥ |b|.
fn quick_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double { high, low: b - (high - a) }
}

fn product(a: f64, b: f64) -> Double {
    let high = a * b;
    Double { high, low: a.mul_add(b, -high) }
}

impl From<f64> for Double {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, t) = (sum(self.high, other.high), sum(self.low, other.low));
        let s = quick_sum(s.high, s.low + t.high);
        quick_sum(s.high, s.low + t.low)
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = product(self.high, other.high);
        quick_sum(p.high, p.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let rest = rest - other * second.into();
        sum(first, second) + (rest.high / other.high).into()
    }
}

impl Double {
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }

    pub(super) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return 0.0.into();
        }
        let root = self.high.sqrt();
        let rest = self - product(root, root);
        sum(root, rest.high / (2.0 * root))
    }

    /// eˣ for |x| < 700.
    pub(super) fn exp(self) -> Self {
        let n = (self.high / std::f64::consts::LN_2).round();
        // To 2⁻¹⁰ of the rest, then squared ten times: the series is short.
        let small = 1.0 / 1024.0;
        let rest = self - LN_2 * n.into();
        let rest = Self { high: rest.high * small, low: rest.low * small };
        let (mut term, mut less) = (rest, rest);
        for k in (2..=8).map(f64::from) {
            term = term * rest / k.into();
            less = less + term;
        }
        // e^2x − 1 = (e^x − 1)(e^x − 1 + 2), which keeps the digits.
        for _ in 0..10 {
            less = less * (less + 2.0.into());
        }
        let value = less + 1.0.into();
        let (half, other) = ((n / 2.0).floor(), n - (n / 2.0).floor());
        let scale = |v: f64| v * half.exp2() * other.exp2();
        Self { high: scale(value.high), low: scale(value.low) }
    }

    /// eˣ − 1 for |x| < 700.
    pub(super) fn exp_m1(self) -> Self {
        if self.high.abs() > 0.5 {
            return self.exp() - 1.0.into();
        }
        let (mut term, mut all) = (self, self);
        for k in (2..=26).map(f64::from) {
            term = term * self / k.into();
            all = all + term;
        }
        all
    }

    pub(super) fn ln(self) -> Self {
        let exponent = (self.high.log2()).round();
        let (half, other) = ((exponent / 2.0).floor(), exponent - (exponent / 2.0).floor());
        let scale = |v: f64| v / half.exp2() / other.exp2();
        let near = Self { high: scale(self.high), low: scale(self.low) };
        // Newton's step on e^y = x doubles the digits.
        let start = Self::from(near.high.ln());
        start + near * (-start).exp() - 1.0.into() + LN_2 * exponent.into()
    }
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
pub(super) fn ln_factorial(n: f64) -> Double {
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
    (x + half) * x.ln() - x + half * LN_TAU + series * inverse
}

#[test]
fn two_doubles_hold_31_digits() {
    let near = |what: &str, a: Double, b: Double| {
        let off = (a - b).value().abs() / b.value().abs();
        assert!(off < 1e-29, "{what}: {off:.1e}");
    };
    for x in [1e-9, 0.37, 1.0, 3.3, 17.5, 88.1, 123.4] {
        let d = Double::from(x);
        near("ln e^x", (d + 2.0.into()).exp().ln(), d + 2.0.into());
        let less = d.exp_m1();
        near("expm1", (d + d).exp_m1(), less * (less + 2.0.into()));
        near("√", d.sqrt() * d.sqrt(), d);
        near("÷", d / 3.0.into() * 3.0.into(), d);
    }
    near("ln 2", Double::from(2.0).ln(), LN_2);
    let exact = LN_FACTORIALS[200];
    near("200!", ln_factorial(201.0) - Double::from(201.0).ln(), exact);
}
