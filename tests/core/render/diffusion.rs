//! Light that spreads within skin, against the dipole's own integrals and a step's Gaussian integral.

use chromascope_core::query::render::MeshQuery;
use chromascope_core::query::{Ask as _, Direct, Shared};
use chromascope_core::reflectance::Normalization;
use chromascope_core::reflectance::diffusion::{SPREADS_MM, shares};
use chromascope_core::render::diffusion::changes;
use chromascope_core::render::{RasterSize, Reach, ShadingImage, Stop, Visibility};
use chromascope_core::scene::Viewpoint;
use chromascope_mesh::Mesh;
use glam::Vec3;

use super::fixture::FrameCase;
use crate::support;

fn mean_square(shares: [f64; 3]) -> f64 {
    shares.iter().zip(SPREADS_MM).map(|(share, spread)| share * spread * spread).sum()
}

/// Half of the mean of r² over Jensen's dipole profile, by midpoints, for an albedo that is found by the total it returns.
fn by_dipole(nm: f64, reflectance: f64) -> f64 {
    let scattering = 4.6 * (nm / 500.0).powf(-1.421);
    let inner = -1.440 / 1.96 + 0.710 / 1.4 + 0.668 + 0.0636 * 1.4;
    let a = (1.0 + inner) / (1.0 - inner);
    let profile = |albedo: f64| {
        let extinction = scattering / albedo;
        let transport = (3.0 * (extinction - scattering) * extinction).sqrt();
        let (real, mirrored) = (1.0 / extinction, (1.0 + 4.0 / 3.0 * a) / extinction);
        let of = |r: f64, z: f64| {
            let d = r.hypot(z);
            z * (transport * d + 1.0) * (-transport * d).exp() / (d * d * d)
        };
        let (mut all, mut squares) = (0.0, 0.0);
        for k in 0..40_000 {
            // Even steps of ln r.
            let r = 1e-4 * (f64::from(k) * 3.5e-4).exp();
            let ring = albedo / 2.0 * (of(r, real) + of(r, mirrored)) * r * r * 3.5e-4;
            all += ring;
            squares += ring * r * r;
        }
        [all, squares / all]
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..30 {
        let middle = f64::midpoint(low, high);
        *(if profile(middle)[0] < reflectance { &mut low } else { &mut high }) = middle;
    }
    profile(low)[1] / 2.0
}

#[test]
fn shares_keep_the_dipoles_mean_square_and_red_spreads_farthest() {
    let skin = support::patches("materials/skin_vrhel.csv");
    let skin = &skin.patches()[0].grid;
    let mut last = 0.0;
    for nm in [420.0, 450.0, 500.0, 600.0, 650.0, 700.0] {
        let reflectance = skin.values()[nm as usize - 380];
        let (shares, expected) = (shares(nm, reflectance), by_dipole(nm, reflectance));
        assert!(shares.iter().all(|&share| share >= 0.0) && shares.iter().sum::<f64>() <= 1.0);
        // What lies beyond the widest Gaussian is put into it.
        let found = mean_square(shares);
        assert!((found / expected - 1.0).abs() < 0.05, "{nm} nm: {} and {} mm", found.sqrt(), expected.sqrt());
        assert!(found > last, "{nm} nm: {found} mm²");
        last = found;
    }
    for nothing in [0.0, -1.0, f64::NAN] {
        assert_eq!(shares(550.0, nothing), [0.0; 3]);
    }
    assert!(shares(550.0, 2.0).iter().all(|share| share.is_finite()));
}

/// A square of 80 mm, half of it in the shadow of one before it and aside; one behind it keeps the middle.
fn half_in_shadow() -> MeshQuery {
    let square = |x: [f32; 2], y: f32, z: f32| {
        [Vec3::new(x[0], -y, z), Vec3::new(x[1], -y, z), Vec3::new(x[1], y, z), Vec3::new(x[0], y, z)]
    };
    let corners =
        [square([-0.04, 0.04], 0.04, 0.0), square([0.4, 0.6], 0.1, 0.4), square([-0.6, -0.4], 0.1, -0.4)].concat();
    let triangles = (0..3).flat_map(|k| [[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]]).collect();
    MeshQuery::Own(Shared::new(Mesh::new(corners, vec![Vec3::Z; 12], triangles).unwrap()))
}

struct Scene {
    mesh: Shared<Mesh>,
    visibility: Visibility,
    shading: ShadingImage,
}

fn scene(case: &FrameCase, viewpoint: Viewpoint) -> Scene {
    let mut query = case.question().shading;
    query.geometry.visibility.viewpoint = viewpoint;
    query.geometry.reach = Reach { everywhere: true, through: false };
    let visibility = (*Direct.ask(&query.geometry.visibility)).clone().unwrap();
    let shading = (*Direct.ask(&query)).clone().unwrap();
    Scene { mesh: (*Direct.ask(&case.mesh)).clone(), visibility, shading }
}

impl Scene {
    fn changes(&self) -> Vec<[f32; 3]> {
        changes(&self.mesh, &self.visibility, &self.shading, &Stop::NEVER).unwrap()
    }
}

#[test]
fn an_evenly_lit_plane_stays_as_it_is() {
    let case = FrameCase {
        mesh: MeshQuery::Plane,
        reading: Normalization::Lambertian,
        size: RasterSize::new(60, 60),
        ..FrameCase::new()
    };
    let scene = scene(&case, Viewpoint::new(0.4, 0.3, 0.1, 0.5).unwrap());
    let changes = scene.changes();
    assert!(changes.len() > 3000 && changes.as_flattened().iter().all(|change| change.abs() < 1e-6));
}

/// Integral of the normal density from a place on, by midpoints.
fn upper_tail(from: f64) -> f64 {
    let step = 0.01;
    let places = (0..1200).map(|k| from.max(-6.0) + step * (f64::from(k) + 0.5));
    places.map(|x| step * (-0.5 * x * x).exp()).sum::<f64>() / std::f64::consts::TAU.sqrt()
}

#[test]
fn at_a_shadows_edge_light_falls_as_the_integral_of_each_gaussian() {
    // 0.17 mm a sample, seen from the front.
    let case = FrameCase {
        mesh: half_in_shadow(),
        reading: Normalization::Lambertian,
        size: RasterSize::new(240, 60),
        angular_radius: 0.0,
        light_up: 0.0,
        light_right: 45.0,
        ..FrameCase::new()
    };
    let scene = scene(&case, Viewpoint::new(0.0, 0.0, 1.0, 0.007_f64.atan() * 2.0).unwrap());
    let (geometry, changes) = (scene.shading.geometry(), scene.changes());
    let hits = scene.visibility.hits();
    let full = 45_f64.to_radians().cos();
    let points = geometry.samples().iter().map(|&sample| {
        let hit = hits[sample as usize];
        let corners = scene.mesh.triangles()[hit.triangle as usize].map(|v| scene.mesh.positions()[v as usize]);
        corners.iter().zip(hit.barycentric()).map(|(&p, weight)| p * weight).sum::<Vec3>()
    });
    let places: Vec<Vec3> = points.collect();
    let lit = |at: usize| scene.shading.shades()[at].front > 0.0;
    let seen: Vec<usize> = (0..places.len()).filter(|&at| places[at].z == 0.0).collect();
    let edge = |ends: fn(f32, f32) -> f32, want: bool, start: f32| {
        f64::from(seen.iter().filter(|&&at| lit(at) == want).map(|&at| places[at].x).fold(start, ends))
    };
    let edge = f64::midpoint(edge(f32::max, true, -1.0), edge(f32::min, false, 1.0));
    let (mut checked, mut kept) = (0, [0.0_f64; 3]);
    for at in seen {
        let x = (f64::from(places[at].x) - edge) * 1e3;
        for k in 0..3 {
            let own = if lit(at) { full } else { 0.0 };
            // Lit where x < 0: the normal distribution's upper tail.
            let expected = full * upper_tail(x / SPREADS_MM[k]) - own;
            let found = f64::from(changes[at][k]);
            if places[at].x.abs() < 0.0085 {
                assert!(
                    (found - expected).abs() < 0.02 * full + 0.08 * full * 0.17 / SPREADS_MM[k],
                    "{k} at {x} mm: {found} {expected}"
                );
                checked += 1;
            }
            kept[k] += found;
        }
    }
    assert!(checked > 1000, "{checked}");
    let all = full * geometry.samples().len() as f64;
    assert!(kept.iter().all(|sum| (sum / all).abs() < 2e-3), "light is neither lost nor made: {kept:?} of {all}");
}

#[test]
fn past_the_terminator_skin_is_redder_and_other_scenes_have_no_part_of_it() {
    let case = FrameCase { light_right: -70.0, size: RasterSize::new(200, 200), sky: Some(0.0), ..FrameCase::new() };
    let mut query = case.question();
    let plain = (*Direct.ask(&query)).clone().unwrap().unwrap();
    query.shading.diffusion = true;
    let spread = (*Direct.ask(&query)).clone().unwrap().unwrap();
    let shading = Direct.ask(&query.shading);
    assert!((*shading).as_ref().unwrap().spread().is_some());
    let measure = Direct.ask(&query.image(&query.sources[2]).measure);
    let totals = (*measure).as_ref().unwrap().totals();
    let [plain, spread] = [&plain, &spread].map(|pictures| pictures.images[2].as_ref().unwrap());
    let mut gained = [0.0; 3];
    for (before, after) in plain.signals().iter().zip(spread.signals()) {
        assert!(after.iter().all(|&signal| signal > -1e-3), "{after:?}");
        if *before == [0.0; 3] {
            (0..3).for_each(|c| gained[c] += f64::from(after[c]) / totals[c]);
        }
    }
    assert!(gained[0] > 2.0 * gained[2] && gained[1] > gained[2] && gained[2] > 0.0, "{gained:?}");
}
