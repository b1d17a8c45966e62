//! Prints size, bands and mean spectrum of a spectral image: `image_report cube.hdr cube.img` or `image_report image.exr`.
#![allow(clippy::print_stdout, reason = "an example that prints")]
#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "a program opens the files")]

use spectral_image::{EnviHeader, EnviImage, ExrImage, SpectralImage};
use std::error::Error;
use std::fs::{File, read};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut image = match arguments.as_slice() {
        [header, data] => SpectralImage::Envi(EnviImage::new(EnviHeader::parse(&read(header)?)?, File::open(data)?)?),
        [exr] => SpectralImage::Exr(ExrImage::new(File::open(exr)?, None)?),
        _ => return Err("name an ENVI header and its data, or one OpenEXR file".into()),
    };
    let info = image.info().clone();
    println!("{} x {} pixels, {} bands, {:?}", info.width, info.height, info.wavelengths_nm.len(), info.quantity);
    let mut sums = vec![(0_u64, 0.0_f64); info.wavelengths_nm.len()];
    let mut samples = Vec::new();
    let rows = info.rows_within(16 << 20);
    for first in (0..info.height).step_by(rows) {
        image.read_rows(first..(first + rows).min(info.height), &mut samples)?;
        for pixel in samples.chunks_exact(sums.len()) {
            for ((count, sum), sample) in sums.iter_mut().zip(pixel).filter(|(_, sample)| sample.is_finite()) {
                *count += 1;
                *sum += f64::from(*sample);
            }
        }
    }
    for (nm, (count, sum)) in info.wavelengths_nm.iter().zip(sums) {
        println!("{nm} nm: {}", sum / count.max(1) as f64);
    }
    Ok(())
}
