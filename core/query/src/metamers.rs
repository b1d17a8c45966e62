//! Query for metamers among sets of reflectances.

use super::ask::{Ask, Query, Shared};
use super::compare::DifferenceError;
use super::metrics::WhyNot;
use super::patches::{PatchColorsQuery, RenderingQuery};
use chromascope_color::camera::RenderingError;
use chromascope_color::camera::rendering::{raw, under_light, white_divisors};
use chromascope_color::metamers::{Confusion, MetamerLimits, MetamerPair, Seen, search};
use chromascope_color::patch_set::PatchSet;

/// Pairs of reflectances that a camera confuses and the reference separates, or the reverse.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MetamersQuery {
    /// The camera under its light. Balance and color transform do not matter: signals are balanced to unity.
    pub rendering: RenderingQuery,
    /// The reference observer under the same light.
    pub reference: RenderingQuery,
    /// The sets that are searched, as one list.
    pub sets: Vec<Shared<PatchSet>>,
    /// The one that confuses.
    pub confusion: Confusion,
    /// Differences that count.
    pub limits: MetamerLimits,
    /// Maximum number of pairs in the result.
    pub most: usize,
}

/// Metamers, worst first.
#[derive(Clone, Debug, PartialEq)]
pub struct Metamers {
    /// The pairs; places count through all sets.
    pub pairs: Vec<MetamerPair>,
    /// Number of reflectances that were searched.
    pub searched: usize,
}

impl MetamersQuery {
    /// Set and patch at a place of the list.
    pub fn at(&self, place: usize) -> Option<[usize; 2]> {
        let mut left = place;
        for (set, patches) in self.sets.iter().enumerate() {
            let count = patches.patches().len();
            if left < count {
                return Some([set, left]);
            }
            left -= count;
        }
        None
    }
}

impl Query for MetamersQuery {
    type Answer = Result<Metamers, WhyNot>;
    const NAME: &'static str = "metamers";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let RenderingQuery { sensor, light, .. } = &self.rendering;
        let divisors = white_divisors(sensor, light)?;
        if divisors.abs().min_element() == 0.0 {
            return Err(RenderingError::NoWhite.into());
        }
        let product = under_light(sensor, light);
        let mut colors = Vec::new();
        for patches in &self.sets {
            let (rendering, patches) = (self.reference.clone(), patches.clone());
            let seen = ask.ask(&PatchColorsQuery { rendering, patches: patches.clone() });
            let seen = (*seen).as_ref().map_err(|&e| e)?;
            for (patch, color) in patches.patches().iter().zip(seen) {
                let rgb = (raw(&product, patch.grid.values()) / divisors).to_array();
                colors.push(Seen { rgb, lab: color.lab.ok_or(DifferenceError::NoLab)? });
            }
        }
        let stop = ask.stop();
        let pairs = search(&colors, self.confusion, self.limits, self.most, || stop.is_set());
        Ok(Metamers { pairs, searched: colors.len() })
    }
}
