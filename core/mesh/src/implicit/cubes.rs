//! How the surface passes a cell, for each of the 256 ways its corners can lie inside or outside.

/// The corners of a cell's edges as bits: 1 for x, 2 for y, 4 for z. Edge `4 a + n` is along axis a.
pub(super) const EDGES: [[usize; 2]; 12] = edges();

/// For each set of inside corners, as bits, the triangles through the crossed edges, counter-clockwise from outside.
pub(super) struct Cubes(Vec<Vec<[u8; 3]>>);

const fn edges() -> [[usize; 2]; 12] {
    let mut edges = [[0; 2]; 12];
    let mut n = 0;
    while n < 12 {
        let axis = n / 4;
        let (side, up) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let low = (n % 2) * side + (n % 4 / 2) * up;
        edges[n] = [low, low | (1 << axis)];
        n += 1;
    }
    edges
}

impl Cubes {
    /// Works the table out.
    pub(super) fn new() -> Self {
        Self((0..256).map(triangles).collect())
    }

    /// The triangles of a cell with these inside corners.
    pub(super) fn triangles(&self, inside: u8) -> &[[u8; 3]] {
        &self.0[usize::from(inside)]
    }
}

/// The four corners of each face, counter-clockwise seen from outside the cell.
fn faces() -> [[usize; 4]; 6] {
    std::array::from_fn(|n| {
        let axis = n / 2;
        let (side, up) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let cycle = [0, side, side | up, up];
        if n % 2 == 1 { cycle.map(|c| c | (1 << axis)) } else { [cycle[3], cycle[2], cycle[1], cycle[0]] }
    })
}

/// The edge between two corners.
fn edge(a: usize, b: usize) -> usize {
    EDGES.iter().position(|e| *e == [a.min(b), a.max(b)]).expect("neighbors on a face share an edge")
}

/// Whether two edges lie on one face.
fn share_face(a: usize, b: usize) -> bool {
    let [corners_a, corners_b] = [a, b].map(|e| EDGES[e]);
    let all = corners_a[0] & corners_a[1] & corners_b[0] & corners_b[1];
    let any = corners_a[0] | corners_a[1] | corners_b[0] | corners_b[1];
    all != 0 || any != 7
}

fn triangles(inside: usize) -> Vec<[u8; 3]> {
    let is_in = |corner: usize| inside >> corner & 1 == 1;
    // On each face the inside corners are cut off one run at a time, which the neighbor across the face does alike.
    let mut next = [None; 12];
    for face in faces() {
        for k in 0..4 {
            if is_in(face[k]) || !is_in(face[(k + 1) % 4]) {
                continue;
            }
            let run = (1..4).find(|&r| !is_in(face[(k + r + 1) % 4])).expect("one corner of the run's face is outside");
            let leave = (k + run) % 4;
            let (from, to) = (edge(face[k], face[(k + 1) % 4]), edge(face[leave], face[(leave + 1) % 4]));
            next[from] = Some(to);
        }
    }
    let mut triangles = Vec::new();
    for start in 0..12 {
        let mut polygon = Vec::new();
        let mut at = start;
        while let Some(following) = next[at].take() {
            polygon.push(at);
            at = following;
        }
        if polygon.len() >= 3 {
            cut(&polygon, &mut triangles);
        }
    }
    triangles
}

/// Cuts a polygon into triangles, if it can be without a diagonal on a face: the neighbor might draw the same.
fn cut(polygon: &[usize], triangles: &mut Vec<[u8; 3]>) {
    let n = polygon.len();
    if n == 3 {
        triangles.push([polygon[0] as u8, polygon[1] as u8, polygon[2] as u8]);
        return;
    }
    let free = |k: usize| !share_face(polygon[(k + n - 1) % n], polygon[(k + 1) % n]);
    let rest = |k: usize| -> Vec<usize> { (1..n).map(|i| polygon[(k + i) % n]).collect() };
    let ear = (0..n).find(|&k| free(k) && can_cut(&rest(k))).or_else(|| (0..n).find(|&k| free(k))).unwrap_or(0);
    triangles.push([polygon[(ear + n - 1) % n] as u8, polygon[ear] as u8, polygon[(ear + 1) % n] as u8]);
    cut(&rest(ear), triangles);
}

/// Whether a polygon can be cut without a diagonal on a face.
fn can_cut(polygon: &[usize]) -> bool {
    let n = polygon.len();
    n == 3
        || (0..n).any(|k| {
            let rest: Vec<usize> = (1..n).map(|i| polygon[(k + i) % n]).collect();
            !share_face(polygon[(k + n - 1) % n], polygon[(k + 1) % n]) && can_cut(&rest)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lone_corner_faces_outward() {
        let table = Cubes::new();
        let [[a, b, c]] = table.triangles(1) else { panic!("one triangle") };
        let point = |e: u8| {
            let [low, high] = EDGES[usize::from(e)];
            glam::Vec3::from_array(std::array::from_fn(|k| ((low >> k & 1) + (high >> k & 1)) as f32 / 2.0))
        };
        let normal = (point(*b) - point(*a)).cross(point(*c) - point(*a));
        assert!(normal.dot(glam::Vec3::ONE) > 0.0);
    }

    #[test]
    fn no_inner_edge_lies_on_a_face() {
        let table = Cubes::new();
        for inside in 0..=255 {
            let triangles = table.triangles(inside);
            let edges: Vec<[u8; 2]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
            for [a, b] in &edges {
                if edges.contains(&[*b, *a]) {
                    assert!(!share_face(usize::from(*a), usize::from(*b)), "corners {inside:08b}");
                }
            }
        }
    }
}
