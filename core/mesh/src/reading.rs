//! Meshes from files: bytes in, a mesh out, with its groups and a report of what was found and tolerated.
//!
//! [`read_mesh`] takes the bytes of a Wavefront OBJ, Stanford PLY or STL file, the latter two as text or binary.
//! Coordinates are not converted: neither the unit nor the up axis is guessed.
//!
//! Pipeline of a file: the format is detected, `obj`, `ply` or `stl` (to vertices, normals and polygons, the shared
//! `soup`; STL's corners are welded where they are equal), `triangulate` (polygons of any shape to triangles), `edges`
//! (open, doubled or flipped edges, and corners that share a normal), `build` (vertices split where normals differ,
//! missing normals computed).
//!
//! Normals: those of the file where it has them. Missing ones are the mean of the faces around a vertex, by angle, going
//! over an edge only where both faces are of one smoothing group (`s 1`), or where the file names no smoothing at
//! all and the faces meet at less than 60°; `s off` gives each face its own.
//!
//! Reading is total: it does not panic, takes time about proportional to the input (a concave polygon: to the square of its
//! corners at most), and needs about 150 bytes for each triangle beside the file's own. The limits are
//! [`MAX_BYTES`], [`MAX_VERTICES`] and [`MAX_TRIANGLES`].

mod build;
mod edges;
mod lines;
mod obj;
mod ply;
mod report;
mod soup;
mod stl;
mod triangulate;

use self::lines::Cursor;
use super::mesh::Mesh;

pub use report::{Alien, Kind, MeshReadError, Normals, Note, Place, Quantity, Report, Skipped, Tally};

/// The largest file that is read, in bytes.
pub const MAX_BYTES: usize = 1 << 31;

/// The most vertices, and the most normals, that one file may hold.
pub const MAX_VERTICES: usize = 30_000_000;

/// The most triangles that one file may make.
pub const MAX_TRIANGLES: usize = 10_000_000;

/// Statements, faces or vertices between two looks at whether to stop.
const STOP_EVERY: usize = 4096;

/// Looks from time to time at whether to stop.
fn look(at: usize, stop: &dyn Fn() -> bool) -> Result<(), MeshReadError> {
    if at.is_multiple_of(STOP_EVERY) && stop() { Err(MeshReadError::Stopped) } else { Ok(()) }
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
    let kind = kind_of(bytes, extension_hint)?;
    if stop() {
        return Err(MeshReadError::Stopped);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let soup = match kind {
        Kind::Obj => obj::read(text, stop)?,
        Kind::Ply => ply::read(text, stop)?,
        Kind::Stl if !stl::is_whole_binary(bytes) && is_text_stl(text) => stl::read_text(text, stop)?,
        Kind::Stl => stl::read_binary(bytes, stop)?,
    };
    build::build(&soup, kind, stop)
}

/// Number of bytes searched for what no text has.
const LOOK: usize = 4096;

/// The format of a file, or why it is none that is read.
fn kind_of(bytes: &[u8], extension_hint: Option<&str>) -> Result<Kind, MeshReadError> {
    if bytes.len() > MAX_BYTES {
        let place = Place::Line(1);
        return Err(MeshReadError::TooLarge { quantity: Quantity::Bytes, limit: MAX_BYTES, place });
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Err(MeshReadError::Empty);
    }
    let hint = |extension: &str| extension_hint.is_some_and(|hint| hint.eq_ignore_ascii_case(extension));
    if text.split(u8::is_ascii_whitespace).next() == Some(b"ply") {
        return Ok(Kind::Ply);
    }
    if stl::is_whole_binary(bytes) || is_text_stl(text) {
        return Ok(Kind::Stl);
    }
    if let Some(looks_like) = alien(bytes, text) {
        // Only its name distinguishes a truncated binary STL from other binary data.
        return if looks_like == Alien::Binary && hint("stl") {
            Ok(Kind::Stl)
        } else {
            Err(MeshReadError::NotAMesh(looks_like))
        };
    }
    if hint("obj") || has_vertex(text) { Ok(Kind::Obj) } else { Err(MeshReadError::NotAMesh(Alien::Text)) }
}

fn is_text_stl(text: &[u8]) -> bool {
    let mut cursor = Cursor::new(&text[..text.len().min(LOOK)]);
    if cursor.word().is_none_or(|word| !word.text.eq_ignore_ascii_case(b"solid")) {
        return false;
    }
    cursor.next_line();
    while !cursor.is_done() {
        if let Some(word) = cursor.word() {
            return [&b"facet"[..], b"endsolid"].iter().any(|known| word.text.eq_ignore_ascii_case(known));
        }
        cursor.next_line();
    }
    false
}

/// The kind of a file that is not read, by its first bytes.
fn alien(bytes: &[u8], text: &[u8]) -> Option<Alien> {
    let looks_like = match text {
        [b'g', b'l', b'T', b'F', ..] | [b'{', ..] => Alien::Gltf,
        [b'P', b'K', 3, 4, ..] | [0x1f, 0x8b, ..] => Alien::Compressed,
        [b'<', ..] => Alien::Xml,
        _ if text.starts_with(b"Kaydara FBX") || text.starts_with(b"; FBX") => Alien::Fbx,
        _ if [&b"OFF"[..], b"COFF", b"NOFF"].contains(&text.split(u8::is_ascii_whitespace).next()?) => Alien::Off,
        _ if bytes[..bytes.len().min(LOOK)].contains(&0) => Alien::Binary,
        _ => return None,
    };
    Some(looks_like)
}

fn has_vertex(text: &[u8]) -> bool {
    let mut cursor = Cursor::new(text);
    while !cursor.is_done() {
        if cursor.word().is_some_and(|word| word.text == b"v") {
            return true;
        }
        cursor.next_line();
    }
    false
}
