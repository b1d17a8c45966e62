//! Queries on blackbodies and monochromatic light through a sensor.

use super::ask::{Ask, Query, Shared};
use super::patches::RenderingQuery;
use chromascope_color::camera::{LocusEvaluator, LocusMethod, RenderingError};
use chromascope_color::colorimetry::diagram::{SpectralPoint, spectral_locus};
use chromascope_color::colorimetry::{Uv60, UvPrime, Xy, Xyz};
use chromascope_color::light::temperature::single::nearest_blackbody;
use chromascope_color::light::{Cct, CctError, LocusError, PlanckianLocus, RadiationConstants};
use chromascope_color::spectral::Sensor;
use chromascope_color::spectral::grid::{COUNT, wavelength_nm};
use chromascope_color::units::Kelvin;

/// Temperatures of a locus.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Temperatures {
    /// Evenly in 1/T from the first to the last, both included.
    Range {
        /// The first temperature.
        from: Kelvin,
        /// The last temperature.
        to: Kelvin,
        /// Number of temperatures; one gives the first alone.
        count: usize,
    },
    /// These, in this order.
    List(Vec<Kelvin>),
}

impl Temperatures {
    /// The temperatures one by one.
    pub fn to_vec(&self) -> Vec<Kelvin> {
        self.part(0..self.count())
    }

    /// Number of temperatures.
    pub fn count(&self) -> usize {
        match self {
            Self::List(list) => list.len(),
            Self::Range { count, .. } => *count,
        }
    }

    /// The temperatures of these indices, so that a long locus can be evaluated in parts.
    pub fn part(&self, places: std::ops::Range<usize>) -> Vec<Kelvin> {
        match self {
            Self::List(list) => list.get(places).unwrap_or_default().to_vec(),
            Self::Range { from, to, count } => places.filter_map(|index| between(*from, *to, index, *count)).collect(),
        }
    }
}

/// Temperature `index` of `count`, evenly in 1/T; the ends exactly.
fn between(from: Kelvin, to: Kelvin, index: usize, count: usize) -> Option<Kelvin> {
    match index {
        0 => Some(from),
        _ if index + 1 == count => Some(to),
        _ => {
            let t = index as f64 / (count - 1) as f64;
            Kelvin::from_mired(from.mired() + t * (to.mired() - from.mired())).ok()
        }
    }
}

/// With which quadrature is a sensor's locus evaluated? Making it costs more than a hundred temperatures with it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LocusRulesQuery {
    /// The camera or observer.
    pub sensor: Shared<Sensor>,
    /// The constants of Planck's law.
    pub constants: RadiationConstants,
}

impl Query for LocusRulesQuery {
    type Answer = LocusEvaluator<Shared<Sensor>>;
    const NAME: &'static str = "locus rules";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        LocusEvaluator::new(self.sensor.clone(), self.constants)
    }
}

/// Signals of blackbodies before any balance: independent of light, white balance and color transform.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RadiatorSignalsQuery {
    /// The camera or observer.
    pub sensor: Shared<Sensor>,
    /// The temperatures.
    pub temperatures: Temperatures,
    /// The constants of Planck's law.
    pub constants: RadiationConstants,
}

/// Raw integrals along a locus, each up to a positive factor of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct RawLocus {
    /// Temperature and the three integrals.
    pub points: Vec<(Kelvin, [f64; 3])>,
    /// Method of computation, with the error found.
    pub method: LocusMethod,
}

impl Query for RadiatorSignalsQuery {
    type Answer = RawLocus;
    const NAME: &'static str = "radiator signals";

    fn answer(&self, ask: &impl Ask) -> RawLocus {
        let evaluator = ask.ask(&LocusRulesQuery { sensor: self.sensor.clone(), constants: self.constants });
        let points = self.temperatures.to_vec().into_iter().map(|t| (t, evaluator.raw(t))).collect();
        RawLocus { points, method: evaluator.method() }
    }
}

/// One blackbody on a locus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocusPoint {
    /// Its temperature.
    pub temperature: Kelvin,
    /// Its tristimulus values, up to a positive factor.
    pub xyz: Xyz,
    /// Its chromaticity, or none where the signals sum to nothing.
    pub xy: Option<Xy>,
    /// Chromaticity in the 1976 diagram.
    pub uv: Option<UvPrime>,
}

/// A Planckian locus through a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Locus {
    /// Its points, in the requested order.
    pub points: Vec<LocusPoint>,
    /// Method of computation, with the error found.
    pub method: LocusMethod,
}

impl Locus {
    /// The length of the locus in xy, the paper's "dynamic range": the sum of straight steps, gaps skipped.
    pub fn length_xy(&self) -> f64 {
        let steps = self.points.windows(2);
        steps.filter_map(|pair| Some(pair[0].xy?.distance(pair[1].xy?))).sum()
    }
}

/// Planckian locus through a sensor (Eq 15).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LocusQuery {
    /// The sensor and its color transform.
    pub rendering: RenderingQuery,
    /// The temperatures.
    pub temperatures: Temperatures,
    /// The constants of Planck's law.
    pub constants: RadiationConstants,
}

impl Query for LocusQuery {
    type Answer = Result<Locus, RenderingError>;
    const NAME: &'static str = "locus";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let signals = ask.ask(&RadiatorSignalsQuery {
            sensor: self.rendering.sensor.clone(),
            temperatures: self.temperatures.clone(),
            constants: self.constants,
        });
        let points = signals.points.iter().map(|&(temperature, raw)| {
            let xyz = rendering.blackbody(raw);
            LocusPoint { temperature, xyz, xy: xyz.chromaticity(), uv: xyz.uv_prime() }
        });
        Ok(Locus { points: points.collect(), method: signals.method })
    }
}

/// Spectral locus through a sensor: shows errors that no 3×3 matrix can correct.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MonochromaticQuery {
    /// The sensor and its color transform.
    pub rendering: RenderingQuery,
}

impl Query for MonochromaticQuery {
    type Answer = Result<Vec<SpectralPoint>, RenderingError>;
    const NAME: &'static str = "monochromatic light";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let rendering = ask.ask(&self.rendering);
        let rendering = (*rendering).as_ref().map_err(|&e| e)?;
        let sensor = &self.rendering.sensor;
        let strongest = (0..COUNT).map(|i| magnitude(sensor.at_index(i))).fold(0.0, f64::max);
        let points = (0..COUNT).filter_map(|index| {
            let signals = sensor.at_index(index);
            // Where a camera hardly responds its chromaticity is noise of the measurement, not color.
            if magnitude(signals) < 1e-3 * strongest {
                return None;
            }
            let xy = rendering.blackbody(signals).chromaticity()?;
            Some(SpectralPoint { wavelength_nm: wavelength_nm(index), xy })
        });
        Ok(points.collect())
    }
}

fn magnitude(v: [f64; 3]) -> f64 {
    v.iter().fold(0.0, |m, x| x.abs().max(m))
}

/// Evaluator of the nearest blackbody of any color that an XYZ observer sees.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct NearestBlackBodyQuery {
    /// The observer.
    pub observer: Shared<Sensor>,
    /// The constants of Planck's law.
    pub constants: RadiationConstants,
}

impl Query for NearestBlackBodyQuery {
    type Answer = Result<PlanckianLocus, LocusError>;
    const NAME: &'static str = "nearest black body";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        PlanckianLocus::new(&self.observer, self.constants)
    }
}

/// Nearest blackbody of one color.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CctQuery {
    /// The observer.
    pub observer: Shared<Sensor>,
    /// The bits of u and v in the CIE 1960 diagram.
    color: [u64; 2],
}

impl CctQuery {
    /// Query for a color.
    pub fn new(observer: Shared<Sensor>, color: Uv60) -> Self {
        Self { observer, color: [color.u, color.v].map(f64::to_bits) }
    }
}

impl Query for CctQuery {
    type Answer = Result<Cct, CctError>;
    const NAME: &'static str = "color temperature";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        let [u, v] = self.color.map(f64::from_bits);
        nearest_blackbody(&self.observer, RadiationConstants::Paper, Uv60 { u, v })
    }
}

/// Spectral locus of an XYZ observer: the diagram's outline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SpectralLocusQuery {
    /// The observer.
    pub observer: Shared<Sensor>,
}

impl Query for SpectralLocusQuery {
    type Answer = Vec<SpectralPoint>;
    const NAME: &'static str = "spectral locus";

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        spectral_locus(&self.observer)
    }
}
