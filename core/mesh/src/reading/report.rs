//! Report on reading a mesh: findings, and faults that were tolerated.

use super::Kind;
use super::error::Place;
use std::fmt::{Display, Formatter, Result};

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
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Skipped {
    /// Materials: their names are stored with the groups, their properties are ignored.
    Materials,
    /// Texture coordinates and maps.
    Textures,
    /// Colors or weights of vertices.
    VertexColors,
    /// Points.
    Points,
    /// Lines.
    Lines,
    /// Free-form curves and surfaces.
    Curves,
    /// Instructions for display and rendering.
    Display,
    /// Elements that are neither vertices nor faces.
    Elements,
    /// Words that the format does not have.
    Unknown,
}

impl Skipped {
    /// Number of kinds.
    pub(super) const COUNT: usize = 9;
    /// All kinds, in their order.
    const ALL: [Self; Self::COUNT] = [
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

    /// User-facing name of skipped content.
    fn name(self) -> &'static str {
        match self {
            Self::Materials => "material statements",
            Self::Textures => "texture statements",
            Self::VertexColors => "vertices with colors or weights",
            Self::Points => "point statements",
            Self::Lines => "line statements",
            Self::Curves => "free-form curve and surface statements",
            Self::Display => "display statements",
            Self::Elements => "elements that are neither vertices nor faces",
            Self::Unknown => "unknown statements",
        }
    }
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

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{}: {} vertices, {} faces, {} triangles", self.kind, self.vertices, self.polygons, self.triangles)
    }
}

/// A note for the user about a mesh that was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the fields count what the variant names, or give the first place")]
pub enum Note {
    /// Polygons that cross themselves.
    Crossing { count: usize, first: Place },
    /// A closed mesh whose triangles face inwards.
    InsideOut,
    /// Edges whose triangles disagree on which side is outside.
    Flipped { edges: usize, first: Place },
    /// Normals that point to the opposite side of the winding order.
    AgainstWinding { triangles: usize, of: usize },
    /// Single precision shows.
    FarFromOrigin,
    /// Triangles without area were omitted.
    Degenerate { count: usize, first: Place },
    /// Edges of more than two triangles.
    NonManifold { edges: usize, first: Place },
    /// Triangles on the same three vertices.
    Duplicates { count: usize, first: Place },
    /// The file has no normals.
    NormalsComputed,
    /// Some corners have no normals.
    NormalsMixed { corners: usize },
    /// The mesh is not closed.
    Open { edges: usize },
    /// Vertices without triangles.
    Unused { vertices: usize },
    /// Names of groups past the limit.
    UnnamedGroups { count: usize },
    /// Statements that were read over.
    Skipped { what: Skipped, count: usize, first: Place },
}

impl Display for Note {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Crossing { count, first } => {
                write!(f, "Polygons that cross themselves: {count}, first at {first}; triangulate before exporting")
            }
            Self::InsideOut => f.write_str("The mesh is inside out; flip its faces before exporting"),
            Self::Flipped { edges, first } => {
                write!(f, "Neighboring faces wound against each other: {edges} edges, first at {first}")
            }
            Self::AgainstWinding { triangles, of } => {
                write!(f, "Normals point against the faces' winding in {triangles} of {of} triangles")
            }
            Self::FarFromOrigin => f.write_str(
                "Far from the origin for its size, details are lost; move it to the origin before exporting",
            ),
            Self::Degenerate { count, first } => {
                write!(f, "Triangles without area left out: {count}, first at {first}")
            }
            Self::NonManifold { edges, first } => {
                write!(f, "Edges where more than two triangles meet: {edges}, first at {first}")
            }
            Self::Duplicates { count, first } => {
                write!(f, "Triangles on the same three vertices as another: {count}, first at {first}")
            }
            Self::NormalsComputed => f.write_str("No normals in the file; computed from the faces"),
            Self::NormalsMixed { corners } => write!(f, "Normals missing at {corners} corners; computed there"),
            Self::Open { edges } => write!(f, "The surface is open: {edges} edges have a triangle on one side only"),
            Self::Unused { vertices } => write!(f, "Vertices that no triangle uses: {vertices}"),
            Self::UnnamedGroups { count } => write!(f, "Too many groups: {count} kept without their names"),
            Self::Skipped { what, count, first } => {
                write!(f, "Skipped {}: {count}, first at {first}", what.name())
            }
        }
    }
}
