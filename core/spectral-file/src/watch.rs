//! Reading that is watched: how far it is, the wish to stop, warnings, and places of samples in the text, recorded by the readers for
//! a preview and else not at all.

use std::cell::Cell;
use std::mem::discriminant;

use crate::error::ReadError;
use crate::text::Lines;
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

pub(super) struct Log<'a> {
    pub(super) warnings: Vec<Warning>,
    pub(super) places: Option<Places<'a>>,
    watch: Watch<'a>,
    whole: usize,
    /// The watch is looked at again from this byte on.
    next: usize,
    /// Bytes looked at since the watch was, however often each.
    worked: Cell<usize>,
}

impl<'a> Log<'a> {
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

    /// Takes back the warning of thousands; returns whether there was one.
    pub(super) fn drop_doubt_of_thousands(&mut self) -> bool {
        let count = self.warnings.len();
        self.warnings.retain(|warning| *warning != Warning::MaybeThousands);
        self.warnings.len() < count
    }

    /// Returns whether rows were put in another order.
    pub(super) fn has_sorted(&self) -> bool {
        self.warnings.iter().any(|warning| matches!(warning, Warning::Sorted(_)))
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct PlaceId(u32);

impl PlaceId {
    pub(super) fn after(self, count: usize) -> Self {
        if self.0 == 0 { self } else { Self(self.0.saturating_add(count as u32)) }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlaceKind {
    Wavelength,
    Value,
    Block,
    /// A line that only repeats the last of the compressed values above it.
    Check,
    Repeated,
    /// One of several values at a wavelength, of which the mean is taken.
    Averaged,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) start: u32,
    pub(super) end: u32,
    pub(super) kind: PlaceKind,
    /// The origin of the curve; [`UNUSED`] where no curve took the sample.
    pub(super) origin: u32,
    /// In the unit of the file.
    pub(super) wavelength: f64,
}

pub(super) const UNUSED: u32 = u32::MAX;

#[derive(Debug)]
pub(super) struct Places<'a> {
    text: &'a str,
    all: Vec<Place>,
}

impl<'a> Places<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, all: Vec::new() }
    }

    /// The places that curves took, in the order of the text.
    pub(super) fn used(self) -> Vec<Place> {
        let mut all = self.all;
        all.retain(|place| place.origin != UNUSED);
        all.sort_unstable_by_key(|place| place.start);
        all.shrink_to_fit();
        all
    }

    pub(super) fn line(&self, number: usize) -> &'a str {
        Lines::new(self.text).find(|(other, _)| *other == number).map_or("", |(_, line)| line)
    }

    /// Records a piece of the text; nothing where the piece is a copy.
    pub(super) fn add(&mut self, kind: PlaceKind, piece: &str) -> PlaceId {
        let start = piece.as_ptr().addr().wrapping_sub(self.text.as_ptr().addr());
        self.add_at(kind, start, piece.len())
    }

    pub(super) fn add_at(&mut self, kind: PlaceKind, start: usize, length: usize) -> PlaceId {
        let Some(end) = start.checked_add(length).filter(|end| *end <= self.text.len()) else {
            return PlaceId::default();
        };
        self.all.push(Place { start: start as u32, end: end as u32, kind, origin: UNUSED, wavelength: f64::NAN });
        PlaceId(self.all.len() as u32)
    }

    pub(super) fn pair(&mut self, wavelength: &str, value: &str) -> PlaceId {
        self.add(PlaceKind::Wavelength, wavelength);
        self.add(PlaceKind::Value, value)
    }

    /// Records a word that stands at or after a byte, behind white space only, and moves the byte behind it.
    pub(super) fn find(&mut self, from: &mut usize, word: &str) -> PlaceId {
        let rest = self.text.get(*from..).unwrap_or_default();
        let start = *from + rest.len() - rest.trim_ascii_start().len();
        if !rest.trim_ascii_start().starts_with(word) {
            return PlaceId::default();
        }
        *from = start + word.len();
        self.add_at(PlaceKind::Value, start, word.len())
    }

    /// Gives a place to a sample of a curve, with the wavelength just before it and the check just behind it.
    pub(super) fn assign(&mut self, id: PlaceId, origin: usize, wavelength: f64) {
        let Some(at) = id.0.checked_sub(1).map(|at| at as usize) else { return };
        let from = at.saturating_sub(1);
        for (index, place) in self.all.iter_mut().enumerate().take(at + 2).skip(from) {
            let beside = if index < at { PlaceKind::Wavelength } else { PlaceKind::Check };
            if index == at || (place.kind == beside && place.origin == UNUSED) {
                (place.origin, place.wavelength) = (origin as u32, wavelength);
            }
        }
    }

    /// Marks the value at a place as one that is in no curve by itself.
    pub(super) fn merge(&mut self, id: PlaceId, kind: PlaceKind, origin: usize, wavelength: f64) {
        self.assign(id, origin, wavelength);
        if let Some(place) = id.0.checked_sub(1).and_then(|at| self.all.get_mut(at as usize)) {
            place.kind = kind;
        }
    }
}
