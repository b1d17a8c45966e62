//! Broken files: an error or an image, never a panic, and no allocation beyond what the data allow.

use crate::writer::{Dng, Frame, long, packed, short};
use crate::{jpeg_xl, noise};
use proptest::prelude::*;
use raw_image::RawImage;

/// Small files of each compression.
fn files() -> Vec<Vec<u8>> {
    let samples = noise(16 * 8, 12);
    let frame = Frame { width: 8, components: 2, precision: 12, predictor: 7, restart: 2 };
    let levels = [short(50713, &[1, 2]), short(50714, &[10, 20]), long(50829, &[0, 2, 8, 16]), long(50975, &[2])];
    vec![
        Dng::mosaic(16, 8, 12, packed(&samples, 16, 12)).with(&levels).bytes(),
        Dng::mosaic(16, 8, 12, frame.encode(&samples)).with(&[short(259, &[7])]).below(&[short(50706, &[1])]),
        Dng::mosaic(8, 6, 16, jpeg_xl(true)).with(&[short(259, &[52546])]).bytes(),
    ]
}

fn go_through(bytes: &[u8]) {
    if let Ok(image) = RawImage::read(bytes) {
        let [width, height] = image.size();
        assert!(image.pixel(width - 1, height - 1).iter().any(|value| value.is_finite()));
        assert!(image.preview(16).rgb.iter().flatten().all(|value| value.is_finite()));
    }
}

#[test]
fn truncated_files_are_no_harm() {
    for whole in files() {
        for length in 0..whole.len() {
            go_through(&whole[..length]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_never_panic(
        file in 0..3_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = files().swap_remove(file);
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        go_through(&bytes);
    }
}
