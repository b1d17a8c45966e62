//! Times, counts and errors of a rendering as JSON.

use std::collections::BTreeMap;
use std::time::Duration;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::Roughness;
use chromascope_core::render::plan::Candidate;
use chromascope_core::render::shading::DiffuseKind;
use serde_json::{Value, json};

use super::accuracy::{self, Cost, Errors, Measured};
use super::{Made, Times};
use crate::figures::render::headline::Measure;
use crate::figures::render::returned;
use crate::profiler::plans;
use crate::results::Count;

/// The figures, as text with a line break at its end.
pub(super) fn json(made: &Made<'_>, counts: &BTreeMap<&'static str, Count>, times: &Times) -> String {
    let accuracy = accuracy::measure(made);
    let size = made.setup.finish.size;
    let mesh = made.scene.results.ask(&made.query.shading.geometry.visibility.mesh);
    let plans = counts.get("plan").copied().unwrap_or_default();
    let value = json!({
        "program": concat!("chromascope ", env!("CARGO_PKG_VERSION")),
        "mesh": {
            "name": made.setup.mesh_name,
            "triangles": mesh.triangles().len(),
            "vertices": mesh.positions().len(),
        },
        "size": { "width": size.width, "height": size.height, "samples_per_side": size.samples },
        "threads": rayon::current_num_threads(),
        "settings": settings(made),
        "time_ms": {
            "all": milliseconds(times.all),
            "reading_mesh": milliseconds(times.reading),
            "writing_files": milliseconds(times.writing),
        },
        "stages": counts.iter().map(|(name, count)| ((*name).to_owned(), stage(count))).collect::<serde_json::Map<_, _>>(),
        "samples": samples(made),
        "plans": { "built": plans.misses, "reused": plans.hits },
        "sources": (0..made.sources.len()).map(|index| source(made, index, accuracy.as_ref())).collect::<Vec<_>>(),
        "accuracy": accuracy.as_ref().map(|accuracy| summary(made, accuracy)),
    });
    format!("{value:#}\n")
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn stage(count: &Count) -> Value {
    json!({
        "own_ms": milliseconds(count.own_time),
        "all_ms": milliseconds(count.time),
        "hits": count.hits,
        "misses": count.misses,
    })
}

fn settings(made: &Made<'_>) -> Value {
    let (document, viewpoint) = (made.scene.document, made.setup.viewpoint);
    let shading = &made.query.shading;
    let surface = shading.surface;
    json!({
        "material": document.render.material,
        "garment": document.render.worn(),
        "illuminant": made.scene.light_name(),
        "white": document.white.name(),
        "reference": document.reference,
        "transform": made.scene.conditions()[3].1,
        "preset": document.start.key(),
        "reading": shading.reading.key(),
        "quality": shading.quality.level().key(),
        "tolerance": shading.quality.given_tolerance().map(RelTolerance::max_relative_error),
        "sigma_m": plain(surface.sigma_m()),
        "tau_from_mesh": shading.roughness == Roughness::Mesh,
        "sigma_from_mesh": shading.roughness == Roughness::Mesh,
        "tau_m": plain(surface.tau_m()),
        "half_sides_m": [plain(surface.half_x_m()), plain(surface.half_y_m())],
        "area_m2": plain(surface.area_m2()),
        "area": document.render.area.key(),
        "specular": document.render.specular.key(),
        "returned_light": returned::of(&made.scene).map(|light| {
            json!({
                "normal_incidence": light.normal,
                "at_85_deg": light.grazing,
                "exceeds_one_from_deg": light.exceeds_one_from_deg,
            })
        }),
        "refractive_index": surface.index(),
        "light_direction": shading.geometry.lighting.place().to_array(),
        "shadows": document.render.shadows,
        "orbit": {
            "yaw_deg": plain(viewpoint.yaw().to_degrees()),
            "pitch_deg": plain(viewpoint.pitch().to_degrees()),
            "distance_radii": viewpoint.distance(),
        },
        "field_of_view_deg": plain(viewpoint.field_of_view().to_degrees()),
        "exposure_ev": document.render.exposure_ev,
    })
}

/// A number without what changing units added to its last digits.
fn plain(number: f64) -> f64 {
    format!("{number:.12e}").parse().unwrap_or(number)
}

fn samples(made: &Made<'_>) -> Value {
    let (geometry, shading) = (made.pictures.geometry, made.pictures.shading);
    let size = made.setup.finish.size;
    json!({
        "all": size.columns() * size.rows(),
        "seen": geometry.seen,
        "lit": geometry.lit,
        "lit_from_behind": geometry.through,
        "facing_away": geometry.facing_away,
        "in_shadow": geometry.shadowed,
        "below_threshold": shading.dark,
        "lambertian": shading.flat,
        "spectral": shading.spectral,
        "mirror_terms": shading.coherent_samples,
        "mirror_terms_skipped": shading.coherent_skipped,
        "shadow_rays": geometry.rays,
    })
}

fn source(made: &Made<'_>, index: usize, accuracy: Option<&Measured>) -> Value {
    let (source, pictures) = (&made.sources[index], &made.pictures);
    let difference = pictures.differences[index].as_ref().filter(|_| made.not_comparable[index].is_none());
    let measure = Measure::of(&made.query);
    let weights = made.scene.results.ask(&made.query.image(&made.query.sources[index]).measure);
    let of = |cost: &Cost| cost.errors[index].map(errors);
    json!({
        "name": source.name,
        "kind": source.kind.label(),
        "file": made.files[index].display().to_string(),
        "is_reference": source.is_reference,
        "is_truth": source.is_reference,
        // Under Eq 13 there is no ΔE*00; numbers by any metric are under "difference".
        "delta_e_2000": difference.filter(|difference| measure.name() == Metric::DELTA_E_2000.symbol && !difference.map.is_empty()).map(|difference| {
            json!({ "mean": difference.mean, "max": difference.max, "samples": difference.map.len() })
        }),
        "difference": difference.map(|difference| {
            json!({
                "measure": measure.name(),
                "mean_of_lit": (!difference.map.is_empty()).then_some(difference.mean),
                "max_of_lit": (!difference.map.is_empty()).then_some(difference.max),
                "samples_of_lit": difference.map.len(),
                "facing_light": difference.facing,
                "garment_facing_light": difference.garment,
                "median_above_l20": difference.bright.map(|bright| bright.median),
                "p95_above_l20": difference.bright.map(|bright| bright.p95),
                "samples_above_l20": difference.bright.map_or(0, |bright| bright.count),
            })
        }),
        "clipped_samples": pictures.pictures[index].as_ref().ok().map(|picture| picture.clipped),
        "plan": plan(made, index),
        "peak_signal": pictures.images[index].as_ref().map(accuracy::peak),
        "wavelengths_with_weight": (*weights).as_ref().ok().map(|weights| weights.dense().len()),
        "integrals": integrals(made, index),
        "error_to_peak": accuracy.map(|accuracy| of(&accuracy.chosen)),
        "error_to_peak_by_regimes": accuracy.map(|accuracy| of(&accuracy.regimes)),
    })
}

fn plan(made: &Made<'_>, index: usize) -> Option<Value> {
    let explanation = made.pictures.images[index].as_ref()?.plan().explanation();
    let planned = plans::planned(&made.query, &made.query.sources[index], made.scene.results).ok()?;
    let candidate = |candidate: &Candidate| {
        json!({
            "method": candidate.method.to_string(),
            "estimated_error_bound": candidate.error_bound,
            "sample_ns_by_model": candidate.sample_ns,
            "making_ms_by_model": candidate.making_ns / 1e6,
        })
    };
    Some(json!({
        "certified_error": explanation.error_bound(),
        "estimated_error_bound": explanation.error_bound(),
        "mirror_error": planned.and_then(|planned| planned.bounds.coherent),
        "single_precision": plans::SINGLE_PRECISION,
        "rough": explanation.rough.as_ref().map(candidate),
        "chosen": candidate(&explanation.chosen),
        "rejected": explanation.rejected.iter().map(candidate).collect::<Vec<_>>(),
    }))
}

/// Samples of a sensor by integration method, and how many wavelengths each rests on.
fn integrals(made: &Made<'_>, index: usize) -> Option<Value> {
    let plan = made.pictures.images[index].as_ref()?.plan();
    let shading = made.scene.results.ask(&made.query.shading);
    let mut samples: BTreeMap<&'static str, (u64, usize)> = BTreeMap::new();
    for shade in (*shading).as_ref()?.shades().iter().filter(|shade| shade.kind == DiffuseKind::Spectral) {
        let method = plan.method(shade.kappa, shade.beta);
        let entry = samples.entry(method.name()).or_default();
        *entry = (entry.0 + 1, method.node_count());
    }
    let value = |(name, (samples, wavelengths)): (&str, (u64, usize))| {
        (name.to_owned(), json!({ "samples": samples, "wavelengths": wavelengths }))
    };
    Some(Value::Object(samples.into_iter().map(value).collect()))
}

fn errors(errors: Errors) -> Value {
    json!({ "max": errors.max, "rms": errors.rms })
}

/// Of all sensors together. Ratios are to the sum over all wavelengths.
fn summary(made: &Made<'_>, accuracy: &Measured) -> Value {
    let cost = |name: &str, cost: &Cost| {
        let worst = cost
            .errors
            .iter()
            .flatten()
            .copied()
            .reduce(|a, b| Errors { max: a.max.max(b.max), rms: a.rms.max(b.rms) });
        json!({
            "quality": name,
            "samples_by_sums": cost.sums,
            "ns_per_sample": cost.ns,
            "time_ratio": cost.ns / accuracy.exact.ns,
            "error_to_peak": worst.map(errors),
        })
    };
    json!({
        "against": "exact",
        "samples": accuracy.samples,
        "stride": accuracy.stride,
        "threads": 1,
        "chosen": cost(made.setup.finish.quality.level().key(), &accuracy.chosen),
        "exact": cost("exact", &accuracy.exact),
        "regimes": cost("regimes", &accuracy.regimes),
    })
}
