//! The spectral integral by each of its ways against the sum over 401 wavelengths; small pictures of anything.

use std::sync::{Arc, LazyLock};

use chromascope_core::camera::{ColorTransform, Rendering, WhiteBalanceTarget};
use chromascope_core::colorimetry::{Metric, Stimulus, Xyz};
use chromascope_core::query::render::difference::BrightSamples;
use chromascope_core::reflectance::{Normalization, Precision, Surface, wavelength_power};
use chromascope_core::render::develop::signal_differences;
use chromascope_core::render::diffuse::{by_moments, by_nodes, by_nodes_into, by_regimes, rough_basis};
use chromascope_core::render::{
    CameraImage, ColorimetricScale, Development, GeometryImage, IntegrationMethod, Plan, Quality, RasterSize,
    ShadingImage, Shadows, SpectralWeights, Stop, VertexImage, Visibility, develop,
};
use chromascope_core::scene::{Lighting, Viewpoint, roughness};
use chromascope_core::spectral::{GridSpectrum, Primaries};
use chromascope_mesh::{Mesh, ShadowTree, shapes};
use glam::{DVec3, Vec3};

use super::draw::{Case, Draw, case};
use super::spectral::{drawn_light, drawn_sensor};
use super::walk::{Verdict, Walk};
use crate::support::{CANON_10D, CIE_1931, light, sensor};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "by_moments", promise: 1e-9, share: 0.5, draw: draw_rough, check: moments },
    Walk { name: "by_nodes", promise: 1e-9, share: 0.5, draw: draw_any, check: nodes },
    Walk { name: "diffuse ends", promise: 0.0, share: 4.0, draw: draw_ends, check: ends },
    Walk { name: "Measure::new", promise: 1e-9, share: 0.2, draw: draw_measure, check: measure },
    Walk { name: "Plan::fixed", promise: 0.0, share: 0.01, draw: draw_measure, check: fixed },
    Walk { name: "ShadowTree::is_blocked", promise: 0.0, share: 20.0, draw: draw_ray, check: shadow },
    Walk { name: "RasterSize, Hit", promise: 1e-6, share: 20.0, draw: draw_size, check: size },
    Walk { name: "Measurement", promise: 0.0, share: 10.0, draw: draw_size, check: measurement },
    Walk { name: "a picture", promise: 0.0, share: 0.05, draw: draw_picture, check: picture },
];

pub(super) struct Scene {
    rendering: Rendering,
    pub(super) measure: SpectralWeights,
}

fn scene(path: &str) -> Scene {
    let (sensor, light) = (sensor(path), light("illuminants/d55.csv"));
    let rendering = Rendering::new(&sensor, &light, WhiteBalanceTarget::UNITY, ColorTransform::Paper).unwrap();
    let power = wavelength_power(Normalization::Radiometric);
    let measure = SpectralWeights::new(&sensor, &light, &GridSpectrum::constant(0.5), rendering.white_integrals, power);
    Scene { rendering, measure }
}

static SCENES: LazyLock<[Scene; 2]> = LazyLock::new(|| [CANON_10D, CIE_1931].map(scene));

pub(super) fn of(which: f64) -> &'static Scene {
    &SCENES[usize::from(which >= 1.0)]
}

fn draw_rough(d: &mut Draw) -> Case {
    case([d.pick(2), d.log(128.0, 1e15), if d.pick(2) == 0.0 { d.log(1e-12, 1e3) } else { d.within(0.0, 30.0) }])
}

fn draw_any(d: &mut Draw) -> Case {
    case([d.pick(2), d.log(1e-12, 1e12), d.log(1e-12, 1e6)])
}

fn draw_ends(d: &mut Draw) -> Case {
    case([d.pick(2), d.log(1e-300, 1e300), if d.pick(4) == 0.0 { 0.0 } else { d.log(1e-300, 1e150) }])
}

fn exact(scene: &Scene, kappa: f64, beta: f64) -> [f64; 3] {
    by_nodes(scene.measure.dense(), kappa, beta, Precision::Full)
}

/// Relative to J(κ, 0), the peak; without the signs of the channels' weights.
fn compare(scene: &Scene, kappa: f64, value: [f64; 3], exact_value: [f64; 3], v: &mut Verdict) {
    v.all_finite(value);
    let peak = exact(scene, kappa, 0.0).iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (a, b) in value.into_iter().zip(exact_value) {
        v.error(if a == b { 0.0 } else { (a - b).abs() / peak });
    }
}

fn moments(&[which, kappa, beta, ..]: &Case, v: &mut Verdict) {
    let scene = of(which);
    let value = by_moments(scene.measure.moments(), &rough_basis(kappa.max(128.0), beta));
    compare(scene, kappa.max(128.0), value, exact(scene, kappa.max(128.0), beta), v);
}

fn nodes(&[which, kappa, beta, ..]: &Case, v: &mut Verdict) {
    let scene = of(which);
    let value = by_nodes(scene.measure.fine(), kappa, beta, Precision::Full);
    compare(scene, kappa, value, exact(scene, kappa, beta), v);
}

fn ends(&[which, kappa, beta, ..]: &Case, v: &mut Verdict) {
    let scene = of(which);
    v.all_finite(by_nodes(scene.measure.fine(), kappa, beta, Precision::Coarse));
    let mut many = [[f64::NAN; 3]; 2];
    by_nodes_into(scene.measure.fine(), &[3.0, kappa], &[0.5, beta], Precision::Full, &mut many);
    v.holds("by nodes of many", many[1] == by_nodes(scene.measure.fine(), kappa, beta, Precision::Full));
    v.all_finite(by_regimes(scene.measure.coarse(), kappa, beta));
    v.all_finite(rough_basis(kappa.max(128.0), beta));
}

fn draw_measure(d: &mut Draw) -> Case {
    case([d.key(), d.pick(6), d.pick(2), d.pick(6)])
}

pub(super) fn drawn_measure(&[key, kind, power, light, ..]: &Case) -> Option<SpectralWeights> {
    let sensor = drawn_sensor(key, Primaries::Camera, 1.0)?;
    let light = drawn_light(key, light, &sensor);
    let reflectance = drawn_light(key + 1.0, kind, &sensor);
    let rendering = Rendering::new(&sensor, &light, WhiteBalanceTarget::UNITY, ColorTransform::Paper).ok()?;
    Some(SpectralWeights::new(&sensor, &light, &reflectance, rendering.white_integrals, 2 * i32::from(power >= 1.0)))
}

fn measure(case: &Case, v: &mut Verdict) {
    let Some(measure) = drawn_measure(case) else { return v.refuse() };
    v.all_finite(measure.totals().into_iter().chain(measure.moments().iter().flatten().copied()));
    let unsigned: [f64; 3] = [0, 1, 2].map(|c: usize| measure.dense().iter().map(|n| n.weights[c].abs()).sum());
    for list in [measure.dense(), measure.coarse(), measure.fine()] {
        v.all_finite(list.iter().flat_map(|n| n.weights.into_iter().chain([n.scale, n.wavelength_nm, n.reference])));
        for (c, unsigned) in unsigned.into_iter().enumerate() {
            let sum: f64 = list.iter().map(|n| n.weights[c]).sum();
            let off = (sum - measure.totals()[c]).abs();
            v.error(if off == 0.0 { 0.0 } else { off / unsigned });
        }
    }
}

/// The methods of the qualities by name, for any measure.
fn fixed(case: &Case, v: &mut Verdict) {
    let Some(measure) = drawn_measure(case) else { return v.refuse() };
    for quality in [Quality::Preview, Quality::Full, Quality::Fine, Quality::Reference, Quality::Regimes] {
        let plan = Plan::fixed(&measure, quality);
        for kappa in [0.0, 1e-30, 1e-3, 1.0, 128.0, 1e30] {
            for beta in [0.0, 1.0, 30.0, 4e4] {
                v.all_finite(plan.at(kappa, beta));
                let method = plan.method(kappa, beta);
                v.holds("a dark place that is integrated", kappa > 0.0 || method == IntegrationMethod::Nothing);
                v.holds("more wavelengths than there are", method.node_count() <= 401);
            }
        }
    }
}

static SPHERE: LazyLock<Mesh> = LazyLock::new(|| shapes::sphere(4000));
static TREE: LazyLock<ShadowTree> = LazyLock::new(|| ShadowTree::new(&SPHERE));

fn draw_ray(d: &mut Draw) -> Case {
    if d.pick(4) == 0.0 {
        return case([d.anything(), d.anything(), d.anything(), d.anything(), d.angle(), d.angle()]);
    }
    case([d.within(-0.3, 0.3), d.within(-0.3, 0.3), d.within(-0.3, 0.3), d.log(1e-9, 1e9), d.angle(), d.angle()])
}

/// A sphere of 0.1 m, from inside and out; not within a facet's height of the silhouette.
fn shadow(&[x, y, z, distance, up, around, ..]: &Case, v: &mut Verdict) {
    let (point, direction) =
        (DVec3::new(x, y, z), DVec3::new(up.cos() * around.cos(), up.sin(), up.cos() * around.sin()));
    let blocked = TREE.is_blocked(point, direction, distance);
    // A ray along the edges of a meridian or the equator can slip between two facets: single precision.
    let oblique = [point, direction].iter().all(|v| v.abs().min_element() > 1e-4);
    if !(oblique && point.is_finite() && point.length() < 10.0 && direction.is_finite()) {
        return;
    }
    let along = -point.dot(direction);
    let miss = (point.length_squared() - along * along).max(0.0).sqrt();
    let half = (0.01 - miss * miss).max(0.0).sqrt();
    let ends = [along - half, along + half];
    if miss > 0.1001 {
        v.holds("the sphere is missed", !blocked);
    } else if miss < 0.098 {
        let reached = |t: f64| t > 1e-3 && t < distance - 1e-3;
        let away = |t: f64| t < -1e-3 || t > distance + 1e-3;
        if ends.into_iter().any(reached) {
            v.holds("the sphere is in the way", blocked);
        } else if ends.into_iter().all(away) {
            v.holds("nothing is in the way", !blocked);
        }
    }
}

fn draw_size(d: &mut Draw) -> Case {
    case([d.anything(), d.anything(), d.anything(), d.unit(), d.unit()])
}

fn size(&[x, y, s, b, c, ..]: &Case, v: &mut Verdict) {
    let size = RasterSize { width: x as u32, height: y as u32, samples: s as u32 };
    v.holds("no count", size.columns() >= size.width as usize * usize::from(size.samples > 0));
    v.holds("no count", size.rows() >= size.height as usize * usize::from(size.samples > 0));
    let clamped = size.clamped();
    v.holds(
        "a side of nothing or too long",
        (1..=16_384).contains(&clamped.columns()) && (1..=16_384).contains(&clamped.rows()),
    );
    let hit = chromascope_core::render::visibility::Hit { triangle: 0, weights: [b as f32, c as f32] };
    v.holds("nothing is hit", hit.is_some());
    v.error((f64::from(hit.barycentric().iter().sum::<f32>()) - 1.0).abs());
}

fn measurement(&[luminance, x, y, ..]: &Case, v: &mut Verdict) {
    let rendering = &SCENES[0].rendering;
    let usable = |n: f64| if n.is_nan() || n.abs() > 1e30 { 1.0 } else { n };
    let measured =
        ColorimetricScale::new(rendering, if luminance > 0.0 { luminance.clamp(1e-100, 1e100) } else { luminance });
    let signal = [usable(x) as f32, usable(y) as f32, 0.5];
    let Stimulus { xyz: Xyz { x, y, z }, lab } = measured.color(signal);
    v.all_finite([x, y, z]);
    if let Some(lab) = lab {
        v.all_finite([lab.l, lab.a, lab.b]);
    }
}

fn draw_picture(d: &mut Draw) -> Case {
    let sigma = if d.pick(4) == 0.0 { 0.0 } else { d.log(1e-12, 1.0) };
    case([d.key(), sigma, d.log(1e-9, 1.0), d.log(1e-9, 1.0), d.log(0.01, 1e3), d.pick(4), d.pick(5), d.pick(6)])
}

/// Some triangles anywhere, and flat and repeated ones.
fn drawn_mesh(key: f64) -> Option<Mesh> {
    let mut d = Draw::new(key as u64, "mesh", 0);
    if d.pick(2) == 0.0 {
        return Some(shapes::sphere(200));
    }
    let size = d.log(1e-30, 1e30);
    let mut number = || (size * d.within(-1.0, 1.0)) as f32;
    let positions: Vec<Vec3> = (0..9).map(|_| Vec3::new(number(), number(), number())).collect();
    Mesh::with_smooth_normals(positions, vec![[0, 1, 2], [3, 4, 5], [6, 7, 8], [0, 4, 8], [0, 0, 1], [2, 2, 2]]).ok()
}

fn picture(&[key, sigma, tau, half, index, reading, quality, kind]: &Case, v: &mut Verdict) {
    let mut d = Draw::new(key as u64, "view", 0);
    let Ok(surface) = Surface::new(sigma, tau, half, half, index) else { return v.refuse() };
    let Some(mesh) = drawn_mesh(key) else { return v.refuse() };
    let Ok(viewpoint) = Viewpoint::new(d.angle(), d.angle(), d.log(0.05, 1000.0), d.log(0.01, 2.6)) else {
        return v.refuse();
    };
    let place = DVec3::new(d.signed(1e-9, 1e9), d.signed(1e-9, 1e9), d.signed(1e-9, 1e9));
    let radius = d.within(0.0, 0.5);
    let lighting = if d.pick(2) == 0.0 { Lighting::far(place, radius) } else { Lighting::near(place, radius) };
    let Ok(lighting) = lighting else { return v.refuse() };
    let reading =
        [Normalization::Radiometric, Normalization::Paper, Normalization::Microfacet, Normalization::Lambertian]
            [reading as usize % 4];
    let quality =
        [Quality::Preview, Quality::Full, Quality::Fine, Quality::Reference, Quality::Regimes][quality as usize % 5];
    let eye = viewpoint.eye(mesh.bounds());
    let seen = Visibility::new(&mesh, eye, RasterSize::new(6, 5), &Stop::NEVER).expect("never stopped");
    let tree = ShadowTree::new(&mesh);
    let shadows = Some((&tree, if d.pick(2) == 0.0 { Shadows::Full } else { Shadows::Coarse }));
    let geometry = GeometryImage::new(&mesh, &seen, &lighting, shadows, &Stop::NEVER).expect("never stopped");
    v.all_finite(geometry.angles().iter().flat_map(|a| {
        let g = a.geometry();
        [a.light(), g.cos_i, g.cos_s, g.vx_by_k, g.vy_by_k, g.vxy2_by_k2, g.vz_by_k, g.cos_half2]
    }));
    let thin = geometry.thinned(2);
    v.holds("thinned to more", thin.samples().len() == geometry.samples().len().div_ceil(2));
    let geometry = Arc::new(geometry);
    let scene = of(kind);
    let plain = ShadingImage::new(Arc::clone(&geometry), surface, reading, quality, &Stop::NEVER);
    let vertices =
        VertexImage::new(&mesh, &seen, Arc::clone(&geometry), &lighting, &Stop::NEVER).expect("never stopped");
    let heights = roughness::vertex_roughness(&mesh);
    v.all_finite(heights.iter().flat_map(|h| [h.sigma_m, h.tau_m].map(f64::from)));
    v.all_finite(heights.iter().map(|h| h.of(surface).slope()));
    let rough = ShadingImage::by_vertices(Arc::new(vertices), &heights, surface, reading, quality, &Stop::NEVER);
    let images = [plain, rough].map(|shading| {
        let shading = shading.expect("never stopped");
        let mut measure = scene.measure.clone();
        measure.untinted = Some(Arc::new(scene.measure.clone()));
        let plan = Arc::new(Plan::fixed(&measure, shading.fixed_quality()));
        CameraImage::new(&shading, &measure, plan, &Stop::NEVER).expect("never stopped")
    });
    for image in &images {
        v.all_finite(image.signals().iter().flatten().map(|s| f64::from(*s)));
        let development = Development::new(&scene.rendering, 1.0, None);
        v.holds("no picture", develop(image, &development, &Stop::NEVER).is_some_and(|p| p.rgba.len() == 120));
    }
    let measured = ColorimetricScale::new(&scene.rendering, 1.0);
    let (map, lightness) = signal_differences(
        Metric::DELTA_E_2000,
        [images[0].signals(), images[1].signals()],
        [&measured; 2],
        1,
        &Stop::NEVER,
    )
    .expect("never stopped");
    v.all_finite(BrightSamples::new(&map, &lightness).into_iter().flat_map(|bright| [bright.median, bright.p95]));
    v.all_finite(map.into_iter().chain(lightness).map(f64::from));
}
