//! A chart found in rendered photographs.

use chromascope_core::camera::chart_grid::ChartGrid;
use chromascope_core::camera::chart_search::{FoundChart, find_chart, refine_chart};
use chromascope_core::data;
use chromascope_math::random::SplitMix64;
use glam::{DMat3, DVec2, DVec3};

/// Raw values of the chart's patches, relative to the brightest of each channel.
fn raw(camera: &str, light: &str) -> Vec<DVec3> {
    let camera = data::camera(camera).unwrap();
    let light = data::illuminant(light).unwrap();
    let chart = data::chart("ColorChecker 24 (BabelColor average)").unwrap();
    let signal = |reflectance| DVec3::from_array(camera.integrate(light.times(reflectance).values()));
    let colors: Vec<DVec3> = chart.patches().iter().map(|patch| signal(&patch.grid)).collect();
    let most = colors.iter().fold(DVec3::ZERO, |most, color| most.max(*color));
    colors.iter().map(|color| color / most).collect()
}

fn expected() -> Vec<[f64; 3]> {
    raw("Canon EOS 5D Mark II", "D65").iter().map(glam::DVec3::to_array).collect()
}

/// A rendered photograph: a mosaic of pixels, four of them for each of the preview's.
struct Photo {
    size: [usize; 2],
    picture_from_chart: DMat3,
    colors: Vec<DVec3>,
    fill: f64,
}

impl Photo {
    /// The chart's 6 × 4 cells of some pixels each, turned about the picture's middle and tilted.
    fn new(pixels: f64, degrees: f64, tilt: [f64; 2], fill: f64) -> Self {
        let size = [1600, 1200];
        let middle = DMat3::from_translation(DVec2::from_array(size.map(|n| n as f64 / 2.0)));
        let perspective =
            DMat3::from_cols(DVec3::new(1.0, 0.0, tilt[0]), DVec3::new(0.0, 1.0, tilt[1]), DVec3::new(0.0, 0.0, 1.0));
        let turned = DMat3::from_scale_angle_translation(DVec2::splat(pixels), degrees.to_radians(), DVec2::ZERO);
        let centered = DMat3::from_translation(DVec2::new(-3.0, -2.0));
        let gains = DVec3::new(0.35, 0.7, 0.5);
        let colors = raw("Nikon D70 (A.M.P.A.S.)", "D50").iter().map(|color| color * gains).collect();
        Self { size, picture_from_chart: middle * perspective * turned * centered, colors, fill }
    }

    fn corners(&self) -> [DVec2; 4] {
        [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]].map(|corner| {
            let place = self.picture_from_chart * DVec2::from_array(corner).extend(1.0);
            place.truncate() / place.z
        })
    }

    /// Light of 20 % slope, by the picture's place.
    fn light(&self, x: f64) -> f64 {
        0.9 + 0.2 * x / self.size[0] as f64
    }

    /// Signal without noise: the chart in its black frame, on a wall with stripes and tiles.
    fn signal(&self, chart_from_picture: DMat3, x: f64, y: f64) -> DVec3 {
        let chart = chart_from_picture * DVec3::new(x, y, 1.0);
        let chart = chart.truncate() / chart.z;
        let frame = DVec3::new(0.012, 0.024, 0.018);
        let on_frame = chart.cmpge(DVec2::splat(-0.4)).all() && chart.cmple(DVec2::new(6.4, 4.4)).all();
        let on_grid = chart.cmpge(DVec2::ZERO).all() && chart.cmplt(DVec2::new(6.0, 4.0)).all();
        let color = if on_grid {
            let off = (chart - chart.floor() - 0.5).abs().max_element();
            let patch = chart.y as usize * 6 + chart.x as usize;
            if off < self.fill / 2.0 { self.colors[patch] } else { frame }
        } else if on_frame {
            frame
        } else {
            let tile = (x / 130.0).floor() * 7.0 + (y / 110.0).floor() * 5.0;
            let tone = if y < 300.0 { 0.2 + 0.1 * (tile % 3.0) } else { 0.4 + 0.05 * (x / 23.0).sin().signum() };
            DVec3::new(0.3, 0.6, 0.5) * tone
        };
        color * self.light(x)
    }

    /// Pixels with 2 % noise; a mosaic's lacking channels are NaN.
    fn pixels(&self) -> Vec<[f64; 3]> {
        let chart_from_picture = self.picture_from_chart.inverse();
        let mut random = SplitMix64::new(7);
        let pixel = |index: usize| {
            let (x, y) = (index % self.size[0], index / self.size[0]);
            let channel = [[0, 1], [1, 2]][y % 2][x % 2];
            let signal = self.signal(chart_from_picture, x as f64 + 0.5, y as f64 + 0.5)[channel];
            let noise: f64 = (0..3).map(|_| random.unit() - 0.5).sum::<f64>() * 2.0;
            let mut pixel = [f64::NAN; 3];
            pixel[channel] = signal + noise * (4e-6 + 2e-4 * signal).sqrt();
            pixel
        };
        (0..self.size[0] * self.size[1]).map(pixel).collect()
    }

    fn preview(&self, pixels: &[[f64; 3]]) -> ([usize; 2], Vec<[f32; 3]>) {
        let size = self.size.map(|n| n / 2);
        let cell = |index: usize| {
            let at = index / size[0] * 2 * self.size[0] + index % size[0] * 2;
            let green = f64::midpoint(pixels[at + 1][1], pixels[at + self.size[0]][1]);
            [pixels[at][0], green, pixels[at + self.size[0] + 1][2]].map(|value| value as f32)
        };
        (size, (0..size[0] * size[1]).map(cell).collect())
    }
}

fn error(found: &FoundChart, truth: [DVec2; 4]) -> f64 {
    let distance = |(corner, truth): (&[f64; 2], DVec2)| DVec2::from_array(*corner).distance(truth);
    found.corners.iter().zip(truth).map(distance).fold(0.0, f64::max)
}

#[test]
fn a_chart_is_found_and_measured_in_any_pose() {
    let poses = [
        (200.0, 0.0, [0.0, 0.0], 0.9),
        (70.0, 180.0, [0.0, 2e-4], 0.9),
        (130.0, 97.0, [-3e-4, 1e-4], 0.83),
        (110.0, -38.0, [2e-4, 2e-4], 0.92),
        (120.0, 215.0, [0.0, 3e-4], 1.0),
    ];
    for (pixels, degrees, tilt, fill) in poses {
        let photo = Photo::new(pixels, degrees, tilt, fill);
        let pose = format!("{pixels} {degrees} {tilt:?} {fill}");
        let mosaic = photo.pixels();
        let (size, preview) = photo.preview(&mosaic);
        let mut found = find_chart(size, &preview, &expected()).unwrap_or_else(|| panic!("{pose}"));
        assert!(error(&found, photo.corners().map(|corner| corner / 2.0)) < 1.5, "{pose}: {found:?}");
        found.corners = found.corners.map(|corner| corner.map(|x| 2.0 * x));
        let pixel = |x: usize, y: usize| mosaic[y * photo.size[0] + x];
        let refined = refine_chart(&found, photo.size, pixel).unwrap_or_else(|| panic!("{pose}"));
        assert!(error(&refined, photo.corners()) < 1.5, "{pose}: {refined:?}");
        assert!(refined.fill.iter().all(|found| (found - fill).abs() < 0.02), "{pose}: {refined:?}");
        let patches = ChartGrid::new(refined.corners, 6, 4).unwrap().means(photo.size, 1.0, pixel).unwrap();
        for (k, patch) in patches.iter().enumerate() {
            let middle = DVec2::new((k % 6) as f64 + 0.5, (k / 6) as f64 + 0.5);
            let place = photo.picture_from_chart * middle.extend(1.0);
            for c in 0..3 {
                let truth = photo.colors[k][c] * photo.light(place.x / place.z);
                let off = (patch.mean[c] - truth).abs();
                assert!(off < 0.005 * truth + 4.0 * patch.noise[c], "{pose}: patch {k}: {patch:?}, {truth}");
                assert!(patch.noise[c] < 0.01 * truth.max(0.1), "{pose}: patch {k}: {patch:?}");
            }
        }
    }
}

#[test]
fn what_is_no_chart_is_not_found() {
    let mut photo = Photo::new(130.0, 20.0, [1e-4, 0.0], 0.9);
    let found = |photo: &Photo| {
        let (size, preview) = photo.preview(&photo.pixels());
        find_chart(size, &preview, &expected())
    };
    assert!(found(&photo).is_some());
    // A grid of the same colors in another order, and of grays.
    photo.colors = (0..24).map(|k| photo.colors[k * 7 % 24]).collect();
    assert_eq!(found(&photo), None);
    photo.colors = (0..24).map(|k| DVec3::splat(0.2 + 0.02 * f64::from(k))).collect();
    assert_eq!(found(&photo), None);
    photo.picture_from_chart = DMat3::from_translation(DVec2::splat(1e5));
    assert_eq!(found(&photo), None);
    for size in [[0, 0], [5, 5], [usize::MAX, 2], [40, 40]] {
        assert_eq!(find_chart(size, &vec![[f32::NAN; 3]; 1600], &expected()), None);
    }
}
