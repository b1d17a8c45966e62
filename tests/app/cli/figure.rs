//! Tests of `figure`: forms by the ending, size of the page, sessions.

use std::fs;

use super::run;

#[test]
fn a_figure_takes_the_form_of_its_file_and_the_session_it_is_given() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    fs::write(at("work.json"), "{\"format\":\"chromascope\",\"version\":1,\"diagram\":\"uv-prime\"}").expect("written");
    for (name, beginning) in
        [("a.pdf", &b"%PDF-"[..]), ("a.svg", b"<svg"), ("a.png", b"\x89PNG"), ("a.csv", b"sensor,")]
    {
        let out = at(name);
        let done = run(&["figure", "chromaticity", "--session", &at("work.json"), "--width", "3in", "--out", &out]);
        assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
        assert!(fs::read(&out).expect("a file").starts_with(beginning), "{name}");
    }
    let svg = fs::read_to_string(at("a.svg")).expect("text");
    assert!(svg.contains("width=\"76.2mm\""));
    assert!(svg.contains(">u′</text>") && svg.contains(">v′</text>"), "the diagram of the session");
}

#[test]
fn a_figure_without_a_form_or_a_unit_is_refused() {
    for arguments in [&["--out", "figure.txt"][..], &[], &["--width", "85", "--out", "figure.pdf"]] {
        let done = run(&[&["figure", "spectra"], arguments].concat());
        assert_eq!(done.status.code(), Some(2), "{arguments:?}");
    }
}
