//! What is understood of a file, for a person who looks at it.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use chromascope_core::query::{Ask, Query};
use spectral_file::{Marker, Preview, ReadError, ReadOptions, Table, Watch};

use super::file::OpenFile;
use crate::catalog::import::Origin;
use crate::document::own::Fingerprint;

/// A file's contents as part of a question.
#[derive(Clone, Debug)]
struct Contents {
    origin: Origin,
    bytes: Arc<[u8]>,
}

impl PartialEq for Contents {
    fn eq(&self, other: &Self) -> bool {
        self.origin == other.origin && (Arc::ptr_eq(&self.bytes, &other.bytes) || self.bytes == other.bytes)
    }
}

impl Eq for Contents {}

impl Hash for Contents {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.origin.fingerprint.hash(state);
    }
}

/// What is a file understood as with these switches?
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FilePreviewQuery {
    table: TableQuery,
    marked: bool,
}

impl FilePreviewQuery {
    /// Of a file: first what was understood, then also where it stands in the text.
    pub fn stages(file: &OpenFile, options: &ReadOptions) -> Vec<Self> {
        let contents = Contents { origin: file.origin.clone(), bytes: Arc::clone(&file.bytes) };
        let table = TableQuery { contents, options: options.clone() };
        [false, true].map(|marked| Self { table: table.clone(), marked }).into()
    }
}

/// A file's text and what was understood of it.
#[derive(Debug)]
pub struct FilePreview {
    /// Which file.
    pub fingerprint: Fingerprint,
    /// The switches it was read with.
    pub options: ReadOptions,
    /// Its text, where it is text.
    pub preview: Result<Arc<Preview>, ReadError>,
    /// What was understood.
    pub table: Result<Arc<Table>, ReadError>,
    /// Where that stands in the text; none until it is found out.
    pub marker: Option<Marker>,
}

impl Query for FilePreviewQuery {
    type Answer = FilePreview;
    const NAME: &'static str = "look at a file";
    const KEPT: usize = 4;

    fn answer(&self, ask: &impl Ask) -> FilePreview {
        let TableQuery { contents, options } = &self.table;
        let preview = (*ask.ask(&PreviewQuery { contents: contents.clone() })).clone();
        let table = (*ask.ask(&self.table)).clone();
        let marker = match (&preview, &table) {
            (Ok(preview), Ok(table)) if self.marked => Some(preview.marker(table)),
            _ => None,
        };
        FilePreview { fingerprint: contents.origin.fingerprint, options: options.clone(), preview, table, marker }
    }
}

/// What curves does a file hold?
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct TableQuery {
    contents: Contents,
    options: ReadOptions,
}

impl Query for TableQuery {
    type Answer = Result<Arc<Table>, ReadError>;
    const NAME: &'static str = "curves of a file";
    const KEPT: usize = 4;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let stop = ask.stop();
        let go_on = |_: f32| !stop.is_set();
        spectral_file::read_watched(&self.contents.bytes, &self.options, Watch::new(&go_on)).map(Arc::new)
    }

    fn bytes(table: &Self::Answer) -> usize {
        let samples = |table: &Table| table.curves.iter().map(|curve| 2 * size_of_val(&*curve.values)).sum();
        table.as_ref().map_or(0, |table| samples(table))
    }
}

/// What are the lines of a file?
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct PreviewQuery {
    contents: Contents,
}

impl Query for PreviewQuery {
    type Answer = Result<Arc<Preview>, ReadError>;
    const NAME: &'static str = "lines of a file";
    const KEPT: usize = 2;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        Preview::new(&self.contents.bytes).map(Arc::new)
    }
}
