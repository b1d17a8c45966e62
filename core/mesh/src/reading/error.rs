//! Reason that a file gives no mesh: where, and what to do about it.

/// Unsupported contents of a file: another kind of file, or an unsupported kind of mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Alien {
    /// glTF, as text or binary.
    #[error("glTF")]
    Gltf,
    /// Autodesk FBX.
    #[error("FBX")]
    Fbx,
    /// A compressed file or archive: zip, gzip, 3MF, USDZ.
    #[error("compressed")]
    Compressed,
    /// XML: Collada, X3D, AMF.
    #[error("XML")]
    Xml,
    /// Geomview OFF.
    #[error("OFF")]
    Off,
    /// Bytes that are no text and carry no known mark.
    #[error("binary data")]
    Binary,
    /// Text without a single vertex.
    #[error("text without vertices")]
    Text,
}

/// Quantity that has a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Quantity {
    /// Bytes of the file.
    #[error("bytes")]
    Bytes,
    /// Vertices or normals.
    #[error("vertices")]
    Vertices,
    /// Triangles, polygons counted as what they are cut into.
    #[error("triangles")]
    Triangles,
}

/// Place in a file, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, thiserror::Error)]
pub enum Place {
    /// A line of a text file; of a statement continued over several lines, the first.
    #[error("line {0}")]
    Line(usize),
    /// A face of a binary file.
    #[error("face {0}")]
    Face(usize),
    /// A vertex of a binary file.
    #[error("vertex {0}")]
    Vertex(usize),
}

/// Reason that bytes give no mesh. Each message says where the error is and how to correct it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(
    missing_docs,
    reason = "each variant says in its message what is wrong; lines and columns (bytes) count from 1"
)]
pub enum MeshReadError {
    #[error("the file is empty; export the mesh again")]
    Empty,
    #[error("this is no OBJ, PLY or STL file (it looks like {0}); export the mesh as OBJ")]
    NotAMesh(Alien),
    #[error("line {line}, column {column}: not a number; write numbers like 0.25 or 1e-3, with a decimal point")]
    Number { line: usize, column: usize },
    #[error("{0}: a coordinate is not finite; remove or repair that vertex")]
    NotFinite(Place),
    #[error("{0}: a coordinate is beyond ±1e15; rescale the mesh or repair that vertex")]
    TooFar(Place),
    #[error("line {line}: {found} numbers where three are needed (x y z); repair or remove that line")]
    TooFewNumbers { line: usize, found: usize },
    #[error(
        "line {line}, column {column}: not a corner of a face; write 1, 1/1, 1//1 or 1/1/1, with indices other than 0"
    )]
    Index { line: usize, column: usize },
    #[error("{place} names vertex {index}, but there are {count}; the file may be incomplete, export it again")]
    NoSuchVertex {
        place: Place,
        index: i64,
        /// Number of vertices the file has (before this line, where the index is counted back from it).
        count: usize,
    },
    #[error("{place} names normal {index}, but there are {count}; export the mesh again, or without normals")]
    NoSuchNormal {
        place: Place,
        index: i64,
        /// Number of normals the file has (before this line, where the index is counted back from it).
        count: usize,
    },
    #[error("{place}: a face of {corners} corners; a face needs at least three, remove it")]
    FaceTooShort { place: Place, corners: usize },
    #[error(
        "{place}: a concave polygon of {corners} corners (at most {limit}); triangulate the mesh before exporting it"
    )]
    FaceTooLong { place: Place, corners: usize, limit: usize },
    #[error("{0} vertices but no faces; export a surface, not a point cloud or curves")]
    NoFaces(usize),
    #[error("none of the {triangles} triangles has an area (the first at {place}); check the export's scale and axes")]
    NoArea { triangles: usize, place: Place },
    #[error("more than {limit} {quantity} (reached at {place}); simplify the mesh or export a part of it")]
    TooLarge { quantity: Quantity, limit: usize, place: Place },
    #[error("the file ends at {place} of {announced}; it was not copied whole, get it again")]
    Truncated {
        /// The first face or vertex that is not whole.
        place: Place,
        announced: usize,
    },
    #[error("the file ends within the face that begins on line {0}; it was not copied whole, get it again")]
    Unfinished(usize),
    #[error("{0}: not what the format has here; the file is damaged or of a rare variant, export it as OBJ")]
    Syntax(Place),
    #[error("stopped before the mesh was read")]
    Stopped,
}
