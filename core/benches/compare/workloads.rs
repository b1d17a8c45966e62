//! The pieces of work: the first screen, the temperature slider.

use crate::asker::Remembering;
use crate::exact::{Exact, apart, locus_point, plain};
use crate::library::{
    CHART, CONSTANTS, DEFAULT, TRAINING, defaults, equal_energy, patches as chart, sensor, shared, temperatures, text,
};
use crate::stopwatch::{candidate, compare};
use chromascope_core::camera::{ColorTransform, LocusEvaluator, Rendering, WhiteBalanceTarget};
use chromascope_core::colorimetry::Xy;
use chromascope_core::light::planckian::black_body;
use chromascope_core::patch_set::{PAPER_FIVE, PatchSet};
use chromascope_core::query::{
    Ask, ColorTransformSpec, LocusQuery, PatchColorsQuery, RadiatorSignalsQuery, RenderingQuery, Shared,
};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use chromascope_core::units::Kelvin;

/// What is asked for one screen.
struct Screen {
    sensors: Vec<Shared<Sensor>>,
    patches: Shared<PatchSet>,
    reference: Shared<Sensor>,
    training: Shared<PatchSet>,
}

impl Screen {
    fn new(patches: PatchSet) -> Self {
        Self {
            sensors: defaults(),
            patches: Shared::new(patches),
            reference: shared(DEFAULT[4]),
            training: Shared::new(chart(TRAINING)),
        }
    }

    fn transform(&self, observer: bool) -> ColorTransformSpec {
        if observer {
            ColorTransformSpec::Observer { reference: self.reference.clone(), training: self.training.clone() }
        } else {
            ColorTransformSpec::Paper
        }
    }

    /// Every answer that the screen shows: the loci's points, then the patches', source by source.
    fn answers(&self, ask: &impl Ask, light: GridSpectrum, observer: bool) -> Vec<Xy> {
        let (light, transform) = (Shared::new(light), self.transform(observer));
        let mut found = Vec::with_capacity(self.sensors.len() * (200 + self.patches.patches().len()));
        for sensor in &self.sensors {
            let rendering = RenderingQuery {
                sensor: sensor.clone(),
                light: light.clone(),
                white: WhiteBalanceTarget::UNITY,
                transform: transform.clone(),
            };
            let colors = ask.ask(&PatchColorsQuery { rendering: rendering.clone(), patches: self.patches.clone() });
            let locus = ask.ask(&LocusQuery { rendering, temperatures: temperatures(200), constants: CONSTANTS });
            found.extend((*locus).as_ref().unwrap().points.iter().map(|point| point.xy.unwrap()));
            found.extend((*colors).as_ref().unwrap().iter().map(|color| color.xy.unwrap()));
        }
        found
    }

    /// The same by plain 1 nm sums, one number after the other.
    fn by_sums(&self, light: &GridSpectrum, observer: bool) -> Vec<Xy> {
        let mut found = Vec::new();
        for sensor in &self.sensors {
            let rendering = Rendering::new(sensor, light, WhiteBalanceTarget::UNITY, self.borrowed(observer)).unwrap();
            let evaluator = LocusEvaluator::by_sum(&**sensor, CONSTANTS);
            found.extend(temperatures(200).to_vec().into_iter().map(|t| locus_point(&rendering, evaluator.raw(t))));
            for patch in self.patches.patches() {
                let raw = plain(sensor, light.values(), patch.grid.values()).to_array();
                found.push(rendering.xyz(rendering.patch_signals(raw)).chromaticity().unwrap());
            }
        }
        found
    }

    /// The same by compensated sums.
    fn exactly(&self, light: &GridSpectrum, observer: bool) -> Vec<Xy> {
        let mut found = Vec::new();
        for sensor in &self.sensors {
            let exact = Exact::new(sensor, light, self.borrowed(observer));
            found.extend(temperatures(200).to_vec().into_iter().map(|t| exact.radiator(sensor, t)));
            found.extend(self.patches.patches().iter().map(|patch| exact.patch(sensor, light, patch.grid.values())));
        }
        found
    }

    fn borrowed(&self, observer: bool) -> ColorTransform<'_> {
        if observer {
            ColorTransform::Observer { reference: &self.reference, training: &self.training }
        } else {
            ColorTransform::Paper
        }
    }
}

/// The first screen: five sources, equal energy, 200 temperatures, five patches.
pub(crate) fn document(rounds: usize) {
    let screen = Screen::new(chart(CHART).subset(&PAPER_FIVE));
    let texts: Vec<String> = DEFAULT.iter().map(|path| text(path)).collect();
    let exact = screen.exactly(&equal_energy(), false);
    compare(
        "the first screen: 5 sources, 200 temperatures, 5 patches",
        "max xy error",
        rounds,
        vec![
            candidate(
                "1 nm sums, without reading (baseline)",
                || screen.by_sums(&equal_energy(), false),
                |found| apart(&found, &exact),
            ),
            candidate(
                "all answers, nothing known",
                || screen.answers(&Remembering::default(), equal_energy(), false),
                |found| apart(&found, &exact),
            ),
            candidate(
                "reading five sensors and the chart",
                || (texts.iter().map(|text| sensor(text)).collect::<Vec<_>>(), chart(CHART)),
                |_| f64::NAN,
            ),
        ],
    );
}

/// All that changes when the temperature slider moves and the light is a black body of that temperature: 24 patches and 200
/// temperatures of five sources. What no light changes, the sensors' raw signals, is known already.
pub(crate) fn slider(rounds: usize) {
    let screen = Screen::new(chart(CHART));
    for (observer, title) in [(false, "the slider moves, Paper"), (true, "the slider moves, Observer")] {
        let light = |t: f64| black_body(Kelvin::new(t).unwrap(), CONSTANTS);
        let asker = Remembering::default();
        for sensor in &screen.sensors {
            let (sensor, temperatures) = (sensor.clone(), temperatures(200));
            asker.ask(&RadiatorSignalsQuery { sensor, temperatures, constants: CONSTANTS });
        }
        let known = asker.len();
        let move_to = || {
            asker.keep(known);
            screen.answers(&asker, light(5500.0), observer)
        };
        let exact = screen.exactly(&light(5500.0), observer);
        compare(
            title,
            "max xy error",
            rounds,
            vec![
                candidate(
                    "1 nm sums (baseline)",
                    || screen.by_sums(&light(5500.0), observer),
                    |found| apart(&found, &exact),
                ),
                candidate("all answers that change", move_to, |found| apart(&found, &exact)),
            ],
        );
    }
}
