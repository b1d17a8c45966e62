//! Range of κ and β that a plan serves, and their place in a table.

use crate::render::diffuse::{DARK, ROUGH};
use chromascope_math::ln::{ln, ln_1p};

/// Range of κ and number of samples below [`ROUGH`] that a plan is made for, both rounded out to powers of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Demand {
    from: i16,
    to: i16,
    samples: u16,
    /// True if κ beyond the farthest ends are served as those at the ends.
    open: bool,
}

/// Powers of two that bound κ: beyond them, a surface is a mirror or follows geometrical optics in every respect.
const POWERS: (f64, f64) = (-60.0, 60.0);
/// Number of powers of two a demand spans at most; the smoothest beyond that are left to the sum over all wavelengths.
const SPAN: i16 = 40;
/// Powers of two at which the demands of pictures end: rough alone, all that a table reaches, and beyond.
const ROUGH_POWER: i16 = 7;
const TABLE_POWERS: (i16, i16) = (-12, 12);
const FAR_POWERS: (i16, i16) = (-28, 28);
/// Numbers of samples are rounded up to powers of two whose exponent is a multiple of this.
const SAMPLE_POWERS: u16 = 6;

impl Demand {
    /// The κ from the smallest to the largest, and the number of samples, among those below [`ROUGH`] (the others cost
    /// next to nothing). A range without an end that is a positive number is the widest.
    ///
    /// [`ROUGH`]: crate::render::diffuse::ROUGH
    pub fn new(kappa: [f64; 2], samples: u64) -> Self {
        let power = |kappa: f64, other: f64| if kappa > 0.0 { kappa.log2() } else { other };
        let to = power(kappa[1], POWERS.1).ceil().clamp(POWERS.0 + 1.0, POWERS.1) as i16;
        let from = power(kappa[0], POWERS.0).floor().clamp(POWERS.0, f64::from(to - 1)) as i16;
        Self { from: from.max(to - SPAN), to, samples: samples.max(1).ilog2() as u16 + 1, open: false }
    }

    /// The demand of a picture, rounded out to one of a few, so that a plan outlives changes of viewpoint and roughness.
    ///
    /// κ beyond the farthest ends are served too. Above 2²⁸ the error of moments falls with κ⁻⁴ and that of nodes stays as it is,
    /// since S goes to `e^-β / g`; below 2⁻²⁸ it stays as it is, since S goes to `g e^-b`.
    pub fn of_picture(kappa: [f64; 2], samples: u64) -> Self {
        let (least, most) = (kappa[0], kappa[1]);
        let smoothest = if least >= f64::from(TABLE_POWERS.0).exp2() { TABLE_POWERS.0 } else { FAR_POWERS.0 };
        let from = if least >= ROUGH { ROUGH_POWER } else { smoothest };
        let to =
            if from == ROUGH_POWER || most > f64::from(TABLE_POWERS.1).exp2() { FAR_POWERS.1 } else { TABLE_POWERS.1 };
        let samples = (samples.max(1).ilog2() as u16 + 1).next_multiple_of(SAMPLE_POWERS);
        Self { from, to, samples, open: true }
    }

    /// The κ at which it begins and ends.
    pub fn kappa(self) -> [f64; 2] {
        [f64::from(self.from).exp2(), f64::from(self.to).exp2()]
    }

    /// At most this many samples below the rough.
    pub fn samples(self) -> f64 {
        f64::from(self.samples).exp2()
    }

    pub(super) fn held(self) -> [f64; 2] {
        let [from, to] = self.kappa();
        let is_at = |power: i16, end: i16| self.open && power == end;
        [
            if is_at(self.from, FAR_POWERS.0) { f64::MIN_POSITIVE } else { from },
            if is_at(self.to, FAR_POWERS.1) { f64::MAX } else { to },
        ]
    }

    /// Returns true if a κ is served.
    #[inline]
    pub fn holds(self, kappa: f64) -> bool {
        let [from, to] = self.held();
        from <= kappa && kappa <= to
    }
}

/// Position of (κ, β) in any camera's table: ln κ, and v from 0 at β = 0 to 1 where every wavelength is dark.
///
/// ```text
/// v = ln(1 + β) / ln(1 + β_last(κ)),  β_last = 30 (1 + 6/√κ + 3.5/κ)
/// ```
/// Beyond v = 1 the integral is below e^-30 of its peak, whatever the weights. For κ from 1e-300 to 1e300; without branches or
/// calls, so that a loop over it vectorizes.
#[inline(always)]
pub fn position(kappa: f64, beta: f64) -> [f64; 2] {
    [ln(kappa), ln_1p(beta) / ln_last(kappa)]
}

/// Returns true within v = 1. NaN is never within.
#[inline]
pub fn is_lit(kappa: f64, beta: f64) -> bool {
    beta <= last(kappa)
}

/// β at a v of a κ.
pub(super) fn beta_at(kappa: f64, v: f64) -> f64 {
    (v * ln_last(kappa)).exp_m1()
}

/// The logarithm of 1 + β at v = 1.
#[inline(always)]
pub(super) fn ln_last(kappa: f64) -> f64 {
    ln_1p(last(kappa))
}

/// β at v = 1.
#[inline(always)]
fn last(kappa: f64) -> f64 {
    let root = 1.0 / kappa.sqrt();
    DARK * (1.0 + root * (6.0 + 3.5 * root))
}
