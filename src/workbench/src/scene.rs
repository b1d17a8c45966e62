//! Document as queries: names become data, choices become queries, failures become messages.
//!
//! Used by panes, exports and the command line alike, so that they cannot disagree.

pub mod conditions;
pub mod correction;
pub mod light;
pub mod locus;
pub mod measurement;
pub mod metrics;
pub mod orbit;
pub mod recorded;
pub mod recovery;
pub mod render;
pub mod spectral_image;
pub mod tables;
pub mod uncertainty;

use std::borrow::Cow;
use std::sync::Arc;

use chromascope_core::camera::{RenderingError, WhiteBalanceTarget};
use chromascope_core::colorimetry::diagram::SpectralPoint;
use chromascope_core::colorimetry::lab::xyz_from_lab;
use chromascope_core::colorimetry::rgb::encode_srgb;
use chromascope_core::colorimetry::{UvPrime, Xyz};
use chromascope_core::correction::aces::IdtError;
use chromascope_core::light::{DaylightError, RadiationConstants, daylight};
use chromascope_core::patch_set::{PAPER_FIVE, PatchSet};
use chromascope_core::query::{
    Ask, ColorTransformSpec, DifferenceError, Locus, LocusQuery, MonochromaticQuery, PatchColor, PatchColorsQuery,
    Query, RenderingQuery, Shared, SpectralLocusQuery, Temperatures, compare,
};
use chromascope_core::recovery::{NarrowBandError, RecoveryError};
use chromascope_core::reflectance::SurfaceError;
use chromascope_core::scene::lighting::LightingError;
use chromascope_core::spectral::{GridSpectrum, Sensor};
use chromascope_core::units::{Kelvin, NotPositive};
use chromascope_figure::{InkRole, Marker};

use crate::catalog::load::{
    FilterQuery, FilteredLightQuery, LightQuery, LoadError, LoadedLight, PatchesQuery, SensorQuery,
};
use crate::catalog::{Catalog, Entry};
use crate::document::names::caseless;
use crate::document::{
    Compared, Document, Exaggeration, FIT_TARGET, LOCUS_RANGE_K, Light, SetKind, Subset, TransformChoice,
    WhiteBalanceChoice,
};
use crate::format::cut_in_middle;
use crate::names::shortest;
use crate::results::Results;

/// Number of points a locus on screen has.
pub const LOCUS_POINTS: usize = 200;

pub type Result<T, E = SceneError> = std::result::Result<T, E>;

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    #[error("no {kind} is named \"{name}\" here; open its file, or choose another", kind = kind.label())]
    NoSet { kind: SetKind, name: String },
    #[error("{name}: {error}")]
    Load { name: String, error: LoadError },
    #[error("{name}: {error}")]
    Idt { name: String, error: IdtError },
    #[error("{name}: {error}")]
    Rendering { name: String, error: RenderingError },
    #[error("the white-balance target \"{0}\" has no color; choose another")]
    WhiteBalanceTarget(String),
    #[error(transparent)]
    Daylight(#[from] DaylightError),
    #[error(transparent)]
    Temperature(#[from] NotPositive),
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    #[error(transparent)]
    Lighting(#[from] LightingError),
    #[error(transparent)]
    Recovery(#[from] RecoveryError),
    #[error(transparent)]
    NarrowBands(#[from] NarrowBandError),
}

/// Name and appearance of a compared sensor, the same in all panes.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedSensor {
    pub kind: SetKind,
    pub name: String,
    pub label: String,
    /// The label where room is short, of cameras by what distinguishes them.
    pub short: String,
    pub role: InkRole,
    pub marker: Marker,
    /// The width of its lines in points.
    pub width: f64,
    pub is_reference: bool,
    pub is_own: bool,
    pub visible: bool,
}

impl ComparedSensor {
    /// The label where those of all sensors fit, else the short one, with its middle cut where even that does not.
    pub fn fitted(&self, all: &[Self], fits: impl Fn(&str) -> bool) -> String {
        let words = if all.iter().all(|one| fits(&one.label)) { &self.label } else { &self.short };
        cut_in_middle(words, fits).into_owned()
    }
}

/// A condition under which the values have an unusual meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Caution {
    /// The reference is an XYZ observer while Eq 13 takes RGB: no camera can be compared with it.
    NotComparable { reference: String },
    /// Cameras are fitted to another observer than they are compared with, which can be fitted to if it is an XYZ observer.
    FitDiffers { target: String, reference: String, can_fit: bool },
}

impl Caution {
    pub fn sentence(&self) -> String {
        match self {
            Self::NotComparable { reference } => {
                format!("{reference} is an XYZ observer, but Eq 13 takes RGB: cameras cannot be compared with it.")
            }
            Self::FitDiffers { target, reference, .. } => {
                format!("Compared with {reference}, but the color transform is fitted to {target}.")
            }
        }
    }

    /// The observer to fit to that removes the condition.
    pub fn fit_to(&self) -> Option<&str> {
        match self {
            Self::NotComparable { reference } | Self::FitDiffers { reference, can_fit: true, .. } => Some(reference),
            Self::FitDiffers { can_fit: false, .. } => None,
        }
    }
}

/// The document, the data sets and the answers, read together.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    pub document: &'a Document,
    pub catalog: &'a Catalog,
    pub results: &'a Results,
}

impl<'a> Scene<'a> {
    /// The sets of a kind, the user's own first.
    pub fn entries(&self, kind: SetKind) -> impl Iterator<Item = Entry> + 'a {
        let own = self.document.own.iter().map(Entry::from_own).filter(move |entry| entry.kind == kind);
        own.chain(self.catalog.of_kind(kind).cloned())
    }

    /// The set of this name; the user's own win.
    pub fn entry(&self, kind: SetKind, name: &str) -> Result<Entry> {
        self.find(kind, name).map(Cow::into_owned)
    }

    /// Finds a set without copying a built-in set's header, which may name thousands of columns.
    fn find(&self, kind: SetKind, name: &str) -> Result<Cow<'a, Entry>> {
        let own = |is_it: &dyn Fn(&str) -> bool| {
            let mut sets = self.document.own.iter().filter(|set| SetKind::of_own(set) == kind);
            sets.find(|set| is_it(&set.name)).map(|set| Cow::Owned(Entry::from_own(set)))
        };
        own(&|known| known == name)
            .or_else(|| self.catalog.get(kind, name).map(Cow::Borrowed))
            .or_else(|| {
                let wanted = caseless(name);
                own(&|known| caseless(known) == wanted)
            })
            .ok_or_else(|| SceneError::NoSet { kind, name: name.to_owned() })
    }

    /// The chart or, failing that, the material set of this name. Transmittances can be seen as patches too.
    pub fn chart_entry(&self, name: &str) -> Result<Entry> {
        self.find_chart(name).map(Cow::into_owned)
    }

    fn find_chart(&self, name: &str) -> Result<Cow<'a, Entry>> {
        let other = |kind| move |e| self.find(kind, name).map_err(|_| e);
        self.find(SetKind::Chart, name).or_else(other(SetKind::Material)).or_else(other(SetKind::Filter))
    }

    pub fn sensor(&self, kind: SetKind, name: &str) -> Result<Shared<Sensor>> {
        self.loaded(&SensorQuery(self.find(kind, name)?.place.clone()), name)
    }

    pub fn temperature(&self) -> Result<Kelvin> {
        Ok(Kelvin::new(self.document.temperature_k)?)
    }

    pub fn light(&self) -> Result<LoadedLight> {
        let (light, name) = match &self.document.light {
            Light::Set(name) => (LightQuery::Set(self.find(SetKind::Illuminant, name)?.place.clone()), name.as_str()),
            Light::BlackBody => (LightQuery::BlackBody(self.temperature()?), "blackbody"),
            Light::Daylight => (LightQuery::Daylight(self.temperature()?), "daylight"),
        };
        self.filtered(light, name)
    }

    /// An illuminant of the catalog, or one by formula such as `blackbody 3200 K`, through the document's filters.
    pub(crate) fn illuminant(&self, name: &str) -> Result<LoadedLight> {
        self.filtered(self.light_of(name)?, name)
    }

    fn light_of(&self, name: &str) -> Result<LightQuery> {
        let formula = name.strip_suffix(" K").and_then(|name| name.split_once(' '));
        let formula = formula.and_then(|(formula, kelvin)| Some((formula, Kelvin::new(kelvin.parse().ok()?).ok()?)));
        Ok(match formula {
            Some(("blackbody", kelvin)) => LightQuery::BlackBody(kelvin),
            Some(("daylight", kelvin)) => LightQuery::Daylight(kelvin),
            _ => LightQuery::Set(self.entry(SetKind::Illuminant, name)?.place),
        })
    }

    fn filtered(&self, light: LightQuery, name: &str) -> Result<LoadedLight> {
        if self.document.filters.is_empty() {
            return self.loaded(&light, name);
        }
        // Sorted, so that the order of the filters does not change the query.
        let mut names = self.document.filters.clone();
        names.sort();
        let filters = names.iter().map(|name| self.filter(name)).collect::<Result<_, _>>()?;
        self.loaded(&FilteredLightQuery { light, filters }, &self.with_filters(name.to_owned()))
    }

    pub fn filter(&self, name: &str) -> Result<Shared<GridSpectrum>> {
        self.loaded(&FilterQuery(self.entry(SetKind::Filter, name)?.place), name)
    }

    /// The data of a set of that name.
    fn loaded<T: Clone>(&self, query: &impl Query<Answer = Result<T, LoadError>>, name: &str) -> Result<T> {
        (*self.results.ask(query)).clone().map_err(|error| SceneError::Load { name: name.to_owned(), error })
    }

    /// What a sensor of that name makes of something.
    pub(crate) fn rendered<T: Clone>(
        &self,
        query: &impl Query<Answer = Result<T, RenderingError>>,
        name: &str,
    ) -> Result<T> {
        (*self.results.ask(query)).clone().map_err(|error| SceneError::Rendering { name: name.to_owned(), error })
    }

    /// The name of the light with its temperature and the filters in front of it: `D65 × ND 0.3`.
    pub fn light_name(&self) -> String {
        let light = match &self.document.light {
            Light::Set(name) => name.clone(),
            Light::BlackBody => format!("blackbody {:.0} K", self.document.temperature_k),
            Light::Daylight => format!("daylight {:.0} K", self.document.temperature_k),
        };
        self.with_filters(light)
    }

    /// The name of a light with the filters in front of it.
    pub(crate) fn with_filters(&self, light: String) -> String {
        self.document.filters.iter().fold(light, |name, filter| format!("{name} × {filter}"))
    }

    pub fn patches(&self) -> Result<Shared<PatchSet>> {
        self.patch_set(&self.document.chart, self.subset())
    }

    /// Names of the chart's patches that are compared; none for all.
    pub(crate) fn subset(&self) -> Option<&'static [&'static str]> {
        let five = self.document.subset == Subset::Five && self.has_five();
        five.then_some(PAPER_FIVE.as_slice())
    }

    /// True if the chart has the paper's five patches and more.
    pub fn has_five(&self) -> bool {
        self.find_chart(&self.document.chart).is_ok_and(|entry| {
            entry.header.as_ref().is_some_and(|header| {
                header.columns.len() > PAPER_FIVE.len()
                    && PAPER_FIVE.iter().all(|name| header.columns.iter().any(|c| c == name))
            })
        })
    }

    pub(crate) fn patch_set(&self, name: &str, names: Option<&'static [&'static str]>) -> Result<Shared<PatchSet>> {
        self.loaded(&PatchesQuery { place: self.find_chart(name)?.place.clone(), names }, name)
    }

    /// The color that a perfect white is to take.
    pub fn white(&self) -> Result<WhiteBalanceTarget> {
        self.white_target(&self.document.white)
    }

    fn built_in_light(&self, name: &str) -> Result<LoadedLight> {
        self.loaded(&LightQuery::Set(self.find(SetKind::Illuminant, name)?.place.clone()), name)
    }

    fn white_target(&self, choice: &WhiteBalanceChoice) -> Result<WhiteBalanceTarget> {
        match choice {
            WhiteBalanceChoice::Unity => Ok(WhiteBalanceTarget::UNITY),
            WhiteBalanceChoice::Light(name) => self.white_of(&self.built_in_light(name)?, name),
            WhiteBalanceChoice::Daylight(kelvin) => {
                let xy = daylight::chromaticity(Kelvin::new(*kelvin)?)?;
                WhiteBalanceTarget::from_chromaticity(xy)
                    .ok_or_else(|| SceneError::WhiteBalanceTarget(format!("daylight {kelvin} K")))
            }
            WhiteBalanceChoice::BlackBody(kelvin) => {
                let light = self.loaded(&LightQuery::BlackBody(Kelvin::new(*kelvin)?), "blackbody")?;
                self.white_of(&light, &format!("blackbody {kelvin} K"))
            }
        }
    }

    fn white_of(&self, light: &LoadedLight, name: &str) -> Result<WhiteBalanceTarget> {
        let observer = self.sensor(SetKind::Observer, FIT_TARGET)?;
        WhiteBalanceTarget::from_light(&light.measured, &observer)
            .ok_or_else(|| SceneError::WhiteBalanceTarget(name.to_owned()))
    }

    pub fn transform(&self) -> Result<ColorTransformSpec> {
        match &self.document.transform {
            TransformChoice::Paper => Ok(ColorTransformSpec::Paper),
            TransformChoice::Observer(reference) => {
                let choice = &self.document.correction;
                let reference = self.sensor(SetKind::Observer, reference)?;
                let training = self.patch_set(&choice.training, None)?;
                Ok(ColorTransformSpec::Observer { reference, training, correction: choice.correction() })
            }
        }
    }

    /// Query for the conversion of a sensor's signals to chromaticities.
    pub fn rendering_of(&self, kind: SetKind, name: &str) -> Result<RenderingQuery> {
        Ok(RenderingQuery {
            sensor: self.sensor(kind, name)?,
            light: self.light()?.grid,
            white: self.white()?,
            transform: self.transform()?,
        })
    }

    /// Adopted white of the reference's L\*a\*b\*.
    pub fn adopted_white(&self) -> Result<Xyz> {
        let name = &self.document.reference;
        Ok(self.rendered(&self.rendering_of(SetKind::Observer, name)?, name)?.lab_white)
    }

    pub fn locus_temperatures() -> Result<Temperatures> {
        let [from, to] = LOCUS_RANGE_K;
        Ok(Temperatures::Range { from: Kelvin::new(from)?, to: Kelvin::new(to)?, count: LOCUS_POINTS })
    }

    /// A sensor's Planckian locus at the given temperatures.
    pub fn locus_at(&self, kind: SetKind, name: &str, temperatures: Temperatures) -> Result<Arc<Locus>> {
        let rendering = self.rendering_of(kind, name)?;
        let query = LocusQuery { rendering, temperatures, constants: RadiationConstants::Paper };
        // One copy of 200 points against a second layer of shared ownership in every caller.
        self.rendered(&query, name).map(Arc::new)
    }

    pub fn locus(&self, kind: SetKind, name: &str) -> Result<Arc<Locus>> {
        self.locus_at(kind, name, Self::locus_temperatures()?)
    }

    /// A sensor's locus at the marked temperature alone.
    pub fn locus_mark(&self, kind: SetKind, name: &str) -> Result<Arc<Locus>> {
        self.locus_at(kind, name, Temperatures::List(vec![self.temperature()?]))
    }

    pub fn patch_colors(&self, kind: SetKind, name: &str) -> Result<Vec<PatchColor>> {
        let query = PatchColorsQuery { rendering: self.rendering_of(kind, name)?, patches: self.patches()? };
        self.rendered(&query, name)
    }

    /// Patches as they are drawn: differences from the reference times the document's exaggeration, chromaticities in u′v′, colors
    /// in L*a*b*; L* is not below 0. XYZ and L*a*b* stay as they are.
    pub fn drawn_patch_colors(&self, kind: SetKind, name: &str) -> Result<Vec<PatchColor>> {
        let mut colors = self.patch_colors(kind, name)?;
        let to = self.document.exaggeration;
        let is_reference = kind == SetKind::Observer && name == self.document.reference;
        if to == Exaggeration::One || is_reference || !self.is_comparable(kind, name) {
            return Ok(colors);
        }
        let rendering = self.rendered(&self.rendering_of(kind, name)?, name)?;
        let reference = self.patch_colors(SetKind::Observer, &self.document.reference)?;
        for (color, reference) in colors.iter_mut().zip(&reference) {
            color.uv = color.uv.zip(reference.uv).map(|(own, from)| {
                let far = |own: f64, from: f64| from + to.factor() * (own - from);
                UvPrime { u: far(own.u, from.u), v: far(own.v, from.v) }
            });
            color.xy = color.uv.and_then(UvPrime::xy);
            if let Some((own, from)) = color.lab.zip(reference.lab) {
                let xyz = xyz_from_lab(own.exaggerated(from, to.factor()), rendering.lab_white);
                color.srgb = encode_srgb(rendering.linear_srgb(xyz));
            }
        }
        Ok(colors)
    }

    pub fn monochromatic(&self, kind: SetKind, name: &str) -> Result<Vec<SpectralPoint>> {
        self.rendered(&MonochromaticQuery { rendering: self.rendering_of(kind, name)? }, name)
    }

    /// The outline of the diagram: monochromatic light for CIE 1931.
    pub fn outline(&self) -> Result<Arc<Vec<SpectralPoint>>> {
        Ok(self.results.ask(&SpectralLocusQuery { observer: self.sensor(SetKind::Observer, FIT_TARGET)? }))
    }

    /// True if a sensor may be compared with the reference under this color transform.
    pub fn comparable(&self, kind: SetKind, name: &str) -> Result<Result<(), DifferenceError>> {
        if self.document.transform != TransformChoice::Paper {
            return Ok(Ok(()));
        }
        let reference = self.sensor(SetKind::Observer, &self.document.reference)?;
        let sensor = self.sensor(kind, name)?;
        Ok(compare::comparable_by_paper(reference.primaries(), sensor.primaries()))
    }

    pub fn is_comparable(&self, kind: SetKind, name: &str) -> bool {
        matches!(self.comparable(kind, name), Ok(Ok(())))
    }

    /// The condition to warn of, if there is one.
    pub fn caution(&self) -> Option<Caution> {
        let reference = self.document.reference.clone();
        let counts_in_xyz = self.find(SetKind::Observer, &reference).is_ok_and(|entry| entry.counts_in_xyz());
        match &self.document.transform {
            TransformChoice::Paper => counts_in_xyz.then_some(Caution::NotComparable { reference }),
            TransformChoice::Observer(target) if *target == reference => None,
            TransformChoice::Observer(target) => {
                Some(Caution::FitDiffers { target: target.clone(), reference, can_fit: counts_in_xyz })
            }
        }
    }

    /// Name of the metric under the color transform.
    pub fn difference_name(&self) -> &'static str {
        self.document.difference.name(self.document.transform.is_eq_13())
    }

    /// The difference of each patch from the reference, by the measure chosen; or why there is none.
    pub fn differences(&self, kind: SetKind, name: &str) -> Result<Vec<Result<f64, DifferenceError>>> {
        let comparable = self.comparable(kind, name)?;
        let reference = self.patch_colors(SetKind::Observer, &self.document.reference)?;
        let own = self.patch_colors(kind, name)?;
        let pairs = reference.iter().zip(&own);
        Ok(pairs.map(|(a, b)| comparable.and_then(|()| compare::difference(self.document.difference, a, b))).collect())
    }

    /// The compared sensors that are drawn, the reference first.
    pub fn visible_sources(&self) -> Vec<ComparedSensor> {
        let mut sources = self.sources();
        sources.retain(|source| source.visible);
        sources
    }

    /// The compared sensors with how they are drawn, the reference first, hidden ones included.
    pub fn sources(&self) -> Vec<ComparedSensor> {
        let mut observers = 0;
        let mut sources: Vec<ComparedSensor> =
            self.document.compared.iter().map(|c| self.source(c, &mut observers)).collect();
        sources.sort_by_key(|source| !source.is_reference);
        let cameras = sources.iter().filter(|source| source.kind == SetKind::Camera);
        let short = shortest(cameras.map(|source| source.label.as_str()));
        for (source, short) in sources.iter_mut().filter(|source| source.kind == SetKind::Camera).zip(short) {
            // A label of the user's stays.
            if source.short.is_empty() {
                source.short = short;
            }
        }
        sources
    }

    /// Appearance of one sensor. Observers other than the reference differ by marker only.
    fn source(&self, compared: &Compared, observers: &mut usize) -> ComparedSensor {
        let entry = self.find(compared.kind, &compared.name).ok();
        let short = entry.as_ref().map_or_else(|| compared.name.clone(), |entry| entry.short.clone());
        let is_reference = self.document.is_reference(compared);
        let (role, marker, width) = match compared.kind {
            _ if is_reference => (InkRole::Reference, Marker::Plus, 4.0),
            SetKind::Observer => {
                *observers += 1;
                (InkRole::Observer, Marker::observer(*observers - 1), 1.5)
            }
            _ => (InkRole::Sensor(compared.slot % 8), Marker::source(compared.slot.into()), 2.0),
        };
        let own = compared.label.clone();
        let label = own.clone().unwrap_or(short);
        ComparedSensor {
            kind: compared.kind,
            name: compared.name.clone(),
            short: own.unwrap_or_else(|| if compared.kind == SetKind::Camera { String::new() } else { label.clone() }),
            label,
            role,
            marker,
            width,
            is_reference,
            is_own: entry.is_some_and(|entry| entry.is_own()),
            visible: compared.visible,
        }
    }
}
