//! Whole pictures: quick ways beside the sum over 401 wavelengths, one thread beside many, light and shade.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::RenderingError;
use chromascope_core::colorimetry::Metric;
use chromascope_core::query::compare;
use chromascope_core::query::patches::patch_colors;
use chromascope_core::query::render::difference::{BrightSamples, Difference};
use chromascope_core::query::render::picture::{Pictures, PicturesQuery};
use chromascope_core::query::render::{MeshQuery, MeshRoughnessQuery, Parts, Roughness, ShadingQuery};
use chromascope_core::query::{Ask, Direct, PatchColorsQuery, RenderingQuery, Shared};
use chromascope_core::reflectance::power::factor;
use chromascope_core::reflectance::{Geometry, Normalization, Specular};
use chromascope_core::render::{CameraImage, Quality, RasterSize, Shadows, Stop, Visibility};
use chromascope_core::scene::Viewpoint;
use chromascope_core::scene::roughness::VertexRoughness;
use chromascope_core::spectral::GridSpectrum;
use chromascope_mesh::stage::Stage;
use chromascope_mesh::{Mesh, Part, shapes};
use glam::Vec3;

use super::fixture::{Counting, FrameCase};
use crate::support;

/// The largest difference between pictures of one scene, relative to each source's largest signal or, where that is larger,
/// to the material facing light and eye: a mirror's highlight may fall between the samples.
pub(super) fn apart(a: &Pictures, b: &Pictures) -> f64 {
    let (mut worst, facing) = (0.0_f64, b.facing.material.y);
    for (a, b) in a.images.iter().flatten().zip(b.images.iter().flatten()) {
        assert_eq!(a.signals().len(), b.signals().len());
        let all = |image: &CameraImage| image.signals().iter().flatten().map(|&v| f64::from(v)).collect::<Vec<_>>();
        let (a, b) = (all(a), all(b));
        let peak = b.iter().fold(facing, |m, v| m.max(v.abs()));
        assert!(peak > 0.0);
        worst = a.iter().zip(&b).fold(worst, |w, (a, b)| w.max((a - b).abs() / peak));
    }
    worst
}

/// True if `CHROMASCOPE_THOROUGH` requests more cases than in a usual run.
fn thorough() -> bool {
    std::env::var_os("CHROMASCOPE_THOROUGH").is_some()
}

#[test]
fn every_quality_keeps_its_error_against_401_wavelengths() {
    let size = if thorough() { RasterSize::new(20, 20) } else { RasterSize::new(10, 10) };
    for reading in [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet] {
        // Tables do not depend on σ: they are made once.
        let (studio, ask) = (FrameCase { size, reading, ..FrameCase::new() }, Counting::default());
        for sigma_m in [5e-6, 0.4e-6, 0.06e-6, 2e-9] {
            let with = |quality| FrameCase { sigma_m, quality, ..studio.clone() };
            let exact = with(Quality::Reference).take(&ask);
            // Signals are kept in single precision, which alone is 6e-8.
            for (quality, bound) in [(Quality::Full, 1e-5), (Quality::Fine, 1e-7), (Quality::Preview, 1e-3)] {
                let error = apart(&with(quality).take(&ask), &exact);
                assert!(error < bound, "{reading:?}, σ = {sigma_m}, {quality:?}: {error:.1e}");
            }
        }
    }
}

#[test]
fn a_picture_keeps_the_error_that_was_asked_for() {
    let tolerances: &[f64] = if thorough() { &[1e-3, 1e-5, 1e-7, 1e-11] } else { &[1e-3, 1e-7] };
    // At 0.05 µm very many coherent components are next to nothing.
    for (reading, sigmas_m) in [
        (Normalization::Radiometric, [5e-6, 0.4e-6]),
        (Normalization::Radiometric, [0.1e-6, 0.05e-6]),
        (Normalization::Paper, [0.06e-6, 2e-9]),
        (Normalization::Lambertian, [1e-6, 1e-9]),
    ] {
        for sigma_m in sigmas_m {
            let with = |quality| {
                let mut studio =
                    FrameCase { reading, sigma_m, quality, size: RasterSize::new(12, 12), ..FrameCase::new() };
                studio.sources.truncate(2);
                studio
            };
            let exact = with(Quality::Reference).take(&Direct);
            for &tolerance in tolerances {
                let found = with(Quality::Within(RelTolerance::new(tolerance).unwrap())).take(&Direct);
                assert_eq!(found.shading.spectral == 0, reading == Normalization::Lambertian, "{:?}", found.shading);
                assert!(
                    found.shading.coherent_samples <= exact.shading.coherent_samples,
                    "what it is compared with leaves more out"
                );
                let error = apart(&found, &exact);
                // Signals are kept in single precision.
                assert!(error <= tolerance + 1.2e-7, "{reading:?}, σ = {sigma_m}, {tolerance:e}: {error:.1e}");
            }
        }
    }
}

#[test]
fn what_no_plan_can_promise_is_said() {
    let quality = Quality::Within(RelTolerance::new(1e-14).unwrap());
    let studio = FrameCase { quality, ..FrameCase::new() };
    let pictures = Direct.ask(&studio.question());
    let pictures = (*pictures).as_ref().unwrap().as_ref().unwrap();
    for picture in &pictures.pictures {
        assert!(matches!(picture, Err(RenderingError::Accuracy(_))));
    }
}

#[test]
fn three_cases_of_g_are_seen_to_err() {
    let with = |quality| FrameCase { sigma_m: 0.2e-6, quality, size: RasterSize::new(20, 20), ..FrameCase::new() };
    let error = apart(&with(Quality::Regimes).take(&Direct), &with(Quality::Reference).take(&Direct));
    assert!((1e-3..1.0).contains(&error), "{error:.1e}");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let with = |threads: usize, sigma_m: f64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let size = RasterSize { width: 70, height: 60, samples: if thorough() { 2 } else { 1 } };
        let studio = FrameCase { mesh: MeshQuery::Fern(5_000), size, sigma_m, ..FrameCase::new() };
        pool.install(|| studio.take(&Direct))
    };
    for sigma_m in [5e-6, 0.1e-6] {
        let one = with(1, sigma_m);
        for threads in [2, 5] {
            let many = with(threads, sigma_m);
            assert_eq!(one.geometry, many.geometry);
            assert_eq!(one.shading, many.shading);
            for (a, b) in one.images.iter().zip(&many.images) {
                let [a, b] = [a, b].map(|image| image.as_ref().unwrap());
                assert_eq!(a.signals(), b.signals());
                assert_eq!(a.placed(), b.placed());
            }
            for (a, b) in one.pictures.iter().zip(&many.pictures) {
                assert_eq!(a.as_ref().unwrap(), b.as_ref().unwrap());
            }
            assert_eq!(one.differences, many.differences);
        }
    }
}

#[test]
fn between_vertices_of_one_roughness_there_is_little_to_interpolate() {
    // A plane's σ is 0 everywhere, a fine ball's nearly the same: shading vertices comes near to shading samples.
    let ball = MeshQuery::Sphere(60_000);
    let own = Direct.ask(&MeshRoughnessQuery(ball.clone()));
    let median = |length: fn(&VertexRoughness) -> f32| {
        let mut sorted: Vec<f32> = own.iter().map(length).collect();
        sorted.sort_by(f32::total_cmp);
        f64::from(sorted[sorted.len() / 2])
    };
    let (sigma_m, tau_m) = (median(|v| v.sigma_m), median(|v| v.tau_m));
    let with = |roughness| {
        let size = RasterSize::new(96, 96);
        FrameCase { mesh: ball.clone(), roughness, sigma_m, tau_m, size, ..FrameCase::new() }.take(&Direct)
    };
    let [uniform, own] = [Roughness::Surface, Roughness::Mesh].map(with);
    assert_eq!(uniform.geometry, own.geometry);
    // The lobe is as wide as a triangle turns: only its light as a whole is kept by interpolation.
    let light = |pictures: &Pictures| -> f64 {
        pictures.images[0].as_ref().unwrap().signals().iter().map(|signal| f64::from(signal[1])).sum()
    };
    let ratio = light(&own) / light(&uniform);
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
}

#[test]
fn by_the_papers_own_roughness_a_head_has_the_gloss_of_its_triangles() {
    let with = |triangles, roughness| {
        let size = RasterSize::new(64, 64);
        FrameCase { mesh: MeshQuery::Head(triangles), roughness, size, ..FrameCase::new() }.take(&Direct)
    };
    let concentration = |pictures: &Pictures| {
        let signals = pictures.images[0].as_ref().unwrap().signals();
        let mut greens: Vec<f64> = signals.iter().map(|signal| f64::from(signal[1])).collect();
        greens.sort_by(f64::total_cmp);
        let (all, brightest): (f64, f64) = (greens.iter().sum(), greens[greens.len() * 9 / 10..].iter().sum());
        brightest / all
    };
    let [given, coarse, fine] =
        [(9_000, Roughness::Surface), (9_000, Roughness::Mesh), (30_000, Roughness::Mesh)].map(|(n, r)| with(n, r));
    // A tenth of the samples has how much of the light: the finer the triangles, the flatter they meet.
    let shares = [&given, &coarse, &fine].map(concentration);
    assert!(shares[0] < 0.4 && shares[1] > shares[0] && shares[2] > shares[1], "{shares:?}");
}

#[test]
fn of_the_papers_cameras_the_kodak_is_farthest_from_the_truth() {
    let leaf = support::patches("materials/leaves_vrhel.csv");
    let leaf = leaf.patches().iter().find(|patch| patch.name.contains("024")).unwrap();
    let skin = FrameCase::new().reflectance;
    for (mesh, reflectance) in
        [(MeshQuery::Head(9_000), skin), (MeshQuery::Fern(20_000), Shared::new(leaf.grid.clone()))]
    {
        let studio = FrameCase { mesh, reflectance, yaw: 0.35, size: RasterSize::new(96, 96), ..FrameCase::new() };
        let differences = studio.take(&Direct).differences;
        let facing: Vec<f64> = differences.iter().flatten().filter_map(|difference| difference.facing).collect();
        let medians: Vec<f64> =
            differences.iter().flatten().filter_map(|difference| Some(difference.bright?.median)).collect();
        for values in [facing, medians] {
            assert!(values.len() == 3 && values[2] > 1.8 * values[0].max(values[1]), "{values:?}");
        }
    }
}

#[test]
fn read_to_the_letter_a_rough_white_turns_yellow() {
    for (reading, expected) in [(Normalization::Radiometric, [0.332, 0.347]), (Normalization::Paper, [0.373, 0.379])] {
        let mut studio = FrameCase { reading, ..FrameCase::new() };
        studio.reflectance = Shared::new(GridSpectrum::constant(1.0));
        let light = Shared::new(support::light("illuminants/d55.csv"));
        studio.sources.iter_mut().for_each(|source| source.light = light.clone());
        let pictures = studio.take(&Direct);
        let rendering = Direct.ask(&studio.sources[0]);
        let rendering = (*rendering).as_ref().unwrap();
        let signals = pictures.images[0].as_ref().unwrap().signals();
        let brightest = signals.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        let signals = rendering.white * glam::DVec3::from_array(brightest.map(f64::from));
        let xy = rendering.xyz(signals).chromaticity().unwrap();
        assert!((xy.x - expected[0]).abs() < 1e-3 && (xy.y - expected[1]).abs() < 1e-3, "{reading:?}: {xy:?}");
    }
}

#[test]
fn an_untinted_lobe_keeps_its_color_on_any_material() {
    let with = |specular, reflectance: f64, sigma_m| {
        let mut studio = FrameCase { specular, sigma_m, quality: Quality::Reference, ..FrameCase::new() };
        studio.reflectance = Shared::new(GridSpectrum::constant(reflectance));
        studio
    };
    // A mirror has no diffuse component: all that is left is the boundary's reflection.
    let signals =
        |studio: &FrameCase| -> Vec<[f32; 3]> { studio.take(&Direct).images[1].as_ref().unwrap().signals().to_vec() };
    let [white, dark] = [1.0, 0.05].map(|reflectance| signals(&with(Specular::Fresnel, reflectance, 0.0)));
    assert_eq!(white, dark);
    assert!(white.iter().any(|signal| signal[1] > 0.0));
    let paper = signals(&with(Specular::Paper, 0.05, 0.0));
    let peak = |signals: &[[f32; 3]]| signals.iter().map(|signal| signal[1]).fold(0.0, f32::max);
    // 36 at normal incidence; the highlight is seen at half of the 36° between light and viewer.
    let ratio = peak(&signals(&with(Specular::Paper, 1.0, 0.0))) / peak(&white);
    assert!((33.0..36.1).contains(&ratio), "{ratio}");
    assert!((peak(&paper) / peak(&white) - 0.05 * ratio).abs() < 1e-3);
}

#[test]
fn untinted_lobes_keep_every_qualitys_error_on_a_dark_material() {
    for sigma_m in [0.4e-6, 0.06e-6, 2e-9] {
        let with = |quality| {
            let (specular, size) = (Specular::Fresnel, RasterSize::new(20, 20));
            let mut studio = FrameCase { size, sigma_m, specular, quality, ..FrameCase::new() };
            studio.reflectance = Shared::new(GridSpectrum::from_fn(|nm| if nm > 600.0 { 0.04 } else { 0.02 }));
            studio.sources.truncate(2);
            studio
        };
        let exact = with(Quality::Reference).take(&Direct);
        let within = |error| Quality::Within(RelTolerance::new(error).unwrap());
        for (quality, bound) in
            [(Quality::Full, 1e-5), (Quality::Fine, 1e-7), (within(1e-3), 1e-3), (within(1e-5), 1.1e-5)]
        {
            let error = apart(&with(quality).take(&Direct), &exact);
            assert!(error < bound, "σ = {sigma_m}, {quality:?}: {error:.1e}");
        }
    }
}

#[test]
fn the_headline_is_the_patch_that_patches_print() {
    let studio = FrameCase { mesh: MeshQuery::Head(9_000), ..FrameCase::new() };
    let skin = support::patches("materials/skin_vrhel.csv")
        .subset(&[&support::patches("materials/skin_vrhel.csv").patches()[0].name]);
    let patches = Shared::new(skin);
    let color = |of: &RenderingQuery| {
        let colors = Direct.ask(&PatchColorsQuery { rendering: of.clone(), patches: patches.clone() });
        (*colors).as_ref().unwrap()[0]
    };
    // Whatever the roughness, its reading, and where the light stands.
    for (sigma_m, light_up, reading, metric) in [
        (5e-6, 25.0, Normalization::Radiometric, Metric::DELTA_E_2000),
        (0.1e-6, 80.0, Normalization::Paper, Metric::XY),
        (5e-6, -60.0, Normalization::Lambertian, Metric::UV_PRIME),
    ] {
        let studio = FrameCase { light_up, sigma_m, reading, metric, ..studio.clone() };
        let pictures = studio.take(&Direct);
        for (source, difference) in studio.sources.iter().zip(&pictures.differences).skip(1) {
            let expected = compare::difference(studio.metric, &color(&studio.sources[0]), &color(source)).unwrap();
            assert_eq!(difference.as_ref().unwrap().facing, Some(expected));
        }
    }
}

#[test]
fn the_mean_over_all_lit_samples_is_a_mean_of_brightness() {
    let of = |ev_of_light: f64| {
        let light_up = ev_of_light;
        let studio =
            FrameCase { light_up, mesh: MeshQuery::Sphere(20_000), size: RasterSize::new(96, 96), ..FrameCase::new() };
        let difference = studio.take(&Direct).differences[1].clone().unwrap();
        let bright = difference.bright.unwrap();
        assert!(bright.count < difference.map.len() && bright.median <= bright.p95 && bright.p95 <= difference.max);
        (difference.mean, bright.median, difference.facing.unwrap())
    };
    let (front, side) = (of(10.0), of(80.0));
    assert!(side.0 < 0.85 * front.0, "the mean falls where light falls from the side: {front:?}, {side:?}");
    assert_eq!(side.2, front.2, "the material's difference does not");
    assert!(side.1 > 0.9 * front.1, "nor much the median of what is bright: {front:?}, {side:?}");
    // Dark samples count in no quantile, and where all are dark there is none.
    let map = [9.0, 1.0, 2.0, 3.0, 4.0];
    let found = BrightSamples::new(&map, &[20.0, 20.1, 50.0, 99.0, 21.0]).unwrap();
    assert_eq!((found.count, found.median), (4, 2.5));
    assert!((found.p95 - 3.85).abs() < 1e-14, "{}", found.p95);
    assert_eq!(BrightSamples::new(&map, &[20.0; 5]), None);
}

#[test]
fn every_sample_is_accounted_for() {
    for mesh in [MeshQuery::Sphere(2_000), MeshQuery::Fern(5_000), MeshQuery::Head(5_000)] {
        let studio = FrameCase { mesh, ..FrameCase::new() };
        let pictures = studio.take(&Direct);
        let counts = pictures.geometry;
        assert_eq!(counts.seen, counts.lit + counts.facing_away + counts.shadowed);
        let shading = pictures.shading;
        assert_eq!(counts.lit, shading.dark + shading.flat + shading.spectral);
        assert_eq!(counts.lit, shading.coherent_samples + shading.coherent_skipped);
        assert!(counts.seen > 0 && counts.rays <= counts.lit + counts.shadowed);
    }
}

/// Each sample of a clothed head is skin as on the head all of skin, or matte: `T F (cos θi cos⁴α + s W)`, W by a head all of white that
/// scatters evenly.
#[test]
fn a_garment_has_a_material_of_its_own_and_no_gloss() {
    let cloth = support::patches("materials/textiles_vrhel.csv");
    let cloth = Shared::new(cloth.patches().iter().find(|patch| patch.name.starts_with("Faded")).unwrap().grid.clone());
    for (roughness, sky, sigma_m) in [(Roughness::Surface, Some(0.15), 0.05e-6), (Roughness::Mesh, None, 5e-6)] {
        let skin = FrameCase { mesh: MeshQuery::ClothedHead(13_000), roughness, sky, sigma_m, ..FrameCase::new() };
        let even = FrameCase { reading: Normalization::Lambertian, reflectance: cloth.clone(), ..skin.clone() };
        let worn = FrameCase { parts: vec![(Part::Garment, cloth.clone())], ..skin.clone() };
        let question = skin.question();
        let seen = question.shading.geometry.visibility.clone();
        let lambert = FrameCase { roughness: Roughness::Surface, ..even.clone() };
        let [skin, even, lambert, worn] = [skin, even, lambert, worn].map(|service| service.take(&Direct));
        // The white of the surface that faces the light, over one that scatters evenly.
        let head_on = Geometry::from_angles(0.0, 0.0, 0.0);
        let radius = question.shading.geometry.lighting.angular_radius();
        let scale = factor(&question.shading.surface, &head_on, 550.0, Normalization::Radiometric, radius) as f32;
        let (mesh, visibility) = (Direct.ask(&seen.mesh), Direct.ask(&seen));
        let hits = (*visibility).as_ref().unwrap().hits();
        let mut counts = [0; 2];
        for (at, &sample) in worn.angles.samples().iter().enumerate() {
            let is_garment = mesh.part(hits[sample as usize].triangle) == Part::Garment;
            counts[usize::from(is_garment)] += 1;
            for ((worn, skin), even) in worn.images.iter().zip(&skin.images).zip(&lambert.images) {
                let signal = |image: &Option<CameraImage>| image.as_ref().unwrap().signals()[at];
                if is_garment {
                    let [worn, even] = [signal(worn), signal(even)].map(glam::Vec3::from_array);
                    assert!(
                        worn.abs_diff_eq(even * scale, 2e-3 * even.max_element() * scale),
                        "{worn} {}",
                        even * scale
                    );
                } else {
                    assert_eq!(signal(worn), signal(skin));
                }
            }
        }
        assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
        let facing =
            |pictures: &Pictures, of: fn(&Difference) -> Option<f64>| of(pictures.differences[1].as_ref().unwrap());
        assert_eq!(facing(&worn, |d| d.garment), facing(&even, |d| d.facing));
        assert_eq!(facing(&worn, |d| d.facing), facing(&skin, |d| d.facing));
        assert_eq!(facing(&skin, |d| d.garment), None);
    }
}

/// The chart's patches in a picture have the colors of the swatches: by a plain sum over the light, times one factor that is the
/// same for all of them at one place of the card's plane under a distant light.
#[test]
fn patches_of_the_chart_in_the_picture_are_as_their_swatches() {
    let chart = support::patches("charts/colorchecker_24_babelcolor_average.csv");
    let grids: Vec<_> = chart.patches().iter().map(|patch| Shared::new(patch.grid.clone())).collect();
    let parts: Parts = (0..).map(Part::Patch).zip(grids.clone()).collect();
    let stage = Stage { patches: 24, ground: true, ..Stage::default() };
    let mesh = MeshQuery::Staged(Box::new(MeshQuery::Sphere(2_000)), stage);
    let case =
        FrameCase { mesh, parts, yaw: -0.4, size: RasterSize::new(160, 120), light_right: 20.0, ..FrameCase::new() };
    let question = PicturesQuery { shading: framed(case.question().shading), ..case.question() };
    let pictures = (*Direct.ask(&question)).clone().unwrap().unwrap();
    for (image, rendering) in pictures.images.iter().zip(&question.sources) {
        let (image, made) = (image.as_ref().unwrap(), Direct.ask(rendering));
        let colors = patch_colors(rendering, (*made).as_ref().unwrap(), grids.iter().map(|grid| &**grid));
        let mut seen = [0; 24];
        for (at, signal) in image.signals().iter().enumerate() {
            let Part::Patch(patch) = image.placed().part(at) else { continue };
            let angles = pictures.angles.angles()[at];
            let xyz = (*made)
                .as_ref()
                .unwrap()
                .xyz((*made).as_ref().unwrap().white * glam::Vec3::from_array(*signal).as_dvec3());
            let expected = colors[usize::from(patch)].xyz.to_vector() * angles.light() * pictures.facing.white;
            assert!((xyz.to_vector() - expected).abs().max_element() < 2e-3 * pictures.facing.white, "{patch}");
            seen[usize::from(patch)] += 1;
        }
        assert!(seen.iter().all(|&count| count > 3), "{seen:?}");
    }
    // What stands about the mesh is not counted with it.
    let alone = FrameCase { mesh: MeshQuery::Sphere(2_000), parts: Parts::new(), ..case.clone() }.question();
    let alone = (*Direct.ask(&PicturesQuery { shading: framed(alone.shading), ..alone })).clone().unwrap().unwrap();
    let [with, without] = [&pictures, &alone].map(|pictures| pictures.differences[1].clone().unwrap());
    assert!(
        with.bright.unwrap().count < with.map.len() && (with.max - without.max).abs() < 0.1,
        "{with:?} {without:?}"
    );
}

fn framed(mut shading: ShadingQuery) -> ShadingQuery {
    let viewpoint = &mut shading.geometry.visibility.viewpoint;
    *viewpoint = viewpoint.framed(4.0 / 3.0, 1.0).unwrap();
    shading
}

#[test]
fn a_material_facing_light_and_eye_is_shown_at_its_exposure() {
    for reading in
        [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet, Normalization::Lambertian]
    {
        // The light stands behind the eye.
        let mut question = FrameCase { mesh: MeshQuery::Plane, reading, ..FrameCase::new() }.question();
        question.shading.geometry.visibility.viewpoint = Viewpoint::new(0.0, 0.0, 1000.0, 0.002).unwrap();
        question.shading.geometry.lighting = chromascope_core::scene::Lighting::from_angles(0.0, 0.0, 4.65e-3).unwrap();
        let pictures = (*Direct.ask(&question)).clone().unwrap().unwrap();
        let rendering = Direct.ask(&question.reference);
        let rendering = (*rendering).as_ref().unwrap();
        let image = pictures.images[0].as_ref().unwrap();
        let middle = image.signals()[image.signals().len() / 2];
        let signals = rendering.white * glam::DVec3::from_array(middle.map(f64::from));
        let y = rendering.xyz(signals).y;
        assert!((y / pictures.facing.material.y - 1.0).abs() < 1e-5, "{reading:?}: {y}");
        assert!((y * pictures.facing.factor(0.0) - 0.4).abs() < 1e-5);
        assert!((y * pictures.facing.factor(-1.5) - 0.4 * (-1.5_f64).exp2()).abs() < 1e-5);
    }
}

#[test]
fn without_a_model_a_white_in_the_light_is_white() {
    let mut question =
        FrameCase { mesh: MeshQuery::Plane, reading: Normalization::Lambertian, ..FrameCase::new() }.question();
    question.reflectance = Shared::new(GridSpectrum::constant(1.0));
    let pictures = (*Direct.ask(&question)).clone().unwrap().unwrap();
    let facing = pictures.facing;
    assert!((facing.white - facing.material.y).abs() < 1e-12, "{facing:?}");
    // Eq 13's matrix has three digits.
    assert!((facing.white - 1.0).abs() < 1e-4, "{facing:?}");
    // The same share of every signal at any sample: cos θi cos⁴α.
    for image in pictures.images.iter().flatten() {
        for signal in image.signals() {
            assert!(signal.iter().all(|v| (v - signal[0]).abs() < 1e-6), "{signal:?}");
        }
    }
}

/// A square on the ground and a small one above it.
fn table_and_lid() -> Mesh {
    let square = |half: f32, y: f32| {
        [[-half, half], [half, half], [half, -half], [-half, -half]].map(|[x, z]| Vec3::new(x, y, z))
    };
    let positions = [square(1.0, 0.0), square(0.3, 0.5)].concat();
    let faces = |first: u32| [[first, first + 1, first + 2], [first, first + 2, first + 3]];
    Mesh::with_smooth_normals(positions, [faces(0), faces(4)].concat()).unwrap()
}

#[test]
fn a_lid_casts_its_shadow_where_the_sun_is_high() {
    let mesh = MeshQuery::Own(Shared::new(table_and_lid()));
    let from_above = |shadows| {
        let mut question = FrameCase { mesh: mesh.clone(), shadows, ..FrameCase::new() }.question();
        let geometry = &mut question.shading.geometry;
        geometry.visibility.size = RasterSize::new(101, 101);
        // From straight above the lid hides its own shadow but for perspective; from the side the table is seen.
        geometry.visibility.viewpoint = Viewpoint::new(0.0, 0.6, 4.0, 0.6).unwrap();
        geometry.lighting = chromascope_core::scene::Lighting::from_angles(0.5, 0.0, 0.0).unwrap();
        (*Direct.ask(&question)).clone().unwrap().unwrap().geometry
    };
    let [off, coarse, full] = [Shadows::Off, Shadows::Coarse, Shadows::Full].map(from_above);
    assert_eq!((off.shadowed, off.rays), (0, 0));
    assert_eq!(off.seen, full.seen);
    assert!(full.shadowed > 100 && full.rays == full.lit + full.shadowed);
    // The ground is 4/0.36 times the lid; a high sun lets the lid's shadow be nearly as large as the lid.
    assert!(full.shadowed < full.seen / 5);
    assert!(coarse.rays * 3 < full.rays * 2, "{} rays of {}", coarse.rays, full.rays);
    // Each sample at an edge has a ray of its own.
    assert!(coarse.shadowed.abs_diff(full.shadowed) < full.shadowed / 50, "{} {}", coarse.shadowed, full.shadowed);
}

#[test]
fn a_ball_does_not_shadow_itself_in_the_light() {
    // Facets are flat where normals are round: rays that start on them must not meet their neighbors.
    let studio = FrameCase { mesh: MeshQuery::Sphere(300), size: RasterSize::new(200, 200), ..FrameCase::new() };
    let counts = studio.take(&Direct).geometry;
    assert!(counts.shadowed * 200 < counts.lit, "{counts:?}");
}

#[test]
fn what_is_stopped_gives_nothing() {
    let stop = Stop::at(Arc::new(AtomicBool::new(true)));
    let mesh = shapes::sphere(2_000);
    let eye = Viewpoint::new(0.0, 0.0, 3.0, 0.5).unwrap().eye(mesh.bounds());
    assert!(Visibility::new(&mesh, eye, RasterSize::new(64, 64), &stop).is_none());
}

#[test]
fn more_samples_give_the_same_picture_but_for_its_edges() {
    let with = |samples| {
        let size = RasterSize { width: 48, height: 48, samples };
        FrameCase { size, mesh: MeshQuery::Sphere(20_000), ..FrameCase::new() }.take(&Direct).pictures[1]
            .clone()
            .unwrap()
    };
    let (one, nine) = (with(1), with(3));
    let far = |a: &[u8; 4], b: &[u8; 4]| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 12);
    let (a, b) = (one.rgba.as_chunks().0, nine.rgba.as_chunks().0);
    let apart = a.iter().zip(b).filter(|(a, b)| far(a, b)).count();
    assert!(apart < 48 * 5, "{apart} pixels");
    // Half covered pixels are half opaque.
    assert!(b.iter().any(|pixel| (60..200).contains(&pixel[3])));
}
