//! Binary trees over boxes, built in n log n steps whatever the boxes are.
//!
//! Clustering from the leaves up needs as many passes as there are boxes where many cost the same (coincident, nested or evenly
//! spaced ones). Splitting from the root down by the surface area heuristic in bins (Wald 2007) visits each box once a level, and
//! the number of levels is bounded.

use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, node::Bvh2Node};
use obvhs::triangle::Triangle;
use rayon::prelude::*;

/// Most bins along each axis; small parts have as many as items.
const BINS: usize = 16;
/// Most items that are halved along their longest axis: bins cost more than a better cut saves.
const HALVED: usize = 4;
/// Items that one task sorts into bins.
const RUN: usize = 8192;
/// Levels below the root: what the stack of a traversal has room for.
const DEEPEST: u32 = 31;
/// Triangles from which both halves are built side by side.
const PARALLEL: usize = 4096;

#[derive(Clone, Copy)]
struct Item {
    aabb: Aabb,
    center: Vec3A,
    triangle: u32,
}

/// Part of the tree that is to be built: triangles, and nodes for all below its root.
struct Part<'a> {
    items: &'a mut [Item],
    nodes: &'a mut [Bvh2Node],
    first_item: u32,
    first_node: u32,
    depth: u32,
}

/// Builds a tree with one triangle in each leaf.
pub(super) fn tree(triangles: &[Triangle]) -> Bvh2 {
    let item = |(index, triangle): (usize, &Triangle)| {
        let aabb = triangle.aabb();
        Item { aabb, center: aabb.center(), triangle: index as u32 }
    };
    let mut items: Vec<Item> = triangles.iter().enumerate().map(item).collect();
    let mut tree = Bvh2::zeroed(items.len());
    if let Some((root, nodes)) = tree.nodes.split_first_mut() {
        *root = build(Part { items: &mut items, nodes, first_item: 0, first_node: 1, depth: 0 });
    }
    tree.primitive_indices = items.iter().map(|item| item.triangle).collect();
    tree
}

/// Builds a part and returns its root. n leaves have 2n − 2 nodes below their root, so that each side's nodes are known before
/// it is built.
fn build(part: Part<'_>) -> Bvh2Node {
    let Part { items, nodes, first_item, first_node, depth } = part;
    if let [item] = items {
        return Bvh2Node::new(item.aabb, 1, first_item);
    }
    let extent = Extent::new(items);
    let aabb = extent.items;
    let middle = if items.len() == 2 { 1 } else { split(items, &extent, depth) };
    let is_large = items.len() >= PARALLEL;
    let (left, right) = items.split_at_mut(middle);
    let (children, below) = nodes.split_at_mut(2);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * middle - 2);
    let (first, depth) = (first_node + 2, depth + 1);
    let sides = [
        Part { items: left, first_node: first, nodes: left_nodes, first_item, depth },
        Part {
            items: right,
            first_node: first + 2 * middle as u32 - 2,
            nodes: right_nodes,
            first_item: first_item + middle as u32,
            depth,
        },
    ];
    let [left, right] = sides;
    let (left, right) =
        if is_large { rayon::join(|| build(left), || build(right)) } else { (build(left), build(right)) };
    children.copy_from_slice(&[left, right]);
    Bvh2Node::new(aabb, 0, first_node)
}

/// The boxes around items and around their centers.
struct Extent {
    items: Aabb,
    centers: Aabb,
}

impl Extent {
    fn new(items: &[Item]) -> Self {
        let of = |items: &[Item]| {
            let (mut all, mut centers) = (Aabb::empty(), Aabb::empty());
            for item in items {
                all = all.union(&item.aabb);
                centers.extend(item.center);
            }
            Self { items: all, centers }
        };
        let join = |a: Self, b: Self| Self { items: a.items.union(&b.items), centers: a.centers.union(&b.centers) };
        if items.len() < 2 * RUN {
            return of(items);
        }
        let runs = items.par_chunks(RUN).map(of);
        runs.reduce(|| Self { items: Aabb::empty(), centers: Aabb::empty() }, join)
    }
}

/// Reorders the items and returns how many go to the left: at least one, and no more than fit below this level.
fn split(items: &mut [Item], extent: &Extent, depth: u32) -> usize {
    let most = 1_usize << (DEEPEST.saturating_sub(depth + 1));
    let fits = |left: usize| left > 0 && left < items.len() && left.max(items.len() - left) <= most;
    let cut = if items.len() > HALVED { Bins::new(items, extent).best_cut() } else { None };
    if let Some(cut) = cut.filter(|cut| fits(cut.left)) {
        return partition(items, |item| cut.is_left(item));
    }
    let extent = extent.centers.max - extent.centers.min;
    let axis = (0..3).max_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(0);
    let middle = items.len() / 2;
    if extent[axis] > 0.0 {
        items.select_nth_unstable_by(middle, |a, b| a.center[axis].total_cmp(&b.center[axis]));
    } else {
        // Nested boxes: the small ones apart from the large ones.
        items.select_nth_unstable_by(middle, |a, b| a.aabb.half_area().total_cmp(&b.aabb.half_area()));
    }
    middle
}

/// Brings those that satisfy a condition to the front and counts them.
fn partition(items: &mut [Item], is_left: impl Fn(&Item) -> bool) -> usize {
    let mut left = 0;
    for index in 0..items.len() {
        if is_left(&items[index]) {
            items.swap(left, index);
            left += 1;
        }
    }
    left
}

/// Boxes and counts of the items in each bin of each axis.
struct Bins {
    min: Vec3A,
    scale: Vec3A,
    count: usize,
    axes: Axes,
}

type Axes = [[(Aabb, usize); BINS]; 3];

/// A plane between two bins.
struct Cut {
    axis: usize,
    /// The first bin to the right of it.
    bin: usize,
    left: usize,
    min: Vec3A,
    scale: Vec3A,
    bins: usize,
}

impl Cut {
    fn is_left(&self, item: &Item) -> bool {
        let axis = self.axis;
        bin_on_axis((item.center[axis] - self.min[axis]) * self.scale[axis], self.bins) < self.bin
    }
}

/// The bin on each axis. A center that is on no axis' scale comes to the first.
fn bin(center: Vec3A, min: Vec3A, scale: Vec3A, bins: usize) -> [usize; 3] {
    ((center - min) * scale).to_array().map(|at| bin_on_axis(at, bins))
}

fn bin_on_axis(at: f32, bins: usize) -> usize {
    // Through 32 bits, which processors convert to; no place is below 0.
    (at as i32 as usize).min(bins - 1)
}

impl Bins {
    fn new(items: &[Item], extent: &Extent) -> Self {
        // Below this the bins' own cost exceeds the items'.
        let count = items.len().clamp(4, BINS);
        let (min, extent) = (extent.centers.min, extent.centers.max - extent.centers.min);
        let scale = |extent: f32| if extent > f32::MIN_POSITIVE * 32.0 { count as f32 / extent } else { 0.0 };
        let scale = Vec3A::from_array(extent.to_array().map(scale));
        let sorted = |items: &[Item]| {
            let mut axes = [[(Aabb::empty(), 0); BINS]; 3];
            for item in items {
                for (bins, at) in axes.iter_mut().zip(bin(item.center, min, scale, count)) {
                    let (aabb, count) = &mut bins[at];
                    *aabb = aabb.union(&item.aabb);
                    *count += 1;
                }
            }
            axes
        };
        if items.len() < 2 * RUN {
            return Self { min, scale, count, axes: sorted(items) };
        }
        let join = |mut a: Axes, b: Axes| {
            for (into, from) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
                *into = (into.0.union(&from.0), into.1 + from.1);
            }
            a
        };
        let axes = items.par_chunks(RUN).map(sorted).reduce(|| [[(Aabb::empty(), 0); BINS]; 3], join);
        Self { min, scale, count, axes }
    }

    /// The cut with the least sum over both sides of area times count; none where all are in one bin on every axis.
    fn best_cut(&self) -> Option<Cut> {
        let mut best: Option<(f32, Cut)> = None;
        for (axis, bins) in self.axes.iter().enumerate() {
            let mut right = [0.0; BINS];
            let mut side = (Aabb::empty(), 0);
            for (index, bin) in bins.iter().enumerate().take(self.count).skip(1).rev() {
                side = (side.0.union(&bin.0), side.1 + bin.1);
                right[index] = if side.1 == 0 { f32::INFINITY } else { side.0.half_area() * side.1 as f32 };
            }
            let mut side = (Aabb::empty(), 0);
            for index in 1..self.count {
                let bin = &bins[index - 1];
                side = (side.0.union(&bin.0), side.1 + bin.1);
                let left = if side.1 == 0 { f32::INFINITY } else { side.0.half_area() * side.1 as f32 };
                let cost = left + right[index];
                if cost.is_finite() && best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    let Self { min, scale, count, .. } = *self;
                    best = Some((cost, Cut { axis, bin: index, left: side.1, min, scale, bins: count }));
                }
            }
        }
        best.map(|(_, cut)| cut)
    }
}
