//! Tests of visibility: the rasterizer against a plain ray caster.

use chromascope_core::render::{RasterSize, Stop, Visibility};
use chromascope_core::scene::Viewpoint;
use chromascope_mesh::{Mesh, shapes};
use glam::{DVec3, Vec3};

/// The nearest triangle along a ray, by Cramer's rule, with its distance: every triangle is tried.
fn cast(mesh: &Mesh, origin: DVec3, direction: DVec3) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for (id, triangle) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = triangle.map(|i| mesh.positions()[i as usize].as_dvec3());
        let (e1, e2) = (b - a, c - a);
        let p = direction.cross(e2);
        let det = e1.dot(p);
        if det == 0.0 {
            continue;
        }
        let s = origin - a;
        let u = s.dot(p) / det;
        let q = s.cross(e1);
        let (v, t) = (direction.dot(q) / det, e2.dot(q) / det);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && nearest.is_none_or(|(_, best)| t < best) {
            nearest = Some((id as u32, t));
        }
    }
    nearest
}

/// Triangles all over the place, without any order: a small generator's (Knuth's MMIX).
fn soup(count: usize, seed: u64) -> Mesh {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1_u64 << 24) as f32 - 0.5
    };
    let mut positions = Vec::new();
    for _ in 0..count {
        let center = Vec3::new(next(), next(), next());
        positions.extend((0..3).map(|_| center + 0.3 * Vec3::new(next(), next(), next())));
    }
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::with_smooth_normals(positions, triangles).unwrap()
}

fn seen(mesh: &Mesh, viewpoint: Viewpoint, size: RasterSize) -> Visibility {
    Visibility::new(mesh, viewpoint.eye(mesh.bounds()), size, &Stop::NEVER).unwrap()
}

#[test]
fn the_rasterizer_sees_what_rays_see() {
    let size = RasterSize::new(61, 47);
    for seed in 0..4 {
        let mesh = soup(300, seed);
        // From outside, from within, and with triangles behind the eye.
        for (yaw, distance, lens) in [(0.3, 3.0, 0.7), (2.0, 0.4, 1.2), (-1.0, 0.05, 2.0)] {
            let viewpoint = Viewpoint::new(yaw, 0.4, distance, lens).unwrap();
            let visibility = seen(&mesh, viewpoint, size);
            let eye = *visibility.eye();
            for (sample, hit) in visibility.hits().iter().enumerate() {
                let ray = visibility.rays().at(sample);
                let direction = eye.world_from_view * DVec3::new(ray.x, ray.y, -ray.z);
                let expected = cast(&mesh, eye.position, direction);
                match expected {
                    None => assert!(!hit.is_some(), "sample {sample}"),
                    Some((id, _)) if hit.triangle == id => {
                        let corners = mesh.triangles()[id as usize].map(|i| mesh.positions()[i as usize].as_dvec3());
                        let weights = hit.barycentric().map(f64::from);
                        let point: DVec3 = corners.iter().zip(weights).map(|(p, w)| *p * w).sum();
                        let off = (point - eye.position).cross(direction).length() / direction.length();
                        assert!(off < 1e-5, "sample {sample} is {off} off its ray");
                    }
                    Some((id, _)) => panic!("sample {sample}: {} instead of {id}", hit.triangle),
                }
            }
        }
    }
}

#[test]
fn a_closed_surface_has_no_cracks_and_no_sample_twice() {
    let mesh = shapes::sphere(200_000);
    let visibility = seen(&mesh, Viewpoint::new(0.7, 0.2, 5.0, 0.5).unwrap(), RasterSize::new(333, 301));
    let (columns, rows) = (333, 301);
    // A row of a sphere's picture is one run: a crack would be a hole in it.
    for row in 0..rows {
        let line = &visibility.hits()[row * columns..][..columns];
        let runs = (1..columns).filter(|&i| line[i].is_some() != line[i - 1].is_some()).count();
        assert!(runs <= 2, "row {row} has {runs} borders");
    }
    let count = visibility.hits().iter().filter(|hit| hit.is_some()).count() as f64;
    // The sphere's silhouette is a cone: its picture is a circle of tangent r/√(d² − r²), with d = 5 r.
    let tangent = 1.0 / 24.0_f64.sqrt();
    let pixels = f64::from(rows as u32) / (2.0 * 0.25_f64.tan());
    let expected = std::f64::consts::PI * (tangent * pixels).powi(2);
    assert!((count / expected - 1.0).abs() < 2e-3, "{count} samples, {expected} expected");
}

#[test]
fn samples_on_a_common_edge_belong_to_one_side() {
    // Two triangles whose common edge runs exactly through sample centers.
    let positions = vec![
        Vec3::new(-1.0, -1.0, 0.0),
        Vec3::new(1.0, -1.0, 0.0),
        Vec3::new(1.0, 1.0, 0.0),
        Vec3::new(-1.0, 1.0, 0.0),
    ];
    let mesh = Mesh::with_smooth_normals(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let visibility = seen(&mesh, Viewpoint::new(0.0, 0.0, 3.0, 0.4).unwrap(), RasterSize::new(64, 64));
    assert!(visibility.hits().iter().all(|hit| hit.is_some()));
    let upper = visibility.hits().iter().filter(|hit| hit.triangle == 1).count();
    assert_eq!(64 * 64 / 2, usize::midpoint(upper, 64 * 64 - upper), "all samples are of one or the other");
}

#[test]
fn one_thread_and_many_see_the_same() {
    let mesh = soup(2000, 9);
    let viewpoint = Viewpoint::new(0.3, 0.1, 2.5, 0.7).unwrap();
    let render = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| seen(&mesh, viewpoint, RasterSize { width: 200, height: 150, samples: 2 }))
    };
    assert_eq!(render(1), render(7));
}

#[test]
fn a_stopped_picture_is_none() {
    let mesh = soup(10, 1);
    let flag = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
    let eye = Viewpoint::new(0.0, 0.0, 3.0, 0.7).unwrap().eye(mesh.bounds());
    assert!(Visibility::new(&mesh, eye, RasterSize::new(8, 8), &Stop::at(flag)).is_none());
}

#[test]
fn from_within_a_mesh_each_sample_sees_what_a_ray_meets() {
    let ball = shapes::sphere(300);
    for (yaw, distance) in [(0.3, 0.9), (1.7, 0.4), (-2.0, 0.06)] {
        let visibility = seen(&ball, Viewpoint::new(yaw, 0.4, distance, 1.2).unwrap(), RasterSize::new(48, 40));
        let eye = visibility.eye();
        for (sample, hit) in visibility.hits().iter().enumerate() {
            let ray = visibility.rays().at(sample);
            let direction = eye.world_from_view * DVec3::new(ray.x, ray.y, -ray.z);
            let (triangle, _) = cast(&ball, eye.position, direction).expect("a ball is closed");
            assert!(hit.is_some(), "sample {sample} at {distance}");
            // On an edge either neighbor will do.
            let near =
                |t: u32| ball.triangles()[t as usize].iter().any(|v| ball.triangles()[triangle as usize].contains(v));
            assert!(hit.triangle == triangle || near(hit.triangle), "sample {sample} at {distance}");
        }
    }
}
