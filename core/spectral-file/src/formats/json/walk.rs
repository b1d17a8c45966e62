//! Any document of wavelengths and values: lists side by side, records, rows, and objects whose keys are wavelengths, at any depth,
//! with the names, quantities and units that stand in and around them.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::rc::Rc;

use crate::decimal::{clean, extent};
use crate::decision::{Decision, WavelengthUnit};
use crate::error::{MAX_SAMPLES, ReadError, check_curves, check_samples};
use crate::formats::json::Document;
use crate::formats::json::document::{Members, Value};
use crate::formats::spectra::{Sample, Spectrum};
use crate::header::Header;
use crate::header_terms::{self, XUnit};
use crate::text::{has_word, is_one, listed, spaced};
use crate::watch::{Log, PlaceKind};
use crate::{uncertainty_terms, units};

/// Keys of names, the most telling first.
const NAMES: &str = "title|name|spd name|spectrum name|sample name|sample|label|camera name|camera|model|sample id|band id|id|\
    channel|material|state";
const QUANTITIES: &str = "measurement type|quantity|measurement|spectrum type|data type|type|kind|mode|y label";
const UNITS: &str = "unit|units|y unit|y units|value unit|values unit|scale";
/// Keys of objects whose texts are about the object around.
const ABOUT: &str = "metadata|meta|header|info|attributes|properties|units|batch metadata";
/// Keys that name values and nothing else.
const VALUES: &str = "|values|value|data|spectrum|spectra|spectral data|spd|spds|sd|samples|measurements|measurement|curve|curves|\
    entries|y|val|amplitude|response|results|items|power";
/// Keys of wavelengths that are no words for them elsewhere.
const AXES: &str = "wvl|wvls|wls|nm|grid nm|nm grid|wavelength grid|bands|ssf bands";
/// Words for the ends of a range.
const ENDS: &str = "domain|span|range|extent|limits";
/// Keys of spectra that are conditions of the measurement.
const BESIDE: &str = "color science|colour science|white reference|provenance|calibration";

/// The fewest numbers that look like wavelengths where no word says that they are: settings hold some too.
const FEWEST_GUESSED: usize = 10;

/// What stands around a value.
#[derive(Clone, Default)]
pub(super) struct Around<'a> {
    /// Wavelengths, and how they are written where they are.
    pub(super) wavelengths: Rc<[Wavelength<'a>]>,
    pub(super) name: String,
    pub(super) quantity: String,
    pub(super) unit: String,
    /// Names of columns, where rows do not repeat them.
    pub(super) columns: Rc<[String]>,
    /// True if what is said here is about all spectra of the document.
    pub(super) alone: bool,
}

/// A wavelength, and how it is written.
type Wavelength<'a> = (f64, &'a str);

/// A list of numbers with its key, and wavelengths with the lists beside them.
type List<'a> = (Cow<'a, str>, Vec<&'a str>);
type Group<'a> = (Rc<[Wavelength<'a>]>, Vec<List<'a>>);

/// Values at one wavelength, each with the name of its column, which may be empty.
struct Row<'a> {
    /// The name of the sample that it is of.
    sample: String,
    wavelength: Wavelength<'a>,
    cells: Vec<(Cow<'a, str>, &'a str)>,
}

struct Column<'a> {
    sample: String,
    key: Cow<'a, str>,
    at: usize,
    samples: Vec<Sample>,
}

pub(super) struct Walk<'d, 'a, 'l, 'w> {
    document: &'d Document<'a>,
    log: &'l mut Log<'w>,
    pub(super) spectra: Vec<Spectrum>,
    pub(super) header: Header,
    pub(super) notes: Vec<Decision>,
    /// The key of the first wavelengths, and true if it says that they are.
    pub(super) evidence: Option<(String, bool)>,
    /// Members that are in no curve.
    pub(super) left: Vec<String>,
    samples: usize,
    /// A byte of the text and its line.
    cursor: (usize, usize),
}

impl<'d, 'a, 'l, 'w> Walk<'d, 'a, 'l, 'w> {
    pub(super) fn new(document: &'d Document<'a>, log: &'l mut Log<'w>) -> Self {
        let (spectra, notes, left) = Default::default();
        let header = Header::default();
        Self { document, log, spectra, header, notes, evidence: None, left, samples: 0, cursor: (0, 1) }
    }

    /// Takes all spectra in a value.
    pub(super) fn take(&mut self, value: Value<'a>, around: Around<'a>) -> Result<(), ReadError> {
        self.value(value, around, 0)?;
        if !self.left.is_empty() && !self.spectra.is_empty() {
            let why = "They do not go with the wavelengths";
            self.notes.push(Decision::certain("Left out", listed(&self.left), why));
        }
        Ok(())
    }

    fn value(&mut self, value: Value<'a>, around: Around<'a>, depth: usize) -> Result<(), ReadError> {
        const DEEPEST: usize = 16;
        self.log.at(value.offset(value.written))?;
        match value.written.as_bytes().first() {
            _ if depth > DEEPEST => Ok(()),
            Some(b'{') => self.object(value, around, depth),
            // Scalars hold no spectra.
            Some(b'[') if value.written[1..].trim_start().starts_with(['[', '{']) => self.list(value, around, depth),
            _ => Ok(()),
        }
    }

    fn list(&mut self, value: Value<'a>, mut around: Around<'a>, depth: usize) -> Result<(), ReadError> {
        let mut items = value.items()?;
        if items[0].starts_with('[') {
            return self.rows(&items, around);
        }
        if self.records(&items, &around)? {
            return Ok(());
        }
        check_curves(items.len(), 1)?;
        if let Some((at, wavelengths)) = self.entry_of_wavelengths(&items)? {
            items.remove(at);
            around.wavelengths = wavelengths.into();
        }
        if items.len() > 1 {
            (around.alone, around.name) = (false, String::new());
        }
        items.into_iter().try_for_each(|item| self.value(value.with(item), around.clone(), depth + 1))
    }

    /// The entry of a list whose name or type says that its numbers are the wavelengths of the others.
    fn entry_of_wavelengths(&mut self, items: &[&'a str]) -> Result<Option<(usize, Vec<Wavelength<'a>>)>, ReadError> {
        for (at, item) in items.iter().enumerate().filter(|(_, item)| item.starts_with('{')) {
            let members = self.document.whole.with(item).members()?;
            let is_name = |value: Value<'a>| value.read::<String>().is_ok_and(|text| header_terms::names_axis(&text));
            if members.each().any(|(_, value)| value.written.starts_with('"') && is_name(value)) {
                let list = members.each().find(|(_, value)| value.written.starts_with('['));
                let found = list.map(|(key, value)| self.axis(key, value)).transpose()?.flatten();
                return Ok(found.map(|wavelengths| (at, wavelengths)));
            }
        }
        Ok(None)
    }

    fn object(&mut self, value: Value<'a>, mut here: Around<'a>, depth: usize) -> Result<(), ReadError> {
        let members = value.members()?;
        self.hear(&members, &mut here);
        if self.keyed(&members, &here, false)? {
            return Ok(());
        }
        let own = self.own_wavelengths(&members)?;
        let (mut lists, mut others) = (Vec::new(), Vec::new());
        for (key, value) in members.each().filter(|(key, _)| own.as_ref().is_none_or(|(axis, _)| axis != *key)) {
            match numbers(value).filter(|pieces| pieces.len() > 1) {
                Some(pieces) => lists.push((key.clone(), pieces)),
                None if value.written.starts_with(['{', '[']) => others.push((key, value)),
                None => {}
            }
        }
        let mut groups = if own.is_some() { self.marked(&members, &mut lists)? } else { Vec::new() };
        others.retain(|(key, _)| !is_one(&words(key), BESIDE) && !is_one(&words(key), ABOUT));
        let all = own.is_some() && others.is_empty();
        here.wavelengths = own.map_or(here.wavelengths, |(_, wavelengths)| wavelengths.into());
        let only = others.len() == 1 && lists.is_empty();
        groups.insert(0, (here.wavelengths.clone(), lists));
        for (wavelengths, mut lists) in groups {
            if !wavelengths.is_empty() {
                self.leave_out(&lists, wavelengths.len(), all)?;
            }
            lists.retain(|(_, pieces)| pieces.len() == wavelengths.len());
            let row = |(at, wavelength): (usize, &Wavelength<'a>)| {
                let cells = lists.iter().map(|(key, pieces)| (key.clone(), pieces[at])).collect();
                Ok(Row { sample: String::new(), wavelength: *wavelength, cells })
            };
            self.table(wavelengths.iter().enumerate().map(row), &here, true)?;
        }
        // Each is marked where it is first used.
        here.wavelengths = here.wavelengths.iter().map(|(nm, _)| (*nm, "")).collect();
        for (key, value) in others {
            let said = words(key);
            // The only member of one among many that has a name says no more of it.
            let generic = is_one(&said, VALUES) || only && !here.alone && !here.name.is_empty();
            let mut inner = Around { alone: here.alone && only && generic, ..here.clone() };
            if header_terms::role(&said).is_some() && inner.quantity.is_empty() {
                inner.quantity.clone_from(&said);
            }
            if !generic {
                let alone = here.alone || here.name.is_empty();
                inner.name = if alone { key.to_string() } else { format!("{} {key}", here.name) };
            }
            self.value(value, inner, depth + 1)?;
        }
        Ok(())
    }

    /// Removes the wavelengths that are not the first of an object, which are no curve of others, with the lists beside them: `b_offsets`
    /// goes with `b_wavelengths`.
    fn marked(&mut self, members: &Members<'a>, lists: &mut Vec<List<'a>>) -> Result<Vec<Group<'a>>, ReadError> {
        let mut all = Vec::new();
        let axes: Vec<_> = lists.extract_if(.., |(key, _)| header_terms::names_axis(&words(key))).collect();
        for (key, _) in axes {
            let said = words(&key);
            let mark =
                said.split(' ').filter(|word| !header_terms::names_wavelengths(word)).collect::<Vec<_>>().join(" ");
            let goes = |said: &str| said.starts_with(&format!("{mark} ")) || said.ends_with(&format!(" {mark}"));
            let own: Vec<_> = lists.extract_if(.., |(key, _)| !mark.is_empty() && goes(&words(key))).collect();
            match members.get(&key).filter(|_| !own.is_empty()) {
                Some(value) => all.push((self.axis(&key, value)?.unwrap_or_default().into(), own)),
                None => self.left.push(format!("“{key}”")),
            }
        }
        Ok(all)
    }

    /// Refuses lists that seem cut short beside wavelengths, or that are all there is; leaves out others, such as coordinates of colors.
    fn leave_out(&mut self, lists: &[(Cow<'a, str>, Vec<&str>)], expected: usize, all: bool) -> Result<(), ReadError> {
        let none = !lists.iter().any(|(_, pieces)| pieces.len() == expected);
        for (key, pieces) in
            lists.iter().filter(|(key, pieces)| pieces.len() != expected && !has_word(&words(key), ENDS))
        {
            let (name, found) = (key.to_string(), pieces.len());
            if (2 * found > expected && found < 2 * expected) || (none && all) {
                return Err(ReadError::WrongCount { line: self.document.line(&name), name, found, expected });
            }
            self.left.push(format!("“{name}”"));
        }
        Ok(())
    }

    /// Takes the texts of an object, and of those in it that are about it.
    pub(super) fn hear(&mut self, members: &Members<'a>, here: &mut Around<'a>) {
        let mut texts = Vec::new();
        for (key, value) in members.each() {
            let said = words(key);
            if is_one(&said, ABOUT) && value.written.starts_with('{') {
                let inner = value.members();
                let unit = |key: &str| if said == "units" { format!("{key} unit") } else { key.to_owned() };
                let inner = inner.iter().flat_map(Members::each);
                texts.extend(inner.map(|(key, value)| (unit(&words(key)), key.clone(), value)));
            } else if is_one(&said, "columns|index|names|channels|labels|fields") && !value.written.starts_with('{') {
                here.columns =
                    Some(value.texts()).filter(|names| !names.is_empty()).map_or(here.columns.clone(), Rc::from);
            } else {
                texts.push((said, key.clone(), value));
            }
        }
        let mut best = usize::MAX;
        for (said, key, value) in texts {
            let Some(text) = value.written.starts_with('"').then(|| value.read::<String>().ok()).flatten() else {
                continue;
            };
            let is_unit = is_one(&said, UNITS) || said.ends_with(" unit");
            let symbol = WavelengthUnit::from_symbol(&text).map(XUnit::Wavelength).filter(|_| is_unit);
            let prose =
                || header_terms::x_unit_in_prose(&format!("{said} {text}")).filter(|_| said.starts_with(['w', 'x']));
            if let Some(unit) = symbol.or_else(prose) {
                let line = self.line(value);
                self.header.x_unit = self.header.x_unit.or(Some((line, unit)));
                continue;
            }
            if is_unit {
                here.unit = if text.starts_with("fraction") { "1".to_owned() } else { text.clone() };
            } else if is_one(&said, QUANTITIES)
                && (header_terms::role(&text).is_some() || header_terms::values(&text).is_some())
            {
                here.quantity.clone_from(&text);
            } else if let Some(rank) = NAMES.split('|').position(|name| name == said).filter(|rank| *rank < best) {
                (best, here.name) = (rank, text.clone());
            }
            if here.alone {
                let line = self.line(value);
                self.header.take_comment(line, &key, &text);
            }
        }
    }

    /// The wavelengths among the members of an object, with the key of what they are of.
    fn own_wavelengths(&mut self, members: &Members<'a>) -> Result<Option<(String, Vec<Wavelength<'a>>)>, ReadError> {
        let lists = || members.each().filter(|(_, value)| value.written.starts_with(['[', '{']));
        let names: Vec<String> = lists().map(|(key, _)| words(key)).collect();
        let other = || names.iter().position(|name| is_one(name, AXES));
        let named = header_terms::axis(&names).or_else(other).and_then(|at| lists().nth(at));
        let found = named.map(|(key, value)| Ok((key.to_string(), self.axis(key, value)?))).transpose()?;
        if let Some((key, Some(wavelengths))) = found {
            return Ok(Some((key, wavelengths)));
        }
        let range = range_of(members).map(|ends| self.ranged("interval", ends)).transpose()?;
        Ok(range.map(|wavelengths| (String::new(), wavelengths)))
    }

    /// Wavelengths in a list, in a range, or in a member of an object.
    pub(super) fn axis(&mut self, key: &str, value: Value<'a>) -> Result<Option<Vec<Wavelength<'a>>>, ReadError> {
        if let Some(pieces) = numbers(value).filter(|pieces| pieces.len() > 1) {
            let numbers = pieces.iter().enumerate().map(|(at, piece)| Ok((value.number(piece, at)?, *piece)));
            let numbers = numbers.collect::<Result<Vec<_>, ReadError>>()?;
            // Three numbers are the ends of a range and its step, unless the third goes on from the second.
            if let [(first, _), (last, _), (step, _)] = numbers[..]
                && step <= last - first
                && step > 0.0
            {
                return self.ranged(key, [first, last, step]).map(Some);
            }
            self.begin(key, true);
            return Ok(Some(numbers));
        }
        let Some(inner) = value.written.starts_with('{').then(|| value.members()).transpose()? else { return Ok(None) };
        if let Some(ends) = range_of(&inner) {
            return self.ranged(key, ends).map(Some);
        }
        let within = inner.each().find(|(_, value)| value.written.starts_with(['[', '{']));
        within.map_or(Ok(None), |(key, value)| self.axis(key, value))
    }

    fn ranged(&mut self, key: &str, [first, last, step]: [f64; 3]) -> Result<Vec<Wavelength<'a>>, ReadError> {
        let steps = ((last - first) / step).round();
        if !(1.0..=MAX_SAMPLES as f64).contains(&steps) {
            return Err(ReadError::NoWavelengths(self.document.line(key)));
        }
        if self.evidence.is_none() {
            let value = format!("{first} to {last} nm in steps of {step}");
            let why = format!("{}, and three numbers are a range", self.document.says(key));
            self.notes.push(Decision::certain("Grid", value, why));
        }
        self.begin(key, true);
        Ok((0..=steps as usize).map(|i| (clean(first + step * i as f64), "")).collect())
    }

    /// Takes what the key of wavelengths says; whether it says that they are.
    fn begin(&mut self, key: &str, says: bool) {
        if self.evidence.is_none() {
            self.evidence = Some((key.to_owned(), says));
            let unit = header_terms::x_unit(&words(key)).map(|unit| (self.document.line(key), unit));
            self.header.x_unit = self.header.x_unit.or(unit);
        }
    }

    /// Takes an object whose keys are wavelengths, if it is one. Where nothing says that it is, it has to look so.
    pub(super) fn keyed(&mut self, members: &Members<'a>, here: &Around<'a>, known: bool) -> Result<bool, ReadError> {
        let number = |key: &str| {
            let key =
                key.strip_prefix("SPECTRAL_").map_or(key, |key| key.trim_start_matches("NM").trim_start_matches('_'));
            key.trim().trim_end_matches("nm").trim_end().parse().ok().filter(|nm: &f64| nm.is_finite())
        };
        let keys: Vec<f64> = members.each().filter_map(|(key, _)| number(key)).collect();
        if keys.is_empty() || !known && (keys.len() < FEWEST_GUESSED || !is_plausible(&keys)) {
            return Ok(false);
        }
        // Colors of wavelengths, too, are keyed so.
        let is_color = |(_, value): (&Cow<'a, str>, Value<'a>)| value.written.starts_with("\"#");
        if members.each().all(is_color) {
            return Ok(false);
        }
        let mut rows = Vec::with_capacity(keys.len());
        for (key, value) in members.each() {
            let Some(wavelength) = number(key) else {
                self.left.extend(value.written.starts_with(['{', '[']).then(|| format!("“{key}”")));
                continue;
            };
            let cells = match value.written.as_bytes().first() {
                Some(b'{') => of_numbers(&value.members()?),
                Some(b'[') => value.pieces().map(|piece| (Cow::Borrowed(""), piece)).collect(),
                // Of numbers that are written as texts, too.
                _ => vec![(Cow::Borrowed(""), value.written.trim_matches('"'))],
            };
            let written = if let Cow::Borrowed(written) = key { written } else { "" };
            rows.push(Row { sample: String::new(), wavelength: (wavelength, written), cells });
        }
        // Members have no order.
        rows.sort_by(|a, b| a.wavelength.0.total_cmp(&b.wavelength.0));
        self.begin(rows[0].wavelength.1, known);
        self.table(rows.into_iter().map(Ok), here, true)?;
        Ok(true)
    }

    /// Takes a list of lists: curves or rows at the wavelengths around, or rows that begin with their wavelength.
    fn rows(&mut self, items: &[&'a str], mut here: Around<'a>) -> Result<(), ReadError> {
        let whole = self.document.whole;
        let Some(mut rows) = items.iter().map(|item| numbers(whole.with(item))).collect::<Option<Vec<_>>>() else {
            return Ok(());
        };
        let width = rows[0].len();
        if rows.iter().any(|row| row.len() != width) {
            return Ok(());
        }
        if width == here.wavelengths.len() {
            rows = (0..width).map(|at| rows.iter().map(|row| row[at]).collect()).collect();
        } else if rows.len() != here.wavelengths.len() {
            let first = rows.iter_mut().map(|row| Ok((whole.number(row[0], 0)?, row.remove(0))));
            let first = first.collect::<Result<Vec<_>, ReadError>>()?;
            let numbers: Vec<f64> = first.iter().map(|(nm, _)| *nm).collect();
            let named = here.columns.first().is_some_and(|name| header_terms::names_wavelengths(&words(name)));
            let sorted = numbers.is_sorted() || numbers.is_sorted_by(|a, b| a >= b);
            let likely = named || numbers.len() >= FEWEST_GUESSED && is_plausible(&numbers);
            if numbers.len() < 3 || width < 2 || !sorted || !likely {
                return Ok(());
            }
            self.begin(here.columns.first().filter(|_| named).map_or(first[0].1, String::as_str), named);
            here.wavelengths = first.into();
            here.columns = if here.columns.len() == width { here.columns[1..].into() } else { here.columns };
        }
        let cells = |row: Vec<&'a str>| row.into_iter().map(|piece| (Cow::Borrowed(""), piece)).collect();
        let rows = here.wavelengths.iter().zip(rows);
        let rows = rows.map(|(at, row)| Ok(Row { sample: String::new(), wavelength: *at, cells: cells(row) }));
        self.table(rows, &here, true)
    }

    /// Takes a list of objects that each have a wavelength, if it is one.
    fn records(&mut self, items: &[&'a str], here: &Around<'a>) -> Result<bool, ReadError> {
        let whole = self.document.whole;
        let first = whole.with(items[0]).members()?;
        let keys: Vec<Cow<'a, str>> = of_numbers(&first).into_iter().map(|(key, _)| key).collect();
        let names: Vec<String> = keys.iter().map(|key| words(key)).collect();
        let other = || names.iter().position(|name| is_one(name, AXES));
        let Some(axis) = header_terms::axis(&names).or_else(other).filter(|_| keys.len() > 1 && items.len() > 1) else {
            return Ok(false);
        };
        let mut around = Around { alone: false, ..here.clone() };
        self.hear(&first, &mut around);
        (around.name, around.alone) = (here.name.clone(), here.alone);
        self.begin(&keys[axis], true);
        let row = |written: &&'a str| {
            let item = whole.with(written);
            let members = item.members()?;
            let mut cells = of_numbers(&members);
            let at = cells.iter().position(|(key, piece)| *key == keys[axis] && *piece != "null");
            // An object is no number.
            let written = at.map_or(item.written, |at| cells.remove(at).1);
            let wavelength = (item.number(written, 0)?, written);
            let texts = members.each().filter(|(key, _)| is_one(&words(key), NAMES));
            let texts: Vec<String> = texts.filter_map(|(_, value)| value.read().ok()).collect();
            Ok(Row { sample: texts.join(" "), wavelength, cells })
        };
        self.table(items.iter().map(row), &around, false)?;
        Ok(true)
    }

    /// Takes rows of values; where all have to be of one length, one of another is an error.
    fn table(
        &mut self,
        rows: impl Iterator<Item = Result<Row<'a>, ReadError>>,
        here: &Around<'a>,
        even: bool,
    ) -> Result<(), ReadError> {
        let mut columns: Vec<Column<'a>> = Vec::new();
        let mut known = BTreeMap::new();
        let mut width = None;
        let whole = self.document.whole;
        for row in rows {
            let Row { sample, wavelength: (nm, written), cells } = row?;
            let (found, expected) = (cells.len(), *width.get_or_insert(cells.len()));
            if even && found != expected {
                return Err(ReadError::WrongCount { line: 1, name: nm.to_string(), found, expected });
            }
            if let Some(places) = self.log.places.as_mut().filter(|_| !written.is_empty()) {
                places.add_at(PlaceKind::Wavelength, whole.offset(written), written.len());
            }
            for (at, (key, piece)) in cells.into_iter().enumerate() {
                let is_same = |column: &&Column<'a>| column.sample == sample && column.key == key;
                let index = if columns.get(at).as_ref().is_some_and(is_same) {
                    at
                } else {
                    let place = if key.is_empty() { at } else { 0 };
                    let next = columns.len();
                    let index = *known.entry((sample.clone(), key.clone(), place)).or_insert(next);
                    if index == next {
                        check_curves(next + 1, 1)?;
                        columns.push(Column { sample: sample.clone(), key, at, samples: Vec::new() });
                    }
                    index
                };
                let sample = self.sample(nm, piece, at)?;
                columns[index].samples.extend(sample);
            }
        }
        self.push(columns, here)
    }

    /// A value at a wavelength; none for a gap.
    fn sample(&mut self, wavelength: f64, piece: &'a str, at: usize) -> Result<Option<Sample>, ReadError> {
        let whole = self.document.whole;
        let start = whole.offset(piece);
        self.log.work(piece.len() + 1, start)?;
        let value = whole.number(piece, at)?;
        if value.is_nan() || wavelength.is_nan() {
            return Ok(None);
        }
        self.samples += 1;
        check_samples(self.samples, 1)?;
        let place = self.log.places.as_mut().map(|places| places.add_at(PlaceKind::Value, start, piece.len()));
        Ok(Some(Sample { wavelength, value, line: 1, place: place.unwrap_or_default() }))
    }

    /// Takes curves, whose names and labels follow from their keys and from what is around them.
    fn push(&mut self, columns: Vec<Column<'a>>, here: &Around<'a>) -> Result<(), ReadError> {
        check_curves(self.spectra.len() + columns.len(), 1)?;
        let is_curve = |column: &Column<'a>| uncertainty_terms::term(&column.key, &column.key).is_none();
        let mut curves = columns.iter().filter(|column| is_curve(column));
        let first = curves.next().map(|column| (column.key.clone(), column.at));
        let single = curves.all(|column| Some((&column.key, column.at)) == first.as_ref().map(|(key, at)| (key, *at)));
        for column in columns {
            let is_curve = is_curve(&column);
            let numbered = || if single { String::new() } else { (column.at + 1).to_string() };
            let named = || here.columns.get(column.at).cloned().unwrap_or_else(numbered);
            let listed = column.key.is_empty() && here.columns.len() > 1;
            let key = if column.key.is_empty() { named() } else { column.key.into_owned() };
            let said = words(&key);
            let around = if column.sample.is_empty() { &here.name } else { &column.sample };
            let name = match (around.is_empty(), !listed && is_one(&said, VALUES)) {
                (true, true) => None,
                (false, true) => Some(around.clone()),
                (false, false) if single && is_curve => Some(around.clone()),
                (false, false) if !here.alone || !column.sample.is_empty() => Some(format!("{around} {key}")),
                _ => Some(key.clone()),
            };
            let own = here.quantity.is_empty() || header_terms::role(&said).is_some() || !is_curve;
            let label = if own { key } else { here.quantity.clone() };
            let unit = if here.unit.is_empty() { String::new() } else { format!(" ({})", here.unit) };
            self.spectra.push(Spectrum { name, label: label + &unit, samples: column.samples });
        }
        Ok(())
    }

    /// The line in which a value begins.
    fn line(&mut self, value: Value<'a>) -> usize {
        let end = value.offset(value.written).min(self.document.text.len());
        if end < self.cursor.0 {
            self.cursor = (0, 1);
        }
        let between = &self.document.text[self.cursor.0..end];
        self.cursor = (end, self.cursor.1 + between.bytes().filter(|byte| *byte == b'\n').count());
        self.cursor.1
    }
}

/// A key in lower case, with blanks between its words.
fn words(key: &str) -> String {
    spaced(key).replace(['_', '-'], " ")
}

fn is_plausible(numbers: &[f64]) -> bool {
    let (min, max) = extent(numbers.iter().copied());
    units::plausible(min, max, numbers.iter().any(|number| number.fract() != 0.0))
}

fn is_number(piece: &str) -> bool {
    piece == "null" || piece.starts_with(|c: char| c == '-' || c.is_ascii_digit())
}

/// The numbers of a list as they are written, or of an object whose keys count them.
fn numbers(value: Value<'_>) -> Option<Vec<&str>> {
    let pieces: Vec<&str> = match value.written.as_bytes().first()? {
        b'[' if !value.written[1..].contains(['[', '{', '"']) => value.pieces().collect(),
        b'{' => {
            let members = value.members().ok()?;
            let counts = members.each().zip(0..).all(|((key, _), at)| key.parse() == Ok::<usize, _>(at));
            members.each().filter(|_| counts).map(|(_, value)| value.written).collect()
        }
        _ => return None,
    };
    (!pieces.is_empty() && pieces.iter().all(|piece| is_number(piece))).then_some(pieces)
}

/// Members of an object that are numbers.
fn of_numbers<'a>(members: &Members<'a>) -> Vec<(Cow<'a, str>, &'a str)> {
    let numbers = members.each().filter(|(_, value)| is_number(value.written));
    numbers.map(|(key, value)| (key.clone(), value.written)).collect()
}

/// The ends of a range and its step, by the keys of an object.
fn range_of(members: &Members<'_>) -> Option<[f64; 3]> {
    let named = |wanted| members.each().filter(move |(key, _)| has_word(&words(key), wanted)).map(|(_, value)| value);
    let number = |wanted| named(wanted).find_map(|value| value.written.parse::<f64>().ok());
    let step = number("step|interval|increment|delta|spacing").filter(|step| *step > 0.0)?;
    let ends = number("start|from|first|begin|min|minimum").zip(number("end|to|last|stop|max|maximum"));
    let listed = || match numbers(named(ENDS).next()?)?[..] {
        [first, last] => first.parse().ok().zip(last.parse().ok()),
        _ => None,
    };
    let (first, last) = ends.or_else(listed)?;
    (first < last && is_plausible(&[first, last])).then_some([first, last, step])
}
