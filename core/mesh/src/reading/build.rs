//! Conversion of a file's contents to a mesh: vertices split where normals differ, missing normals computed.

use super::edges::{Edges, survey};
use super::report::{MeshReadError, Normals, Report};
use super::soup::{Corner, NONE, Soup};
use super::triangulate::{Cut, cut};
use super::{Group, Kind, ReadMesh};
use crate::mesh::{Mesh, smooth_normals};
use glam::Vec3;

/// Largest number of vertices at one position that are compared: keeps the time proportional.
const MOST_COMPARED: usize = 64;

pub(super) fn build(soup: &Soup, kind: Kind, stop: &dyn Fn() -> bool) -> Result<ReadMesh, MeshReadError> {
    if soup.faces() == 0 {
        return Err(MeshReadError::NoFaces(soup.positions.len()));
    }
    let cut = cut(soup, stop)?;
    if cut.triangles.is_empty() {
        let place = cut.degenerate.first.unwrap_or(soup.place(0));
        return Err(MeshReadError::NoArea { triangles: cut.degenerate.count, place });
    }
    let edges = survey(soup, &cut, stop)?;
    if stop() {
        return Err(MeshReadError::Stopped);
    }
    let mut vertices = Vertices::new(soup.positions.len());
    let triangles: Vec<[u32; 3]> = (0..cut.triangles.len() as u32)
        .map(|t| {
            let corners = cut.triangles[t as usize];
            std::array::from_fn(|k| {
                vertices.index(soup, soup.corners[corners[k] as usize], edges.fan(3 * t + k as u32))
            })
        })
        .collect();
    let computed = triangles.as_flattened().iter().filter(|&&i| vertices.normals[i as usize] == NONE).count();
    if stop() {
        return Err(MeshReadError::Stopped);
    }
    let report = report(soup, kind, &cut, &edges, computed);
    let positions: Vec<Vec3> = vertices.positions.iter().map(|&i| soup.positions[i as usize]).collect();
    let mut normals =
        if computed > 0 { smooth_normals(&positions, &triangles) } else { vec![Vec3::ZERO; positions.len()] };
    for (normal, &read) in normals.iter_mut().zip(&vertices.normals) {
        if read != NONE {
            *normal = soup.normals[read as usize];
        }
    }
    let mesh =
        Mesh::new(positions, normals, triangles).expect("corners were checked, and coordinates are finite and few");
    let report = Report { far_from_origin: is_far(&mesh), ..report };
    Ok(ReadMesh { mesh, groups: groups(soup, &cut), report })
}

/// The mesh's vertices: each a position with a normal from the file, or with the fan of corners that share one.
struct Vertices {
    /// The position of each vertex, as an index among the soup's.
    positions: Vec<u32>,
    /// The normal of each vertex, as an index among the soup's, or [`NONE`].
    normals: Vec<u32>,
    fans: Vec<u32>,
    /// The vertex made before at the same position, or [`NONE`].
    before: Vec<u32>,
    /// The vertex made last at each position, or [`NONE`].
    last: Vec<u32>,
}

impl Vertices {
    fn new(positions: usize) -> Self {
        let last = vec![NONE; positions];
        Self { positions: Vec::new(), normals: Vec::new(), fans: Vec::new(), before: Vec::new(), last }
    }

    /// The vertex of a corner, made where there is none yet.
    fn index(&mut self, soup: &Soup, corner: Corner, fan: u32) -> u32 {
        let normal = usable(soup, corner.normal);
        let fan = if normal == NONE { fan } else { NONE };
        let mut vertex = self.last[corner.position as usize];
        for _ in 0..MOST_COMPARED {
            if vertex == NONE {
                break;
            }
            if self.fans[vertex as usize] == fan && is_same(soup, self.normals[vertex as usize], normal) {
                return vertex;
            }
            vertex = self.before[vertex as usize];
        }
        let vertex = self.positions.len() as u32;
        self.positions.push(corner.position);
        self.normals.push(normal);
        self.fans.push(fan);
        self.before.push(std::mem::replace(&mut self.last[corner.position as usize], vertex));
        vertex
    }
}

/// True if two normals, or the lack of them, are the same; exporters repeat equal normals for each corner.
fn is_same(soup: &Soup, a: u32, b: u32) -> bool {
    a == b || (a != NONE && b != NONE && soup.normals[a as usize] == soup.normals[b as usize])
}

/// A normal's index, or [`NONE`] where the normal has no length and must be computed.
pub(super) fn usable(soup: &Soup, normal: u32) -> u32 {
    if normal == NONE || soup.normals[normal as usize] == Vec3::ZERO { NONE } else { normal }
}

/// The counts, except those known only for the finished mesh.
fn report(soup: &Soup, kind: Kind, cut: &Cut, edges: &Edges, computed: usize) -> Report {
    let normals = match computed {
        0 => Normals::Read,
        n if n == 3 * cut.triangles.len() => Normals::Computed,
        computed => Normals::Mixed { computed },
    };
    Report {
        kind,
        vertices: soup.positions.len(),
        polygons: soup.faces(),
        triangles: cut.triangles.len(),
        normals,
        degenerate: cut.degenerate,
        crossing: cut.crossing,
        non_manifold_edges: edges.non_manifold,
        duplicates: edges.duplicates,
        boundary_edges: edges.boundary,
        flipped: edges.flipped,
        inside_out: edges.is_closed() && volume(soup, cut) < 0.0,
        against_winding: against_winding(soup, cut),
        unused_vertices: edges.unused,
        far_from_origin: false,
        skipped: Report::skipped_list(&soup.skipped),
        unnamed_groups: soup.unnamed_groups,
    }
}

/// Six times the volume that triangles enclose, positive where they face outwards.
fn volume(soup: &Soup, cut: &Cut) -> f64 {
    let at = |i: u32| soup.positions[soup.corners[i as usize].position as usize].as_dvec3();
    let origin = at(cut.triangles[0][0]);
    cut.triangles.iter().map(|t| t.map(|i| at(i) - origin)).map(|[a, b, c]| a.dot(b.cross(c))).sum()
}

/// Number of triangles with three normals from the file whose sum points to their back.
fn against_winding(soup: &Soup, cut: &Cut) -> usize {
    let is_against = |triangle: &&[u32; 3]| {
        let corners = triangle.map(|i| soup.corners[i as usize]);
        if corners.iter().any(|c| usable(soup, c.normal) == NONE) {
            return false;
        }
        let [a, b, c] = corners.map(|c| soup.positions[c.position as usize].as_dvec3());
        let sum: glam::DVec3 =
            corners.iter().map(|c| soup.normals[c.normal as usize].as_dvec3().normalize_or_zero()).sum();
        (b - a).cross(c - a).dot(sum) < 0.0
    };
    cut.triangles.iter().filter(is_against).count()
}

/// True if the mesh lies so far out that its coordinates have less than about a thousand steps across it.
fn is_far(mesh: &Mesh) -> bool {
    let bounds = mesh.bounds();
    let far = bounds.min.abs().max(bounds.max.abs()).max_element();
    f64::from(far) > 1e4 * (bounds.max.as_dvec3() - bounds.min.as_dvec3()).max_element()
}

fn groups(soup: &Soup, cut: &Cut) -> Vec<Group> {
    let start = |i: usize| {
        let first = soup.groups.get(i).map_or(u32::MAX, |(first, _)| *first);
        cut.faces.partition_point(|&face| face < first)
    };
    let mut groups = Vec::new();
    let before = start(0);
    if before > 0 {
        groups.push(Group { name: String::new(), material: String::new(), triangles: 0..before });
    }
    for (i, (_, names)) in soup.groups.iter().enumerate() {
        let triangles = start(i)..start(i + 1);
        if !triangles.is_empty() {
            groups.push(Group { name: names.name.clone(), material: names.material.clone(), triangles });
        }
    }
    groups
}
