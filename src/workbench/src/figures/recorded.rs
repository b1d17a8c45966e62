//! Residuals of a camera's sensitivities against recorded raw values, patch by patch.

use chromascope_core::camera::recorded::{Exclusion, RankRange, RecordedFit};
use chromascope_figure::{
    Anchor, Axis, Cell, Field, Figure, FigureRoom, Ink, InkRole, Label, Labels, LegendEntry, LegendPlace, Mark, Marker,
    Panel, Place, Rect, Shape, Table, Tag, Ticks,
};

use super::kind::{FigureKind, Need};
use super::look::FigureLook;
use crate::format::fixed;
use crate::scene::Scene;
use crate::scene::recorded::{CHANNELS, RankedCamera, range_in_words};

/// Markers and colors of the three channels.
const MARKS: [(Marker, [u8; 3]); 3] =
    [(Marker::TriangleUp, [208, 64, 52]), (Marker::Circle, [44, 148, 72]), (Marker::Square, [58, 108, 214])];
const SIZE: [f64; 2] = [720.0, 320.0];

/// The camera whose residuals are shown: the one chosen, or the best.
pub fn chosen<'a>(
    ranked: &'a [RankedCamera],
    choice: Option<&String>,
) -> Option<(&'a str, &'a RecordedFit, RankRange)> {
    let named = |camera: &&RankedCamera| choice.is_none_or(|name| *name == camera.name);
    let camera = ranked.iter().find(named).or(ranked.first())?;
    Some((&camera.name, camera.fit.as_ref().ok()?, camera.rank?))
}

pub static KIND: FigureKind =
    FigureKind::new("recorded", "Residuals of the camera nearest to recorded raw values", figure)
        .needing(Need::Recorded);

/// Residual per patch and channel of the selected camera, with the numbers.
fn figure(_: &Scene<'_>, look: &FigureLook, room: FigureRoom) -> Option<Figure> {
    let (set, ranked) = look.recorded.as_ref()?;
    let (name, fit, rank) = chosen(ranked, look.residuals_of.as_ref())?;
    let names: Vec<String> = set.iter().map(|patch| patch.name.clone()).collect();
    let mut figure = Figure::new(title(name), room.size(SIZE, 0.0));
    figure.panels.push(panel(fit, &names, figure.size));
    figure.legend = legend();
    figure.legend_place = LegendPlace::Outside;
    figure.caption = format!(
        "Recorded over modeled raw values of {name} in percent (100 ln); RMS {} %, {} values, {} fitted parameters; {}. Named: the patches \
         with the largest residuals.",
        fixed(fit.rms() * 100.0, 2),
        fit.values,
        fit.parameters,
        range_in_words(rank)
    );
    figure.table = table(name, fit, rank, &names);
    Some(figure)
}

pub fn title(name: &str) -> String {
    format!("Residuals of {name}")
}

pub fn legend() -> Vec<LegendEntry> {
    let entry = |(name, (marker, rgb)): (&str, (Marker, [u8; 3]))| LegendEntry {
        name: name.to_owned(),
        stroke: None,
        marker: Some(marker),
        fill: Some(Ink::rgb(rgb)),
    };
    CHANNELS.into_iter().zip(MARKS).map(entry).collect()
}

/// Plot of the residuals in percent over the patches.
pub fn panel(fit: &RecordedFit, names: &[String], size: [f64; 2]) -> Panel {
    let percent = |row: usize, channel: usize| fit.residuals[row][channel].ok().map(|log| log * 100.0);
    let largest = fit.residuals.iter().flatten().flatten().fold(0.0, |most: f64, log| most.max(log.abs() * 100.0));
    let reach = (largest * 1.15).max(0.1);
    let count = names.len().max(1) as f64;
    let ticks = (0..names.len()).map(|i| (i as f64, (i + 1).to_string())).collect();
    let x = Axis::new("patch", [-0.6, count - 0.4]).with_ticks(Ticks::At(ticks));
    // Room above for the names of the worst patches.
    let y = Axis::new("ln(recorded / modeled) (%)", [-reach, 1.35 * reach]);
    let mut panel = Panel::new("residuals", Rect::from_min_size([0.0, 0.0], size), x, y);
    let zero = Shape::Segments { segments: vec![[[-0.6, 0.0], [count - 0.4, 0.0]]] };
    panel.marks.push(Mark::new(Tag::default(), "no residual", zero).with_stroke(InkRole::Line, 1.0));
    for (channel, (marker, rgb)) in MARKS.into_iter().enumerate() {
        for (row, patch) in names.iter().enumerate() {
            let Some(value) = percent(row, channel) else { continue };
            let at = [row as f64 + 0.22 * (channel as f64 - 1.0), value];
            let shape = Shape::Points { points: vec![at], marker, radius: 3.5 };
            let words = format!("{patch}, {}: {} %", CHANNELS[channel], fixed(value, 2));
            panel.marks.push(Mark::new(Tag((row * 3 + channel) as u32 + 1), words, shape).with_fill(Ink::rgb(rgb)));
        }
    }
    let mut labels = Labels::new(&panel);
    for (patch, _) in fit.worst_patches().into_iter().take(3).filter(|(_, rms)| *rms > 1e-9) {
        let top = (0..3).filter_map(|c| percent(patch, c)).fold(f64::MIN, f64::max);
        let (at, along) = ([patch as f64, top], patch as f64 / (count - 1.0).max(1.0));
        let places = [along, 0.0, 1.0].map(|along| Place { at, anchor: Anchor(along, 1.0), offset: [0.0, -6.0] });
        labels.place(&Label { starts: vec![at], ..Label::new(&names[patch], InkRole::Weak, places.to_vec()) });
    }
    panel.marks.extend(labels.into_marks());
    panel
}

struct Residual {
    camera: String,
    patch: String,
    channel: &'static str,
    log: Result<f64, Exclusion>,
    brightness: Option<f64>,
    rank: RankRange,
}

const COLUMNS: [Field<Residual>; 8] = [
    Field::new("camera", |residual| residual.camera.as_str().into()),
    Field::new("patch", |residual| residual.patch.as_str().into()),
    Field::new("channel", |residual| residual.channel.into()),
    Field::new("residual_percent", |residual| residual.log.ok().map(|log| log * 100.0).into()),
    Field::new("excluded", |residual| residual.log.err().map_or(Cell::Empty, |why| why.to_string().into())),
    Field::new("brightness", |residual| residual.brightness.into()),
    Field::new("rank_first", |residual| (residual.rank.range[0] as f64).into()),
    Field::new("rank_last", |residual| (residual.rank.range[1] as f64).into()),
];

fn table(camera: &str, fit: &RecordedFit, rank: RankRange, names: &[String]) -> Table {
    let residuals = names.iter().enumerate().flat_map(|(row, patch)| {
        let brightness = fit.brightness[row];
        let channels = CHANNELS.into_iter().zip(fit.residuals[row]);
        channels.map(move |(channel, log)| Residual {
            camera: camera.to_owned(),
            patch: patch.clone(),
            channel,
            log,
            brightness,
            rank,
        })
    });
    Table::of(&COLUMNS, residuals)
}
