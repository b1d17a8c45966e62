//! The spectral integral of the rendered samples, by each method.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::query::Ask;
use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::reflectance::{Normalization, Precision};
use chromascope_core::render::diffuse::by_nodes;
use chromascope_core::render::shading::DiffuseKind;
use chromascope_core::render::{Demand, Plan, Quality, ShadingImage, SpectralWeights};
use chromascope_measure::harness::timed;
use chromascope_measure::method::{Family, Method, Point, compare, largest, together};

use super::{SceneRunJob, Subject, Trial};

/// Maximum number of samples measured.
const SAMPLES: usize = 300;
/// The tolerances that are tried, as powers of ten.
const TOLERANCES: [i32; 6] = [-3, -5, -7, -9, -11, -13];
const EXACT: &str = "401 wavelengths, S to 1e-13";
const REGIMES: &str = "401 wavelengths, the paper's cases";

/// A tolerance relative to the peak, and its name.
type Tolerance = (RelTolerance, String);

/// Measures; none where nothing is rendered, where no sample takes an integral, and if stopped.
pub(super) fn trial(run: &SceneRunJob, ask: &impl Ask) -> Option<Trial> {
    let pictures = run.pictures.as_ref()?;
    if pictures.shading.reading == Normalization::Lambertian {
        return None;
    }
    let shading = ask.ask(&pictures.shading);
    let places = places((*shading).as_ref()?);
    if places.is_empty() {
        return None;
    }
    let demand = Demand::of_picture(range(&places), samples(pictures));
    let (set, fixed) = (set((*shading).as_ref()?), (*shading).as_ref()?.fixed_quality());
    let tolerances = tolerances(set.clone());
    let mut sources = Vec::new();
    for source in &pictures.sources {
        let measure = ask.ask(&pictures.image(source).measure);
        let Ok(measure) = &*measure else { continue };
        sources.push(through(measure, &places, (demand, &tolerances), ask)?);
    }
    let points = together(&sources);
    let set = set.map_or_else(|| by_quality(fixed).to_owned(), |(_, name)| name);
    let set = points.iter().position(|point| point.name == set);
    Some(Trial { subject: Subject::Integral, inputs: places.len(), points, set })
}

/// κ and β of samples spread over those that the light reaches.
fn places(shading: &ShadingImage) -> Vec<[f64; 2]> {
    let lit: Vec<[f64; 2]> = shading
        .shades()
        .iter()
        .filter(|shade| shade.kind == DiffuseKind::Spectral)
        .map(|shade| [shade.kappa, shade.beta])
        .collect();
    lit.iter().step_by(lit.len().div_ceil(SAMPLES).max(1)).copied().collect()
}

/// The least and the largest κ.
fn range(places: &[[f64; 2]]) -> [f64; 2] {
    places.iter().fold([f64::INFINITY, 0.0], |[low, high], [kappa, _]| [low.min(*kappa), high.max(*kappa)])
}

/// Maximum number of samples of a picture that are integrated.
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
    let mut methods = fixed(measure, places);
    for (accuracy, name) in tolerances {
        let (plan, preparation) = timed(|| Plan::new(measure, *accuracy, demand));
        let Ok(plan) = plan else { continue };
        methods.push(Method {
            name: name.clone(),
            family: Family::Tolerance,
            preparation,
            error_bound: Some(plan.explanation().error_bound()),
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
    let usual = TOLERANCES.iter().filter_map(|exponent| RelTolerance::new(format!("1e{exponent}").parse().ok()?).ok());
    let usual = usual.map(|accuracy| (accuracy, format!("within {:e}", accuracy.max_relative_error())));
    let mut all: Vec<Tolerance> = set.into_iter().chain(usual).collect();
    all.sort_by(|(a, _), (b, _)| b.max_relative_error().total_cmp(&a.max_relative_error()));
    all.dedup_by_key(|(accuracy, _)| *accuracy);
    all
}

/// The tolerance that plans of the pictures keep, if any: of the integral's peak it may be less than of the picture's brightest
/// sample.
fn set(shading: &ShadingImage) -> Option<Tolerance> {
    let (of_peak, _) = shading.plan_request()?;
    let peak = of_peak.max_relative_error();
    let name = match shading.quality().given_tolerance().map(RelTolerance::max_relative_error) {
        None => format!("{}: within {peak:e}", shading.quality().level().key()),
        Some(picture) if picture == peak => format!("within {peak:e}"),
        Some(picture) => format!("within {peak:.1e}, for {picture:e}"),
    };
    Some((of_peak, name))
}

/// Name of the fixed method of a quality.
fn by_quality(quality: Quality) -> &'static str {
    match quality {
        Quality::Reference | Quality::Within(_) => EXACT,
        Quality::Regimes => REGIMES,
        Quality::Preview => "6 wavelengths, 8 moments",
        Quality::Full => "9 wavelengths, 8 moments",
        Quality::Fine => "15 wavelengths",
    }
}

/// The methods that are not searched, the reference first.
fn fixed<'a>(measure: &'a SpectralWeights, places: &'a [[f64; 2]]) -> Vec<Method<'a>> {
    let method = |name: &str, family, values| Method {
        name: name.to_owned(),
        family,
        preparation: 0.0,
        error_bound: None,
        values,
    };
    let sum = |name: &str, precision| {
        let at = move |&[kappa, beta]: &[f64; 2]| by_nodes(measure.dense(), kappa, beta, precision);
        method(name, Family::Sum, Box::new(move || places.iter().map(at).collect()))
    };
    let quality = |quality| {
        let plan = Plan::fixed(measure, quality);
        let values = move || {
            let mut sums = vec![[0.0; 3]; places.len()];
            plan.fill(places, &mut sums);
            sums
        };
        method(by_quality(quality), Family::Quality, Box::new(values))
    };
    vec![
        sum(EXACT, Precision::Full),
        sum("401 wavelengths, S to 1e-10", Precision::Fine),
        sum("401 wavelengths, S to 1e-6", Precision::Coarse),
        quality(Quality::Regimes),
        quality(Quality::Fine),
        quality(Quality::Full),
        quality(Quality::Preview),
    ]
}
