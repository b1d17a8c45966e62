//! Format of a file, by its content.

use super::error::{Alien, MeshReadError, Place, Quantity};
use super::lines::Cursor;
use super::{Kind, MAX_BYTES, stl};

/// Number of bytes searched for what no text has.
const LOOK: usize = 4096;

/// The format of a file, or why it is none that is read.
pub(super) fn kind(bytes: &[u8], extension_hint: Option<&str>) -> Result<Kind, MeshReadError> {
    if bytes.len() > MAX_BYTES {
        let place = Place::Line(1);
        return Err(MeshReadError::TooLarge { quantity: Quantity::Bytes, limit: MAX_BYTES, place });
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Err(MeshReadError::Empty);
    }
    let hint = |extension: &str| extension_hint.is_some_and(|hint| hint.eq_ignore_ascii_case(extension));
    if text.split(u8::is_ascii_whitespace).next() == Some(b"ply") {
        return Ok(Kind::Ply);
    }
    if stl::is_whole_binary(bytes) || is_text_stl(text) {
        return Ok(Kind::Stl);
    }
    if let Some(looks_like) = alien(bytes, text) {
        // Only its name distinguishes a truncated binary STL from other binary data.
        return if looks_like == Alien::Binary && hint("stl") {
            Ok(Kind::Stl)
        } else {
            Err(MeshReadError::NotAMesh(looks_like))
        };
    }
    if hint("obj") || has_vertex(text) { Ok(Kind::Obj) } else { Err(MeshReadError::NotAMesh(Alien::Text)) }
}

pub(super) fn is_text_stl(text: &[u8]) -> bool {
    let mut cursor = Cursor::new(&text[..text.len().min(LOOK)]);
    if cursor.word().is_none_or(|word| !word.text.eq_ignore_ascii_case(b"solid")) {
        return false;
    }
    cursor.next_line();
    while !cursor.is_done() {
        if let Some(word) = cursor.word() {
            return [&b"facet"[..], b"endsolid"].iter().any(|known| word.text.eq_ignore_ascii_case(known));
        }
        cursor.next_line();
    }
    false
}

/// The kind of a file that is not read, by its first bytes.
fn alien(bytes: &[u8], text: &[u8]) -> Option<Alien> {
    let looks_like = match text {
        [b'g', b'l', b'T', b'F', ..] | [b'{', ..] => Alien::Gltf,
        [b'P', b'K', 3, 4, ..] | [0x1f, 0x8b, ..] => Alien::Compressed,
        [b'<', ..] => Alien::Xml,
        _ if text.starts_with(b"Kaydara FBX") || text.starts_with(b"; FBX") => Alien::Fbx,
        _ if [&b"OFF"[..], b"COFF", b"NOFF"].contains(&text.split(u8::is_ascii_whitespace).next()?) => Alien::Off,
        _ if bytes[..bytes.len().min(LOOK)].contains(&0) => Alien::Binary,
        _ => return None,
    };
    Some(looks_like)
}

fn has_vertex(text: &[u8]) -> bool {
    let mut cursor = Cursor::new(text);
    while !cursor.is_done() {
        if cursor.word().is_some_and(|word| word.text == b"v") {
            return true;
        }
        cursor.next_line();
    }
    false
}
