//! Rows with units in their cells, with text among them, and rows that come again.

use spectral_file::{Dropped, LeftOut, Mark, Preview, ReadOptions, Role, Warning, Watch, What, read, read_marked};

use super::{names, ok, samples};

#[test]
fn cells_with_a_unit_are_numbers_where_the_column_agrees() {
    let ok = |text: &str| {
        let options = ReadOptions { role: text.contains('%').then_some(Role::Reflectance), ..ReadOptions::default() };
        read(text.as_bytes(), &options).unwrap()
    };
    let table = ok("nm,A\n400,4.0%\n410,5.0%\n420,6.5%\n");
    assert_eq!(samples(&table.curves[0]), [(400.0, 0.04), (410.0, 0.05), (420.0, 0.065)]);
    assert_eq!((table.curves[0].unit.as_deref(), table.warnings.len()), (Some("%"), 0));
    for text in ["400 4.0%\n410 5.0%\n420 6.5%\n", "400\t4.0 %\n410\t5.0 %\n420\t6.5 %\n"] {
        assert_eq!(samples(&ok(text).curves[0]), samples(&table.curves[0]), "{text}");
    }
    let power = ok("nm;P;Q\n400;12,5 mW;1\n410;13 mW;2\n420;;3\n430;14 mW;4\n");
    assert_eq!(samples(&power.curves[0]), [(400.0, 12.5), (410.0, 13.0), (430.0, 14.0)]);
    assert_eq!((power.curves[0].unit.as_deref(), names(&power)), (Some("mW"), vec!["P", "Q"]));
    assert_eq!(power.role.value, Role::Illuminant);
    let area = ok("nm;P\n400;0.5 W/m2\n410;0.6 W/m2\n420;0.7 W/m2\n");
    assert_eq!(
        (area.curves[0].values.as_slice(), area.curves[0].unit.as_deref()),
        (&[0.5, 0.6, 0.7][..], Some("W/m2"))
    );
}

#[test]
fn cells_whose_units_differ_are_text() {
    for cells in
        [["0.5 W/m2", "0.6 mW", "0.7 W/m2"], ["1%", "2%", "bad"], ["1%", "2", "3%"], ["5 oaks", "6 oaks", "7 oaks"]]
    {
        let table = ok(&format!("nm;P;Q\n400;{};1\n410;{};2\n420;{};3\n", cells[0], cells[1], cells[2]));
        assert_eq!(names(&table), ["Q"], "{cells:?}");
        assert_eq!(table.warnings, [Warning::TextColumns { count: 1, column: 2, name: "P".to_owned() }]);
        assert_eq!(table.warnings[0].to_string(), "Column 2 (“P”) holds text: left out");
    }
}

#[test]
fn remarks_in_some_rows_are_left_out() {
    let table = ok("nm,A,note\n400,1.5,good\n410,2,\n420,3,ok\n430,4,\n440,5,\n");
    assert_eq!((names(&table), table.curves[0].values.len()), (vec!["A"], 5));
    assert!(matches!(table.warnings.as_slice(), [Warning::TextColumns { column: 3, .. }]), "{:?}", table.warnings);
}

fn marks(text: &str, line: usize) -> Vec<Mark> {
    let (table, marker) = read_marked(text.as_bytes(), &ReadOptions::default(), Watch::none()).unwrap();
    Preview::new(text.as_bytes()).unwrap().marks(line, &table, &marker)
}

#[test]
fn values_with_units_are_marked_in_the_text() {
    let marks = marks("nm,Reflectance\n400,4.0%\n410,5.0%\n420,6.5%\n", 2);
    assert_eq!(marks[1].what, What::Value { curve: 0, nm: 400.0, value: 0.04, written: 4.0 });
}

#[test]
fn one_wavelength_with_several_values_has_their_mean() {
    let text = "nm,A,B\n400,1.5,1\n410,2,\n410,2.5,4\n420,3,3\n430,3,3\n";
    let table = ok(text);
    assert_eq!(table.curves[0].values, [1.5, 2.25, 3.0, 3.0]);
    assert_eq!(table.curves[1].values, [1.0, 4.0, 3.0, 3.0]);
    let [Warning::AveragedRows(lines)] = table.warnings.as_slice() else { panic!("{:?}", table.warnings) };
    assert_eq!(lines.first(), [3, 4]);
    assert!(table.reading.dropped_rows.iter().all(|row| row.why == Dropped::Averaged));
    assert_eq!(marks(text, 4)[0].what, What::LeftOut(LeftOut::Averaged));
    assert_eq!(ok("nm,a\n400,2\n390,2\n390,3\n380,1\n").curves[0].values, [1.0, 2.5, 2.0]);
    let pairs = ok("nm,a\n400,1\n400,2\n410,2\n410,3\n420,3\n420,4\n");
    assert_eq!(pairs.curves[0].values, [1.5, 2.5, 3.5]);
    let huge = ok("nm,a\n400,1e308\n400,1e308\n400,9e307\n410,2\n");
    assert!(huge.curves[0].values[0].is_finite());
}

#[test]
fn rows_that_begin_anew_are_another_spectrum() {
    let below = "nm,A\n400,10\n410,20\n420,30\n400,20\n410,30\n420,40\n";
    let named = "sample,nm,R\nleaf,400,0.1\nleaf,410,0.2\nleaf,420,0.3\nbark,400,0.2\nbark,410,0.3\nbark,420,0.4\n";
    // Rows of named samples are read as curves of one table, and part by part where a part is chosen.
    assert_eq!((ok(named).curves.len(), ok(named).reading.parts.len()), (2, 1));
    for text in [below, named] {
        let options = ReadOptions { part: Some(1), ..ReadOptions::default() };
        let table = read(text.as_bytes(), &options).unwrap();
        assert_eq!((table.reading.parts.len(), table.curves[0].values.len()), (2, 3), "{text}");
        let second = read(text.as_bytes(), &ReadOptions { part: Some(2), ..ReadOptions::default() }).unwrap();
        assert_eq!(second.curves[0].wavelengths_nm, [400.0, 410.0, 420.0]);
        assert!(second.curves[0].values[0] > table.curves[0].values[0]);
    }
}

#[test]
fn a_sign_of_percent_behind_a_name_is_its_unit() {
    for (head, name) in [("R%", "R"), ("leaf %", "leaf")] {
        let options = ReadOptions { role: Some(Role::Reflectance), ..ReadOptions::default() };
        let table = read(format!("nm,{head}\n400,10\n410,20\n420,30\n").as_bytes(), &options).unwrap();
        let curve = &table.curves[0];
        assert_eq!((curve.name.as_str(), curve.unit.as_deref(), curve.values[0]), (name, Some("%"), 0.1));
    }
}

#[test]
fn holes_and_what_nobody_sees_are_told() {
    let rows = |nm: std::ops::Range<usize>| nm.step_by(2).fold(String::new(), |text, nm| format!("{text}{nm},0.5\n"));
    let holed = ok(&format!("nm,A\n{}{}", rows(400..440), rows(500..540)));
    assert_eq!(holed.warnings, [Warning::Hole { count: 1, from_nm: 438.0, to_nm: 500.0, lines: Some([21, 22]) }]);
    assert_eq!(ok(&format!("nm,A\n{}", rows(800..840))).warnings, [Warning::Invisible]);
    assert_eq!(ok(&format!("nm,A\n{}", rows(780..840))).warnings, []);
}
