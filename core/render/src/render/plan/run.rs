//! Batch evaluation of samples: those without a sum over wavelengths are evaluated together, so that the loop
//! vectorizes.

use super::candidate::Explanation;
use super::domain::{Demand, is_lit};
use super::method::IntegrationMethod;
use super::nodes::{OwnRule, by_own};
use super::spline::BLOCK;
use super::table::{Around, Table};
use crate::reflectance::Precision;
use crate::render::diffuse::{FEW_MOMENTS, by_nodes, by_nodes_into, by_regimes, rough_basis_of};
use crate::render::measure::{MOMENTS, Node, SpectralWeights};
use chromascope_math::exp::exp;
use multiversion::multiversion;

/// Samples that are sorted by method together.
pub(in crate::render) const RUN: usize = 64;

/// From this β on moments give nothing: e^-60 of the peak, beyond which the polynomials overflow.
pub(super) const LAST_BETA: f64 = 60.0;

/// The places of a run of samples.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Places {
    pub(in crate::render) kappa: [f64; RUN],
    pub(in crate::render) beta: [f64; RUN],
    /// Samples wanted; the others had better be [`Self::UNWANTED`].
    pub(in crate::render) wanted: [bool; RUN],
    pub(in crate::render) count: usize,
}

impl Places {
    /// κ and β that take the least work.
    pub(in crate::render) const UNWANTED: (f64, f64) = (1e100, 0.0);
    pub(in crate::render) const EMPTY: Self =
        Self { kappa: [1.0; RUN], beta: [0.0; RUN], wanted: [true; RUN], count: 0 };
}

/// Fast method of a sample.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FastMethod {
    Moments,
    Table,
    Dark,
    Neither,
}

/// A method of integration with all that it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub(super) demand: Demand,
    /// Range of κ that is served.
    pub(super) held: [f64; 2],
    /// True if places below e^-30 of the peak are omitted.
    pub(super) leaves_dark: bool,
    /// κ from which on the first moments suffice, and their number; infinite if none are accurate enough.
    pub(super) rough: (f64, usize),
    /// κ from which on [`FEW_MOMENTS`] of these serve.
    pub(super) few: f64,
    pub(super) moments: [[f64; MOMENTS]; 3],
    pub(super) below: Below,
    /// All wavelengths, for κ that are not served.
    pub(super) every: Vec<Node>,
    pub(super) explanation: Explanation,
}

/// Method below the rough.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Below {
    Nothing,
    Table(Table),
    Shared(Vec<Node>, Precision),
    Own([OwnRule; 3], Precision),
    Every(Precision),
    Regimes,
}

pub(super) fn fill(plan: &Plan, points: &[[f64; 2]], sums: &mut [[f64; 3]]) {
    let (mut places, mut found) = (Places::EMPTY, [[0.0; RUN]; 3]);
    for (points, sums) in points.chunks(RUN).zip(sums.chunks_mut(RUN)) {
        places.count = points.len().min(sums.len());
        for (i, &[kappa, beta]) in points.iter().enumerate() {
            (places.kappa[i], places.beta[i]) = (kappa, beta.max(0.0));
        }
        plan.run(&places, &mut found);
        for (i, sum) in sums.iter_mut().enumerate().take(places.count) {
            *sum = [found[0][i], found[1][i], found[2][i]];
        }
    }
}

/// Samples of a run with one method, side by side.
struct Chosen {
    which: [u8; RUN],
    count: usize,
    kappa: [f64; RUN],
    beta: [f64; RUN],
}

impl Chosen {
    fn of(ways: &[FastMethod; RUN], method: FastMethod, places: &Places) -> Self {
        let mut chosen = Self { which: [0; RUN], count: 0, kappa: [1.0; RUN], beta: [0.0; RUN] };
        for (i, &way) in ways.iter().enumerate() {
            // The next one takes the place of one that does not count.
            let at = chosen.count;
            (chosen.which[at], chosen.kappa[at], chosen.beta[at]) = (i as u8, places.kappa[i], places.beta[i]);
            chosen.count += usize::from(way == method);
        }
        chosen
    }

    fn blocks(&self) -> usize {
        self.count.div_ceil(BLOCK)
    }

    fn put(&self, found: &[[f64; RUN]; 3], sums: &mut [[f64; RUN]; 3]) {
        for c in 0..3 {
            for (at, &i) in self.which[..self.count].iter().enumerate() {
                sums[c][usize::from(i)] = found[c][at];
            }
        }
    }
}

impl Plan {
    /// The demand it was made for.
    pub fn demand(&self) -> Demand {
        self.demand
    }

    /// Memory in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.every.as_slice()) + self.table().map_or(0, Table::bytes)
    }

    /// The methods and the reasons for them.
    pub fn explanation(&self) -> &Explanation {
        &self.explanation
    }

    /// The method that evaluates the integral at (κ, β).
    pub fn method(&self, kappa: f64, beta: f64) -> IntegrationMethod {
        let Explanation { rough, chosen, .. } = &self.explanation;
        let is_dark = self.leaves_dark && !is_lit(kappa, beta);
        match (rough, self.table()) {
            _ if kappa.is_nan() || kappa <= 0.0 || is_dark => IntegrationMethod::Nothing,
            _ if !self.holds(kappa) => IntegrationMethod::Every { precision: Precision::Full },
            (Some(rough), _) if kappa >= self.rough.0 => rough.method,
            (_, Some(table)) if !table.holds(kappa) => {
                IntegrationMethod::Shared { nodes: table.nodes().len(), precision: Precision::Full }
            }
            _ => chosen.method,
        }
    }

    /// The wavelengths that integrals below the rough rest on, in each sample or in the table; for rules of each channel's own, as
    /// many for all.
    pub fn nodes(&self, measure: &SpectralWeights) -> Vec<Node> {
        match &self.below {
            Below::Table(table) => table.nodes().to_vec(),
            Below::Shared(nodes, _) => nodes.clone(),
            Below::Own(rules, _) => measure.shared(rules.iter().map(Vec::len).sum()),
            Below::Nothing | Below::Every(_) | Below::Regimes => measure.dense().to_vec(),
        }
    }

    /// The three integrals. Outside the demanded κ by the sum over all wavelengths: exact and slow. 0 where κ is not above 0;
    /// a β below 0 counts as 0.
    pub fn at(&self, kappa: f64, beta: f64) -> [f64; 3] {
        let mut sums = [[0.0; 3]];
        self.fill(&[[kappa, beta]], &mut sums);
        sums[0]
    }

    /// The three integrals at each `[κ, β]`, as many as both have. Much faster than one by one.
    pub fn fill(&self, points: &[[f64; 2]], sums: &mut [[f64; 3]]) {
        fill(self, points, sums);
    }

    /// Number of samples that take about a millisecond: between two looks at a stop signal.
    pub(in crate::render) fn chunk(&self) -> usize {
        let samples = 1e6 / self.explanation.chosen.sample_ns.max(1.0);
        (samples as usize).next_multiple_of(RUN).clamp(RUN, 4096)
    }

    fn holds(&self, kappa: f64) -> bool {
        let [from, to] = self.held;
        from <= kappa && kappa <= to
    }

    /// The integral at a place that neither moments nor table serve.
    fn by_remaining_method(&self, kappa: f64, beta: f64) -> [f64; 3] {
        match &self.below {
            _ if !self.holds(kappa) => by_nodes(&self.every, kappa, beta, Precision::Full),
            Below::Own(rules, precision) => by_own(rules, kappa, beta, *precision),
            Below::Regimes => by_regimes(&self.every, kappa, beta),
            _ => {
                let (nodes, precision) = self.common().unwrap_or((&self.every, Precision::Full));
                by_nodes(nodes, kappa, beta, precision)
            }
        }
    }

    /// The wavelengths of such an integral, where all channels have them in common.
    fn common(&self) -> Option<(&[Node], Precision)> {
        match &self.below {
            Below::Nothing => Some((&self.every, Precision::Full)),
            Below::Table(table) => Some((table.nodes(), Precision::Full)),
            Below::Shared(nodes, precision) => Some((nodes, *precision)),
            Below::Own(..) | Below::Regimes => None,
            Below::Every(precision) => Some((&self.every, *precision)),
        }
    }

    fn table(&self) -> Option<&Table> {
        if let Below::Table(table) = &self.below { Some(table) } else { None }
    }

    /// The three channels of the wanted samples of a run; those of others are left with any value.
    pub(in crate::render) fn run(&self, places: &Places, sums: &mut [[f64; RUN]; 3]) {
        let ([from, to], (rough, orders), moments) = (self.held, self.rough, (&self.moments, self.few));
        let is_rough = |i: usize| rough.max(from) <= places.kappa[i] && places.kappa[i] <= to;
        if places.count == RUN && (0..RUN).fold(true, |all, i| all & (!places.wanted[i] | is_rough(i))) {
            by_moments(moments, orders, (&places.kappa, &places.beta, RUN / BLOCK), sums);
            return;
        }
        let mut ways = [FastMethod::Dark; RUN];
        let table = self.table();
        let [first, last] = table.map_or([f64::INFINITY, 0.0], Table::kappa);
        let mut counts = [0_usize; 4];
        for (i, way) in ways.iter_mut().enumerate().take(places.count) {
            let kappa = places.kappa[i];
            let by_table = first <= kappa && kappa <= last;
            let quick = if by_table { FastMethod::Table } else { FastMethod::Neither };
            let quick = if is_rough(i) { FastMethod::Moments } else { quick };
            *way = if places.wanted[i] { quick } else { FastMethod::Dark };
            counts[*way as usize] += 1;
        }
        let mut found = [[0.0; RUN]; 3];
        if counts[FastMethod::Moments as usize] > 0 {
            let chosen = Chosen::of(&ways, FastMethod::Moments, places);
            by_moments(moments, orders, (&chosen.kappa, &chosen.beta, chosen.blocks()), &mut found);
            chosen.put(&found, sums);
        }
        if let (Some(table), 1..) = (table, counts[FastMethod::Table as usize]) {
            let chosen = Chosen::of(&ways, FastMethod::Table, places);
            by_table(table, &chosen, &mut found);
            chosen.put(&found, sums);
        }
        if counts[FastMethod::Neither as usize] > 0 {
            self.slow(places, &Chosen::of(&ways, FastMethod::Neither, places), sums);
        }
    }

    /// Samples that neither moments nor table serve: together where wavelengths are in common.
    fn slow(&self, places: &Places, chosen: &Chosen, sums: &mut [[f64; RUN]; 3]) {
        let (mut which, mut kappa, mut beta, mut count) = ([0; RUN], [0.0; RUN], [0.0; RUN], 0);
        let common = self.common();
        for i in chosen.which[..chosen.count].iter().map(|&i| usize::from(i)) {
            if common.is_some() && self.holds(places.kappa[i]) {
                (which[count], kappa[count], beta[count]) = (i, places.kappa[i], places.beta[i]);
                count += 1;
            } else {
                let slow = self.by_remaining_method(places.kappa[i], places.beta[i]);
                (sums[0][i], sums[1][i], sums[2][i]) = (slow[0], slow[1], slow[2]);
            }
        }
        let Some((nodes, precision)) = common else { return };
        let mut answers = [[0.0; 3]; RUN];
        by_nodes_into(nodes, &kappa[..count], &beta, precision, &mut answers);
        for (&i, slow) in which[..count].iter().zip(answers) {
            (sums[0][i], sums[1][i], sums[2][i]) = (slow[0], slow[1], slow[2]);
        }
    }
}

/// Moments in blocks, with the κ from which on few of them suffice. Compiled for several instruction sets, the best chosen at run
/// time; no operation is fused, so that all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn by_moments(
    moments: (&[[f64; MOMENTS]; 3], f64),
    orders: usize,
    places: (&[f64; RUN], &[f64; RUN], usize),
    sums: &mut [[f64; RUN]; 3],
) {
    by_moments_portable(moments, orders, places, sums);
}

/// Table, compiled as moments are.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn by_table(table: &Table, chosen: &Chosen, sums: &mut [[f64; RUN]; 3]) {
    by_table_portable(table, chosen, sums);
}

/// Portable form for any processor.
#[inline(always)]
fn by_moments_portable(
    (moments, few): (&[[f64; MOMENTS]; 3], f64),
    orders: usize,
    (kappa, beta, blocks): (&[f64; RUN], &[f64; RUN], usize),
    sums: &mut [[f64; RUN]; 3],
) {
    let mut kept = *moments;
    for moments in &mut kept {
        moments[orders..].fill(0.0);
    }
    for first in (0..RUN).step_by(BLOCK).take(blocks) {
        let (mut k, mut b) = ([0.0; BLOCK], [0.0; BLOCK]);
        let (kappa, beta) = (&kappa[first..first + BLOCK], &beta[first..first + BLOCK]);
        let mut least = f64::INFINITY;
        for i in 0..BLOCK {
            (k[i], b[i]) = (kappa[i], beta[i]);
            least = least.min(k[i]);
        }
        // To what takes few, the others add nothing.
        let found = if orders <= FEW_MOMENTS || least >= few {
            block::<FEW_MOMENTS>(&kept, f64::INFINITY, &k, &b)
        } else {
            block::<MOMENTS>(&kept, few, &k, &b)
        };
        for c in 0..3 {
            if let Some(sums) = sums[c][first..].first_chunk_mut() {
                *sums = found[c];
            }
        }
    }
}

#[inline(always)]
fn block<const N: usize>(
    moments: &[[f64; MOMENTS]; 3],
    few: f64,
    kappa: &[f64; BLOCK],
    beta: &[f64; BLOCK],
) -> [[f64; BLOCK]; 3] {
    let mut found = [[0.0; BLOCK]; 3];
    for i in 0..BLOCK {
        let mut basis = rough_basis_of::<N>(kappa[i], beta[i].min(LAST_BETA));
        let rest = if kappa[i] >= few { 0.0 } else { 1.0 };
        for k in FEW_MOMENTS..N {
            basis[k] *= rest;
        }
        for c in 0..3 {
            let mut sum = 0.0;
            for k in 0..N {
                sum += moments[c][k] * basis[k];
            }
            found[c][i] = sum;
        }
    }
    found
}

/// Portable form for any processor.
#[inline(always)]
fn by_table_portable(table: &Table, chosen: &Chosen, sums: &mut [[f64; RUN]; 3]) {
    match table.degree() {
        3 => read::<4>(table, chosen, sums),
        5 => read::<6>(table, chosen, sums),
        7 => read::<8>(table, chosen, sums),
        _ => read::<10>(table, chosen, sums),
    }
}

#[inline(always)]
fn read<const N: usize>(table: &Table, chosen: &Chosen, sums: &mut [[f64; RUN]; 3]) {
    let mut around = Around::<N>::NOTHING;
    for first in (0..RUN).step_by(BLOCK).take(chosen.blocks()) {
        let (mut kappa, mut beta, mut peaks) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        for i in 0..BLOCK {
            (kappa[i], beta[i]) = (chosen.kappa[first + i], chosen.beta[first + i]);
        }
        table.around(&kappa, &beta, &mut around);
        for i in 0..BLOCK.min(chosen.count - first) {
            // Written so that NaN is dark.
            let lit = around.v[i] <= 1.0;
            let [peak, channels @ ..] = if lit { table.read(&around, i) } else { [0.0; 4] };
            peaks[i] = peak;
            for c in 0..3 {
                sums[c][first + i] = channels[c];
            }
        }
        for peak in &mut peaks {
            *peak = exp(*peak);
        }
        for c in 0..3 {
            let sums = &mut sums[c][first..first + BLOCK];
            for i in 0..BLOCK {
                sums[i] *= peaks[i];
            }
        }
    }
}

impl Below {
    pub(super) fn method(&self) -> IntegrationMethod {
        match self {
            Self::Nothing => IntegrationMethod::Nothing,
            Self::Table(table) => table.method(),
            Self::Shared(nodes, precision) => IntegrationMethod::Shared { nodes: nodes.len(), precision: *precision },
            Self::Own(rules, precision) => {
                IntegrationMethod::Own { nodes: rules.iter().map(Vec::len).sum(), precision: *precision }
            }
            Self::Every(precision) => IntegrationMethod::Every { precision: *precision },
            Self::Regimes => IntegrationMethod::Regimes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::extent::Extent;
    use super::super::surface::Surface;
    use super::*;
    use crate::reflectance::Precision;
    use crate::render::measure::Node;

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let node = |scale: f64| Node {
            wavelength_nm: 550.0 / scale.sqrt(),
            scale,
            weights: [0.3 * scale, 0.4, -0.1 / scale],
            reference: 0.5,
        };
        let moments = [1.0, 0.4, -0.1].map(|m: f64| std::array::from_fn(|k| m * 1.1_f64.powf(k as f64)));
        let kappa = [0.01, 64.0];
        for degree in [3, 5, 7, 9] {
            let (extent, nodes) = (Extent::new(kappa), vec![node(0.7), node(1.4)]);
            let surface = Surface::filled(&extent, degree, [12, 10], &nodes, Precision::Fine);
            let table = Table::new(&extent, surface, nodes);
            let mut places = Places::EMPTY;
            places.count = RUN;
            let mut ways = [FastMethod::Table; RUN];
            for (i, way) in ways.iter_mut().enumerate() {
                places.kappa[i] = 0.01 * 1.14_f64.powf(i as f64);
                places.beta[i] = 0.3 * ((i * 37) % RUN) as f64;
                if i % 7 == 6 {
                    *way = FastMethod::Moments;
                }
            }
            let (mut chosen, mut portable) = ([[0.0; RUN]; 3], [[0.0; RUN]; 3]);
            let (rough, tabulated) = ((&places.kappa, &places.beta, 2), Chosen::of(&ways, FastMethod::Table, &places));
            by_table(&table, &tabulated, &mut chosen);
            by_table_portable(&table, &tabulated, &mut portable);
            by_moments((&moments, 1.0), MOMENTS, rough, &mut chosen);
            by_moments_portable((&moments, 1.0), MOMENTS, rough, &mut portable);
            assert_eq!(chosen.map(|c| c.map(f64::to_bits)), portable.map(|c| c.map(f64::to_bits)), "{degree}");
            assert!(chosen[0].iter().all(|sum| sum.is_finite()) && chosen[0][0] > 0.0);
        }
    }
}
