//! Tests of the queries that a change recomputes or reuses.

use chromascope_core::accuracy::RelTolerance;
use chromascope_core::camera::WhiteBalanceTarget;
use chromascope_core::colorimetry::Xy;
use chromascope_core::query::{Ask, Shared};
use chromascope_core::reflectance::Normalization;
use chromascope_core::render::{IntegrationMethod, Quality, RasterSize, Shadows};
use chromascope_core::spectral::GridSpectrum;

use super::fixture::{Counting, FrameCase};

/// Queries computed after a change to a cached picture, with counts.
fn after(start: &FrameCase, change: impl FnOnce(&mut FrameCase)) -> Vec<(&'static str, usize)> {
    let ask = Counting::default();
    let mut studio = start.clone();
    studio.take(&ask);
    ask.made();
    change(&mut studio);
    studio.take(&ask);
    ask.made().into_iter().collect()
}

#[test]
fn four_cameras_share_all_that_has_no_camera_in_it() {
    let ask = Counting::default();
    FrameCase::new().take(&ask);
    let made = ask.made();
    for (name, count) in [("mesh", 1), ("visibility", 1), ("geometry", 1), ("shading", 1), ("camera image", 4)] {
        assert_eq!(made[name], count, "{name}");
    }
}

#[test]
fn exposure_asks_for_pixels_alone() {
    assert_eq!(after(&FrameCase::new(), |studio| studio.ev = 1.0), [("picture", 4), ("pictures", 1)]);
}

#[test]
fn a_new_white_asks_for_no_signals() {
    let made = after(&FrameCase::new(), |studio| {
        let white = WhiteBalanceTarget::from_chromaticity(Xy { x: 0.31, y: 0.33 }).unwrap();
        studio.sources.iter_mut().for_each(|source| source.white = white);
    });
    let names: Vec<&str> = made.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["difference", "exposure", "picture", "pictures", "rendering"]);
}

#[test]
fn a_rougher_surface_asks_for_no_geometry_and_no_plan() {
    // Enough samples for a plan.
    let smooth = FrameCase { sigma_m: 0.3e-6, size: RasterSize::new(256, 256), ..FrameCase::new() };
    let made = after(&smooth, |studio| studio.sigma_m = 0.4e-6);
    let names: Vec<&str> = made.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["camera image", "difference", "exposure", "picture", "pictures", "shading"]);
}

#[test]
fn at_a_chosen_accuracy_a_little_rougher_asks_for_no_plan() {
    let quality = Quality::Within(RelTolerance::new(1e-5).unwrap());
    let start = FrameCase { sigma_m: 0.3e-6, quality, ..FrameCase::new() };
    let made = after(&start, |studio| studio.sigma_m = 0.305e-6);
    let names: Vec<&str> = made.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["camera image", "difference", "exposure", "picture", "pictures", "shading"]);
    let ask = Counting::default();
    start.take(&ask);
    let made = ask.made();
    assert_eq!(made["plan"], 4);
}

#[test]
fn few_samples_and_pictures_in_motion_ask_for_no_plan() {
    let large = FrameCase { sigma_m: 0.3e-6, size: RasterSize::new(256, 256), ..FrameCase::new() };
    let asked = |studio: &FrameCase| {
        let ask = Counting::default();
        studio.take(&ask);
        ask.made().get("plan").copied()
    };
    assert_eq!(asked(&large), Some(4));
    assert_eq!(asked(&FrameCase { quality: Quality::Fine, ..large.clone() }), Some(4));
    for quality in [Quality::Preview, Quality::Reference, Quality::Regimes] {
        assert_eq!(asked(&FrameCase { quality, size: RasterSize::new(40, 40), ..large.clone() }), None, "{quality:?}");
    }
    assert_eq!(asked(&FrameCase { quality: Quality::Preview, ..large.clone() }), None);
    assert_eq!(asked(&FrameCase { size: RasterSize::new(40, 40), ..large }), None);
}

#[test]
fn moving_the_light_keeps_what_is_seen() {
    let made = after(&FrameCase::new(), |studio| studio.light_up = 40.0);
    assert!(made.iter().all(|(name, _)| !["mesh", "visibility", "shadow tree", "measure"].contains(name)), "{made:?}");
    assert!(made.contains(&("geometry", 1)));
}

#[test]
fn another_reflectance_keeps_the_shading() {
    let made = after(&FrameCase::new(), |studio| studio.reflectance = Shared::new(GridSpectrum::constant(0.5)));
    assert!(made.iter().all(|(name, _)| !["visibility", "geometry", "shading"].contains(name)), "{made:?}");
}

#[test]
fn a_hidden_camera_costs_nothing() {
    let made = after(&FrameCase::new(), |studio| drop(studio.sources.pop()));
    assert_eq!(made, [("pictures", 1)]);
    // And one that was never shown is never requested.
    let ask = Counting::default();
    let mut studio = FrameCase::new();
    studio.sources.truncate(2);
    studio.take(&ask);
    assert_eq!(ask.made()["camera image"], 2);
}

#[test]
fn without_shadows_there_is_no_tree() {
    let ask = Counting::default();
    FrameCase { shadows: Shadows::Off, ..FrameCase::new() }.take(&ask);
    assert!(!ask.made().contains_key("shadow tree"));
}

#[test]
fn rough_surfaces_need_moments_and_no_mirror() {
    let ask = Counting::default();
    // A ball seen face to face with the sun still has samples near grazing, where κ is small.
    let studio = FrameCase { sigma_m: 50e-6, ..FrameCase::new() };
    let shading = ask.ask(&studio.question().shading);
    let shades = (*shading).as_ref().unwrap().shades().to_vec();
    let pictures = studio.take(&ask);
    let plan = pictures.images[0].as_ref().unwrap().plan();
    let moments =
        shades.iter().filter(|shade| matches!(plan.method(shade.kappa, shade.beta), IntegrationMethod::Moments { .. }));
    let moments = moments.count();
    assert!(moments * 10 > (shades.len() - moments) * 9);
    let flat = FrameCase { reading: Normalization::Lambertian, ..FrameCase::new() };
    let ask = Counting::default();
    let shading = flat.take(&ask).shading;
    assert_eq!((shading.spectral, shading.coherent_samples), (0, 0));
    assert!(!ask.made().contains_key("plan"));
}
