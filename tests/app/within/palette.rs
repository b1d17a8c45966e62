//! Order of what the palette finds.

use super::*;

#[test]
fn settings_come_before_what_only_contains_the_words() {
    let found = |group, words: &str| Found::new(group, words, Command::Undo);
    let all = vec![
        found("Patches shown", "outfit"),
        found("Settings", "Color transform: fitted to CIE 1931"),
        found("Settings", "Diagram: fit to data"),
    ];
    let lines: Vec<String> = matching(all, "fit").into_iter().map(|found| found.line.words).collect();
    assert_eq!(
        lines,
        ["Settings", "Color transform: fitted to CIE 1931", "Diagram: fit to data", "Patches shown", "outfit"]
    );
}
