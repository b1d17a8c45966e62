//! Curves of a file, as interpreted.

mod drawn;
pub mod import_selection;

use std::sync::Arc;

use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_figure::{
    Axis, Cell, Column, Figure, FigureRoom, Ink, InkRole, Label, Labels, LegendEntry, LegendPlace, Mark, Numbers,
    Panel, Place, Rect, Shape, Stroke, Table, Tag, TextSize, finite_runs,
};

pub use drawn::{Curve, Curves, DRAWN};
pub use import_selection::{ImportItem, ImportSelection, places};

use super::band;
use super::kind::{FigureKind, Need};
use super::look::FigureLook;
use crate::format::{capitalized, number};
use crate::plot_item::PickIndex;
use crate::scene::Scene;

const SIZE: [f64; 2] = [640.0, 360.0];
/// Room above a peak for the letter of a channel.
const LETTER: f64 = 17.0;
/// Maximum number of curves with legend entries of their own.
const NAMED: usize = 12;
/// Maximum number of curves that a caption names.
const LISTED: usize = 40;

/// The panel for an area of the given size. `hovered` is the index in the file of the hovered curve.
pub fn panel(curves: &Curves, size: [f64; 2], hovered: Option<usize>) -> Panel {
    let x = Axis::new("wavelength (nm)", curves.range_nm());
    let [low, high] = curves.span();
    let low = low.min(0.0);
    let clipped = curves.beyond().is_some();
    let kept = |curve: &Curve| {
        let mut points = curve.points.clone();
        if clipped {
            // Parts of curves far beyond the plot are not drawn; a note says so.
            points.iter_mut().filter(|[_, y]| *y < low || *y > high).for_each(|point| point[1] = f64::NAN);
        }
        points
    };
    // Margin above the curves for labels, none below: near zero there are curves everywhere.
    let below = if low < 0.0 { 0.05 * (high - low) } else { 0.0 };
    let range = [low - below, round_above(high).filter(|nice| *nice < 1.4 * high).unwrap_or(high).max(low + 1e-12)];
    let y = Axis::new(curves.quantity.clone(), range);
    let mut panel = Panel::new("curves of the file", Rect::from_min_size([0.0, 0.0], size), x, y);
    panel.note = curves.beyond().map_or_else(|| curves.note.clone(), |beyond| format!("{}; {beyond}", curves.note));
    // As if nothing were hovered: the axis holds still.
    let all = curves.drawn.iter().flat_map(|curve| marks(curve, kept(curve), false, curves.drawn.len()));
    panel.marks.extend(all);
    let mut panel = panel.with_headroom(if curves.drawn.iter().any(|of| of.channel.is_some()) { LETTER } else { 3.0 });
    panel.marks.clear();
    let [first, last] = curves.range_nm();
    if first < FIRST_NM || last > LAST_NM {
        panel.marks.push(visible(panel.y.range));
    }
    panel.marks.push(zero(curves.range_nm()));
    let count = curves.drawn.len();
    let within = |at: &&([f64; 2], f64)| !clipped || (low..=high).contains(&at.0[1]);
    panel.marks.extend(curves.drawn.iter().filter_map(|curve| {
        let points: Vec<_> = curve.band.0.iter().filter(within).copied().collect();
        band::mark(&curve.name, &points, ink(curve, count, false))
    }));
    let last = curves.drawn.iter().filter(|curve| Some(curve.place) == hovered);
    for curve in curves.drawn.iter().filter(|curve| Some(curve.place) != hovered).chain(last) {
        let on = Some(curve.place) == hovered;
        panel.marks.extend(marks(curve, kept(curve), on, curves.drawn.len()));
    }
    let mut labels = Labels::new(&panel);
    for curve in &curves.drawn {
        // The letter of a channel, where color alone would not name it.
        let Some(channel) = curve.channel else { continue };
        let finite = curve.points.iter().filter(|p| p[1].is_finite() && (!clipped || (low..=high).contains(&p[1])));
        let Some(at) = finite.copied().max_by(|a, b| a[1].total_cmp(&b[1])) else { continue };
        let places = Place::around(at, [1.0, 0.3], 7.0);
        let letter = Label::new(["R", "G", "B"][channel.min(2)], InkRole::Text, places);
        labels.place(&Label { tag: tag(curve.place), size: TextSize::Body, starts: vec![at], ..letter });
    }
    panel.marks.extend(labels.into_marks());
    panel
}

/// The next of 1, 2, 5, 10, … at or above a value, so that there is a tick above it.
fn round_above(value: f64) -> Option<f64> {
    let power = 10_f64.powf(value.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|factor| factor * power).find(|nice| nice.is_finite() && *nice >= value)
}

/// Tag of a curve in a panel. The first tag has no item.
fn tag(place: usize) -> Tag {
    Tag(u32::try_from(place).unwrap_or(u32::MAX - 1) + 1)
}

/// The place in the file of a curve that was hit.
pub fn place(tag: Tag) -> Option<usize> {
    tag.0.checked_sub(1).map(|place| place as usize)
}

fn marks(curve: &Curve, points: Vec<[f64; 2]>, on: bool, count: usize) -> Vec<Mark> {
    let tag = tag(curve.place);
    let ink = ink(curve, count, on);
    let width = if on {
        4.0
    } else if count > 20 {
        1.0
    } else {
        2.0
    };
    let alone: Vec<[f64; 2]> = finite_runs(&points).filter(|run| run.len() == 1).map(|run| run[0]).collect();
    let line = Mark::new(tag, &curve.name, Shape::Line { points, closed: false }).with_stroke(ink, width);
    let mut marks = vec![if on { line.with_halo(Ink::new(InkRole::Plot)) } else { line }];
    if !alone.is_empty() {
        // A sample between two gaps has no line.
        let marker = chromascope_figure::Marker::Dot;
        marks.push(Mark::new(tag, &curve.name, Shape::Points { points: alone, marker, radius: 3.0 }).with_fill(ink));
    }
    marks
}

/// Red, green and blue for a camera; else one after the other, paler where there are many.
fn ink(curve: &Curve, count: usize, on: bool) -> Ink {
    let slot = match curve.channel {
        Some(channel) => [6, 2, 1][channel.min(2)],
        None => (5 + curve.order) % 8,
    };
    let ink = Ink::new(InkRole::Sensor(u8::try_from(slot).unwrap_or(0)));
    if count > 20 && !on { ink.faded(0.6) } else { ink }
}

/// Band of visible wavelengths.
fn visible(range: [f64; 2]) -> Mark {
    let shape = Shape::Rect { min: [FIRST_NM, range[0]], max: [LAST_NM, range[1]] };
    let name = format!("visible range, {FIRST_NM:.0} to {LAST_NM:.0} nm");
    Mark::new(PickIndex::NONE, name, shape).with_fill(Ink::new(InkRole::Text).faded(0.06))
}

fn zero(range: [f64; 2]) -> Mark {
    let points = vec![[range[0], 0.0], [range[1], 0.0]];
    Mark::new(PickIndex::NONE, "zero", Shape::Line { points, closed: false }).with_stroke(InkRole::Weak, 1.0)
}

/// Values of a curve near a wavelength: lines of text.
pub fn describe(curves: &Curves, place: usize, nm: f64) -> Vec<String> {
    let Some(curve) = curves.drawn.iter().find(|curve| curve.place == place) else { return Vec::new() };
    let there = curve.points.iter().filter(|point| point[1].is_finite());
    let nearest = there.min_by(|a, b| (a[0] - nm).abs().total_cmp(&(b[0] - nm).abs()));
    let unit = curves.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
    let mut lines = vec![curve.name.clone()];
    lines.extend(nearest.map(|[nm, value]| format!("{} nm: {}{unit}", number(*nm), number(*value))));
    lines
}

pub static KIND: FigureKind = FigureKind::new("curves", "Curves of a file", figure).needing(Need::Curves);

fn figure(_: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let curves = Curves::of(look.curves.as_ref()?, usize::MAX).ok()?;
    let mut drawn = curves.clone();
    drawn.cut(DRAWN);
    let size = room.size(SIZE, 0.0);
    let mut figure = Figure::new(title(&curves), size);
    let mut panel = panel(&drawn, size, None);
    panel.name.clone_from(&curves.title);
    // No band of visible wavelengths on paper, which no caption explains.
    panel.marks.retain(|mark| !matches!(mark.shape, Shape::Rect { .. }));
    figure.panels.push(panel);
    // Channels have their letters at the curves.
    let has_letters = drawn.drawn.iter().all(|curve| curve.channel.is_some());
    if (2..=NAMED).contains(&drawn.drawn.len()) && !has_letters {
        let entry = |curve: &Curve| LegendEntry {
            name: curve.name.clone(),
            stroke: Some(Stroke::solid(ink(curve, drawn.drawn.len(), false), 2.0)),
            marker: None,
            fill: None,
        };
        figure.legend = drawn.drawn.iter().map(entry).collect();
        figure.legend_place = LegendPlace::Outside;
    }
    let band = curves.band_words().map_or_else(String::new, |words| format!(" {}.", capitalized(&words)));
    let named = if drawn.drawn.len() > NAMED { names(&curves.drawn) } else { String::new() };
    figure.caption = format!("{}: {}.{named}{band}", curves.title, curves.quantity);
    figure.table = numbers(if room.numbers == Numbers::Visible { &drawn } else { &curves });
    Some(figure)
}

/// Names of more curves than a legend tells apart by color, in a sentence.
fn names(curves: &[Curve]) -> String {
    let names: Vec<&str> = curves.iter().take(LISTED).map(|curve| curve.name.as_str()).collect();
    let more = curves.len() - names.len();
    let more = if more > 0 { format!(", and {more} more, which the numbers name") } else { String::new() };
    format!(" In order of the file, colors recurring: {}{more}.", names.join(", "))
}

pub fn title(curves: &Curves) -> String {
    format!("Curves of {}", curves.title)
}

/// The values at the wavelengths of the file; nothing where a curve has none.
pub fn numbers(curves: &Curves) -> Table {
    let column = |curve: &Curve| match &curves.unit {
        Some(unit) => Column::in_unit(&curve.name, unit),
        None => curve.name.as_str().into(),
    };
    let wavelength = Column::quantity("wavelength_nm", "wavelength", "nm");
    let mut table = Table::new(std::iter::once(wavelength).chain(curves.drawn.iter().map(column)));
    let mut all: Vec<f64> = curves.drawn.iter().flat_map(|curve| curve.points.iter().map(|point| point[0])).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    let mut next = vec![0_usize; curves.drawn.len()];
    for nm in all {
        let cells = curves.drawn.iter().zip(&mut next).map(|(curve, next)| {
            let mut value = None;
            // A gap lies between two samples, at a wavelength that may be another's.
            while let Some([at, v]) = curve.points.get(*next).filter(|point| point[0] <= nm) {
                if *at == nm && v.is_finite() {
                    value = Some(*v);
                }
                *next += 1;
            }
            Cell::from(value)
        });
        let row: Vec<Cell> = std::iter::once(Cell::from(nm)).chain(cells).collect();
        if row.iter().skip(1).any(|cell| *cell != Cell::Empty) {
            table.push(row);
        }
    }
    table
}

/// Maximum total number of points drawn on screen.
const POINTS: usize = 80_000;

#[derive(Clone, Debug)]
pub struct CurveCache {
    of: ImportSelection,
    curves: Result<Arc<Pair>, String>,
}

/// Curves, and the same with no more points than can be seen.
#[derive(Debug)]
struct Pair {
    all: Curves,
    seen: Curves,
}

impl CurveCache {
    /// The curves of the selected item: the cached ones, if still valid.
    pub fn of(shown: &ImportSelection, before: Option<Self>) -> Self {
        if let Some(before) = before.filter(|before| before.of.is_same(shown)) {
            return before;
        }
        let curves = Curves::of(shown, DRAWN).map(|all| {
            let most = (POINTS / all.drawn.len().max(1)).clamp(64, 4096);
            let mut seen = all.clone();
            seen.drawn.iter_mut().for_each(|curve| curve.points = drawn::thinned(&curve.points, most));
            Arc::new(Pair { all, seen })
        });
        Self { of: shown.clone(), curves }
    }

    /// The curves with all their points; or why there are none.
    pub fn all(&self) -> Result<&Curves, &str> {
        self.curves.as_ref().map(|pair| &pair.all).map_err(String::as_str)
    }

    /// The curves with the points that can be seen.
    pub fn seen(&self) -> Option<&Curves> {
        self.curves.as_ref().ok().map(|pair| &pair.seen)
    }
}
