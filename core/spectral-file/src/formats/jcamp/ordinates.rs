//! Places of ordinates: from the first abscissa and the step of the header, held against the abscissa at the head of each line.
//!
//! A line that stands elsewhere than its abscissa says is placed by the abscissa, if that leaves no two values for one place. What
//! contradicts itself beyond the rounding of the digits written is refused.

use crate::decimal::{clean, last_digit};
use crate::error::ReadError;
use crate::formats::spectra::Sample;
use crate::warning::{LineList, Warning};
use crate::watch::{PlaceId, PlaceKind, Places};

/// A number and the unit of its last digit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Written {
    pub(super) value: f64,
    pub(super) digit: f64,
}

impl Written {
    pub(super) fn parse(text: &str) -> Option<Self> {
        let text = text.trim().replace(',', ".");
        let value = text.parse::<f64>().ok().filter(|number| number.is_finite())?;
        Some(Self { value, digit: last_digit(&text) })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) line: usize,
    /// The abscissa at its head, without a factor.
    pub(super) head: Written,
    /// The first of its ordinates among all of the block.
    pub(super) from: usize,
    /// True if the line before ended with a difference, so that this one begins by repeating its last ordinate.
    pub(super) repeats: bool,
    /// The place of its first ordinate, or of all of them.
    pub(super) place: PlaceId,
    pub(super) block: bool,
}

impl Row {
    fn place(&self, index: usize) -> PlaceId {
        if self.block { self.place } else { self.place.after(index) }
    }
}

/// Records a line of ordinates, and returns whether they are compressed, so that only the line has a place.
pub(super) fn record(line: &str, values: usize, repeats: bool, places: &mut Places<'_>) -> (PlaceId, bool) {
    let mut entries = line.split(|c: char| c.is_whitespace() || c == ',').filter(|entry| !entry.is_empty());
    let is_plain = |entry: &str| entry == "?" || entry.parse::<f64>().is_ok();
    if entries.clone().count() != values + 1 || !entries.clone().all(is_plain) {
        let kind = if repeats && values == 1 { PlaceKind::Check } else { PlaceKind::Block };
        return (places.add(kind, line.trim()), true);
    }
    places.add(PlaceKind::Wavelength, entries.next().unwrap_or_default());
    let mut ids = entries.map(|entry| places.add(PlaceKind::Value, entry));
    let first = ids.next().unwrap_or_default();
    ids.for_each(drop);
    (first, false)
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    pub(super) first: Written,
    pub(super) last: Option<Written>,
    pub(super) delta: Option<(usize, Written)>,
    pub(super) points: Option<usize>,
    pub(super) factor: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Digits {
    Rounded,
    Cut,
    /// The header is rounded too.
    Loose,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Data<'a> {
    pub(super) rows: &'a [Row],
    pub(super) ordinates: &'a [f64],
}

#[derive(Debug, Default)]
pub(super) struct Placed {
    pub(super) samples: Vec<Sample>,
    pub(super) warnings: Vec<Warning>,
    moved: LineList,
    /// Lines that lack a value somewhere: omitted.
    short: LineList,
}

impl Data<'_> {
    fn values(&self, index: usize) -> &[f64] {
        let end = self.rows.get(index + 1).map_or(self.ordinates.len(), |next| next.from);
        &self.ordinates[self.rows[index].from..end]
    }

    /// Returns whether every line after a difference begins with the last ordinate of the line before it.
    fn always_repeats(&self) -> bool {
        let mut pairs = self.rows.windows(2).filter(|pair| pair[1].repeats && pair[1].from < self.ordinates.len());
        pairs.all(|pair| pair[1].from == 0 || same(self.ordinates[pair[1].from], self.ordinates[pair[1].from - 1]))
    }

    /// Ordinates without those that only repeat.
    fn count(&self) -> usize {
        let again = self.rows.iter().filter(|row| row.repeats).count();
        self.ordinates.len() - if self.always_repeats() { again } else { 0 }
    }

    pub(super) fn place(&self, axis: &Axis) -> Result<Placed, ReadError> {
        let line = self.rows.first().map_or(1, |row| row.line);
        let (steps, contradicted) = axis.steps(self.count());
        let (mut moved, mut error) = (None, None);
        for &step in &steps {
            for digits in [Digits::Rounded, Digits::Cut, Digits::Loose] {
                match (Grid { axis, step, digits }).place(self) {
                    Ok(mut placed) if placed.moved.is_empty() && placed.short.is_empty() => {
                        if let Some((line, delta)) = contradicted {
                            if self.rows.len() < 2 {
                                return Err(ReadError::StepContradicts { line, announced: delta, found: steps[0] });
                            }
                            let found = step / axis.factor.abs();
                            let differs = Warning::HeaderDiffers { line, label: "DELTAX", announced: delta, found };
                            placed.warnings.extend((step != delta).then_some(differs));
                        }
                        return Ok(placed);
                    }
                    Ok(placed) => moved = moved.or(Some(placed)),
                    Err(other) => error = error.or(Some(other)),
                }
            }
        }
        if let Some(placed) = self.as_counted(axis) {
            return Ok(placed);
        }
        if let Some(mut placed) = moved {
            let (lines, short) = (std::mem::take(&mut placed.moved), std::mem::take(&mut placed.short));
            let moved = (!lines.is_empty()).then_some(Warning::PlacedByAbscissa(lines));
            let short = (!short.is_empty()).then_some(Warning::ShortLines(short));
            placed.warnings.splice(0..0, short.into_iter().chain(moved));
            return Ok(placed);
        }
        let error = error.unwrap_or(ReadError::NoWavelengths(line));
        self.points(axis).or_else(|| self.by_ends(axis)).ok_or(error)
    }

    /// The ordinates in equal steps between the ends of the header, where their number is the announced one and the heads of lines
    /// are those of the values there or of the neighbors, as far as all are rounded.
    fn by_ends(&self, axis: &Axis) -> Option<Placed> {
        const SUMMED: f64 = 0.05;
        let (last, points) = (axis.last?, axis.points.filter(|points| *points == self.ordinates.len())?);
        let step = (last.value - axis.first.value) / points.saturating_sub(1) as f64;
        let grid = Grid { axis, step, digits: Digits::Loose };
        let off = |row: &Row| (row.head.value * axis.factor - grid.abscissa(row.from as f64)).abs();
        let digits = |row: &Row| row.head.digit * axis.factor.abs() + axis.first.digit + last.digit;
        // What a program summed up in single precision names the place all the same.
        let summed = |row: &Row| off(row) <= SUMMED * step.abs();
        let near = |row: &Row| off(row).min((off(row) - step.abs()).abs()) <= digits(row) || summed(row);
        if self.rows.len() < 2 || !self.rows.iter().all(near) {
            return None;
        }
        let moved: LineList = self.rows.iter().filter(|row| off(row) > digits(row)).map(|row| row.line).collect();
        let head = |row: &Row| Written { value: grid.abscissa(row.from as f64) / axis.factor, ..row.head };
        let rows: Vec<Row> = self.rows.iter().map(|row| Row { head: head(row), ..*row }).collect();
        let mut placed = grid.place(&Data { rows: &rows, ordinates: self.ordinates }).ok()?;
        placed.warnings.extend((!moved.is_empty()).then_some(Warning::PlacedByEnds(moved)));
        Some(placed)
    }

    /// The ordinates where all lines and both ends agree with their number, and only the announced number does not.
    fn as_counted(&self, axis: &Axis) -> Option<Placed> {
        let count = self.count();
        axis.points.filter(|points| *points != count && self.rows.len() > 1)?;
        axis.last?;
        let axis = Axis { points: Some(count), ..*axis };
        let (steps, contradicted) = axis.steps(count);
        let step = *steps.first().filter(|_| contradicted.is_none())?;
        [Digits::Rounded, Digits::Cut].into_iter().find_map(|digits| {
            let placed = Grid { axis: &axis, step, digits }.place(self).ok()?;
            (placed.moved.is_empty() && placed.short.is_empty()).then_some(placed)
        })
    }

    /// Returns whether a line lacks values by where the next line begins: less than would make it a full line.
    fn is_short(&self, index: usize, lacking: usize, longest: usize) -> bool {
        let sums = self.rows[index].repeats || self.rows.get(index + 1).is_some_and(|next| next.repeats);
        !sums && lacking > 0 && self.values(index).len() + lacking <= longest
    }

    /// The ordinates at the abscissas beside them, where each line has one and the ends are those of the header: then the steps
    /// are not equal.
    fn points(&self, axis: &Axis) -> Option<Placed> {
        let (first, last) = (self.rows.first()?, self.rows.last()?);
        let ends =
            |row: &Row, end: Written| (row.head.value * axis.factor - end.value).abs() <= row.head.digit + end.digit;
        let whole =
            self.rows.len() == self.ordinates.len() && axis.points.is_none_or(|points| points == self.rows.len());
        let ordered =
            |sign: f64| self.rows.windows(2).all(|pair| sign * (pair[1].head.value - pair[0].head.value) > 0.0);
        if !(whole && ends(first, axis.first) && ends(last, axis.last?) && (ordered(1.0) || ordered(-1.0))) {
            return None;
        }
        let samples = self.rows.iter().zip(self.ordinates).map(|(row, &value)| Sample {
            wavelength: clean(row.head.value * axis.factor),
            value,
            line: row.line,
            place: row.place(0),
        });
        Some(Placed { samples: samples.collect(), ..Placed::default() })
    }
}

impl Axis {
    /// The steps that the header allows, the likelier first, and DELTAX where it contradicts the rest.
    fn steps(&self, count: usize) -> (Vec<f64>, Option<(usize, f64)>) {
        let span = self.last.map(|last| last.value - self.first.value);
        let signed = |delta: f64| match span {
            Some(span) if span != 0.0 => delta.abs() * span.signum(),
            _ => delta,
        };
        let delta = self.delta.map(|(_, delta)| signed(delta.value)).filter(|delta| *delta != 0.0);
        let intervals = |points: usize| points.saturating_sub(1) as f64;
        let from_ends = span.zip(self.points.or_else(|| delta.is_none().then_some(count)));
        let from_ends = from_ends.map(|(span, points)| span / intervals(points)).filter(|step| step.is_normal());
        let mut contradicted = None;
        if let (Some((line, written)), Some(delta), Some(step), Some(points)) =
            (self.delta, delta, from_ends, self.points)
        {
            let digits = self.first.digit + self.last.map_or(0.0, |last| last.digit);
            let slack = (written.digit / 2.0 + 1e-6 * step.abs()) * intervals(points) + digits / 2.0;
            contradicted = ((delta - step).abs() * intervals(points) > slack).then_some((line, delta));
        }
        let second = delta.filter(|_| from_ends.is_none() || contradicted.is_some());
        (from_ends.into_iter().chain(second).collect(), contradicted)
    }

    fn most(&self, step: f64) -> Option<f64> {
        let from_ends = || self.last.map(|last| ((last.value - self.first.value) / step).round() + 1.0);
        self.points.map(|points| points as f64).or_else(from_ends)
    }
}

struct Grid<'a> {
    axis: &'a Axis,
    step: f64,
    digits: Digits,
}

impl Grid<'_> {
    fn abscissa(&self, index: f64) -> f64 {
        self.axis.first.value + self.step * index
    }

    /// Returns whether the head of a line can be the abscissa of an index.
    fn fits(&self, head: Written, index: f64) -> bool {
        let (digit, step) = (head.digit * self.axis.factor.abs(), self.step.abs());
        let noise = 1e-6 * (digit + step);
        let head = head.value * self.axis.factor;
        // How far the abscissa is from what is written of it, away from zero.
        let beyond = (self.abscissa(index) - head) * if head < 0.0 { -1.0 } else { 1.0 };
        let fine = digit <= step / 2.0;
        match self.digits {
            Digits::Cut if !fine => beyond >= -noise && beyond < digit - noise,
            Digits::Rounded | Digits::Cut => beyond.abs() <= if fine { digit } else { digit / 2.0 } + noise,
            Digits::Loose => {
                let ends = self.axis.first.digit + self.axis.last.map_or(0.0, |last| last.digit);
                let steps = match self.axis.delta {
                    Some((_, delta)) if self.axis.last.is_none() => delta.digit / 2.0 * index,
                    _ => 0.0,
                };
                beyond.abs() <= digit + ends / 2.0 + steps + noise
            }
        }
    }

    /// The index that the head of a line names, if its digits distinguish it from the next.
    fn index(&self, head: Written) -> Option<usize> {
        let resolved = self.digits != Digits::Loose && head.digit * self.axis.factor.abs() <= self.step.abs() * 1.000_1;
        let index = ((head.value * self.axis.factor - self.axis.first.value) / self.step).round();
        let within = (0.0..1e12).contains(&index) && resolved && self.fits(head, index);
        within.then_some(index as usize)
    }

    fn place(&self, data: &Data<'_>) -> Result<Placed, ReadError> {
        let checks = data.always_repeats() && self.axis.points != Some(data.ordinates.len());
        if self.digits == Digits::Loose && self.axis.points.is_some_and(|points| points != data.count()) {
            return Err(self.misplaced(data, 0, 0));
        }
        let mut all: Vec<(usize, Sample)> = Vec::with_capacity(data.ordinates.len());
        let (mut moved, mut short) = (LineList::default(), LineList::default());
        let longest = (0..data.rows.len()).map(|at| data.values(at).len()).max().unwrap_or(0);
        let (mut next, mut first_moved) = (0_usize, None);
        // Lines that begin at the abscissa of the value they repeat, as they should, and the first that does not.
        let (mut standard, mut other) = (false, None);
        for (at, row) in data.rows.iter().enumerate() {
            let mut values = data.values(at);
            let Some(&first) = values.first() else { continue };
            let index = if row.repeats && next > 0 && self.fits(row.head, (next - 1) as f64) {
                let last = all.last().map_or(f64::NAN, |(_, last)| last.value);
                if !same(first, last) {
                    let before = all.last().map_or(row.line, |(_, last)| last.line);
                    return Err(ReadError::CheckFails { line: row.line, found: first, before, expected: last });
                }
                values = &values[1..];
                standard = true;
                next
            } else if self.fits(row.head, next as f64) {
                // Some programs write the abscissa of what follows the repeated ordinate, or repeat none.
                if row.repeats {
                    other = other.or(Some((at, next.saturating_sub(1))));
                }
                values = &values[usize::from(row.repeats && checks)..];
                next
            } else {
                let named = self.index(row.head).ok_or_else(|| self.misplaced(data, at, next))?;
                first_moved = first_moved.or(Some((at, next)));
                if at > 0 && data.is_short(at - 1, named.saturating_sub(next), longest) {
                    // The position of the missing value in the line before is unknown.
                    let before = data.rows[at - 1].line;
                    short.add(before);
                    while all.pop_if(|(_, sample)| sample.line == before).is_some() {}
                } else {
                    moved.add(row.line);
                }
                named
            };
            let skipped = data.values(at).len() - values.len();
            let samples = values.iter().enumerate().map(|(offset, &value)| {
                let (index, place) = (index + offset, row.place(offset + skipped));
                (index, Sample { wavelength: clean(self.abscissa(index as f64)), value, line: row.line, place })
            });
            all.extend(samples);
            next = index + values.len();
        }
        let whole = self.axis.points.is_none_or(|points| points == all.len());
        if let Some((at, expected)) = other.filter(|_| standard || !whole) {
            return Err(self.misplaced(data, at, expected));
        }
        let mut warnings = Vec::new();
        if let Some((at, expected)) = first_moved {
            let most = self.axis.most(self.step);
            let last = all.iter().map(|(index, _)| *index).max().unwrap_or(0);
            if most.map_or(at == 0, |most| last as f64 >= most) {
                return Err(self.misplaced(data, at, expected));
            }
            all.sort_by_key(|(index, _)| *index);
            let again = merge(&mut all)?;
            warnings.extend((!again.is_empty()).then_some(Warning::RepeatedRows(again)));
        }
        let samples = all.into_iter().map(|(_, sample)| sample).filter(|sample| !sample.value.is_nan()).collect();
        Ok(Placed { samples, warnings, moved, short })
    }

    fn misplaced(&self, data: &Data<'_>, row: usize, index: usize) -> ReadError {
        let Row { line, head, .. } = data.rows[row];
        ReadError::Misplaced {
            line,
            found: head.value,
            expected: clean(self.abscissa(index as f64) / self.axis.factor),
        }
    }
}

/// Leaves one of equal values at one place. Returns the lines that only hold values of earlier ones.
fn merge(all: &mut Vec<(usize, Sample)>) -> Result<LineList, ReadError> {
    let mut lines = LineList::default();
    let mut error = None;
    let mut before: Option<(usize, Sample)> = None;
    let mut count = (0, 0);
    all.retain(|(index, sample)| {
        let Some((_, kept)) = before.filter(|(last, _)| last == index) else {
            before = Some((*index, *sample));
            return true;
        };
        if !same(kept.value, sample.value) {
            let (line, other) = (kept.line.max(sample.line), kept.line.min(sample.line));
            error.get_or_insert(ReadError::TwoValues { line, other, at: sample.wavelength });
        }
        // One value that comes again is the check of a line; more are the line again.
        count = if count.0 == sample.line { (count.0, count.1 + 1) } else { (sample.line, 1) };
        if count.1 == 2 {
            lines.add(sample.line);
        }
        false
    });
    error.map_or(Ok(lines), Err)
}

/// Returns whether two ordinates are the same number; one that is missing fits any.
fn same(a: f64, b: f64) -> bool {
    a.is_nan() || b.is_nan() || (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

#[derive(Debug, PartialEq)]
pub(super) struct Ordinates {
    pub(super) head: Written,
    /// The values of the line, with one that only repeats the last of the line before.
    pub(super) values: Vec<f64>,
    /// True if the last value was written as a difference: the next line then begins by repeating it.
    pub(super) ends_in_difference: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// The abscissa or a value, with an ordinary sign or none, or the sign in its first letter.
    Value,
    Difference,
    Repeat,
}

/// The most values of a line, far above any line of a sound file: a few letters can request billions.
const MOST_VALUES: usize = 100_000;

/// Decodes a line; `None` for a blank one. The error is the text that is not a number.
pub(super) fn decode(line: &str) -> Result<Option<Ordinates>, &str> {
    let mut entries = entries(line)?.into_iter();
    let abscissa = match entries.next() {
        None => return Ok(None),
        Some((Kind::Value, number)) if !number.is_nan() => number,
        Some(_) => return Err(line.trim()),
    };
    let mut values: Vec<f64> = Vec::new();
    let mut before: Option<(Kind, f64)> = None;
    for (kind, number) in entries {
        match (kind, before, values.last()) {
            (Kind::Value, ..) => values.push(number),
            (Kind::Difference, _, Some(last)) => values.push(last + number),
            (Kind::Repeat, Some((entry, step)), Some(&last)) => {
                let mut value = last;
                // The entry itself is the first of the repetitions.
                if number > MOST_VALUES as f64 || values.len() > MOST_VALUES {
                    return Err(line.trim());
                }
                for _ in 1..number.max(1.0) as usize {
                    value += if entry == Kind::Difference { step } else { 0.0 };
                    values.push(value);
                }
                continue;
            }
            _ => return Err(line.trim()),
        }
        before = Some((kind, number));
    }
    let ends_in_difference = before.is_some_and(|(kind, _)| kind == Kind::Difference);
    let start = line.trim_start_matches(separates);
    let body = start.char_indices().nth(1).map_or("", |(at, _)| &start[at..]);
    let digits = &start[..start.len() - body.len() + end(body)];
    // A first letter is a digit and no exponent.
    let plain = digits.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let head = Written { value: abscissa, digit: last_digit(plain) };
    Ok(Some(Ordinates { head, values, ends_in_difference }))
}

/// The entries of a line. Plain numbers may have exponents, which squeezed ones never have.
fn entries(line: &str) -> Result<Vec<(Kind, f64)>, &str> {
    let mut found = Vec::new();
    let mut rest = line.trim_start_matches(separates);
    while let Some(first) = rest.chars().next() {
        let (kind, lead) = lead(first).ok_or(rest)?;
        let body = &rest[first.len_utf8()..];
        let end = end(body);
        let number = match (first, &body[..end]) {
            ('?', "") => f64::NAN,
            (_, digits) => number(lead, digits).ok_or(rest)?,
        };
        found.push((kind, number));
        if found.len() > MOST_VALUES {
            return Err(line.trim());
        }
        rest = body[end..].trim_start_matches(separates);
    }
    Ok(found)
}

fn separates(c: char) -> bool {
    c.is_whitespace() || c == ','
}

fn end(body: &str) -> usize {
    let bytes = body.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let exponent = matches!(bytes[at], b'E' | b'e')
            && matches!(bytes.get(at + 1), Some(b'+' | b'-'))
            && bytes.get(at + 2).is_some_and(u8::is_ascii_digit);
        match bytes[at] {
            b'0'..=b'9' | b'.' => at += 1,
            _ if exponent => at += 3,
            _ => break,
        }
    }
    at
}

/// The number that a first character and the digits after it stand for.
fn number(lead: (bool, Option<u8>), digits: &str) -> Option<f64> {
    // On the stack: a file holds millions of entries, of a few letters each.
    const LONGEST: usize = 48;
    let mut buffer = [0; LONGEST];
    let mut length = 0;
    let (negative, first) = lead;
    for byte in negative.then_some(b'-').into_iter().chain(first).chain(digits.bytes()) {
        *buffer.get_mut(length)? = byte;
        length += 1;
    }
    std::str::from_utf8(&buffer[..length]).ok()?.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Meaning of the first character of an entry: its kind, its sign and its first digit.
fn lead(first: char) -> Option<(Kind, (bool, Option<u8>))> {
    let digit = |from: u8| Some((first as u8).wrapping_sub(from) + b'1');
    Some(match first {
        '0'..='9' | '.' => (Kind::Value, (false, Some(first as u8))),
        '-' => (Kind::Value, (true, None)),
        '+' | '?' => (Kind::Value, (false, None)),
        '@' => (Kind::Value, (false, Some(b'0'))),
        'A'..='I' => (Kind::Value, (false, digit(b'A'))),
        'a'..='i' => (Kind::Value, (true, digit(b'a'))),
        '%' => (Kind::Difference, (false, Some(b'0'))),
        'J'..='R' => (Kind::Difference, (false, digit(b'J'))),
        'j'..='r' => (Kind::Difference, (true, digit(b'j'))),
        'S'..='Z' => (Kind::Repeat, (false, digit(b'S'))),
        's' => (Kind::Repeat, (false, Some(b'9'))),
        _ => return None,
    })
}
