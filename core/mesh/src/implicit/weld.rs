//! Joining the blocks.

use super::blocks::Block;
use glam::Vec3;
use rayon::prelude::*;
use std::ops::Range;

/// The surface on one side of the plane x = 0, in one piece.
pub(super) struct Half<F> {
    /// The vertices.
    pub positions: Vec<Vec3>,
    /// Which vertices lie on the plane x = 0.
    pub on_plane: Vec<bool>,
    /// The size of the cells around each vertex, in meters.
    pub cell: Vec<f32>,
    /// Triangles as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
    /// The function around each range of vertices; the ranges follow one another.
    pub fields: Vec<(Range<usize>, F)>,
}

/// One vertex for each edge of the grid, however many blocks have it.
pub(super) fn weld<F>(blocks: Vec<Block<F>>) -> Half<F> {
    let mut entries: Vec<(u64, u32)> =
        blocks.iter().flat_map(|b| &b.vertices).zip(0..).map(|(vertex, slot)| (vertex.key, slot)).collect();
    entries.par_sort_unstable();
    // The first of equal keys stands for all.
    let mut index = vec![u32::MAX; entries.len()];
    for group in entries.chunk_by(|a, b| a.0 == b.0) {
        for entry in group {
            index[entry.1 as usize] = group[0].1;
        }
    }
    let mut half = Half {
        positions: Vec::new(),
        on_plane: Vec::new(),
        cell: Vec::new(),
        triangles: Vec::new(),
        fields: Vec::new(),
    };
    let mut slot = 0;
    for block in blocks {
        let (first, begin) = (slot, half.positions.len());
        for vertex in &block.vertices {
            if index[slot] as usize == slot {
                index[slot] = half.positions.len() as u32;
                half.positions.push(vertex.position);
                half.on_plane.push(vertex.on_plane);
                half.cell.push(vertex.cell);
            } else {
                // An earlier slot, which has its final number by now.
                index[slot] = index[index[slot] as usize];
            }
            slot += 1;
        }
        half.triangles.extend(block.triangles.iter().map(|t| t.map(|v| index[first + v as usize])));
        half.fields.push((begin..half.positions.len(), block.field));
    }
    half
}
