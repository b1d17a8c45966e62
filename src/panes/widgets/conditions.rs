//! The conditions of the scene with their alternatives: the scene bar offers them, and the palette finds them.

use chromascope_core::correction::CorrectionMethod;

use super::pick_list::Line;
use crate::action::{Action, CompareAction, SceneAction};
use crate::catalog::Entry;
use crate::document::correction::CorrectionChoice;
use crate::document::{Exaggeration, Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::scene::Scene;

/// A line with its action; a heading has none.
pub type Alternative = (Line, Option<Action>);

/// Lists the alternatives of a condition.
pub type Listing = fn(&Scene<'_>) -> Vec<Alternative>;

/// All conditions but the temperature, by name.
pub const ALL: [(&str, Listing); 8] = [
    ("Reference", references),
    ("Light", lights),
    ("Patches", patches),
    ("White balance", whites),
    ("Filter", filters),
    ("Color transform", transforms),
    ("Difference", differences),
    ("Exaggerate", exaggerations),
];

fn heading(words: &str) -> Alternative {
    (Line::heading(words), None)
}

fn offer(line: Line, on: bool, action: SceneAction) -> Alternative {
    (Line { on, ..line }, Some(Action::Scene(action)))
}

fn named(words: impl Into<String>, on: bool, action: SceneAction) -> Alternative {
    offer(Line::new(words, on), on, action)
}

pub fn references(scene: &Scene<'_>) -> Vec<Alternative> {
    let observers = scene.entries(SetKind::Observer).map(|entry| {
        let line = Line::of_set(&entry, entry.name == scene.document.reference);
        let counts_in_xyz = entry.counts_in_xyz();
        (line, Some(Action::Compare(CompareAction::SetReference { name: entry.name, counts_in_xyz })))
    });
    observers.collect()
}

pub fn lights(scene: &Scene<'_>) -> Vec<Alternative> {
    let set = |line: Line, light: Light| offer(line, scene.document.light == light, SceneAction::SetLight(light));
    let black_body = Line { also: "Planckian".to_owned(), ..Line::new("Blackbody at the temperature", false) };
    let daylight = Line::new("Daylight at the temperature, 4000–20000 K", false);
    let mut all = vec![
        heading("At the temperature"),
        set(black_body, Light::BlackBody),
        set(daylight, Light::Daylight),
        heading("Illuminants"),
    ];
    let illuminants = scene.entries(SetKind::Illuminant);
    all.extend(illuminants.map(|entry| set(Line::of_set(&entry, false), Light::Set(entry.name))));
    all
}

pub fn patches(scene: &Scene<'_>) -> Vec<Alternative> {
    let document = scene.document;
    let mut all = Vec::new();
    if scene.has_five() {
        let five = document.subset == Subset::Five;
        all.push(named("The paper's five", five, SceneAction::SetSubset(Subset::Five)));
        all.push(named("All of the chart", !five, SceneAction::SetSubset(Subset::All)));
    }
    for (kind, words) in [(SetKind::Chart, "Charts"), (SetKind::Material, "Single reflectances")] {
        all.push(heading(words));
        all.extend(scene.entries(kind).map(|entry| {
            let on = entry.name == document.chart;
            offer(Line::of_set(&entry, on), on, SceneAction::SetChart(entry.name))
        }));
    }
    all
}

pub fn whites(scene: &Scene<'_>) -> Vec<Alternative> {
    let set = |line: Line, white: WhiteBalanceChoice| {
        offer(line, scene.document.white == white, SceneAction::SetWhite(white))
    };
    let kelvin = scene.document.temperature_k;
    let daylight = kelvin.max(4000.0);
    let unity = "Unity, 1 : 1 : 1 (the paper's experiments 1 and 2)";
    let mut all = vec![
        set(Line::new(unity, false), WhiteBalanceChoice::Unity),
        set(Line::new(format!("Daylight {daylight:.0} K"), false), WhiteBalanceChoice::Daylight(daylight)),
        set(Line::new(format!("Blackbody {kelvin:.0} K"), false), WhiteBalanceChoice::BlackBody(kelvin)),
        heading("Illuminants"),
    ];
    let illuminants = scene.entries(SetKind::Illuminant);
    all.extend(illuminants.map(|entry| set(Line::of_set(&entry, false), WhiteBalanceChoice::Light(entry.name))));
    all
}

pub fn filters(scene: &Scene<'_>) -> Vec<Alternative> {
    let used = &scene.document.filters;
    let remove = (!used.is_empty()).then(|| named("Remove filters", false, SceneAction::ClearFilters));
    let filters = scene.entries(SetKind::Filter).map(|entry| {
        let on = used.contains(&entry.name);
        offer(Line::of_set(&entry, on), on, SceneAction::SetFilter(entry.name, !on))
    });
    remove.into_iter().chain(filters).collect()
}

pub fn transforms(scene: &Scene<'_>) -> Vec<Alternative> {
    let (now, correction) = (&scene.document.transform, &scene.document.correction);
    let set = |words: String, to: TransformChoice| named(words, *now == to, SceneAction::SetTransform(to));
    let mut all =
        vec![set("Paper matrix (Eq 13)".to_owned(), TransformChoice::Paper), heading("Fitted to an observer")];
    let observers = scene.entries(SetKind::Observer).filter(Entry::counts_in_xyz);
    all.extend(observers.map(|entry| set(format!("Fitted to {}", entry.name), TransformChoice::Observer(entry.name))));
    all.push(heading("Method of the fit"));
    all.extend(CorrectionMethod::ALL.map(|method| {
        let line = Line { also: "color correction".to_owned(), ..Line::new(method.label(), false) };
        let on = !now.is_eq_13() && correction.method == method;
        offer(line, on, SceneAction::SetCorrection(CorrectionChoice { method, ..correction.clone() }))
    }));
    all
}

pub fn differences(scene: &Scene<'_>) -> Vec<Alternative> {
    let document = scene.document;
    let metrics = document.transform.metrics().into_iter().map(|metric| {
        let also = format!("delta E {} {}", metric.id, metric.label);
        let line = Line::new(metric.name(document.transform.is_eq_13()), false);
        let line = Line { note: metric.label.to_owned(), also, ..line };
        offer(line, document.difference == metric, SceneAction::SetDifference(metric))
    });
    metrics.collect()
}

pub fn exaggerations(scene: &Scene<'_>) -> Vec<Alternative> {
    let line = |to: Exaggeration| {
        let line = Line { note: to.why().to_owned(), also: "magnify".to_owned(), ..Line::new(to.label(), false) };
        offer(line, scene.document.exaggeration == to, SceneAction::SetExaggeration(to))
    };
    Exaggeration::ALL.map(line).into()
}
