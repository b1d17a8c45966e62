//! Color corrections as queries: of which sensor, under which one or two lights; and the credibility of the ratio between a camera
//! table's channels, judged by the maker's other tables.

use chromascope_core::camera::{ChannelRatio, RatioTable};
use chromascope_core::colorimetry::Metric;
use chromascope_core::correction::aces::IdtExposure;
use chromascope_core::query::correction::{CorrectionSheetQuery, IdtQuery};
use chromascope_core::query::{Ask, CorrectionReportQuery, Query, RenderingQuery};

use super::{Result, Scene};
use crate::catalog::load::{LightQuery, LoadError, SensorQuery};
use crate::catalog::{Entry, Place};
use crate::document::{CIE_1931, FIT_TARGET, SetKind, TRAINING, TransformChoice};

/// EXIF's codes of lights by the names of their sets (`LightSource`).
const EXIF_LIGHTS: [(&str, u16); 8] = [
    ("A", 17),
    ("B", 18),
    ("C", 19),
    ("D55", 20),
    ("D65", 21),
    ("D75", 22),
    ("D50", 23),
    ("ISO 7589 studio tungsten", 24),
];

/// EXIF's code of a light; none for lights that EXIF does not name.
pub fn exif_light(name: &str) -> Option<u16> {
    EXIF_LIGHTS.iter().find(|(known, _)| *known == name).map(|(_, code)| *code)
}

/// The light under which neutrals are compared.
const NEUTRAL_LIGHT: &str = "D65";

/// Query for the credibility of a camera's channel ratio.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ChannelRatioQuery {
    light: Place,
    /// The camera's table, then the built-in ones of the same maker; true for tables read off a printed figure.
    tables: Vec<(Place, bool)>,
}

impl Query for ChannelRatioQuery {
    type Answer = Result<ChannelRatio, LoadError>;
    const NAME: &'static str = "channel ratio";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let light = ask.ask(&LightQuery::Set(self.light.clone()));
        let light = (*light).as_ref().map_err(Clone::clone)?;
        let table = |(place, is_digitized): &(Place, bool)| {
            let camera = (*ask.ask(&SensorQuery(place.clone()))).clone()?;
            Ok(RatioTable::new(&camera, &light.grid, *is_digitized))
        };
        let tables = self.tables.iter().map(table).collect::<Result<Vec<_>, LoadError>>()?;
        let (own, others) = tables.split_first().ok_or(LoadError::NoCurve)?;
        Ok(ChannelRatio::new(own, others.iter().copied()))
    }
}

/// Maker by the first word of a camera's name, as `Nikon` of `nikon_d200`.
fn maker_of(name: &str) -> String {
    name.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_lowercase()
}

impl Scene<'_> {
    pub fn channel_ratio_query(&self, name: &str) -> Result<ChannelRatioQuery> {
        let own = self.entry(SetKind::Camera, name)?;
        let maker = maker_of(&own.name);
        let is_other = |other: &&Entry| other.place != own.place && maker_of(&other.name) == maker;
        let others = self.catalog.of_kind(SetKind::Camera).filter(is_other);
        let tables = std::iter::once(&own).chain(others).map(|entry| (entry.place.clone(), entry.is_digitized()));
        Ok(ChannelRatioQuery { light: self.entry(SetKind::Illuminant, NEUTRAL_LIGHT)?.place, tables: tables.collect() })
    }

    /// Credibility of a camera's channel ratio. Loads the tables of its maker.
    pub fn channel_ratio(&self, name: &str) -> Result<ChannelRatio> {
        self.loaded(&self.channel_ratio_query(name)?, name)
    }

    /// Query for a sensor's color correction with all errors, under the light on the scene and the second of the document.
    pub fn correction_sheet(&self, kind: SetKind, name: &str) -> Result<CorrectionSheetQuery> {
        let first = self.rendering_of(kind, name)?;
        let metric = self.correction_metric();
        let second = match &self.document.correction.second_light {
            Some(light) => Some(RenderingQuery { light: self.illuminant(light)?.grid, ..first.clone() }),
            None => None,
        };
        let report = |rendering| CorrectionReportQuery { rendering, metric };
        let observer = self.sensor(SetKind::Observer, CIE_1931)?;
        Ok(CorrectionSheetQuery { first: report(first), second: second.map(report), observer })
    }

    /// Metric of corrections' errors: the document's, where it is one of L\*a\*b\*.
    pub fn correction_metric(&self) -> Metric {
        Some(self.document.difference).filter(|metric| metric.needs_adopted_white()).unwrap_or(Metric::DELTA_E_2000)
    }

    /// Query for a camera's ACES input transform under the light on the scene.
    pub fn input_device_transform(&self, kind: SetKind, name: &str, exposure: IdtExposure) -> Result<IdtQuery> {
        Ok(IdtQuery {
            camera: self.sensor(kind, name)?,
            light: self.light()?.grid,
            observer: self.sensor(SetKind::Observer, CIE_1931)?,
            training: self.patch_set(TRAINING, None)?,
            exposure,
            neutral: None,
        })
    }

    /// The observer that fitted color transforms are fitted to.
    pub fn fit_target(&self) -> &str {
        match &self.document.transform {
            TransformChoice::Paper => FIT_TARGET,
            TransformChoice::Observer(target) => target,
        }
    }
}
