//! Raw values of a real camera: residuals of one table of sensitivities, and all cameras ranked.

use std::sync::Arc;

use chromascope_core::camera::recorded::{RankRange, RecordedFit, RecordedPatch};
use chromascope_core::query::{RecordedSet, Shared};
use chromascope_figure::{Cell, Column, Table};
use egui::{DragValue, Id, Label, Rect, RichText, Sense, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::catalog::file_store::FileState;
use crate::catalog::recorded::Levels;
use crate::catalog::recorded_store::RecordedFile;
use crate::command::Command;
use crate::document::SetKind;
use crate::figures::recorded;
use crate::format::{file_name, fixed, rank_in_words};
use crate::paint::{self, PlotOptions};
use crate::panes::widgets;
use crate::panes::widgets::table::DataTable;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;
use crate::scene::recorded::{RANK_CAUTION, RankedCamera, cause_in_words, range_in_words};
use crate::theme::UNIT;
use crate::view::recorded::RecordedInputs;
use crate::workspaces::PaneKind;

const REACH: f32 = 10.0;
/// Share of the squares below which a cause is not named.
const NOTABLE: f64 = 0.25;
const ABOUT: &str = "Raw RGB that a camera recorded of known patches, against the sensitivities of every camera. Open a \
    table with columns patch, R, G, B (of the chart and light chosen above, or with spectra in further columns). A picture of a chart \
    opens in Data, Measure a camera.";

pub const PANE: Pane =
    Pane::new(PaneKind::RECORDED, "Recorded", show).tab("Raw").figure(&recorded::KIND).under_conditions().table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::body(ui, &PANE, rect, context, switches);
    let Some(path) = context.view.recorded.path.clone() else { return sentence(ui, body, ABOUT, true, context) };
    let file = match context.recorded.get(&path) {
        FileState::Ready(file) => file,
        FileState::Loading => {
            return sentence(ui, body, &format!("Reading {}…", file_name(&path)), false, context);
        }
        FileState::Failed(why) => return sentence(ui, body, &format!("{why}."), true, context),
    };
    if let Err(why) = refresh(&file, context) {
        (context.view.recorded.set, context.view.recorded.ranked) = (None, None);
        return sentence(ui, body, &format!("{}: {why}.", file.name), true, context);
    }
    let Some((set, ranked)) = context.view.recorded.ranked.clone() else {
        return sentence(ui, body, "Fitting the cameras…", false, context);
    };
    if let Some(camera) = recorded::chosen(&ranked, context.view.recorded.camera.as_ref()) {
        return ranking_and_residuals(ui, body, &file, (&set, &ranked), camera, context);
    }
    let why = ranked.first().and_then(|camera| camera.fit.as_ref().err());
    let why = why.map_or_else(|| "there are no cameras".to_owned(), ToString::to_string);
    sentence(ui, body, &format!("{}: {why}.", file.name), true, context);
}

/// Updates the current patches after changes of file, chart and light, and takes in their ranking.
fn refresh(file: &Arc<RecordedFile>, context: &mut PaneContext<'_>) -> Result<(), String> {
    let scene = context.scene;
    let view = &mut context.view.recorded;
    let chart = file.needs_chart().then(|| scene.patches()).transpose().map_err(|error| error.to_string())?;
    let inputs = RecordedInputs {
        file: Arc::clone(file),
        chart,
        light: scene.light().map_err(|error| error.to_string())?.grid,
        clip: view.clip,
    };
    let now = view.set.as_ref().filter(|(of, _)| *of == inputs);
    let set = match now {
        Some((_, set)) => set.clone(),
        None => Shared::new(patches(&scene, &inputs)?),
    };
    if view.set.as_ref().is_none_or(|(of, _)| !Arc::ptr_eq(&of.file, file)) {
        view.ranked = None;
    }
    view.set = Some((inputs, set.clone()));
    let query = scene.recorded_ranking(&set, view.freedom, &[]).map_err(|error| error.to_string())?;
    if let Some(made) = context.later.ask(PANE.kind, vec![query]).current()? {
        let ranked = made.as_ref().as_ref().map_err(ToString::to_string)?;
        view.ranked = Some((set, Arc::clone(ranked)));
    }
    Ok(())
}

fn patches(scene: &Scene<'_>, inputs: &RecordedInputs) -> Result<Vec<RecordedPatch>, String> {
    let chart =
        if inputs.chart.is_some() { scene.patch_radiances().map_err(|error| error.to_string())? } else { Vec::new() };
    let clip = if inputs.clip > 0.0 { inputs.clip } else { f64::INFINITY };
    inputs.file.patches(&chart, &inputs.light, Levels { black: 0.0, clip })
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let hint = "Open a table of raw values, or a picture of a chart";
    context.button(ui, "Open…", hint, Command::OpenRecorded);
    let view = &mut context.view.recorded;
    let file = view.path.as_ref().map(|path| context.recorded.get(path));
    let Some(FileState::Ready(_)) = file else { return };
    ui.checkbox(&mut view.freedom.gains, "Channel gains")
        .on_hover_text("Fit a gain for each channel; else one for all");
    ui.checkbox(&mut view.freedom.brightness, "Patch brightness")
        .on_hover_text("Fit a brightness for each patch: uneven illumination, shading; else all are 1");
    let clip = DragValue::new(&mut view.clip).range(0.0..=1e12).prefix("Clip at ");
    ui.add(clip).on_hover_text("Raw value from which on a channel is clipped and excluded; 0 for none");
}

fn sentence(ui: &mut Ui, body: Rect, words: &str, open: bool, context: &mut PaneContext<'_>) {
    let mut child = widgets::middle(ui, "recorded sentence", body, Vec2::new(460.0, 140.0));
    child.add(Label::new(words).wrap());
    child.add_space(UNIT);
    if open && child.button("Open raw values…").clicked() {
        context.push(Command::OpenRecorded);
    }
}

/// Residuals of one camera above, all cameras below.
fn ranking_and_residuals(
    ui: &mut Ui,
    body: Rect,
    file: &RecordedFile,
    (set, ranked): (&RecordedSet, &[RankedCamera]),
    (name, fit, rank): (&str, &RecordedFit, RankRange),
    context: &mut PaneContext<'_>,
) {
    let names: Vec<String> = set.iter().map(|patch| patch.name.clone()).collect();
    let top = words(ui, body, file, (name, fit, rank), &names, context);
    let body = body.with_min_y(top);
    let (plot, list) = body.split_top_bottom_at_fraction(0.55);
    if !widgets::figure_numbers(ui, &PANE, plot, context) {
        let size = [plot.width(), plot.height()].map(f64::from);
        let panel = recorded::panel(fit, &names, size);
        let options = PlotOptions { zoomable: true, reset: context.view.reset_plots, ..PlotOptions::default() };
        let shown = paint::plot(ui, Id::unique("residuals"), &panel, &context.theme, plot, options);
        context.view.note_zoom(PaneKind::RECORDED, recorded::title(name), shown.zoomed(&panel));
        widgets::labeled(&shown.response, egui::Role::Canvas, format!("Residuals of {name}"));
        let hit = shown.response.hover_pos().and_then(|at| paint::nearest(&panel, &shown.view, at, REACH));
        if let Some(mark) = hit.and_then(|hit| panel.marks.iter().find(|mark| mark.tag == hit.tag && hit.tag.0 > 0)) {
            widgets::read_at_pointer(&shown.response, std::slice::from_ref(&mark.name));
        }
    }
    let list = list.with_min_y(list.top() + UNIT);
    if let Some(camera) = ranking(ui, list, ranked, &names, context) {
        context.view.recorded.camera = Some(camera);
    }
}

fn words(
    ui: &mut Ui,
    body: Rect,
    file: &RecordedFile,
    (name, fit, rank): (&str, &RecordedFit, RankRange),
    names: &[String],
    context: &PaneContext<'_>,
) -> f32 {
    let mut child = widgets::clipped(ui, "recorded words", body);
    child.spacing_mut().item_spacing.y = 0.0;
    let percent = |log: f64| fixed(log * 100.0, 2);
    let left = names.len() * 3 - fit.values;
    let left = if left > 0 { format!(", {left} excluded") } else { String::new() };
    let largest = fit.gains.iter().flatten().fold(f64::MIN_POSITIVE, |most: f64, gain| most.max(gain.abs()));
    let decimals = (3.0 - largest.log10().floor()).clamp(0.0, 12.0) as usize;
    let gains = fit.gains.map(|gain| gain.map_or_else(|| "–".to_owned(), |gain| fixed(gain, decimals)));
    let line = format!(
        "{}: {name}, RMS {} % ({} % by the degrees of freedom); {} values{left}; gains {}; {}",
        file.name,
        percent(fit.rms()),
        percent(fit.deviation()),
        fit.values,
        gains.join(", "),
        range_in_words(rank)
    );
    child.add(Label::new(RichText::new(line).small().color(context.theme.weak)).wrap());
    for link in fit.links.iter().filter(|link| link.share >= NOTABLE) {
        let cause = cause_in_words(link.kind, link.amount, names);
        let line = format!("{} % of the squares would be explained by: {cause}", fixed(link.share * 100.0, 0));
        child.add(Label::new(RichText::new(line).small()).wrap());
    }
    child.horizontal_wrapped(|ui| {
        for entry in recorded::legend() {
            let (rect, _) = ui.allocate_exact_size(Vec2::new(16.0, 18.0), Sense::hover());
            paint::key(ui.painter(), rect, &entry, &context.theme);
            ui.add(Label::new(RichText::new(&entry.name).small()).extend());
        }
    });
    (child.min_rect().bottom() + UNIT).min(body.bottom())
}

fn ranking(
    ui: &mut Ui,
    rect: Rect,
    ranked: &[RankedCamera],
    names: &[String],
    context: &mut PaneContext<'_>,
) -> Option<String> {
    let percent = |name: &str| Column { decimals: Some(2), shaded: true, ..Column::in_unit(name, "%") };
    let hint = format!("95 % range by a bootstrap over the patches. {RANK_CAUTION}");
    let rank = Column { hint, ..Column::from("rank") };
    let channels = ["RMS", "red", "green", "blue"].map(percent).into_iter();
    let mut table = Table::new(["camera".into(), rank].into_iter().chain(channels).chain(["worst patch".into()]));
    for (index, camera) in ranked.iter().enumerate() {
        let fit = camera.fit.as_ref();
        let why = fit.err().map_or_else(String::new, ToString::to_string);
        let fit = fit.ok();
        let percent = |log: Option<f64>| Cell::from(log.map(|log| 100.0 * log));
        let worst = fit.and_then(|fit| names.get(fit.worst_patches().first()?.0)).map_or("", String::as_str);
        let channels = fit.map_or([None; 3], RecordedFit::channel_rms).map(percent);
        let range = camera.rank.map(|rank| rank.range).filter(|[first, last]| first < last);
        let rank = Cell::from(fit.map(|_| (index + 1) as f64));
        let rank = rank.with(|note| note.words = range.map(|range| rank_in_words(Some(range))));
        let rest = [rank, percent(fit.map(RecordedFit::rms))].into_iter().chain(channels).chain([Cell::from(worst)]);
        let rest = rest.map(|cell| cell.with(|note| note.hint.clone_from(&why)));
        table.push(std::iter::once(Cell::from(camera.name.as_str())).chain(rest));
    }
    let item = |row: usize| Some(PlotItem::Sensor(SensorId { kind: SetKind::Camera, name: ranked[row].name.clone() }));
    let shown = DataTable::new(PaneKind::RECORDED, "Recorded: cameras", &table).with_items(&item);
    let output = shown.show(ui, rect, context);
    output.clicked.map(|row| ranked[row].name.clone())
}
