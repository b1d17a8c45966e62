//! Pictures of the window without a display, a GPU or a driver: a CPU rasterizer for `egui_kittest`, and the
//! comparison of its pictures with those in `screenshots/`.
//!
//! ```text
//! Harness::builder().with_size([1280.0, 800.0]).renderer(Cpu::default()).build_eframe(…)
//! compare(&harness.render()?, Path::new("screenshots/main.png"))?
//! ```
//!
//! It does what egui's fragment shader does, in gamma space with premultiplied alpha and without dithering: color of
//! the vertices times bilinear texture, blended over what is there. Coverage and blending are in integers. This
//! crate is built without optimization, so whole runs of pixels are written at once, and two channels in one
//! multiplication.

#![allow(clippy::cast_possible_wrap, reason = "sides of pictures are far below 2^63")]

mod kept;

use std::collections::HashMap;

use egui::{
    Color32, ColorImage, ImageData, Rect, TextureFilter, TextureId, TextureOptions, TextureWrapMode, TexturesDelta,
    epaint::{Mesh, Primitive, Vertex},
};
use image::RgbaImage;

pub(crate) use kept::compare;

/// Fractional bits of a vertex position, in pixels.
const SUBPIXEL: f32 = 256.0;

/// Fractional bits of what is interpolated over a triangle.
const ONE: f64 = 65_536.0;

/// A [`egui_kittest::TestRenderer`] that needs nothing but a CPU. Paint callbacks are omitted.
#[derive(Default)]
pub(crate) struct Cpu {
    textures: HashMap<TextureId, (ColorImage, TextureOptions)>,
    /// Freed by the last frame, whose picture may still be requested.
    freed: Vec<TextureId>,
}

impl egui_kittest::TestRenderer for Cpu {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        for id in self.freed.drain(..) {
            self.textures.remove(&id);
        }
        for (id, parts) in delta.set.drain() {
            for part in parts {
                let ImageData::Color(image) = part.image;
                let Some([x, y]) = part.pos else {
                    let image = ColorImage::clone(&image);
                    self.textures.insert(id, (image, part.options));
                    continue;
                };
                if let Some((whole, _)) = self.textures.get_mut(&id) {
                    for (row, line) in image.pixels.chunks_exact(image.width()).enumerate() {
                        let start = (y + row) * whole.width() + x;
                        whole.pixels[start..start + line.len()].copy_from_slice(line);
                    }
                }
            }
        }
        self.freed.extend(delta.free.drain());
    }

    fn render(&mut self, ctx: &egui::Context, output: &egui::FullOutput) -> Result<RgbaImage, String> {
        let scale = output.pixels_per_point;
        let size = ctx.viewport_rect().size() * scale;
        let mut canvas = Canvas::new(size.x.round() as usize, size.y.round() as usize, scale);
        for clipped in ctx.tessellate(output.shapes.clone(), scale) {
            if let Primitive::Mesh(mesh) = clipped.primitive {
                let (texture, options) =
                    self.textures.get(&mesh.texture_id).ok_or_else(|| format!("no texture {:?}", mesh.texture_id))?;
                canvas.clip(clipped.clip_rect);
                canvas.mesh(&mesh, texture, *options);
            }
        }
        let [width, height] = canvas.image.size.map(|side| side as u32);
        let bytes = canvas.image.as_raw().to_vec();
        RgbaImage::from_raw(width, height, bytes).ok_or_else(|| "no such size".to_owned())
    }
}

struct Canvas {
    image: ColorImage,
    scale: f32,
    /// Clip rectangle in pixels: columns and rows, each from and up to.
    clip: [[i64; 2]; 2],
    /// A line of one color, to copy runs of it from.
    ink: (Color32, Vec<Color32>),
}

impl Canvas {
    fn new(width: usize, height: usize, scale: f32) -> Self {
        Self {
            image: ColorImage::new([width, height], vec![Color32::TRANSPARENT; width * height]),
            scale,
            clip: [[0; 2]; 2],
            ink: (Color32::TRANSPARENT, vec![Color32::TRANSPARENT; width]),
        }
    }

    fn clip(&mut self, rect: Rect) {
        let pixels = |from: f32, to: f32, side: usize| {
            let [from, to] = [from, to].map(|at| (at * self.scale).round() as i64);
            let from = from.clamp(0, side as i64);
            [from, to.clamp(from, side as i64)]
        };
        let [width, height] = self.image.size;
        self.clip = [pixels(rect.min.x, rect.max.x, width), pixels(rect.min.y, rect.max.y, height)];
    }

    fn mesh(&mut self, mesh: &Mesh, texture: &ColorImage, options: TextureOptions) {
        for corners in mesh.indices.chunks_exact(3) {
            let corners = [0, 1, 2].map(|at| mesh.vertices[corners[at] as usize]);
            self.triangle(corners, texture, options);
        }
    }

    fn triangle(&mut self, mut corners: [Vertex; 3], texture: &ColorImage, options: TextureOptions) {
        let mut at = corners.map(|corner| (corner.pos * self.scale * SUBPIXEL).round());
        if at.iter().any(|at| !at.is_finite()) {
            return;
        }
        let area = |at: [egui::Pos2; 3]| {
            let [a, b, c] = at.map(|at| [f64::from(at.x), f64::from(at.y)]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        if area(at) < 0.0 {
            corners.swap(1, 2);
            at.swap(1, 2);
        }
        if area(at) == 0.0 {
            return;
        }
        let edges = [0, 1, 2].map(|from| Edge::new(at[from], at[(from + 1) % 3]));
        let [top, bottom] =
            [f32::min, f32::max].map(|far| at.map(|at| at.y).into_iter().reduce(far).unwrap_or(0.0) / SUBPIXEL);
        let [columns, rows] = self.clip;
        let rows = rows[0].max(top as i64 - 1)..rows[1].min(bottom as i64 + 1);

        let paint = Paint::new(&corners, at, texture, options);
        for y in rows {
            let [mut from, mut to] = columns;
            for edge in &edges {
                edge.narrow(y, &mut from, &mut to);
            }
            if from < to {
                self.span(y, from, to, &paint);
            }
        }
    }

    fn span(&mut self, y: i64, from: i64, to: i64, paint: &Paint<'_>) {
        let start = y as usize * self.image.width();
        let run = start + from as usize..start + to as usize;
        let target = &mut self.image.pixels[run];
        match paint.flat {
            Some(color) if color.a() == 255 => {
                if self.ink.0 != color {
                    self.ink.0 = color;
                    self.ink.1[0] = color;
                    let mut done = 1;
                    while done < self.ink.1.len() {
                        let more = done.min(self.ink.1.len() - done);
                        self.ink.1.copy_within(..more, done);
                        done += more;
                    }
                }
                target.copy_from_slice(&self.ink.1[..(to - from) as usize]);
            }
            Some(Color32::TRANSPARENT) => {}
            Some(color) => {
                let color = packed(color);
                for pixel in target {
                    *pixel = over(color, *pixel);
                }
            }
            None => paint.blend(from, y, target),
        }
    }
}

/// One side of a triangle: `slope · x + …` is not negative inside.
struct Edge {
    from: [i64; 2],
    step: [i64; 2],
}

impl Edge {
    fn new(from: egui::Pos2, to: egui::Pos2) -> Self {
        // 2²⁰ pixels are beyond any screen, and keep the products below 2⁶³.
        let fixed = |at: f32| at.clamp(-268_435_456.0, 268_435_456.0) as i64;
        let [from, to] = [from, to].map(|at| [fixed(at.x), fixed(at.y)]);
        Self { from, step: [to[0] - from[0], to[1] - from[1]] }
    }

    /// Leaves of a row's columns those whose center is inside; on the edge, if it is a left or a top one.
    fn narrow(&self, y: i64, from: &mut i64, to: &mut i64) {
        let [dx, dy] = self.step;
        let belongs = dy < 0 || (dy == 0 && dx > 0);
        let at_zero = dx * (y * 256 + 128 - self.from[1]) - dy * (128 - self.from[0]) - i64::from(!belongs);
        let slope = -dy * 256;
        if slope > 0 {
            *from = (*from).max(-(at_zero.div_euclid(slope)));
        } else if slope < 0 {
            *to = (*to).min(at_zero.div_euclid(-slope) + 1);
        } else if at_zero < 0 {
            *to = *from;
        }
    }
}

/// Fill of a triangle: six quantities (r, g, b, a, texel column, texel row) that are linear in the position.
struct Paint<'a> {
    /// The one color, if it has only one.
    flat: Option<Color32>,
    texture: Texture<'a>,
    origin: [f64; 2],
    start: [f64; 6],
    across: [f64; 6],
    down: [f64; 6],
}

impl<'a> Paint<'a> {
    fn new(corners: &[Vertex; 3], at: [egui::Pos2; 3], texture: &'a ColorImage, options: TextureOptions) -> Self {
        let [width, height] = texture.size.map(|side| side as f64);
        let values = corners.map(|corner| {
            let [r, g, b, a] = corner.color.to_array().map(f64::from);
            let [u, v] = [f64::from(corner.uv.x), f64::from(corner.uv.y)];
            [r, g, b, a, u * width, v * height]
        });
        let at = at.map(|at| [at.x, at.y].map(|at| f64::from(at / SUBPIXEL)));
        let [[x1, y1], [x2, y2]] = [1, 2].map(|i| [at[i][0] - at[0][0], at[i][1] - at[0][1]]);
        let area = x1 * y2 - x2 * y1;
        let mut paint = Paint {
            flat: None,
            texture: Texture::new(texture, options),
            origin: [at[0][0] - 0.5, at[0][1] - 0.5],
            start: values[0],
            across: [0.0; 6],
            down: [0.0; 6],
        };
        for (i, start) in values[0].into_iter().enumerate() {
            let [one, two] = [1, 2].map(|corner| values[corner][i] - start);
            paint.across[i] = (one * y2 - two * y1) / area;
            paint.down[i] = (two * x1 - one * x2) / area;
        }
        let stretch = (paint.across[4].abs() + paint.down[4].abs()).max(paint.across[5].abs() + paint.down[5].abs());
        paint.texture.linear =
            TextureFilter::Linear == if stretch > 1.0 { options.minification } else { options.magnification };
        if values[1..] == [values[0]; 2] {
            let [u, v] = [4, 5].map(|i| (values[0][i] * ONE) as i64);
            let [r, g, b, a] = times(paint.texture.at(u, v), packed(corners[0].color)).to_le_bytes();
            paint.flat = Some(Color32::from_rgba_premultiplied(r, g, b, a));
        }
        paint
    }

    fn blend(&self, x: i64, y: i64, target: &mut [Color32]) {
        let [x, y] = [x as f64 - self.origin[0], y as f64 - self.origin[1]];
        let mut now = [0; 6];
        let mut step = [0; 6];
        for i in 0..6 {
            now[i] = ((self.start[i] + self.across[i] * x + self.down[i] * y) * ONE) as i64;
            step[i] = (self.across[i] * ONE) as i64;
        }
        let [mut r, mut g, mut b, mut a, mut u, mut v] = now;
        let even = step[..4] == [0; 4];
        let fixed_texel = step[4..] == [0; 2];
        let mut color = channel(r) | channel(g) << 8 | channel(b) << 16 | channel(a) << 24;
        let mut texel = self.texture.at(u, v);
        for pixel in target {
            if !even {
                color = channel(r) | channel(g) << 8 | channel(b) << 16 | channel(a) << 24;
                r += step[0];
                g += step[1];
                b += step[2];
                a += step[3];
            }
            if !fixed_texel {
                texel = self.texture.at(u, v);
                u += step[4];
                v += step[5];
            }
            *pixel = over(times(texel, color), *pixel);
        }
    }
}

struct Texture<'a> {
    pixels: &'a [Color32],
    size: [i64; 2],
    wrap: TextureWrapMode,
    linear: bool,
}

impl<'a> Texture<'a> {
    fn new(image: &'a ColorImage, options: TextureOptions) -> Self {
        Self { pixels: &image.pixels, size: image.size.map(|side| side as i64), wrap: options.wrap_mode, linear: true }
    }

    /// The color at a place in texels, with 16 fractional bits.
    fn at(&self, u: i64, v: i64) -> u32 {
        if !self.linear {
            return self.texel(u >> 16, v >> 16);
        }
        let [u, v] = [u - 32_768, v - 32_768];
        let [x, y] = [u >> 16, v >> 16];
        let [right, lower] = [(u >> 8 & 255) as u32, (v >> 8 & 255) as u32];
        let above = self.between(x, y, right);
        if lower == 0 {
            return above;
        }
        mix(above, self.between(x, y + 1, right), lower)
    }

    fn between(&self, x: i64, y: i64, right: u32) -> u32 {
        let left = self.texel(x, y);
        if right == 0 {
            return left;
        }
        mix(left, self.texel(x + 1, y), right)
    }

    fn texel(&self, x: i64, y: i64) -> u32 {
        let [width, height] = self.size;
        packed(self.pixels[(self.wrapped(y, height) * width + self.wrapped(x, width)) as usize])
    }

    fn wrapped(&self, at: i64, side: i64) -> i64 {
        if at >= 0 && at < side {
            return at;
        }
        match self.wrap {
            TextureWrapMode::ClampToEdge => at.clamp(0, side - 1),
            TextureWrapMode::Repeat => at.rem_euclid(side),
            TextureWrapMode::MirroredRepeat => {
                let at = at.rem_euclid(2 * side);
                at.min(2 * side - 1 - at)
            }
        }
    }
}

// A packed color holds r, g, b, a from its lowest byte up. `EVEN` are r and b, or g and a after a shift by 8: two
// channels with 8 bits of room each.
const EVEN: u32 = 0x00ff_00ff;
const HALF: u32 = 0x0080_0080;

fn packed(color: Color32) -> u32 {
    u32::from_le_bytes(color.to_array())
}

/// An interpolated channel as a byte. Between corners it is within 0–255 but for rounding.
fn channel(value: i64) -> u32 {
    if value < 0 {
        return 0;
    }
    let value = (value + 32_768) >> 16;
    if value > 255 { 255 } else { value as u32 }
}

/// From `a` to `b` by `part` / 256.
fn mix(a: u32, b: u32, part: u32) -> u32 {
    if a == b {
        return a;
    }
    let rest = 256 - part;
    let even = (a & EVEN) * rest + (b & EVEN) * part + HALF;
    let odd = (a >> 8 & EVEN) * rest + (b >> 8 & EVEN) * part + HALF;
    even >> 8 & EVEN | odd & !EVEN
}

/// Two channels times `part` / 255, rounded.
fn scaled(pair: u32, part: u32) -> u32 {
    let pair = pair * part + HALF;
    ((pair + ((pair >> 8) & EVEN)) >> 8) & EVEN
}

/// A texel in a color, channel by channel.
fn times(texel: u32, color: u32) -> u32 {
    if texel == u32::MAX {
        return color;
    }
    let part = texel & 255;
    if texel == part * 0x0101_0101 {
        return scaled(color & EVEN, part) | scaled(color >> 8 & EVEN, part) << 8;
    }
    if color == u32::MAX {
        return texel;
    }
    let mut product = 0;
    for shift in [0, 8, 16, 24] {
        product |= scaled(texel >> shift & 255, color >> shift & 255) << shift;
    }
    product
}

/// A premultiplied color over what is there. A sum above 255, which egui's additive colors can reach, stays at 255.
fn over(color: u32, below: Color32) -> Color32 {
    let rest = 255 - (color >> 24);
    if color == 0 {
        return below;
    }
    let mut sum = color;
    if rest > 0 {
        let below = packed(below);
        let even = (color & EVEN) + scaled(below & EVEN, rest);
        let odd = (color >> 8 & EVEN) + scaled(below >> 8 & EVEN, rest);
        let full = |pair: u32| (pair | (((pair >> 8) & 0x0001_0001) * 255)) & EVEN;
        sum = full(even) | full(odd) << 8;
    }
    let [r, g, b, a] = sum.to_le_bytes();
    Color32::from_rgba_premultiplied(r, g, b, a)
}

#[test]
fn quads_that_share_an_edge_neither_overlap_nor_leave_a_gap() {
    // Half-transparent, so that a pixel painted twice or not at all shows. Corners off the pixels' grid, one quad each
    // way round, one of them far larger than the clip.
    let mut mesh = Mesh::default();
    let color = Color32::from_rgba_premultiplied(100, 0, 0, 128);
    for corners in [
        [[-9e6, -50.0], [7.3, -50.0], [12.9, 70.0], [-9e6, 70.0]],
        [[7.3, -50.0], [90.0, -50.0], [90.0, 70.0], [12.9, 70.0]],
    ] {
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(corners.map(|at| Vertex::untextured(at.into(), color)));
        mesh.indices.extend([0, 1, 2, 2, 0, 3].map(|corner| first + corner));
    }
    let texture = ColorImage::new([1, 1], vec![Color32::WHITE]);
    let mut canvas = Canvas::new(24, 16, 1.0);
    canvas.clip(Rect::from_min_max([2.0, 3.0].into(), [22.0, 99.0].into()));
    canvas.mesh(&mesh, &texture, TextureOptions::LINEAR);
    for y in 0..16 {
        for x in 0..24 {
            let inside = (2..22).contains(&x) && y >= 3;
            let expected = if inside { color } else { Color32::TRANSPARENT };
            assert_eq!(canvas.image[(x, y)], expected, "at ({x}, {y})");
        }
    }
}

#[test]
fn colors_blend_and_textures_are_filtered_as_in_the_shader() {
    for (color, below, expected) in [
        ([0, 0, 0, 0], [9, 8, 7, 255], [9, 8, 7, 255]),
        ([1, 2, 3, 255], [9, 8, 7, 255], [1, 2, 3, 255]),
        ([64, 0, 128, 128], [255, 255, 0, 255], [191, 127, 128, 255]),
        ([250, 0, 9, 0], [200, 10, 0, 255], [255, 10, 9, 255]),
    ] {
        let [color, below] = [color, below].map(|[r, g, b, a]| Color32::from_rgba_premultiplied(r, g, b, a));
        assert_eq!(over(packed(color), below).to_array(), expected);
    }
    let gray = |level| u32::from_le_bytes([level; 4]);
    assert_eq!(times(gray(128), 0xff_00_80_ff), 0x80_00_40_80);
    assert_eq!(times(0xff_00_80_ff, 0x80_ff_40_80), 0x80_00_20_80);

    let image = ColorImage::new([2, 1], vec![Color32::BLACK, Color32::from_gray(200)]);
    let mut texture = Texture::new(&image, TextureOptions::LINEAR);
    let columns = [-1.0, 0.5, 1.0, 1.25, 3.0].map(|u| (u * ONE) as i64);
    assert_eq!(columns.map(|u| texture.at(u, 0) & 255), [0, 0, 100, 150, 200]);
    texture.linear = false;
    assert_eq!(columns.map(|u| texture.at(u, 0) & 255), [0, 0, 200, 200, 200]);
    texture.wrap = TextureWrapMode::Repeat;
    assert_eq!(columns.map(|u| texture.at(u, 0) & 255), [200, 0, 200, 200, 200]);
    texture.wrap = TextureWrapMode::MirroredRepeat;
    assert_eq!(columns.map(|u| texture.at(u, 0) & 255), [0, 0, 200, 200, 0]);
}

#[test]
fn a_window_with_text_repeats_byte_for_byte_in_both_themes_and_sizes() {
    let font = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/fonts/DejaVuSans.ttf");
    let font = std::fs::read(font).expect("assets/fonts has the font of the window");
    let picture = |theme, scale| {
        let mut fonts = egui::FontDefinitions::empty();
        fonts.font_data.insert("dejavu".to_owned(), egui::FontData::from_owned(font.clone()).into());
        for family in fonts.families.values_mut() {
            family.push("dejavu".to_owned());
        }
        let mut harness = egui_kittest::Harness::builder()
            .with_size([160.0, 90.0])
            .with_pixels_per_point(scale)
            .with_theme(theme)
            .with_context_setup(move |ctx| ctx.set_fonts(fonts))
            .renderer(Cpu::default())
            .build_ui(|ui| {
                egui::CentralPanel::default().show(ui, |ui| {
                    ui.label("Δu′v′ of λ");
                    let _ = ui.button("Add camera");
                    ui.add(egui::ProgressBar::new(0.5));
                });
            });
        harness.run();
        harness.render().expect("the picture")
    };
    for (theme, dark) in [(egui::Theme::Dark, true), (egui::Theme::Light, false)] {
        for scale in [1.0, 2.0] {
            let image = picture(theme, scale);
            assert_eq!(image.dimensions(), ((160.0 * scale) as u32, (90.0 * scale) as u32));
            assert_eq!(image, picture(theme, scale), "the same again");
            // The harness leaves a margin of 8 points.
            let from = (9.0 * scale) as u32;
            let (width, height) = (image.width() - 2 * from, image.height() - 2 * from);
            let inner = image::imageops::crop_imm(&image, from, from, width, height).to_image();
            assert!(inner.pixels().all(|pixel| pixel[3] == 255), "nothing shows through");
            let corner = inner.get_pixel(width - 1, height - 1);
            assert_eq!(corner[0] < 128, dark, "the theme's background");
            let inked = inner.pixels().filter(|pixel| pixel[0].abs_diff(corner[0]) > 60).count();
            assert!(inked > 100, "text and bar are painted, in {inked} pixels");
        }
    }
}
