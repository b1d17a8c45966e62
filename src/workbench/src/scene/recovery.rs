//! Cameras measured from shots of a chart or from narrow bands, with the built-in tables as prior.

use std::sync::Arc;

use chromascope_core::camera::recorded::RecordedPatch;
use chromascope_core::query::{Ask, ChartMeasurement, ChartRecoveryQuery, ChartShot, Query, Shared};
use chromascope_core::recovery::{Library, NarrowBandRecovery, NarrowBands, Shot};
use chromascope_core::spectral::{GridSpectrum, Sensor};

use super::metrics::SetPlace;
use super::{Result, Scene, SceneError};
use crate::catalog::load::{PatchesQuery, SensorQuery, StandardsQuery};
use crate::catalog::{Catalog, Entry};
use crate::document::{CIE_1931, SetKind};

/// Lights that a shot is compared with, where another than the one named would explain it.
const OTHER_LIGHTS: [&str; 7] = ["A", "D50", "D55", "D65", "D75", "FL2", "FL11"];

/// Question for a camera's sensitivities by shots of a chart. The library's tables are loaded where it is answered.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MeasuredCameraQuery {
    pub shots: Vec<ChartShot>,
    cameras: Vec<SetPlace>,
    charts: Vec<SetPlace>,
    other_lights: Vec<(String, Shared<GridSpectrum>)>,
    observer: Shared<Sensor>,
}

impl Query for MeasuredCameraQuery {
    type Answer = Result<Arc<ChartMeasurement>>;
    const NAME: &'static str = "camera measured from a chart";
    const CAPACITY: usize = 8;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let standards = (*ask.ask(&StandardsQuery)).clone();
        let standards = standards.map_err(|error| SceneError::Load { name: "daylight".to_owned(), error })?;
        let sites: Vec<f64> = (0..41).map(|i| 380.0 + 10.0 * f64::from(i)).collect();
        let chart = |SetPlace { name, place, .. }: &SetPlace| {
            let patches = (*ask.ask(&PatchesQuery { place: place.clone(), names: None })).clone();
            Some((name.clone(), patches.ok()?))
        };
        let query = ChartRecoveryQuery {
            other_charts: self.charts.iter().filter_map(chart).collect(),
            library: Shared::new(Library::new(sensors(&self.cameras, ask)?, &sites)),
            shots: self.shots.clone(),
            daylight: Shared::new(standards.daylight.clone()),
            other_lights: self.other_lights.clone(),
            observer: self.observer.clone(),
        };
        Ok((*ask.ask(&query)).clone()?)
    }
}

/// Question for a camera's sensitivities by narrow bands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MeasuredBandsQuery {
    bands: Shared<NarrowBands>,
    cameras: Vec<SetPlace>,
}

impl Query for MeasuredBandsQuery {
    type Answer = Result<Arc<NarrowBandRecovery>>;
    const NAME: &'static str = "camera measured from narrow bands";
    const CAPACITY: usize = 8;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let nm = self.bands.wavelengths_nm()?;
        let library = Library::new(sensors(&self.cameras, ask)?, &nm);
        Ok(Arc::new(self.bands.recover(&library)?))
    }
}

/// Built-in cameras: what users measured takes no part in the prior.
pub fn built_in_cameras(catalog: &Catalog) -> Vec<SetPlace> {
    let place =
        |entry: &Entry| SetPlace { kind: SetKind::Camera, name: entry.name.clone(), place: entry.place.clone() };
    catalog.of_kind(SetKind::Camera).map(place).collect()
}

/// Tables by their names.
pub(super) fn sensors(cameras: &[SetPlace], ask: &impl Ask) -> Result<Vec<(String, Sensor)>> {
    let table = |SetPlace { name, place, .. }: &SetPlace| {
        let sensor = (*ask.ask(&SensorQuery(place.clone()))).clone();
        let sensor = sensor.map_err(|error| SceneError::Load { name: name.clone(), error })?;
        Ok((name.clone(), (*sensor).clone()))
    };
    cameras.iter().map(table).collect()
}

impl Scene<'_> {
    /// Patches recorded under the light on the scene, with the standard deviations of their values by the pixels where they are known, and
    /// of what model and recording differ by beyond that, relative to a value; in rows of so many columns, 24 patches else in rows
    /// of 6. With `is_daylight` the light on the scene stands in for daylight of unknown temperature.
    pub fn chart_shot(
        &self,
        (patches, pixels): (Vec<RecordedPatch>, Vec<[f64; 3]>),
        columns: Option<usize>,
        relative: f64,
        is_daylight: bool,
    ) -> Result<ChartShot> {
        let light = (*self.light()?.grid).clone();
        let name = if is_daylight { "daylight".to_owned() } else { self.light_name() };
        let (chart, picture) = (self.document.chart.clone(), String::new());
        let columns = columns.or_else(|| (patches.len() == 24).then_some(6));
        let shot = Shot::new(patches, columns, light, &pixels, relative);
        Ok(ChartShot { shot: Shared::new(shot), is_daylight, light: name, chart, picture })
    }

    /// Question for the sensitivities of the camera that recorded narrow bands.
    pub fn measured_bands(&self, bands: NarrowBands) -> MeasuredBandsQuery {
        MeasuredBandsQuery { bands: Shared::new(bands), cameras: built_in_cameras(self.catalog) }
    }

    /// Question for the sensitivities of the camera that recorded some shots.
    pub fn measured_camera(&self, shots: Vec<ChartShot>) -> Result<MeasuredCameraQuery> {
        let other = |name: &&str| Ok(((*name).to_owned(), self.illuminant(name)?.grid));
        Ok(MeasuredCameraQuery {
            shots,
            cameras: built_in_cameras(self.catalog),
            charts: self.places(SetKind::Chart).collect(),
            other_lights: OTHER_LIGHTS.iter().map(other).collect::<Result<_>>()?,
            observer: self.sensor(SetKind::Observer, CIE_1931)?,
        })
    }
}
