//! Instruction sets that draw a mesh.

use super::*;

#[test]
fn every_instruction_set_draws_the_same() {
    let size = RasterSize::new(16, 16);
    let rays = Rays { step: 0.1, left: -0.8, top: 0.8, columns: 16 };
    let place = |i: u32| DVec3::new((1.9 * f64::from(i)).sin(), (2.7 * f64::from(i)).cos(), 1.5 + f64::from(i % 5));
    let corners: Vec<Corner> = (0..60).map(|i| Corner::new(place(i), &rays)).collect();
    let triangles: Vec<[u32; 3]> = (0..58).map(|i| [i, i + 1, i + 2]).collect();
    let bins = [Bins::new(0, &triangles, &corners, size)];
    let scene = Scene { triangles: &triangles, corners: &corners, bins: &bins, rays: &rays };
    let drawn = |draw: fn(&mut Tile, usize, &Scene<'_>, [usize; 2])| {
        let (mut tile, mut hits) = (Tile::EMPTY, vec![Hit::NOTHING; 256]);
        draw(&mut tile, 0, &scene, [0; 2]);
        tile.store(&mut hits, 0, 16);
        hits
    };
    let chosen = drawn(draw);
    assert_eq!(chosen, drawn(draw_portable));
    assert!(chosen.iter().any(|hit| hit.is_some()));
}
