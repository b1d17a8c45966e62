//! Pictures beside those that are kept.

use std::{env, fs, path::Path};

use image::{
    ExtendedColorType, ImageEncoder as _, RgbaImage,
    codecs::png::{CompressionType, FilterType, PngEncoder},
};

/// The largest difference of a channel that counts as equal. On one machine pictures repeat byte for byte; elsewhere
/// the last bits of the tessellation's `sin` and `sqrt` may differ.
const TOLERANCE: u8 = 2;

/// Holds a picture to the one kept at `path`, or keeps it there if `UPDATE_SCREENSHOTS=1`.
///
/// # Errors
///
/// The difference, with the paths of both pictures.
pub(crate) fn compare(actual: &RgbaImage, path: &Path) -> Result<(), String> {
    let update = env::var_os("UPDATE_SCREENSHOTS").is_some_and(|value| value == "1");
    if update { write_png(actual, path) } else { hold(actual, path) }
}

fn hold(actual: &RgbaImage, path: &Path) -> Result<(), String> {
    let difference = match image::open(path) {
        Ok(expected) => difference(actual, &expected.to_rgba8()),
        Err(error) => Some(error.to_string()),
    };
    let Some(difference) = difference else {
        return Ok(());
    };
    let name = path.file_name().unwrap_or_default();
    let shown = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    write_png(actual, &shown)?;
    Err(format!(
        "{} is not what is drawn now, {}: {difference}. If it is meant to change, `UPDATE_SCREENSHOTS=1 cargo test`",
        path.display(),
        shown.display(),
    ))
}

/// Difference of two pictures beyond [`TOLERANCE`], in words; `None` if they are equal within it.
fn difference(actual: &RgbaImage, expected: &RgbaImage) -> Option<String> {
    if actual.dimensions() != expected.dimensions() {
        let [now, kept] = [actual, expected].map(|image| format!("{} × {}", image.width(), image.height()));
        return Some(format!("{now} pixels instead of {kept}"));
    }
    let width = actual.width() as usize;
    let (mut count, mut largest, mut first) = (0, 0, 0);
    // Equal lines, which is nearly all, are compared as memory.
    let [now, kept] = [actual, expected].map(|image| image.as_raw().chunks_exact(4 * width.max(1)));
    for (row, (line, other)) in now.zip(kept).enumerate() {
        if line == other {
            continue;
        }
        for (column, (pixel, other)) in line.chunks_exact(4).zip(other.chunks_exact(4)).enumerate() {
            let far = pixel.iter().zip(other).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            if far > TOLERANCE {
                first = if count == 0 { row * width + column } else { first };
                count += 1;
                largest = largest.max(far);
            }
        }
    }
    let [x, y] = [first % width.max(1), first / width.max(1)];
    (count > 0).then(|| format!("{count} pixels differ, the first at ({x}, {y}), by up to {largest} / 255"))
}

fn write_png(image: &RgbaImage, path: &Path) -> Result<(), String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(image.as_raw(), image.width(), image.height(), ExtendedColorType::Rgba8)
        .map_err(|error| failed(&error))?;
    fs::write(path, bytes).map_err(|error| failed(&error))
}

#[test]
fn pictures_are_equal_within_two_levels_only() {
    let kept = RgbaImage::from_pixel(3, 2, image::Rgba([10, 20, 30, 255]));
    let mut now = kept.clone();
    now.put_pixel(2, 1, image::Rgba([12, 18, 30, 255]));
    assert_eq!(difference(&now, &kept), None);
    now.put_pixel(2, 1, image::Rgba([12, 18, 33, 255]));
    let expected = "1 pixels differ, the first at (2, 1), by up to 3 / 255";
    assert_eq!(difference(&now, &kept).as_deref(), Some(expected));
    let wide = RgbaImage::new(4, 2);
    assert!(difference(&wide, &kept).is_some_and(|text| text.contains("4 × 2 pixels instead of 3 × 2")));
}

#[test]
fn a_picture_that_changed_is_left_beside_the_kept_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("changed in cpu_renderer.png");
    let kept = RgbaImage::from_pixel(3, 2, image::Rgba([10, 20, 30, 255]));
    assert!(hold(&kept, &path).is_err(), "there is none yet");
    write_png(&kept, &path).expect("it is kept");
    assert_eq!(hold(&kept, &path), Ok(()));

    let now = RgbaImage::from_pixel(3, 2, image::Rgba([10, 20, 90, 255]));
    let told = hold(&now, &path).expect_err("it has changed");
    let shown = Path::new(env!("CARGO_TARGET_TMPDIR")).join("changed in cpu_renderer.png");
    assert!(told.contains(&path.display().to_string()) && told.contains(&shown.display().to_string()), "{told}");
    assert_eq!(image::open(&shown).expect("what is drawn now").to_rgba8(), now);
    assert_eq!(image::open(&path).expect("what was kept").to_rgba8(), kept);
}
