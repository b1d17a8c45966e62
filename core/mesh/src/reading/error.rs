//! Reason that a file gives no mesh: where, and what to do about it.

/// Unsupported contents of a file: another kind of file, or an unsupported kind of mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Alien {
    /// glTF, as text or binary.
    Gltf,
    /// Autodesk FBX.
    Fbx,
    /// A compressed file or archive: zip, gzip, 3MF, USDZ.
    Compressed,
    /// XML: Collada, X3D, AMF.
    Xml,
    /// Geomview OFF.
    Off,
    /// Bytes that are no text and carry no known mark.
    Binary,
    /// Text without a single vertex.
    Text,
}

impl std::fmt::Display for Alien {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Gltf => "glTF",
            Self::Fbx => "FBX",
            Self::Compressed => "compressed",
            Self::Xml => "XML",
            Self::Off => "OFF",
            Self::Binary => "binary data",
            Self::Text => "text without vertices",
        })
    }
}

/// Quantity that has a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Bytes of the file.
    Bytes,
    /// Vertices or normals.
    Vertices,
    /// Triangles, polygons counted as what they are cut into.
    Triangles,
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Bytes => "bytes",
            Self::Vertices => "vertices",
            Self::Triangles => "triangles",
        })
    }
}

/// Place in a file, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// A line of a text file; of a statement continued over several lines, the first.
    Line(usize),
    /// A face of a binary file.
    Face(usize),
    /// A vertex of a binary file.
    Vertex(usize),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Line(n) => write!(f, "line {n}"),
            Self::Face(n) => write!(f, "face {n}"),
            Self::Vertex(n) => write!(f, "vertex {n}"),
        }
    }
}

/// Reason that bytes give no mesh. Each message says where the error is and how to correct it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum MeshReadError {
    /// There are no bytes, or nothing but blanks.
    #[error("the file is empty; export the mesh again")]
    Empty,
    /// The file is of another kind.
    #[error("this is no OBJ, PLY or STL file (it looks like {0}); export the mesh as OBJ")]
    NotAMesh(Alien),
    /// A word stands where a number should.
    #[error("line {line}, column {column}: not a number; write numbers like 0.25 or 1e-3, with a decimal point")]
    Number {
        /// The line, from 1.
        line: usize,
        /// The byte in the line, from 1.
        column: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("{0}: a coordinate is not finite; remove or repair that vertex")]
    NotFinite(Place),
    /// A coordinate is beyond ±1e15.
    #[error("{0}: a coordinate is beyond ±1e15; rescale the mesh or repair that vertex")]
    TooFar(Place),
    /// A vertex or normal has fewer than three numbers.
    #[error("line {line}: {found} numbers where three are needed (x y z); repair or remove that line")]
    TooFewNumbers {
        /// The line, from 1.
        line: usize,
        /// Number.
        found: usize,
    },
    /// A corner of a face cannot be read.
    #[error(
        "line {line}, column {column}: not a corner of a face; write 1, 1/1, 1//1 or 1/1/1, with indices other than 0"
    )]
    Index {
        /// The line, from 1.
        line: usize,
        /// The byte in the line, from 1.
        column: usize,
    },
    /// A face names a vertex that the file does not have.
    #[error("{place} names vertex {index}, but there are {count}; the file may be incomplete, export it again")]
    NoSuchVertex {
        /// The line or face.
        place: Place,
        /// The index as written.
        index: i64,
        /// Number of vertices the file has (before this line, where the index is counted back from it).
        count: usize,
    },
    /// A face names a normal that the file does not have.
    #[error("{place} names normal {index}, but there are {count}; export the mesh again, or without normals")]
    NoSuchNormal {
        /// The line or face.
        place: Place,
        /// The index as written.
        index: i64,
        /// Number of normals the file has (before this line, where the index is counted back from it).
        count: usize,
    },
    /// A face has fewer than three corners.
    #[error("{place}: a face of {corners} corners; a face needs at least three, remove it")]
    FaceTooShort {
        /// The line or face.
        place: Place,
        /// Number of corners.
        corners: usize,
    },
    /// A concave polygon has more corners than are cut.
    #[error(
        "{place}: a concave polygon of {corners} corners (at most {limit}); triangulate the mesh before exporting it"
    )]
    FaceTooLong {
        /// The line or face.
        place: Place,
        /// Number of corners.
        corners: usize,
        /// Largest number.
        limit: usize,
    },
    /// There are vertices but no faces.
    #[error("{0} vertices but no faces; export a surface, not a point cloud or curves")]
    NoFaces(usize),
    /// All triangles are without area.
    #[error("none of the {triangles} triangles has an area (the first at {place}); check the export's scale and axes")]
    NoArea {
        /// Number of triangles.
        triangles: usize,
        /// The first.
        place: Place,
    },
    /// The file holds more than is read.
    #[error("more than {limit} {quantity} (reached at {place}); simplify the mesh or export a part of it")]
    TooLarge {
        /// Of what.
        quantity: Quantity,
        /// Limit.
        limit: usize,
        /// Place where the limit is passed.
        place: Place,
    },
    /// The file ends before what its header announces.
    #[error("the file ends at {place} of {announced}; it was not copied whole, get it again")]
    Truncated {
        /// The first face or vertex that is not whole.
        place: Place,
        /// Number that the header announces.
        announced: usize,
    },
    /// A text ends within a face.
    #[error("the file ends within the face that begins on line {0}; it was not copied whole, get it again")]
    Unfinished(usize),
    /// A line of a header, or a record, is not what the format requires there.
    #[error("{0}: not what the format has here; the file is damaged or of a rare variant, export it as OBJ")]
    Syntax(Place),
    /// The caller stopped the reading.
    #[error("stopped before the mesh was read")]
    Stopped,
}
