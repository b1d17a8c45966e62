//! Scale of the values of each curve.

use crate::decimal::short;
use crate::decision::{Certainty, Decided, Role, Values};
use crate::grid::{Grid, RawCurve};
use crate::header_terms;
use crate::options::ReadOptions;
use crate::scale::evidence::{Evidence, Looks, Span};
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
    if let Some((line, values)) = grid.header.values.filter(|(_, values)| fraction || is_power(*values)) {
        doubt_percent(values, evidence, log);
        return all(Decided::certain(values, format!("Line {line} says so")));
    }
    if let Some(headed) = by_headers(grid, role.value, evidence) {
        doubt_percent(headed.0.value, evidence, log);
        return headed;
    }
    if let Some((line, values)) = grid.header.clues.values.filter(|(_, values)| fraction || is_power(*values)) {
        doubt_percent(values, evidence, log);
        return all(Decided::certain(values, format!("Line {line} says so")));
    }
    if !fraction {
        return all(match role.certainty {
            Certainty::Open => Decided::open(Values::Plain, &*role.why),
            _ => Decided::certain(Values::Plain, "Only reflectances and transmittances are scaled"),
        });
    }
    if let Some(line) = grid.header.clues.absorbance.filter(|_| role.certainty != Certainty::Certain) {
        // No instrument measures larger ones.
        const LARGEST_ABSORBANCE: f64 = 10.0;
        let why = format!("Line {line} mentions absorbances");
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
    let columns = columns.into_iter().map(|values| values.unwrap_or(Values::Plain)).collect();
    Some((if assumed { Decided::guess(first, why) } else { Decided::certain(first, why) }, columns))
}

/// Scale that the header of a curve gives, as far as it suits the role.
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
    if percent == 0 && neither > 0 || percent > 0 && !trusted {
        let why = format!("{}, and nothing says whether they are percent", evidence.words());
        return (Decided::open(Values::Plain, why), same(Values::Plain));
    }
    if percent == 0 {
        return (Decided::guess(Values::Plain, why()), same(Values::Plain));
    }
    // Dark samples in percent look like fractions: where most curves are percent, all are.
    let others = if plain > percent { Values::Plain } else { Values::Percent };
    let columns: Vec<Values> = looks
        .iter()
        .map(|looks| match looks {
            Some(Looks::Percent) => Values::Percent,
            Some(Looks::Neither) => Values::Plain,
            Some(Looks::Plain) | None => others,
        })
        .collect();
    warn_of_others(grid, &columns, log);
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
fn doubt_percent(values: Values, evidence: &Evidence, log: &mut Log<'_>) {
    const LARGEST_FRACTION: f64 = 1.2;
    let (_, max) = evidence.range();
    if values == Values::Percent && max <= LARGEST_FRACTION && max > 0.0 {
        log.push(Warning::SmallPercent(short(max, 4)));
    }
}
