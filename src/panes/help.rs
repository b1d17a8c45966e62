//! The help window: list of pages, search and the page; the palette; the tour; the window about the program.

mod blocks;
mod palette;
mod typeset;

use blocks::Ink;
use chromascope_core::query::DifferenceError;
use egui::{
    Align, Align2, Button, Event, Key, Layout, Modifiers, Rect, RichText, ScrollArea, Sense, TextEdit, Ui, UiBuilder,
    Vec2,
};

use super::context::PaneContext;
use crate::action::history::History;
use crate::command::{Command, TourMove};
use crate::document::{Diagram, SetKind};
use crate::figures::portrait;
use crate::figures::render::headline::{Detail, Measure};
use crate::format::fixed;
use crate::help::{Hit, Page, Target, find, pages, resolve, search, terms};
use crate::paint;
use crate::panes::widgets::{self, WHAT_YOU_SEE};
use crate::scene::{ComparedSensor, Scene};
use crate::theme::{ROW, SMALL, UNIT};
use crate::view::HelpView;
use crate::view::tour::{Tour, TourNumbers, TourStep};

const LIST: f32 = 224.0;
const TEXT_WIDTH: f32 = 720.0;
const MOST_HITS: usize = 100;

pub fn show(ui: &mut Ui, history: &History, context: &mut PaneContext<'_>) {
    if let Some(page) = context.view.help.page.and_then(find) {
        window(ui, page, context);
    }
    if context.view.palette.is_some() {
        palette::show(ui, history, context);
    }
    about(ui, context);
}

fn window(ui: &Ui, page: &'static Page, context: &mut PaneContext<'_>) {
    let mut open = true;
    let screen = ui.ctx().content_rect();
    let size = Vec2::new(1040.0_f32.min(screen.width() - 48.0), 760.0_f32.min(screen.height() - 96.0));
    widgets::window("Help", "help", (Align2::CENTER_CENTER, Vec2::ZERO)).open(&mut open).fixed_size(size).show(
        ui.ctx(),
        |ui| {
            let (all, _) = ui.allocate_exact_size(ui.available_size(), egui::Sense::hover());
            let split = all.left() + LIST;
            let mut left = ui.new_child(UiBuilder::new().id_salt("list").max_rect(all.with_max_x(split - 2.0 * UNIT)));
            list(&mut left, page, &mut context.view.help);
            ui.painter().vline(split - UNIT, all.y_range(), egui::Stroke::new(1.0, context.theme.line));
            let right = all.with_min_x(split + UNIT);
            let mut right = ui.new_child(UiBuilder::new().id_salt(("page", page.name)).max_rect(right));
            content(&mut right, page, context);
        },
    );
    if !open {
        context.view.help = HelpView::default();
    }
}

fn list(ui: &mut Ui, page: &'static Page, help: &mut HelpView) {
    let id = ui.scope_id().with("search");
    let slash = !ui.ctx().text_edit_focused() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Slash));
    if slash {
        ui.input_mut(|input| input.events.retain(|event| !matches!(event, Event::Text(text) if text == "/")));
    }
    if slash || std::mem::take(&mut help.focus_search) {
        ui.memory_mut(|memory| memory.request_focus(id));
    }
    let hits = search(pages(), &help.query);
    let has_focus = ui.memory(|memory| memory.has_focus(id));
    let pressed = |ui: &mut Ui, key| has_focus && ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    if pressed(ui, Key::ArrowDown) {
        help.picked += 1;
    }
    if pressed(ui, Key::ArrowUp) {
        help.picked = help.picked.saturating_sub(1);
    }
    help.picked = help.picked.min(hits.len().saturating_sub(1));
    let field = TextEdit::singleline(&mut help.query).id(id).hint_text("Search ( / )").desired_width(f32::INFINITY);
    let field = ui.add(field);
    widgets::labeled(&field, egui::Role::TextInput, "Search help");
    if field.changed() {
        help.picked = 0;
    }
    if field.lost_focus()
        && ui.input(|input| input.key_pressed(Key::Enter))
        && let Some(hit) = hits.get(help.picked)
    {
        help.open(hit.page, hit.block);
        field.request_focus();
    }
    ui.add_space(UNIT);
    ScrollArea::vertical().id_salt("pages").auto_shrink(false).show(ui, |ui| {
        if help.query.trim().is_empty() {
            for other in pages() {
                let name = egui::Button::selectable(other.name == page.name, &other.title);
                if ui.add_sized([ui.available_width(), ROW], name.right_text("")).clicked() {
                    help.open(other.name, 0);
                }
            }
        } else {
            results(ui, &hits, help);
        }
    });
}

fn results(ui: &mut Ui, hits: &[Hit], help: &mut HelpView) {
    let count = match hits.len() {
        0 => "No match.".to_owned(),
        1 => "1 match".to_owned(),
        count => format!("{count} matches"),
    };
    ui.label(RichText::new(count).small().weak());
    for (index, hit) in hits.iter().take(MOST_HITS).enumerate() {
        let page = find(hit.page).map_or("", |page| page.title.as_str());
        let place = if hit.heading == page { page.to_owned() } else { format!("{page}: {}", hit.heading) };
        let mut words = egui::text::LayoutJob::default();
        let format = |size, color| egui::TextFormat::simple(egui::FontId::proportional(size), color);
        words.append(&place, 0.0, format(SMALL, ui.visuals().weak_text_color()));
        words.append(&format!("\n{}", hit.excerpt), 0.0, format(SMALL, ui.visuals().text_color()));
        let row = egui::Button::selectable(index == help.picked, words).wrap();
        let row = ui.add(row.min_size(Vec2::new(ui.available_width(), ROW)));
        if index == help.picked && !ui.is_rect_visible(row.rect) {
            row.scroll_to_me(None);
        }
        if row.clicked() {
            help.picked = index;
            help.open(hit.page, hit.block);
        }
    }
}

fn content(ui: &mut Ui, page: &'static Page, context: &mut PaneContext<'_>) {
    ui.horizontal(|ui| {
        let before = context.view.help.visited.last().and_then(|name| find(name));
        let back = ui.add_enabled(before.is_some(), egui::Button::new("← Back"));
        let key = ui.input_mut(|input| input.consume_key(Modifiers::ALT, Key::ArrowLeft));
        if back.on_hover_text(before.map_or("", |page| page.title.as_str())).clicked() || key {
            context.view.help.back();
        }
    });
    // A hit on another page is scrolled to when that page is drawn.
    let is_open = context.view.help.page == Some(page.name);
    let wanted = if is_open { context.view.help.scroll_to.take() } else { None };
    let terms = terms(&context.view.help.query);
    let ink = Ink { theme: context.theme, terms: &terms };
    let mut clicked = None;
    ScrollArea::vertical().id_salt(page.name).auto_shrink(false).show(ui, |ui| {
        scroll_by_keys(ui);
        ui.set_max_width(TEXT_WIDTH.min(ui.available_width() - 3.0 * UNIT));
        for (index, block) in page.blocks.iter().enumerate() {
            let top = ui.cursor().min;
            clicked = blocks::show(ui, block, &ink).or(clicked.take());
            if wanted == Some(index) {
                ui.scroll_to_rect(Rect::from_min_size(top, Vec2::splat(1.0)), Some(egui::Align::TOP));
            }
        }
        ui.add_space(8.0 * UNIT);
    });
    match clicked.as_deref().and_then(|link| resolve(page.name, link)) {
        Some(Target::Web(address)) => ui.ctx().open_url(egui::OpenUrl::new_tab(address)),
        Some(Target::Page(name, anchor)) => {
            let blocks = find(name).map_or(&[][..], |page| &page.blocks);
            let at = blocks.iter().position(|block| anchor.is_some() && block.anchor().as_deref() == anchor);
            context.view.help.open(name, at.unwrap_or(0));
        }
        None => {}
    }
}

/// Arrow and page keys scroll while no control has the keyboard.
fn scroll_by_keys(ui: &mut Ui) {
    if ui.memory(|memory| memory.focused().is_some()) {
        return;
    }
    let page = ui.clip_rect().height() - 2.0 * ROW;
    for (key, distance) in [
        (Key::ArrowDown, 2.0 * ROW),
        (Key::ArrowUp, -2.0 * ROW),
        (Key::PageDown, page),
        (Key::PageUp, -page),
        (Key::Space, page),
    ] {
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, key)) {
            ui.scroll_with_delta(Vec2::new(0.0, -distance));
        }
    }
}

const PICTURE: Vec2 = Vec2::new(220.0, 240.0);
const ABOUT_TEXT: f32 = 320.0;

fn about(ui: &Ui, context: &mut PaneContext<'_>) {
    if !context.view.about {
        return;
    }
    let mut open = true;
    let window = widgets::window("About Chromascope", "about", (Align2::CENTER_CENTER, Vec2::ZERO));
    window.open(&mut open).show(ui.ctx(), |ui| {
        ui.horizontal_top(|ui| {
            head(ui, context);
            ui.add_space(2.0 * UNIT);
            ui.vertical(|ui| text(ui, context));
        });
    });
    context.view.about &= open;
}

fn head(ui: &mut Ui, context: &PaneContext<'_>) {
    let (rect, response) = ui.allocate_exact_size(PICTURE, Sense::hover());
    let name = format!("A head: left through the reference, right through the {}", portrait::CAMERA);
    widgets::labeled(&response, egui::Role::Image, &name);
    ui.painter().rect_filled(rect, 3.0, context.theme.surround);
    let query = portrait::query(context.scene.catalog, context.scene.results);
    let Some(shown) = context.later.ask("About", query.into_iter().collect()).shown else { return };
    let size = [f64::from(PICTURE.x), f64::from(PICTURE.y)];
    let pictures = (*shown.answer).as_ref().ok().and_then(Option::as_ref);
    if let Some(panel) = pictures.and_then(|pictures| portrait::panel(pictures, size)) {
        paint::still(ui.painter(), &panel, &context.theme, Rect::from_min_size(rect.min, PICTURE));
    }
}

fn text(ui: &mut Ui, context: &mut PaneContext<'_>) {
    ui.set_width(ABOUT_TEXT);
    ui.heading("Chromascope");
    ui.label(RichText::new(concat!("Version ", env!("CARGO_PKG_VERSION"))).color(context.theme.weak));
    ui.add_space(UNIT);
    ui.label(WHAT_YOU_SEE);
    ui.add_space(UNIT);
    ui.label(
        "It carries out and extends C. P. Huynh and A. Robles-Kelly, “Comparative colorimetric simulation and evaluation \
         of digital cameras using spectroscopy data” (2007).",
    );
    ui.add_space(UNIT);
    let words =
        format!("The head, as in its Figure 8: left through the reference, right through the {}.", portrait::CAMERA);
    widgets::note(ui, words);
    widgets::note(ui, format!("Program: {}. Each data set has its own source and terms.", env!("CARGO_PKG_LICENSE")));
    ui.add_space(UNIT);
    ui.horizontal_wrapped(|ui| {
        for (words, command) in [
            ("Take the tour", Command::Tour(TourMove::Begin(Tour::Program))),
            ("Data and sources", Command::Help("data", 0)),
            ("Equations", Command::Help("model", 0)),
        ] {
            if ui.button(words).clicked() {
                context.view.about = false;
                context.push(command);
            }
        }
    });
}

pub const TOUR: f32 = 100.0;
const TOUR_BUTTONS: f32 = 216.0;

pub fn tour(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let Some((tour, index)) = context.view.tour else { return };
    let (step, count) = (&tour.steps()[index], tour.steps().len());
    let theme = context.theme;
    ui.painter().rect_filled(rect, 0.0, theme.plot);
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let words = inner.with_max_x(inner.right() - TOUR_BUTTONS - 4.0 * UNIT);
    let mut left = ui.new_child(UiBuilder::new().id_salt("tour words").max_rect(words));
    left.set_clip_rect(words.intersect(ui.clip_rect()));
    left.spacing_mut().item_spacing.y = 2.0;
    left.label(RichText::new(format!("{} of {count}  {}", index + 1, step.title)).strong());
    left.label(step.text);
    left.label(RichText::new(numbers(step, context)).small());
    let place = inner.with_min_x(inner.right() - TOUR_BUTTONS);
    let to_left = Layout::right_to_left(Align::Center);
    let mut right = ui.new_child(UiBuilder::new().id_salt("tour buttons").max_rect(place).layout(to_left));
    let size = Vec2::new(64.0, ROW);
    let last = index + 1 == count;
    let hint = "Your document and layout come back as they were (Esc)";
    if right.add(Button::new("End").min_size(size)).on_hover_text(hint).clicked() {
        context.push(Command::Tour(TourMove::End));
    }
    if right.add_enabled(!last, Button::new("Next").min_size(size)).clicked() {
        context.push(Command::Tour(TourMove::Next));
    }
    if right.add_enabled(index > 0, Button::new("Back").min_size(size)).clicked() {
        context.push(Command::Tour(TourMove::Back));
    }
}

fn numbers(step: &TourStep, context: &PaneContext<'_>) -> String {
    let scene = &context.scene;
    let sources = scene.sources();
    let cameras = || sources.iter().filter(|source| source.kind == SetKind::Camera && source.visible);
    let list = |parts: Vec<String>| parts.join("   ");
    match step.numbers {
        TourNumbers::None => String::new(),
        TourNumbers::MeanDifferences => {
            let mean = |camera: &ComparedSensor| {
                let all = scene.differences(camera.kind, &camera.name).ok()?;
                let mean = all.iter().copied().sum::<Result<f64, _>>().ok()? / all.len() as f64;
                Some(format!("{} {}", camera.label, fixed(mean, scene.document.difference.decimals)))
            };
            format!("Mean {}:   {}", scene.difference_name(), list(cameras().filter_map(mean).collect()))
        }
        TourNumbers::LocusLengths => {
            let shown = sources.iter().filter(|source| source.is_reference).chain(cameras());
            let length = |s: &ComparedSensor| {
                let locus = scene.locus(s.kind, &s.name).ok()?;
                Some(format!("{} {}", s.label, fixed(locus.length_xy(), 3)))
            };
            format!("Length in xy:   {}", list(shown.filter_map(length).collect()))
        }
        TourNumbers::NearestTemperatures => {
            let nearest = |s: &ComparedSensor| {
                let nearest = scene.nearest_to_reference(s.kind, &s.name, Diagram::Xy)?;
                Some(format!("{} {} K", s.label, fixed(nearest.kelvin, 0)))
            };
            format!("Minimum at:   {}", list(cameras().filter_map(nearest).collect()))
        }
        TourNumbers::PatchDifferences => {
            let words = cameras().filter_map(|camera| patches_of(scene, camera));
            format!("{}:   {}", scene.difference_name(), words.collect::<Vec<_>>().join("\n"))
        }
        TourNumbers::RenderedDifferences => rendered(context),
    }
}

/// Differences of the colored patches through a camera.
fn patches_of(scene: &Scene<'_>, camera: &ComparedSensor) -> Option<String> {
    let patches = scene.patches().ok()?;
    let differences: Vec<Result<f64, DifferenceError>> = scene.differences(camera.kind, &camera.name).ok()?;
    let decimals = scene.document.difference.decimals;
    let colored = patches.patches().iter().zip(differences).filter(|(patch, _)| !patch.name.starts_with("white"));
    let words = colored.filter_map(|(patch, value)| Some(format!("{} {}", patch.name, fixed(value.ok()?, decimals))));
    Some(format!("{}: {}", camera.label, words.collect::<Vec<_>>().join(", ")))
}

/// Differences of the rendered material, once the pictures are there.
fn rendered(context: &PaneContext<'_>) -> String {
    let made = context.render_service.frame().and_then(|frame| Some((frame, frame.made()?)));
    let Some((frame, made)) = made else { return "The pictures are being rendered.".to_owned() };
    let measure = Measure::of_frame(frame);
    let pairs = frame.sources.iter().zip(made.differences).filter(|(source, _)| !source.is_reference);
    let words = pairs.filter_map(|(source, difference)| {
        let difference = difference.as_ref()?;
        Some(format!("{} {}", source.label, measure.words(difference, Detail::Number)))
    });
    format!("Facing the light:   {}", words.collect::<Vec<_>>().join("   "))
}
