//! Any bytes as a spectral file, read by what they hold: a sound table or an error.
#![no_main]

use spectral_file::{ReadOptions, read};
use chromascope_core_fuzz::check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(table) = read(bytes, &ReadOptions::default()) {
        check(&table);
    }
});
