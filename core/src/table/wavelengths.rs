//! Wavelengths: their unit, their range, their order, and repeats.

use std::fmt;

use super::grid::Grid;
use super::reading::clean;
use super::warning::{LineList, Warning};
use super::words::XUnit;
use super::{Decided, Dropped, ReadError, ReadOptions};

/// The unit in which wavelengths are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum WavelengthUnit {
    /// nm.
    Nanometer,
    /// µm: 1000 nm.
    Micrometer,
    /// Å: 0.1 nm.
    Angstrom,
}

impl fmt::Display for WavelengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nanometer => "nanometers",
            Self::Micrometer => "micrometers",
            Self::Angstrom => "ångströms",
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
            "å" | "ångström" | "ångströms" | "angstrom" | "angstroms" => Some(Self::Angstrom),
            _ => None,
        }
    }

    fn nanometers(self, value: f64) -> f64 {
        match self {
            Self::Nanometer => value,
            Self::Micrometer => clean(value * 1000.0),
            Self::Angstrom => clean(value / 10.0),
        }
    }
}

/// What the wavelengths may be, in nanometers: beyond what any instrument for light measures.
const RANGE_NM: std::ops::RangeInclusive<f64> = 100.0..=20_000.0;

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
        None => Ok(unit_from_range(&grid.wavelengths)),
    }
}

fn unit_from_range(wavelengths: &[f64]) -> Decided<WavelengthUnit> {
    let min = wavelengths.iter().copied().fold(f64::INFINITY, f64::min);
    let max = wavelengths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let unit = if min >= 0.2 && max <= 20.0 {
        WavelengthUnit::Micrometer
    } else if (2000.0..=20_000.0).contains(&min) && (3000.0..=20_000.0).contains(&max) {
        WavelengthUnit::Angstrom
    } else {
        WavelengthUnit::Nanometer
    };
    Decided::guess(unit, format!("Wavelengths run from {min} to {max}"))
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
pub(super) fn sort(grid: &mut Grid, warnings: &mut Vec<Warning>) -> Result<bool, ReadError> {
    let wavelengths = &grid.wavelengths;
    let falls = wavelengths.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let rises = wavelengths.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let descending = falls > rises;
    if falls > 0 && rises > 0 {
        let wrong = |pair: &[f64]| if descending { pair[1] > pair[0] } else { pair[1] < pair[0] };
        let at = wavelengths.windows(2).position(wrong).unwrap_or(0);
        refuse_second_pass(grid, rises, falls, at)?;
        warnings.push(Warning::Sorted { line: grid.line(at + 1) });
    }
    if falls > 0 {
        let mut order: Vec<usize> = (0..wavelengths.len()).collect();
        order.sort_by(|&a, &b| wavelengths[a].total_cmp(&wavelengths[b]));
        grid.reorder(&order);
    }
    merge_repeats(grid, warnings)?;
    Ok(descending)
}

/// Two or more passes over the same range, one below the other, are two tables, not one in disorder.
fn refuse_second_pass(grid: &Grid, rises: usize, falls: usize, at: usize) -> Result<(), ReadError> {
    const FEWEST: usize = 5;
    let w = &grid.wavelengths;
    let restart = rises.min(falls) == 1 && at + 1 >= FEWEST && w.len() - at > FEWEST;
    let overlap = restart && {
        let (before, after) = (&w[..=at], &w[at + 1..]);
        let (first, last) = (before[0].min(before[at]), before[0].max(before[at]));
        after.iter().all(|x| (first..=last).contains(x)) && after.iter().any(|x| before.contains(x))
    };
    if overlap { Err(ReadError::SecondTable { line: grid.line(at + 1) }) } else { Ok(()) }
}

/// Leaves one of rows that are the same; rows that differ at one wavelength are an error.
fn merge_repeats(grid: &mut Grid, warnings: &mut Vec<Warning>) -> Result<(), ReadError> {
    let mut repeats = vec![false; grid.wavelengths.len()];
    let mut lines = Vec::new();
    let mut kept = 0;
    for (i, repeat) in repeats.iter_mut().enumerate().skip(1) {
        if grid.wavelengths[i] != grid.wavelengths[kept] {
            kept = i;
            continue;
        }
        let (a, b) = (grid.line(kept), grid.line(i));
        if !grid.same_values(kept, i) {
            let wavelength_nm = grid.wavelengths[i];
            return Err(ReadError::RepeatedWavelength { line: a.max(b), first_line: a.min(b), wavelength_nm });
        }
        *repeat = true;
        lines.push(a.max(b));
    }
    if !lines.is_empty() {
        grid.remove(&repeats);
        lines.sort_unstable();
        let mut list = LineList::default();
        for &line in &lines {
            list.add(line);
            grid.drop_row(line, Dropped::Repeated);
        }
        warnings.push(Warning::RepeatedRows { lines: list });
    }
    Ok(())
}
