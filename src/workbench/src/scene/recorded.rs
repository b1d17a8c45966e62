//! Recorded raw RGB against the library: which table is this camera?

use std::sync::Arc;

use chromascope_core::camera::chart_grid::named_places;
use chromascope_core::camera::recorded::{
    Freedom, LinkKind, RESAMPLES, RankRange, RecordedError, RecordedFit, rank_ranges,
};
use chromascope_core::query::{Ask, Query, RecordedFitQuery, RecordedSet};
use chromascope_core::spectral::{GridSpectrum, Primaries};

use super::metrics::SetPlace;
use super::{Result, Scene, SceneError};
use crate::catalog::load::SensorQuery;
use crate::catalog::recorded::lit;
use crate::document::SetKind;
use crate::format::{fixed, rank_in_words};

#[derive(Clone, Debug)]
pub struct RankedCamera {
    pub name: String,
    /// Its fit, or the reason that there is none.
    pub fit: Result<RecordedFit, RecordedError>,
    /// Its rank by a bootstrap over the patches; none without a fit.
    pub rank: Option<RankRange>,
}

/// Question for cameras ranked by their fit to recorded values. They are loaded where it is answered.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RecordedRankingQuery {
    pub recorded: RecordedSet,
    freedom: Freedom,
    cameras: Vec<SetPlace>,
}

impl Query for RecordedRankingQuery {
    type Answer = Result<Arc<Vec<RankedCamera>>>;
    const NAME: &'static str = "recorded ranking";
    const CAPACITY: usize = 4;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let mut ranked = Vec::with_capacity(self.cameras.len());
        for SetPlace { name, place, .. } in &self.cameras {
            let sensor = (*ask.ask(&SensorQuery(place.clone()))).clone();
            let sensor = sensor.map_err(|error| SceneError::Load { name: name.clone(), error })?;
            if sensor.primaries() == Primaries::Camera {
                let query = RecordedFitQuery { recorded: self.recorded.clone(), sensor, freedom: self.freedom };
                ranked.push(RankedCamera { name: name.clone(), fit: (*ask.ask(&query)).clone(), rank: None });
            }
        }
        let rms = |camera: &RankedCamera| camera.fit.as_ref().map_or(f64::INFINITY, RecordedFit::rms);
        ranked.sort_by(|a, b| rms(a).total_cmp(&rms(b)));
        let fits: Vec<&RecordedFit> = ranked.iter().filter_map(|camera| camera.fit.as_ref().ok()).collect();
        // Those with a fit come first.
        let ranges = rank_ranges(&fits, self.freedom);
        for (camera, rank) in ranked.iter_mut().zip(ranges) {
            camera.rank = Some(rank);
        }
        Ok(Arc::new(ranked))
    }
}

impl Scene<'_> {
    /// The question for cameras by the RMS of their log error, smallest first: those named, or all of the library and the user's.
    pub fn recorded_ranking(
        &self,
        recorded: &RecordedSet,
        freedom: Freedom,
        names: &[String],
    ) -> Result<RecordedRankingQuery> {
        let kind = SetKind::Camera;
        let named =
            |name: &String| Ok(SetPlace { kind, name: name.clone(), place: self.find(kind, name)?.place.clone() });
        let cameras = if names.is_empty() {
            self.places(kind).collect()
        } else {
            names.iter().map(named).collect::<Result<_>>()?
        };
        Ok(RecordedRankingQuery { recorded: recorded.clone(), freedom, cameras })
    }

    /// Radiances `S_p L` of the chart's patches under the light, by name.
    pub fn patch_radiances(&self) -> Result<Vec<(String, GridSpectrum)>> {
        let light = self.light()?;
        let patches = self.patches()?;
        Ok(patches.patches().iter().map(|patch| (patch.name.clone(), lit(&patch.grid, &light.grid))).collect())
    }
}

/// Patches row by row of a picture's grid: by the places that their names state, else in their own order.
pub fn in_grid<T>(patches: Vec<(String, T)>, grid: [usize; 2]) -> Vec<(String, T)> {
    let Some(places) = named_places(patches.iter().map(|(name, _)| name.as_str()), grid) else { return patches };
    let mut placed: Vec<_> = places.into_iter().zip(patches).collect();
    placed.sort_by_key(|(place, _)| *place);
    placed.into_iter().map(|(_, patch)| patch).collect()
}

pub const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// What a rank does not tell.
pub const RANK_CAUTION: &str =
    "A rank is of tables: sensors of one maker or family often fit equally well, so it does not prove a model.";

pub fn range_in_words(rank: RankRange) -> String {
    let (range, first) = (rank_in_words(Some(rank.range)), fixed(rank.first * 100.0, 0));
    format!("rank {range} in 95 % of {RESAMPLES} resamples of the patches, smallest RMS in {first} %")
}

pub fn cause_in_words(kind: LinkKind, amount: f64, patches: &[String]) -> String {
    let signed = |value: f64, decimals| format!("{}{}", if value > 0.0 { "+" } else { "" }, fixed(value, decimals));
    match kind {
        LinkKind::Light => format!("light tilted by {} % per 100 nm", signed(amount * 100.0, 1)),
        LinkKind::Channel(channel) => {
            format!("{} sensitivity shifted by {} nm", CHANNELS.get(channel).unwrap_or(&""), signed(amount, 1))
        }
        LinkKind::Patch(patch) => {
            let name = patches.get(patch).map_or("", String::as_str);
            format!("patch {name}: {} %", fixed(amount * 100.0, 1))
        }
    }
}
