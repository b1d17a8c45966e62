//! Choices made of the first bytes of an input.

use spectral_file::{DecimalMark, Delimiter, Orientation, ReadOptions, Reader, Role, Values, WavelengthUnit};

/// Number of bytes that determine the choices.
pub const LENGTH: usize = 6;

/// One of several, or none where the number is 0 or beyond them.
fn pick<T: Copy>(all: &[T], number: u8) -> Option<T> {
    all.get(usize::from(number).wrapping_sub(1)).copied()
}

/// One of the labeled choices, or none.
fn choose<T: Copy>(all: &[(T, &str)], number: u8) -> Option<T> {
    pick(all, number).map(|(choice, _)| choice)
}

/// The choices and the rest of an input; zeros choose nothing.
pub fn split(input: &[u8]) -> Option<(ReadOptions, &[u8])> {
    let ([reader, cells, axis, values, part, column], rest) = input.split_first_chunk::<LENGTH>()?;
    let options = ReadOptions {
        reader: pick(&Reader::ALL, *reader),
        delimiter: choose(Delimiter::CHOICES, cells & 15),
        decimal_mark: choose(DecimalMark::CHOICES, cells >> 4),
        orientation: choose(Orientation::CHOICES, axis & 15),
        wavelength_unit: choose(WavelengthUnit::CHOICES, axis >> 4),
        values: choose(Values::CHOICES, values & 15),
        role: choose(Role::CHOICES, values >> 4),
        part: (*part & 15 > 0).then_some(usize::from(part & 15)),
        raw: pick(&[true, false], part >> 4),
        wavelength_column: (*column > 0).then_some(usize::from(*column)),
        ..ReadOptions::default()
    };
    Some((options, rest))
}

/// The bytes that choose a reader by its number from 1 and nothing else; 0 for none.
pub fn only_reader(reader: u8) -> [u8; LENGTH] {
    [reader, 0, 0, 0, 0, 0]
}

/// Number of readers to choose from.
pub const fn readers() -> u8 {
    Reader::ALL.len() as u8
}
