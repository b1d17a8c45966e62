//! Several tables in one file, several columns of wavelengths in one table, and the switches for them.

use std::cell::Cell;

use proptest::prelude::*;
use spectral_file::{Certainty, ReadError, ReadOptions, Reader, SpectralFile, Warning, Watch, read, read_watched};

use super::{names, ok, samples};

fn with(text: &str, options: &ReadOptions) -> Result<SpectralFile, ReadError> {
    read(text.as_bytes(), options)
}

fn part(text: &str, part: usize) -> Result<SpectralFile, ReadError> {
    with(text, &ReadOptions { part: Some(part), ..ReadOptions::default() })
}

#[test]
fn tables_below_one_another() {
    let text = "nm,a\n380,1\n390,2\n400,3\nnm,b\n380,4\n390,5\n";
    let first = ok(text);
    assert_eq!((names(&first), first.reading.parts.len()), (vec!["a"], 2));
    assert_eq!(first.warnings, [Warning::MoreTables(6)]);
    assert_eq!((first.reading.part.value, first.reading.part.certainty), (1, Certainty::Guess));
    let said = first.decisions().into_iter().find(|decision| decision.what == "Part").unwrap().to_string();
    assert_eq!(said, "2 tables stand below one another: read as part 1 of 2, from line 2.");
    let second = part(text, 2).unwrap();
    assert_eq!((names(&second), samples(&second.curves[0])), (vec!["b"], vec![(380.0, 4.0), (390.0, 5.0)]));
    assert_eq!((second.reading.first_data_line, second.warnings.len()), (6, 0));
    assert_eq!(second.reading.part.certainty, Certainty::Chosen);
    assert_eq!(second.reading.parts, first.reading.parts);
    assert_eq!(part(text, 3), Err(ReadError::NoSuchPart { part: 3, parts: 2 }));
    assert_eq!(part(text, 0), Err(ReadError::NoSuchPart { part: 0, parts: 2 }));
    assert_eq!(part("380,1\n390,2\n", 2), Err(ReadError::NoSuchPart { part: 2, parts: 1 }));
    let wider = "380,1\n390,2\n400,3\nagain\n401,2,3\n402,3,4\n";
    assert_eq!(part(wider, 2).unwrap().curves.len(), 2);
}

#[test]
fn a_table_below_that_is_broken_is_told() {
    let rows = |from: u32| (0..6).map(|i| format!("{},{}\n", 380 + 10 * i, from + i)).collect::<Vec<_>>().concat();
    let text = format!("nm,a\n{}nm,b,c\n380,1,2\n390,oops,3\n400,5,6\n410,6,7\n420,7,8\n", rows(1));
    let table = ok(&text);
    assert_eq!(table.curves[0].values.len(), 6);
    let [Warning::BrokenTable { line, error }] = table.warnings.as_slice() else { panic!("{:?}", table.warnings) };
    assert_eq!((*line > 7, error.line()), (true, Some(10)), "{error}");
}

#[test]
fn the_same_wavelengths_again_are_another_table() {
    let pass = |from: u32| (0..8).map(|i| format!("{},{}\n", 380 + 10 * i, from + i)).collect::<Vec<_>>().concat();
    let text = format!("{}\n{}{}", pass(1), pass(5), pass(9));
    let table = ok(&text);
    assert_eq!((table.curves[0].values.len(), table.reading.parts.len()), (8, 3));
    assert_eq!(table.warnings, [Warning::MoreTables(10)]);
    assert_eq!(part(&text, 3).unwrap().curves[0].values[0], 9.0);
    let other = text.replace(',', ";");
    assert_eq!(part(&other, 2).unwrap().curves, part(&text, 2).unwrap().curves);
}

#[test]
fn pairs_of_columns() {
    let table = ok("Wavelength (nm),%R a,Wavelength (nm),%R b\n380,1,385,2\n390,3,395,4\n400,5,,\n");
    assert_eq!(names(&table), ["%R a", "%R b"]);
    assert_eq!(samples(&table.curves[0]), [(380.0, 0.01), (390.0, 0.03), (400.0, 0.05)]);
    assert_eq!(samples(&table.curves[1]), [(385.0, 0.02), (395.0, 0.04)]);
    assert_eq!((table.curves[1].missing, table.warnings.as_slice()), (0, &[Warning::CommasOnly][..]));
    let note = table.reading.notes.iter().find(|note| note.what == "Columns").unwrap();
    assert_eq!(note.to_string(), "Column 3 holds wavelengths too: read as 2 curves with wavelengths of their own.");
    let same = ok("380,0.1,380,0.2\n390,0.1,390,0.3\n");
    assert_eq!((names(&same), same.curves[1].values.as_slice()), (vec!["Column 2", "Column 4"], &[0.2, 0.3][..]));
    let options = ReadOptions { wavelength_column: Some(3), ..ReadOptions::default() };
    let right = with("380,0.1,385,0.2\n390,0.1,395,0.3\n", &options).unwrap();
    assert_eq!(
        (right.curves.len(), right.reading.range_nm, right.reading.wavelength_column),
        (1, [385.0, 395.0], Some(3))
    );
}

#[test]
fn a_wavelength_column_without_wavelengths() {
    let choose = |column| {
        let options = ReadOptions { wavelength_column: Some(column), ..ReadOptions::default() };
        with("380,,0.01\n390,,0.02\n", &options)
    };
    for column in [0, 2, 4, usize::MAX] {
        assert_eq!(choose(column), Err(ReadError::NotWavelengthColumn { column, columns: 3 }));
    }
    assert!(choose(1).is_ok());
    assert!(matches!(choose(3), Err(ReadError::AsChosen { switch, .. }) if switch == "wavelengths in column 3"));
}

#[test]
fn blocks_of_a_meter_and_of_jcamp() {
    let mut text = String::new();
    for step in [5, 1] {
        for i in 0..=21 / step {
            text += &format!("Data {}[nm],0.{}\n", 380 + step * i, step + i);
        }
    }
    let finest = ok(&text);
    assert_eq!((finest.reading.part.value, finest.reading.parts.len()), (2, 2));
    assert_eq!(part(&text, 1).unwrap().reading.step_nm.max, 5.0);
    assert_eq!(part(&text, 2).unwrap().curves, finest.curves);
    assert_eq!(part(&text, 3), Err(ReadError::NoSuchPart { part: 3, parts: 2 }));
    let block = |title: &str, value: u32| {
        format!(
            "##TITLE= {title}\n##DATA TYPE= UV\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##XYPOINTS= (XY..XY)\n400, 0.{value}\n410, 0.{value}\n##END=\n"
        )
    };
    let text = block("leaf", 1) + &block("dark", 2) + &block("bark", 3);
    let both = ok(&text);
    assert_eq!((names(&both), both.reading.part.value), (vec!["leaf", "bark"], 0));
    let listed: Vec<&str> = both.reading.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(listed, ["leaf", "dark", "bark"]);
    assert_eq!(names(&part(&text, 2).unwrap()), ["dark"]);
    assert_eq!(part(&text, 4), Err(ReadError::NoSuchPart { part: 4, parts: 3 }));
}

#[test]
fn tables_of_cgats_and_groups_of_json() {
    let table = |name: &str, value: u32| {
        format!(
            "CGATS.17\nDESCRIPTOR \"{name}\"\nSPECTRAL_NORM \"{value}\"\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_410\nEND_DATA_FORMAT\nBEGIN_DATA\n1 {value} {value}\n2 0 {value}\nEND_DATA\n"
        )
    };
    let text = table("one", 10) + &table("two", 20).replace(" \"20\"", " \"40\"");
    let first = ok(&text);
    assert_eq!((first.curves[0].values[0], first.reading.comment("title")), (1.0, Some("one")));
    assert_eq!(first.warnings, [Warning::MoreTables(18)]);
    let second = part(&text, 2).unwrap();
    assert_eq!((second.curves[0].values[0], second.reading.comment("title")), (0.5, Some("two")));
    assert_eq!((second.reading.parts.clone(), second.reading.parts[1].curves), (first.reading.parts, 2));
    assert_eq!(part(&text, 3), Err(ReadError::NoSuchPart { part: 3, parts: 2 }));
    let json = "{\"spectral_data\": {\"units\": \"relative\",\n\"index\": {\"z\": [\"power\"], \"main\": [\"power\"]},\n\"data\": {\n\"z\": {\"400\": [1], \"410\": [2]},\n\"main\": {\"400\": [3], \"410\": [4]}}}}";
    let main = ok(json);
    assert_eq!((main.curves[0].values[0], main.reading.part.value), (3.0, 2));
    assert_eq!(part(json, 1).unwrap().curves[0].values[0], 1.0);
    assert_eq!(part(json, 3), Err(ReadError::NoSuchPart { part: 3, parts: 2 }));
}

#[test]
fn the_reader_of_another_layout() {
    for reader in Reader::ALL.into_iter().filter(|reader| *reader != Reader::TABLE) {
        let options = ReadOptions { reader: Some(reader), ..ReadOptions::default() };
        assert_eq!(with("nm,a\n400,1\n500,2\n", &options), Err(ReadError::OtherLayout(reader)));
    }
    let options = ReadOptions { reader: Some(Reader::RAWTOACES), ..ReadOptions::default() };
    let other = with("{\"bands\": [400, 420, 10], \"spectrum\": [1, 2, 3]}", &options);
    assert_eq!(other, Err(ReadError::OtherLayout(Reader::RAWTOACES)));
}

#[test]
fn every_reader_stops_when_told() {
    let rows = 60_000;
    let numbers = |line: &dyn Fn(u32) -> String| (0..rows).map(line).collect::<Vec<_>>().concat();
    let table = numbers(&|i| format!("{}.{:04},0.{i}\n", 400 + i / 10_000, i % 10_000));
    let labels = numbers(&|i| format!("Data {}.{:04}[nm],0.{i}\n", 400 + i / 10_000, i % 10_000));
    let jcamp = format!("##TITLE= a\n##XYPOINTS= (XY..XY)\n{table}");
    let cgats = format!(
        "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID R_400 R_410\nEND_DATA_FORMAT\nBEGIN_DATA\n{}END_DATA\n",
        numbers(&|i| format!("{i} 0.{i} 0.{i}\n"))
    );
    let list = |text: &str| text.lines().map(|line| line.split_once(',').unwrap().0).collect::<Vec<_>>().join(", ");
    let json = format!("{{\"bands\": [{}], \"spectrum\": [{}]}}", list(&table), list(&table));
    for text in [table, labels, jcamp, cgats, json] {
        let looks = Cell::new(0_usize);
        let count = |_| {
            looks.set(looks.get() + 1);
            true
        };
        let whole = read_watched(text.as_bytes(), &ReadOptions::default(), Watch::new(&count)).unwrap();
        let all = looks.get();
        assert!(all >= 3 && !whole.curves.is_empty(), "{all} looks");
        for stop in 0..all {
            looks.set(0);
            let go_on = |_| {
                looks.set(looks.get() + 1);
                looks.get() <= stop
            };
            let stopped = read_watched(text.as_bytes(), &ReadOptions::default(), Watch::new(&go_on));
            assert!(matches!(stopped, Err(ReadError::Stopped)));
        }
    }
}

proptest! {
    #[test]
    fn part_k_of_n_is_the_kth_table_alone(counts in prop::collection::vec(5_u32..12, 1..6), titled in any::<bool>()) {
        let one = |at: usize, count: u32| {
            let head = if titled { format!("nm,curve {at}\n") } else { String::new() };
            let rows = (0..count).map(|i| format!("{},{}.5\n", 400 + 10 * i, at * 100 + i as usize));
            head + &rows.collect::<Vec<_>>().concat()
        };
        let text: String = counts.iter().enumerate().map(|(at, count)| one(at, *count)).collect();
        for (at, count) in counts.iter().enumerate() {
            let alone = ok(&one(at, *count));
            let taken = part(&text, at + 1).unwrap();
            prop_assert_eq!(&taken.curves, &alone.curves);
            prop_assert_eq!(taken.reading.parts.len(), counts.len());
        }
        let missing = ReadError::NoSuchPart { part: counts.len() + 1, parts: counts.len() };
        prop_assert_eq!(part(&text, counts.len() + 1), Err(missing));
    }
}
