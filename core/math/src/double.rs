//! Numbers of 106 bits as unevaluated sums of two doubles (Dekker 1971; Knuth 1969), for references: what errors are measured
//! against.
//!
//! Made of additions, products and the standard library's first guesses alone, never of this crate's own exponentials,
//! logarithms or sums: what those are judged by may not share their mistakes. Some fifty times slower than doubles, and so
//! not for pictures.
//!
//! Relative errors stay below 1e-29 if the arguments, their parts and all intermediate values lie between 1e-280 and 1e280
//! (details at each function), tested against 40 digits computed elsewhere. **Outside this range the operators behave as
//! those of doubles**: digits are lost, 1/0 is infinite or NaN, and infinities propagate as NaN. Only here in this crate: a
//! reference must not hide that it has left its range.
//!
//! ```
//! use chromascope_math::double::Double;
//! let third = Double::ONE / Double::new(3.0);
//! assert_eq!((third * Double::new(3.0) - Double::ONE).value(), 0.0);
//! // By how much 0.1, the double, misses a tenth.
//! let tenth = Double::ONE / Double::new(10.0);
//! assert!((tenth.error_of(0.1) - 5.551_115_123_125_783e-18).abs() < 1e-32);
//! ```

use std::f64::consts::LN_2;
use std::iter::Sum;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number as the sum of two doubles, the second at most half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// One.
    pub const ONE: Self = Self::new(1.0);
    /// ln 2.
    pub const LN_2: Self = Self { high: LN_2, low: 2.319_046_813_846_299_6e-17 };

    /// A double as it is.
    pub const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// The nearest double.
    pub const fn value(self) -> f64 {
        self.high
    }

    /// Part that the nearest double lacks.
    pub const fn low(self) -> f64 {
        self.low
    }

    /// Signed distance of a double from this number: `found - self`, correct in the leading digits however near it is.
    pub fn error_of(self, found: f64) -> f64 {
        (found - self.high) - self.low
    }

    /// The sum of two doubles without error (Knuth).
    fn two_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let other = high - a;
        Self { high, low: (a - (high - other)) + (b - other) }
    }

    /// Sum where the first is the larger (Dekker).
    fn fast_two_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// The product of two doubles without error.
    fn two_product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    /// The product with a power of two, without error.
    fn times(self, factor: f64) -> Self {
        Self { high: self.high * factor, low: self.low * factor }
    }

    /// The product with a whole power of two, in two steps: the power itself may be subnormal or too large.
    fn times_two_to(self, power: f64) -> Self {
        let half = (power / 2.0).floor();
        self.times(half.exp2()).times((power - half).exp2())
    }

    /// The magnitude.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The square root, and 0 of what is not positive.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::default();
        }
        let first = Self::new(self.high.sqrt());
        first + (self - first * first) / first.times(2.0)
    }

    /// The whole power, with an error of 1e-31 for each factor of itself.
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

    /// e to the number, for magnitudes below 640.
    ///
    /// ```text
    /// e^x = 2^k e^r,  k = round(x / ln 2),  r = x - k ln 2
    /// ```
    #[must_use]
    pub fn exp(self) -> Self {
        let turns = (self.high / LN_2).round();
        let rest = self - Self::LN_2 * Self::new(turns);
        (rest.small_exp_m1() + Self::ONE).times_two_to(turns)
    }

    /// e to the number less one, without cancellation near 0; below 640.
    #[must_use]
    pub fn exp_m1(self) -> Self {
        if self.high.abs() < 0.5 { self.small_exp_m1() } else { self.exp() - Self::ONE }
    }

    /// Exponential for magnitudes below 1: Taylor's series of a 256th, doubled eight times by `(1 + y)² - 1 = 2y + y²`.
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

    /// The natural logarithm of a positive number, also near 1: one step of Newton's method from the double's. NaN for
    /// others.
    ///
    /// ```text
    /// x = 2^k m,  √½ ≤ m ≤ √2;   y₀ ≈ ln m;   ln x = k ln 2 + y₀ + (m e^-y₀ - 1)
    /// ```
    #[must_use]
    pub fn ln(self) -> Self {
        if self.high.is_nan() || self.high <= 0.0 {
            return Self::new(f64::NAN);
        }
        let power = self.high.log2().round();
        let near = self.times_two_to(-power);
        let first = Self::new(near.high.ln());
        // m e^-y - 1, in parts that vanish with y.
        let less = (-first).exp_m1();
        let step = (near - Self::ONE) * (less + Self::ONE) + less;
        first + step + Self::LN_2 * Self::new(power)
    }
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
        let sum = Self::fast_two_sum(high.high, high.low + low.high);
        Self::fast_two_sum(sum.high, sum.low + low.low)
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
        Self::fast_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
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
        Self::fast_two_sum(first, second) + Self::new(third)
    }
}

impl Sum for Double {
    fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
        items.fold(Self::default(), Add::add)
    }
}
