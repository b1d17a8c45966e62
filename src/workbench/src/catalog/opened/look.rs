//! A file's contents, and their preview: curves and annotated text.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use chromascope_core::query::{Ask, Query};
use spectral_file::{Marker, Preview, ReadError, ReadOptions, SpectralFile, Watch};

use crate::catalog::import::Origin;
use crate::document::imported::Fingerprint;

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

#[derive(Clone, Debug)]
pub struct OpenFile {
    pub origin: Origin,
    pub bytes: Arc<[u8]>,
    /// Reason that it could not be read, as a message with its name.
    pub failure: Option<String>,
}

/// Query for the curves, the text and the marks of a file that is read with these switches.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FilePreviewQuery {
    contents: Contents,
    options: ReadOptions,
}

impl FilePreviewQuery {
    pub fn new(file: &OpenFile, options: &ReadOptions) -> Self {
        let contents = Contents { origin: file.origin.clone(), bytes: Arc::clone(&file.bytes) };
        Self { contents, options: options.clone() }
    }
}

#[derive(Debug)]
pub struct FilePreview {
    pub fingerprint: Fingerprint,
    pub options: ReadOptions,
    /// Its text, where it is text.
    pub preview: Result<Arc<Preview>, ReadError>,
    pub table: Result<Arc<SpectralFile>, ReadError>,
    /// Their places in the text.
    pub marker: Option<Marker>,
}

impl Query for FilePreviewQuery {
    type Answer = FilePreview;
    const NAME: &'static str = "look at a file";
    const CAPACITY: usize = 4;

    fn answer(&self, ask: &impl Ask) -> FilePreview {
        let Self { contents, options } = self;
        let preview = (*ask.ask(&PreviewQuery { contents: contents.clone() })).clone();
        let stop = ask.stop();
        let go_on = |_: f32| !stop.is_set();
        let source = contents.origin.source(&contents.bytes);
        let read = spectral_file::read_marked(source, options, Watch::new(&go_on));
        let (table, marker) = match read.and_then(|(table, marker)| Ok((table.usable()?, marker))) {
            Ok((table, marker)) => (Ok(Arc::new(table)), Some(marker)),
            Err(error) => (Err(error), None),
        };
        FilePreview { fingerprint: contents.origin.fingerprint, options: options.clone(), preview, table, marker }
    }

    fn bytes(look: &FilePreview) -> usize {
        let samples = |table: &SpectralFile| table.curves.iter().map(|curve| 2 * size_of_val(&*curve.values)).sum();
        look.table.as_ref().map_or(0, |table| samples(table))
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct PreviewQuery {
    contents: Contents,
}

impl Query for PreviewQuery {
    type Answer = Result<Arc<Preview>, ReadError>;
    const NAME: &'static str = "lines of a file";
    const CAPACITY: usize = 2;

    fn answer(&self, _: &impl Ask) -> Self::Answer {
        Preview::new(&self.contents.bytes).map(Arc::new)
    }
}
