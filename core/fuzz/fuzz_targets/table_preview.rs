//! Preview marks of any bytes under any choices: parts of lines, in order, with names.
#![no_main]

use chromascope_core_fuzz::options;
use libfuzzer_sys::fuzz_target;
use spectral_file::{Preview, Watch, read_marked};

/// Lines that are looked at.
const LINES: usize = 300;

fuzz_target!(|input: &[u8]| {
    let Some((options, bytes)) = options::split(input) else { return };
    let table = read_marked(bytes, &options, Watch::none());
    let Ok(preview) = Preview::new(bytes) else {
        assert!(table.is_err());
        return;
    };
    assert!(preview.line_count() > 0);
    match &table {
        Ok((table, marker)) => {
            for number in 0..=preview.line_count().min(LINES) + 1 {
                let line = preview.line(number).unwrap_or_default();
                let mut end = 0;
                for mark in preview.marks(number, table, marker) {
                    assert!(
                        mark.range.start >= end && line.get(mark.range.clone()).is_some(),
                        "line {number}: {mark:?}"
                    );
                    assert!(!mark.what.describe(table).is_empty());
                    assert!(mark.what.curve().is_none_or(|curve| curve < table.curves.len()), "{mark:?}");
                    end = mark.range.end;
                }
            }
        }
        Err(error) => {
            if let Some((number, range)) = preview.error_range(error) {
                assert!(preview.line(number).is_some_and(|line| line.get(range).is_some()), "{error:?}");
            }
        }
    }
    for number in 0..=preview.line_count().min(LINES) + 1 {
        assert_eq!(preview.line(number).is_some(), preview.shown(number, 3, 40).is_some());
    }
});
