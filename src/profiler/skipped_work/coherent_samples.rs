//! Specular terms skipped because they are too small.

use std::collections::BTreeSet;

use chromascope_core::query::Ask;
use chromascope_core::query::render::MeshRoughnessQuery;
use chromascope_core::reflectance::{Geometry, Normalization, Surface, coherent_prefactor, kappa};
use chromascope_core::render::shading::CoherentSample;
use chromascope_core::render::{CoherentIntegral, SpectralWeights};
use chromascope_measure::harness::shortest;

use super::{SUMS, SkippedWork, Sources, measured_on, some_of};

/// They are computed here, with the quality in use. `None` for a normalization without a specular component.
pub(super) fn coherent_samples(sources: &Sources<'_>, ask: &impl Ask) -> Option<SkippedWork> {
    let shading = sources.shading;
    let quality = shading.quality();
    let of = &sources.pictures.shading;
    let lit: Vec<usize> = (0..shading.shades().len()).filter(|&index| sources.is_lit(index)).collect();
    let all = lit.len();
    let has: BTreeSet<u32> = shading.coherent_samples().iter().map(|coherent| coherent.index).collect();
    let skipped: Vec<usize> = lit.into_iter().filter(|&index| !has.contains(&(index as u32))).collect();
    if of.reading == Normalization::Lambertian || skipped.is_empty() {
        return None;
    }
    let roughness = shading.vertices().map(|_| ask.ask(&MeshRoughnessQuery(of.geometry.visibility.mesh.clone())));
    let surface = *shading.surface();
    let place = |index: usize| -> Option<(Geometry, f64, Surface)> {
        match (shading.vertices(), &roughness) {
            (Some(vertices), Some(roughness)) => {
                let own = roughness.get(index).copied().unwrap_or_default();
                Some((*vertices.geometries().get(index)?, 1.0, own.of(surface)))
            }
            _ => shading.geometry().angles().get(index).map(|angles| (angles.geometry(), angles.light(), surface)),
        }
    };
    let coherent = |index: &usize| {
        let (geometry, light, surface) = place(*index)?;
        Some(CoherentSample {
            index: *index as u32,
            front: light * coherent_prefactor(&surface, &geometry, of.reading),
            kappa: kappa(&surface, &geometry),
            v: [geometry.vx_by_k, geometry.vy_by_k],
        })
    };
    let taken: Vec<CoherentSample> = some_of(&skipped, SUMS).iter().filter_map(coherent).collect();
    let sum = |measure: &SpectralWeights| {
        let integral = CoherentIntegral::in_picture(shading, measure);
        taken.iter().map(|coherent| integral.at(coherent)).collect::<Vec<_>>()
    };
    let seconds = shortest(|| sources.measures().map(sum).collect::<Vec<_>>());
    Some(SkippedWork {
        what: "specular terms".into(),
        count: skipped.len() as u64,
        of: Some(all as u64),
        saved: seconds * skipped.len() as f64 / taken.len().max(1) as f64,
        how: format!(
            "below {:.0e} of the picture's brightest sample; made as this quality makes those that it has; {}, one thread",
            quality.coherent_share(),
            measured_on(taken.len(), skipped.len(), sources.places())
        ),
    })
}
