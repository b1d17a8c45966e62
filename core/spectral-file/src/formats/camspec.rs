//! A database of cameras: a line with the name of each, then a line of 33 values for red, green and blue, without wavelengths
//! (J. Jiang et al. 2013: 400 to 720 nm by 10). Compared with the database itself.

use crate::decision::{Decided, DecimalMark, Decision, Delimiter, Orientation, Reader, Role, WavelengthUnit};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::Layout;
use crate::error::{ReadError, check_curves};
use crate::formats::Format;
use crate::formats::spectra::Found;
use crate::grid::{Grid, RawCurve};
use crate::header::Header;
use crate::options::ReadOptions;
use crate::text::Lines;
use crate::watch::{Log, PlaceKind};

impl Reader {
    /// Cameras by name, each with three lines of 33 values.
    pub const CAMSPEC: Self = Self::new("camspec", "database of cameras", "Camera database");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::CAMSPEC, fits: |head| head.is_plain() && recognize(head.text), read };

/// Values in a line, one every 10 nm from 400 nm.
const BANDS: usize = 33;

const CHANNELS: [&str; 3] = ["R", "G", "B"];

fn recognize(text: &str) -> bool {
    const LONGEST_NAME: usize = 100;
    let mut lines = Lines::new(text).map(|(_, line)| line).filter(|line| !line.trim().is_empty());
    let is_name = |line: &str| line.len() <= LONGEST_NAME && line.contains(char::is_alphabetic);
    lines.next().is_some_and(is_name) && (0..CHANNELS.len()).all(|_| lines.next().and_then(values).is_some())
}

fn values(line: &str) -> Option<Vec<f64>> {
    let dialect = Dialect::new(Delimiter::Spaces, DecimalMark::Point);
    let number = |cell| match dialect.parse(cell) {
        Cell::Number(value) => Some(value),
        Cell::Gap | Cell::Text => None,
    };
    let all: Vec<f64> = dialect.cells(line).take(BANDS + 1).map(number).collect::<Option<_>>()?;
    (all.len() == BANDS).then_some(all)
}

fn wavelength(band: usize) -> f64 {
    400.0 + 10.0 * band as f64
}

fn record(line: &str, origin: usize, log: &mut Log<'_>) {
    let Some(places) = &mut log.places else { return };
    for (band, cell) in line.split_ascii_whitespace().enumerate() {
        let place = places.add(PlaceKind::Value, cell);
        places.assign(place, origin, wavelength(band));
    }
}

fn read(text: &str, _: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    let mut lines = Lines::new(text).filter(|(_, line)| !line.trim().is_empty()).peekable();
    let first_line = lines.peek().map_or(1, |(line, _)| line + 1);
    let mut cameras: Vec<(String, [Vec<f64>; 3])> = Vec::new();
    while let Some((_, name)) = lines.next() {
        log.at(name.as_ptr() as usize - text.as_ptr() as usize)?;
        let mut origin = CHANNELS.len() * cameras.len();
        let mut channel = || {
            let (line, text) = lines.next().unwrap_or_default();
            record(text, origin, log);
            origin += 1;
            let found = text.split_ascii_whitespace().count();
            values(text).ok_or(ReadError::UnevenRow { line: line.max(1), found, expected: BANDS })
        };
        cameras.push((name.trim().to_owned(), [channel()?, channel()?, channel()?]));
        check_curves(cameras.len() * CHANNELS.len(), first_line)?;
    }
    let mut header = Header::default();
    if let [(only, _)] = cameras.as_slice() {
        header.note(0, "title", only);
    }
    let (alone, rows) = (cameras.len() == 1, cameras.len() * CHANNELS.len());
    let curves = cameras.into_iter().flat_map(|(camera, channels)| {
        channels.into_iter().zip(CHANNELS).map(move |(values, channel)| {
            let name = if alone { channel.to_owned() } else { format!("{camera} {channel}") };
            RawCurve { name, named: true, values, ..RawCurve::default() }
        })
    });
    let curves = curves.enumerate().map(|(origin, curve)| RawCurve { origin, ..curve });
    let why = "Three lines of 33 values under each name";
    let grid = Grid {
        wavelengths: (0..BANDS).map(wavelength).collect(),
        lines: vec![first_line],
        curves: curves.collect(),
        header,
        unit: Some(Decided::guess(WavelengthUnit::Nanometer, why)),
        role: Some(Decided::certain(Role::Camera, why)),
        rows,
        ..Grid::default()
    };
    let notes = vec![Decision::new("Grid", &Decided::guess("400 to 720 nm in steps of 10".to_owned(), why))];
    let layout = Layout::fixed((Delimiter::Spaces, DecimalMark::Point), Orientation::Across, first_line, why);
    Ok(Found { grid, layout, reader: Decided::guess(Reader::CAMSPEC, why), notes })
}
