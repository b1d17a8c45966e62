//! Instruction sets that run a plan.

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
