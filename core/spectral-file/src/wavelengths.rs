//! Wavelengths: their unit, their range, their order, and repeats.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::reading::clean;
use super::warning::{LineList, Warning};
use super::watch::Log;
use super::words::XUnit;
use super::{Decided, Dropped, ReadError, ReadOptions, Steps, decimal};

/// The unit in which wavelengths are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WavelengthUnit {
    /// nm.
    #[serde(alias = "nanometers")]
    Nanometer,
    /// µm: 1000 nm.
    #[serde(alias = "micrometers")]
    Micrometer,
    /// Å: 0.1 nm.
    #[serde(alias = "angstroms")]
    Angstrom,
    /// Wave numbers σ in 1/cm, taken as the vacuum wavelength 10⁷ nm/σ.
    Wavenumber,
    /// Frequencies ν in THz, taken as the vacuum wavelength c/ν with c = 299 792.458 nm THz.
    Terahertz,
}

impl fmt::Display for WavelengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nanometer => "nanometers",
            Self::Micrometer => "micrometers",
            Self::Angstrom => "ångströms",
            Self::Wavenumber => "wave numbers in 1/cm",
            Self::Terahertz => "frequencies in terahertz",
        })
    }
}

impl WavelengthUnit {
    /// The unit of a symbol or name, such as `nm`, `um`, `µm` or `Micrometers`.
    pub(super) fn from_symbol(symbol: &str) -> Option<Self> {
        if symbol.len() > 16 {
            return None;
        }
        let lower = symbol.to_lowercase();
        match lower.as_str() {
            "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => Some(Self::Nanometer),
            // U+00B5 and U+03BC, and the former misread as Windows-1252.
            "um" | "µm" | "μm" | "âµm" | "micron" | "microns" | "micro" | "micrometer" | "micrometers"
            | "micrometre" | "micrometres" => Some(Self::Micrometer),
            "cm-1" | "cm^-1" | "1/cm" | "cm⁻¹" | "wavenumbers" => Some(Self::Wavenumber),
            "thz" | "terahertz" => Some(Self::Terahertz),
            "å" | "ångström" | "ångströms" | "angstrom" | "angstroms" => Some(Self::Angstrom),
            _ => None,
        }
    }

    /// The wavelength in nanometers that a number in this unit means, to 1e-9 nm.
    pub fn nanometers(self, value: f64) -> f64 {
        match self {
            Self::Nanometer => value,
            Self::Micrometer => clean(decimal::shifted(value, 3)),
            Self::Angstrom => clean(decimal::shifted(value, -1)),
            Self::Wavenumber => clean(1e7 / value),
            Self::Terahertz => clean(SPEED_OF_LIGHT_NM_THZ / value),
        }
    }

    /// The number in this unit that means a wavelength in nanometers, to 1e-9 of the unit: what
    /// [`nanometers`](Self::nanometers) was given.
    pub fn from_nanometers(self, nm: f64) -> f64 {
        match self {
            Self::Nanometer => nm,
            Self::Micrometer => decimal::shifted(nm, -3),
            Self::Angstrom => decimal::shifted(nm, 1),
            Self::Wavenumber => clean(1e7 / nm),
            Self::Terahertz => clean(SPEED_OF_LIGHT_NM_THZ / nm),
        }
    }
}

/// The speed of light in vacuum in nm THz, exact.
const SPEED_OF_LIGHT_NM_THZ: f64 = 299_792.458;

/// What the wavelengths may be, in nanometers: beyond what any instrument for light measures.
const RANGE_NM: std::ops::RangeInclusive<f64> = 100.0..=25_000.0;

/// Whether numbers can be wavelengths at all: in range as nanometers, or as micrometers with fractions.
pub(super) fn plausible(min: f64, max: f64, fractions: bool) -> bool {
    (RANGE_NM.contains(&min) && RANGE_NM.contains(&max)) || (fractions && min >= 0.2 && max <= 20.0)
}

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
        Some((line, XUnit::Other)) => Err(ReadError::NotWavelengths { line }),
        None => unit_from_range(grid),
    }
}

/// The unit that a range suggests. Where it fits ångströms and wave numbers, only a person knows.
fn unit_from_range(grid: &Grid) -> Result<Decided<WavelengthUnit>, ReadError> {
    let wavelengths = &grid.wavelengths;
    let min = wavelengths.iter().copied().fold(f64::INFINITY, f64::min);
    let max = wavelengths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let unit = if min >= 0.2 && max <= 20.0 {
        WavelengthUnit::Micrometer
    } else if (2000.0..=20_000.0).contains(&min) && (3000.0..=20_000.0).contains(&max) {
        return Err(ReadError::AmbiguousUnit { line: grid.line(0), min, max });
    } else if is_bare(grid) && min >= 400.0 && max > 3300.0 && min < 2000.0 && max <= 10_000.0 {
        // No spectrometer for light reaches so far from there, but those for the infrared all do.
        WavelengthUnit::Wavenumber
    } else if min >= 10_000.0 && max > 20_000.0 && max <= 50_000.0 {
        WavelengthUnit::Wavenumber
    } else {
        WavelengthUnit::Nanometer
    };
    Ok(Decided::guess(unit, format!("Wavelengths run from {min} to {max}")))
}

/// Whether a table is a single curve about which nothing is said.
fn is_bare(grid: &Grid) -> bool {
    let named = !grid.header.names.is_empty() || !grid.header.comments.is_empty() || grid.header.mentioned.is_some();
    grid.curves.len() == 1 && !named
}

/// Converts the wavelengths of a grid to nanometers and checks their range.
pub(super) fn to_nanometers(grid: &mut Grid, unit: WavelengthUnit) -> Result<(), ReadError> {
    for i in 0..grid.wavelengths.len() {
        let wavelength_nm = unit.nanometers(grid.wavelengths[i]);
        if !RANGE_NM.contains(&wavelength_nm) {
            return Err(ReadError::WavelengthOutOfRange { line: grid.line(i), wavelength_nm });
        }
        grid.wavelengths[i] = wavelength_nm;
    }
    Ok(())
}

/// Brings a grid into ascending order without repeats. Returns whether it was descending.
pub(super) fn sort(grid: &mut Grid, log: &mut Log<'_>) -> bool {
    let wavelengths = &grid.wavelengths;
    let falls = wavelengths.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let rises = wavelengths.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let descending = falls > rises;
    if falls > 0 && rises > 0 {
        let wrong = |pair: &[f64]| if descending { pair[1] > pair[0] } else { pair[1] < pair[0] };
        let at = wavelengths.windows(2).position(wrong).unwrap_or(0);
        log.push(Warning::Sorted { line: grid.line(at + 1) });
    }
    if falls > 0 {
        let mut order: Vec<usize> = (0..wavelengths.len()).collect();
        order.sort_by(|&a, &b| wavelengths[a].total_cmp(&wavelengths[b]));
        grid.reorder(&order);
    }
    merge_repeats(grid, log);
    descending
}

/// Warns of wavelengths that nobody sees, and of holes among them.
pub(super) fn warn(grid: &Grid, step: Steps, log: &mut Log<'_>) {
    const VISIBLE_NM: std::ops::RangeInclusive<f64> = 380.0..=780.0;
    const LEAST_NM: f64 = 20.0;
    const TIMES: f64 = 10.0;
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
    for (at, pair) in wavelengths.windows(2).enumerate() {
        if pair[1] - pair[0] > LEAST_NM.max(TIMES * step.median) {
            let mut lines = [grid.line(at), grid.line(at + 1)];
            lines.sort_unstable();
            log.push(Warning::Hole { from_nm: pair[0], to_nm: pair[1], lines: own.then_some(lines) });
        }
    }
}

/// Leaves one of rows that are the same, and the mean of rows that differ at one wavelength.
fn merge_repeats(grid: &mut Grid, log: &mut Log<'_>) {
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
    for (mut lines, why) in [(same, Dropped::Repeated), (averaged, Dropped::Averaged)] {
        lines.sort_unstable();
        let mut list = LineList::default();
        for &line in &lines {
            list.add(line);
            grid.drop_row(line, why);
        }
        match why {
            _ if list.is_empty() => {}
            Dropped::Averaged => log.push(Warning::AveragedRows { lines: list }),
            _ => log.push(Warning::RepeatedRows { lines: list }),
        }
    }
}

/// Where a second pass over the wavelengths of a first one begins, if rows do: that is another table, not disorder.
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
