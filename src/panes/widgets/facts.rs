//! Facts about a data set, for tooltips and the inspector.

use chromascope_core::query::Ask;
use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_core::spectral::{Evidence, Header, Interpolation, Quantity, Response, SpectralDistribution};
use egui::text::LayoutJob;
use egui::{TextFormat, Ui};

use crate::catalog::load::FileQuery;
use crate::catalog::{Entry, Place};
use crate::document::SetKind;
use crate::document::imported::Role;
use crate::format::number;
use crate::scene::Scene;
use crate::theme::{SMALL, Theme};

pub type Fact = (&'static str, String);

pub fn response_of(header: &Header) -> String {
    let words = match (header.response(), header.response_evidence()) {
        (Response::Unknown, _) | (_, Evidence::Unknown) => "unknown, assumed per energy".to_owned(),
        (response, Evidence::Stated) => format!("{}, stated", response_words(response)),
        (response, Evidence::Inferred) => format!("{}, inferred", response_words(response)),
    };
    match header.response_note() {
        Some(note) => format!("{words}: {note}"),
        None => words,
    }
}

/// Resampling of a table to the 1 nm grid, and its values beyond its ends.
pub fn resampling_words(curve: &SpectralDistribution, quantity: Quantity) -> String {
    let steps = match Interpolation::of(curve, quantity) {
        Interpolation::None => "none needed, 1 nm as measured",
        Interpolation::Sprague => "to 1 nm by Sprague's interpolation",
        Interpolation::Linear => "to 1 nm, linear between samples",
    };
    let range = curve.range_nm();
    if range[0] <= FIRST_NM && range[1] >= LAST_NM {
        return steps.to_owned();
    }
    let beyond = match quantity {
        Quantity::Light | Quantity::Reflectance => "end values held",
        Quantity::CameraSensitivity | Quantity::MatchingFunction => "zero",
    };
    format!("{steps}; {beyond} outside {}", range_words(range))
}

pub const fn response_words(response: Response) -> &'static str {
    match response {
        Response::PerEnergy => "per energy",
        Response::PerPhoton => "per photon",
        Response::Unknown => "not stated; assumed per energy",
    }
}

pub fn range_words([first, last]: [f64; 2]) -> String {
    format!("{}–{} nm", number(first), number(last))
}

/// The range that all curves of a set are within, and the first curve; parses the set.
pub fn range(scene: &Scene<'_>, entry: &Entry) -> Option<([f64; 2], SpectralDistribution)> {
    let union = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
    match &entry.place {
        Place::BuiltIn { file, column } => {
            let file = scene.results.ask(&FileQuery(*file));
            let curves = &(*file).as_ref().ok()?.curves;
            let curves = column.map_or(&curves[..], |column| curves.get(column).map_or(&[], std::slice::from_ref));
            let range = curves.iter().map(SpectralDistribution::range_nm).reduce(union)?;
            Some((range, curves.first()?.clone()))
        }
        Place::Own(set) => {
            let curves = set.curves_in_nm().ok()?;
            let range = curves.iter().map(|(_, curve)| curve.range_nm()).reduce(union)?;
            Some((range, curves.into_iter().next()?.1))
        }
    }
}

const fn quantity(kind: SetKind) -> Option<Quantity> {
    match kind {
        SetKind::Camera => Some(Quantity::CameraSensitivity),
        SetKind::Observer => Some(Quantity::MatchingFunction),
        SetKind::Chart | SetKind::Material | SetKind::Filter => Some(Quantity::Reflectance),
        SetKind::Illuminant => Some(Quantity::Light),
        SetKind::Unsorted => None,
    }
}

/// All that is known about a set. `with_range` parses it.
pub fn of(scene: &Scene<'_>, entry: &Entry, with_range: bool) -> Vec<Fact> {
    let mut facts: Vec<Fact> = Vec::new();
    let is_sensor = matches!(entry.kind, SetKind::Camera | SetKind::Observer);
    if let Some(header) = &entry.header {
        let unit = if header.unit == "1" { String::new() } else { format!(", in {}", header.unit) };
        facts.push(("Quantity", format!("{}{unit}", header.quantity)));
    }
    if with_range && let Some((range, curve)) = range(scene, entry) {
        facts.push(("Range", range_words(range)));
        facts.extend(quantity(entry.kind).map(|quantity| ("Resampled", resampling_words(&curve, quantity))));
    }
    if let Some(header) = &entry.header {
        if is_sensor {
            facts.push(("Response", response_of(header)));
        }
        if header.is_digitized() {
            facts.push(("Origin", "digitized from a figure".to_owned()));
        }
        facts.push(("Source", header.source.clone()));
        facts.push(("Terms", header.license.clone()));
        // The grounds of the response are listed with it.
        let told = header.response_note().filter(|_| is_sensor);
        let notes = header.notes.iter().filter(|note| Some(note.as_str()) != told);
        facts.extend(notes.map(|note| ("Note", note.clone())));
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

pub fn show(ui: &mut Ui, theme: &Theme, facts: &[Fact]) {
    let mut last = "";
    for (caption, words) in facts {
        let mut job = LayoutJob::default();
        let format = |color| TextFormat { font_id: egui::FontId::proportional(SMALL), color, ..TextFormat::default() };
        // Several notes share one caption.
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

/// Credibility of a camera's channel ratio; none for an observer and for damaged tables.
pub fn channel_ratio(scene: &Scene<'_>, entry: &Entry) -> Option<Fact> {
    let ratio = (entry.kind == SetKind::Camera).then(|| scene.channel_ratio(&entry.name))?.ok()?;
    Some(("Channel ratio", ratio.to_string()))
}

/// Source and terms of a data set, for the pointer on its name. Parses nothing.
pub fn provenance(scene: &Scene<'_>, entry: &Entry) -> String {
    let facts =
        of(scene, entry, false).into_iter().filter(|(caption, _)| ["Source", "Terms", "File"].contains(caption));
    facts.map(|(caption, words)| format!("{caption}: {words}")).collect::<Vec<_>>().join("\n")
}
