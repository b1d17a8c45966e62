//! Bytes whose reading is watched.

use std::io;

use crate::watch::Log;

/// Bytes between two looks at the watch: some milliseconds.
const STRIDE: usize = 1 << 18;

/// Reads bytes until the watch wants no more.
pub(super) struct Watched<'a, 'b> {
    bytes: &'a [u8],
    at: usize,
    next: usize,
    log: &'a Log<'b>,
}

impl<'a, 'b> Watched<'a, 'b> {
    pub(super) fn new(bytes: &'a [u8], log: &'a Log<'b>) -> Self {
        Self { bytes, at: 0, next: STRIDE, log }
    }

    #[cold]
    fn look(&mut self) -> io::Result<()> {
        self.next = self.at + STRIDE;
        self.log.look(self.at).map_err(io::Error::other)
    }
}

impl io::Read for Watched<'_, '_> {
    #[inline]
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.at >= self.next {
            self.look()?;
        }
        let count = buffer.len().min(self.bytes.len() - self.at);
        buffer[..count].copy_from_slice(&self.bytes[self.at..self.at + count]);
        self.at += count;
        Ok(count)
    }
}
