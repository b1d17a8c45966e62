//! Writes a file of spectra as CSV to standard output: `cargo run --example convert -- FILE > spectra.csv`
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "an example reads a file and prints"
)]

use std::error::Error;

use spectral_file::write::{Content, Format, Grid, Sheet, Trace, write};
use spectral_file::{ReadOptions, Role, read};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: convert FILE")?;
    let file = read(&std::fs::read(path)?, &ReadOptions::default())?;
    let curves: Vec<Trace<'_>> = file.curves.iter().map(Trace::from).collect();
    let content = match file.role.value {
        Role::Reflectance => Content::Reflectance,
        Role::Transmittance => Content::Transmittance,
        Role::Illuminant => Content::Illuminant,
        Role::Camera | Role::Unknown => Content::Other,
    };
    let sheet = Sheet {
        title: file.reading.comment("title").unwrap_or_default(),
        content,
        curves: &curves,
        unit: file.curves.first().and_then(|curve| curve.unit.as_deref()),
        ..Sheet::default()
    };
    let written = write(&sheet, Format::Csv, Grid::Native)?;
    print!("{}", written.text);
    for note in written.notes {
        eprintln!("{note}");
    }
    Ok(())
}
