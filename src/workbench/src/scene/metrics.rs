//! Figures of merit of cameras under the document's conditions.

use std::sync::Arc;

use chromascope_core::camera::ChannelRatio;
use chromascope_core::camera::quality::Electrons;
use chromascope_core::metamers::{Confusion, MetamerLimits, MetamerPair};
use chromascope_core::patch_set::{COLOR_CHECKER_CHROMATIC, PatchSet};
use chromascope_core::query::metrics::{MetricSet, OwnUncertainties};
use chromascope_core::query::{
    Ask, CameraMetric, CameraMetrics, CameraMetricsQuery, IndexConditions, MetamersQuery, MetricUncertaintiesQuery,
    MetricUncertainty, MetricValue, PatchColorsQuery, Query, RenderingQuery, Shared,
};
use chromascope_core::spectral::Sensor;
use chromascope_core::units::Kelvin;
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

use super::correction::ChannelRatioQuery;
use super::{Result, Scene, SceneError};
use crate::catalog::load::{
    CurveSpreadQuery, LightQuery, LoadError, PatchesQuery, SensorQuery, StatedQuery, response_evidence,
};
use crate::catalog::{Entry, Place};
use crate::document::{CHART, CIE_1931, Document, SensorId, SetKind};
use crate::jobs::{Later, Waiting};

/// The light of the sensitivity metamerism index (ISO 17321-1).
const INDEX_LIGHT: &str = "D55";
const MOST_METAMERS: usize = 100;
/// Cameras between two answers of a ranking.
const STEP: usize = 4;

/// Conditions of figures of merit, the same for all sensors.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MetricsConditions {
    reference: RenderingQuery,
    patches: Shared<PatchSet>,
    temperature: Kelvin,
    index: IndexConditions,
    electrons: Option<Electrons>,
    /// Uncertainties that the files of light and chart state.
    own: OwnUncertainties,
    /// Metrics that are shown or sorted by.
    wanted: MetricSet,
}

impl MetricsConditions {
    pub fn query(&self, sensor: Shared<Sensor>) -> CameraMetricsQuery {
        CameraMetricsQuery {
            rendering: RenderingQuery { sensor, ..self.reference.clone() },
            reference: self.reference.clone(),
            patches: self.patches.clone(),
            temperature: self.temperature,
            index: self.index.clone(),
            electrons: self.electrons,
            wanted: self.wanted,
        }
    }
}

/// Uncertainties of all metrics of a camera, in their order.
pub type Uncertainties = Arc<Vec<Option<MetricUncertainty>>>;

/// Figures of merit of a camera, with their uncertainties once these are computed.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraFigures {
    pub metrics: Arc<CameraMetrics>,
    /// None while they are not computed.
    pub uncertainties: Option<Uncertainties>,
}

impl CameraFigures {
    pub fn of(&self, metric: CameraMetric) -> Option<MetricValue> {
        self.metrics.with(self.uncertainties.as_ref().map(|all| all.as_slice()), metric)
    }
}

/// Figures of merit of a camera of the catalog, which is loaded where the question is answered.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CatalogMetricsQuery {
    place: Place,
    conditions: Shared<MetricsConditions>,
    ratio: Option<ChannelRatioQuery>,
    with_uncertainties: bool,
}

impl CatalogMetricsQuery {
    /// The same with uncertainties, which take longer.
    #[must_use]
    pub fn with_uncertainties(&self) -> Self {
        Self { with_uncertainties: true, ..self.clone() }
    }

    /// True if both are of the same camera, whatever the conditions.
    pub fn is_of_same_camera(&self, other: &Self) -> bool {
        self.place == other.place
    }
}

impl Query for CatalogMetricsQuery {
    type Answer = Result<CameraFigures, LoadError>;
    const NAME: &'static str = "camera of the ranking";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let query = self.conditions.query((*ask.ask(&SensorQuery(self.place.clone()))).clone()?);
        let metrics = ask.ask(&query);
        let uncertainties = if self.with_uncertainties {
            let own = self.conditions.own.clone();
            Some(ask.ask(&uncertainties_query(query, &self.place, (self.ratio.as_ref(), own), ask)?))
        } else {
            None
        };
        Ok(CameraFigures { metrics, uncertainties })
    }
}

/// The question for the uncertainties of a camera's figures of merit, with those that the files of light and chart state.
fn uncertainties_query(
    metrics: CameraMetricsQuery,
    place: &Place,
    (ratio, conditions): (Option<&ChannelRatioQuery>, OwnUncertainties),
    ask: &impl Ask,
) -> Result<MetricUncertaintiesQuery, LoadError> {
    let camera = ask.ask(&StatedQuery { place: place.clone(), names: None }).uncertainty.clone();
    Ok(MetricUncertaintiesQuery {
        own: OwnUncertainties { camera, ..conditions },
        metrics,
        spread: (*ask.ask(&CurveSpreadQuery)).clone()?,
        response: response_evidence(place, ask),
        ratio: ratio.map_or(Ok(ChannelRatio::Unchecked), |ratio| (*ask.ask(ratio)).clone())?,
    })
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum RankedCameras {
        #[default]
        Library = "library", "Library", "All cameras of the library and yours";
        Compared = "compared", "Compared", "The cameras that are compared";
        Yours = "yours", "Yours", "The cameras that you imported";
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RankedCamera {
    pub id: SensorId,
    /// Query for its figures of merit, or the reason that there is none.
    query: Result<CatalogMetricsQuery, String>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ranked {
    pub cameras: Vec<RankedCamera>,
    /// Their figures of merit: reason for none, or none while they are being made.
    pub metrics: Vec<Option<Result<CameraFigures, String>>>,
}

impl Ranked {
    /// Cameras with the figures of merit of the first of those that have a query.
    fn new(cameras: &[RankedCamera], made: impl IntoIterator<Item = Arc<Result<CameraFigures, LoadError>>>) -> Self {
        let mut made = made.into_iter();
        let metrics = |camera: &RankedCamera| match &camera.query {
            Ok(_) => made.next().map(|figures| (*figures).clone().map_err(|error| unloaded(&camera.id.name, error))),
            Err(why) => Some(Err(why.clone())),
        };
        Self { metrics: cameras.iter().map(metrics).collect(), cameras: cameras.to_vec() }
    }
}

/// Sentence for a camera whose table is damaged.
pub fn unloaded(name: &str, error: LoadError) -> String {
    SceneError::Load { name: name.to_owned(), error }.to_string()
}

/// Question for the figures of merit of the first so many of some cameras.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RankingQuery {
    cameras: Shared<Vec<RankedCamera>>,
    count: usize,
    with_uncertainties: bool,
}

impl Query for RankingQuery {
    type Answer = Ranked;
    const NAME: &'static str = "ranking";
    const CAPACITY: usize = 2;

    fn answer(&self, ask: &impl Ask) -> Ranked {
        let queries = self.cameras.iter().filter_map(|camera| camera.query.as_ref().ok()).take(self.count);
        let queries: Vec<_> = if self.with_uncertainties {
            queries.map(CatalogMetricsQuery::with_uncertainties).collect()
        } else {
            queries.cloned().collect()
        };
        Ranked::new(&self.cameras, ask.ask_all(&queries))
    }
}

impl RankingQuery {
    /// A few cameras more at each stage, then the uncertainties of all, for which values do not wait.
    fn stages(cameras: Vec<RankedCamera>) -> Vec<Self> {
        let all = cameras.iter().filter(|camera| camera.query.is_ok()).count();
        let cameras = Shared::new(cameras);
        let counts = (1..=all.div_ceil(STEP)).map(|step| ((step * STEP).min(all), false));
        let stages = counts.chain((all > 0).then_some((all, true)));
        stages.map(|(count, with_uncertainties)| Self { cameras: cameras.clone(), count, with_uncertainties }).collect()
    }
}

impl Waiting<RankingQuery> {
    /// Number of cameras done and of all, while some are not.
    pub fn progress(&self) -> Option<(usize, usize)> {
        let all = self.stages.last()?.count;
        let done = self.shown.as_ref().filter(|shown| shown.current).map_or(0, |shown| shown.job.count);
        (done < all).then_some((done, all))
    }
}

/// The ranking that several panes show: until all cameras are done, the last complete one stays.
#[derive(Default)]
pub struct Ranking {
    /// Document and choice of cameras of the request, its cameras and its stages.
    asked: Option<(Document, RankedCameras, Vec<RankedCamera>, Vec<RankingQuery>)>,
    complete: Option<Arc<Ranked>>,
}

impl Ranking {
    /// The panes that show it wait for one answer.
    const PANE: &'static str = "Metrics";

    /// The ranking as far as somebody asked for it in the last frame.
    pub fn seen(later: &Later) -> Waiting<RankingQuery> {
        later.seen(Self::PANE)
    }

    /// Asks for the cameras of a scene.
    pub fn ask(&mut self, later: &Later, scene: &Scene<'_>, which: RankedCameras) -> Arc<Ranked> {
        let asked = match self.asked.take() {
            Some(asked) if asked.0 == *scene.document && asked.1 == which => asked,
            former => {
                let cameras = scene.cameras_to_rank(which);
                let stages = former.filter(|former| former.2 == cameras).map(|former| former.3);
                let stages = stages.unwrap_or_else(|| RankingQuery::stages(cameras.clone()));
                (scene.document.clone(), which, cameras, stages)
            }
        };
        let (_, _, cameras, stages) = self.asked.insert(asked);
        let waiting = later.ask(Self::PANE, stages.clone());
        let is_complete = waiting.progress().is_none();
        let made = waiting.shown.filter(|shown| shown.current).map(|shown| shown.answer);
        let none_yet = || Arc::new(Ranked::new(cameras, []));
        if is_complete && (made.is_some() || stages.is_empty()) {
            return Arc::clone(self.complete.insert(made.unwrap_or_else(none_yet)));
        }
        self.complete.clone().or(made).unwrap_or_else(none_yet)
    }
}

/// A set of the catalog or the user's, without its header.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SetPlace {
    pub kind: SetKind,
    pub name: String,
    pub place: Place,
}

/// Question for metamers among sets of the catalog, which are loaded where it is answered.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CatalogMetamersQuery {
    pub rendering: RenderingQuery,
    pub reference: RenderingQuery,
    pub sets: Vec<SetPlace>,
    pub confusion: Confusion,
}

/// Two reflectances that are confused: set and name of each, and the kind of each set.
#[derive(Clone, Debug, PartialEq)]
pub struct MetamerRow {
    pub pair: MetamerPair,
    /// Name of its set, and of each in it.
    pub names: [[String; 2]; 2],
    pub kinds: [SetKind; 2],
    /// The two in sRGB as the reference renders them, and as the camera does.
    pub colors: [[[u8; 3]; 2]; 2],
}

#[derive(Clone, Debug, PartialEq)]
pub struct FoundMetamers {
    pub rows: Vec<MetamerRow>,
    pub searched: usize,
}

impl CatalogMetamersQuery {
    /// The question with all sets loaded.
    pub fn loaded(&self, ask: &impl Ask) -> Result<MetamersQuery> {
        let load = |set: &SetPlace| {
            let patches = ask.ask(&PatchesQuery { place: set.place.clone(), names: None });
            (*patches).clone().map_err(|error| SceneError::Load { name: set.name.clone(), error })
        };
        Ok(MetamersQuery {
            rendering: self.rendering.clone(),
            reference: self.reference.clone(),
            sets: self.sets.iter().map(load).collect::<Result<_, _>>()?,
            confusion: self.confusion,
            limits: MetamerLimits::USUAL,
            most: MOST_METAMERS,
        })
    }
}

impl Query for CatalogMetamersQuery {
    type Answer = Result<FoundMetamers, String>;
    const NAME: &'static str = "metamers by name";
    const CAPACITY: usize = 4;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let query = self.loaded(ask).map_err(|error| error.to_string())?;
        let found = ask.ask(&query);
        let found = (*found).as_ref().map_err(ToString::to_string)?;
        let named = |place: usize| {
            let [set, patch] = query.at(place)?;
            let (patch, set) = (query.sets[set].patches().get(patch)?.name.clone(), self.sets.get(set)?);
            Some(([set.name.clone(), patch], set.kind))
        };
        let color = |by: &RenderingQuery, place: usize| {
            let [set, patch] = query.at(place)?;
            let colors = ask.ask(&PatchColorsQuery { rendering: by.clone(), patches: query.sets.get(set)?.clone() });
            Some((*colors).as_ref().ok()?.get(patch)?.srgb.bytes)
        };
        let row = |pair: &MetamerPair| {
            let [a, b] = pair.places.map(named);
            let ((first, a), (second, b)) = a.zip(b)?;
            let seen = |by: &RenderingQuery| Some([color(by, pair.places[0])?, color(by, pair.places[1])?]);
            let colors = [seen(&self.reference)?, seen(&self.rendering)?];
            Some(MetamerRow { pair: *pair, names: [first, second], kinds: [a, b], colors })
        };
        Ok(FoundMetamers { rows: found.pairs.iter().filter_map(row).collect(), searched: found.searched })
    }
}

impl Scene<'_> {
    /// Query for all figures of merit of a sensor under the document's conditions, the locus at the marked temperature.
    pub fn camera_metrics_query(&self, kind: SetKind, name: &str) -> Result<CameraMetricsQuery> {
        Ok(self.metrics_conditions(self.document.temperature_k, MetricSet::ALL)?.query(self.sensor(kind, name)?))
    }

    pub fn camera_figures(&self, kind: SetKind, name: &str) -> Result<CameraFigures> {
        let query = self.card_query(&SensorId { kind, name: name.to_owned() })?.with_uncertainties();
        self.loaded(&query, name)
    }

    /// The cameras of a choice, each with its query. Loads none of them.
    fn cameras_to_rank(&self, which: RankedCameras) -> Vec<RankedCamera> {
        let is_chosen = |entry: &Entry| match which {
            RankedCameras::Library => true,
            RankedCameras::Compared => self.document.compared(SetKind::Camera, &entry.name).is_some(),
            RankedCameras::Yours => entry.is_own(),
        };
        let conditions = self.metrics_conditions(self.document.temperature_k, MetricSet::ALL);
        let conditions = conditions.map(Shared::new).map_err(|error| error.to_string());
        let camera = |entry: Entry| RankedCamera {
            query: conditions.clone().map(|conditions| self.metrics_query_of(&entry, conditions)),
            id: SensorId { kind: SetKind::Camera, name: entry.name },
        };
        self.entries(SetKind::Camera).filter(is_chosen).map(camera).collect()
    }

    /// Figures of merit of a choice of cameras with uncertainties, without delay.
    pub fn ranked(&self, which: RankedCameras) -> Ranked {
        let cameras = self.cameras_to_rank(which);
        let queries = cameras.iter().filter_map(|camera| camera.query.as_ref().ok());
        Ranked::new(&cameras, queries.map(|query| self.results.ask(&query.with_uncertainties())))
    }

    /// Query for the figures of merit of a camera, which is loaded where it is answered.
    pub fn card_query(&self, camera: &SensorId) -> Result<CatalogMetricsQuery> {
        let conditions = Shared::new(self.metrics_conditions(self.document.temperature_k, MetricSet::ALL)?);
        self.figures_query(camera, conditions)
    }

    /// The same under other conditions.
    pub fn figures_query(
        &self,
        camera: &SensorId,
        conditions: Shared<MetricsConditions>,
    ) -> Result<CatalogMetricsQuery> {
        Ok(self.metrics_query_of(&self.entry(camera.kind, &camera.name)?, conditions))
    }

    fn metrics_query_of(&self, camera: &Entry, conditions: Shared<MetricsConditions>) -> CatalogMetricsQuery {
        let ratio = self.channel_ratio_query(&camera.name).ok();
        CatalogMetricsQuery { place: camera.place.clone(), conditions, ratio, with_uncertainties: false }
    }

    /// Conditions of the figures of merit that are wanted, the locus at a temperature in kelvins. Loads no camera.
    pub fn metrics_conditions(&self, temperature_k: f64, wanted: MetricSet) -> Result<MetricsConditions> {
        Ok(MetricsConditions {
            reference: self.rendering_of(SetKind::Observer, &self.document.reference)?,
            patches: self.patches()?,
            temperature: Kelvin::new(temperature_k)?,
            index: self.index_conditions()?,
            electrons: self.document.pixel.and_then(|pixel| pixel.electrons().ok()),
            own: self.own_uncertainties()?,
            wanted,
        })
    }

    /// Query for metamers of a camera and the reference among all sets of reflectances. Loads none of them.
    pub fn metamers_query(&self, kind: SetKind, name: &str, confusion: Confusion) -> Result<CatalogMetamersQuery> {
        let kinds = [SetKind::Chart, SetKind::Material].into_iter();
        Ok(CatalogMetamersQuery {
            rendering: self.rendering_of(kind, name)?,
            reference: self.rendering_of(SetKind::Observer, &self.document.reference)?,
            sets: kinds.flat_map(|kind| self.places(kind)).collect(),
            confusion,
        })
    }

    /// The sets of a kind, the user's own first.
    pub(super) fn places(&self, kind: SetKind) -> impl Iterator<Item = SetPlace> {
        let own = self.document.own.iter().filter(move |set| SetKind::of_own(set) == kind);
        let own = own.map(|set| (set.name.clone(), Place::Own(set.clone())));
        let built_in = self.catalog.of_kind(kind).map(|entry| (entry.name.clone(), entry.place.clone()));
        own.chain(built_in).map(move |(name, place)| SetPlace { kind, name, place })
    }

    fn index_conditions(&self) -> Result<IndexConditions> {
        let light = self.entry(SetKind::Illuminant, INDEX_LIGHT)?;
        Ok(IndexConditions {
            observer: self.sensor(SetKind::Observer, CIE_1931)?,
            light: self.loaded(&LightQuery::Set(light.place), INDEX_LIGHT)?.grid,
            patches: self.patch_set(CHART, Some(&COLOR_CHECKER_CHROMATIC))?,
        })
    }
}
