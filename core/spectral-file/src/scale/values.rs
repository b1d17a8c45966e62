//! Scale of the values of each curve, and the statistics of its numbers that are evidence of it.

use crate::decimal::short;
use crate::decision::{Certainty, Decided, Role, Values};
use crate::grid::{Grid, RawCurve};
use crate::header_terms;
use crate::options::ReadOptions;
use crate::warning::Warning;
use crate::watch::Log;

/// Largest reflectance in percent, and the largest where the program is known to write percent.
pub(super) const LARGEST_PERCENT: (f64, f64) = (130.0, 1000.0);

/// Decides for all curves, and for each: by choice, by a line, by the headers, by the numbers.
pub(super) fn decide(
    grid: &Grid,
    options: &ReadOptions,
    role: &Decided<Role>,
    from_file: bool,
    evidence: &Evidence,
    log: &mut Log<'_>,
) -> (Decided<Values>, Vec<Values>) {
    let all = |decided: Decided<Values>| {
        let columns = vec![decided.value; grid.curves.len()];
        (decided, columns)
    };
    if let Some(chosen) = options.values {
        return all(Decided::chosen(chosen));
    }
    let fraction = role.value.is_fraction();
    let said = |said: Option<(usize, Values)>| {
        let (line, values) = said.filter(|(_, values)| fraction || is_power(*values))?;
        Some(all(Decided::certain(values, format!("Line {line} says so"))))
    };
    let said = said(grid.header.values)
        .or_else(|| by_headers(grid, role.value, evidence))
        .or_else(|| said(grid.header.clues.values));
    if let Some(said) = said {
        doubt_percent(grid, said.0.value, log);
        return said;
    }
    if !fraction {
        return all(match role.certainty {
            Certainty::Open => Decided::open(Values::Plain, &*role.why),
            _ => Decided::certain(Values::Plain, "Only reflectances and transmittances are scaled"),
        });
    }
    let named = |line: &usize| *line > 0 || role.value == Role::Transmittance && Some(role) == grid.beside.as_ref();
    if let Some(line) = grid.header.clues.absorbance.filter(|_| role.certainty != Certainty::Certain).filter(named) {
        // No instrument measures larger ones.
        const LARGEST_ABSORBANCE: f64 = 10.0;
        let why = match line {
            0 => role.why.clone(),
            _ => format!("Line {line} mentions absorbances"),
        };
        return all(if evidence.range().1 > LARGEST_ABSORBANCE {
            Decided::open(Values::Plain, format!("{why}, but {}", evidence.words()))
        } else {
            Decided::guess(Values::Absorbance, why)
        });
    }
    by_numbers(grid, from_file || role.certainty != Certainty::Chosen, evidence, log)
}

/// Each curve by its own header, if any header has information. A table has one scale: beside columns headed percent, a silent
/// one with a sign of percent in its name, or that reaches as far, is percent too.
fn by_headers(grid: &Grid, role: Role, evidence: &Evidence) -> Option<(Decided<Values>, Vec<Values>)> {
    let mut columns: Vec<Option<Values>> = grid.curves.iter().map(|curve| headed(curve, role)).collect();
    let first = columns.iter().flatten().next().copied()?;
    let count = columns.iter().flatten().count();
    for ((said, curve), span) in columns.iter_mut().zip(&grid.curves).zip(&evidence.curves) {
        let open = said.is_none() && first == Values::Percent && header_terms::values(&curve.label).is_none();
        let same = |span: &Span| curve.label.contains('%') || span.looks(LARGEST_PERCENT.0) == Looks::Percent;
        *said = said.or_else(|| span.filter(|span| open && curve.unit.is_none() && same(span)).map(|_| first));
    }
    let assumed = columns.iter().flatten().count() > count;
    let other = columns.iter().flatten().find(|values| **values != first);
    let why = match other {
        Some(other) => format!("Columns are headed differently, some {first}, others {other}, each read so"),
        None if count == columns.len() => format!("The columns are headed {first}"),
        None if assumed => format!("Some columns are headed {first}, and the table has one scale"),
        None => format!("Some columns, and only they, are headed {first}"),
    };
    let columns: Vec<Values> = columns.into_iter().map(|values| values.unwrap_or(Values::Plain)).collect();
    // `abs_bg` may be a coefficient; a column of absorbances is called so, or ends in `Abs`.
    let short = |curve: &RawCurve| {
        let label = curve.label.to_lowercase();
        let bare = label.split(['(', '[']).next().unwrap_or_default().trim().trim_end_matches('.');
        label.contains("abs") && !label.contains("absorban") && !bare.ends_with("abs")
    };
    // Beside some that are headed so, others may be of them without a word: a model of what was measured.
    let silent = first == Values::Absorbance && count < columns.len();
    let assumed = assumed || silent || first == Values::Absorbance && grid.curves.iter().any(short);
    Some((if assumed { Decided::guess(first, why) } else { Decided::certain(first, why) }, columns))
}

fn headed(curve: &RawCurve, role: Role) -> Option<Values> {
    let said = header_terms::values(&curve.label);
    said.filter(|values| *values != Values::Plain && (role.is_fraction() || is_power(*values)))
}

/// Returns whether values are powers of ten of any quantity, not only of fractions.
fn is_power(values: Values) -> bool {
    values == Values::Decibels
}

/// Fractions of light by their numbers. The curves that name what is measured decide, or all where none does. `trusted`: it is not
/// only by choice that they are fractions of light.
fn by_numbers(grid: &Grid, trusted: bool, evidence: &Evidence, log: &mut Log<'_>) -> (Decided<Values>, Vec<Values>) {
    let clues = &grid.header.clues;
    let writer = clues.ratios_in_percent;
    let largest = if writer.is_some() { LARGEST_PERCENT.1 } else { LARGEST_PERCENT.0 };
    let names_role = |curve: &RawCurve| header_terms::role(&curve.label).is_some_and(Role::is_fraction);
    let some_named = grid.curves.iter().any(names_role);
    let looks: Vec<Option<Looks>> = evidence.curves.iter().map(|span| Some(span.as_ref()?.looks(largest))).collect();
    let main = || {
        let named = grid.curves.iter().zip(&looks).filter(|(curve, _)| !some_named || names_role(curve));
        named.filter_map(|(_, looks)| *looks)
    };
    let count = |wanted: Looks| main().filter(|looks| *looks == wanted).count();
    let (percent, plain, neither) = (count(Looks::Percent), count(Looks::Plain), count(Looks::Neither));
    let why = || match writer {
        Some((line, program)) => format!("{}, and line {line} shows {program}, which writes percent", evidence.words()),
        None => evidence.words(),
    };
    let same = |values: Values| vec![values; grid.curves.len()];
    if percent == 0 && (neither > 0 || writer.is_some()) || percent > 0 && !trusted {
        let unsaid = || format!("{}, and nothing says whether they are percent", evidence.words());
        let why = writer.map_or_else(unsaid, |_| format!("{}, but the numbers do not show it", why()));
        return (Decided::open(Values::Plain, why), same(Values::Plain));
    }
    if percent == 0 {
        return (Decided::guess(Values::Plain, evidence.words()), same(Values::Plain));
    }
    // Dark samples in percent look like fractions, and those that are seen only in part like neither: where most curves are percent,
    // all are that reach no farther.
    let others = if plain > percent { Values::Plain } else { Values::Percent };
    let as_percent = |(looks, span): (&Option<Looks>, &Option<Span>)| match looks {
        Some(Looks::Percent) => Values::Percent,
        Some(Looks::Neither) if span.is_none_or(|span| span.max > largest) => Values::Plain,
        Some(Looks::Neither | Looks::Plain) | None => others,
    };
    let columns: Vec<Values> = looks.iter().zip(&evidence.curves).map(as_percent).collect();
    warn_of_others(grid, &columns, log);
    let small = || grid.curves.iter().zip(&looks).filter(|(_, looks)| **looks == Some(Looks::Plain));
    if let Some((curve, _)) = small().next().filter(|_| others == Values::Percent) {
        log.push(Warning::SmallAmongPercent { count: small().count(), first: curve.description() });
    }
    (Decided::guess(Values::Percent, why()), columns)
}

/// Warns where some curves are read as percent and others are not.
fn warn_of_others(grid: &Grid, columns: &[Values], log: &mut Log<'_>) {
    let of = |wanted: Values| grid.curves.iter().zip(columns).filter(move |(_, values)| **values == wanted);
    if let (Some((first, _)), Some((other, _))) = (of(Values::Percent).next(), of(Values::Plain).next()) {
        let (first, other) = (first.description(), other.description());
        log.push(Warning::ScalesDiffer { percent: of(Values::Percent).count(), first, other });
    }
}

/// Warns of values that are percent by the file, and look like fractions.
fn doubt_percent(grid: &Grid, values: Values, log: &mut Log<'_>) {
    const LARGEST_FRACTION: f64 = 1.2;
    // A filter may let pass what is not seen.
    let max = grid.curves.iter().flat_map(|curve| &curve.values).copied().fold(f64::NEG_INFINITY, f64::max);
    if values == Values::Percent && max <= LARGEST_FRACTION && max > 0.0 {
        log.push(Warning::SmallPercent(short(max, 4)));
    }
}

/// Wavelengths at which reflectances are judged: outside, instruments are noisy.
pub(super) const VISIBLE_NM: std::ops::RangeInclusive<f64> = 400.0..=700.0;

/// Values of one curve that are enough for its quantiles.
const SAMPLE: usize = 4096;

/// Values above it are no fractions, apart from noise and fluorescence.
const ABOVE_FRACTIONS: f64 = 2.0;

#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) median: f64,
    /// The ninth decile, and at most the second largest value: one outlier does not move it.
    pub(super) high: f64,
    /// The most neighbors that are all larger than fractions are.
    run: usize,
}

#[derive(Debug)]
pub(super) struct Evidence {
    /// Those of each curve; `None` where it has no value.
    pub(super) curves: Vec<Option<Span>>,
    /// True if there are values elsewhere.
    within: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Looks {
    /// Fractions, but dark samples in percent look the same.
    Plain,
    Percent,
    Neither,
}

impl Span {
    /// The numbers of a curve at the wavelengths that `judged` takes.
    fn of(wavelengths: &[f64], values: &[f64], judged: impl Fn(&f64) -> bool) -> Option<Self> {
        let present = || {
            let pairs = wavelengths.iter().zip(values).filter(|(w, value)| judged(w) && !value.is_nan());
            pairs.map(|(_, value)| *value)
        };
        let (mut min, mut max, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0_usize);
        let (mut run, mut now) = (0, 0);
        for value in present() {
            (min, max, count) = (min.min(value), max.max(value), count + 1);
            now = if value > ABOVE_FRACTIONS { now + 1 } else { 0 };
            run = run.max(now);
        }
        let stride = (count / SAMPLE).max(1);
        let mut sample: Vec<f64> = present().step_by(stride).collect();
        sample.sort_unstable_by(f64::total_cmp);
        let last = sample.len().checked_sub(1)?;
        Some(Self { min, max, median: sample[sample.len() / 2], high: sample[last * 9 / 10], run })
    }

    /// Scale of fractions of light with such numbers. `largest` is what percent may reach: glossy and fluorescent samples
    /// pass 100.
    pub(super) fn looks(&self, largest: f64) -> Looks {
        // Percent of a filter that lets only a band pass: dark elsewhere, and far above one in the band.
        const BAND: usize = 3;
        const BAND_PEAK: f64 = 5.0;
        let mostly = self.median > ABOVE_FRACTIONS && self.high <= largest;
        let band = self.run >= BAND && self.max >= BAND_PEAK && self.max <= largest;
        if mostly || band {
            Looks::Percent
        } else if self.high <= ABOVE_FRACTIONS && self.median <= ABOVE_FRACTIONS && self.run < BAND {
            Looks::Plain
        } else {
            Looks::Neither
        }
    }
}

impl Evidence {
    pub(super) fn of(grid: &Grid) -> Self {
        let visible = |w: &f64| VISIBLE_NM.contains(w);
        let everywhere = !grid.wavelengths.iter().any(visible);
        let judged = |w: &f64| everywhere || visible(w);
        let spans = grid.curves.iter().map(|curve| Span::of(&grid.wavelengths, &curve.values, judged));
        Self { curves: spans.collect(), within: !everywhere && !grid.wavelengths.iter().all(visible) }
    }

    pub(super) fn range(&self) -> (f64, f64) {
        let all = self.curves.iter().flatten();
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), span| (min.min(span.min), max.max(span.max)))
    }

    pub(super) fn high(&self) -> f64 {
        self.curves.iter().flatten().map(|span| span.high).fold(f64::NEG_INFINITY, f64::max)
    }

    pub(super) fn words(&self) -> String {
        let within = if self.within { " from 400 to 700 nm" } else { "" };
        format!("Values reach {}{within}", short(self.range().1, 4))
    }
}
