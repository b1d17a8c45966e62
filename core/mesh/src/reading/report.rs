//! Report on reading a mesh: findings, faults that were tolerated, or the reason that there is no mesh: where, and what to do about it.

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum Kind {
    #[error("OBJ")]
    Obj,
    #[error("PLY")]
    Ply,
    #[error("STL")]
    Stl,
}

/// Number of occurrences, and the first place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Tally {
    /// Number of occurrences.
    pub count: usize,
    /// The first in the file; none where there is none.
    pub first: Option<Place>,
}

impl Tally {
    pub(super) fn add(&mut self, place: Place) {
        self.merge(Self { count: 1, first: Some(place) });
    }

    pub(super) fn merge(&mut self, other: Self) {
        self.count += other.count;
        self.first = [self.first, other.first].into_iter().flatten().min();
    }
}

/// Statements that are read over, since nothing in a mesh answers to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum Skipped {
    #[error("material statements")]
    Materials,
    #[error("texture statements")]
    Textures,
    #[error("vertices with colors or weights")]
    VertexColors,
    #[error("point statements")]
    Points,
    #[error("line statements")]
    Lines,
    #[error("free-form curve and surface statements")]
    Curves,
    #[error("display statements")]
    Display,
    #[error("elements that are neither vertices nor faces")]
    Elements,
    #[error("unknown statements")]
    Unknown,
}

impl Skipped {
    pub(super) const COUNT: usize = Self::ALL.len();
    /// All kinds, in their order.
    const ALL: [Self; 9] = [
        Self::Materials,
        Self::Textures,
        Self::VertexColors,
        Self::Points,
        Self::Lines,
        Self::Curves,
        Self::Display,
        Self::Elements,
        Self::Unknown,
    ];
}

/// Origin of the mesh's normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Normals {
    /// All from the file.
    Read,
    /// All computed, as the file has none.
    Computed,
    /// Some from the file; this many of the triangles' corners have none, or one of no length, and theirs are computed.
    Mixed {
        /// Number of corners computed.
        computed: usize,
    },
}

/// Counts, and what was tolerated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The format.
    pub kind: Kind,
    /// Vertices in the file.
    pub vertices: usize,
    /// Faces in the file, of any number of corners.
    pub polygons: usize,
    /// Triangles in the mesh.
    pub triangles: usize,
    /// Origin of the normals.
    pub normals: Normals,
    /// Triangles omitted because they have no area within single precision's resolution of their coordinates.
    pub degenerate: Tally,
    /// Self-intersecting polygons, which have no valid triangulation; they were triangulated arbitrarily.
    pub crossing: Tally,
    /// Edges where more than two triangles meet; not changed. `first` is the first face at such an edge.
    pub non_manifold_edges: Tally,
    /// Triangles with the same three vertices as an earlier one; not removed.
    pub duplicates: Tally,
    /// Edges of one triangle only: none where the mesh is closed.
    pub boundary_edges: usize,
    /// Edges whose two triangles disagree on which side is outside.
    pub flipped: Tally,
    /// True if a closed mesh encloses a negative volume: its triangles face inwards.
    pub inside_out: bool,
    /// Triangles whose normals in the file point to the opposite side of their winding order.
    pub against_winding: usize,
    /// Vertices in the file that no triangle uses.
    pub unused_vertices: usize,
    /// True if the mesh lies so far from the origin that single precision shows: more than 1e4 of its own size.
    pub far_from_origin: bool,
    /// Statements read over, by kind.
    pub skipped: Vec<(Skipped, Tally)>,
    /// Names of groups beyond the limit, which were discarded.
    pub unnamed_groups: usize,
}

impl Report {
    /// Counts of statements read over, as a list of those that occur.
    pub(super) fn skipped_list(tallies: &[Tally; Skipped::COUNT]) -> Vec<(Skipped, Tally)> {
        Skipped::ALL.into_iter().zip(*tallies).filter(|(_, tally)| tally.count > 0).collect()
    }

    /// Notes for the user, a line each, the most severe first; empty if there are none.
    pub fn notes(&self) -> Vec<Note> {
        let tally = |tally: Tally, note: fn(usize, Place) -> Note| tally.first.map(|first| note(tally.count, first));
        let some = |count: usize, note: Note| (count > 0).then_some(note);
        let mut notes: Vec<Note> = [
            tally(self.crossing, |count, first| Note::Crossing { count, first }),
            self.inside_out.then_some(Note::InsideOut),
            tally(self.flipped, |edges, first| Note::Flipped { edges, first }),
            some(self.against_winding, Note::AgainstWinding { triangles: self.against_winding, of: self.triangles }),
            self.far_from_origin.then_some(Note::FarFromOrigin),
            tally(self.degenerate, |count, first| Note::Degenerate { count, first }),
            tally(self.non_manifold_edges, |edges, first| Note::NonManifold { edges, first }),
            tally(self.duplicates, |count, first| Note::Duplicates { count, first }),
            match self.normals {
                Normals::Read => None,
                Normals::Computed => Some(Note::NormalsComputed),
                Normals::Mixed { computed } => Some(Note::NormalsMixed { corners: computed }),
            },
            some(self.boundary_edges, Note::Open { edges: self.boundary_edges }),
            some(self.unused_vertices, Note::Unused { vertices: self.unused_vertices }),
            some(self.unnamed_groups, Note::UnnamedGroups { count: self.unnamed_groups }),
        ]
        .into_iter()
        .flatten()
        .collect();
        notes.extend(
            self.skipped.iter().filter_map(|&(what, tally)| {
                tally.first.map(|first| Note::Skipped { what, count: tally.count, first })
            }),
        );
        notes
    }
}

impl std::fmt::Display for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {} vertices, {} faces, {} triangles", self.kind, self.vertices, self.polygons, self.triangles)
    }
}

/// A note for the user about a mesh that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[expect(missing_docs, reason = "each says what it is in its text")]
pub enum Note {
    #[error("Polygons that cross themselves: {count}, first at {first}; triangulate before exporting")]
    Crossing { count: usize, first: Place },
    #[error("The mesh is inside out; flip its faces before exporting")]
    InsideOut,
    #[error("Neighboring faces wound against each other: {edges} edges, first at {first}")]
    Flipped { edges: usize, first: Place },
    #[error("Normals point against the faces' winding in {triangles} of {of} triangles")]
    AgainstWinding { triangles: usize, of: usize },
    #[error("Far from the origin for its size, details are lost; move it to the origin before exporting")]
    FarFromOrigin,
    #[error("Triangles without area left out: {count}, first at {first}")]
    Degenerate { count: usize, first: Place },
    #[error("Edges where more than two triangles meet: {edges}, first at {first}")]
    NonManifold { edges: usize, first: Place },
    #[error("Triangles on the same three vertices as another: {count}, first at {first}")]
    Duplicates { count: usize, first: Place },
    #[error("No normals in the file; computed from the faces")]
    NormalsComputed,
    #[error("Normals missing at {corners} corners; computed there")]
    NormalsMixed { corners: usize },
    #[error("The surface is open: {edges} edges have a triangle on one side only")]
    Open { edges: usize },
    #[error("Vertices that no triangle uses: {vertices}")]
    Unused { vertices: usize },
    #[error("Too many groups: {count} kept without their names")]
    UnnamedGroups { count: usize },
    #[error("Skipped {what}: {count}, first at {first}")]
    Skipped { what: Skipped, count: usize, first: Place },
}

/// Unsupported contents of a file: another kind of file, or an unsupported kind of mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum Alien {
    #[error("glTF")]
    Gltf,
    #[error("FBX")]
    Fbx,
    /// A compressed file or archive: zip, gzip, 3MF, USDZ.
    #[error("compressed")]
    Compressed,
    #[error("XML")]
    Xml,
    #[error("OFF")]
    Off,
    #[error("binary data")]
    Binary,
    #[error("text without vertices")]
    Text,
}

/// Quantity that has a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum Quantity {
    #[error("bytes")]
    Bytes,
    #[error("vertices")]
    Vertices,
    /// Triangles, polygons counted as what they are cut into.
    #[error("triangles")]
    Triangles,
}

/// Place in a file, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum Place {
    /// A line of a text file; of a statement continued over several lines, the first.
    #[error("line {0}")]
    Line(usize),
    #[error("face {0}")]
    Face(usize),
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
