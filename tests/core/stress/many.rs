//! Work for many at once: responses in batches, differences side by side, tables of loci.

use std::sync::LazyLock;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::batch::Sample;
use chromascope_core::camera::{
    Batch, BatchError, ColorTransform, LocusEvaluator, LocusTable, LocusTableError, Rendering, WhiteBalanceTarget,
};
use chromascope_core::colorimetry::{Lab, Xy, delta_e_2000, delta_e_2000_into};
use chromascope_core::light::RadiationConstants;
use chromascope_core::spectral::{Primaries, Sensor};
use chromascope_core::units::Kelvin;
use chromascope_math::double::Double;
use glam::DVec3;

use super::draw::{Case, Draw, case};
use super::spectral::{drawn_light, drawn_sensor};
use super::walk::{Verdict, Walk};
use crate::support::{CANON_10D, CIE_1931, DCS200, NIKON_D70, REFERENCE, light, sensor};

const C: RadiationConstants = RadiationConstants::Paper;

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "Batch", promise: 1.0, share: 2.0, draw: draw_batch, check: batch },
    Walk { name: "delta_e_2000_into", promise: 0.0, share: 0.5, draw: draw_pairs, check: pairs },
    Walk { name: "LocusTable::xy", promise: LocusTable::LIMIT, share: 10.0, draw: draw_temperature, check: xy },
    Walk { name: "LocusTable::xys", promise: 0.0, share: 1.0, draw: draw_pairs, check: xys },
    Walk { name: "LocusTable::within", promise: 1.0, share: 0.006, draw: draw_table, check: any_table },
    Walk { name: "LocusTable::of", promise: 1.0, share: 0.02, draw: draw_curve, check: any_curve },
];

/// A stream, the samples of a curve, channels, spectra, an offset in memory, a kind of numbers, a size.
fn draw_batch(d: &mut Draw) -> Case {
    let length = d.log(1.0, 500.0).floor() - f64::from(u8::from(d.pick(40) == 0.0));
    case([d.key(), length, d.pick(14), d.pick(9), d.pick(9), d.pick(6), d.log(1e-320, 1e300), d.pick(3)])
}

/// Numbers of some kind: zeros, a spike, small and large, anything, or usual.
fn numbers(d: &mut Draw, kind: f64, size: f64, count: usize) -> Vec<f64> {
    let place = d.pick(count.max(1) as u32) as usize;
    let number = |i: usize| match kind as u32 {
        0 => 0.0,
        1 => f64::from(u8::from(i == place)) * size,
        2 => d.signed(1e-300, 1e300),
        3 => d.anything(),
        4 => size * d.within(-1.0, 1.0),
        _ => d.unit(),
    };
    (0..count).map(number).collect()
}

fn batch(&[key, length, channels, rows, offset, kind, size, odd]: &Case, v: &mut Verdict) {
    let count = |n: f64| n.clamp(0.0, 1000.0) as usize;
    let (length, channels, rows, offset) = (count(length), count(channels), count(rows), count(offset));
    let mut d = Draw::new(key as u64, "batch", 0);
    let curves = numbers(&mut d, if kind == 3.0 { 5.0 } else { kind }, size, length * channels);
    let other = if d.pick(2) == 0.0 { kind } else { 5.0 };
    let spectra = numbers(&mut d, other, 1.0, offset + length * rows);
    let shape = Shape { length, rows, offset, ragged: odd >= 2.0 };
    responses(&curves, &spectra, shape, v);
    let single = |n: &[f64]| n.iter().map(|n| *n as f32).collect::<Vec<f32>>();
    responses(&single(&curves), &single(&spectra), shape, v);
}

#[derive(Clone, Copy)]
struct Shape {
    length: usize,
    rows: usize,
    offset: usize,
    ragged: bool,
}

/// Each response beside its sum in two doubles, in parts of what it may be off by; and the same alone as among others.
fn responses<T: Sample + Into<f64>>(curves: &[T], spectra: &[T], shape: Shape, v: &mut Verdict) {
    let Shape { length, rows, offset, ragged } = shape;
    let number = |n: &T| -> f64 { (*n).into() };
    let batch = match Batch::new(curves, length) {
        Ok(batch) => batch,
        Err(refusal) => {
            let odd = curves.iter().any(|c| !number(c).is_finite());
            v.holds(
                "refused without need",
                odd && refusal == BatchError::NotFinite || length == 0 && !curves.is_empty(),
            );
            return v.refuse();
        }
    };
    let spectra = &spectra[offset..];
    let Ok(answers) = batch.responses(spectra) else {
        v.holds("spectra refused without need", length == 0 && !spectra.is_empty());
        return v.refuse();
    };
    let channels = batch.channels();
    v.holds("another number of answers", answers.len() == rows * channels || length == 0);
    if ragged && length > 1 && !spectra.is_empty() {
        v.holds("part of a spectrum is taken", batch.responses(&spectra[1..]).is_err());
        v.holds("part of a curve is taken", curves.is_empty() || Batch::new(&curves[1..], length).is_err());
    }
    if !answers.is_empty() {
        let mut short = answers[1..].to_vec();
        v.holds("too few places are taken", batch.responses_into(spectra, &mut short).is_err());
    }
    for (n, (spectrum, row)) in spectra.chunks(length.max(1)).zip(answers.chunks(channels.max(1))).enumerate() {
        let mut alone = row.to_vec();
        v.holds("refused alone", batch.responses_into(spectrum, &mut alone).is_ok());
        v.holds("another answer alone", alone == row);
        for (c, answer) in row.iter().enumerate() {
            let curve = &curves[c * length..(c + 1) * length];
            response(curve, spectrum, number(answer), batch.max_error(), v);
            if n == 0 {
                let single = Batch::new(curve, length).and_then(|batch| batch.responses(spectrum));
                v.holds("another answer of a single channel", single.is_ok_and(|s| s == [*answer]));
            }
        }
    }
}

fn response<T: Sample + Into<f64>>(curve: &[T], spectrum: &[T], answer: f64, max_error: f64, v: &mut Verdict) {
    v.finite(answer);
    let products = || curve.iter().zip(spectrum).map(|(a, b)| -> (f64, f64) { ((*a).into(), (*b).into()) });
    if products().any(|(a, b)| !(a * b).is_finite()) {
        return v.holds("not 0 though a sample is no number", answer == 0.0 || products().all(|(_, b)| b.is_finite()));
    }
    let unsigned: f64 = products().map(|(a, b)| (a * b).abs()).sum();
    // Where sums may overflow, and where products are subnormal, only a finite result is required.
    let [least, most] = if size_of::<T>() == 4 { [1e-37, 1e38] } else { [1e-290, 1e300] };
    if unsigned > most || products().any(|(a, b)| a != 0.0 && b != 0.0 && (a * b).abs() < least) {
        return;
    }
    let mut exact = Double::from(0.0);
    for (a, b) in products() {
        exact = exact + Double::from(a) * b.into();
    }
    let off = (Double::from(answer) - exact).value().abs();
    v.error(if off == 0.0 { 0.0 } else { off / (max_error * unsigned) });
}

/// A stream, how many there are of each of three, and where from.
fn draw_pairs(d: &mut Draw) -> Case {
    let most = if d.pick(50) == 0.0 { 9000.0 } else { 200.0 };
    let mut count = || d.log(1.0, most).floor() - 1.0;
    let counts = [count(), count(), count()];
    case([d.key(), counts[0], counts[1], counts[2], d.pick(4)])
}

fn pairs(&[key, first, second, room, offset, ..]: &Case, v: &mut Verdict) {
    const LEFT: f64 = -7.0;
    let count = |n: f64| n.clamp(0.0, 1e4) as usize;
    let mut d = Draw::new(key as u64, "pairs", 0);
    let kinds = d.pick(2) == 0.0;
    let mut color = || {
        if kinds {
            Lab { l: d.number(), a: d.number(), b: d.number() }
        } else {
            Lab { l: d.within(0.0, 100.0), a: d.within(-100.0, 100.0), b: d.within(-100.0, 100.0) }
        }
    };
    let mut firsts: Vec<Lab> = (0..count(first)).map(|_| color()).collect();
    let seconds: Vec<Lab> = (0..count(second)).map(|_| color()).collect();
    let offset = count(offset).min(firsts.len());
    if let Some(color) = firsts.get_mut(offset) {
        // One that is NaN must not reach the others.
        color.a = if kinds { f64::NAN } else { color.a };
    }
    let firsts = &firsts[offset..];
    let mut answers = vec![LEFT; count(room)];
    delta_e_2000_into(firsts, &seconds, &mut answers);
    let many = firsts.len().min(seconds.len()).min(answers.len());
    v.holds("written beyond the shortest", answers[many..].iter().all(|a| *a == LEFT));
    for (i, ((a, b), answer)) in firsts.iter().zip(&seconds).zip(&answers).enumerate() {
        let alone = delta_e_2000(*a, *b);
        v.holds("not as one by one", alone.to_bits() == answer.to_bits() || alone.is_nan() && answer.is_nan());
        if i > 0 || !kinds {
            v.finite(*answer);
        }
    }
}

/// A sensor with its color transform, its table and its sum.
struct Seen {
    rendering: Rendering,
    table: LocusTable,
    sum: LocusEvaluator<Box<Sensor>>,
}

static SEEN: LazyLock<Vec<Seen>> = LazyLock::new(|| {
    let of = |path| {
        let sensor = sensor(path);
        let rendering =
            Rendering::new(&sensor, &light("illuminants/d55.csv"), WhiteBalanceTarget::UNITY, ColorTransform::Paper)
                .unwrap();
        let table = LocusTable::new(&sensor, &rendering, C);
        Seen { rendering, table, sum: LocusEvaluator::by_sum(Box::new(sensor), C) }
    };
    [REFERENCE, CIE_1931, CANON_10D, NIKON_D70, DCS200].map(of).into()
});

/// Made before there are many threads: one that waits for a part of a table would take up a case that waits for the table.
pub(super) fn ready() {
    LazyLock::force(&SEEN);
}

impl Seen {
    fn exact(&self, t: Kelvin) -> Option<Xy> {
        through(&self.rendering, self.sum.raw(t))
    }
}

fn through(rendering: &Rendering, raw: [f64; 3]) -> Option<Xy> {
    rendering.xyz(DVec3::from_array(raw) * rendering.locus_gain).chromaticity()
}

fn draw_temperature(d: &mut Draw) -> Case {
    let t = match d.pick(4) as u32 {
        0 => d.log(1e-300, 1e300),
        1 => d.log(0.9, 1.1),
        _ => d.log(0.5, 2e15),
    };
    case([d.pick(5), t])
}

fn is_outside(t: Kelvin) -> bool {
    !(1.0..=1e15).contains(&t.get())
}

/// Checks a table against the sum; errors are returned exactly outside the table.
fn against(
    answer: Result<Xy, LocusTableError>,
    t: Kelvin,
    exact: impl Fn() -> Option<Xy>,
    v: &mut Verdict,
) -> Option<f64> {
    v.holds("refused or not", is_outside(t) == (answer == Err(LocusTableError::Outside)));
    match answer {
        Ok(xy) => {
            v.all_finite([xy.x, xy.y]);
            let exact = exact();
            v.holds("a chromaticity of nothing", exact.is_some());
            exact.map(|exact| (xy.x - exact.x).abs().max((xy.y - exact.y).abs()))
        }
        Err(_) => None,
    }
}

fn xy(&[which, kelvins, ..]: &Case, v: &mut Verdict) {
    let Ok(t) = Kelvin::new(kelvins) else { return v.refuse() };
    let seen = &SEEN[(which.max(0.0) as usize).min(4)];
    match against(seen.table.xy(t), t, || seen.exact(t), v) {
        Some(off) => v.error(off),
        None => v.refuse(),
    }
}

fn xys(&[key, count, room, which, ..]: &Case, v: &mut Verdict) {
    let mut d = Draw::new(key as u64, "temperatures", 0);
    let many = |n: f64| n.clamp(0.0, 1e4) as usize;
    let table = &SEEN[which as usize % 5].table;
    let mut kelvin = || Kelvin::new(if d.pick(8) == 0.0 { d.log(1e-320, 1e308) } else { d.log(0.5, 2e15) });
    let temperatures: Vec<Kelvin> = (0..many(count)).filter_map(|_| kelvin().ok()).collect();
    let answers = table.xys(&temperatures);
    v.holds("another number", answers.len() == temperatures.len());
    v.holds("not as one by one", temperatures.iter().zip(&answers).all(|(t, answer)| table.xy(*t) == *answer));
    let left = Ok(Xy { x: -7.0, y: -7.0 });
    let mut room = vec![left; many(room)];
    table.xys_into(&temperatures, &mut room);
    let shorter = room.len().min(answers.len());
    v.holds("not the same twice", room[..shorter] == answers[..shorter]);
    v.holds("written beyond the shorter", room[shorter..].iter().all(|answer| *answer == left));
}

fn draw_table(d: &mut Draw) -> Case {
    let target = if d.pick(3) == 0.0 { d.anything() } else { d.log(1e-16, 1.0) };
    case([d.key(), d.pick(4), d.log(1e-100, 1e99), d.pick(6), target, d.key()])
}

/// Error bound of a table: ten times the target, which is not below [`LocusTable::TARGET`].
fn promised(table: &LocusTable, target: f64, v: &mut Verdict) -> f64 {
    let limit = 10.0 * target.max(LocusTable::TARGET);
    v.holds("an error beyond the limit", table.max_error() <= limit * (1.0 + 1e-12));
    v.finite(table.max_error());
    v.holds("another size", table.size()[0] <= 1536 && table.size()[1] == 16);
    limit
}

fn any_table(&[key, kind, size, light, target, other, ..]: &Case, v: &mut Verdict) {
    let primaries = [Primaries::Camera, Primaries::Rgb, Primaries::Xyz, Primaries::Cones][kind as usize % 4];
    let Some(sensor) = drawn_sensor(key, primaries, size) else { return v.refuse() };
    let light = drawn_light(key + 1.0, light, &sensor);
    let Ok(rendering) = Rendering::new(&sensor, &light, WhiteBalanceTarget::UNITY, ColorTransform::Paper) else {
        return v.refuse();
    };
    let Ok(accuracy) = RelTolerance::new(target) else { return v.refuse() };
    let table = LocusTable::within(&sensor, &rendering, C, accuracy);
    let limit = promised(&table, target, v);
    let sum = LocusEvaluator::by_sum(&sensor, C);
    let mut d = Draw::new(other as u64, "temperatures", 0);
    for t in (0..200).filter_map(|_| Kelvin::new(d.log(0.5, 2e15)).ok()) {
        if let Some(off) = against(table.xy(t), t, || through(&rendering, sum.raw(t)), v) {
            v.error(off / limit);
        }
    }
}

/// A curve by its kind, how crooked and how large it is, and the temperature at which it ends.
fn draw_curve(d: &mut Draw) -> Case {
    let size = if d.pick(2) == 0.0 { 1.0 } else { d.log(1e-300, 1e300) };
    case([d.pick(6), d.log(1e-9, 1e3), size, d.log(1e-3, 1e18), d.key()])
}

fn any_curve(&[kind, bend, size, end, other, ..]: &Case, v: &mut Verdict) {
    let exact = |t: Kelvin| {
        let m = 1e6 / t.get();
        let at = |x: f64, y: f64| Some(Xy { x: size * x, y: size * y });
        match kind as u32 {
            0 => at((bend * m).sin(), (bend * m).cos()),
            1 => (t.get() < end).then_some(Xy { x: 0.3, y: 0.3 }),
            2 => at(f64::NAN, 0.3),
            3 => at(f64::INFINITY, f64::NEG_INFINITY),
            4 => at((-bend * m).exp(), 1.0 / (1.0 + m)),
            _ => None,
        }
    };
    let table = LocusTable::of(exact);
    let limit = promised(&table, 0.0, v);
    let mut d = Draw::new(other as u64, "temperatures", 0);
    for t in (0..200).filter_map(|_| Kelvin::new(d.log(0.5, 2e15)).ok()) {
        let answer = table.xy(t);
        v.holds("of no number a chromaticity", answer.is_err() || ![2, 3, 5].contains(&(kind as u32)));
        if kind == 1.0 {
            // A step between two places that are looked at stays unseen; elsewhere it is constant.
            v.holds("another constant", answer.is_err() || answer.is_ok_and(|xy| (xy.x - 0.3).abs() < 1e-12));
        } else if let Some(off) = against(answer, t, || exact(t), v) {
            v.error(off / limit);
        }
    }
}
