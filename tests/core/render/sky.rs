//! Light of a uniform sky, against quadratures that share no code with it, and what it costs where there is none.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use chromascope_core::query::render::MeshQuery;
use chromascope_core::query::render::picture::Pictures;
use chromascope_core::query::{Direct, Shared};
use chromascope_core::reflectance::{
    Geometry, Normalization, Surface, directional_hemispherical, factors, hemispherical_directional,
};
use chromascope_core::render::sky::{SkyVisibility, visible_share};
use chromascope_core::render::{Quality, RasterSize, Shadows, Stop};
use chromascope_mesh::{Mesh, ShadowTree};
use glam::{DVec3, Vec3};

use super::fixture::{Counting, FrameCase};

/// `∫ π f cos θi dωi / π` over the part of the sky that a place with this normal sees, by midpoints in height and azimuth.
fn by_midpoints(surface: &Surface, reading: Normalization, normal: DVec3, to_viewer: DVec3, nm: f64) -> f64 {
    const HEIGHTS: u32 = 300;
    const AZIMUTHS: u32 = 600;
    let mut sum = 0.0;
    for i in 0..HEIGHTS {
        // Equal steps of y are equal solid angles.
        let y = (f64::from(i) + 0.5) / f64::from(HEIGHTS);
        let r = (1.0 - y * y).sqrt();
        for j in 0..AZIMUTHS {
            let (sin, cos) = (TAU * (f64::from(j) + 0.5) / f64::from(AZIMUTHS)).sin_cos();
            let to_light = DVec3::new(r * cos, y, r * sin);
            if to_light.dot(normal) > 0.0 {
                let geometry = Geometry::from_directions(to_light, to_viewer, normal);
                let [diffuse, _] = factors(surface, &geometry, nm, reading, 0.0);
                sum += diffuse * to_light.dot(normal);
            }
        }
    }
    sum * TAU / f64::from(HEIGHTS * AZIMUTHS) / PI
}

fn surface(sigma_m: f64, tau_m: f64) -> Surface {
    Surface::new(sigma_m, tau_m, 50e-6, 50e-6, 1.4).unwrap()
}

#[test]
fn the_reflectance_under_light_from_everywhere_is_that_of_a_plain_quadrature() {
    for (sigma, tau) in [(5e-6, 10e-6), (0.3e-6, 2e-6), (0.1e-6, 1e-6)] {
        for reading in [Normalization::Radiometric, Normalization::Microfacet] {
            for (degrees, nm) in [(0.0_f64, 550.0), (40.0, 430.0), (70.0, 700.0)] {
                let theta = degrees.to_radians();
                let to_viewer = DVec3::new(theta.sin(), theta.cos(), 0.0);
                let expected = by_midpoints(&surface(sigma, tau), reading, DVec3::Y, to_viewer, nm);
                let got = hemispherical_directional(&surface(sigma, tau), reading, theta, nm).diffuse;
                assert!((got / expected - 1.0).abs() < 6e-3, "{sigma} {reading:?} {degrees}: {got} for {expected}");
            }
        }
    }
}

/// The same scene without sky, and with one.
fn taken(service: &FrameCase, sky: f64) -> [Pictures; 2] {
    let without = FrameCase { sky: None, ..service.clone() };
    [without.take(&Direct), FrameCase { sky: Some(sky), ..without }.take(&Direct)]
}

/// The sky's part of the first sensor's signals at every sample that sees the mesh, with the sample's place in the picture.
fn sky_part(service: &FrameCase, sky: f64) -> Vec<(u32, [f64; 3])> {
    let [without, with] = taken(service, sky);
    let [plain, image] = [&without, &with].map(|pictures| pictures.images[0].clone().unwrap());
    assert_eq!(image.placed().samples(), image.placed().seen(), "the sky lights whatever is seen");
    let direct = |sample: u32| {
        let at = plain.placed().samples().binary_search(&sample).ok();
        at.map_or([0.0; 3], |at| plain.signals()[at])
    };
    let part = |(&sample, signal): (&u32, &[f32; 3])| {
        let direct = direct(sample);
        (sample, std::array::from_fn(|c| f64::from(signal[c]) - f64::from(direct[c])))
    };
    image.placed().samples().iter().zip(image.signals()).map(part).collect()
}

/// Normal of a unit sphere, direction to the viewer, and cos⁴α of a sample.
fn on_sphere(service: &FrameCase, sample: u32) -> (DVec3, DVec3, f64) {
    let question = service.question();
    let visibility = &question.shading.geometry.visibility;
    let mesh = chromascope_mesh::shapes::sphere(2_000);
    let eye = visibility.viewpoint.eye(mesh.bounds());
    let columns = service.size.columns();
    let step = 2.0 * eye.half_height / service.size.rows() as f64;
    let [x, y] = [sample as usize % columns, sample as usize / columns].map(|at| at as f64 + 0.5);
    let ahead = DVec3::new(step * (x - columns as f64 / 2.0), eye.half_height - step * y, 1.0).normalize();
    let ray = eye.world_from_view * DVec3::new(ahead.x, ahead.y, -ahead.z);
    let from = eye.position - eye.center;
    let (b, c) = (from.dot(ray), from.length_squared() - eye.radius * eye.radius);
    let t = -b - (b * b - c).max(0.0).sqrt();
    ((from + ray * t).normalize(), -ray, ahead.z.powi(4))
}

#[test]
fn a_sphere_under_the_sky_is_as_a_quadrature_over_all_directions_makes_it() {
    const QUALITIES: [Quality; 3] = [Quality::Fine, Quality::Full, Quality::Preview];
    for (sigma_m, tau_m, reading, allowed) in [
        (5e-6, 10e-6, Normalization::Lambertian, [0.0015, 0.02, 0.04]),
        (5e-6, 10e-6, Normalization::Radiometric, [0.007, 0.009, 0.045]),
        // Returns up to 1.4 of the light at grazing angles.
        (5e-6, 10e-6, Normalization::Microfacet, [0.0075, 0.08, 0.12]),
        (1e-6, 10e-6, Normalization::Radiometric, [0.007, 0.026, 0.031]),
    ] {
        let service = FrameCase {
            mesh: MeshQuery::Sphere(20_000),
            size: RasterSize::new(96, 96),
            reflectance: Shared::new(chromascope_core::spectral::GridSpectrum::constant(1.0)),
            sigma_m,
            tau_m,
            reading,
            ..FrameCase::new()
        };
        let parts = QUALITIES.map(|quality| sky_part(&FrameCase { quality, ..service.clone() }, 0.5));
        let (mut worst, mut checked) = ([0.0_f64; 3], 0);
        for index in (0..parts[0].len()).step_by(113) {
            let (normal, to_viewer, falloff) = on_sphere(&service, parts[0][index].0);
            if normal.dot(to_viewer) < 0.15 {
                continue;
            }
            let whole = by_midpoints(&service.surface(), reading, normal, to_viewer, 550.0);
            for (worst, part) in worst.iter_mut().zip(&parts) {
                // A rough white scatters all wavelengths nearly alike: green stands for them.
                *worst = worst.max((part[index].1[1] / (0.5 * falloff) - whole).abs());
            }
            checked += 1;
        }
        let is_within = worst.iter().zip(allowed).all(|(worst, allowed)| *worst < allowed);
        assert!(checked > 20 && is_within, "{sigma_m} {reading:?}: {worst:?} of a white at {checked} places");
    }
}

/// A floor before a wall that is far longer and higher than it, turned about the vertical.
fn floor_and_wall(turned: f32) -> Mesh {
    let turn = glam::Quat::from_rotation_y(turned);
    let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let mut sheet = |origin: Vec3, across: Vec3, along: Vec3, cells: [u32; 2]| {
        let first = positions.len() as u32;
        for row in 0..=cells[1] {
            for column in 0..=cells[0] {
                let [u, v] = [column as f32 / cells[0] as f32, row as f32 / cells[1] as f32];
                positions.push(turn * (origin + across * u + along * v));
                normals.push(turn * across.cross(along).normalize());
            }
        }
        for row in 0..cells[1] {
            for column in 0..cells[0] {
                let a = first + row * (cells[0] + 1) + column;
                let b = a + cells[0] + 1;
                triangles.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
            }
        }
    };
    sheet(Vec3::new(-1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::Z * -2.0, [8, 8]);
    sheet(Vec3::new(-60.0, 0.0, -1.0), Vec3::X * 120.0, Vec3::Y * 60.0, [2, 2]);
    Mesh::new(positions, normals, triangles).unwrap()
}

/// Irradiance of a level place over that under the whole sky.
fn level_share(cells: u64) -> f64 {
    let (mut sum, mut all) = (0.0, 0.0);
    for i in 0..40 {
        for j in 0..80 {
            let theta = FRAC_PI_2 * (f64::from(i) + 0.5) / 40.0;
            let phi = TAU * (f64::from(j) + 0.5) / 80.0;
            let direction = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            let weight = theta.sin() * theta.cos();
            sum += weight * f64::from(visible_share([cells; 3], [1.0, 0.0, 0.0], direction.as_vec3()));
            all += weight;
        }
    }
    sum / all
}

#[test]
fn a_wall_hides_half_of_the_sky_from_the_floor_at_its_foot() {
    // The second row of the floor from the wall sees (1 + sin of the wall's angle off the zenith)/2.
    let expected = f64::midpoint(1.0, (0.25_f64 / 60.0).atan().sin());
    let errors: Vec<f64> = (0..12)
        .map(|k| {
            let mesh = floor_and_wall(0.131 * k as f32);
            let sky = SkyVisibility::new(&mesh, &ShadowTree::new(&mesh), true, &Stop::NEVER).unwrap();
            level_share(sky.cells()[7 * 9 + 4].front) - expected
        })
        .collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    // 64 rays find one edge of the sky to within the width of a cell, and over all directions of the edge without a bias.
    assert!(mean.abs() < 0.02 && errors.iter().all(|error| error.abs() < 0.06), "{errors:?}");
}

#[test]
fn without_a_sky_nothing_of_it_is_computed_and_nothing_else_changes() {
    let counting = Counting::default();
    let service = FrameCase::new();
    let plain = service.take(&counting);
    let made = counting.made();
    assert!(made.keys().all(|name| !name.contains("sky") && !name.contains("leaf")), "{made:?}");
    let image = plain.images[0].as_ref().unwrap();
    assert_eq!(image.placed().samples().len() as u64, plain.geometry.lit, "only what the light reaches is listed");
    assert!(plain.geometry.rays <= plain.geometry.seen, "one ray a sample at most");
    // Moving the light asks for no sky anew, and a sky asks for no visibility anew.
    let sky = FrameCase { sky: Some(0.15), ..service.clone() };
    sky.take(&counting);
    let made = counting.made();
    assert_eq!((made.get("sky"), made.get("sky visibility"), made.get("visibility")), (Some(&1), Some(&1), None));
    FrameCase { light_up: 40.0, ..sky.clone() }.take(&counting);
    let made = counting.made();
    assert_eq!(
        (made.get("sky"), made.get("sky visibility"), made.get("sky reflectance")),
        (None, None, None),
        "{made:?}"
    );
    // Turning the mesh traces no ray to the sky.
    FrameCase { yaw: 0.3, ..sky }.take(&counting);
    let made = counting.made();
    assert_eq!((made.get("sky"), made.get("sky visibility"), made.get("sky reflectance")), (Some(&1), None, None));
}

#[test]
fn the_sky_adds_in_proportion_to_its_share() {
    let service = FrameCase { quality: Quality::Preview, shadows: Shadows::Off, ..FrameCase::new() };
    let [one, two] = [0.1, 0.2].map(|share| sky_part(&service, share));
    assert!(!one.is_empty());
    for ((_, one), (_, two)) in one.iter().zip(&two) {
        assert!(one.iter().zip(two).all(|(a, b)| *a >= 0.0 && (2.0 * a - b).abs() < 2e-6), "{one:?} {two:?}");
    }
}

#[test]
fn a_leaf_lit_from_behind_shines_in_its_transmittance() {
    use chromascope_core::reflectance::leaf::LeafModel;
    use chromascope_core::spectral::GridSpectrum;
    let gray = 0.12;
    let service = FrameCase {
        mesh: MeshQuery::Plane,
        reflectance: Shared::new(GridSpectrum::constant(gray)),
        // Behind the plane, 30° from its back's normal.
        light_up: 150.0,
        light_right: 0.0,
        through: true,
        ..FrameCase::new()
    };
    let made = service.take(&Direct);
    assert_eq!((made.geometry.lit, made.geometry.through), (0, made.geometry.seen));
    let opaque = FrameCase { through: false, ..service.clone() }.take(&Direct);
    assert!(opaque.images[0].as_ref().unwrap().signals().is_empty(), "it is dark without");
    // What the rough surface takes from the reflectance it takes from the transmittance.
    let theta = f64::from(-made.angles.angles()[0].cos_i).acos();
    let scattered = directional_hemispherical(&service.surface(), service.reading, theta).diffuse;
    assert!((0.3..0.6).contains(&scattered), "{scattered}");
    let check = |made: &Pictures, transmitted: f64, bound: f64| {
        let (image, angles) = (made.images[0].as_ref().unwrap(), Arc::clone(&made.angles));
        for (signal, angles) in image.signals().iter().zip(angles.angles()) {
            let expected = transmitted * f64::from(-angles.cos_i * angles.falloff);
            assert!(signal.iter().all(|s| (f64::from(*s) - expected).abs() < bound), "{signal:?} for {expected}");
        }
    };
    let transmitted = LeafModel::new().transmittance(gray);
    // The share scattered is interpolated in a table; without a model nothing is.
    check(&made, transmitted * scattered, 1e-4);
    let even = FrameCase { reading: Normalization::Lambertian, ..service }.take(&Direct);
    check(&even, transmitted, 1e-5);
}

#[test]
fn a_level_leaf_lets_through_and_returns_light_as_its_transmittance_to_its_reflectance() {
    use chromascope_core::reflectance::leaf::{LeafModel, ScatteredShare};
    let transmitted = LeafModel::new().transmittance(0.09);
    assert!(transmitted > 0.0);
    for (sigma, tau) in [(5e-6, 10e-6), (1e-6, 10e-6), (20e-6, 10e-6), (0.1e-6, 2e-6), (0.0, 10e-6)] {
        for reading in [Normalization::Radiometric, Normalization::Microfacet] {
            let surface = surface(sigma, tau);
            let share = ScatteredShare::new(&surface, reading);
            // The side that faces the light returns this share of R; the other one shines with as much of T.
            for degrees in [0.0_f64, 20.0, 45.0, 70.0] {
                let theta = degrees.to_radians();
                let returned = directional_hemispherical(&surface, reading, theta).diffuse;
                assert!((share.at(theta.cos()) - returned).abs() < 4e-3, "{sigma} {reading:?} {degrees}: {returned}");
            }
            // Mean over a uniform sky, by midpoints in cos² θ.
            let cosine = |k: u32| ((f64::from(k) + 0.5) / 200.0).sqrt();
            let mean =
                (0..200).map(|k| directional_hemispherical(&surface, reading, cosine(k).acos()).diffuse).sum::<f64>()
                    / 200.0;
            assert!((share.under_sky() - mean).abs() < 3e-3, "{sigma} {reading:?}: {} for {mean}", share.under_sky());
        }
    }
    let even = ScatteredShare::new(&surface(5e-6, 10e-6), Normalization::Lambertian);
    assert!((even.at(0.5) - 1.0).abs() < 1e-12 && (even.under_sky() - 1.0).abs() < 1e-12);
}
