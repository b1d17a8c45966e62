//! Pictures as textures: rendered ones, uploaded when they changed, and those of figures, uploaded once.

use std::collections::HashMap;
use std::sync::Arc;

use chromascope_figure::Image;
use egui::{Color32, ColorImage, Id, Painter, Pos2, Rect, TextureHandle, TextureOptions};

/// Frames after which an unused texture is freed.
const IDLE_FRAMES: u64 = 240;

type Textures = HashMap<String, Entry>;

#[derive(Clone)]
struct Entry {
    texture: TextureHandle,
    /// Version and sharpness of the picture that it holds.
    version: (u64, bool),
    used: u64,
    /// Pixels by whose address it is known: held, so that the address is not given to others meanwhile.
    _pixels: Option<Arc<[u8]>>,
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

impl PictureQuery<'_> {
    /// Draws the picture; `make` gives width, height and straight RGBA where it is not known yet.
    pub fn draw<P: AsRef<[u8]>>(self, painter: &Painter, make: impl FnOnce() -> ([usize; 2], P)) {
        self.draw_held(painter, None, make);
    }

    fn draw_held<P: AsRef<[u8]>>(
        self,
        painter: &Painter,
        pixels: Option<Arc<[u8]>>,
        make: impl FnOnce() -> ([usize; 2], P),
    ) {
        let (ctx, id, version) = (painter.ctx(), Id::unique("textures"), (self.version, self.sharp));
        let known = ctx.data_mut(|data| data.get_temp_mut_or_default::<Textures>(id).get(self.name).cloned());
        let texture = if let Some(entry) = known.filter(|entry| entry.version == version) {
            entry.texture
        } else {
            let (size, rgba) = make();
            let rgba = rgba.as_ref();
            if size.contains(&0) || rgba.len() != 4 * size[0] * size[1] {
                return;
            }
            let options = if self.sharp { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
            ctx.load_texture(self.name, ColorImage::from_rgba_unmultiplied(size, rgba), options)
        };
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        let inside = painter.with_clip_rect(self.clip.intersect(painter.clip_rect()));
        inside.image(texture.id(), self.rect, whole, Color32::WHITE);
        let used = ctx.cumulative_pass_nr();
        ctx.data_mut(|data| {
            let textures = data.get_temp_mut_or_default::<Textures>(id);
            textures.insert(self.name.to_owned(), Entry { texture, version, used, _pixels: pixels });
            textures.retain(|_, entry| entry.used + IDLE_FRAMES >= used);
        });
    }
}

/// Draws a picture of a figure.
pub fn draw(painter: &Painter, rect: Rect, image: &Image) {
    let name = format!("figure {:p}", image.rgba.as_ptr());
    let of = PictureQuery { name: &name, version: 0, rect, clip: rect, sharp: false };
    of.draw_held(painter, Some(Arc::clone(&image.rgba)), || ([image.width, image.height], &image.rgba));
}
