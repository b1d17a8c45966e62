//! Evidence that a table of sensitivities holds the ratio between the camera's channels.
//!
//! White balance divides the ratio out of colors, so most figures do not depend on it. Noise, `AsShotNeutral`, DNG's `ColorMatrix` and
//! balance multipliers do.

use crate::math::quantile::quantile;
use crate::spectral::{GridSpectrum, Sensor};
use crate::units::{bits, hash_by};
use std::fmt;

/// Relative difference within which three channel maxima are equal: agreement that no measurement shows by chance.
pub const EQUAL_MAXIMA: f64 = 1e-6;
/// Relative deviation from the maker's other tables beyond which a ratio is implausible.
pub const IMPLAUSIBLE: f64 = 0.15;
/// Fewest other tables of the maker that a ratio is checked against.
pub const FEWEST_TABLES: usize = 3;

/// Reason that a table does not hold the ratio.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RatioLoss {
    /// Each channel is scaled to the same maximum, to [`EQUAL_MAXIMA`].
    EqualMaxima,
    /// Curves read off a printed figure: it shows their shapes, at a height that no source states.
    PrintedFigure,
}

/// Neutral of one table, as [`ChannelRatio::new`] compares it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatioTable {
    /// R/G and B/G of a perfect diffuser; none where a channel has no positive signal.
    pub neutral: Option<[f64; 2]>,
    /// Reason that the ratio is not in the table, if it is not.
    pub loss: Option<RatioLoss>,
}

impl RatioTable {
    /// Neutral of a camera under a light, D65 by convention. `is_digitized` marks curves read off a printed figure.
    pub fn new(camera: &Sensor, light: &GridSpectrum, is_digitized: bool) -> Self {
        let [red, green, blue] = camera.integrate(light.values());
        let neutral = Some([red / green, blue / green]).filter(|n| n.iter().all(|v| v.is_finite() && *v > 0.0));
        let loss = has_equal_maxima(camera).then_some(RatioLoss::EqualMaxima);
        Self { neutral, loss: loss.or_else(|| is_digitized.then_some(RatioLoss::PrintedFigure)) }
    }
}

/// True if the three channel maxima agree within [`EQUAL_MAXIMA`]: each channel was scaled on its own.
pub fn has_equal_maxima(camera: &Sensor) -> bool {
    let maxima = camera.curves().each_ref().map(|curve| curve.values().iter().fold(0.0_f64, |m, v| m.max(*v)));
    maxima.iter().all(|maximum| (maximum - maxima[0]).abs() <= EQUAL_MAXIMA * maxima[0])
}

/// Deviation of a neutral from those of the maker's other tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatioDeviation {
    /// Relative deviations of R/G and B/G from the median.
    pub deviation: [f64; 2],
    /// Number of tables that the median is over.
    pub tables: usize,
}

hash_by!(RatioDeviation, |of| (of.deviation.map(bits), of.tables));

/// Credibility of the ratio between a table's channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChannelRatio {
    /// Within [`IMPLAUSIBLE`] of the maker's other tables.
    Plausible(RatioDeviation),
    /// The maker has fewer than [`FEWEST_TABLES`] other tables that hold the ratio.
    Unchecked,
    /// The table does not hold the ratio.
    Lost(RatioLoss),
    /// Beyond [`IMPLAUSIBLE`] from the maker's other tables.
    Implausible(RatioDeviation),
}

impl ChannelRatio {
    /// Checks a table against the other tables of its maker; those that lost their ratio do not count.
    ///
    /// ```text
    /// implausible: |(R/G) / median(R/G) − 1| > 0.15  or  |(B/G) / median(B/G) − 1| > 0.15
    /// ```
    pub fn new(table: &RatioTable, others: impl IntoIterator<Item = RatioTable>) -> Self {
        if let Some(loss) = table.loss {
            return Self::Lost(loss);
        }
        let known: Vec<[f64; 2]> =
            others.into_iter().filter(|other| other.loss.is_none()).filter_map(|other| other.neutral).collect();
        let median = |c: usize| quantile(&mut known.iter().map(|neutral| neutral[c]).collect::<Vec<_>>(), 0.5);
        let (Some(own), Some(red), Some(blue), true) =
            (table.neutral, median(0), median(1), known.len() >= FEWEST_TABLES)
        else {
            return Self::Unchecked;
        };
        let deviation = [own[0] / red - 1.0, own[1] / blue - 1.0];
        let found = RatioDeviation { deviation, tables: known.len() };
        let implausible = deviation.iter().any(|deviation| deviation.abs() > IMPLAUSIBLE);
        if implausible { Self::Implausible(found) } else { Self::Plausible(found) }
    }

    /// True unless the ratio is lost or implausible.
    pub fn is_credible(self) -> bool {
        matches!(self, Self::Plausible(_) | Self::Unchecked)
    }
}

impl fmt::Display for ChannelRatio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (word, RatioDeviation { deviation, tables }) = match self {
            Self::Unchecked => return f.write_str("unchecked: fewer than three other tables of the maker hold one"),
            Self::Lost(RatioLoss::EqualMaxima) => {
                return f.write_str("lost: each channel is scaled to the same maximum");
            }
            Self::Lost(RatioLoss::PrintedFigure) => return f.write_str("lost: read off a printed figure"),
            Self::Plausible(found) => ("plausible", found),
            Self::Implausible(found) => ("implausible", found),
        };
        let [red, blue] = deviation.map(|deviation| 100.0 * deviation);
        write!(
            f,
            "{word}: neutral under D65 {red:+.0} % in R/G and {blue:+.0} % in B/G from the median of {tables} other tables \
             of the maker"
        )
    }
}
