//! Conditions of a run, without which its times say little.

use chromascope_core::query::render::Roughness;
use chromascope_measure::Machine;
use chromascope_measure::harness::now;
use serde::{Deserialize, Serialize};

use super::{SceneRunJob, Subject, Trial};
use crate::format::number;
use crate::scene::Scene;

/// Conditions of a run: scene, machine, program and time.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Conditions {
    /// Mesh, material, surface, light and number of sensors, in words; empty where nothing was rendered.
    pub scene: String,
    /// Number of visible sensors.
    pub sensors: usize,
    /// The processor, its threads, its instruction set.
    pub machine: String,
    pub program: String,
    /// Start time in UTC, as `2026-11-21T18:05:11Z`.
    pub began: String,
}

impl Conditions {
    pub(super) fn now(run: &SceneRunJob) -> Self {
        Self {
            scene: run.scene.clone(),
            sensors: run.sensors.len(),
            machine: Machine::unmeasured().identity(),
            program: chromascope_measure::program(),
            began: now(),
        }
    }

    /// Scene or stimuli of a trial, in words.
    pub fn of(&self, trial: &Trial) -> String {
        match trial.subject {
            Subject::Integral => self.scene.clone(),
            Subject::Loci => {
                let plural = if self.sensors == 1 { "source" } else { "sources" };
                format!("blackbodies from 1000 to 20 000 K, {} {plural}", self.sensors)
            }
        }
    }

    /// Machine and time of the measurement, a sentence.
    pub fn on(&self) -> String {
        let known = [&self.machine, &self.program, &self.began].into_iter().filter(|words| !words.is_empty());
        let known = known.map(String::as_str).collect::<Vec<_>>().join(", ");
        if known.is_empty() {
            "The machine it was measured on is unknown.".to_owned()
        } else {
            format!("Measured on: {known}.")
        }
    }
}

impl Trial {
    /// Number and kind of inputs, in words.
    pub fn inputs_in_words(&self) -> String {
        format!("{} {}", self.inputs, self.subject.either("lit samples", "temperatures"))
    }

    /// A method's name, marked as the reference or the selected one.
    pub fn name(&self, index: usize) -> String {
        let name = self.points.get(index).map_or("", |point| &point.name);
        match (index == 0, self.set == Some(index)) {
            (true, true) => format!("{name} (reference, set)"),
            (true, false) => format!("{name} (reference)"),
            (false, true) => format!("{name} (set)"),
            (false, false) => name.to_owned(),
        }
    }
}

impl Subject {
    /// Name of the computation, in a few words.
    pub const fn what(self) -> &'static str {
        self.either("the diffuse spectral integral of rendered samples", "Planckian loci")
    }

    /// Explanation of the measurement, in full sentences.
    pub const fn explained(self) -> &'static str {
        match self {
            Self::Integral => {
                "The diffuse integral J(κ, β) over wavelength, without the specular lobe, at lit samples spread over \
                 the picture, through each sensor. κ is the roughness g at 550 nm and a sample's angles, β how far \
                 off the specular direction it is seen; S(g, b) is the sum under the integral. Errors are relative \
                 to J(κ, 0), the peak at the sample's κ; of several sensors the largest is shown, and times are \
                 means. The reference is the sum over all 401 wavelengths with S to 1e-13; error bounds are \
                 checked against that sum too. A tolerance is of the picture's brightest sample: where no sample \
                 is seen from near the specular direction, its integral is kept to less of the peak, as in “within \
                 3.1e-11, for 5e-10”."
            }
            Self::Loci => {
                "The three signals of blackbodies through each visible sensor; independent of mesh, material and \
                 light. Errors are relative to the largest of the three signals; of several sensors the largest is \
                 shown, and times are means. The reference is the sum over each nanometer; error bounds refer to \
                 that sum too."
            }
        }
    }
}

pub(super) fn words(scene: &Scene<'_>, sources: usize) -> String {
    let settings = &scene.document.render;
    let sigma = match settings.roughness {
        Roughness::Mesh => "σ of the mesh".to_owned(),
        Roughness::Surface => format!("σ {} µm", number(settings.sigma_um)),
    };
    let reading = settings.normalization.label();
    let (mesh, [light, _]) = (settings.mesh.name(), scene.rendered_conditions());
    let light = if light == "E" { "E, equal energy".to_owned() } else { light };
    let plural = if sources == 1 { "source" } else { "sources" };
    format!("{mesh}, {}, {sigma}, {reading}, under {light}, {sources} {plural}", settings.materials())
}
