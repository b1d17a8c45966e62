//! Stress tests of error bounds: tolerances, precisions of S, loci, the extent of the specular lobe, plans of the
//! spectral integral.

use std::sync::{Arc, LazyLock};

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::LocusEvaluator;
use chromascope_core::light::RadiationConstants;
use chromascope_core::reflectance::{Normalization, Precision, Surface, diffuse_sum};
use chromascope_core::render::diffuse::by_nodes;
use chromascope_core::render::plan::position;
use chromascope_core::render::shading::{CoherentSample, DiffuseKind, Shade};
use chromascope_core::render::{
    CameraImage, CoherentIntegral, Demand, GeometryImage, Plan, Quality, RasterSize, ShadingImage, SpectralWeights,
    Stop, Visibility,
};
use chromascope_core::scene::{Lighting, Viewpoint};
use chromascope_core::spectral::Primaries;
use chromascope_core::units::Kelvin;
use chromascope_mesh::shapes;
use glam::DVec3;

use super::draw::{Case, Draw, case};
use super::render::{drawn_measure, of};
use super::spectral::drawn_sensor;
use super::sum::reference;
use super::walk::{Verdict, Walk};

pub(super) const WALKS: &[Walk] = &[
    Walk {
        name: "RelTolerance",
        promise: 0.0,
        share: 10.0,
        draw: |d| case([d.anything(), d.anything()]),
        check: accuracy,
    },
    Walk { name: "Precision::within", promise: 1.0, share: 2.0, draw: draw_sum, check: precision },
    Walk { name: "LocusEvaluator::within", promise: 1.0, share: 0.05, draw: draw_locus, check: locus },
    Walk { name: "Measure::shared", promise: 1e-9, share: 0.05, draw: draw_shared, check: shared },
    Walk { name: "CoherentIntegral of any camera", promise: 1.0, share: 0.05, draw: draw_lobes, check: lobes },
    Walk { name: "CoherentIntegral", promise: 1.0, share: 0.5, draw: draw_coherent, check: coherent },
    Walk { name: "Demand", promise: 0.0, share: 20.0, draw: draw_demand, check: demand },
    Walk { name: "Plan::at", promise: 1.0, share: 0.5, draw: draw_place, check: place },
    Walk { name: "Plan::fill", promise: 0.0, share: 0.05, draw: draw_fill, check: fill },
    Walk { name: "Plan::new", promise: 1.0, share: 0.014, draw: draw_plan, check: any_plan },
    Walk { name: "a picture by plan", promise: 0.0, share: 0.05, draw: draw_picture, check: picture },
];

/// An accuracy that may be requested: as coarse as there is, and far finer than can be had.
fn draw_accuracy(d: &mut Draw) -> f64 {
    match d.pick(8) as u32 {
        0 => d.log(1e-320, 1e-14),
        1 => 1.0 - d.log(1e-16, 0.5),
        _ => d.log(1e-14, 1.0),
    }
}

fn accuracy(&[x, y, ..]: &Case, v: &mut Verdict) {
    let taken = RelTolerance::new(x);
    v.holds("taken and not", taken.is_ok() == (x > 0.0 && x < 1.0));
    let Ok(accuracy) = taken else { return v.refuse() };
    v.holds("another number", accuracy.max_relative_error() == x);
    v.holds("itself is not allowed", accuracy.allows(x) && !accuracy.allows(x.next_up()) && !accuracy.allows(f64::NAN));
    v.holds("not what is smaller", accuracy.allows(y) == (y <= x));
    if let Ok(other) = RelTolerance::new(y) {
        v.holds("another order", (accuracy < other) == (x < y) && (accuracy == other) == (x == y));
    }
}

fn draw_sum(d: &mut Draw) -> Case {
    let g = d.log(1e-12, 1e12);
    case([draw_accuracy(d), g, d.log(1e-6, 700.0 * g.max(1.0))])
}

/// The cheapest that is exact enough, beside S in two doubles.
fn precision(&[error, g, b, ..]: &Case, v: &mut Verdict) {
    let Ok(accuracy) = RelTolerance::new(error) else { return v.refuse() };
    let precision = match Precision::within(accuracy) {
        Ok(precision) => precision,
        Err(unmet) => {
            v.holds("refused without need", error < Precision::Full.max_relative_error());
            v.holds("asked for something else", unmet.asked == accuracy);
            v.holds("not even the best", Precision::within(unmet.best) == Ok(Precision::Full));
            return v.refuse();
        }
    };
    v.holds("too coarse", accuracy.allows(precision.max_relative_error()));
    let cheaper = Precision::ALL.iter().take_while(|&&other| other != precision);
    v.holds("not the cheapest", cheaper.into_iter().all(|other| other.max_relative_error() > error));
    let exact = reference(g, b);
    let ln = exact.value();
    if ln > -460.0 {
        let truth = exact.exp().value();
        let off = (diffuse_sum(g, b, precision) - truth).abs() / truth - ln.abs() * f64::EPSILON;
        v.error(off.max(0.0) / error);
    }
}

fn draw_locus(d: &mut Draw) -> Case {
    case([d.key(), d.pick(4), d.log(1e-100, 1e100), d.log(1e-3, 1e18), draw_accuracy(d)])
}

/// Nodes against the sum, in parts of what was requested.
fn locus(&[key, kind, size, kelvins, error, ..]: &Case, v: &mut Verdict) {
    const C: RadiationConstants = RadiationConstants::Si2019;
    let primaries = [Primaries::Camera, Primaries::Rgb, Primaries::Xyz, Primaries::Cones][kind as usize % 4];
    let Some(sensor) = drawn_sensor(key, primaries, size) else { return v.refuse() };
    let Ok(accuracy) = RelTolerance::new(error) else { return v.refuse() };
    let evaluator = match LocusEvaluator::within(&sensor, C, accuracy) {
        Ok(evaluator) => evaluator,
        Err(unmet) => {
            v.holds("refused without need", error < 1e-14);
            v.holds("not even the best", LocusEvaluator::within(&sensor, C, unmet.best).is_ok());
            return v.refuse();
        }
    };
    let sum = LocusEvaluator::by_sum(&sensor, C);
    let mut d = Draw::new(key as u64, "temperatures", 0);
    let further = (0..20).map(|_| d.log(900.0, 1.1e6)).chain([kelvins]);
    for t in further.filter_map(|t| Kelvin::new(t).ok()) {
        let (nodes, exact) = (evaluator.raw(t), sum.raw(t));
        v.all_finite(nodes);
        let largest = exact.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (a, b) in nodes.into_iter().zip(exact) {
            v.error(if a == b { 0.0 } else { (a - b).abs() / largest / error });
        }
    }
}

fn draw_shared(d: &mut Draw) -> Case {
    case([d.key(), d.pick(6), d.pick(2), d.pick(6), d.pick(64)])
}

fn shared(numbers: &Case, v: &mut Verdict) {
    let Some(measure) = drawn_measure(numbers) else { return v.refuse() };
    let count = numbers[4].clamp(0.0, 100.0) as usize;
    let nodes = measure.shared(count);
    v.holds("more than asked for", nodes.len() <= count);
    v.holds("none", !nodes.is_empty() || count == 0 || measure.dense().is_empty());
    v.all_finite(nodes.iter().flat_map(|n| n.weights.into_iter().chain([n.scale, n.wavelength_nm, n.reference])));
    for c in (0..3).filter(|_| !nodes.is_empty()) {
        let unsigned: f64 = measure.dense().iter().map(|n| n.weights[c].abs()).sum();
        let off = (nodes.iter().map(|n| n.weights[c]).sum::<f64>() - measure.totals()[c]).abs();
        v.error(if off == 0.0 { 0.0 } else { off / unsigned });
    }
}

fn draw_lobes(d: &mut Draw) -> Case {
    case([d.key(), d.pick(6), d.pick(2), d.pick(6), draw_accuracy(d), d.key()])
}

/// Lobes of a drawn measure.
fn lobes(numbers: &Case, v: &mut Verdict) {
    let (error, key) = (numbers[4], numbers[5]);
    let (Some(measure), true) = (drawn_measure(numbers), error > 0.0) else { return v.refuse() };
    let mut d = Draw::new(key as u64, "lobes", 0);
    for _ in 0..50 {
        let lobe = draw_lobe(&mut d);
        compare(&measure, error, lobe, v);
    }
}

/// Half-width, v along each axis, κ, the light's angular radius: anything, or as in a picture with the paper's smooth surfaces.
fn draw_lobe(d: &mut Draw) -> [f64; 5] {
    if d.pick(2) == 0.0 {
        let half = [1e-6, 10e-6, 50e-6, 1e-3][d.pick(4) as usize % 4];
        let sigma = [0.3e-6, 0.1e-6, 0.05e-6, 0.01e-6, 0.0][d.pick(5) as usize % 5];
        let kappa = (std::f64::consts::TAU * sigma / 550e-9 * d.within(0.1, 2.0)).powi(2);
        let radius = if d.pick(2) == 0.0 { 0.0 } else { 4.65e-3 };
        return [half, d.signed(1e-5, 1.0), d.signed(1e-5, 1.0), kappa, radius];
    }
    let v = |d: &mut Draw| if d.pick(4) == 0.0 { 0.0 } else { d.signed(1e-9, 2.0) };
    let radius = if d.pick(2) == 0.0 { 0.0 } else { d.log(1e-6, 0.5) };
    [d.log(1e-9, 1.0), v(d), v(d), d.log(1e-12, 1e3), radius]
}

/// A lobe by the fastest sum and by all wavelengths, in parts of the tolerance. Rounding of phases along very long paths is in
/// both.
fn compare(measure: &SpectralWeights, error: f64, [half, vx, vy, kappa, radius]: [f64; 5], v: &mut Verdict) {
    let Ok(surface) = Surface::new(1e-6, 1e-5, half, half, 1.5) else { return v.refuse() };
    let coherent = CoherentSample { index: 0, front: 1.0, kappa, v: [vx, vy] };
    let integral = CoherentIntegral::new(measure, &surface, radius, error);
    let found = integral.at(&coherent);
    v.all_finite(found);
    v.holds("more wavelengths than there are", integral.evaluations(&coherent) <= measure.dense().len());
    let unsigned = |c: usize| measure.dense().iter().map(|n| n.weights[c].abs()).sum::<f64>();
    let height = unsigned(0).max(unsigned(1)).max(unsigned(2));
    for (a, b) in found.into_iter().zip(CoherentIntegral::new(measure, &surface, radius, 0.0).at(&coherent)) {
        v.error(if a == b { 0.0 } else { ((a - b).abs() / height - 1e-14).max(0.0) / error });
    }
}

/// Errors that the measures of two sensors are planned for.
const ERRORS: [f64; 4] = [1e-2, 1e-4, 1e-7, 1e-11];

fn draw_coherent(d: &mut Draw) -> Case {
    let [half, vx, vy, kappa, radius] = draw_lobe(d);
    case([d.pick(2), d.log(1e-12, 1e-1), half, vx, vy, kappa, radius])
}

fn coherent(&[which, error, half, vx, vy, kappa, radius, ..]: &Case, v: &mut Verdict) {
    if error > 0.0 {
        compare(&of(which).measure, error, [half, vx, vy, kappa, radius], v);
    }
}

fn draw_demand(d: &mut Draw) -> Case {
    case([d.anything(), d.anything(), d.log(1e-320, 1e308), d.log(1e-320, 1e308), d.number().abs(), d.log(1e-20, 1e20)])
}

fn demand(&[least, most, kappa, beta, samples, inside, ..]: &Case, v: &mut Verdict) {
    let demand = Demand::new([least, most], samples as u64);
    let [from, to] = demand.kappa();
    v.all_finite([from, to, demand.samples()]);
    v.holds("no range", from > 0.0 && from < to);
    v.holds("too few samples", demand.samples() >= samples as u64 as f64);
    v.holds("held or not", demand.holds(inside) == (from <= inside && inside <= to));
    let usual = |kappa: f64| (1e-12..=1e12).contains(&kappa);
    // 40 powers of two are held at most, of which rounding to whole ones may take two.
    if usual(least) && usual(most) && least <= most && most / least < 38.0_f64.exp2() {
        v.holds("what was asked for is left out", demand.holds(least) && demand.holds(most));
    }
    for kappa in [inside, kappa].map(|kappa| kappa.clamp(1e-300, 1e300)) {
        let [ln, place] = position(kappa, beta);
        v.finite(ln);
        v.holds("no place", place >= 0.0 && place.is_finite());
        v.holds("not rising in β", position(kappa, 2.0 * beta + 1e-3)[1] > place || beta > 1e300);
        v.holds("β below 0", position(kappa, -beta)[1] == 0.0);
    }
}

/// Plans of two sensors in turn: for many samples, where tables pay, and for few.
static PLANS: LazyLock<[Plan; 4]> = LazyLock::new(|| {
    [0, 1, 2, 3].map(|i| {
        let (accuracy, samples) = (RelTolerance::new(ERRORS[i]).unwrap(), if i % 2 == 0 { 1_000_000 } else { 10 });
        Plan::new(&of((i % 2) as f64).measure, accuracy, Demand::new([1e-3, 1e6], samples)).unwrap()
    })
});

/// Made before there are many threads: one that waits for a part of a plan would take up a case that waits for the plan.
pub(super) fn ready() {
    LazyLock::force(&PLANS);
}

/// Draws κ of smooth, rough and rougher surfaces, and the distance from the peak.
fn draw_near(d: &mut Draw) -> [f64; 2] {
    let kappa = if d.pick(4) == 0.0 { d.log(1e-300, 1e300) } else { d.log(1e-4, 1e7) };
    let last = 30.0 * (1.0 + 6.0 / kappa.sqrt() + 3.5 / kappa);
    match d.pick(4) as u32 {
        0 => [kappa, 0.0],
        1 => [kappa, d.log(1e-320, 1e300)],
        _ => [kappa, 1.2 * last.min(1e300) * d.unit().powi(3)],
    }
}

fn draw_place(d: &mut Draw) -> Case {
    let [kappa, beta] = draw_near(d);
    case([d.pick(4), kappa, beta])
}

/// A plan beside the sum over all wavelengths, in parts of its estimated error bound.
fn bounded(plan: &Plan, measure: &SpectralWeights, [kappa, beta]: [f64; 2], v: &mut Verdict) {
    let exact = |beta| by_nodes(measure.dense(), kappa, beta, Precision::Full);
    let largest = |sums: [f64; 3]| sums.into_iter().map(f64::abs).fold(0.0, f64::max);
    let (found, exact, peak) = (plan.at(kappa, beta), exact(beta), largest(exact(0.0)));
    v.all_finite(found);
    let explanation = plan.explanation();
    for (a, b) in found.into_iter().zip(exact) {
        v.error(if a == b { 0.0 } else { (a - b).abs() / peak / explanation.error_bound() });
    }
}

fn place(&[which, kappa, beta, ..]: &Case, v: &mut Verdict) {
    let which = which as usize % 4;
    bounded(&PLANS[which], &of((which % 2) as f64).measure, [kappa, beta], v);
}

fn draw_fill(d: &mut Draw) -> Case {
    case([d.key(), d.pick(4), d.pick(200), d.pick(200)])
}

/// As one by one, whatever else is there; what is beyond the shorter is left alone.
fn fill(&[key, which, count, room, ..]: &Case, v: &mut Verdict) {
    let mut d = Draw::new(key as u64, "points", 0);
    let many = |n: f64| n.clamp(0.0, 1000.0) as usize;
    let plan = &PLANS[which as usize % 4];
    let mut point = || if d.pick(8) == 0.0 { [d.anything(), d.anything()] } else { draw_near(&mut d) };
    let points: Vec<[f64; 2]> = (0..many(count)).map(|_| point()).collect();
    let mut sums = vec![[-7.0; 3]; many(room)];
    plan.fill(&points, &mut sums);
    for (i, sum) in sums.iter().enumerate() {
        match points.get(i) {
            Some(&[kappa, beta]) => {
                v.all_finite(*sum);
                v.holds("not as one by one", plan.at(kappa, beta) == *sum);
                v.holds("light without κ", kappa > 0.0 || *sum == [0.0; 3]);
                v.holds("β below 0 is not 0", beta >= 0.0 || beta.is_nan() || plan.at(kappa, 0.0) == *sum);
            }
            None => v.holds("written beyond the points", *sum == [-7.0; 3]),
        }
    }
}

fn draw_plan(d: &mut Draw) -> Case {
    let from = d.log(1e-30, 1e25);
    case([d.key(), d.pick(6), d.pick(2), d.pick(6), draw_accuracy(d), from, d.log(1.0, 1e12), d.key()])
}

/// A plan for a drawn measure and range of κ.
fn any_plan(numbers: &Case, v: &mut Verdict) {
    let &[.., error, from, span, key] = numbers;
    let (Some(measure), Ok(accuracy)) = (drawn_measure(numbers), RelTolerance::new(error)) else { return v.refuse() };
    let mut d = Draw::new(key as u64, "places", 0);
    let demand = Demand::new([from, from * span], d.log(1.0, 1e12) as u64);
    let plan = match Plan::new(&measure, accuracy, demand) {
        Ok(plan) => plan,
        Err(unmet) => {
            v.holds("refused without need", error < 1e-13);
            v.holds("the best is none", unmet.best.max_relative_error() >= 1e-13);
            return v.refuse();
        }
    };
    let explanation = plan.explanation();
    v.holds("a bound above the tolerance", accuracy.allows(explanation.error_bound()));
    v.holds("another demand", plan.demand() == demand && explanation.demand == demand);
    v.holds("no memory", plan.bytes() < 1 << 30);
    let all = explanation.rejected.iter().chain(&explanation.rough).chain([&explanation.chosen]);
    let samples = demand.samples();
    v.all_finite(all.flat_map(|c| [c.total_ns(samples), c.seen.unwrap_or(0.0), c.error_bound.unwrap_or(0.0)]));
    let [from, to] = demand.kappa();
    for i in 0..60 {
        let [far, beta] = draw_near(&mut d);
        let kappa = if i % 6 == 0 { far } else { d.log(from, to) };
        let last = 30.0 * (1.0 + 6.0 / kappa.sqrt() + 3.5 / kappa);
        bounded(&plan, &measure, [kappa, if i % 5 == 0 { beta } else { d.unit().powi(2) * last }], v);
    }
}

fn draw_picture(d: &mut Draw) -> Case {
    let sigma = if d.pick(4) == 0.0 { 0.0 } else { d.log(1e-9, 1e-4) };
    case([d.pick(4), sigma, d.log(1e-6, 1e-4), d.log(1e-6, 1e-4), d.log(1.0, 3.0), d.key(), d.pick(3)])
}

/// Each sample as the plan says, where no mirror's light comes on top.
fn picture(&[which, sigma, tau, half, index, key, reading, ..]: &Case, v: &mut Verdict) {
    let which = which as usize % 4;
    let (plan, scene) = (&PLANS[which], of((which % 2) as f64));
    let Ok(surface) = Surface::new(sigma, tau, half, half, index) else { return v.refuse() };
    let mut d = Draw::new(key as u64, "view", 0);
    let viewpoint = Viewpoint::new(d.angle(), d.within(-1.0, 1.0), d.log(2.0, 10.0), 0.7);
    let place = DVec3::new(d.within(-1.0, 1.0), d.within(-1.0, 1.0), d.within(-1.0, 1.0));
    let (Ok(viewpoint), Ok(lighting)) = (viewpoint, Lighting::far(place, 4.65e-3)) else { return v.refuse() };
    let reading = [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet][reading as usize % 3];
    let mesh = shapes::sphere(200);
    let seen = Visibility::new(&mesh, viewpoint.eye(mesh.bounds()), RasterSize::new(6, 5), &Stop::NEVER);
    let geometry = GeometryImage::new(&mesh, &seen.expect("never stopped"), &lighting, None, &Stop::NEVER);
    let quality = Quality::Within(plan.explanation().asked);
    let geometry = Arc::new(geometry.expect("never stopped"));
    let shading = ShadingImage::new(geometry, surface, reading, quality, &Stop::NEVER).expect("never stopped");
    let is_spectral = |shade: &Shade| shade.kind == DiffuseKind::Spectral;
    if let Some(demand) = shading.demand() {
        let held = shading.shades().iter().all(|s| !is_spectral(s) || demand.holds(s.kappa));
        v.holds("a sample that is not asked for", held);
    } else {
        v.holds("samples without a demand", !shading.shades().iter().any(is_spectral));
    }
    let image = |plan: &Plan| {
        let plan = Arc::new(plan.clone());
        CameraImage::new(&shading, &scene.measure, plan, &Stop::NEVER).expect("never stopped")
    };
    let (image, by_sum) = (image(plan), image(&Plan::fixed(&scene.measure, Quality::Reference)));
    against_all(&shading, reading, &scene.measure, v);
    let mirrored = |i: usize| shading.coherent_samples().iter().any(|coherent| coherent.index as usize == i);
    for (i, shade) in shading.shades().iter().enumerate() {
        let signal = image.signals()[i];
        v.all_finite(signal.into_iter().chain(by_sum.signals()[i]).map(f64::from));
        if is_spectral(shade) && !mirrored(i) {
            let expected = plan.at(shade.kappa, shade.beta).map(|sum| (sum * shade.front) as f32);
            v.holds("not as the plan says", signal == expected);
        }
    }
}

/// The coherent components of a whole picture, relative to its brightest sample, compared with those without omissions.
fn against_all(shading: &ShadingImage, reading: Normalization, measure: &SpectralWeights, v: &mut Verdict) {
    let asked = shading.quality().given_tolerance().expect("an accuracy is asked for");
    v.holds("no brightness", shading.brightness() >= 0.0 && shading.brightness().is_finite());
    v.holds("the diffuse part less exact than the whole", shading.plan_tolerance().is_none_or(|part| part <= asked));
    let (geometry, surface) = (Arc::clone(shading.geometry()), *shading.surface());
    let exact = ShadingImage::new(geometry, surface, reading, Quality::Reference, &Stop::NEVER).expect("never stopped");
    v.holds(
        "the truth leaves more out",
        exact.quality().coherent_share() <= shading.quality().coherent_share().max(1e-14),
    );
    let plan = Arc::new(Plan::fixed(measure, Quality::Reference));
    let exact = CameraImage::new(&exact, measure, plan.clone(), &Stop::NEVER).expect("never stopped");
    let found = CameraImage::new(shading, measure, plan, &Stop::NEVER).expect("never stopped");
    let integral = CoherentIntegral::in_picture(shading, measure);
    let evaluations = shading.coherent_samples().iter().map(|coherent| integral.evaluations(coherent));
    v.holds("more wavelengths than there are", evaluations.max().unwrap_or(0) <= measure.dense().len());
    let pairs = || found.signals().as_flattened().iter().zip(exact.signals().as_flattened());
    let peak = pairs().fold(0.0_f64, |most, (_, exact)| most.max(exact.abs().into()));
    let off = pairs().fold(0.0_f64, |most, (found, exact)| most.max((found - exact).abs().into()));
    // Black by any measure is what is darker than e^-30 of the peak; signals are kept in single precision.
    v.holds("not within the tolerance", peak < 1e-12 || off <= (asked.max_relative_error() + 1.2e-7) * peak);
}
