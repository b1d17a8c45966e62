//! Drawing operations that each file format provides.

use crate::ink::Ink;
use crate::mark::{Anchor, Image, Stroke, TextSize};
use crate::rect::Rect;

/// A document being written. Lengths are the figure's points, y downward.
pub(crate) trait Canvas {
    /// Begins a named group; with a rectangle, its contents show inside that only.
    fn begin(&mut self, name: &str, clip: Option<Rect>);
    /// Ends the group begun last.
    fn end(&mut self);
    /// Draws a path through at least two points.
    fn path(&mut self, points: &[[f64; 2]], closed: bool, stroke: Option<Stroke>, fill: Option<Ink>);
    /// Draws a rectangle.
    fn rect(&mut self, area: Rect, stroke: Option<Stroke>, fill: Option<Ink>);
    /// Draws a disk.
    fn disk(&mut self, center: [f64; 2], radius: f64, stroke: Option<Stroke>, fill: Option<Ink>);
    /// Draws a line of text.
    fn text(&mut self, label: &TextLine<'_>);
    /// Draws a picture over a rectangle.
    fn image(&mut self, area: Rect, image: &Image);
}

/// A line of text with its place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TextLine<'a> {
    /// Its place.
    pub(crate) at: [f64; 2],
    /// The text.
    pub(crate) text: &'a str,
    /// Point of the text that lies on the place.
    pub(crate) anchor: Anchor,
    /// Size and face.
    pub(crate) size: TextSize,
    /// Color.
    pub(crate) ink: Ink,
    /// Color of the halo beneath.
    pub(crate) halo: Option<Ink>,
    /// True if the text runs upward.
    pub(crate) upward: bool,
}

impl<'a> TextLine<'a> {
    /// Width of a halo's stroke, half of which shows on each side.
    pub(crate) const HALO: f64 = 4.0;

    /// Text without a halo, running to the right.
    pub(crate) fn new(at: [f64; 2], text: &'a str, anchor: Anchor, size: TextSize, ink: Ink) -> Self {
        Self { at, text, anchor, size, ink, halo: None, upward: false }
    }

    /// Distance from the place down to the baseline. The center is that of capital letters and digits.
    pub(crate) fn baseline(&self) -> f64 {
        let (top, middle, bottom) = (0.80, 0.36, -0.22);
        let vertical = self.anchor.1;
        let share = if vertical < 0.5 {
            top + (middle - top) * 2.0 * vertical
        } else {
            middle + (bottom - middle) * (2.0 * vertical - 1.0)
        };
        share * f64::from(self.size.points())
    }
}
