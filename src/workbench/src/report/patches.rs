//! Experiment 2: patches of the chart.

use chromascope_core::colorimetry::Metric;

use super::claim::{CANON, Finding, KODAK, NIKON, Series, Subject, Value, Verdict};
use crate::document::{Document, SetKind};
use crate::scene::SceneError;

/// Spread of a signal above which a white is not the same through all sensors.
const SAME: f64 = 0.005;

const COLORED: [&str; 4] = ["red", "green", "blue", "orange yellow"];

/// Differences of a camera's patches from the reference's, by patch.
fn differences(subject: &Subject<'_>, document: &Document, camera: &str) -> Result<Series, SceneError> {
    let scene = subject.scene(document);
    let (patches, differences) = (scene.patches()?, scene.differences(SetKind::Camera, camera)?);
    let pairs = patches.patches().iter().zip(differences);
    Ok(Series(pairs.filter_map(|(patch, value)| Some((patch.name.clone(), value.ok()?))).collect()))
}

type OfCameras = Vec<(String, Series)>;

/// Differences of all cameras, by patch, and those of each camera.
fn table(subject: &Subject<'_>, document: &Document) -> Result<(Vec<Value>, OfCameras), SceneError> {
    const MANY: usize = 6;
    let metric = document.difference;
    let name = metric.name(document.transform.is_eq_13());
    let cameras = subject.cameras().into_iter();
    let all = cameras.map(|name| Ok((name.clone(), differences(subject, document, &name)?)));
    let all: OfCameras = all.collect::<Result<_, SceneError>>()?;
    let mut values = Vec::new();
    for (camera, series) in &all {
        let count = series.0.len();
        let row = |quantity: String, number: f64| Value::new(quantity, camera, number, "", metric.decimals);
        if count > MANY {
            let sum: f64 = series.0.iter().map(|(_, number)| number).sum();
            values.push(row(format!("{name}, mean of {count} patches"), sum / count as f64));
        } else {
            values.extend(series.0.iter().map(|(patch, number)| row(format!("{name} {patch}"), *number)));
        }
    }
    Ok((values, all))
}

/// True if red and orange yellow are nearer than green and blue for Canon and Nikon.
fn red_is_nearer(all: &[(String, Series)]) -> Option<bool> {
    let nearer = |camera: &str| {
        let (_, series) = all.iter().find(|(name, _)| name == camera)?;
        let of = |patch: &str| series.get(patch);
        Some(of("red")?.max(of("orange yellow")?) < of("green")?.min(of("blue")?))
    };
    Some(nearer(CANON)? && nearer(NIKON)?)
}

pub(super) fn white(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let scene = subject.scene(subject.document);
    let Some(at) = scene.patches()?.patches().iter().position(|patch| patch.name == "white") else {
        return Ok(Finding::on(None, []));
    };
    let blue = |kind, name: &str| {
        let color = scene.patch_colors(kind, name)?[at];
        Ok(color.rgb.map_or(f64::NAN, |rgb| rgb[2]))
    };
    let blues = subject.all(subject.document, blue)?;
    let range = |fold: fn(f64, f64) -> f64| blues.0.iter().map(|(_, blue)| *blue).reduce(fold).unwrap_or(f64::NAN);
    let verdict = if range(f64::max) - range(f64::min) <= SAME { Verdict::Holds } else { Verdict::Partly };
    Ok(Finding { values: blues.values("B of the white patch", "", 3), verdict })
}

pub(super) fn in_diagram(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let mut values = Vec::new();
    let mut holds = Some(true);
    for metric in [Metric::XY, Metric::UV_PRIME] {
        let document = Document { difference: metric, ..subject.document.clone() };
        let (found, all) = table(subject, &document)?;
        values.extend(found);
        holds = holds.zip(red_is_nearer(&all)).map(|(before, now)| before && now);
    }
    Ok(Finding::on(holds, values))
}

pub(super) fn by_eye(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let document = Document { difference: Metric::DELTA_E_2000, ..subject.fitted("D65") };
    let (values, all) = table(subject, &document)?;
    Ok(Finding::on(red_is_nearer(&all), values))
}

pub(super) fn farthest(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let document = Document { difference: Metric::XY, ..subject.document.clone() };
    let (_, all) = table(subject, &document)?;
    let least = |camera: &str, fold: fn(f64, f64) -> f64| {
        let (_, series) = all.iter().find(|(name, _)| name == camera)?;
        COLORED.iter().map(|patch| series.get(patch)).collect::<Option<Vec<f64>>>()?.into_iter().reduce(fold)
    };
    let each = |patch: &str| {
        let of = |camera: &str| all.iter().find(|(name, _)| name == camera)?.1.get(patch);
        Some(of(KODAK)? > of(CANON)?.max(of(NIKON)?))
    };
    let holds = COLORED.iter().map(|patch| each(patch)).collect::<Option<Vec<bool>>>().map(|all| !all.contains(&false));
    let extremes = [
        ("least Δxy of the colored patches", f64::min as fn(f64, f64) -> f64),
        ("largest Δxy of the colored patches", f64::max),
    ];
    let values = extremes.into_iter().flat_map(|(quantity, fold)| {
        let cameras = all.iter().filter_map(|(name, _)| Some((name.clone(), least(name, fold)?)));
        Series(cameras.collect()).values(quantity, "", 3)
    });
    Ok(Finding::on(holds, values))
}
