//! Patches of a chart in a picture, by the corners of its grid.

use chromascope_core::camera::chart_grid::{ChartGrid, ChartGridError, grids, named_places, region_mean};
use chromascope_math::random::SplitMix64;

/// A picture of 6 × 4 patches in perspective: patch i has (i + 1, 2(i + 1), 3(i + 1)), everything else −1.
fn picture(x: usize, y: usize) -> [f64; 3] {
    // The inverse of the projection x = 100 (u + 0.2 v) / w + 20, y = 80 v / w + 10, w = 1 + 0.3 v, by hand.
    let (x, y) = (x as f64 + 0.5, y as f64 + 0.5);
    let v = (y - 10.0) / (80.0 - 0.3 * (y - 10.0));
    let u = (x - 20.0) * (1.0 + 0.3 * v) / 100.0 - 0.2 * v;
    if !(0.0..1.0).contains(&u) || !(0.0..1.0).contains(&v) {
        return [-1.0; 3];
    }
    let index = (v * 4.0).floor() * 6.0 + (u * 6.0).floor() + 1.0;
    [index, 2.0 * index, 3.0 * index]
}

/// Corners of that picture's grid.
fn corners() -> [[f64; 2]; 4] {
    let at = |u: f64, v: f64| {
        let w = 1.0 + 0.3 * v;
        [100.0 * (u + 0.2 * v) / w + 20.0, 80.0 * v / w + 10.0]
    };
    [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]
}

#[test]
fn patches_in_perspective_are_averaged_exactly() {
    let grid = ChartGrid::new(corners(), 6, 4).unwrap();
    let means = grid.means([140, 90], 60.0, picture).unwrap();
    for (index, patch) in means.iter().enumerate() {
        let value = (index + 1) as f64;
        assert_eq!(patch.mean, [value, 2.0 * value, 3.0 * value], "patch {index}");
        assert_eq!(patch.clipped, [value, 2.0 * value, 3.0 * value].map(|v| v >= 60.0));
        assert!(patch.pixels > 20, "{}", patch.pixels);
    }
    // The chart upside down: corners named from its first patch on.
    let [a, b, c, d] = corners();
    let turned = ChartGrid::new([c, d, a, b], 6, 4).unwrap().means([140, 90], 1e9, picture).unwrap();
    assert_eq!(turned[0].mean[0], 24.0);
    assert_eq!(turned[23].mean[0], 1.0);
}

#[test]
fn corners_that_mark_no_grid_are_refused() {
    let [a, b, c, d] = corners();
    assert_eq!(ChartGrid::new([a, c, b, d], 6, 4), Err(ChartGridError::NotConvex));
    assert_eq!(ChartGrid::new([a, a, b, c], 6, 4), Err(ChartGridError::NotConvex));
    assert_eq!(ChartGrid::new([[f64::NAN; 2], b, c, d], 6, 4), Err(ChartGridError::NotConvex));
    assert_eq!(ChartGrid::new(corners(), 0, 4), Err(ChartGridError::Grid { columns: 0, rows: 4 }));
    let grid = ChartGrid::new(corners(), 6, 4).unwrap();
    assert_eq!(grid.means([100, 90], 1e9, picture), Err(ChartGridError::Outside { corner: 2, width: 100, height: 90 }));
    let tiny = ChartGrid::new([[0.0, 0.0], [9.0, 0.0], [9.0, 6.0], [0.0, 6.0]], 6, 4).unwrap();
    assert!(matches!(tiny.means([140, 90], 1e9, picture), Err(ChartGridError::TooSmall { .. })));
}

#[test]
fn a_region_is_averaged_within_its_bounds() {
    let pixel =
        |x: usize, y: usize| if (3..7).contains(&x) && (2..5).contains(&y) { [x as f64, 2.0, 9.0] } else { [-1.0; 3] };
    let found = region_mean([3, 2, 4, 3], [8, 6], 9.0, pixel).unwrap();
    assert_eq!((found.mean, found.pixels, found.clipped), ([4.5, 2.0, 9.0], 12, [false, false, true]));
    // Many pixels are taken an odd number apart: as many of each column of a mosaic.
    let mosaic =
        |x: usize, _: usize| if x.is_multiple_of(2) { [x as f64, f64::NAN, 1.0] } else { [f64::NAN, 7.0, 1.0] };
    let found = region_mean([0, 0, 1000, 1000], [1000, 1000], 1e9, mosaic).unwrap();
    assert!((found.mean[0] - 499.5).abs() < 3.0 && found.mean[1] == 7.0, "{:?}", found.mean);
    assert!((20_000..60_000).contains(&found.pixels), "{}", found.pixels);
    for region in [[5, 2, 4, 3], [3, 4, 4, 3], [0, 0, 1, 3], [usize::MAX, 0, 2, 2]] {
        let why = ChartGridError::Region { region, width: 8, height: 6 };
        assert_eq!(region_mean(region, [8, 6], 9.0, pixel), Err(why));
    }
}

#[test]
fn patches_have_noise_and_shares_of_clipped_pixels() {
    let square = [[0.0, 0.0], [120.0, 0.0], [120.0, 80.0], [0.0, 80.0]];
    let grid = ChartGrid::new(square, 6, 4).unwrap();
    // Twelve uniform values have a variance of 1; the light slopes by more than the noise.
    let value = |x: usize, y: usize| {
        let mut random = SplitMix64::new((y * 120 + x) as u64);
        let noise = (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
        [1000.0 + 2.0 * x as f64 + noise, if x == 5 && y == 5 { 9.0 } else { 1.0 }, f64::NAN]
    };
    let patches = grid.means([120, 80], 9.0, value).unwrap();
    for (k, patch) in patches.iter().enumerate() {
        assert_eq!(patch.pixels, 100);
        assert!((patch.mean[0] - 1000.0 - 2.0 * (20.0 * (k % 6) as f64 + 9.5)).abs() < 0.5, "{patch:?}");
        assert!((0.05..0.3).contains(&patch.noise[0]), "{patch:?}");
        assert!(patch.mean[1] == 1.0 && patch.mean[2].is_nan());
        assert_eq!((patch.clipped_share[1], patch.clipped[1]), if k == 0 { (0.01, true) } else { (0.0, false) });
    }
}

#[test]
fn names_place_patches_with_letters_for_columns_or_rows() {
    // The SG is listed column by column: A1 to A10, then B1.
    let sg: Vec<String> = ('A'..='N').flat_map(|letter| (1..=10).map(move |n| format!("{letter}{n}"))).collect();
    let names = || sg.iter().map(String::as_str);
    let places = named_places(names(), [14, 10]).unwrap();
    assert_eq!(places[..3], [0, 14, 28], "A1, A2 and A3 are below each other");
    assert_eq!([places[10], places[139]], [1, 139], "B1 is beside A1, N10 the last");
    assert_eq!(named_places(names(), [10, 14]).unwrap()[..3], [0, 1, 2], "turned, letters are rows");
    assert_eq!(grids(&names().collect::<Vec<_>>())[..2], [[14, 10], [10, 14]]);
    // The classic chart: four lettered rows, with leading zeros or without.
    let classic: Vec<String> = ('A'..='D').flat_map(|letter| (1..=6).map(move |n| format!("{letter}0{n}"))).collect();
    let in_order: Vec<usize> = (0..24).collect();
    assert_eq!(named_places(classic.iter().map(String::as_str), [6, 4]).unwrap(), in_order);
    for wrong in [&["A1", "A1"][..], &["A1", "white"], &["A1", "B2"], &["é1", "A1"], &["A0", "A18446744073709551615"]]
    {
        assert_eq!(named_places(wrong.iter().copied(), [2, 1]), None, "{wrong:?}");
    }
    assert_eq!(grids(&["dark skin"; 24])[0], [6, 4]);
    assert_eq!(grids(&["prime"; 13]), [[13, 1], [1, 13]]);
    assert!(grids(&[]).is_empty() && grids(&vec!["many"; 20_000]).is_empty());
}
