//! Columns that state the uncertainty of others: found by their names and places, and followed through conversions.
//!
//! Stated numbers are k u, with u the standard uncertainty and k the coverage factor (JCGM 100:2008, 6.2), in the unit of the values,
//! in percent, or as a part of the value.

use std::collections::{BTreeMap, BTreeSet};

use crate::decimal::median;
use crate::decision::{Certainty, Decided, Decision, Effect, Role, Values};
use crate::grid::{Grid, RawCurve, Stated, StatedScale, retain};
use crate::header_terms;
use crate::uncertainty_terms::{self, Kind, Sense, Term};
use crate::warning::Warning;
use crate::watch::Log;

/// What a column with a name of an uncertainty is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Use {
    Curve,
    /// The uncertainty of the curve with this index.
    Of(usize),
    /// In no curve, for a reason.
    LeftOut(&'static str),
}

const NO_CURVE: &str = "nothing says of which curve";
const UNIT: &str = "its unit is not that of its curve";
const SECOND: &str = "its curve has another";
const NEGATIVE: &str = "it has numbers below zero";
const ZERO: &str = "it is zero everywhere";
/// Fields from which on names are those of a chart.
const FEWEST_FIELDS: usize = 10;

const SIDE: &str = "it is of one side only";
const FEW: &str = "most of its cells are empty";

/// Takes the columns that are uncertainties of other curves from the curves, and gives them to these.
pub(super) fn take(grid: &mut Grid, log: &mut Log<'_>) {
    let is_own = !grid.header.own.is_empty();
    let are_fields = grid.curves.iter().filter(|curve| is_field(curve)).nth(FEWEST_FIELDS).is_some();
    let term = |curve: &RawCurve| {
        if is_own {
            return grid
                .header
                .own
                .get(curve.column?.checked_sub(2)?)
                .copied()
                .flatten()
                .map(uncertainty_terms::expanded);
        }
        // `U1` beside `A1` and `Z20` is a field of a chart.
        let named = curve.named && grid.curves.len() > 1 && !(are_fields && is_field(curve));
        named.then(|| uncertainty_terms::term(&curve.name, &curve.label)).flatten()
    };
    let mut terms: Vec<Option<Term>> = grid.curves.iter().map(term).collect();
    for index in (1..terms.len()).filter(|_| !is_own) {
        terms[index] = terms[index].take().or_else(|| of_difference(&grid.curves, index));
    }
    if terms.iter().all(Option::is_none) {
        return say_doubtful(grid, log);
    }
    let uses = if is_own { own_uses(&grid.curves, &terms) } else { settle_uses(grid, &mut terms) };
    let mut marks = vec![false; grid.curves.len()];
    for (index, place) in uses.iter().enumerate() {
        match *place {
            Use::Curve => continue,
            Use::Of(curve) => {
                let Some(term) = &terms[index] else { continue };
                let stated = stated(grid, index, term);
                grid.curves[curve].uncertainty = Some(stated);
            }
            Use::LeftOut(why) => log.push(Warning::NotUncertainty { named: grid.curves[index].description(), why }),
        }
        marks[index] = true;
    }
    retain(&mut grid.curves, &marks);
    say_doubtful(grid, log);
}

/// Returns whether a name is a letter and a number, as those of fields are: `A1`, `Z20`.
fn is_field(curve: &RawCurve) -> bool {
    let number = curve.name.strip_prefix(|c: char| c.is_ascii_alphabetic()).filter(|number| !number.is_empty());
    number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
}

/// Names the curves that may be uncertainties, unless most are called so. The program's own tables say which are.
fn say_doubtful(grid: &Grid, log: &mut Log<'_>) {
    let is_own = !grid.header.own.is_empty();
    let is_doubtful = |curve: &&RawCurve| !is_own && curve.named && uncertainty_terms::has_usual_word(&curve.name);
    let mut doubtful = grid.curves.iter().filter(is_doubtful);
    if let Some(first) = doubtful.next().map(RawCurve::description) {
        let count = 1 + doubtful.count();
        if 2 * count <= grid.curves.len() {
            log.push(Warning::MaybeUncertainty { count, first });
        }
    }
}

/// The term of a column such as `dR`, `eR` or `d_refl` behind one of that name, or of that name with a number: `QE183`, `dQE`. Derivatives
/// are called so too, but have signs, or units of their own.
fn of_difference(curves: &[RawCurve], index: usize) -> Option<Term> {
    const NEAR: usize = 100;
    let own = &curves[index];
    let name = own.name.strip_prefix(['d', 'e'])?.trim_start_matches(['_', ' ']);
    let is_its = |curve: &&RawCurve| {
        let stem = || curve.name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches(['_', ' ']);
        curve.named && (curve.name == name || stem() == name)
    };
    let of = curves[..index].iter().rev().take(NEAR).find(is_its).filter(|_| own.named && !name.is_empty())?;
    let about = uncertainty_terms::without_mean(&uncertainty_terms::key(&of.name));
    let term =
        Term { kind: Kind::Unsaid, sense: Sense::Open, of: about, coverage: None, ..uncertainty_terms::expanded(1.0) };
    let sound = fault(&own.values, &of.values).is_none() && !is_too_large(&of.values, &own.values);
    Some(term).filter(|term| sound && !other_unit(of, own, term))
}

/// The uses that the heads of the program's own tables state: each uncertainty stands behind its curve.
fn own_uses(curves: &[RawCurve], terms: &[Option<Term>]) -> Vec<Use> {
    let of = |index: usize| {
        let before =
            index.checked_sub(1).filter(|before| curves[*before].column.map(|at| at + 1) == curves[index].column);
        before.map_or(Use::LeftOut(NO_CURVE), Use::Of)
    };
    terms.iter().enumerate().map(|(index, term)| term.as_ref().map_or(Use::Curve, |_| of(index))).collect()
}

fn settle_uses(grid: &Grid, terms: &mut [Option<Term>]) -> Vec<Use> {
    let curves = &grid.curves;
    let keys: Vec<String> = curves.iter().map(|curve| uncertainty_terms::key(&curve.name)).collect();
    let bare: Vec<String> = keys.iter().map(|key| uncertainty_terms::without_mean(key)).collect();
    let mut uses = vec![Use::Curve; curves.len()];
    let mut known: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
    for index in (0..curves.len()).filter(|index| terms[*index].is_none()) {
        known.entry(&bare[index]).or_default().insert(index);
    }
    let mut last = None;
    for index in 0..curves.len() {
        if let Some(term) = &terms[index] {
            // The nearest before it, else the first behind.
            let named = known.get(&*term.of).filter(|_| !term.of.is_empty());
            let named = named.and_then(|all| all.range(..index).next_back().or_else(|| all.first()));
            let is_about_last = || {
                last.is_some_and(|last: usize| {
                    // `SD 1, SD 2` behind two curves.
                    let counts =
                        |at: usize| terms.get(at).into_iter().flatten().any(|term| term.of == (at - last).to_string());
                    counts(index) && (counts(last + 2)) || is_about(term, &curves[last].label, &keys[last])
                }) || term.of.is_empty()
            };
            match named {
                Some(&curve) => uses[index] = Use::Of(curve),
                None if term.sense == Sense::Clear || is_about_last() => {}
                None => terms[index] = None,
            }
        }
        if terms[index].is_none() {
            known.entry(&bare[index]).or_default().insert(index);
            last = Some(index);
        }
    }
    place_unnamed(curves, &keys, terms, &mut uses);
    let names = |term: &Term, key: &str| !term.of.is_empty() && uncertainty_terms::without_mean(key) == term.of;
    let fits = |curve: usize, index: usize| !is_too_large(&curves[curve].values, &curves[index].values);
    let mut covered: Vec<bool> = terms.iter().map(Option::is_some).collect();
    for place in &uses {
        if let Use::Of(curve) = *place {
            covered[curve] = true;
        }
    }
    let all = !covered.contains(&false);
    for index in 0..curves.len() {
        let Some(term) = &terms[index] else { continue };
        let owner = if let Use::Of(curve) = uses[index] { curve } else { index };
        uses[index] = match (uses[index], fault(&curves[index].values, &curves[owner].values)) {
            // Short words are names too, such as SE of a direction: they need a table in which every curve has one.
            (Use::Of(curve), why) if term.sense < Sense::Clear && !names(term, &keys[curve]) => {
                let mean = uncertainty_terms::names_mean(&keys[curve]);
                if (all || mean || term.sense == Sense::Usual)
                    && fits(curve, index)
                    && (term.sense == Sense::Usual || why != Some(NEGATIVE))
                {
                    why.map_or(Use::Of(curve), Use::LeftOut)
                } else {
                    Use::Curve
                }
            }
            _ if is_one_sided(&curves[index].label) => Use::LeftOut(SIDE),
            (Use::Of(_), Some(NEGATIVE)) if term.sense < Sense::Clear => Use::Curve,
            (Use::Of(_) | Use::LeftOut(_), Some(why)) => Use::LeftOut(why),
            (Use::Curve, _) if term.sense == Sense::Clear => Use::LeftOut(NO_CURVE),
            (Use::Of(curve), None) if other_unit(&curves[curve], &curves[index], term) => Use::LeftOut(UNIT),
            (other, _) => other,
        };
    }
    keep_best(terms, &mut uses);
    // Nothing is left out for words that may mean something else, where no curve would be left.
    if uses.iter().all(|place| *place != Use::Curve) { vec![Use::Curve; curves.len()] } else { uses }
}

/// Leaves each curve the most telling of several uncertainties.
fn keep_best(terms: &[Option<Term>], uses: &mut [Use]) {
    let mut best: BTreeMap<usize, usize> = BTreeMap::new();
    for index in 0..uses.len() {
        let Use::Of(curve) = uses[index] else { continue };
        // Of the same in percent and in the unit of the values, the latter.
        let kind = |at: usize| terms[at].as_ref().map(|term| (term.kind, !(term.relative || term.percent)));
        if let Some(other) = best.insert(curve, index) {
            let worse = if kind(index) > kind(other) { other } else { index };
            best.insert(curve, if worse == index { other } else { index });
            uses[worse] = Use::LeftOut(SECOND);
        }
    }
}

/// Returns whether the words about a curve are those of one with a label and words of its own: its quantity, its last word or sign, or
/// beginnings of its words.
fn is_about(term: &Term, label: &str, key: &str) -> bool {
    let quantity = header_terms::quantity(&term.of);
    quantity.is_some() && quantity == header_terms::quantity(label)
        || !term.of.is_empty()
            && (key.split(' ').next_back() == Some(&*term.of)
                || term.of.split(' ').all(|part| part.len() > 1 && key.split(' ').any(|word| word.starts_with(part)))
                || label.to_lowercase().ends_with(&format!("({})", term.of)))
}

/// Places the columns whose names tell no curve: behind one curve, behind the mean of several, or as many as the curves before them.
fn place_unnamed(curves: &[RawCurve], keys: &[String], terms: &[Option<Term>], uses: &mut [Use]) {
    let is_curve = |at: usize| terms[at].is_none();
    let is_open = |at: usize, uses: &[Use]| terms[at].is_some() && uses[at] == Use::Curve;
    let mut start = 0;
    while start < curves.len() {
        let end = (start..curves.len()).find(|at| !is_curve(*at)).unwrap_or(curves.len());
        let next = (end..curves.len()).find(|at| is_curve(*at)).unwrap_or(curves.len());
        let open: Vec<usize> = (end..next).filter(|at| is_open(*at, uses)).collect();
        let kind = |at: &usize| {
            terms[*at].as_ref().map(|term| (term.kind, term.sense == Sense::Clear, term.relative || term.percent))
        };
        let alike = open.iter().all(|at| kind(at) == kind(&open[0]));
        let several = open.len() > 1 && alike;
        let is_meant = |at: &usize| end - start == 1 || uncertainty_terms::names_mean(&keys[*at]);
        if end - start == open.len() && (several || open.len() == 1) {
            open.iter().zip(start..end).for_each(|(at, curve)| uses[*at] = Use::Of(curve));
        } else if let Some(curve) = (start..end).rev().find(is_meant).filter(|_| !several) {
            for at in open {
                uses[at] = Use::Of(curve);
            }
        }
        start = next;
    }
}

/// Returns whether a name is that of an error up or down alone: `error of R (+)`.
fn is_one_sided(label: &str) -> bool {
    ["(+)", "(-)", "(−)"].iter().any(|sign| label.ends_with(sign))
}

/// Reason why numbers are no uncertainties.
fn fault(numbers: &[f64], values: &[f64]) -> Option<&'static str> {
    let stated = values.iter().filter(|value| !value.is_nan()).count();
    let present = || numbers.iter().filter(|number| !number.is_nan());
    match () {
        () if present().any(|number| *number < 0.0) => Some(NEGATIVE),
        () if present().count() * 2 < stated.max(1) => Some(FEW),
        () if present().all(|number| *number == 0.0) => Some(ZERO),
        () => None,
    }
}

/// Returns whether numbers are no uncertainties of values by their size: half of the values or more.
fn is_too_large(values: &[f64], numbers: &[f64]) -> bool {
    median(numbers.iter().copied()) >= 0.5 * median(values.iter().map(|value| value.abs()))
}

fn other_unit(curve: &RawCurve, column: &RawCurve, term: &Term) -> bool {
    let bare = |unit: &str| unit.to_lowercase().replace([' ', '^', '·', '*', '(', ')', '[', ']'], "").replace('²', "2");
    let units = curve.unit.as_deref().zip(column.unit.as_deref());
    !(term.percent || term.relative) && units.is_some_and(|(own, other)| bare(own) != bare(other))
}

/// The stated uncertainties of a column, with the coverage factor and how that is known.
fn stated(grid: &mut Grid, index: usize, term: &Term) -> Stated {
    let said = |k: f64| Decided::certain(k, "The header names it");
    let line = grid.header.coverage.map(|(line, k)| Decided::certain(k, format!("Line {line} says so")));
    let own = term.coverage.map(said);
    let level = || term.level.map(|k| Decided::guess(k, "By the level of confidence in the header"));
    let one = |what: &str| Decided::certain(1.0, format!("The header names a {what}"));
    let coverage = own
        .or_else(|| line.or_else(level).filter(|_| matches!(term.kind, Kind::Expanded | Kind::Unsaid)))
        .unwrap_or_else(|| match term.kind {
            Kind::Deviation => one("standard deviation"),
            Kind::Error => one("standard error"),
            Kind::Standard => one("standard uncertainty"),
            Kind::Expanded => {
                Decided::guess(2.0, "An expanded uncertainty without a coverage factor, taken as one of 95 %")
            }
            Kind::Unsaid => Decided::guess(1.0, "Nothing names a coverage factor"),
        });
    let scale = match (term.relative, term.percent) {
        (false, false) => StatedScale::Unit,
        (true, true) => StatedScale::Relative,
        (false, true) if term.kind <= Kind::Error => StatedScale::SamePercent,
        (false, true) => StatedScale::Percent,
        (true, false) => StatedScale::Part,
    };
    let column = &mut grid.curves[index];
    let numbers = std::mem::take(&mut column.values);
    Stated { numbers, named: column.description(), origin: column.origin, coverage, scale }
}

/// Brings stated uncertainties into the unit of the values as written, and reports them. `scales` are those of the values.
pub(super) fn settle(grid: &mut Grid, role: Role, scales: &[Values], log: &mut Log<'_>) -> Option<Decision> {
    let mut found: Vec<(&'static str, f64, bool)> = Vec::new();
    let mut first = None;
    for (curve, scale) in grid.curves.iter_mut().zip(scales) {
        let description = curve.description();
        let Some(stated) = &mut curve.uncertainty else { continue };
        let (how, is_guess) = stated.settle(&curve.values, *scale, role);
        if is_guess {
            log.push(Warning::UncertaintyScale { named: stated.named.clone(), how });
        }
        let k = &stated.coverage;
        found.push((how, k.value, is_guess || k.certainty == Certainty::Guess));
        first
            .get_or_insert_with(|| (format!("{} of {description}, k = {}{how}", stated.named, k.value), k.why.clone()));
    }
    let (words, why) = first?;
    let (count, guess) = (found.len(), found.iter().any(|(.., guess)| *guess));
    let same = found.iter().all(|(how, k, _)| (*how, *k) == (found[0].0, found[0].1));
    let others = match count {
        1 => String::new(),
        _ if same => format!("; {} more so", count - 1),
        _ => format!("; {} more, with other factors or scales", count - 1),
    };
    let certainty = if guess { Certainty::Guess } else { Certainty::Certain };
    let decided = Decided { value: format!("{words}{others}"), certainty, why };
    Some(Decision::new("Uncertainty", &decided).affecting(if guess { Effect::Data } else { Effect::Report }))
}

impl Stated {
    /// Brings the numbers into the unit of the values; returns how, in words, and whether that is a guess.
    fn settle(&mut self, values: &[f64], scale: Values, role: Role) -> (&'static str, bool) {
        const OF_VALUE: &str = ", in percent of the value";
        const POINTS: &str = ", in percent as the values are";
        const PART: &str = ", as a part of the value";
        let above = values.iter().zip(&self.numbers).filter(|(value, number)| **number > value.abs()).count();
        let (how, is_guess) = match self.scale {
            StatedScale::Unit => return ("", false),
            StatedScale::Relative => (OF_VALUE, false),
            StatedScale::SamePercent if scale == Values::Percent => (POINTS, false),
            // Uncertainties above the values themselves are of another scale.
            StatedScale::Percent if scale == Values::Percent && above * 4 < values.len() => (POINTS, true),
            StatedScale::SamePercent | StatedScale::Percent => (OF_VALUE, role.is_fraction()),
            StatedScale::Part if median(self.numbers.iter().copied()) > 1.0 => (OF_VALUE, true),
            StatedScale::Part => (PART, true),
        };
        if how != POINTS {
            let divisor = if how == PART { 1.0 } else { 100.0 };
            self.numbers.iter_mut().zip(values).for_each(|(number, value)| *number = *number * value.abs() / divisor);
        }
        (how, is_guess)
    }
}
