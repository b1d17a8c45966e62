//! The diffuse sum, uniformly accurate: for all roughnesses and angles by one method.
//!
//! ```text
//! S(g, b) = e^-g Σ_{n≥1} gⁿ/(n! n) e^(-b/n)
//! ```
//! The terms have one maximum, near `n = m` with
//! ```text
//! m = g e^δ,  δ e^(2δ) = b/g²
//! ```
//! Where m is large, the sum is an expansion about that maximum in powers of 1/m, uniformly in b (`saddle`); where it is
//! small, the terms that weigh are added (`direct`). What decides is m, not g: with b ≫ g² a sum of many terms belongs to a
//! small g. With b ≫ g² the terms can also fall off within one step of n, at any m (`narrow`).

mod coefficients;
mod direct;
mod factorials;
mod narrow;
mod saddle;

use crate::accuracy::{Accuracy, Unmet};
use multiversion::multiversion;
use saddle::Peak;

/// How closely a diffuse sum is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Precision {
    /// Relative error of 1e-6.
    Coarse,
    /// Relative error of 1e-10.
    Fine,
    /// Relative error of 1e-13, to which rounding b adds |ln S| ε: for S < 1e-200 as much again.
    #[default]
    Full,
}

impl Precision {
    /// From the cheapest to the most exact.
    pub const ALL: [Self; 3] = [Self::Coarse, Self::Fine, Self::Full];

    /// The cheapest that keeps the relative error of S within an accuracy.
    ///
    /// Beside it stands what rounding b costs, |ln S| ε, which no precision is without: 7e-15 where S is e^-30, 2e-13 where S is
    /// 1e-300. Relative to S(g, 0) instead of S it is below 1e-16.
    ///
    /// # Errors
    /// Below 1e-13 none does.
    pub fn within(accuracy: Accuracy) -> Result<Self, Unmet> {
        let found = Self::ALL.into_iter().find(|precision| accuracy.allows(precision.max_relative_error()));
        found.map_or_else(|| accuracy.met_by(Self::Full.max_relative_error()).map(|()| Self::Full), Ok)
    }

    /// The relative error of S that it keeps, beside |ln S| ε.
