//! Files in which the values of a curve stand one after the other, without wavelengths beside them.

use super::super::{Curve, Reader, Table};
use super::Preview;
use super::cells::Conversion;
use super::pairs::{Spot, lines};
use super::stream::{Kind, Numbers, Placed};

/// How often each number may be looked at on average, so that no text takes long.
const LOOKS: usize = 16;

/// The values of each camera and channel in a database of them.
const BANDS: usize = 33;

/// Finds the curves of a table among the numbers of its text.
pub(super) fn place(preview: &Preview, table: &Table) -> Vec<Placed> {
    let reading = &table.reading;
    let conversion = Conversion::of(table);
    let mut all = Vec::new();
    let numbers: Vec<Spot> = match reading.reader.value {
        Reader::Cgats => {
            let fields = fields(preview, table);
            find_wavelengths(&fields, table, &mut all);
            let rows = lines(preview, reading.first_data_line);
            let rows = rows.take_while(|(_, line)| !line.trim_start().starts_with("END_DATA"));
            rows.flat_map(|(start, line)| spots(start, line, true)).collect()
        }
        Reader::Camspec => {
            let rows = lines(preview, 1).map(|(start, line)| spots(start, line, false));
            rows.filter(|row| row.len() == BANDS).flatten().collect()
        }
        _ => {
            let numbers: Vec<Spot> = lines(preview, 1).flat_map(|(start, line)| spots(start, line, false)).collect();
            if reading.reader.value == Reader::Dcamprof {
                find_wavelengths(&numbers, table, &mut all);
            }
            numbers
        }
    };
    find(&numbers, conversion, table, &mut all);
    all.sort_unstable_by_key(|piece| piece.start);
    // Wavelengths that look like values, as in a list of both, are one or the other.
    all.dedup_by_key(|piece| piece.start);
    all
}

/// The numbers of a line that stand alone.
fn spots(start: usize, line: &str, comma: bool) -> Vec<Spot> {
    let alone = Numbers::new(line, comma).filter(|number| !number.glued);
    alone.map(|number| Spot { line: start, number }).collect()
}

/// The numbers at the ends of the names of fields.
fn fields(preview: &Preview, table: &Table) -> Vec<Spot> {
    let from = table.reading.header_line.unwrap_or(1);
    let until = table.reading.first_data_line;
    let format = preview.lines_from(from).take_while(|(number, _)| *number < until);
    let mut all = Vec::new();
    for (number, line) in format {
        let start = preview.start(number).unwrap_or(0);
        let ends = |end: usize| line[end..].chars().next().is_none_or(|c| c.is_whitespace() || c == '"');
        let numbers = Numbers::new(line, false).filter(|number| ends(number.range.end));
        all.extend(numbers.map(|number| Spot { line: start, number }));
    }
    all
}

/// Finds the wavelengths of a table as a run of numbers, which may be rounded.
fn find_wavelengths(numbers: &[Spot], table: &Table, all: &mut Vec<Placed>) {
    const ROUNDING_NM: f64 = 1.0;
    let longest =
        table.curves.iter().enumerate().max_by_key(|(index, curve)| (curve.values.len(), std::cmp::Reverse(*index)));
    let Some((index, curve)) = longest else { return };
    let unit = table.reading.wavelength_unit.value;
    let near = |spot: &Spot, sample: usize| {
        (unit.nanometers(spot.number.value.abs()) - curve.wavelengths_nm[sample]).abs() <= ROUNDING_NM
    };
    let mut looks = LOOKS * numbers.len();
    let run = Run { length: length(curve), step: 1, descending: table.reading.descending };
    if let Some(at) = run.find(numbers, 0, &mut looks, near) {
        for (spot, sample) in run.samples(numbers, at) {
            let mut range = spot.number.range.clone();
            // What looks like a sign belongs to the name of the field.
            range.start += usize::from(spot.number.value < 0.0);
            all.push(Placed::new(spot.line, &range, Kind::Wavelength, index, sample));
        }
    }
}

/// Finds the values of each curve as a run of numbers, one after the other.
pub(super) fn find(numbers: &[Spot], conversion: Conversion, table: &Table, all: &mut Vec<Placed>) {
    let mut looks = LOOKS * numbers.len();
    let mut from = 0;
    for (index, curve) in table.curves.iter().enumerate() {
        from = place_curve(numbers, from, &mut looks, (index, curve), conversion, table, all).unwrap_or(from);
    }
}

/// Places one curve; gives where the numbers after it begin.
pub(super) fn place_curve(
    numbers: &[Spot],
    from: usize,
    looks: &mut usize,
    (index, curve): (usize, &Curve),
    conversion: Conversion,
    table: &Table,
    all: &mut Vec<Placed>,
) -> Option<usize> {
    let unit = table.reading.wavelength_unit.value;
    let value = |spot: &Spot, sample: usize| conversion.gives(spot.number.value, curve.values[sample]);
    let wavelength = |spot: &Spot, sample: usize| unit.nanometers(spot.number.value) == curve.wavelengths_nm[sample];
    let mut run = Run { length: length(curve), step: 1, descending: table.reading.descending };
    if let Some(at) = run.find(numbers, from, looks, value) {
        all.extend(run.samples(numbers, at).map(|(spot, sample)| spot.placed(Kind::Value, index, sample)));
        return Some(at + run.length);
    }
    run.step = 2;
    let at = run.find(numbers, from, looks, wavelength)?;
    if !run.samples(numbers, at + 1).all(|(spot, sample)| value(spot, sample)) {
        return None;
    }
    all.extend(run.samples(numbers, at).map(|(spot, sample)| spot.placed(Kind::Wavelength, index, sample)));
    all.extend(run.samples(numbers, at + 1).map(|(spot, sample)| spot.placed(Kind::Value, index, sample)));
    Some(at + 2 * run.length)
}

impl Spot {
    fn placed(&self, kind: Kind, curve: usize, sample: usize) -> Placed {
        Placed::new(self.line, &self.number.range, kind, curve, sample)
    }
}

/// The samples of a curve.
fn length(curve: &Curve) -> usize {
    curve.values.len().min(curve.wavelengths_nm.len())
}

/// Numbers at equal distances that are the samples of a curve in order.
#[derive(Debug, Clone, Copy)]
struct Run {
    length: usize,
    step: usize,
    descending: bool,
}

impl Run {
    /// The numbers of the run that begins at one, each with its sample.
    fn samples(self, numbers: &[Spot], at: usize) -> impl Iterator<Item = (&Spot, usize)> {
        let run = numbers.get(at..).unwrap_or(&[]).iter().step_by(self.step).take(self.length);
        let sample = move |i: usize| if self.descending { self.length - 1 - i } else { i };
        run.enumerate().map(move |(i, spot)| (spot, sample(i)))
    }

    /// Where the first such run begins; given up when `looks` are used up.
    fn find(
        self,
        numbers: &[Spot],
        from: usize,
        looks: &mut usize,
        is: impl Fn(&Spot, usize) -> bool,
    ) -> Option<usize> {
        let last = numbers.len().checked_sub(self.length * self.step)?;
        for at in from..=last {
            let same = self.samples(numbers, at).take_while(|(spot, sample)| is(spot, *sample)).count();
            if same == self.length {
                return Some(at);
            }
            *looks = looks.checked_sub(same + 1)?;
        }
        None
    }
}
