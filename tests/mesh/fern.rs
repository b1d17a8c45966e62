//! The procedural fern: how many triangles, that its parts are closed, that it is as large and tapers as it should.

use chromascope_mesh::Mesh;
use chromascope_mesh::fern::{Fern, fern};
use glam::Vec3;
use std::collections::BTreeMap;

const COUNTS: [usize; 8] = [2_000, 5_000, 12_000, 30_000, 70_000, 85_000, 200_000, 500_000];

/// A position that can be compared: closed parts share their edges' positions to the last bit.
fn key(p: Vec3) -> [u32; 3] {
    (p + 0.0).to_array().map(f32::to_bits)
}

fn corners(mesh: &Mesh, triangle: [u32; 3]) -> [Vec3; 3] {
    triangle.map(|i| mesh.positions()[i as usize])
}

/// Twice the area times the normal.
fn area([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

/// The parts that hang together by positions, each the indices of its triangles.
fn parts(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut of_position = BTreeMap::new();
    let mut parent: Vec<usize> = (0..mesh.triangles().len()).collect();
    let root = |parent: &mut Vec<usize>, mut i: usize| {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    };
    for (i, &triangle) in mesh.triangles().iter().enumerate() {
        for corner in corners(mesh, triangle) {
            let other = *of_position.entry(key(corner)).or_insert(i);
            let (a, b) = (root(&mut parent, i), root(&mut parent, other));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut parts: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for i in 0..parent.len() {
        parts.entry(root(&mut parent, i)).or_default().push(i);
    }
    parts.into_values().collect()
}

#[test]
fn the_number_of_triangles_is_about_what_was_asked() {
    for asked in COUNTS {
        let got = fern(asked).triangles().len();
        assert!(got * 4 >= asked * 3 && got * 4 <= asked * 5, "{asked}: {got}");
    }
    assert_eq!(fern(0), fern(2_000));
}

#[test]
fn all_is_finite_and_normals_agree_with_the_winding() {
    for asked in COUNTS {
        let mesh = fern(asked);
        assert!(mesh.positions().iter().all(|p| p.is_finite()));
        assert!(mesh.normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
        let (mut against, mut thin) = (0, 0);
        for &triangle in mesh.triangles() {
            let at = corners(&mesh, triangle);
            let normal = area(at);
            let longest = (0..3).map(|k| at[k].distance(at[(k + 1) % 3])).fold(0.0, f32::max);
            // An altitude below a thousandth of the longest edge.
            thin += usize::from(normal.length() <= 1e-3 * longest * longest);
            against += triangle.iter().filter(|&&i| mesh.normals()[i as usize].dot(normal) <= 0.0).count();
        }
        assert!(against * 2_000 <= mesh.triangles().len(), "{asked}: {against} normals against the winding");
        assert!(thin * 500 <= mesh.triangles().len(), "{asked}: {thin} triangles without area");
    }
}

#[test]
fn every_part_is_closed() {
    for asked in [2_000, 30_000, 120_000] {
        let mesh = fern(asked);
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        for &triangle in mesh.triangles() {
            let at = corners(&mesh, triangle).map(key);
            for k in 0..3 {
                let (a, b) = (at[k], at[(k + 1) % 3]);
                *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
            }
        }
        assert!(edges.values().all(|&sum| sum == 0), "{asked}");
    }
}

#[test]
fn every_leaf_has_two_sides() {
    let mesh = fern(100_000);
    let all = parts(&mesh);
    assert!(all.len() > 5_000, "{}", all.len());
    for part in &all {
        let areas: Vec<Vec3> = part.iter().map(|&i| area(corners(&mesh, mesh.triangles()[i]))).collect();
        let (sum, total): (Vec3, f32) = (areas.iter().sum(), areas.iter().map(|a| a.length()).sum());
        assert!(sum.length() < 1e-2 * total, "{sum} of {total}");
        // The signed volume: positive where the surface looks outwards.
        let origin = corners(&mesh, mesh.triangles()[part[0]])[0];
        let volume: f32 = part
            .iter()
            .map(|&i| corners(&mesh, mesh.triangles()[i]).map(|p| p - origin))
            .map(|[a, b, c]| a.cross(b).dot(c))
            .sum();
        assert!(volume > 0.0, "inside out: {volume}");
    }
}

#[test]
fn the_size_does_not_depend_on_the_number_of_triangles() {
    for asked in COUNTS {
        let bounds = fern(asked).bounds();
        let size = bounds.max - bounds.min;
        assert!(bounds.center().length() < 1e-4);
        assert!((0.42..0.58).contains(&size.y), "{asked}: {size}");
        assert!((0.70..0.95).contains(&size.x) && (0.70..0.95).contains(&size.z), "{asked}: {size}");
    }
}

#[test]
fn pinnae_are_shorter_at_the_tip() {
    // So few triangles that each pinna is one part.
    let mesh = Fern { fronds: 1, fiddleheads: 0, ..Fern::default() }.mesh(4_000);
    let foot = mesh.positions().iter().copied().min_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
    let mut pinnae: Vec<(f32, f32)> = parts(&mesh)
        .iter()
        .map(|part| {
            let points: Vec<Vec3> = part.iter().flat_map(|&i| corners(&mesh, mesh.triangles()[i])).collect();
            let near = points.iter().map(|p| p.distance(foot)).fold(f32::INFINITY, f32::min);
            let long = points.iter().map(|p| p.distance(points[0])).fold(0.0, f32::max);
            (near, long)
        })
        .filter(|&(near, long)| near > 0.08 && long < 0.3)
        .collect();
    pinnae.sort_by(|a, b| a.0.total_cmp(&b.0));
    let n = pinnae.len();
    assert!(n > 30, "{n}");
    let mean = |from: usize, to: usize| pinnae[from..to].iter().map(|p| p.1).sum::<f32>() / (to - from) as f32;
    let (low, third, tip) = (mean(0, 4), mean(n / 4, n / 2), mean(n - 8, n));
    assert!(tip < 0.35 * third && low < 0.85 * third, "{low} {third} {tip}");
    assert!((0.08..0.16).contains(&third), "{third}");
}

#[test]
fn the_same_fern_twice_and_another_by_another_seed() {
    assert_eq!(fern(20_000), fern(20_000));
    let other = Fern { seed: 1, ..Fern::default() };
    assert_ne!(other.mesh(20_000), fern(20_000));
}

#[test]
fn any_parameters_make_a_mesh() {
    for extreme in [0, 1, u32::MAX] {
        let fern = Fern { fronds: extreme, fiddleheads: extreme, frond_mm: extreme, seed: extreme };
        let mesh = fern.mesh(if extreme == 1 { 300_000 } else { 0 });
        assert!(mesh.normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    }
}
