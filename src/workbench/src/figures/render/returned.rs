//! Share of light that the chosen surface returns, in words: an indication of the reflectance model's limits.

use chromascope_core::query::Ask as _;
use chromascope_core::query::render::LEAST_FACING;
use chromascope_core::query::render::Roughness;
use chromascope_core::query::render::returned::{ReturnedLight, ReturnedLightQuery};
use chromascope_core::reflectance::{Normalization, Surface};

use crate::format::number;
use crate::scene::Scene;

/// A sentence on the share of light returned.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    pub text: String,
    /// More light is returned than comes.
    pub is_warning: bool,
}

/// The share for the selected surface; `None` where each vertex has a roughness of its own, or without a model.
pub fn of(scene: &Scene<'_>) -> Option<ReturnedLight> {
    let settings = &scene.document.render;
    if settings.roughness == Roughness::Mesh || settings.normalization == Normalization::Lambertian {
        return None;
    }
    let surface: Surface = settings.surface().ok()?;
    Some(*scene.results.ask(&ReturnedLightQuery { surface, reading: settings.normalization }))
}

/// The share for the surface that is chosen, in words.
pub fn words(scene: &Scene<'_>) -> Option<Words> {
    of(scene).map(|light| sentence(light, scene.document.render.normalization))
}

/// Meaning of the sentence, for a hint.
pub const fn meaning(reading: Normalization) -> &'static str {
    match reading {
        Normalization::Paper => {
            "The model's directional-hemispherical reflectance at 550 nm, diffuse and coherent, for S(λ) = 1. P is \
             relative to a smooth mirror, and depends on A: it is not a reflectance. This is the value that Eq 12 \
             uses."
        }
        _ => {
            "The model's directional-hemispherical reflectance at 550 nm, diffuse and coherent, for S(λ) = 1: ∫ f \
             cos θs dω. Without multiple scattering, shadowing and masking, energy is not conserved at grazing \
             angles: light that falls there is lost, and a viewer there sees the surface brighter than an exchange of \
             light and viewer would have it. A steep surface sends little straight back to the light; a picture of it \
             is exposed as if that were at least a fifth of a diffuse white's."
        }
    }
}

fn sentence(light: ReturnedLight, reading: Normalization) -> Words {
    let share = |value: f64| {
        let decimals = if value < 0.005 && value > 0.0 { return format!("{value:.0e}") } else { 2 };
        crate::format::fixed(value, decimals)
    };
    let (normal, grazing) = (share(light.normal), share(light.grazing));
    let mut text = format!("Returns {normal} of the light at normal incidence ({grazing} at 85°)");
    if reading == Normalization::Paper {
        text.push_str(", with P as π f");
    }
    if reading != Normalization::Paper && light.facing < LEAST_FACING {
        let facing = share(light.facing);
        text = format!(
            "{text}; seen from the light {facing} of a diffuse white, brighter at grazing views: exposed for {LEAST_FACING}"
        );
    }
    if let Some(from) = light.exceeds_one_from_deg {
        let from = number(from.round());
        text = format!("{text}; more than 1 from {from}°: energy is not conserved");
    }
    Words { text, is_warning: light.exceeds_one_from_deg.is_some() }
}
