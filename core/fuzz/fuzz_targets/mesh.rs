//! Any bytes as a mesh, under each extension: a sound mesh or an error, never a panic.
#![no_main]

use chromascope_mesh::reading::read_mesh;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for hint in [None, Some("obj"), Some("ply"), Some("stl")] {
        if let Ok(read) = read_mesh(bytes, hint, &|| false) {
            let mesh = &read.mesh;
            assert_eq!(mesh.triangles().len(), read.report.triangles);
            assert!(mesh.positions().iter().chain(mesh.normals()).all(|v| v.is_finite()));
            assert!(mesh.triangles().iter().flatten().all(|&i| (i as usize) < mesh.positions().len()));
            assert!(read.groups.iter().all(|group| group.triangles.end <= mesh.triangles().len()));
        }
    }
});
