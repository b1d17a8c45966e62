//! Damaged files, and large ones.

#![allow(clippy::format_push_string, clippy::format_collect, reason = "files are written as they read")]

use proptest::prelude::*;
use spectral_file::{Preview, ReadOptions, Watch, What, read, read_marked};

use super::{LEAF, Seen, families, sound};

fn look(bytes: &[u8]) {
    let Ok(preview) = Preview::new(bytes) else {
        assert!(read(bytes, &ReadOptions::default()).is_err());
        return;
    };
    match read_marked(bytes, &ReadOptions::default(), Watch::none()) {
        Err(error) => {
            assert_eq!(read(bytes, &ReadOptions::default()), Err(error.clone()));
            if let Some((number, range)) = preview.error_range(&error) {
                assert!(preview.line(number).unwrap().get(range).is_some());
            }
        }
        Ok((table, marker)) => {
            assert_eq!(read(bytes, &ReadOptions::default()).as_ref(), Ok(&table), "recording changes nothing");
            for number in 1..=preview.line_count() {
                let marks = preview.marks(number, &table, &marker);
                sound(preview.line(number).unwrap(), &marks);
                for mark in &marks {
                    assert!(!mark.what.describe(&table).is_empty());
                    let shown = preview.shown(number, 3, 20).unwrap();
                    assert!(shown.map(&mark.range).is_none_or(|range| shown.text.get(range).is_some()));
                }
                let part = preview.marks_within(number, 4..9, &table, &marker);
                assert!(part.len() <= marks.len().max(1));
            }
        }
    }
}

fn samples() -> Vec<String> {
    let mut all = vec![
        LEAF.to_owned(),
        "ID;Name;400;410;420;430;440\n1;a;5;6;;8;9\n2;b;1;2;3;4;5\n".to_owned(),
        "Pixel;Wavelength (nm);Dark counts;Reflectance (%)\n0;400;100;40\n1;410;101;41\n2;420;102;42\n".to_owned(),
    ];
    all.extend(families::ALL.iter().map(|text| (*text).to_owned()));
    all
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn damage_is_survived(which in 0_usize..64, edits in prop::collection::vec((any::<u16>(), any::<u8>(), 0_u8..4), 1..6)) {
        let all = samples();
        let mut bytes = all[which % all.len()].clone().into_bytes();
        for (at, byte, kind) in edits {
            let at = usize::from(at) % bytes.len().max(1);
            match kind {
                0 if at < bytes.len() => bytes[at] = byte,
                1 => bytes.insert(at.min(bytes.len()), byte),
                2 => bytes.truncate(at.max(1)),
                _ if at < bytes.len() => {
                    bytes.remove(at);
                }
                _ => {}
            }
        }
        look(&bytes);
    }
}

#[test]
fn a_window_of_a_long_line_holds_the_marks_of_the_line_that_touch_it() {
    let header: String = (0..2000).map(|i| format!(";{}", 400 + i)).collect();
    let row: String = (0..2000).map(|i| format!(";0.{i:04}")).collect();
    let seen = Seen::new(format!("Name{header}\na{row}\nb{row}\n").as_bytes());
    for number in 1..=3 {
        let window = 5000..5200;
        let part = seen.preview.marks_within(number, window.clone(), &seen.table, &seen.marker);
        let all = seen.marks(number);
        let inside: Vec<_> =
            all.into_iter().filter(|mark| mark.range.start < window.end && mark.range.end >= window.start).collect();
        assert_eq!(part, inside);
        assert!((20..60).contains(&part.len()));
    }
}

#[test]
fn any_screen_of_a_large_file_is_marked() {
    let mut text = "nm".to_owned();
    (0..40).for_each(|i| text += &format!(",Curve {i}"));
    for row in 0..5000 {
        text += &format!("\n{:.3}", 300.0 + f64::from(row) / 100.0);
        (0..40).for_each(|i| text += &format!(",0.{:05}", (row * 7 + i * 13) % 99_991));
    }
    let seen = Seen::new(text.as_bytes());
    let marks: usize = (4000..4060).map(|number| seen.marks(number).len()).sum();
    assert_eq!(marks, 60 * 41);
}

#[test]
fn a_table_that_no_reader_made_is_survived() {
    for text in samples() {
        let seen = Seen::new(text.as_bytes());
        let mut table = seen.table.clone();
        table.reading.header_line = Some(usize::MAX);
        table.reading.wavelength_column = Some(usize::MAX);
        for first in [0, usize::MAX] {
            table.reading.first_data_line = first;
            table.curves[0].values.pop();
            table.curves[0].wavelengths_nm.remove(0);
            table.curves[0].wavelengths_nm.push(f64::NAN);
            for number in 0..=seen.preview.line_count() {
                seen.preview.marks(number, &table, &seen.marker);
            }
        }
        table.curves.clear();
        (1..=seen.preview.line_count()).for_each(|number| drop(seen.preview.marks(number, &table, &seen.marker)));
    }
}

#[test]
fn what_was_moved_or_left_out_is_never_marked_as_something_else() {
    let head = "##TITLE=t\n##XUNITS=NANOMETERS\n##YUNITS=REFLECTANCE\n##FIRSTX=400\n##LASTX=450\n##NPOINTS=6\n##XYDATA=(X++(Y..Y))\n";
    let blocks = "id,400,410,420,430,440,,400,410,420,430,440\na,.1,.2,.3,.4,.5,,.2,.3,.4,.5,.6\n";
    for (text, values) in [
        (format!("{head}400 .1 .2\n440 .5 .6\n420 .3 .4\n"), 6),
        (format!("{head}400 .1 .2\n440 .5 .6\n"), 4),
        ("id,400,410,420,430,440,450\na,.1,.2,.3,.4,.5,.6\n".replace("420", "4x0"), 5),
        (blocks.to_owned(), 5),
        ("nm;1/cm;A\n400;25000;.1\n500;20000;.2\n625;16000;.3\n".to_owned(), 3),
        ("id,Mode,400,410,420,430,440\na,Reflectance,.1,.2,.3,.4,.5\nb,Transmittance,.2,.3,.4,.5,.6\n".to_owned(), 5),
    ] {
        let (table, marker) = read_marked(text.as_bytes(), &ReadOptions::default(), Watch::none()).unwrap();
        let preview = Preview::new(text.as_bytes()).unwrap();
        let all = (1..=preview.line_count()).flat_map(|line| {
            let marks = preview.marks(line, &table, &marker);
            marks.into_iter().map(move |mark| (line, mark.what)).collect::<Vec<_>>()
        });
        let mut count = 0;
        for (line, what) in all {
            let What::Value { curve, nm, value, written } = what else { continue };
            let curve = &table.curves[curve];
            let at = curve.wavelengths_nm.iter().position(|other| *other == nm).unwrap();
            assert_eq!((curve.values[at], written), (value, value), "line {line} of {text}");
            count += 1;
        }
        assert_eq!(count, values, "{text}");
    }
}
