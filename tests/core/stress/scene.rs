//! Places of lights and eyes, meshes of any size.

use chromascope_core::scene::roughness::vertex_roughness;
use chromascope_core::scene::{Lighting, PlacedLight, Viewpoint};
use chromascope_mesh::mesh::smooth_normals;
use chromascope_mesh::{Mesh, shapes};
use glam::{DVec3, Vec3};

use super::draw::{Case, Draw, case};
use super::walk::{Verdict, Walk};

pub(super) const WALKS: &[Walk] = &[
    Walk { name: "Lighting", promise: 1e-14, share: 20.0, draw: draw_place, check: lighting },
    Walk { name: "Viewpoint", promise: 1e-14, share: 20.0, draw: draw_place, check: viewpoint },
    Walk { name: "Mesh::new", promise: 1e-6, share: 10.0, draw: draw_mesh, check: mesh },
    Walk { name: "sphere, plane", promise: 2e-3, share: 0.05, draw: |d| case([d.number()]), check: shape },
];

fn draw_place(d: &mut Draw) -> Case {
    let radius = if d.pick(2) == 0.0 { d.unit() } else { d.anything() };
    case([d.anything(), d.anything(), d.anything(), radius, d.angle(), d.angle(), d.log(1e-3, 1e5), d.within(0.0, 3.0)])
}

fn lighting(&[x, y, z, radius, up, right, ..]: &Case, v: &mut Verdict) {
    let place = DVec3::new(x, y, z);
    if let Ok(light) = Lighting::from_angles(up, right, radius) {
        v.error((light.place().length() - 1.0).abs());
    }
    if let Ok(far) = Lighting::far(place, radius) {
        v.error((far.place().length() - 1.0).abs());
        v.holds("another radius", far.angular_radius() == radius && (0.0..=0.5).contains(&radius));
    }
    let Ok(near) = Lighting::near(place, radius) else { return v.refuse() };
    let point = DVec3::new(up, right, radius);
    if !point.is_finite() {
        return;
    }
    if let Some((transform, distance)) = PlacedLight::Point(near.place()).seen_from(point) {
        v.all_finite(transform.to_array());
        v.error((transform.length() - 1.0).abs());
        v.holds("a distance that is no number", distance > 0.0);
    }
}

fn viewpoint(&[x, y, z, _, yaw, pitch, distance, view]: &Case, v: &mut Verdict) {
    let Ok(viewpoint) = Viewpoint::new(yaw, pitch, distance, view) else { return v.refuse() };
    v.holds("more than half a turn", viewpoint.yaw().abs() <= std::f64::consts::PI);
    v.holds("beyond the zenith", viewpoint.pitch().abs() <= std::f64::consts::FRAC_PI_2);
    let mesh = shapes::plane(2);
    let eye = viewpoint.eye(mesh.bounds());
    v.holds("not finite", eye.position.is_finite() && eye.world_from_view.is_finite() && eye.half_height.is_finite());
    let unity = eye.world_from_view.transpose() * eye.world_from_view - glam::DMat3::IDENTITY;
    v.error(unity.to_cols_array().iter().fold(0.0_f64, |m, e| m.max(e.abs())));
    let point = DVec3::new(x, y, z);
    if point.is_finite() && point.abs().max_element() < 1e300 {
        v.all_finite(eye.view_from_world(point).to_array());
    }
    let ahead = eye.view_from_world(eye.center);
    v.error((ahead.z / (viewpoint.distance() * eye.radius) - 1.0).abs());
}

fn draw_mesh(d: &mut Draw) -> Case {
    case([d.key(), d.pick(4), d.log(1e-45, 3e38), d.pick(12)])
}

fn mesh(&[key, kind, size, count, ..]: &Case, v: &mut Verdict) {
    let mut d = Draw::new(key as u64, "vertices", 0);
    let n = count.clamp(0.0, 20.0) as u32;
    let mut number = || match kind as u32 {
        0 => d.anything() as f32,
        1 => (size * d.within(-1.0, 1.0)) as f32,
        2 => size as f32,
        _ => d.signed(1e-40, 1e38) as f32,
    };
    let positions: Vec<Vec3> = (0..n).map(|_| Vec3::new(number(), number(), number())).collect();
    let normals: Vec<Vec3> = (0..n).map(|_| Vec3::new(number(), number(), number())).collect();
    let triangles: Vec<[u32; 3]> =
        (0..n / 2).map(|_| [0, 1, 2].map(|_| d.pick(n + u32::from(kind == 3.0)) as u32)).collect();
    for mesh in [
        Mesh::with_smooth_normals(positions.clone(), triangles.clone()),
        Mesh::new(positions.clone(), normals, triangles.clone()),
    ] {
        let Ok(mesh) = mesh else {
            v.refuse();
            continue;
        };
        let (bounds, center) = (mesh.bounds(), mesh.bounds().center());
        v.holds("bounds that are no numbers", bounds.radius.is_finite() && center.is_finite());
        v.all_finite(vertex_roughness(&mesh).into_iter().flat_map(|v| [v.sigma_m, v.tau_m].map(f64::from)));
        mesh.normals().iter().for_each(|n| v.error((f64::from(n.length()) - 1.0).abs()));
        let smooth = smooth_normals(mesh.positions(), mesh.triangles());
        v.holds("a normal that is no number", smooth.iter().all(|n| n.is_finite()));
    }
}

fn shape(&[count, ..]: &Case, v: &mut Verdict) {
    let triangles = count.clamp(0.0, 5000.0) as usize;
    for mesh in [shapes::sphere(triangles), shapes::plane(triangles)] {
        v.holds("nothing", mesh.triangles().len() >= 2);
        v.holds("too many", mesh.triangles().len() <= 2 * triangles.max(128) + 200);
    }
    let sphere = shapes::sphere(triangles);
    sphere.positions().iter().for_each(|p| v.error((f64::from(p.length()) - 0.1).abs()));
}
