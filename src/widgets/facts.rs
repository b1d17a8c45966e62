//! What is known about a data set: for tooltips and for the inspector.

use chromascope_core::query::Ask;
use chromascope_core::spectral::Response;
use egui::text::LayoutJob;
use egui::{TextFormat, Ui};

use super::number;
use crate::catalog::load::FileOf;
use crate::catalog::{Entry, Kind, Place};
use crate::document::own::Role;
use crate::scene::Scene;
use crate::theme::{SMALL, Theme, UNIT};

/// A fact with its caption.
pub type Fact = (&'static str, String);

/// What a response is to, with what is assumed where nobody says.
pub const fn response_words(response: Response) -> &'static str {
    match response {
        Response::PerEnergy => "per energy",
        Response::PerPhoton => "per photon",
        Response::Unknown => "not stated; taken per energy",
    }
}

/// A range of wavelengths.
pub fn range_words([first, last]: [f64; 2]) -> String {
    format!("{}–{} nm", number(first), number(last))
}

/// The range that all curves of a set are within; parses the set.
fn range(scene: &Scene<'_>, entry: &Entry) -> Option<[f64; 2]> {
    let ranges: Vec<[f64; 2]> = match &entry.place {
        Place::BuiltIn { path, column } => {
            let file = scene.results.ask(&FileOf(path));
            let dataset = (*file).as_ref().ok()?;
            let wanted = |index: usize| column.is_none_or(|c| c == index);
            let curves = dataset.curves.iter().enumerate().filter(|(index, _)| wanted(*index));
            curves.map(|(_, curve)| curve.range_nm()).collect()
        }
        Place::Own(set) => set.curves_in_nm().ok()?.iter().map(|(_, curve)| curve.range_nm()).collect(),
    };
    ranges.into_iter().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// All that is known about a set. `with_range` parses it.
pub fn of(scene: &Scene<'_>, entry: &Entry, with_range: bool) -> Vec<Fact> {
    let mut facts: Vec<Fact> = Vec::new();
    let is_sensor = matches!(entry.kind, Kind::Camera | Kind::Observer);
    if let Some(header) = &entry.header {
        let unit = if header.unit == "1" { String::new() } else { format!(", in {}", header.unit) };
        facts.push(("Quantity", format!("{}{unit}", header.quantity)));
    }
    if with_range && let Some(range) = range(scene, entry) {
        facts.push(("Range", range_words(range)));
    }
    if let Some(header) = &entry.header {
        if is_sensor {
            facts.push(("Response", response_words(header.response()).to_owned()));
        }
        facts.push(("Source", header.source.clone()));
        facts.push(("Terms", header.license.clone()));
        facts.extend(header.notes.iter().map(|note| ("Note", note.clone())));
    }
    if let Place::Own(set) = &entry.place {
        facts.push(("File", set.file.clone()));
        if set.role == Role::Camera {
            facts.push(("Response", response_words(set.response()).to_owned()));
        }
        facts.extend(set.decisions.iter().map(|decision| ("Read", decision.clone())));
    }
    facts
}

/// Writes facts below each other, each with its caption.
pub fn show(ui: &mut Ui, theme: &Theme, facts: &[Fact]) {
    let mut last = "";
    for (caption, words) in facts {
        let mut job = LayoutJob::default();
        let format = |color| TextFormat { font_id: egui::FontId::proportional(SMALL), color, ..TextFormat::default() };
        // A caption is said once for several notes.
        if *caption == last {
            job.append("· ", 0.0, format(theme.weak));
        } else {
            job.append(caption, 0.0, format(theme.weak));
            job.append("  ", 0.0, format(theme.weak));
        }
        job.append(words, 0.0, format(theme.text));
        ui.label(job);
        last = caption;
    }
}

/// What a data set is, for the pointer on its name.
pub fn tooltip(ui: &mut Ui, scene: &Scene<'_>, theme: &Theme, entry: &Entry) {
    ui.set_max_width(360.0);
    ui.strong(&entry.name);
    if let Some(also) = &entry.also {
        ui.label(also);
    }
    ui.add_space(UNIT);
    show(ui, theme, &of(scene, entry, true));
}
