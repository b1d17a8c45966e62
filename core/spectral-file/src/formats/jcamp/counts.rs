//! Blocks of what a detector counted with a sample, with a reference, and in the dark.

use crate::decision::{Decided, Decision, Quantity, Role, Values};
use crate::formats::jcamp::block::Block;
use crate::header_terms;
use crate::options::ReadOptions;
use crate::warning::Warning;
use crate::watch::{Log, PlaceId};

/// A median that no percentage has.
const MOST_PERCENT: f64 = 200.0;

/// A reference this much above the sample is not in the same unit.
const MOST_TIMES: f64 = 4.0;

/// Measured object of a block, by the end of its title.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Source {
    Dark,
    Reference,
    /// Counts, but neither of these.
    Raw,
    Other,
}

impl Source {
    pub(super) fn of(title: &str) -> Self {
        let title = title.to_ascii_lowercase();
        let last = title.rsplit(':').next().unwrap_or_default();
        match () {
            () if last.contains("dark") => Self::Dark,
            () if last.contains("reference") => Self::Reference,
            () if last.contains("raw") => Self::Raw,
            () => Self::Other,
        }
    }
}

pub(super) struct Ratio {
    pub(super) role: Decided<Role>,
    pub(super) quantity: Decided<Quantity>,
    pub(super) note: Decision,
}

/// Finds out whether the only block beside raw ones holds counts too, whatever unit it announces, and forms
/// (sample − dark) / (reference − dark) where nothing else was chosen. What is missing leaves counts.
pub(super) fn settle(blocks: &mut [Block], options: &ReadOptions, log: &mut Log<'_>) -> Option<Ratio> {
    let one = |wanted: Source| {
        let mut found = blocks.iter().enumerate().filter(|(_, block)| Source::of(&block.title) == wanted);
        found.next().map(|(at, _)| at).filter(|_| found.next().is_none())
    };
    let (sample, dark, reference) = (one(Source::Other)?, one(Source::Dark), one(Source::Reference));
    let announced = blocks[sample].y_units.1.clone();
    let fraction = header_terms::role(&announced).filter(|role| role.is_fraction());
    if fraction.is_none() && !header_terms::says_counts(&announced) || !is_counts(blocks, sample, dark, reference) {
        return None;
    }
    for block in blocks.iter_mut() {
        "counts".clone_into(&mut block.y_units.1);
    }
    let (dark, reference) = (dark?, reference?);
    let alike = |other: usize| {
        let pairs = blocks[sample].samples.iter().zip(&blocks[other].samples);
        blocks[other].samples.len() == blocks[sample].samples.len()
            && pairs.into_iter().all(|(a, b)| a.wavelength == b.wavelength)
    };
    if options.part.is_some() || options.raw == Some(true) || !alike(dark) || !alike(reference) {
        return None;
    }
    let values: Vec<f64> = (0..blocks[sample].samples.len())
        .map(|at| {
            let [sample, dark, reference] = [sample, dark, reference].map(|block| blocks[block].samples[at].value);
            (sample - dark) / (reference - dark)
        })
        .collect();
    let block = &mut blocks[sample];
    for (sample, value) in block.samples.iter_mut().zip(values) {
        (sample.value, sample.place) = (value, PlaceId::default());
    }
    // Where reference and dark are equal, such as at a saturated pixel, there is no ratio.
    let undefined = || block.samples.iter().filter(|sample| !sample.value.is_finite()).map(|sample| sample.line);
    if let cells @ 1.. = undefined().count() {
        log.push(Warning::Gaps { cells, lines: undefined().collect(), sentinel: None });
    }
    block.samples.retain(|sample| sample.value.is_finite());
    block.y_units.1.clear();
    block.values = Some((block.y_units.0, Values::Plain));
    let why = format!("The blocks are counts of sample, reference and dark, whatever line {} says", block.y_units.0);
    let role = fraction.unwrap_or(Role::Transmittance);
    let quantity = if role == Role::Reflectance { Quantity::Reflectance } else { Quantity::Transmittance };
    let told = Decided::guess("(sample − dark) / (reference − dark)", why.clone());
    Some(Ratio {
        role: Decided::guess(role, &*why),
        quantity: Decided::guess(quantity, &*why),
        note: Decision::new("Blocks", &told),
    })
}

/// Returns whether the values of a block are counts: too large for percentages, or of the size of the raw ones.
fn is_counts(blocks: &[Block], sample: usize, dark: Option<usize>, reference: Option<usize>) -> bool {
    let median = |block: usize| {
        let mut values: Vec<f64> = blocks[block].samples.iter().map(|sample| sample.value).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    };
    let own = median(sample);
    let like_raw = || reference.is_some_and(|reference| median(reference) <= MOST_TIMES * own);
    let any = dark.is_some() || reference.is_some();
    any && (own > MOST_PERCENT || like_raw() && dark.is_none_or(|dark| own >= median(dark)))
}
