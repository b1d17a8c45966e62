//! The inner loops: blocks of responses that stay in registers while wavelengths go by.

mod ways;

use multiversion::multiversion;
use multiversion::target::match_target;
use prefetch_index::prefetch_index;

/// A type of numbers that spectra come in: `f64` or `f32`.
pub trait Sample: Copy + Send + Sync + PartialEq + sealed::Kernel {}

impl Sample for f64 {}
impl Sample for f32 {}

/// Number of values that a register loads fastest: not across two cache lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Register<T>(T);

pub(super) mod sealed {
    /// Operations that the product needs of a type of numbers.
    pub trait Kernel: Sized {
        /// Zero.
        const ZERO: Self;
        /// Number of values in an AVX2 register.
        const LANES: usize;
        /// Half the distance from 1 to the next number.
        const ROUNDING: f64;
        /// A register.
        type Lanes: Clone + PartialEq + std::fmt::Debug + Send + Sync;

        /// True if neither infinite nor NaN.
        fn is_finite(&self) -> bool;

        /// Curves of a length, in the order in which [`Self::multiply`] reads them, filled up with zeros.
        fn pack(curves: &[Self], length: usize) -> Vec<Self::Lanes>;

        /// All responses of some spectra to packed curves; neither the length nor the number of channels is 0. Far are spectra
        /// that no cache holds.
        fn multiply(
            spectra: &[Self],
            length: usize,
            curves: &[Self::Lanes],
            answers: &mut [Self],
            channels: usize,
            far: bool,
        );
    }
}

/// Spectra and channels of a block. Its sums are 12 of the 16 registers of AVX2: enough to hide how long one takes, few
/// enough that none goes to memory.
pub(super) const ROWS: usize = 3;
const COLUMNS: usize = 4;

/// Bytes that far spectra are requested ahead of those at hand: as many as arrive while one line does.
const AHEAD: usize = 1 << 13;

/// One register of each curve of a block. Written out: a loop over the spectra or channels would be turned into one over
/// scattered numbers.
macro_rules! step {
    ($sums:ident, $rows:expr, $curves:ident, $count:ident) => {
        let rows = $rows;
        step!(@ $sums, rows, $curves, 0);
        if $count > 1 {
            step!(@ $sums, rows, $curves, 1);
        }
        if $count > 2 {
            step!(@ $sums, rows, $curves, 2);
        }
        if $count > 3 {
            step!(@ $sums, rows, $curves, 3);
        }
    };
    (@ $sums:ident, $rows:ident, $curves:ident, $n:literal) => {
        let curve = load(&$curves[$n].0);
        $sums[0][$n] = fuse($rows[0], curve, $sums[0][$n]);
        $sums[1][$n] = fuse($rows[1], curve, $sums[1][$n]);
        $sums[2][$n] = fuse($rows[2], curve, $sums[2][$n]);
    };
}

/// The loops, with the registers and instructions of one of [`ways`].
macro_rules! way {
    ($way:ident, $type:ident, #[$how:meta]) => {
        pub(super) mod $way {
            use super::*;
            use crate::camera::batch::kernel::ways::$type::$way::{fuse, load, totals, zero};

            /// Far and near spectra have loops of their own: in one function both would keep fewer pointers in registers.
            #[$how]
            pub(in super::super) fn multiply<const FAR: bool>(
                (spectra, length): (&[$type], usize),
                curves: &[Lanes],
                (answers, channels): (&mut [$type], usize),
            ) {
                let (mut spectra, mut answers) = (spectra, answers);
                let together = ROWS * length;
                let between = together * (AHEAD / (together * size_of::<$type>()));
                while !spectra.is_empty() {
                    let count = (spectra.len() / length).min(ROWS);
                    let (these, rest) = spectra.split_at(count * length);
                    let (places, others) = answers.split_at_mut(count * channels);
                    // Where spectra are missing, the first stands for them.
                    let mut all = [&these[..length]; ROWS];
                    for row in 1..count {
                        all[row] = &these[row * length..][..length];
                    }
                    let [a, b, c] = all;
                    let rows = [a.as_chunks().0, b.as_chunks().0, c.as_chunks().0];
                    let lasts = [Register(last(a)), Register(last(b)), Register(last(c))];
                    let ahead = if FAR { rest.get(between..).unwrap_or_default() } else { &[] };
                    let block = Block { rows, lasts, ahead, length };
                    channels_of::<FAR>(&block, curves, places, channels);
                    (spectra, answers) = (rest, others);
                }
            }

            /// The responses of all channels.
            #[$how]
            fn channels_of<const FAR: bool>(spectra: &Block, curves: &[Lanes], answers: &mut [$type], channels: usize) {
                let registers = curves.len() / channels;
                // Each block of channels requests its part of spectra further on, evenly: many lines requested at once would
                // keep those of the spectra at hand waiting.
                let parts = channels.div_ceil(COLUMNS).min(ROWS);
                let part = (ROWS * spectra.length).div_ceil(parts);
                for (block, done) in (0..channels).step_by(COLUMNS).enumerate() {
                    let count = (channels - done).min(COLUMNS);
                    let curves = &curves[done * registers..][..count * registers];
                    let places = &mut answers[done..];
                    let ahead = spectra.ahead(block * part, part);
                    match count {
                        1 => some::<1, FAR>(spectra, curves, places, channels, ahead),
                        2 => some::<2, FAR>(spectra, curves, places, channels, ahead),
                        3 => some::<3, FAR>(spectra, curves, places, channels, ahead),
                        _ => some::<COLUMNS, FAR>(spectra, curves, places, channels, ahead),
                    }
                }
            }

            /// The responses of N channels; those of each spectrum are `stride` places further on. Where they are far, those ahead are
            /// requested, at most two lines in each step.
            #[$how]
            fn some<const N: usize, const FAR: bool>(
                spectra: &Block,
                curves: &[Lanes],
                places: &mut [$type],
                stride: usize,
                ahead: &[$type],
            ) {
                let mut sums = [[zero(); COLUMNS]; ROWS];
                let [a, b, c] = spectra.rows;
                let curves = curves.as_chunks::<N>().0;
                let whole = a.len().min(b.len()).min(c.len());
                let (a, b, c) = (&a[..whole], &b[..whole], &c[..whole]);
                // With a pointer of its own: by index it would be recomputed in each step.
                let mut rest = curves.iter();
                let pace = if FAR { ahead.len().div_ceil(whole.max(1)) } else { 0 };
                for i in 0..whole {
                    let Some(curves) = rest.next() else { break };
                    if FAR {
                        prefetch_index(ahead, i * pace);
                        prefetch_index(ahead, i * pace + pace / 2);
                    }
                    step!(sums, [load(&a[i]), load(&b[i]), load(&c[i])], curves, N);
                }
                if let Some(curves) = rest.next() {
                    let [a, b, c] = &spectra.lasts;
                    step!(sums, [load(&a.0), load(&b.0), load(&c.0)], curves, N);
                }
                for row in 0..places.len().div_ceil(stride).min(ROWS) {
                    let (places, totals) = (&mut places[row * stride..][..N], totals(sums[row]));
                    for n in 0..N {
                        places[n] = totals[n];
                    }
                }
            }
        }
    };
}

macro_rules! kernel {
    ($type:ident, $lanes:literal) => {
        pub(super) mod $type {
            use super::*;

            /// Contents of a register.
            type Lanes = Register<[$type; $lanes]>;

            /// Number of spectra multiplied together.
            struct Block<'a> {
                /// Their whole registers.
                rows: [&'a [[$type; $lanes]]; ROWS],
                /// Their last ones.
                lasts: [Lanes; ROWS],
                /// Spectra further on, if they are far.
                ahead: &'a [$type],
                length: usize,
            }

            impl sealed::Kernel for $type {
                const ZERO: Self = 0.0;
                const LANES: usize = $lanes;
                const ROUNDING: f64 = $type::EPSILON as f64 / 2.0;
                type Lanes = Lanes;

                fn is_finite(&self) -> bool {
                    $type::is_finite(*self)
                }

                fn pack(curves: &[Self], length: usize) -> Vec<Lanes> {
                    let registers = length.div_ceil($lanes);
                    let curves: Vec<&[Self]> = curves.chunks(length.max(1)).collect();
                    let mut packed = Vec::with_capacity(curves.len() * registers);
                    for block in curves.chunks(COLUMNS) {
                        for first in (0..length).step_by($lanes) {
                            packed.extend(block.iter().map(|curve| Register(register(curve, first))));
                        }
                    }
                    packed
                }

                fn multiply(spectra: &[Self], length: usize, curves: &[Lanes], answers: &mut [Self], channels: usize, far: bool) {
                    multiply((spectra, length), curves, (answers, channels), far);
                }
            }

            /// One register of a curve. In the last, what it repeats of the one before counts only once.
            fn register(curve: &[$type], first: usize) -> [$type; $lanes] {
                match curve.get(first..first + $lanes) {
                    Some(whole) => std::array::from_fn(|k| whole[k]),
                    None if first == 0 => last(curve),
                    None => {
                        let mut register = last(curve);
                        register[..first + $lanes - curve.len()].fill(0.0);
                        register
                    }
                }
            }

            /// Compiled for several instruction sets, the best chosen at run time. Each rounds a product and its sum once, if
            /// need be in software, so all of them give the same bits.
            #[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
            fn multiply(
                spectra: (&[$type], usize),
                curves: &[Lanes],
                answers: (&mut [$type], usize),
                far: bool,
            ) {
                match_target! {
                    "x86_64+avx2+fma" => if far {
                        avx2::multiply::<true>(spectra, curves, answers);
                    } else {
                        avx2::multiply::<false>(spectra, curves, answers);
                    },
                    _ => if far {
                        portable::multiply::<true>(spectra, curves, answers);
                    } else {
                        portable::multiply::<false>(spectra, curves, answers);
                    },
                }
            }

            way!(portable, $type, #[inline(always)]);
            #[cfg(target_arch = "x86_64")]
            way!(avx2, $type, #[target_feature(enable = "avx2,fma")]);

            /// The last register of numbers that do not fill it: some are in the one before, too.
            #[inline(always)]
            fn last(numbers: &[$type]) -> [$type; $lanes] {
                if let Some(last) = numbers.last_chunk() {
                    return *last;
                }
                let mut padded = [0.0; $lanes];
                padded[..numbers.len()].copy_from_slice(numbers);
                padded
            }

            impl Block<'_> {
                /// So many samples of the spectra further on, if they are far.
                #[inline]
                fn ahead(&self, start: usize, count: usize) -> &[$type] {
                    let ahead = &self.ahead[..self.ahead.len().min(ROWS * self.length)];
                    ahead.get(start..).map_or(&[], |ahead| &ahead[..count.min(ahead.len())])
                }
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
    use crate::math::random::SplitMix64;

    fn numbers(count: usize, seed: u64) -> Vec<f64> {
        let mut random = SplitMix64::new(seed);
        (0..count).map(|_| random.unit() - 0.3).collect()
    }

    #[test]
    fn every_instruction_set_and_way_to_read_gives_the_same_bits() {
        for (length, count, channels) in [(1, 1, 1), (3, 2, 2), (4, 5, 9), (81, 7, 13), (401, 4, 60)] {
            let (spectra, curves) = (numbers(length * count, 1), numbers(length * channels, 5));
            let packed = <f64 as Kernel>::pack(&curves, length);
            let mut answers = vec![0.0; count * channels];
            <f64 as Kernel>::multiply(&spectra, length, &packed, &mut answers, channels, false);
            for multiply in [f64::portable::multiply::<false>, f64::portable::multiply::<true>] {
                let mut others = vec![0.0; count * channels];
                multiply((&spectra, length), &packed, (&mut others, channels));
                assert_eq!(answers, others);
            }
            let narrow = |values: &[f64]| -> Vec<f32> { values.iter().map(|&v| v as f32).collect() };
            let (spectra, packed) = (narrow(&spectra), <f32 as Kernel>::pack(&narrow(&curves), length));
            let mut answers = vec![0.0; count * channels];
            <f32 as Kernel>::multiply(&spectra, length, &packed, &mut answers, channels, true);
            let mut others = vec![0.0; count * channels];
            f32::portable::multiply::<false>((&spectra, length), &packed, (&mut others, channels));
            assert_eq!(answers, others);
        }
    }
}
