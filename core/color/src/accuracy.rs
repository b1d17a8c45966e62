//! Tolerances, and the error where one cannot be met.
//!
//! A function that takes a [`RelTolerance`] uses the fastest method whose error it has checked, and returns [`Unmet`] if none
//! is accurate enough. The scale of the relative error is documented there: a peak, a value, the largest of three signals.

use ordered_float::OrderedFloat;
use std::fmt;

/// The largest relative error that is allowed: above 0, below 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RelTolerance(OrderedFloat<f64>);

impl RelTolerance {
    /// Takes a relative error above 0 and below 1.
    ///
    /// # Errors
    /// [`NotATolerance`] unless the number is positive and below 1.
    ///
    /// ```
    /// use chromascope_core::accuracy::RelTolerance;
    /// assert_eq!(RelTolerance::new(1e-6).unwrap().to_string(), "1e-6");
    /// assert!(RelTolerance::new(0.0).is_err());
    /// ```
    pub fn new(max_relative_error: f64) -> Result<Self, NotATolerance> {
        if max_relative_error > 0.0 && max_relative_error < 1.0 {
            Ok(Self(OrderedFloat(max_relative_error)))
        } else {
            Err(NotATolerance { value: max_relative_error })
        }
    }

    /// The largest relative error that is allowed.
    pub const fn max_relative_error(self) -> f64 {
        self.0.0
    }

    /// True if an error is within it. NaN never is.
    pub fn allows(self, relative_error: f64) -> bool {
        relative_error <= self.max_relative_error()
    }

    /// A share of it, above 0 and not above 1.
    #[must_use]
    pub fn times(self, share: f64) -> Self {
        Self::at_best(self.max_relative_error() * share)
    }

    /// Smallest supported tolerance. Errors of 1 and more, and NaN, count as the largest below 1.
    pub fn at_best(relative_error: f64) -> Self {
        let largest = 1.0 - f64::EPSILON;
        let clamped = if relative_error < largest { relative_error.max(f64::MIN_POSITIVE) } else { largest };
        Self(OrderedFloat(clamped))
    }

    /// Refusal of this tolerance, if a method of this error does not meet it.
    ///
    /// # Errors
    /// [`Unmet`] with the method's error as the best.
    pub fn met_by(self, relative_error: f64) -> Result<(), Unmet> {
        if self.allows(relative_error) {
            Ok(())
        } else {
            Err(Unmet { asked: self, best: Self::at_best(relative_error) })
        }
    }
}

impl fmt::Display for RelTolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(digits) = f.precision() {
            return write!(f, "{:.digits$e}", self.max_relative_error());
        }
        write!(f, "{:e}", self.max_relative_error())
    }
}

/// Reason that a number is no accuracy.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{value} is not a relative error between 0 and 1")]
pub struct NotATolerance {
    /// The number that was offered.
    pub value: f64,
}

/// A tolerance that no method meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[error("an error of {asked:.1} cannot be promised; the best that can be is {best:.1}")]
pub struct Unmet {
    /// Requested tolerance.
    pub asked: RelTolerance,
    /// The smallest error bound that is available.
    pub best: RelTolerance,
}
