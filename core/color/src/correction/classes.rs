//! Classes of training reflectances by their color, and their weights.

use crate::colorimetry::lab::lab_from_xyz;
use crate::colorimetry::{Lab, Xyz};
use crate::units::{bits, hash_by};
use chromascope_text::choices;
use glam::DVec3;

choices! {
    /// Class of a reflectance by its color under the light, to the reference observer.
    ///
    /// | class | L\* | C\*ab | hue angle |
    /// |---|---|---|---|
    /// | neutral | any | up to 5 | any |
    /// | skin | 25–90 | 8–40 | 30°–80° |
    /// | foliage | 15–80 | 10–60 | 100°–160° |
    /// | sky | 30–90 | 8–50 | 220°–290° |
    ///
    /// The bounds are this program's: boxes around the memory colors of a `ColorChecker` (dark and light skin, foliage, blue sky).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum ColorClass {
        /// Near gray.
        Neutral = "neutrals", "Neutrals", "Near gray";
        /// Like skin.
        Skin = "skin", "Skin", "Like skin";
        /// Like leaves.
        Foliage = "foliage", "Foliage", "Like leaves";
        /// Like the blue sky.
        Sky = "sky", "Sky", "Like the blue sky";
    }
}

impl ColorClass {
    /// The class of a color; none for all others.
    pub fn of(lab: Lab) -> Option<Self> {
        let (chroma, hue) = (lab.a.hypot(lab.b), lab.b.atan2(lab.a).to_degrees().rem_euclid(360.0));
        let within = |l: [f64; 2], c: [f64; 2], h: [f64; 2]| {
            (l[0]..=l[1]).contains(&lab.l) && (c[0]..=c[1]).contains(&chroma) && (h[0]..=h[1]).contains(&hue)
        };
        if chroma <= 5.0 {
            Some(Self::Neutral)
        } else if within([25.0, 90.0], [8.0, 40.0], [30.0, 80.0]) {
            Some(Self::Skin)
        } else if within([15.0, 80.0], [10.0, 60.0], [100.0, 160.0]) {
            Some(Self::Foliage)
        } else if within([30.0, 90.0], [8.0, 50.0], [220.0, 290.0]) {
            Some(Self::Sky)
        } else {
            None
        }
    }

    /// The classes of tristimulus values under a white.
    pub fn of_targets(targets: &[DVec3], white: Xyz) -> Vec<Option<Self>> {
        let class = |target: &DVec3| lab_from_xyz(Xyz::from_vector(*target), white).and_then(Self::of);
        targets.iter().map(class).collect()
    }
}

/// Weights of the classes in a fit, 0 to [`Self::MOST`]; all other reflectances have 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassWeights([f64; 4]);

impl Default for ClassWeights {
    fn default() -> Self {
        Self([1.0; 4])
    }
}

hash_by!(ClassWeights, |of| of.0.map(bits));

impl ClassWeights {
    /// The largest weight.
    pub const MOST: f64 = 100.0;

    /// Weights in the order of [`ColorClass::ALL`]; what is outside the range is clamped, NaN counts as 1.
    pub fn new(weights: [f64; 4]) -> Self {
        Self(weights.map(|weight| if weight.is_nan() { 1.0 } else { weight.clamp(0.0, Self::MOST) }))
    }

    /// Weight of a class.
    pub fn of(self, class: ColorClass) -> f64 {
        self.0[class as usize]
    }

    /// The weight of each training reflectance.
    pub fn for_targets(self, targets: &[DVec3], white: Xyz) -> Vec<f64> {
        if self == Self::default() {
            return vec![1.0; targets.len()];
        }
        ColorClass::of_targets(targets, white)
            .into_iter()
            .map(|class| class.map_or(1.0, |class| self.of(class)))
            .collect()
    }
}
