//! The rendered pictures as a figure, and their pixels in words.

pub mod difference;
pub mod headline;
pub mod returned;
pub mod spectrum;

use chromascope_figure::{Anchor, Cell, Figure, Image, Ink, Mark, Panel, Rect, Shape, Table, TextSize};
use spectral_image::ImageQuantity;

use self::headline::{Detail, Measure};
use super::FigureInput;
use super::chromaticity::viewing_conditions;
use crate::document::render::RoughnessChoice;
use crate::format::fixed;
use crate::plot_item::{PickIndex, SensorId};
use crate::render_service::RenderedFrame;
use crate::render_service::made::MadePictures;
use crate::render_service::pixel::{self, LitPixel, PixelReading, PixelShows};
use crate::scene::Scene;
use crate::scene::spectral_image::ImagePictures;
use crate::view::render::{PixelPlace, RenderMode};

/// The width of a saved picture in points, in a grid of two columns.
const WIDTH: f64 = 340.0;
/// The height of the line above a picture.
const CAPTION: f64 = 20.0;
const GAP: f64 = 8.0;
/// A pixel of an image with a sample that is no number.
pub const NO_VALUE: &str = "no value in some band";

/// A sensor's index among the pictures.
pub fn index_of(shot: &RenderedFrame, id: &SensorId) -> Option<usize> {
    shot.sources.iter().position(|source| source.kind == id.kind && source.name == id.name)
}

/// The current pictures, with captions and numbers; `None` before there are any.
pub fn figure(input: &FigureInput<'_>) -> Option<Figure> {
    let (scene, view, shot) = (input.scene, input.view, input.pictures?);
    let made = shot.made()?;
    let measure = Measure::of_frame(shot);
    let mode = view.saved.render.mode;
    let maps = (mode == RenderMode::Difference).then(|| difference::Scale::of(shot));
    let only_sources = matches!(mode, RenderMode::One | RenderMode::Difference);
    let first = usize::from(only_sources && shot.sources.len() > 1);
    let shown: Vec<usize> = (first..shot.sources.len()).collect();
    let columns = ((shown.len() as f64).sqrt().ceil() as usize).max(1);
    let shape = made.pictures.iter().flatten().next().map_or([1, 1], |picture| [picture.width, picture.height]);
    let height = WIDTH * shape[1] as f64 / shape[0].max(1) as f64;
    let rows = shown.len().div_ceil(columns);
    let scale = if maps.is_some() { difference::SCALE_HEIGHT } else { 0.0 };
    let all = [columns as f64 * (WIDTH + GAP) + GAP, rows as f64 * (height + CAPTION + GAP) + GAP + scale];
    let mut figure = Figure::new("Rendered pictures", all);
    // The gray that the pictures were made on, whatever paper they go to.
    let surround = view.saved.surround;
    let [ground, ink] = [surround.color(), surround.label()].map(|color| {
        let [r, g, b, _] = color.to_array();
        Ink::rgb([r, g, b])
    });
    let mut panel = Panel::board("Render", Rect::from_min_size([0.0, 0.0], all), ground);
    for (place, &at) in shown.iter().enumerate() {
        let x = GAP + (place % columns) as f64 * (WIDTH + GAP);
        let y = GAP + (place / columns) as f64 * (height + CAPTION + GAP);
        let source = &shot.sources[at];
        let label = if source.is_reference { format!("Reference, {}", source.label) } else { source.label.clone() };
        let difference = made.differences.get(at).and_then(Option::as_ref);
        let detail = if maps.is_some() { Detail::Metric } else { Detail::Quantiles };
        let note = difference.map(|difference| measure.words(difference, detail));
        let middle = y + CAPTION / 2.0;
        let marker = Shape::Points { points: vec![[x + 7.0, middle]], marker: source.marker, radius: 5.0 };
        let mark = Mark::new(PickIndex::NONE, label.clone(), marker).with_stroke(ink, 1.5);
        panel.marks.push(if source.marker.has_inside() { mark.with_fill(ink) } else { mark });
        panel.marks.push(text(&label, [x + 18.0, middle], Anchor::LEFT, ink));
        if let Some(note) = note {
            panel.marks.push(text(&note, [x + WIDTH - GAP, middle], Anchor::RIGHT, ink));
        }
        if let Some(Ok(picture)) = made.pictures.get(at) {
            let ([width, height_in_pixels], rgba) = match maps {
                Some(scale) => difference::map(shot, at, scale.end),
                None => ([picture.width, picture.height], picture.rgba.clone()),
            };
            let image = Image { width, height: height_in_pixels, rgba: rgba.into() };
            let top = y + CAPTION;
            let shape = Shape::Image { min: [x, top + height], max: [x + WIDTH, top], image };
            panel.marks.push(Mark::new(PickIndex::NONE, format!("{label}, picture"), shape));
        }
    }
    if let Some(scale) = maps {
        let corner = [GAP, all[1] - difference::SCALE_HEIGHT];
        panel.marks.extend(difference::scale(scale, measure.name(), corner, all[0] - 2.0 * GAP, ink));
    }
    figure.panels.push(panel);
    figure.caption = match maps {
        Some(_) if made.image().is_some() => {
            format!("Maps of {} from the reference. {}", measure.name(), caption(scene, shot))
        }
        Some(_) => {
            format!("Maps of {} from the reference; hatched: no light. {}", measure.name(), caption(scene, shot))
        }
        None => caption(scene, shot),
    };
    if shown.len() > 1 || !shot.sources.iter().all(|source| source.is_reference) {
        figure.caption = format!("{} {}", figure.caption, measure.meaning());
    }
    figure.table = table(shot, measure.name());
    Some(figure)
}

fn text(words: &str, at: [f64; 2], anchor: Anchor, ink: Ink) -> Mark {
    let shape = Shape::Text { at, text: words.to_owned(), anchor, offset: [0.0, 0.0], size: TextSize::Body, ink };
    Mark::new(PickIndex::NONE, words, shape)
}

/// The conditions in sentences.
fn caption(scene: &Scene<'_>, shot: &RenderedFrame) -> String {
    let settings = &scene.document.render;
    let mesh = settings.mesh.name();
    if let Some(image) = shot.made().and_then(MadePictures::image) {
        let quantity = match image.image.quantity {
            ImageQuantity::Reflectance => "reflectances under the scene's light".to_owned(),
            ImageQuantity::Radiance => format!("radiances, white at Y = {:.3e}", image.white),
        };
        let size = image_words(shot, image);
        return format!("Spectral image: {mesh}, {size}, {quantity}. {}", viewing_conditions(scene));
    }
    let roughness = match settings.roughness {
        RoughnessChoice::Surface => format!("σ = {} µm, τ = {} µm", settings.sigma_um, settings.tau_um),
        RoughnessChoice::Mesh => "σ and τ from the mesh".to_owned(),
    };
    let [light, white] = scene.rendered_conditions();
    let sky = if settings.sky > 0.0 { format!(" and {} % sky", fixed(100.0 * settings.sky, 0)) } else { String::new() };
    let thin = if settings.thin { ", light passes through as through a leaf" } else { "" };
    format!(
        "Mesh: {mesh}. Material: {}{thin}, {roughness}, n = {}. Normalization of P: {}; coherent component: {}; {}. Reference: {}. \
         Light: {light}{sky}. White balance: {white}.",
        settings.material,
        settings.index,
        settings.reading.label(),
        settings.specular.label(),
        settings.area.label(),
        scene.document.reference
    )
}

/// Size, decimation and bands of an image.
pub fn image_words(shot: &RenderedFrame, image: &ImagePictures) -> String {
    let info = &image.image.info;
    let step = shot.query.image().map_or(1, |query| query.signals.step);
    let decimation = match step {
        1 => String::new(),
        2 => ", every second pixel across and down".to_owned(),
        3 => ", every 3rd pixel across and down".to_owned(),
        _ => format!(", every {step}th pixel across and down"),
    };
    format!("{} × {} pixels{decimation}, {} bands", info.width, info.height, info.wavelengths_nm.len())
}

fn table(shot: &RenderedFrame, measure: &str) -> Table {
    let columns = if shot.query.image().is_some() {
        "sensor mean max clipped_pixels pixels_across pixels_down time_ms measure facing_light median p95 \
         pixels_with_value"
    } else {
        "sensor mean_of_lit max_of_lit clipped_samples pixels_across pixels_down time_ms measure facing_light \
         median_above_l20 p95_above_l20 samples_above_l20"
    };
    let mut table = Table::new(columns.split(' '));
    let Some(made) = shot.made() else { return table };
    for (at, source) in shot.sources.iter().enumerate() {
        let difference = made.differences.get(at).and_then(Option::as_ref);
        let bright = difference.and_then(|difference| difference.bright);
        let picture = made.pictures.get(at).and_then(|picture| picture.as_ref().ok());
        table.push([
            Cell::from(source.label.as_str()),
            Cell::from(difference.map(|difference| difference.mean)),
            Cell::from(difference.map(|difference| difference.max)),
            Cell::from(picture.map(|picture| picture.clipped as f64)),
            Cell::from(picture.map(|picture| picture.width as f64)),
            Cell::from(picture.map(|picture| picture.height as f64)),
            Cell::from(shot.time.as_secs_f64() * 1e3),
            Cell::from(if source.is_reference { "" } else { measure }),
            Cell::from(difference.and_then(|difference| difference.facing)),
            Cell::from(bright.map(|bright| bright.median)),
            Cell::from(bright.map(|bright| bright.p95)),
            Cell::from(difference.map(|_| bright.map_or(0.0, |bright| bright.count as f64))),
        ]);
    }
    table
}

/// The pixel at a place of a sensor's picture.
pub fn pixel_of(scene: &Scene<'_>, shot: &RenderedFrame, place: &PixelPlace) -> Option<PixelReading> {
    pixel::read(shot, scene.results, index_of(shot, &place.source)?, place.at)
}

/// A pixel in one line.
pub fn pixel_line(scene: &Scene<'_>, shot: &RenderedFrame, place: &PixelPlace) -> Option<String> {
    let reading = pixel_of(scene, shot, place)?;
    let label = &shot.sources.get(index_of(shot, &place.source)?)?.label;
    let [x, y] = reading.at;
    let rest = match &reading.shows {
        PixelShows::Nothing => {
            let hint = "Drag to orbit; scroll to move nearer.";
            return Some(format!("{label}, pixel {x}, {y}: beside the mesh. {hint}"));
        }
        PixelShows::NoValue => NO_VALUE.to_owned(),
        PixelShows::Unlit => "no light reaches it".to_owned(),
        PixelShows::Lit(lit) => facts(lit, Measure::of_frame(shot))
            .into_iter()
            .map(|(name, value)| format!("{name} {value}"))
            .collect::<Vec<_>>()
            .join("  "),
    };
    Some(format!("{label}, pixel {x}, {y}: {rest}"))
}

/// A lit pixel's numbers with their names; `measure` is that of its difference.
pub fn facts(lit: &LitPixel, measure: Measure) -> Vec<(&'static str, String)> {
    let three = |values: [f64; 3], decimals: usize| values.map(|v| fixed(v, decimals)).join(" ");
    let mut facts = vec![("RGB", three(lit.linear, 3))];
    if let Some(xy) = lit.xy {
        facts.push(("xy", format!("{} {}", fixed(xy.x, 4), fixed(xy.y, 4))));
    }
    if let Some(lab) = lit.lab {
        facts.push(("Lab", three([lab.l, lab.a, lab.b], 1)));
    }
    if let Some(difference) = lit.difference {
        facts.push((measure.name(), measure.number(difference)));
    }
    if let Some((g, _)) = lit.roughness {
        let decimals = if g >= 100.0 { 0 } else { 3 };
        facts.push(("g", fixed(g, decimals)));
    }
    facts
}
