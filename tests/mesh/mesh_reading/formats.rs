//! PLY and STL, as text and binary, beside the same mesh as OBJ; and what is refused in them.

use super::{CUBE_FACES, area, cube_corners, read};
use chromascope_mesh::reading::{Kind, MeshReadError, Normals, Note, Place, ReadMesh, Skipped, read_mesh};
use glam::Vec3;
use std::fmt::Write;

/// Reads bytes without the help of an extension.
fn open(bytes: &[u8]) -> Result<ReadMesh, MeshReadError> {
    read_mesh(bytes, None, &|| false)
}

/// The cube as OBJ.
fn cube() -> ReadMesh {
    read(&format!("{}{CUBE_FACES}", cube_corners()))
}

/// The corners of all triangles of a mesh.
fn facets(mesh: &ReadMesh) -> Vec<[Vec3; 3]> {
    mesh.mesh.triangles().iter().map(|t| t.map(|i| mesh.mesh.positions()[i as usize])).collect()
}

/// The cube as binary STL.
pub(super) fn binary_stl() -> Vec<u8> {
    let facets = facets(&cube());
    let mut bytes = b"solid, or so it says".to_vec();
    bytes.resize(80, 0);
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0; 12]);
        bytes.extend(facet.iter().flat_map(Vec3::to_array).flat_map(f32::to_le_bytes));
        bytes.extend([7, 7]);
    }
    bytes
}

/// The cube as text STL.
pub(super) fn text_stl() -> String {
    let mut text = "solid a cube\n".to_owned();
    for facet in facets(&cube()) {
        text += "  facet normal 0 0 0\n    OUTER LOOP\n";
        for p in facet {
            writeln!(text, "      vertex {:e} {} {}", p.x, p.y, p.z).unwrap();
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid a cube\n"
}

/// The header of the cube as PLY.
fn ply_header(format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment made in C:\\\nelement vertex 8\nproperty float x\nproperty double y\n\
         property short z\nproperty uchar red\nelement edge 1\nproperty int from\nproperty list uchar int more\n\
         element face 6\nproperty list uchar uint vertex_indices\nend_header\n"
    )
}

/// The cube's faces by indices from 0.
fn ply_faces() -> Vec<Vec<u32>> {
    let index = |word: &str| word.parse::<u32>().unwrap() - 1;
    CUBE_FACES.lines().map(|line| line[2..].split(' ').map(index).collect()).collect()
}

/// The cube as text PLY.
pub(super) fn text_ply() -> String {
    let mut text = ply_header("ascii");
    (0..8).for_each(|i| writeln!(text, "{} {} {} 255", i & 1, i >> 1 & 1, i >> 2 & 1).unwrap());
    text += "0 2 5 6\n";
    for face in ply_faces() {
        writeln!(text, "4 {}", face.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")).unwrap();
    }
    text
}

/// The cube as binary PLY, greatest byte first or last.
pub(super) fn binary_ply(big: bool) -> Vec<u8> {
    fn turn<const N: usize>(big: bool, mut bytes: [u8; N]) -> [u8; N] {
        if big {
            bytes.reverse();
        }
        bytes
    }
    let mut bytes = ply_header(if big { "binary_big_endian" } else { "binary_little_endian" }).into_bytes();
    for i in 0..8_u8 {
        bytes.extend(turn(big, f32::from(i & 1).to_le_bytes()));
        bytes.extend(turn(big, f64::from(i >> 1 & 1).to_le_bytes()));
        bytes.extend(turn(big, i16::from(i >> 2 & 1).to_le_bytes()));
        bytes.push(255);
    }
    bytes.extend(turn(big, 3_i32.to_le_bytes()));
    bytes.push(0);
    for face in ply_faces() {
        bytes.push(4);
        bytes.extend(face.iter().flat_map(|i| turn(big, i.to_le_bytes())));
    }
    bytes
}

#[test]
fn the_same_cube_in_every_format() {
    let plain = cube();
    for (bytes, kind) in [
        (text_ply().into_bytes(), Kind::Ply),
        (text_ply().replace('\n', "\r\n").into_bytes(), Kind::Ply),
        (binary_ply(false), Kind::Ply),
        (binary_ply(true), Kind::Ply),
        (text_stl().into_bytes(), Kind::Stl),
        (binary_stl(), Kind::Stl),
    ] {
        let read = open(&bytes).unwrap();
        assert_eq!(read.report.kind, kind);
        assert_eq!(facets(&read), facets(&plain));
        assert_eq!((read.report.vertices, read.mesh.positions().len(), area(&read)), (8, 24, 6.0));
        assert_eq!(read.report.notes()[0], Note::NormalsComputed, "closed, and nothing else amiss");
    }
    let skipped = open(&binary_ply(true)).unwrap().report.skipped;
    let found: Vec<_> = skipped.iter().map(|(what, tally)| (*what, tally.count, tally.first.unwrap())).collect();
    assert_eq!(found, [(Skipped::VertexColors, 8, Place::Vertex(1)), (Skipped::Elements, 1, Place::Face(1))]);
    assert_eq!(open(text_stl().as_bytes()).unwrap().groups[0].name, "a cube");
}

#[test]
fn normals_of_ply_vertices_are_kept() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 3\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float x\nproperty float y\nproperty float z\n\
        end_header\n3 0 1 2\n0 0 1 0 0 0\n0 0 2 1 0 0\n1 0 0 0 1 0\n";
    let read = open(text.as_bytes()).unwrap();
    assert_eq!((read.report.normals, read.mesh.normals()), (Normals::Read, &[Vec3::Z, Vec3::Z, Vec3::X][..]));
}

#[test]
fn what_is_wrong_in_a_ply_file() {
    let line = |text: String| open(text.as_bytes()).unwrap_err();
    let text = text_ply();
    // The header has 14 lines, the vertices begin on line 15, the faces on line 24.
    let syntax = |line| MeshReadError::Syntax(Place::Line(line));
    assert_eq!(line(text.replace("ascii", "html")), syntax(2));
    assert_eq!(line(text.replace("property short z", "property short w")), syntax(4));
    assert_eq!(line(text.replace("property short z", "property shirt z")), syntax(7));
    assert_eq!(line(text.replace("vertex_indices", "corners")), syntax(12));
    assert_eq!(line(text.replace("vertex 8", "vertex many")), syntax(4));
    assert_eq!(line(text.replace("end_header\n", "")), syntax(14));
    assert_eq!(line(text.replace("1 0 0 255", "1 0 x 255")), MeshReadError::Number { line: 16, column: 5 });
    assert_eq!(line(text.replace("1 0 0 255", "1 0")), MeshReadError::TooFewNumbers { line: 16, found: 2 });
    assert_eq!(line(text.replace("1 0 0 255", "1 nan 0 255")), MeshReadError::NotFinite(Place::Line(16)));
    let place = Place::Line(24);
    let missing = |index| MeshReadError::NoSuchVertex { place, index, count: 8 };
    assert_eq!(line(text.replace("4 0 2 3 1", "4 0 2 3 8")), missing(8));
    assert_eq!(line(text.replace("4 0 2 3 1", "4 0 2 3 -1")), missing(-1));
    assert_eq!(line(text.replace("4 0 2 3 1", "2 0 2")), MeshReadError::FaceTooShort { place, corners: 2 });
    assert_eq!(line(text.replace("4 0 2 3 1", "-4 0 2")), MeshReadError::Syntax(place));
    assert_eq!(
        line(text.replace("face 6", "face 9")),
        MeshReadError::Truncated { place: Place::Face(7), announced: 9 }
    );
    let binary = binary_ply(false);
    let cut = open(&binary[..binary.len() - 1]).unwrap_err();
    assert_eq!(cut, MeshReadError::Truncated { place: Place::Face(6), announced: 6 });
    assert_eq!(cut.to_string(), "the file ends at face 6 of 6; it was not copied whole, get it again");
    let endless = text.replace("uchar uint vertex", "uint uint vertex").replace("4 0 2 3 1", "4000000000 0 2 3 1");
    assert!(matches!(line(endless), MeshReadError::TooLarge { place: Place::Line(24), .. }));
    let cloud = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    assert_eq!(line(cloud.to_owned()), MeshReadError::NoFaces(1));
}

#[test]
fn what_is_wrong_in_an_stl_file() {
    let line = |text: String| open(text.as_bytes()).unwrap_err();
    let text = text_stl();
    assert_eq!(
        line(text.replacen("vertex 0e0 0 0", "vertex 0e0 0", 1)),
        MeshReadError::TooFewNumbers { line: 4, found: 2 }
    );
    assert_eq!(
        line(text.replacen("vertex 0e0 0 0", "vertex 0e0 0 O", 1)),
        MeshReadError::Number { line: 4, column: 20 }
    );
    assert_eq!(line(text.replacen("endfacet", "", 1)), MeshReadError::Unfinished(2));
    assert_eq!(
        line(text.replacen("outer", "inner", 1).replacen("OUTER", "inner", 1)),
        MeshReadError::Syntax(Place::Line(3))
    );
    assert_eq!(line(text[..text.len() - 60].to_owned()), MeshReadError::Unfinished(79));
    assert_eq!(line(text.replacen("vertex", "remark", 1)), MeshReadError::Syntax(Place::Line(4)));
    let mut binary = binary_stl();
    let cut = read_mesh(&binary[..binary.len() - 1], Some("STL"), &|| false).unwrap_err();
    assert_eq!(cut, MeshReadError::Truncated { place: Place::Face(12), announced: 12 });
    binary[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(open(&binary).unwrap_err(), MeshReadError::NotFinite(Place::Face(2)));
}
