//! Credibility of the ratio between a camera table's channels, judged by the maker's other tables.

use chromascope_core::camera::{ChannelRatio, RatioTable};
use chromascope_core::query::{Ask, Query};

use super::{Scene, SceneError};
use crate::catalog::load::{LightQuery, LoadError, SensorQuery};
use crate::catalog::{Entry, Place};
use crate::document::SetKind;

/// The light under which neutrals are compared.
const LIGHT: &str = "D65";

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
    pub fn channel_ratio_query(&self, name: &str) -> Result<ChannelRatioQuery, SceneError> {
        let own = self.entry(SetKind::Camera, name)?;
        let maker = maker_of(&own.name);
        let is_other = |other: &&Entry| other.place != own.place && maker_of(&other.name) == maker;
        let others = self.catalog.of_kind(SetKind::Camera).filter(is_other);
        let tables = std::iter::once(&own).chain(others).map(|entry| (entry.place.clone(), entry.is_digitized()));
        Ok(ChannelRatioQuery { light: self.entry(SetKind::Illuminant, LIGHT)?.place, tables: tables.collect() })
    }

    /// Credibility of a camera's channel ratio. Loads the tables of its maker.
    pub fn channel_ratio(&self, name: &str) -> Result<ChannelRatio, SceneError> {
        self.loaded(&self.channel_ratio_query(name)?, name)
    }
}
