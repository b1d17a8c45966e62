//! Stanford PLY, as text or binary of either byte order.
//!
//! By its own hand, on the words and the soup that OBJ has anyway: `ply-rs-bw` 4 reads all values before it gives any, so
//! that it can neither be stopped nor held to a limit, and its errors are texts.

use super::lines::Cursor;
use super::report::{MeshReadError, Place, Quantity, Skipped};
use super::soup::{Corner, NONE, Soup};
use super::{MAX_TRIANGLES, look};

pub(super) fn read(bytes: &[u8], stop: &dyn Fn() -> bool) -> Result<Soup, MeshReadError> {
    let (header, cursor) = header(bytes)?;
    let mut soup = Soup::new(if header.encoding == Encoding::Text { Place::Line } else { Place::Face }, 0);
    let has_normals = header.elements.iter().any(|e| e.content == Content::Vertices && e.has_normals());
    let mut data = Data::new(header.encoding, cursor);
    for element in &header.elements {
        records(element, &mut data, &mut soup, has_normals, stop)?;
    }
    soup.check()?;
    Ok(soup)
}

fn records(
    element: &Element,
    data: &mut Data<'_>,
    soup: &mut Soup,
    has_normals: bool,
    stop: &dyn Fn() -> bool,
) -> Result<(), MeshReadError> {
    // What takes no bytes could be announced in any number.
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut record = Record::default();
    for n in 1..=element.count {
        look(n, stop)?;
        data.read(element, n, &mut record)?;
        let place = data.place(element.content, n);
        match element.content {
            Content::Vertices => {
                let [x, y, z, normal @ ..] = record.values;
                soup.add_position([x, y, z], place)?;
                if has_normals {
                    soup.add_normal(normal, place)?;
                }
                if element.has_more() {
                    soup.skip(Skipped::VertexColors, place);
                }
            }
            Content::Faces => {
                for &index in &record.corners {
                    let wrong = MeshReadError::NoSuchVertex { place, index: index as i64, count: soup.positions.len() };
                    let position = index_from(index).ok_or(wrong)?;
                    let normal = if has_normals { position } else { NONE };
                    soup.add_corner(Corner { position, normal }, place)?;
                }
                let (Place::Line(number) | Place::Face(number) | Place::Vertex(number)) = place;
                soup.end_face(number)?;
            }
            Content::Other => soup.skip(Skipped::Elements, place),
        }
        data.next();
    }
    Ok(())
}

/// Values of a record; the next one reuses its memory.
#[derive(Default)]
struct Record {
    /// x, y, z, and the normal's x, y, z.
    values: [f64; 6],
    corners: Vec<f64>,
}

struct Data<'a> {
    encoding: Encoding,
    cursor: Cursor<'a>,
    /// Unread rest of a binary file.
    rest: &'a [u8],
}

impl<'a> Data<'a> {
    fn new(encoding: Encoding, cursor: Cursor<'a>) -> Self {
        let rest = cursor.left();
        Self { encoding, cursor, rest }
    }

    /// The place of a record by its number: the line that is read, or the number.
    fn place(&self, content: Content, number: usize) -> Place {
        match (self.encoding, content) {
            (Encoding::Text, _) => Place::Line(self.cursor.first_line()),
            (_, Content::Vertices) => Place::Vertex(number),
            _ => Place::Face(number),
        }
    }

    fn read(&mut self, element: &Element, number: usize, record: &mut Record) -> Result<(), MeshReadError> {
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

    fn next(&mut self) {
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
    match encoding {
        Encoding::Text => cursor.number(),
        Encoding::Little => Ok((scalar.0)(rest, false)),
        Encoding::Big => Ok((scalar.0)(rest, true)),
    }
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
fn index_from(value: f64) -> Option<u32> {
    (value >= 0.0 && value < f64::from(u32::MAX) && value.fract() == 0.0).then_some(value as u32)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
    /// Words, one record on a line.
    Text,
    /// Least byte first.
    Little,
    /// Greatest byte first.
    Big,
}

/// Takes a value off the bytes of a binary file; none where they end within it. True for the greatest byte first.
#[derive(Clone, Copy)]
struct Scalar(fn(&mut &[u8], bool) -> Option<f64>);

impl Scalar {
    /// The type of a name, of which there are two sets.
    fn named(name: &[u8]) -> Option<Self> {
        Some(Self(match name {
            b"char" | b"int8" => |rest, big| take(rest, big).map(|bytes| i8::from_le_bytes(bytes).into()),
            b"uchar" | b"uint8" => |rest, big| take(rest, big).map(|bytes| u8::from_le_bytes(bytes).into()),
            b"short" | b"int16" => |rest, big| take(rest, big).map(|bytes| i16::from_le_bytes(bytes).into()),
            b"ushort" | b"uint16" => |rest, big| take(rest, big).map(|bytes| u16::from_le_bytes(bytes).into()),
            b"int" | b"int32" => |rest, big| take(rest, big).map(|bytes| i32::from_le_bytes(bytes).into()),
            b"uint" | b"uint32" => |rest, big| take(rest, big).map(|bytes| u32::from_le_bytes(bytes).into()),
            b"float" | b"float32" => |rest, big| take(rest, big).map(|bytes| f32::from_le_bytes(bytes).into()),
            b"double" | b"float64" => |rest, big| take(rest, big).map(f64::from_le_bytes),
            _ => return None,
        }))
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Content {
    Vertices,
    Faces,
    Other,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    /// One of x, y, z, and the normal's x, y, z.
    Value(usize),
    Corners,
    /// Read over.
    Other,
}

/// One value, or one list, of each record.
struct Property {
    role: Role,
    /// The type of a list's length; none for a single value.
    length: Option<Scalar>,
    scalar: Scalar,
}

struct Element {
    content: Content,
    count: usize,
    properties: Vec<Property>,
    line: usize,
}

impl Element {
    fn has_normals(&self) -> bool {
        (3..6).all(|i| self.has(Role::Value(i)))
    }

    fn has_more(&self) -> bool {
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

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
}

/// Reads the header; the cursor is where the data begins.
fn header(bytes: &[u8]) -> Result<(Header, Cursor<'_>), MeshReadError> {
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
