//! Normals that the file has, and those it lacks.

use super::{CUBE_FACES, area, cube_corners, read};
use chromascope_mesh::reading::{Normals, Note};
use glam::Vec3;

/// Two squares that meet along the y axis at an angle in degrees; 0 is plane.
fn folded(degrees: f64, smoothing: &str) -> String {
    let (sin, cos) = degrees.to_radians().sin_cos();
    format!(
        "v -1 0 0\nv 0 0 0\nv {cos} 0 {}\nv -1 1 0\nv 0 1 0\nv {cos} 1 {}\n{smoothing}f 1 2 5 4\nf 2 3 6 5\n",
        -sin, -sin
    )
}

#[test]
fn creases_above_sixty_degrees_are_kept_where_the_file_names_no_smoothing() {
    for (degrees, vertices) in [(0.0, 6), (59.0, 6), (61.0, 8), (170.0, 8)] {
        assert_eq!(read(&folded(degrees, "")).mesh.positions().len(), vertices, "{degrees}°");
    }
    let mesh = read(&folded(59.0, "")).mesh;
    let half = 29.5_f32.to_radians();
    let ridge = mesh.positions().iter().position(|p| p.x == 0.0).unwrap();
    assert!(mesh.normals()[ridge].distance(Vec3::new(half.sin(), 0.0, half.cos())) < 1e-6);
}

#[test]
fn smoothing_groups_decide_where_there_are_some() {
    for (degrees, smoothing, vertices) in
        [(120.0, "s 1\n", 6), (120.0, "s on\n", 6), (5.0, "s off\n", 8), (5.0, "s 0\n", 8)]
    {
        assert_eq!(read(&folded(degrees, smoothing)).mesh.positions().len(), vertices, "{smoothing}");
    }
    let two = folded(5.0, "").replace("f 1", "s 1\nf 1").replace("f 2", "s 2\nf 2");
    assert_eq!(read(&two).mesh.positions().len(), 8, "an edge between groups");
}

#[test]
fn a_smooth_cube_has_normals_along_its_diagonals() {
    let mesh = read(&format!("{}s 1\n{CUBE_FACES}", cube_corners())).mesh;
    assert_eq!(mesh.positions().len(), 8);
    for (position, normal) in mesh.positions().iter().zip(mesh.normals()) {
        assert!(normal.distance((position - Vec3::splat(0.5)).normalize()) < 1e-6);
    }
}

#[test]
fn vertices_are_split_where_normals_differ_and_only_there() {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    // The second normal repeats the first, as exporters that write one for each corner do.
    let normals = "vn 0 0 1\nvn 0 0 1\nvn 0 1 1\n";
    let same = read(&format!("{corners}{normals}f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"));
    assert_eq!(same.mesh.positions().len(), 4);
    let split = read(&format!("{corners}{normals}f 1//1 2//1 3//1\nf 1//3 3//2 4//2\n"));
    assert_eq!(split.mesh.positions().len(), 5);
    assert_eq!(split.report.boundary_edges, 4, "a split vertex opens no surface");
}

#[test]
fn missing_and_empty_normals_are_computed() {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let mixed = read(&format!("{corners}vn 1 0 0\nvn 0 0 0\nf 1//1 2 3//2 4//1\n"));
    assert_eq!(mixed.report.normals, Normals::Mixed { computed: 3 });
    assert!(mixed.report.notes().contains(&Note::NormalsMixed { corners: 3 }));
    assert_eq!(mixed.mesh.normals().iter().filter(|n| **n == Vec3::Z).count(), 2);
    assert_eq!(mixed.mesh.normals().iter().filter(|n| **n == Vec3::X).count(), 2);
    assert_eq!(area(&mixed), 1.0);
}

#[test]
fn normals_of_any_length_are_brought_to_one() {
    let read = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1e-30\nvn 1e12 0 0\nvn 3 4 0\nf 1//1 2//2 3//3\n");
    let expected = [Vec3::Z, Vec3::X, Vec3::new(0.6, 0.8, 0.0)];
    assert!(read.mesh.normals().iter().zip(expected).all(|(n, e)| n.distance(e) < 1e-6));
}

#[test]
fn normals_against_the_winding_are_reported() {
    let read = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n");
    assert_eq!(read.report.against_winding, 1);
    assert_eq!(read.mesh.normals(), [Vec3::NEG_Z; 3], "kept as the file has them");
}
