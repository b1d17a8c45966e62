//! Stanford PLY, as text or binary of either byte order.
//!
//! By its own hand, on the words and the soup that OBJ has anyway: `ply-rs-bw` 4 reads all values before it gives any, so
//! that it can neither be stopped nor held to a limit, and its errors are texts.

mod data;
mod header;

use super::STOP_EVERY;
use super::error::{MeshReadError, Place};
use super::report::Skipped;
use super::soup::{Corner, NONE, Soup};
use data::{Data, Record};
use header::{Content, Element, Encoding};

pub(super) fn read(bytes: &[u8], stop: &dyn Fn() -> bool) -> Result<Soup, MeshReadError> {
    let (header, cursor) = header::read(bytes)?;
    let mut soup = Soup::new(if header.encoding == Encoding::Text { Place::Line } else { Place::Face }, 0);
    let has_normals = header.elements.iter().any(|e| e.content == Content::Vertices && e.has_normals());
    let mut data = Data::new(header.encoding, cursor);
    for element in &header.elements {
        take(element, &mut data, &mut soup, has_normals, stop)?;
    }
    soup.check()?;
    Ok(soup)
}

fn take(
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
        if n % STOP_EVERY == 0 && stop() {
            return Err(MeshReadError::Stopped);
        }
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
                    let position = data::index_from(index).ok_or(wrong)?;
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
