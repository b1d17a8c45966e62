//! Run time against error: of the visible scene, or of the program on benchmark workloads.

use std::time::Duration;

use chromascope_figure::LegendEntry;
use chromascope_measure::Workload;
use egui::{Id, Label, Rect, RichText, ScrollArea, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::command::Command;
use crate::figures::accuracy;
use crate::paint::{self, PlotOptions};
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::profiler::{BUILD, bench};
use crate::profiler::{Profiler, SceneRunJob, Subject};
use crate::theme::UNIT;
use crate::view::Shows;
use crate::workspaces::PaneKind;

const REACH: f32 = 10.0;
/// A panel of the bench is at least so large; a wider pane has two side by side.
const PANEL: Vec2 = Vec2::new(420.0, 280.0);

const KEY: Vec2 = Vec2::new(16.0, 18.0);
const MARKS: &str = "Filled markers, joined by the dashed line: no other method is both faster and more accurate.";
const BENCH: &str = "The program's methods on standard inputs, independent of the scene, against reference values \
                     computed by another method or with twice the digits. Point at a marker for its values.";

pub const PANE: Pane = Pane::new(PaneKind::METHODS, "Methods", show).figure(&accuracy::KIND).table();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    refresh(context);
    let body = widgets::body(ui, &PANE, rect, context, switches);
    if let Some(why) = Profiler::failure(context.later) {
        failed(ui, body, &why, context);
        return;
    }
    match context.view.shows {
        Shows::Scene(subject) => scene(ui, body, subject, context),
        Shows::Bench(workload) => benchmark(ui, body, workload, context),
    }
}

fn refresh(context: &mut PaneContext<'_>) {
    let own = context.meshes.chosen(&context.scene.document.render.mesh);
    let scene = SceneRunJob::of(&context.scene, own.as_ref(), context.view.saved.render.orbit);
    context.profiler.refresh(context.later, &scene);
}

fn scene(ui: &mut Ui, body: Rect, subject: Subject, context: &mut PaneContext<'_>) {
    let Some(run) = context.profiler.measured.run.clone() else {
        nothing(ui, body, "Nothing measured yet.", context);
        return;
    };
    let Some(trial) = accuracy::trial(&run, subject) else {
        let words = match subject {
            Subject::Integral => {
                "No sample needs a spectral integral: nothing is rendered, or every surface is \
                                  Lambertian."
            }
            Subject::Loci => "No sensor is visible. Add a camera in Compare.",
        };
        nothing(ui, body, words, context);
        return;
    };
    if widgets::numbers(ui, &PANE, body, context, |_| Some(accuracy::table(trial))) {
        return;
    }
    let words = run.conditions.of(trial);
    let about = format!("{} {MARKS} {}", subject.explained(), run.conditions.on());
    let body = above(ui, body, [&words, &about], &accuracy::legend(trial), context);
    let size = [f64::from(body.width()), f64::from(body.height())];
    let panel = accuracy::panel(trial, context.profiler.measured.is_current, size);
    let options = PlotOptions { zoomable: true, reset: context.view.reset_plots, ..PlotOptions::default() };
    let id = Id::unique(("run time against error", subject.title()));
    let shown = paint::plot(ui, id, &panel, &context.theme, body, options);
    context.view.note_zoom(PaneKind::METHODS, accuracy::title(subject), shown.zoomed(&panel));
    widgets::labeled(&shown.response, egui::Role::Canvas, format!("Run time against error: {}", subject.title()));
    let hit = shown.response.hover_pos().and_then(|at| paint::nearest(&panel, &shown.view, at, REACH));
    if let Some(point) = hit.and_then(|hit| accuracy::point(trial, hit.tag)) {
        let lines = accuracy::describe(trial, point);
        context.view.point = Some(lines.join("  "));
        widgets::read_at_pointer(&shown.response, &lines);
    }
}

fn benchmark(ui: &mut Ui, body: Rect, workload: Workload, context: &mut PaneContext<'_>) {
    let report = match context.profiler.measured.reports.get(&workload).map(AsRef::as_ref) {
        None if bench().is_none() => {
            let mut child = widgets::middle(ui, "no benchmark", body, Vec2::new(420.0, 96.0));
            child.label("This build has no benchmark. To have it, build and run with:");
            child.monospace(BUILD);
            return;
        }
        None => {
            nothing(ui, body, "Nothing measured yet.", context);
            return;
        }
        Some(Err(why)) => {
            let why = why.clone();
            failed(ui, body, &why, context);
            return;
        }
        Some(Ok(report)) => report.clone(),
    };
    let Some(figure) = report.figure(workload) else {
        nothing(ui, body, "No measurement was completed.", context);
        return;
    };
    if widgets::numbers(ui, &PANE, body, context, |_| Some(figure.table.clone())) {
        return;
    }
    let words = format!("{}; {}", workload.label(), report.machine.identity());
    let about = format!("{BENCH} {MARKS} Measured on: {}; {}, {}.", report.machine, report.program, report.began);
    let body = above(ui, body, [&words, &about], &figure.legend, context);
    let mut child = widgets::clipped(ui, "bench", body);
    ScrollArea::vertical().id_salt(workload.key()).auto_shrink(false).show(&mut child, |ui| {
        let across = ((body.width() / PANEL.x).floor() as usize).clamp(1, figure.panels.len());
        let down = figure.panels.len().div_ceil(across);
        let each =
            Vec2::new(body.width() / across as f32, (body.height() / down as f32).max(PANEL.y.min(body.height())));
        let (area, _) = ui.allocate_exact_size(Vec2::new(body.width(), each.y * down as f32), egui::Sense::hover());
        let size = each - Vec2::splat(UNIT);
        let panels = report.panels(workload, [size.x, size.y].map(f64::from));
        for (index, panel) in panels.iter().enumerate() {
            let corner = Vec2::new((index % across) as f32 * each.x, (index / across) as f32 * each.y);
            let place = Rect::from_min_size(area.min + corner, size);
            let options = PlotOptions { zoomable: false, reset: context.view.reset_plots, ..PlotOptions::default() };
            let id = Id::unique(("bench", workload.key(), index));
            let shown = paint::plot(ui, id, panel, &context.theme, place, options);
            let hit = shown.response.hover_pos().and_then(|at| paint::nearest(panel, &shown.view, at, REACH));
            let method = hit.and_then(|hit| report.of(workload).nth((hit.tag.0 as usize).checked_sub(1)?));
            if let Some(method) = method {
                let lines = accuracy::describe_measurement(method);
                context.view.point = Some(lines.join("  "));
                widgets::read_at_pointer(&shown.response, &lines);
            }
        }
    });
}

fn above(
    ui: &mut Ui,
    body: Rect,
    [words, about]: [&str; 2],
    legend: &[LegendEntry],
    context: &PaneContext<'_>,
) -> Rect {
    let theme = context.theme;
    let mut child = widgets::clipped(ui, "what is measured", body);
    child.spacing_mut().item_spacing.y = 0.0;
    child.spacing_mut().interact_size.y = KEY.y;
    child.add(Label::new(RichText::new(words).small().color(theme.weak)).wrap());
    child.horizontal_wrapped(|ui| {
        for entry in legend {
            ui.horizontal(|ui| {
                let (rect, _) = ui.allocate_exact_size(KEY, egui::Sense::hover());
                paint::key(ui.painter(), rect, entry, &theme);
                ui.add(Label::new(RichText::new(&entry.name).small()).extend());
            });
        }
        let what = RichText::new("What is this?").small().underline().color(theme.weak);
        ui.add(Label::new(what).extend()).on_hover_text(about);
    });
    let top = (child.min_rect().bottom() + UNIT).min(body.bottom());
    body.with_min_y(top)
}

fn switches(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.view.shows;
    run(ui, now, context);
    ui.add_space(UNIT);
    let choices = Subject::ALL.map(|subject| (Shows::Scene(subject), subject.title(), subject.words()));
    let mut chosen = widgets::segmented(ui, &choices, now);
    let words = if let Shows::Bench(workload) = now { workload.key() } else { "Bench" };
    let hint = ("Workload of the bench", "The program's methods on standard inputs, independent of the scene");
    let line = |workload: Workload| {
        let line = Line::new(workload.key(), now == Shows::Bench(workload));
        Line { also: workload.label().to_owned(), ..line }
    };
    let index =
        pick_list::drop_down(ui, hint, words, 96.0, &context.theme, || Workload::ALL.into_iter().map(line).collect());
    chosen = index.and_then(|index| Workload::ALL.into_iter().nth(index)).map(Shows::Bench).or(chosen);
    if let Some(shows) = chosen {
        context.view.shows = shows;
        ui.ctx().request_repaint();
    }
}

fn run(ui: &mut Ui, now: Shows, context: &mut PaneContext<'_>) {
    if let Some(busy) = Profiler::busy(context.later) {
        context.button(ui, "Stop", "Stop measuring (Esc). Earlier results are unchanged.", Command::StopMeasuring);
        let words = format!("measuring, {:.0} s…", busy.as_secs_f64());
        widgets::note(ui, words);
        ui.ctx().request_repaint_after(Duration::from_millis(100));
        return;
    }
    if matches!(now, Shows::Bench(_)) && bench().is_none() {
        return;
    }
    let again = is_measured(context);
    // Before anything is measured the button is in the middle, where the numbers will be.
    if again || Profiler::failure(context.later).is_some() {
        let hint = "Measures the methods on this scene. Takes a few seconds.";
        context.button(ui, if again { "Run again" } else { "Run" }, hint, measure(now));
    }
}

fn is_measured(context: &PaneContext<'_>) -> bool {
    match context.view.shows {
        Shows::Scene(_) => context.profiler.measured.run.is_some(),
        Shows::Bench(workload) => context.profiler.measured.reports.contains_key(&workload),
    }
}

fn measure(shows: Shows) -> Command {
    match shows {
        Shows::Scene(_) => Command::MeasureScene,
        Shows::Bench(workload) => Command::MeasureWorkload(workload),
    }
}

fn nothing(ui: &mut Ui, body: Rect, words: &str, context: &mut PaneContext<'_>) {
    let mut child = widgets::middle(ui, "nothing measured", body, Vec2::new(420.0, 64.0));
    child.label(words);
    if Profiler::busy(context.later).is_some() {
        child.label("Measuring…");
    } else if !is_measured(context) {
        let command = measure(context.view.shows);
        context.button(&mut child, "Run", "Measures the methods. Takes a few seconds.", command);
    }
}

fn failed(ui: &Ui, body: Rect, why: &str, context: &PaneContext<'_>) {
    widgets::say(ui, body, format!("Nothing measured: {why}."), context.theme.error);
}
