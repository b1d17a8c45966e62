//! Ranks of fits as ranges, by a paired bootstrap over the patches (Efron and Tibshirani 1993, *An Introduction to the Bootstrap*).

use chromascope_math::random::SplitMix64;

use super::two_way::{Freedom, Grid, rms};

/// Resamples of the patches.
pub const RESAMPLES: usize = 1000;
/// Start of the pseudorandom numbers: the same resamples on every run.
const SEED: u64 = 0x0043_6872_6F6D_6173;

/// Rank of a fit among others under resampling of the patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RankRange {
    /// First and last rank of the 95 % range: quantiles 0.025 and 0.975 of the ranks, widened to the rank by all patches.
    pub range: [usize; 2],
    /// Share of the resamples in which no other fit has a smaller RMS.
    pub first: f64,
}

/// Rank range of each fit by its residuals of the patches.
pub(super) fn rank_ranges(fits: &[Vec<[Option<f64>; 3]>], freedom: Freedom) -> Vec<RankRange> {
    let count = fits.len();
    let patches = fits.iter().map(Vec::len).min().unwrap_or(0);
    if patches < 2 {
        return vec![RankRange { range: [1, count], first: 1.0 }; count];
    }
    let mut seen = vec![Vec::with_capacity(RESAMPLES); count];
    let mut random = SplitMix64::new(SEED);
    let mut drawn = vec![0; patches];
    for _ in 0..RESAMPLES {
        drawn.fill_with(|| random.below(patches));
        let rms: Vec<f64> = fits.iter().map(|fit| resampled_rms(fit, &drawn, freedom)).collect();
        for (ranks, rank) in seen.iter_mut().zip(ranks(&rms)) {
            ranks.push(rank);
        }
    }
    let all: Vec<f64> = fits.iter().map(|fit| rms(fit.iter().flatten().flatten().copied()).unwrap_or(0.0)).collect();
    let range = |(mut seen, rank): (Vec<usize>, usize)| {
        seen.sort_unstable();
        let at = |share: f64| seen[(share * (RESAMPLES - 1) as f64).round() as usize];
        let first = seen.iter().filter(|&&rank| rank == 1).count() as f64 / RESAMPLES as f64;
        RankRange { range: [at(0.025).min(rank), at(0.975).max(rank)], first }
    };
    seen.into_iter().zip(ranks(&all)).map(range).collect()
}

fn ranks(values: &[f64]) -> Vec<usize> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    values.iter().map(|value| 1 + sorted.partition_point(|other| other < value)).collect()
}

/// RMS of a fit to drawn patches; infinite where none of them has a usable value. A fit of the residuals leaves what a fit of the
/// values leaves, because the model is linear.
fn resampled_rms(fit: &[[Option<f64>; 3]], drawn: &[usize], freedom: Freedom) -> f64 {
    let grid = Grid::new(drawn.iter().map(|&patch| fit[patch]).collect(), freedom);
    rms(grid.fit().residuals.into_iter().flatten().flatten()).unwrap_or(f64::INFINITY)
}
