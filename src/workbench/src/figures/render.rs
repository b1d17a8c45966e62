//! The rendered pictures as a figure, and their pixels in words.

pub mod difference;
pub mod headline;
pub mod returned;

use chromascope_figure::{
    Anchor, Axis, Cell, Column, Figure, FigureRoom, Image, Ink, InkRole, Mark, Panel, Rect, Shape, Table, Tag,
    TextSize, text_width, wrapped,
};
use spectral_image::ImageQuantity;

use self::headline::{Detail, Measure};
use super::chromaticity::{sign, transform_words, viewing_conditions};
use super::kind::{FigureKind, Need};
use super::look::{FigureLook, PixelPlace, RenderMode};
use crate::format::fixed;
use crate::plot_item::{PickIndex, SensorId};
use crate::render_service::RenderedFrame;
use crate::render_service::made::MadePictures;
use crate::render_service::pixel::{self, LitPixel, PixelReading, PixelShows};
use crate::scene::spectral_image::ImagePictures;
use crate::scene::{ComparedSensor, Scene};
use chromascope_core::query::render::Roughness;

/// The width of a saved picture in points, where the figure may be as wide as it likes.
const WIDTH: f64 = 340.0;
/// Height of a line above a picture.
const LINE: f64 = 20.0;
/// Height of each line below it.
const SMALL_LINE: f64 = 15.0;
const GAP: f64 = 8.0;
/// A pixel of an image with a sample that is no number.
pub const NO_VALUE: &str = "no value in some band";

pub fn index_of(shot: &RenderedFrame, id: &SensorId) -> Option<usize> {
    shot.sources.iter().position(|source| source.kind == id.kind && source.name == id.name)
}

/// Pictures side by side for a number of sensors: three in a row, as two rows would leave a quarter empty.
fn columns(count: usize) -> usize {
    if count == 3 { 3 } else { in_square(count) }
}

fn in_square(count: usize) -> usize {
    ((count as f64).sqrt().ceil() as usize).max(1)
}

/// Width in points of each of some pictures in a figure with this room.
pub fn picture_width(room: FigureRoom, count: usize) -> f64 {
    let across = columns(count) as f64;
    room.width.map_or(WIDTH, |width| ((width - GAP) / across - GAP).max(1.0))
}

/// True if maps of so many sensors leave a place of a square empty, which the reference takes.
pub fn has_reference_beside(compared: usize) -> bool {
    !compared.is_multiple_of(in_square(compared))
}

/// Pictures shown, by index: all, or all but the reference, which is beside maps only in a place that were empty.
fn shown(shot: &RenderedFrame, mode: RenderMode) -> Vec<usize> {
    let compared = shot.sources.iter().filter(|source| !source.is_reference).count();
    let is_free = mode == RenderMode::Difference && has_reference_beside(compared);
    let only_compared = compared > 0 && matches!(mode, RenderMode::One | RenderMode::Difference) && !is_free;
    (0..shot.sources.len()).filter(|at| !(only_compared && shot.sources[*at].is_reference)).collect()
}

pub static KIND: FigureKind =
    FigureKind::new("render", "Pictures of a mesh or spectral image through each sensor", figure)
        .needing(Need::Pictures(RenderMode::Grid))
        .in_report();

/// The same with differences in place of the pictures, as the pane has them in that arrangement.
pub static DIFFERENCE: FigureKind =
    FigureKind::new("difference", "Maps of the pictures' differences from the reference", figure)
        .needing(Need::Pictures(RenderMode::Difference));

/// The current pictures, with captions and numbers; `None` before there are any.
fn figure(scene: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let shot = look.pictures.as_deref()?;
    let made = shot.made()?;
    let measure = Measure::of_frame(shot);
    let maps = (look.mode == RenderMode::Difference).then(|| difference::Scale::of(shot));
    // The gray that the pictures were made on, whatever paper they go to.
    let [ground, ink] = [look.surround.color(), look.surround.ink()].map(Ink::rgb);
    let shown = shown(shot, look.mode);
    let columns = columns(shown.len());
    let shape = made.pictures.iter().flatten().next().map_or([1, 1], |picture| [picture.width, picture.height]);
    let width = picture_width(room, shown.len());
    let size = [width, width * shape[1] as f64 / shape[0].max(1) as f64];
    let cells = |on_a_line: bool| -> Vec<PictureCell<'_>> {
        shown.iter().map(|at| PictureCell::new(shot, *at, maps.is_some(), width, on_a_line)).collect()
    };
    let all_on_a_line = cells(true).iter().all(|cell| cell.lines.len() == 1);
    let cells = cells(all_on_a_line);
    let above = cells.iter().map(PictureCell::height).fold(0.0, f64::max);
    let rows = cells.len().div_ceil(columns);
    let scale = if maps.is_some() { difference::SCALE_HEIGHT } else { 0.0 };
    let all = [columns as f64 * (size[0] + GAP) + GAP, rows as f64 * (size[1] + above + GAP) + GAP + scale];
    let mut figure = Figure::new("Rendered pictures", all);
    let mut panel = Panel::board("Render", Rect::from_min_size([0.0, 0.0], all), ground);
    for (place, cell) in cells.iter().enumerate() {
        let x = GAP + (place % columns) as f64 * (size[0] + GAP);
        let y = GAP + (place / columns) as f64 * (size[1] + above + GAP);
        panel.marks.extend(cell.heading([x, y], width, ink));
        panel.marks.extend(cell.picture(shot, maps, Rect::from_min_size([x, y + above], size)));
    }
    if let Some(scale) = maps {
        let corner = [GAP, all[1] - difference::SCALE_HEIGHT];
        panel.marks.extend(difference::scale(scale, measure.name(), corner, all[0] - 2.0 * GAP, ink));
    }
    figure.panels.push(panel);
    figure.caption = match maps {
        Some(_) => {
            let hatched = if shown_unlit(&made) { "; hatched: no light" } else { "" };
            let black = if made.image().is_none() { "; black: no surface" } else { "" };
            format!("Maps of {} from the reference{black}{hatched}. {}", measure.name(), caption(scene, shot))
        }
        None => format!("{}{}", caption(scene, shot), shot.query.exaggeration().sentence()),
    };
    if !shot.sources.iter().all(|source| source.is_reference) {
        let meaning = if cells.iter().any(|cell| cell.is_short) { measure.short_meaning() } else { measure.meaning() };
        figure.caption = format!("{} {meaning}", figure.caption);
    }
    figure.table = table(shot, measure.name());
    Some(figure)
}

/// True if a sample that is seen gets no light.
fn shown_unlit(made: &MadePictures<'_>) -> bool {
    (0..made.pictures.len())
        .filter_map(|at| made.signals(at))
        .any(|(geometry, _)| geometry.seen().len() > geometry.samples().len())
}

/// One picture with the words above it.
struct PictureCell<'a> {
    at: usize,
    source: &'a ComparedSensor,
    label: String,
    /// Lines of the name, then of the difference, at the left.
    lines: Vec<(String, TextSize)>,
    /// Number of lines of the name.
    named: usize,
    /// Words at the right end of the first line.
    note: String,
    /// True if the words are of one number only.
    is_short: bool,
}

impl<'a> PictureCell<'a> {
    /// Room for the marker before the name.
    const KEY: f64 = 18.0;

    /// With name and difference on one line, where asked for and possible.
    fn new(shot: &'a RenderedFrame, at: usize, is_map: bool, width: f64, on_a_line: bool) -> Self {
        let source = &shot.sources[at];
        let label = if source.is_reference { format!("Reference, {}", source.label) } else { source.label.clone() };
        let is_long =
            |of: &ComparedSensor| !of.is_reference && text_width(&of.label, TextSize::Small) + Self::KEY > width;
        let by_short = shot.sources.iter().any(is_long);
        // Maps are of the differences as they are.
        let exaggerated = shot.query.exaggeration().note().filter(|_| !is_map && !source.is_reference);
        let named = |name: &str| exaggerated.as_ref().map_or(name.to_owned(), |note| format!("{name}, {note}"));
        let (label, short) = (named(&label), named(&source.short));
        let difference = shot.made().and_then(|made| made.differences.get(at)?.as_ref());
        let words = |detail| difference.map(|difference| Measure::of_frame(shot).words(difference, detail));
        let all = words(Detail::Quantiles).unwrap_or_default();
        // What takes more than a line is left to the numbers.
        let is_short = is_map || text_width(&all, TextSize::Small) > width;
        let note = if is_short { words(Detail::Metric).unwrap_or_default() } else { all };
        let both = text_width(&label, TextSize::Body) + text_width(&note, TextSize::Body) + Self::KEY + 2.0 * GAP;
        let lines = |text: &str, size, room| wrapped(text, size, room).into_iter().map(move |line| (line, size));
        if on_a_line && both <= width && !by_short {
            return Self { at, source, lines: vec![(label.clone(), TextSize::Body)], named: 1, label, note, is_short };
        }
        let fits = |form: &&str| text_width(form, TextSize::Small) + Self::KEY <= width;
        let first = if by_short { &short } else { &label };
        let forms = if source.is_reference { ["Reference"; 2] } else { [first.as_str(), short.as_str()] };
        let short = forms.into_iter().find(fits).unwrap_or(forms[1]);
        let name: Vec<_> = lines(short, TextSize::Small, width - Self::KEY).collect();
        let named = name.len();
        let lines = name.into_iter().chain(lines(&note, TextSize::Small, width)).collect();
        Self { at, source, label, lines, named, note: String::new(), is_short }
    }

    /// Height of the words: those of a name of one line have air around them.
    fn height(&self) -> f64 {
        LINE + SMALL_LINE * (self.lines.len() as f64 - 1.0)
    }

    fn heading(&self, [x, y]: [f64; 2], width: f64, ink: Ink) -> Vec<Mark> {
        let middle = y + LINE / 2.0;
        let mark = sign(PickIndex::NONE, self.source, [x + 7.0, middle], 5.0, ink);
        let mut marks = vec![Mark { name: self.label.clone(), ..mark }];
        for (row, (words, size)) in self.lines.iter().enumerate() {
            let inset = if row < self.named { Self::KEY } else { 0.0 };
            let at = [x + inset, middle + SMALL_LINE * row as f64];
            marks.push(Mark::text(words.as_str(), at, Anchor::LEFT, *size, ink));
        }
        if !self.note.is_empty() {
            let at = [x + width - GAP, middle];
            marks.push(Mark::text(self.note.as_str(), at, Anchor::RIGHT, TextSize::Body, ink));
        }
        marks
    }

    fn picture(&self, shot: &RenderedFrame, maps: Option<difference::Scale>, area: Rect) -> Option<Mark> {
        let made = shot.made()?;
        let picture = made.pictures.get(self.at)?.as_ref().ok()?;
        let ([width, height], rgba) = match maps {
            Some(scale) if !self.source.is_reference => difference::map(shot, self.at, scale.end),
            _ => ([picture.width, picture.height], picture.rgba.clone()),
        };
        let image = Image { width, height, rgba: rgba.into() };
        let shape = Shape::Image { min: [area.min[0], area.max[1]], max: [area.max[0], area.min[1]], image };
        Some(Mark::new(PickIndex::NONE, format!("{}, picture", self.label), shape))
    }
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
        let [seen, transform] = [viewing_conditions(scene), transform_words(scene)];
        return format!("Spectral image: {mesh}, {size}, {quantity}. {seen} {transform}");
    }
    let roughness = match settings.roughness {
        Roughness::Surface => format!("σ = {} µm, τ = {} µm", settings.sigma_um, settings.tau_um),
        Roughness::Mesh => "σ and τ from the mesh".to_owned(),
    };
    let [light, white] = scene.rendered_conditions();
    let sky = if settings.sky > 0.0 { format!(" and {} % sky", fixed(100.0 * settings.sky, 0)) } else { String::new() };
    let thin = if settings.thin { ", light passes through as through a leaf" } else { "" };
    format!(
        "Mesh: {mesh}. Material: {}{thin}, {roughness}, n = {}. Normalization of P: {}; coherent component: {}; {}. Reference: {}. \
         Light: {light}{sky}. White balance: {white}. {}",
        settings.materials(),
        settings.index,
        settings.normalization.label(),
        settings.specular.label(),
        settings.area.label(),
        scene.document.reference,
        transform_words(scene)
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
    let is_image = shot.query.image().is_some();
    let columns = if is_image {
        "sensor mean max clipped_pixels pixels_across pixels_down time_ms measure facing_light median p95 \
         pixels_with_value"
    } else {
        "sensor mean_of_lit max_of_lit clipped_samples pixels_across pixels_down time_ms measure facing_light \
         median_above_l20 p95_above_l20 samples_above_l20 garment_facing_light"
    };
    let mut table = Table::new(columns.split(' '));
    table.columns[6] = Column::quantity("time_ms", "time", "ms");
    let Some(made) = shot.made() else { return table };
    for (at, source) in shot.sources.iter().enumerate() {
        let difference = made.differences.get(at).and_then(Option::as_ref);
        let bright = difference.and_then(|difference| difference.bright);
        let garment = (!is_image).then(|| Cell::from(difference.and_then(|difference| difference.garment)));
        let picture = made.pictures.get(at).and_then(|picture| picture.as_ref().ok());
        let row = [
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
        ];
        table.push(row.into_iter().chain(garment));
    }
    table
}

pub fn pixel_of(scene: &Scene<'_>, shot: &RenderedFrame, place: &PixelPlace) -> Option<PixelReading> {
    pixel::read(shot, scene.results, index_of(shot, &place.source)?, place.at)
}

/// A pixel in one line.
pub fn pixel_line(scene: &Scene<'_>, shot: &RenderedFrame, place: &PixelPlace) -> Option<String> {
    let reading = pixel_of(scene, shot, place)?;
    let label = &shot.sources.get(index_of(shot, &place.source)?)?.label;
    let label = patch_at(scene, shot, place).map_or_else(|| label.clone(), |patch| format!("{patch}, {label}"));
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

/// The patch of the chart in the picture that a pixel shows.
pub fn patch_at(scene: &Scene<'_>, shot: &RenderedFrame, place: &PixelPlace) -> Option<String> {
    let PixelShows::Lit(lit) = pixel_of(scene, shot, place)?.shows else { return None };
    scene.patch_name(lit.part)
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

/// Samples of a pixel over the wavelength, from 0.
pub fn spectrum_panel(points: &[[f64; 2]], quantity: ImageQuantity, size: [f64; 2]) -> Panel {
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
