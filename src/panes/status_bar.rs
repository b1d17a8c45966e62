//! The foot of the window: at the left the reading under the pointer; at the right the last message, else how the numbers came
//! about.

use std::time::Duration;

use chromascope_core::camera::LocusMethod;
use chromascope_core::render::QualityLevel;
use egui::{Align, Button, Color32, Layout, Rect, TextStyle, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use crate::action::{Action, ImportedAction};
use crate::catalog::opened::Progress;
use crate::command::Command;
use crate::document::SetKind;
use crate::figures::chromaticity;
use crate::figures::render::image_words;
use crate::format::{file_name, fixed};
use crate::jobs::{PATIENCE, Waiting};
use crate::panes::widgets::{self, lines, pick_list};
use crate::plot_item::{PlotItem, SensorId};
use crate::render_service::made::MadePictures;
use crate::report::{Report, ReportJob};
use crate::scene::metrics::Ranking;
use crate::theme::UNIT;
use crate::view::{Offer, Status, Weight};
use crate::workspaces::{Arrangement, PaneKind};

const READY: &str = "Ready. Drop a spectrum or camera file anywhere.";
const LONG: Duration = Duration::from_millis(500);
/// Share of the bar that readings have; messages and facts have the rest, so that neither moves the other. A longer message takes
/// the room of readings while there is none.
const READINGS: f32 = 0.62;
/// Seconds that a message is shown; warnings and errors stay until Esc or the next message.
const MESSAGE: f64 = 6.0;
/// Seconds of those in which it fades.
const FADE: f64 = 0.5;
const FRAME: Duration = Duration::from_millis(100);
const FACTS: &str = "Computation time of the last change; largest error of the visible loci, relative to the largest \
                     signal and checked against sums at 1 nm; number of cameras computed. What is not visible is not \
                     computed.";
const RENDER_FACTS: &str = "Time of the last rendering stage; error of integrals over wavelength, relative to the \
                            brightest pixel; number of cameras rendered. What is not visible is not computed.";

pub fn show(ui: &mut Ui, rect: Rect, arrangement: &Arrangement, context: &mut PaneContext<'_>) {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let half = READINGS * inner.width();
    let is_idle = context.view.point.is_none() && context.view.hovered.is_none();
    let lacks = if is_idle { (message_width(ui, context) - (inner.width() - half - 2.0 * UNIT)).max(0.0) } else { 0.0 };
    let cut = (inner.left() + (half - lacks).max(0.0)).round();
    reading(ui, inner.with_max_x(cut - 2.0 * UNIT), context);
    let right = inner.with_min_x(cut + 2.0 * UNIT);
    if !message(ui, right, context) {
        show_facts(ui, right, arrangement, context);
    }
}

/// Value or name of what is under the pointer, else an invitation.
fn reading(ui: &mut Ui, rect: Rect, context: &PaneContext<'_>) {
    let view = &*context.view;
    let hovered = || view.hovered.as_ref().map(|thing| describe(thing, context));
    let idle = selection(context).unwrap_or_else(|| READY.to_owned());
    let fits = rect.width() >= lines::width(ui, &idle, TextStyle::Body);
    let words = view.point.clone().or_else(hovered).or_else(|| fits.then_some(idle));
    let Some(words) = words else { return };
    let cut = lines::elided(ui, rect, &words, TextStyle::Body, context.theme.text);
    let response = widgets::named(ui, rect, ui.scope_id().with("reading"), egui::Role::Label, &words);
    if cut {
        response.on_hover_text(words);
    }
}

fn selection(context: &PaneContext<'_>) -> Option<String> {
    let selected = context.view.selected.as_ref().filter(|_| !context.view.selected_elsewhere)?;
    let name = chromaticity::brief(&context.scene, selected).into_iter().next()?;
    Some(format!("{name} selected; Esc shows all"))
}

fn show_facts(ui: &mut Ui, rect: Rect, arrangement: &Arrangement, context: &PaneContext<'_>) {
    let words = facts(arrangement, context).join("   ");
    let width = lines::right_aligned(ui, rect, &words, TextStyle::Small, context.theme.weak);
    let (place, id) = (rect.with_min_x(rect.right() - width), ui.scope_id().with("facts"));
    let response = widgets::named(ui, place, id, egui::Role::Label, &words);
    let shows_pictures = arrangement.shows(PaneKind::RENDER);
    let is_of_pictures = shows_pictures && context.render_service.frame().is_some();
    response.on_hover_text(if is_of_pictures { RENDER_FACTS } else { FACTS });
}

/// The files being read, else the last message while it lasts. Returns whether there is one.
fn message(ui: &mut Ui, mut rect: Rect, context: &mut PaneContext<'_>) -> bool {
    let theme = context.theme;
    if let Some(progress) = context.opened.progress() {
        if progress.time >= PATIENCE {
            file_progress(ui, rect, &progress, context);
            return true;
        }
        ui.ctx().request_repaint_after(PATIENCE);
    }
    let report = context.later.seen::<ReportJob>(Report::NAME);
    if report.busy.is_some() {
        report_progress(ui, rect, &report, context);
        return true;
    }
    let opacity = remaining(ui, rect, context);
    let status = context.view.status.clone();
    if status.text.is_empty() {
        return false;
    }
    let color = match status.weight {
        Weight::Note => theme.text.gamma_multiply(opacity),
        Weight::Warning => theme.warning,
        Weight::Error => theme.error,
    };
    if status.weight != Weight::Note {
        lines::warning_mark(ui.painter(), egui::pos2(rect.left() + 7.0, rect.center().y), color);
        rect.min.x += 5.0 * UNIT;
    }
    line(ui, rect, &status.text, color, &buttons(&status), context);
    true
}

/// A button behind a message: its title, its tooltip, what it does.
type LineButton = (String, String, Press);

enum Press {
    Run(Command),
    /// Takes one of the message's offers; the first has the keyboard.
    Take(Vec<Offer>),
}

fn buttons(status: &Status) -> Vec<LineButton> {
    const LEAVES: &str = "Enter does it, Esc leaves it: until then nothing changes";
    let offers = match status.offers.as_slice() {
        [] => None,
        [one] => Some((offered(one, true), LEAVES)),
        [Offer::Open(_), ..] => Some(("Open…".to_owned(), LEAVES)),
        _ => Some(("Use as…".to_owned(), LEAVES)),
    };
    let offers = offers.map(|(title, hint)| (title, hint.to_owned(), Press::Take(status.offers.clone())));
    let change = status.change.clone().map(|(item, line)| {
        let (title, hint) = if status.weight == Weight::Error {
            ("Show line", "Show the text where reading failed")
        } else {
            ("Change", "Check and correct how the file was read")
        };
        (title.to_owned(), hint.to_owned(), Press::Run(Command::ShowImport(item, line)))
    });
    offers.into_iter().chain(change).collect()
}

fn offered(offer: &Offer, is_alone: bool) -> String {
    match offer {
        Offer::Open(path) => format!("Open {}", file_name(path)),
        Offer::Use(kind, _) if is_alone => {
            kind.used_as().map_or_else(|| "Compare camera".to_owned(), |used| format!("Use as {used}"))
        }
        Offer::Use(kind, name) => ImportedAction::Use(*kind, name.clone()).name(),
    }
}

/// Takes an offer; the others of its message stay.
fn take(offer: &Offer, context: &mut PaneContext<'_>) {
    let mut left = std::mem::take(&mut context.view.status.offers);
    left.retain(|other| other != offer);
    context.view.say(match offer {
        Offer::Use(..) => format!("{}: done. Ctrl+Z undoes this.", offered(offer, false)),
        Offer::Open(_) => String::new(),
    });
    context.view.offer(left, true);
    context.push(match offer {
        Offer::Use(kind, name) => Command::Do(Action::Imported(ImportedAction::Use(*kind, name.clone()))),
        Offer::Open(path) => Command::OpenPath(path.clone()),
    });
}

fn message_width(ui: &Ui, context: &PaneContext<'_>) -> f32 {
    let status = &context.view.status;
    if status.text.is_empty() {
        return 0.0;
    }
    let mark = if status.weight == Weight::Note { 0.0 } else { 5.0 * UNIT };
    let buttons: f32 = buttons(status).iter().map(|(title, ..)| button_width(ui, title) + UNIT).sum();
    mark + lines::width(ui, &status.text, TextStyle::Body).ceil() + 1.0 + buttons
}

fn button_width(ui: &Ui, title: &str) -> f32 {
    lines::width(ui, title, TextStyle::Button).ceil() + 2.0 * ui.spacing().button_padding.x
}

/// Opacity of the message by egui's time; one whose time is over is cleared. Under the pointer it stays.
fn remaining(ui: &Ui, rect: Rect, context: &mut PaneContext<'_>) -> f32 {
    let status = &mut context.view.status;
    if status.text.is_empty() || status.weight != Weight::Note || !status.offers.is_empty() {
        return 1.0;
    }
    let now = ui.input(|input| input.time);
    if ui.rect_contains_pointer(rect) {
        status.since = Some(now);
    }
    let left = MESSAGE - (now - *status.since.get_or_insert(now));
    if left <= 0.0 {
        *status = Status::default();
        return 0.0;
    }
    if left > FADE {
        ui.ctx().request_repaint_after(Duration::from_secs_f64(left - FADE));
        return 1.0;
    }
    ui.ctx().request_repaint_after(FRAME);
    (left / FADE) as f32
}

/// One line, with buttons behind it where something can be done about it.
fn line(
    ui: &mut Ui,
    mut rect: Rect,
    words: &str,
    color: Color32,
    buttons: &[LineButton],
    context: &mut PaneContext<'_>,
) {
    if !buttons.is_empty() {
        let width: f32 = buttons.iter().map(|(title, ..)| button_width(ui, title) + UNIT).sum();
        rect.max.x -= width;
        let wrap = Some(egui::TextWrapMode::Truncate);
        let galley = egui::WidgetText::from(words).into_galley(ui, wrap, rect.width().max(0.0), TextStyle::Body);
        let left = (rect.left() + galley.size().x).min(rect.right()) + UNIT;
        let place = Rect::from_min_size(egui::pos2(left, rect.top() + 1.0), Vec2::new(width, rect.height() - 2.0));
        let layout = Layout::left_to_right(Align::Center);
        // The keyboard stays on a button when another workspace is shown.
        let id = egui::Id::unique("buttons of the message");
        let mut child = ui.new_child(UiBuilder::new().scope_id(id).max_rect(place).layout(layout));
        child.spacing_mut().item_spacing.x = UNIT;
        child.spacing_mut().button_padding.y = 0.0;
        child.spacing_mut().interact_size.y = place.height();
        for (title, hint, press) in buttons {
            button(&mut child, (title, hint), press, context);
        }
    }
    let cut = lines::elided(ui, rect, words, TextStyle::Body, color);
    let response = widgets::named(ui, rect, ui.scope_id().with("message"), egui::Role::Status, words);
    if cut {
        response.on_hover_text(words);
    }
}

fn button(ui: &mut Ui, (title, hint): (&str, &str), press: &Press, context: &mut PaneContext<'_>) {
    let response = match press {
        Press::Take(offers) if offers.len() > 1 => {
            let choices = || offers.iter().map(|offer| pick_list::Line::new(offered(offer, false), false)).collect();
            let (response, chosen) = pick_list::menu(ui, (title, "offers", hint), &context.theme, choices);
            if let Some(index) = chosen {
                take(&offers[index], context);
            }
            response
        }
        _ => ui.add(Button::new(title)).on_hover_text(hint),
    };
    match press {
        Press::Run(command) if response.clicked() => context.push(command.clone()),
        Press::Take(offers) => {
            if std::mem::take(&mut context.view.status.takes_keyboard) && !ui.ctx().text_edit_focused() {
                response.request_focus();
                ui.data_mut(|data| data.insert_temp(egui::Id::unique("offer"), response.id));
            }
            if let ([one], true) = (offers.as_slice(), response.clicked()) {
                take(one, context);
            }
        }
        Press::Run(_) => {}
    }
}

fn file_progress(ui: &mut Ui, rect: Rect, progress: &Progress, context: &mut PaneContext<'_>) {
    ui.ctx().request_repaint_after(Duration::from_millis(50));
    let words = progress_words(progress);
    let stop =
        ("Stop".to_owned(), "Stop reading; nothing is changed (Esc)".to_owned(), Press::Run(Command::StopReading));
    line(ui, rect, &words, context.theme.text, &[stop], context);
}

fn report_progress(ui: &mut Ui, rect: Rect, report: &Waiting<ReportJob>, context: &mut PaneContext<'_>) {
    let name = report.stages.first().map_or_else(String::new, |job| job.report.name(report.done));
    let words = format!("Report: {name}, {} of {}", report.done + 1, report.stages.len());
    let hint = "Stop the report; the files so far stay (Esc)".to_owned();
    line(ui, rect, &words, context.theme.text, &[("Stop".to_owned(), hint, Press::Run(Command::StopReport))], context);
}

fn progress_words(progress: &Progress) -> String {
    let [file, count] = progress.file;
    let of = if count > 1 { format!(", {file} of {count}") } else { String::new() };
    let name = if progress.name.is_empty() { "files" } else { &progress.name };
    format!("Reading {name}{of}, {:.0} %", 100.0 * progress.share.clamp(0.0, 1.0))
}

fn describe(thing: &PlotItem, context: &PaneContext<'_>) -> String {
    let scene = &context.scene;
    let label = |id: &SensorId| chromaticity::label(scene, id);
    let at = |xy: Option<chromascope_core::colorimetry::Xy>| {
        xy.map_or_else(
            || "chromaticity undefined".to_owned(),
            |xy| format!("x {} y {}", fixed(xy.x, 4), fixed(xy.y, 4)),
        )
    };
    match thing {
        PlotItem::Light => format!("The light: {}", scene.light_name()),
        PlotItem::DataSet { kind, name } => format!("{} {name}", kind.label()),
        PlotItem::Sensor(id) => {
            let also = scene.entry(id.kind, &id.name).ok().and_then(|entry| entry.also);
            let also = also.map_or_else(String::new, |also| format!(", {also}"));
            format!("{} {}{also}", id.kind.label(), id.name)
        }
        PlotItem::Patch { source: None, patch } => format!("Patch {patch}"),
        PlotItem::Patch { source: Some(id), patch } => {
            let index = scene.patches().ok().and_then(|set| set.patches().iter().position(|p| p.name == *patch));
            let color = index.and_then(|index| scene.patch_colors(id.kind, &id.name).ok()?.get(index).copied());
            let place = color.map_or_else(String::new, |color| format!(": {}", at(color.xy)));
            let is_reference = id.kind == SetKind::Observer && id.name == scene.document.reference;
            let difference = index
                .filter(|_| !is_reference)
                .and_then(|index| scene.differences(id.kind, &id.name).ok()?.get(index).copied().and_then(Result::ok));
            let difference = difference.map_or_else(String::new, |value| {
                format!(", {} {}", scene.difference_name(), fixed(value, scene.document.difference.decimals))
            });
            format!("{}, {patch}{place}{difference}", label(id))
        }
        PlotItem::Radiator { source, kelvin } => {
            use chromascope_core::query::Temperatures;
            let list = chromascope_core::units::Kelvin::new(*kelvin).map(|kelvin| Temperatures::List(vec![kelvin]));
            let locus = list.ok().and_then(|list| scene.locus_at(source.kind, &source.name, list).ok());
            let place = locus.and_then(|locus| locus.points.first().map(|point| at(point.xy)));
            let place = place.map_or_else(String::new, |place| format!(": {place}"));
            format!("{}, blackbody {} K{place}", label(source), fixed(*kelvin, 0))
        }
    }
}

fn facts(arrangement: &Arrangement, context: &PaneContext<'_>) -> Vec<String> {
    let scene = &context.scene;
    if arrangement.shows(PaneKind::RENDER) {
        return render_facts(context);
    }
    let mut facts = Vec::new();
    if !context.view.fixed_clock {
        let milliseconds = scene.results.last_work().as_secs_f64() * 1e3;
        facts.push(format!("updated in {} ms", fixed(milliseconds, usize::from(milliseconds < 100.0))));
    }
    if arrangement.shows(PaneKind::METRICS)
        && let Some((done, all)) = Ranking::seen(context.later).progress()
    {
        facts.push(format!("Computing: {done} of {all}"));
        return facts;
    }
    let sources = scene.sources();
    let shown = || sources.iter().filter(|source| source.visible);
    if arrangement.shows(PaneKind::CHROMATICITY) && scene.document.overlays.loci {
        let loci = shown().filter_map(|source| scene.locus(source.kind, &source.name).ok());
        let methods: Vec<LocusMethod> = loci.map(|locus| locus.method).collect();
        facts.extend(error_words(&methods));
    }
    let computed = shown().filter(|s| s.kind == SetKind::Camera && scene.rendering_of(s.kind, &s.name).is_ok()).count();
    let own = scene.document.own.iter().map(crate::catalog::Entry::from_own);
    let all =
        scene.catalog.of_kind(SetKind::Camera).count() + own.filter(|entry| entry.kind == SetKind::Camera).count();
    facts.push(format!("{computed} of {all} cameras computed"));
    facts
}

fn render_facts(context: &PaneContext<'_>) -> Vec<String> {
    let Some(shot) = context.render_service.frame() else { return Vec::new() };
    let mut facts = Vec::new();
    let long = context.render_service.busy().filter(|busy| *busy >= LONG);
    if let Some(busy) = long {
        let settings = &context.scene.document.render;
        let rows = context.images.chosen(&settings.mesh).map(|image| 100.0 * image.source.rows.share());
        let rows = rows.map_or_else(String::new, |share| format!(" {share:.0} %"));
        let making = if settings.quality == QualityLevel::Full { "Rendering" } else { settings.quality.label() };
        facts.push(format!("{making}{rows}: {:.0} s, Esc stops", busy.as_secs_f64()));
    } else if !context.view.fixed_clock {
        let milliseconds = shot.time.as_secs_f64() * 1e3;
        facts.push(format!("updated in {} ms", fixed(milliseconds, usize::from(milliseconds < 100.0))));
    }
    if let Some(image) = shot.made().and_then(MadePictures::image) {
        facts.push(image_words(shot, image));
    } else if let Some(query) = shot.query.mesh() {
        facts.push(query.shading.quality.summary().replace('-', "−"));
    }
    let cameras = shot.sources.iter().filter(|source| source.kind == SetKind::Camera).count();
    facts.push(format!("{cameras} {}", if cameras == 1 { "camera" } else { "cameras" }));
    facts
}

/// The largest error, up to the next power of ten.
fn error_words(methods: &[LocusMethod]) -> Option<String> {
    let largest = methods.iter().filter_map(|method| match method {
        LocusMethod::Nodes { error, .. } => Some(*error),
        LocusMethod::Sum => None,
    });
    match largest.reduce(f64::max) {
        Some(error) if error > 0.0 => {
            let power = (error.log10().floor() as i32 + 1).max(-15);
            Some(format!("error < 1e{power}").replace('-', "−"))
        }
        Some(_) => Some("error < 1e−15".to_owned()),
        None if methods.is_empty() => None,
        None => Some("1 nm sums".to_owned()),
    }
}
