//! Introduction for a newcomer: the window's purpose, and the key.

use chromascope_core::spectral::Primaries;
use chromascope_figure::{InkRole, LegendEntry, Marker, Stroke};
use egui::{Rect, RichText, Ui, Vec2};

use crate::action::Action;
use crate::document::start::Start;
use crate::document::{TransformChoice, WhiteBalanceChoice};
use crate::paint;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, WHAT_YOU_SEE};
use crate::theme::{Theme, UNIT};

/// Width of the drawn keys.
const KEY: f32 = 26.0;

pub(super) fn show(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    starts(ui, context);
    ui.label(RichText::new("What you see").strong());
    ui.label(WHAT_YOU_SEE);
    ui.add_space(UNIT);
    let line = |role: InkRole, marker: Marker, width: f64| LegendEntry {
        name: String::new(),
        stroke: Some(Stroke::solid(role, width)),
        marker: Some(marker),
        fill: Some(role.into()),
    };
    let thick = line(InkRole::Reference, Marker::Plus, 4.0);
    entry(
        ui,
        "thick line: the reference observer's Planckian locus, from 20000 K (blue) to 1000 K (red)",
        |ui, rect| paint::key(ui.painter(), rect, &thick, &theme),
    );
    let colored = line(InkRole::Sensor(0), Marker::Circle, 2.0);
    entry(ui, "colored lines: the Planckian locus of each camera", |ui, rect| {
        paint::key(ui.painter(), rect, &colored, &theme);
    });
    let point = line(InkRole::Sensor(1), Marker::Square, 1.2);
    entry(ui, "points: chart patches; the tail leads to the reference's", |ui, rect| {
        paint::key(ui.painter(), rect, &point, &theme);
    });
    entry(ui, "swatches: left the reference, right the camera; the bar is the difference", |ui, rect| {
        swatch(ui, rect, &theme);
    });
    if let Some(words) = caveat(context) {
        ui.add_space(UNIT);
        ui.label(RichText::new(words).small().color(theme.weak));
    }
    ui.separator();
    ui.label(RichText::new("Hover to read, click to select, Esc to deselect.").color(theme.weak));
}

/// The two starts, one click apart, with a summary of the chosen one.
fn starts(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let now = context.scene.document.start;
    ui.label(RichText::new("Start").small().color(context.theme.weak));
    let choices = Start::ALL.map(|start| (start, start.name(), start.summary()));
    ui.horizontal(|ui| {
        if let Some(start) = widgets::segmented(ui, &choices, now) {
            context.push(Action::Start(start));
        }
    });
    ui.label(RichText::new(now.summary()).small().color(context.theme.weak));
    ui.separator();
}

/// A drawn key and its action; the words wrap beside it.
fn entry(ui: &mut Ui, words: &str, draw: impl FnOnce(&Ui, Rect)) {
    ui.horizontal_top(|ui| {
        let (rect, _) = ui.allocate_exact_size(Vec2::new(KEY, 17.0), egui::Sense::hover());
        draw(ui, rect);
        ui.add_space(UNIT);
        ui.add(egui::Label::new(words).wrap());
    });
}

/// Two halves over a bar.
fn swatch(ui: &Ui, rect: Rect, theme: &Theme) {
    let frame = Rect::from_center_size(rect.center(), Vec2::new(22.0, 16.0));
    let painter = ui.painter();
    painter.rect_filled(frame, 0.0, theme.surround.color());
    let [left, right] = [[226, 190, 76], [214, 199, 164]].map(|rgb| theme.role(InkRole::Rgb(rgb)));
    let half = Vec2::new(9.0, 10.0);
    let min = frame.min + Vec2::new(2.0, 2.0);
    painter.rect_filled(Rect::from_min_size(min, half), 0.0, left);
    painter.rect_filled(Rect::from_min_size(min + Vec2::new(9.0, 0.0), half), 0.0, right);
    let bar = Rect::from_min_size(min + Vec2::new(0.0, 11.0), Vec2::new(11.0, 2.0));
    painter.rect_filled(bar, 0.0, theme.surround.label());
}

/// Caveat about settings that make the picture misleading.
fn caveat(context: &PaneContext<'_>) -> Option<&'static str> {
    let scene = &context.scene;
    let sources = scene.sources();
    let counts_in_xyz = |source: &crate::scene::ComparedSensor| {
        scene.sensor(source.kind, &source.name).is_ok_and(|sensor| sensor.primaries() == Primaries::Xyz)
    };
    let observers =
        || sources.iter().filter(|source| source.visible && source.kind == crate::document::SetKind::Observer);
    match (&scene.document.transform, &scene.document.white) {
        (TransformChoice::Paper, _) if observers().any(counts_in_xyz) => Some(
            "CIE observers are drawn directly, not through Eq 13: their lines differ from the others by construction.",
        ),
        (_, WhiteBalanceChoice::Unity) => None,
        (TransformChoice::Observer(_), _) => {
            Some("White balance changes camera RGB only; the fitted matrix compensates for it.")
        }
        (TransformChoice::Paper, _) => {
            Some("All colors, including the reference's, are shifted toward the white-balance target.")
        }
    }
}
