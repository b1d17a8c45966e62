//! The diagram and the strip below it.

use chromascope_core::colorimetry::{UvPrime, Xy};
use chromascope_core::light::{CctError, RadiationConstants};
use chromascope_core::query::NearestBlackBodyQuery;
use chromascope_figure::{Shape, TextSize, text_width};
use egui::{Align2, Id, Pos2, Rect, RectAlign, Tooltip, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::action::{Action, SceneAction};
use crate::command::Command;
use crate::document::{Diagram, FIT_TARGET, LOCUS_RANGE_K, SetKind};
use crate::figures::chromaticity::{self, Built};
use crate::figures::look::DifferencePlane;
use crate::figures::strip;
use crate::paint::{self, Emphasis, PlotOptions};
use crate::panes::widgets;
use crate::plot_item::{PickIndex, PlotItem};
use crate::theme::{ROW, UNIT};
use crate::view::DiagramFit;
use crate::workspaces::PaneKind;

const REACH: f32 = 10.0;
const STRIP: f32 = 124.0;
/// Least height of the cameras' differences, and their share of a high pane.
const MULTIPLES: f32 = 151.0;
const MULTIPLES_SHARE: f32 = 0.33;
/// Below this height of the diagram there is no strip.
const WITH_STRIP: f32 = 350.0;
/// Share of a low pane that the cameras' differences take beside the diagram, and its least width and height.
const COLUMN: f32 = 0.42;
const WITH_COLUMN: f32 = 520.0;
const LOW: f32 = 130.0;
const OVERVIEW: Vec2 = Vec2::new(96.0, 104.0);

pub const PANE: Pane = Pane::new(PaneKind::CHROMATICITY, "Chromaticity", show)
    .tab("Diagram")
    .settings(settings)
    .figure(&chromaticity::KIND)
    .under_conditions()
    .table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let body = widgets::pane(ui, &PANE, rect, context, switches);
    let body = body.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    if widgets::figure_numbers(ui, &PANE, body, context) {
        return;
    }
    let body = widgets::lines::caution(ui, body, context);
    let multiples = context.scene.document.overlays.multiples;
    let fits = body.height() >= WITH_STRIP;
    // In a low pane differences stand beside the diagram, which is wider than its data.
    let beside = multiples && !fits && body.width() >= WITH_COLUMN && body.height() >= LOW;
    let cut = if beside {
        Pos2::new(body.right() - (COLUMN * body.width()).round(), body.bottom())
    } else {
        let below = if multiples { (MULTIPLES_SHARE * body.height()).round().max(MULTIPLES) } else { STRIP };
        Pos2::new(body.right(), body.bottom() - if fits { below } else { ROW })
    };
    diagram(ui, Rect::from_min_max(body.min, cut), context);
    let place = if beside { body.with_min_x(cut.x + UNIT) } else { body.with_min_y(cut.y + UNIT) };
    if multiples && (fits || beside) {
        widgets::differences::plots(ui, place, DifferencePlane::UvPrime, context);
    } else if fits {
        show_strip(ui, place, context);
    } else {
        let what = if multiples { "the cameras' differences" } else { "the strip over the temperature" };
        let words = format!("No room for {what}: fill the window (F)");
        let line = body.with_min_y(cut.y);
        let response = ui.interact(line, Id::unique("no room below the diagram"), egui::Sense::click());
        widgets::labeled(&response, egui::Role::Button, &words);
        widgets::lines::elided(ui, line, &words, egui::TextStyle::Small, context.theme.weak);
        if response.clicked() {
            context.push(Command::Maximize(PANE.kind));
        }
    }
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if let Some(diagram) = widgets::choice(ui, context.scene.document.diagram) {
        context.push(Action::Scene(SceneAction::SetDiagram(diagram)));
    }
    ui.add_space(UNIT);
    if let Some(fit) = widgets::choice_of(ui, &DiagramFit::ALL, context.view.saved.diagram_fit) {
        context.view.saved.diagram_fit = fit;
        context.view.reset_plots = true;
        ui.ctx().request_repaint();
    }
}

fn settings(ui: &mut Ui, body: Rect, context: &mut PaneContext<'_>) {
    widgets::scroll(ui, (PaneKind::SETTINGS, "show"), body, context, |ui, context| {
        let before = context.scene.document.overlays;
        let mut overlays = before;
        for (on, words) in overlays.labeled() {
            ui.checkbox(on, words);
        }
        if overlays != before {
            context.push(Action::Scene(SceneAction::SetOverlays(overlays)));
        }
    });
}

fn diagram(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    hold_fit(ui, context);
    let built = chromaticity::build(&context.scene, &context.look(PANE.kind), size);
    let id = Id::unique(("chromaticity", context.scene.document.diagram));
    let shown = plot(ui, id, &built, rect, true, context);
    note_zoom(ui, &built, &shown, context);
    point_at(&built, &shown, context);
    if let Some(lens) = &built.lens {
        let area =
            [lens.panel.area.min, lens.panel.area.max].map(|at| rect.min + Vec2::new(at[0] as f32, at[1] as f32));
        let shown = plot(ui, id.with("lens"), lens, Rect::from_min_max(area[0], area[1]), false, context);
        point_at(lens, &shown, context);
    }
    widgets::walk::along(ui, PaneKind::CHROMATICITY, context, widgets::walk::patches_by_sensor);
    if context.view.diagram.zoomed.is_some() && rect.width() > 420.0 && rect.height() > 240.0 {
        let place = Rect::from_min_size(shown.view.rect.right_top() + Vec2::new(-OVERVIEW.x - 6.0, 6.0), OVERVIEW);
        let size = [f64::from(OVERVIEW.x), f64::from(OVERVIEW.y)];
        let panel = chromaticity::overview(&context.scene, [shown.view.x, shown.view.y], size);
        paint::still(ui.painter(), &panel, &context.theme, place);
    }
    say_refusals(ui, shown.view.rect, &built, context);
}

/// Keeps the shown part of the diagram until a new fit is due.
fn hold_fit(ui: &Ui, context: &mut PaneContext<'_>) {
    let key = chromaticity::fit_key(&context.scene, context.view.saved.diagram_fit);
    let (scene, refit) = (context.scene, context.view.reset_plots);
    let seconds = ui.input(|input| input.time);
    if context.view.diagram.hold(key, refit, seconds, |key| chromaticity::fitted(&scene, key)) {
        ui.ctx().request_repaint();
    }
}

fn plot(
    ui: &mut Ui,
    id: Id,
    built: &Built,
    rect: Rect,
    zoomable: bool,
    context: &mut PaneContext<'_>,
) -> paint::PlotOutput {
    let view = &*context.view;
    let reference = &context.scene.document.reference;
    let emphasis = |tag| view.emphasis_of(&built.things, tag, reference);
    let options = PlotOptions { reset: view.reset_plots, zoomable, emphasis: &emphasis };
    paint::plot(ui, id, &built.panel, &context.theme, rect, options)
}

/// Records the ranges that the user zoomed or panned to: labels, arrows, lens and overview follow in the next frame.
fn note_zoom(ui: &Ui, built: &Built, shown: &paint::PlotOutput, context: &mut PaneContext<'_>) {
    let zoomed = shown.zoomed(&built.panel);
    if zoomed != context.view.diagram.zoomed {
        context.view.diagram.zoomed = zoomed;
        ui.ctx().request_repaint();
    }
}

fn point_at(built: &Built, shown: &paint::PlotOutput, context: &mut PaneContext<'_>) {
    let pointer = shown.response.hover_pos().filter(|at| shown.view.rect.contains(*at));
    let hit = pointer.and_then(|at| paint::nearest(&built.panel, &shown.view, at, REACH));
    let thing = hit.and_then(|hit| thing_at(context, built, &hit));
    context.view.hover(thing.as_ref());
    if shown.response.clicked() {
        context.view.click(thing.as_ref());
    }
    if let Some((thing, at)) = thing.zip(pointer) {
        let is_held = shown.response.ctx.input(|input| input.pointer.any_down());
        if !is_held {
            tooltip(built, shown, at, &chromaticity::brief(&context.scene, &thing));
        }
    } else if let (Some([a, b]), Some(_)) = (shown.hovered, pointer) {
        let diagram = context.scene.document.diagram;
        let [x, y] = chromaticity::coordinates(diagram);
        let color = match diagram {
            Diagram::Xy => Xy { x: a, y: b }.uv_prime(),
            Diagram::UvPrime => Some(UvPrime { u: a, v: b }),
        };
        let nearest = color.and_then(|color| nearest_black_body(color, context));
        let nearest = nearest.map_or_else(String::new, |words| format!("   {words}"));
        context.view.point = Some(format!("{x} {a:.4}  {y} {b:.4}").replace('-', "−") + &nearest);
    }
}

/// Shows lines of text beside the pointer, in the quarter that covers the fewest points and lines.
fn tooltip(built: &Built, shown: &paint::PlotOutput, pointer: Pos2, lines: &[String]) {
    const GAP: f32 = 14.0;
    let widest = lines.iter().map(|line| text_width(line, TextSize::Body)).fold(0.0, f64::max);
    let size = Vec2::new(widest as f32 + 5.0 * UNIT, lines.len() as f32 * 18.0 + 4.0 * UNIT);
    let points =
        built.panel.marks.iter().filter(|mark| mark.tag != PickIndex::NONE).flat_map(|mark| match &mark.shape {
            Shape::Points { points, .. } | Shape::Line { points, .. } => points.as_slice(),
            _ => &[],
        });
    let points: Vec<Pos2> = points.filter(|at| at[0].is_finite()).map(|at| shown.view.at(*at)).collect();
    let screen = shown.response.ctx.content_rect();
    let quarters = [
        (RectAlign::BOTTOM_START, Vec2::new(GAP, GAP), Vec2::ZERO),
        (RectAlign::TOP_START, Vec2::new(GAP, -GAP), Vec2::new(0.0, 1.0)),
        (RectAlign::BOTTOM_END, Vec2::new(-GAP, GAP), Vec2::new(1.0, 0.0)),
        (RectAlign::TOP_END, Vec2::new(-GAP, -GAP), Vec2::splat(1.0)),
    ];
    let cost = |(_, gap, share): &(RectAlign, Vec2, Vec2)| {
        let covered = Rect::from_min_size(pointer + *gap - size * *share, size);
        let outside = if screen.contains_rect(covered) { 0 } else { points.len() + 1 };
        outside + points.iter().filter(|at| covered.contains(**at)).count()
    };
    let Some((align, gap, _)) = quarters.into_iter().min_by_key(cost) else { return };
    let mut tooltip = Tooltip::for_enabled(&shown.response).gap(0.0);
    tooltip.popup = tooltip.popup.at_position(pointer + gap).align(align).align_alternatives(&[]);
    tooltip.show(|ui| widgets::told(ui, lines));
}

/// The correlated color temperature of a color and its distance from that blackbody, for the observer of the diagram; `None`
/// while it is being computed, and for colors without one.
fn nearest_black_body(color: UvPrime, context: &PaneContext<'_>) -> Option<String> {
    let observer = context.scene.sensor(SetKind::Observer, FIT_TARGET).ok()?;
    let query = NearestBlackBodyQuery { observer, constants: RadiationConstants::Paper };
    let shown = context.later.ask(PANE.kind, vec![query]).shown?;
    let cct = (*shown.answer).as_ref().ok()?.cct(color.uv60());
    Some(match cct {
        Ok(cct) => {
            let sign = if cct.duv < 0.0 { "−" } else { "+" };
            format!("CCT {:.0} K, Duv {sign}{:.4} ({FIT_TARGET})", cct.temperature.get(), cct.duv.abs())
        }
        Err(CctError::TooHot) => "CCT above 20000 K".to_owned(),
        Err(CctError::TooCold) => "CCT below 1000 K".to_owned(),
        Err(CctError::TooFar | CctError::NoChromaticity) => return None,
    })
}

/// Replaces a locus line's item with the blackbody nearest to the pointer.
fn thing_at(context: &PaneContext<'_>, built: &Built, hit: &paint::Hit) -> Option<PlotItem> {
    let thing = built.things.get(hit.tag)?.clone();
    let PlotItem::Sensor(source) = &thing else { return Some(thing) };
    let locus = context.scene.locus(source.kind, &source.name).ok()?;
    match locus.points.get(hit.index).filter(|_| built.loci.contains(&hit.mark)) {
        Some(point) => Some(PlotItem::Radiator { source: source.clone(), kelvin: point.temperature.get().round() }),
        None => Some(thing),
    }
}

fn say_refusals(ui: &Ui, rect: Rect, built: &Built, context: &PaneContext<'_>) {
    let theme = context.theme;
    let font = egui::FontId::proportional(crate::theme::SMALL);
    let painter = ui.painter().with_clip_rect(rect);
    for (index, line) in built.refused.iter().rev().enumerate() {
        let at = rect.left_bottom() + Vec2::new(8.0, -8.0 - 16.0 * index as f32);
        painter.text(at, Align2::LEFT_BOTTOM, line, font.clone(), theme.warning);
    }
    if context.scene.sources().iter().all(|source| !source.visible) {
        let font = egui::FontId::proportional(crate::theme::HEADING);
        painter.text(rect.center(), Align2::CENTER_CENTER, "Add a camera at the left.", font, theme.text);
    }
}

fn show_strip(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let size = [f64::from(rect.width()), f64::from(rect.height())];
    let Some(built) = strip::build(&context.scene, size) else {
        let font = egui::FontId::proportional(crate::theme::SMALL);
        let words = "No sensor here can be compared with the reference under this color transform.";
        ui.painter().text(rect.center(), Align2::CENTER_CENTER, words, font, context.theme.weak);
        return;
    };
    let reference = context.scene.document.reference.clone();
    let shown = {
        let view = &*context.view;
        let emphasis = |tag| match view.emphasis_of(&built.things, tag, &reference) {
            // A line of one color needs no ring to be found again.
            Emphasis::Hovered if tag == PickIndex::NONE => Emphasis::Normal,
            emphasis => emphasis,
        };
        let options = PlotOptions { zoomable: false, emphasis: &emphasis, ..PlotOptions::default() };
        paint::plot(ui, Id::unique("strip"), &built.panel, &context.theme, rect, options)
    };
    let response = ui.interact(shown.view.rect, Id::unique("strip slider"), egui::Sense::click_and_drag());
    let now = context.scene.document.temperature_k;
    response.widget_info(|| egui::WidgetInfo::slider(true, now, "Temperature, over the distances"));
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged() || response.clicked()) {
        let [low, high] = LOCUS_RANGE_K;
        set_temperature(strip::kelvin(shown.view.value(at)[0]).clamp(low, high), context);
    }
    if response.has_focus() {
        let step = ui.input(|input| {
            i32::from(input.key_pressed(egui::Key::ArrowRight)) - i32::from(input.key_pressed(egui::Key::ArrowLeft))
        });
        if step != 0 {
            set_temperature(1e6 / (1e6 / now - 2.0 * f64::from(step)), context);
        }
    }
    if let Some(at) = response.hover_pos() {
        let hit = paint::nearest(&built.panel, &shown.view, at, REACH);
        let thing = hit.and_then(|hit| built.things.get(hit.tag)).cloned();
        context.view.hover(thing.as_ref());
        let kelvin = (strip::kelvin(shown.view.value(at)[0]) / 10.0).round() * 10.0;
        let mut lines = vec![format!("{kelvin:.0} K")];
        for source in context.scene.sources().iter().filter(|source| source.visible && !source.is_reference) {
            let id = crate::plot_item::SensorId { kind: source.kind, name: source.name.clone() };
            if let Some(distance) = chromaticity::blackbody_distance(&context.scene, &id, kelvin) {
                let below = context.scene.extrapolated_below(id.kind, &id.name);
                let mark = if below.is_some_and(|(below, _)| kelvin < below) { " (extrapolated)" } else { "" };
                lines.push(format!("{}: {distance}{mark}", source.label));
            }
        }
        if !response.is_pointer_button_down_on() {
            let line = Rect::from_x_y_ranges(at.x..=at.x, rect.y_range());
            widgets::read_beside(&response, line, [RectAlign::TOP, RectAlign::BOTTOM], &lines);
        }
    }
}

fn set_temperature(kelvin: f64, context: &mut PaneContext<'_>) {
    let kelvin = (kelvin / 10.0).round() * 10.0;
    context.push(Action::Scene(SceneAction::SetTemperature(kelvin)));
}
