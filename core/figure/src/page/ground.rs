//! Pictures on paper: cut to the plot, and opaque where they are the ground.

use std::sync::Arc;

use crate::mark::Image;
use crate::rect::Rect;

/// Pixels per point to which a coarse ground is refined; renderers differ in how they enlarge pictures.
const FINE: f64 = 1.5;

/// The pixels of a picture that cover a plot, with their rectangle; none where it lies elsewhere.
pub(super) fn cropped(image: &Image, area: Rect, plot: Rect) -> Option<(Rect, Image)> {
    let pixels = [image.width, image.height];
    let mut part = [[0_usize; 2]; 2];
    let mut shown = area;
    for axis in 0..2 {
        let length = area.max[axis] - area.min[axis];
        let pixel = length / pixels[axis] as f64;
        if pixel <= 0.0 || area.max[axis] <= plot.min[axis] || area.min[axis] >= plot.max[axis] {
            return None;
        }
        let from = ((plot.min[axis] - area.min[axis]) / pixel + 1e-6).floor().max(0.0) as usize;
        let to = (((plot.max[axis] - area.min[axis]) / pixel - 1e-6).ceil() as usize).min(pixels[axis]);
        // One more at each side: enlarged pixels blend into their neighbors.
        part[axis] = [from.saturating_sub(1), (to + 1).min(pixels[axis])];
        shown.min[axis] = area.min[axis] + part[axis][0] as f64 * pixel;
        shown.max[axis] = area.min[axis] + part[axis][1] as f64 * pixel;
    }
    let [[left, right], [top, bottom]] = part;
    if [left, top] == [0, 0] && [right, bottom] == pixels {
        return Some((area, image.clone()));
    }
    let row = |y: usize| &image.rgba[4 * (y * image.width + left)..4 * (y * image.width + right)];
    let rgba: Vec<u8> = (top..bottom).flat_map(row).copied().collect();
    Some((shown, Image { width: right - left, height: bottom - top, rgba: Arc::from(rgba) }))
}

/// A translucent picture over a ground as an opaque one, refined where it is coarse on its rectangle.
pub(super) fn flattened(image: Image, ground: [u8; 3], area: Rect) -> Image {
    if image.rgba.chunks_exact(4).all(|pixel| pixel[3] == 255) {
        return image;
    }
    let fine = |pixels: usize, points: f64| pixels.max((FINE * points).ceil().min(4096.0) as usize);
    let (width, height) = (fine(image.width, area.width()), fine(image.height, area.height()));
    let columns: Vec<Blend> = (0..width).map(|x| Blend::new(x, width, image.width)).collect();
    let mut rgba = Vec::with_capacity(4 * width * height);
    for y in 0..height {
        let row = Blend::new(y, height, image.height);
        for column in &columns {
            let mut sum = [0.0_f32; 4];
            for (y, share) in row.parts() {
                for (x, part) in column.parts() {
                    let pixel = &image.rgba[4 * (y * image.width + x)..][..4];
                    let alpha = share * part * f32::from(pixel[3]) / 255.0;
                    (0..3).for_each(|i| sum[i] += alpha * f32::from(pixel[i]));
                    sum[3] += alpha;
                }
            }
            let over = |i: usize| (sum[i] + (1.0 - sum[3]) * f32::from(ground[i])).round() as u8;
            rgba.extend([over(0), over(1), over(2), 255]);
        }
    }
    Image { width, height, rgba: Arc::from(rgba) }
}

/// Two neighboring samples and the share of the second.
struct Blend {
    at: [usize; 2],
    share: f32,
}

impl Blend {
    fn new(index: usize, fine: usize, coarse: usize) -> Self {
        let place = (index as f64 + 0.5) * coarse as f64 / fine as f64 - 0.5;
        let place = place.clamp(0.0, coarse as f64 - 1.0);
        let first = place as usize;
        Self { at: [first, (first + 1).min(coarse - 1)], share: (place - first as f64) as f32 }
    }

    fn parts(&self) -> [(usize, f32); 2] {
        [(self.at[0], 1.0 - self.share), (self.at[1], self.share)]
    }
}
