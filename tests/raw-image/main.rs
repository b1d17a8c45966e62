//! The reader of DNG files against files of a small writer of the tests, with every sample known, and hostile bytes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should say so by failing")]
#![allow(clippy::cast_possible_wrap, reason = "files of the tests are small")]

mod hostile;
mod refused;
mod writer;

use raw_image::{DngColorMatrix, RawImage};
use writer::{Dng, Frame, Tag, long, packed, rational, short, text};

/// Samples of up to `bits` bits that look random.
pub(crate) fn noise(count: usize, bits: u32) -> Vec<u16> {
    let step = |state: &mut u32| {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Some((*state >> (32 - bits)) as u16)
    };
    std::iter::repeat_n((), count).scan(28, |state, ()| step(state)).collect()
}

/// Samples of an image without black, with 65535 as white: the channels that are numbers, in order.
fn samples(image: &RawImage) -> Vec<u16> {
    let [width, height] = image.size();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let values = pixels.flat_map(|(x, y)| image.pixel(x, y)).filter(|value| !value.is_nan());
    values.map(|value| (value * 65535.0).round() as u16).collect()
}

fn white() -> Tag {
    long(50717, &[65535])
}

#[track_caller]
fn holds(dng: &Dng, expected: &[u16]) {
    for big_endian in [false, true] {
        // Samples of 16 bits are in the order of the file; the tests write them big-endian.
        let sixteen = dng.tags.iter().any(|tag| tag.0 == 258 && tag.2 == [16]);
        let plain = !dng.tags.iter().any(|tag| tag.0 == 259);
        if !big_endian && sixteen && plain {
            continue;
        }
        let dng = Dng { big_endian, ..dng.clone().with(&[white()]) };
        assert_eq!(samples(&RawImage::read(&dng.bytes()).unwrap()), expected);
    }
}

#[test]
fn every_depth_is_unpacked() {
    for bits in 8..=16 {
        let mosaic = noise(11 * 6, bits);
        holds(&Dng::mosaic(11, 6, bits.into(), packed(&mosaic, 11, bits as usize)), &mosaic);
        let linear = noise(5 * 4 * 3, bits);
        holds(&Dng::linear(5, 4, bits.into(), packed(&linear, 15, bits as usize)), &linear);
    }
    let little = Dng::mosaic(2, 2, 16, vec![1, 2, 3, 4, 5, 6, 7, 8]).with(&[white()]);
    assert_eq!(samples(&RawImage::read(&little.bytes()).unwrap()), [0x201, 0x403, 0x605, 0x807]);
}

/// Tiles of an image of one plane, those at its edge filled with zeros.
fn tiles(samples: &[u16], width: usize, tile: [usize; 2]) -> Vec<Vec<u16>> {
    let height = samples.len() / width;
    let corners = (0..height).step_by(tile[1]).flat_map(|top| (0..width).step_by(tile[0]).map(move |left| (top, left)));
    let at = |x: usize, y: usize| if x < width && y < height { samples[y * width + x] } else { 0 };
    let tile = |(top, left)| (0..tile[0] * tile[1]).map(move |i| at(left + i % tile[0], top + i / tile[0])).collect();
    corners.map(tile).collect()
}

#[test]
fn tiles_and_strips_are_put_together() {
    let mosaic = noise(21 * 10, 12);
    let cut = tiles(&mosaic, 21, [16, 4]).iter().map(|tile| packed(tile, 16, 12)).collect();
    holds(&Dng::mosaic(21, 10, 12, Vec::new()).tiled(16, 4, cut), &mosaic);
    let strips = mosaic.chunks(21 * 3).map(|strip| packed(strip, 21, 12)).collect();
    holds(&Dng { tiles: strips, ..Dng::mosaic(21, 10, 12, Vec::new()).with(&[short(278, &[3])]) }, &mosaic);
}

#[test]
fn lossless_jpeg_is_decoded_with_each_predictor_and_count_of_components() {
    for precision in [8, 12, 16] {
        let mosaic = noise(24 * 9, precision);
        for predictor in 1..=7 {
            for (components, restart) in [(1, 0), (2, 0), (4, 0), (2, 2)] {
                let frame = Frame { width: 24 / components, components, precision, predictor, restart };
                let dng = Dng::mosaic(24, 9, precision.into(), frame.encode(&mosaic)).with(&[short(259, &[7])]);
                holds(&dng, &mosaic);
            }
            let frame = Frame { width: 8, components: 3, precision, predictor, restart: 0 };
            let dng = Dng::linear(8, 9, precision.into(), frame.encode(&mosaic)).with(&[short(259, &[7])]);
            holds(&dng, &mosaic);
        }
    }
}

#[test]
fn a_frame_of_another_shape_than_its_tile_is_put_in_order() {
    let frame = Frame { width: 24, components: 1, precision: 14, predictor: 6, restart: 0 };
    let mosaic = noise(12 * 8, 14);
    // Two rows of the tile in one of the frame.
    holds(&Dng::mosaic(12, 8, 14, frame.encode(&mosaic)).with(&[short(259, &[7])]), &mosaic);
    // An odd width in two components.
    let odd: Vec<u16> = mosaic.chunks(12).flat_map(|row| &row[..11]).copied().collect();
    let frame = Frame { width: 6, components: 2, ..frame };
    holds(&Dng::mosaic(11, 8, 14, frame.encode(&mosaic)).with(&[short(259, &[7])]), &odd);
}

#[test]
fn a_difference_of_half_the_range_is_decoded() {
    let mosaic = [0, 32768, 0, 65535, 32767, 65535, 1, 32769];
    let frame = Frame { width: 4, components: 1, precision: 16, predictor: 1, restart: 0 };
    holds(&Dng::mosaic(4, 2, 16, frame.encode(&mosaic)).with(&[short(259, &[7])]), &mosaic);
}

/// (7919 x + 104729 y) mod 65536 in 8 × 6 pixels of 16 bits, by libjxl, lossless; in a container before the last box's bytes.
const JPEG_XL: &str = "ff0a2830fc00458b080401002c014b2825d6818282a4d86a2ce50a440736f964a3bbbbbbbbbbbbbbbbbbbbc7c8babbbbbbfb11216e6e3046d6ddddfd88708cacbb1f11c218d9cd8d31b2eeeeeeee7e44688cec11218c917537";
const CONTAINER: &str =
    "0000000c4a584c200d0a870a00000014667479706a786c20000000006a786c20000000096a786c6c0a000000616a786c63";

pub(crate) fn jpeg_xl(container: bool) -> Vec<u8> {
    let hex = if container { [CONTAINER, JPEG_XL].concat() } else { JPEG_XL.to_owned() };
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

#[test]
fn jpeg_xl_is_decoded_bare_and_in_a_container() {
    let expected: Vec<u16> = (0..48).map(|i| (i % 8 * 7919 + i / 8 * 104_729) as u16).collect();
    for container in [false, true] {
        holds(&Dng::mosaic(8, 6, 16, jpeg_xl(container)).with(&[short(259, &[52546])]), &expected);
    }
}

#[test]
fn interleaved_rows_and_columns_are_put_in_order() {
    let mosaic = noise(7 * 5, 12);
    // Fields 0, 2, 4, 1, 3 of the rows; 0, 3, 6, 1, 4, 2, 5 of the columns.
    let stored: Vec<u16> =
        [0, 2, 4, 1, 3].iter().flat_map(|y| [0, 3, 6, 1, 4, 2, 5].map(|x| mosaic[y * 7 + x])).collect();
    let dng = Dng::mosaic(7, 5, 12, packed(&stored, 7, 12)).with(&[long(50975, &[2]), long(52547, &[3])]);
    holds(&dng, &mosaic);
}

#[test]
fn levels_are_those_of_the_active_area() {
    // Stored samples are 100 y + 10 x; the active area begins at column 1 and row 2.
    let stored: Vec<u16> = (0..8).flat_map(|y| (0..6).map(move |x| 100 * y + 10 * x)).collect();
    let tags = [
        long(50829, &[2, 1, 8, 5]),
        short(50713, &[2, 2]),
        rational(50714, &[1000, 2000, 3000, 4500]),
        rational(50715, &[0, 500, 0, -500]),
        rational(50716, &[0, 0, 1000, 0, 0, 0]),
        long(50717, &[1005]),
        short(274, &[6]),
    ];
    let image = RawImage::read(&Dng::mosaic(6, 8, 12, packed(&stored, 6, 12)).with(&tags).bytes()).unwrap();
    assert_eq!((image.size(), image.orientation()), ([4, 6], 6));
    // The highest black is 4.5 + 0.5 (column 1 below) + 1 (row 2).
    let range = 1005.0 - (4.5 + 0.5 + 1.0);
    let at = |x, y, channel: usize| image.pixel(x, y)[channel] * range;
    let close = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-9, "{value} {expected}");
    close(at(0, 0, 0), 210.0 - 1.0);
    close(at(1, 0, 1), 220.0 - 2.5);
    close(at(0, 1, 1), 310.0 - 3.0);
    close(at(3, 1, 2), 340.0 - 4.0);
    close(at(0, 2, 0), 410.0 - 2.0);
    assert!(image.pixel(0, 0)[1..].iter().chain(&image.pixel(4, 0)).all(|value| value.is_nan()));
    assert_eq!([image.filter(0, 0), image.filter(1, 0), image.filter(1, 1)], [Some(0), Some(1), Some(2)]);
}

#[test]
fn a_sample_at_white_is_clipped_and_one_below_is_not() {
    let table: Vec<i64> = (0..256).map(|n| n * 4).collect();
    let tags = [short(50712, &table), short(50714, &[64]), short(50717, &[1000])];
    let image = RawImage::read(&Dng::mosaic(4, 2, 8, vec![250, 249, 255, 16, 0, 1, 2, 3]).with(&tags).bytes()).unwrap();
    let values: Vec<f64> = (0..4).map(|x| image.pixel(x, 0)[[0, 1][x % 2]]).collect();
    assert_eq!(values.iter().map(|value| (value * 936.0).round()).collect::<Vec<_>>(), [936.0, 932.0, 956.0, 0.0]);
    assert!(values[0] >= image.clip() && values[1] < image.clip());
    assert!(935.0 / 936.0 < image.clip());
}

#[test]
fn a_preview_is_the_mean_of_its_cells() {
    let mosaic = noise(37 * 23, 12);
    let bytes = Dng::mosaic(37, 23, 12, packed(&mosaic, 37, 12)).with(&[short(50714, &[100])]).bytes();
    let linear = noise(37 * 23 * 3, 12);
    let linear = Dng::linear(37, 23, 12, packed(&linear, 111, 12)).bytes();
    for (bytes, longest, step) in
        [(&bytes, 10, 4), (&bytes, 100, 2), (&bytes, 1, 22), (&linear, 37, 1), (&linear, 13, 3)]
    {
        let image = RawImage::read(bytes).unwrap();
        let preview = image.preview(longest);
        assert_eq!((preview.step, preview.size), (step, [37 / step, 23 / step]));
        for (i, cell) in preview.rgb.iter().enumerate() {
            let (left, top) = (i % preview.size[0] * step, i / preview.size[0] * step);
            let pixels = (0..step * step).map(|i| image.pixel(left + i % step, top + i / step));
            let pixels: Vec<[f64; 3]> = pixels.collect();
            for channel in 0..3 {
                let values: Vec<f64> = pixels.iter().map(|rgb| rgb[channel]).filter(|value| !value.is_nan()).collect();
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                assert!((mean - f64::from(cell[channel])).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn the_raw_image_below_a_preview_and_the_metadata_are_found() {
    let mosaic = noise(4 * 4, 8);
    let raw = Dng::mosaic(4, 4, 8, packed(&mosaic, 4, 8)).with(&[white()]);
    let matrix = [1, 2, 3, 4, 5, 6, 7, 8, 9].map(|n| n * 100);
    let above = [
        Tag(50706, 1, vec![1, 4, 0, 0]),
        text(271, "Maker "),
        text(272, "Camera 1"),
        text(50708, "Maker Camera 1"),
        rational(33434, &[4]),
        rational(33437, &[5600]),
        short(34855, &[200]),
        rational(50728, &[500, 1000, 650]),
        short(50778, &[17]),
        rational(50721, &matrix),
        short(50779, &[21]),
        rational(50722, &matrix),
        rational(50965, &matrix),
    ];
    let image = RawImage::read(&raw.below(&above)).unwrap();
    assert_eq!(samples(&image), mosaic);
    let found = image.metadata();
    assert_eq!((found.make.as_deref(), found.model.as_deref()), (Some("Maker"), Some("Camera 1")));
    assert_eq!(found.unique_camera_model.as_deref(), Some("Maker Camera 1"));
    assert_eq!((found.iso, found.exposure_s, found.f_number), (Some(200.0), Some(0.004), Some(5.6)));
    assert_eq!(found.as_shot_neutral, Some([0.5, 1.0, 0.65]));
    let color = [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6], [0.7, 0.8, 0.9]];
    let second = DngColorMatrix { illuminant: 21, color, forward: Some(color) };
    assert_eq!(found.color_matrices, [DngColorMatrix { illuminant: 17, color, forward: None }, second]);
}
