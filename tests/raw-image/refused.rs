//! Files that are refused, with the reason.

use crate::writer::{Dng, Frame, Tag, long, short, text};
use raw_image::{LosslessJpegError, RawImage, RawImageError};

fn small() -> Dng {
    Dng::mosaic(4, 4, 8, vec![0; 16])
}

#[track_caller]
fn reason(bytes: &[u8]) -> String {
    RawImage::read(bytes).unwrap_err().to_string()
}

#[test]
fn other_forms_of_a_dng_are_named() {
    for (tags, named) in [
        (vec![short(33421, &[6, 6])], "X-Trans"),
        (vec![short(33421, &[2, 4])], "other than 2 × 2 filters"),
        (vec![Tag(33422, 1, vec![0, 1, 1, 3])], "other than red, green and blue"),
        (vec![Tag(50710, 1, vec![3, 4, 5])], "other than red, green and blue"),
        (vec![short(277, &[4])], "other than three colors"),
        (vec![short(339, &[3]), short(258, &[16])], "floating point"),
        (vec![short(259, &[8])], "Deflate"),
        (vec![short(259, &[34892])], "lossy JPEG"),
        (vec![short(258, &[32])], "more than 16 bits"),
        (vec![short(50714, &[255])], "more than the black level"),
        (vec![long(50829, &[0, 0, 5, 4])], "ActiveArea"),
        (vec![long(254, &[1])], "only previews"),
        (vec![long(256, &[40_000]), long(257, &[40_000])], "more than the file holds"),
        (vec![long(278, &[1])], "cover the image"),
    ] {
        let reason = reason(&small().with(&tags).bytes());
        assert!(reason.contains(named), "{reason}");
    }
}

#[test]
fn other_raw_formats_are_named_with_the_converters() {
    for (bytes, format) in [
        (&b"\0\0\0\x18ftypcrx \0\0\0\x01"[..], "Canon CR3"),
        (b"II*\0\x10\0\0\0CR\x02\0", "Canon CR2"),
        (b"FUJIFILMCCD-RAW 0201", "Fujifilm RAF"),
        (b"IIU\0\x18\0\0\0", "Panasonic RW2"),
        (b"IIRO\x08\0\0\0", "Olympus ORF"),
    ] {
        let reason = reason(bytes);
        assert!(reason.starts_with(format) && reason.contains("Adobe DNG Converter or dnglab"), "{reason}");
    }
    let mut nef = small().with(&[text(271, "NIKON CORPORATION")]);
    nef.tags.retain(|tag| tag.0 != 50706);
    assert!(reason(&nef.bytes()).starts_with("Nikon NEF"));
    // A picture by the same maker is no raw file.
    let picture = nef.with(&[short(262, &[1])]);
    assert!(matches!(RawImage::read(&picture.bytes()), Err(RawImageError::NotDng)));
    assert!(matches!(RawImage::read(b""), Err(RawImageError::NotDng)));
}

#[test]
fn broken_lossless_jpegs_are_refused() {
    let frame = Frame { width: 4, components: 1, precision: 8, predictor: 1, restart: 0 };
    let sound = frame.encode(&[7; 16]);
    let read = |jpeg: Vec<u8>| {
        let dng = Dng::mosaic(4, 4, 8, jpeg).with(&[short(259, &[7])]);
        match RawImage::read(&dng.bytes()) {
            Err(RawImageError::LosslessJpeg { error, .. }) => Some(error),
            other => other.map(|_| None).unwrap(),
        }
    };
    assert_eq!(read(sound.clone()), None);
    let changed = |from: &[u8], to: &[u8]| {
        let at = sound.windows(from.len()).position(|part| part == from).unwrap();
        let mut changed = sound.clone();
        changed[at..at + to.len()].copy_from_slice(to);
        read(changed)
    };
    assert_eq!(changed(&[0xFF, 0xC3], &[0xFF, 0xC0]), Some(LosslessJpegError::Lossy(0xC0)));
    assert_eq!(changed(&[0xFF, 0xD8], &[0xFF, 0xD9]), Some(LosslessJpegError::NotJpeg));
    assert_eq!(changed(&[0, 4, 0, 4], &[0, 3]), Some(LosslessJpegError::Size { found: 12, expected: 16 }));
    assert_eq!(changed(&[0, 4, 0, 4], &[9, 9]), Some(LosslessJpegError::Size { found: 9252, expected: 32 }));
    // More codes of one bit than there are.
    assert_eq!(changed(&[0, 36, 0, 1], &[0, 36, 0, 3]), Some(LosslessJpegError::Segment("DHT")));
    assert_eq!(read(sound[..sound.len() - 4].to_vec()), Some(LosslessJpegError::Truncated));
}
