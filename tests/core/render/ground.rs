//! Light that the ground sends up, against quadratures that share no code with it.

use std::f64::consts::{FRAC_PI_2, TAU};

use chromascope_core::query::render::picture::PicturesQuery;
use chromascope_core::query::render::{BounceQuery, MeshQuery, Parts};
use chromascope_core::query::{Ask as _, Direct, Shared};
use chromascope_core::reflectance::Normalization;
use chromascope_core::render::sky::ground::GroundView;
use chromascope_core::render::{Reach, Stop};
use chromascope_core::scene::PlacedLight;
use chromascope_core::spectral::GridSpectrum;
use chromascope_mesh::stage::Stage;
use chromascope_mesh::{Part, ShadowTree, shapes};
use glam::DVec3;

use super::fixture::FrameCase;

const ON_GROUND: Stage = Stage { patches: 0, ground: true, hair: false, cropped: false };

/// Irradiance of a place on a sphere of radius r that stands on a white ground, under the light and under the sky: midpoints in height
/// and azimuth, the sphere's shadow by its equation.
fn by_midpoints(normal: DVec3, radius: f64, light: DVec3) -> [f64; 2] {
    let (mut direct, mut sky) = (0.0, 0.0);
    let (rings, sectors) = (240, 480);
    for i in 0..rings {
        for j in 0..sectors {
            let (down, phi) =
                (FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(rings), TAU * f64::from(j) / f64::from(sectors));
            let direction = DVec3::new(down.cos() * phi.cos(), -down.sin(), down.cos() * phi.sin());
            let cos = direction.dot(normal);
            let place = normal * radius + direction * ((radius + normal.y * radius) / down.sin());
            if cos <= 0.0 {
                continue;
            }
            let weight = cos * down.cos() * FRAC_PI_2 / f64::from(rings) * TAU / f64::from(sectors) / (TAU / 2.0);
            let along = -place.dot(light);
            let is_shaded = along > 0.0 && (place + light * along).length() < radius;
            sky += weight;
            direct += if is_shaded { 0.0 } else { weight * light.y };
        }
    }
    [direct, sky]
}

#[test]
fn the_ground_lights_a_sphere_as_a_quadrature_over_all_directions_makes_it() {
    let sphere = shapes::sphere(4_000);
    let mesh = ON_GROUND.about(&sphere);
    assert_eq!(mesh.bounds(), sphere.bounds(), "the ground is not of the mesh");
    let tree = ShadowTree::new(&mesh);
    let light = DVec3::new(0.5, 0.7, 0.4).normalize();
    let view = GroundView::new(&mesh, &tree, &Stop::NEVER).unwrap();
    let at = |tree| view.at_vertices(&mesh, PlacedLight::Direction(light), tree, &Stop::NEVER).unwrap();
    let (shaded, open) = (at(Some(&tree)), at(None));
    let (mut worst, mut sums, mut count) = ([0.0_f64; 2], [0.0; 2], 0.0);
    for vertex in (0..sphere.positions().len()).step_by(37) {
        let normal = sphere.normals()[vertex].as_dvec3();
        let expected = by_midpoints(normal, 0.1, light);
        for k in 0..2 {
            let error = f64::from(shaded[vertex][k]) - expected[k];
            worst[k] = worst[k].max(error.abs());
            sums[k] += error;
        }
        count += 1.0;
        assert_eq!(shaded[vertex][1], open[vertex][1]);
        assert!(shaded[vertex][0] <= open[vertex][0]);
    }
    // 64 rays find the shadow's edge to within the width of a cell, and the whole without a bias.
    assert!(worst[0] < 0.1 && worst[1] < 5e-3, "{worst:?}");
    assert!(sums.iter().all(|sum| (sum / count).abs() < 0.01), "{sums:?} of {count}");
}

#[test]
fn the_grounds_light_is_reflected_in_the_product_of_both_reflectances() {
    let flat = |value: f64| Shared::new(GridSpectrum::from_fn(|nm| value * nm / 700.0));
    let mesh = MeshQuery::Staged(Box::new(MeshQuery::Sphere(2_000)), ON_GROUND);
    let case = FrameCase { mesh, reflectance: flat(0.8), reading: Normalization::Lambertian, ..FrameCase::new() };
    let mut over = case.question();
    over.shading.geometry.reach = Reach { everywhere: true, through: false };
    let plain = over.clone();
    over.shading.bounce = true;
    over.parts = Parts::from([(Part::Ground, flat(0.4))]);
    // The measure of the product, as the material's own.
    let product = GridSpectrum::from_fn(|nm| 0.32 * (nm / 700.0) * (nm / 700.0));
    let twice = FrameCase { reflectance: Shared::new(product), ..case.clone() }.question();
    let taken = |query: &PicturesQuery| (*Direct.ask(query)).clone().unwrap().unwrap();
    let (over, plain, bounce) = (taken(&over), taken(&plain), Direct.ask(&BounceQuery(over.shading.geometry.clone())));
    let bounce = (*bounce).as_ref().unwrap();
    let mut seen = 0;
    for (k, source) in twice.sources.iter().enumerate() {
        let measure = Direct.ask(&twice.image(source).measure);
        let totals = (*measure).as_ref().unwrap().totals();
        let [a, b] = [&over, &plain].map(|pictures| pictures.images[k].as_ref().unwrap());
        for (at, (with, without)) in a.signals().iter().zip(b.signals()).enumerate() {
            if a.placed().part(at) != Part::Body {
                continue;
            }
            for c in 0..3 {
                let expected = totals[c] * f64::from(bounce[at][0]);
                let added = f64::from(with[c]) - f64::from(without[c]);
                assert!((added - expected).abs() < 1e-4 * totals[c].abs().max(1e-3), "{added} {expected}");
            }
            seen += usize::from(bounce[at][0] > 0.05);
        }
    }
    assert!(seen > 100, "{seen}");
}
