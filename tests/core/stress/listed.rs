//! Every public function of the core, and where it is walked or why it is not: a new one has to be put here.
//!
//! The list is held against the sources, and what it says is walked has to be called by the walks' own text. Readers,
//! writers and figures have suites of their own.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Walked, file by file.
const WALKED: &[(&str, &str)] = &[
    ("accuracy", "Accuracy::new Accuracy::allows Accuracy::max_relative_error"),
    ("camera/batch", "Batch::new Batch::channels Batch::max_error Batch::responses Batch::responses_into"),
    (
        "camera/locus",
        "LocusEvaluator::new LocusEvaluator::within LocusEvaluator::by_sum LocusEvaluator::method LocusEvaluator::raw",
    ),
    (
        "camera/locus_table",
        "LocusTable::new LocusTable::within LocusTable::of LocusTable::max_error LocusTable::size LocusTable::xy LocusTable::xys LocusTable::xys_into",
    ),
    (
        "camera/rendering",
        "Rendering::new Rendering::by_targets Rendering::patch_signals Rendering::xyz Rendering::linear_srgb Rendering::lab white_divisors FitTargets::new under_light raw",
    ),
    ("camera/white_balance", "White::from_xyz White::from_chromaticity White::from_light"),
    ("colorimetry/adaptation", "bradford"),
    ("colorimetry/diagram", "spectral_locus area_color wavelength_color"),
    ("colorimetry/difference", "delta_e_1976 delta_e_2000 delta_e_2000_into"),
    ("colorimetry/lab", "lab_from_xyz"),
    ("colorimetry/rgb", "srgb_from_xyz srgb_white encode_srgb srgb_transfer srgb_inverse_transfer"),
    (
        "colorimetry/tristimulus",
        "Xyz::new Xyz::chromaticity Xyz::uv_prime Xyz::to_vector Xy::with_unit_luminance Xy::uv_prime Xy::distance UvPrime::uv60 UvPrime::xy UvPrime::distance",
    ),
    ("light/daylight", "DaylightBasis::new DaylightBasis::light chromaticity"),
    ("light/planckian", "RadiationConstants::first RadiationConstants::second exitance relative_exitance black_body"),
    (
        "light/temperature",
        "PlanckianLocus::new PlanckianLocus::cct PlanckianLocus::cct_of_xy PlanckianLocus::cct_of_xyz PlanckianLocus::ccts PlanckianLocus::ccts_into PlanckianLocus::at PlanckianLocus::off",
    ),
    ("light/temperature/published", "mccamy_1992 hernandez_andres_1999 kang_2002"),
    ("light/temperature/tabulated", "Robertson::new Robertson::cct Ohno::new Ohno::cct"),
    ("math/chebyshev", "nodes coefficients evaluate"),
    ("math/dot", "dot dot_each"),
    (
        "math/double",
        "Double::new Double::value Double::low Double::error_of Double::abs Double::sqrt Double::cbrt Double::powi Double::exp Double::exp_m1 Double::ln Double::sin_cos Double::atan2",
    ),
    ("math/exp", "exp"),
    ("math/gauss", "gauss_rule interpolatory_rule"),
    ("math/interpolation", "linear Sprague::new Sprague::at"),
    ("math/least_squares", "matrix_keeping"),
    ("math/ln", "ln ln_1p"),
    ("query/loci", "Temperatures::to_vec"),
    ("query/render/difference", "BrightSamples::new"),
    ("reflectance/coherent", "sinc mean_sinc_squared sine_integral rho0_squared rho0_squared_bound is_negligible"),
    ("reflectance/fresnel", "reflectance transmittance transmittance_by_cosine"),
    (
        "reflectance/geometry",
        "Geometry::from_angles Geometry::from_directions Geometry::quickly_from_directions Geometry::is_lit",
    ),
    ("reflectance/hemispherical", "directional_hemispherical HemisphericalReflectance::total"),
    (
        "reflectance/power",
        "factor factor_by factors_by diffuse_prefactor coherent_prefactor wavelength_power kappa beta",
    ),
    ("reflectance/regimes", "Regime::of diffuse_sum_by_regimes"),
    (
        "reflectance/sum",
        "diffuse_sum diffuse_sums_into ln_diffuse_sum ln_diffuse_sums_into Precision::within Precision::max_relative_error",
    ),
    ("reflectance/sum/terms", "series_terms"),
    (
        "reflectance/surface",
        "Surface::with_sigma Surface::with_tau Surface::with_area Surface::with_specular Surface::new Surface::sigma_m Surface::tau_m Surface::half_x_m Surface::half_y_m Surface::index Surface::area_m2 Surface::slope Surface::cautions",
    ),
    ("render/develop", "Development::new develop Measurement::new Measurement::xyz Measurement::lab differences"),
    (
        "render/diffuse",
        "DiffuseTable::new DiffuseTable::holds DiffuseTable::at DiffuseTable::position DiffuseTable::read by_nodes by_nodes_into by_regimes rough_basis by_moments",
    ),
    (
        "render/geometry",
        "Angles::light Angles::geometry GeometryImage::new GeometryImage::samples GeometryImage::angles GeometryImage::thinned",
    ),
    ("render/lobe", "mean_sinc_squared_quick"),
    (
        "render/measure",
        "Measure::new Measure::dense Measure::coarse Measure::fine Measure::shared Measure::moments Measure::totals Measure::settled_m Measure::with_untinted",
    ),
    ("render/mirror", "mirror_sum Reach::of Reach::within Reach::in_picture"),
    ("render/plan", "Plan::new Plan::demand Plan::bytes Plan::explanation Plan::at Plan::fill"),
    ("render/plan/candidate", "Candidate::total_ns Explanation::certified"),
    ("render/plan/domain", "Demand::new Demand::kappa Demand::samples Demand::holds position"),
    (
        "render/shading",
        "ShadingImage::new ShadingImage::by_vertices ShadingImage::demand ShadingImage::needs_table ShadingImage::mirror_scale ShadingImage::mirror_accuracy ShadingImage::plan_accuracy Quality::accuracy Quality::mirror_share",
    ),
    ("render/shadow", "ShadowTree::new ShadowTree::is_blocked"),
    ("render/signals", "CameraImage::new CameraImage::by_plan CameraImage::with_reach CameraImage::signals"),
    ("render/vertices", "VertexImage::new"),
    (
        "render/visibility",
        "RasterSize::new RasterSize::clamped RasterSize::columns RasterSize::rows Hit::is_some Hit::barycentric Visibility::new",
    ),
    (
        "scene/lighting",
        "Lighting::far Lighting::near Lighting::from_angles Lighting::place Lighting::angular_radius PlacedLight::seen_from",
    ),
    (
        "scene/mesh",
        "Bounds::center Mesh::new Mesh::with_smooth_normals Mesh::positions Mesh::normals Mesh::triangles Mesh::bounds smooth_normals",
    ),
    ("scene/roughness", "vertex_roughness VertexRoughness::of"),
    ("scene/shapes", "sphere plane"),
    (
        "scene/viewpoint",
        "Viewpoint::new Viewpoint::yaw Viewpoint::pitch Viewpoint::distance Viewpoint::eye Eye::view_from_world",
    ),
    (
        "spectral/distribution",
        "SpectralDistribution::new SpectralDistribution::wavelengths_nm SpectralDistribution::values SpectralDistribution::range_nm SpectralDistribution::uniform_step_nm SpectralDistribution::map",
    ),
    (
        "spectral/grid",
        "wavelength_nm Assumed::nothing GridSpectrum::resample GridSpectrum::constant GridSpectrum::from_fn GridSpectrum::values GridSpectrum::assumed",
    ),
    (
        "spectral/sensor",
        "Sensor::new Sensor::primaries Sensor::weighted Sensor::integrals Sensor::absolute_integrals Sensor::integrate Sensor::at_index Sensor::support_nm",
    ),
    ("units", "::new ::get Kelvin::mired Kelvin::from_mired"),
];

/// Not walked, and why.
const NOT_WALKED: &[(&str, &str)] = &[
    (
        "spectral/grid Interpolation::of, spectral/sensor Sensor::extrapolated_below_k, object PatchSet::new, object PatchSet::from_dataset, object PatchSet::patches, object PatchSet::subset, query/shared Shared::new, render Stop::at, render Stop::is_set, colorimetry/tristimulus Xyz::from_vector, render/geometry GeometryImage::placed, render/geometry GeometryImage::counts, render/geometry GeometryImage::chunk, render/shading ShadingImage::quality, render/shading ShadingImage::vertices, render/shading ShadingImage::shades, render/shading ShadingImage::mirrors, render/shading ShadingImage::counts, render/signals CameraImage::placed, render/vertices VertexImage::geometries, render/vertices VertexImage::geometry, render/visibility Visibility::hits, render/visibility Visibility::size, render/visibility Visibility::eye, spectral/sensor Primaries::quantity, spectral/sensor Primaries::channels, spectral/sensor Sensor::response, spectral/sensor Sensor::curves, scene/viewpoint Viewpoint::field_of_view, scene/lighting Lighting::distance, render/geometry Placed::size, render/geometry Placed::samples, render/geometry Placed::seen, render/geometry GeometryImage::angular_radius, reflectance/surface Surface::area, reflectance/surface Surface::specular, render/measure Measure::coherent, render/shading ShadingImage::geometry, render/shading ShadingImage::surface",
        "keeps and hands out what it is given",
    ),
    (
        "scene/lighting Lighting::before, render/visibility Visibility::rays, render/visibility Rays::at",
        "part of a picture, and walked with it",
    ),
    (
        "query/compare comparable_by_paper, query/compare patch_difference, query/compare locus_distance_xy, query/compare locus_distance_uv, query/loci Locus::length_xy, query/loci Temperatures::count, query/loci Temperatures::part, query/render MeasureOf::in_picture, query/render/picture Facing::factor, query/render/picture PicturesOf::exposure, query/render/picture PicturesOf::image, query/render/picture PicturesOf::picture, query/render/picture PicturesOf::difference",
        "asks what others compute; tests/core/query.rs",
    ),
    (
        "scene/fern fern, scene/fern Fern::mesh, scene/head head, scene/head Head::mesh, scene/implicit mirrored",
        "too slow for many cases: thousands of triangles; tests/core/fern.rs and head.rs",
    ),
];

/// Folders with suites of their own.
const ELSEWHERE: [&str; 4] = ["table", "figure", "scene/reading", "spectral/dataset"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// `file Type::name` for each public function of a source, without its tests.
fn functions(file: &str, text: &str) -> Vec<String> {
    let mut of = String::new();
    let mut found = Vec::new();
    for line in text.lines().take_while(|line| !line.starts_with("#[cfg(test)]")) {
        if let Some(rest) = line.strip_prefix("impl") {
            of = implemented(rest);
        }
        let plain = line.trim_start().replace("pub const fn ", "pub fn ");
        if let Some(rest) = plain.strip_prefix("pub fn ") {
            let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            let inner = line.starts_with(' ');
            found.push(if inner { format!("{file} {of}::{name}") } else { format!("{file} {name}") });
        }
    }
    found
}

/// The type of `impl<…> Trait for Type<…> {`.
fn implemented(rest: &str) -> String {
    let rest = match rest.strip_prefix('<') {
        // Bounds hold no arrows; the parameters end where the brackets do.
        Some(parameters) => {
            let mut depth = 1;
            let end = parameters.find(|c| {
                depth += i32::from(c == '<') - i32::from(c == '>');
                depth == 0
            });
            &parameters[end.map_or(0, |end| end + 1)..]
        }
        None => rest,
    };
    let own = rest.rsplit(" for ").next().unwrap_or(rest).trim();
    own.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

fn public() -> BTreeSet<String> {
    let base = root().join("src");
    let mut files = Vec::new();
    sources(&base, &mut files);
    let mut found = BTreeSet::new();
    for path in files {
        let relative = path.strip_prefix(&base).unwrap().with_extension("");
        let name = relative.to_str().unwrap().replace('\\', "/");
        let elsewhere = |folder: &str| name == folder || name.starts_with(&format!("{folder}/"));
        if !ELSEWHERE.iter().any(|folder| elsewhere(folder)) {
            found.extend(functions(&name, &fs::read_to_string(&path).unwrap()));
        }
    }
    found
}

fn named(list: &[(&str, &str)]) -> BTreeSet<String> {
    list.iter().flat_map(|(file, names)| names.split(' ').map(move |name| format!("{file} {name}"))).collect()
}

#[test]
fn every_public_function_is_walked_or_said_why_not() {
    let (public, walked) = (public(), named(WALKED));
    let excused: BTreeSet<String> =
        NOT_WALKED.iter().flat_map(|(names, _)| names.split(", ").map(str::to_owned)).collect();
    assert!(public.len() > 150, "only {} functions were found", public.len());
    let missing: Vec<&String> = public.iter().filter(|f| !walked.contains(*f) && !excused.contains(*f)).collect();
    assert!(missing.is_empty(), "public, and neither walked nor said why not: {missing:#?}");
    let gone: Vec<&String> = walked.union(&excused).filter(|f| !public.contains(*f)).collect();
    assert!(gone.is_empty(), "listed, but not public: {gone:#?}");
    let both: Vec<&String> = walked.intersection(&excused).collect();
    assert!(both.is_empty(), "walked and excused: {both:#?}");
}

#[test]
fn what_is_listed_as_walked_is_called() {
    let folder = root().join("../tests/core/stress");
    let mut files = Vec::new();
    sources(&folder, &mut files);
    let text: String = files
        .iter()
        .filter(|path| !path.ends_with("listed.rs"))
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    let silent: Vec<String> = named(WALKED)
        .into_iter()
        .filter(|function| {
            let whole = function.rsplit(' ').next().unwrap();
            let name = whole.rsplit(':').next().unwrap();
            // A function may also be handed on by its name; a macro's type has none of its own.
            let calls = if whole.contains("::") && !whole.starts_with(':') {
                vec![format!("{whole}("), format!(".{name}(")]
            } else {
                vec![format!("{name}("), format!("{name}::<"), format!("and_then({name})")]
            };
            !calls.iter().any(|call| text.contains(call))
        })
        .collect();
    assert!(silent.is_empty(), "listed as walked, but never called: {silent:#?}");
}

#[test]
fn the_source_is_read_as_it_is_written() {
    let text = "pub fn a(x: f64) {}\nimpl<S: Deref<Target = X>> Big<S> {\n    pub const fn new() {}\n    fn no() {}\n}\n\
                impl fmt::Display for Small {\n    pub fn b() {}\n}\n#[cfg(test)]\npub fn c() {}";
    assert_eq!(functions("f", text), ["f a", "f Big::new", "f Small::b"]);
}
