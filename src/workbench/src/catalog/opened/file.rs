//! The contents of an opened file.

use std::sync::Arc;

use crate::catalog::import::Origin;

/// A file's contents.
#[derive(Clone, Debug)]
pub struct OpenFile {
    /// Origin of the bytes.
    pub origin: Origin,
    pub bytes: Arc<[u8]>,
    /// Reason that it could not be read, as a message with its name.
    pub failure: Option<String>,
}
