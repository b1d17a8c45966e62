//! Question about an open decision of a file: values are not scaled before an answer is chosen.

use egui::{Rect, RichText, Sense, Ui, Vec2};
use spectral_file::{Certainty, Role, SpectralFile, Values};

use crate::command::Command;
use crate::figures::curves::ImportSelection;
use crate::format::sentence;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, lines};
use crate::theme::UNIT;

type Answer = (&'static str, &'static str, Option<Role>, Option<Values>);

const KINDS: [Answer; 5] = [
    ("Reflectances", "Use the numbers as reflectances, fractions of one", Some(Role::Reflectance), None),
    ("Filter", "Use the numbers as transmittances, fractions of one", Some(Role::Transmittance), None),
    LIGHT,
    CAMERA,
    AS_WRITTEN,
];

/// Answers where nothing indicates the quantity, and fractions of one are out of the question.
const LARGE_KINDS: [Answer; 5] = [
    (
        "Reflectances in percent",
        "Divide the numbers by 100 and use them as reflectances",
        Some(Role::Reflectance),
        Some(Values::Percent),
    ),
    (
        "Filter in percent",
        "Divide the numbers by 100 and use them as transmittances",
        Some(Role::Transmittance),
        Some(Values::Percent),
    ),
    LIGHT,
    CAMERA,
    AS_WRITTEN,
];

const LIGHT: Answer = ("Light", "Use the numbers as spectral power of a light", Some(Role::Illuminant), None);
const CAMERA: Answer = ("Camera", "Use the numbers as sensitivities of a camera", Some(Role::Camera), None);
const AS_WRITTEN: Answer = (
    "As written",
    "Import as spectra of an unknown kind; change it any time under “This is a”",
    Some(Role::Unknown),
    None,
);

const SCALES: [Answer; 2] = [
    ("In percent", "Divide the numbers by 100", None, Some(Values::Percent)),
    ("As written", "Use the numbers as fractions of one", None, Some(Values::Plain)),
];

/// Reflectances pass one by noise and fluorescence.
const LARGEST_FRACTION: f64 = 1.2;

fn question(table: &SpectralFile) -> Option<(&str, &'static [Answer])> {
    let open = |certainty| certainty == Certainty::Open;
    match (&table.role, &table.reading.values) {
        (role, _) if open(role.certainty) => {
            let large = table.curves.iter().flat_map(|curve| &curve.values).any(|value| *value > LARGEST_FRACTION);
            Some((&role.why, if large { &LARGE_KINDS } else { &KINDS }))
        }
        (_, values) if open(values.certainty) => Some((&values.why, &SCALES)),
        _ => None,
    }
}

/// Shows the question, if there is one, at the top of a rectangle. Returns what is left below.
pub(super) fn show(ui: &mut Ui, rect: Rect, shown: &ImportSelection, context: &mut PaneContext<'_>) -> Rect {
    let Some((why, answers)) = shown.table().filter(|_| shown.is_fresh()).and_then(question) else { return rect };
    let color = context.theme.warning;
    let mut child = widgets::clipped(ui, "question", rect);
    child.spacing_mut().item_spacing = Vec2::splat(UNIT);
    child.horizontal_wrapped(|ui| {
        let (mark, _) = ui.allocate_exact_size(Vec2::splat(16.0), Sense::hover());
        lines::warning_mark(ui.painter(), mark.center(), color);
        ui.label(RichText::new(sentence(why)).color(color));
    });
    child.horizontal_wrapped(|ui| {
        for (words, hint, role, values) in answers {
            if ui.button(*words).on_hover_text(*hint).clicked() {
                let mut overrides = shown.overrides.clone();
                overrides.options.role = role.or(overrides.options.role);
                overrides.options.values = values.or(overrides.options.values);
                context.push(Command::SetOverrides(shown.item.clone(), Box::new(overrides)));
            }
        }
    });
    let bottom = child.min_rect().bottom() + UNIT;
    ui.painter().hline(rect.x_range(), bottom, egui::Stroke::new(1.0, context.theme.line));
    Rect::from_min_max(egui::pos2(rect.left(), (bottom + UNIT).min(rect.bottom())), rect.max)
}
