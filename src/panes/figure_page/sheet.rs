//! The page on screen: its pixels as a PNG has them, on gray.

use std::sync::Arc;

use chromascope_figure::Figure;
use egui::{Align, Layout, Rect, RichText, ScrollArea, Sense, Ui, UiBuilder, Vec2};

use crate::export::page::{PageFacts, PageJob};
use crate::jobs::Job as _;
use crate::paint;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::theme::{self, UNIT};
use crate::view::page::PageZoom;
use crate::workspaces::PaneKind;

const AROUND: f32 = 16.0;
const MOST_PIXELS: f64 = 4096.0;

pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    (kind, figure): (PaneKind, Option<Arc<Figure>>),
    context: &mut PaneContext<'_>,
) {
    let ground = rect.with_min_y(rect.top() + widgets::HEADER);
    let head = rect.with_max_y(ground.top());
    ui.painter().rect_filled(ground, 0.0, context.theme.surround);
    let Some(figure) = figure else {
        self::head(ui, head, kind, None, context);
        let words = format!("{} has no figure now.", context.title(kind));
        let font = egui::TextStyle::Body.resolve(ui.style());
        let color = context.theme.on_surround;
        ui.painter().text(ground.center(), egui::Align2::CENTER_CENTER, words, font, color);
        return;
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
    self::head(ui, head, kind, Some(scale), context);
    let size = Vec2::new((size[0] * scale) as f32, (size[1] * scale) as f32);
    let mut child = widgets::clipped(ui, "page", ground);
    let area =
        ScrollArea::both().id_salt("page").auto_shrink(false).scroll_source(egui::scroll_area::ScrollSource::ALL);
    area.show(&mut child, |ui| {
        let room = (size + Vec2::splat(2.0 * AROUND)).max(ui.available_size());
        let (place, response) = ui.allocate_exact_size(room, Sense::hover());
        let words = format!("{} on paper: {}", context.title(kind), figure.title);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &words));
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

fn head(ui: &mut Ui, rect: Rect, kind: PaneKind, scale: Option<f64>, context: &mut PaneContext<'_>) {
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
