//! Background of the diagram: colored area, spectral locus, gamuts and daylight locus.

use std::sync::{Arc, OnceLock};

use chromascope_core::colorimetry::diagram::{SpectralPoint, area_color, wavelength_color};
use chromascope_core::colorimetry::rgb::GAMUTS;
use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_core::light::daylight;
use chromascope_core::units::Kelvin;
use chromascope_figure::{Dash, Image, InkRole, Mark, Place, Shape};

use super::drawing::{Drawing, Rank, label};
use crate::document::{Diagram, FIT_TARGET, SetKind};
use crate::plot_item::PickIndex;

/// Pixels along a side of the area's picture.
const PIXELS: usize = 192;
/// The corner of the picture opposite to the origin, in both diagrams.
const EXTENT: [[f64; 2]; 2] = [[0.75, 0.85], [0.65, 0.60]];

/// Adds the background by the document's settings.
pub(super) fn add(drawing: &mut Drawing<'_>) {
    add_area(drawing);
    add_labels(drawing);
    let overlays = drawing.scene.document.overlays;
    for (gamut, on) in GAMUTS.iter().zip([overlays.srgb, overlays.dci_p3, overlays.rec2020]) {
        if on {
            let points: Vec<[f64; 2]> = gamut.primaries.iter().filter_map(|xy| drawing.place(*xy)).collect();
            let corner = points.get(1).copied();
            let line = Shape::Line { points, closed: true };
            drawing.marks.push(Mark::new(PickIndex::NONE, gamut.name, line).with_stroke(InkRole::Weak, 1.2));
            if let Some(at) = corner {
                let places = Place::around(at, [1.0, -1.0], 4.0);
                drawing.labels.push(label(Rank::Ground, gamut.name, InkRole::Weak, places));
            }
        }
    }
    if overlays.daylight {
        add_daylight(drawing);
    }
}

/// The colors of the area and its outline.
pub(super) fn add_area(drawing: &mut Drawing<'_>) {
    let Ok(outline) = drawing.scene.outline() else { return };
    let image = picture(drawing.diagram, &outline);
    let max = EXTENT[usize::from(drawing.diagram == Diagram::UvPrime)];
    let area = Shape::Image { min: [0.0, 0.0], max, image };
    drawing.marks.push(Mark::new(PickIndex::NONE, "colors of the diagram", area));
    let Ok(observer) = drawing.scene.sensor(SetKind::Observer, FIT_TARGET) else { return };
    let points: Vec<([f64; 2], [u8; 3])> = outline
        .iter()
        .filter_map(|p| Some((drawing.place(p.xy)?, wavelength_color(&observer, p.wavelength_nm))))
        .collect();
    let ends = points.first().zip(points.last()).map(|(a, b)| vec![a.0, b.0]);
    let locus = Mark::new(PickIndex::NONE, "spectral locus", Shape::Gradient { points });
    drawing.marks.push(locus.with_stroke(InkRole::Weak, 2.0));
    if let Some(points) = ends {
        let line = Shape::Line { points, closed: false };
        drawing.marks.push(Mark::new(PickIndex::NONE, "purple line", line).with_stroke(InkRole::Weak, 1.0));
    }
}

/// Wavelengths along the outline.
fn add_labels(drawing: &mut Drawing<'_>) {
    let Ok(outline) = drawing.scene.outline() else { return };
    let center = drawing.place(Xy { x: 1.0 / 3.0, y: 1.0 / 3.0 }).unwrap_or_default();
    for nm in [460.0, 470.0, 480.0, 490.0, 500.0, 520.0, 540.0, 560.0, 580.0, 600.0, 620.0, 700.0] {
        let Some(at) = outline.iter().find(|p| p.wavelength_nm == nm).and_then(|p| drawing.place(p.xy)) else {
            continue;
        };
        let away = [at[0] - center[0], at[1] - center[1]];
        let length = away[0].hypot(away[1]).max(1e-9);
        // Outside, or inside where the plot ends.
        let out = [away[0] / length, -away[1] / length];
        let sides = [1.0, -1.0].into_iter().flat_map(|side| [6.0, 9.0, 12.0].map(|far| (side, far)));
        let places = sides.map(|(side, far)| Place::beside(at, out.map(|v| side * v), far)).collect();
        drawing.labels.push(label(Rank::Ground, format!("{nm:.0}"), InkRole::Weak, places));
        let dot = Shape::Points { points: vec![at], marker: chromascope_figure::Marker::Circle, radius: 1.8 };
        drawing.marks.push(Mark::new(PickIndex::NONE, "wavelength", dot).with_fill(InkRole::Weak));
    }
}

fn add_daylight(drawing: &mut Drawing<'_>) {
    let points: Vec<[f64; 2]> = (0..=80)
        .filter_map(|i| Kelvin::from_mired(250.0 - 210.0 * f64::from(i) / 80.0).ok())
        .filter_map(|kelvin| daylight::chromaticity(kelvin).ok())
        .filter_map(|xy| drawing.place(xy))
        .collect();
    let end = points.last().copied();
    let line = Mark::new(PickIndex::NONE, "daylight locus", Shape::Line { points, closed: false });
    drawing.marks.push(line.with_stroke(InkRole::Weak, 1.5).with_dash(Dash::Dashed));
    if let Some(at) = end {
        drawing.labels.push(label(Rank::Ground, "daylight", InkRole::Weak, Place::around(at, [-1.0, 0.0], 6.0)));
    }
}

/// The colors within the spectral locus, made once for each diagram.
fn picture(diagram: Diagram, outline: &[SpectralPoint]) -> Image {
    static MADE: [OnceLock<Image>; 2] = [const { OnceLock::new() }; 2];
    MADE[usize::from(diagram == Diagram::UvPrime)].get_or_init(|| paint(diagram, outline)).clone()
}

fn paint(diagram: Diagram, outline: &[SpectralPoint]) -> Image {
    let corners: Vec<[f64; 2]> = outline
        .iter()
        .filter_map(|p| match diagram {
            Diagram::Xy => Some([p.xy.x, p.xy.y]),
            Diagram::UvPrime => p.xy.uv_prime().map(|uv| [uv.u, uv.v]),
        })
        .collect();
    let [width, height] = EXTENT[usize::from(diagram == Diagram::UvPrime)];
    let cell = width / PIXELS as f64;
    let mut rgba = Vec::with_capacity(4 * PIXELS * PIXELS);
    for row in 0..PIXELS {
        let v = height * (1.0 - (row as f64 + 0.5) / PIXELS as f64);
        let covered = coverage(&corners, row, height, cell);
        for (column, covered) in covered.into_iter().enumerate() {
            let u = cell * (column as f64 + 0.5);
            let xy = match diagram {
                Diagram::Xy => Some(Xy { x: u, y: v }),
                Diagram::UvPrime => UvPrime { u, v }.xy(),
            };
            let [r, g, b] = xy.filter(|_| covered > 0.0).map_or([0; 3], area_color);
            rgba.extend([r, g, b, (255.0 * crate::palette::DIAGRAM_FILL * covered).round() as u8]);
        }
    }
    Image { width: PIXELS, height: PIXELS, rgba: Arc::from(rgba) }
}

/// Share of each pixel of a row that lies within an outline, from four scan lines.
fn coverage(corners: &[[f64; 2]], row: usize, height: f64, cell: f64) -> Vec<f32> {
    const LINES: usize = 4;
    let mut covered = vec![0.0_f32; PIXELS];
    for line in 0..LINES {
        let y = height * (1.0 - (row as f64 + (line as f64 + 0.5) / LINES as f64) / PIXELS as f64);
        let mut crossings = Vec::new();
        let mut previous = corners.last().copied().unwrap_or_default();
        for &corner in corners {
            if (corner[1] > y) != (previous[1] > y) {
                let t = (y - previous[1]) / (corner[1] - previous[1]);
                crossings.push((previous[0] + t * (corner[0] - previous[0])) / cell);
            }
            previous = corner;
        }
        crossings.sort_by(f64::total_cmp);
        for inside in crossings.chunks_exact(2) {
            let (from, to) = (inside[0].max(0.0), inside[1].min(PIXELS as f64));
            for (column, share) in covered.iter_mut().enumerate().skip(from as usize).take((to - from) as usize + 2) {
                let overlap = (to.min(column as f64 + 1.0) - from.max(column as f64)).clamp(0.0, 1.0);
                *share += overlap as f32 / LINES as f32;
            }
        }
    }
    covered
}
