//! Tables of recorded raw values: reading them, and joining them with spectra.

use chromascope::catalog::recorded::{JoinError, Levels, RawRow, RawTable, join, read_table};
use chromascope_core::camera::recorded::RecordedPatch;
use chromascope_core::spectral::GridSpectrum;

fn rgb(table: &RawTable) -> Vec<[f64; 3]> {
    table.rows.iter().map(|row| row.rgb).collect()
}

#[test]
fn tables_with_and_without_spectra() {
    let table = read_table(b"# a comment\npatch;R;G;B\n\"a;b\";1,5;2;3\nc;;-;nan\n").expect("read");
    assert_eq!(table.rows[0], RawRow { line: 3, name: Some("a;b".to_owned()), rgb: [1.5, 2.0, 3.0] });
    assert!(table.rows[1].rgb.iter().all(|v| v.is_nan()) && table.spectra.is_none());
    assert_eq!(rgb(&read_table(b"1\t2\t3\n4\t5\t6\n").expect("read")), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let table = read_table(b"name,400,blue,500,Red,green\nx,0.1,3,0.2,1,2\n").expect("read");
    assert_eq!(rgb(&table), [[1.0, 2.0, 3.0]]);
    assert_eq!(table.spectra.as_deref(), Some("name,400,500\nx,0.1,0.2\n"));
}

#[test]
fn broken_tables_name_line_and_column() {
    let complaint = |text: &str| read_table(text.as_bytes()).expect_err("refused").to_string();
    assert_eq!(complaint("# nothing\n"), "no rows; expected columns patch,R,G,B");
    assert_eq!(complaint("patch,x,y\n"), "line 1: no columns R, G and B; head the columns of raw values so");
    assert_eq!(complaint("patch,R,G,B\na,1,2\n"), "line 2: 3 cells for 4 heads");
    let text = complaint("patch,R,G,B\na,1,two,3\n");
    assert_eq!(text, "line 2, column 3: \"two\" is not a number; leave a missing value empty");
    assert!(complaint("patch,R,G,B\na,inf,2,3\n").contains("\"inf\" is not a number"));
}

#[test]
fn rows_find_their_spectra_by_name_or_in_order() {
    let spectra: Vec<(String, GridSpectrum)> =
        ["Dark Skin", "b"].iter().map(|name| ((*name).to_owned(), GridSpectrum::constant(1.0))).collect();
    let rows = |names: &[Option<&str>]| -> Vec<RawRow> {
        let row = |(line, name): (usize, Option<&str>)| RawRow {
            line: line + 1,
            name: name.map(str::to_owned),
            rgb: [line as f64 + 1.0; 3],
        };
        names.iter().copied().enumerate().map(row).collect()
    };
    let joined = |names: &[Option<&str>]| join(&spectra, &rows(names), Levels::default());
    let values = |patches: Vec<RecordedPatch>| -> Vec<f64> {
        patches.iter().map(|patch| patch.rgb[0].value().expect("read")).collect()
    };
    assert_eq!(values(joined(&[None, None]).expect("read")), [1.0, 2.0]);
    let by_name = joined(&[Some("B"), Some("dark-skin")]).expect("read");
    assert_eq!((by_name[0].name.as_str(), values(by_name.clone())), ("b", vec![1.0, 2.0]));
    assert_eq!(joined(&[Some("b")]).expect("read").len(), 1);
    assert_eq!(joined(&[None]), Err(JoinError::Count { rows: 1, spectra: 2 }));
    assert!(joined(&[Some("c")]).expect_err("refused").to_string().contains("\"c\"; there are Dark Skin, b"));
    assert!(matches!(joined(&[Some("b"), Some("b")]), Err(JoinError::Twice { line: 2, .. })));
    // The 24 of a ColorChecker also by number, and by row and column.
    let chart =
        chromascope_core::patch_set::COLOR_CHECKER_CHROMATIC.iter().copied().chain(["w", "8", "6.5", "5", "3.5", "k"]);
    let chart: Vec<_> = chart.map(|name| (name.to_owned(), GridSpectrum::constant(1.0))).collect();
    for (written, name) in [("A01", "dark skin"), ("b2", "purplish blue"), ("D6", "k"), ("18", "cyan"), ("8", "8")] {
        let found = join(&chart, &rows(&[Some(written)]), Levels::default()).expect(written);
        assert_eq!(found[0].name, name, "{written}");
    }
    assert!(["E1", "A7", "25", "0"].iter().all(|name| join(&chart, &rows(&[Some(name)]), Levels::default()).is_err()));
    let levels = Levels { black: 64.0, clip: 100.0 };
    let row = RawRow { line: 1, name: Some("b".to_owned()), rgb: [65.0, 100.0, 64.0] };
    let patch = &join(&spectra, &[row], levels).expect("read")[0];
    let said = patch.rgb.map(|signal| signal.value().map_err(|why| why.to_string()));
    assert_eq!(said, [Ok(1.0), Err("clipped".to_owned()), Err("zero or negative".to_owned())]);
}
