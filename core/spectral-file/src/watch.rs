//! Reading that is watched: how far it is, and the wish to stop.

use std::cell::Cell;
use std::mem::discriminant;

use crate::error::ReadError;
use crate::places::Places;
use crate::warning::Warning;

/// Progress of a reading, and a way to stop it.
///
/// The function receives the progress of the reading, as a fraction of one, some hundred times a second, always on the
/// thread that reads; it returns whether to continue.
#[derive(Clone, Copy)]
pub struct Watch<'a>(&'a dyn Fn(f32) -> bool);

impl<'a> Watch<'a> {
    /// Watches with a function.
    pub fn new(go_on: &'a dyn Fn(f32) -> bool) -> Self {
        Self(go_on)
    }

    /// Watches nothing and never stops.
    pub fn none() -> Self {
        Self(&|_| true)
    }
}

/// Warnings and progress of a reader.
pub(super) struct Log<'a> {
    pub(super) warnings: Vec<Warning>,
    /// Places of samples, if they are recorded.
    pub(super) places: Option<Places<'a>>,
    watch: Watch<'a>,
    /// Number of bytes to read.
    whole: usize,
    /// The watch is looked at again from this byte on.
    next: usize,
    /// Bytes looked at since the watch was, however often each.
    worked: Cell<usize>,
}

impl<'a> Log<'a> {
    /// Maximum number of listed warnings of one kind.
    const MOST_ALIKE: usize = 20;

    /// Bytes between two looks at the watch: some milliseconds of reading.
    const STRIDE: usize = 1 << 18;

    pub(super) fn new(watch: Watch<'a>, whole: usize) -> Self {
        Self { warnings: Vec::new(), places: None, watch, whole, next: Self::STRIDE, worked: Cell::new(0) }
    }

    /// Adds a warning, or counts it where there are many of its kind.
    pub(super) fn push(&mut self, warning: Warning) {
        let kind = discriminant(&warning);
        let same = self.warnings.iter().filter(|other| discriminant(*other) == kind).count();
        let counted = matches!(self.warnings.last(), Some(Warning::More(..)));
        match self.warnings.last_mut() {
            Some(Warning::More(count)) if same >= Self::MOST_ALIKE => *count += 1,
            _ if same >= Self::MOST_ALIKE => self.warnings.push(Warning::More(1)),
            // The count of those that are not listed stays the last.
            _ if counted => self.warnings.insert(self.warnings.len() - 1, warning),
            _ => self.warnings.push(warning),
        }
    }

    pub(super) fn extend(&mut self, warnings: impl IntoIterator<Item = Warning>) {
        warnings.into_iter().for_each(|warning| self.push(warning));
    }

    /// Reports that the reader is at a byte of the text; an error if the caller stops it.
    #[inline]
    pub(super) fn at(&mut self, byte: usize) -> Result<(), ReadError> {
        if byte < self.next {
            return Ok(());
        }
        self.next = byte.saturating_add(Self::STRIDE);
        self.look(byte)
    }

    /// Reports that a number of bytes was examined, for the first time or again, and that the reader is at a byte of the text; an
    /// error if the caller stops it.
    #[inline]
    pub(super) fn work(&self, bytes: usize, at: usize) -> Result<(), ReadError> {
        let worked = self.worked.get() + bytes;
        if worked < Self::STRIDE {
            self.worked.set(worked);
            return Ok(());
        }
        self.worked.set(0);
        self.look(at)
    }

    /// Polls the watch immediately: before and after long steps.
    pub(super) fn look(&self, byte: usize) -> Result<(), ReadError> {
        let share = byte.min(self.whole) as f32 / self.whole.max(1) as f32;
        if (self.watch.0)(share) { Ok(()) } else { Err(ReadError::Stopped) }
    }
}
