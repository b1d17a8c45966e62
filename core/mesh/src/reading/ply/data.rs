//! The records of a PLY file.

use super::header::{Content, Element, Encoding, Property, Role, Scalar};
use crate::reading::MAX_TRIANGLES;
use crate::reading::error::{MeshReadError, Place, Quantity};
use crate::reading::lines::Cursor;

/// Values of a record; the next one reuses its memory.
#[derive(Default)]
pub(super) struct Record {
    /// x, y, z, and the normal's x, y, z.
    pub(super) values: [f64; 6],
    pub(super) corners: Vec<f64>,
}

pub(super) struct Data<'a> {
    encoding: Encoding,
    cursor: Cursor<'a>,
    /// Unread rest of a binary file.
    rest: &'a [u8],
}

impl<'a> Data<'a> {
    pub(super) fn new(encoding: Encoding, cursor: Cursor<'a>) -> Self {
        let rest = cursor.left();
        Self { encoding, cursor, rest }
    }

    /// The place of a record by its number: the line that is read, or the number.
    pub(super) fn place(&self, content: Content, number: usize) -> Place {
        match (self.encoding, content) {
            (Encoding::Text, _) => Place::Line(self.cursor.first_line()),
            (_, Content::Vertices) => Place::Vertex(number),
            _ => Place::Face(number),
        }
    }

    pub(super) fn read(&mut self, element: &Element, number: usize, record: &mut Record) -> Result<(), MeshReadError> {
        let truncated = MeshReadError::Truncated {
            place: match element.content {
                Content::Vertices => Place::Vertex(number),
                _ => Place::Face(number),
            },
            announced: element.count,
        };
        if self.encoding == Encoding::Text {
            self.cursor.skip_empty_lines();
            if self.cursor.is_done() {
                return Err(truncated);
            }
        }
        record.corners.clear();
        let line = self.cursor.first_line();
        let mut found = 0;
        let syntax = MeshReadError::Syntax(self.place(element.content, number));
        // Words can be missing on a line; in a binary file only its end can.
        let missing = |found| match (self.encoding, element.content) {
            (Encoding::Text, Content::Vertices) if found < 3 => MeshReadError::TooFewNumbers { line, found },
            (Encoding::Text, _) => syntax,
            _ => truncated,
        };
        for Property { role, length, scalar } in &element.properties {
            let count = match length {
                None => 1,
                Some(length) => {
                    let count = value(self.encoding, &mut self.cursor, &mut self.rest, *length)?;
                    index_from(count.ok_or(missing(found))?).ok_or(syntax)?
                }
            };
            if *role == Role::Corners && count as usize > 3 * MAX_TRIANGLES {
                let (quantity, limit) = (Quantity::Triangles, MAX_TRIANGLES);
                return Err(MeshReadError::TooLarge { quantity, limit, place: self.place(element.content, number) });
            }
            for _ in 0..count {
                let value = value(self.encoding, &mut self.cursor, &mut self.rest, *scalar)?.ok_or(missing(found))?;
                found += 1;
                match *role {
                    Role::Value(place) => record.values[place] = value,
                    Role::Corners => record.corners.push(value),
                    Role::Other => {}
                }
            }
        }
        Ok(())
    }

    pub(super) fn next(&mut self) {
        if self.encoding == Encoding::Text {
            self.cursor.next_line();
        }
    }
}

/// The next value; none where there is none on the line or in the file.
fn value(
    encoding: Encoding,
    cursor: &mut Cursor<'_>,
    rest: &mut &[u8],
    scalar: Scalar,
) -> Result<Option<f64>, MeshReadError> {
    let big = match encoding {
        Encoding::Text => return cursor.number(),
        Encoding::Little => false,
        Encoding::Big => true,
    };
    Ok(match scalar {
        Scalar::I8 => take(rest, big).map(|bytes| f64::from(i8::from_le_bytes(bytes))),
        Scalar::U8 => take(rest, big).map(|bytes| f64::from(u8::from_le_bytes(bytes))),
        Scalar::I16 => take(rest, big).map(|bytes| f64::from(i16::from_le_bytes(bytes))),
        Scalar::U16 => take(rest, big).map(|bytes| f64::from(u16::from_le_bytes(bytes))),
        Scalar::I32 => take(rest, big).map(|bytes| f64::from(i32::from_le_bytes(bytes))),
        Scalar::U32 => take(rest, big).map(|bytes| f64::from(u32::from_le_bytes(bytes))),
        Scalar::F32 => take(rest, big).map(|bytes| f64::from(f32::from_le_bytes(bytes))),
        Scalar::F64 => take(rest, big).map(f64::from_le_bytes),
    })
}

/// The next bytes, the least first.
fn take<const N: usize>(rest: &mut &[u8], big: bool) -> Option<[u8; N]> {
    let (bytes, left) = rest.split_first_chunk::<N>()?;
    *rest = left;
    let mut bytes = *bytes;
    if big {
        bytes.reverse();
    }
    Some(bytes)
}

/// A value as an index or a length; none where it is no whole number from 0.
pub(super) fn index_from(value: f64) -> Option<u32> {
    (value >= 0.0 && value < f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u32)
}
