//! The chromaticities of blackbodies at very many temperatures: polynomials in the reciprocal temperature.
//!
//! A table costs about a thousand sums over the spectrum and then replaces each further one by sixteen coefficients. It is
//! made for a sensor with its color transform, so that a camera costs no more than an observer.

mod pieces;

use self::pieces::{Pieces, TERMS};
use crate::accuracy::RelTolerance;
use crate::camera::locus::LocusEvaluator;
use crate::camera::rendering::Rendering;
use crate::colorimetry::Xy;
use crate::light::RadiationConstants;
use crate::spectral::Sensor;
use crate::units::Kelvin;
use glam::DVec3;
use rayon::prelude::*;

/// The coldest blackbody of a table, in kelvins.
pub const COLDEST_K: f64 = 1.0;
/// The hottest blackbody of a table, in kelvins. The locus hardly moves any more: from 10⁹ K on by less than 1e-6 in xy.
pub const HOTTEST_K: f64 = 1e15;

/// Temperatures per piece of work: enough to outweigh handing it over.
const CHUNK: usize = 8192;

/// Reason that a table has no chromaticity for a temperature. The sum may have one: [`LocusEvaluator`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum LocusTableError {
    /// Colder than [`COLDEST_K`] or hotter than [`HOTTEST_K`].
    #[error("the temperature is outside the table")]
    Outside,
    #[error("the locus has no smooth chromaticity near this temperature")]
    Rough,
}

/// x and y of blackbodies as a sensor sees them, ready for any number of temperatures.
///
/// ```text
/// x(T) ≈ Σ a_k tᵏ,   y(T) ≈ Σ b_k tᵏ,   k = 0…7,   m = 10⁶/T
/// ```
/// with t running over −1…1 in each of the pieces that divide m + 256 mired: evenly within each doubling, so that the pieces
/// are narrow where the locus bends fast, below 256 mired all alike, and their number is a few hundred from
/// [`COLDEST_K`] to [`HOTTEST_K`]. Each piece goes through Chebyshev's nodes of the 1 nm sum.
///
/// The error is absolute, in x and y, against the 1 nm sum ([`LocusEvaluator::by_sum`]): where Chebyshev's error is largest,
/// between all nodes and at both ends, it was looked up for every piece when the table was made. Pieces are halved until
/// that stays below [`Self::TARGET`]; those that still miss [`Self::LIMIT`] are omitted, and their temperatures refused as
/// [`LocusTableError::Rough`].
#[derive(Clone, Debug, PartialEq)]
pub struct LocusTable {
    pieces: Pieces,
    max_error: f64,
}

impl LocusTable {
    /// The error at which pieces are narrow enough.
    pub const TARGET: f64 = 1e-13;
    /// The error beyond which a piece is omitted.
    pub const LIMIT: f64 = 1e-12;

    /// Tabulates the locus of a sensor with its color transform (Eq 15). About a thousand sums, on all cores.
    pub fn new(sensor: &Sensor, rendering: &Rendering, constants: RadiationConstants) -> Self {
        Self::summed(sensor, rendering, constants, Self::TARGET)
    }

    /// Table with another error of its pieces than [`Self::TARGET`], absolute in x and y; smaller ones count as that target. A
    /// piece is omitted beyond ten times its error. Larger errors take fewer sums.
    pub fn within(
        sensor: &Sensor,
        rendering: &Rendering,
        constants: RadiationConstants,
        accuracy: RelTolerance,
    ) -> Self {
        Self::summed(sensor, rendering, constants, accuracy.max_relative_error())
    }

    fn summed(sensor: &Sensor, rendering: &Rendering, constants: RadiationConstants, target: f64) -> Self {
        let evaluator = LocusEvaluator::by_sum(sensor, constants);
        let exact = |temperature| {
            rendering.xyz(DVec3::from_array(evaluator.raw(temperature)) * rendering.locus_gain).chromaticity()
        };
        Self::made(&exact, target)
    }

    /// Tabulates any curve in the diagram that is smooth in the reciprocal temperature.
    pub fn of(exact: impl Fn(Kelvin) -> Option<Xy> + Sync) -> Self {
        Self::made(&exact, Self::TARGET)
    }

    fn made(exact: &(impl Fn(Kelvin) -> Option<Xy> + Sync), target: f64) -> Self {
        let (pieces, max_error) = Pieces::new(exact, target.max(Self::TARGET));
        Self { pieces, max_error }
    }

    /// The largest error that was found when the table was made, in x or y, over all pieces that are in it.
    pub fn max_error(&self) -> f64 {
        self.max_error
    }

    /// Number of pieces of the table, and of coefficients of a piece.
    pub fn size(&self) -> [usize; 2] {
        [self.pieces.len(), 2 * TERMS]
    }

    /// The chromaticity of one blackbody.
    ///
    /// # Errors
    /// [`LocusTableError`] where the temperature is outside the table, or in a piece that is omitted.
    #[inline]
    pub fn xy(&self, temperature: Kelvin) -> Result<Xy, LocusTableError> {
        self.pieces.xy(temperature)
    }

    /// Chromaticities of many temperatures, on all cores; the answers do not depend on their number.
    pub fn xys(&self, temperatures: &[Kelvin]) -> Vec<Result<Xy, LocusTableError>> {
        let mut answers = vec![Err(LocusTableError::Outside); temperatures.len()];
        self.xys_into(temperatures, &mut answers);
        answers
    }

    /// Chromaticities written into existing memory. Extra elements of the longer slice are ignored.
    pub fn xys_into(&self, temperatures: &[Kelvin], answers: &mut [Result<Xy, LocusTableError>]) {
        let chunks = answers.par_chunks_mut(CHUNK).zip(temperatures.par_chunks(CHUNK));
        chunks.for_each(|(answers, temperatures)| self.pieces.fill(temperatures, answers));
    }
}
