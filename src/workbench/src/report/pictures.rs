//! Experiment 3: skin and leaf in sunlight.

use chromascope_core::colorimetry::delta_e_2000;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::PatchColor;

use super::claim::{CANON, Finding, KODAK, NIKON, Series, Subject, Value, Verdict};
use crate::document::render::{LEAF, SKIN, SUN};
use crate::document::{Document, SetKind};
use crate::scene::{Scene, SceneError};

fn color(scene: &Scene<'_>, kind: SetKind, name: &str) -> Result<PatchColor, SceneError> {
    let color = scene.patch_colors(kind, name)?.first().copied();
    color.ok_or_else(|| SceneError::NoSet { kind: SetKind::Material, name: scene.document.chart.clone() })
}

/// A number of the color of a material in sunlight, for all sensors.
fn numbers(subject: &Subject<'_>, material: &str, number: impl Fn(&PatchColor) -> f64) -> Result<Series, SceneError> {
    let document = subject.in_sun(material);
    let scene = subject.scene(&document);
    subject.all(&document, |kind, name| Ok(number(&color(&scene, kind, name)?)))
}

/// Number of a camera relative to the reference, which is the first.
fn relative(series: &Series, camera: &str) -> Option<f64> {
    Some(series.get(camera)? / series.0.first()?.1)
}

pub(super) fn brighter(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let luminances = numbers(subject, SKIN, |color| color.xyz.y)?;
    let ratios = subject.cameras().into_iter().filter_map(|name| Some((name.clone(), relative(&luminances, &name)?)));
    let ratios = Series(ratios.collect());
    let holds = ratios.get(KODAK).map(|ratio| ratio > 1.0);
    Ok(Finding::on(holds, ratios.values("Y of the skin, relative to the reference", "", 2)))
}

/// Saturation of HSV in linear RGB.
fn saturation(color: &PatchColor) -> f64 {
    let [r, g, b] = color.linear;
    let (high, low) = (r.max(g).max(b), r.min(g).min(b));
    (high - low) / high
}

pub(super) fn saturated(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let saturations = numbers(subject, SKIN, saturation)?;
    let mut values = saturations.values("saturation (HSV) of the skin", "", 3);
    values.extend(to_white(subject, SKIN)?.values("distance of the skin to white, xy", "", 3));
    let verdict = relative(&saturations, KODAK).map_or(Verdict::Open, |_| Verdict::Ambiguous);
    Ok(Finding { values, verdict })
}

/// Distances in xy of a material in sunlight from the white of the balance.
fn to_white(subject: &Subject<'_>, material: &str) -> Result<Series, SceneError> {
    let document = subject.in_sun(material);
    let white = subject.white(&document)?;
    numbers(subject, material, |color| white.zip(color.xy).map_or(f64::NAN, |(white, xy)| xy.distance(white)))
}

pub(super) fn fern_white(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    let distances = to_white(subject, LEAF)?;
    let holds = relative(&distances, KODAK).map(|ratio| ratio < 1.0);
    Ok(Finding::on(holds, distances.values("distance of the leaf to white, xy", "", 3)))
}

pub(super) fn greener(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    /// Difference of a* that is barely seen.
    const BARELY: f64 = 1.0;
    let greens = numbers(subject, LEAF, |color| color.lab.map_or(f64::NAN, |lab| lab.a))?;
    let than = |camera: &str| Some(greens.0.first()?.1 - greens.get(camera)?);
    let verdict = than(CANON).zip(than(NIKON)).map_or(Verdict::Open, |(canon, nikon)| match canon.min(nikon) {
        least if least > BARELY => Verdict::Holds,
        least if least > 0.0 => Verdict::Partly,
        _ => Verdict::Fails,
    });
    Ok(Finding { values: greens.values("a* of the leaf, of Eq 13 colors", "", 2), verdict })
}

/// A material scaled to L* 50 for the reference.
fn at_lightness_50(scene: &Scene<'_>) -> Result<PatchSet, SceneError> {
    fn luminance(lightness: f64) -> f64 {
        let root = (lightness + 16.0) / 116.0;
        if lightness > 8.0 { root.powi(3) } else { lightness * 27.0 / 24389.0 }
    }
    let now = color(scene, SetKind::Observer, &scene.document.reference)?.lab.map_or(50.0, |lab| lab.l);
    let factor = luminance(50.0) / luminance(now);
    let patches = scene.patches()?;
    let scaled = patches
        .patches()
        .iter()
        .take(1)
        .filter_map(|patch| Some((patch.name.clone(), patch.measured.map(|_, value| value * factor).ok()?)));
    Ok(PatchSet::new(scaled))
}

/// Differences of a material from the reference by the formula of ΔE*00: as it is, and at equal lightness.
fn differences(subject: &Subject<'_>, document: &Document) -> Result<[Series; 2], SceneError> {
    let scene = subject.scene(document);
    let scaled = at_lightness_50(&scene)?;
    let as_is = PatchSet::new(scene.patches()?.patches().iter().take(1).map(|p| (p.name.clone(), p.measured.clone())));
    let difference = |patches: &PatchSet, camera: &str| -> Result<f64, SceneError> {
        let lab = |kind, name: &str| {
            let colors = subject.colors(scene.rendering_of(kind, name)?, patches.clone())?;
            Ok::<_, SceneError>(colors.first().and_then(|color| color.lab))
        };
        let (reference, own) = (lab(SetKind::Observer, &document.reference)?, lab(SetKind::Camera, camera)?);
        Ok(reference.zip(own).map_or(f64::NAN, |(a, b)| delta_e_2000(a, b)))
    };
    Ok([subject.each(|camera| difference(&as_is, camera))?, subject.each(|camera| difference(&scaled, camera))?])
}

/// Differences of skin and leaf under conditions, and what they say of Canon and Nikon at equal lightness.
fn compared(subject: &Subject<'_>, name: &str, conditions: impl Fn(&str) -> Document) -> Result<Finding, SceneError> {
    let [skin, leaf] = [SKIN, LEAF].map(|material| differences(subject, &conditions(material)));
    let ([skin, skin_50], [leaf, leaf_50]) = (skin?, leaf?);
    let rows = [("skin", &skin), ("leaf", &leaf), ("skin at L* 50", &skin_50), ("leaf at L* 50", &leaf_50)];
    let values: Vec<Value> =
        rows.iter().flat_map(|(what, series)| series.values(&format!("{name}, {what}"), "", 2)).collect();
    let worse = |camera: &str| Some(leaf_50.get(camera)? > skin_50.get(camera)?);
    let holds = worse(CANON).zip(worse(NIKON)).map(|(canon, nikon)| canon && nikon);
    Ok(Finding::on(holds, values))
}

pub(super) fn skin_and_leaf(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    compared(subject, "Δ of Eq 13 colors", |material| subject.in_sun(material))
}

pub(super) fn skin_and_leaf_fitted(subject: &Subject<'_>) -> Result<Finding, SceneError> {
    compared(subject, "ΔE*00", |material| {
        let fitted = subject.fitted(SUN);
        let Document { chart, subset, .. } = subject.in_sun(material);
        let light = if subject.has_own_light { subject.document.light.clone() } else { fitted.light.clone() };
        Document { light, chart, subset, ..fitted }
    })
}
