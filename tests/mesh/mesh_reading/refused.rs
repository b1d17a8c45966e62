//! Tests of rejected mesh files: the line and the remedy of each error.

use super::error;
use chromascope_mesh::reading::{Alien, MeshReadError, Place, Quantity, read_mesh};
use std::cell::Cell;
use std::fmt::Write;

/// Three vertices on lines 1 to 3.
const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";

/// The error of what follows the three vertices, from line 4 on.
fn after_corners(text: &str) -> MeshReadError {
    error(&format!("{CORNERS}{text}"))
}

#[test]
fn words_that_are_no_numbers() {
    for (text, line, column) in [
        ("v 0 x 0\n", 1, 5),
        ("v 0 0 0\nv 1,5 0 0\n", 2, 3),
        ("v 0 0 0\nv 0 \\\n  0 1.2.3\n", 3, 5),
        ("v 0 0 0\r\nvn 0 0 --1\r\n", 2, 8),
        ("v 1e 0 0\n", 1, 3),
        ("v 0 0 0\nv 0x10 0 0\n", 2, 3),
        ("v \u{b5} 0 0\n", 1, 3),
        ("s x\n", 1, 3),
    ] {
        assert_eq!(error(text), MeshReadError::Number { line, column }, "{text}");
    }
    assert_eq!(error("v 0 0\n"), MeshReadError::TooFewNumbers { line: 1, found: 2 });
    assert_eq!(after_corners("vn\n"), MeshReadError::TooFewNumbers { line: 4, found: 0 });
}

#[test]
fn numbers_beyond_all_bounds() {
    let place = Place::Line(4);
    for text in ["v NaN 0 0\n", "v 0 inf 0\n", "v 0 0 -infinity\n", "v 0 0 1e999\n", "vn 0 nan 0\n"] {
        assert_eq!(after_corners(text), MeshReadError::NotFinite(place), "{text}");
    }
    for text in ["v 1.0001e15 0 0\n", "v 0 -1e300 0\n", "v 0 0 99999999999999999999\n"] {
        assert_eq!(after_corners(text), MeshReadError::TooFar(place), "{text}");
    }
}

#[test]
fn corners_that_are_no_indices() {
    for (text, column) in [
        ("f 1 0 2\n", 5),
        ("f 1 2 x\n", 7),
        ("f 1 2 3x\n", 7),
        ("f 1 2 3//x\n", 7),
        ("f 1 2 3/1/1/1\n", 7),
        ("f 1.5 2 3\n", 3),
        ("f /1 2 3\n", 3),
        ("f 1 - 3\n", 5),
        ("f 1//0 2 3\n", 3),
    ] {
        assert_eq!(after_corners(text), MeshReadError::Index { line: 4, column }, "{text}");
    }
}

#[test]
fn vertices_and_normals_that_are_not_there() {
    let place = Place::Line(5);
    for (text, index, count) in [
        ("\nf 1 2 4\n", 4, 3),
        ("\nf 1 2 -4\nv 0 0 0\n", -4, 3),
        ("\nf 1 2 4294967296\n", 4_294_967_296, 3),
        ("\nf 1 2 -4294967296\n", -4_294_967_296, 3),
        ("\nf 1 2 99999999999999999999999\n", 100_000_000_000_000_000, 3),
    ] {
        assert_eq!(after_corners(text), MeshReadError::NoSuchVertex { place, index, count }, "{text}");
    }
    let normal = MeshReadError::NoSuchNormal { place, index: 2, count: 1 };
    assert_eq!(after_corners("vn 0 0 1\nf 1//1 2//2 3//1\n"), normal);
    assert_eq!(
        after_corners("vn 0 0 1\nf 1//1 2//-2 3//1\n"),
        MeshReadError::NoSuchNormal { place, index: -2, count: 1 }
    );
}

#[test]
fn faces_that_are_none() {
    let place = Place::Line(4);
    for (text, corners) in [("f\n", 0), ("f 1\n", 1), ("f 1 2\n", 2)] {
        assert_eq!(after_corners(text), MeshReadError::FaceTooShort { place, corners });
    }
    assert_eq!(after_corners("l 1 2\n"), MeshReadError::NoFaces(3));
    assert_eq!(after_corners("f 1 2 2\nf 1 1 1\n"), MeshReadError::NoArea { triangles: 2, place });
    let mut long: String = (0..5000).fold(String::new(), |mut text, i| {
        writeln!(text, "v {i} {} 0", i % 2).unwrap();
        text
    });
    long += "f";
    (1..=5000).for_each(|i| write!(long, " {i}").unwrap());
    let place = Place::Line(5001);
    assert_eq!(error(&long), MeshReadError::FaceTooLong { place, corners: 5000, limit: 4096 });
}

#[test]
fn files_of_other_kinds() {
    let alien = |bytes: &[u8], hint| read_mesh(bytes, hint, &|| false).unwrap_err();
    for (bytes, looks_like) in [
        (&b"glTF\x02\0\0\0"[..], Alien::Gltf),
        (b"{\"asset\": {}}", Alien::Gltf),
        (b"PK\x03\x04", Alien::Compressed),
        (b"\x1f\x8b\x08", Alien::Compressed),
        (b"<?xml version='1.0'?>", Alien::Xml),
        (b"OFF\n3 1 0\n", Alien::Off),
        (b"Kaydara FBX Binary  \0", Alien::Fbx),
        (b"\x7fELF\0\0\0", Alien::Binary),
        (b"wavelength,value\n400,1\n", Alien::Text),
    ] {
        assert_eq!(alien(bytes, None), MeshReadError::NotAMesh(looks_like));
    }
    for empty in [&b""[..], b" \r\n\t", b"\xEF\xBB\xBF\n"] {
        assert_eq!(alien(empty, Some("obj")), MeshReadError::Empty);
    }
    assert_eq!(alien(b"# nothing\n", Some("OBJ")), MeshReadError::NoFaces(0));
}

#[test]
fn more_triangles_than_are_held() {
    // One face of many corners, named again and again.
    let face = format!("f{}\n", " 1 2 3".repeat(40_000));
    let text = CORNERS.to_owned() + &face.repeat(90);
    let limit = chromascope_mesh::reading::MAX_TRIANGLES;
    let quantity = Quantity::Triangles;
    assert_eq!(error(&text), MeshReadError::TooLarge { quantity, limit, place: Place::Line(87) });
    let endless = format!("{CORNERS}f{}", " 1 2 3".repeat(limit + 1));
    assert_eq!(error(&endless), MeshReadError::TooLarge { quantity, limit, place: Place::Line(4) });
}

#[test]
fn stops_when_asked_at_any_time() {
    let side = 120_usize;
    let mut text = String::new();
    for i in 0..side * side {
        writeln!(text, "v {} {} {}", i % side, i / side, i % 7).unwrap();
    }
    for i in (0..side * (side - 1)).filter(|i| i % side != side - 1) {
        writeln!(text, "f {} {} {} {}", i + 1, i + 2, i + side + 2, i + side + 1).unwrap();
    }
    let asked = Cell::new(0_usize);
    let whole = read_mesh(text.as_bytes(), None, &|| {
        asked.set(asked.get() + 1);
        false
    });
    assert!(whole.is_ok() && asked.get() > 10, "asked {} times", asked.get());
    for last in 0..asked.get() {
        let left = Cell::new(last);
        let stop = || left.replace(left.get().saturating_sub(1)) == 0;
        assert_eq!(read_mesh(text.as_bytes(), None, &stop), Err(MeshReadError::Stopped), "at {last}");
    }
}

#[test]
fn every_message_names_the_place_and_the_remedy() {
    for (text, message) in [
        (
            "v 0 0 0\nv 1,5 0 0\n",
            "line 2, column 3: not a number; write numbers like 0.25 or 1e-3, with a decimal point",
        ),
        ("v 0 0 nan\n", "line 1: a coordinate is not finite; remove or repair that vertex"),
        ("v 1 1 1\nf 1 1\n", "line 2: a face of 2 corners; a face needs at least three, remove it"),
        ("v 1 1 1\nf 1 2 1\n", "line 2 names vertex 2, but there are 1; the file may be incomplete, export it again"),
    ] {
        assert_eq!(error(text).to_string(), message);
    }
}
