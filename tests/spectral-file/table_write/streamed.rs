//! Tables that are passed on in parts, and cells that no program takes for anything but text.

use super::{Curves, back, sheet};
use spectral_file::write::{Content, Format, Grid, Prepared, Trace, write};
use spectral_file::{ReadOptions, guarded, read};

/// More than a hundred parts of text are passed on, none longer than a part and a row, and together they are the table.
#[test]
fn a_long_table_is_passed_on_in_short_parts() {
    let curves = Curves::bells(&["a", "b", "c", "d"], [380.0, 780.0], 5.0);
    let traces = curves.traces();
    let sheet = sheet(Content::Other, &traces);
    let mut prepared = Prepared::new(&sheet, Grid::Step(0.004)).unwrap();
    let (mut text, mut longest, mut parts) = (String::new(), 0, 0);
    prepared.table(&mut |part| {
        text.push_str(part);
        (longest, parts) = (longest.max(part.len()), parts + 1);
        true
    });
    assert_eq!(text.lines().count(), 100_002);
    assert!(parts > 100 && longest < 70_000, "{parts} parts, the longest of {longest} bytes");
    let whole = write(&sheet, Format::Csv, Grid::Step(0.004)).unwrap();
    assert_eq!((whole.text, whole.notes), (text, prepared.notes()));
}

/// A writer that is full ends the work, not only the output.
#[test]
fn who_has_enough_gets_no_more() {
    let curves = Curves::bells(&["a", "b"], [380.0, 780.0], 5.0);
    let traces = curves.traces();
    let sheet = sheet(Content::Other, &traces);
    let mut prepared = Prepared::new(&sheet, Grid::Step(0.01)).unwrap();
    let mut calls = 0;
    prepared.table(&mut |_| {
        calls += 1;
        calls < 3
    });
    assert_eq!(calls, 3);
    calls = 0;
    prepared.each(|_, _, _| {
        calls += 1;
        false
    });
    assert_eq!(calls, 1);
}

/// One curve after the other has the samples that the table has.
#[test]
fn curves_are_those_of_the_table() {
    let mut curves = Curves::bells(&["a", "b", "c"], [400.0, 700.0], 7.0);
    curves.0[1].1.truncate(20);
    curves.0[1].2.truncate(20);
    let own = Curves::bells(&["d"], [503.25, 507.5], 0.25);
    curves.0.extend(own.0);
    let traces = curves.traces();
    for grid in [Grid::Native, Grid::Step(3.0), Grid::Step(0.01)] {
        let sheet = sheet(Content::Other, &traces);
        let table = read(write(&sheet, Format::Csv, grid).unwrap().text.as_bytes(), &ReadOptions::default()).unwrap();
        let mut prepared = Prepared::new(&sheet, grid).unwrap();
        let mut index = 0;
        prepared.each(|wavelengths, values, _| {
            assert_eq!(wavelengths, table.curves[index].wavelengths_nm, "{grid:?} {index}");
            assert_eq!(values, table.curves[index].values, "{grid:?} {index}");
            index += 1;
            true
        });
        assert_eq!(index, 4);
    }
}

/// Spreadsheets run a cell that begins with one of these, quoted or not.
fn runs(cell: &str) -> bool {
    cell.starts_with(['=', '+', '-', '@', '\t', '\r', '＝', '＋', '－', '＠']) && cell.parse::<f64>().is_err()
}

#[test]
fn no_name_runs_in_a_spreadsheet_and_each_is_read_back() {
    let names = [
        "=cmd|calc!A1",
        "+1+1",
        "@SUM(A1)",
        "-2+3",
        "'=x",
        "''-y",
        "'tis",
        "-leaf",
        "－x",
        "=HYPERLINK(\"a\", \"b\")",
        "+",
        "=1;2",
        "leaf",
    ];
    let curves = Curves::bells(&names, [400.0, 700.0], 10.0);
    let traces = curves.traces();
    let text = write(&sheet(Content::Other, &traces), Format::Csv, Grid::Native).unwrap().text;
    let mut cells = csv_cells(text.lines().next().unwrap());
    assert_eq!(cells.remove(0), "wavelength_nm");
    assert!(!cells.iter().any(|cell| runs(cell)), "{cells:?}");
    let table = back(&text);
    assert_eq!(table.curves.iter().map(|curve| curve.name.as_str()).collect::<Vec<_>>(), names);
    assert_eq!(guarded("-2.5e3"), "-2.5e3", "a number is a number");
}

/// The cells of a line as a spreadsheet sees them.
fn csv_cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '"' if quoted && rest.peek() == Some(&'"') => cells.last_mut().unwrap().extend(rest.next()),
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}

/// Names come from files, which may hold anything; each is one line of plain text once it is read.
#[test]
fn names_are_read_on_one_line_without_control_characters() {
    let name = |file: &str| read(file.as_bytes(), &ReadOptions::default()).unwrap().curves[0].name.clone();
    let csv = |name: &str| format!("nm,{name},b\n400,0.1,0.2\n500,0.2,0.3\n600,0.3,0.4\n");
    assert_eq!(name(&csv("\u{1b}]0;pwned\u{7}\u{1b}[31mR")), "]0;pwned  [31mR");
    assert_eq!(name(&csv("a\u{9b}31mb")), "a 31mb", "C1");
    assert_eq!(name(&csv("a\u{202e}fdp.exe")), "afdp.exe", "turned text");
    let json = "{\"header\": {\"schema_version\": \"1.0.0\", \"manufacturer\": \"N\", \"model\": \"1\"}, \"spectral_data\": \
                {\"units\": \"relative\", \"index\": {\"main\": [\"R\\u0000d\", \"G\\ny\", \"B\"]}, \"data\": {\"main\": \
                {\"380\": [0.02, 0.03, 0.04], \"385\": [0.04, 0.02, 0.01], \"390\": [0.04, 0.02, 0.02]}}}}";
    let table = read(json.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!([&*table.curves[0].name, &*table.curves[1].name], ["R d", "G y"], "NUL and line feed");
}

#[test]
fn what_is_written_of_a_name_stays_on_its_line() {
    let (wavelengths, values) = ([400.0, 500.0], [0.1, 0.2]);
    let trace =
        Trace { name: "a\u{0}b\r\nc\u{202e}d", wavelengths_nm: &wavelengths, values: &values, uncertainty: None };
    let text = write(&sheet(Content::Other, &[trace]), Format::Csv, Grid::Native).unwrap().text;
    assert_eq!(text, "wavelength_nm,a b  cd [unspecified quantity]\n400,0.1\n500,0.2\n");
}
