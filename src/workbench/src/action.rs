//! Every change a user can make to the document. Undo is the previous document.

pub mod history;

use std::mem::discriminant;
use std::path::PathBuf;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Shared;

use crate::document::correction::CorrectionChoice;
use crate::document::imported::ImportedSet;
use crate::document::measurement::Measurement;
use crate::document::names::{BuiltInNames, PLACES};
use crate::document::render::{BALANCE, MeshChoice, RenderSettings, SUN};
use crate::document::start::Start;
use crate::document::{
    Compared, Diagram, Document, Exaggeration, FIT_TARGET, LOCUS_RANGE_K, Light, MOST_COMPARED, Overlays, Pixel,
    SetKind, Subset, TransformChoice, WhiteBalanceChoice,
};

#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    Compare(CompareAction),
    Scene(SceneAction),
    Render(RenderAction),
    Imported(ImportedAction),
    /// Another state of the measurement of a camera, in a step of this name.
    Measure(&'static str, Box<Measurement>),
    /// A choice of light or white balance made where pictures of their own light are visible: they take it too.
    ForPictures(Box<Action>),
    /// Begins again from a named start; imported sets stay.
    Start(Start),
    /// All back to the start that the document was made from; imported sets stay.
    Reset,
}

/// Changes to the comparison. An empty label takes a renamed sensor's own back. A reference is added where it is not compared; a fitted
/// color transform follows to one that counts in XYZ: whose color matching functions are XYZ, so that it can be fitted to.
#[derive(Clone, Debug, PartialEq)]
pub enum CompareAction {
    Add(SetKind, String),
    Remove(SetKind, String),
    SetVisible(SetKind, String, bool),
    Rename(SetKind, String, String),
    SetReference { name: String, counts_in_xyz: bool },
}

#[derive(Clone, Debug, PartialEq)]
pub enum SceneAction {
    SetLight(Light),
    /// Puts a filter in front of the light, or takes it away.
    SetFilter(String, bool),
    ClearFilters,
    SetTemperature(f64),
    SetPixel(Option<Pixel>),
    SetChart(String),
    SetSubset(Subset),
    SetWhite(WhiteBalanceChoice),
    SetTransform(TransformChoice),
    /// Another color correction; where Eq 13 was chosen, a transform is fitted to the default observer.
    SetCorrection(CorrectionChoice),
    SetDifference(Metric),
    SetExaggeration(Exaggeration),
    SetDiagram(Diagram),
    SetOverlays(Overlays),
}

/// Changes to the rendered scene. The settings are independent numbers, so that a change consists of the new settings and the
/// name of the changed one, as shown in the menu. A file is opened once it was read. The paper's Figures 8 and 9 are head and fern
/// under sunlight, balanced to D55; in the paper's own setup the light is a point, and Eq 12 in the paper's normalization.
#[derive(Clone, Debug, PartialEq)]
pub enum RenderAction {
    Set { what: &'static str, to: Box<RenderSettings> },
    Open(PathBuf),
    OpenImage(PathBuf),
    Figure8,
    Figure9,
    PaperFigure8,
    PaperFigure9,
}

/// Changes of the user's own sets. Imported cameras are added to the comparison, of several while the palette has room; light,
/// filters and chart stay, and a name in use is replaced by a free one. A set is replaced by another version: another unit, role
/// or name; several in a step of the given name, each with the name that it had, and those beside, whose file came back in another
/// role, are added and not used. A set is used as the light, as the chart, as a filter, or in the comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum ImportedAction {
    Import { sets: Vec<ImportedSet>, built_in: BuiltInNames },
    Replace { name: String, with: Box<ImportedSet>, built_in: BuiltInNames },
    Use(SetKind, String),
    ReplaceAll { what: String, with: Vec<(String, ImportedSet)>, beside: Vec<ImportedSet>, built_in: BuiltInNames },
    Remove(String),
}

impl Action {
    pub fn name(&self) -> String {
        match self {
            Self::Compare(action) => action.name(),
            Self::Scene(action) => action.name(),
            Self::Render(RenderAction::Open(path) | RenderAction::OpenImage(path)) => {
                let name = path.file_name().unwrap_or(path.as_os_str());
                format!("Open {}", name.to_string_lossy())
            }
            Self::Render(action) => action.name().to_owned(),
            Self::Imported(action) => action.name(),
            Self::Measure(what, _) => (*what).to_owned(),
            Self::ForPictures(action) => action.name(),
            Self::Start(start) => format!("Start: {}", start.label()),
            Self::Reset => "Reset to the first screen".to_owned(),
        }
    }

    /// True if a change during the same drag belongs to the same step.
    pub fn is_same_gesture(&self, next: &Self) -> bool {
        use SceneAction::{SetCorrection, SetPixel, SetTemperature, SetWhite};
        match (self, next) {
            (Self::Render(RenderAction::Set { what, .. }), Self::Render(RenderAction::Set { what: next, .. }))
            | (Self::Measure(what, _), Self::Measure(next, _)) => what == next,
            (Self::ForPictures(action), Self::ForPictures(next)) => action.is_same_gesture(next),
            (
                Self::Scene(action @ (SetTemperature(_) | SetPixel(_) | SetWhite(_) | SetCorrection(_))),
                Self::Scene(next),
            ) => discriminant(action) == discriminant(next),
            _ => false,
        }
    }

    /// Changes the document. Pure: depends on the document and the action alone.
    pub fn apply(&self, document: &mut Document) {
        match self {
            Self::Compare(action) => action.apply(document),
            Self::Scene(action) => action.apply(document),
            Self::Render(action) => action.apply(document),
            Self::Imported(action) => action.apply(document),
            Self::Measure(_, to) => document.measurement.clone_from(to),
            Self::ForPictures(action) => {
                document.render.sunlight = false;
                action.apply(document);
            }
            Self::Start(start) => begin(document, *start),
            Self::Reset => begin(document, document.start),
        }
    }
}

/// Begins again from a named start, with the imported sets and the measured camera available.
fn begin(document: &mut Document, start: Start) {
    let (own, measurement) = (std::mem::take(&mut document.own), std::mem::take(&mut document.measurement));
    let (session, unknown) = (document.session.take(), std::mem::take(&mut document.unknown));
    *document = Document { own, measurement, session, unknown, ..start.document() };
}

fn named<'a>(document: &'a mut Document, kind: SetKind, name: &'a str) -> impl Iterator<Item = &'a mut Compared> {
    document.compared.iter_mut().filter(move |compared| compared.kind == kind && compared.name == name)
}

impl CompareAction {
    fn name(&self) -> String {
        match self {
            Self::Add(_, name) => format!("Compare {name}"),
            Self::Remove(_, name) => format!("Remove {name} from comparison"),
            Self::SetVisible(_, name, true) => format!("Show {name}"),
            Self::SetVisible(_, name, false) => format!("Hide {name}"),
            Self::Rename(_, name, _) => format!("Rename {name}"),
            Self::SetReference { name, .. } => format!("Reference: {name}"),
        }
    }

    fn apply(&self, document: &mut Document) {
        match self {
            Self::Add(kind, name) => document.compare(name, *kind),
            Self::Remove(kind, name) => {
                if *kind != SetKind::Observer || *name != document.reference {
                    document.compared.retain(|c| c.kind != *kind || c.name != *name);
                }
            }
            Self::SetVisible(kind, name, visible) => {
                named(document, *kind, name).for_each(|compared| compared.visible = *visible);
            }
            Self::Rename(kind, name, label) => {
                let label = label.trim();
                let label = (!label.is_empty() && label != *name).then(|| label.to_owned());
                named(document, *kind, name).for_each(|compared| compared.label.clone_from(&label));
            }
            Self::SetReference { name, counts_in_xyz } => {
                document.compare(name, SetKind::Observer);
                document.reference.clone_from(name);
                if *counts_in_xyz && matches!(document.transform, TransformChoice::Observer(_)) {
                    document.set_transform(TransformChoice::Observer(name.clone()));
                }
                named(document, SetKind::Observer, name).for_each(|compared| compared.visible = true);
            }
        }
    }
}

impl SceneAction {
    fn name(&self) -> String {
        match self {
            Self::SetLight(Light::Set(name)) => format!("Illuminant: {name}"),
            Self::SetLight(Light::BlackBody) => "Illuminant: blackbody".to_owned(),
            Self::SetLight(Light::Daylight) => "Illuminant: daylight".to_owned(),
            Self::SetFilter(name, true) => format!("Add filter {name}"),
            Self::SetFilter(name, false) => format!("Remove filter {name}"),
            Self::ClearFilters => "Remove all filters".to_owned(),
            Self::SetTemperature(kelvin) => format!("Temperature: {kelvin:.0} K"),
            Self::SetPixel(Some(pixel)) => format!("Pixel: {}", pixel.describe()),
            Self::SetPixel(None) => "Pixel: not given".to_owned(),
            Self::SetChart(name) => format!("Patches: {name}"),
            Self::SetSubset(subset) => format!("Patches: {}", subset.key()),
            Self::SetWhite(white) => format!("White balance: {}", white.name()),
            Self::SetTransform(TransformChoice::Paper) => "Color transform: paper matrix".to_owned(),
            Self::SetTransform(TransformChoice::Observer(name)) => format!("Color transform: fitted to {name}"),
            Self::SetCorrection(correction) => format!("Color correction: {}", correction.method.label()),
            Self::SetDifference(metric) => format!("Difference: {}", metric.symbol),
            Self::SetExaggeration(to) => format!("Exaggerate: {}", to.label()),
            Self::SetDiagram(diagram) => format!("Diagram: {}", diagram.label()),
            Self::SetOverlays(_) => "Overlays of the diagram".to_owned(),
        }
    }

    fn apply(&self, document: &mut Document) {
        match self {
            Self::SetLight(light) => {
                document.light = light.clone();
                // Daylight begins at 4000 K; a temperature from elsewhere would leave the scene without light.
                if *light == Light::Daylight {
                    document.temperature_k = document.temperature_k.max(4000.0);
                }
            }
            Self::SetFilter(name, on) => document.set_filter(name, *on),
            Self::ClearFilters => document.filters.clear(),
            Self::SetTemperature(kelvin) if kelvin.is_finite() => {
                let low = if document.light == Light::Daylight { 4000.0 } else { LOCUS_RANGE_K[0] };
                document.temperature_k = kelvin.clamp(low, LOCUS_RANGE_K[1]);
            }
            Self::SetTemperature(_) => {}
            Self::SetPixel(pixel) => document.pixel = pixel.filter(|pixel| pixel.electrons().is_ok()),
            Self::SetChart(chart) => document.chart.clone_from(chart),
            Self::SetSubset(subset) => document.subset = *subset,
            Self::SetWhite(white) => document.white = white.clone(),
            Self::SetTransform(transform) => document.set_transform(transform.clone()),
            Self::SetCorrection(correction) => {
                document.correction.clone_from(correction);
                if document.transform.is_eq_13() {
                    document.set_transform(TransformChoice::Observer(FIT_TARGET.to_owned()));
                }
            }
            Self::SetDifference(difference) => document.difference = *difference,
            Self::SetExaggeration(to) => document.exaggeration = *to,
            Self::SetDiagram(diagram) => document.set_diagram(*diagram),
            Self::SetOverlays(overlays) => document.overlays = *overlays,
        }
    }
}

impl RenderAction {
    fn name(&self) -> &'static str {
        match self {
            Self::Set { what, .. } => what,
            Self::Open(_) => "Open a mesh",
            Self::OpenImage(_) => "Open a spectral image",
            Self::Figure8 => "Figure 8",
            Self::Figure9 => "Figure 9",
            Self::PaperFigure8 => "Figure 8, as in the paper",
            Self::PaperFigure9 => "Figure 9, as in the paper",
        }
    }

    fn apply(&self, document: &mut Document) {
        let figure = match self {
            Self::Set { to, .. } => return document.render.clone_from(to),
            Self::Open(path) => return document.render.mesh = MeshChoice::File(path.clone()),
            Self::OpenImage(path) => return document.render.mesh = MeshChoice::Image(path.clone()),
            Self::Figure8 => {
                RenderSettings { specular: document.start.specular(), sky: 0.0, ..RenderSettings::default() }
            }
            Self::Figure9 => RenderSettings { specular: document.start.specular(), sky: 0.0, ..RenderSettings::fern() },
            Self::PaperFigure8 => RenderSettings::default().as_in_the_paper(),
            Self::PaperFigure9 => RenderSettings::fern().as_in_the_paper(),
        };
        document.render = RenderSettings { sunlight: false, ..figure };
        document.light = Light::Set(SUN.to_owned());
        document.white = WhiteBalanceChoice::Light(BALANCE.to_owned());
    }
}

impl ImportedAction {
    pub fn name(&self) -> String {
        match self {
            Self::Import { sets, .. } => match sets.as_slice() {
                [one] if one.measured.is_some() => format!("Add camera {}", one.name),
                [one] => format!("Open {}", one.name),
                many => format!("Open {} sets", many.len()),
            },
            Self::Replace { name, .. } => format!("Change {name}"),
            Self::ReplaceAll { what, .. } => what.clone(),
            Self::Use(kind, name) => match kind.used_as() {
                Some(used) => format!("Use {name} as {used}"),
                None => format!("Compare {name}"),
            },
            Self::Remove(name) => format!("Remove {name}"),
        }
    }

    fn apply(&self, document: &mut Document) {
        match self {
            Self::Import { sets, built_in } => {
                let most = if sets.len() == 1 { MOST_COMPARED } else { PLACES };
                for set in sets {
                    let set = add(document, set, built_in);
                    document.compare_camera(&set, most);
                }
            }
            Self::Use(kind, name) => {
                let is_it = |set: &&Shared<ImportedSet>| SetKind::of_own(set) == *kind && set.name == *name;
                if let Some(set) = document.own.iter().find(is_it).cloned() {
                    document.put_to_use(&set);
                }
            }
            Self::Replace { name, with, built_in } => replace(document, name, with, built_in),
            Self::ReplaceAll { with, beside, built_in, .. } => {
                for (name, with) in with {
                    replace(document, name, with, built_in);
                }
                for set in beside {
                    add(document, set, built_in);
                }
            }
            Self::Remove(name) => {
                let Some(index) = document.own.iter().position(|set| set.name == *name) else { return };
                let set = document.own.remove(index);
                document.forget_name(SetKind::of_own(&set), name);
            }
        }
    }
}

/// Adds a set, or finds it: the file of a set that is opened again with the same contents leaves the set and the user's settings
/// as they are; other contents in the same role replace the set's under its name.
fn add(document: &mut Document, set: &ImportedSet, built_in: &BuiltInNames) -> Shared<ImportedSet> {
    let Some(index) = document.same_set(set) else {
        let name = document.free_name(SetKind::of_own(set), &set.name, None, built_in);
        let set = Shared::new(ImportedSet { name, ..set.clone() });
        document.own.push(set.clone());
        return set;
    };
    let name = document.own[index].name.clone();
    if set.measured.is_some() {
        // Under the name that the measurement has by now.
        replace(document, &name, set, built_in);
    } else if set.fingerprint != document.own[index].fingerprint {
        replace(document, &name, &ImportedSet { name: name.clone(), ..set.clone() }, built_in);
    }
    document.own[index].clone()
}

/// Replaces a set by another version. Its uses stay, unless its kind has changed.
fn replace(document: &mut Document, name: &str, with: &ImportedSet, built_in: &BuiltInNames) {
    let Some(index) = document.own.iter().position(|set| set.name == name) else { return };
    let before = SetKind::of_own(&document.own[index]);
    let mut set = Shared::new(with.clone());
    let kind = SetKind::of_own(&set);
    let free = document.free_name(kind, &set.name, Some(index), built_in);
    if free != set.name {
        set = Shared::new(ImportedSet { name: free, ..with.clone() });
    }
    document.own[index] = set.clone();
    if kind != before {
        document.forget_name(before, name);
        document.compare_camera(&set, MOST_COMPARED);
    } else if set.name != name {
        document.follow_name(kind, name, &set.name);
    }
}
