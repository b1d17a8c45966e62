//! Pictures as textures, uploaded once.

use std::{collections::HashMap, sync::Arc};

use chromascope_figure::Image;
use egui::{Color32, ColorImage, Context, Id, Painter, Pos2, Rect, TextureHandle, TextureOptions};

/// Frames after which an unused texture is freed.
const IDLE_FRAMES: u64 = 120;

/// Textures by the address of their pixels. The pixels are held, so an address is not given to others meanwhile.
#[derive(Clone, Default)]
struct Textures(HashMap<usize, Entry>);

#[derive(Clone)]
struct Entry {
    _pixels: Arc<[u8]>,
    texture: TextureHandle,
    used: u64,
}

pub(super) fn draw(painter: &Painter, rect: Rect, image: &Image) {
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
        Entry { _pixels: Arc::clone(&image.rgba), texture, used: now }
    });
    entry.used = now;
    let texture = entry.texture.clone();
    textures.0.retain(|_, entry| entry.used + IDLE_FRAMES >= now);
    ctx.data_mut(|data| data.insert_temp(id, textures));
    texture
}
