//! Wavefront OBJ, line by line.
//!
//! Own implementation, as the available crates lack required features: tobj 4 cuts polygons into fans, stops at the
//! first word it cannot read without reporting its position, and hashes vertices by their indices; obj 0.10 copies each
//! line and does not support continued ones; `wavefront_obj` 11 rejects unknown statements. None can be stopped.

use super::lines::{Cursor, Word};
use super::look;
use super::report::{MeshReadError, Place, Skipped};
use super::soup::{Corner, NONE, Names, Smoothing, Soup};

/// Maximum number of name changes that are stored.
const MAX_GROUPS: usize = 65_536;

/// The present object, group and material.
#[derive(Default)]
struct Naming {
    object: String,
    group: String,
    material: String,
}

impl Naming {
    fn names(&self) -> Names {
        let name = match (self.object.is_empty(), self.group.is_empty() || self.group == self.object) {
            (true, _) => self.group.clone(),
            (_, true) => self.object.clone(),
            _ => format!("{} / {}", self.object, self.group),
        };
        Names { name, material: self.material.clone() }
    }
}

pub(super) fn read(bytes: &[u8], stop: &dyn Fn() -> bool) -> Result<Soup, MeshReadError> {
    let mut cursor = Cursor::new(bytes);
    let mut soup = Soup::new(Place::Line, 1);
    let mut naming = Naming::default();
    let mut lines = 0;
    while !cursor.is_done() {
        if let Some(keyword) = cursor.word() {
            statement(keyword.text, &mut cursor, &mut soup, &mut naming)?;
        }
        cursor.next_line();
        lines += 1;
        look(lines, stop)?;
    }
    soup.check()?;
    Ok(soup)
}

fn statement(
    keyword: &[u8],
    cursor: &mut Cursor<'_>,
    soup: &mut Soup,
    naming: &mut Naming,
) -> Result<(), MeshReadError> {
    let place = Place::Line(cursor.first_line());
    match keyword {
        b"v" => {
            soup.add_position(cursor.three()?, place)?;
            if cursor.word().is_some() {
                soup.skip(Skipped::VertexColors, place);
            }
        }
        b"vn" => soup.add_normal(cursor.three()?, place)?,
        b"vt" | b"maplib" | b"usemap" => soup.skip(Skipped::Textures, place),
        b"f" | b"fo" => {
            while let Some(word) = cursor.word() {
                let corner = corner(&word, soup, place)?;
                soup.add_corner(corner, place)?;
            }
            soup.end_face(cursor.first_line())?;
        }
        b"s" => soup.smooth(smoothing(cursor)?),
        b"o" | b"g" | b"usemtl" => {
            let name = clean(cursor.rest());
            match keyword {
                b"o" => (naming.object, naming.group) = (name, String::new()),
                b"g" => naming.group = name,
                _ => {
                    naming.material = name;
                    soup.skip(Skipped::Materials, place);
                }
            }
            if soup.groups.len() < MAX_GROUPS {
                soup.name(naming.names());
            } else {
                soup.unnamed_groups += 1;
            }
        }
        _ => soup.skip(skipped(keyword), place),
    }
    Ok(())
}

fn skipped(keyword: &[u8]) -> Skipped {
    match keyword {
        b"mtllib" => Skipped::Materials,
        b"p" => Skipped::Points,
        b"l" => Skipped::Lines,
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim" | b"hole"
        | b"scrv" | b"sp" | b"end" | b"con" | b"mg" | b"ctech" | b"stech" => Skipped::Curves,
        b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" => Skipped::Display,
        _ => Skipped::Unknown,
    }
}

/// One corner: `1`, `1/2`, `1//3` or `1/2/3`, each from 1, or counted back from the last with -1.
#[inline]
fn corner(word: &Word<'_>, soup: &Soup, place: Place) -> Result<Corner, MeshReadError> {
    let wrong = MeshReadError::Index { line: word.line, column: word.column };
    let (position, rest) = integer(word.text).ok_or(wrong)?;
    let count = soup.positions.len();
    let position = absolute(position, count).ok_or(MeshReadError::NoSuchVertex { place, index: position, count })?;
    let Some(rest) = after_slash(rest, wrong)? else { return Ok(Corner { position, normal: NONE }) };
    // The texture's index may be missing.
    let rest = integer(rest).map_or(rest, |(_, rest)| rest);
    let Some(rest) = after_slash(rest, wrong)? else { return Ok(Corner { position, normal: NONE }) };
    if rest.is_empty() {
        return Ok(Corner { position, normal: NONE });
    }
    let (normal, rest) = integer(rest).ok_or(wrong)?;
    if !rest.is_empty() {
        return Err(wrong);
    }
    let count = soup.normals.len();
    let normal = absolute(normal, count).ok_or(MeshReadError::NoSuchNormal { place, index: normal, count })?;
    Ok(Corner { position, normal })
}

/// Text after a slash, or none at the word's end.
fn after_slash(text: &[u8], wrong: MeshReadError) -> Result<Option<&[u8]>, MeshReadError> {
    match text {
        [] => Ok(None),
        [b'/', rest @ ..] => Ok(Some(rest)),
        _ => Err(wrong),
    }
}

/// The whole number other than zero that a text begins with, and what follows; numbers beyond 18 digits are as good as 1e18.
#[inline]
fn integer(text: &[u8]) -> Option<(i64, &[u8])> {
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, text),
    };
    let length = digits.iter().position(|b| !b.is_ascii_digit()).unwrap_or(digits.len());
    let mut value = 0_i64;
    for digit in &digits[..length] {
        value = (value * 10 + i64::from(digit - b'0')).min(1_000_000_000_000_000_000 / 10);
    }
    (value > 0).then_some((if negative { -value } else { value }, &digits[length..]))
}

/// An index from 0 for one from 1 or back from the end; none where it lies before the beginning or beyond any file.
///
/// Indices of what comes later are looked at when all is read.
#[inline]
fn absolute(index: i64, count: usize) -> Option<u32> {
    let index = if index > 0 { index - 1 } else { index + i64::try_from(count).ok()? };
    u32::try_from(index).ok().filter(|&index| index != NONE)
}

/// A smoothing statement's value: `off`, `0`, or a group.
fn smoothing(cursor: &mut Cursor<'_>) -> Result<Smoothing, MeshReadError> {
    let Some(word) = cursor.word() else { return Ok(Smoothing::Flat) };
    match word.text {
        b"off" | b"0" => Ok(Smoothing::Flat),
        b"on" => Ok(Smoothing::Group(1)),
        text => match integer(text) {
            Some((group, [])) => Ok(Smoothing::Group(group as u32)),
            _ => Err(MeshReadError::Number { line: word.line, column: word.column }),
        },
    }
}

/// A name as text, of limited length.
fn clean(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).chars().take(Names::LONGEST).collect()
}
