//! Meshes, eyes and lights.

use chromascope_core::scene::roughness::{VertexRoughness, vertex_roughness};
use chromascope_core::scene::{Lighting, PlacedLight, Viewpoint};
use chromascope_mesh::{Mesh, MeshError, head, shapes};
use glam::{DVec3, Vec3};

/// The middle value.
fn median(mut values: Vec<f32>) -> f32 {
    values.sort_by(f32::total_cmp);
    values[values.len() / 2]
}

/// σ at each vertex.
fn sigmas(mesh: &Mesh) -> Vec<f32> {
    vertex_roughness(mesh).iter().map(|v| v.sigma_m).collect()
}

#[test]
fn a_sphere_is_as_uneven_as_its_edges_are_long() {
    let mesh = shapes::sphere(20_000);
    // A neighbor at distance d lies d²/2r below the tangent plane.
    let (r, roughness) = (0.1, vertex_roughness(&mesh));
    let longest = mesh.triangles().iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]);
    let longest = longest.map(|(a, b)| mesh.positions()[a as usize].distance(mesh.positions()[b as usize]));
    let longest = longest.fold(0.0, f32::max);
    let sigma = |v: &VertexRoughness| v.sigma_m > 0.0 && v.sigma_m <= longest * longest / (2.0 * r) * 1.001;
    assert!(roughness.iter().all(sigma));
    assert!(vertex_roughness(&shapes::plane(100)).iter().all(|v| v.sigma_m == 0.0));
}

#[test]
fn the_correlation_length_of_a_vertex_is_the_radius_of_its_neighborhood() {
    let corners = [[0.0, 0.0], [3.0, 0.0], [0.0, 4.0], [9.0, 9.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let mesh = Mesh::with_smooth_normals(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
    let taus: Vec<f32> = vertex_roughness(&mesh).iter().map(|v| v.tau_m).collect();
    assert_eq!(taus, [4.0, 5.0, 5.0, 0.0]);
    // A ball's heights go with the square of its neighborhood's radius: σ/τ shrinks with it.
    let slopes = [2_000, 20_000].map(|count| {
        let roughness = vertex_roughness(&shapes::sphere(count));
        median(roughness.iter().map(|v| v.sigma_m / v.tau_m).collect())
    });
    assert!((slopes[0] / slopes[1] - 10_f32.sqrt()).abs() < 0.2, "{slopes:?}");
}

#[test]
fn a_head_is_ten_thousand_times_too_uneven_to_scatter_light() {
    // The paper's head had some thousand triangles.
    let coarse = median(sigmas(&head::head(9_000)));
    assert!((5e-5..1e-3).contains(&coarse), "{coarse} m");
    let fine = median(sigmas(&head::head(100_000)));
    assert!(fine < coarse / 4.0, "{fine} m: it says more of the triangles than of the skin");
}

#[test]
fn smooth_normals_of_a_ball_point_outward() {
    let ball = shapes::sphere(2_000);
    let mesh = Mesh::with_smooth_normals(ball.positions().to_vec(), ball.triangles().to_vec()).unwrap();
    for (normal, expected) in mesh.normals().iter().zip(ball.normals()) {
        assert!(normal.dot(*expected) > 0.999);
    }
    assert!((mesh.bounds().radius - 0.1).abs() < 1e-6 && mesh.bounds().center().length() < 1e-6);
}

#[test]
fn what_is_no_mesh_is_refused() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let made = |positions: Vec<Vec3>, triangle| Mesh::with_smooth_normals(positions, vec![triangle]);
    assert!(matches!(made(corners.clone(), [0, 1, 3]), Err(MeshError::Vertex { .. })));
    assert!(matches!(made(vec![Vec3::ZERO, Vec3::X, Vec3::NAN], [0, 1, 2]), Err(MeshError::NotFinite { vertex: 2 })));
    assert!(Mesh::with_smooth_normals(corners, Vec::new()).is_err());
    assert!(Mesh::new(vec![Vec3::ZERO; 3], vec![Vec3::X; 2], vec![[0, 1, 2]]).is_err());
}

#[test]
fn an_orbit_looks_at_the_middle_from_where_it_says() {
    let bounds = shapes::sphere(2_000).bounds();
    for (yaw, pitch, expected) in [(0.0, 0.0, DVec3::Z), (90.0, 0.0, DVec3::X), (0.0, 90.0, DVec3::Y)] {
        let eye = Viewpoint::new(f64::to_radians(yaw), f64::to_radians(pitch), 4.0, 0.5).unwrap().eye(bounds);
        assert!((eye.position / 0.4).distance(expected) < 1e-5, "{yaw}, {pitch}: {}", eye.position);
        let seen = eye.view_from_world(bounds.center().as_dvec3());
        assert!(seen.x.abs() < 1e-9 && seen.y.abs() < 1e-9 && (seen.z - 0.4).abs() < 1e-5);
    }
    assert!(Viewpoint::new(0.0, 0.0, 0.0, 0.5).is_err() && Viewpoint::new(0.0, f64::NAN, 3.0, 0.5).is_err());
    assert!((Viewpoint::new(7.0, 9.0, 3.0, 0.5).unwrap().pitch() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
}

#[test]
fn a_light_moves_with_the_eye() {
    let bounds = shapes::sphere(2_000).bounds();
    let eye = Viewpoint::new(1.0, 0.3, 4.0, 0.5).unwrap().eye(bounds);
    // Up and to the left of the view axis, towards the eye.
    let (up, right) = (25_f64.to_radians(), (-25_f64).to_radians());
    let light = Lighting::from_angles(up, right, 0.0).unwrap();
    let (direction, distance) = light.before(&eye).seen_from(DVec3::ZERO).unwrap();
    let view = eye.world_from_view.transpose() * direction;
    assert!(distance.is_infinite() && view.x < 0.0 && view.y > 0.0 && view.z > 0.0);
    assert!((view.y - up.sin()).abs() < 1e-12, "{view}");
    let near = Lighting::near(DVec3::new(0.0, 0.0, 2.0), 0.01).unwrap().before(&eye);
    let (_, distance) = near.seen_from(DVec3::ZERO).unwrap();
    assert!((distance - 0.2).abs() < 1e-6, "{distance}");
}

#[test]
fn the_largest_vertices_have_bounds_and_unevenness() {
    let x = 2e38;
    let positions =
        vec![Vec3::new(x, x, x), Vec3::new(1.1 * x, x, -x), Vec3::new(1.2 * x, -x, x), Vec3::new(x, 1.5 * x, x)];
    let mesh = Mesh::with_smooth_normals(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    assert!(mesh.bounds().center().is_finite() && mesh.bounds().radius.is_finite());
    assert!(vertex_roughness(&mesh).iter().all(|v| v.sigma_m.is_finite() && v.tau_m.is_finite()));
}

#[test]
fn a_direction_of_any_size_has_a_length_of_1() {
    for size in [1e-320, 1e-161, 1e-150, 1.0, 1e160, 1e300] {
        let light = Lighting::far(DVec3::new(0.6 * size, 0.0, 0.8 * size), 0.0).unwrap();
        assert!((light.place().length() - 1.0).abs() < 1e-14, "{size}");
    }
    assert!(Lighting::far(DVec3::ZERO, 0.0).is_err());
    let (transform, distance) = PlacedLight::Point(DVec3::new(0.0, 0.0, 1e-300)).seen_from(DVec3::ZERO).unwrap();
    assert_eq!((transform, distance), (DVec3::Z, 1e-300));
}

/// A mesh's reach to the left, right, below and above the middle of a picture, in halves of its sides.
fn reach(mesh: &Mesh, viewpoint: &Viewpoint, aspect: f64) -> [f64; 4] {
    let eye = viewpoint.eye_before(mesh);
    mesh.positions().iter().fold([0.0; 4], |[left, right, below, above], p| {
        let view = eye.view_from_world(p.as_dvec3());
        let [x, y] = [view.x / aspect, view.y].map(|v| v / view.z / eye.half_height);
        [left.max(-x), right.max(x), below.max(-y), above.max(y)]
    })
}

#[test]
fn a_mesh_fills_the_picture_from_everywhere() {
    for mesh in [head::head(10_000), chromascope_mesh::fern::fern(4_000), shapes::plane(2)] {
        for aspect in [0.6, 1.0, 1.8] {
            for (yaw, pitch) in [(-0.4_f64, 0.1), (1.6, 0.0), (2.8, -0.7), (0.3, 1.5)] {
                let viewpoint = Viewpoint::new(yaw, pitch, 1.0, 0.5).unwrap().framed(aspect, 1.0).unwrap();
                let [left, right, below, above] = reach(&mesh, &viewpoint, aspect);
                let fullest = left.max(right).max(below).max(above);
                assert!((fullest - 0.92).abs() < 1e-6, "{yaw} {pitch} {aspect}: {fullest}");
                // The fuller axis is in the middle, the other nearly.
                assert!((left - right).abs() < 0.15 && (below - above).abs() < 0.15, "{left} {right} {below} {above}");
                // From twice as far it is about half as large, and one that is not framed stays where it was put.
                let far = Viewpoint::new(yaw, pitch, 1.0, 0.5).unwrap().framed(aspect, 2.0).unwrap();
                let share = reach(&mesh, &far, aspect).into_iter().fold(0.0, f64::max) / fullest;
                assert!((0.3..0.6).contains(&share), "{share}");
                let plain = Viewpoint::new(yaw, pitch, 5.0, 0.5).unwrap();
                assert_eq!(plain.eye_before(&mesh), plain.eye(mesh.bounds()));
            }
        }
    }
}
