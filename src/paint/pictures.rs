//! Pictures as textures: rendered ones, uploaded when they changed, and those of figures, uploaded once.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use chromascope_figure::Image;
use egui::{Color32, ColorImage, Context, Id, Painter, Pos2, Rect, TextureHandle, TextureOptions};

/// Frames after which an unused texture is freed.
const IDLE_FRAMES: u64 = 240;

/// Textures by name, each with the version of the picture that it holds.
#[derive(Default)]
pub struct PictureTextures(HashMap<String, Entry>);

struct Entry {
    texture: TextureHandle,
    version: u64,
    sharp: bool,
    used: u64,
}

#[derive(Clone, Copy, Debug)]
pub struct PictureQuery<'a> {
    pub name: &'a str,
    /// Its version: it is made and uploaded when this changed.
    pub version: u64,
    pub rect: Rect,
    pub clip: Rect,
    /// True if its pixels are those of the screen.
    pub sharp: bool,
}

impl PictureTextures {
    /// Draws a picture; `make` gives width, height and straight RGBA where it is not known yet.
    pub fn draw(&mut self, painter: &Painter, of: PictureQuery<'_>, make: impl FnOnce() -> ([usize; 2], Vec<u8>)) {
        let now = painter.ctx().cumulative_pass_nr();
        let known = self.0.get(of.name).is_some_and(|e| e.version == of.version && e.sharp == of.sharp);
        if !known {
            let (size, rgba) = make();
            if size[0] == 0 || size[1] == 0 || rgba.len() != 4 * size[0] * size[1] {
                return;
            }
            let image = ColorImage::from_rgba_unmultiplied(size, &rgba);
            let options = if of.sharp { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
            if let Some(entry) = self.0.get_mut(of.name) {
                entry.texture.set(image, options);
                (entry.version, entry.sharp) = (of.version, of.sharp);
            } else {
                let texture = painter.ctx().load_texture(of.name, image, options);
                let entry = Entry { texture, version: of.version, sharp: of.sharp, used: now };
                self.0.insert(of.name.to_owned(), entry);
            }
        }
        if let Some(entry) = self.0.get_mut(of.name) {
            entry.used = now;
            let whole = Rect::from_min_max(egui::Pos2::ZERO, egui::Pos2::new(1.0, 1.0));
            painter.with_clip_rect(of.clip.intersect(painter.clip_rect())).image(
                entry.texture.id(),
                of.rect,
                whole,
                Color32::WHITE,
            );
        }
        self.0.retain(|_, entry| entry.used + IDLE_FRAMES >= now);
    }
}

impl fmt::Debug for PictureTextures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}

/// Frames after which an unused texture is freed.
const HELD_FRAMES: u64 = 120;

/// Textures by the address of their pixels. The pixels are held, so an address is not given to others meanwhile.
#[derive(Clone, Default)]
struct Textures(HashMap<usize, Held>);

#[derive(Clone)]
struct Held {
    _pixels: Arc<[u8]>,
    texture: TextureHandle,
    used: u64,
}

pub fn draw(painter: &Painter, rect: Rect, image: &Image) {
    if !image.is_drawable() {
        return;
    }
    let texture = texture(painter.ctx(), image);
    let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    painter.image(texture.id(), rect, whole, Color32::WHITE);
}

fn texture(ctx: &Context, image: &Image) -> TextureHandle {
    let id = Id::unique("figure textures");
    let now = ctx.cumulative_pass_nr();
    let address = image.rgba.as_ptr() as usize;
    let mut textures: Textures = ctx.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let entry = textures.0.entry(address).or_insert_with(|| {
        let pixels = ColorImage::from_rgba_unmultiplied([image.width, image.height], &image.rgba);
        let texture = ctx.load_texture("figure", pixels, TextureOptions::LINEAR);
        Held { _pixels: Arc::clone(&image.rgba), texture, used: now }
    });
    entry.used = now;
    let texture = entry.texture.clone();
    textures.0.retain(|_, entry| entry.used + HELD_FRAMES >= now);
    ctx.data_mut(|data| data.insert_temp(id, textures));
    texture
}
