//! Lines, their parts as they are drawn, and where a reading failed.

use spectral_file::{Encoding, MAX_BYTES, Preview, ReadError, ReadOptions, What, read};

use super::Seen;

fn preview(text: &str) -> Preview {
    Preview::new(text.as_bytes()).unwrap()
}

#[test]
fn lines_of_all_ends() {
    let seen = preview("a\nbc\r\n\rd\r\r\nlast");
    let lines: Vec<&str> = (1..=seen.line_count()).map(|number| seen.line(number).unwrap()).collect();
    assert_eq!(lines, ["a", "bc", "", "d", "", "last"]);
    assert_eq!((seen.line(0), seen.line(7), seen.line(usize::MAX)), (None, None, None));
    assert_eq!(seen.longest(), 4);
    assert_eq!(seen.encoding(), Encoding::Utf8);
}

#[test]
fn the_longest_line_is_counted_in_characters() {
    assert_eq!(preview("ääää\nabcde\n").longest(), 5);
    assert_eq!(preview("äääääää\nabcde\n").longest(), 7);
}

#[test]
fn what_no_reader_takes_has_no_preview() {
    assert_eq!(Preview::new(b" \n ").unwrap_err(), ReadError::Empty);
    assert!(matches!(Preview::new(b"PK\x03\x04").unwrap_err(), ReadError::Binary(..)));
    assert!(matches!(Preview::new(&vec![b' '; MAX_BYTES + 1]).unwrap_err(), ReadError::TooLarge { .. }));
}

#[test]
fn a_part_of_a_line_is_drawn_and_ranges_follow() {
    let seen = preview("aä\tb\u{7}\u{202e}cd");
    let all = seen.shown(1, 0, 400).unwrap();
    assert_eq!(all.text, "aä→b··cd");
    assert!(!all.more_before && !all.more_after);
    let line = seen.line(1).unwrap();
    let at = line.find("cd").unwrap();
    assert_eq!(&all.text[all.map(&(at..at + 2)).unwrap()], "cd");
    let part = seen.shown(1, 1, 3).unwrap();
    assert_eq!(part.text, "ä→b");
    assert!(part.more_before && part.more_after);
    assert_eq!(part.map(&(0..1)), None);
    assert_eq!(&part.text[part.map(&(0..3)).unwrap()], "ä");
    assert_eq!(part.map(&(at..at + 2)), None);
    assert_eq!(seen.shown(1, 100, 3).unwrap().text, "");
    assert_eq!(seen.shown(2, 0, 3), None);
}

/// The piece of a text that an error is about.
fn fault(text: &str) -> (usize, String) {
    let error = read(text.as_bytes(), &ReadOptions::default()).unwrap_err();
    let seen = preview(text);
    let (number, range) = seen.error_range(&error).unwrap();
    (number, seen.line(number).unwrap()[range].to_owned())
}

#[test]
fn a_failure_is_found_in_its_line() {
    assert_eq!(fault("nm;A\n400;1\n410;x1\n420;3\n430;4\n"), (3, "x1".into()));
    assert_eq!(fault("nm,A,B\n400,1,1\n410,oh,oh\n420,3,3\n430,4,4\n"), (3, "oh".into()));
    assert_eq!(fault("nm,A\n400,1\n410,2\n  420,3,5 \n430,4\n"), (4, "420,3,5".into()));
    let (line, _) = fault("{\n  \"spectral_data\": {\n    \"data\": {\"main\": {\"380\": [0.1], }}\n");
    assert!(line >= 3);
}

#[test]
fn an_error_of_the_whole_file_has_no_range() {
    let seen = preview("no numbers");
    assert_eq!(seen.error_range(&ReadError::NoNumbers), None);
    assert_eq!(seen.error_range(&ReadError::OneColumn(7)), None);
    let error = ReadError::NotANumber { line: 1, column: usize::MAX, text: "absent".into() };
    assert_eq!(seen.error_range(&error), Some((1, 0..10)));
}

#[test]
fn a_header_in_the_first_line_is_marked() {
    let seen = Seen::new("nm;leaf (%)\n400;5,0\n500;10,0\n600;20,0\n".as_bytes());
    let said = seen.said(1);
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(seen.pieces(1)[1].1 == What::Name(0), "{said:?}");
}
