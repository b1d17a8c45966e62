//! The head, bare and clothed: how many triangles, that it is closed, symmetric, smooth, of human proportions and on one limit
//! surface; and that the collar stands off the neck.

use chromascope_mesh::head::{FEWEST, clothed, head};
use chromascope_mesh::stage::Stage;
use chromascope_mesh::{Mesh, Part};
use glam::Vec3;
use std::collections::BTreeMap;

const COUNTS: [usize; 5] = [10_000, 16_000, 25_000, 45_000, 100_000];

/// The corners of all triangles.
fn corners(mesh: &Mesh) -> impl Iterator<Item = [Vec3; 3]> {
    mesh.triangles().iter().map(|t| t.map(|i| mesh.positions()[i as usize]))
}

/// The enclosed volume in cubic meters.
fn volume(mesh: &Mesh) -> f64 {
    corners(mesh).map(|t| t.map(Vec3::as_dvec3)).map(|[a, b, c]| a.cross(b).dot(c) / 6.0).sum()
}

/// The largest coordinate along a direction among the vertices of a region.
fn extreme(mesh: &Mesh, direction: Vec3, region: impl Fn(Vec3) -> bool) -> f32 {
    let within = mesh.positions().iter().filter(|p| region(**p));
    within.map(|p| p.dot(direction)).fold(f32::NEG_INFINITY, f32::max)
}

/// Vertices by the cube of a given side in which they lie.
struct Cells {
    side: f32,
    cells: BTreeMap<[i32; 3], Vec<usize>>,
}

impl Cells {
    fn new(mesh: &Mesh, side: f32) -> Self {
        let mut cells: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
        for (i, p) in mesh.positions().iter().enumerate() {
            cells.entry(Self::cell(side, *p)).or_default().push(i);
        }
        Self { side, cells }
    }

    fn cell(side: f32, p: Vec3) -> [i32; 3] {
        (p / side).floor().to_array().map(|v| v as i32)
    }

    /// The vertices in the cubes around a place.
    fn near(&self, p: Vec3) -> impl Iterator<Item = usize> {
        let [x, y, z] = Self::cell(self.side, p);
        let around = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        around.filter_map(move |[i, j, k]| self.cells.get(&[x + i, y + j, z + k])).flatten().copied()
    }
}

#[test]
fn the_number_of_triangles_is_about_what_was_asked() {
    for asked in COUNTS.into_iter().chain([200_000, 777_000]) {
        let got = head(asked).triangles().len();
        assert!(got.abs_diff(asked) * 20 <= asked, "{asked}: {got}");
    }
    assert_eq!(head(0), head(2_000), "the cage's own is the coarsest");
    for asked in [FEWEST[1], 25_000, 100_000, 777_000] {
        let got = clothed(asked).triangles().len();
        assert!(got.abs_diff(asked) * 20 <= asked, "clothed {asked}: {got}");
    }
}

#[test]
fn it_is_closed_and_faces_outward() {
    for (asked, mesh) in COUNTS.into_iter().flat_map(|asked| [(asked, head(asked)), (asked, clothed(asked))]) {
        let mut edges: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
        for &[a, b, c] in mesh.triangles() {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                edges.entry([from.min(to), from.max(to)]).or_default()[usize::from(from < to)] += 1;
            }
        }
        assert!(edges.values().all(|uses| *uses == [1, 1]), "{asked}");
        assert!(volume(&mesh) > 0.0, "{asked}");
    }
}

#[test]
fn normals_agree_with_the_winding() {
    for (asked, mesh) in COUNTS.into_iter().flat_map(|asked| [(asked, head(asked)), (asked, clothed(asked))]) {
        let mut against = 0;
        for (triangle, [a, b, c]) in mesh.triangles().iter().zip(corners(&mesh)) {
            let normal = (b - a).cross(c - a);
            let mean: Vec3 = triangle.iter().map(|&i| mesh.normals()[i as usize]).sum();
            against += usize::from(normal.dot(mean) <= 0.0);
        }
        // Triangles in the folds of ears, lids and lips may, where the mesh is coarse.
        assert!(against * 100 <= mesh.triangles().len(), "{asked}: {against}");
    }
}

#[test]
fn the_halves_are_mirror_images() {
    let mesh = clothed(20_000);
    let cells = Cells::new(&mesh, 1e-3);
    for (p, n) in mesh.positions().iter().zip(mesh.normals()) {
        let mirror = Vec3::new(-1.0, 1.0, 1.0);
        let is_image = |i: usize| {
            mesh.positions()[i].distance(*p * mirror) < 1e-6 && mesh.normals()[i].distance(*n * mirror) < 1e-3
        };
        assert!(cells.near(*p * mirror).any(is_image), "{p}");
    }
}

/// All meshes are of one surface: where a coarse one has a vertex, a finer one has the same with the same normal.
#[test]
fn the_vertices_of_a_coarse_mesh_are_vertices_of_a_finer_one() {
    let (coarse, fine) = (head(0), head(150_000));
    let cells = Cells::new(&fine, 1e-3);
    let mut missing = 0;
    for (p, n) in coarse.positions().iter().zip(coarse.normals()) {
        let is_same = |i: usize| fine.positions()[i].distance(*p) < 1e-6 && fine.normals()[i].distance(*n) < 2e-3;
        missing += usize::from(!cells.near(*p).any(is_same));
    }
    // Only those of the eyeballs, which are spheres of rings and sectors.
    let skin = coarse.positions().len() - missing;
    assert!(skin >= 4_800 && missing <= 300, "{skin} {missing}");
}

#[test]
fn normals_are_those_of_the_surface() {
    // The mean normal of the triangles around a vertex comes near the surface's own as they shrink.
    let angles = [25_000, 400_000].map(|count| {
        let mesh = head(count);
        let smooth = Mesh::with_smooth_normals(mesh.positions().to_vec(), mesh.triangles().to_vec()).unwrap();
        let mut angles: Vec<f32> =
            mesh.normals().iter().zip(smooth.normals()).map(|(a, b)| a.angle_between(*b)).collect();
        angles.sort_by(f32::total_cmp);
        [angles[angles.len() / 2], angles[angles.len() * 95 / 100]]
    });
    assert!(angles[0][0] < 0.02 && angles[1][0] < 0.002, "{angles:?}");
    assert!(angles[1][1] < angles[0][1] / 4.0, "{angles:?}");
}

#[test]
fn proportions_are_human() {
    let mesh = head(50_000);
    let bounds = mesh.bounds();
    assert!(bounds.center().length() < 2e-3, "{}", bounds.center());
    let crown = bounds.max.y;
    let chin = -extreme(&mesh, Vec3::NEG_Y, |p| p.z > 0.075);
    let tall = crown - chin;
    assert!((0.20..0.25).contains(&tall), "{tall}");
    // Above the ears, and with them.
    let wide = 2.0 * extreme(&mesh, Vec3::X, |p| p.y > crown - 0.08);
    let with_ears = 2.0 * extreme(&mesh, Vec3::X, |p| p.y > chin);
    assert!((0.60..0.75).contains(&(wide / tall)), "{}", wide / tall);
    assert!((1.05..1.30).contains(&(with_ears / wide)), "{}", with_ears / wide);
    let nose = extreme(&mesh, Vec3::Z, |p| p.x.abs() < 0.02);
    let forehead = extreme(&mesh, Vec3::Z, |p| p.y > crown - 0.08);
    let back = -extreme(&mesh, Vec3::NEG_Z, |p| p.y > chin);
    assert!((0.80..0.95).contains(&((forehead - back) / tall)), "{}", (forehead - back) / tall);
    assert!((0.008..0.035).contains(&(nose - forehead)), "{}", nose - forehead);
    let shoulders = 2.0 * bounds.max.x;
    assert!((1.4..2.2).contains(&(shoulders / wide)), "{}", shoulders / wide);
}

#[test]
fn a_garment_hides_the_shoulders_and_its_collar_stands_off_the_neck() {
    let mesh = clothed(120_000);
    let first =
        (0..mesh.triangles().len() as u32).find(|&triangle| mesh.part(triangle) == Part::Garment).unwrap() as usize;
    assert!(head(20_000).part(19_000) == Part::Body && mesh.part(mesh.triangles().len() as u32 - 1) == Part::Garment);
    let skin =
        Mesh::new(mesh.positions().to_vec(), mesh.normals().to_vec(), mesh.triangles()[..first].to_vec()).unwrap();
    // From before and at half height between chin and base: the garment lies before the skin, at the collar by its thickness.
    let ahead = |x: f32, y: f32| {
        let (triangle, z) = foremost(&mesh, x, y)?;
        let (_, behind) = foremost(&skin, x, y)?;
        (mesh.part(triangle as u32) == Part::Garment).then_some(z - behind)
    };
    for x in [-0.1, -0.04, 0.0, 0.04, 0.1] {
        assert!(ahead(x, 0.0).is_none() && ahead(x, -0.15).is_some_and(|gap| (0.002..0.02).contains(&gap)), "{x}");
    }
    // Down the front of the neck: skin, then the collar's edge, which stands off by more than its foot.
    let gaps: Vec<f32> = (0..60).filter_map(|step| ahead(0.0, -0.09 - 0.001 * step as f32)).collect();
    let [edge, foot] = [gaps[3], gaps[gaps.len() - 1]];
    assert!(edge > 0.006 && edge < 0.02 && foot < edge, "{gaps:?}");
}

/// Of what lies on a line along z, the foremost triangle's index and depth.
fn foremost(mesh: &Mesh, x: f32, y: f32) -> Option<(usize, f32)> {
    let hit = |[a, b, c]: [Vec3; 3]| {
        let area = |p: Vec3, q: Vec3| (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
        let weights = [area(b, c), area(c, a), area(a, b)];
        let sum: f32 = weights.iter().sum();
        let inside = sum != 0.0 && weights.iter().all(|w| w * sum >= 0.0);
        inside.then(|| (weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) / sum)
    };
    let hits = corners(mesh).enumerate().filter_map(|(i, corners)| Some((i, hit(corners)?)));
    hits.max_by(|a, b| a.1.total_cmp(&b.1))
}

#[test]
fn eyeballs_show_between_the_lids_and_only_there() {
    let mesh = head(60_000);
    // The spheres come last, one component each.
    let eye = mesh.triangles().len() - 2 * (mesh.triangles().len() / 70);
    for side in [-1.0, 1.0] {
        let middle = Vec3::new(side * 0.0299, mesh.bounds().max.y - 0.110, 0.0);
        let between: Vec<bool> = (-20..=20)
            .filter_map(|step| foremost(&mesh, middle.x, middle.y + step as f32 * 1e-3))
            .map(|(triangle, _)| triangle >= eye)
            .collect();
        // Upper and lower lid with 6 to 14 mm of the eyeball between them, in one piece.
        let shown = between.iter().filter(|shown| **shown).count();
        assert!((6..=14).contains(&shown), "{side}: {between:?}");
        assert_eq!(between.windows(2).filter(|two| two[0] != two[1]).count(), 2, "{side}: {between:?}");
        assert!(!between[0] && !between[40], "{side}: {between:?}");
    }
    let seen = |x: f32, y: f32| foremost(&mesh, x, mesh.bounds().max.y - y).map(|(triangle, _)| triangle >= eye);
    assert_eq!([seen(0.0, 0.110), seen(0.06, 0.110), seen(0.03, 0.06), seen(0.03, 0.14)], [Some(false); 4]);
}

#[test]
fn finer_meshes_converge() {
    let volumes = [10_000, 40_000, 160_000, 640_000].map(|n| volume(&head(n)));
    let errors: Vec<f64> = volumes[..3].iter().map(|v| (v / volumes[3] - 1.0).abs()).collect();
    assert!(errors[0] < 1e-2 && errors[1] < 2.5e-3 && errors[2] < 6e-4, "{errors:?}");
    assert!(errors[2] < errors[1] / 2.0 && errors[1] < errors[0] / 2.0, "{errors:?}");
    // Liters: of a head with neck and a slice of the shoulders.
    assert!((0.006..0.012).contains(&volumes[3]), "{}", volumes[3]);
}

#[test]
fn the_same_head_twice_for_any_number_of_threads() {
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| head(30_000));
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap().install(|| head(30_000));
    assert_eq!(alone, three);
    assert_eq!(alone, head(30_000));
}

#[test]
fn hair_and_brows_end_within_triangles() {
    let mesh = Stage { hair: true, ..Stage::default() }.about(&head(100_000));
    let corners = |triangle: u32| [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|weights| mesh.part_at(triangle, weights));
    let seen: Vec<[Part; 3]> = (0..mesh.triangles().len() as u32).map(corners).collect();
    for part in [Part::Hair, Part::Brows] {
        assert!(seen.contains(&[part; 3]), "{part:?}");
        assert!(seen.iter().any(|parts| parts.contains(&part) && parts.contains(&Part::Body)), "{part:?}");
    }
}
