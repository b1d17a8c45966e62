//! A card to share: a pane's figure, the swatches and the conditions in one picture.

use chromascope_figure::{Anchor, Figure, Ink, InkRole, Mark, Panel, Rect, TextSize, wrapped};
use image::{RgbaImage, imageops};

use super::{ExportError, Paper, png, png_within, svg};
use crate::palette::Colors;

/// Size of a card in pixels.
pub const SIZE: [u32; 2] = [1600, 900];
/// Pixels per point: a card is looked at small.
const SCALE: f64 = 1.6;
/// Size of a card in points.
const POINTS: [f64; 2] = [1000.0, 562.5];
/// Empty space along its sides and between its parts.
const MARGIN: f64 = 20.0;
/// Empty space that a written figure has around it.
const EDGE: f64 = 8.0;
/// Height of the line of the title.
const TITLE: f64 = 28.0;
/// Width at its right that is the program's name.
const SIGNED: f64 = 110.0;
/// Height of a line of the caption.
const LINE: f64 = 16.0;
/// Width of the figure beside the swatches.
const FIGURE: f64 = 580.0;

pub struct Card {
    /// Figure; its title and caption are those of the card.
    pub figure: Figure,
    pub swatches: Option<Figure>,
}

/// Size in points that a figure fills a card with, beside swatches.
pub const fn figure_size() -> [f64; 2] {
    [FIGURE - 2.0 * EDGE, 430.0]
}

/// Size in points that swatches fill their part of a card with.
pub const fn swatches_size() -> [f64; 2] {
    [POINTS[0] - FIGURE - 3.0 * MARGIN - 2.0 * EDGE, 430.0]
}

impl Card {
    /// The picture, of [`SIZE`].
    pub fn picture(&self) -> Result<RgbaImage, ExportError> {
        let inner = POINTS[0] - 2.0 * MARGIN;
        let lines = wrapped(&self.figure.caption, TextSize::Small, inner);
        let title = wrapped(&self.figure.title, TextSize::Heading, inner - SIGNED);
        let top = MARGIN + TITLE * title.len() as f64;
        let bottom = POINTS[1] - MARGIN - LINE * lines.len() as f64;
        let mut picture = Self::page(&title, &lines, bottom)?;
        let height = (bottom - 0.5 * MARGIN - top).max(2.0 * TITLE);
        let width = if self.swatches.is_some() { FIGURE } else { inner };
        place(&mut picture, &self.figure, [MARGIN, top], [width, height])?;
        if let Some(swatches) = &self.swatches {
            let left = MARGIN + FIGURE + MARGIN;
            place(&mut picture, swatches, [left, top], [POINTS[0] - MARGIN - left, height])?;
        }
        Ok(picture)
    }

    /// The ground with title and caption.
    fn page(title: &[String], caption: &[String], bottom: f64) -> Result<RgbaImage, ExportError> {
        let size = POINTS.map(|side| side - 2.0 * EDGE);
        let mut panel = Panel::board("card", Rect::from_min_size([0.0; 2], size), Ink::new(InkRole::Plot));
        let mut write = |[x, y]: [f64; 2], text: &str, anchor, size, role: InkRole| {
            panel.marks.push(Mark::text(text, [x - EDGE, y - EDGE], anchor, size, role));
        };
        for (index, line) in title.iter().enumerate() {
            let at = [MARGIN, MARGIN + TITLE * index as f64];
            write(at, line, Anchor::LEFT_TOP, TextSize::Heading, InkRole::Text);
        }
        let right = [POINTS[0] - MARGIN, MARGIN];
        write(right, "Chromascope", Anchor::RIGHT_TOP, TextSize::Body, InkRole::Weak);
        for (index, line) in caption.iter().enumerate() {
            let at = [MARGIN, bottom + LINE * index as f64];
            write(at, line, Anchor::LEFT_TOP, TextSize::Small, InkRole::Text);
        }
        let mut whole = Figure::new("card", size);
        whole.panels.push(panel);
        png(&svg(&whole, &Colors::LIGHT, Paper::default()), SCALE as f32)
    }
}

/// Draws a figure without its caption at the upper left of a place, as large as fits.
fn place(picture: &mut RgbaImage, figure: &Figure, at: [f64; 2], room: [f64; 2]) -> Result<(), ExportError> {
    let bare = Figure { caption: String::new(), ..figure.clone() };
    let drawn = png_within(&svg(&bare, &Colors::LIGHT, Paper::default()), room.map(|side| side * SCALE))?;
    let [x, y] = at.map(|at| (at * SCALE).round() as i64);
    imageops::overlay(picture, &drawn, x, y);
    Ok(())
}
