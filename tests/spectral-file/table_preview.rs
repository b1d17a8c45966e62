//! Marks of the preview of a file: every value of every curve once, nothing else, in files built byte for byte.

mod damage;
mod families;
mod lines;

use std::collections::BTreeMap;

use spectral_file::{Mark, Marker, Preview, ReadOptions, Role, SpectralFile, Watch, What, read_marked};

/// A file, what it was read as, and its marks.
struct Seen {
    table: SpectralFile,
    preview: Preview,
    marker: Marker,
}

impl Seen {
    fn new(bytes: &[u8]) -> Self {
        Self::with(bytes, &ReadOptions::default())
    }

    fn with(bytes: &[u8], options: &ReadOptions) -> Self {
        let (table, marker) = read_marked(bytes, options, Watch::none()).unwrap_or_else(|error| panic!("{error}"));
        let preview = Preview::new(bytes).unwrap();
        Self { table, preview, marker }
    }

    /// The marks of a line, checked for order and borders.
    fn marks(&self, number: usize) -> Vec<Mark> {
        let marks = self.preview.marks(number, &self.table, &self.marker);
        sound(self.preview.line(number).unwrap(), &marks);
        marks
    }

    /// The marked pieces of a line and what they are.
    fn pieces(&self, number: usize) -> Vec<(&str, What)> {
        let line = self.preview.line(number).unwrap();
        self.marks(number).into_iter().map(|mark| (&line[mark.range], mark.what)).collect()
    }

    /// Descriptions of the pieces of a line.
    fn said(&self, number: usize) -> Vec<String> {
        let say = |(piece, what): (&str, What)| format!("{piece} = {}", what.describe(&self.table));
        self.pieces(number).into_iter().map(say).collect()
    }
}

#[track_caller]
fn sound(line: &str, marks: &[Mark]) {
    for mark in marks {
        assert!(line.get(mark.range.clone()).is_some(), "{mark:?} in {line:?}");
    }
    for pair in marks.windows(2) {
        assert!(pair[0].range.end <= pair[1].range.start, "{pair:?} in {line:?}");
    }
}

/// Every value of every curve is marked once and is that of the table; no other number is marked as one.
#[track_caller]
fn whole(bytes: &[u8]) -> Seen {
    whole_with(bytes, &ReadOptions::default())
}

#[track_caller]
fn whole_with(bytes: &[u8], options: &ReadOptions) -> Seen {
    let seen = Seen::with(bytes, options);
    let mut found: BTreeMap<(usize, u64), f64> = BTreeMap::new();
    for number in 1..=seen.preview.line_count() {
        for mark in seen.marks(number) {
            if let What::Value { curve, nm, value, .. } = mark.what {
                let twice = found.insert((curve, nm.to_bits()), value);
                assert_eq!(twice, None, "line {number}: {nm} nm of curve {curve} again");
            }
        }
    }
    let mut all = BTreeMap::new();
    for (index, curve) in seen.table.curves.iter().enumerate() {
        all.extend(curve.wavelengths_nm.iter().zip(&curve.values).map(|(nm, value)| ((index, nm.to_bits()), *value)));
    }
    assert_eq!(found, all);
    seen
}

const LEAF: &str = "Wavelength (nm);Leaf (%);Bark (%)\n400;5,5;1,5\n410;6,0;1,25\n420;7,0;2,5\n";

#[test]
fn a_table_down_is_marked_cell_by_cell() {
    let seen = whole_with(LEAF.as_bytes(), &ReadOptions { role: Some(Role::Reflectance), ..ReadOptions::default() });
    assert_eq!(
        seen.said(1),
        [
            "Wavelength (nm) = unit of the wavelengths: nanometers",
            "Leaf (%) = name of curve 1",
            "Bark (%) = name of curve 2"
        ]
    );
    assert_eq!(
        seen.said(3),
        [
            "410 = 410 nm",
            "6,0 = Leaf: 0.06 at 410 nm (written 6, percent)",
            "1,25 = Bark: 0.0125 at 410 nm (written 1.25, percent)"
        ]
    );
    assert_eq!(seen.pieces(2)[1].1, What::Value { curve: 0, nm: 400.0, value: 0.055, written: 5.5 });
}

#[test]
fn every_separator_and_line_end() {
    for text in [
        "380,0.05\n385.5,0.25\n390,0.5\n",
        "380;0,05\r\n385,5;0,25\r\n390;0,5\r\n",
        "380\t0.05\r385.5\t0.25\r390\t0.5\r",
        "  380 0.05\n  385.5   0.25\n  390 \t 0.5 ",
        "380,0, 0,05\n385,5, 0,25\n390,0, 0,5\n",
        "\"380\",\"0,05\"\r\n\"385,5\",\"0,25\"\n\"390\",\"0,5\"\n",
        "380nm;5\n390nm;6\n400nm;7\n",
        "nm,A,B\n400,1,2\n390,3,4\n380,5,6\n",
        "nm,A,B\n400,0.1,0.2\n380,0.3,0.4\n420,0.5,0.6\n390,0.7,0.8\n",
        "um,R\n0.40,0.1\n0.41,0.2\n0.42,0.3\n",
        "\u{feff}nm;Blätter\n400;1\n410;2\n420;3\n",
    ] {
        whole(text.as_bytes());
    }
}

#[test]
fn encodings_do_not_move_the_marks() {
    let text = "# Gerät: Größe\r\nWellenlänge\tÄpfel\r\n400\t0,5\r\n410\t0,6\r\n420\t0,7\r\n";
    let utf16: Vec<u8> = [0xFF, 0xFE].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    for bytes in [text.as_bytes(), &utf16, &latin] {
        let seen = whole(bytes);
        assert_eq!(seen.pieces(1), [("# Gerät: Größe", What::Setting)]);
        assert_eq!(seen.pieces(2).last(), Some(&("Äpfel", What::Name(0))));
        assert_eq!(seen.pieces(3)[1].0, "0,5");
    }
}

#[test]
fn settings_are_kept_whole_and_their_numbers_are_not_marked() {
    let text = "# Date: 2024-05-400\n# Integration: 410\nFirmware 0.1\n\nnm,Lamp\n400,0.1\n410,410\n420,0.3\n";
    let seen = whole(text.as_bytes());
    assert_eq!(seen.pieces(1), [("# Date: 2024-05-400", What::Setting)]);
    assert_eq!(seen.pieces(2), [("# Integration: 410", What::Setting)]);
    assert_eq!(seen.pieces(3), []);
    assert_eq!(seen.pieces(4), []);
}

#[test]
fn gaps_and_dropped_rows() {
    let text = "nm,A,B\n400,0.1,0.2\n410,,0.3\n,0.5,0.6\n420,0.4,NaN\n400,0.1,0.2\n430,0.7,0.8\nEnd of data\n";
    let seen = whole(text.as_bytes());
    assert_eq!(seen.pieces(3)[1], ("", What::Gap(0)));
    assert_eq!(seen.said(4), [",0.5,0.6 = left out: no wavelength"]);
    assert_eq!(seen.pieces(5)[2], ("NaN", What::Gap(1)));
    assert_eq!(seen.said(6), ["400,0.1,0.2 = left out: the same as an earlier row"]);
    assert_eq!(seen.said(8), ["End of data = left out: no row of this table"]);
    assert_eq!(seen.said(5)[2], "NaN = B: no value here");
}

#[test]
fn more_repeated_rows_than_a_reading_lists() {
    let mut text = "nm,A\n".to_owned();
    for nm in 0..1500 {
        let row = format!("{},{}\n", 400 + nm, f64::from(nm) / 2000.0);
        text += &row;
        text += &row;
    }
    whole(text.as_bytes());
}

#[test]
fn columns_that_are_in_no_curve() {
    let text = "Pixel;Wavelength (nm);Dark counts;Empty;Reflectance (%)\n\
                0;400;100;;40\n1;410;101;;41\n2;420;102;;42\n3;430;103;;43\n";
    let seen = whole(text.as_bytes());
    assert_eq!(seen.table.curves.len(), 1);
    let left = |piece: &str| format!("{piece} = left out: a column that is in no curve");
    assert_eq!(
        seen.said(3),
        [
            left("1"),
            "410 = 410 nm".into(),
            left("101"),
            "41 = Reflectance: 0.41 at 410 nm (written 41, percent)".into()
        ]
    );
    assert_eq!(seen.pieces(1).len(), 5);
    assert_eq!(seen.pieces(1)[4].1, What::Name(0));
}

#[test]
fn units_below_the_names() {
    let seen = whole(b"Wavelength\tSample\n[nm]\t[%]\n400\t50\n410\t51\n420\t52\n430\t60\n");
    assert_eq!(seen.pieces(2), [("[nm]", What::Unit(None)), ("[%]", What::Unit(Some(0)))]);
}

#[test]
fn names_without_one_for_the_wavelengths() {
    let seen = whole(b"A;B\n400;0.1;0.2\n410;0.3;0.4\n420;0.5;0.6\n");
    assert_eq!(seen.pieces(1), [("A", What::Name(0)), ("B", What::Name(1))]);
}

#[test]
fn a_table_across_is_marked_cell_by_cell() {
    let text =
        "ID;Name;400;410;420;430;440\n1;\"a \"\"b\"\"\";5;6;;8;9\n2;empty;;;3;;\n3;c;15;16;17;18;19\nText below\n";
    let seen = whole(text.as_bytes());
    assert_eq!(seen.table.curves.len(), 2);
    assert_eq!(seen.pieces(1)[0], ("400", What::Wavelength(400.0)));
    let row = seen.pieces(2);
    assert_eq!(row[1], ("a \"\"b\"\"", What::Name(0)));
    assert_eq!(row[4], ("", What::Gap(0)));
    assert_eq!(seen.said(3), ["2;empty;;;3;; = left out: no row of this table"]);
    assert_eq!(seen.pieces(4)[1].1, What::Name(1));
    assert_eq!(seen.said(5), ["Text below = left out: no row of this table"]);
}

#[test]
fn across_and_descending_with_units_in_the_cells() {
    whole(b"Name,440nm,430nm,420nm,410nm,400nm\na,0.1,0.2,0.3,0.4,0.5\nb,0.2,0.3,0.4,0.5,0.6\n");
}

#[test]
fn a_choice_moves_the_marks() {
    let options = ReadOptions { wavelength_column: Some(2), ..ReadOptions::default() };
    let seen = whole_with(b"1,400,0.1\n2,410,0.2\n3,420,0.3\n", &options);
    assert_eq!(seen.pieces(1)[1], ("400", What::Wavelength(400.0)));
    let options = ReadOptions { values: Some(spectral_file::Values::Absorbance), ..ReadOptions::default() };
    let seen = whole_with(b"400,1\n410,2\n420,0.3\n", &options);
    assert_eq!(seen.said(1)[1], "1 = Column 2: 0.1 at 400 nm (written 1, absorbance)");
}

#[test]
fn a_marker_of_another_table_marks_no_wrong_number() {
    let (leaf, other) = (Seen::new(LEAF.as_bytes()), Seen::new(b"nm,A\n400,0.1\n410,0.2\n"));
    for number in 0..=leaf.preview.line_count() + 1 {
        let marks = leaf.preview.marks(number, &other.table, &leaf.marker);
        assert!(!marks.iter().any(|mark| matches!(mark.what, What::Value { .. })), "{marks:?}");
        leaf.preview.marks(number, &leaf.table, &other.marker);
    }
}
