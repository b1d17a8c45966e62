//! Lines with more points than columns of pixels.

use super::*;

const PLOT: Rect = Rect { min: Pos2::new(10.0, 20.0), max: Pos2::new(510.0, 220.0) };

fn line(count: usize, y: impl Fn(usize) -> f32) -> Vec<Pos2> {
    (0..count).map(|i| Pos2::new(10.0 + 500.0 * i as f32 / (count - 1) as f32, y(i))).collect()
}

fn noise(i: usize) -> f32 {
    20.0 + ((i as u32).wrapping_mul(2_654_435_761).rotate_left(11).wrapping_mul(2_246_822_519) >> 8) as f32
        / 16_777_216.0
        * 200.0
}

#[test]
fn a_line_of_few_points_or_one_that_turns_back_stays_as_it_is() {
    let few = line(1000, noise);
    assert_eq!(shortened(few.clone(), PLOT, 1.0), Drawn::Line(few));
    let mut turning = line(20_000, noise);
    turning.swap(5, 6);
    turning[7].x = 400.0;
    assert_eq!(shortened(turning.clone(), PLOT, 1.0), Drawn::Line(turning));
}

#[test]
fn a_smooth_line_keeps_its_extremes_in_four_points_a_column() {
    let points = line(100_000, |i| 120.0 + 90.0 * (i as f32 / 3000.0).sin());
    let Drawn::Line(drawn) = shortened(points.clone(), PLOT, 1.0) else { panic!("it is smooth") };
    assert!((500..=2010).contains(&drawn.len()), "{} points", drawn.len());
    let extremes =
        |points: &[Pos2]| points.iter().fold((f32::MAX, f32::MIN), |(low, high), at| (low.min(at.y), high.max(at.y)));
    assert_eq!(extremes(&drawn), extremes(&points));
    assert_eq!((drawn.first(), drawn.last()), (points.first(), points.last()));
    let reversed = points.into_iter().rev().collect();
    assert_eq!(shortened(reversed, PLOT, 1.0), Drawn::Line(drawn));
}

#[test]
fn noise_covers_each_pixel_once() {
    let points = line(4000, noise);
    let Drawn::Filled(columns) = shortened(points.clone(), PLOT, 1.0) else { panic!("it is restless") };
    let mesh = bars(&columns, PLOT, 1.0, 2.0, Color32::RED);
    assert!(mesh.vertices.len() <= 4 * 502, "{} vertices", mesh.vertices.len());
    // Every sample lies within its bar, and no two bars lie over each other.
    let bars: Vec<(f32, f32, f32)> =
        mesh.vertices.chunks(4).map(|bar| (bar[0].pos.x, bar[0].pos.y, bar[3].pos.y)).collect();
    assert!(bars.windows(2).all(|pair| pair[0].0 + 0.999 < pair[1].0));
    for at in points {
        assert!(
            bars.iter().any(|(x, top, bottom)| (*x..x + 1.001).contains(&at.x) && (*top..=*bottom).contains(&at.y)),
            "{at:?}"
        );
    }
}

#[test]
fn what_is_zoomed_out_of_sight_is_not_drawn() {
    let points: Vec<Pos2> = (0..100_000).map(|i| Pos2::new(i as f32, noise(i))).collect();
    let Drawn::Line(drawn) = shortened(points, PLOT, 1.0) else { panic!("there are few in sight") };
    assert_eq!(drawn.len(), 503);
}
