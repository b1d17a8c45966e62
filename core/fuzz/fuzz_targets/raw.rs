//! Any bytes as a raw image: a sound image or an error, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use raw_image::RawImage;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(image) = RawImage::read(bytes) {
        let [width, height] = image.size();
        assert!(image.pixel(width - 1, height - 1).iter().any(|value| value.is_finite()));
        assert!(image.clip() < 1.0);
        let preview = image.preview(64);
        assert_eq!(preview.rgb.len(), preview.size[0] * preview.size[1]);
        assert!(preview.rgb.iter().flatten().all(|value| value.is_finite()));
    }
});
