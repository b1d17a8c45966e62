//! Correlated color temperature and Duv: published approximations, and the nearest blackbody itself.

use super::timing::{Bench, Candidate, Case, Room, each, spaced};
use super::{CONSTANTS, Numbers, OBSERVER, exact};
use crate::data::sensor;
use crate::harness::timed;
use crate::workload::{BenchError, ErrorOf, ErrorScale, Errors, Workload};
use chromascope_core::colorimetry::{Uv60, UvPrime, Xy};
use chromascope_core::light::PlanckianLocus;
use chromascope_core::light::temperature::{Cct, CctError, published};
use chromascope_core::spectral::Sensor;
use chromascope_core::units::Kelvin;
use chromascope_math::double::Double;
use rayon::prelude::*;

/// Temperature in kelvins and Duv; NaN where a method has no answer, or gives none.
type Answer = [f64; 2];

const NOTHING: Answer = [f64::NAN; 2];

#[derive(Clone, Copy)]
enum Judged {
    Temperature,
    Duv,
}

pub(super) fn run(bench: &mut Bench<'_>) -> Result<(), BenchError> {
    let observer = sensor(OBSERVER)?;
    for judged in [Judged::Temperature, Judged::Duv] {
        one(bench, &observer, judged);
    }
    Ok(())
}

fn one(bench: &mut Bench<'_>, observer: &Sensor, judged: Judged) {
    let items = bench.pick(300, 1_000_000, 1_000_000);
    let checked = bench.pick(6, 200, 2000);
    let (Ok(locus), locus_seconds) = timed(|| PlanckianLocus::new(observer, CONSTANTS)) else { return };
    let robertson = timed(|| published::Robertson::new(observer, CONSTANTS));
    let ohno = timed(|| published::Ohno::new(observer, CONSTANTS));
    let mut numbers = Numbers::new(6);
    let known: Vec<(f64, f64)> =
        (0..items).map(|_| (1e6 / numbers.between(50.5, 990.0), numbers.between(-0.045, 0.045))).collect();
    // Most colors may come from the code under test: only those checked have to be where they are to the last bit.
    let colors: Vec<Uv60> = known.iter().map(|&(kelvins, duv)| color(&locus, kelvins, duv)).collect();
    let some: Vec<(Uv60, f64)> = spaced(items, checked).map(|index| (colors[index], known[index].0)).collect();
    let exact: Vec<[Double; 2]> = bench.pools.on(bench.pools.most(), || {
        some.par_iter().map(|&(color, near)| exact::cct(observer, CONSTANTS, [color.u, color.v], near)).collect()
    });
    let error = |found: &[Answer]| error(judged, found, &exact);
    let room = Room::new(items, &NOTHING);
    let answers = Room::new(items, &Err(CctError::NoChromaticity));
    let one = [1, checked];
    let kelvins = |found: Result<Kelvin, CctError>| [found.map_or(f64::NAN, Kelvin::get), f64::NAN];
    let whole = |found: Result<Cct, CctError>| found.map_or(NOTHING, |cct| [cct.temperature.get(), cct.duv]);
    let mccamy = move |color: &Uv60| xy(*color).map_or(NOTHING, |xy| kelvins(published::mccamy_1992(xy)));
    let hernandez = move |color: &Uv60| xy(*color).map_or(NOTHING, |xy| kelvins(published::hernandez_andres_1999(xy)));
    let mut candidates: Vec<Candidate<'_>> = Vec::new();
    if let (Ok(robertson), seconds) = &robertson {
        let answer = move |color: &Uv60| whole(robertson.cct(*color));
        candidates.push(each("Robertson 1968", one, &colors, &room, error, answer).built_in(*seconds));
    }
    if let (Ok(ohno), seconds) = &ohno {
        let answer = move |color: &Uv60| whole(ohno.cct(*color));
        candidates.push(each("Ohno 2014", one, &colors, &room, error, answer).built_in(*seconds));
    }
    if matches!(judged, Judged::Temperature) {
        candidates.push(each("McCamy 1992", one, &colors, &room, error, mccamy));
        candidates.push(each("Hernández-Andrés 1999", one, &colors, &room, error, hernandez));
    }
    let scalar = |color: &Uv60| whole(locus.cct(*color));
    candidates.push(each("nearest point, one by one", one, &colors, &room, error, scalar).built_in(locus_seconds));
    for threads in bench.pools.counts() {
        let points: Vec<Uv60> = some.iter().map(|(color, _)| *color).collect();
        let found: Vec<Answer> = locus.ccts(&points).into_iter().map(whole).collect();
        let (locus, colors, answers) = (&locus, &colors, &answers);
        let work = move |items: usize| answers.lend(|answers| locus.ccts_into(&colors[..items], &mut answers[..items]));
        let candidate = Candidate::new("nearest point, side by side", items, error(&found), work);
        candidates.push(candidate.on(threads).built_in(locus_seconds));
    }
    let name = match judged {
        Judged::Temperature => "CIE 1931 2°, 1010 to 19 800 K, |Duv| below 0.045",
        Judged::Duv => "Duv of the same colors",
    };
    bench.compare(Case { workload: Workload::Temperature, name, item: "color" }, candidates);
}

fn color(locus: &PlanckianLocus, kelvins: f64, duv: f64) -> Uv60 {
    let there = Kelvin::new(kelvins).ok().and_then(|temperature| locus.off(Cct { temperature, duv }));
    there.unwrap_or(Uv60 { u: f64::NAN, v: f64::NAN })
}

fn xy(color: Uv60) -> Option<Xy> {
    UvPrime { u: color.u, v: color.v * 1.5 }.xy()
}

fn error(judged: Judged, found: &[Answer], exact: &[[Double; 2]]) -> ErrorOf {
    let which = judged as usize;
    let errors = Errors::against(found.iter().zip(exact).map(|(found, exact)| (&found[which], &exact[which])));
    let what = match judged {
        Judged::Temperature => "temperature in kelvins, where it answers, against the nearest point in 106 bits",
        Judged::Duv => "Duv, where it answers, against the nearest point in 106 bits",
    };
    errors.sum_up(what, ErrorScale::Absolute)
}
