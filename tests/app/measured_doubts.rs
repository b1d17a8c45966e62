//! How often a measurement is warned of: every camera of the library as if it were unknown, under lights that are named rightly and wrongly.

use chromascope::catalog::Catalog;
use chromascope::catalog::load::StandardsQuery;
use chromascope::catalog::names::model_of;
use chromascope::document::start::Start;
use chromascope::document::{CIE_1931, Light, PHOTOGRAPHED_CHART, SetKind};
use chromascope::export::measured::doubts;
use chromascope::results::Results;
use chromascope::scene::Scene;
use chromascope::scene::measurement::RELATIVE;
use chromascope::scene::recovery::built_in_cameras;
use chromascope_core::camera::recorded::{RecordedPatch, Signal};
use chromascope_core::light::DaylightBasis;
use chromascope_core::math::random::SplitMix64;
use chromascope_core::query::{Ask as _, ChartMeasurement, ChartRecoveryQuery, ChartShot, Shared};
use chromascope_core::recovery::{ChartRecovery, Library, RecoveryError, Shot, ShotProfile};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use rayon::prelude::*;

/// Name of daylight of unknown temperature.
const DAYLIGHT: &str = "daylight";

/// Name of a light, perfect diffuser and patches of the chart under it.
type Lit = (&'static str, GridSpectrum, Vec<(String, GridSpectrum)>);

struct World {
    cameras: Vec<(String, Sensor)>,
    observer: Sensor,
    basis: DaylightBasis,
    lights: Vec<Lit>,
}

impl World {
    fn new() -> Self {
        let (catalog, results) = (Catalog::built_in(), Results::default());
        let mut document = Start::Colorimetry.document();
        PHOTOGRAPHED_CHART.clone_into(&mut document.chart);
        let lights = ["D65", "A", "FL11", "FL2", "D50", "D55", "D75"].map(|name| {
            document.light = Light::Set(name.to_owned());
            let scene = Scene { document: &document, catalog: &catalog, results: &results };
            (name, (*scene.light().unwrap().grid).clone(), scene.patch_radiances().unwrap())
        });
        let scene = Scene { document: &document, catalog: &catalog, results: &results };
        let names = built_in_cameras(&catalog).into_iter().map(|set| set.name);
        let sensor = |kind, name: &str| (*scene.sensor(kind, name).unwrap()).clone();
        let standards = (*results.ask(&StandardsQuery)).clone().unwrap();
        Self {
            cameras: names.map(|name| (name.clone(), sensor(SetKind::Camera, &name))).collect(),
            observer: sensor(SetKind::Observer, CIE_1931),
            basis: standards.daylight.clone(),
            lights: lights.to_vec(),
        }
    }

    fn light(&self, name: &str) -> &Lit {
        self.lights.iter().find(|(own, ..)| *own == name).unwrap()
    }

    /// A photograph by a camera under one light, named as under another: pixels with noise, shading and glare.
    fn shot(&self, camera: usize, under: &str, named: &str) -> Shot {
        let mut random = SplitMix64::new(camera as u64);
        let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
        let (sensor, (_, own, patches)) = (&self.cameras[camera].1, self.light(under));
        let (_, light, radiances) = self.light(if named == DAYLIGHT { "D65" } else { named });
        let white = sensor.integrate(own.values());
        let patch = |((name, radiance), (_, own)): (&(String, GridSpectrum), &(String, GridSpectrum))| {
            let (raw, bright) = (sensor.integrate(own.values()), (0.05 * normal()).exp());
            let rgb = [0, 1, 2].map(|c| {
                let value = 0.8 * (bright * raw[c] + 0.004 * white[c]) / white[1];
                Signal::new(value * (1.0 + 0.002 * normal()), f64::INFINITY)
            });
            RecordedPatch { name: name.clone(), radiance: radiance.clone(), rgb }
        };
        let patches = radiances.iter().zip(patches).map(patch).collect();
        Shot::new(patches, Some(6), light.clone(), &[], RELATIVE)
    }

    /// All tables but those of the camera's model.
    fn others(&self, camera: usize) -> Library {
        let own = model_of(&self.cameras[camera].0);
        let sites: Vec<f64> = (0..41).map(|i| 380.0 + 10.0 * f64::from(i)).collect();
        Library::new(self.cameras.iter().filter(|(name, _)| model_of(name) != own).cloned(), &sites)
    }

    /// As the program measures it.
    fn whole(&self, camera: usize, under: &str, named: &str) -> Result<ChartMeasurement, RecoveryError> {
        let others = self.lights.iter().map(|(name, light, _)| ((*name).to_owned(), Shared::new(light.clone())));
        let shot = ChartShot {
            shot: Shared::new(self.shot(camera, under, named)),
            is_daylight: named == DAYLIGHT,
            light: named.to_owned(),
            chart: String::new(),
            picture: String::new(),
        };
        let query = ChartRecoveryQuery {
            library: Shared::new(self.others(camera)),
            shots: vec![shot],
            daylight: Shared::new(self.basis.clone()),
            other_lights: others.collect(),
            other_charts: Vec::new(),
            observer: Shared::new(self.observer.clone()),
        };
        (*chromascope_core::query::Direct.ask(&query)).clone().map(|found| (*found).clone())
    }

    /// Without what is not asked for doubts; compared with the other lights, or not.
    fn short(
        &self,
        camera: usize,
        [under, named]: [&str; 2],
        compared: bool,
    ) -> Result<ChartMeasurement, RecoveryError> {
        let (library, shots) = (self.others(camera), vec![self.shot(camera, under, named)]);
        let others = self.lights.iter().filter(|(name, ..)| compared && *name != named);
        let others: Vec<(String, Vec<Shot>)> =
            others.map(|(name, light, _)| ((*name).to_owned(), vec![shots[0].under(light)])).collect();
        let others = others.iter().map(|(name, shots)| (name.clone(), shots.as_slice()));
        let recovery = ChartRecovery::against(&library, &shots, others)?;
        let nearest = library.nearest(&recovery.curves.values);
        let nearest = nearest.into_iter().map(|(name, distance)| (name.to_owned(), distance)).collect();
        let corrections = ChartRecoveryQuery::corrections();
        let profile = ShotProfile::new(&recovery, &shots, &[0], &self.observer, &corrections)?;
        let profiles = vec![(named.to_owned(), profile)];
        let (charts, left_out) = (Vec::new(), Vec::new());
        Ok(ChartMeasurement {
            recovery,
            shots,
            charts,
            better_chart: None,
            daylight: None,
            nearest,
            left_out,
            profiles,
        })
    }

    /// Numbers of cameras that are refused, and that are warned of, among every so many.
    fn count(
        &self,
        every: usize,
        measure: impl Fn(usize) -> Result<ChartMeasurement, RecoveryError> + Sync,
    ) -> [usize; 3] {
        let cameras: Vec<usize> = (0..self.cameras.len()).step_by(every).collect();
        let one = |camera: &usize| match measure(*camera) {
            Err(_) => [1, 0],
            Ok(found) => [0, usize::from(!doubts(&found).is_empty())],
        };
        let all: Vec<[usize; 2]> = cameras.par_iter().map(one).collect();
        let [refused, warned] = [0, 1].map(|at| all.iter().map(|of| of[at]).sum());
        [refused, warned, cameras.len()]
    }
}

const RIGHT: [[&str; 2]; 3] = [["D65"; 2], ["A"; 2], ["FL11"; 2]];
const WRONG: [[&str; 2]; 7] =
    [["A", "D65"], ["D65", "A"], ["FL11", "D65"], ["FL11", "A"], ["D65", "FL11"], ["A", "FL11"], ["D50", "D65"]];

#[test]
#[ignore = "prints the table of refusals and warnings"]
#[allow(clippy::print_stdout, reason = "the table is what a run on demand is for")]
fn table_of_doubts() {
    let world = World::new();
    for [under, named] in RIGHT.into_iter().chain(WRONG) {
        let [refused, warned, all] = world.count(1, |camera| world.short(camera, [under, named], true));
        println!("{under} named {named}: refused {refused}, warned {warned} of {all}");
        for camera in (0..world.cameras.len()).filter(|_| under == named) {
            if let Ok(found) = world.short(camera, [under, named], false) {
                for why in doubts(&found) {
                    println!("  {}: {why}", world.cameras[camera].0);
                }
            }
        }
    }
    for under in ["D55", "D75", "A", "FL11"] {
        let [refused, warned, all] = world.count(4, |camera| world.whole(camera, under, DAYLIGHT));
        println!("{under} named daylight: refused {refused}, warned {warned} of {all}");
    }
}

/// A third of the cameras, without the comparison with other lights, which refuses more.
#[test]
fn right_lights_are_rarely_warned_of_and_wrong_ones_mostly_noticed() {
    let world = World::new();
    let sum = |cases: &[[&str; 2]]| {
        let of = |case: &[&str; 2]| world.count(3, |camera| world.short(camera, *case, false));
        cases.iter().map(of).fold([0; 3], |sum, of| [0, 1, 2].map(|at| sum[at] + of[at]))
    };
    let ([refused, warned, all], [stopped, noticed, cases]) = (sum(&RIGHT), sum(&WRONG[..6]));
    assert!((refused + warned) as f64 <= 0.1 * all as f64, "{refused} {warned} of {all}");
    assert!((stopped + noticed) as f64 >= 0.8 * cases as f64, "{stopped} {noticed} of {cases}");
}
