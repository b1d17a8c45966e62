//! A kind of figure: the same for pane, command line and report.

use chromascope_figure::{AxisRanges, Figure, FigureRoom, Shape};

use super::look::{FigureLook, RenderMode};
use crate::export::Paper;
use crate::scene::Scene;

/// Draws a figure; none where there is nothing to draw.
type Draw = fn(&Scene<'_>, &FigureLook, FigureRoom) -> Option<Figure>;

#[derive(Debug)]
pub struct FigureKind {
    /// Its word on the command line.
    pub key: &'static str,
    /// What it shows, for the command line's help.
    pub help: &'static str,
    pub needs: Need,
    /// True if it shows figures of merit: where no temperature is chosen, those of the same one as in `compare`.
    pub is_of_metrics: bool,
    /// True if it is part of a report on a comparison.
    pub is_reported: bool,
    /// The most cameras that it shows.
    pub cameras: usize,
    /// Places on the axes of numbers that are written there.
    scales: [fn(f64) -> f64; 2],
    draw: Draw,
}

/// Answer that a figure takes as a value, since making it takes long, or since it is of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// All that it shows is asked of the scene.
    Nothing,
    /// Pictures of a mesh or spectral image, in this arrangement where none is chosen.
    Pictures(RenderMode),
    Correction,
    /// A ranking by recorded raw values.
    Recorded,
    Curves,
    Measured,
}

impl FigureKind {
    pub(super) const fn new(key: &'static str, help: &'static str, draw: Draw) -> Self {
        let scales: [fn(f64) -> f64; 2] = [|number| number; 2];
        let (needs, cameras) = (Need::Nothing, usize::MAX);
        Self { key, help, needs, is_of_metrics: false, is_reported: false, cameras, scales, draw }
    }

    pub(super) const fn needing(self, needs: Need) -> Self {
        Self { needs, ..self }
    }

    /// With the places on both axes of numbers that are written there.
    pub(super) const fn with_scales(self, scales: [fn(f64) -> f64; 2]) -> Self {
        Self { scales, ..self }
    }

    pub(super) const fn of_metrics(self) -> Self {
        Self { is_of_metrics: true, ..self }
    }

    pub(super) const fn of_cameras(self, cameras: usize) -> Self {
        Self { cameras, ..self }
    }

    pub(super) const fn in_report(self) -> Self {
        Self { is_reported: true, ..self }
    }

    /// The figure with its numbers in a room; none while there is nothing to draw.
    pub fn figure(&self, scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
        let figure = self.zoomed(scene, look, room)?;
        let own = figure.panels.iter().find(|panel| panel.framed).map(|panel| [panel.x.range, panel.y.range]);
        let Some(own) = own.filter(|_| room.limits.iter().any(|[from, to]| from != to)) else { return Some(figure) };
        // The diagram is drawn anew for its ranges, so that its labels find their places.
        let ranges = [0, 1].map(|axis| match room.limits[axis] {
            [from, to] if from == to => own[axis],
            limits => limits.map(self.scales[axis]),
        });
        let mut look = look.clone();
        look.diagram.zoomed = Some(ranges);
        let mut figure = self.zoomed(scene, &look, FigureRoom { ranges: AxisRanges::Screen, ..room })?;
        let mut plots = figure.panels.iter_mut().filter(|panel| panel.framed && !panel.equal_aspect);
        if let Some(first) = plots.next().filter(|first| [first.x.range, first.y.range] == own) {
            [first.x.range, first.y.range] = ranges;
        }
        // Plots below it share its horizontal axis, and the one where that is written.
        let below = figure.panels.iter_mut().filter(|panel| !panel.equal_aspect && panel.x.range == own[0]);
        below.for_each(|panel| panel.x.range = ranges[0]);
        Some(figure)
    }

    /// The figure in the ranges that the window's plot is zoomed to.
    fn zoomed(&self, scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
        let mut figure = (self.draw)(scene, look, room)?;
        figure.caption += &full_names(scene, &figure);
        let zoom = look.zoom.as_ref().filter(|(title, _)| room.ranges == AxisRanges::Screen && *title == figure.title);
        if let Some(((_, [x, y]), panel)) = zoom.zip(figure.panels.first_mut()) {
            (panel.x.range, panel.y.range) = (*x, *y);
        }
        Some(figure)
    }

    /// The figure laid out on a paper, as it is printed and saved.
    pub fn on_paper(&self, paper: &Paper, scene: &Scene<'_>, look: &FigureLook) -> Option<Figure> {
        paper.laid_out(|room| self.figure(scene, look, room))
    }
}

/// Kelvins of a number along an axis of temperatures: below 1000 it is of thousands, as the axes of loci are written.
pub(super) fn kelvins(number: f64) -> f64 {
    (if number < 1e3 { 1e3 * number } else { number }).max(1.0)
}

/// Names of sensors that a figure shows in short and no legend in full, in a sentence.
fn full_names(scene: &Scene<'_>, figure: &Figure) -> String {
    let marks = figure.panels.iter().flat_map(|panel| &panel.marks).filter(|_| figure.legend.is_empty());
    let texts = marks.filter_map(|mark| if let Shape::Text { text, .. } = &mark.shape { Some(text) } else { None });
    // In little room a name may have been cut in its middle.
    let is_of = |text: &str, name: &str| match text.split_once('…') {
        Some((head, tail)) => name.starts_with(head) && name.ends_with(tail),
        None => text == name,
    };
    let short = scene.visible_sources().into_iter().filter_map(|of| {
        let written = texts
            .clone()
            .find(|text| **text != of.label && [&of.short, &of.label].iter().any(|name| is_of(text, name)));
        Some(format!("{}: {}", written?, of.label))
    });
    let names: Vec<String> = short.collect();
    if names.is_empty() { String::new() } else { format!(" {}.", names.join("; ")) }
}
