//! Dots with whiskers on one axis, a row for each name.

use chromascope_figure::{
    Anchor, Axis, Dash, Ink, InkRole, Mark, Marker, Panel, Projection, Rect, Shape, Tag, TextSize, Ticks, auto_ticks,
    text_width,
};

/// Height of a row in points.
pub(super) const ROW: f64 = 15.0;
/// Least width of the plot in points.
const LEAST: f64 = 80.0;
const GAP: f64 = 8.0;
/// Reach of a whisker's crossbar above and below it, as a share of a row.
const END: f64 = 0.2;

pub(super) struct Row {
    /// Text at the left, right-aligned.
    pub(super) name: String,
    /// Text at the right.
    pub(super) behind: String,
    pub(super) ink: Ink,
    pub(super) marker: Marker,
    pub(super) is_filled: bool,
    /// Value and half the length of its whisker; none for a row of words.
    pub(super) value: Option<[f64; 2]>,
}

/// Names with what stands behind them, and the plot over them. The axis' range is widened to hold the whiskers.
pub(super) fn panels(rows: &[Row], title: &str, width: f64, with_zero: bool) -> [Panel; 2] {
    let widest =
        |words: fn(&Row) -> &str| rows.iter().map(|row| text_width(words(row), TextSize::Small)).fold(0.0, f64::max);
    let [left, right] = [widest(|row| &row.name), widest(|row| &row.behind)].map(|side| side + 2.0 * GAP);
    let ends = || rows.iter().filter_map(|row| row.value).flat_map(|[value, reach]| [value - reach, value + reach]);
    let zero = if with_zero { 0.0 } else { f64::INFINITY };
    let (low, high) = (ends().fold(zero, f64::min), ends().fold(if with_zero { 0.0 } else { -zero }, f64::max));
    let pad = 0.05 * (high - low).max(1e-9);
    let range = [low - pad, high + pad];
    let across = (width - left - right).max(LEAST);
    // Twice as many as on screen: a narrow plot would have one number. None is moved inward, where another one belongs.
    let mut ticks = auto_ticks(range, 2.0 * across);
    let half = |label: &str| 0.5 * text_width(label, TextSize::Small) * (range[1] - range[0]) / across;
    ticks.retain(|tick| (tick.value - range[0]).min(range[1] - tick.value) >= half(&tick.label));
    let ticks = ticks.into_iter().map(|tick| (tick.value, tick.label)).collect();
    let x = Axis::new(title, range).with_ticks(Ticks::At(ticks));
    let count = rows.len() as f64;
    let size = [across, count * ROW + Projection::bottom(&x)];
    let whole = Rect::from_min_size([0.0; 2], [left + size[0] + right, size[1]]);
    let mut names = Panel::board("names", whole, Ink::new(InkRole::Plot));
    let area = Rect::from_min_size([left, 0.0], size);
    let mut plot = Panel::new(title, area, x, Axis::hidden([count, 0.0]));
    let segments =
        |segments, ink: Ink, width| Mark::new(Tag::default(), "", Shape::Segments { segments }).with_stroke(ink, width);
    if with_zero {
        plot.marks.push(segments(vec![[[0.0, 0.0], [0.0, count]]], InkRole::Weak.into(), 1.0).with_dash(Dash::Solid));
    }
    for (index, row) in rows.iter().enumerate() {
        let middle = index as f64 + 0.5;
        for (words, x, anchor) in
            [(&row.name, left - GAP, Anchor::RIGHT), (&row.behind, area.max[0] + GAP, Anchor::LEFT)]
        {
            names.marks.push(Mark::text(words, [x, ROW * middle], anchor, TextSize::Small, row.ink));
        }
        let Some([value, reach]) = row.value else { continue };
        if reach > 0.0 {
            let bar = |x: f64| [[x, middle - END], [x, middle + END]];
            let [from, to] = [value - reach, value + reach];
            plot.marks.push(segments(vec![[[from, middle], [to, middle]], bar(from), bar(to)], row.ink, 1.0));
        }
        let shape = Shape::Points { points: vec![[value, middle]], marker: row.marker, radius: 3.5 };
        let dot = Mark::new(Tag::default(), &row.name, shape).with_stroke(row.ink, 1.2);
        plot.marks.push(dot.with_fill(if row.is_filled { row.ink } else { InkRole::Plot.into() }));
    }
    [names, plot]
}
