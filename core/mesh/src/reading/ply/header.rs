//! The header of a PLY file: what follows, how much of it, and in which types.

use crate::reading::error::{MeshReadError, Place};
use crate::reading::lines::Cursor;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Words, one record on a line.
    Text,
    /// Least byte first.
    Little,
    /// Greatest byte first.
    Big,
}

#[derive(Clone, Copy)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    /// The type of a name, of which there are two sets.
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    Vertices,
    Faces,
    Other,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// One of x, y, z, and the normal's x, y, z.
    Value(usize),
    Corners,
    /// Read over.
    Other,
}

/// One value, or one list, of each record.
pub(super) struct Property {
    pub(super) role: Role,
    /// The type of a list's length; none for a single value.
    pub(super) length: Option<Scalar>,
    pub(super) scalar: Scalar,
}

pub(super) struct Element {
    pub(super) content: Content,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
    line: usize,
}

impl Element {
    pub(super) fn has_normals(&self) -> bool {
        (3..6).all(|i| self.has(Role::Value(i)))
    }

    pub(super) fn has_more(&self) -> bool {
        self.has(Role::Other)
    }

    fn has(&self, role: Role) -> bool {
        self.properties.iter().any(|property| property.role == role)
    }

    fn is_complete(&self) -> bool {
        match self.content {
            Content::Vertices => (0..3).all(|i| self.has(Role::Value(i))),
            Content::Faces => self.has(Role::Corners),
            Content::Other => true,
        }
    }
}

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

/// Reads the header; the cursor is where the data begins.
pub(super) fn read(bytes: &[u8]) -> Result<(Header, Cursor<'_>), MeshReadError> {
    let mut cursor = Cursor::new(bytes);
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let line = cursor.first_line();
        let wrong = MeshReadError::Syntax(Place::Line(line));
        if cursor.is_done() {
            return Err(wrong);
        }
        match cursor.word().map(|word| word.text) {
            // Names of files in a remark may end with a backslash, which continues nothing.
            None | Some(b"ply" | b"comment" | b"obj_info") => drop(cursor.rest()),
            Some(b"format") => {
                encoding = Some(match cursor.word().map(|word| word.text) {
                    Some(b"ascii") => Encoding::Text,
                    Some(b"binary_little_endian") => Encoding::Little,
                    Some(b"binary_big_endian") => Encoding::Big,
                    _ => return Err(wrong),
                });
            }
            Some(b"element") => elements.push(element(&mut cursor, line).ok_or(wrong)?),
            Some(b"property") => {
                let element = elements.last_mut().ok_or(wrong)?;
                let property = property(&mut cursor, element.content).ok_or(wrong)?;
                element.properties.push(property);
            }
            Some(b"end_header") => {
                cursor.next_line();
                let encoding = encoding.ok_or(wrong)?;
                if let Some(element) = elements.iter().find(|element| element.count > 0 && !element.is_complete()) {
                    return Err(MeshReadError::Syntax(Place::Line(element.line)));
                }
                return Ok((Header { encoding, elements }, cursor));
            }
            Some(_) => return Err(wrong),
        }
        cursor.next_line();
    }
}

/// An element after its keyword: a name and a count.
fn element(cursor: &mut Cursor<'_>, line: usize) -> Option<Element> {
    let content = match cursor.word()?.text {
        b"vertex" => Content::Vertices,
        b"face" => Content::Faces,
        _ => Content::Other,
    };
    let count = std::str::from_utf8(cursor.word()?.text).ok()?.parse().ok()?;
    Some(Element { content, count, properties: Vec::new(), line })
}

/// A property after its keyword: a type and a name, or `list`, two types and a name.
fn property(cursor: &mut Cursor<'_>, content: Content) -> Option<Property> {
    let first = cursor.word()?.text;
    let length = if first == b"list" { Some(Scalar::named(cursor.word()?.text)?) } else { None };
    let scalar = Scalar::named(if length.is_some() { cursor.word()?.text } else { first })?;
    let name = cursor.word()?.text;
    let place = [&b"x"[..], b"y", b"z", b"nx", b"ny", b"nz"].iter().position(|known| *known == name);
    let role = match (content, place) {
        (Content::Vertices, Some(place)) if length.is_none() => Role::Value(place),
        (Content::Faces, _) if length.is_some() && matches!(name, b"vertex_indices" | b"vertex_index") => Role::Corners,
        _ => Role::Other,
    };
    Some(Property { role, length, scalar })
}
