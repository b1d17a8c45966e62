//! Which κ and β are asked for, and where they lie in a table.

use crate::math::ln::{ln, ln_1p};
use crate::render::diffuse::DARK;

/// The κ of a scene and how many samples lie where a table may serve them, in powers of two: little changes of a scene make no
/// new plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Demand {
    from: i16,
    to: i16,
    samples: u16,
}

/// The powers of two that κ may lie between: beyond, a surface is a mirror or beyond geometrical optics by any measure.
const POWERS: (f64, f64) = (-60.0, 60.0);
/// How many powers of two a demand spans at most; the smoothest beyond that are left to the sum over all wavelengths.
const SPAN: i16 = 40;

impl Demand {
    /// The κ from the smallest to the largest, and the number of samples, among those below [`ROUGH`] (the others cost
    /// next to nothing). A range without an end that is a positive number is the widest.
    ///
    /// [`ROUGH`]: crate::render::diffuse::ROUGH
    pub fn new(kappa: [f64; 2], samples: u64) -> Self {
        let power = |kappa: f64, other: f64| if kappa > 0.0 { kappa.log2() } else { other };
        let to = power(kappa[1], POWERS.1).ceil().clamp(POWERS.0 + 1.0, POWERS.1) as i16;
        let from = power(kappa[0], POWERS.0).floor().clamp(POWERS.0, f64::from(to - 1)) as i16;
        Self { from: from.max(to - SPAN), to, samples: samples.max(1).ilog2() as u16 + 1 }
    }

    /// The κ at which it begins and ends.
    pub fn kappa(self) -> [f64; 2] {
        [f64::from(self.from).exp2(), f64::from(self.to).exp2()]
    }

    /// At most this many samples below the rough.
    pub fn samples(self) -> f64 {
        f64::from(self.samples).exp2()
    }

    /// Whether a κ was asked for.
    #[inline]
    pub fn holds(self, kappa: f64) -> bool {
        let [from, to] = self.kappa();
        from <= kappa && kappa <= to
    }
}

/// Where (κ, β) lies in any camera's table: ln κ, and v from 0 at β = 0 to 1 where every wavelength is dark.
///
/// ```text
/// v = ln(1 + β) / ln(1 + β_last(κ)),  β_last = 30 (1 + 6/√κ + 3.5/κ)
/// ```
/// Beyond v = 1 the integral is below e^-30 of its peak, whatever the weights. For κ from 1e-300 to 1e300; without branches or
/// calls, so that a loop over it vectorizes.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
pub fn position(kappa: f64, beta: f64) -> [f64; 2] {
    [ln(kappa), ln_1p(beta) / ln_last(kappa)]
}

/// Whether a place lies within v = 1; what is no number does not.
#[inline]
pub(in crate::render) fn is_lit(kappa: f64, beta: f64) -> bool {
    beta <= last(kappa)
}

/// β at a v of a κ.
pub(super) fn beta_at(kappa: f64, v: f64) -> f64 {
    (v * ln_last(kappa)).exp_m1()
}

/// The logarithm of 1 + β at v = 1.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
pub(super) fn ln_last(kappa: f64) -> f64 {
    ln_1p(last(kappa))
}

/// β at v = 1.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn last(kappa: f64) -> f64 {
    let root = 1.0 / kappa.sqrt();
    DARK * (1.0 + root * (6.0 + 3.5 * root))
}
