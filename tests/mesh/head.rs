//! The procedural head: how many triangles, that it is watertight, symmetric, smooth and of human proportions.

use chromascope_mesh::Mesh;
use chromascope_mesh::head::{Head, head};
use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

const COUNTS: [usize; 6] = [2_000, 3_500, 6_000, 12_000, 25_000, 60_000];

/// The corners of all triangles.
fn corners(mesh: &Mesh) -> impl Iterator<Item = [Vec3; 3]> {
    mesh.triangles().iter().map(|t| t.map(|i| mesh.positions()[i as usize]))
}

/// The enclosed volume in cubic meters.
fn volume(mesh: &Mesh) -> f64 {
    corners(mesh).map(|t| t.map(Vec3::as_dvec3)).map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum()
}

/// The largest coordinate along a direction among the vertices of a region.
fn extreme(mesh: &Mesh, direction: Vec3, region: impl Fn(Vec3) -> bool) -> f32 {
    let within = mesh.positions().iter().filter(|p| region(**p));
    within.map(|p| p.dot(direction)).fold(f32::NEG_INFINITY, f32::max)
}

#[test]
fn the_number_of_triangles_is_about_what_was_asked() {
    for asked in COUNTS.into_iter().chain([200_000]) {
        let got = head(asked).triangles().len();
        assert!(got * 4 >= asked * 3 && got * 4 <= asked * 5, "{asked}: {got}");
    }
    assert_eq!(head(0), head(2_000));
}

#[test]
fn it_is_watertight_and_faces_outward() {
    for asked in COUNTS {
        let mesh = head(asked);
        let mut edges: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
        for &[a, b, c] in mesh.triangles() {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                edges.entry([from.min(to), from.max(to)]).or_default()[usize::from(from < to)] += 1;
            }
        }
        assert!(edges.values().all(|uses| *uses == [1, 1]), "{asked}");
        assert!(volume(&mesh) > 0.0, "{asked}");
    }
}

#[test]
fn normals_agree_with_the_winding() {
    for asked in COUNTS {
        let mesh = head(asked);
        let mut against = 0;
        for (triangle, [a, b, c]) in mesh.triangles().iter().zip(corners(&mesh)) {
            let normal = (b - a).cross(c - a);
            let mean: Vec3 = triangle.iter().map(|&i| mesh.normals()[i as usize]).sum();
            against += usize::from(normal.dot(mean) <= 0.0);
        }
        // Triangles across the slit of the mouth or under the rim of an ear may, where the mesh is coarse.
        assert!(against * 100 <= mesh.triangles().len(), "{asked}: {against}");
    }
}

#[test]
fn the_halves_are_mirror_images() {
    let mesh = head(20_000);
    let key = |p: Vec3| (p + 0.0).to_array().map(f32::to_bits);
    let normals: BTreeMap<_, _> = mesh.positions().iter().map(|p| key(*p)).zip(mesh.normals()).collect();
    let mirror = Vec3::new(-1.0, 1.0, 1.0);
    for (p, n) in mesh.positions().iter().zip(mesh.normals()) {
        assert_eq!(normals.get(&key(*p * mirror)), Some(&&(*n * mirror)), "{p}");
    }
}

#[test]
fn vertices_lie_on_the_surface() {
    // The same surface, so finely that its triangles are within some hundredths of a millimeter of it.
    let fine = head(150_000);
    let cell = |p: Vec3| (p / 0.004).floor().to_array().map(|v| v as i32);
    let mut near: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
    for (i, p) in fine.positions().iter().enumerate() {
        near.entry(cell(*p)).or_default().push(i);
    }
    let coarse = head(10_000);
    let distances = coarse.positions().iter().map(|&p| {
        let [x, y, z] = cell(p);
        let around = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [x + i, y + j, z + k])));
        let candidates = around.filter_map(|c| near.get(&c)).flatten();
        let plane = |&i: &usize| (p - fine.positions()[i]).dot(fine.normals()[i]).abs();
        let distance = |&i: &usize| p.distance_squared(fine.positions()[i]);
        candidates.min_by(|a, b| distance(a).total_cmp(&distance(b))).map_or(f32::INFINITY, plane)
    });
    let mut distances: Vec<f32> = distances.collect();
    distances.sort_by(f32::total_cmp);
    let share = |s: f32| distances[(s * (distances.len() - 1) as f32) as usize];
    assert!(share(0.5) < 3e-5 && share(0.95) < 5e-4, "{} {}", share(0.5), share(0.95));
}

#[test]
fn proportions_are_human() {
    let mesh = head(50_000);
    let bounds = mesh.bounds();
    assert!(bounds.center().length() < 2e-3, "{}", bounds.center());
    let crown = bounds.max.y;
    let chin = -extreme(&mesh, Vec3::NEG_Y, |p| p.z > 0.075);
    let tall = crown - chin;
    assert!((0.20..0.25).contains(&tall), "{tall}");
    // Above the ears.
    let wide = 2.0 * extreme(&mesh, Vec3::X, |p| p.y > crown - 0.08);
    let with_ears = 2.0 * bounds.max.x;
    assert!((0.60..0.75).contains(&(wide / tall)), "{}", wide / tall);
    assert!((1.05..1.30).contains(&(with_ears / wide)), "{}", with_ears / wide);
    let nose = extreme(&mesh, Vec3::Z, |p| p.x.abs() < 0.02);
    let forehead = extreme(&mesh, Vec3::Z, |p| p.y > crown - 0.08);
    let back = -extreme(&mesh, Vec3::NEG_Z, |p| p.y > chin);
    assert!((0.80..0.95).contains(&((forehead - back) / tall)), "{}", (forehead - back) / tall);
    assert!((0.008..0.035).contains(&(nose - forehead)), "{}", nose - forehead);
}

#[test]
fn finer_meshes_converge() {
    let volumes = [5_000, 15_000, 45_000, 135_000].map(|n| volume(&head(n)));
    let errors: Vec<f64> = volumes[..3].iter().map(|v| (v / volumes[3] - 1.0).abs()).collect();
    assert!(errors[0] < 2e-2 && errors[1] < 5e-3 && errors[2] < 1.5e-3, "{errors:?}");
    assert!(errors[2] < errors[1] && errors[1] < errors[0], "{errors:?}");
    // Liters: of a head with its neck.
    assert!((0.004..0.006).contains(&volumes[3]), "{}", volumes[3]);
}

#[test]
fn the_same_head_twice_for_any_number_of_threads() {
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| head(30_000));
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap().install(|| head(30_000));
    assert_eq!(alone, three);
    assert_eq!(alone, head(30_000));
}

#[test]
fn parameters_scale_and_widen_it() {
    let usual = head(8_000);
    let small = Head { size_m: 0.115, ..Head::default() }.mesh(8_000);
    assert_eq!(usual.triangles().len(), small.triangles().len());
    let ratio = small.bounds().max.y / usual.bounds().max.y;
    assert!((ratio - 0.5).abs() < 1e-3, "{ratio}");
    let jaw = |mesh: &Mesh| extreme(mesh, Vec3::X, |p| (-0.06..-0.03).contains(&p.y) && p.z > 0.03);
    let square = Head { jaw: 1.2, ..Head::default() }.mesh(8_000);
    assert!((1.1..1.25).contains(&(jaw(&square) / jaw(&usual))), "{}", jaw(&square) / jaw(&usual));
    for extreme in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e30] {
        let mesh = Head { size_m: extreme, jaw: extreme }.mesh(4_000);
        assert!(mesh.positions().iter().all(|p| p.is_finite()) && volume(&mesh) > 0.0, "{extreme}");
        assert!(mesh.normals().iter().all(|n| (n.as_dvec3().distance(DVec3::ZERO) - 1.0).abs() < 1e-5));
    }
}
