//! The Figure page: a pane as it is printed, beside the settings of its paper.

mod settings;

use std::sync::Arc;
use std::time::Duration;

use chromascope_figure::Figure;
use egui::{Align, Layout, Rect, RichText, ScrollArea, Sense, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use super::{by_kind, show as show_pane};
use crate::export::Paper;
use crate::export::page::{PageFacts, PageJob};
use crate::jobs::Job as _;
use crate::paint;
use crate::panes::widgets;
use crate::theme::{self, UNIT};
use crate::view::PageZoom;
use crate::workspaces::PaneKind;

const SETTINGS: f32 = 300.0;
/// Panes whose figures follow from the document alone. The others ask for work in the background while they are shown.
const OF_DOCUMENT: [PaneKind; 3] = [PaneKind::CHROMATICITY, PaneKind::SWATCHES, PaneKind::SPECTRA];

pub fn show(ui: &mut Ui, rect: Rect, kind: PaneKind, context: &mut PaneContext<'_>) {
    widgets::ground(ui, kind, rect, context);
    keep_working(ui, rect, kind, context);
    let figure = made(ui, kind, context);
    let facts = figure.as_deref().map(|figure| PageFacts::of(figure, &context.view.saved.page.paper));
    let cut = rect.right() - SETTINGS.min(0.5 * rect.width());
    sheet(ui, rect.with_max_x(cut), (kind, figure), context);
    ui.painter().vline(cut + 0.5, rect.y_range(), egui::Stroke::new(1.0, context.theme.line));
    settings::show(ui, rect.with_min_x(cut + 1.0), (kind, facts), context);
    // Esc leaves a field before it leaves the page.
    if context.view.palette.is_none() && context.view.help.page.is_none() {
        context.view.keeps_escape = ui.ctx().text_edit_focused();
    }
}

/// Lets a pane that is not seen go on asking for what its figure needs.
fn keep_working(ui: &mut Ui, rect: Rect, kind: PaneKind, context: &mut PaneContext<'_>) {
    if OF_DOCUMENT.contains(&kind) {
        return;
    }
    // No key is meant for it.
    let (focused, enters) = (context.view.focused.take(), std::mem::take(&mut context.view.tab_enters));
    let mut unseen = ui.new_child(UiBuilder::new().id_salt("unseen pane").max_rect(rect).invisible());
    unseen.set_clip_rect(Rect::NOTHING);
    show_pane(&mut unseen, kind, rect, context);
    (context.view.focused, context.view.tab_enters) = (focused, enters);
}

/// The figure, made anew ten times a second at most while neither pane nor paper change.
fn made(ui: &Ui, kind: PaneKind, context: &mut PaneContext<'_>) -> Option<Arc<Figure>> {
    let (of, now) = ((kind, context.view.saved.page.paper), ui.input(|input| input.time));
    if let Some((figure, rest)) = context.states.of::<LastPage>().fresh(of, now) {
        ui.ctx().request_repaint_after(rest);
        return figure;
    }
    let shown = by_kind(kind).and_then(|pane| pane.figure);
    let figure = shown.and_then(|shown| shown.on_paper(&of.1, &context.scene, &context.look(kind)));
    context.states.of::<LastPage>().keep(of, now, figure)
}

/// A child of a rectangle with some space along its sides.
fn inside(ui: &mut Ui, salt: &'static str, rect: Rect) -> Ui {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, 0.0));
    let mut child = ui.new_child(UiBuilder::new().id_salt(salt).max_rect(inner));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    child
}

#[derive(Default)]
struct LastPage(Option<MadeFigure>);

struct MadeFigure {
    of: (PaneKind, Paper),
    /// Time of egui in seconds.
    at: f64,
    figure: Option<Arc<Figure>>,
}

impl LastPage {
    /// Seconds between two figures while neither pane nor paper change: moving the pointer makes none.
    const PAUSE: f64 = 0.1;

    /// The figure made last while it is fresh, and for how long it still is; after that, [`Self::keep`] takes another.
    fn fresh(&self, of: (PaneKind, Paper), now: f64) -> Option<(Option<Arc<Figure>>, Duration)> {
        let made = self.0.as_ref().filter(|made| made.of == of)?;
        let age = now - made.at;
        (0.0..Self::PAUSE).contains(&age).then(|| (made.figure.clone(), Duration::from_secs_f64(Self::PAUSE - age)))
    }

    /// Keeps a figure that was made. One equal to the last leaves that in place.
    fn keep(&mut self, of: (PaneKind, Paper), now: f64, figure: Option<Figure>) -> Option<Arc<Figure>> {
        let last = self.0.take().and_then(|made| made.figure);
        let figure = match (last, figure) {
            (Some(last), Some(figure)) if *last == figure => Some(last),
            (_, figure) => figure.map(Arc::new),
        };
        self.0 = Some(MadeFigure { of, at: now, figure: figure.clone() });
        figure
    }
}

const AROUND: f32 = 16.0;
const MOST_PIXELS: f64 = 4096.0;

fn sheet(ui: &mut Ui, rect: Rect, (kind, figure): (PaneKind, Option<Arc<Figure>>), context: &mut PaneContext<'_>) {
    let ground = rect.with_min_y(rect.top() + widgets::HEADER);
    let head = rect.with_max_y(ground.top());
    ui.painter().rect_filled(ground, 0.0, context.theme.surround);
    let Some(figure) = figure else {
        title(ui, head, kind, None, context);
        let words = format!("{} has no figure now.", context.title(kind));
        return widgets::say(ui, ground, words, context.theme.on_surround);
    };
    let paper = context.view.saved.page.paper;
    let pixels = f64::from(ui.ctx().pixels_per_point());
    let scale = |size: [f64; 2], context: &PaneContext<'_>| {
        let room = [ground.width(), ground.height()].map(|side| f64::from(side - 2.0 * AROUND).max(1.0));
        context.view.saved.page.zoom.scale((room[0] / size[0]).min(room[1] / size[1]))
    };
    let size = PageFacts::of(&figure, &paper).size_pt;
    let fine = (scale(size, context) * pixels).min(MOST_PIXELS / size[0].max(size[1]));
    let job = PageJob { figure: Arc::clone(&figure), paper, scale: fine as f32 };
    let page = context.later.ask(PageJob::NAME, vec![job]);
    // Until the page is drawn, the last one of the pane stays.
    let shown = page.shown.filter(|shown| shown.job.figure.title == figure.title);
    let size = shown.as_ref().map_or(size, |shown| PageFacts::of(&shown.job.figure, &shown.job.paper).size_pt);
    let scale = scale(size, context);
    title(ui, head, kind, Some(scale), context);
    let size = Vec2::new((size[0] * scale) as f32, (size[1] * scale) as f32);
    let mut child = widgets::clipped(ui, "page", ground);
    let area =
        ScrollArea::both().id_salt("page").auto_shrink(false).scroll_source(egui::scroll_area::ScrollSource::ALL);
    area.show(&mut child, |ui| {
        let room = (size + Vec2::splat(2.0 * AROUND)).max(ui.available_size());
        let (place, response) = ui.allocate_exact_size(room, Sense::hover());
        let words = format!("{} on paper: {}", context.title(kind), figure.title);
        widgets::labeled(&response, egui::Role::Image, &words);
        let corner = (place.center() - 0.5 * size).round();
        let page = Rect::from_min_size(corner, size);
        match shown.as_ref().map(|shown| shown.answer.as_ref()) {
            Some(Ok(image)) => paint::picture(ui.painter(), page, image),
            Some(Err(error)) => {
                ui.put(page, egui::Label::new(RichText::new(error.to_string()).color(context.theme.on_surround)));
            }
            None => {
                ui.painter().rect_filled(page, 0.0, theme::rgb(paper.colors().plot));
            }
        }
    });
    widgets::busy_line(ui, ground, page.busy, context.theme.text);
}

fn title(ui: &mut Ui, rect: Rect, kind: PaneKind, scale: Option<f64>, context: &mut PaneContext<'_>) {
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let to_left = Layout::right_to_left(Align::Center);
    let mut right = ui.new_child(UiBuilder::new().id_salt("page zoom").max_rect(inner).layout(to_left));
    let zoom = context.view.saved.page.zoom;
    let [fit, true_size, double] = PageZoom::ALL;
    if let Some(to) = widgets::choice_of(&mut right, &[double, true_size, fit], zoom) {
        context.view.saved.page.zoom = to;
        ui.ctx().request_repaint();
    }
    let free = inner.with_max_x(right.min_rect().left() - UNIT);
    let layout = Layout::left_to_right(Align::Center);
    let mut left = ui.new_child(UiBuilder::new().id_salt("page title").max_rect(free).layout(layout));
    left.set_clip_rect(free.intersect(ui.clip_rect()));
    left.strong(context.title(kind));
    if let Some(scale) = scale {
        let words = format!("as it prints, {:.0} %", 100.0 * scale / PageZoom::TRUE);
        left.weak(words);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_is_fresh_for_a_while_and_an_equal_one_leaves_it_in_place() {
        let mut view = LastPage::default();
        let of = (PaneKind::SPECTRA, Paper::default());
        assert!(view.fresh(of, 1.0).is_none());
        let first = view.keep(of, 1.0, Some(Figure::new("Spectra", [1.0; 2]))).expect("a figure");
        let (fresh, rest) = view.fresh(of, 1.04).expect("fresh");
        assert!(Arc::ptr_eq(&fresh.expect("a figure"), &first) && (rest.as_secs_f64() - 0.06).abs() < 1e-9);
        assert!(view.fresh((of.0, Paper { dpi: 600.0, ..of.1 }), 1.04).is_none(), "another paper");
        assert!(view.fresh(of, 1.11).is_none(), "some time later");
        let again = view.keep(of, 1.11, Some(Figure::new("Spectra", [1.0; 2]))).expect("a figure");
        assert!(Arc::ptr_eq(&again, &first));
        let other = view.keep(of, 1.3, Some(Figure::new("Spectra", [2.0; 2]))).expect("a figure");
        assert!(!Arc::ptr_eq(&other, &first));
    }
}
