//! Positions of the numbers of a document, parsed again by the same parser if a preview needs them.

use serde::Deserialize;
use serde_json::value::RawValue;

use crate::formats::json::document::InOrder;
use crate::header::Header;
use crate::places::{PlaceKind, Places};

type Numbers<'a> = Option<Vec<&'a RawValue>>;

/// The members that hold numbers, as they are written.
#[derive(Deserialize)]
struct Members<'a> {
    #[serde(borrow)]
    ssf_bands: Numbers<'a>,
    #[serde(borrow)]
    red_ssf: Numbers<'a>,
    #[serde(borrow)]
    green_ssf: Numbers<'a>,
    #[serde(borrow)]
    blue_ssf: Numbers<'a>,
    #[serde(borrow)]
    bands: Numbers<'a>,
    #[serde(borrow)]
    spectrum: Option<&'a RawValue>,
    #[serde(borrow)]
    spectral_data: Option<Groups<'a>>,
}

#[derive(Deserialize)]
struct Groups<'a> {
    #[serde(borrow)]
    data: InOrder<InOrder<Vec<&'a RawValue>>>,
}

/// Records the numbers of a document, whose bytes are those of the text: those of one group where it has several.
pub(super) fn record(text: &str, group: usize, places: &mut Places<'_>) {
    let Ok(members) = serde_json::from_str::<Members<'_>>(text) else { return };
    let mut at = Recorder { text, places };
    if let Some(group) = members.spectral_data.and_then(|groups| groups.data.0.into_iter().nth(group)) {
        group.1.0.iter().for_each(|(key, row)| at.row(key, row));
        return;
    }
    let (bands, lists) = match (members.ssf_bands, members.bands, members.spectrum) {
        (Some(bands), ..) => (bands, vec![members.red_ssf, members.green_ssf, members.blue_ssf]),
        (None, Some(bands), Some(list)) => (bands, vec![serde_json::from_str(list.get()).ok()]),
        _ => return,
    };
    let lists: Vec<Vec<&RawValue>> = lists.into_iter().flatten().collect();
    let wavelengths = wavelengths(&bands, lists.first().map_or(0, Vec::len));
    if wavelengths.len() == bands.len() {
        at.list(&bands, PlaceKind::Wavelength, 0, &wavelengths);
    }
    for (curve, list) in lists.iter().enumerate() {
        at.list(list, PlaceKind::Value, curve, &wavelengths);
    }
}

/// The wavelengths of a list, or a range for the given number of values.
fn wavelengths(bands: &[&RawValue], values: usize) -> Vec<f64> {
    let bands: Vec<f64> = bands.iter().filter_map(|band| band.get().parse().ok()).collect();
    if bands.len() == values { bands } else { crate::formats::json::content::range(&bands).unwrap_or_default() }
}

/// Lines of a header's members, each sought behind the one before.
pub(super) fn note_lines(text: &str, header: &mut Header) {
    let (mut from, mut line) = (0, 1);
    for ((key, _), noted) in header.comments.iter().zip(&mut header.noted) {
        let Some(at) = text[from..].find(&format!("\"{key}\"")) else { continue };
        line += text[from..from + at].bytes().filter(|byte| *byte == b'\n').count();
        from += at;
        *noted = line as u32;
    }
}

struct Recorder<'a, 'b, 'c> {
    text: &'a str,
    places: &'b mut Places<'c>,
}

impl Recorder<'_, '_, '_> {
    fn offset(&self, piece: &str) -> usize {
        piece.as_ptr().addr().saturating_sub(self.text.as_ptr().addr())
    }

    fn list(&mut self, numbers: &[&RawValue], kind: PlaceKind, curve: usize, wavelengths: &[f64]) {
        for (number, wavelength) in numbers.iter().zip(wavelengths) {
            self.number(number, kind, curve, *wavelength);
        }
    }

    fn number(&mut self, number: &RawValue, kind: PlaceKind, curve: usize, wavelength: f64) {
        if number.get() != "null" {
            let place = self.places.add_at(kind, self.offset(number.get()), number.get().len());
            self.places.assign(place, curve, wavelength);
        }
    }

    /// A wavelength as a key, before a number for each curve.
    fn row(&mut self, key: &str, row: &[&RawValue]) {
        let (Some(first), Ok(wavelength)) = (row.first(), key.trim().parse()) else { return };
        let before = self.text.get(..self.offset(first.get())).unwrap_or_default().trim_end();
        let before = before.strip_suffix('[').and_then(|text| text.trim_end().strip_suffix(':'));
        if let Some(written) = before.and_then(|text| text.trim_end().strip_suffix('"'))
            && written.ends_with(key)
        {
            let place = self.places.add_at(PlaceKind::Wavelength, written.len() - key.len(), key.len());
            self.places.assign(place, 0, wavelength);
        }
        for (curve, number) in row.iter().enumerate() {
            self.number(number, PlaceKind::Value, curve, wavelength);
        }
    }
}
