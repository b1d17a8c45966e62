//! Whatever the bytes: a sound mesh or an error, never a panic. The fuzz target `mesh` has the same entry point.

use super::formats::{binary_ply, binary_stl, text_ply, text_stl};
use super::{CUBE_FACES, FERN_LIKE, HEAD_LIKE, cube_corners};
use chromascope_mesh::reading::{ReadMesh, read_mesh};
use proptest::prelude::*;

/// Reads bytes under each extension, and checks what comes out.
fn check(bytes: &[u8]) {
    for hint in [None, Some("obj"), Some("stl"), Some("ply")] {
        if let Ok(read) = read_mesh(bytes, hint, &|| false) {
            assert_sound(&read);
            assert_eq!(read_mesh(bytes, hint, &|| false).as_ref(), Ok(&read));
        }
    }
}

/// That all numbers are finite, all indices in range and all groups in order.
fn assert_sound(read: &ReadMesh) {
    let mesh = &read.mesh;
    assert!(mesh.positions().iter().all(|p| p.is_finite()));
    assert!(mesh.normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    assert!(mesh.triangles().iter().flatten().all(|&i| (i as usize) < mesh.positions().len()));
    assert!(!mesh.triangles().is_empty() && mesh.triangles().len() == read.report.triangles);
    let mut end = 0;
    for group in &read.groups {
        assert!(group.triangles.start == end && group.triangles.end > end);
        end = group.triangles.end;
    }
    assert!(end == 0 || end == read.report.triangles);
    assert!(read.report.notes().iter().all(|note| !note.to_string().is_empty()));
}

/// A word of the kind that statements have, sane or not.
fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (-6_i32..12).prop_map(|i| i.to_string()),
        3 => (-4_i32..9, -4_i32..9).prop_map(|(a, b)| format!("{a}//{b}")),
        2 => (-1e3_f32..1e3).prop_map(|v| v.to_string()),
        1 => any::<f64>().prop_map(|v| format!("{v:e}")),
        1 => any::<i64>().prop_map(|v| v.to_string()),
        1 => "[-+0-9./eE\\\\#]{0,12}",
        1 => Just("\\\n".to_owned()),
    ]
}

/// A statement that may make sense.
fn line() -> impl Strategy<Value = String> {
    let keyword = prop_oneof![
        8 => Just("v"), 2 => Just("vn"), 8 => Just("f"), 1 => Just("s"), 1 => Just("g"), 1 => Just("usemtl"),
        1 => Just("vt"), 1 => Just("l"), 1 => Just(""),
    ];
    (keyword, prop::collection::vec(word(), 0..7), prop_oneof![4 => Just("\n"), 1 => Just("\r\n")])
        .prop_map(|(keyword, words, end)| format!("{keyword} {}{end}", words.join(" ")))
}

/// A statement that always makes sense in a file with twelve vertices and normals before it.
fn sane_line() -> impl Strategy<Value = String> {
    prop_oneof![
        prop::collection::vec(1..13, 3..9)
            .prop_map(|f| f.iter().fold("f".to_owned(), |s, i| format!("{s} {i}")) + "\n"),
        prop::collection::vec((1..13, 1..13), 3..6)
            .prop_map(|f| f.iter().fold("f".to_owned(), |s, (i, n)| format!("{s} {i}//{n}")) + "\n"),
        "(s (1|2|off)|g [ab]|o [cd]|usemtl [ef])\n",
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        check(&bytes);
    }

    #[test]
    fn any_statements(lines in prop::collection::vec(line(), 0..30)) {
        check(lines.concat().as_bytes());
    }

    #[test]
    fn any_faces_on_any_vertices(
        vertices in prop::collection::vec(prop::array::uniform3(-2_i32..3), 12),
        faces in prop::collection::vec(sane_line(), 1..30),
        scale in prop_oneof![Just(1.0), Just(1e-40), Just(1e14), Just(1e-20)],
    ) {
        let number = |v: i32| f64::from(v) * scale;
        let vertex = |v: &[i32; 3]| format!("v {} {} {}\n", number(v[0]), number(v[1]), number(v[2]));
        let mut text = vertices.iter().map(vertex).collect::<Vec<_>>().concat();
        text.extend(vertices.iter().map(|v| format!("vn {} {} {}\n", v[1], v[2], v[0])));
        text.extend(faces);
        check(text.as_bytes());
    }

    #[test]
    fn damaged_files(which in 0..8_usize, cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5)) {
        let mut bytes = match which {
            0 => HEAD_LIKE.as_bytes().to_vec(),
            1 => FERN_LIKE.as_bytes().to_vec(),
            2 => format!("{}{CUBE_FACES}", cube_corners()).into_bytes(),
            3 => text_ply().into_bytes(),
            4 => text_stl().into_bytes(),
            5 => binary_stl(),
            big => binary_ply(big == 6),
        };
        for (at, byte) in cuts {
            let at = at.index(bytes.len());
            match byte % 4 {
                0 => bytes[at] = byte,
                1 => bytes.truncate(at + 1),
                2 => bytes.insert(at, b"\\\n-/9 .#"[usize::from(byte >> 5)]),
                _ => drop(bytes.remove(at)),
            }
            if bytes.is_empty() {
                break;
            }
        }
        check(&bytes);
    }
}
