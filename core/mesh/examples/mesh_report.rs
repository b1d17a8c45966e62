//! Reads a mesh file and prints what was found in it.
//!
//! ```text
//! cargo run -p chromascope-mesh --example mesh_report -- head.obj
//! ```
#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "a program of its own")]

use chromascope_mesh::reading::read_mesh;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("the path of an OBJ, PLY or STL file is missing")?;
    let read = read_mesh(&std::fs::read(path)?, None, &|| false)?;
    println!("{}", read.report);
    for note in read.report.notes() {
        println!("{note}");
    }
    let bounds = read.mesh.bounds();
    println!("from {} to {}, radius {}", bounds.min, bounds.max, bounds.radius);
    for group in &read.groups {
        println!("group {}: {} triangles", group.name, group.triangles.len());
    }
    Ok(())
}
