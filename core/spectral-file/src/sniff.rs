//! Decides how a text is laid out: separators, decimal mark, orientation, and the line where the numbers begin.

use crate::bands;
use crate::decision::{Decided, DecimalMark, Delimiter, Orientation};
use crate::dialect::{Cell, Dialect, may_be_thousands};
use crate::dialect_trial::{Layout, Shape, Trial};
use crate::error::{MAX_CURVES, NearMiss, ReadError};
use crate::header_terms;
use crate::options::ReadOptions;
use crate::text::{Lines, Section, comment, excerpt};
use crate::units::plausible;
use crate::warning::Warning;
use crate::watch::Log;

/// Lines that are tried before deciding, if enough of them are rows of numbers.
const SAMPLE_LINES: usize = 200;
const SAMPLE_ROWS: usize = 8;
/// Bytes that are tried where lines are very long, and rows that are then enough.
const SAMPLE_BYTES: usize = 1 << 20;
const SAMPLE_ROWS_LONG: usize = 3;

/// Marks that all may group thousands, and are too many for a chance.
const FEWEST_GROUPED: usize = 4;

/// Fewer rows of numbers alone are what is left of a table with texts in it, if one is there.
const FEW_ROWS: usize = SAMPLE_ROWS;

/// Maximum number of bytes above the first numbers, so that hostile text is rejected soon.
const LONGEST_HEADER: usize = 4 << 20;

/// Most bytes between one table and the next, of which there may be a thousand.
const LONGEST_HEADER_LATER: usize = 16 << 10;

/// Bytes that all tables after the first may take together before each is tried on few.
pub(super) const SAMPLE_BUDGET: usize = 1 << 20;
const LEAST_LATER: usize = 512;

/// All ways to split a line; where several fit equally, the first is taken.
const CANDIDATES: [(Delimiter, DecimalMark); 11] = [
    (Delimiter::Semicolon, DecimalMark::Point),
    (Delimiter::Semicolon, DecimalMark::Comma),
    (Delimiter::Tab, DecimalMark::Point),
    (Delimiter::Tab, DecimalMark::Comma),
    (Delimiter::CommaSpace, DecimalMark::Comma),
    (Delimiter::Comma, DecimalMark::Point),
    (Delimiter::Comma, DecimalMark::Comma),
    (Delimiter::Bar, DecimalMark::Point),
    (Delimiter::Bar, DecimalMark::Comma),
    (Delimiter::Spaces, DecimalMark::Point),
    (Delimiter::Spaces, DecimalMark::Comma),
];

/// Decides the layout from the beginning of a text, as far as it takes to find the numbers.
///
/// Tables after the first are tried with what is left of `budget`, in bytes, so that a thousand of them stay cheap.
pub(super) fn sniff(
    section: Section<'_>,
    options: &ReadOptions,
    budget: &mut usize,
    log: &Log<'_>,
) -> Result<Layout, ReadError> {
    Sniffer { section, options }.layout(budget, log)
}

/// A text whose layout is sought, and what of it was chosen.
#[derive(Clone, Copy)]
struct Sniffer<'a> {
    section: Section<'a>,
    options: &'a ReadOptions,
}

impl Sniffer<'_> {
    fn layout(self, budget: &mut usize, log: &Log<'_>) -> Result<Layout, ReadError> {
        let trials = self.try_all(false, budget, log)?;
        let best = self.choose(&trials);
        let rows = best.map_or(0, |best| best.rows(self.options.orientation));
        let few = if self.section.line > 1 { 1 } else { FEW_ROWS };
        if rows < few && self.options.orientation != Some(Orientation::Across) {
            // Names, dates or remarks in rows: only apparent wavelengths distinguish such a table from prose.
            let mixed = self.try_all(true, budget, log)?;
            let mixed: Vec<Trial> = mixed.into_iter().filter(|trial| self.may_be_spectra(trial)).collect();
            if let Some(best) = self.choose(&mixed).filter(|best| best.best.rows > 2 * rows) {
                let orientation = Decided::or_chosen(self.options.orientation, || {
                    Decided::guess(
                        Orientation::Down,
                        "The first numbers of the rows are in order, with text beside them",
                    )
                });
                return self.lay_down(best, orientation);
            }
        }
        let Some(best) = best else {
            let single = trials.iter().find(|trial| trial.single >= 2);
            return Err(single.map_or_else(|| self.near_miss(), |trial| ReadError::OneColumn(trial.single_line)));
        };
        let orientation = Decided::or_chosen(self.options.orientation, || orientation(best));
        if orientation.value == Orientation::Across {
            return self.lay_across(best, orientation);
        }
        if best.best.rows == 0 {
            return Err(self.near_miss());
        }
        self.lay_down(best, orientation)
    }

    /// Returns whether rows with text among their numbers run over wavelengths: by their order, or by the name above most of it.
    fn may_be_spectra(self, trial: &Trial) -> bool {
        let run = &trial.best;
        let above = || Lines::of(self.section).take_while(|(number, _)| *number < run.line).last();
        let named = |(_, line): (usize, &str)| {
            let mut cells = trial.dialect.cells(line).skip(run.texts.trailing_ones() as usize);
            cells.next().is_some_and(header_terms::names_axis)
        };
        run.looks_like_passes() || run.looks_read_off() && above().is_some_and(named)
    }

    fn try_all(self, mixed: bool, budget: &mut usize, log: &Log<'_>) -> Result<Vec<Trial>, ReadError> {
        let look = if self.section.line == 1 { SAMPLE_BYTES } else { LONGEST_HEADER_LATER };
        let start = &self.section.text[..self.section.text.floor_char_boundary(look)];
        let bars = start.contains('|');
        let wanted = |(delimiter, mark): &(Delimiter, DecimalMark)| {
            self.options.delimiter.map_or(bars || *delimiter != Delimiter::Bar, |chosen| chosen == *delimiter)
                && self.options.decimal_mark.is_none_or(|chosen| chosen == *mark)
        };
        let dialects = CANDIDATES.iter().filter(|candidate| wanted(candidate));
        // If the decimal point was chosen, commas within numbers are known; else only quotes prevent them from separating.
        let chosen = self.options.decimal_mark == Some(DecimalMark::Point);
        let quoted = self.options.decimal_mark.is_none()
            && self.options.delimiter.is_none_or(|chosen| chosen == Delimiter::Comma)
            && self.section.text.bytes().take(SAMPLE_BYTES).any(|byte| byte == b'"');
        let dialects = dialects.map(|&(delimiter, mark)| Dialect { delimiter, mark, thousands: chosen });
        let grouped = Dialect { delimiter: Delimiter::Comma, mark: DecimalMark::Point, thousands: true };
        let dialects = dialects.chain(quoted.then_some(grouped));
        let told = self.options.decimal_mark.is_none() && has_grouped(start);
        let others = CANDIDATES.iter().filter(|candidate| told && wanted(candidate) && candidate.0 != Delimiter::Comma);
        let others = others.filter(|candidate| candidate.0 != Delimiter::CommaSpace);
        let dialects = dialects.chain(others.map(|&(delimiter, mark)| Dialect { delimiter, mark, thousands: true }));
        let mut trials: Vec<Trial> = dialects.map(|dialect| Trial::new(dialect, mixed)).collect();
        let share = LEAST_LATER.max(LONGEST_HEADER_LATER.min(*budget));
        let (mut lines, mut bytes) = (0, 0);
        for (number, line) in Lines::of(self.section).filter(|(_, line)| !line.trim_ascii().is_empty()) {
            if comment(line).is_some() {
                for trial in &mut trials {
                    trial.take_marked(number, line);
                }
                continue;
            }
            for trial in &mut trials {
                trial.take(number, line);
            }
            lines += 1;
            bytes += line.len() + 1;
            // Each trial splits it again.
            log.work(trials.len() * (line.len() + 1), self.section.byte + bytes)?;
            let rows = trials.iter().map(|trial| trial.rows(self.options.orientation)).max().unwrap_or(0);
            let enough = match rows {
                _ if self.section.line > 1 => bytes >= if rows == 0 { LONGEST_HEADER_LATER } else { share },
                SAMPLE_ROWS.. => lines >= SAMPLE_LINES || bytes >= SAMPLE_BYTES,
                SAMPLE_ROWS_LONG.. => bytes >= SAMPLE_BYTES,
                _ => bytes >= LONGEST_HEADER,
            };
            if enough || (rows >= SAMPLE_ROWS && lines >= SAMPLE_LINES) {
                break;
            }
        }
        *budget = budget.saturating_sub(if self.section.line > 1 { bytes } else { 0 });
        Ok(trials)
    }

    /// The trial that understands most rows, then the one in best order, then the first.
    fn choose<'t>(&self, trials: &'t [Trial]) -> Option<&'t Trial> {
        let mut best: Option<&Trial> = None;
        for trial in trials {
            let Dialect { delimiter, mark, .. } = trial.dialect;
            // Both uses of the comma are believed only where one is seen that does not separate.
            let unproven = match (delimiter, mark) {
                (Delimiter::Comma, DecimalMark::Comma) => {
                    trial.quoted == 0 && self.options.decimal_mark != Some(DecimalMark::Comma)
                }
                (Delimiter::CommaSpace, DecimalMark::Comma) => trial.marks == 0 && self.options.delimiter.is_none(),
                // Of two marks one must be seen to stand before fractions.
                (Delimiter::Semicolon | Delimiter::Tab | Delimiter::Bar | Delimiter::Spaces, _) => {
                    trial.dialect.thousands && self.options.decimal_mark.is_none() && trial.fractions == 0
                }
                _ => false,
            };
            let rank = |trial: &Trial| (trial.rows(self.options.orientation), trial.best.steady());
            if rank(trial).0 > 0 && !unproven && best.is_none_or(|best| rank(trial) > rank(best)) {
                best = Some(trial);
            }
        }
        best
    }

    fn lay_across(self, trial: &Trial, orientation: Decided<Orientation>) -> Result<Layout, ReadError> {
        let mut across = trial.across.clone().filter(|across| across.rows > 0).ok_or(ReadError::NoNumbers)?;
        across.part = self.options.part.unwrap_or(1).saturating_sub(1);
        let rows = if across.rows == 1 { "one row" } else { "rows" };
        let evidence = format!("A header of {} wavelengths with {rows} below it", across.group().count());
        let (decimal_mark, thousands, warning) = self.marks(trial, across.first_row, Orientation::Across);
        let dialect = Dialect { delimiter: trial.dialect.delimiter, mark: decimal_mark.value, thousands };
        if dialect != trial.dialect
            && let Some((_, header)) = Lines::of(self.section).find(|(number, _)| *number == across.line)
        {
            // The header too may hold marks that group thousands.
            let groups = bands::groups(dialect, header);
            if !groups.is_empty() {
                let shift = across.shift;
                across.groups = groups;
                across = across.shifted(shift);
            }
        }
        let certain = || Decided::certain(trial.dialect.delimiter, evidence);
        let delimiter = Decided::or_chosen(self.options.delimiter, certain);
        let layout = Layout::new(delimiter, decimal_mark, orientation, across.first_row);
        let (width, warnings) = (across.group().end(), warning.into_iter().collect());
        Ok(Layout { thousands, width, warnings, across: Some(across), ..layout })
    }

    /// The decimal mark, whether the other one groups thousands, and what to say of that.
    fn marks(
        self,
        trial: &Trial,
        from: usize,
        orientation: Orientation,
    ) -> (Decided<DecimalMark>, bool, Option<Warning>) {
        let mark = self.decimal_mark(trial, from);
        if self.options.decimal_mark.is_some() {
            return (mark, trial.dialect.thousands, None);
        }
        let delimiter = trial.dialect.delimiter;
        let seen = trial.dialect.thousands && delimiter != Delimiter::Comma;
        if trial.fractions > 0 && (seen || beside_fractions(self.section, delimiter, mark.value, from)) {
            return (mark, true, None);
        }
        let sign = match mark.value {
            _ if delimiter == Delimiter::Comma => ',',
            DecimalMark::Comma => ',',
            DecimalMark::Point => '.',
        };
        let possible = trial.marks == 0 || trial.may_be_thousands(1);
        if trial.dialect.thousands || (possible && is_grouped(self.section, (delimiter, sign), from, orientation)) {
            let (mark, fractions) = match sign {
                ',' => (DecimalMark::Point, DecimalMark::Comma),
                _ => (DecimalMark::Comma, DecimalMark::Point),
            };
            let why = format!("Numbers such as 1{sign}000 stand next to whole ones of three digits");
            return (Decided::guess(mark, why), true, Some(Warning::GroupedThousands(fractions)));
        }
        (mark, false, trial.may_be_thousands(FEWEST_GROUPED).then_some(Warning::MaybeThousands))
    }

    fn lay_down(self, trial: &Trial, orientation: Decided<Orientation>) -> Result<Layout, ReadError> {
        let run = &trial.best;
        let (delimiter, mark) = (trial.dialect.delimiter, trial.dialect.mark);
        let why = format!("Rows of {} numbers", run.filled);
        let (decimal_mark, thousands, warning) = self.marks(trial, run.line, Orientation::Down);
        let commas_only = !thousands
            && (delimiter, mark) == (Delimiter::Comma, DecimalMark::Point)
            && trial.marks == 0
            && run.filled > 2
            && self.options.delimiter.is_none()
            && self.options.decimal_mark.is_none();
        let mut warnings = Vec::new();
        if commas_only {
            if let Some(line) = trial.padded_line {
                return Err(ReadError::AmbiguousCommas(line));
            }
            warnings.push(Warning::CommasOnly);
        }
        warnings.extend(warning);
        let decide = || if commas_only { Decided::guess(delimiter, why) } else { Decided::certain(delimiter, why) };
        let delimiter = Decided::or_chosen(self.options.delimiter, decide);
        let first_line = self.first_line(trial, &mut warnings);
        Ok(Layout {
            thousands,
            texts: run.texts,
            gaps: run.gaps,
            width: run.filled,
            wavelength_column: self.options.wavelength_column,
            every_column: self.options.raw == Some(true) && self.options.wavelength_column.is_some(),
            warnings,
            ..Layout::new(delimiter, decimal_mark, orientation, first_line)
        })
    }

    /// The decimal mark; where the sample holds whole numbers only, the first mark after it decides.
    fn decimal_mark(self, trial: &Trial, from: usize) -> Decided<DecimalMark> {
        Decided::or_chosen(self.options.decimal_mark, || {
            let Dialect { delimiter, mark, .. } = trial.dialect;
            if trial.marks > 0 {
                let why = match mark {
                    DecimalMark::Point => "Fractions stand after points",
                    DecimalMark::Comma => "Fractions stand after commas",
                };
                return if trial.may_be_thousands(FEWEST_GROUPED) {
                    Decided::guess(mark, why)
                } else {
                    Decided::certain(mark, why)
                };
            }
            let later = Lines::of(self.section)
                .skip_while(|(number, _)| *number < from)
                .take(if self.section.line == 1 { usize::MAX } else { SAMPLE_LINES })
                .filter(|(_, line)| line.trim_ascii_start().starts_with(|c: char| c.is_ascii_digit()))
                .find_map(|(_, line)| line.bytes().find(|b| matches!(b, b'.' | b',')));
            match later {
                Some(b',') if delimiter != Delimiter::Comma => {
                    Decided::certain(DecimalMark::Comma, "Fractions stand after commas")
                }
                Some(b'.') => Decided::certain(DecimalMark::Point, "Fractions stand after points"),
                _ => Decided::guess(mark, "No number looked at has a fraction"),
            }
        })
    }

    /// The first line of the table: where the rows of numbers begin, even if a broken row soon interrupts them, so that
    /// the reader sees the broken row. Lone numbers further up that do not continue the table are omitted.
    fn first_line(self, trial: &Trial, warnings: &mut Vec<Warning>) -> usize {
        let run = &trial.best;
        let step = (run.last - run.first) / run.rows.max(2).saturating_sub(1) as f64;
        let mut fragment: Option<(usize, usize)> = None; // first line, rows
        let mut stray = None;
        let is_content = |(_, line): &(usize, &str)| !line.trim_ascii().is_empty() && comment(line).is_none();
        for (number, line) in Lines::of(self.section).filter(is_content).take_while(|(number, _)| *number < run.line) {
            let shape = Shape::of(trial.dialect, line);
            let steps_away = shape.first.map_or(f64::NAN, |first| (run.first - first) / step);
            let near = steps_away > 0.0 && steps_away <= 4.0 * (run.line - number) as f64;
            if near && shape.leads && (shape.cells > 1 || number + 1 == run.line) {
                return number;
            }
            // A row whose last cells are remarks.
            let remarked = number + 1 == run.line && shape.text && shape.cells == run.cells;
            if is_spoiled(trial, &shape, line) || remarked && shape.leads && 2 * shape.numbers > shape.cells {
                return fragment.map_or(number, |(line, _)| line);
            }
            if !shape.is_row(trial.mixed) {
                continue;
            }
            let same = run.takes(&shape);
            match &mut fragment {
                Some((_, rows)) if same => *rows += 1,
                Some(_) => {}
                None if same => fragment = Some((number, 1)),
                None => stray = stray.or(Some(number)),
            }
        }
        match fragment {
            Some((line, 2..)) => return line,
            Some((line, _)) => stray = stray.map_or(Some(line), |other: usize| Some(other.min(line))),
            None => {}
        }
        if let Some(line) = stray {
            warnings.push(Warning::NumbersAbove(line));
        }
        run.line
    }

    /// The error for a text without rows: about the first line that nearly is one.
    fn near_miss(self) -> ReadError {
        let mut read = 0;
        for (line, text) in Lines::of(self.section) {
            read += text.len() + 1;
            if read > LOOK_NEAR {
                break;
            }
            if comment(text).is_some() {
                continue;
            }
            let start = &text[..text.floor_char_boundary(LONGEST)];
            if let Some(why) = nearly(start.trim(), self.options) {
                return ReadError::NearlyRow { line, text: excerpt(text.trim()), why };
            }
        }
        ReadError::NoNumbers
    }
}

fn orientation(trial: &Trial) -> Decided<Orientation> {
    let rows = trial.best.rows;
    let down = trial.best.looks_like_wavelengths();
    match trial.across.as_ref().filter(|across| across.rows > 0) {
        Some(across) if down && across.is_indexed() => Decided::guess(
            Orientation::Across,
            format!(
                "Line {} holds {} numbers in order, behind the head of a column",
                across.line,
                across.group().count()
            ),
        ),
        Some(across) if !down && across.rows + 1 >= rows => {
            let why = format!("Line {} holds {} wavelengths", across.line, across.group().count());
            let decide = if across.group().known { Decided::certain } else { Decided::guess };
            decide(Orientation::Across, why)
        }
        Some(_) => Decided::guess(Orientation::Down, "The first numbers of the rows are in order"),
        None => Decided::certain(Orientation::Down, "No line holds wavelengths side by side"),
    }
}

/// Returns whether a line would be a row of the table but for cells such as `0.2x`, which begin as numbers do.
fn is_spoiled(trial: &Trial, shape: &Shape, line: &str) -> bool {
    let (run, dialect) = (&trial.best, trial.dialect);
    let before = shape.first.is_some_and(|first| {
        let falls = run.rows > 1 && run.last < run.first;
        plausible(first, first, first.fract() != 0.0) && if falls { first > run.first } else { first < run.first }
    });
    let begun = |cell: &str| {
        let digit = cell.trim_start_matches(['-', '+', '.']).starts_with(|c: char| c.is_ascii_digit());
        dialect.parse(cell) != Cell::Text || (digit && dialect.parse_united(cell).is_none())
    };
    let whole = shape.leads && shape.text && shape.cells == run.cells;
    whole && before && plausible(run.first, run.last, run.first.fract() != 0.0) && dialect.cells(line).all(begun)
}

const LOOK_NEAR: usize = 1 << 18;

/// A line of more bytes is not looked at as a whole.
const LONGEST: usize = 4000;

/// Prose that begins with a number has more words behind it than a row has texts.
const MOST_CELLS: usize = 3;

fn nearly(line: &str, options: &ReadOptions) -> Option<NearMiss> {
    let chosen = options.delimiter.is_some() || options.decimal_mark.is_some();
    // Commas that both separate and mark fractions prove nothing.
    let twice = |&(delimiter, mark): &(Delimiter, DecimalMark)| {
        matches!(delimiter, Delimiter::Comma | Delimiter::CommaSpace) && mark == DecimalMark::Comma
    };
    let shape = |(delimiter, mark)| {
        let dialect = Dialect::new(delimiter, mark);
        let cells = dialect.cells(line).filter(|cell| !cell.is_empty());
        let is_number = |cell: &str| matches!(dialect.parse(cell), Cell::Number(_));
        let (mut count, mut numbers, mut leads) = (0, 0, false);
        for cell in cells {
            leads |= count == 0 && (is_number(cell) || dialect.parse_label(cell).is_some());
            numbers += usize::from(is_number(cell));
            count += 1;
        }
        (count, numbers, leads)
    };
    let shapes: Vec<(usize, usize, bool)> =
        CANDIDATES.into_iter().filter(|candidate| !twice(candidate)).map(shape).collect();
    if shapes.iter().any(|(count, numbers, _)| *count > 1 && count == numbers) {
        return chosen.then_some(NearMiss::Separators);
    }
    if let Some(between) = between(line) {
        return Some(NearMiss::Between(between));
    }
    if shapes.iter().any(|(count, numbers, leads)| *leads && *numbers <= 1 && (2..=MOST_CELLS).contains(count)) {
        return Some(NearMiss::TextAfter);
    }
    shapes.iter().any(|(count, numbers, _)| *numbers >= 2 && *count > *numbers).then_some(NearMiss::Order)
}

/// The sign between two numbers that fill a line.
fn between(line: &str) -> Option<char> {
    let in_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '+');
    let end = line.find(|c: char| !in_number(c))?;
    let rest = line[end..].trim_start();
    let sign = rest.chars().next().filter(|c| !c.is_alphanumeric() && !matches!(c, ';' | '"' | '\''))?;
    let second = rest[sign.len_utf8()..].trim();
    let second = second.split(sign).next()?.trim();
    let plain = |text: &str| text.replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite);
    (plain(&line[..end]) && plain(second)).then_some(sign)
}

/// Returns whether a mark groups thousands in the rows from a line on: each number that has it could be a whole one, and the
/// whole numbers of three digits next to them are nearer to that than to a fraction.
///
/// ```text
/// Σ |ln(p/f)| − |ln(p/1000 f)| > 0    over neighbors, a whole number p and one that would be the fraction f
/// ```
fn is_grouped(
    section: Section<'_>,
    (delimiter, mark): (Delimiter, char),
    from: usize,
    orientation: Orientation,
) -> bool {
    let dialect = Dialect::new(delimiter, DecimalMark::Point);
    // Commas that separate stand in every line; one within a cell is quoted.
    let sign = if delimiter == Delimiter::Comma && mark == ',' { '"' } else { mark };
    let mut score = 0.0;
    let mut before = (false, "");
    for (number, line) in Lines::of(section) {
        if number < from || line.trim_ascii().is_empty() || comment(line).is_some() {
            continue;
        }
        let marked = line.contains(sign);
        if marked {
            for (index, cell) in dialect.cells(line).take(MAX_CURVES + 1).enumerate() {
                let Some(cell) = Written::of(cell, mark) else { continue };
                let too_large = matches!(cell, Written::Whole(value) if index > 0 && value >= 1000.0);
                if too_large || matches!(cell, Written::Fraction) {
                    return false;
                }
            }
        }
        if orientation == Orientation::Across && marked {
            let cells = || dialect.cells(line).take(MAX_CURVES + 1);
            score += cells().zip(cells().skip(1)).map(|(a, b)| votes(a, b, mark)).sum::<f64>();
        } else if orientation == Orientation::Down && (marked || before.0) {
            score += dialect.cells(before.1).zip(dialect.cells(line)).map(|(a, b)| votes(a, b, mark)).sum::<f64>();
        }
        before = (marked, line);
    }
    score > 0.0
}

/// Returns whether a mark that stands before no fraction groups thousands in the rows from a line on, `1,000` beside `0.390`: where
/// fractions are seen to stand after the other mark, it can mean nothing else.
fn beside_fractions(section: Section<'_>, delimiter: Delimiter, fractions: DecimalMark, from: usize) -> bool {
    let other = if fractions == DecimalMark::Point { ',' } else { '.' };
    let dialect = Dialect::new(delimiter, fractions);
    let content = Lines::of(section).skip_while(|(number, _)| *number < from);
    // Commas that separate stand in every line; one within a cell is quoted.
    let sign = if delimiter == Delimiter::Comma && other == ',' { '"' } else { other };
    if !section.text.contains(sign) {
        return false;
    }
    let mut marked = content.filter(|(_, line)| line.contains(sign) && comment(line).is_none());
    let grouped = |cell: &str| cell.contains(other) && may_be_thousands(cell);
    marked.any(|(_, line)| dialect.cells(line).take(MAX_CURVES + 1).any(grouped))
}

/// Returns whether a text has a number such as `1,000` or `1.000` in it that no comma of a list makes.
fn has_grouped(text: &str) -> bool {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut signs = bytes.iter().enumerate().filter(|(_, byte)| matches!(byte, b',' | b'.'));
    let commas_and_points = bytes.contains(&b',') && bytes.contains(&b'.');
    commas_and_points
        && signs
            .any(|(at, _)| at > 0 && digit(at - 1) && digit(at + 1) && digit(at + 2) && digit(at + 3) && !digit(at + 4))
}

enum Written {
    Whole(f64),
    /// With a mark that may group thousands; the number that it is with a fraction.
    Either(f64),
    /// With a mark that can only stand before a fraction.
    Fraction,
}

impl Written {
    fn of(cell: &str, mark: char) -> Option<Self> {
        const LONGEST: usize = 24;
        let other = |c: char| !(c.is_ascii_digit() || c == mark || c == '-');
        if cell.is_empty() || cell.len() > LONGEST || cell.contains(other) {
            return None;
        }
        match cell.matches(mark).count() {
            0 => cell.parse().ok().map(Self::Whole),
            1 if may_be_thousands(cell) => cell.replace(mark, ".").parse().ok().map(Self::Either),
            1 => Some(Self::Fraction),
            _ => None,
        }
    }
}

/// Natural logarithm of how much nearer two neighbors are with thousands than with fractions.
fn votes(a: &str, b: &str, mark: char) -> f64 {
    let both = (Written::of(a, mark), Written::of(b, mark));
    let ((Some(Written::Whole(plain)), Some(Written::Either(fraction)))
    | (Some(Written::Either(fraction)), Some(Written::Whole(plain)))) = both
    else {
        return 0.0;
    };
    if !(100.0..1000.0).contains(&plain) || fraction <= 0.0 {
        return 0.0;
    }
    (plain / fraction).ln().abs() - (plain / (1000.0 * fraction)).ln().abs()
}
