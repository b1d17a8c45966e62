//! Tests of the counts and texts of skipped work, for scenes of several kinds.

use chromascope_core::query::render::MeshQuery;
use chromascope_core::render::RasterSize;

use super::*;
use crate::catalog::Catalog;
use crate::document::Document;
use crate::document::render::{MeshChoice, ReadingChoice, RenderSettings, RoughnessChoice};
use crate::results::Results;
use crate::scene::Scene;
use chromascope_core::render::QualityLevel;

/// The rows of a small picture of the default scene's cameras.
fn rows_of(change: impl FnOnce(&mut RenderSettings)) -> Vec<SkippedWork> {
    rows_at(RasterSize { width: 64, height: 48, samples: 1 }, change)
}

fn rows_at(size: RasterSize, change: impl FnOnce(&mut RenderSettings)) -> Vec<SkippedWork> {
    let mut document = Document::paper();
    (document.render.mesh, document.render.triangles) = (MeshChoice::Sphere, 2000);
    change(&mut document.render);
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let mut run = SceneRunJob::of(&scene, None, None);
    let pictures = run.pictures.as_mut().expect("there is a mesh");
    pictures.shading.geometry.visibility.size = size;
    of_pictures(pictures, &Results::default()).expect("nothing stops it")
}

#[test]
fn pictures_that_are_not_visible_are_made_from_nothing() {
    let document = Document::paper();
    let (catalog, results) = (Catalog::built_in(), Results::default());
    let scene = Scene { document: &document, catalog: &catalog, results: &results };
    let mut pictures = SceneRunJob::of(&scene, None, None).pictures.expect("there is a mesh");
    pictures.shading.geometry.visibility.mesh = MeshQuery::Sphere(2000);
    pictures.shading.geometry.visibility.size = RasterSize { width: 16, height: 12, samples: 1 };
    // The rows are computed from cached inputs.
    let asking = Results::default();
    asking.ask(&pictures);
    let asked =
        || asking.counts().into_iter().map(|(name, count)| (name, count.hits, count.misses)).collect::<Vec<_>>();
    let before = asked();
    assert!(panes::pictures(&pictures, &asking).is_some_and(|row| row.count == pictures.sources.len() as u64));
    assert_eq!(asked(), before, "nothing that is remembered was used");
}

fn row<'a>(rows: &'a [SkippedWork], what: &str) -> Option<&'a SkippedWork> {
    rows.iter().find(|row| row.what == what)
}

fn tolerance(settings: &mut RenderSettings, tolerance: f64) {
    (settings.quality, settings.tolerance) = (QualityLevel::Tolerance, tolerance);
}

#[test]
fn a_lambertian_surface_leaves_out_no_mirror_and_no_wavelength() {
    let rows = rows_of(|settings| settings.reading = ReadingChoice::Lambertian);
    assert!(row(&rows, "specular terms").is_none(), "there are none to leave out");
    assert_eq!(rows.len(), 3, "what is not lit: {rows:?}");
}

#[test]
fn wavelengths_that_are_looked_at_do_not_count_as_left_out() {
    let rows_of = |change: fn(&mut RenderSettings)| rows_at(RasterSize { width: 24, height: 18, samples: 1 }, change);
    let wavelengths = |rows: &[SkippedWork]| row(rows, "wavelengths at a lit sample").map(|row| (row.count, row.of));
    for quality in [QualityLevel::Reference, QualityLevel::Regimes] {
        let size = RasterSize { width: 24, height: 18, samples: 1 };
        assert_eq!(wavelengths(&rows_at(size, |settings| settings.quality = quality)), None, "{quality:?}");
    }
    // Few at a sample, or none by moments, of those of 401 that a source responds at.
    let Some((fine, Some(of))) = wavelengths(&rows_of(|settings| settings.quality = QualityLevel::Fine)) else {
        panic!("some are left out");
    };
    assert!(fine <= of && (of - fine) * 20 < of, "{fine} of {of}");
    let Some((full, Some(of_full))) = wavelengths(&rows_of(|_| ())) else { panic!("some are left out") };
    assert!(full <= of_full && (of_full - full) * 20 < of_full && of_full <= of, "{full} of {of_full}");
    // Few samples so exact are summed over some wavelengths or all, as each camera's plan says.
    let exact = rows_of(|settings| tolerance(settings, 1e-13));
    let left = wavelengths(&exact).map_or(0, |(count, _)| count);
    assert!(left < of, "{left} of {of}");
}

#[test]
fn what_was_measured_on_a_part_says_so_with_threads_and_threshold() {
    let rows = rows_of(|_| ());
    for row in &rows {
        assert!(row.how.contains("one thread"), "{row:?}");
    }
    let coherent_samples = row(&rows, "specular terms").expect("left out of a rough surface");
    assert!(
        coherent_samples.count > 200 && coherent_samples.how.contains("extrapolated from 1"),
        "{coherent_samples:?}"
    );
    assert!(coherent_samples.how.contains("below 1e-6 of the picture's brightest sample"), "{coherent_samples:?}");
    let rows = rows_of(|settings| tolerance(settings, 1e-6));
    let coherent_samples = row(&rows, "specular terms").expect("left out of a rough surface");
    assert!(coherent_samples.how.contains("below 1e-7 of"), "a tenth of the tolerance: {coherent_samples:?}");
}

#[test]
fn of_vertices_each_has_a_roughness_of_its_own() {
    let rows = rows_of(|settings| settings.roughness = RoughnessChoice::Mesh);
    let beside = row(&rows, "samples beside the mesh").expect("counted");
    assert!(beside.saved == 0.0 && beside.count > 0 && beside.how.contains("not measured"), "{beside:?}");
    let coherent_samples = row(&rows, "specular terms").expect("left out at most vertices");
    assert!(coherent_samples.how.contains("vertices"), "{coherent_samples:?}");
    assert!(row(&rows, "wavelengths at a lit vertex").is_some_and(|row| row.count > 0 && row.saved >= 0.0), "{rows:?}");
}
