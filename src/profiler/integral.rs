//! The spectral integral of the rendered samples, by each method.

use chromascope_core::accuracy::Accuracy;
use chromascope_core::query::Ask;
use chromascope_core::query::render::PicturesQuery;
use chromascope_core::reflectance::{Precision, Reading};
use chromascope_core::render::diffuse::{DARK, ROUGH, by_moments, by_nodes, by_regimes, rough_basis};
use chromascope_core::render::shading::Way;
use chromascope_core::render::{Against, Demand, DiffuseTable, Plan, Quality, ShadingImage, SpectralWeights};
use chromascope_measure::harness::timed;
use chromascope_measure::method::{Family, Method, Point, compare, largest, together};

use super::{SceneRunQuery, Subject, Trial};

/// At most so many samples are measured on.
const SAMPLES: usize = 300;
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: [i32; 6] = [-3, -5, -7, -9, -11, -13];
const EXACT: &str = "401 wavelengths, S to 1e-13";
const REGIMES: &str = "401 wavelengths, the paper's cases";
const FINE: &str = "Fine: 15 wavelengths";
const FULL: &str = "Full: moments, table";

/// A tolerance relative to the peak, and what it is called.
type Tolerance = (Accuracy, String);

/// Measures; none where nothing is rendered, where no sample takes an integral, and if stopped.
pub(super) fn trial(run: &SceneRunQuery, ask: &impl Ask) -> Option<Trial> {
    let pictures = run.pictures.as_ref()?;
    if pictures.shading.reading == Reading::Lambertian {
        return None;
    }
    let shading = ask.ask(&pictures.shading);
    let places = places((*shading).as_ref()?);
    if places.is_empty() {
        return None;
    }
    let demand = Demand::new(range(&places), samples(pictures));
    let set = set((*shading).as_ref()?);
    let tolerances = tolerances(set.clone());
    let mut sources = Vec::new();
    for source in &pictures.sources {
        let measure = ask.ask(&pictures.image(&source.rendering).measure);
        let Ok(measure) = &*measure else { continue };
        sources.push(through(measure, &places, (demand, &tolerances), ask)?);
    }
    let points = together(&sources);
    let set = set.map(|(_, name)| name).or_else(|| by_quality(pictures.shading.quality).map(str::to_owned));
    let set = set.and_then(|name| points.iter().position(|point| point.name == name));
    Some(Trial { subject: Subject::Integral, inputs: places.len(), points, set })
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

/// At most how many samples a picture has whose integral is made.
fn samples(pictures: &PicturesQuery) -> u64 {
    let size = pictures.shading.geometry.visibility.size;
    (size.columns() * size.rows()) as u64
}

/// All methods through one source; none if stopped.
fn through(
    measure: &SpectralWeights,
    places: &[[f64; 2]],
    (demand, tolerances): (Demand, &[Tolerance]),
    ask: &impl Ask,
) -> Option<Vec<Point>> {
    let (table, build) = timed(|| DiffuseTable::new(measure));
    let mut methods = fixed(measure, &table, build, places);
    for (accuracy, name) in tolerances {
        let (plan, preparation) = timed(|| Plan::new(measure, *accuracy, Against::Peak, demand));
        let Ok(plan) = plan else { continue };
        methods.push(Method {
            name: name.clone(),
            family: Family::Tolerance,
            preparation,
            certified: Some(plan.explanation().certified()),
            values: Box::new(move || {
                let mut sums = vec![[0.0; 3]; places.len()];
                plan.fill(places, &mut sums);
                sums
            }),
        });
        if ask.stop().is_set() {
            return None;
        }
    }
    let peak = |[kappa, _]: &[f64; 2]| largest(by_nodes(measure.fine(), *kappa, 0.0, Precision::Full));
    let peaks: Vec<f64> = places.iter().map(peak).collect();
    let share = |index: usize, value: [f64; 3], exact: [f64; 3]| {
        let off = largest([0, 1, 2].map(|c: usize| value[c] - exact[c]));
        if peaks[index] > 0.0 { off / peaks[index] } else { 0.0 }
    };
    compare(&methods, share, &ask.stop())
}

/// The tolerances that are tried, and the one that pictures keep, if any: the largest first.
fn tolerances(set: Option<Tolerance>) -> Vec<Tolerance> {
    // Through their text: powers of ten that are not the nearest numbers have long names.
    let usual = TOLERANCES.iter().filter_map(|exponent| Accuracy::new(format!("1e{exponent}").parse().ok()?).ok());
    let usual = usual.map(|accuracy| (accuracy, format!("within {:e}", accuracy.max_relative_error())));
    let mut all: Vec<Tolerance> = set.into_iter().chain(usual).collect();
    all.sort_by(|(a, _), (b, _)| b.max_relative_error().total_cmp(&a.max_relative_error()));
    all.dedup_by_key(|(accuracy, _)| *accuracy);
    all
}

/// The tolerance that pictures keep, if any: of the integral's peak it may be less than of the picture's brightest sample.
fn set(shading: &ShadingImage) -> Option<Tolerance> {
    let (of_picture, of_peak) = (shading.quality().accuracy()?, shading.plan_accuracy()?);
    let [picture, peak] = [of_picture, of_peak].map(Accuracy::max_relative_error);
    let name =
        if of_picture == of_peak { format!("within {peak:e}") } else { format!("within {peak:.1e}, for {picture:e}") };
    Some((of_peak, name))
}

/// What the integral of a quality is called here; none where it is not tried.
fn by_quality(quality: Quality) -> Option<&'static str> {
    match quality {
        Quality::Exact => Some(EXACT),
        Quality::Regimes => Some(REGIMES),
        Quality::Fine => Some(FINE),
        Quality::Full => Some(FULL),
        Quality::Preview | Quality::Within(_) => None,
    }
}

/// The methods that promise nothing, the reference first.
fn fixed<'a>(
    measure: &'a SpectralWeights,
    table: &'a DiffuseTable,
    build: f64,
    places: &'a [[f64; 2]],
) -> Vec<Method<'a>> {
    let method = |name: &str, family, preparation, at: Box<dyn Fn(f64, f64) -> [f64; 3] + 'a>| Method {
        name: name.to_owned(),
        family,
        preparation,
        certified: None,
        values: Box::new(move || places.iter().map(|&[kappa, beta]| at(kappa, beta)).collect()),
    };
    let sum = |name: &str, precision| {
        let at = move |kappa, beta| by_nodes(measure.dense(), kappa, beta, precision);
        method(name, Family::Sum, 0.0, Box::new(at))
    };
    let regimes = |kappa, beta| by_regimes(measure.dense(), kappa, beta);
    let fine = |kappa, beta| by_nodes(measure.fine(), kappa, beta, Precision::Full);
    let full = |kappa, beta| full(measure, table, kappa, beta);
    vec![
        sum(EXACT, Precision::Full),
        sum("401 wavelengths, S to 1e-10", Precision::Fine),
        sum("401 wavelengths, S to 1e-6", Precision::Coarse),
        method(REGIMES, Family::Quality, 0.0, Box::new(regimes)),
        method(FINE, Family::Quality, 0.0, Box::new(fine)),
        method(FULL, Family::Quality, build, Box::new(full)),
    ]
}

/// As the quality Full does it.
fn full(measure: &SpectralWeights, table: &DiffuseTable, kappa: f64, beta: f64) -> [f64; 3] {
    if kappa >= ROUGH {
        if beta > DARK { [0.0; 3] } else { by_moments(measure.moments(), &rough_basis(kappa, beta)) }
    } else if DiffuseTable::holds(kappa, beta) {
        table.at(kappa, beta)
    } else {
        by_nodes(measure.coarse(), kappa, beta, Precision::Fine)
    }
}
