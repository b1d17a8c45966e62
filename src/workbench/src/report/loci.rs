//! Experiment 1: Planckian loci.

use chromascope_core::query::Temperatures;
use chromascope_core::units::Kelvin;

use super::claim::{CANON, Finding, KODAK, NIKON, Subject, Value};
use crate::document::{Diagram, LOCUS_RANGE_K, SetKind};
use crate::scene::locus::distance;
use crate::scene::{Scene, SceneError};

/// Temperatures in kelvins that count as daylight.
const DAYLIGHT: std::ops::RangeInclusive<f64> = 5000.0..=6200.0;
const COUNT: usize = 2001;

pub(super) fn lengths(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let scene = subject.scene(subject.document);
    let [from, to] = LOCUS_RANGE_K;
    let temperatures = Temperatures::Range { from: Kelvin::new(from)?, to: Kelvin::new(to)?, count: COUNT };
    let length = |kind, name: &str| Ok(scene.locus_at(kind, name, temperatures.clone())?.length_xy());
    let lengths = subject.all(subject.document, length)?;
    let shortest =
        lengths.get(KODAK).map(|kodak| lengths.0.iter().all(|(name, length)| name == KODAK || *length > kodak));
    let mut values = lengths.values("length in xy", "", 3);
    values.extend(subject.spread("length in xy", "", 3, |name| length(SetKind::Camera, name))?);
    Ok(Finding::on(shortest, values))
}

/// Temperature at which a camera's locus is nearest to the reference's.
fn minimum(scene: &Scene<'_>, camera: &str) -> f64 {
    let nearest = scene.nearest_to_reference(SetKind::Camera, camera, Diagram::Xy);
    nearest.map_or(f64::NAN, |nearest| nearest.kelvin)
}

pub(super) fn minima(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let scene = subject.scene(subject.document);
    let minima = subject.each(|camera| Ok(minimum(&scene, camera)))?;
    let around = minima.0.iter().all(|(_, kelvin)| DAYLIGHT.contains(kelvin));
    let mut values = minima.values("nearest at", "K", 0);
    values.extend(subject.spread("nearest at", "K", 0, |camera| Ok(minimum(&scene, camera)))?);
    Ok(Finding::on(Some(around), values))
}

pub(super) fn minima_under_a(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let document = subject.fitted("A");
    let scene = subject.scene(&document);
    let minima = subject.each(|camera| Ok(minimum(&scene, camera)))?;
    let moved = minima.0.iter().all(|(_, kelvin)| !DAYLIGHT.contains(kelvin));
    let mut values = minima.values("nearest at, fitted under A", "K", 0);
    let scene = subject.scene(subject.document);
    let library = subject.catalog.of_kind(SetKind::Camera).map(|camera| minimum(&scene, &camera.name));
    let [least, most] = library.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], at| [least.min(at), most.max(at)]);
    for (quantity, number) in [("least of the library, by Eq 15", least), ("most of the library, by Eq 15", most)] {
        values.push(Value::new(quantity, "", number, "K", 0));
    }
    Ok(Finding::on(Some(!moved), values))
}

fn in_logarithm() -> Result<Vec<Kelvin>, SceneError> {
    let [from, to] = LOCUS_RANGE_K;
    let at = |index: usize| from * (to / from).powf(index as f64 / (COUNT - 1) as f64);
    Ok((0..COUNT).map(|index| Kelvin::new(at(index).min(to))).collect::<Result<_, _>>()?)
}

/// Distances of a camera's locus from the reference's along temperatures.
fn distances(scene: &Scene<'_>, camera: &str, temperatures: &[Kelvin]) -> Result<Vec<f64>, SceneError> {
    let along = |kind, name: &str| scene.locus_at(kind, name, Temperatures::List(temperatures.to_vec()));
    let (reference, own) = (along(SetKind::Observer, &scene.document.reference)?, along(SetKind::Camera, camera)?);
    let pairs = own.points.iter().zip(&reference.points);
    Ok(pairs.map(|(a, b)| distance(a, b, Diagram::Xy).unwrap_or(f64::NAN)).collect())
}

pub(super) fn means(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let scene = subject.scene(subject.document);
    let temperatures = in_logarithm()?;
    let mean = |distances: &[f64]| {
        let pairs = distances.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
        pairs.sum::<f64>() / (distances.len() - 1) as f64
    };
    let of = |camera: &str| Ok(mean(&distances(&scene, camera, &temperatures)?));
    let means = subject.each(of)?;
    let mut values = means.values("mean distance in xy over log T", "", 3);
    values.extend(subject.spread("mean distance in xy over log T", "", 3, of)?);
    let named = [CANON, NIKON].map(|camera| means.get(camera)).into_iter().collect::<Option<Vec<f64>>>();
    let Some((kodak, others)) = means.get(KODAK).zip(named) else {
        return Ok(Finding::on(None, values));
    };
    let kodaks = distances(&scene, KODAK, &temperatures)?;
    let canons = distances(&scene, CANON, &temperatures)?;
    let lead: Vec<f64> = canons.iter().zip(&kodaks).map(|(canon, kodak)| canon - kodak).collect();
    // Where the lead changes its sign.
    let at = |index: usize| {
        let share = lead[index] / (lead[index] - lead[index + 1]);
        let [a, b] = [index, index + 1].map(|index| temperatures[index].get());
        a + share * (b - a)
    };
    let crossings = (0..COUNT - 1).filter(|&index| (lead[index] > 0.0) != (lead[index + 1] > 0.0));
    let nearer: Vec<f64> = crossings.map(at).collect();
    for (quantity, kelvin) in
        [("nearer than the Canon from", nearer.first()), ("nearer than the Canon to", nearer.last())]
    {
        values.extend(kelvin.map(|kelvin| Value::new(quantity, KODAK, *kelvin, "K", 0)));
    }
    Ok(Finding::on(Some(others.iter().all(|mean| *mean < kodak)), values))
}
