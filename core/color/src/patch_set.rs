//! Named reflectances: charts, training data, materials.

use crate::spectral::{Dataset, GridSpectrum, Quantity, SpectralDistribution};
use crate::units::hash_by;

/// One reflectance with its name, measured and on the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its name, such as `orange yellow`.
    pub name: String,
    /// As measured.
    pub measured: SpectralDistribution,
    /// On the standard grid.
    pub grid: GridSpectrum,
}

hash_by!(Patch, |of| (&of.name, &of.measured));

/// A set of reflectances: a chart, training data, materials.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PatchSet {
    patches: Vec<Patch>,
}

/// The five patches that the paper shows, C1 to C5, by their `ColorChecker` names.
pub const PAPER_FIVE: [&str; 5] = ["red", "green", "blue", "white", "orange yellow"];

/// The 18 chromatic patches of the `ColorChecker`, by their names.
pub const COLOR_CHECKER_CHROMATIC: [&str; 18] = [
    "dark skin",
    "light skin",
    "blue sky",
    "foliage",
    "blue flower",
    "bluish green",
    "orange",
    "purplish blue",
    "moderate red",
    "purple",
    "yellow green",
    "orange yellow",
    "blue",
    "green",
    "red",
    "yellow",
    "magenta",
    "cyan",
];

impl PatchSet {
    /// Brings named reflectances (1 for a perfect white) onto the grid.
    pub fn new(reflectances: impl IntoIterator<Item = (String, SpectralDistribution)>) -> Self {
        let patches = reflectances
            .into_iter()
            .map(|(name, measured)| {
                let grid = GridSpectrum::resample(&measured, Quantity::Reflectance);
                Patch { name, measured, grid }
            })
            .collect();
        Self { patches }
    }

    /// All columns of a data set.
    pub fn from_dataset(dataset: &Dataset) -> Self {
        Self::new(dataset.header.columns.iter().cloned().zip(dataset.curves.iter().cloned()))
    }

    /// The patches in order.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Those with the given names, in the order of the names; names that the set does not have are omitted.
    #[must_use]
    pub fn subset(&self, names: &[&str]) -> Self {
        let found = names.iter().filter_map(|name| self.patches.iter().find(|patch| patch.name == *name));
        Self { patches: found.cloned().collect() }
    }
}
