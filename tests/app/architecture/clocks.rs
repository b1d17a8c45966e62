//! No test reads a clock or sleeps: what it finds would depend on the machine, and on what else runs there.

use super::rust_text::{code, words};
use super::{Report, Violation, found, hold, sources};

/// The one place that waits for what must come.
const WAITS: &str = "tests/app/waiting.rs";

/// A benchmark: ignored unless asked for, and it asserts nothing.
const MEASURES: &str = "tests/app/frames.rs";

/// Words that only those use who measure or let pass time. A `SystemTime` may be made, as the time of a file, but not read.
const TIME: &[&str] = &["Instant", "elapsed", "park_timeout", "recv_timeout", "sleep"];

#[test]
fn tests_do_not_depend_on_a_clock() {
    for folder in ["core", "src", "tests/app", "tests/core", "tests/figure", "tests/mesh", "tests/spectral-file"] {
        hold(sources(folder).iter().flat_map(|(path, text)| clocks(path, text)));
    }
}

fn clocks(file: &str, text: &str) -> Vec<Violation> {
    let mut found = Report::new(file);
    let is_test = file.starts_with("tests/") || file.ends_with("/tests.rs");
    let words = match is_test {
        _ if [WAITS, MEASURES].contains(&file) => Vec::new(),
        true => words(text),
        false => code(text).tests,
    };
    for (place, (word, line)) in words.iter().enumerate() {
        let reads = || word == "SystemTime" && words[place + 1..].iter().take(3).any(|(next, _)| next == "now");
        if TIME.contains(&word.as_str()) || reads() {
            let rule = "tests count work, drive an executor, or wait for an event with `waiting::until`";
            found.push(*line, format!("{rule}: `{word}`"));
        }
    }
    found.violations
}

#[test]
fn a_test_that_reads_a_clock_is_found() {
    let text = "use std::time::Instant; // Instant::now
fn f() { std::thread::sleep(PAUSE); let text = \"elapsed\"; }
#[cfg(test)]
mod tests {
    #[test]
    fn quick() { let start = std::time::Instant::now(); work(); assert!(start.elapsed() < LIMIT); }
    fn of_a_file() { let made = SystemTime::UNIX_EPOCH; let read = SystemTime::now(); }
}
";
    let lines = |file: &str| clocks(file, text).into_iter().map(|found| found.line).collect::<Vec<_>>();
    assert_eq!(lines("tests/app/x.rs"), [1, 2, 6, 6, 7]);
    assert_eq!(lines("tests/core/table/x.rs"), [1, 2, 6, 6, 7]);
    assert_eq!(lines("src/laboratory/loci/tests.rs"), [1, 2, 6, 6, 7]);
    assert_eq!(lines("src/jobs.rs"), [6, 6, 7], "the program itself may");
    assert_eq!(lines(WAITS), [0; 0]);
    let rule = "tests count work, drive an executor, or wait for an event with `waiting::until`";
    assert_eq!(found(&clocks("src/jobs.rs", text))[0], format!("src/jobs.rs:6: {rule}: `Instant`"));
}
