//! A figure's page as pixels, made in the background as its PNG is.

use std::collections::HashSet;
use std::sync::Arc;

use chromascope_core::colorimetry::Xyz;
use chromascope_core::colorimetry::lab::lab_from_xyz;
use chromascope_core::colorimetry::rgb::{srgb_from_xyz, srgb_inverse_transfer, srgb_white};
use chromascope_figure::{Figure, Image, InkRole, Mark, Page, Palette as _, Panel, Shape, TextSize, Ticks};
use glam::DVec3;

use super::{ExportError, Paper, png, svg};
use crate::jobs::Job;
use crate::palette::Colors;
use crate::results::Results;

#[derive(Clone)]
pub struct PageJob {
    pub figure: Arc<Figure>,
    pub paper: Paper,
    /// Pixels per point on paper.
    pub scale: f32,
}

impl PartialEq for PageJob {
    fn eq(&self, other: &Self) -> bool {
        (self.scale, self.paper) == (other.scale, other.paper)
            && (Arc::ptr_eq(&self.figure, &other.figure) || self.figure == other.figure)
    }
}

impl Job for PageJob {
    type Answer = Result<Image, ExportError>;
    const NAME: &'static str = "page";

    fn run(&self, _: &Results) -> Arc<Self::Answer> {
        let picture = png(&svg(&self.figure, &self.paper.colors(), self.paper), self.scale);
        Arc::new(picture.map(|picture| {
            let [width, height] = [picture.width(), picture.height()].map(|side| side as usize);
            Image { width, height, rgba: Arc::from(picture.into_raw()) }
        }))
    }
}

/// Measures of a figure on paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageFacts {
    pub size_pt: [f64; 2],
    /// Smallest text in points; `None` without text.
    pub smallest_text_pt: Option<f64>,
    /// Thinnest line of a mark in points; `None` without lines.
    pub thinnest_line_pt: Option<f64>,
    /// Least difference in lightness L* of two inks of the legend; `None` for fewer than two.
    pub lightness_apart: Option<f64>,
    pub has_legend: bool,
    pub has_titles: bool,
    pub has_plot: bool,
}

impl PageFacts {
    /// Least difference in L* that lines and markers are told apart by.
    pub const TOLD_APART: f64 = 8.0;

    pub fn of(figure: &Figure, paper: &Paper) -> Self {
        let style = paper.page_style();
        let page = Page::new(figure, &style);
        let scale = page.scale(&style);
        let marks = || figure.panels.iter().flat_map(|panel| &panel.marks);
        let texts = marks().filter_map(|mark| match &mark.shape {
            Shape::Text { size, .. } => Some(f64::from(size.points())),
            _ => None,
        });
        let small = f64::from(TextSize::Small.points());
        let has_ticks = |panel: &Panel| [&panel.x, &panel.y].iter().any(|axis| axis.ticks != Ticks::None);
        let notes = figure.panels.iter().filter(|panel| !panel.note.is_empty()).map(|_| small);
        let ticks = figure.panels.iter().filter(|panel| has_ticks(panel)).map(|_| small);
        let caption = (!figure.caption.is_empty()).then_some(small);
        let legend = (!figure.legend.is_empty()).then_some(small);
        let texts = texts.chain(notes).chain(ticks).chain(caption).chain(legend);
        let lines = marks().filter_map(|mark: &Mark| Some(mark.stroke?.width)).filter(|width| *width > 0.0);
        Self {
            size_pt: [page.area.width(), page.area.height()].map(|side| side * scale),
            smallest_text_pt: texts.reduce(f64::min).map(|points| points * scale),
            thinnest_line_pt: lines.reduce(f64::min).map(|points| points * scale * paper.line_scale),
            lightness_apart: lightness_apart(figure, &paper.colors()),
            has_legend: !figure.legend.is_empty(),
            has_plot: figure.panels.iter().any(|panel| panel.framed),
            has_titles: figure.panels.iter().any(|panel| !panel.x.label.is_empty() || !panel.y.label.is_empty()),
        }
    }

    pub fn size_mm(&self) -> [f64; 2] {
        self.size_pt.map(|points| points / 72.0 * 25.4)
    }
}

/// Least difference in L* between the inks of a legend.
fn lightness_apart(figure: &Figure, colors: &Colors) -> Option<f64> {
    let inks = figure.legend.iter().filter_map(|entry| Some(entry.stroke.map(|line| line.ink).or(entry.fill)?.role));
    let roles: HashSet<InkRole> = inks.filter(|role| matches!(role, InkRole::Sensor(_))).collect();
    let mut lightness: Vec<f64> = roles.iter().map(|role| lightness_of(colors.rgb(*role))).collect();
    lightness.sort_by(f64::total_cmp);
    lightness.windows(2).map(|pair| pair[1] - pair[0]).reduce(f64::min)
}

/// L* of an sRGB color.
fn lightness_of(rgb: [u8; 3]) -> f64 {
    let linear = rgb.map(|channel| srgb_inverse_transfer(f64::from(channel) / 255.0));
    let [x, y, z] = (srgb_from_xyz().inverse() * DVec3::from_array(linear)).to_array();
    lab_from_xyz(Xyz::new(x, y, z), srgb_white()).map_or(0.0, |lab| lab.l)
}
