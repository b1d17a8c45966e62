//! What curves are, and whether their values are percent.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::grid::{Grid, RawCurve};
use super::quantity;
use super::text::excerpt;
use super::warning::Warning;
use super::watch::Log;
use super::words::{self, Channel};
use super::{Certainty, Curve, Decided, ReadOptions, decimal};

/// What the curves of a table are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Sensitivities of a camera, or color matching functions.
    Camera,
    /// Reflectances: fractions of one.
    Reflectance,
    /// Transmittances of filters: fractions of one.
    Transmittance,
    /// Spectral power of lights, in any unit.
    Illuminant,
    /// Nothing says what they are, and their values suggest nothing.
    Unknown,
}

impl Role {
    /// Whether the curves are fractions of the light that falls on something.
    pub fn is_fraction(self) -> bool {
        matches!(self, Self::Reflectance | Self::Transmittance)
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Camera => "camera sensitivities",
            Self::Reflectance => "reflectances",
            Self::Transmittance => "transmittances",
            Self::Illuminant => "illuminants",
            Self::Unknown => "spectra of an unknown kind",
        })
    }
}

/// What the values stand for as written, and so what is done to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Values {
    /// Taken as they are: fractions of one where the curves are reflectances or transmittances.
    Plain,
    /// Percent: divided by 100.
    Percent,
    /// Decadic absorbances A: taken as the fraction 10^−A.
    Absorbance,
    /// Decibels L of power: taken as the power 10^(L/10).
    Decibels,
}

impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Plain => "plain numbers, not percent",
            Self::Percent => "percent",
            Self::Absorbance => "absorbances, of which fractions are made",
            Self::Decibels => "decibels, of which powers are made",
        })
    }
}

/// The role, the scale, and the curves that are divided by 100.
#[derive(Debug)]
pub(super) struct Scale {
    pub(super) role: Decided<Role>,
    pub(super) values: Decided<Values>,
    divided: Divided,
}

#[derive(Debug, PartialEq)]
enum Divided {
    None,
    All(Values),
    /// Only the curves whose own headers say so.
    Headed(Role),
}

/// Where reflectances are judged: outside, instruments are noisy.
const VISIBLE_NM: std::ops::RangeInclusive<f64> = 400.0..=700.0;

/// Largest and median values, where they are judged.
#[derive(Debug)]
struct Span {
    min: f64,
    median: f64,
    max: f64,
}

impl Span {
    /// Of all curves: in the visible range, or everywhere if nothing is there.
    fn of(grid: &Grid) -> Self {
        let visible = |w: &f64| VISIBLE_NM.contains(w);
        let all = !grid.wavelengths.iter().any(visible);
        let stride = (grid.wavelengths.len() * grid.curves.len() / MEDIAN_SAMPLE).max(1);
        let (mut min, mut max, mut seen) = (f64::INFINITY, f64::NEG_INFINITY, 0_usize);
        let mut sample = Vec::new();
        for curve in &grid.curves {
            for (w, &value) in grid.wavelengths.iter().zip(&curve.values) {
                if value.is_nan() || !(all || visible(w)) {
                    continue;
                }
                (min, max) = (min.min(value), max.max(value));
                if seen.is_multiple_of(stride) {
                    sample.push(value);
                }
                seen += 1;
            }
        }
        sample.sort_unstable_by(f64::total_cmp);
        let median = sample.get(sample.len() / 2).copied().unwrap_or(0.0);
        Self { min, median, max }
    }

    /// The range of reflectances in percent. Up to 130, because glossy and fluorescent samples pass 100.
    fn percent(&self) -> bool {
        self.median > 2.0 && self.max <= 130.0
    }

    fn evidence(&self) -> String {
        format!("Values reach {}", short(self.max))
    }
}

/// Values that are enough for a median that is only compared with 2.
const MEDIAN_SAMPLE: usize = 65_536;

/// A number with at most four significant digits, for people.
fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let digits = 3 - value.abs().log10().floor() as i32;
    if (-8..=12).contains(&digits) {
        let scale = 10_f64.powi(digits.max(0));
        format!("{}", (value * scale).round() / scale)
    } else {
        format!("{value:.3e}")
    }
}

impl Scale {
    /// Whether values above a thousand are out of question: percent, and fractions of light.
    pub(super) fn denies_thousands(&self) -> bool {
        let sure = |certainty| certainty != Certainty::Guess;
        (self.values.value == Values::Percent && sure(self.values.certainty))
            || (self.role.value.is_fraction() && sure(self.role.certainty))
    }
}

/// Decides what the curves are and whether they are percent.
pub(super) fn decide(grid: &Grid, options: &ReadOptions) -> Scale {
    let span = Span::of(grid);
    let role = Decided::or_chosen(options.role, || {
        role_from_header(grid)
            .or_else(|| role_from_hints(grid, options))
            .unwrap_or_else(|| role_from_values(grid, &span))
    });
    let (values, divided) = values(grid, options, role.value, &span);
    Scale { role, values, divided }
}

fn role_from_header(grid: &Grid) -> Option<Decided<Role>> {
    if let Some(role) = grid.role.as_ref().filter(|role| role.certainty == Certainty::Certain) {
        return Some(role.clone());
    }
    if let Some((line, role)) = grid.header.role {
        return Some(Decided::certain(role, format!("Line {line} says so")));
    }
    let mut named = grid.curves.iter().filter_map(|curve| Some((words::role(&curve.label)?, &curve.label)));
    if let Some((role, name)) = named.next() {
        let why = format!("A column is named “{}”", excerpt(name));
        let agree = named.all(|(other, _)| other == role);
        return Some(if agree { Decided::certain(role, why) } else { Decided::guess(role, why) });
    }
    let names: Vec<&str> = grid.curves.iter().take(MOST_CHANNELS + 1).map(|curve| curve.name.as_str()).collect();
    if let Some((_, letters)) = channels(&names) {
        let why = format!("The curves are named {}", names.join(", "));
        return Some(if letters { Decided::certain(Role::Camera, why) } else { Decided::guess(Role::Camera, why) });
    }
    role_from_quantity(grid)
}

/// The role that a quantity leaves, such as none for counts: the sensitivity of the detector is still in them.
fn role_from_quantity(grid: &Grid) -> Option<Decided<Role>> {
    if let Some((line, quantity)) = grid.header.quantity
        && let Some(role) = quantity.role()
    {
        return Some(Decided::certain(role, format!("Line {line} says {quantity}")));
    }
    let unit = grid.curves.iter().find_map(|curve| curve.unit.as_deref());
    if let Some((unit, role)) = unit.and_then(|unit| Some((unit, quantity::of_unit(unit)?.role()?)))
        && role != Role::Unknown
    {
        return Some(Decided::certain(role, format!("The unit is {unit}")));
    }
    let says_counts = |curve: &RawCurve| {
        words::says_counts(&curve.label) || curve.unit.as_ref().is_some_and(|unit| words::says_counts(unit))
    };
    let counts = !grid.curves.is_empty() && grid.curves.iter().all(says_counts);
    counts.then(|| {
        Decided::certain(Role::Unknown, "The columns are headed counts, which a detector's own sensitivity shapes")
    })
}

fn role_from_hints(grid: &Grid, options: &ReadOptions) -> Option<Decided<Role>> {
    let (values, why) = match (options.values, grid.header.values) {
        (Some(values), _) => (Some(values), "It was chosen what the values stand for".to_owned()),
        (None, Some((line, values))) => (Some(values), format!("Line {line} says {values}")),
        (None, None) => {
            let headed = grid.curves.iter().find_map(|curve| words::values(&curve.label));
            (headed.filter(|values| *values != Values::Plain), "The header says what the values stand for".to_owned())
        }
    };
    // What else a file says of its content says more than its scale.
    if let Some((line, role)) = grid.header.mentioned.filter(|(_, role)| suits(*role, values)) {
        return Some(Decided::guess(role, format!("Line {line} mentions it")));
    }
    if let Some(role) = grid.role.as_ref().filter(|role| suits(role.value, values)) {
        return Some(role.clone());
    }
    match values? {
        Values::Plain => None,
        Values::Percent => Some(Decided::guess(Role::Reflectance, why)),
        // Most spectrometers derive absorbances from what passes a sample.
        Values::Absorbance => Some(Decided::guess(Role::Transmittance, why)),
        Values::Decibels => Some(Decided::guess(Role::Illuminant, why)),
    }
}

/// Whether curves of a role may be written so. Lights in percent are not told from reflectances by a mere mention.
fn suits(role: Role, values: Option<Values>) -> bool {
    match values {
        Some(Values::Percent | Values::Absorbance) => role.is_fraction(),
        _ => true,
    }
}

fn role_from_values(grid: &Grid, span: &Span) -> Decided<Role> {
    // Lights scaled the usual way are exactly 100 at 560 nm.
    const ANCHOR: (f64, f64) = (560.0, 100.0);
    // Reflectances in percent without a header: the noise of a white tile, but not the peak of a light.
    const PERCENT_MAX: f64 = 106.0;
    if bells(grid).is_some() {
        return Decided::guess(Role::Camera, "Three bells, one in each third of the visible range");
    }
    let at = grid.wavelengths.iter().position(|&w| w == ANCHOR.0);
    let anchored = at.is_some_and(|i| grid.curves.iter().all(|curve| curve.values[i] == ANCHOR.1));
    let fraction = span.min >= -0.2 && span.max <= 1.2 && span.max > 0.0;
    if fraction || (span.percent() && span.max <= PERCENT_MAX && !anchored) {
        Decided::guess(Role::Reflectance, span.evidence())
    } else if anchored {
        Decided::guess(Role::Illuminant, "Values are 100 at 560 nm")
    } else {
        Decided::guess(Role::Unknown, format!("{}, and nothing says what they are", span.evidence()))
    }
}

fn values(grid: &Grid, options: &ReadOptions, role: Role, span: &Span) -> (Decided<Values>, Divided) {
    let all = |values: Values| if values == Values::Plain { Divided::None } else { Divided::All(values) };
    if let Some(chosen) = options.values {
        return (Decided::chosen(chosen), all(chosen));
    }
    if let Some((line, values)) = grid.header.values.filter(|(_, values)| role.is_fraction() || is_power(*values)) {
        return (Decided::certain(values, format!("Line {line} says so")), all(values));
    }
    let headed = |curve: &RawCurve| headed(curve, role);
    let marks = grid.curves.iter().filter_map(headed);
    if let Some(first) = marks.clone().next() {
        let whole = marks.clone().count() == grid.curves.len() && marks.clone().all(|values| values == first);
        let others = marks.clone().find(|values| *values != first);
        let why = match others {
            Some(other) => format!("Columns are headed differently, some {first}, others {other}, each read so"),
            None if whole => format!("The columns are headed {first}"),
            None => format!("Some columns, and only they, are headed {first}"),
        };
        return (Decided::certain(first, why), if whole { Divided::All(first) } else { Divided::Headed(role) });
    }
    if !role.is_fraction() {
        return (Decided::certain(Values::Plain, "Only reflectances and transmittances are scaled"), Divided::None);
    }
    let values = if span.percent() { Values::Percent } else { Values::Plain };
    (Decided::guess(values, span.evidence()), all(values))
}

/// Whether values are powers of ten of any quantity, not only of fractions.
fn is_power(values: Values) -> bool {
    values == Values::Decibels
}

/// What the header of a curve says that its values stand for, as far as that goes with its role.
fn headed(curve: &RawCurve, role: Role) -> Option<Values> {
    let said = words::values(&curve.label);
    said.filter(|values| *values != Values::Plain && (role.is_fraction() || is_power(*values)))
}

/// Makes plain numbers of what is written.
pub(super) fn convert(grid: &mut Grid, scale: &Scale) {
    let plain_by_choice = scale.values.certainty == Certainty::Chosen && scale.values.value == Values::Plain;
    for curve in &mut grid.curves {
        let values = match scale.divided {
            Divided::All(values) => values,
            Divided::Headed(role) => match headed(curve, role) {
                Some(values) => values,
                None => continue,
            },
            Divided::None => {
                let denied = |unit: &String| words::values(unit).is_some_and(|said| said != Values::Plain);
                curve.unit = curve.unit.take().filter(|unit| !(plain_by_choice && denied(unit)));
                continue;
            }
        };
        relabel(curve, values, scale.role.value);
        let plain = |value: f64| match values {
            Values::Plain => value,
            Values::Percent => decimal::shifted(value, -2),
            Values::Absorbance => 10_f64.powf(-value),
            Values::Decibels => 10_f64.powf(value / 10.0),
        };
        // What no number can hold is a gap.
        let finite = |value: f64| if value.is_finite() { value } else { f64::NAN };
        curve.values.iter_mut().for_each(|value| *value = finite(plain(*value)));
    }
}

/// Gives a curve the unit that its converted values have, and a name that does not say what they were.
fn relabel(curve: &mut RawCurve, values: Values, role: Role) {
    let fraction = if role == Role::Reflectance { "Reflectance" } else { "Transmittance" };
    let renamed = match values {
        // Percent are so common that what is written to files leaves them out, not what a person sees.
        Values::Plain | Values::Percent => return,
        Values::Absorbance => {
            curve.unit = Some("1".to_owned());
            replaced(&curve.name, |word| word.starts_with("absorban").then_some(fraction))
        }
        Values::Decibels => {
            // Decibels are powers above a milliwatt, or ratios.
            let word = |ratio| {
                move |word: &str| match word {
                    "dbm" => Some("mW"),
                    "db" => Some(ratio),
                    _ => None,
                }
            };
            let milliwatts = || curve.label.to_lowercase().contains("dbm").then_some("dBm");
            curve.unit = curve.unit.as_deref().or_else(milliwatts).map(|unit| replaced(unit, word("1")));
            replaced(&curve.name, word(""))
        }
    };
    let misleads = renamed.is_empty() || words::values(&renamed).is_some_and(|said| said != Values::Plain);
    let whole = if role.is_fraction() { fraction } else { "Power" };
    curve.name = if misleads { whole.to_owned() } else { renamed };
}

/// A text with some of its words, given in lower case, replaced, and without what blanks and brackets that leaves.
fn replaced<'a>(text: &str, by: impl Fn(&str) -> Option<&'a str>) -> String {
    let mut out = String::with_capacity(text.len());
    for piece in text.split_inclusive(|c: char| !c.is_alphanumeric()) {
        let word = piece.trim_end_matches(|c: char| !c.is_alphanumeric());
        out.push_str(by(&word.to_lowercase()).unwrap_or(word));
        out.push_str(&piece[word.len()..]);
    }
    quantity::tidy(&out)
}

/// Warns of reflectances that cannot be, and of values further below zero than noise.
pub(super) fn warn(scale: &Scale, grid: &Grid, log: &mut Log<'_>) {
    const LARGEST: f64 = 2.0;
    const NOISE: f64 = 0.05;
    let role = scale.role.value;
    if !role.is_fraction() && role != Role::Camera {
        return;
    }
    // Outside, instruments are noisy.
    let all = !grid.wavelengths.iter().any(|w| VISIBLE_NM.contains(w));
    let (mut bright, mut below) = (0, 0);
    let (mut first_bright, mut first_below) = (None, None);
    for curve in &grid.curves {
        let mut lowest = (f64::INFINITY, 0);
        let mut max = f64::NEG_INFINITY;
        for (at, (w, &value)) in grid.wavelengths.iter().zip(&curve.values).enumerate() {
            if (all || VISIBLE_NM.contains(w)) && !value.is_nan() {
                max = max.max(value);
                lowest = if value < lowest.0 { (value, at) } else { lowest };
            }
        }
        if role.is_fraction() && max > LARGEST && !all {
            bright += 1;
            first_bright.get_or_insert((curve, max));
        }
        if lowest.0 < -NOISE * max.max(0.0) && lowest.0 < 0.0 {
            below += 1;
            first_below.get_or_insert((curve, lowest));
        }
    }
    if let Some((curve, max)) = first_bright {
        log.push(Warning::NotReflectances { count: bright, first: curve.told(), max });
    }
    if let Some((curve, (min, at))) = first_below {
        let line = (grid.lines.len() == grid.wavelengths.len()).then(|| grid.line(at));
        log.push(Warning::BelowZero { count: below, first: curve.told(), min, line });
    }
}

/// Channels that a camera may have.
const MOST_CHANNELS: usize = 4;

/// Which of three or four names are red, green and blue, and whether all are letters. A fourth curve may be beside
/// them, such as an infrared or a clear channel.
fn channels(names: &[&str]) -> Option<([usize; 3], bool)> {
    if !(3..=MOST_CHANNELS).contains(&names.len()) {
        return None;
    }
    let mut found: [Option<usize>; 3] = [None; 3];
    let mut letters = true;
    for (index, name) in names.iter().enumerate() {
        let channel = match words::channel(name) {
            Some(Channel::Letter(channel)) => channel,
            Some(Channel::Word(channel)) => {
                letters = false;
                channel
            }
            None => continue,
        };
        if found[channel].replace(index).is_some() {
            return None;
        }
    }
    Some(([found[0]?, found[1]?, found[2]?], letters))
}

/// Which curves of a camera are red, green and blue: by name, or by where three curves peak.
pub(super) fn camera_columns(role: Role, curves: &[Curve]) -> Option<[usize; 3]> {
    if role != Role::Camera {
        return None;
    }
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).take(MOST_CHANNELS + 1).collect();
    channels(&names).map(|(columns, _)| columns).or_else(|| by_peak(curves))
}

fn by_peak(curves: &[Curve]) -> Option<[usize; 3]> {
    if curves.len() != 3 {
        return None;
    }
    let mut order: Vec<(f64, usize)> =
        curves.iter().enumerate().map(|(i, curve)| (peak(&curve.wavelengths_nm, &curve.values).0, i)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    Some([order[0].1, order[1].1, order[2].1])
}

/// Where a curve is largest, and how large.
fn peak(wavelengths: &[f64], values: &[f64]) -> (f64, f64) {
    let start = (f64::NAN, f64::NEG_INFINITY);
    wavelengths.iter().zip(values).fold(start, |best, (&w, &value)| if value > best.1 { (w, value) } else { best })
}

/// Whether exactly three curves look like the channels of a camera: small at both ends, with peaks in order.
fn bells(grid: &Grid) -> Option<()> {
    const ENDS: f64 = 0.3;
    const PEAKS_NM: [std::ops::RangeInclusive<f64>; 3] = [410.0..=500.0, 500.0..=580.0, 570.0..=680.0];
    if grid.curves.len() != 3 || grid.wavelengths.len() < 8 {
        return None;
    }
    let mut peaks = Vec::with_capacity(3);
    for curve in &grid.curves {
        let (at, max) = peak(&grid.wavelengths, &curve.values);
        let ends = [curve.values.first()?, curve.values.last()?];
        if max <= 0.0 || ends.iter().any(|&&end| end.is_nan() || end > ENDS * max) {
            return None;
        }
        peaks.push(at);
    }
    peaks.sort_by(f64::total_cmp);
    let in_place = peaks.iter().zip(&PEAKS_NM).all(|(peak, range)| range.contains(peak));
    (in_place && peaks[1] - peaks[0] > 20.0 && peaks[2] - peaks[1] > 20.0).then_some(())
}
