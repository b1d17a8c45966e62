//! Many samples at once: what takes no sum over wavelengths is done together, so that it vectorizes.

use super::Plan;
use super::table::{Around, Table};
use crate::math::exp::exp;
use crate::render::diffuse::{by_moments, by_nodes_into, rough_basis};
use crate::render::measure::MOMENTS;
use multiversion::multiversion;

/// Samples that are done together.
pub(in crate::render) const RUN: usize = 64;

/// From this β on moments give nothing: e^-60 of the peak, beyond which the polynomials overflow.
pub(super) const LAST_BETA: f64 = 60.0;

/// The places of a run of samples.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Places {
    pub(in crate::render) kappa: [f64; RUN],
    pub(in crate::render) beta: [f64; RUN],
    /// Samples wanted.
    pub(in crate::render) wanted: [bool; RUN],
    pub(in crate::render) count: usize,
}

impl Places {
    pub(in crate::render) const EMPTY: Self =
        Self { kappa: [1.0; RUN], beta: [0.0; RUN], wanted: [true; RUN], count: 0 };
}

/// Fast method of a sample.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Quick {
    Moments,
    Table,
    Dark,
    Neither,
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

impl Plan {
    /// The three channels of a run of samples.
    pub(in crate::render) fn run(&self, places: &Places, sums: &mut [[f64; RUN]; 3]) {
        let mut ways = [Quick::Dark; RUN];
        let table = self.table();
        let ([from, to], rough) = (self.held, self.rough.0);
        let [first, last] = table.map_or([f64::INFINITY, 0.0], Table::kappa);
        let mut slowly = false;
        for (i, way) in ways.iter_mut().enumerate().take(places.count) {
            let kappa = places.kappa[i];
            let by_moments = kappa >= rough && from <= kappa && kappa <= to;
            let by_table = first <= kappa && kappa <= last;
            let quick = if by_table { Quick::Table } else { Quick::Neither };
            let quick = if by_moments { Quick::Moments } else { quick };
            *way = if places.wanted[i] { quick } else { Quick::Dark };
            slowly |= *way == Quick::Neither;
        }
        quick(&self.moments, self.rough.1, table, places, &ways, sums);
        if slowly {
            self.slow(places, &ways, sums);
        }
    }

    /// Samples that neither moments nor table serve: together where wavelengths are in common.
    fn slow(&self, places: &Places, ways: &[Quick; RUN], sums: &mut [[f64; RUN]; 3]) {
        let (mut which, mut kappa, mut beta, mut count) = ([0; RUN], [0.0; RUN], [0.0; RUN], 0);
        let common = self.common();
        for i in (0..places.count).filter(|&i| ways[i] == Quick::Neither) {
            if common.is_some() && self.holds(places.kappa[i]) {
                (which[count], kappa[count], beta[count]) = (i, places.kappa[i], places.beta[i]);
                count += 1;
            } else {
                let slow = self.slowly(places.kappa[i], places.beta[i]);
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

/// Moments and table. Compiled for several instruction sets, the best chosen at run time; no operation is fused, so all of
/// them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn quick(
    moments: &[[f64; MOMENTS]; 3],
    orders: usize,
    table: Option<&Table>,
    places: &Places,
    ways: &[Quick; RUN],
    sums: &mut [[f64; RUN]; 3],
) {
    quick_portable(moments, orders, table, places, ways, sums);
}

/// Portable form for any processor.
#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn quick_portable(
    moments: &[[f64; MOMENTS]; 3],
    orders: usize,
    table: Option<&Table>,
    places: &Places,
    ways: &[Quick; RUN],
    sums: &mut [[f64; RUN]; 3],
) {
    if let Some(table) = table
        && ways.contains(&Quick::Table)
    {
        match table.degree() {
            3 => read::<4>(table, places, ways, sums),
            5 => read::<6>(table, places, ways, sums),
            7 => read::<8>(table, places, ways, sums),
            _ => read::<10>(table, places, ways, sums),
        }
    } else {
        *sums = [[0.0; RUN]; 3];
    }
    if ways.contains(&Quick::Moments) {
        for i in 0..RUN {
            let mut basis = rough_basis(places.kappa[i], places.beta[i].min(LAST_BETA));
            basis[orders..].fill(0.0);
            let found = by_moments(moments, &basis);
            if ways[i] == Quick::Moments {
                (sums[0][i], sums[1][i], sums[2][i]) = (found[0], found[1], found[2]);
            }
        }
    }
}

#[allow(clippy::inline_always, reason = "only inside the caller is it compiled for the caller's instruction set")]
#[inline(always)]
fn read<const N: usize>(table: &Table, places: &Places, ways: &[Quick; RUN], sums: &mut [[f64; RUN]; 3]) {
    let mut around = Around::<N>::NOTHING;
    table.around(&places.kappa, &places.beta, &mut around);
    let mut peaks = [0.0; RUN];
    for i in 0..RUN {
        // Written so that NaN is dark.
        let lit = ways[i] == Quick::Table && around.v[i] <= 1.0;
        let [peak, channels @ ..] = if lit { table.read(&around, i) } else { [0.0; 4] };
        peaks[i] = peak;
        (sums[0][i], sums[1][i], sums[2][i]) = (channels[0], channels[1], channels[2]);
    }
    for i in 0..RUN {
        let peak = exp(peaks[i]);
        for channel in sums.iter_mut() {
            channel[i] *= peak;
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
        let moments = [[1.0, 1.1, 1.3, 1.7], [0.4, 0.5, 0.7, 0.9], [-0.1, -0.2, -0.3, -0.4]];
        let kappa = [0.01, 64.0];
        for degree in [3, 5, 7, 9] {
            let (extent, nodes) = (Extent::new(kappa), vec![node(0.7), node(1.4)]);
            let surface = Surface::filled(&extent, degree, [12, 10], &nodes, Precision::Fine);
            let table = Table::new(&extent, surface, nodes);
            let mut places = Places::EMPTY;
            places.count = RUN;
            let mut ways = [Quick::Table; RUN];
            for (i, way) in ways.iter_mut().enumerate() {
                places.kappa[i] = 0.01 * 1.14_f64.powf(i as f64);
                places.beta[i] = 0.3 * ((i * 37) % RUN) as f64;
                if i % 7 == 6 {
                    *way = Quick::Moments;
                }
            }
            let (mut chosen, mut portable) = ([[0.0; RUN]; 3], [[0.0; RUN]; 3]);
            quick(&moments, 4, Some(&table), &places, &ways, &mut chosen);
            quick_portable(&moments, 4, Some(&table), &places, &ways, &mut portable);
            assert_eq!(chosen.map(|c| c.map(f64::to_bits)), portable.map(|c| c.map(f64::to_bits)), "{degree}");
            assert!(chosen[0].iter().all(|sum| sum.is_finite()) && chosen[0][0] > 0.0);
        }
    }
}
