//! Claims of the paper as values: what it says, what is found, and whether that agrees.

use chromascope_core::colorimetry::Xy;
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{Ask as _, PatchColor, PatchColorsQuery, RenderingQuery, Shared};
use chromascope_core::spectral::SpectralDistribution;
use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_text::choices;

use crate::catalog::Catalog;
use crate::catalog::names::model_of;
use crate::document::render::{BALANCE, SUN};
use crate::document::{CIE_1931, Document, Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::results::Results;
use crate::scene::{Scene, SceneError};

pub(super) const CANON: &str = "Canon EOS 10D (2007 figure)";
pub(super) const NIKON: &str = "Nikon D70 (2007 figure)";
/// The camera in place of the paper's Kodak, a DCS420.
pub(super) const KODAK: &str = "Kodak DCS200";
/// Qualification of verdicts on the paper's Kodak.
pub(super) const STAND_IN: &str = "Kodak DCS200 in place of the paper's DCS420";
/// Part of the checks that go beyond the paper.
pub const FURTHER: &str = "Further checks";

choices! {
    /// Agreement of a claim with what is found.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Verdict {
        Holds = "holds", "", "";
        Partly = "holds in part", "", "It holds within limits";
        Fails = "does not hold", "", "";
        Ambiguous = "ambiguous", "", "Its words have more than one meaning, and the verdict depends on which";
        Open = "not judged", "", "It is about cameras or patches that are not in this report";
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    pub quantity: String,
    /// Sensor it is of; may be empty.
    pub sensor: String,
    pub number: f64,
    /// Decimals that are stated.
    pub decimals: usize,
    /// Unit; may be empty.
    pub unit: &'static str,
}

impl Value {
    pub(super) fn new(
        quantity: impl Into<String>,
        sensor: &str,
        number: f64,
        unit: &'static str,
        decimals: usize,
    ) -> Self {
        Self { quantity: quantity.into(), sensor: sensor.to_owned(), number, decimals, unit }
    }
}

/// Numbers found for a claim, with the verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub values: Vec<Value>,
    pub verdict: Verdict,
}

impl Finding {
    /// Finding on a condition; not judged where what it is about is not there.
    pub(super) fn on(holds: Option<bool>, values: impl IntoIterator<Item = Value>) -> Self {
        let verdict = holds.map_or(Verdict::Open, |holds| if holds { Verdict::Holds } else { Verdict::Fails });
        Self { values: values.into_iter().collect(), verdict }
    }
}

/// A claim of the paper, or a further check that it suggests.
pub struct Claim {
    /// Name in tables.
    pub key: &'static str,
    /// Part of the paper, or [`FURTHER`].
    pub part: &'static str,
    /// The claim, paraphrased but for what stands between quotation marks.
    pub paper: &'static str,
    pub why: &'static str,
    pub find: Find,
}

pub type Find = fn(&Subject<'_>) -> Result<Finding, SceneError>;

impl Claim {
    pub fn is_of_paper(&self) -> bool {
        self.part != FURTHER
    }

    /// Qualification of a verdict on the paper's Kodak; empty for others.
    pub fn condition(&self, verdict: Verdict) -> &'static str {
        if self.paper.contains("Kodak") && verdict != Verdict::Open { STAND_IN } else { "" }
    }
}

/// A number for each of several sensors.
pub(super) struct Series(pub Vec<(String, f64)>);

impl Series {
    pub(super) fn get(&self, sensor: &str) -> Option<f64> {
        self.0.iter().find(|(name, _)| name == sensor).map(|(_, number)| *number)
    }

    /// The numbers with what they are.
    pub(super) fn values(&self, quantity: &str, unit: &'static str, decimals: usize) -> Vec<Value> {
        self.0.iter().map(|(sensor, number)| Value::new(quantity, sensor, *number, unit, decimals)).collect()
    }
}

/// Cameras, patches and light that a report is about, with the answers.
pub struct Subject<'a> {
    /// Start of the paper with these cameras, patches and light.
    pub document: &'a Document,
    /// True if the light takes the place of the paper's lights.
    pub has_own_light: bool,
    pub catalog: &'a Catalog,
    pub results: &'a Results,
}

impl Subject<'_> {
    pub(super) fn scene<'b>(&'b self, document: &'b Document) -> Scene<'b> {
        Scene { document, catalog: self.catalog, results: self.results }
    }

    pub(super) fn cameras(&self) -> Vec<String> {
        let cameras = self.document.compared.iter().filter(|compared| compared.kind == SetKind::Camera);
        cameras.map(|compared| compared.name.clone()).collect()
    }

    pub(super) fn each(&self, number: impl Fn(&str) -> Result<f64, SceneError>) -> Result<Series, SceneError> {
        let cameras = self.cameras().into_iter();
        cameras.map(|name| Ok((name.clone(), number(&name)?))).collect::<Result<_, _>>().map(Series)
    }

    /// Least and most of a number among the library's tables of the paper's Nikon: what it depends on the table.
    pub(super) fn spread(
        &self,
        quantity: &str,
        unit: &'static str,
        decimals: usize,
        number: impl Fn(&str) -> Result<f64, SceneError>,
    ) -> Result<Vec<Value>, SceneError> {
        let model = model_of(NIKON);
        let tables = self.catalog.of_kind(SetKind::Camera).filter(|entry| model_of(&entry.name) == model);
        let numbers = tables.map(|entry| number(&entry.name)).collect::<Result<Vec<f64>, _>>()?;
        let among = format!("among {} tables of one {model}", numbers.len());
        let end = |end: &str, number| Value::new(format!("{quantity}, {end} {among}"), "", number, unit, decimals);
        let [least, most] =
            [f64::min as fn(f64, f64) -> f64, f64::max].map(|fold| numbers.iter().copied().fold(f64::NAN, fold));
        Ok(vec![end("least", least), end("most", most)])
    }

    /// A number for the reference of a document and for each camera.
    pub(super) fn all(
        &self,
        document: &Document,
        number: impl Fn(SetKind, &str) -> Result<f64, SceneError>,
    ) -> Result<Series, SceneError> {
        let reference = document.reference.clone();
        let mut all = vec![(reference.clone(), number(SetKind::Observer, &reference)?)];
        all.extend(self.each(|name| number(SetKind::Camera, name))?.0);
        Ok(Series(all))
    }

    /// Cameras through matrices fitted to CIE 1931, which is the reference, under a light of the catalog.
    pub(super) fn fitted(&self, light: &str) -> Document {
        let mut document = self.document.clone();
        document.set_transform(TransformChoice::Observer(CIE_1931.to_owned()));
        CIE_1931.clone_into(&mut document.reference);
        document.light = Light::Set(light.to_owned());
        document
    }

    /// A material in sunlight, balanced to D55: the conditions of experiment 3.
    pub(super) fn in_sun(&self, material: &str) -> Document {
        let mut document = self.document.clone();
        if !self.has_own_light {
            document.light = Light::Set(SUN.to_owned());
        }
        document.white = WhiteBalanceChoice::Light(BALANCE.to_owned());
        (document.chart, document.subset) = (material.to_owned(), Subset::All);
        document
    }

    pub(super) fn colors(&self, rendering: RenderingQuery, patches: PatchSet) -> Result<Vec<PatchColor>, SceneError> {
        let answer = self.results.ask(&PatchColorsQuery { rendering, patches: Shared::new(patches) });
        (*answer).clone().map_err(|error| SceneError::Rendering { name: "a sensor".to_owned(), error })
    }

    /// Chromaticity of a perfect diffuser through the reference of a document.
    pub(super) fn white(&self, document: &Document) -> Result<Option<Xy>, SceneError> {
        let Ok(diffuser) = SpectralDistribution::new(vec![FIRST_NM, LAST_NM], vec![1.0, 1.0]) else { return Ok(None) };
        let rendering = self.scene(document).rendering_of(SetKind::Observer, &document.reference)?;
        let colors = self.colors(rendering, PatchSet::new([("perfect diffuser".to_owned(), diffuser)]))?;
        Ok(colors.first().and_then(|color| color.xy))
    }
}
