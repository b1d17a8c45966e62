//! Warnings in words.

use std::fmt;

use super::{LineList, Sentinel, Warning};
use crate::separators::DecimalMark;

impl Warning {
    /// Words about columns and rows that hold something else; nothing for the others.
    fn of_layout(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherAxes { named, wavelength_column: None } => {
                write!(f, "{named}: another scale than the wavelengths, no spectrum: left out")
            }
            Self::OtherAxes { named, wavelength_column: Some(column) } => {
                write!(f, "{named}: another scale than the wavelengths in column {column}, no spectrum: left out")
            }
            Self::MoreQuantities { taken, others } => {
                write!(f, "Rows of other quantities than “{taken}”: left out ({others}): choose the part to read them")
            }
            Self::BadWavelengths { line, named } => {
                write!(f, "line {line}: {named}: no wavelength there, so the column is left out")
            }
            _ => Ok(()),
        }
    }

    /// Part that concerns single curves, in words; empty for other warnings.
    fn of_curves(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EmptyCurves { count: 1, first } => write!(f, "{first} has fewer than two values: left out"),
            Self::EmptyCurves { count, first } => {
                write!(f, "{count} curves with fewer than two values, the first {first}: left out")
            }
            Self::TextColumns { count, column, name } => {
                write!(f, "Column {column}")?;
                if !name.is_empty() {
                    write!(f, " (“{name}”)")?;
                }
                match count {
                    1 => f.write_str(" holds text: left out"),
                    2 => f.write_str(" and another hold text: left out"),
                    _ => write!(f, " and {} others hold text: left out", count - 1),
                }
            }
            Self::Averaged { name, lines } => {
                write!(f, "{lines}: “{name}” has several values at one wavelength: their mean is taken")
            }
            Self::BelowZero { count, first, min, line } => {
                if let Some(line) = line {
                    write!(f, "line {line}: ")?;
                }
                match count {
                    1 => write!(f, "{first} falls to {min}, further below zero than noise"),
                    _ => write!(f, "{count} curves fall further below zero than noise, the first {first} to {min}"),
                }
            }
            Self::NotReflectances { first, max, .. } if *max > 1e30 => {
                write!(f, "{first} reaches {max:e}, more than any quantity of light can")
            }
            Self::NotReflectances { count: 1, first, max } => {
                write!(f, "{first} reaches {max}, more than a fraction of light can")
            }
            Self::NotReflectances { count, first, max } => {
                write!(f, "{count} curves reach more than a fraction of light can, the first {first} {max}")
            }
            Self::NotSpectra { count: 1, first } => write!(f, "{first} is no spectrum: left out"),
            Self::NotSpectra { count, first } => {
                write!(f, "{count} columns are no spectra, the first {first}: left out")
            }
            Self::ScalesDiffer { percent, first, other } => {
                let more = if *percent == 1 { String::new() } else { format!(" and {} more", percent - 1) };
                write!(f, "By their values {first}{more} are read as percent, others such as {other} as written")
            }
            _ => Ok(()),
        }
    }
}

fn gaps(f: &mut fmt::Formatter<'_>, cells: usize, lines: &LineList, sentinel: Option<&Sentinel>) -> fmt::Result {
    write!(f, "{cells} missing value{}", if cells == 1 { "" } else { "s" })?;
    if !lines.is_empty() {
        write!(f, ", {lines}")?;
    }
    f.write_str(": left out")?;
    match sentinel {
        Some(Sentinel { number, curve }) if number.abs() >= 1e9 => {
            write!(f, " ({number:e} in {curve} stands for no value)")
        }
        Some(Sentinel { number, curve }) => write!(f, " ({number} in {curve} stands for no value)"),
        None => Ok(()),
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gaps { cells, lines, sentinel } => gaps(f, *cells, lines, sentinel.as_ref()),
            Self::SkippedColumns(wavelength_column) => {
                write!(f, "Wavelengths stand in column {wavelength_column}: the columns before it are left out")
            }
            Self::Sorted(line) => write!(f, "line {line}: wavelengths out of order: sorted"),
            Self::RepeatedRows(lines) => write!(f, "{lines}: the same as an earlier row: counted once"),
            Self::AveragedRows(lines) => {
                write!(f, "{lines}: several rows with different values at one wavelength: their mean is taken")
            }
            Self::ShortLines(lines) => {
                write!(
                    f,
                    "{lines}: fewer values than places before the next line: left out. Which is missing is not known"
                )
            }
            Self::NoWavelength(lines) => write!(f, "{lines}: no wavelength: left out"),
            Self::NumbersAbove(line) => write!(f, "line {line}: numbers above the table: left out"),
            Self::TextBelow(line) => write!(f, "line {line}: text after the table: left out"),
            Self::CommentedRows(lines) => {
                write!(f, "{lines}: rows that begin with # in the table: left out as comments")
            }
            Self::RepeatedHeader(lines) => write!(f, "{lines}: the names of the columns again: left out"),
            Self::MaybeThousands => {
                f.write_str("Every fraction has three digits: if the marks group thousands, the values are wrong")
            }
            Self::Invisible => f.write_str("There is nothing between 380 and 780 nm, the light that is seen"),
            Self::Hole { from_nm, to_nm, lines } => {
                if let Some([a, b]) = lines {
                    write!(f, "lines {a} and {b}: ")?;
                }
                write!(f, "nothing between {from_nm} and {to_nm} nm, far more than the other steps")
            }
            Self::GroupedThousands(fractions) => {
                let mark = if *fractions == DecimalMark::Comma { "1,000" } else { "1.000" };
                write!(f, "Numbers such as {mark} are read as thousands: if they have fractions, choose {fractions}")
            }
            Self::CommasOnly => {
                f.write_str("No number has a decimal point: if the commas mark fractions, choose decimal commas")
            }
            Self::BrokenTable { line, error } => {
                write!(f, "line {line}: another table that cannot be read: left out ({error})")
            }
            Self::MoreGroups { count: 2, second } => write!(f, "“{second}”, another group of spectra: left out"),
            Self::MoreGroups { count, second } => {
                write!(f, "“{second}” and {} more groups of spectra: left out", count - 2)
            }
            Self::MaybeWavelengths => {
                f.write_str("Nothing names the unit of wave numbers: if they are wavelengths, choose nanometers")
            }
            Self::OtherQuantity { quantity, role } => write!(f, "The numbers look like {quantity}, not like {role}"),
            Self::MoreTables(line) => write!(f, "line {line}: another table with spectra: left out"),
            Self::PlacedByAbscissa(lines) => {
                write!(f, "{lines}: not where the line before ends: placed by the wavelength at the head of the line")
            }
            Self::HeaderDiffers { line, label, announced, found } => {
                write!(f, "line {line}: {label} announces {announced}, but the data give {found}")
            }
            Self::CountDiffers { line, expected, found } => {
                write!(f, "line {line} announces {expected} values, but there are {found}")
            }
            Self::More(1) => f.write_str("1 more warning like these"),
            Self::More(count) => write!(f, "{count} more warnings like these"),
            Self::SmallPercent(max) => {
                write!(
                    f,
                    "The file says percent, but no value exceeds {max}: if they are fractions, choose plain numbers"
                )
            }
            Self::OtherAxes { .. } | Self::MoreQuantities { .. } | Self::BadWavelengths { .. } => self.of_layout(f),
            Self::EmptyCurves { .. }
            | Self::NotSpectra { .. }
            | Self::ScalesDiffer { .. }
            | Self::TextColumns { .. }
            | Self::Averaged { .. }
            | Self::BelowZero { .. }
            | Self::NotReflectances { .. } => self.of_curves(f),
        }
    }
}
