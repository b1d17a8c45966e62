//! Tables of one camera model against each other.

use glam::DVec3;

use super::prior::relative_distance;
use super::profile::{difference, fitted};
use crate::correction::Correction;
use crate::math::least_squares::FitError;
use crate::patch_set::PatchSet;
use crate::spectral::grid::{COUNT, FIRST_NM};
use crate::spectral::{GridSpectrum, Sensor};

/// Least share of a channel's peak at which a table's end counts as open.
const OPEN: f64 = 0.05;

/// Difference of a table from another of the same model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableDifference {
    /// Root mean square of each channel's difference relative to its own, at the scale that fits best, where both tables have samples.
    pub curves: [f64; 3],
    /// Mean CIEDE2000 between the colors of patches, each table through its own matrix.
    pub delta_e: f64,
}

impl TableDifference {
    /// Compares two tables; matrices are fitted to the patches under the light, white kept.
    ///
    /// # Errors
    /// [`FitError`] where a table does not see the light or the patches determine no matrix.
    pub fn new(
        tables: [&Sensor; 2],
        light: &GridSpectrum,
        observer: &Sensor,
        patches: &PatchSet,
    ) -> Result<Self, FitError> {
        let [from, to] = tables.map(Sensor::support_nm);
        let first = (from[0].max(to[0]) - FIRST_NM).ceil().max(0.0) as usize;
        let last = ((from[1].min(to[1]) - FIRST_NM).floor().max(0.0) as usize).min(COUNT - 1);
        let curve = |table: &Sensor, c: usize| (first..=last).map(|i| table.at_index(i)[c]).collect::<Vec<f64>>();
        let curves = [0, 1, 2].map(|c| relative_distance(&curve(tables[0], c), &curve(tables[1], c)));
        let white = DVec3::from(observer.integrate(light.values()));
        let radiances: Vec<GridSpectrum> = patches.patches().iter().map(|patch| patch.grid.times(light)).collect();
        let colors = |table: &Sensor| -> Result<Vec<DVec3>, FitError> {
            let diffuser = DVec3::from(table.integrate(light.values()));
            let pair = |radiance: &GridSpectrum| {
                let of = |sensor: &Sensor| DVec3::from(sensor.integrate(radiance.values()));
                (of(table) / diffuser, of(observer) / white.y)
            };
            let pairs: Vec<(DVec3, DVec3)> = radiances.iter().map(pair).collect();
            let matrix = fitted(pairs.iter().copied(), &Correction::default(), white / white.y)?;
            Ok(pairs.into_iter().map(|(rgb, _)| matrix.xyz(rgb)).collect())
        };
        let pairs = colors(tables[0])?.into_iter().zip(colors(tables[1])?);
        let all: Vec<f64> = pairs.filter_map(|(a, b)| difference(a, b, white / white.y)).collect();
        Ok(Self { curves, delta_e: all.iter().sum::<f64>() / all.len().max(1) as f64 })
    }
}

/// Ends of a table within 380–780 nm at which a channel is above 5 % of its peak: channel, wavelength in nanometers, share of the peak.
/// Beyond them the response is unknown.
pub fn open_ends(table: &Sensor) -> Vec<(usize, f64, f64)> {
    let ends = table.support_nm();
    let at = |nm: f64, c: usize| table.at_index(((nm - FIRST_NM).max(0.0).round() as usize).min(COUNT - 1))[c];
    let share = |c: usize, nm: f64| {
        let peak = (0..COUNT).map(|i| table.at_index(i)[c]).fold(f64::MIN_POSITIVE, f64::max);
        (c, nm, at(nm, c) / peak)
    };
    let all = (0..3).flat_map(|c| ends.map(|nm| share(c, nm)));
    all.filter(|(.., share)| *share > OPEN).collect()
}
