//! Spectrum of a pixel of a spectral image.

use chromascope_figure::{Axis, InkRole, Mark, Panel, Rect, Shape, Tag};
use spectral_image::ImageQuantity;

/// Samples of a pixel over the wavelength, from 0.
pub fn panel(points: &[[f64; 2]], quantity: ImageQuantity, size: [f64; 2]) -> Panel {
    let finite = || points.iter().copied().filter(|point| point[1].is_finite());
    let ends = [points.first(), points.last()].map(|point| point.map(|point| point[0]));
    let [first, last] = [ends[0].unwrap_or(380.0), ends[1].unwrap_or(780.0)];
    let low = finite().map(|point| point[1]).fold(0.0, f64::min);
    let high = finite().map(|point| point[1]).fold(f64::MIN_POSITIVE, f64::max);
    let x = Axis::new("wavelength (nm)", [first, last.max(first + 1.0)]);
    let y = Axis::new("", [1.1 * low, 1.35 * high]);
    let mut panel = Panel::new("spectrum of the pixel", Rect::from_min_size([0.0; 2], size), x, y);
    let note = match quantity {
        ImageQuantity::Reflectance => "reflectance",
        ImageQuantity::Radiance => "radiance",
    };
    note.clone_into(&mut panel.note);
    let shape = Shape::Line { points: finite().collect(), closed: false };
    panel.marks.push(Mark::new(Tag::default(), "spectrum of the pixel", shape).with_stroke(InkRole::Text, 1.5));
    panel
}
