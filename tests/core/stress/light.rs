//! Blackbodies, daylight, color temperatures, loci.

use std::sync::LazyLock;

use chromascope_core::camera::{LocusEvaluator, LocusMethod};
use chromascope_core::colorimetry::{Uv60, Xy, Xyz};
use chromascope_core::light::daylight::{DaylightBasis, chromaticity};
use chromascope_core::light::planckian::{black_body, exitance, relative_exitance};
use chromascope_core::light::temperature::published::{Ohno, Robertson};
use chromascope_core::light::temperature::published::{hernandez_andres_1999, mccamy_1992};
use chromascope_core::light::{Cct, CctError, PlanckianLocus, RadiationConstants};
use chromascope_core::query::Temperatures;
use chromascope_core::spectral::{Primaries, Sensor};
use chromascope_core::units::Kelvin;
use chromascope_math::double::Double;

use super::draw::{Case, Draw, case};
use super::spectral::drawn_sensor;
use super::walk::{Verdict, Walk};
use crate::support::{CANON_10D, CIE_1931, DCS200, NIKON_D70, REFERENCE, dataset, sensor};

const C: RadiationConstants = RadiationConstants::Paper;

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "Kelvin", promise: 1e-15, share: 20.0, draw: |d| case([d.anything()]), check: units },
    Walk { name: "Temperatures", promise: 1e-15, share: 4.0, draw: draw_range, check: range },
    Walk { name: "exitance", promise: 1e-14, share: 40.0, draw: draw_body, check: body },
    Walk { name: "exitance ends", promise: 0.0, share: 20.0, draw: draw_far, check: body_ends },
    Walk { name: "relative_exitance", promise: 2e-14, share: 20.0, draw: draw_relative, check: relative },
    Walk { name: "black_body", promise: 0.0, share: 1.0, draw: draw_temperature, check: curve },
    Walk { name: "daylight", promise: 0.0, share: 4.0, draw: draw_temperature, check: daylight },
    Walk { name: "PlanckianLocus::cct", promise: 2e-9, share: 60.0, draw: draw_near, check: nearest },
    Walk { name: "PlanckianLocus::cct far", promise: 0.0, share: 20.0, draw: draw_color, check: any_color },
    Walk { name: "PlanckianLocus::at", promise: 2e-15, share: 4.0, draw: draw_temperature, check: at },
    Walk { name: "ccts", promise: 0.0, share: 0.3, draw: |d| case([d.key()]), check: many },
    Walk { name: "PlanckianLocus::new", promise: 0.0, share: 0.002, draw: draw_sensor, check: any_observer },
    Walk { name: "Robertson", promise: 1.4e-3, share: 10.0, draw: draw_near, check: robertson },
    Walk { name: "Ohno", promise: 4e-4, share: 4.0, draw: draw_near, check: ohno },
    Walk { name: "published", promise: 0.0, share: 20.0, draw: draw_color, check: published },
    Walk { name: "LocusEvaluator::raw", promise: 1e-13, share: 10.0, draw: draw_locus, check: locus },
    Walk { name: "LocusEvaluator::new", promise: 1e-11, share: 0.05, draw: draw_sensor, check: any_sensor },
];

static OBSERVER: LazyLock<Sensor> = LazyLock::new(|| sensor(CIE_1931));
static LOCUS: LazyLock<PlanckianLocus> = LazyLock::new(|| PlanckianLocus::new(&OBSERVER, C).unwrap());
static ROBERTSON: LazyLock<Robertson> = LazyLock::new(|| Robertson::new(&OBSERVER, C).unwrap());
static OHNO: LazyLock<Ohno> = LazyLock::new(|| Ohno::new(&OBSERVER, C).unwrap());
static DAYLIGHT: LazyLock<DaylightBasis> =
    LazyLock::new(|| DaylightBasis::new(&dataset("illuminants/cie_daylight_basis.csv")).unwrap());
static SENSORS: LazyLock<Vec<Sensor>> =
    LazyLock::new(|| [REFERENCE, CIE_1931, CANON_10D, NIKON_D70, DCS200].map(sensor).into());
static EVALUATORS: LazyLock<Vec<LocusEvaluator<&'static Sensor>>> =
    LazyLock::new(|| SENSORS.iter().map(|s| LocusEvaluator::new(s, C)).collect());
static SUMS: LazyLock<Vec<LocusEvaluator<&'static Sensor>>> =
    LazyLock::new(|| SENSORS.iter().map(|s| LocusEvaluator::by_sum(s, C)).collect());

fn units(&[x, ..]: &Case, v: &mut Verdict) {
    let taken = x > 0.0 && x.is_finite();
    v.holds("taken and not", Kelvin::new(x).is_ok() == taken);
    let Ok(t) = Kelvin::new(x) else { return v.refuse() };
    match Kelvin::from_mired(t.mired()) {
        Ok(back) => v.relative(back.get(), x, 0.0),
        Err(_) => v.holds("no way back", !(1e-290..1e290).contains(&x)),
    }
    v.holds("another number", Kelvin::new(x).is_ok_and(|t| t.get() == x));
}

fn draw_range(d: &mut Draw) -> Case {
    case([d.log(1e-300, 1e300), d.log(1e-300, 1e300), d.pick(40)])
}

/// Evenly in 1/T: all between the ends, each beyond the one before.
fn range(&[from, to, count, ..]: &Case, v: &mut Verdict) {
    let (Ok(from), Ok(to)) = (Kelvin::new(from), Kelvin::new(to)) else { return v.refuse() };
    let count = count.clamp(0.0, 100.0) as usize;
    let all = Temperatures::Range { from, to, count }.to_vec();
    v.holds("too many", all.len() <= count);
    v.holds("another first", count == 0 || all.first() == Some(&from));
    v.holds("another last", count < 2 || all.last() == Some(&to));
    let (low, high) = (from.min(to).get(), from.max(to).get());
    for t in all {
        v.error((low / t.get() - 1.0).max(t.get() / high - 1.0).max(0.0));
    }
}

fn draw_body(d: &mut Draw) -> Case {
    case([d.log(1.0, 1e9), d.log(1e-3, 1e18)])
}

fn draw_far(d: &mut Draw) -> Case {
    case([d.number(), d.number()])
}

fn exact_exitance(meters: f64, kelvins: f64) -> Option<Double> {
    let l = Double::from(meters);
    let x = Double::from(C.second()) / (l * kelvins.into());
    (x.value() < 600.0).then(|| Double::from(C.first()) / (l * l * l * l * l * x.exp_m1()))
}

fn body(&[nm, kelvins, ..]: &Case, v: &mut Verdict) {
    let (true, Ok(t)) = (nm.is_finite() && nm > 0.0, Kelvin::new(kelvins)) else { return v.refuse() };
    let value = exitance(nm, t, C);
    v.finite(value);
    let exponent = C.second() / (nm * 1e-9 * kelvins);
    match exact_exitance(nm * 1e-9, kelvins) {
        Some(exact) => v.relative(value, exact.value(), exponent * f64::EPSILON),
        None => v.holds("light of a cold body", (0.0..1e-200).contains(&value)),
    }
    if let Ok(hotter) = Kelvin::new(kelvins * (1.0 + 1e-12)) {
        v.holds("falls with temperature", exitance(nm, hotter, C) >= value * (1.0 - 1e-15));
    }
}

fn body_ends(&[nm, kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    for constants in [C, RadiationConstants::Si2019] {
        let value = exitance(nm, t, constants);
        v.finite(value);
        v.holds("below 0", value >= 0.0);
    }
}

fn draw_relative(d: &mut Draw) -> Case {
    let (a, b) = (d.within(380.0, 780.0), d.within(380.0, 780.0));
    case([a.min(b), a.max(b), d.log(1e-3, 1e18)])
}

fn relative(&[nm, anchor, kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let value = relative_exitance(nm, anchor, t, C);
    v.normal(value);
    v.holds("not positive", value >= 0.0);
    // A wavelength in nanometers that is a number in meters too would round; the ratio has the same exponents in any unit.
    let exponent = |l: f64| Double::from(C.second()) * 1e9.into() / (Double::from(l) * kelvins.into());
    let (x, x0) = (exponent(nm), exponent(anchor));
    if (x - x0).value() > 600.0 || !x.value().is_finite() {
        return v.holds("light of a cold body", value < 1e-250);
    }
    let one = Double::from(1.0);
    let short = |x: Double| if x.value() > 600.0 { one } else { one - (-x).exp() };
    let short = |x: Double| if x.value() < 0.5 { -(-x).exp_m1() } else { short(x) };
    let ratio = Double::from(anchor) / nm.into();
    let exact = (x0 - x).exp() * short(x0) / short(x) * ratio * ratio * ratio * ratio * ratio;
    v.relative(value, exact.value(), (x - x0).value() * f64::EPSILON * 4.0);
}

fn draw_temperature(d: &mut Draw) -> Case {
    let far = if d.pick(8) == 0.0 { d.log(1e-300, 1e300) } else { d.log(1e-3, 1e18) };
    case([if d.pick(2) == 0.0 { d.log(500.0, 30_000.0) } else { far }])
}

fn curve(&[kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let curve = black_body(t, C);
    curve.values().iter().for_each(|x| v.normal(*x));
    v.holds("below 0 or above its anchor", curve.values().iter().all(|x| (0.0..=1.0 + 1e-12).contains(x)));
    v.holds("black", curve.values().iter().any(|x| *x > 0.1));
}

fn daylight(&[kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let (Ok(xy), Ok(light)) = (chromaticity(t), DAYLIGHT.light(t)) else {
        v.holds("refused within 4000–25000 K", !(4000.0..=25000.0).contains(&kelvins));
        return v.refuse();
    };
    v.all_finite([xy.x, xy.y]);
    v.all_finite(light.values().iter().copied());
    if let Ok(hotter) = Kelvin::new(kelvins * 1.0001).map_or(Err(()), |t| chromaticity(t).map_err(|_| ())) {
        // The two cubics meet at 7000 K but for 1e-5 or so.
        v.holds(
            "x rises with temperature",
            hotter.x < xy.x + if (6999.0..7001.0).contains(&kelvins) { 1e-4 } else { 0.0 },
        );
    }
}

/// A temperature and a distance from the locus; to the ends of both.
fn draw_near(d: &mut Draw) -> Case {
    let duv = if d.pick(4) == 0.0 { d.signed(1e-15, 0.05) } else { d.within(-0.05, 0.05) };
    case([d.log(1000.0, 20_000.0), duv])
}

fn off(kelvins: f64, duv: f64) -> Option<(Cct, Uv60)> {
    let cct = Cct { temperature: Kelvin::new(kelvins).ok()?, duv };
    Some((cct, LOCUS.off(cct)?))
}

fn nearest(&[kelvins, duv, ..]: &Case, v: &mut Verdict) {
    let Some((asked, color)) = off(kelvins, duv) else { return v.refuse() };
    match LOCUS.cct(color) {
        Ok(found) => {
            // A rounded color is another color: half a unit of u and v over what a mired moves them, in kelvins.
            let t = asked.temperature.get();
            let per_kelvin = LOCUS
                .at(Kelvin::new((t * 1.000_01).min(20_000.0)).expect("warm"))
                .zip(LOCUS.at(Kelvin::new((t / 1.000_01).max(1000.0)).expect("warm")));
            let pace = per_kelvin.map_or(1e-9, |(a, b)| (a.u - b.u).hypot(a.v - b.v) / (2e-5 * t));
            let rounding = 1.2e-16 / pace;
            v.error(((found.temperature.get() - t).abs() - rounding).max(0.0));
            v.holds("Duv off by more than 1e-15", (found.duv - duv).abs() <= 1e-15);
        }
        Err(_) => v.holds("refused within the domain", duv.abs() > 0.05 * (1.0 - 1e-11)),
    }
}

fn draw_color(d: &mut Draw) -> Case {
    match d.pick(3) as u32 {
        0 => case([d.anything(), d.anything(), d.anything()]),
        1 => case([d.within(-0.2, 1.0), d.within(-0.2, 1.0), d.unit()]),
        _ => case([d.signed(1e-12, 1e12), d.signed(1e-12, 1e12), d.signed(1e-12, 1e12)]),
    }
}

fn said(answer: Result<Cct, CctError>, v: &mut Verdict) {
    match answer {
        Ok(cct) => {
            v.all_finite([cct.temperature.get(), cct.duv]);
            v.holds("Duv beyond 0.05", cct.duv.abs() <= 0.05 * (1.0 + 1e-10));
        }
        Err(_) => v.refuse(),
    }
}

fn any_color(&[x, y, z, ..]: &Case, v: &mut Verdict) {
    let answer = LOCUS.cct(Uv60 { u: x, v: y });
    said(answer, v);
    said(LOCUS.cct_of_xy(Xy { x, y }), v);
    said(LOCUS.cct_of_xyz(Xyz::new(x, y, z)), v);
    if let Ok(Cct { temperature, duv }) = answer {
        v.holds("beyond 1000–20000 K", (999.99..=20_000.01).contains(&temperature.get()));
        v.holds("no way back", LOCUS.off(Cct { temperature, duv }).is_some() || duv.abs() > 0.05);
    }
}

fn at(&[kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let Some(at) = LOCUS.at(t) else {
        v.holds("refused within the domain", !(1000.0..=20_000.0).contains(&kelvins));
        return v.refuse();
    };
    let [x, y, z] = SUMS[1].raw(t);
    let sum = Xyz::new(x, y, z).uv_prime().expect("a black body has a chromaticity").uv60();
    // The sum in doubles is itself within two units.
    v.error(((at.u - sum.u).hypot(at.v - sum.v) - 4e-16).max(0.0));
    if let Some(hotter) = Kelvin::new(kelvins * 1.000_1).ok().and_then(|t| LOCUS.at(t)) {
        v.holds("u rises with temperature", hotter.u < at.u);
    }
}

fn many(&[key, ..]: &Case, v: &mut Verdict) {
    let mut d = Draw::new(key as u64, "colors", 0);
    let colors: Vec<Uv60> = (0..37).map(|_| Uv60 { u: d.within(-0.1, 0.7), v: d.within(-0.1, 0.5) }).collect();
    let answers = LOCUS.ccts(&colors);
    let mut again = vec![Err(CctError::TooFar); 20];
    LOCUS.ccts_into(&colors, &mut again);
    v.holds("not the same twice", again == answers[..20]);
    for (color, answer) in colors.into_iter().zip(answers) {
        let near = match (LOCUS.cct(color), answer) {
            (Ok(a), Ok(b)) => (a.temperature.get() - b.temperature.get()).abs() < 4e-9 && (a.duv - b.duv).abs() < 2e-15,
            (a, b) => a == b,
        };
        v.holds("many are not as each", near);
    }
}

fn draw_sensor(d: &mut Draw) -> Case {
    case([d.key(), d.pick(4), d.log(1e-100, 1e100), d.log(1e-3, 1e18)])
}

fn any_observer(&[key, _, size, ..]: &Case, v: &mut Verdict) {
    let Some(observer) = drawn_sensor(key, Primaries::Xyz, size) else { return v.refuse() };
    let color = Uv60 { u: 0.2, v: 0.3 };
    match PlanckianLocus::new(&observer, C) {
        Ok(locus) => said(locus.cct(color), v),
        Err(_) => v.refuse(),
    }
    if let Ok(robertson) = Robertson::new(&observer, C) {
        said(robertson.cct(color), v);
    }
    if let Ok(ohno) = Ohno::new(&observer, C) {
        said(ohno.cct(color), v);
    }
}

fn against(found: Result<Cct, CctError>, kelvins: f64, v: &mut Verdict) {
    match found {
        Ok(found) => v.relative(found.temperature.get(), kelvins, 0.0),
        Err(_) => v.refuse(),
    }
}

fn robertson(&[kelvins, duv, ..]: &Case, v: &mut Verdict) {
    let Some((_, color)) = off(kelvins, duv) else { return v.refuse() };
    against(ROBERTSON.cct(color), kelvins, v);
}

fn ohno(&[kelvins, duv, ..]: &Case, v: &mut Verdict) {
    let Some((_, color)) = off(kelvins, duv) else { return v.refuse() };
    against(OHNO.cct(color), kelvins, v);
}

fn published(&[x, y, ..]: &Case, v: &mut Verdict) {
    let color = Xy { x, y };
    for answer in [mccamy_1992(color), hernandez_andres_1999(color)] {
        match answer {
            Ok(t) => v.holds("beyond what was published", (2854.0..=800_000.0).contains(&t.get())),
            Err(_) => v.refuse(),
        }
    }
    said(ROBERTSON.cct(Uv60 { u: x, v: y }), v);
    said(OHNO.cct(Uv60 { u: x, v: y }), v);
}

fn draw_locus(d: &mut Draw) -> Case {
    let [t, ..] = draw_temperature(d);
    case([d.pick(5), t])
}

/// The nodes against the sum, relative to the largest of the three signals.
fn compare(nodes: [f64; 3], sum: [f64; 3], v: &mut Verdict) {
    v.all_finite(nodes);
    v.all_finite(sum);
    let largest = sum.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (a, b) in nodes.into_iter().zip(sum) {
        v.error(if a == b { 0.0 } else { (a - b).abs() / largest });
    }
}

fn locus(&[which, kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let which = (which.max(0.0) as usize).min(4);
    compare(EVALUATORS[which].raw(t), SUMS[which].raw(t), v);
}

fn any_sensor(&[key, kind, size, kelvins, ..]: &Case, v: &mut Verdict) {
    let primaries = [Primaries::Camera, Primaries::Rgb, Primaries::Xyz, Primaries::Cones][kind as usize % 4];
    let Some(sensor) = drawn_sensor(key, primaries, size) else { return v.refuse() };
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let evaluator = LocusEvaluator::new(&sensor, C);
    compare(evaluator.raw(t), LocusEvaluator::by_sum(&sensor, C).raw(t), v);
    if let LocusMethod::Nodes { error, .. } = evaluator.method() {
        v.holds("a rule beyond 1e-11", error <= 1e-11);
    }
}
