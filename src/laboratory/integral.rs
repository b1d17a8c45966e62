//! The spectral integral of the rendered samples, by each method.

use chromascope_core::accuracy::Accuracy;
use chromascope_core::query::Ask;
use chromascope_core::query::render::PicturesOf;
use chromascope_core::reflectance::{Precision, Reading};
use chromascope_core::render::diffuse::{DARK, ROUGH, by_moments, by_nodes, by_regimes, rough_basis};
use chromascope_core::render::shading::Way;
use chromascope_core::render::{Against, Demand, DiffuseTable, Measure, Plan, ShadingImage};

use super::stopwatch::{medians, once};
use super::{Family, Point, SceneRunOf, Subject, Trial};

/// At most so many samples are measured on.
const SAMPLES: usize = 300;
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: [i32; 6] = [-3, -5, -7, -9, -11, -13];

/// Samples of the scene through one source.
struct Bench<'a> {
    /// κ and β of each sample.
    places: &'a [[f64; 2]],
    /// The source's weights over wavelength.
    measure: &'a Measure,
    /// What is asked of a plan.
    demand: Demand,
}

/// A way of integrating.
struct Method<'a> {
    name: String,
    family: Family,
    preparation: f64,
    certified: Option<f64>,
    fill: Fill<'a>,
}

/// Integrates at each κ and β.
type Fill<'a> = Box<dyn Fn(&[[f64; 2]], &mut [[f64; 3]]) + 'a>;

/// One place after the other.
fn each<'a>(at: impl Fn(f64, f64) -> [f64; 3] + 'a) -> Fill<'a> {
    Box::new(move |places, sums| {
        for ([kappa, beta], sum) in places.iter().zip(sums) {
            *sum = at(*kappa, *beta);
        }
    })
}

/// Measures; none where nothing is rendered, where no sample takes an integral, and if stopped.
pub(super) fn trial(run: &SceneRunOf, ask: &impl Ask) -> Option<Trial> {
    let pictures = run.pictures.as_ref()?;
    if pictures.shading.reading == Reading::Lambertian {
        return None;
    }
    let shading = ask.ask(&pictures.shading);
    let places = places((*shading).as_ref()?);
    if places.is_empty() {
        return None;
    }
    let demand = Demand::new(range(&places), lit(pictures));
    let mut sums: Vec<Sums> = Vec::new();
    let mut sources = 0.0;
    for source in &pictures.sources {
        let measure = ask.ask(&pictures.image(&source.rendering).measure);
        let Ok(measure) = &*measure else { continue };
        let bench = Bench { places: &places, measure, demand };
        let points = bench.measured(ask)?;
        sources += 1.0;
        for (index, point) in points.into_iter().enumerate() {
            match sums.get_mut(index) {
                Some(sum) => sum.add(&point),
                None => sums.push(Sums(point)),
            }
        }
    }
    let points = sums.into_iter().map(|sum| sum.mean(sources)).collect();
    Some(Trial { subject: Subject::Integral, inputs: places.len(), points })
}

/// κ and β of samples spread over those that the light reaches.
fn places(shading: &ShadingImage) -> Vec<[f64; 2]> {
    let lit: Vec<[f64; 2]> = shading
        .shades()
        .iter()
        .filter(|shade| !matches!(shade.way, Way::Dark | Way::Flat))
        .map(|shade| [shade.kappa, shade.beta])
        .collect();
    lit.iter().step_by(lit.len().div_ceil(SAMPLES).max(1)).copied().collect()
}

/// The least and the largest κ.
fn range(places: &[[f64; 2]]) -> [f64; 2] {
    places.iter().fold([f64::INFINITY, 0.0], |[low, high], [kappa, _]| [low.min(*kappa), high.max(*kappa)])
}

/// About how many samples a picture has whose integral is made.
fn lit(pictures: &PicturesOf) -> u64 {
    let size = pictures.shading.geometry.visibility.size;
    (size.columns() * size.rows()) as u64
}

/// The worst and the sum of several sources' points.
struct Sums(Point);

impl Sums {
    fn add(&mut self, other: &Point) {
        let Self(sum) = self;
        sum.seconds += other.seconds;
        sum.preparation += other.preparation;
        sum.max = sum.max.max(other.max);
        sum.rms = sum.rms.max(other.rms);
        sum.certified = sum.certified.zip(other.certified).map(|(a, b)| a.max(b));
    }

    fn mean(self, sources: f64) -> Point {
        let Self(point) = self;
        Point { seconds: point.seconds / sources, preparation: point.preparation / sources, ..point }
    }
}

impl Bench<'_> {
    /// All methods through this source; none if stopped.
    fn measured(&self, ask: &impl Ask) -> Option<Vec<Point>> {
        let (table, build) = once(|| DiffuseTable::new(self.measure));
        let mut methods = methods(self.measure, &table, build);
        for exponent in TOLERANCES {
            let Ok(accuracy) = Accuracy::new(10_f64.powi(exponent)) else { continue };
            let (plan, preparation) = once(|| Plan::new(self.measure, accuracy, Against::Peak, self.demand));
            let Ok(plan) = plan else { continue };
            let certified = Some(plan.explanation().certified());
            let fill: Fill<'_> = Box::new(move |places, sums| plan.fill(places, sums));
            methods.push(Method {
                name: format!("within 1e{exponent}").replace('-', "−"),
                family: Family::Tolerance,
                preparation,
                certified,
                fill,
            });
            if ask.stop().is_set() {
                return None;
            }
        }
        let exact = self.values(&methods[0]);
        // One thread: what a sample costs, not what a machine does.
        let work: Vec<Box<dyn Fn() -> Vec<[f64; 3]> + '_>> = methods
            .iter()
            .map(|method| -> Box<dyn Fn() -> Vec<[f64; 3]> + '_> { Box::new(|| self.values(method)) })
            .collect();
        let seconds = medians(&work, &ask.stop())?;
        let peaks: Vec<f64> = self
            .places
            .iter()
            .map(|[kappa, _]| largest(by_nodes(self.measure.fine(), *kappa, 0.0, Precision::Full)))
            .collect();
        let point = |(method, seconds): (&Method<'_>, f64)| {
            let (mut max, mut squares) = (0.0_f64, 0.0);
            for ((value, exact), peak) in self.values(method).iter().zip(&exact).zip(&peaks) {
                let off = [0, 1, 2].map(|c: usize| value[c] - exact[c]);
                let share = if *peak > 0.0 { largest(off) / peak } else { 0.0 };
                max = max.max(share);
                squares += share * share;
            }
            let count = self.places.len() as f64;
            Point {
                name: method.name.clone(),
                family: method.family,
                seconds: seconds / count,
                preparation: method.preparation,
                max,
                rms: (squares / count).sqrt(),
                certified: method.certified,
            }
        };
        Some(methods.iter().zip(seconds).map(point).collect())
    }

    fn values(&self, method: &Method<'_>) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; self.places.len()];
        (method.fill)(self.places, &mut sums);
        sums
    }
}

fn largest(values: [f64; 3]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

/// The methods, the reference first.
fn methods<'a>(measure: &'a Measure, table: &'a DiffuseTable, build: f64) -> Vec<Method<'a>> {
    let sum = |name: &str, precision| Method {
        name: name.to_owned(),
        family: Family::Sum,
        preparation: 0.0,
        certified: None,
        fill: each(move |kappa, beta| by_nodes(measure.dense(), kappa, beta, precision)),
    };
    let quality = |name: &str, preparation, fill: Fill<'a>| Method {
        name: name.to_owned(),
        family: Family::Quality,
        preparation,
        certified: None,
        fill,
    };
    vec![
        sum("401 wavelengths, S to 1e-13", Precision::Full),
        sum("401 wavelengths, S to 1e-10", Precision::Fine),
        sum("401 wavelengths, S to 1e-6", Precision::Coarse),
        quality(
            "401 wavelengths, the paper's cases",
            0.0,
            each(|kappa, beta| by_regimes(measure.dense(), kappa, beta)),
        ),
        quality(
            "Fine: 15 wavelengths",
            0.0,
            each(|kappa, beta| by_nodes(measure.fine(), kappa, beta, Precision::Full)),
        ),
        quality("Full: moments, table", build, each(move |kappa, beta| full(measure, table, kappa, beta))),
    ]
}

/// As the quality Full does it.
fn full(measure: &Measure, table: &DiffuseTable, kappa: f64, beta: f64) -> [f64; 3] {
    if kappa >= ROUGH {
        if beta > DARK { [0.0; 3] } else { by_moments(measure.moments(), &rough_basis(kappa, beta)) }
    } else if DiffuseTable::holds(kappa, beta) {
        table.at(kappa, beta)
    } else {
        by_nodes(measure.coarse(), kappa, beta, Precision::Fine)
    }
}
