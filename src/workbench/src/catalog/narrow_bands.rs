//! Tables of narrow bands: raw means lit and dark, exposure and power.
//!
//! ```text
//! wavelength_nm,power,exposure_s,red,green,blue,dark_red,dark_green,dark_blue[,width_nm]
//! ```
//! One row per band, in ascending order. Lines that begin with `#` are comments.

use chromascope_core::recovery::{Band, Pass};

use super::names::folded;
use super::recorded::{cells, delimiter, number};

const HEADS: [&str; 9] =
    ["wavelength_nm", "power", "exposure_s", "red", "green", "blue", "dark_red", "dark_green", "dark_blue"];
const WIDTH: &str = "width_nm";

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BandTableError {
    #[error("no rows; expected the columns {}", HEADS.join(", "))]
    Empty,
    #[error("no column {head}; expected {}, and {WIDTH} where it is known", HEADS.join(", "))]
    Head { head: &'static str },
    #[error("line {line}, column {head}: not a number")]
    Number { line: usize, head: &'static str },
}

/// True for a table with these columns.
pub fn is_pass(bytes: &[u8]) -> bool {
    let beginning = read_pass(&bytes[..bytes.len().min(1 << 16)]);
    !matches!(beginning, Err(BandTableError::Empty | BandTableError::Head { .. }))
}

pub fn read_pass(bytes: &[u8]) -> Result<Pass, BandTableError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut rows = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (_, head) = rows.next().ok_or(BandTableError::Empty)?;
    let delimiter = delimiter(head);
    let heads: Vec<String> = cells(head, delimiter).iter().map(|head| folded(head)).collect();
    let place = |head: &'static str| heads.iter().position(|own| *own == folded(head));
    let places: Vec<usize> =
        HEADS.into_iter().map(|head| place(head).ok_or(BandTableError::Head { head })).collect::<Result<_, _>>()?;
    let band = |(line, row): (usize, &str)| {
        let cells = cells(row, delimiter);
        let at = |place: usize, head| {
            let value = cells.get(place).and_then(|cell| number(cell, delimiter)).filter(|value| !value.is_nan());
            value.ok_or(BandTableError::Number { line: line + 1, head })
        };
        let value = |column: usize| at(places[column], HEADS[column]);
        Ok(Band {
            wavelength_nm: value(0)?,
            width_nm: place(WIDTH).map(|place| at(place, WIDTH)).transpose()?,
            power: value(1)?,
            exposure: value(2)?,
            lit: [value(3)?, value(4)?, value(5)?],
            dark: [value(6)?, value(7)?, value(8)?],
        })
    };
    let pass: Pass = rows.map(band).collect::<Result<_, _>>()?;
    if pass.is_empty() { Err(BandTableError::Empty) } else { Ok(pass) }
}
