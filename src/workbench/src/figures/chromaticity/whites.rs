//! Standard whites and lines of equal correlated color temperature, for the CIE 1931 observer.

use chromascope_core::colorimetry::{UvPrime, Xy, Xyz};
use chromascope_core::light::Cct;
use chromascope_core::query::Ask;
use chromascope_core::units::Kelvin;
use chromascope_figure::{InkRole, Label, Mark, Marker, Place, Shape};

use super::drawing::{Drawing, Rank, label};
use crate::catalog::load::LightQuery;
use crate::document::{FIT_TARGET, Light, SetKind};
use crate::plot_item::{PickIndex, PlotItem};
use crate::scene::Scene;

/// White points with the preferred side of their labels: they lie close together.
const WHITES: [(&str, [f64; 2]); 5] =
    [("A", [1.0, 0.5]), ("D50", [1.0, -0.4]), ("D55", [-1.0, -0.5]), ("D65", [-1.0, 0.2]), ("E", [1.0, 0.6])];
/// Temperatures of the isotherms in kelvins.
const ISOTHERMS: [f64; 10] = [1500.0, 2000.0, 2500.0, 3000.0, 4000.0, 5000.0, 6500.0, 8000.0, 10_000.0, 20_000.0];
/// Length of an isotherm to each side in the CIE 1960 diagram.
const REACH: f64 = 0.03;

/// Adds both, by the document's settings.
pub(super) fn add(drawing: &mut Drawing<'_>) {
    let overlays = drawing.scene.document.overlays;
    if overlays.isotherms {
        add_isotherms(drawing);
    }
    if overlays.whites {
        add_whites(drawing);
    }
}

/// Chromaticity of a built-in light for the CIE 1931 observer.
fn white(scene: &Scene<'_>, name: &str) -> Option<Xy> {
    let place = scene.entry(SetKind::Illuminant, name).ok()?.place;
    let light = scene.results.ask(&LightQuery::Set(place));
    let grid = &(*light).as_ref().ok()?.grid;
    let [x, y, z] = scene.sensor(SetKind::Observer, FIT_TARGET).ok()?.integrate(grid.values());
    Xyz { x, y, z }.chromaticity()
}

fn add_whites(drawing: &mut Drawing<'_>) {
    let scene = drawing.scene;
    let plain = scene.document.filters.is_empty();
    let shown = |name: &str| plain && scene.document.light == Light::Set(name.to_owned());
    for (name, side) in WHITES {
        let at = white(scene, name).and_then(|xy| drawing.place(xy));
        let Some(at) = at.filter(|_| !shown(name)) else { continue };
        let shape = Shape::Points { points: vec![at], marker: Marker::Diamond, radius: 3.5 };
        let mark = Mark::new(PickIndex::NONE, format!("white {name}"), shape).with_stroke(InkRole::Text, 1.2);
        drawing.small.push(mark.with_fill(InkRole::Plot).with_halo(InkRole::Plot));
        let places = Place::around(at, side, 7.0);
        let (rank, label) = label(Rank::White, name, InkRole::Text, places);
        drawing.labels.push((rank, Label { starts: vec![at], ..label }));
    }
    let light = scene.light_color().ok().and_then(Xyz::chromaticity);
    let Some(at) = light.and_then(|xy| drawing.place(xy)) else { return };
    let tag = drawing.things.tag(PlotItem::Light);
    let shape = Shape::Points { points: vec![at], marker: Marker::Diamond, radius: 5.5 };
    let name = format!("light {}", scene.light_name());
    let mark = Mark::new(tag, &name, shape).with_stroke(InkRole::Text, 1.5).with_fill(InkRole::Text);
    drawing.small.push(mark.with_halo(InkRole::Plot));
    let places = Place::around(at, [0.2, 1.0], 9.0);
    let (rank, label) = label(Rank::Light, name, InkRole::Text, places);
    drawing.labels.push((rank, Label { starts: vec![at], ..label }));
}

fn add_isotherms(drawing: &mut Drawing<'_>) {
    let Ok(query) = drawing.scene.nearest_blackbody_query() else { return };
    let locus = drawing.scene.results.ask(&query);
    let Ok(locus) = &*locus else { return };
    for kelvins in ISOTHERMS {
        let Ok(temperature) = Kelvin::new(kelvins) else { continue };
        let end = |duv| {
            let uv = locus.off(Cct { temperature, duv })?;
            let uv = UvPrime { u: uv.u, v: 1.5 * uv.v };
            drawing.place_of(uv.xy(), Some(uv))
        };
        let Some((below, above)) = end(-REACH).zip(end(REACH)) else { continue };
        let name = format!("{kelvins:.0} K");
        let line = Shape::Segments { segments: vec![[below, above]] };
        let mark = Mark::new(PickIndex::NONE, format!("isotherm {name}"), line);
        drawing.marks.push(mark.with_stroke(InkRole::Weak, 0.8));
        let up = [0.0, -1.0];
        let places = vec![Place::beside(above, up, 3.0), Place::beside(below, up.map(|v| -v), 3.0)];
        drawing.labels.push(label(Rank::Ground, name, InkRole::Weak, places));
    }
}
