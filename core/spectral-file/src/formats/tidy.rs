//! Tidy (long) tables: a row for each sample and wavelength, with columns that name the sample, in any order of the rows.

use std::collections::{BTreeMap, BTreeSet};

use crate::decision::{Decided, DecimalMark, Delimiter, Orientation, Reader};
use crate::dialect::{Cell, Dialect};
use crate::dialect_trial::Layout;
use crate::error::{MAX_CURVES, ReadError, check_samples};
use crate::formats::spectra::{self, Found, Sample, Spectrum};
use crate::formats::{Format, table};
use crate::no_curve::FEWEST_ROWS;
use crate::options::ReadOptions;
use crate::text::{Lines, Section, comment, excerpt, has_word, listed, lower};
use crate::uncertainty_terms::{self, Term};
use crate::units::plausible;
use crate::warning::{LineList, Warning};
use crate::watch::{Log, PlaceId, PlaceKind};
use crate::{decimal, header, header_terms};

impl Reader {
    /// A row for each sample and wavelength.
    pub const TIDY: Self = Self::new("tidy", "tidy table, a row for each sample and wavelength", "Tidy table");
}

pub(super) const FORMAT: Format =
    Format { reader: Reader::TIDY, fits: |head| head.is_plain() && Plan::new(head.text).is_some(), read };

/// Most columns, lines above the names, rows and bytes of a line that are looked at.
const MOST_COLUMNS: usize = 24;
const MOST_ABOVE: usize = 12;
const LOOK: usize = 8;
const LONGEST: usize = 1000;

const DELIMITERS: [Delimiter; 5] =
    [Delimiter::Tab, Delimiter::Semicolon, Delimiter::Bar, Delimiter::Comma, Delimiter::Spaces];

/// Names of columns of numbers that tell samples apart.
const KEYS: &str = "sample|samples|specimen|individual|replicate|rep|species|id|sampleid|plot|plant|leaf|patch|spot|scan|spectrum|\
    group|treatment|idx|measurement|filter|lamp|subject|tree|flower|curve|series|variable|name";

/// Names of those that do where there are no others.
const ANGLES: &str = "degree|degrees|angle|theta|phi";

/// Layout of such a table, as its first lines suggest it.
struct Plan {
    dialect: Dialect,
    first_line: usize,
    /// Names of the columns; empty texts where there are none.
    names: Vec<String>,
    axis: usize,
    /// Columns that may name samples; the others are numbers.
    keys: Vec<usize>,
}

fn content(text: &str) -> impl Iterator<Item = (usize, &str)> {
    Lines::new(text).filter(|(_, line)| !line.trim_ascii().is_empty() && comment(line).is_none())
}

impl Plan {
    fn new(text: &str) -> Option<Self> {
        let lines: Vec<(usize, &str)> = content(text).take(MOST_ABOVE + LOOK).collect();
        if lines.first().is_none_or(|(_, line)| line.len() > LONGEST) {
            return None;
        }
        let above = lines.iter().take(MOST_ABOVE).enumerate();
        let names = || {
            above.filter(|(_, (_, line))| line.len() <= LONGEST).find_map(|(at, (_, line))| Some((at, named(line)?)))
        };
        Self::bare(&lines).or_else(|| {
            let (at, (dialect, names, axis)) = names()?;
            Self::below(dialect, names, axis, &lines[at + 1..])
        })
    }

    /// The plan of the rows below a line of names.
    fn below(dialect: Dialect, names: Vec<String>, axis: usize, rows: &[(usize, &str)]) -> Option<Self> {
        let rows = &rows[..rows.len().min(LOOK)];
        let comma = Dialect { mark: DecimalMark::Comma, ..dialect };
        let is_comma = |cell: &str| cell.contains(',') && matches!(comma.parse(cell), Cell::Number(_));
        let commas = rows.iter().any(|(_, row)| dialect.cells(row).take(MOST_COLUMNS).any(is_comma));
        let dialect = if commas { comma } else { dialect };
        let (first_line, first) = *rows.first()?;
        // R's names of rows have no head.
        let bare = dialect.cells(first).take(names.len() + 2).count() == names.len() + 1;
        let names = if bare { [vec![String::new()], names].concat() } else { names };
        let axis = axis + usize::from(bare);
        let is_key = |(column, cell): &(usize, &str), named: &str| {
            let text = dialect.parse(cell) == Cell::Text && dialect.parse_united(cell).is_none();
            let name = lower(names.get(*column).map_or("", String::as_str)).replace(['_', '.'], " ");
            *column != axis && (text || has_word(&name, named) && header_terms::quantity(&name).is_none())
        };
        let keys = |named: &str| -> Vec<usize> {
            let cells = dialect.cells(first).take(names.len()).enumerate();
            cells.filter(|cell| is_key(cell, named)).map(|(column, _)| column).collect()
        };
        let keys = Some(keys(KEYS)).filter(|keys| !keys.is_empty()).unwrap_or_else(|| keys(ANGLES));
        // Remarks beside the first rows name no samples.
        let is_filled = |key: &usize, row: &str| dialect.cells(row).nth(*key).is_some_and(|cell| !cell.is_empty());
        let filled = |key: &usize| 2 * rows.iter().filter(|(_, row)| is_filled(key, row)).count() > rows.len();
        let keys: Vec<usize> = keys.into_iter().filter(filled).collect();
        let is_row = |(_, row): &(usize, &str)| {
            let mut cells = dialect.cells(row).take(names.len() + 1).enumerate();
            let sound = |(at, cell): (usize, &str)| keys.contains(&at) || dialect.parse(cell) != Cell::Text;
            dialect.cells(row).take(names.len() + 1).count() == names.len() && cells.all(sound)
        };
        let enough = rows.len() >= FEWEST_ROWS && !keys.is_empty() && keys.len() + 1 < names.len();
        (enough && rows.iter().all(is_row)).then_some(Self { dialect, first_line, names, axis, keys })
    }

    /// The plan of rows `sample, wavelength, value` without names, in which the wavelengths of each sample run one way.
    fn bare(rows: &[(usize, &str)]) -> Option<Self> {
        let (first_line, first) = *rows.first().filter(|_| rows.len() >= LOOK)?;
        let dialects = DELIMITERS.into_iter().map(|delimiter| Dialect::new(delimiter, DecimalMark::Point));
        let dialect = dialects.into_iter().find(|dialect| dialect.cells(first).take(4).count() == 3)?;
        let sample = |(_, row): &(usize, &'_ str)| {
            let [key, nm, value] = dialect.cells(row).take(4).collect::<Vec<_>>().try_into().ok()?;
            let nm = dialect.value(nm).filter(|nm| !nm.is_nan())?;
            (dialect.value(value).is_some() && !key.is_empty()).then(|| (key.to_owned(), nm))
        };
        let rows: Vec<(String, f64)> = rows[..LOOK].iter().map(sample).collect::<Option<_>>()?;
        let pairs = || rows.iter().enumerate().flat_map(|(at, a)| rows[at + 1..].iter().map(move |b| (a, b)));
        let ordered = |sign: f64| pairs().filter(|(a, b)| a.0 == b.0).all(|(a, b)| sign * (b.1 - a.1) > 0.0);
        // Numbers may be anything else, unless each stands there again.
        let named = rows.iter().all(|(key, _)| dialect.parse(key) == Cell::Text);
        let again = |key: &String| rows[LOOK / 2..].iter().any(|(other, _)| other == key);
        let told = named || rows[..LOOK / 2].iter().all(|(key, _)| again(key));
        let (low, high) = decimal::extent(rows.iter().map(|(_, nm)| *nm));
        let sound = told && (ordered(1.0) || ordered(-1.0)) && plausible(low, high, true);
        sound.then(|| Self { dialect, first_line, names: vec![String::new(); 3], axis: 1, keys: vec![0] })
    }

    fn is_named(&self) -> bool {
        self.names.iter().any(|name| !name.is_empty())
    }

    fn suits(&self, options: &ReadOptions) -> bool {
        options.part.is_none()
            && options.raw != Some(true)
            && options.orientation != Some(Orientation::Across)
            && options.wavelength_column.is_none_or(|column| column == self.axis + 1)
            && options.delimiter.is_none_or(|delimiter| delimiter == self.dialect.delimiter)
            && options.decimal_mark.is_none_or(|mark| mark == self.dialect.mark)
    }
}

/// The names of columns in a line, if one of them names wavelengths.
fn named(line: &str) -> Option<(Dialect, Vec<String>, usize)> {
    let dialects = DELIMITERS.into_iter().map(|delimiter| Dialect::new(delimiter, DecimalMark::Point));
    let several = |dialect: &Dialect| (3..=MOST_COLUMNS).contains(&dialect.cells(line).take(MOST_COLUMNS + 1).count());
    let dialect = dialects.into_iter().find(several)?;
    let names = header::split(dialect, line);
    let texts = names.iter().all(|name| dialect.parse(name) == Cell::Text || name.is_empty());
    let axis = header_terms::axis(&names).filter(|_| texts)?;
    Some((dialect, names, axis))
}

fn read(text: &str, options: &ReadOptions, log: &mut Log<'_>) -> Result<Found, ReadError> {
    if let Some(plan) = Plan::new(text).filter(|plan| plan.suits(options))
        && let Some(rows) = Rows::read(&plan, text, log)?
        && let Some(found) = plan.found(&rows, text, log)?
    {
        return Ok(found);
    }
    // What is torn or ambiguous is left to the general reader, which says where.
    (table::FORMAT.read)(text, options, log)
}

impl Plan {
    fn found(&self, rows: &Rows<'_>, text: &str, log: &mut Log<'_>) -> Result<Option<Found>, ReadError> {
        let Some(keys) = rows.keys(&self.keys) else { return Ok(None) };
        let groups = rows.groups(&keys);
        let count = groups.iter().max().map_or(0, |last| *last as usize + 1);
        // Wavelengths that go on from one to the next are of one spectrum, whose parts have several sources.
        if count > 1 && rows.wavelengths.is_sorted_by(|a, b| a < b) {
            return Ok(None);
        }
        let is_value = |column: &usize| {
            let name = &self.names[*column];
            let beside =
                header_terms::names_time(name) || header_terms::names_axis(name) || header_terms::is_count(name);
            let nameless = name.is_empty() && self.is_named();
            !(beside || nameless) && (rows.varies(&groups, *column) || self.term(*column).is_some())
        };
        let numbers = (0..self.names.len()).filter(|column| *column != self.axis && !self.keys.contains(column));
        let (taken, left): (Vec<usize>, Vec<usize>) = numbers.partition(is_value);
        // With a number beside texts before its wavelengths a table of one sample is none of columns.
        let is_number = |key: &usize| matches!(self.dialect.parse(rows.text(*key, 0)), Cell::Number(_));
        let few = self.keys.len() < 2 || !self.keys.iter().any(is_number);
        // The general reader takes texts only beside wavelengths in order.
        let single = self.is_named() && count < 2 && few && rows.repeats(&keys) == 0;
        if single || taken.is_empty() || rows.lines.len() < FEWEST_ROWS * count || count > MAX_CURVES {
            return Ok(None);
        }
        check_samples(rows.lines.len() * taken.len(), self.first_line)?;
        let why = "Each row has a sample, a wavelength and values";
        let dialect = (self.dialect.delimiter, self.dialect.mark);
        let layout = Layout::fixed(dialect, Orientation::Down, self.first_line, why);
        let layout = Layout { width: self.names.len(), ..layout };
        let header = header::read(Section::whole(text), &layout);
        let units: Vec<Option<String>> = taken.iter().map(|&column| header.unit(column)).collect();
        let mut spectra: Vec<Spectrum> = Vec::new();
        spectra.resize_with(count * taken.len(), Spectrum::default);
        let (mut gaps, mut lines) = (0, LineList::default());
        let own = self.own_names(&taken);
        for (row, &group) in groups.iter().enumerate() {
            for (index, &column) in taken.iter().enumerate() {
                let spectrum = &mut spectra[group as usize * taken.len() + index];
                if spectrum.name.is_none() {
                    let texts = keys.iter().map(|key| rows.text(*key, row));
                    let texts = texts.chain([own[index].as_str()]);
                    spectrum.name = Some(texts.filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" "));
                    spectrum.label = header.label(column);
                }
                let (value, place) = rows.numbers[column][row];
                let (wavelength, line) = (rows.wavelengths[row], rows.lines[row]);
                if value.is_nan() {
                    gaps += 1;
                    lines.add(line);
                } else {
                    spectrum.samples.push(Sample { wavelength, value, line, place });
                }
            }
        }
        for (cells, lines) in [(rows.empty.count(), rows.empty.clone()), (gaps, lines)] {
            if cells > 0 {
                log.push(Warning::Gaps { cells, lines, sentinel: None });
            }
        }
        if let Some(first) = left.first() {
            log.push(Warning::NotSpectra { count: left.len(), first: self.description(*first) });
        }
        let mut grid = spectra::grid(spectra, header, log)?;
        for (curve, unit) in grid.curves.iter_mut().zip(units.iter().cycle()) {
            curve.unit.clone_from(unit);
        }
        (grid.rows, grid.wavelength_column) = (rows.lines.len(), Some(self.axis + 1));
        let told = listed(&keys.iter().map(|key| self.description(*key)).collect::<Vec<_>>());
        let decide = if self.is_named() { Decided::certain } else { Decided::guess };
        let reader = decide(Reader::TIDY, format!("{count} samples are told apart by {told}"));
        Ok(Some(Found { grid, layout, reader, notes: Vec::new() }))
    }

    fn term(&self, column: usize) -> Option<Term> {
        uncertainty_terms::term(&self.names[column], &self.names[column])
    }

    /// What the columns of values add to the names of the samples: nothing where there is one, and its `R_sd` is ` sd` then.
    fn own_names(&self, taken: &[usize]) -> Vec<String> {
        let mut values = taken.iter().filter(|column| self.term(**column).is_none());
        let only = values.next().filter(|_| values.next().is_none()).map(|only| self.names[*only].as_str());
        let own = |&column: &usize| match (only, self.term(column)) {
            (Some(_), None) => String::new(),
            (Some(only), Some(term)) if term.of == uncertainty_terms::key(only) => {
                self.names[column].replacen(only, "", 1)
            }
            _ => self.names[column].clone(),
        };
        taken.iter().map(own).collect()
    }

    fn description(&self, column: usize) -> String {
        match self.names[column].as_str() {
            "" => format!("column {}", column + 1),
            name => format!("“{}” (column {})", excerpt(name), column + 1),
        }
    }
}

/// Cells of all rows, by column: numbers with their places, and texts by their number among those of the column.
struct Rows<'a> {
    lines: Vec<usize>,
    /// Rows without any number, which are left out.
    empty: LineList,
    wavelengths: Vec<f64>,
    numbers: Vec<Vec<(f64, PlaceId)>>,
    cells: Vec<Vec<u32>>,
    texts: Vec<Vec<&'a str>>,
}

impl<'a> Rows<'a> {
    /// All rows; `None` if one of them does not fit.
    fn read(plan: &Plan, text: &'a str, log: &mut Log<'_>) -> Result<Option<Self>, ReadError> {
        let width = plan.names.len();
        let mut known: Vec<BTreeMap<&str, u32>> = vec![BTreeMap::new(); width];
        let (numbers, cells, texts) = (vec![Vec::new(); width], vec![Vec::new(); width], vec![Vec::new(); width]);
        let (lines, wavelengths, empty) = (Vec::new(), Vec::new(), LineList::default());
        let mut rows = Self { lines, empty, wavelengths, numbers, cells, texts };
        for (number, line) in content(text).skip_while(|(number, _)| *number < plan.first_line) {
            log.at(line.as_ptr() as usize - text.as_ptr() as usize)?;
            let is_gap = |cell: &str| plan.dialect.parse(cell) == Cell::Gap;
            let mut others = plan.dialect.cells(line).enumerate().filter(|(column, _)| !plan.keys.contains(column));
            if plan.dialect.cells(line).nth(plan.axis).is_some_and(is_gap) && others.all(|(_, cell)| is_gap(cell)) {
                rows.empty.add(number);
                continue;
            }
            let mut count = 0;
            for (column, cell) in plan.dialect.cells(line).enumerate() {
                count = column + 1;
                if column >= width && !cell.is_empty() {
                    return Ok(None);
                } else if column >= width {
                    continue;
                } else if plan.keys.contains(&column) {
                    let next = rows.texts[column].len() as u32;
                    let id = *known[column].entry(cell).or_insert(next);
                    rows.texts[column].extend((id == next).then_some(cell));
                    rows.cells[column].push(id);
                    continue;
                }
                match plan.dialect.value(cell) {
                    Some(value) if column == plan.axis && !value.is_nan() => {
                        log.places.as_mut().map(|places| places.add(PlaceKind::Wavelength, cell));
                        rows.wavelengths.push(value);
                    }
                    Some(value) if column != plan.axis => {
                        let place = log.places.as_mut().map(|places| places.add(PlaceKind::Value, cell));
                        rows.numbers[column].push((value, place.unwrap_or_default()));
                    }
                    _ => return Ok(None),
                }
            }
            if count < width {
                return Ok(None);
            }
            rows.lines.push(number);
        }
        Ok(Some(rows))
    }

    fn text(&self, key: usize, row: usize) -> &'a str {
        self.texts[key][self.cells[key][row] as usize]
    }

    /// The columns whose cells together tell the samples apart: those that vary, without those that follow the wavelength or are of
    /// one row each. `None` if more than a few rows of one sample have the same wavelength.
    fn keys(&self, columns: &[usize]) -> Option<Vec<usize>> {
        const ROWS_PER_REPEAT: usize = 20;
        let mut keys: Vec<usize> = columns.iter().copied().filter(|&key| self.texts[key].len() > 1).collect();
        let repeats = self.repeats(&keys);
        for key in keys.clone() {
            let rest: Vec<usize> = keys.iter().copied().filter(|other| *other != key).collect();
            let lone = self.texts[key].len() * 2 > self.lines.len();
            if !rest.is_empty() && (lone || self.follows_wavelength(key)) && self.repeats(&rest) <= repeats {
                keys = rest;
            }
        }
        keys.extend(columns.first().filter(|_| keys.is_empty()));
        (self.repeats(&keys) * ROWS_PER_REPEAT <= self.lines.len()).then_some(keys)
    }

    fn follows_wavelength(&self, key: usize) -> bool {
        let mut seen = BTreeMap::new();
        let mut cells = self.wavelengths.iter().zip(&self.cells[key]);
        cells.all(|(nm, cell)| *seen.entry(nm.to_bits()).or_insert(*cell) == *cell)
    }

    /// The sample of each row, in the order of their first rows.
    fn groups(&self, keys: &[usize]) -> Vec<u32> {
        let mut groups = vec![0; self.lines.len()];
        for &key in keys {
            let mut known = BTreeMap::new();
            for (group, cell) in groups.iter_mut().zip(&self.cells[key]) {
                let next = known.len() as u32;
                *group = *known.entry((*group, *cell)).or_insert(next);
            }
        }
        groups
    }

    /// Rows of a sample with the wavelength of an earlier one.
    fn repeats(&self, keys: &[usize]) -> usize {
        let mut seen = BTreeSet::new();
        self.groups(keys)
            .iter()
            .zip(&self.wavelengths)
            .filter(|(group, nm)| !seen.insert((**group, nm.to_bits())))
            .count()
    }

    /// Returns whether a number differs in the rows of some sample.
    fn varies(&self, groups: &[u32], column: usize) -> bool {
        let mut first = BTreeMap::new();
        let mut values = groups.iter().zip(&self.numbers[column]);
        values.any(|(group, (value, _))| *first.entry(*group).or_insert(value.to_bits()) != value.to_bits())
    }
}
