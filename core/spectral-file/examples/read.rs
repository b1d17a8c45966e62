//! Reads files of spectra and prints their curves, decisions and warnings: `cargo run --example read -- FILE…`
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "an example reads files and prints"
)]

use std::process::ExitCode;

use spectral_file::{ReadOptions, Source, SpectralFile, read};

fn main() -> ExitCode {
    let mut failed = false;
    for path in std::env::args().skip(1) {
        let read = std::fs::read(&path).map_err(|error| error.to_string());
        let parse = |bytes: Vec<u8>| {
            let source = Source { bytes: &bytes, path: &path, ..Source::default() };
            self::read(source, &ReadOptions::default()).map_err(|error| error.to_string())
        };
        match read.and_then(parse) {
            Ok(file) => print(&path, &file),
            Err(error) => {
                eprintln!("{path}: {error}");
                failed = true;
            }
        }
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

fn print(path: &str, file: &SpectralFile) {
    println!("{path}");
    for curve in &file.curves {
        let (first, last) = (curve.wavelengths_nm.first(), curve.wavelengths_nm.last());
        let unit = curve.unit.as_deref().unwrap_or("no unit");
        if let (Some(first), Some(last)) = (first, last) {
            let (name, count) = (&curve.name, curve.values.len());
            let named = if curve.named { "" } else { " (no name in the file)" };
            println!("  {name}{named}: {count} samples from {first} to {last} nm, {unit}");
        }
    }
    for decision in file.decisions() {
        println!("  {}: {} ({}: {})", decision.what, decision.value, decision.certainty, decision.why);
    }
    for warning in &file.warnings {
        println!("  warning: {warning}");
    }
}
