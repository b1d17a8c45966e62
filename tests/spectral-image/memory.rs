//! A cube of two gigabytes is gone through in megabytes.

use spectral_image::{EnviHeader, EnviImage};
use std::cell::Cell;
use std::io::{self, Read, Seek, SeekFrom};
use std::rc::Rc;

/// Data of any length whose bytes are made as they are read: byte i is i mod 251.
struct Made {
    length: u64,
    at: u64,
    largest: Rc<Cell<usize>>,
}

impl Read for Made {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.largest.set(self.largest.get().max(buffer.len()));
        let count = buffer.len().min((self.length - self.at) as usize);
        for (i, byte) in buffer[..count].iter_mut().enumerate() {
            *byte = ((self.at + i as u64) % 251) as u8;
        }
        self.at += count as u64;
        Ok(count)
    }
}

impl Seek for Made {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.at = match position {
            SeekFrom::Start(at) => at,
            SeekFrom::End(by) => self.length.saturating_add_signed(by),
            SeekFrom::Current(by) => self.at.saturating_add_signed(by),
        };
        Ok(self.at)
    }
}

#[test]
fn a_cube_of_two_gigabytes_is_read_in_megabytes() {
    const BUDGET: usize = 4 << 20;
    let wavelengths: Vec<String> = (0..250).map(|band| (380 + 2 * band).to_string()).collect();
    for interleave in ["bil", "bip", "bsq"] {
        let text = format!(
            "ENVI\nsamples = 2000\nlines = 2000\nbands = 250\ndata type = 12\nbyte order = 0\ninterleave = {interleave}\n\
             wavelength units = nm\nwavelength = {{{}}}\n",
            wavelengths.join(",")
        );
        let header = EnviHeader::parse(text.as_bytes()).unwrap();
        assert_eq!(header.data_bytes(), Some(2_000_000_000));
        let largest = Rc::new(Cell::new(0));
        let data = Made { length: 2_000_000_000, at: 0, largest: Rc::clone(&largest) };
        let mut image = EnviImage::new(header, data).unwrap();
        let rows = image.info().rows_within(BUDGET);
        assert_eq!(rows, 2);
        let mut samples = Vec::new();
        for first in [0, 998, 1998] {
            image.read_rows(first..first + rows, &mut samples).unwrap();
            // The second pixel of the second row, band 7.
            let index: u64 = match interleave {
                "bil" => (first as u64 + 1) * 500_000 + 7 * 2000 + 1,
                "bip" => (first as u64 + 1) * 500_000 + 250 + 7,
                _ => 7 * 4_000_000 + (first as u64 + 1) * 2000 + 1,
            };
            let bytes = [2 * index % 251, (2 * index + 1) % 251];
            assert_eq!(samples[(2000 + 1) * 250 + 7], (bytes[0] + 256 * bytes[1]) as f32, "{interleave}");
        }
        let held = samples.capacity() * size_of::<f32>() + largest.get();
        assert!(held <= BUDGET + (1 << 20), "{held} bytes");
    }
}
