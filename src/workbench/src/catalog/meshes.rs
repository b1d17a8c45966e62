//! Reading of mesh files: returns the mesh with notes for the user, or an error message.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use chromascope_core::query::Shared;
use chromascope_mesh::Mesh;
use chromascope_mesh::reading::{MeshReadError, Note, ReadMesh, read_mesh};

use super::file_store::{FileState, FileStore, FromFile, Stamp, Unread};
use crate::document::render::MeshChoice;
use crate::format::{capitalized, file_name, io_reason};

pub type MeshStore = FileStore<LoadedMesh>;
pub type MeshState = FileState<LoadedMesh>;

pub const MAX_FILE_BYTES: u64 = 1_000_000_000;
/// Number of bytes read between two checks of the stop signal.
const CHUNK_BYTES: u64 = 4 << 20;
pub const ENDINGS: [&str; 3] = ["obj", "ply", "stl"];

#[derive(Clone, Debug)]
pub struct LoadedMesh {
    pub mesh: Shared<Mesh>,
    /// Tolerated findings, most serious first.
    pub notes: Vec<String>,
    /// The file's name and its counts: `head.obj: 4429 vertices, 8812 triangles, open edges 36`.
    pub summary: String,
    /// The summary with the most severe note that the counts do not already imply, in full sentences.
    pub message: String,
}

impl FromFile for LoadedMesh {
    type Failure = MeshFailure;
    type Version = Stamp;
    const THREAD: &'static str = "meshes";

    fn read_unless(
        path: &Path,
        unless: Option<Stamp>,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<(Self, Stamp)>, MeshFailure> {
        let file = file_name(path);
        let failed = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => {
                let folder = path.parent().map_or_else(String::new, |folder| folder.display().to_string());
                MeshFailure::Missing { file: file.clone(), folder }
            }
            _ => MeshFailure::Io { file: file.clone(), error },
        };
        // Opening a pipe would block until another process writes into it.
        if !std::fs::metadata(path).map_err(failed)?.is_file() {
            return Err(MeshFailure::NoFile(file));
        }
        let source = File::open(path).map_err(failed)?;
        let known = source.metadata().map_err(failed)?;
        let stamp = Stamp::of(&known);
        if unless == Some(stamp) {
            return Ok(None);
        }
        if stamp.bytes() > MAX_FILE_BYTES {
            return Err(MeshFailure::TooLarge { file, bytes: stamp.bytes() });
        }
        let bytes = contents(source, stamp.bytes(), stop).map_err(|error| match error.kind() {
            io::ErrorKind::OutOfMemory => MeshFailure::NoMemory { file: file.clone(), bytes: stamp.bytes() },
            io::ErrorKind::Interrupted => MeshFailure::Stopped(file.clone()),
            _ => failed(error),
        })?;
        match read_mesh(&bytes, path.extension().and_then(OsStr::to_str), stop) {
            Ok(mesh) => Ok(Some((loaded(&file, mesh), stamp))),
            Err(MeshReadError::Stopped) => Err(MeshFailure::Stopped(file)),
            Err(error) => Err(MeshFailure::Mesh { file, error }),
        }
    }

    fn bytes(&self) -> usize {
        size_of_val(self.mesh.positions()) + size_of_val(self.mesh.normals()) + size_of_val(self.mesh.triangles())
    }

    fn summary(&self) -> &str {
        &self.summary
    }

    fn on_opening(failure: &MeshFailure) -> String {
        format!("{}. Nothing was changed.", failure.beginning())
    }

    fn picture_message(failure: &MeshFailure) -> String {
        let remedy = match failure {
            MeshFailure::Missing { .. } => "; open it from where it is now, or choose Head or Fern.",
            MeshFailure::Io { .. } | MeshFailure::Stopped(..) => "; open it again, or choose Head or Fern.",
            _ => ". Open another mesh, or choose Head or Fern.",
        };
        failure.beginning() + remedy
    }
}

impl MeshStore {
    /// Returns the mesh of a document, if it is from a file and was read.
    pub fn chosen(&self, choice: &MeshChoice) -> Option<Shared<Mesh>> {
        let MeshChoice::File(path) = choice else { return None };
        match self.get(path) {
            FileState::Ready(mesh) => Some(mesh.mesh.clone()),
            FileState::Loading | FileState::Failed(_) => None,
        }
    }
}

#[derive(Debug, thiserror::Error)]
pub enum MeshFailure {
    #[error("{file} is not in {folder}")]
    Missing { file: String, folder: String },
    #[error("{file}: {}", io_reason(.error))]
    Io { file: String, error: io::Error },
    #[error("{0} is not a file")]
    NoFile(String),
    #[error(
        "{file}: {} MB, but the limit is {} MB; simplify the mesh or export a part of it",
        .bytes / 1_000_000,
        MAX_FILE_BYTES / 1_000_000
    )]
    TooLarge { file: String, bytes: u64 },
    #[error("{file}: not enough memory for its {} MB; close other programs or simplify the mesh", .bytes / 1_000_000)]
    NoMemory { file: String, bytes: u64 },
    #[error("{file}{}{error}", joint(.error))]
    Mesh { file: String, error: MeshReadError },
    #[error("{0} could not be read because of an error in this program; please report it with the file")]
    Broken(String),
    #[error("reading {0} stopped")]
    Stopped(String),
}

impl From<Unread> for MeshFailure {
    fn from(why: Unread) -> Self {
        match why {
            Unread::Io { file, error } => Self::Io { file, error },
            Unread::Broken(file) => Self::Broken(file),
            Unread::Stopped(file) => Self::Stopped(file),
        }
    }
}

impl MeshFailure {
    /// The message as the beginning of a sentence: only a sentence's own first word takes a capital, a file's name stays as it is.
    fn beginning(&self) -> String {
        match self {
            Self::Stopped(..) => capitalized(&self.to_string()),
            _ => self.to_string(),
        }
    }
}

/// Separator between a file's name and a message, which may begin with a position in the file.
fn joint(error: &MeshReadError) -> &'static str {
    use MeshReadError as E;
    match error {
        E::Number { .. }
        | E::NotFinite { .. }
        | E::TooFar { .. }
        | E::TooFewNumbers { .. }
        | E::Index { .. }
        | E::NoSuchVertex { .. }
        | E::NoSuchNormal { .. }
        | E::FaceTooShort { .. }
        | E::FaceTooLong { .. }
        | E::Syntax { .. } => ", ",
        _ => ": ",
    }
}

/// Reads a mesh file. `stop` is polled, and ends the reading with [`MeshFailure::Stopped`].
pub fn read(path: &Path, stop: &dyn Fn() -> bool) -> Result<LoadedMesh, MeshFailure> {
    // Nothing to compare with, so there is always something.
    LoadedMesh::read_unless(path, None, stop)?
        .map(|(mesh, _)| mesh)
        .ok_or_else(|| MeshFailure::Stopped(file_name(path)))
}

/// The bytes of a file, in pieces, for a disk can be slow.
fn contents(source: File, size: u64, stop: &dyn Fn() -> bool) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let room = usize::try_from(size).unwrap_or(usize::MAX);
    bytes.try_reserve_exact(room).map_err(|_| io::Error::from(io::ErrorKind::OutOfMemory))?;
    // A file that grows meanwhile is read as long as it was.
    let mut rest = source.take(size);
    while (&mut rest).take(CHUNK_BYTES).read_to_end(&mut bytes)? > 0 {
        if stop() {
            return Err(io::Error::from(io::ErrorKind::Interrupted));
        }
    }
    Ok(bytes)
}

fn loaded(file: &str, read: ReadMesh) -> LoadedMesh {
    let ReadMesh { mesh, report, .. } = read;
    let open = report.boundary_edges;
    let open = if open == 0 { "closed".to_owned() } else { format!("open edges {open}") };
    let plural = if report.triangles == 1 { "" } else { "s" };
    let summary = format!("{file}: {} vertices, {} triangle{plural}, {open}", report.vertices, report.triangles);
    let notes = report.notes();
    let first = notes.iter().find(|note| !matches!(note, Note::Open { .. } | Note::Skipped { .. }));
    let message = first.map_or_else(|| format!("{summary}."), |note| format!("{summary}. {note}."));
    LoadedMesh { mesh: Shared::new(mesh), notes: notes.iter().map(ToString::to_string).collect(), summary, message }
}

/// True if a file is a mesh rather than spectra: by its name's ending, else by its first bytes.
pub fn is_mesh(path: &Path, beginning: &[u8]) -> bool {
    let ending = path.extension().and_then(OsStr::to_str);
    if ending.is_some_and(|ending| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known))) {
        return true;
    }
    let text = String::from_utf8_lossy(beginning);
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    match lines.next() {
        Some("ply") => true,
        Some(first) if first.starts_with("solid") => lines.next().is_some_and(|line| line.starts_with("facet")),
        _ => text.lines().any(is_vertex),
    }
}

/// `v`, and three numbers or more.
fn is_vertex(line: &str) -> bool {
    let mut words = line.split_whitespace();
    let numbers = |words: std::str::SplitWhitespace<'_>| words.take_while(|word| word.parse::<f64>().is_ok()).count();
    words.next() == Some("v") && numbers(words) >= 3
}
