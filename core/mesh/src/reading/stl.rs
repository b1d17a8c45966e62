//! STL, as text or binary: triangles with their corners' coordinates, which are welded where they are equal.
//!
//! Own implementation, on the tokenizer and soup of the OBJ reader: `stl_io` 0.11 reports no lines. The facets' normals
//! are ignored, as the order of the corners gives the same, and so are the two bytes after each facet of a binary file.

use super::lines::Cursor;
use super::report::{MeshReadError, Place, Quantity};
use super::soup::{Corner, NONE, Names, Soup};
use super::{MAX_TRIANGLES, look};

/// The bytes before the first facet: a remark of 80 and the number of facets.
const HEADER: usize = 84;

/// The bytes of a facet: a normal and three corners in single precision, and two more.
const FACET: usize = 50;

/// Number of facets a binary file announces; none where the header is not whole.
pub(super) fn announced(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..)?.first_chunk()?;
    usize::try_from(u32::from_le_bytes(*count)).ok()
}

/// True if the number of facets that a binary file announces is that of those it has.
pub(super) fn is_whole_binary(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|count| {
        let facets = count.checked_mul(FACET);
        count > 0 && facets.and_then(|facets| facets.checked_add(HEADER)) == Some(bytes.len())
    })
}

pub(super) fn read_binary(bytes: &[u8], stop: &dyn Fn() -> bool) -> Result<Soup, MeshReadError> {
    let announced = announced(bytes).ok_or(MeshReadError::Truncated { place: Place::Face(1), announced: 1 })?;
    if announced > MAX_TRIANGLES {
        let (quantity, limit) = (Quantity::Triangles, MAX_TRIANGLES);
        return Err(MeshReadError::TooLarge { quantity, limit, place: Place::Face(MAX_TRIANGLES + 1) });
    }
    let (facets, _) = bytes[HEADER..].as_chunks::<FACET>();
    if facets.len() < announced {
        return Err(MeshReadError::Truncated { place: Place::Face(facets.len() + 1), announced });
    }
    let mut soup = Soup::new(Place::Face, 1);
    for (i, facet) in facets[..announced].iter().enumerate() {
        look(i, stop)?;
        let (values, _) = facet.as_chunks::<4>();
        for corner in values[3..].chunks_exact(3) {
            let xyz = [corner[0], corner[1], corner[2]].map(|value| f64::from(f32::from_le_bytes(value)));
            add_corner(&mut soup, xyz, Place::Face(i + 1))?;
        }
        soup.end_face(i + 1)?;
    }
    soup.weld();
    Ok(soup)
}

pub(super) fn read_text(bytes: &[u8], stop: &dyn Fn() -> bool) -> Result<Soup, MeshReadError> {
    let mut cursor = Cursor::new(bytes);
    let mut soup = Soup::new(Place::Line, 1);
    let mut facet = None;
    let mut lines = 0_usize;
    while !cursor.is_done() {
        if let Some(keyword) = cursor.word() {
            let is = |word: &[u8]| keyword.text.eq_ignore_ascii_case(word);
            if is(b"vertex") {
                let xyz = cursor.three()?;
                add_corner(&mut soup, xyz, Place::Line(keyword.line))?;
            } else if is(b"facet") {
                if let Some(line) = facet.replace(keyword.line) {
                    return Err(MeshReadError::Unfinished(line));
                }
            } else if is(b"endfacet") {
                let line = facet.take().ok_or(MeshReadError::Syntax(Place::Line(keyword.line)))?;
                soup.end_face(line)?;
            } else if is(b"solid") {
                let name = String::from_utf8_lossy(cursor.rest()).chars().take(Names::LONGEST).collect();
                soup.name(Names { name, material: String::new() });
            } else if ![&b"outer"[..], b"endloop", b"endsolid"].iter().any(|word| is(word)) {
                return Err(MeshReadError::Syntax(Place::Line(keyword.line)));
            }
        }
        cursor.next_line();
        lines += 1;
        look(lines, stop)?;
    }
    if let Some(line) = facet {
        return Err(MeshReadError::Unfinished(line));
    }
    soup.weld();
    Ok(soup)
}

/// Takes a corner with a position of its own.
fn add_corner(soup: &mut Soup, xyz: [f64; 3], place: Place) -> Result<(), MeshReadError> {
    let position = soup.positions.len() as u32;
    soup.add_position(xyz, place)?;
    soup.add_corner(Corner { position, normal: NONE }, place)
}
