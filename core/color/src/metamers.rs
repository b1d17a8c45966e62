//! Metamers: pairs of reflectances that a camera confuses and an observer separates, and the reverse.

use crate::colorimetry::lab::lightness;
use crate::colorimetry::{Lab, delta_e_2000};
use crate::units::{bits, hash_by};

/// The eye or the camera, whichever takes two colors for one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Confusion {
    /// The camera confuses what the observer separates.
    Camera,
    /// The observer confuses what the camera separates.
    Observer,
}

/// A reflectance as camera and observer see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The camera's RGB, balanced to unity.
    pub rgb: [f64; 3],
    /// The observer's L\*a\*b\*.
    pub lab: Lab,
}

impl Seen {
    /// Balanced channels through the CIE lightness function, so that a difference means as much in the dark as in the light.
    fn levels(&self) -> [f64; 3] {
        self.rgb.map(lightness)
    }
}

/// Differences below which two colors are one, and above which they are two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetamerLimits {
    confused: f64,
    separated: f64,
}

hash_by!(MetamerLimits, |of| [of.confused, of.separated].map(bits));

/// Reason that numbers are no limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[error("limits of metamers must be positive numbers, at most 1000")]
pub struct MetamerLimitsError;

impl MetamerLimits {
    /// Half a unit for one that confuses, two for one that separates.
    pub const USUAL: Self = Self { confused: 0.5, separated: 2.0 };

    /// Limits for the one that confuses and for the one that separates: ΔE*00 of the observer, lightness units of the camera's channels.
    ///
    /// # Errors
    /// [`MetamerLimitsError`] unless both are positive and at most 1000.
    pub fn new(confused: f64, separated: f64) -> Result<Self, MetamerLimitsError> {
        let usable = |limit: f64| limit > 0.0 && limit <= 1000.0;
        if usable(confused) && usable(separated) { Ok(Self { confused, separated }) } else { Err(MetamerLimitsError) }
    }
}

/// Two reflectances that one of camera and observer confuses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetamerPair {
    /// Places of the two in the list that was searched, the smaller first.
    pub places: [usize; 2],
    /// Largest difference of a balanced channel, each through the CIE lightness function (0 to 100).
    pub camera_difference: f64,
    /// ΔE\*00 to the observer.
    pub observer_difference: f64,
}

/// Bound of `S_L` of CIEDE2000 among colors, with which `|ΔL*| ≤ S_L ΔE*00`: `1 + 0.015 |L* − 50|`, 1.75 from black to white.
fn largest_s_l(colors: &[Seen]) -> f64 {
    let off = colors.iter().map(|color| (color.lab.l - 50.0).abs()).filter(|off| off.is_finite()).fold(0.0, f64::max);
    1.0 + 0.015 * off
}

/// Pairs that one confuses and the other separates, worst first, at most `most`.
///
/// ```text
/// Camera:    max_c |L*(I_c) − L*(I'_c)| ≤ confused   and   ΔE*00 ≥ separated,   largest ΔE*00 first
/// Observer:  ΔE*00 ≤ confused   and   max_c |L*(I_c) − L*(I'_c)| ≥ separated,   largest of that first
/// ```
/// `L*(I)` is the CIE lightness of a balanced channel. The list is sorted by one coordinate in which confused colors are near (green, or
/// L* by `|ΔL*| ≤ S_L ΔE*00`), so that only neighbors are compared: about `n² w` pairs for windows of a share w of the range, and ΔE*00 of
/// those alone whose channels decide nothing. Every pair within the limits is found. Colors that are not finite are omitted.
/// Incomplete once `stop` says so.
pub fn search(
    colors: &[Seen],
    confusion: Confusion,
    limits: MetamerLimits,
    most: usize,
    stop: impl Fn() -> bool,
) -> Vec<MetamerPair> {
    let levels: Vec<[f64; 3]> = colors.iter().map(Seen::levels).collect();
    let (key, window): (Vec<f64>, f64) = match confusion {
        Confusion::Camera => (levels.iter().map(|level| level[1]).collect(), limits.confused),
        Confusion::Observer => {
            (colors.iter().map(|color| color.lab.l).collect(), largest_s_l(colors) * limits.confused)
        }
    };
    let finite = |at: &usize| {
        let Lab { l, a, b } = colors[*at].lab;
        levels[*at].iter().chain([&l, &a, &b]).all(|v| v.is_finite())
    };
    let mut order: Vec<usize> = (0..colors.len()).filter(finite).collect();
    order.sort_by(|&a, &b| key[a].total_cmp(&key[b]));
    let mut found = Vec::new();
    for (at, &first) in order.iter().enumerate().take_while(|_| !stop()) {
        for &second in order[at + 1..].iter().take_while(|&&second| key[second] - key[first] <= window) {
            let apart = (0..3).map(|c| (levels[first][c] - levels[second][c]).abs()).fold(0.0, f64::max);
            let possible = match confusion {
                Confusion::Camera => apart <= limits.confused,
                Confusion::Observer => apart >= limits.separated,
            };
            if !possible {
                continue;
            }
            let delta_e = delta_e_2000(colors[first].lab, colors[second].lab);
            let is_pair = match confusion {
                Confusion::Camera => delta_e >= limits.separated,
                Confusion::Observer => delta_e <= limits.confused,
            };
            if is_pair {
                let places = [first.min(second), first.max(second)];
                found.push(MetamerPair { places, camera_difference: apart, observer_difference: delta_e });
            }
        }
    }
    let severity = |pair: &MetamerPair| match confusion {
        Confusion::Camera => pair.observer_difference,
        Confusion::Observer => pair.camera_difference,
    };
    found.sort_by(|a, b| severity(b).total_cmp(&severity(a)).then(a.places.cmp(&b.places)));
    found.truncate(most);
    found
}
