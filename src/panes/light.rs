//! The light judged: its temperature, rendition indices and color vectors, and how consistent each camera is under it.

use std::sync::Arc;

use chromascope_core::light::temperature::MAX_DUV;
use chromascope_core::query::Rendition;
use chromascope_figure::{Cell, Rect as Area, Table};
use egui::{Rect, Sense, Ui, UiBuilder, Vec2};

use super::context::{Pane, PaneContext};
use crate::document::SetKind;
use crate::figures::light;
use crate::format::{fixed, sentence, signed};
use crate::jobs::Shown;
use crate::paint;
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::panes::widgets::table::DataTable;
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;
use crate::scene::light::LightSheetQuery;
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane = Pane::new(PaneKind::LIGHT, "Light", show).figure(&light::KIND).under_conditions().table();

const LIST: f32 = 220.0;
/// Minimum width for bars and vectors side by side.
const WIDE: f32 = 520.0;
const BARS: f32 = 150.0;
const VECTORS: f32 = 250.0;

#[derive(Default)]
struct SimilarTo(Option<String>);

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, |_, _| {});
    let scene = context.scene;
    let mut child = ui.new_child(UiBuilder::new().id_salt("light").max_rect(body.shrink2(Vec2::new(2.0 * UNIT, 0.0))));
    let failed = |ui: &mut Ui, why: &str| {
        ui.colored_label(context.theme.warning, sentence(why));
    };
    let query = scene.light_sheet_query().map_err(|error| error.to_string());
    let shown = match query.and_then(|query| context.later.ask(PANE.kind, vec![query]).last()) {
        Ok(Some(shown)) => shown,
        Ok(None) => {
            child.weak("computing…");
            return;
        }
        Err(why) => return failed(&mut child, &why),
    };
    let rendition = match &shown.answer.rendition {
        Ok(rendition) => Arc::clone(rendition),
        Err(error) => return failed(&mut child, &error.to_string()),
    };
    if shown.current && widgets::numbers(ui, &PANE, body, context, |_| Some(light::table(&scene, &rendition))) {
        return;
    }
    widgets::scroll(ui, (PANE.kind, "light"), body, context, |ui, context| {
        summary(ui, &scene, &rendition, context);
        similarity(ui, &scene, context);
        pictures(ui, &rendition, context);
        cameras(ui, &scene, &shown, context);
    });
}

/// The numbers in a few lines, and the reasons for those that there are not.
fn summary(ui: &mut Ui, scene: &Scene<'_>, rendition: &Rendition, context: &PaneContext<'_>) {
    let mut reasons: Vec<String> = Vec::new();
    let mut reason = |what: &str, error: String| reasons.push(sentence(&format!("no {what}: {error}")));
    ui.strong(scene.light_name());
    match scene.light_temperature() {
        Ok(Ok(cct)) => {
            let words = format!("CCT {} K   Duv {}", fixed(cct.temperature.get(), 0), signed(cct.duv));
            ui.label(words)
                .on_hover_text("Nearest blackbody for CIE 1931 2°, 380–780 nm; Duv is positive above the locus");
        }
        Ok(Err(error)) => reason("CCT", error.to_string()),
        Err(error) => reason("CCT", error.to_string()),
    }
    let mut words = Vec::new();
    match &rendition.rendering {
        Ok(indices) => words.push(format!("Ra {}", fixed(indices.general, 1))),
        Err(error) => reason("Ra", error.to_string()),
    }
    match &rendition.fidelity {
        Ok(fidelity) => {
            words.push(format!("Rf {}   Rg {}", fixed(fidelity.fidelity, 1), fixed(fidelity.gamut, 1)));
        }
        Err(error) => reason("Rf and Rg", error.to_string()),
    }
    match &rendition.similarity {
        Ok(similarity) => words.push(format!("SSI {}", fixed(*similarity, 0))),
        Err(error) => reason("SSI", error.to_string()),
    }
    if !words.is_empty() {
        let hint = "Ra: CIE 13.3. Rf, Rg: ANSI/IES TM-30, CIE 224. SSI: SMPTE ST 2122, to a blackbody below 4000 K and \
                    daylight from there on, at the light's temperature.";
        ui.label(words.join("   ")).on_hover_text(hint);
    }
    for note in scene.rendition_cautions(rendition).unwrap_or_default() {
        widgets::note(ui, sentence(&note));
    }
    reasons.dedup();
    for reason in reasons {
        let hint = format!("A color temperature is defined up to Duv \u{b1}{MAX_DUV}, indices for white lights only.");
        ui.colored_label(context.theme.warning, reason).on_hover_text(hint);
    }
}

fn similarity(ui: &mut Ui, scene: &Scene<'_>, context: &mut PaneContext<'_>) {
    let now = context.states.of::<SimilarTo>().0.clone();
    ui.horizontal(|ui| {
        ui.label("SSI to");
        let hint = (
            "Light of the similarity index",
            "A light that SSI is taken to, beside the reference at the light's temperature",
        );
        let mut names = vec![None];
        let lines = || {
            names.extend(scene.entries(SetKind::Illuminant).map(|entry| Some(entry.name)));
            names.iter().map(|name| Line::new(name.as_deref().unwrap_or("None"), *name == now)).collect()
        };
        let shown = now.as_deref().unwrap_or("None");
        if let Some(index) = pick_list::drop_down(ui, hint, shown, LIST, &context.theme, lines) {
            context.states.of::<SimilarTo>().0 = names.swap_remove(index);
        }
        let Some(name) = &now else { return };
        match scene.similarity_to(name) {
            Ok(Ok(value)) => ui.label(fixed(value, 0)),
            Ok(Err(error)) => ui.colored_label(context.theme.warning, sentence(&error.to_string())),
            Err(error) => ui.colored_label(context.theme.warning, sentence(&error.to_string())),
        };
    });
}

fn pictures(ui: &mut Ui, rendition: &Rendition, context: &PaneContext<'_>) {
    let width = ui.available_width();
    let wide = width >= WIDE;
    let across = |share: f32| if wide { share * width } else { width };
    let sizes = [Vec2::new(across(0.55), if wide { VECTORS } else { BARS }), Vec2::new(across(0.45), VECTORS)];
    let area = |size: Vec2| Area::from_min_size([0.0; 2], [size.x, size.y].map(f64::from));
    let panels = [light::bars(rendition, area(sizes[0])), light::vectors(rendition, area(sizes[1]))];
    let total = if wide { Vec2::new(width, VECTORS) } else { Vec2::new(width, BARS + VECTORS) };
    if panels.iter().all(Option::is_none) {
        return;
    }
    let (rect, response) = ui.allocate_exact_size(total, Sense::hover());
    widgets::labeled(&response, egui::Role::Image, "Color rendering indices as bars, and color vectors");
    let below = if wide { Vec2::new(sizes[0].x, 0.0) } else { Vec2::new(0.0, BARS) };
    let places = [Rect::from_min_size(rect.min, sizes[0]), Rect::from_min_size(rect.min + below, sizes[1])];
    for (panel, place) in panels.iter().zip(places) {
        if let Some(panel) = panel {
            paint::still(ui.painter(), panel, &context.theme, place);
        }
    }
}

/// Differences of each compared camera between this light and its reference illuminant.
fn cameras(ui: &mut Ui, scene: &Scene<'_>, shown: &Shown<LightSheetQuery>, context: &mut PaneContext<'_>) {
    let (cameras, found) = (&shown.job.cameras, &shown.answer.cameras);
    if cameras.is_empty() {
        return;
    }
    ui.add_space(UNIT);
    ui.strong("Cameras: ΔE*00 to the reference illuminant").on_hover_text(
        "The patches under this light against those under its reference illuminant, through the camera balanced to each \
         and corrected by one matrix, fitted under the reference illuminant.",
    );
    let names = scene.patches().map(|set| set.patches().iter().map(|patch| patch.name.clone()).collect::<Vec<_>>());
    let names = names.unwrap_or_default();
    let mut table = Table::new(["camera", "mean", "95 %", "max", "worst patch"]);
    for column in &mut table.columns {
        column.decimals = Some(2);
    }
    for ((label, _), found) in cameras.iter().zip(found) {
        let why = found.as_ref().err().map_or_else(String::new, |error| sentence(&error.to_string()));
        let found = found.as_ref().ok();
        let numbers = [found.map(|f| f.mean), found.map(|f| f.percentile_95), found.map(|f| f.max)].map(Cell::from);
        // No patch is the worst of equal ones.
        let worst = found
            .filter(|found| found.max >= 0.005)
            .and_then(|found| names.get(found.worst))
            .map_or("", String::as_str);
        let cells = std::iter::once(Cell::from(label.as_str())).chain(numbers).chain([Cell::from(worst)]);
        table.push(cells.map(|cell| if why.is_empty() { cell } else { cell.with(|note| note.hint.clone_from(&why)) }));
    }
    let sources = scene.sources();
    let item = |row: usize| {
        let source = sources.iter().find(|source| source.kind == SetKind::Camera && source.label == cameras[row].0)?;
        Some(PlotItem::Sensor(SensorId { kind: source.kind, name: source.name.clone() }))
    };
    let shown = DataTable::new(PANE.kind, "consistency", &table);
    let top = ui.cursor().top();
    if let Some(row) = shown.with_items(&item).show_compact(ui, context).clicked {
        context.view.click(item(row).as_ref());
    }
    if widgets::walk::along(ui, PANE.kind, context, |_| {
        (0..cameras.len()).map(|row| item(row).into_iter().collect()).collect()
    }) {
        ui.scroll_to_rect(Rect::from_x_y_ranges(ui.max_rect().x_range(), top..=ui.cursor().top()), None);
    }
}
