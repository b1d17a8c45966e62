//! Columns of text, columns before the wavelengths, lines that begin with `#`, names that come again, thousands.

use spectral_file::{
    Certainty, DecimalMark, Delimiter, NearMiss, ReadError, ReadOptions, Warning, Watch, WavelengthUnit, read,
    read_watched,
};

use super::{error, names, ok, samples};

/// Number of looks at the watch while a text is read: once for each table in it, and once for each 256 KiB that are looked at,
/// however often they were before.
fn looks(text: &str, values: usize) -> usize {
    let looks = std::cell::Cell::new(0);
    let go_on = |_: f32| {
        looks.set(looks.get() + 1);
        true
    };
    let table = read_watched(text.as_bytes(), &ReadOptions::default(), Watch::new(&go_on)).unwrap();
    assert_eq!(table.curves[0].values.len(), values);
    looks.get()
}

#[test]
fn thousands_of_short_tables_are_read_in_proportion() {
    const COUNT: usize = 3200;
    // Reading to the end from each table would look at 120 MB, which are 480 looks.
    let short = looks(&"nm,A\n400,1\n410,2\n420,3\n\n".repeat(COUNT), 3);
    assert!(short <= COUNT + 40, "{short} looks");
    // Where wavelengths just start again, only reading on shows where: up to 64 MB, which are 256 looks.
    let whole = looks(&"400;1\n410;2\n420;3\n430;4\n440;5\n".repeat(COUNT), 5);
    assert!(whole <= COUNT + 300, "{whole} looks");
}

#[test]
fn short_tables_can_be_stopped() {
    let text = "nm,A\n400,1\n410,2\n420,3\n\n".repeat(20_000);
    let looks = std::cell::Cell::new(0);
    let go_on = |_: f32| {
        looks.set(looks.get() + 1);
        looks.get() < 20
    };
    let result = read_watched(text.as_bytes(), &ReadOptions::default(), Watch::new(&go_on));
    assert_eq!((result, looks.get()), (Err(ReadError::Stopped), 20));
}

#[test]
fn names_with_a_number_sign_are_rows() {
    let head = "name,400,410,420,430,440\n";
    let table = ok(&format!("{head}#0,1,2,3,4,5\n#1,2,3,4,5,6\ns3,3,4,5,6,7\n# by hand\n"));
    assert_eq!(names(&table), ["#0", "#1", "s3"]);
    assert_eq!(names(&ok(&format!("{head}#0,1,2,3,4,5\n#1,2,3,4,5,6\n"))), ["#0", "#1"]);
}

#[test]
fn rows_behind_a_number_sign_are_told() {
    let table = ok("nm,a\n540,0.5\n#550,0.55\n560,0.6\n# a remark\n570,0.7\n");
    assert_eq!(table.curves[0].values.len(), 3);
    let [Warning::CommentedRows(lines)] = table.warnings.as_slice() else { panic!("{:?}", table.warnings) };
    assert_eq!((lines.first(), table.warnings[0].line()), (&[3][..], Some(3)));
}

#[test]
fn marks_that_may_group_thousands_are_a_guess() {
    for mark in [',', '.'] {
        let table = ok(&"nm;a\n400;4_800\n410;5_100\n420;6_250\n430;7_000\n".replace('_', &mark.to_string()));
        assert_eq!(table.curves[0].values[0], 4.8);
        assert_eq!(table.reading.decimal_mark.certainty, Certainty::Guess);
        assert!(table.warnings.contains(&Warning::MaybeThousands), "{:?}", table.warnings);
    }
    let fractions = ok("nm;a\n400;4.800\n410;5.100\n420;6.250\n430;0.900\n440;7.000\n");
    assert!(fractions.warnings.is_empty());
}

#[test]
fn marks_next_to_whole_numbers_of_three_digits_group_thousands() {
    let counts = [980.0, 990.0, 1000.0, 1010.0];
    let quoted = "nm,c\n400,980\n410,990\n420,\"1,000\"\n430,\"1,010\"\n";
    let bare = "nm;c\n400;980\n410;990\n420;1,000\n430;1,010\n";
    for text in [quoted, bare, &bare.replace(';', "\t"), &bare.replace(',', ".")] {
        let table = ok(text);
        assert_eq!(table.curves[0].values, counts, "{text}");
        assert_eq!(table.reading.decimal_mark.certainty, Certainty::Guess);
        let [Warning::GroupedThousands(fractions)] = table.warnings.as_slice() else { panic!("{:?}", table.warnings) };
        let chosen = ReadOptions { decimal_mark: Some(*fractions), ..ReadOptions::default() };
        assert_eq!(read(text.as_bytes(), &chosen).unwrap().curves[0].values, [980.0, 990.0, 1.0, 1.01], "{text}");
    }
    let two = ok("nm,c,d\n400,980,970\n410,990,980\n420,\"1,000\",990\n430,\"1,010\",\"1,000\"\n");
    assert_eq!((two.curves[0].values.as_slice(), two.curves[1].values[3]), (&counts[..], 1000.0));
    let across = ok("name;400;410;420;430;440\na;980;990;1,000;1,010;1,020\n");
    assert_eq!(across.curves[0].values[1..], [990.0, 1000.0, 1010.0, 1020.0]);
    // Far below the lines that are tried first.
    let long = (0..600).fold(String::new(), |text, i| format!("{text}{};{}\n", 400 + i, 390 + i));
    assert_eq!(ok(&format!("{long}1000;1,000\n")).curves[0].values[600], 1000.0);
}

#[test]
fn points_that_are_chosen_leave_commas_to_thousands() {
    let points = ReadOptions { decimal_mark: Some(DecimalMark::Point), ..ReadOptions::default() };
    for text in ["nm;c\n400;1,000\n410;1,100\n", "nm,c\n400,\"1,000\"\n410,\"1,100\"\n"] {
        assert_eq!(read(text.as_bytes(), &points).unwrap().curves[0].values, [1000.0, 1100.0]);
    }
    assert!(read(b"nm;c\n400;1,000\n410;1,10\n", &points).is_err());
}

#[test]
fn fractions_of_three_digits_are_no_thousands() {
    let table = ok("nm;Reflectance (%)\n400;99.125\n410;100\n420;98.750\n430;97.125\n440;96.500\n");
    assert_eq!((table.curves[0].values[0], table.warnings.as_slice()), (0.99125, &[][..]));
    let named = ok("nm;Reflectance\n400;9.125\n410;7.100\n420;8.750\n430;7.125\n440;6.500\n");
    assert_eq!((named.curves[0].values[0], named.warnings.as_slice()), (0.09125, &[][..]));
    assert_eq!(ok("nm;c\n400;98,125\n410;100\n420;98,750\n").curves[0].values[0], 98.125);
}

#[test]
fn a_row_with_a_bad_cell_is_no_header() {
    for text in ["nm,R\n400,0.1\n410,0.2x\n500,0.3\n510,0.4\n", "# a\nnm,a\n400,0.2x\n\n500,0.4\n"] {
        let error = read(text.as_bytes(), &ReadOptions::default()).unwrap_err();
        assert_eq!(error, ReadError::NotANumber { line: 3, column: 2, text: "0.2x".to_owned() });
    }
}

#[test]
fn thousands_set_apart_are_numbers() {
    let wanted = [(400.0, 1234.5), (410.0, 2345.5), (420.0, 3456.5)];
    for text in [
        "nm;a\n400;1.234,5\n410;2.345,5\n420;3.456,5\n",
        "nm,a\n400,\"1,234.5\"\n410,\"2,345.5\"\n420,\"3,456.5\"\n",
        "nm;a\n400;1 234,5\n410;2 345,5\n420;3 456,5\n",
    ] {
        assert_eq!(samples(&ok(text).curves[0]), wanted, "{text}");
    }
}

#[test]
fn columns_before_the_wavelengths_are_curves_too() {
    let table = ok("A,nm,B\n1.5,400,4\n2,410,5\n3,420,6\n");
    assert_eq!((names(&table), table.warnings.len()), (vec!["A", "B"], 0));
    let last = ok("A,B,Wavelength\n1.5,4,400\n2,5,410\n3,6,420\n");
    assert_eq!((names(&last), last.reading.wavelength_column), (vec!["A", "B"], Some(3)));
    let pixel = ok("Pixel,A,nm\n1,4.5,400\n2,5,410\n3,6,420\n");
    assert_eq!((names(&pixel), pixel.warnings.len()), (vec!["A"], 1));
}

#[test]
fn names_that_come_again_are_left_out() {
    let table = ok("nm,a\n400,1\n410,2\nnm,a\n420,3\n430,4\n");
    assert_eq!(table.curves[0].values.len(), 4);
    let [Warning::RepeatedHeader(lines)] = table.warnings.as_slice() else { panic!("{:?}", table.warnings) };
    assert_eq!(lines.first(), [4]);
    assert!(matches!(error("nm,a\n400,1\n410,2\noops,a\n420,3\n"), ReadError::NotANumber { line: 4, .. }));
}

#[test]
fn a_row_of_measured_numbers_names_nothing() {
    let table = ok("Data;s1;s2\nx;0.33;0.34\n380;1.5;2\n390;2;3\n400;3;4\n");
    assert_eq!(names(&table), ["s1", "s2"]);
}

#[test]
fn ångströms_of_the_infrared_look_like_visible_wave_numbers() {
    for text in [
        "14000,1\n20000,2\n25000,3\n",
        "23478.9 0\n25000 0.4\n27526.1 0\n",
        "# the pass band\n30000 0\n35000 1\n45000 0\n",
    ] {
        assert!(matches!(error(text), ReadError::AmbiguousUnit { .. }), "{text}");
    }
    let text = "#   wavelength in AA\n23478.9 0\n25000 0.4\n27526.1 0\n";
    assert_eq!(ok(text).reading.wavelength_unit.value, WavelengthUnit::Angstrom);
}

#[test]
fn a_first_column_of_another_quantity_is_no_wavelength() {
    let heads = [
        "Time(msec)",
        "T (K)",
        "# T_surf (K)",
        "Theta (degrees)",
        "2theta",
        "lon (deg)",
        "P conc. (mg/kg)",
        "Temperature",
    ];
    for head in heads {
        let text = format!("{head},signal\n400,1.5\n410,2.5\n420,3.5\n430,3\n");
        assert!(matches!(error(&text), ReadError::NoWavelengths(_)), "{text}");
    }
    assert!(matches!(error("X,Y,Z\n400,1.5,2\n410,2,3\n420,3,2\n"), ReadError::NoWavelengths(_)));
    assert_eq!(ok("device,1F00145\ntime,00:21:33\n400,1.5\n410,2\n420,3\n").curves.len(), 1);
    let innocent = ok("x,y\n400,1.5\n410,2\n420,3\n");
    assert_eq!(names(&innocent).len(), 1);
}

#[test]
fn columns_of_text_are_left_out() {
    for (text, warnings) in [
        ("nm;remark;a\n400;good;1.5\n410;bad;2\n420;good;3\n", 1),
        ("date;nm;a\nmon;400;1.5\ntue;410;2\nwed;420;3\n", 1),
        ("nm,a,remark\n400,1.5,x\n410,2,y\n420,3,z\n", 1),
    ] {
        let table = ok(text);
        assert_eq!(names(&table), ["a"], "{text}");
        assert_eq!(table.curves[0].values.len(), 3);
        assert_eq!(table.warnings.len(), warnings, "{:?}", table.warnings);
    }
    let disorder = error("one;2;x;3\ntwo;1;y;3\nthree;2;z;4\n");
    assert!(matches!(disorder, ReadError::NearlyRow { line: 1, why: NearMiss::Order, .. }), "{disorder}");
}

#[test]
fn what_is_nearly_a_row_is_cited() {
    for (text, line, why) in [
        ("hello\nnm;R\n400: 0.1\n410: 0.2\n", 3, NearMiss::Between(':')),
        ("400/0.1\n410/0.2\n420/0.3\n", 1, NearMiss::Between('/')),
        ("nm R\n400 abc\n410 def\n420 x\n", 2, NearMiss::TextAfter),
        ("nm;R\n400;\"\n", 2, NearMiss::TextAfter),
    ] {
        let found = error(text);
        assert_eq!(found.line(), Some(line), "{found}");
        assert!(matches!(found, ReadError::NearlyRow { why: found, .. } if found == why), "{text}: {found}");
    }
    let said = error("nm;R\n400: 0.1\n410: 0.2\n").to_string();
    let remedy = "separate them by commas, semicolons, tabs or spaces";
    assert_eq!(said, format!("line 2: no rows of numbers: \"400: 0.1\" has “:” between its numbers: {remedy}"));
    assert_eq!(error("The quick brown\nfox jumps over the dog\n"), ReadError::NoNumbers);
}

#[test]
fn an_error_that_a_choice_caused_says_so() {
    let tab = ReadOptions { delimiter: Some(Delimiter::Tab), ..ReadOptions::default() };
    let found = read(b"400;0.1\n410;0.2\n", &tab).unwrap_err();
    assert!(matches!(&found, ReadError::AsChosen { switch, .. } if switch == "tab separated"), "{found:?}");
    assert!(found.to_string().ends_with("choose other separators (as chosen: tab separated)"), "{found}");
    assert_eq!(found.line(), Some(1));
    let far = ReadOptions { wavelength_unit: Some(WavelengthUnit::Micrometer), ..ReadOptions::default() };
    let found = read(b"400;0.1\n410;0.2\n", &far).unwrap_err();
    assert!(found.to_string().ends_with("(as chosen: micrometers)"), "{found}");
    assert_eq!(read(b"hello\n", &tab), Err(ReadError::NoNumbers));
}

#[test]
fn a_column_of_the_wavelengths_again_is_no_curve() {
    let level = ok("nm,level,A\n400,400,1\n410,410,2\n420,420,3\n");
    assert_eq!(names(&level), ["A"]);
    assert!(level.warnings.iter().any(|warning| matches!(warning, Warning::OtherAxes { .. })), "{:?}", level.warnings);
    let pairs = ok("x1_data,y1_data,x2_data,y2_data\n400,1,400,5\n410,2,410,6\n420,3,420,7\n");
    assert_eq!((names(&pairs), pairs.curves[1].values[0]), (vec!["y1_data", "y2_data"], 5.0));
    assert_eq!(names(&ok("lambda,A,lambda,B\n400,1,400,2\n410,1,410,2\n420,1,420,2\n")), ["A", "B"]);
    assert_eq!(ok("400,1,400,2\n410,1,410,3\n420,2,420,2\n").curves.len(), 2);
}
