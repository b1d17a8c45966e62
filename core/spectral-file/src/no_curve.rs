//! Numbers that are no curve: temperatures, times, counts of rows, other scales of the same samples, the counts that some
//! instruments write beside the curve they made of them, and numbers that stand for missing values (−999, 9999, −1.23e34).

use std::collections::BTreeSet;

use crate::decimal::extent;
use crate::decision::{Decided, Decision, Values};
use crate::grid::{Grid, RawCurve, retain};
use crate::header_terms::Channel;
use crate::options::ReadOptions;
use crate::text::{begins, is_one, spaced};
use crate::warning::{LineList, Sentinel, Warning};
use crate::watch::Log;
use crate::{header_terms, unit_text};

/// The fewest rows that show how two columns belong together.
pub(super) const FEWEST_ROWS: usize = 3;

/// Names of what is recorded beside spectra, without their units.
const NAMES: &str = "temperature|temp|temp.|t_amb|ambient temperature|detector temperature|ccd temperature|temperatur|\
    température|temperatura|time|elapsed time|elapsed|timestamp|time stamp|date|day|hour|zeit|temps|tiempo|integration time|\
    exposure|exposure time|humidity|relative humidity|rel. humidity|imgs|noise|snr|s/n|bandwidth|bandpass|fwhm|pressure|air pressure|voltage|battery|battery voltage|\
    altitude|latitude|longitude|repeat|repeats|n contrib|n obs|n spectra|calibration|theta|phase|theta device|gain|flag|flags|quality flag|bias";

/// What detectors give, recorded beside what was made of it: last words of names.
const SIGNALS: &str = "current|photocurrent|voltage";

/// What is one number of a whole spectrum, repeated in each row.
const OF_SPECTRUM: &str = "luminance|illuminance|lux|cct|duv|cri|dominant wavelength|peak wavelength|purity";

const UNITS: &str = "°c|℃|deg c|degc|°f|℉|° c|celsius|kelvin|seconds|ms|hpa|mbar|kpa|%rh|% rh|rh";

/// Removes curves that are no spectra, unless there are no others.
pub(super) fn leave_out(grid: &mut Grid, log: &mut Log<'_>) {
    if is_own(grid) {
        return;
    }
    let made = grid.curves.iter().any(|curve| !is_blank(curve) && header_terms::role(&curve.label).is_some());
    let marks: Vec<bool> = grid.curves.iter().map(|curve| is_companion(curve, made)).collect();
    let count = marks.iter().filter(|mark| **mark).count();
    if count == grid.curves.len() {
        return;
    }
    let Some(first) = marks.iter().position(|mark| *mark) else { return };
    log.push(Warning::NotSpectra { count, first: grid.curves[first].description() });
    retain(&mut grid.curves, &marks);
}

/// Removes curves of fewer than two values, unless there are no others: their heads say nothing of the rest.
pub(super) fn leave_out_blank(grid: &mut Grid, log: &mut Log<'_>) {
    let marks: Vec<bool> = grid.curves.iter().map(is_blank).collect();
    if marks.iter().all(|mark| *mark) {
        return;
    }
    let worth_a_word = |curve: &&RawCurve| !curve.label.is_empty() || curve.values.iter().any(|value| !value.is_nan());
    let left =
        || grid.curves.iter().zip(&marks).filter(|(_, mark)| **mark).map(|(curve, _)| curve).filter(worth_a_word);
    let Some(first) = left().next() else { return retain(&mut grid.curves, &marks) };
    log.push(Warning::EmptyCurves { count: left().count(), first: first.description() });
    if let Some((line, role)) = grid.header.mentioned
        && grid.header.line == Some(line)
        && left().any(|curve| header_terms::role(&curve.label) == Some(role))
        && !grid.curves.iter().any(|curve| !is_blank(curve) && header_terms::role(&curve.label) == Some(role))
    {
        grid.header.mentioned = None;
    }
    retain(&mut grid.curves, &marks);
}

/// The most curves of which one that is unlike the others is said.
const FEW: usize = 12;

/// Warns of columns that may be no spectra, by their numbers: widths of bins, counts of scans and settings stand beside spectra under
/// names that nothing tells from theirs.
pub(super) fn warn_of_strangers(grid: &Grid, log: &mut Log<'_>) {
    warn_of_constants(grid, log);
    warn_of_integrals(grid, log);
    let is_channel = |curve: &&RawCurve| matches!(header_terms::channel(&curve.name), Some(Channel::Letter(_)));
    let are_channels = grid.curves.iter().filter(is_channel).count() >= 3;
    let are_known = are_channels || grid.curves.iter().any(|curve| is_index_part(&curve.name));
    if !is_own(grid) && (2..=FEW).contains(&grid.curves.len()) && !are_known {
        warn_of_other_sizes(grid, log);
        warn_of_steps(grid, log);
    }
}

/// Returns whether a name is of one part of a refractive index: `n`, `glass_k`.
fn is_index_part(name: &str) -> bool {
    name.rsplit(['_', ' ']).next().is_some_and(|part| is_one(part, "n|k|N|K"))
}

/// Warns of columns that hold one number only: zero, or any without a name.
fn warn_of_constants(grid: &Grid, log: &mut Log<'_>) {
    const FEWEST: usize = 10;
    let is_constant = |curve: &&RawCurve| {
        let value = curve.values[0];
        (value == 0.0 || !curve.named && grid.curves.len() > 1)
            && curve.values.len() >= FEWEST
            && curve.values.iter().all(|other| *other == value)
    };
    let mut constant = grid.curves.iter().filter(is_constant);
    if let Some(first) = constant.next() {
        let (value, first) = (first.values[0], first.description());
        log.push(Warning::Constant { count: 1 + constant.count(), first, value });
    }
}

/// Warns of columns far smaller or larger than the others of a few.
fn warn_of_other_sizes(grid: &Grid, log: &mut Log<'_>) {
    const RATIO: f64 = 100.0;
    let size = |curve: &RawCurve| curve.values.iter().fold(0.0_f64, |size, value| size.max(*value));
    let mut sizes: Vec<(f64, &RawCurve)> = grid.curves.iter().map(|curve| (size(curve), curve)).collect();
    sizes.retain(|(size, _)| *size > 0.0);
    sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(gap) = sizes.windows(2).position(|pair| pair[1].0 > RATIO * pair[0].0) else { return };
    let (small, large) = sizes.split_at(gap + 1);
    let (few, many) = if small.len() > large.len() { (large, small) } else { (small, large) };
    let (first, other) = (few[0].1.description(), many[0].1.description());
    log.push(Warning::OtherSize { count: few.len(), first, other });
}

/// Warns of columns that only rise, from nothing to their end, as sums over the wavelengths below do.
fn warn_of_integrals(grid: &Grid, log: &mut Log<'_>) {
    const FEWEST_VALUES: usize = 20;
    const NOTHING: f64 = 1e-3;
    let is_sum = |curve: &&RawCurve| {
        let (Some(first), Some(last)) = (curve.values.first(), curve.values.last()) else { return false };
        !curve.named
            && first.abs() < NOTHING * last
            && grid.wavelengths.len() >= FEWEST_VALUES
            && curve.values.is_sorted_by(|a, b| a <= b)
            && curve.values.windows(2).filter(|pair| pair[0] < pair[1]).count() * 2 > curve.values.len()
    };
    let mut sums = grid.curves.iter().filter(is_sum);
    if let Some(first) = sums.next().filter(|_| !is_own(grid)) {
        log.push(Warning::Integral { count: 1 + sums.count(), first: first.description() });
    }
}

/// How many different numbers there are, at most one more than `most`.
fn levels(numbers: impl Iterator<Item = f64>, most: usize) -> usize {
    const BITS_OF_ZERO: u64 = 0;
    let mut found = BTreeSet::new();
    for number in numbers {
        found.insert(if number == 0.0 { BITS_OF_ZERO } else { number.to_bits() });
        if found.len() > most {
            break;
        }
    }
    found.len()
}

/// Warns of columns of whole numbers, or of few or nearly equal ones, beside others that are not so.
fn warn_of_steps(grid: &Grid, log: &mut Log<'_>) {
    const FEWEST_VALUES: usize = 10;
    const LEVELS: usize = 3;
    const STEADY: f64 = 0.01;
    const FEW_OF: usize = 10;
    let is_stepped = |curve: &&RawCurve| {
        let present = || curve.values.iter().copied().filter(|value| !value.is_nan());
        let levels = levels(present(), LEVELS);
        // Of which others warn.
        let is_constant = levels == 1 && (curve.values[0] == 0.0 || !curve.named);
        let near = |value: f64| (value - curve.values[0]).abs() < STEADY * value.abs();
        let steady = || curve.named && present().all(near);
        // Counts of detectors are whole too, but hardly the same twice.
        let whole = || {
            let filled = present().filter(|value| *value != 0.0).count();
            present().all(|value| value.fract() == 0.0)
                && FEW_OF * self::levels(present(), filled) < filled.max(FEW_OF * FEWEST_VALUES)
        };
        let is_light = || curve.name == "E" || header_terms::names_illuminant(&curve.name);
        !is_constant && (levels <= LEVELS || steady() || whole()) && !is_light()
    };
    let stepped: Vec<&RawCurve> = grid.curves.iter().filter(is_stepped).collect();
    if let [first, ..] = stepped[..]
        && 2 * stepped.len() <= grid.curves.len()
        && grid.wavelengths.len() >= FEWEST_VALUES
    {
        log.push(Warning::Stepped { count: stepped.len(), first: first.description() });
    }
}

fn is_blank(curve: &RawCurve) -> bool {
    curve.values.iter().filter(|value| !value.is_nan()).nth(1).is_none()
}

/// True for the program's own tables, which hold neither numbers for gaps nor columns that are no curves.
fn is_own(grid: &Grid) -> bool {
    !grid.header.own.is_empty()
}

/// Returns whether there is nothing but what is recorded beside spectra.
pub(super) fn is_only_beside(grid: &Grid) -> bool {
    !is_own(grid)
        && !grid.curves.is_empty()
        && grid.curves.iter().all(|curve| curve.unit.is_none() && is_companion(curve, false))
}

/// `made` says that another column is what was made of signals.
fn is_companion(curve: &RawCurve, made: bool) -> bool {
    const LONGEST: usize = 60;
    if !curve.named || curve.name.len() > LONGEST || curve.label.len() > 2 * LONGEST {
        return false;
    }
    let name = spaced(unit_text::without_unit(&curve.name).trim());
    let label = curve.label.to_lowercase();
    let bracketed = UNITS.split('|').any(|unit| {
        let inside = |open: char, close: char| label.ends_with(&format!("{open}{unit}{close}"));
        inside('(', ')') || inside('[', ']')
    });
    let bare = name.split(['(', '[']).next().unwrap_or_default().trim().replace('_', " ");
    let angle = bare.rsplit(' ').next().is_some_and(|word| is_one(word, "azimuth|zenith|incidence|aoi"));
    let signal = made && bare.rsplit(' ').next().is_some_and(|word| is_one(word, SIGNALS));
    let width = bare.split(' ').any(|word| is_one(word, "wdth|width|halfwidth|binwidth"));
    let named = signal || angle || width || is_one(&bare, NAMES) || is_one(&name, NAMES);
    let of_all = is_one(&bare, OF_SPECTRUM) && curve.values.iter().all(|value| *value == curve.values[0]);
    // A pixel of each of a few lines, too.
    let in_order = || runs_one_way(&curve.values) && curve.values.iter().all(|value| value.fract() == 0.0);
    let counted = || counts(&curve.values) || is_one(&bare, "pixel|pixels") && in_order();
    let counts = header_terms::is_count(&bare) && !bare.contains(' ') && curve.values.len() > 2 && counted();
    // What names a quantity of light is a spectrum, whatever stands in brackets.
    let integral = begins(&label, "cumulative|cumulated|integrated irradian|integrated radian");
    of_all || integral || (named || bracketed || counts) && header_terms::role(&curve.label).is_none()
}

/// Returns whether numbers never turn back.
pub(super) fn runs_one_way(values: &[f64]) -> bool {
    values.is_sorted_by(|a, b| a <= b) || values.is_sorted_by(|a, b| a >= b)
}

pub(super) fn is_empty(column: &[f64]) -> bool {
    column.iter().all(|value| value.is_nan())
}

/// True for numbers that count their rows, up or down.
pub(super) fn counts(column: &[f64]) -> bool {
    column.len() > 1
        && column.windows(2).all(|pair| (pair[1] - pair[0]).abs() == 1.0 && pair[1] - pair[0] == column[1] - column[0])
}

/// True for numbers that count their rows from the first, whatever they are called.
pub(super) fn counts_from_start(column: &[f64], fewest: usize) -> bool {
    column.len() >= fewest && counts(column) && matches!(column[0], 0.0 | 1.0)
}

/// True for numbers that may identify or mark rows: all equal, or flags, or a count of the rows.
pub(super) fn tells_rows_apart(column: &[f64]) -> bool {
    let whole = column.iter().all(|value| value.fract() == 0.0);
    let flags = || column.iter().all(|value| matches!(value, 0.0 | 1.0));
    whole && (counts(column) || flags() || column.iter().all(|value| *value == column[0]))
}

/// True for a column that holds the wavelengths of another in a unit that is inverse to theirs, or the upper edges of their
/// intervals.
pub(super) fn is_other_scale(wavelengths: &[f64], column: &[f64]) -> bool {
    /// Wave numbers in 1/cm, energies in eV and frequencies in THz and Hz, times nanometers.
    const PRODUCTS: [f64; 4] = [1e7, 1_239.841_984, 299_792.458, 299_792.458e12];
    /// Of micrometers and of ångströms too.
    const UNITS: [f64; 3] = [1.0, 1e-3, 10.0];
    /// Of three digits, `1.01E+03`.
    const CLOSE: f64 = 6e-3;
    if wavelengths.len() < FEWEST_ROWS {
        return false;
    }
    let inverse = |product: f64| wavelengths.iter().zip(column).all(|(w, c)| (w * c / product - 1.0).abs() < CLOSE);
    PRODUCTS.iter().any(|product| UNITS.iter().any(|unit| inverse(product * unit)))
        || are_upper_ends(wavelengths, column)
        || are_widths(wavelengths, column)
}

/// True for the widths of intervals, each as wide as the step to the next wavelength, where steps differ.
fn are_widths(wavelengths: &[f64], column: &[f64]) -> bool {
    const LEAST: f64 = 1.05;
    const CLOSE: f64 = 0.02;
    let steps = || wavelengths.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let fit = |(step, width): &(f64, &f64)| (*width / step - 1.0).abs() < CLOSE;
    if !steps().zip(column).take(FEWEST_ROWS).any(|pair| fit(&pair)) {
        return false;
    }
    let (least, most) = extent(steps());
    let fits = steps().zip(column).filter(fit).count();
    least > 0.0 && most > LEAST * least && 10 * fits > 9 * wavelengths.len()
}

/// True for the upper ends of intervals that begin at the wavelengths, one at the end of the other.
pub(super) fn are_upper_ends(wavelengths: &[f64], column: &[f64]) -> bool {
    wavelengths.len() >= FEWEST_ROWS && wavelengths[1..] == column[..column.len() - 1]
}

/// True for a row of a table across that holds no spectrum: wave numbers, times, or numbers that count the columns.
pub(super) fn is_scale_row<'a>(leading: impl Iterator<Item = &'a str>, wavelengths: &[f64], curve: &RawCurve) -> bool {
    let name = leading.filter(|cell| !cell.is_empty()).take(usize::from(curve.named)).next();
    let named = name.is_some_and(|name| {
        header_terms::names_axis(name) && runs_one_way(&curve.values)
            || header_terms::names_time(name)
            || header_terms::is_count(name) && counts(&curve.values)
    });
    named || is_other_scale(wavelengths, &curve.values)
}

/// Removes raw columns if a processed one exists, unless they are requested.
pub(super) fn leave_out_raw(grid: &mut Grid, options: &ReadOptions) -> Option<Decision> {
    if options.raw == Some(true) || is_own(grid) {
        return None;
    }
    let raw = raw_marks(&grid.curves)?;
    let list = |wanted: bool| {
        let named = grid.curves.iter().zip(&raw).filter(|(_, raw)| **raw == wanted);
        named.map(|(curve, _)| format!("“{}”", curve.name)).collect::<Vec<_>>().join(", ")
    };
    let (kept, left) = (list(false), list(true));
    let decided = Decided::or_chosen(options.raw.map(|_| kept.clone()), || {
        Decided::certain(kept, format!("By the header {left} are what it was computed from"))
    });
    retain(&mut grid.curves, &raw);
    Some(Decision::new("Columns", &decided))
}

/// Removes columns of quantities that hold only zeros beside measured ones of others: programs write them although nothing was
/// computed, and their heads say nothing of the rest.
pub(super) fn leave_out_uncomputed(grid: &mut Grid, log: &mut Log<'_>) {
    let says = |curve: &RawCurve| {
        header_terms::role(&curve.label).is_some()
            || header_terms::values(&curve.label).is_some_and(|v| v != Values::Plain)
    };
    let is_zero = |curve: &RawCurve| {
        curve.values.contains(&0.0) && curve.values.iter().all(|value| *value == 0.0 || value.is_nan())
    };
    let marks: Vec<bool> = grid.curves.iter().map(|curve| is_zero(curve) && says(curve)).collect();
    let Some(first) = marks.iter().position(|mark| *mark) else { return };
    let mut measured = grid.curves.iter().filter(|curve| !is_zero(curve)).peekable();
    if measured.peek().is_none() || measured.any(says) {
        return;
    }
    log.push(Warning::Uncomputed {
        count: marks.iter().filter(|mark| **mark).count(),
        first: grid.curves[first].description(),
    });
    if grid.header.mentioned.is_some_and(|(line, _)| grid.header.line == Some(line)) {
        grid.header.mentioned = None;
    }
    retain(&mut grid.curves, &marks);
}

/// Flags for the curves that are raw; `None` if none is, or all are.
fn raw_marks(curves: &[RawCurve]) -> Option<Vec<bool>> {
    const LETTERS: [&str; 3] = ["D", "R", "S"];
    let letters = curves.iter().all(|curve| curve.name == "P" || LETTERS.contains(&curve.name.as_str()));
    let jaz = letters && curves.len() >= 2 && curves.iter().any(|curve| curve.name == "P");
    let processed = curves.iter().any(is_processed);
    let reflected = curves.iter().any(|curve| curve.name.eq_ignore_ascii_case("reflectance"));
    let starts = |curve: &RawCurve, start: &str| curve.label.to_lowercase().starts_with(start);
    let radiant = |curve: &RawCurve| starts(curve, "rad. (") || starts(curve, "irrad. (");
    let radiates = !processed && curves.iter().any(radiant);
    // The logarithm of what stands beside it.
    let logged = curves.iter().any(|curve| starts(curve, "reflect."));
    let raw = |curve: &RawCurve| {
        let raw = curve.label.to_lowercase().contains("count") || is_raw_name(&curve.name);
        // Light that came from the sample is recorded beside its reflectance.
        let light = reflected && is_one(&curve.name.to_lowercase(), "radiance|irradiance");
        let log = logged && starts(curve, "-log reflect.");
        let counts = radiates && !radiant(curve) && raw;
        if jaz { curve.name != "P" } else { light || log || counts || processed && !is_processed(curve) && raw }
    };
    let marks: Vec<bool> = curves.iter().map(raw).collect();
    (marks.contains(&true) && marks.contains(&false)).then_some(marks)
}

/// Returns whether a header describes a column computed from others.
fn is_processed(curve: &RawCurve) -> bool {
    let lower = curve.label.to_lowercase();
    let said = header_terms::role(&curve.label).is_some()
        || header_terms::says_percent(&lower)
        || header_terms::values(&curve.label) == Some(Values::Absorbance)
        || begins(&lower, "tgt./ref|dark subtracted");
    let measured = lower.contains("count") || is_side(&lower);
    !measured && (said || curve.name.eq_ignore_ascii_case("processed"))
}

const RAW: &str =
    "raw|raw data|dark|ref|reference|sample|scope|reference_corrected|sample_corrected|reference signal|sample signal";

fn is_raw_name(name: &str) -> bool {
    let lower = name.to_lowercase();
    let bare = lower.trim_end_matches(" (unitless)").trim_end_matches(" #1");
    is_side(&lower) || is_one(bare, RAW)
}

/// Returns whether a header is that of one side of a ratio, as Spectral Evolution writes: `Norm. DN (Ref.)`, `Rad. (Target)`.
fn is_side(lower: &str) -> bool {
    lower.ends_with(" (ref.)") || lower.ends_with(" (target)")
}

/// Numbers that programs write for missing values, as sizes, the smallest first; each with either sign. (−9999 is one wherever it stands.)
const SIZES: [f64; 17] = [
    9.999, 99.0, 99.9, 99.99, 999.0, 999.25, 999.9, 999.99, 8_888.0, 9_999.0, 9_999.9, 9_999.99, 99_999.0, 999_999.0,
    32_767.0, 32_768.0, 65_535.0,
];
const LARGE_SIZES: [f64; 3] = [9_999_999.0, 99_999_999.0, 2_147_483_648.0];

/// Sizes far beyond what is measured: of USGS (1.23e34), netCDF (9.97e36), instruments with SCPI (9.91e37), and the largest number
/// in single precision, each to the digits that are written; and its half.
const HUGE: [f64; 13] =
    [1e30, 1e31, 1e32, 1e33, 1e34, 1.23e34, 1e35, 1e36, 9.969_21e36, 1e37, 9.9e37, 9.91e37, 3.402_823e38];
const HALF: [f64; 2] = [1.7e38, 1.701_411e38];
const WRITTEN: f64 = 1e-6;

const COMMON: f64 = 1e19;

fn is_huge(size: f64) -> bool {
    let near = |known: &f64| (size - known).abs() <= WRITTEN * known;
    size >= HUGE[0] * (1.0 - WRITTEN) && HUGE.iter().chain(&HALF).any(near)
}

/// Factors by which a number must stand out below and above the others: percent reach 100, beside which 999 is none.
const TIMES: [f64; 2] = [10.0, 5.0];

fn is_candidate(value: f64) -> bool {
    let size = value.abs();
    // A reading of 99 is no rarity above zero.
    // Most values are smaller than all of them.
    size >= SIZES[0]
        && (is_huge(size) || LARGE_SIZES.contains(&size) || SIZES.contains(&size) && (value < 0.0 || size >= 999.0))
}

/// Returns whether a number stands for a missing value beside the others, which run from `low` to `high` if there are any.
fn stands_for_none(value: f64, (low, high): (f64, f64)) -> bool {
    let largest = low.abs().max(high.abs());
    is_candidate(value)
        && match () {
            () if low > high => value < 0.0,
            () if is_huge(value.abs()) => largest <= COMMON,
            () if value < 0.0 => low >= value / TIMES[0],
            () => value >= TIMES[1] * largest,
        }
}

/// Returns whether −1 stands there again and again beside values that are not below zero.
fn repeats_minus_one(values: &[f64]) -> bool {
    const FEWEST: usize = 3;
    let (marks, others): (Vec<f64>, Vec<f64>) =
        values.iter().filter(|value| **value < 0.0).partition(|value| **value == -1.0);
    others.is_empty() && marks.len() >= FEWEST && marks.len() * 2 < values.len()
}

/// Makes gaps of numbers that stand for missing values, before rows of one wavelength are averaged.
pub(super) fn take_sentinels(grid: &mut Grid, log: &mut Log<'_>) {
    if is_own(grid) {
        return;
    }
    let own_lines = grid.lines.len() == grid.wavelengths.len() && !grid.own_wavelengths;
    let mut cells = 0;
    let mut first: Option<Sentinel> = None;
    for curve in &mut grid.curves {
        if !curve.values.iter().any(|value| *value == -1.0 || is_candidate(*value)) {
            continue;
        }
        let marked = repeats_minus_one(&curve.values);
        let others = extent(curve.values.iter().copied().filter(|value| !value.is_nan() && !is_candidate(*value)));
        let is_none = |value: &f64| stands_for_none(*value, others) || marked && *value == -1.0;
        let Some(&number) = curve.values.iter().find(|value| is_none(value)) else { continue };
        first.get_or_insert_with(|| Sentinel { number, curve: curve.description() });
        for value in curve.values.iter_mut().filter(|value| is_none(value)) {
            *value = f64::NAN;
            cells += 1;
        }
    }
    if let Some(sentinel) = first {
        if own_lines {
            // Reported with the other gaps of the rows.
            grid.sentinel = Some(sentinel);
        } else {
            log.push(Warning::Gaps { cells, lines: LineList::default(), sentinel: Some(sentinel) });
        }
    }
}
