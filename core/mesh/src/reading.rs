//! Meshes from files: bytes in, a mesh out, with its groups and a report of what was found and tolerated.
//!
//! [`read_mesh`] takes the bytes of a Wavefront OBJ, Stanford PLY or STL file, the latter two as text or binary.
//! Coordinates are not converted: neither the unit nor the up axis is guessed.
//!
//! Pipeline of a file: `sniff` (detects the format), `obj`, `ply` or `stl` (to vertices, normals and polygons, the shared
//! `soup`; STL's corners are welded where they are equal), `triangulate` (polygons of any shape to triangles), `edges`
//! (open, doubled or flipped edges, and corners that share a normal), `build` (vertices split where normals differ,
//! missing normals computed).
//!
//! Normals: those of the file where it has them. Missing ones are the mean of the faces around a vertex, by angle, going
//! over an edge only where both faces are of one smoothing group (`s 1`), or where the file names no smoothing at
//! all and the faces meet at less than 60°; `s off` gives each face its own.
//!
//! Reading is total: it does not panic, takes time about proportional to the input (a concave polygon: to the square of its
//! corners, a few times over), and needs about 150 bytes for each triangle beside the file's own. The limits are
//! [`MAX_BYTES`], [`MAX_VERTICES`] and [`MAX_TRIANGLES`].

mod build;
mod edges;
mod error;
mod lines;
mod obj;
mod ply;
mod report;
mod sniff;
mod soup;
mod stl;
mod triangulate;

pub use error::{Alien, MeshReadError, Place, Quantity};
pub use report::{Normals, Note, Report, Skipped, Tally};

use super::mesh::Mesh;

/// The largest file that is read, in bytes.
pub const MAX_BYTES: usize = 1 << 31;

/// The most vertices, and the most normals, that one file may hold.
pub const MAX_VERTICES: usize = 30_000_000;

/// The most triangles that one file may make.
pub const MAX_TRIANGLES: usize = 10_000_000;

/// Statements, faces or vertices between two looks at whether to stop.
const STOP_EVERY: usize = 4096;

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Kind {
    /// Wavefront OBJ.
    #[error("OBJ")]
    Obj,
    /// Stanford PLY.
    #[error("PLY")]
    Ply,
    /// Stereolithography STL.
    #[error("STL")]
    Stl,
}

/// Consecutive triangles under one name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The object's and the group's name (`head / eyes`); empty where the file gives none.
    pub name: String,
    /// The material's name; empty where the file gives none.
    pub material: String,
    /// Triangles of the mesh.
    pub triangles: std::ops::Range<usize>,
}

/// A mesh as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadMesh {
    /// The mesh, in the file's own unit and axes.
    pub mesh: Mesh,
    /// The groups that have triangles, in the file's order; together they are all triangles. A name may come up again.
    pub groups: Vec<Group>,
    /// Findings, and faults that were tolerated.
    pub report: Report,
}

/// Reads the bytes of a file as a mesh.
///
/// The format is recognized by the content; the file name's extension (without the dot, in any case) decides only if the
/// content is ambiguous. `stop` is polled every few thousand lines, and ends the reading with [`MeshReadError::Stopped`].
/// Deterministic: equal bytes give equal meshes.
///
/// # Errors
/// [`MeshReadError`] names the line or byte that cannot be read, or reports that `stop` ended the reading.
///
/// ```
/// use chromascope_mesh::reading::read_mesh;
///
/// let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
/// let read = read_mesh(square.as_bytes(), Some("obj"), &|| false)?;
/// assert_eq!(read.mesh.triangles().len(), 2);
/// assert_eq!(read.report.boundary_edges, 4);
/// # Ok::<(), chromascope_mesh::reading::MeshReadError>(())
/// ```
pub fn read_mesh(
    bytes: &[u8],
    extension_hint: Option<&str>,
    stop: &dyn Fn() -> bool,
) -> Result<ReadMesh, MeshReadError> {
    let kind = sniff::kind(bytes, extension_hint)?;
    if stop() {
        return Err(MeshReadError::Stopped);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let soup = match kind {
        Kind::Obj => obj::read(text, stop)?,
        Kind::Ply => ply::read(text, stop)?,
        Kind::Stl if !stl::is_whole_binary(bytes) && sniff::is_text_stl(text) => stl::read_text(text, stop)?,
        Kind::Stl => stl::read_binary(bytes, stop)?,
    };
    build::build(&soup, kind, stop)
}
