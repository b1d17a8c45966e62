//! That time goes with the size of the file, whatever its shape.

use super::read;
use std::fmt::Write;

/// A wheel of many triangles around one vertex, in one order or the other.
fn wheel(spokes: usize, backwards: bool) -> String {
    let mut text = "v 0 0 1\n".to_owned();
    for i in 0..spokes {
        let angle = std::f64::consts::TAU * i as f64 / spokes as f64;
        writeln!(text, "v {} {} 0", 1e3 * angle.cos(), 1e3 * angle.sin()).unwrap();
    }
    for i in 0..spokes {
        let i = if backwards { spokes - 1 - i } else { i };
        writeln!(text, "f 1 {} {}", i + 2, (i + 1) % spokes + 2).unwrap();
    }
    text
}

#[test]
fn a_vertex_of_very_many_triangles_is_one_vertex() {
    for backwards in [false, true] {
        let read = read(&wheel(60_000, backwards));
        assert_eq!(read.mesh.positions().len(), 60_001);
        assert!(read.mesh.normals()[0].z > 0.999);
    }
}
