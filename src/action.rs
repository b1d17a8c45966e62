//! Every change a user can make to the document. Undo is the previous document.

use std::path::PathBuf;

use chromascope_core::query::Shared;

use crate::catalog::{Entry, Kind};
use crate::document::own::OwnSet;
use crate::document::render::{BALANCE, MeshChoice, RenderSettings, SUN};
use crate::document::{
    Diagram, DifferenceChoice, Document, LOCUS_RANGE_K, Light, Overlays, Subset, WayChoice, WhiteChoice,
};

/// A change of the document.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// To the list of compared sources.
    Compare(CompareAction),
    /// To the conditions of the scene.
    Scene(SceneAction),
    /// To the rendered scene.
    Render(RenderAction),
    /// To the user's own sets.
    Own(OwnAction),
    /// All back to the first screen; own sets stay.
    Reset,
}

/// Changes to the list of compared sources.
#[derive(Clone, Debug, PartialEq)]
pub enum CompareAction {
    /// Puts a source on show.
    Add(Kind, String),
    /// Takes a source off; the truth stays.
    Remove(Kind, String),
    /// Shows or hides a source's curves.
    SetVisible(Kind, String, bool),
    /// Gives a source another label; an empty one takes it back.
    Rename(Kind, String, String),
    /// Makes an observer the truth, putting it on show.
    SetTruth(String),
}

/// Changes to the conditions.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneAction {
    /// Another light.
    SetLight(Light),
    /// Another temperature, in kelvins.
    SetTemperature(f64),
    /// Another chart.
    SetChart(String),
    /// Five patches or all.
    SetSubset(Subset),
    /// Another white.
    SetWhite(WhiteChoice),
    /// Another way to the diagram.
    SetWay(WayChoice),
    /// Another measure of difference.
    SetDifference(DifferenceChoice),
    /// Other coordinates.
    SetDiagram(Diagram),
    /// Other things on the diagram.
    SetOverlays(Overlays),
}

/// Changes to the rendered scene. The settings are a record of independent numbers, so a change is the record as it is to be,
/// with the name of what was moved.
#[derive(Clone, Debug, PartialEq)]
pub enum RenderAction {
    /// Other settings.
    Set {
        /// What was changed, as the menu calls it.
        what: &'static str,
        /// The settings as they are to be.
        to: Box<RenderSettings>,
    },
    /// Looks at a mesh file of the user's, which was read.
    Open(PathBuf),
    /// The paper's Figure 8: the head under sunlight, balanced to D55.
    Figure8,
    /// The paper's Figure 9: the fern under sunlight, balanced to D55.
    Figure9,
}

/// Changes to the user's own sets.
#[derive(Clone, Debug, PartialEq)]
pub enum OwnAction {
    /// Brings sets in and puts them to use. Names that are taken get a number.
    Import(Vec<OwnSet>),
    /// Puts another version of a set in its place: another unit, role or name.
    Replace {
        /// The name it had.
        name: String,
        /// The set as it is to be.
        with: Box<OwnSet>,
    },
    /// Puts other versions of some sets in their places, because of what the step is called.
    ReplaceAll {
        /// What the step is called.
        what: String,
        /// The names they had, and the sets as they are to be.
        with: Vec<(String, OwnSet)>,
    },
    /// Takes a set out, and off the list.
    Remove(String),
}

impl Action {
    /// What the step is called in the menu.
    pub fn name(&self) -> String {
        match self {
            Self::Compare(action) => action.name(),
            Self::Scene(action) => action.name().to_owned(),
            Self::Render(RenderAction::Open(path)) => {
                let name = path.file_name().unwrap_or(path.as_os_str());
                format!("Open {}", name.to_string_lossy())
            }
            Self::Render(action) => action.name().to_owned(),
            Self::Own(OwnAction::Import(sets)) => match sets.as_slice() {
                [one] => format!("Open {}", one.name),
                many => format!("Open {} sets", many.len()),
            },
            Self::Own(OwnAction::Replace { name, .. }) => format!("Change {name}"),
            Self::Own(OwnAction::ReplaceAll { what, .. }) => what.clone(),
            Self::Own(OwnAction::Remove(name)) => format!("Remove {name}"),
            Self::Reset => "Reset to the first screen".to_owned(),
        }
    }

    /// Whether a change during the same drag belongs to the same step.
    pub fn is_same_gesture(&self, next: &Self) -> bool {
        if let (Self::Render(RenderAction::Set { what, .. }), Self::Render(RenderAction::Set { what: next, .. })) =
            (self, next)
        {
            return what == next;
        }
        matches!(
            (self, next),
            (Self::Scene(SceneAction::SetTemperature(_)), Self::Scene(SceneAction::SetTemperature(_)))
                | (Self::Scene(SceneAction::SetWhite(_)), Self::Scene(SceneAction::SetWhite(_)))
        )
    }

    /// Changes the document. Pure: depends on the document and the action alone.
    pub fn apply(&self, document: &mut Document) {
        match self {
            Self::Compare(action) => action.apply(document),
            Self::Scene(action) => action.apply(document),
            Self::Render(action) => action.apply(document),
            Self::Own(action) => action.apply(document),
            Self::Reset => {
                let own = std::mem::take(&mut document.own);
                let unknown = std::mem::take(&mut document.unknown);
                *document = Document { own, unknown, ..Document::default() };
            }
        }
    }
}

impl CompareAction {
    fn name(&self) -> String {
        match self {
            Self::Add(_, name) => format!("Compare {name}"),
            Self::Remove(_, name) => format!("Take {name} off"),
            Self::SetVisible(_, name, true) => format!("Show {name}"),
            Self::SetVisible(_, name, false) => format!("Hide {name}"),
            Self::Rename(_, name, _) => format!("Rename {name}"),
            Self::SetTruth(name) => format!("Truth: {name}"),
        }
    }

    fn apply(&self, document: &mut Document) {
        match self {
            Self::Add(kind, name) => document.compare(name, *kind),
            Self::Remove(kind, name) => {
                if *kind != Kind::Observer || *name != document.truth {
                    document.compared.retain(|c| c.kind != *kind || c.name != *name);
                }
            }
            Self::SetVisible(kind, name, visible) => {
                for compared in document.compared.iter_mut().filter(|c| c.kind == *kind && c.name == *name) {
                    compared.visible = *visible;
                }
            }
            Self::Rename(kind, name, label) => {
                let label = label.trim();
                for compared in document.compared.iter_mut().filter(|c| c.kind == *kind && c.name == *name) {
                    compared.label = (!label.is_empty() && label != *name).then(|| label.to_owned());
                }
            }
            Self::SetTruth(name) => {
                document.compare(name, Kind::Observer);
                document.truth.clone_from(name);
                for compared in document.compared.iter_mut().filter(|c| c.kind == Kind::Observer && c.name == *name) {
                    compared.visible = true;
                }
            }
        }
    }
}

impl SceneAction {
    fn name(&self) -> &'static str {
        match self {
            Self::SetLight(_) => "Light",
            Self::SetTemperature(_) => "Temperature",
            Self::SetChart(_) => "Patches",
            Self::SetSubset(_) => "Number of patches",
            Self::SetWhite(_) => "White",
            Self::SetWay(_) => "To diagram",
            Self::SetDifference(_) => "Difference",
            Self::SetDiagram(_) => "Diagram",
            Self::SetOverlays(_) => "Shown on the diagram",
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
            Self::SetTemperature(kelvin) if kelvin.is_finite() => {
                let low = if document.light == Light::Daylight { 4000.0 } else { LOCUS_RANGE_K[0] };
                document.temperature_k = kelvin.clamp(low, LOCUS_RANGE_K[1]);
            }
            Self::SetTemperature(_) => {}
            Self::SetChart(chart) => document.chart.clone_from(chart),
            Self::SetSubset(subset) => document.subset = *subset,
            Self::SetWhite(white) => document.white = white.clone(),
            Self::SetWay(way) => document.way = way.clone(),
            Self::SetDifference(difference) => document.difference = *difference,
            Self::SetDiagram(diagram) => document.diagram = *diagram,
            Self::SetOverlays(overlays) => document.overlays = *overlays,
        }
    }
}

impl RenderAction {
    fn name(&self) -> &'static str {
        match self {
            Self::Set { what, .. } => what,
            Self::Open(_) => "Open a mesh",
            Self::Figure8 => "Figure 8",
            Self::Figure9 => "Figure 9",
        }
    }

    fn apply(&self, document: &mut Document) {
        let figure = match self {
            Self::Set { to, .. } => {
                document.render.clone_from(to);
                return;
            }
            Self::Open(path) => {
                document.render.mesh = MeshChoice::File(path.clone());
                return;
            }
            Self::Figure8 => RenderSettings::default(),
            Self::Figure9 => RenderSettings::fern(),
        };
        // The reading is what the two versions of each figure differ in, so it stays as it was chosen.
        document.render = RenderSettings { reading: document.render.reading, ..figure };
        document.light = Light::Set(SUN.to_owned());
        document.white = WhiteChoice::Light(BALANCE.to_owned());
    }
}

impl OwnAction {
    fn apply(&self, document: &mut Document) {
        match self {
            Self::Import(sets) => {
                for set in sets {
                    let mut set = set.clone();
                    set.name = free_name(document, &set.name, None);
                    let set = Shared::new(set);
                    put_to_use(document, &set);
                    document.own.push(set);
                }
            }
            Self::Replace { name, with } => replace(document, name, with),
            Self::ReplaceAll { with, .. } => with.iter().for_each(|(name, with)| replace(document, name, with)),
            Self::Remove(name) => {
                document.own.retain(|set| set.name != *name);
                forget(document, name);
            }
        }
    }
}

/// Puts another version of a set in its place. What it is used as stays, unless that has become something else.
fn replace(document: &mut Document, name: &str, with: &OwnSet) {
    let Some(index) = document.own.iter().position(|set| set.name == name) else { return };
    let mut set = with.clone();
    set.name = free_name(document, &set.name, Some(index));
    let before = Entry::from_own(&document.own[index]).kind;
    let set = Shared::new(set);
    document.own[index] = set.clone();
    if Entry::from_own(&set).kind != before {
        forget(document, name);
        put_to_use(document, &set);
    } else if set.name != name {
        follow(document, name, &set.name);
    }
}

/// Keeps a set that has another name now in the uses it had; it gets no others.
fn follow(document: &mut Document, old: &str, new: &str) {
    for compared in document.compared.iter_mut().filter(|c| c.kind == Kind::Camera && c.name == old) {
        new.clone_into(&mut compared.name);
    }
    for used in [&mut document.chart, &mut document.render.material] {
        if used == old {
            new.clone_into(used);
        }
    }
    if document.light == Light::Set(old.to_owned()) {
        document.light = Light::Set(new.to_owned());
    }
    if document.white == WhiteChoice::Light(old.to_owned()) {
        document.white = WhiteChoice::Light(new.to_owned());
    }
}

/// A name that no other own set has.
fn free_name(document: &Document, wanted: &str, except: Option<usize>) -> String {
    let taken =
        |name: &str| document.own.iter().enumerate().any(|(index, set)| Some(index) != except && set.name == name);
    if !taken(wanted) {
        return wanted.to_owned();
    }
    // Among one more names than there are sets, one is free.
    let numbers = 2..=document.own.len() + 2;
    numbers.map(|n| format!("{wanted} ({n})")).find(|name| !taken(name)).unwrap_or_else(|| wanted.to_owned())
}

/// Shows what was just opened: a camera in the list, a chart as the patches, a light as the light.
fn put_to_use(document: &mut Document, set: &Shared<OwnSet>) {
    match Entry::from_own(set).kind {
        Kind::Camera | Kind::Observer => document.compare(&set.name, Kind::Camera),
        Kind::Chart | Kind::Material => {
            document.chart.clone_from(&set.name);
            document.subset = Subset::All;
        }
        Kind::Illuminant => document.light = Light::Set(set.name.clone()),
        Kind::Unsorted => {}
    }
}

/// Takes a set that is no more out of use.
fn forget(document: &mut Document, name: &str) {
    document.compared.retain(|c| c.kind != Kind::Camera || c.name != name);
    if document.chart == name {
        crate::document::CHART.clone_into(&mut document.chart);
        document.subset = Subset::Five;
    }
    if document.light == Light::Set(name.to_owned()) {
        document.light = Light::Set(crate::document::LIGHT.to_owned());
    }
    if document.white == WhiteChoice::Light(name.to_owned()) {
        document.white = WhiteChoice::Unity;
    }
}
