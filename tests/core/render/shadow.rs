//! Rays along the axes, and from and to nowhere.

use chromascope_core::render::RasterSize;
use chromascope_mesh::{Mesh, ShadowTree, shapes};
use glam::{DVec3, Vec3};

/// A direction with a component of −0 is the same as with 0.
#[test]
fn a_ray_is_stopped_whatever_the_sign_of_its_zeros() {
    let tree = ShadowTree::new(&shapes::sphere(4000));
    let point = DVec3::new(-0.107, -0.193, 0.024);
    for zero in [0.0, -0.0, -1e-106, 1e-106] {
        assert!(tree.is_blocked(point, DVec3::new(0.43, 0.9, zero), 10.0), "z {zero}");
        assert!(tree.is_blocked(DVec3::new(0.013, 0.017, 0.5), DVec3::new(zero, zero, -1.0), 10.0), "x, y {zero}");
    }
}

#[test]
fn nothing_is_in_the_way_of_what_is_no_direction() {
    let tree = ShadowTree::new(&shapes::sphere(500));
    assert!(!tree.is_blocked(DVec3::ZERO, DVec3::new(f64::NAN, 0.0, 1.0), 1.0));
    assert!(!tree.is_blocked(DVec3::ZERO, DVec3::new(f64::INFINITY, 0.0, 1.0), 1.0));
    assert!(!tree.is_blocked(DVec3::ZERO, DVec3::Z, f64::NAN));
}

#[test]
fn a_size_of_any_numbers_has_a_count() {
    let size = RasterSize { width: u32::MAX, height: u32::MAX, samples: 8 };
    assert_eq!([size.columns(), size.rows()], [u32::MAX as usize * 8; 2]);
}
/// A mesh of triangles that share no vertex.
fn soup(triangles: impl IntoIterator<Item = [Vec3; 3]>) -> Mesh {
    let positions: Vec<Vec3> = triangles.into_iter().flatten().collect();
    let faces = (0..positions.len() as u32).step_by(3).map(|i| [i, i + 1, i + 2]).collect();
    Mesh::with_smooth_normals(positions, faces).unwrap()
}

/// A triangle in the plane y = 0 around the origin that no ray along y through the origin misses.
fn level(size: f32) -> [Vec3; 3] {
    [Vec3::new(-size, 0.0, -size), Vec3::new(size, 0.0, -size), Vec3::new(0.0, 0.0, size)]
}

/// The tree takes n log n steps: by n² steps each of these would take minutes to hours.
#[test]
fn a_tree_is_built_over_a_hundred_thousand_triangles_wherever_they_lie() {
    const COUNT: usize = 100_000;
    let part = |i: usize| (i + 1) as f32 / COUNT as f32;
    let triangles = |one: &dyn Fn(usize) -> [Vec3; 3]| soup((0..COUNT).map(one));
    let far = [[3.0, 0.0, 3.0], [4.0, 0.0, 3.0], [3.0, 0.0, 4.0]].map(Vec3::from);
    for (name, mesh) in [
        ("one triangle again and again", triangles(&|_| level(1.0))),
        ("one triangle again and again beside another", triangles(&|i| if i == 7 { far } else { level(1.0) })),
        (
            "one triangle turned",
            triangles(&|i| {
                let mut corners = level(1.0);
                corners.rotate_left(i % 3);
                corners
            }),
        ),
        ("nested", triangles(&|i| level(part(i)))),
        ("nested with sides that shrink as powers", triangles(&|i| level(2.0_f32.powf(-120.0 * part(i))))),
        ("evenly spaced", triangles(&|i| level(1.0).map(|v| v + Vec3::Y * i as f32))),
        ("ever closer", triangles(&|i| level(1.0).map(|v| v + Vec3::Y / (i + 1) as f32))),
        ("ever closer and smaller", triangles(&|i| level(part(i)).map(|v| v + Vec3::Y * part(i) * part(i)))),
        (
            "alternating far and near",
            triangles(&|i| level(1.0).map(|v| v + Vec3::Y * if i % 2 == 0 { 1e3 } else { 0.0 })),
        ),
        ("points beside one triangle", triangles(&|i| if i == 0 { level(1.0) } else { [Vec3::ONE * part(i); 3] })),
        ("one point beside one triangle", triangles(&|i| if i == 0 { level(1.0) } else { [Vec3::ONE; 3] })),
        ("lines", triangles(&|i| if i == 0 { level(1.0) } else { [Vec3::ZERO, Vec3::X, Vec3::X * part(i)] })),
    ] {
        let tree = ShadowTree::new(&mesh);
        let radius = f64::from(mesh.bounds().radius);
        let center = mesh.bounds().center().as_dvec3();
        let start = DVec3::new(0.0, center.y - 2.0 * radius, 0.0);
        assert!(tree.is_blocked(start, DVec3::Y, 5.0 * radius), "{name}");
        assert!(!tree.is_blocked(start, DVec3::NEG_Y, 5.0 * radius), "{name}");
        assert!(!tree.is_blocked(start - DVec3::X * 2.0 * radius, DVec3::Y, 5.0 * radius), "{name}");
    }
}

/// Looking at every triangle gives the same answers as the tree.
#[test]
fn the_tree_finds_what_a_look_at_every_triangle_finds() {
    // The bits of a product in the middle, as by chance.
    let spread = |seed: usize| {
        let mixed = (seed as u32 + 1).wrapping_mul(2_654_435_761).rotate_left(15).wrapping_mul(2_246_822_519) >> 8;
        mixed as f32 / (1 << 24) as f32 - 0.5
    };
    let corner = |i: usize| Vec3::new(spread(i), spread(7 * i + 1), spread(31 * i + 5));
    let corners = |i: usize| [0, 1, 2].map(|k| corner(i / 2) + 0.4 * corner(3 * i + k));
    let all: Vec<[Vec3; 3]> = (0..600).map(corners).collect();
    let tree = ShadowTree::new(&soup(all.iter().copied()));
    let mut blocked = 0;
    for ray in 0..2000 {
        let (from, to) = (2.0 * corner(3 * ray + 11).as_dvec3(), 2.0 * corner(5 * ray + 2).as_dvec3());
        let Some(direction) = (to - from).try_normalize() else { continue };
        let distance = from.distance(to);
        let near_edge = std::cell::Cell::new(false);
        let hit = all.iter().any(|[a, b, c]| {
            let (a, u, v) = (a.as_dvec3(), (*b - *a).as_dvec3(), (*c - *a).as_dvec3());
            let normal = u.cross(v);
            let along = normal.dot(a - from) / normal.dot(direction);
            let p = from + direction * along - a;
            let (s, t) = (p.cross(v).dot(normal), u.cross(p).dot(normal));
            let weights = [s, t, normal.length_squared() - s - t].map(|weight| weight / normal.length_squared());
            let least = weights.into_iter().chain([along, distance - along]).fold(f64::INFINITY, f64::min);
            near_edge.set(near_edge.get() || least.abs() < 1e-3);
            least >= 0.0
        });
        if !near_edge.get() {
            assert_eq!(tree.is_blocked(from, direction, distance), hit, "ray {ray}");
            blocked += usize::from(hit);
        }
    }
    assert!((200..1800).contains(&blocked), "{blocked} of 2000 rays are blocked");
}

#[test]
fn a_light_with_a_disk_has_soft_shadows_where_pixels_have_several_samples() {
    use chromascope_core::query::render::{MeshQuery, VisibilityQuery};
    use chromascope_core::query::{Ask as _, Direct};
    use chromascope_core::render::{GeometryImage, RasterSize, Shadows, Stop};
    use chromascope_core::scene::{Lighting, Viewpoint};
    let size = RasterSize { width: 60, height: 60, samples: 3 };
    let viewpoint = Viewpoint::new(-0.4, 0.1, 3.6, 0.5).unwrap();
    let visibility = Direct.ask(&VisibilityQuery { mesh: MeshQuery::Head(10_000), viewpoint, size });
    let visibility = (*visibility).as_ref().unwrap();
    let mesh = chromascope_mesh::head::head(10_000);
    let tree = ShadowTree::new(&mesh);
    // Pixels of which all samples are seen, some in shadow.
    let edges = |radius: f64, samples: Shadows| {
        let lighting = Lighting::from_angles(0.5, 0.9, radius).unwrap();
        let image = GeometryImage::new(&mesh, visibility, &lighting, Some((&tree, samples)), &Stop::NEVER).unwrap();
        let pixel = |sample: &u32| (sample / 180 / 3) * 60 + sample % 180 / 3;
        let count = |list: &[u32]| {
            list.iter().fold(vec![0_u8; 3600], |mut counts, sample| {
                counts[pixel(sample) as usize] += 1;
                counts
            })
        };
        let (lit, seen) = (count(image.samples()), count(image.placed().seen()));
        lit.iter().zip(&seen).filter(|(lit, seen)| **seen == 9 && (1..9).contains(*lit)).count()
    };
    let (hard, sun, wide) = (edges(0.0, Shadows::Full), edges(4.65e-3, Shadows::Full), edges(0.15, Shadows::Full));
    assert!(sun >= hard && wide > hard * 3 / 2, "{hard} {sun} {wide}");
}
