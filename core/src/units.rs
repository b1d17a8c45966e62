//! Units that live in types: finite, ordered, hashable.
//!
//! A quantity that stands in a query must be comparable and hashable, which bare floats are not. These newtypes are
//! finite and positive by construction, so equality is an equivalence and NaN cannot enter a key.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

/// Reason that a number is not a physical quantity of the wanted kind.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{value} is not a positive, finite number of {unit}")]
pub struct NotPositive {
    /// The number that was offered.
    pub value: f64,
    /// The unit it was offered in.
    pub unit: &'static str,
}

macro_rules! positive_unit {
    ($(#[$doc:meta])* $name:ident, $unit:literal, $symbol:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name(f64);

        impl $name {
            /// Takes a positive, finite number.
            ///
            /// # Errors
            ///
            /// [`NotPositive`] otherwise.
            pub fn new(value: f64) -> Result<Self, NotPositive> {
                if value.is_finite() && value > 0.0 {
                    Ok(Self(value))
                } else {
                    Err(NotPositive { value, unit: $unit })
                }
            }

            /// The bare number.
            pub const fn get(self) -> f64 {
                self.0
            }
        }

        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                self.0 == other.0
            }
        }

        impl Eq for $name {}

        impl Hash for $name {
            fn hash<H: Hasher>(&self, state: &mut H) {
                self.0.to_bits().hash(state);
            }
        }

        impl PartialOrd for $name {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                Some(self.cmp(other))
            }
        }

        impl Ord for $name {
            fn cmp(&self, other: &Self) -> Ordering {
                self.0.total_cmp(&other.0)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)?;
                f.write_str($symbol)
            }
        }
    };
}

positive_unit!(
    /// A wavelength in air, in nanometers.
    Nanometers,
    "nanometers",
    " nm"
);
positive_unit!(
    /// A thermodynamic or correlated color temperature, in kelvins.
    ///
    /// ```
    /// use chromascope_core::units::Kelvin;
    /// let t = Kelvin::new(5500.0)?;
    /// assert!((t.mired() - 181.818).abs() < 1e-3);
    /// assert!(Kelvin::new(f64::NAN).is_err());
    /// # Ok::<(), chromascope_core::units::NotPositive>(())
    /// ```
    Kelvin,
    "kelvins",
    " K"
);

impl Kelvin {
    /// The reciprocal temperature in mired (10⁶ / T), the scale in which equal steps look alike.
    pub fn mired(self) -> f64 {
        1e6 / self.0
    }

    /// The temperature of a reciprocal temperature in mired.
    ///
    /// # Errors
    ///
    /// [`NotPositive`] unless the number is positive and finite.
    pub fn from_mired(mired: f64) -> Result<Self, NotPositive> {
        Self::new(1e6 / mired)
    }
}
