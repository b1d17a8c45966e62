//! Responses of very many spectra to many sensitivities at once: a product of two matrices, blocked for registers.

mod kernel;

use rayon::prelude::*;

pub use kernel::Sample;

/// Pieces of work, if there are spectra enough: more than threads, so that none waits long for the last.
const PIECES: usize = 32;
/// The most samples of a piece: the first spectra of each, which nothing could request ahead, are below a hundredth of it.
const LONGEST: usize = 1 << 18;
/// Bytes that a cache may still hold when they are requested again.
const NEAR: usize = 1 << 20;
/// Below this many products the work is done where it is requested: waking other threads takes longer.
const ALONE: usize = 1 << 20;

/// Reason that numbers make no batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum BatchError {
    #[error("{samples} samples are no whole number of curves of {length}")]
    Ragged { samples: usize, length: usize },
    #[error("{answers} places for {wanted} responses")]
    Answers { answers: usize, wanted: usize },
    #[error("a sensitivity is not a finite number")]
    NotFinite,
}

/// Sensitivities side by side, ready for any number of spectra that are sampled alike.
///
/// ```text
/// I_nc = Σ_i S_ni C_ci,   n = spectra, c = channels, i = samples
/// ```
/// The caller defines the curves: for `∫ C S L dλ` the products of [`under_light`], which include the quadrature weights.
/// Numbers are `f64` or `f32`; products are summed in the same type.
///
/// Each response is the sum of 4 partial sums (8 in `f32`), each of at most ⌈L/4⌉ (⌈L/8⌉) products of the L samples; its
/// error is within [`Self::max_error`]. Products and sums are rounded once together, by the processor or, where it cannot
/// (before 2013), slowly in software: the bits depend on neither the kind of processor nor the number of threads, of spectra
/// or of channels. Responses that are not finite, because a sample is not or is too large, are given as zero.
///
/// [`under_light`]: super::rendering::under_light
#[derive(Clone, Debug, PartialEq)]
pub struct Batch<T: Sample> {
    length: usize,
    curves: Vec<T::Lanes>,
    channels: usize,
}

impl<T: Sample> Batch<T> {
    /// Takes the curves of any number of channels one after the other, each of `length` samples.
    ///
    /// # Errors
    /// [`BatchError`] where the numbers are no whole curves of that length.
    pub fn new(curves: &[T], length: usize) -> Result<Self, BatchError> {
        let channels = count(curves.len(), length)?;
        if curves.iter().any(|c| !c.is_finite()) {
            return Err(BatchError::NotFinite);
        }
        Ok(Self { length, curves: T::pack(curves, length), channels })
    }

    /// Number of channels.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Error bound of a response relative to `Σ|S C|`: `(⌈L/4⌉ + 4) ε` (`⌈L/8⌉` in `f32`), ε half the distance from 1 to the next
    /// number. Holds where no product is subnormal.
    pub fn max_error(&self) -> f64 {
        (self.length.div_ceil(T::LANES) + 4) as f64 * T::ROUNDING
    }

    /// The responses to spectra that lie one after the other: all channels of the first, all of the second, ….
    ///
    /// # Errors
    /// [`BatchError`] where the numbers are no whole curves of the batch's length.
    pub fn responses(&self, spectra: &[T]) -> Result<Vec<T>, BatchError> {
        let mut answers = vec![T::ZERO; count(spectra.len(), self.length)? * self.channels];
        self.responses_into(spectra, &mut answers)?;
        Ok(answers)
    }

    /// Responses written into existing memory.
    ///
    /// # Errors
    /// [`BatchError`] as [`Self::responses`], or where the answers do not fit.
    pub fn responses_into(&self, spectra: &[T], answers: &mut [T]) -> Result<(), BatchError> {
        let wanted = count(spectra.len(), self.length)? * self.channels;
        if answers.len() != wanted {
            return Err(BatchError::Answers { answers: answers.len(), wanted });
        }
        if wanted == 0 {
            return Ok(());
        }
        let (length, channels) = (self.length, self.channels);
        let far = size_of_val(spectra) > NEAR;
        let products = spectra.len().saturating_mul(channels);
        if products <= ALONE {
            T::multiply(spectra, length, &self.curves, answers, channels, far);
            return Ok(());
        }
        let count = (wanted / channels / PIECES).min(LONGEST / length).max(ALONE / 8 / (length * channels));
        let count = count.max(1).next_multiple_of(kernel::ROWS);
        let pieces = answers.par_chunks_mut(count * channels).zip(spectra.par_chunks(count * length));
        pieces.for_each(|(answers, spectra)| T::multiply(spectra, length, &self.curves, answers, channels, far));
        Ok(())
    }
}

/// Number of curves of a length that some samples make.
fn count(samples: usize, length: usize) -> Result<usize, BatchError> {
    match (samples, length) {
        (0, 0) => Ok(0),
        (_, 0) => Err(BatchError::Ragged { samples, length }),
        _ if samples.is_multiple_of(length) => Ok(samples / length),
        _ => Err(BatchError::Ragged { samples, length }),
    }
}
