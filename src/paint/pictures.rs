//! Rendered pictures as textures, uploaded when they changed.

use std::collections::HashMap;
use std::fmt;

use egui::{Color32, ColorImage, Painter, Rect, TextureHandle, TextureOptions};

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
