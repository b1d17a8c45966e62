//! Numbers of 106 bits as unevaluated sums of two doubles (Dekker 1971; Knuth 1969): what errors are measured against.
//!
//! Own, for what is to be had does not do: of the crates, the one with such pairs was found off by 2e-11 in its exponential,
//! and those of any precision take 30 µs for one, that is seconds for the integral of a pixel. These are off by less than
//! 1e-29, which a test holds against 40 digits computed elsewhere, and take a fraction of a microsecond.

use std::f64::consts::{FRAC_PI_2, LN_2};
use std::iter::Sum;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number as the sum of two doubles, the second below half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Double {
    high: f64,
    low: f64,
}

const LN_2_PAIR: Double = Double { high: LN_2, low: 2.319_046_813_846_299_6e-17 };
const HALF_PI: Double = Double { high: FRAC_PI_2, low: 6.123_233_995_736_766e-17 };

impl Double {
    /// One.
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// A double as it is.
    pub const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// The nearest double.
    pub const fn high(self) -> f64 {
        self.high
    }

    /// What the nearest double lacks.
    pub const fn low(self) -> f64 {
        self.low
    }

    /// The sum of two doubles without error (Knuth).
    fn two_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let other = high - a;
        Self { high, low: (a - (high - other)) + (b - other) }
    }

    /// The same where the first is the larger (Dekker).
    fn quick_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// The product of two doubles without error.
    fn two_product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    /// The square root of a number that is not negative.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::default();
        }
        let first = Self::new(self.high.sqrt());
        first + (self - first * first) / (first + first)
    }

    /// The whole power.
    #[must_use]
    pub fn powi(self, power: u32) -> Self {
        let (mut result, mut square, mut rest) = (Self::ONE, self, power);
        while rest > 0 {
            if rest & 1 == 1 {
                result = result * square;
            }
            square = square * square;
            rest >>= 1;
        }
        result
    }

    /// e to the number, for magnitudes below 700.
    #[must_use]
    pub fn exp(self) -> Self {
        let turns = (self.high / LN_2).round();
        let rest = (self - LN_2_PAIR * Self::new(turns)).small_exp_m1() + Self::ONE;
        // In two steps: the whole power of two may be subnormal.
        let half = (turns / 2.0).floor();
        let scale = |value: f64| value * half.exp2() * (turns - half).exp2();
        Self { high: scale(rest.high), low: scale(rest.low) }
    }

    /// e to the number less one, without cancellation near 0.
    #[must_use]
    pub fn exp_m1(self) -> Self {
        if self.high.abs() < 0.5 { self.small_exp_m1() } else { self.exp() - Self::ONE }
    }

    /// The same for magnitudes below 1: Taylor's series of a 256th, doubled eight times.
    fn small_exp_m1(self) -> Self {
        let small = self.times(1.0 / 256.0);
        let (mut term, mut sum) = (small, small);
        for k in 2..=12 {
            term = term * small / Self::new(f64::from(k));
            sum = sum + term;
        }
        for _ in 0..8 {
            sum = sum.times(2.0) + sum * sum;
        }
        sum
    }

    /// The natural logarithm of a positive number: one step of Newton's from the double's.
    #[must_use]
    pub fn ln(self) -> Self {
        let first = Self::new(self.high.ln());
        first + self * (-first).exp() - Self::ONE
    }

    /// Sine and cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        let turns = (self.high / FRAC_PI_2).round();
        let rest = self - HALF_PI * Self::new(turns);
        let square = rest * rest;
        let series = |first: Self, from: u32| {
            let (mut term, mut sum, mut k) = (first, first, from);
            while k < 28 {
                term = -(term * square) / Self::new(f64::from((k + 1) * (k + 2)));
                sum = sum + term;
                k += 2;
            }
            sum
        };
        let (sine, cosine) = (series(rest, 1), series(Self::ONE, 0));
        match (turns as i64).rem_euclid(4) {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    /// The angle of the point with this ordinate and that abscissa, −π to π: one step from the double's.
    #[must_use]
    pub fn atan2(self, x: Self) -> Self {
        let length = (self * self + x * x).sqrt();
        if length.high == 0.0 {
            return Self::default();
        }
        let first = Self::new(self.high.atan2(x.high));
        let (sine, cosine) = first.sin_cos();
        first + (self * cosine - x * sine) / length
    }

    /// The cube root: one step of Newton's from the double's.
    #[must_use]
    pub fn cbrt(self) -> Self {
        let first = Self::new(self.high.cbrt());
        if first.high == 0.0 {
            return first;
        }
        first - (first * first * first - self) / (first * first).times(3.0)
    }

    /// The magnitude.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The product with a power of two.
    fn times(self, factor: f64) -> Self {
        self * Self::new(factor)
    }
}

/// How far a double is from a number of twice its length.
pub(super) fn off(found: f64, exact: Double) -> f64 {
    (found - exact.high) - exact.low
}

impl From<f64> for Double {
    fn from(value: f64) -> Self {
        Self::new(value)
    }
}

impl Neg for Double {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let high = Self::two_sum(self.high, other.high);
        let low = Self::two_sum(self.low, other.low);
        let sum = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(sum.high, sum.low + low.low)
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
        let product = Self::two_product(self.high, other.high);
        Self::quick_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Double {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::new(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::new(second);
        let third = rest.high / other.high;
        Self::quick_sum(first, second) + Self::new(third)
    }
}

impl Sum for Double {
    fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
        items.fold(Self::default(), Add::add)
    }
}
