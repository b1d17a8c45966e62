//! Polygons of any shape, cut into triangles.

use super::{area, read};
use chromascope_mesh::reading::{Note, Place, ReadMesh};
use glam::{DMat3, DVec2, DVec3};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::fmt::Write;

/// A polygon in a plane that stands aslant in space, as a file.
fn file(points: &[DVec2]) -> String {
    let turn = DMat3::from_rotation_y(0.7) * DMat3::from_rotation_x(-1.1);
    let mut text = String::new();
    let mut face = "f".to_owned();
    for (i, p) in points.iter().enumerate() {
        let v = turn * DVec3::new(p.x, p.y, 0.3);
        writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
        write!(face, " {}", i + 1).unwrap();
    }
    text + &face + "\n"
}

/// The area inside a polygon that does not cross itself.
fn enclosed(points: &[DVec2]) -> f64 {
    let n = points.len();
    (0..n).map(|i| points[i].perp_dot(points[(i + 1) % n])).sum::<f64>().abs() / 2.0
}

/// That the triangles of a polygon cover it once, all facing one way.
fn assert_covered(points: &[DVec2]) -> ReadMesh {
    let read = read(&file(points));
    assert_eq!(read.report.crossing.count, 0, "{points:?}");
    assert_eq!(read.report.degenerate.count, 0, "{points:?}");
    assert_eq!(read.mesh.triangles().len(), points.len() - 2);
    assert_eq!((read.report.flipped.count, read.report.non_manifold_edges.count), (0, 0));
    let expected = enclosed(points);
    assert!((area(&read) - expected).abs() < 1e-5 * expected, "{} for {expected}: {points:?}", area(&read));
    read
}

/// Points of a list of pairs.
fn points(pairs: &[[i32; 2]]) -> Vec<DVec2> {
    pairs.iter().map(|&[x, y]| DVec2::new(f64::from(x), f64::from(y))).collect()
}

#[test]
fn concave_polygons_keep_their_area() {
    let shapes: [&[[i32; 2]]; 6] = [
        // An arrow head, at each of its corners in turn.
        &[[0, 0], [4, 0], [1, 1], [0, 4]],
        &[[1, 1], [0, 4], [0, 0], [4, 0]],
        // An L, a U and a comb.
        &[[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]],
        &[[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]],
        &[[0, 0], [7, 0], [7, 5], [6, 1], [5, 5], [4, 1], [3, 5], [2, 1], [1, 5]],
        // A square with a corner in the middle of each side.
        &[[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]],
    ];
    for shape in shapes {
        let mut shape = points(shape);
        assert_covered(&shape);
        shape.reverse();
        assert_covered(&shape);
    }
}

#[test]
fn a_polygon_with_a_bridge_to_its_hole_keeps_its_area() {
    let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\nf 1 2 3 4 1 5 8 7 6 5\n";
    let read = read(text);
    assert_eq!((area(&read), read.report.crossing.count), (12.0, 0));
}

#[test]
fn quads_are_cut_along_the_shorter_diagonal_inside() {
    let shorter = read("v 0 0 0\nv 3 1 0\nv 4 4 0\nv 1 3 0\nf 1 2 3 4\n");
    assert!(shorter.mesh.triangles().iter().all(|t| {
        let ends = t.map(|i| shorter.mesh.positions()[i as usize].to_array());
        ends.contains(&[3.0, 1.0, 0.0]) && ends.contains(&[1.0, 3.0, 0.0])
    }));
    let grid = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n";
    assert_eq!(read(grid).mesh.triangles(), [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]]);
}

#[test]
fn polygons_that_cross_themselves_are_cut_and_reported() {
    let bow_tie = read("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\n");
    assert_eq!(bow_tie.report.notes()[0], Note::Crossing { count: 1, first: Place::Line(5) });
    let star: Vec<DVec2> = (0..5).map(|i| DVec2::from_angle(TAU * 2.0 * f64::from(i) / 5.0)).collect();
    assert_eq!(read(&file(&star)).report.crossing.count, 1, "goes around twice, and turns to the left all along");
}

#[test]
fn a_corner_named_twice_in_a_row_is_one() {
    let read = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 2 3\nf 1 2 3 1\n");
    assert_eq!((read.mesh.triangles().len(), read.report.degenerate.count), (2, 0));
}

#[test]
fn long_concave_polygons_are_cut_in_time() {
    // A spiral, whose every corner has many others near.
    let turn = |i: u32, r: f64| DVec2::from_angle(TAU * f64::from(i) / 64.0) * (f64::from(i) + 60.0 + r);
    let spiral: Vec<DVec2> = (0..2048).map(|i| turn(i, 0.0)).chain((0..2048).rev().map(|i| turn(i, 20.0))).collect();
    assert_covered(&spiral);
    // A comb, whose teeth are cut one after the other.
    let tooth = |i: u32| DVec2::new(f64::from(i), if i.is_multiple_of(2) { 1000.0 } else { 100.0 });
    let comb: Vec<DVec2> =
        [DVec2::new(0.0, 0.0), DVec2::new(4093.0, 0.0)].into_iter().chain((0..4094).rev().map(tooth)).collect();
    assert_covered(&comb);
}

proptest! {
    #[test]
    fn polygons_around_a_point_keep_their_area(radii in prop::collection::vec(0.1_f64..10.0, 5..60)) {
        let n = radii.len();
        let points: Vec<DVec2> =
            radii.iter().enumerate().map(|(i, r)| DVec2::from_angle(TAU * i as f64 / n as f64) * *r).collect();
        assert_covered(&points);
    }

    #[test]
    fn any_polygon_is_cut(corners in prop::collection::vec((-9_i32..9, -9_i32..9), 3..40)) {
        let points: Vec<DVec2> = corners.iter().map(|&(x, y)| DVec2::new(f64::from(x), f64::from(y))).collect();
        if let Ok(read) = chromascope_mesh::reading::read_mesh(file(&points).as_bytes(), None, &|| false) {
            prop_assert!(read.mesh.triangles().len() <= points.len() - 2);
        }
    }
}
