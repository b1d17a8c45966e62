//! Writes the clothed head as an OBJ file with normals.
//!
//! ```text
//! cargo run -p chromascope-mesh --example head_obj -- 100000 > head.obj
//! ```
#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "a program of its own")]

use chromascope_mesh::head::clothed;
use std::io::{BufWriter, Error, Write as _};

fn main() -> Result<(), Error> {
    let triangles = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(100_000);
    let mesh = clothed(triangles);
    let mut out = BufWriter::new(std::io::stdout().lock());
    for (p, n) in mesh.positions().iter().zip(mesh.normals()) {
        writeln!(out, "v {} {} {}\nvn {} {} {}", p.x, p.y, p.z, n.x, n.y, n.z)?;
    }
    for [a, b, c] in mesh.triangles().iter().map(|corners| corners.map(|v| v + 1)) {
        writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    out.flush()
}
