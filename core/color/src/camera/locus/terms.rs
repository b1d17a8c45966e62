//! Planck's law at many wavelengths side by side, summed with the channels' weights.

use crate::math::array::{array, each};
use crate::math::exp::{exp, exp_m1_near};
use crate::spectral::grid::COUNT;
use multiversion::multiversion;

/// Sums that run side by side: any register's width. Lists are filled up to a multiple.
const LANES: usize = 8;
/// Room for the longest list.
const MOST: usize = COUNT.next_multiple_of(LANES);

/// The longest wavelength λ₀ has the smallest exponent x₀ = c₂/(λ₀T). From here on 1 − e^−x loses nothing by cancellation;
/// below, which is above 56 000 K, all x − x₀ are within what the exponential near 0 is made for.
const PLAIN_FROM: f64 = 0.325;
/// Terms below e^−this of a channel's last one are omitted: all of them together are below its rounding.
const DEPTH: f64 = 52.0;

/// One channel's weights in a list of wavelengths.
#[derive(Clone, Debug, PartialEq)]
struct Channel {
    /// Index in the list at which they begin.
    first: usize,
    /// The weight times (λ₀/λ)⁵, for each wavelength.
    weights: Vec<f64>,
    /// The gap of the last wavelength that weighs.
    last_gap: f64,
    /// Logarithm of the ratio of exponentials, last term's to a term's, beyond which the term is omitted.
    depth: f64,
}

impl Channel {
    /// From the gaps of its wavelengths and their weights.
    fn new(first: usize, gaps: &[f64], weights: Vec<f64>) -> Self {
        let largest = weights.iter().fold(0.0_f64, |largest, weight| largest.max(weight.abs()));
        let last = gaps.iter().zip(&weights).rfind(|&(_, &weight)| weight != 0.0);
        let (last_gap, depth) = last.map_or((0.0, DEPTH), |(&gap, last)| (gap, DEPTH + (largest / last.abs()).ln()));
        Self { first, weights, last_gap, depth }
    }
}

/// Wavelengths λ up to an anchor λ₀ over which Planck's law is summed for three channels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Terms {
    anchor_nm: f64,
    /// (λ₀ − λ)/(λ λ₀), in 1/nm: the difference of the reciprocals without cancellation.
    gaps: Vec<f64>,
    channels: [Channel; 3],
}

impl Terms {
    /// Channels over the same wavelengths in nanometers, each with three weights; from the shortest to the anchor, the last.
    pub(super) fn shared(terms: &[(f64, [f64; 3])], anchor_nm: f64) -> Self {
        let gaps = filled(terms.iter().map(|&(nm, _)| gap(nm, anchor_nm)));
        let channels = [0, 1, 2].map(|c: usize| {
            let weights = terms.iter().map(|&(nm, weights)| weights[c] * (anchor_nm / nm).powi(5));
            Channel::new(0, &gaps, filled(weights))
        });
        Self { anchor_nm, gaps, channels }
    }

    /// Wavelengths and weights of each channel's own, none beyond the anchor; in all no more than the grid has.
    pub(super) fn own(channels: &[Vec<(f64, f64)>; 3], anchor_nm: f64) -> Self {
        let mut gaps = Vec::new();
        let channels = [0, 1, 2].map(|c: usize| {
            let first = gaps.len();
            gaps.extend(filled(channels[c].iter().map(|&(nm, _)| gap(nm, anchor_nm))));
            let weights = channels[c].iter().map(|&(nm, weight)| weight * (anchor_nm / nm).powi(5));
            Channel::new(first, &gaps[first..], filled(weights))
        });
        Self { anchor_nm, gaps, channels }
    }

    /// `Σ w E(λ, T) / E(λ₀, T)` for each channel, for c₂/T in nanometers.
    ///
    /// ```text
    /// E(λ, T)/E(λ₀, T) = (λ₀/λ)⁵ e^−d (1 − e^−x₀)/(1 − e^−d e^−x₀),   d = x − x₀,  x = c₂/(λT)
    /// ```
    /// One exponential a wavelength; d is at least 0, so that nothing overflows.
    pub(super) fn sums(&self, scale: f64) -> [f64; 3] {
        let first = scale / self.anchor_nm;
        let anchor = -(-first).exp_m1();
        let deepest = self.channels.iter().map(|c| c.last_gap + c.depth / scale).fold(0.0, f64::max);
        // The gaps of a shared list fall; those of channels' own are all less deep where they are used.
        let skip = self.gaps.partition_point(|&gap| gap > deepest) / LANES * LANES;
        if first > PLAIN_FROM { plain(self, skip, scale, anchor) } else { hot(self, skip, scale, anchor) }
    }
}

fn gap(nm: f64, anchor_nm: f64) -> f64 {
    (anchor_nm - nm) / (nm * anchor_nm)
}

/// A list filled up with zeros, which weigh nothing.
fn filled(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut list: Vec<f64> = values.collect();
    list.resize(list.len().next_multiple_of(LANES), 0.0);
    list
}

/// Compiled for several instruction sets, the best chosen at run time; no operation is fused, so all of them give the same
/// bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn plain(terms: &Terms, skip: usize, scale: f64, anchor: f64) -> [f64; 3] {
    let rest = 1.0 - anchor;
    let law = |gap| {
        let value = exp(-scale * gap);
        value / (1.0 - value * rest)
    };
    each(sums(terms, skip, law), |sum| sum * anchor)
}

/// Small exponents: 1 − e^−x as the sum of two positive numbers.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn hot(terms: &Terms, skip: usize, scale: f64, anchor: f64) -> [f64; 3] {
    let rest = 1.0 - anchor;
    sums(terms, skip, |gap| {
        let less = exp_m1_near(-scale * gap);
        (1.0 + less) * anchor / (anchor - less * rest)
    })
}

#[inline(always)]
fn sums(terms: &Terms, skip: usize, law: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut buffer = [0.0; MOST];
    let count = terms.gaps.len().min(MOST);
    let values = &mut buffer[..count];
    for (i, value) in values.iter_mut().enumerate().skip(skip) {
        *value = law(terms.gaps[i]);
    }
    let values = &*values;
    array(|c| {
        let Channel { first, weights, .. } = &terms.channels[c];
        let weights = weights.get(skip.saturating_sub(*first)..).unwrap_or_default();
        let mut lanes = [0.0; LANES];
        let (weights, values) = (weights.as_chunks::<LANES>().0, values[skip.max(*first)..].as_chunks::<LANES>().0);
        for i in 0..weights.len().min(values.len()) {
            for lane in 0..LANES {
                lanes[lane] += weights[i][lane] * values[i][lane];
            }
        }
        let [a, b, c, d, e, f, g, h] = lanes;
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    })
}
