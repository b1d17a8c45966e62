//! Recorded raw RGB against the library: which table is this camera?

use chromascope_core::camera::recorded::{Freedom, LinkKind, RecordedError, RecordedFit};
use chromascope_core::query::{Ask as _, RecordedFitQuery, RecordedSet};
use chromascope_core::spectral::{GridSpectrum, Primaries};

use super::{Scene, SceneError};
use crate::catalog::recorded::lit;
use crate::document::SetKind;
use crate::format::fixed;

/// A camera and its fit to recorded values.
#[derive(Clone, Debug)]
pub struct RankedCamera {
    /// Name in the catalog.
    pub name: String,
    /// Its fit, or the reason that there is none.
    pub fit: Result<RecordedFit, RecordedError>,
}

impl RankedCamera {
    /// RMS of the log error in percent; none where there is no fit.
    pub fn rms_percent(&self) -> Option<f64> {
        self.fit.as_ref().ok().map(|fit| fit.rms() * 100.0)
    }
}

impl Scene<'_> {
    /// Cameras by the RMS of their log error, smallest first: those named, or all of the library and the user's.
    pub fn ranked_cameras(
        &self,
        recorded: &RecordedSet,
        freedom: Freedom,
        names: &[String],
    ) -> Result<Vec<RankedCamera>, SceneError> {
        let all = || self.entries(SetKind::Camera).map(|entry| entry.name).collect();
        let names: Vec<String> = if names.is_empty() { all() } else { names.to_vec() };
        let mut ranked = Vec::with_capacity(names.len());
        for name in names {
            let sensor = self.sensor(SetKind::Camera, &name)?;
            if sensor.primaries() == Primaries::Camera {
                let query = RecordedFitQuery { recorded: recorded.clone(), sensor, freedom };
                ranked.push(RankedCamera { name, fit: (*self.results.ask(&query)).clone() });
            }
        }
        let rms = |camera: &RankedCamera| camera.fit.as_ref().map_or(f64::INFINITY, RecordedFit::rms);
        ranked.sort_by(|a, b| rms(a).total_cmp(&rms(b)));
        Ok(ranked)
    }

    /// Radiances `S_p L` of the chart's patches under the light, by name.
    pub fn patch_radiances(&self) -> Result<Vec<(String, GridSpectrum)>, SceneError> {
        let light = self.light()?;
        let patches = self.patches()?;
        Ok(patches.patches().iter().map(|patch| (patch.name.clone(), lit(&patch.grid, &light.grid))).collect())
    }
}

/// Names of the channels in words.
pub const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// A cause of residuals in words, with its amount.
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
