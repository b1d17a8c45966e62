//! Meshes from bytes: what is read, how polygons are cut, where normals come from, what is refused and on which line.

mod formats;
mod hostile;
mod normals;
mod polygons;
mod refused;
mod speed;

use chromascope_mesh::reading::{MeshReadError, Normals, Note, Place, ReadMesh, Skipped, read_mesh};
use glam::Vec3;

/// Reads a text that is a mesh.
fn read(text: &str) -> ReadMesh {
    read_mesh(text.as_bytes(), Some("obj"), &|| false).unwrap()
}

/// Reads a text that is none.
fn error(text: &str) -> MeshReadError {
    read_mesh(text.as_bytes(), Some("obj"), &|| false).unwrap_err()
}

/// The area of all triangles.
fn area(read: &ReadMesh) -> f64 {
    let at = |i: u32| read.mesh.positions()[i as usize].as_dvec3();
    let double = |t: &[u32; 3]| (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).length();
    read.mesh.triangles().iter().map(double).sum::<f64>() / 2.0
}

/// The eight corners of a cube from 0 to 1, bit by bit: x, y, z.
fn cube_corners() -> String {
    (0..8).map(|i| format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1)).collect::<Vec<_>>().concat()
}

/// The six faces of that cube, seen from outside.
const CUBE_FACES: &str = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

/// Like the shared head: an object with quads, texture coordinates, normals, smoothing and two groups by material.
const HEAD_LIKE: &str = "# exported\nmtllib head.mtl\no head\n\
    v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 0\nv 1 1 0\nv 9 9 9\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 0.6 0.8\n\
    g skin\nusemtl Skin\ns 1\nf 1/1/1 2/2/1 5/3/2 4/4/2\n\
    g eyes\nusemtl Eye ball\nf 2//1 3//1 6//2 5//2\n";

/// Like the shared fern: cards of quads and triangles with texture coordinates and no normals, open on all sides.
const FERN_LIKE: &str = "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nv 0 2 0\r\n\
    vt 0 0\r\nvt 1 1\r\nusemtl leaf\r\nf 1/1 2/1 3/2 4/2\r\nf 4/1 3/2 5/2\r\n";

#[test]
fn a_head_of_quads_with_groups() {
    let read = read(HEAD_LIKE);
    let report = &read.report;
    assert_eq!((report.vertices, report.polygons, report.triangles), (7, 2, 4));
    assert_eq!(report.normals, Normals::Read);
    assert_eq!(report.unused_vertices, 1);
    assert_eq!(report.boundary_edges, 6);
    let groups: Vec<_> =
        read.groups.iter().map(|g| (g.name.as_str(), g.material.as_str(), g.triangles.clone())).collect();
    assert_eq!(groups, [("head / skin", "Skin", 0..2), ("head / eyes", "Eye ball", 2..4)]);
    assert_eq!(read.mesh.positions().len(), 6, "six corners, each with one normal");
    let upper = |p: &Vec3| p.y == 1.0;
    for (position, normal) in read.mesh.positions().iter().zip(read.mesh.normals()) {
        assert!(normal.distance(if upper(position) { Vec3::new(0.0, 0.6, 0.8) } else { Vec3::Z }) < 1e-6);
    }
    let skipped: Vec<_> = report.skipped.iter().map(|(what, tally)| (*what, tally.count, tally.first)).collect();
    let materials = (Skipped::Materials, 3, Some(Place::Line(2)));
    assert_eq!(skipped, [materials, (Skipped::Textures, 4, Some(Place::Line(11)))]);
}

#[test]
fn a_fern_of_cards() {
    let read = read(FERN_LIKE);
    assert_eq!((read.report.polygons, read.report.triangles, read.report.boundary_edges), (2, 3, 5));
    assert_eq!(read.report.normals, Normals::Computed);
    assert_eq!(read.mesh.normals(), [Vec3::Z; 5]);
    assert_eq!(area(&read), 1.5);
    assert_eq!((read.groups[0].material.as_str(), read.groups[0].triangles.clone()), ("leaf", 0..3));
}

#[test]
fn a_closed_cube_has_nothing_to_note_but_its_normals() {
    let read = read(&format!("{}{CUBE_FACES}", cube_corners()));
    assert_eq!(read.report.notes(), [Note::NormalsComputed]);
    assert_eq!((area(&read), read.mesh.triangles().len()), (6.0, 12));
    assert_eq!(read.mesh.positions().len(), 24, "each edge of 90° is kept");
    assert_eq!(read.report.to_string(), "OBJ: 8 vertices, 6 faces, 12 triangles");
}

#[test]
fn indices_counted_back_are_those_counted_from_the_start() {
    let back = "v 0 0 0\nv 1 0 0\nvn 0 0 1\nv 1 1 0\nf -3//-1 -2//1 -1//-1\nv 2 1 0\nf -3 -1 -2\n";
    let forth = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 2 4 3\n";
    assert_eq!(read(back).mesh, read(forth).mesh);
    // Faces may come before their vertices.
    let early = "f 1//1 2//1 3//1\nf 2 4 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 1 0\nvn 0 0 1\n";
    assert_eq!(read(early).mesh, read(forth).mesh);
}

#[test]
fn the_same_mesh_in_every_way_of_writing() {
    let plain = read("v 0 0 0\nv 1.5 0 0\nv 0 0.25 -100\nf 1 2 3\n").mesh;
    let ways = [
        "v 0 0 0\r\nv 1.5 0 0\r\nv 0 0.25 -100\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1.5 0 0\rv 0 0.25 -100\rf 1 2 3",
        "\u{feff}v 0 0 0\nv 1.5 0 0\nv 0 0.25 -100\nf 1 2 3",
        "# v 9 9 9 \\\nv 0 0 0 # origin\n\n\tv  15e-1 -0 +0.\n  v 0 .25 -1.0E+2\nf 1\t2 3 #4\n",
        "v 0 0\\\n 0\nv 1.5 0 0\nv 0 0.25 \\\r\n\\\r\n-100\nf 1 \\\n2 \\\n3",
        "v 0 0 0 1\nv 1.5 0 0 0.5 0.5 0.5\nv 0 0.25 -100 1 1 0 0\nf 1/1 2/ 3//\n",
        "v 0 0 0\nv 1.50000000000000000000000 0 0\nv 0 2500e-4 -0.000001e8\nf 1 2 3\n",
    ];
    for transform in ways {
        assert_eq!(read(transform).mesh, plain, "{transform:?}");
    }
}

#[test]
fn numbers_are_read_to_the_last_digit() {
    for text in ["0.1", "-123456.789", "3.4e-38", "16777217", "1e15", "0.30000001192092896", "1.4e-45"] {
        let mesh = read(&format!("v {text} 0 0\nv 0 {text} 0\nv 0 0 {text}\nf 1 2 3\n")).mesh;
        assert_eq!(mesh.positions()[0].x, text.parse::<f32>().unwrap(), "{text}");
    }
}

#[test]
fn groups_go_over_all_triangles() {
    let corners = cube_corners();
    let text = format!(
        "{corners}f 1 3 4 2\ng a b\nf 5 6 8 7\nusemtl m\ng empty\ng a b\nf 1 2 6 5\no other\nf 3 7 8 4\ng other\nf 1 5 7 3\n"
    );
    let groups = read(&text).groups;
    let names: Vec<_> = groups.iter().map(|g| (g.name.as_str(), g.material.as_str(), g.triangles.clone())).collect();
    let expected = [("", "", 0..2), ("a b", "", 2..4), ("a b", "m", 4..6), ("other", "m", 6..10)];
    assert_eq!(names, expected);
}

#[test]
fn what_is_wrong_with_a_mesh_is_reported_and_the_mesh_kept() {
    let corners = cube_corners();
    let report = |faces: &str| read(&format!("{corners}{faces}")).report;
    let degenerate = report("f 1 2 4\nf 1 1 2\nf 3 4 3\n");
    assert_eq!((degenerate.degenerate.count, degenerate.degenerate.first), (2, Some(Place::Line(10))));
    let fins = report("f 1 2 3\nf 2 1 5\nf 1 2 8\n");
    assert_eq!((fins.non_manifold_edges.count, fins.non_manifold_edges.first), (1, Some(Place::Line(9))));
    assert_eq!((fins.boundary_edges, fins.triangles), (6, 3));
    let double = report("f 1 2 3\nf 4 2 3\nf 3 1 2\n");
    assert_eq!((double.duplicates.count, double.duplicates.first), (1, Some(Place::Line(11))));
    assert_eq!(double.triangles, 3);
    let flipped = report("f 1 2 3\nf 2 3 4\n");
    assert_eq!((flipped.flipped.count, flipped.flipped.first), (1, Some(Place::Line(9))));
    let inwards: String = CUBE_FACES
        .lines()
        .map(|face| face[2..].split(' ').rev().fold("f".to_owned(), |face, corner| face + " " + corner) + "\n")
        .collect();
    assert_eq!(report(&inwards).notes(), [Note::InsideOut, Note::NormalsComputed]);
    let far = read("v 1e6 0 0\nv 1000010 0 0\nv 1e6 10 0\nf 1 2 3\n").report;
    assert!(far.far_from_origin && !degenerate.far_from_origin);
}

#[test]
fn statements_without_meaning_for_a_mesh_are_counted() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2\nl 2 3\ncstype bezier\nlod 1\nfoo\nf 1 2 3\nvp 1 2\n";
    let skipped = read(text).report.skipped;
    let found: Vec<_> = skipped.iter().map(|(what, tally)| (*what, tally.count, tally.first.unwrap())).collect();
    let expected = [
        (Skipped::Points, 1, Place::Line(4)),
        (Skipped::Lines, 2, Place::Line(5)),
        (Skipped::Curves, 2, Place::Line(7)),
        (Skipped::Display, 1, Place::Line(8)),
        (Skipped::Unknown, 1, Place::Line(9)),
    ];
    assert_eq!(found, expected);
}

#[test]
fn notes_are_lines_for_a_person() {
    let text = format!("{}f 1 2 4\nf 1 1 2\nl 1 2\n", cube_corners());
    let notes: Vec<_> = read(&text).report.notes().iter().map(ToString::to_string).collect();
    let expected = [
        "Triangles without area left out: 1, first at line 10",
        "No normals in the file; computed from the faces",
        "The surface is open: 3 edges have a triangle on one side only",
        "Vertices that no triangle uses: 5",
        "Skipped line statements: 1, first at line 11",
    ];
    assert_eq!(notes, expected);
}
