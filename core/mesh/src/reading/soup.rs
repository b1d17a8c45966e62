//! Contents of a file without its format: vertices, normals, polygons of any size.

use super::lines::FARTHEST;
use super::report::{MeshReadError, Place, Quantity, Skipped, Tally};
use super::{MAX_TRIANGLES, MAX_VERTICES};
use glam::Vec3;
use rayon::prelude::*;

/// No normal in the file.
pub(super) const NONE: u32 = u32::MAX;

#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) position: u32,
    /// The normal's index, from 0, or [`NONE`].
    pub(super) normal: u32,
}

/// Method for missing normals.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Smoothing {
    /// Not specified in the file: smooth where faces meet at less than the crease angle.
    Auto,
    Flat,
    /// Smooth where both faces are of this group.
    Group(u32),
}

#[derive(Clone, Default, PartialEq, Eq)]
pub(super) struct Names {
    pub(super) name: String,
    pub(super) material: String,
}

impl Names {
    /// Maximum length of a stored name, in characters.
    pub(super) const LONGEST: usize = 200;
}

/// Vertices, normals and polygons as they stand in the file.
pub(super) struct Soup {
    pub(super) positions: Vec<Vec3>,
    /// The normals, of any length.
    pub(super) normals: Vec<Vec3>,
    /// The corners of all faces, one face after the other.
    pub(super) corners: Vec<Corner>,
    /// For each face the end of its corners.
    ends: Vec<u32>,
    /// For each face its line or its number.
    places: Vec<u32>,
    place: fn(usize) -> Place,
    /// The number of the first vertex.
    first_index: i64,
    /// From which face on which smoothing holds.
    smoothing: Vec<(u32, Smoothing)>,
    /// From which face on which names hold.
    pub(super) groups: Vec<(u32, Names)>,
    /// Number of triangles the faces will make.
    triangles: usize,
    pub(super) skipped: [Tally; Skipped::COUNT],
    pub(super) unnamed_groups: usize,
}

impl Soup {
    /// Nothing yet; faces are placed by lines or by numbers, vertices counted from 0 or 1.
    pub(super) fn new(place: fn(usize) -> Place, first_index: i64) -> Self {
        Self {
            positions: Vec::new(),
            normals: Vec::new(),
            corners: Vec::new(),
            ends: Vec::new(),
            places: Vec::new(),
            place,
            first_index,
            smoothing: Vec::new(),
            groups: Vec::new(),
            triangles: 0,
            skipped: [Tally::default(); Skipped::COUNT],
            unnamed_groups: 0,
        }
    }

    pub(super) fn faces(&self) -> usize {
        self.ends.len()
    }

    pub(super) fn face(&self, face: usize) -> std::ops::Range<usize> {
        let start = if face == 0 { 0 } else { self.ends[face - 1] };
        start as usize..self.ends[face] as usize
    }

    /// The end of a range of faces with about the given number of corners in total; at least one face.
    pub(super) fn faces_within(&self, from: usize, corners: usize) -> usize {
        let reach = self.face(from).start + corners;
        self.ends.partition_point(|&end| end as usize <= reach).max(from + 1)
    }

    pub(super) fn place(&self, face: usize) -> Place {
        (self.place)(self.places[face] as usize)
    }

    /// Method for a face's missing normals.
    pub(super) fn smoothing(&self, face: u32) -> Smoothing {
        let after = self.smoothing.partition_point(|&(first, _)| first <= face);
        if after == 0 { Smoothing::Auto } else { self.smoothing[after - 1].1 }
    }

    #[inline]
    pub(super) fn add_position(&mut self, xyz: [f64; 3], place: Place) -> Result<(), MeshReadError> {
        push(&mut self.positions, xyz, place)
    }

    #[inline]
    pub(super) fn add_normal(&mut self, xyz: [f64; 3], place: Place) -> Result<(), MeshReadError> {
        push(&mut self.normals, xyz, place)
    }

    /// Takes a corner of the face that is next ended.
    #[inline]
    pub(super) fn add_corner(&mut self, corner: Corner, place: Place) -> Result<(), MeshReadError> {
        // Each triangle has three corners at most, however polygons are cut: a single line may not hold more either.
        if self.corners.len() >= 3 * MAX_TRIANGLES {
            return Err(MeshReadError::TooLarge { quantity: Quantity::Triangles, limit: MAX_TRIANGLES, place });
        }
        self.corners.push(corner);
        Ok(())
    }

    /// Ends a face, whose corners were taken since the last one ended.
    #[inline]
    pub(super) fn end_face(&mut self, place: usize) -> Result<(), MeshReadError> {
        let start = self.ends.last().copied().unwrap_or(0) as usize;
        let corners = self.corners.len() - start;
        if corners < 3 {
            return Err(MeshReadError::FaceTooShort { place: (self.place)(place), corners });
        }
        self.triangles += corners - 2;
        if self.triangles > MAX_TRIANGLES {
            let (quantity, limit) = (Quantity::Triangles, MAX_TRIANGLES);
            return Err(MeshReadError::TooLarge { quantity, limit, place: (self.place)(place) });
        }
        self.ends.push(self.corners.len() as u32);
        self.places.push(place as u32);
        Ok(())
    }

    /// From the next face on, this smoothing holds.
    pub(super) fn smooth(&mut self, smoothing: Smoothing) {
        set_from(&mut self.smoothing, self.ends.len() as u32, smoothing);
    }

    /// From the next face on, these names hold.
    pub(super) fn name(&mut self, names: Names) {
        set_from(&mut self.groups, self.ends.len() as u32, names);
    }

    pub(super) fn skip(&mut self, what: Skipped, place: Place) {
        self.skipped[what as usize].add(place);
    }

    /// Makes one of positions that are equal; those that are left keep their order.
    pub(super) fn weld(&mut self) {
        // Coordinates and index in one number: sorting by index alone would look all over the memory.
        let key = |i: usize| {
            let [x, y, z] = self.positions[i].to_array().map(|v| u128::from(v.to_bits()));
            x << 96 | y << 64 | z << 32 | i as u128
        };
        let mut keys: Vec<u128> = (0..self.positions.len()).into_par_iter().map(key).collect();
        keys.par_sort_unstable();
        let mut first: Vec<u32> = vec![NONE; keys.len()];
        for equal in keys.chunk_by(|a, b| a >> 32 == b >> 32) {
            for &key in equal {
                first[key as u32 as usize] = equal[0] as u32;
            }
        }
        drop(keys);
        let mut kept = 0;
        for i in 0..first.len() {
            first[i] = if first[i] as usize == i {
                self.positions[kept] = self.positions[i];
                kept += 1;
                kept as u32 - 1
            } else {
                // The first of equals comes before this one, and has its new index already.
                first[first[i] as usize]
            };
        }
        self.positions.truncate(kept);
        self.positions.shrink_to_fit();
        for corner in &mut self.corners {
            corner.position = first[corner.position as usize];
        }
    }

    /// That all corners name positions and normals that are there.
    pub(super) fn check(&self) -> Result<(), MeshReadError> {
        let (positions, normals) = (self.positions.len(), self.normals.len());
        let is_wrong =
            |c: &Corner| c.position as usize >= positions || (c.normal != NONE && c.normal as usize >= normals);
        let Some(corner) = self.corners.iter().position(is_wrong) else { return Ok(()) };
        let place = self.place(self.ends.partition_point(|&end| end as usize <= corner));
        let Corner { position, normal } = self.corners[corner];
        Err(if position as usize >= positions {
            MeshReadError::NoSuchVertex { place, index: i64::from(position) + self.first_index, count: positions }
        } else {
            MeshReadError::NoSuchNormal { place, index: i64::from(normal) + self.first_index, count: normals }
        })
    }
}

/// Appends three coordinates that are within bounds.
#[inline]
fn push(to: &mut Vec<Vec3>, xyz: [f64; 3], place: Place) -> Result<(), MeshReadError> {
    let [x, y, z] = xyz;
    // Not a number is not below the bound either.
    if !(x.abs() <= FARTHEST && y.abs() <= FARTHEST && z.abs() <= FARTHEST) {
        let finite = x.is_finite() && y.is_finite() && z.is_finite();
        return Err(if finite { MeshReadError::TooFar(place) } else { MeshReadError::NotFinite(place) });
    }
    if to.len() >= MAX_VERTICES {
        return Err(MeshReadError::TooLarge { quantity: Quantity::Vertices, limit: MAX_VERTICES, place });
    }
    // Negative zero equals zero, so it must not count as another place.
    to.push(Vec3::new(x as f32, y as f32, z as f32) + 0.0);
    Ok(())
}

/// Appends what holds from a face on, in place of what would hold for no face, and not where nothing changes.
fn set_from<T: PartialEq>(runs: &mut Vec<(u32, T)>, face: u32, value: T) {
    if runs.last().is_some_and(|(first, _)| *first == face) {
        runs.pop();
    }
    if runs.last().is_none_or(|(_, last)| *last != value) {
        runs.push((face, value));
    }
}
