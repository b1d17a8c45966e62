//! Times, counts and errors of a rendering as JSON.

use std::collections::BTreeMap;
use std::time::Duration;

use chromascope_core::accuracy::Accuracy;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::Ask as _;
use chromascope_core::query::render::Roughness;
use chromascope_core::render::plan::Candidate;
use chromascope_core::render::{Quality, ShadingCounts, SpectralWeights};
use chromascope_core::spectral::grid::COUNT;
use serde_json::{Value, json};

use super::accuracy::{self, Cost, Errors, Measured};
use super::{Made, Times};
use crate::export::render::{quality_name, reading_name};
use crate::figures::render::headline::Measure;
use crate::figures::render::returned;
use crate::profiler::plans;
use crate::results::Count;

/// The figures, as text with a line break at its end.
pub(super) fn json(made: &Made<'_>, counts: &BTreeMap<&'static str, Count>, times: &Times) -> String {
    let accuracy = accuracy::measure(made);
    let size = made.setup.finish.size;
    let mesh = made.scene.results.ask(&made.query.shading.geometry.visibility.mesh);
    let table = counts.get("diffuse table").copied().unwrap_or_default();
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
        "tables": { "built": table.misses, "reused": table.hits },
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
        "illuminant": made.scene.light_name(),
        "white": document.white.name(),
        "reference": document.reference,
        "transform": made.scene.conditions()[3],
        "preset": document.start.key(),
        "reading": reading_name(shading.reading),
        "quality": quality_name(shading.quality),
        "tolerance": shading.quality.accuracy().map(Accuracy::max_relative_error),
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
        "facing_away": geometry.facing_away,
        "in_shadow": geometry.shadowed,
        "below_threshold": shading.dark,
        "lambertian": shading.flat,
        "by_moments": shading.moments,
        "by_table": shading.table,
        "by_sums": shading.sums,
        "by_plans": shading.planned,
        "mirror_terms": shading.mirrors,
        "mirror_terms_skipped": shading.mirrors_skipped,
        "shadow_rays": geometry.rays,
    })
}

fn source(made: &Made<'_>, index: usize, accuracy: Option<&Measured>) -> Value {
    let (source, pictures) = (&made.sources[index], &made.pictures);
    let difference = pictures.differences[index].as_ref().filter(|_| made.not_comparable[index].is_none());
    let measure = Measure::of(&made.query);
    let weights = made.scene.results.ask(&made.query.image(&made.query.sources[index].rendering).measure);
    let of = |cost: &Cost| cost.errors[index].map(errors);
    json!({
        "name": source.name,
        "kind": source.kind.singular(),
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
                "median_above_l20": difference.bright.map(|bright| bright.median),
                "p95_above_l20": difference.bright.map(|bright| bright.p95),
                "samples_above_l20": difference.bright.map_or(0, |bright| bright.count),
            })
        }),
        "clipped_samples": pictures.pictures[index].as_ref().ok().map(|picture| picture.clipped),
        "plan": plan(made, index),
        "peak_signal": pictures.images[index].as_ref().map(accuracy::peak),
        "wavelengths": (*weights).as_ref().ok().map(|weights| wavelengths(weights, made)),
        "error_to_peak": accuracy.map(|accuracy| of(&accuracy.chosen)),
        "error_to_peak_by_regimes": accuracy.map(|accuracy| of(&accuracy.regimes)),
    })
}

/// How a sensor's integrals were made within a tolerance.
fn plan(made: &Made<'_>, index: usize) -> Option<Value> {
    let planned = plans::planned(&made.query, &made.query.sources[index], made.scene.results).ok()??;
    let (explanation, certain) = (planned.explanation.as_ref(), planned.certain);
    let candidate = |candidate: &Candidate| {
        json!({
            "way": plans::words(&candidate.method),
            "certified_error": candidate.certified,
            "sample_ns_by_model": candidate.sample_ns,
            "making_ms_by_model": candidate.making_ns / 1e6,
        })
    };
    Some(json!({
        "certified_error": certain.diffuse,
        "mirror_error": certain.mirror,
        "single_precision": plans::SINGLE_PRECISION,
        "rough": explanation.and_then(|explanation| explanation.rough.as_ref()).map(candidate),
        "chosen": explanation.map(|explanation| candidate(&explanation.chosen)),
        "rejected": explanation.map(|explanation| explanation.rejected.iter().map(candidate).collect::<Vec<_>>()),
    }))
}

/// How many wavelengths of the grid's 401 were looked at. Moments are sums over all, made once for any number of samples.
fn wavelengths(measure: &SpectralWeights, made: &Made<'_>) -> Value {
    let ShadingCounts { moments, table, sums, mirrors, .. } = made.pictures.shading;
    let quality = made.setup.finish.quality;
    let of_sum = match quality {
        Quality::Preview | Quality::Full => measure.coarse().len(),
        Quality::Fine => measure.fine().len(),
        Quality::Exact | Quality::Regimes | Quality::Within(_) => measure.dense().len(),
    };
    let where_any = |count: u64, wavelengths: usize| (count > 0).then_some(wavelengths);
    let ways = [
        where_any(moments, 0),
        where_any(table, measure.coarse().len()),
        where_any(sums, of_sum),
        where_any(mirrors, measure.dense().len()),
    ];
    json!({
        "of": COUNT,
        "with_weight": measure.dense().len(),
        "used": ways.iter().flatten().max(),
        "in_a_moment_sample": ways[0],
        "in_a_table_place": ways[1],
        "in_a_sum": ways[2],
        "in_a_mirror_term_at_most": ways[3],
    })
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
        "chosen": cost(quality_name(made.setup.finish.quality), &accuracy.chosen),
        "exact": cost("exact", &accuracy.exact),
        "regimes": cost("regimes", &accuracy.regimes),
    })
}
