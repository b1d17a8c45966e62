//! The window about the program: a head through two sensors, what the program is, where its model and data come from.

use egui::{Align2, Rect, RichText, Sense, Ui, Vec2};

use crate::command::{Command, TourMove};
use crate::figures::portrait;
use crate::paint;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, WHAT_YOU_SEE};
use crate::theme::UNIT;

const PICTURE: Vec2 = Vec2::new(220.0, 240.0);
const TEXT: f32 = 320.0;

pub(super) fn show(ui: &Ui, context: &mut PaneContext<'_>) {
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
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
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
    ui.set_width(TEXT);
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
    let small = |ui: &mut Ui, words: String| ui.label(RichText::new(words).small().color(context.theme.weak));
    small(
        ui,
        format!("The head, as in its Figure 8: left through the reference, right through the {}.", portrait::CAMERA),
    );
    small(ui, format!("Program: {}. Each data set has its own source and terms.", env!("CARGO_PKG_LICENSE")));
    ui.add_space(UNIT);
    ui.horizontal_wrapped(|ui| {
        for (words, command) in [
            ("Take the tour", Command::Tour(TourMove::Begin)),
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
