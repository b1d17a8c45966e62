//! A kind of figure: the same for pane, command line and report.

use chromascope_figure::{AxisRanges, Figure, FigureRoom};

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
        Self { key, help, needs: Need::Nothing, is_of_metrics: false, draw }
    }

    pub(super) const fn needing(self, needs: Need) -> Self {
        Self { needs, ..self }
    }

    pub(super) const fn of_metrics(self) -> Self {
        Self { is_of_metrics: true, ..self }
    }

    /// The figure with its numbers in a room; none while there is nothing to draw.
    pub fn figure(&self, scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
        let mut figure = (self.draw)(scene, look, room)?;
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
