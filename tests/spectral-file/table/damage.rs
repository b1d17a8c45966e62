//! Tables that are damaged or made at random: nothing panics, and what is written is read again.

use proptest::prelude::*;

use super::*;

/// Invariants of every result.
pub(super) fn check(bytes: &[u8], options: &ReadOptions) {
    let Ok(table) = read(bytes, options) else { return };
    assert!(!table.curves.is_empty());
    for curve in &table.curves {
        assert!(curve.wavelengths_nm.len() >= 2 && curve.wavelengths_nm.len() == curve.values.len());
        assert!(curve.wavelengths_nm.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(curve.wavelengths_nm.iter().all(|w| (100.0..=25_000.0).contains(w)));
        assert!(curve.values.iter().all(|value| value.is_finite()));
    }
    let reading = &table.reading;
    assert!(reading.first_data_line > 0 && reading.rows > 0);
    assert!(reading.step_nm.min > 0.0 && reading.step_nm.max >= reading.step_nm.median);
    assert!(reading.camera_columns.is_none_or(|columns| columns.iter().all(|&i| i < table.curves.len())));
    assert!(table.decisions().iter().all(|decision| !decision.to_string().is_empty()));
    assert_eq!(read(bytes, options).as_ref(), Ok(&table));
}

fn options() -> impl Strategy<Value = ReadOptions> {
    use {DecimalMark as Mark, Delimiter as By, WavelengthUnit as Unit};
    let delimiters = vec![By::Comma, By::CommaSpace, By::Semicolon, By::Tab, By::Spaces];
    (
        prop::option::weighted(0.2, prop::sample::select(delimiters)),
        prop::option::weighted(0.2, prop::sample::select(vec![Mark::Point, Mark::Comma])),
        prop::option::weighted(0.2, prop::sample::select(vec![Orientation::Down, Orientation::Across])),
        prop::option::weighted(
            0.2,
            prop::sample::select(vec![
                Unit::Nanometer,
                Unit::Micrometer,
                Unit::Angstrom,
                Unit::Wavenumber,
                Unit::Terahertz,
            ]),
        ),
        prop::option::weighted(
            0.2,
            prop::sample::select(vec![Values::Plain, Values::Percent, Values::Absorbance, Values::Decibels]),
        ),
        prop::option::weighted(0.2, prop::sample::select(vec![Role::Camera, Role::Reflectance, Role::Unknown])),
    )
        .prop_map(|(delimiter, decimal_mark, orientation, wavelength_unit, values, role)| ReadOptions {
            delimiter,
            decimal_mark,
            orientation,
            wavelength_unit,
            values,
            role,
            ..ReadOptions::default()
        })
}

/// Sound files to damage.
pub(super) const SOUND: [&str; 7] = [
    "# title: a\n# unit: percent\nwavelength_nm,R,G,B\n380,0.1,0.2,0.3\n390,0.2,0.3,0.4\n400,,0.4,0.5\n",
    "Wave ;Sample;Reflectance\r\n[nm] ;[counts];[%]\r\n\r\n 300,00; -6,893;52,5\r\n 301,00; -7,474; 0,0\r\n",
    "\" File: x\n\" T->  Wave:7.2nm\n 339.00  1.0000E-003\n 339.50  1.0000E-003\n 340.00  NaN\n",
    "wavelength\t380\t385\t390\t395\t400\n1\t0.1\t0.2\t0.3\t0.4\t0.5\n2\t0.2\t0.3\t\t0.5\t0.6\n",
    "X Units: Wavelength (micrometers)\nY Units: Reflectance (percent)\n\n0.40\t5\t\n0.39\t6\t\n0.38\t7\t\n",
    "Pixel,Wavelength,P\n0,380.5,1\n1,381.5,2\n>>>End\n",
    "a,\"b, c\",400,410,420,430,440\nx,\"y \"\"z\",1,2,3,4,5\nx,y,1,2,3,4,5\n",
];

fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        prop::collection::vec(any::<u8>(), 0..4),
        prop::sample::select(vec![
            ",", ";", "\t", "\"", "\n", "\r", "#", "nm", "%", "-9999", "1e999", "\0", "0.1", "38"
        ])
        .prop_map(|piece| piece.as_bytes().to_vec()),
    ];
    let edits = prop::collection::vec((any::<prop::sample::Index>(), 0..12_usize, piece), 1..6);
    (prop::sample::select(SOUND.to_vec()), edits, any::<prop::sample::Index>(), any::<bool>()).prop_map(
        |(text, edits, end, cut)| {
            let mut bytes = text.as_bytes().to_vec();
            for (at, length, piece) in edits {
                let at = at.index(bytes.len() + 1);
                let until = (at + length).min(bytes.len());
                bytes.splice(at..until, piece);
            }
            if cut {
                bytes.truncate(end.index(bytes.len() + 1));
            }
            bytes
        },
    )
}

/// Notation of a table of numbers.
#[derive(Debug, Clone)]
struct Style {
    separator: &'static str,
    comma: bool,
    unit: (&'static str, f64),
    descending: bool,
    header: bool,
    line_end: &'static str,
}

fn style() -> impl Strategy<Value = Style> {
    let separators =
        vec![(",", false), (";", false), (";", true), ("\t", false), ("\t", true), ("  ", false), ("  ", true)];
    let units = vec![("nm", 1.0), ("um", 1000.0), ("angstrom", 0.1)];
    let ends = vec!["\n", "\r\n", "\r"];
    (
        prop::sample::select(separators),
        prop::sample::select(units),
        any::<bool>(),
        any::<bool>(),
        prop::sample::select(ends),
    )
        .prop_map(|((separator, comma), unit, descending, header, line_end)| Style {
            separator,
            comma,
            unit,
            descending,
            header,
            line_end,
        })
}

impl Style {
    /// A number of hundredths as text, exactly, in the unit of wavelengths.
    fn wavelength(&self, hundredths: u32) -> String {
        match self.unit.0 {
            "um" => format!("{}.{:05}", hundredths / 100_000, hundredths % 100_000),
            "angstrom" => format!("{}.{}", hundredths / 10, hundredths % 10),
            _ => format!("{}.{:02}", hundredths / 100, hundredths % 100),
        }
    }

    fn write(&self, rows: &[(u32, Vec<f64>)]) -> String {
        let mut lines = Vec::new();
        if self.header {
            let names = (1..=rows[0].1.len()).map(|i| format!("c{i}"));
            lines.push(std::iter::once(format!("wavelength_{}", self.unit.0)).chain(names).collect::<Vec<_>>());
        }
        let mut body: Vec<Vec<String>> = rows
            .iter()
            .map(|(w, values)| {
                std::iter::once(self.wavelength(*w)).chain(values.iter().map(|v| format!("{v:?}"))).collect()
            })
            .collect();
        if self.descending {
            body.reverse();
        }
        lines.extend(body);
        let mark = |cell: &String| if self.comma { cell.replace('.', ",") } else { cell.clone() };
        let joined = lines.iter().map(|cells| cells.iter().map(mark).collect::<Vec<_>>().join(self.separator));
        joined.collect::<Vec<_>>().join(self.line_end)
    }

    fn options(&self) -> ReadOptions {
        let unit = match self.unit.0 {
            "um" => WavelengthUnit::Micrometer,
            "angstrom" => WavelengthUnit::Angstrom,
            _ => WavelengthUnit::Nanometer,
        };
        ReadOptions {
            wavelength_unit: (!self.header).then_some(unit),
            role: Some(Role::Illuminant),
            ..ReadOptions::default()
        }
    }
}

/// Two to 300 rows of one to six curves, wavelengths in hundredths of a nanometer.
fn rows() -> impl Strategy<Value = Vec<(u32, Vec<f64>)>> {
    let value = prop_oneof![
        -1000.0..1000.0_f64,
        (0..100_000_u32).prop_map(|v| f64::from(v) / 1000.0),
        (-1e-6..1e-6_f64),
        Just(1e300),
    ];
    (1..=6_usize)
        .prop_flat_map(move |curves| {
            prop::collection::btree_map(20_000_u32..200_000, prop::collection::vec(value.clone(), curves), 2..300)
        })
        .prop_map(|rows| rows.into_iter().collect())
        // Curves that repeat their wavelengths are refused, rightly.
        .prop_filter("a curve equals the wavelengths", |rows: &Vec<(u32, Vec<f64>)>| {
            rows.iter().any(|(w, values)| values.iter().all(|value| *value != f64::from(*w) / 100.0))
        })
}

proptest! {
    #[test]
    fn random_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..400), options in options()) {
        check(&bytes, &options);
    }

    #[test]
    fn random_tables_of_characters_are_survived(text in "[0-9.,; \t\n\r\"#%NnaAµm:e+-]{0,300}", options in options()) {
        check(text.as_bytes(), &options);
    }

    #[test]
    fn damaged_files_are_survived(bytes in damaged(), options in options()) {
        check(&bytes, &options);
    }

    #[test]
    fn tables_round_trip_exactly(rows in rows(), style in style()) {
        let text = style.write(&rows);
        let table = read(text.as_bytes(), &style.options());
        let table = table.map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(table.curves.len(), rows[0].1.len());
        prop_assert_eq!(table.reading.descending, style.descending);
        for (index, curve) in table.curves.iter().enumerate() {
            let expected: Vec<(f64, f64)> = rows.iter().map(|(w, values)| (f64::from(*w) / 100.0, values[index])).collect();
            prop_assert_eq!(samples(curve), expected);
        }
    }

    #[test]
    fn tables_across_round_trip_exactly(rows in rows().prop_filter("a header needs five", |rows| rows.len() >= 5)) {
        let header = rows.iter().map(|(w, _)| format!("{}", f64::from(*w) / 100.0)).collect::<Vec<_>>().join(",");
        let mut text = format!("name,{header}\n");
        for index in 0..rows[0].1.len() {
            text += &format!("curve {index}");
            for (_, values) in &rows {
                text += &format!(",{:?}", values[index]);
            }
            text += "\n";
        }
        let options = ReadOptions {
            role: Some(Role::Illuminant),
            wavelength_unit: Some(WavelengthUnit::Nanometer),
            ..ReadOptions::default()
        };
        let table = read(text.as_bytes(), &options).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        for (index, curve) in table.curves.iter().enumerate() {
            let expected: Vec<(f64, f64)> = rows.iter().map(|(w, values)| (f64::from(*w) / 100.0, values[index])).collect();
            prop_assert_eq!(samples(curve), expected);
            prop_assert_eq!(&curve.name, &format!("curve {index}"));
        }
    }
}

#[test]
fn a_first_row_wider_than_the_table_is_no_crash() {
    // Found by fuzzing.
    let found = error("nm;[\n6,,,,]\n\r5\n50,,,\n55,,,0");
    assert_eq!(found, ReadError::NotANumber { line: 2, column: 5, text: "]".to_owned() });
}
