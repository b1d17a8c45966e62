//! From data units to points.

use super::axis::{Axis, Tick, Ticks, proper};
use super::mark::TextSize;
use super::panel::Panel;
use super::rect::Rect;
use super::text::text_width;

/// Enlarges both ranges around their centers until one unit is as long on x as on y in a box of the given size.
/// Nothing inside the ranges is lost, their directions stay.
pub fn fit_equal(x: [f64; 2], y: [f64; 2], size: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let (x, y) = (proper(x), proper(y));
    let [width, height] = size.map(|side| if side.is_finite() { side.max(1.0) } else { 1.0 });
    let unit = ((x[1] - x[0]).abs() / width).max((y[1] - y[0]).abs() / height);
    let enlarge = |range: [f64; 2], side: f64| {
        let middle = 0.5 * (range[0] + range[1]);
        let half = 0.5 * unit * side * (range[1] - range[0]).signum();
        [middle - half, middle + half]
    };
    (enlarge(x, width), enlarge(y, height))
}

/// Area of a panel's plot in the figure, and the map from data units to points.
#[derive(Debug, Clone, PartialEq)]
pub struct Projection {
    /// The box of the plot, without tick labels, in points.
    pub plot: Rect,
    /// Values at the left and right ends.
    pub x: [f64; 2],
    /// Values at the bottom and top ends.
    pub y: [f64; 2],
    /// Ticks of x, ascending.
    pub x_ticks: Vec<Tick>,
    /// Ticks of y, ascending.
    pub y_ticks: Vec<Tick>,
}

impl Projection {
    /// Room for the tick labels of y unless they are wider, in points. The same in stacked panels, so that they line up.
    pub const LEFT: f64 = 44.0;
    /// Room for the tick labels of x, in points.
    pub const BOTTOM: f64 = 24.0;
    /// Room for the title of x below them, in points.
    pub const TITLE: f64 = 16.0;

    /// Room for the tick labels and the title of a horizontal axis, in points.
    pub fn bottom(x: &Axis) -> f64 {
        match x.ticks {
            Ticks::None => 0.0,
            _ if x.has_title_line() => Self::BOTTOM + Self::TITLE,
            _ => Self::BOTTOM,
        }
    }

    /// Lays a panel out for text drawn `text_scale` times as large as on screen.
    pub fn new(panel: &Panel, text_scale: f64) -> Self {
        let area = panel.area;
        let bottom = Self::bottom(&panel.x) * text_scale;
        let height = (area.height() - bottom).max(1.0);
        let (mut x, mut y) = (panel.x.proper_range(), panel.y.proper_range());
        let mut left = Self::left(panel, y, height, text_scale);
        if panel.equal_aspect {
            // The ticks' room depends on the range, which depends on the room: one repetition is enough for a label's width.
            for _ in 0..2 {
                let size = [(area.width() - left).max(1.0), height];
                (x, y) = fit_equal(panel.x.range, panel.y.range, size);
                left = Self::left(panel, y, height, text_scale);
            }
        }
        let width = (area.width() - left).max(1.0);
        let plot = Rect::from_min_size([area.min[0] + left, area.min[1]], [width, height]);
        let x_ticks = panel.x.ticks_over(x, width / text_scale);
        let y_ticks = panel.y.vertical_ticks_over(y, height / text_scale);
        Self { plot, x, y, x_ticks, y_ticks }
    }

    /// Room for the tick labels of a vertical axis of a height, in points.
    pub fn left(panel: &Panel, y: [f64; 2], height: f64, text_scale: f64) -> f64 {
        if panel.y.ticks == Ticks::None {
            return 0.0;
        }
        let ticks = panel.y.vertical_ticks_over(y, height / text_scale);
        let widest = ticks.iter().map(|tick| text_width(&tick.label, TextSize::Body)).fold(0.0, f64::max);
        text_scale * Self::LEFT.max(widest + 12.0)
    }

    /// The place of a point in the figure, in points.
    pub fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let u = (point[0] - self.x[0]) / (self.x[1] - self.x[0]);
        let v = (point[1] - self.y[0]) / (self.y[1] - self.y[0]);
        [self.plot.min[0] + u * self.plot.width(), self.plot.max[1] - v * self.plot.height()]
    }

    /// The point in data units at a place in the figure, in points.
    pub fn value(&self, at: [f64; 2]) -> [f64; 2] {
        let u = (at[0] - self.plot.min[0]) / self.plot.width();
        let v = (self.plot.max[1] - at[1]) / self.plot.height();
        [self.x[0] + u * (self.x[1] - self.x[0]), self.y[0] + v * (self.y[1] - self.y[0])]
    }
}
