//! The inner loops: blocks of responses that stay in registers while wavelengths go by.

use multiversion::multiversion;
use multiversion::target::target_cfg_f;

/// A type of numbers that spectra come in: `f64` or `f32`.
pub trait Sample: Copy + Send + Sync + PartialEq + sealed::Kernel {}

impl Sample for f64 {}
impl Sample for f32 {}

/// Numbers that a register takes from memory at once, where that is quickest: not across two lines of the cache.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Register<T>(T);

pub(super) mod sealed {
    /// What the product needs of a type of numbers.
    pub trait Kernel: Sized {
        /// Zero.
        const ZERO: Self;
        /// As many numbers as a register of AVX2 holds.
        type Lanes: Clone + PartialEq + std::fmt::Debug + Send + Sync;

        /// Whether it is neither infinite nor NaN.
        fn is_finite(&self) -> bool;

        /// Curves of a length, in the order in which [`Self::multiply`] reads them, filled up with zeros.
        fn pack(curves: &[Self], length: usize) -> Vec<Self::Lanes>;

        /// All responses of some spectra to packed curves; neither the length nor the number of channels is 0.
        fn multiply(spectra: &[Self], length: usize, curves: &[Self::Lanes], answers: &mut [Self], channels: usize);
    }
}

/// Spectra and channels of a block. Its sums are 12 of the 16 registers of AVX2: enough to hide how long one takes, few
/// enough that none goes to memory.
const ROWS: usize = 3;
const COLUMNS: usize = 4;

/// How many channels the next block takes when so many are left.
fn columns(left: usize) -> usize {
    left.min(COLUMNS)
}

/// One register of each curve of a block. Written out: a loop over the channels would be turned into one over scattered
/// numbers.
macro_rules! step {
    ($sums:ident, $spectra:expr, $curves:ident, $lanes:literal, $count:ident, $($n:literal)*) => {
        $(if $n < $count {
            let curve = $curves[$n].0;
            for k in 0..$lanes {
                $sums[0][$n][k] = fused::<FUSED>($spectra[0][k], curve[k], $sums[0][$n][k]);
            }
            for k in 0..$lanes {
                $sums[1][$n][k] = fused::<FUSED>($spectra[1][k], curve[k], $sums[1][$n][k]);
            }
            for k in 0..$lanes {
                $sums[2][$n][k] = fused::<FUSED>($spectra[2][k], curve[k], $sums[2][$n][k]);
            }
        })*
    };
}

macro_rules! kernel {
    ($type:ident, $lanes:literal) => {
        pub(super) mod $type {
            use super::*;

            impl sealed::Kernel for $type {
                const ZERO: Self = 0.0;
                type Lanes = Register<[$type; $lanes]>;

                fn is_finite(&self) -> bool {
                    $type::is_finite(*self)
                }

                fn pack(curves: &[Self], length: usize) -> Vec<Self::Lanes> {
                    let registers = length.div_ceil($lanes);
                    let curves: Vec<&[Self]> = curves.chunks(length.max(1)).collect();
                    let mut packed = Vec::with_capacity(curves.len() * registers);
                    for block in curves.chunks(COLUMNS) {
                        for first in (0..length).step_by($lanes) {
                            let at = |curve: &[Self], i: usize| curve.get(i).copied().unwrap_or(0.0);
                            let register = |curve| Register(std::array::from_fn(|k| at(curve, first + k)));
                            packed.extend(block.iter().map(|&curve| register(curve)));
                        }
                    }
                    packed
                }

                fn multiply(
                    spectra: &[Self],
                    length: usize,
                    curves: &[Self::Lanes],
                    answers: &mut [Self],
                    channels: usize,
                ) {
                    multiply(spectra, length, curves, answers, channels);
                }
            }

            /// Compiled for several instruction sets, the best chosen at run time.
            #[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
            fn multiply(
                spectra: &[$type],
                length: usize,
                curves: &[Register<[$type; $lanes]>],
                answers: &mut [$type],
                channels: usize,
            ) {
                if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
                    portable::<true>(spectra, length, curves, answers, channels);
                } else {
                    portable::<false>(spectra, length, curves, answers, channels);
                }
            }

            /// The same for any processor.
            #[allow(clippy::inline_always, reason = "only there is it compiled for the caller's instruction set")]
            #[inline(always)]
            pub(super) fn portable<const FUSED: bool>(
                spectra: &[$type],
                length: usize,
                curves: &[Register<[$type; $lanes]>],
                answers: &mut [$type],
                channels: usize,
            ) {
                let registers = length.div_ceil($lanes);
                for (spectra, answers) in spectra.chunks(ROWS * length).zip(answers.chunks_mut(ROWS * channels)) {
                    // Where there are fewer, the first stands for those that are missing.
                    let row = |r: usize| spectra.get(r * length..(r + 1) * length).unwrap_or(&spectra[..length]);
                    let rows = [row(0), row(1), row(2)].map(|row| row.as_chunks::<$lanes>());
                    let rests = rows.map(|(_, rest)| std::array::from_fn(|k| rest.get(k).copied().unwrap_or(0.0)));
                    let rows = rows.map(|(whole, _)| whole);
                    for done in (0..channels).step_by(COLUMNS) {
                        let count = columns(channels - done);
                        let block = &curves[done * registers..(done + count) * registers];
                        let places = &mut answers[done..];
                        match count {
                            1 => responses::<1, FUSED>(rows, &rests, block, places, channels),
                            2 => responses::<2, FUSED>(rows, &rests, block, places, channels),
                            3 => responses::<3, FUSED>(rows, &rests, block, places, channels),
                            _ => responses::<COLUMNS, FUSED>(rows, &rests, block, places, channels),
                        }
                    }
                }
            }

            /// The responses of the spectra of a block to N channels; those of each are `stride` places further on.
            #[allow(clippy::inline_always, reason = "only there is it compiled for the caller's instruction set")]
            #[inline(always)]
            fn responses<const N: usize, const FUSED: bool>(
                spectra: [&[[$type; $lanes]]; ROWS],
                rests: &[[$type; $lanes]; ROWS],
                curves: &[Register<[$type; $lanes]>],
                answers: &mut [$type],
                stride: usize,
            ) {
                let mut sums = [[[0.0; $lanes]; N]; ROWS];
                let [s0, s1, s2] = spectra;
                let (curves, _) = curves.as_chunks::<N>();
                for (((s0, s1), s2), curves) in s0.iter().zip(s1).zip(s2).zip(curves) {
                    step!(sums, [s0, s1, s2], curves, $lanes, N, 0 1 2 3);
                }
                if let Some(curves) = curves.get(s0.len()) {
                    step!(sums, rests, curves, $lanes, N, 0 1 2 3);
                }
                // A copy: what a function is given the place of cannot have been in registers.
                let kept = sums;
                write(&kept, answers, stride);
            }

            /// The totals. On its own, so that how they are added up does not decide in which registers partial sums are kept.
            #[inline(never)]
            fn write<const N: usize>(sums: &[[[$type; $lanes]; N]; ROWS], answers: &mut [$type], stride: usize) {
                for (answers, sums) in answers.chunks_mut(stride).zip(sums) {
                    for (answer, sums) in answers.iter_mut().zip(sums) {
                        let total = total(*sums);
                        *answer = if total.is_finite() { total } else { 0.0 };
                    }
                }
            }

            /// `a b + sum`, in one rounding or in two.
            #[allow(clippy::inline_always, reason = "only there is it compiled for the caller's instruction set")]
            #[inline(always)]
            fn fused<const FUSED: bool>(a: $type, b: $type, sum: $type) -> $type {
                if FUSED { a.mul_add(b, sum) } else { sum + a * b }
            }

            /// Partial sums, pairwise.
            #[allow(clippy::inline_always, reason = "only there is it compiled for the caller's instruction set")]
            #[inline(always)]
            fn total(mut sums: [$type; $lanes]) -> $type {
                let mut width = $lanes / 2;
                while width > 0 {
                    for k in 0..width {
                        sums[k] += sums[k + width];
                    }
                    width /= 2;
                }
                sums[0]
            }
        }
    };
}

kernel!(f64, 4);
kernel!(f32, 8);

#[cfg(test)]
mod tests {
    use super::sealed::Kernel;
    use super::*;

    /// Powers of two, whose products and sums are exact: then one rounding or two are the same.
    fn exact(count: usize, seed: usize) -> Vec<f64> {
        (0..count).map(|i| f64::from(1_u32 << ((i * 7 + seed) % 11)) * if i % 3 == 0 { -1.0 } else { 1.0 }).collect()
    }

    #[test]
    fn every_instruction_set_gives_the_same_sums() {
        for (length, count, channels) in [(1, 1, 1), (3, 2, 2), (81, 7, 13), (401, 4, 60)] {
            let (spectra, curves) = (exact(length * count, 1), exact(length * channels, 5));
            let packed = <f64 as Kernel>::pack(&curves, length);
            let mut answers = [vec![0.0; count * channels], vec![0.0; count * channels]];
            <f64 as Kernel>::multiply(&spectra, length, &packed, &mut answers[0], channels);
            f64::portable::<false>(&spectra, length, &packed, &mut answers[1], channels);
            assert_eq!(answers[0], answers[1]);
            let narrow = |values: &[f64]| -> Vec<f32> { values.iter().map(|&v| v as f32).collect() };
            let packed = <f32 as Kernel>::pack(&narrow(&curves), length);
            for fused in [true, false] {
                let mut few = vec![0.0; count * channels];
                if fused {
                    <f32 as Kernel>::multiply(&narrow(&spectra), length, &packed, &mut few, channels);
                } else {
                    f32::portable::<false>(&narrow(&spectra), length, &packed, &mut few, channels);
                }
                // Integers to 2²⁴ are exact in single precision, half of those beyond that to 2²⁵.
                let near = |(few, many): (&f32, &f64)| (f64::from(*few) - many).abs() <= 2.0;
                assert!(few.iter().zip(&answers[0]).all(near));
            }
        }
    }
}
