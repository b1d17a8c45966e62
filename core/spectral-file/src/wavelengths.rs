//! Wavelengths: their unit, their range, their order, and repeats.

use crate::decimal::{ends, extent, median};
use crate::decision::{Certainty, Decided, Dropped, WavelengthUnit};
use crate::error::ReadError;
use crate::grid::{Grid, RawCurve};
use crate::header_terms::{self, XUnit};
use crate::no_curve::FEWEST_ROWS;
use crate::options::ReadOptions;
use crate::report::Steps;
use crate::text::{is_one, lower, words};
use crate::units::{RANGE_NM, plausible};
use crate::warning::{LineList, Warning};
use crate::watch::Log;

/// The unit of the wavelengths: chosen, or given by a header, or guessed from their range.
pub(super) fn unit(grid: &Grid, options: &ReadOptions) -> Result<Decided<WavelengthUnit>, ReadError> {
    if let Some(unit) = options.wavelength_unit {
        return Ok(Decided::chosen(unit));
    }
    if let Some(unit) = &grid.unit {
        return Ok(unit.clone());
    }
    if let Some(unit) = grid.label_unit {
        return Ok(Decided::certain(unit, "The unit stands beside each wavelength"));
    }
    match grid.header.x_unit {
        Some((line, XUnit::Wavelength(unit))) => Ok(Decided::certain(unit, format!("Line {line} names the unit"))),
        Some((line, XUnit::Other)) => Err(ReadError::NotWavelengths(line)),
        None => no_other_axis(grid).and_then(|()| unit_from_frequencies(grid).unwrap_or_else(|| unit_from_range(grid))),
    }
}

/// The unit of a column that is headed frequencies or energies and no unit: MODTRAN means wave numbers by FREQ, else only the user knows.
fn unit_from_frequencies(grid: &Grid) -> Option<Result<Decided<WavelengthUnit>, ReadError>> {
    let name = grid.header.name(grid.wavelength_column?.saturating_sub(1))?;
    is_one(&name.to_lowercase(), "freq|freq.|frequency|frequencies|energy|energies|photon energy").then(|| {
        let why = "MODTRAN writes wave numbers under FREQ";
        let guess = Decided::guess(WavelengthUnit::Wavenumber, why);
        if name == "FREQ" { Ok(guess) } else { Err(ReadError::NotWavelengths(grid.header.line.unwrap_or(1))) }
    })
}

/// The unit that a range suggests. If ångströms fit as well as wave numbers or nanometers of the infrared, only the user knows.
fn unit_from_range(grid: &Grid) -> Result<Decided<WavelengthUnit>, ReadError> {
    // Small numbers in no order, or that only count, are no wavelengths in micrometers.
    let steps = || grid.wavelengths.windows(2);
    let (rises, falls) = (steps().filter(|w| w[1] > w[0]).count(), steps().filter(|w| w[1] < w[0]).count());
    let steady = 4 * rises.max(falls) >= 3 * steps().count();
    let in_order = is_named(grid) || steady && grid.wavelengths.iter().any(|wavelength| wavelength.fract() != 0.0);
    let (min, max) = extent(grid.wavelengths.iter().copied());
    let line = grid.line(0);
    // Energies that rise with wave numbers fall as wavelengths rise, which few tables of micrometers do. Nor are those of whole and half nanometers micrometers.
    let falling = (0.5..6.5).contains(&min) && falls > rises;
    if max <= 6.5 && steady && (falling || are_energies(&grid.wavelengths)) && !is_named(grid) {
        return Err(ReadError::AmbiguousEnergies { line, min, max });
    }
    let unit = if min >= 1e-7 && max <= 25e-6 && in_order {
        WavelengthUnit::Meter
    } else if min >= 0.1 && max <= 25.0 && in_order || are_partly_micrometers(grid, (min, max)) {
        WavelengthUnit::Micrometer
    } else if (2000.0..=4000.0).contains(&min) && (7000.0..=12_000.0).contains(&max) && is_named(grid)
        || min >= 1000.0 && axis_name(grid) == Some("A")
    {
        // The word excludes wave numbers.
        WavelengthUnit::Angstrom
    } else if min >= 10_000.0 && max <= 100_000.0
        || min >= 2000.0 && (3000.0..=20_000.0).contains(&max)
        || (1000.0..3800.0).contains(&min) && (8000.0..=100_000.0).contains(&max)
    {
        return Err(ReadError::AmbiguousUnit { line, min, max });
    } else if (is_bare(grid) || steady && (falls > rises || is_even(&grid.wavelengths)) && !is_named(grid))
        && min >= 390.0
        && max > 3300.0
        && min < 2000.0
        && max <= 10_000.0
        || falls > rises && max > 1200.0 && min >= 390.0 && has_steps_of_a_transform(&grid.wavelengths)
    {
        // No spectrometer for light reaches so far from there, but those for the infrared all do.
        WavelengthUnit::Wavenumber
    } else {
        WavelengthUnit::Nanometer
    };
    Ok(Decided::guess(unit, format!("Wavelengths run from {min} to {max}")))
}

/// True for wavelengths by their name or their span, in order and below 1000, of which some are in range as micrometers: optical
/// constants reach from the far ultraviolet to the far infrared.
fn are_partly_micrometers(grid: &Grid, (min, max): (f64, f64)) -> bool {
    const FROM_TO: (f64, f64) = (0.1, 25.0);
    const MOST: f64 = 1000.0;
    const LEAST: f64 = 1e-3;
    const FAR: f64 = 1000.0;
    let numbers = &grid.wavelengths;
    let sorted = numbers.is_sorted_by(|a, b| a <= b) || numbers.is_sorted_by(|a, b| a >= b);
    let within = numbers.iter().filter(|number| (FROM_TO.0..=FROM_TO.1).contains(*number)).count();
    let fractions = 2 * numbers.iter().filter(|number| number.fract() != 0.0).count() > numbers.len();
    let told = is_named(grid) || max > FAR * min && max > FROM_TO.1 && min >= LEAST && grid.header.names.is_empty();
    told && sorted && within >= FEW && fractions && min > 0.0 && max <= MOST
}

/// True for numbers that are mostly energies in eV of whole or half nanometers, h c / λ, of which micrometers are none.
fn are_energies(numbers: &[f64]) -> bool {
    let whole = |constant: f64| {
        let half = |number: f64| 2.0 * constant / number;
        let is_whole = |number: &&f64| (half(**number) - half(**number).round()).abs() < 0.04;
        // The longest wavelengths are rounded.
        let sharp = || numbers.iter().filter(|number| **number > 1.0);
        let count = sharp().count();
        count > 10 && 10 * sharp().filter(is_whole).count() > 9 * count
    };
    [1240.0, 1239.84, 1_239.841_984].into_iter().any(whole)
}

/// Numbered columns from which on they are no curves beside a column of wavelengths.
const MOST_COUNTED: usize = 10;
const FEWEST_IN_ORDER: usize = 50;

/// Refuses a first column whose head names another quantity than wavelengths.
fn no_other_axis(grid: &Grid) -> Result<(), ReadError> {
    let Some(column) = grid.wavelength_column.map(|column| column.saturating_sub(1)) else { return Ok(()) };
    let names = grid.header.names.get(column..).unwrap_or_default();
    // Of colors, also behind the names or numbers of their samples.
    let samples = names.first().is_some_and(|name| !name.is_empty() && !header_terms::names_wavelengths(name));
    let colors = |letters: [&str; 3]| names.windows(3).any(|names| names.iter().zip(letters).all(|(a, b)| a == b));
    let tristimulus = samples && [["X", "Y", "Z"], ["L*", "a*", "b*"], ["L", "a", "b"]].into_iter().any(colors);
    // A line such as `temperature,32.4` is a setting.
    let setting = names.iter().skip(1).all(|name| name.is_empty() || name.starts_with(|c: char| c.is_ascii_digit()));
    // Bands of which none is read, `400-410nm`, stand across.
    let is_band = |name: &String| {
        name.starts_with(|c: char| c.is_ascii_digit())
            && name.contains(char::is_alphabetic)
            && name.parse::<f64>().is_err()
    };
    let bands = names.len() > 2 && names.iter().all(is_band);
    // `abs1, abs2, …` are numbered samples of spectra, not their wavelengths.
    let stem = names.first().and_then(|name| name.strip_suffix('1')).filter(|stem| !stem.is_empty());
    let is_number = |(at, name): (usize, &String)| stem.is_some_and(|stem| *name == format!("{stem}{}", at + 1));
    // In order, the first numbers are wavelengths all the same.
    let in_order = grid.wavelengths.len() >= FEWEST_IN_ORDER && grid.wavelengths.is_sorted_by(|a, b| a < b);
    let counted = names.len() >= MOST_COUNTED && !in_order && names.iter().enumerate().all(is_number);
    let named = names.first().is_some_and(|name| names_other_axis(name) && !setting);
    // Or its unit, where all heads are taken for units.
    let unit = || grid.header.units.get(column).is_some_and(|unit| names_other_axis(unit));
    let other = named || tristimulus || bands || counted || names.is_empty() && unit();
    if other { Err(ReadError::NoWavelengths(grid.header.line.unwrap_or(1))) } else { Ok(()) }
}

fn axis_name(grid: &Grid) -> Option<&str> {
    grid.header.name(grid.wavelength_column.unwrap_or(1).saturating_sub(1))
}

/// Returns whether a column's header names a quantity over which no spectrum runs: a time, a temperature, an angle, a place.
pub(super) fn names_other_axis(text: &str) -> bool {
    const QUANTITIES: &str = "binding|t|age|pressure|distance|position|mass|height|weight|volume|concentration|concentracion|\
        concentración|conc|time|seconds|minutes|hours|elapsed|temperature|temp|theta|2theta|angle|lon|longitude|lat|latitude|\
        current|voltage|potential|date|year|month|day|hour|mean|median";
    const UNITS: &str = "s|sec|ms|msec|min|h|k|°c|°|deg|degree|degrees|v|mv|ma|ml|bar|mg/kg";
    let text = lower(text).replace('_', " ");
    let (name, unit) = text.split_once(['(', '[', ',']).map_or((&*text, &*text), |(name, unit)| (name, unit));
    let unit = unit.split([')', ']']).next().unwrap_or_default();
    let is_quantity = |word: Option<&str>| word.is_some_and(|word| is_one(word, QUANTITIES));
    let is_number =
        || is_one(name.trim(), "nr|nr.|id|band number") || name.ends_with(" id") || name.ends_with(" index");
    let named = || is_quantity(words(name).next()) || is_quantity(words(name).last());
    !header_terms::names_wavelengths(&text) && (named() || is_one(unit.trim(), UNITS) || is_number())
}

/// Returns whether the column of the wavelengths is named so, without a unit.
fn is_named(grid: &Grid) -> bool {
    axis_name(grid).is_some_and(header_terms::begins_with_wavelengths)
}

/// True for equal steps that are no whole numbers, as between the wave numbers of a Fourier transform.
fn is_even(numbers: &[f64]) -> bool {
    let mut steps = numbers.windows(2).map(|pair| pair[1] - pair[0]);
    let Some(first) = steps.next().filter(|first| (first - first.round()).abs() > 0.01) else { return false };
    steps.all(|step| (step - first).abs() <= 0.01 * first.abs())
}

/// True for equal steps that are no tenths, as those down the wave numbers of a Fourier transform are.
fn has_steps_of_a_transform(numbers: &[f64]) -> bool {
    let tenths = numbers.windows(2).next().map_or(0.0, |pair| 10.0 * (pair[1] - pair[0]));
    is_even(numbers) && (tenths - tenths.round()).abs() > 0.05 && tenths.abs() > 4.0
}

fn is_bare(grid: &Grid) -> bool {
    let named = !grid.header.names.is_empty() || !grid.header.comments.is_empty() || grid.header.mentioned.is_some();
    grid.curves.len() == 1 && !named
}

/// Where light ceases to be seen, and how many rows there are to one that is a last few.
const VISIBLE_TO_NM: f64 = 780.0;
const FEW: usize = 10;
/// Where numbers may begin that are ångströms if they reach as far as from the second to the third, beyond the range of nanometers.
const ANGSTROMS: std::ops::RangeInclusive<f64> = 30.0..=250_000.0;
const MOST_NM: f64 = 3000.0;
const MOST_ANGSTROM: f64 = 1e9;

/// Names the columns of a matrix by its first row, behind a zero in the corner: delays or wavelengths of excitation, in order. Returns
/// whether it has such names.
fn name_by_corner(grid: &mut Grid) -> bool {
    const FEWEST: usize = 3;
    let heads: Vec<f64> = grid.curves.iter().map(|curve| curve.values[0]).collect();
    let in_order = heads.is_sorted_by(|a, b| a < b) || heads.is_sorted_by(|a, b| a > b);
    let are_names = heads.len() >= FEWEST && in_order && grid.curves.iter().all(|curve| !curve.named);
    for (curve, head) in grid.curves.iter_mut().zip(heads).filter(|_| are_names) {
        (curve.name, curve.named) = (head.to_string(), true);
    }
    are_names
}

/// Converts wavelengths to nanometers. Those beyond the range at one end of the table, where they go on in its order, are left out if
/// the unit is no guess, or they are few, and most are within.
pub(super) fn to_nanometers(
    grid: &mut Grid,
    unit: &Decided<WavelengthUnit>,
    log: &mut Log<'_>,
) -> Result<(), ReadError> {
    grid.wavelengths.iter_mut().for_each(|wavelength| *wavelength = unit.value.nanometers(*wavelength));
    let nm = &grid.wavelengths;
    let out = |wavelength: &f64| !RANGE_NM.contains(wavelength);
    let Some(first) = nm.iter().position(out) else { return Ok(()) };
    let (line, wavelength_nm) = (grid.line(first), nm[first]);
    let within = |curve: &&RawCurve| ends(&curve.values).is_some_and(|(low, high)| plausible(low, high, false));
    let turned = grid.curves.iter().find(within).filter(|curve| curve.values.len() > FEWEST_ROWS);
    let error = match turned.and_then(|curve| curve.column) {
        Some(column) => ReadError::OtherWavelengthColumn { line, wavelength_nm, column },
        None => ReadError::WavelengthOutOfRange { line, wavelength_nm },
    };
    let marked: Vec<bool> = nm.iter().map(out).collect();
    let count = marked.iter().filter(|out| **out).count();
    let within = marked.iter().position(|out| !out).unwrap_or(0);
    let within = within..within + nm.len() - count;
    let ordered = nm.is_sorted_by(|a, b| a <= b) || nm.is_sorted_by(|a, b| a >= b);
    // A single zero before the table, as of an empty row, is no wavelength.
    let begins_axis = |nm: &[f64]| nm[1] - nm[0] == nm[2] - nm[1];
    let zero = nm[0] == 0.0 && FEW < nm.len() && !begins_axis(nm);
    let (least, most) = extent(nm[usize::from(zero)..].iter().copied());
    let guessed = (unit.value, unit.certainty) == (WavelengthUnit::Nanometer, Certainty::Guess);
    let far = matches!(unit.value, WavelengthUnit::Micrometer | WavelengthUnit::Electronvolt);
    let enough = within.len() >= count || far;
    let sound = ordered && within.len() > 1 && enough && least > 0.0;
    // From light that is seen on, a last few in the far infrared do not make it another unit.
    let few = zero && count == 1 || (RANGE_NM.start()..&VISIBLE_TO_NM).contains(&&nm[0]) && FEW * count <= nm.len();
    let error = match error {
        ReadError::WavelengthOutOfRange { .. }
            if guessed && ANGSTROMS.contains(&least) && (MOST_NM..=MOST_ANGSTROM).contains(&most) =>
        {
            ReadError::AmbiguousUnit { line: grid.line(0), min: least, max: most }
        }
        error => error,
    };
    // Halves of a table may take turns; a single number out of order is an error.
    let falls = nm.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let mixed = !guessed && 3 * falls.min(nm.len() - 1 - falls) > nm.len() && within.len() >= count && least > 0.0;
    if !mixed && (guessed && !few || !sound || marked[within].contains(&true)) {
        return Err(error);
    }
    // The energy zero has no wavelength.
    let (from_nm, to_nm) = extent(nm.iter().copied().filter(|nm| out(nm) && nm.is_finite()));
    let named = zero && count == 1 && name_by_corner(grid);
    let mut lines = LineList::default();
    if grid.lines.len() == marked.len() {
        for at in (0..marked.len()).filter(|at| marked[*at]) {
            lines.add(grid.lines[at]);
            grid.drop_row(grid.lines[at], Dropped::OutOfRange);
        }
    }
    grid.remove(&marked);
    if !named {
        log.push(Warning::OutOfRange { count, from_nm, to_nm, lines });
    }
    Ok(())
}

/// Brings a grid into ascending order without repeats. Returns whether it was descending. Refuses rows most of which are at one
/// wavelength, and numbers that go up and down where nothing says that they are wavelengths.
pub(super) fn sort(grid: &mut Grid, unit: &Decided<WavelengthUnit>, log: &mut Log<'_>) -> Result<bool, ReadError> {
    const FEWEST_SETTINGS: usize = 4;
    const FEWEST_MIXED: usize = 4;
    let wavelengths = &grid.wavelengths;
    let falls = wavelengths.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let rises = wavelengths.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let descending = falls > rises;
    let mut mixed = None;
    if falls > 0 && rises > 0 {
        let wrong = |pair: &[f64]| if descending { pair[1] > pair[0] } else { pair[1] < pair[0] };
        let at = wavelengths.windows(2).position(wrong).unwrap_or(0);
        let unsaid = unit.certainty == Certainty::Guess && !is_named(grid) && 4 * rises.min(falls) > rises + falls;
        mixed = (unsaid && rises + falls >= FEWEST_MIXED).then(|| grid.line(at + 1));
        log.push(Warning::Sorted(grid.line(at + 1)));
    }
    if falls > 0 {
        let mut order: Vec<usize> = (0..wavelengths.len()).collect();
        order.sort_by(|&a, &b| wavelengths[a].total_cmp(&wavelengths[b]));
        grid.reorder(&order);
    }
    // Points picked off a plot of one curve may stand in any order.
    let is_picked = |curves: &[RawCurve]| matches!(curves, [only] if !only.named && !is_scattered(&only.values));
    if let Some(line) = mixed.filter(|_| !is_picked(&grid.curves)) {
        return Err(ReadError::NoWavelengths(line));
    }
    // What more than half are is in the middle.
    let (all, nm) = (&grid.wavelengths, grid.wavelengths[grid.wavelengths.len() / 2]);
    let (from, to) = (all.partition_point(|other| *other < nm), all.partition_point(|other| *other <= nm));
    let (count, rows) = (to - from, all.len());
    if count >= FEWEST_SETTINGS && 2 * count > rows && !(from + 1..to).all(|row| grid.same_values(from, row)) {
        return Err(ReadError::OneWavelength { line: grid.line(from), nm, count, rows });
    }
    let (line, averaged) = (grid.line(0), merge_repeats(grid, log));
    // So many pairs of values at one whole number each are of other axes, such as places.
    let whole = || grid.curves.len() > 1 && grid.wavelengths.iter().all(|nm| nm.fract() == 0.0);
    let guessed = unit.certainty == Certainty::Guess && !is_named(grid);
    if guessed && FEWEST_IN_ORDER < rows && 2 * averaged > rows && whole() {
        return Err(ReadError::NoWavelengths(line));
    }
    Ok(descending)
}

/// True for values that go up and down over their whole range from one to the next, which none over wavelengths in order do.
fn is_scattered(values: &[f64]) -> bool {
    const MOST_SWINGS: f64 = 6.0;
    let present = || values.iter().copied().filter(|value| !value.is_nan());
    let (low, high) = extent(present());
    let path: f64 = present().zip(present().skip(1)).map(|(a, b)| (b - a).abs()).sum();
    MOST_SWINGS * path > (high - low) * values.len() as f64
}

pub(super) fn warn(grid: &Grid, step: Steps, unit: WavelengthUnit, log: &mut Log<'_>) {
    const VISIBLE_NM: std::ops::RangeInclusive<f64> = 380.0..=780.0;
    const LEAST_NM: f64 = 20.0;
    const TIMES: f64 = 10.0;
    const GROWTH: f64 = 4.0;
    let wavelengths = &grid.wavelengths;
    let outside = |end: Option<&f64>, beyond: fn(f64) -> bool| end.is_some_and(|&nm| beyond(nm));
    if outside(wavelengths.first(), |nm| nm > *VISIBLE_NM.end())
        || outside(wavelengths.last(), |nm| nm < *VISIBLE_NM.start())
    {
        log.push(Warning::Invisible);
    }
    let own = grid.lines.len() == wavelengths.len();
    if grid.own_wavelengths && !own {
        return;
    }
    let width = |at: usize| wavelengths[at + 1] - wavelengths[at];
    // Even steps of wave numbers and frequencies are none of wavelengths.
    let inverse = |at: usize| 1.0 / wavelengths[at] - 1.0 / wavelengths[at + 1];
    let inverse_median = unit.is_inverse().then(|| median((0..wavelengths.len() - 1).map(inverse)));
    let is_wide = |at: usize| inverse_median.is_none_or(|median| inverse(at) > TIMES * median);
    // Nor are steps that grow from one to the next.
    let beside = |at: usize| {
        let below = at.checked_sub(1).map_or(f64::INFINITY, width);
        if at + 2 < wavelengths.len() { below.min(width(at + 1)) } else { below }
    };
    let holes = (0..wavelengths.len() - 1)
        .filter(|&at| width(at) > LEAST_NM.max(TIMES * step.median) && is_wide(at) && width(at) > GROWTH * beside(at));
    // The first of the widest.
    if let Some(at) = holes.clone().rev().max_by(|a, b| width(*a).total_cmp(&width(*b))) {
        let mut lines = [grid.line(at), grid.line(at + 1)];
        lines.sort_unstable();
        let (from_nm, to_nm, count) = (wavelengths[at], wavelengths[at + 1], holes.count());
        log.push(Warning::Hole { count, from_nm, to_nm, lines: own.then_some(lines) });
    }
}

/// Leaves one of rows that are the same, and the mean of rows that differ at one wavelength; returns how many these were.
fn merge_repeats(grid: &mut Grid, log: &mut Log<'_>) -> usize {
    let mut repeats = vec![false; grid.wavelengths.len()];
    let (mut same, mut averaged) = (Vec::new(), Vec::new());
    let mut start = 0;
    while start < repeats.len() {
        let wavelength = grid.wavelengths[start];
        let count = grid.wavelengths[start..].iter().take_while(|other| **other == wavelength).count().max(1);
        let rest = start + 1..start + count;
        if count > 1 {
            let mut lines: Vec<usize> = (start..start + count).map(|row| grid.line(row)).collect();
            lines.sort_unstable();
            if rest.clone().all(|row| grid.same_values(start, row)) {
                same.extend(&lines[1..]);
            } else {
                averaged.append(&mut lines);
                grid.average(start, count);
            }
        }
        repeats[rest].fill(true);
        start += count;
    }
    if repeats.contains(&true) {
        grid.remove(&repeats);
    }
    let count = averaged.len();
    for (mut lines, why) in [(same, Dropped::Repeated), (averaged, Dropped::Averaged)] {
        lines.sort_unstable();
        let list: LineList = lines.iter().copied().collect();
        for line in lines {
            grid.drop_row(line, why);
        }
        match why {
            _ if list.is_empty() => {}
            Dropped::Averaged => log.push(Warning::AveragedRows(list)),
            _ => log.push(Warning::RepeatedRows(list)),
        }
    }
    count
}

/// Start of a second pass over the wavelengths of a first one, if rows do: that is another table, not disorder.
pub(super) fn second_pass(wavelengths: &[f64]) -> Option<usize> {
    // What begins with the very same wavelength is no disorder, however short.
    const FEWEST_AGAIN: usize = 3;
    const FEWEST: usize = 5;
    let steps = || wavelengths.windows(2);
    let falls = steps().filter(|pair| pair[1] < pair[0]).count();
    let rises = steps().filter(|pair| pair[1] > pair[0]).count();
    let back = |pair: &[f64]| if falls > rises { pair[1] > pair[0] } else { pair[1] < pair[0] };
    let starts: Vec<usize> = steps().enumerate().filter(|(_, pair)| back(pair)).map(|(at, _)| at + 1).collect();
    let first = *starts.first()?;
    let ends = starts.iter().copied().skip(1).chain([wavelengths.len()]);
    let again = starts.iter().all(|start| wavelengths[*start] == wavelengths[0]);
    let fewest = if again { FEWEST_AGAIN } else { FEWEST };
    let whole = first >= fewest && starts.iter().zip(ends).all(|(start, end)| end - start >= fewest);
    if !whole {
        return None;
    }
    let (before, after) =
        (&wavelengths[..first], &wavelengths[first..starts.get(1).copied().unwrap_or(wavelengths.len())]);
    let (low, high) = (before[0].min(before[first - 1]), before[0].max(before[first - 1]));
    let order = |x: &f64, wanted: f64| if falls > rises { wanted.total_cmp(x) } else { x.total_cmp(&wanted) };
    let shared = |wanted: &f64| before.binary_search_by(|x| order(x, *wanted)).is_ok();
    let within = before[0] == after[0] || after.iter().all(|x| (low..=high).contains(x));
    (within && after.iter().any(shared)).then_some(first)
}
