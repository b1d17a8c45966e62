//! Introduction for a newcomer: the window's purpose, and the key.

use std::sync::Arc;

use chromascope_core::spectral::Primaries;
use chromascope_figure::{InkRole, LegendEntry, Marker, Panel, Stroke};
use egui::{Rect, Ui, Vec2};

use crate::action::Action;
use crate::command::{Command, TourMove};
use crate::document::start::Start;
use crate::document::{TransformChoice, WhiteBalanceChoice};
use crate::figures::{chromaticity, swatches};
use crate::paint;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, WHAT_YOU_SEE, focus_rim, lines};
use crate::scene::Scene;
use crate::theme::{ROW, Theme, UNIT};
use crate::view::tour::Tour;
use crate::workspaces::PaneKind;

const CARD: Vec2 = Vec2::new(200.0, 70.0);
const KEY: f32 = 26.0;
/// Color of the arrow in the key.
const ARROW: [u8; 3] = [196, 78, 88];

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    starts(ui, context);
    ui.strong("What you see");
    ui.label(WHAT_YOU_SEE);
    ui.add_space(UNIT);
    let line = |role: InkRole, marker: Marker, width: f64| LegendEntry {
        name: String::new(),
        stroke: Some(Stroke::solid(role, width)),
        marker: Some(marker),
        fill: Some(role.into()),
    };
    let shown = |pane| context.view.is_shown(pane);
    let diagram = shown(PaneKind::CHROMATICITY);
    if diagram {
        let thick = line(InkRole::Reference, Marker::Plus, 4.0);
        let words = "thick line: Planckian locus, reference";
        entry(ui, words, |ui, rect| paint::key(ui.painter(), rect, &thick, &theme));
        let colored = line(InkRole::Sensor(0), Marker::Circle, 2.0);
        let words = "colored: loci and patches of cameras";
        entry(ui, words, |ui, rect| paint::key(ui.painter(), rect, &colored, &theme));
        if context.scene.document.overlays.loci {
            let words = format!("ring: blackbody at {:.0} K", context.scene.document.temperature_k);
            entry(ui, &words, |ui, rect| {
                ui.painter().circle_stroke(rect.center(), 5.5, egui::Stroke::new(1.5, theme.role(InkRole::Sensor(0))));
            });
        }
    }
    if shown(PaneKind::DIFFERENCES) || diagram && context.scene.document.overlays.multiples {
        let words = "arrows: errors of patches; dashed ring: 95 % of them; cross: their mean vector";
        entry(ui, words, |ui, rect| {
            let stroke = egui::Stroke::new(2.0, theme.role(InkRole::Rgb(ARROW)));
            ui.painter().arrow(rect.left_center() + Vec2::new(2.0, 4.0), Vec2::new(20.0, -8.0), stroke);
        });
    }
    if shown(PaneKind::SWATCHES) {
        let scale = Some(swatches::bar_scale(&context.scene)).filter(|_| context.view.saved.difference_bars);
        let parts = ["swatches: left reference, right camera".to_owned()].into_iter().chain(scale);
        let words = parts.collect::<Vec<_>>().join("; ");
        entry(ui, &words, |ui, rect| swatch(ui, rect, &theme));
    }
    if let Some(words) = caveat(context) {
        ui.add_space(UNIT);
        widgets::note(ui, words);
    }
    ui.separator();
    ui.weak("Hover reads, click selects, Esc deselects.");
}

fn starts(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let width = ((ui.available_width() - 2.0 * UNIT) / 2.0).min(CARD.x);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
        for start in Start::ALL {
            card(ui, start, Vec2::new(width, CARD.y), context);
        }
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0 * UNIT;
        for tour in Tour::ALL {
            if ui.link(tour.label()).on_hover_text(tour.words().why).clicked() {
                context.push(Command::Tour(TourMove::Begin(tour)));
            }
        }
    });
    ui.separator();
}

fn card(ui: &mut Ui, start: Start, size: Vec2, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    let on = context.scene.document.start == start;
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, on, start.label()));
    let fill = if response.hovered() { theme.hover } else { theme.control };
    ui.painter().rect_filled(rect, 3.0, fill);
    let picture = Rect::from_min_max(rect.min + Vec2::splat(2.0), egui::pos2(rect.right() - 2.0, rect.bottom() - ROW));
    paint::still(ui.painter(), &picture_of(ui, start, picture.size(), context), &theme, picture);
    let words = Rect::from_min_max(egui::pos2(rect.left() + 1.5 * UNIT, picture.bottom()), rect.max);
    lines::elided(ui, words, start.label(), egui::TextStyle::Body, theme.text);
    let rim = if on { egui::Stroke::new(1.5, theme.text) } else { focus_rim(&response, &theme) };
    ui.painter().rect_stroke(rect, 3.0, rim, egui::StrokeKind::Inside);
    if response.on_hover_text(start.why()).clicked() {
        context.push(Action::Start(start));
    }
}

/// Picture of a start: its loci and patches without words. Made once for a size.
fn picture_of(ui: &Ui, start: Start, size: Vec2, context: &PaneContext<'_>) -> Arc<Panel> {
    let id = egui::Id::unique(("picture of a start", start.key(), size.x as u32, size.y as u32));
    if let Some(known) = ui.data(|data| data.get_temp::<Arc<Panel>>(id)) {
        return known;
    }
    let made = Arc::new(chromaticity::thumbnail(
        &Scene { document: &start.document(), ..context.scene },
        [f64::from(size.x), f64::from(size.y)],
    ));
    ui.data_mut(|data| data.insert_temp(id, Arc::clone(&made)));
    made
}

fn entry(ui: &mut Ui, words: &str, draw: impl FnOnce(&Ui, Rect)) {
    ui.horizontal_top(|ui| {
        let (rect, _) = ui.allocate_exact_size(Vec2::new(KEY, 17.0), egui::Sense::hover());
        draw(ui, rect);
        ui.add_space(UNIT);
        ui.add(egui::Label::new(words).wrap());
    });
}

fn swatch(ui: &Ui, rect: Rect, theme: &Theme) {
    let frame = Rect::from_center_size(rect.center(), Vec2::new(22.0, 16.0));
    let painter = ui.painter();
    painter.rect_filled(frame, 0.0, theme.surround);
    let [left, right] = [[226, 190, 76], [214, 199, 164]].map(|rgb| theme.role(InkRole::Rgb(rgb)));
    let half = Vec2::new(9.0, 10.0);
    let min = frame.min + Vec2::new(2.0, 2.0);
    painter.rect_filled(Rect::from_min_size(min, half), 0.0, left);
    painter.rect_filled(Rect::from_min_size(min + Vec2::new(9.0, 0.0), half), 0.0, right);
    let bar = Rect::from_min_size(min + Vec2::new(0.0, 11.0), Vec2::new(11.0, 2.0));
    painter.rect_filled(bar, 0.0, theme.on_surround);
}

fn caveat(context: &PaneContext<'_>) -> Option<&'static str> {
    let scene = &context.scene;
    let sources = scene.sources();
    let counts_in_xyz = |source: &crate::scene::ComparedSensor| {
        scene.sensor(source.kind, &source.name).is_ok_and(|sensor| sensor.primaries() == Primaries::Xyz)
    };
    let observers =
        || sources.iter().filter(|source| source.visible && source.kind == crate::document::SetKind::Observer);
    match (&scene.document.transform, &scene.document.white) {
        (TransformChoice::Paper, _) if observers().any(counts_in_xyz) => {
            Some("CIE observers are drawn directly, not through Eq 13: they differ by construction.")
        }
        (_, WhiteBalanceChoice::Unity) => None,
        (TransformChoice::Observer(_), _) => {
            Some("White balance changes camera RGB only; the fitted matrix compensates for it.")
        }
        (TransformChoice::Paper, _) => {
            Some("All colors, including the reference's, are shifted toward the white-balance target.")
        }
    }
}
