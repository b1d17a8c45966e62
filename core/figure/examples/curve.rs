//! Writes a figure with one curve as SVG to standard output.
#![allow(clippy::disallowed_methods, reason = "an example writes its result")]

use chromascope_figure::{Axis, Figure, Image, InkRole, Mark, PageStyle, Palette, Panel, Rect, Shape, Tag, svg};
use std::io::Write as _;

/// Black on white.
struct Print;

impl Palette for Print {
    fn rgb(&self, role: InkRole) -> [u8; 3] {
        if role == InkRole::Plot { [255; 3] } else { [0; 3] }
    }
}

fn main() -> std::io::Result<()> {
    let area = Rect::from_min_size([50.0, 20.0], [320.0, 200.0]);
    let mut panel = Panel::new("sine", area, Axis::new("phase (rad)", [0.0, 6.3]), Axis::new("amplitude", [-1.0, 1.0]));
    let points = (0..=126).map(|i| f64::from(i) / 20.0).map(|x| [x, x.sin()]).collect();
    let line = Shape::Line { points, closed: false };
    panel.marks.push(Mark::new(Tag(0), "sine", line).with_stroke(InkRole::Text, 1.5));
    let mut figure = Figure::new("A sine", [400.0, 280.0]);
    figure.panels.push(panel);
    let no_image = |_: &Image| None;
    let style = svg::SvgStyle { font_family: "sans-serif", mono_family: "monospace", encode: &no_image };
    std::io::stdout().write_all(svg::write(&figure, &Print, &style, &PageStyle::default()).as_bytes())
}
