//! Credibility of the ratio between a camera table's channels, judged by the maker's other tables.

use chromascope_core::camera::{ChannelRatio, RatioTable};
use chromascope_core::query::{Ask, Query};

use super::{Scene, SceneError};
use crate::catalog::load::{LightQuery, LoadError, SensorQuery};
use crate::catalog::{Entry, Place};
use crate::document::SetKind;

/// The light under which neutrals are compared.
const LIGHT: &str = "D65";

/// Query for the neutral of a camera's table.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct RatioTableQuery {
    camera: Place,
    light: Place,
    is_digitized: bool,
}

impl Query for RatioTableQuery {
    type Answer = Result<RatioTable, LoadError>;
    const NAME: &'static str = "neutral of a table";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let camera = (*ask.ask(&SensorQuery(self.camera.clone()))).clone()?;
        let light = ask.ask(&LightQuery::Set(self.light.clone()));
        let light = (*light).as_ref().map_err(Clone::clone)?;
        Ok(RatioTable::new(&camera, &light.grid, self.is_digitized))
    }
}

/// Query for the credibility of a camera's channel ratio.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ChannelRatioQuery {
    table: RatioTableQuery,
    /// Built-in tables of the same maker.
    others: Vec<RatioTableQuery>,
}

impl Query for ChannelRatioQuery {
    type Answer = Result<ChannelRatio, LoadError>;
    const NAME: &'static str = "channel ratio";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let own = (*ask.ask(&self.table)).clone()?;
        let others = self.others.iter().map(|other| (*ask.ask(other)).clone());
        Ok(ChannelRatio::new(&own, others.collect::<Result<Vec<_>, _>>()?))
    }
}

/// Maker by the first word of a camera's name, as `Nikon` of `nikon_d200`.
fn maker_of(name: &str) -> String {
    name.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_lowercase()
}

impl Scene<'_> {
    /// Query for the credibility of a camera's channel ratio. Loads no table.
    ///
    /// # Errors
    ///
    /// [`SceneError::NoSet`] for a name that no camera has.
    pub fn channel_ratio_query(&self, name: &str) -> Result<ChannelRatioQuery, SceneError> {
        let light = self.entry(SetKind::Illuminant, LIGHT)?.place;
        let own = self.entry(SetKind::Camera, name)?;
        let table = |entry: &Entry| RatioTableQuery {
            camera: entry.place.clone(),
            light: light.clone(),
            is_digitized: entry.is_digitized(),
        };
        let maker = maker_of(&own.name);
        let is_other = |other: &&Entry| other.place != own.place && maker_of(&other.name) == maker;
        let others = self.catalog.of_kind(SetKind::Camera).filter(is_other).map(table).collect();
        Ok(ChannelRatioQuery { table: table(&own), others })
    }

    /// Credibility of a camera's channel ratio. Loads the tables of its maker.
    ///
    /// # Errors
    ///
    /// [`SceneError`] for a name that no camera has, and for a damaged table.
    pub fn channel_ratio(&self, name: &str) -> Result<ChannelRatio, SceneError> {
        self.loaded(&self.channel_ratio_query(name)?, name)
    }
}
