//! Filling simple polygons: egui itself fills convex ones only.

use egui::{Color32, Mesh, Painter, Pos2, Shape, Stroke};

pub(super) fn fill(painter: &Painter, corners: &[Pos2], color: Color32) {
    let mut corners = corners.to_vec();
    corners.dedup();
    if corners.len() < 3 {
        return;
    }
    if is_convex(&corners) {
        painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
        return;
    }
    let mut mesh = Mesh::default();
    for corner in &corners {
        mesh.colored_vertex(*corner, color);
    }
    for [a, b, c] in ears(&corners) {
        mesh.add_triangle(a, b, c);
    }
    painter.add(mesh);
}

fn cross(a: Pos2, b: Pos2, c: Pos2) -> f32 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

fn is_convex(corners: &[Pos2]) -> bool {
    let n = corners.len();
    let turn = |i: usize| cross(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
    let (left, right) =
        (0..n).map(turn).fold((true, true), |(left, right), turn| (left && turn >= 0.0, right && turn <= 0.0));
    // A star that winds twice also turns one way only; figures draw no such outlines.
    left || right
}

/// Cuts off ears until nothing is left. Outlines that cross themselves leave a rest unfilled.
fn ears(corners: &[Pos2]) -> Vec<[u32; 3]> {
    let n = corners.len();
    let area: f32 = (0..n).map(|i| cross(Pos2::ZERO, corners[i], corners[(i + 1) % n])).sum();
    let mut left: Vec<usize> = if area >= 0.0 { (0..n).collect() } else { (0..n).rev().collect() };
    let mut triangles = Vec::with_capacity(n.saturating_sub(2));
    while left.len() > 2 {
        let Some(ear) = (0..left.len()).find(|i| is_ear(corners, &left, *i)) else {
            break;
        };
        let [a, b, c] = around(&left, ear);
        triangles.push([a as u32, b as u32, c as u32]);
        left.remove(ear);
    }
    triangles
}

fn around(left: &[usize], i: usize) -> [usize; 3] {
    let n = left.len();
    [left[(i + n - 1) % n], left[i], left[(i + 1) % n]]
}

fn is_ear(corners: &[Pos2], left: &[usize], i: usize) -> bool {
    let ear = around(left, i);
    let [a, b, c] = ear.map(|j| corners[j]);
    let inside = |p: Pos2| cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
    cross(a, b, c) >= 0.0 && !left.iter().any(|j| !ear.contains(j) && cross(a, b, c) > 0.0 && inside(corners[*j]))
}
