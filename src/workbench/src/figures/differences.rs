//! Each camera's differences from the reference, large: arrows from the reference's place, a plot for each camera, all on one
//! scale; or the offsets of the Planckian loci over the temperature.

pub mod hue;
mod loci;
mod targets;

use chromascope_core::query::{Displacements, PatchColor};
use chromascope_figure::{Figure, FigureRoom, LegendPlace, Panel};

use super::chromaticity::{self, id, key};
use super::kind::FigureKind;
use super::look::{DifferencePlane, FigureLook};
use crate::document::SetKind;
use crate::plot_item::PickIndex;
use crate::scene::{ComparedSensor, Scene};
pub use targets::explained;

/// The plots with the items of their marks.
#[derive(Clone, Debug)]
pub struct Built {
    /// One board with all cameras, or two plots over the temperature.
    pub panels: Vec<Panel>,
    pub things: PickIndex,
}

/// A compared sensor with its displacements from the reference, or the reason that it has none.
struct Compared {
    source: ComparedSensor,
    shift: Result<Displacements, String>,
}

/// Coordinates of a color in the plane; none of the loci's.
fn place(plane: DifferencePlane, color: &PatchColor) -> Option<[f64; 2]> {
    match plane {
        DifferencePlane::UvPrime => color.uv.map(|uv| [uv.u, uv.v]),
        DifferencePlane::Xy => color.xy.map(|xy| [xy.x, xy.y]),
        DifferencePlane::Lab => color.lab.map(|lab| [lab.a, lab.b]),
        DifferencePlane::Loci => None,
    }
}

/// Names of the axes and of a difference's length, and its decimals.
const fn axes(plane: DifferencePlane) -> ([&'static str; 3], usize) {
    match plane {
        DifferencePlane::UvPrime => (["Δu′", "Δv′", "Δu′v′"], 4),
        DifferencePlane::Xy => (["Δx", "Δy", "Δxy"], 4),
        DifferencePlane::Lab => (["Δa*", "Δb*", "Δa*b*"], 2),
        DifferencePlane::Loci => (["ΔT", "Duv", ""], 4),
    }
}

/// The visible sensors that can be compared with the reference, or the reason that there are none.
fn sources(scene: &Scene<'_>) -> Result<Vec<ComparedSensor>, String> {
    let mut sources = scene.visible_sources();
    sources.retain(|source| !source.is_reference);
    let count = sources.len();
    let mut why = "No camera is compared with the reference.".to_owned();
    sources.retain(|source| match scene.comparable(source.kind, &source.name) {
        Ok(Err(reason)) => {
            why = crate::format::sentence(&reason.to_string());
            false
        }
        _ => true,
    });
    if sources.is_empty() && count == 0 && scene.sources().len() > 1 {
        "All cameras are hidden.".clone_into(&mut why);
    }
    if sources.is_empty() { Err(why) } else { Ok(sources) }
}

fn compared(scene: &Scene<'_>, plane: DifferencePlane) -> Result<(Vec<PatchColor>, Vec<Compared>), String> {
    let reference =
        scene.patch_colors(SetKind::Observer, &scene.document.reference).map_err(|error| error.to_string())?;
    let shift = |source: &ComparedSensor| {
        let colors = scene.patch_colors(source.kind, &source.name).map_err(|error| error.to_string())?;
        let pairs = reference.iter().zip(&colors).map(|(a, b)| (place(plane, a), place(plane, b)));
        let shift = Displacements::new(pairs);
        let undefined = || "Chromaticity undefined (X + Y + Z = 0).".to_owned();
        if shift.vectors.iter().any(Option::is_some) { Ok(shift) } else { Err(undefined()) }
    };
    let all = sources(scene)?.into_iter().map(|source| Compared { shift: shift(&source), source });
    let all = all.collect();
    Ok((reference, all))
}

/// Builds the plots for an area; the reason where there is nothing to draw.
pub fn build(scene: &Scene<'_>, look: &FigureLook, size: [f64; 2]) -> Result<Built, String> {
    match look.difference_plane {
        DifferencePlane::Loci => loci::build(scene, size),
        plane => targets::build(scene, look, plane, size),
    }
}

/// Mean length of the arrows on screen in points, of each camera.
pub fn mean_lengths(scene: &Scene<'_>, look: &FigureLook, size: [f64; 2]) -> Vec<f64> {
    let Ok((_, all)) = compared(scene, look.difference_plane) else { return Vec::new() };
    let scale = targets::Frame::of(scene, &all, look.difference_plane, size).scale;
    all.iter().flat_map(|one| &one.shift).map(|shift| shift.mean_length * scale).collect()
}

const SIZE: [f64; 2] = [640.0, 300.0];

pub static KIND: FigureKind =
    FigureKind::new("differences", "Each camera's differences from the reference as arrows, or of the loci", figure)
        .with_scales(super::strip::SCALES)
        .in_report();

fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let size = room.size(SIZE, 0.0);
    let paper = FigureLook { difference_plane: look.difference_plane, ..FigureLook::default() };
    let built = build(scene, &paper, size).ok()?;
    let mut figure = Figure::new("Differences", size);
    figure.panels = built.panels;
    let exaggerated = scene.document.exaggeration.sentence();
    let is_of_loci = look.difference_plane == DifferencePlane::Loci;
    if is_of_loci {
        let shown = scene.visible_sources().into_iter().filter(|source| !source.is_reference);
        figure.legend = shown.map(|source| key(&source, source.label.clone())).collect();
        figure.legend_place = LegendPlace::Below;
        let [seen, transform] = [chromaticity::viewing_conditions(scene), chromaticity::transform_words(scene)];
        let (loci, kelvin) = (chromaticity::loci_words(scene), scene.document.temperature_k);
        figure.caption =
            format!("{}{exaggerated} Vertical line: {kelvin:.0} K. {seen} {transform} {loci}", loci::WORDS);
    } else {
        let words = targets::words(scene, look.difference_plane, size);
        figure.caption = format!("{words}{exaggerated} {}", chromaticity::conditions(scene));
    }
    figure.table = if is_of_loci { loci::table(scene) } else { targets::table(scene) };
    Some(figure)
}
