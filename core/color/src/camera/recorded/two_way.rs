//! Two-way additive model of logarithms by least squares, and the ranks of fits under resampling of the patches.

use chromascope_math::random::SplitMix64;
use glam::{DMat3, DVec3};

/// Parameters of the model that are fitted. One overall scale always is, because tables of sensitivities are relative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Freedom {
    /// True if each channel has a gain of its own; false if all share one.
    pub gains: bool,
    /// True if each patch has a brightness of its own; false if all have brightness 1.
    pub brightness: bool,
}

impl Default for Freedom {
    fn default() -> Self {
        Self { gains: true, brightness: true }
    }
}

/// Data of the model; a missing value has weight 0.
pub(super) struct Grid {
    data: Vec<[Option<f64>; 3]>,
    freedom: Freedom,
}

/// Effects and what they leave.
pub(super) struct Effects {
    pub(super) channels: [Option<f64>; 3],
    pub(super) patches: Vec<Option<f64>>,
    pub(super) residuals: Vec<[Option<f64>; 3]>,
}

impl Grid {
    pub(super) fn new(data: Vec<[Option<f64>; 3]>, freedom: Freedom) -> Self {
        Self { data, freedom }
    }

    pub(super) fn values(&self) -> usize {
        self.data.iter().flatten().flatten().count()
    }

    /// Number of independent parameters: the rank of the model.
    pub(super) fn parameters(&self) -> usize {
        let channels = (0..3).filter(|&c| self.data.iter().any(|row| row[c].is_some())).count();
        let patches = self.data.iter().filter(|row| row.iter().any(Option::is_some)).count();
        match (self.freedom.gains, self.freedom.brightness) {
            (false, false) => channels.min(1),
            (true, false) => channels,
            (false, true) => patches,
            (true, true) => {
                let groups = self.groups();
                let count = (0..3).filter(|&c| groups[c] == Some(c)).count();
                channels + patches - count
            }
        }
    }

    /// Fits the grid's own data.
    pub(super) fn fit(&self) -> Effects {
        self.fit_column(&self.data)
    }

    /// Fits another column of numbers that lie where the grid's data do.
    pub(super) fn fit_column(&self, data: &[[Option<f64>; 3]]) -> Effects {
        let mut channels = match (self.freedom.gains, self.freedom.brightness) {
            (false, _) => [0.0; 3],
            (true, false) => [0, 1, 2].map(|c: usize| mean(data.iter().map(|row| row[c])).unwrap_or(0.0)),
            (true, true) => self.reduced(data),
        };
        let mut patches: Vec<Option<f64>> =
            data.iter().map(|row| mean((0..3).map(|c| row[c].map(|d| d - channels[c])))).collect();
        // The common factor of all values belongs to the gains.
        let level = if self.freedom.brightness {
            mean(patches.iter().copied())
        } else if self.freedom.gains {
            None
        } else {
            mean(data.iter().flatten().copied())
        };
        let level = level.unwrap_or(0.0);
        channels = channels.map(|a| a + level);
        for patch in patches.iter_mut().flatten() {
            *patch = if self.freedom.brightness { *patch - level } else { 0.0 };
        }
        let residual = |(row, b): (&[Option<f64>; 3], &Option<f64>)| {
            [0, 1, 2].map(|c: usize| row[c].map(|d| d - channels[c] - b.unwrap_or(0.0)))
        };
        let residuals = data.iter().zip(&patches).map(residual).collect();
        let used = |c: usize| data.iter().any(|row| row[c].is_some()).then_some(channels[c]);
        Effects { channels: [0, 1, 2].map(used), patches, residuals }
    }

    /// Channels' effects after the patches' are eliminated: `Σ_p (diag w − w wᵀ / n) a = Σ_p w ∘ (d − mean d)`. Within each group
    /// of channels that patches connect the effects sum to zero.
    fn reduced(&self, data: &[[Option<f64>; 3]]) -> [f64; 3] {
        let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for row in data {
            let weights = DVec3::from_array(row.map(|d| f64::from(u8::from(d.is_some()))));
            let count = weights.element_sum();
            let Some(mean) = mean(row.iter().copied()) else { continue };
            let outer = DMat3::from_cols(weights * weights.x, weights * weights.y, weights * weights.z);
            matrix += DMat3::from_diagonal(weights) - outer * count.recip();
            right += DVec3::from_array(row.map(|d| d.map_or(0.0, |d| d - mean)));
        }
        let groups = self.groups();
        for (i, group) in groups.iter().enumerate() {
            for (j, other) in groups.iter().enumerate() {
                let together = if group.is_some() { group == other } else { i == j };
                matrix.col_mut(j)[i] += f64::from(u8::from(together));
            }
        }
        (matrix.inverse() * right).to_array()
    }

    /// For each channel the first of those that patches connect it with; none for a channel without a value.
    fn groups(&self) -> [Option<usize>; 3] {
        let mut groups = [0, 1, 2].map(|c| self.data.iter().any(|row| row[c].is_some()).then_some(c));
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            if self.data.iter().any(|row| row[a].is_some() && row[b].is_some()) {
                let (into, from) = (groups[a].min(groups[b]), groups[a].max(groups[b]));
                groups = groups.map(|group| if group == from { into } else { group });
            }
        }
        groups
    }
}

fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let (count, sum) = values.flatten().fold((0_usize, 0.0), |(n, sum), value| (n + 1, sum + value));
    (count > 0).then(|| sum / count as f64)
}

pub(super) fn rms(residuals: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, squares) = residuals.fold((0_usize, 0.0), |(n, sum), value| (n + 1, sum + value * value));
    (count > 0).then(|| (squares / count as f64).sqrt())
}

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
