//! Units that live in types: finite, ordered, hashable.
//!
//! A quantity that stands in a query must be comparable and hashable, which bare floats are not. A temperature is
//! finite and positive by construction, so that NaN cannot enter a key.

use ordered_float::OrderedFloat;
use std::fmt;

/// Bits by which a number that is never NaN is compared and hashed: negative zero equals zero, so it has zero's.
pub fn bits(number: f64) -> u64 {
    (number + 0.0).to_bits()
}

/// `Eq` and `Hash` of a type with numbers that are never NaN, from what is hashed in its place.
#[doc(hidden)]
#[macro_export]
macro_rules! hash_by {
    ($Type:ty, |$of:ident| $key:expr) => {
        impl Eq for $Type {}

        impl std::hash::Hash for $Type {
            fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
                let $of = self;
                $key.hash(state);
            }
        }
    };
}
pub use hash_by;

/// `PartialEq`, `Eq` and `Hash` of a type from what stands for it.
#[doc(hidden)]
#[macro_export]
macro_rules! eq_by {
    ($Type:ty, |$of:ident| $key:expr) => {
        impl PartialEq for $Type {
            fn eq(&self, other: &Self) -> bool {
                let key = |$of: &Self| $key;
                key(self) == key(other)
            }
        }

        $crate::units::hash_by!($Type, |$of| $key);
    };
}
pub use eq_by;

/// Reason that a number is not a physical quantity of the wanted kind.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{value} is not a positive, finite number of {unit}")]
pub struct NotPositive {
    /// The number that was offered.
    pub value: f64,
    /// The unit it was offered in.
    pub unit: &'static str,
}

/// A thermodynamic or correlated color temperature, in kelvins.
///
/// ```
/// use chromascope_core::units::Kelvin;
/// let t = Kelvin::new(5500.0)?;
/// assert!((t.mired() - 181.818).abs() < 1e-3);
/// assert!(Kelvin::new(f64::NAN).is_err());
/// # Ok::<(), chromascope_core::units::NotPositive>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Kelvin(OrderedFloat<f64>);

impl Kelvin {
    /// Takes a positive, finite number.
    ///
    /// # Errors
    /// [`NotPositive`] otherwise.
    #[inline]
    pub fn new(value: f64) -> Result<Self, NotPositive> {
        let usable = value.is_finite() && value > 0.0;
        if usable { Ok(Self(OrderedFloat(value))) } else { Err(NotPositive { value, unit: "kelvins" }) }
    }

    /// The bare number.
    #[inline]
    pub const fn get(self) -> f64 {
        self.0.0
    }

    /// The reciprocal temperature in mired (10⁶ / T), the scale in which equal steps look alike.
    #[inline]
    pub fn mired(self) -> f64 {
        1e6 / self.get()
    }

    /// The temperature of a reciprocal temperature in mired.
    ///
    /// # Errors
    /// [`NotPositive`] unless the number is positive and finite.
    #[inline]
    pub fn from_mired(mired: f64) -> Result<Self, NotPositive> {
        Self::new(1e6 / mired)
    }
}

impl fmt::Display for Kelvin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.get(), f)?;
        f.write_str(" K")
    }
}
