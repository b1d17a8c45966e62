//! Any bytes as a spectral file under any choices, which the first bytes make: a sound table or an error.
#![no_main]

use spectral_file::read;
use chromascope_core_fuzz::{check, options};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: &[u8]| {
    let Some((options, bytes)) = options::split(input) else { return };
    if let Ok(table) = read(bytes, &options) {
        check(&table);
    }
});
