//! Tables of narrow bands: raw means lit and dark, or the pictures that these are taken from, with exposure and power.
//!
//! ```text
//! wavelength_nm,power,exposure_s,red,green,blue,dark_red,dark_green,dark_blue[,width_nm]
//! wavelength_nm,power,exposure_s,picture,dark_picture[,width_nm]
//! ```
//! One row per band, in ascending order. Lines that begin with `#` are comments; `# region: LEFT,TOP,WIDTH,HEIGHT` is the part of the
//! pictures that counts, in pixels. Pictures are named as seen from the table's folder.

use std::collections::HashMap;
use std::path::Path;

use chromascope_core::recovery::{Band, Pass};

use super::chart_picture::ChartPicture;
use super::names::folded;
use super::recorded::{cells, delimiter, number};
use crate::document::measurement::BandPictures;
use crate::format::io_reason;

const CONDITIONS: [&str; 3] = ["wavelength_nm", "power", "exposure_s"];
const MEANS: [&str; 6] = ["red", "green", "blue", "dark_red", "dark_green", "dark_blue"];
const PICTURES: [&str; 2] = ["picture", "dark_picture"];
const WIDTH: &str = "width_nm";

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BandTableError {
    #[error("no rows; expected the columns {}, {}", CONDITIONS.join(", "), MEANS.join(", "))]
    Empty,
    #[error(
        "no column {head}; expected {}, and {} or {}, and {WIDTH} where it is known",
        CONDITIONS.join(", "), MEANS.join(", "), PICTURES.join(", ")
    )]
    Head { head: &'static str },
    #[error("line {line}, column {head}: not a number")]
    Number { line: usize, head: &'static str },
    #[error("line {line}: expected # region: LEFT,TOP,WIDTH,HEIGHT in pixels")]
    Region { line: usize },
    #[error("line {line}, {file}: {why}")]
    Picture { line: usize, file: String, why: String },
    #[error("pictures are found from the folder of the table: save it and open it as a file")]
    NoFolder,
    #[error("canceled")]
    Canceled,
}

/// Where the bands of a row are recorded.
enum Source {
    Means([usize; 6]),
    Pictures([usize; 2]),
}

struct Columns {
    delimiter: char,
    conditions: [usize; 3],
    width: Option<usize>,
    source: Source,
}

impl Columns {
    fn new(head: &str) -> Result<Self, BandTableError> {
        let delimiter = delimiter(head);
        let heads: Vec<String> = cells(head, delimiter).iter().map(|head| folded(head)).collect();
        let found = |head: &str| heads.iter().position(|own| *own == folded(head));
        let place = |head: &'static str| found(head).ok_or(BandTableError::Head { head });
        let mut conditions = [0; 3];
        for (at, head) in conditions.iter_mut().zip(CONDITIONS) {
            *at = place(head)?;
        }
        let source = if let [Some(lit), Some(dark)] = PICTURES.map(found) {
            Source::Pictures([lit, dark])
        } else {
            let mut means = [0; 6];
            for (at, head) in means.iter_mut().zip(MEANS) {
                *at = place(head)?;
            }
            Source::Means(means)
        };
        Ok(Self { delimiter, conditions, width: found(WIDTH), source })
    }
}

/// A pass, and of which part of which pictures its means are.
pub type ReadPass = (Pass, Option<BandPictures>);

fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate().map(|(index, line)| (index + 1, line));
    lines.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
}

/// True for a table with these columns.
pub fn is_pass(bytes: &[u8]) -> bool {
    let beginning = String::from_utf8_lossy(&bytes[..bytes.len().min(1 << 16)]);
    rows(&beginning).next().is_some_and(|(_, head)| Columns::new(head).is_ok())
}

/// Reads a table, and its pictures from a folder: of these the named region, else that which the table states, else the middle quarter of
/// their width and height. Ends early where `go_on` says no.
pub fn read_pass(
    bytes: &[u8],
    folder: Option<&Path>,
    named: Option<[usize; 4]>,
    go_on: &dyn Fn() -> bool,
) -> Result<ReadPass, BandTableError> {
    let text = String::from_utf8_lossy(bytes);
    let mut rows = rows(&text);
    let (_, head) = rows.next().ok_or(BandTableError::Empty)?;
    let columns = Columns::new(head)?;
    let region = named.map_or_else(|| stated_region(&text), |region| Ok(Some(region)))?;
    let mut pictures = Pictures { folder, region, clip: f64::INFINITY, size: None, known: HashMap::new() };
    let mut pass = Pass::new();
    for (line, row) in rows {
        if !go_on() {
            return Err(BandTableError::Canceled);
        }
        let cells = cells(row, columns.delimiter);
        let cell = |place: usize| cells.get(place).map(String::as_str).unwrap_or_default();
        let at = |place: usize, head| {
            let value = number(cell(place), columns.delimiter).filter(|value| !value.is_nan());
            value.ok_or(BandTableError::Number { line, head })
        };
        let known = |column: usize| at(columns.conditions[column], CONDITIONS[column]);
        let [wavelength_nm, power, exposure] = [known(0)?, known(1)?, known(2)?];
        let width_nm = columns.width.map(|place| at(place, WIDTH)).transpose()?;
        let [lit, dark] = match &columns.source {
            Source::Means(places) => {
                let mean = |column: usize| at(places[column], MEANS[column]);
                [[mean(0)?, mean(1)?, mean(2)?], [mean(3)?, mean(4)?, mean(5)?]]
            }
            Source::Pictures(places) => {
                let mut means = |file: &str| {
                    let failed = |why| BandTableError::Picture { line, file: file.to_owned(), why };
                    pictures.means(file).map_err(|why| why.map_or(BandTableError::NoFolder, failed))
                };
                [means(cell(places[0]))?, means(cell(places[1]))?]
            }
        };
        pass.push(Band { wavelength_nm, width_nm, power, exposure, lit, dark });
    }
    let clip = pictures.clip;
    let taken = pictures.region.filter(|_| pictures.size.is_some()).map(|region| BandPictures { region, clip });
    if pass.is_empty() { Err(BandTableError::Empty) } else { Ok((pass, taken)) }
}

/// Left, top, width and height as `LEFT,TOP,WIDTH,HEIGHT`.
pub fn parse_region(text: &str) -> Option<[usize; 4]> {
    let sides: Vec<usize> = text.split(',').map(|side| side.trim().parse().ok()).collect::<Option<_>>()?;
    sides.try_into().ok()
}

fn stated_region(text: &str) -> Result<Option<[usize; 4]>, BandTableError> {
    let mut lines = text.lines().enumerate();
    let stated = |(index, line): (usize, &'_ str)| {
        let words = line.trim_start_matches('\u{feff}').strip_prefix('#')?.trim_start().strip_prefix("region:")?;
        Some(parse_region(words).ok_or(BandTableError::Region { line: index + 1 }))
    };
    lines.find_map(stated).transpose()
}

/// Pictures of one pass.
struct Pictures<'a> {
    folder: Option<&'a Path>,
    region: Option<[usize; 4]>,
    /// The least value from which on pixels are clipped.
    clip: f64,
    size: Option<[usize; 2]>,
    /// Means by the pictures' names: a dark picture may serve many bands.
    known: HashMap<String, [f64; 3]>,
}

impl Pictures<'_> {
    /// Means of the region; the reason where there are none, nothing without a folder.
    fn means(&mut self, file: &str) -> Result<[f64; 3], Option<String>> {
        if let Some(known) = self.known.get(file) {
            return Ok(*known);
        }
        let path = self.folder.ok_or(None)?.join(file);
        let bytes = std::fs::read(&path).map_err(|error| io_reason(&error))?;
        let picture = ChartPicture::read(&path, &bytes).map_err(|error| error.to_string())?;
        let [width, height] = *self.size.get_or_insert_with(|| picture.size());
        if picture.size() != [width, height] {
            let [across, down] = picture.size();
            return Err(Some(format!("{across} x {down} pixels; the pictures before have {width} x {height}")));
        }
        let middle = [3 * width / 8, 3 * height / 8, width / 4, height / 4];
        let means = picture.region(*self.region.get_or_insert(middle)).map_err(|error| error.to_string())?;
        if let Some(channel) = means.mean.iter().position(|mean| !mean.is_finite()) {
            return Err(Some(format!("no pixels of channel {} in the region", channel + 1)));
        }
        let clip = picture.clip(f64::INFINITY);
        self.clip = self.clip.min(clip);
        let value = |c: usize| if means.clipped[c] { means.mean[c].max(clip) } else { means.mean[c] };
        let means = [0, 1, 2].map(value);
        self.known.insert(file.to_owned(), means);
        Ok(means)
    }
}
