//! Document: the compared sensors and their conditions. Saved; independent of the window.
//!
//! Contains nothing that can be computed from it and the data sets. The JSON it is saved as is the session file:
//! versioned, unknown fields preserved, the user's own data by value.

pub mod correction;
pub mod imported;
mod kind;
pub mod measurement;
pub mod names;
pub mod paths;
pub mod render;
pub mod session;
pub mod start;

use chromascope_core::camera::quality::{Electrons, ElectronsError};
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Shared;
use chromascope_text::choices;
use correction::CorrectionChoice;
pub use correction::TRAINING;
use imported::ImportedSet;
pub use imported::SessionFile;
pub use kind::{Light, SensorId, SetKind};
use measurement::Measurement;
use render::RenderSettings;
use serde::{Deserialize, Serialize};
use start::Start;

/// The version of the saved form that this program writes.
pub const VERSION: u32 = 4;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Document {
    pub format: String,
    pub version: u32,
    /// The start configuration that it was made from, to which a reset returns.
    pub start: Start,
    /// The compared cameras and observers, in the order of the list. The reference is among them.
    pub compared: Vec<Compared>,
    pub reference: String,
    pub light: Light,
    /// The filters in front of the light, in the order they were added; the order changes no number.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub filters: Vec<String>,
    /// Marks the loci; the light's own temperature where that has one. In kelvins.
    pub temperature_k: f64,
    /// Full well and read noise of the cameras, where they are given: for their signal-to-noise ratio.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pixel: Option<Pixel>,
    pub chart: String,
    pub subset: Subset,
    pub white: WhiteBalanceChoice,
    pub transform: TransformChoice,
    #[serde(skip_serializing_if = "CorrectionChoice::is_default")]
    pub correction: CorrectionChoice,
    #[serde(with = "metric_id")]
    pub difference: Metric,
    #[serde(skip_serializing_if = "Exaggeration::is_none")]
    pub exaggeration: Exaggeration,
    pub diagram: Diagram,
    pub overlays: Overlays,
    /// Mesh, material and view of the Render pane.
    pub render: RenderSettings,
    #[serde(with = "imported::list")]
    pub own: Vec<Shared<ImportedSet>>,
    /// Pictures of charts by the user's camera.
    #[serde(skip_serializing_if = "Measurement::is_none")]
    pub measurement: Measurement,
    /// File that it is saved in as a session, where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub session: Option<SessionFile>,
    /// Fields of the file that are unknown here, also within known ones; written back unchanged.
    #[serde(skip)]
    pub unknown: serde_json::Map<String, serde_json::Value>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Compared {
    pub name: String,
    pub kind: SetKind,
    /// Its place in the palette, constant while it is compared.
    pub slot: u8,
    #[serde(default = "yes")]
    pub visible: bool,
    /// Display label, if different from the name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
}

fn yes() -> bool {
    true
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Subset {
        #[default]
        Five = "five", "Five", "The paper's five: red, green, blue, white, orange yellow";
        All = "all", "All", "All patches of the chart";
    }
}

/// The color a perfect white is to take (Eq 11).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WhiteBalanceChoice {
    /// 1 : 1 : 1, the paper's experiments 1 and 2.
    #[default]
    Unity,
    Light(String),
    /// CIE daylight of a temperature in kelvins.
    Daylight(f64),
    /// A blackbody of a temperature in kelvins.
    BlackBody(f64),
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TransformChoice {
    #[default]
    Paper,
    Observer(String),
}

impl TransformChoice {
    pub const fn is_eq_13(&self) -> bool {
        matches!(self, Self::Paper)
    }

    /// Metrics that have a meaning under the transform, the preferred ones first.
    ///
    /// Eq 13 takes an observer's RGB as sRGB: L*a*b* of its XYZ is no CIE L*a*b*, so distances in the diagram come first there, and
    /// one formula of L*a*b* last, as a number.
    pub fn metrics(&self) -> Vec<Metric> {
        match self {
            Self::Observer(_) => Metric::ALL.to_vec(),
            Self::Paper => {
                let distances = Metric::ALL.iter().rev().copied().filter(|metric| !metric.needs_adopted_white());
                distances.chain([Metric::DELTA_E_2000]).collect()
            }
        }
    }

    pub const fn preferred_metric(&self, diagram: Diagram) -> Metric {
        match (self, diagram) {
            (Self::Observer(_), _) => Metric::DELTA_E_2000,
            (Self::Paper, Diagram::Xy) => Metric::XY,
            (Self::Paper, Diagram::UvPrime) => Metric::UV_PRIME,
        }
    }
}

mod metric_id {
    use chromascope_core::colorimetry::Metric;
    use serde::{Deserialize as _, Deserializer, Serializer, de::Error as _};

    pub(super) fn serialize<S: Serializer>(metric: &Metric, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(metric.id)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Metric, D::Error> {
        let id = String::deserialize(deserializer)?;
        Metric::by_id(&id).ok_or_else(|| D::Error::custom(format!("no metric is named {id}")))
    }
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Diagram {
        #[default]
        Xy = "xy", "xy", "The CIE 1931 diagram";
        UvPrime = "uv-prime", "u′v′", "The CIE 1976 diagram, perceptually more uniform";
    }
}

choices! {
    /// Factor k on differences where they are drawn: camera = reference + k · difference. Numbers are never multiplied.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Exaggeration {
        #[default]
        One = "1", "×1", "Differences as they are";
        Three = "3", "×3", "Differences drawn three times as large; numbers stay";
        Ten = "10", "×10", "Differences drawn ten times as large; numbers stay";
    }
}

impl Exaggeration {
    pub const fn factor(self) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Three => 3.0,
            Self::Ten => 10.0,
        }
    }

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde calls")]
    fn is_none(&self) -> bool {
        *self == Self::One
    }

    /// What plots, captions and exports say of it, as "differences ×10"; nothing of ×1.
    pub fn note(self) -> Option<String> {
        (!self.is_none()).then(|| format!("differences {}", self.label()))
    }

    /// The same as a sentence after a blank, for captions.
    pub fn sentence(self) -> String {
        self.note().map_or_else(String::new, |note| format!(" D{}, numbers as they are.", &note[1..]))
    }
}

/// Overlays of the chromaticity diagram other than loci and patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches of one menu")]
pub struct Overlays {
    /// Each camera's differences below the diagram in place of the strip.
    pub multiples: bool,
    pub loci: bool,
    /// Patches with their tails.
    pub patches: bool,
    pub camera_spectral_loci: bool,
    pub daylight: bool,
    pub whites: bool,
    pub isotherms: bool,
    pub srgb: bool,
    pub dci_p3: bool,
    pub rec2020: bool,
}

impl Overlays {
    /// Each switch with what it shows.
    pub fn labeled(&mut self) -> [(&mut bool, &'static str); 10] {
        [
            (&mut self.loci, "Planckian loci"),
            (&mut self.patches, "Patches"),
            (&mut self.camera_spectral_loci, "Cameras' spectral loci: errors that no 3×3 matrix can correct"),
            (&mut self.daylight, "Daylight locus"),
            (&mut self.whites, "Standard whites and the light"),
            (&mut self.isotherms, "Isotherms: lines of equal CCT, to Duv ±0.03"),
            (&mut self.srgb, "sRGB"),
            (&mut self.dci_p3, "DCI-P3"),
            (&mut self.rec2020, "Rec. 2020"),
            (&mut self.multiples, "Differences below: a plot for each camera in place of the temperature strip"),
        ]
    }
}

impl Default for Overlays {
    fn default() -> Self {
        Self {
            multiples: false,
            loci: true,
            patches: true,
            camera_spectral_loci: false,
            daylight: false,
            whites: false,
            isotherms: false,
            srgb: false,
            dci_p3: false,
            rec2020: false,
        }
    }
}

/// A pixel's full-well capacity and read noise: with them a camera's signal-to-noise ratio has a value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Pixel {
    /// In electrons.
    pub full_well: f64,
    /// RMS, in electrons.
    #[serde(default)]
    pub read_noise: f64,
}

impl Pixel {
    pub const LARGEST: f64 = 1e9;

    /// The pixel as the core takes it.
    pub fn electrons(self) -> Result<Electrons, ElectronsError> {
        Electrons::new(self.full_well, self.read_noise)
    }

    pub fn describe(self) -> String {
        format!("full well {} electrons, read noise {} electrons", self.full_well, self.read_noise)
    }
}

pub const PAPER_REFERENCE: &str = "Stiles & Burch 1955 2°";
/// The observer that matrices are fitted to unless the user says otherwise.
pub const FIT_TARGET: &str = CIE_1931;
pub const CIE_1931: &str = "CIE 1931 2°";
pub const CHART: &str = "ColorChecker 24 (Ohta 1997)";
/// Chart of photographs unless the user says otherwise: the average of many.
pub const PHOTOGRAPHED_CHART: &str = "ColorChecker 24 (BabelColor average)";
/// Name of the paper's five patches of the default chart, on the command line and in files.
pub const FIVE: &str = "ColorChecker five";
/// The light on the scene unless the user says otherwise.
pub const LIGHT: &str = "E";
/// Maximum number of compared sensors: each has a place of its own in the palette.
pub const MOST_COMPARED: usize = 256;
/// The temperatures of a locus unless the user says otherwise, in kelvins.
pub const LOCUS_RANGE_K: [f64; 2] = [1000.0, 20_000.0];

impl Default for Document {
    fn default() -> Self {
        Start::default().document()
    }
}

impl Document {
    /// The paper's conditions with nothing compared.
    fn blank(start: Start) -> Self {
        Self {
            format: "chromascope".to_owned(),
            version: VERSION,
            start,
            compared: Vec::new(),
            reference: PAPER_REFERENCE.to_owned(),
            light: Light::Set(LIGHT.to_owned()),
            filters: Vec::new(),
            temperature_k: 5500.0,
            pixel: None,
            chart: CHART.to_owned(),
            subset: Subset::Five,
            white: WhiteBalanceChoice::Unity,
            transform: TransformChoice::Paper,
            correction: CorrectionChoice::default(),
            difference: TransformChoice::Paper.preferred_metric(Diagram::Xy),
            exaggeration: Exaggeration::One,
            diagram: Diagram::Xy,
            overlays: Overlays::default(),
            render: RenderSettings::default(),
            own: Vec::new(),
            measurement: Measurement::default(),
            session: None,
            unknown: serde_json::Map::new(),
        }
    }

    pub fn colorimetry() -> Self {
        Start::Colorimetry.document()
    }

    pub fn paper() -> Self {
        Start::Paper.document()
    }

    /// Adds a sensor to the comparison, in the first free place of the palette.
    pub fn compare(&mut self, name: &str, kind: SetKind) {
        if self.compared.len() >= MOST_COMPARED || self.compared.iter().any(|c| c.kind == kind && c.name == name) {
            return;
        }
        let taken = |slot: u8| self.compared.iter().any(|c| c.kind == kind && c.slot == slot);
        let slot = (0..u8::MAX).find(|&slot| !taken(slot)).unwrap_or(u8::MAX);
        self.compared.push(Compared { name: name.to_owned(), kind, slot, visible: true, label: None });
    }

    pub fn compared(&self, kind: SetKind, name: &str) -> Option<&Compared> {
        self.compared.iter().find(|c| c.kind == kind && c.name == name)
    }

    /// Takes another color transform. The metric changes with it where it was the one that the former starts with, and where it has
    /// no meaning under the new one.
    pub fn set_transform(&mut self, transform: TransformChoice) {
        let (before, after) = (self.transform.is_eq_13(), transform.is_eq_13());
        let was_preferred = before != after && self.difference == self.transform.preferred_metric(self.diagram);
        // The formula has no meaning under Eq 13 unless it is chosen there.
        let loses_meaning = !before && after && self.difference.needs_adopted_white();
        if was_preferred || loses_meaning || !transform.metrics().contains(&self.difference) {
            self.difference = transform.preferred_metric(self.diagram);
        }
        self.transform = transform;
    }

    /// Puts a filter in front of the light or takes it away.
    pub fn set_filter(&mut self, name: &str, on: bool) {
        self.filters.retain(|filter| filter != name);
        if on {
            self.filters.push(name.to_owned());
        }
    }

    /// Shows other coordinates; a distance in the former diagram becomes that in the new one under Eq 13.
    pub fn set_diagram(&mut self, diagram: Diagram) {
        let follows = self.transform.is_eq_13() && self.difference == self.transform.preferred_metric(self.diagram);
        self.diagram = diagram;
        if follows {
            self.difference = self.transform.preferred_metric(diagram);
        }
    }

    /// Temperature in kelvins of a blackbody or CIE daylight as the light.
    pub fn radiator_k(&self) -> Option<f64> {
        (!matches!(self.light, Light::Set(_))).then_some(self.temperature_k)
    }

    pub fn is_reference(&self, compared: &Compared) -> bool {
        compared.kind == SetKind::Observer && compared.name == self.reference
    }
}
