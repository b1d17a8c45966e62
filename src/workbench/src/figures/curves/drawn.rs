//! Conversion of read curves to drawn lines.

use spectral_file::{Quantity, Role, SpectralFile, Uncertainty};

use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};

use super::import_selection::{ImportSelection, places};
use crate::catalog::import::taken;
use crate::document::imported::ImportedSet;
use crate::figures::band::{coverage, words};
use crate::format::{capitalized, number, sentence};

pub const DRAWN: usize = 200;

#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its place in the file, from 0.
    pub place: usize,
    /// Its place among those taken.
    pub order: usize,
    pub name: String,
    /// Of a camera: 0 for red, 1 for green, 2 for blue.
    pub channel: Option<usize>,
    /// Wavelengths in nanometers and values; a value that is not finite marks a gap.
    pub points: Vec<[f64; 2]>,
    /// Samples with the half-width of the band of their uncertainty, and the coverage factor of that; empty where the file states none.
    pub band: (Vec<([f64; 2], f64)>, f64),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    pub title: String,
    pub drawn: Vec<Curve>,
    /// Quantity of the values, with its unit.
    pub quantity: String,
    /// Their unit, where all have the same.
    pub unit: Option<String>,
    /// Their number, for a corner of the plot.
    pub note: String,
    count: usize,
}

impl Curves {
    /// The first curves of the selected item: of the file while settings are tried on it, else of the set. Or the reason that
    /// there are none.
    pub fn of(shown: &ImportSelection, most: usize) -> Result<Self, String> {
        if let Some(error) = shown.error().filter(|_| shown.pending || shown.set.is_none()) {
            return Err(sentence(&error.to_string()));
        }
        // Quantity of the set as the file is interpreted now.
        let known =
            shown.table().filter(|_| !shown.pending && shown.is_fresh()).map(|table| table.reading.quantity.value);
        match (&shown.set, shown.table()) {
            (Some(set), None) => Self::of_set(set, known, most),
            (Some(set), Some(_)) if !shown.pending || !shown.is_fresh() => Self::of_set(set, known, most),
            (_, Some(table)) => Ok(Self::of_table(shown, table, most)),
            (None, None) => Err("Reading…".to_owned()),
        }
    }

    fn of_table(shown: &ImportSelection, table: &SpectralFile, most: usize) -> Self {
        let all = taken(table, &shown.overrides);
        let role = table.role.value;
        let channels = shown.overrides.channels.or(table.reading.camera_columns).unwrap_or([0, 1, 2]);
        let kept: Vec<usize> = all.iter().copied().filter(|place| *place < table.curves.len()).collect();
        let grid = Grid::of(&kept.iter().take(most).map(|&p| &table.curves[p].wavelengths_nm[..]).collect::<Vec<_>>());
        let drawn = kept.iter().take(most).enumerate().map(|(order, &place)| {
            let curve = &table.curves[place];
            let points = points(&curve.wavelengths_nm, &curve.values, (curve.missing > 0).then_some(&grid));
            let standard = curve.uncertainty.as_ref().map(|of| &of.standard[..]);
            let band = band(&curve.wavelengths_nm, &curve.values, standard, curve.uncertainty.as_ref());
            Curve { place, order, name: curve.name.clone(), channel: channel(role, &channels, place), points, band }
        });
        let title = shown.file.as_ref().map_or_else(String::new, |file| file.origin.name.clone());
        let unit = common(kept.iter().map(|&place| table.curves[place].unit.as_deref()));
        let said = Some(table.reading.quantity.value);
        Self::new(title, drawn.collect(), (role, said), unit, kept.len())
    }

    fn of_set(set: &ImportedSet, said: Option<Quantity>, most: usize) -> Result<Self, String> {
        let places = places(set);
        // The curves of a camera that are no channel are shown too; their values are never percent.
        let role = if set.role == Role::Camera { Role::Unknown } else { set.role };
        let count = set.curves.len().min(most);
        let head = ImportedSet {
            role,
            curves: set.curves[..count].to_vec(),
            decisions: Vec::new(),
            overrides: crate::document::imported::ImportOverrides::default(),
            ..set.clone()
        };
        let curves = head.curves_in_nm().map_err(|error| format!("{}: {error}", set.name))?;
        let stated = head.uncertainties_in_nm();
        let drawn = curves.into_iter().zip(places).enumerate().map(|(order, ((name, curve), place))| Curve {
            band: {
                let standard = stated.get(order).and_then(Option::as_deref);
                let uncertainty = head.curves.get(order).and_then(|curve| curve.uncertainty.as_ref());
                band(curve.wavelengths_nm(), curve.values(), standard, uncertainty)
            },
            place,
            order,
            name,
            channel: channel(set.role, &set.channels, order),
            points: points(curve.wavelengths_nm(), curve.values(), None),
        });
        let unit = common(set.curves.iter().map(|curve| curve.unit.as_deref()));
        Ok(Self::new(set.name.clone(), drawn.collect(), (set.role, said), unit, set.curves.len()))
    }

    fn new(
        title: String,
        drawn: Vec<Curve>,
        (role, said): (Role, Option<Quantity>),
        unit: Option<String>,
        count: usize,
    ) -> Self {
        let unit = unit.filter(|_| !role.is_fraction());
        let what = match (said, role) {
            (Some(said), _) if !matches!(said, Quantity::Unknown | Quantity::Relative) => {
                capitalized(&said.to_string())
            }
            (_, Role::Camera) => "Sensitivity".to_owned(),
            (_, Role::Reflectance) => "Reflectance".to_owned(),
            (_, Role::Transmittance) => "Transmittance".to_owned(),
            (_, Role::Illuminant) => "Power".to_owned(),
            (_, Role::Unknown) => "Value".to_owned(),
        };
        let quantity = match &unit {
            Some(unit) => format!("{what} ({unit})"),
            None if role.is_fraction() => what,
            None => format!("{what} (no unit stated)"),
        };
        let mut curves = Self { title, drawn, quantity, unit, note: String::new(), count };
        curves.note = curves.noted();
        curves
    }

    /// Limits the number of drawn curves.
    pub fn cut(&mut self, most: usize) {
        self.drawn.truncate(most);
        self.note = self.noted();
    }

    fn noted(&self) -> String {
        let count = match (self.count, self.drawn.len()) {
            (1, _) => self.drawn.first().map_or_else(String::new, |curve| curve.name.clone()),
            (all, drawn) if drawn < all => format!("the first {drawn} of {all} curves"),
            (all, _) => format!("{all} curves"),
        };
        self.band_words().map_or_else(|| count.clone(), |words| format!("{count}; {words}"))
    }

    /// Words for the bands, if there are any.
    pub fn band_words(&self) -> Option<String> {
        let mut factors: Vec<f64> = self.drawn.iter().filter(|of| !of.band.0.is_empty()).map(|of| of.band.1).collect();
        factors.dedup();
        let [first] = factors[..] else { return (!factors.is_empty()).then(|| "bands: ±U of the file".to_owned()) };
        Some(words(first))
    }

    /// The wavelengths that any curve covers.
    pub fn range_nm(&self) -> [f64; 2] {
        let ends = self.drawn.iter().filter_map(|curve| Some([curve.points.first()?[0], curve.points.last()?[0]]));
        ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([380.0, 780.0])
    }

    /// The least and the largest value to show. At the ends of their range instruments write spikes, which must not flatten what
    /// is seen: where they are several times as large, the visible range alone counts.
    pub fn span(&self) -> [f64; 2] {
        const SPIKE: f64 = 3.0;
        let whole = self.span_in(f64::NEG_INFINITY..=f64::INFINITY);
        let seen = self.span_in(FIRST_NM..=LAST_NM);
        match (seen, whole) {
            (Some(seen), Some(whole)) if height(seen) > 0.0 && height(whole) > SPIKE * height(seen) => seen,
            (_, Some(whole)) => whole,
            (_, None) => [0.0, 1.0],
        }
    }

    /// The least value, and the largest or zero, at some wavelengths; none where there is no value.
    fn span_in(&self, nm: std::ops::RangeInclusive<f64>) -> Option<[f64; 2]> {
        let points = || self.drawn.iter().flat_map(|curve| &curve.points);
        let values = || points().filter(|point| nm.contains(&point[0]) && point[1].is_finite()).map(|point| point[1]);
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        (low <= high).then(|| [low, high.max(0.0)])
    }

    /// Note on samples beyond the visible range, if there are any.
    pub fn beyond(&self) -> Option<String> {
        let ([low, high], [least, most]) = (self.span(), self.span_in(f64::NEG_INFINITY..=f64::INFINITY)?);
        (least < low || most > high)
            .then(|| format!("outside the visible range values run from {} to {}", number(least), number(most)))
    }
}

/// From the zero line, or from what lies below it, to the top.
fn height([low, high]: [f64; 2]) -> f64 {
    high - low.min(0.0)
}

fn channel(role: Role, channels: &[usize; 3], place: usize) -> Option<usize> {
    channels.iter().position(|channel| *channel == place).filter(|_| role == Role::Camera)
}

/// Samples with the half-widths of their band, and its coverage factor.
fn band(nm: &[f64], values: &[f64], standard: Option<&[f64]>, of: Option<&Uncertainty>) -> (Vec<([f64; 2], f64)>, f64) {
    let factor = coverage(of.map_or(1.0, |of| of.coverage));
    let samples = nm.iter().zip(values).zip(standard.unwrap_or_default());
    (samples.map(|((nm, value), u)| ([*nm, *value], factor * u)).collect(), factor)
}

/// Unit that all curves share, if they do.
fn common<'a>(mut units: impl Iterator<Item = Option<&'a str>>) -> Option<String> {
    let first = units.next()??;
    units.all(|unit| unit == Some(first)).then(|| first.to_owned())
}

/// All wavelengths of a table.
struct Grid(Vec<f64>);

impl Grid {
    fn of(curves: &[&[f64]]) -> Self {
        // The longest curve first: where it holds all, nothing is to be sorted.
        let mut all = curves.iter().max_by_key(|curve| curve.len()).map_or_else(Vec::new, |curve| curve.to_vec());
        let known = all.len();
        for curve in curves.iter().filter(|curve| curve.len() < known) {
            all.extend(
                curve
                    .iter()
                    .filter(|nm| all[..known].binary_search_by(|at| at.total_cmp(nm)).is_err())
                    .copied()
                    .collect::<Vec<_>>(),
            );
        }
        all.sort_unstable_by(f64::total_cmp);
        all.dedup();
        Self(all)
    }

    /// True if the table has a wavelength between two.
    fn has_between(&self, a: f64, b: f64) -> bool {
        let after = self.0.partition_point(|nm| *nm <= a);
        self.0.get(after).is_some_and(|nm| *nm < b)
    }
}

/// A curve with its gaps: where the table has wavelengths and the curve has no values, or where an even row of wavelengths has
/// a hole.
fn points(wavelengths_nm: &[f64], values: &[f64], grid: Option<&Grid>) -> Vec<[f64; 2]> {
    let step = even_step(wavelengths_nm);
    let mut points = Vec::with_capacity(values.len());
    let mut before: Option<f64> = None;
    for (&nm, &value) in wavelengths_nm.iter().zip(values) {
        if let Some(last) = before {
            let hole = step.is_some_and(|step| nm - last > 1.9 * step);
            if hole || grid.is_some_and(|grid| grid.has_between(last, nm)) {
                points.push([f64::midpoint(last, nm), f64::NAN]);
            }
        }
        points.push([nm, value]);
        before = Some(nm);
    }
    points
}

/// The wavelength step between nearly all samples.
fn even_step(wavelengths_nm: &[f64]) -> Option<f64> {
    let mut steps: Vec<f64> = wavelengths_nm.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if steps.len() < 8 {
        return None;
    }
    let middle = steps.len() / 2;
    let median = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    let even = steps.iter().filter(|step| (*step - median).abs() < 0.01 * median).count();
    (10 * even >= 8 * steps.len()).then_some(median)
}

/// At most the requested number of points, including the minimum and maximum of each stretch, and the gaps.
pub(super) fn thinned(points: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    if points.len() <= most {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil((most / 2).max(1));
    let mut kept = Vec::with_capacity(most + 2);
    kept.extend(points.first().copied());
    for part in points.chunks(stretch) {
        let finite = || part.iter().enumerate().filter(|(_, point)| point[1].is_finite());
        let least = finite().min_by(|a, b| a.1[1].total_cmp(&b.1[1]));
        let largest = finite().max_by(|a, b| a.1[1].total_cmp(&b.1[1]));
        let gap = part.iter().enumerate().find(|(_, point)| !point[1].is_finite());
        let mut three: Vec<(usize, &[f64; 2])> = [least, largest, gap].into_iter().flatten().collect();
        three.sort_by_key(|(at, _)| *at);
        three.dedup_by_key(|(at, _)| *at);
        kept.extend(three.into_iter().map(|(_, point)| *point));
    }
    kept.extend(points.last().copied());
    kept
}
