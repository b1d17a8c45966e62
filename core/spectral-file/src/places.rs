//! Places of samples in the text, recorded by the readers for a preview and else not at all.

use crate::text::Lines;

/// A recorded place, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct PlaceId(u32);

impl PlaceId {
    /// The place recorded `count` places later.
    pub(super) fn after(self, count: usize) -> Self {
        if self.0 == 0 { self } else { Self(self.0.saturating_add(count as u32)) }
    }
}

/// Content of a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlaceKind {
    Wavelength,
    Value,
    /// Compressed values.
    Block,
    /// A line that only repeats the last of the compressed values above it.
    Check,
    /// A sample that repeats an earlier one.
    Repeated,
    /// One of several values at a wavelength, of which the mean is taken.
    Averaged,
}

/// Bytes of the text, and the sample that they hold.
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

/// The origin of a place that is in no curve.
pub(super) const UNUSED: u32 = u32::MAX;

/// The places recorded in a text, in the order of reading.
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

    /// A line of the text, by its number from 1.
    pub(super) fn line(&self, number: usize) -> &'a str {
        Lines::new(self.text).find(|(other, _)| *other == number).map_or("", |(_, line)| line)
    }

    /// Records a piece of the text; nothing where the piece is a copy.
    pub(super) fn add(&mut self, kind: PlaceKind, piece: &str) -> PlaceId {
        let start = piece.as_ptr().addr().wrapping_sub(self.text.as_ptr().addr());
        self.add_at(kind, start, piece.len())
    }

    /// Records bytes of the text.
    pub(super) fn add_at(&mut self, kind: PlaceKind, start: usize, length: usize) -> PlaceId {
        let Some(end) = start.checked_add(length).filter(|end| *end <= self.text.len()) else {
            return PlaceId::default();
        };
        self.all.push(Place { start: start as u32, end: end as u32, kind, origin: UNUSED, wavelength: f64::NAN });
        PlaceId(self.all.len() as u32)
    }

    /// Records a value and the wavelength beside it.
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
