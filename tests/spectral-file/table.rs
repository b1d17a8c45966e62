//! Tables from text: every layout and trap in files built byte for byte, every error, hostile input, round trips.

#![allow(clippy::format_push_string, reason = "files are written as they read")]

mod bands;
mod columns;
mod damage;
mod doubts;
mod evidence;
mod judged;
mod judged_columns;
mod judged_eighth;
mod judged_eleventh;
mod judged_fourth;
mod judged_more;
mod judged_ninth;
mod judged_seventh;
mod judged_sixth;
mod judged_tenth;
mod judged_third;
mod light_units;
mod limits;
mod parts;
mod rows;
mod said;
mod shapes;
mod uncertainties;

use spectral_file::{
    BinaryKind, Certainty, Curve, DecimalMark, Delimiter, Dropped, Encoding, Family, MAX_BYTES, Orientation, ReadError,
    ReadOptions, Role, Source, SpectralFile, Values, Warning, WavelengthUnit, read,
};

fn ok(text: &str) -> SpectralFile {
    ok_bytes(text.as_bytes())
}

fn ok_bytes(bytes: &[u8]) -> SpectralFile {
    read(bytes, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn error(text: &str) -> ReadError {
    match read(text.as_bytes(), &ReadOptions::default()) {
        Err(error) => error,
        Ok(table) => panic!("read as {table:?}"),
    }
}

/// Rows of a wavelength and a value.
pub(crate) fn rows(separator: &str) -> String {
    (40..60).map(|nm| format!("{nm}0{separator}0.{nm}\n")).collect::<Vec<_>>().concat()
}

fn samples(curve: &Curve) -> Vec<(f64, f64)> {
    curve.wavelengths_nm.iter().copied().zip(curve.values.iter().copied()).collect()
}

/// Forty rows, of wavelengths from 400 on.
fn lines(of: impl Fn(usize) -> String) -> String {
    (400..440).map(of).collect::<Vec<_>>().concat()
}

fn of_file(path: &str, text: &str) -> SpectralFile {
    read(Source { path, ..Source::from(text) }, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn names(table: &SpectralFile) -> Vec<&str> {
    table.curves.iter().map(|curve| curve.name.as_str()).collect()
}

/// The three samples that the layouts below write in different ways.
const THREE: [(f64, f64); 3] = [(380.0, 0.05), (385.5, 0.25), (390.0, 0.5)];

#[track_caller]
fn reads_three(text: &str, delimiter: Delimiter, mark: DecimalMark) {
    let table = ok(text);
    assert_eq!(samples(&table.curves[0]), THREE, "{text:?}");
    assert_eq!(table.reading.delimiter.value, delimiter, "{text:?}");
    assert_eq!(table.reading.decimal_mark.value, mark, "{text:?}");
}

#[test]
fn every_separator_with_every_decimal_mark() {
    use {DecimalMark as Mark, Delimiter as By};
    reads_three("380,0.05\n385.5,0.25\n390,0.5\n", By::Comma, Mark::Point);
    reads_three("380;0.05\n385.5;0.25\n390;0.5\n", By::Semicolon, Mark::Point);
    reads_three("380,0;0,05\n385,5;0,25\n390,0;0,5\n", By::Semicolon, Mark::Comma);
    reads_three("380\t0.05\n385.5\t0.25\n390\t0.5\n", By::Tab, Mark::Point);
    reads_three("380\t0,05\n385,5\t0,25\n390\t0,5\n", By::Tab, Mark::Comma);
    reads_three("  380 0.05\n  385.5   0.25\n  390 \t 0.5 \n", By::Spaces, Mark::Point);
    reads_three("380 0,05\n385,5  0,25\n390 0,5\n", By::Spaces, Mark::Comma);
    reads_three("380,0, 0,05\n385,5, 0,25\n390,0, 0,5\n", By::CommaSpace, Mark::Comma);
    reads_three("\"380\",\"0,05\"\n\"385,5\",\"0,25\"\n\"390\",\"0,5\"\n", By::Comma, Mark::Comma);
    reads_three("380, 0.05\n385.5, 0.25\n390, 0.5\n", By::Comma, Mark::Point);
    reads_three("380 ; 0.05 \n385.5; 0.25 \n390 ;  0.5 \n", By::Semicolon, Mark::Point);
}

#[test]
fn a_decimal_comma_that_comes_late_still_counts() {
    let mut text = String::from("nm;a\n");
    for i in 0..300 {
        text += &format!("{};0\n", 380 + i);
    }
    text += "680,5;0,25\n";
    let table = ok(&text);
    assert_eq!(samples(&table.curves[0]).last(), Some(&(680.5, 0.25)));
    assert_eq!(table.reading.decimal_mark.value, DecimalMark::Comma);
    assert_eq!(table.reading.decimal_mark.certainty, Certainty::Certain);
}

#[test]
fn forms_of_numbers() {
    let table = ok("400\t1,3742E02\n401\t-1.5\n".replace('.', ",").as_str());
    assert_eq!(table.curves[0].values, [137.42, -1.5]);
    let table = ok("339.00  1.0000E-003\n340.00  -7.7101E+001\n341.00 .5\n342.00 +5.\n343 \u{2212}2\n");
    assert_eq!(table.curves[0].values, [0.001, -77.101, 0.5, 5.0, -2.0]);
    let table = ok("1.8792E2\t18.995E0\n1.8839E2\t33.852E0\n");
    assert_eq!(table.curves[0].wavelengths_nm, [187.92, 188.39]);
    let long = ok("400,0.123456789012345678\n401,12345678901234567890\n");
    assert_eq!(long.curves[0].values, [0.123_456_789_012_345_68, 12_345_678_901_234_567_890.0]);
}

#[test]
fn headers_name_curves() {
    let table = ok("wavelength_nm,dark skin,\"sky, blue\",\"a \"\"b\"\"\"\n380,0.1,0.2,0.3\n390,0.2,0.3,0.4\n");
    assert_eq!(names(&table), ["dark skin", "sky, blue", "a \"b\""]);
    assert_eq!(table.reading.header_line, Some(1));
    assert_eq!((table.reading.first_data_line, table.reading.rows), (2, 2));
    assert!(table.curves.iter().all(|curve| curve.named));
    let bare = ok("380,0.1\n390,0.2\n");
    assert_eq!((names(&bare), bare.curves[0].named, bare.reading.header_line), (vec!["Column 2"], false, None));
    let numeric = ok("wavelength,1,2,3\n380,0.1,0.2,0.3\n390,0.2,0.3,0.4\n");
    assert_eq!(names(&numeric), ["1", "2", "3"]);
    let blank_between = ok(
        "Wave   ;Sample   ;Reflectance\r\n[nm]   ;[counts] ;[%]\r\n\r\n 300.00;   -6.893;52.5\r\n 301.00;   -7.474; 0.0\r\n",
    );
    assert_eq!(names(&blank_between), ["Reflectance"]);
    assert_eq!(blank_between.reading.header_line, Some(1));
    let commented = ok("# wavelength, red one, green one\n380,0.1,0.2\n390,0.2,0.3\n");
    assert_eq!(names(&commented), ["red one", "green one"]);
    let unnamed = ok("bark,leaf\n380,0.1,0.2\n390,0.2,0.3\n");
    assert_eq!(names(&unnamed), ["bark", "leaf"]);
    let setting = ok("LUX\t695.1\nIRR\t2.6\n380nm\t0.03\n381nm\t0.04\n");
    assert_eq!(names(&setting), ["Column 2"]);
}

#[test]
fn comments_are_kept() {
    let text = "# title: Nikon D70\n# quantity: relative spectral sensitivity\n# unit: 1\n# response: per energy\n\
                # note: one: two\nwavelength_nm,R,G,B\n380,0.1,0.2,0.3\n# in between\n390,0.2,0.3,0.4\n";
    let table = ok(text);
    let header = &table.reading.header;
    assert_eq!(header[0], ("title".to_owned(), "Nikon D70".to_owned()));
    assert_eq!(table.reading.comment("Quantity"), Some("relative spectral sensitivity"));
    assert_eq!(table.reading.comment("response"), Some("per energy"));
    assert_eq!(table.reading.comment("note"), Some("one: two"));
    assert_eq!(table.reading.comment("license"), None);
    assert_eq!((table.role.value, table.role.certainty), (Role::Camera, Certainty::Certain));
    assert_eq!(table.reading.camera_columns, Some([0, 1, 2]));
    assert_eq!(table.reading.rows, 2);
    let one = ok("# title: My leaf\n380,0.1\n390,0.2\n");
    assert_eq!(names(&one), ["My leaf"]);
    let tool = ok("#Model:D70\n#Maker:Nikon\n400,0.1,0.2,0.3\n410,0.1,0.2,0.3\n");
    assert_eq!(tool.reading.comment("model"), Some("D70"));
}

#[test]
fn encodings() {
    let text = "Wellenlänge (µm);Licht\n0,4;1,5\n0,5;2,5\n";
    let utf8 = ok(text);
    assert_eq!(utf8.reading.encoding, Encoding::Utf8);
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    let bom: Vec<u8> = [b"\xEF\xBB\xBF", text.as_bytes()].concat();
    let le: Vec<u8> = [0xFEFF].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let be: Vec<u8> = [0xFEFF].into_iter().chain(text.encode_utf16()).flat_map(u16::to_be_bytes).collect();
    let bare: Vec<u8> = "400,1\n401,2\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, encoding) in
        [(latin, Encoding::Windows1252), (bom, Encoding::Utf8), (le, Encoding::Utf16Le), (be, Encoding::Utf16Be)]
    {
        let table = ok_bytes(&bytes);
        assert_eq!(table.reading.encoding, encoding);
        assert_eq!(table.curves, utf8.curves);
        assert_eq!(table.reading.wavelength_unit.certainty, Certainty::Certain);
    }
    assert_eq!(utf8.curves[0].wavelengths_nm, [400.0, 500.0]);
    assert_eq!(samples(&ok_bytes(&bare).curves[0]), [(400.0, 1.0), (401.0, 2.0)]);
}

#[test]
fn padding_line_ends_and_unbalanced_quotes() {
    let padded = b"name: 1305084U1\0\0\0\0\0\r\n\r\nWave;Ref\r\n[nm];[counts]\r\n275.27;768.6\r\n275.87;790.3\r\n";
    let table = ok_bytes(padded);
    assert_eq!(samples(&table.curves[0]), [(275.27, 768.6), (275.87, 790.3)]);
    assert_eq!((names(&table), table.reading.first_data_line), (vec!["Ref"], 5));
    for text in ["380 1\r381 2\r382 3", "380 1\r\n381 2\r382 3\n", "\n380 1\n\r381 2\r\r\n382 3\r\n\r\n"] {
        assert_eq!(samples(&ok(text).curves[0]), [(380.0, 1.0), (381.0, 2.0), (382.0, 3.0)], "{text:?}");
    }
    let quote = ok("\" File: Some\\Path\n\" TRANS->  Wave:734.22nm  Pix:1050\n 339.00  1.0\n 339.50  2.0\n");
    assert_eq!(samples(&quote.curves[0]), [(339.0, 0.01), (339.5, 0.02)]);
    let open = ok("\"nm,\"a\n380,1\n381,2\n");
    assert_eq!(names(&open), ["\"a"]);
}

#[test]
fn wavelength_units() {
    use {Certainty as Sure, WavelengthUnit as Unit};
    for (text, unit, certainty) in [
        ("nm,a\n400,1\n500,2\n", Unit::Nanometer, Sure::Certain),
        ("Wavelength (micrometers),a\n0.4,1\n0.5,2\n", Unit::Micrometer, Sure::Certain),
        ("lambda [um],a\n0.4,1\n0.5,2\n", Unit::Micrometer, Sure::Certain),
        ("X Units:  Wavelength (micrometers)\n\n0.4,1\n0.5,2\n", Unit::Micrometer, Sure::Certain),
        ("# wavelength_unit: um\n0.4,1\n0.5,2\n", Unit::Micrometer, Sure::Certain),
        ("0.4µm,1\n0.5 µm,2\n", Unit::Micrometer, Sure::Certain),
        ("400nm,1\n500 [nm],2\n", Unit::Nanometer, Sure::Certain),
        ("Wavelength (Å),a\n4000,1\n5000,2\n", Unit::Angstrom, Sure::Certain),
        ("0.4,1\n0.5,2\n", Unit::Micrometer, Sure::Guess),
        ("Wavenumber (cm-1),a\n25000,1\n20000,2\n", Unit::Wavenumber, Sure::Certain),
        ("1/cm;a\n25000;1\n20000;2\n", Unit::Wavenumber, Sure::Certain),
        ("#XAxisUnit;cm-1\n25000;1\n20000;2\n", Unit::Wavenumber, Sure::Certain),
        ("cm⁻¹\ta\n25000\t1\n20000\t2\n", Unit::Wavenumber, Sure::Certain),
        ("Frequency (THz),a\n749.481145,1\n599.584916,2\n", Unit::Terahertz, Sure::Certain),
        ("Energy (eV),a\n3.09960496083,1\n2.479683968664,2\n", Unit::Electronvolt, Sure::Certain),
        ("400,1\n500,2\n", Unit::Nanometer, Sure::Guess),
    ] {
        let table = ok(text);
        assert_eq!(table.curves[0].wavelengths_nm, [400.0, 500.0], "{text:?}");
        let decided = &table.reading.wavelength_unit;
        assert_eq!((decided.value, decided.certainty), (unit, certainty), "{text:?}");
    }
    let options = ReadOptions { wavelength_unit: Some(Unit::Nanometer), ..ReadOptions::default() };
    let chosen = read(b"4000,1\n5000,2\n", &options).unwrap();
    assert_eq!(chosen.reading.range_nm, [4000.0, 5000.0]);
    assert_eq!(chosen.reading.wavelength_unit.certainty, Sure::Chosen);
}

#[test]
fn percent_and_fractions() {
    use Certainty as Sure;
    for (text, percent, certainty) in [
        ("nm,Reflectance (%)\n400,5\n500,50\n", true, Sure::Certain),
        ("nm,Reflectance\n400,5\n500,50\n", true, Sure::Guess),
        ("nm,Reflectance\n400,0.05\n500,0.5\n", false, Sure::Guess),
        ("# unit: percent\n400,5\n500,50\n", true, Sure::Certain),
        ("# quantity: reflectance\n# unit: 1\n400,0.05\n500,0.5\n", false, Sure::Certain),
        ("Y Units:  Reflectance (percent)\n400 5\n500 50\n", true, Sure::Certain),
        ("Wavelength (nm) Reflectance (%)\n400 5\n500 50\n", true, Sure::Certain),
        ("nm,R%\n400,5\n500,50\n", true, Sure::Certain),
    ] {
        let table = ok(text);
        assert_eq!(table.role.value, Role::Reflectance, "{text:?}");
        assert_eq!(table.curves[0].values, [0.05, 0.5], "{text:?}");
        let decided = &table.reading.values;
        let values = if percent { Values::Percent } else { Values::Plain };
        assert_eq!((decided.value, decided.certainty), (values, certainty), "{text:?}");
    }
    for text in ["400,0.05\n500,0.5\n", "400,1e-5\n500,2e-5\n"] {
        let open = ok(text);
        assert_eq!((open.role.value, open.role.certainty), (Role::Unknown, Sure::Open), "{text:?}");
    }
    let open = ok("400,5\n500,98\n");
    assert_eq!((open.role.value, open.role.certainty), (Role::Unknown, Sure::Open));
    assert_eq!((open.reading.values.certainty, open.curves[0].values.as_slice()), (Sure::Open, &[5.0, 98.0][..]));
    let said: Vec<String> = ok("nm,Reflectance\n400,5\n500,98\n").decisions().iter().map(ToString::to_string).collect();
    assert!(said.contains(&"Values reach 98: read as percent.".to_owned()), "{said:?}");
}

#[test]
fn percent_in_one_column_scales_only_that() {
    let options = ReadOptions { raw: Some(true), ..ReadOptions::default() };
    let table = read(b"Wave;Sample;Reflectance\n[nm];[counts];[%]\n400;700;40\n401;800;50\n", &options).unwrap();
    assert_eq!(table.curves[0].values, [700.0, 800.0]);
    assert_eq!(table.curves[1].values, [0.4, 0.5]);
    assert_eq!((table.curves[0].unit.as_deref(), table.curves[1].unit.as_deref()), (Some("counts"), Some("%")));
    let expected = Warning::NotReflectances { count: 1, first: "“Sample” (column 2)".to_owned(), max: 800.0 };
    assert_eq!(table.warnings, [expected]);
}

#[test]
fn illuminants_and_sensitivities_are_scaled_only_when_asked() {
    let options = |role, values| ReadOptions { role: Some(role), values, ..ReadOptions::default() };
    for role in [Role::Illuminant, Role::Camera, Role::Unknown] {
        let table = read(b"400,5\n500,50\n", &options(role, None)).unwrap();
        assert_eq!((table.curves[0].values.as_slice(), table.reading.values.value), (&[5.0, 50.0][..], Values::Plain));
        assert_eq!(table.role.certainty, Certainty::Chosen);
        let table = read(b"400,5\n500,50\n", &options(role, Some(Values::Percent))).unwrap();
        assert_eq!(table.curves[0].values, [0.05, 0.5]);
        assert_eq!(table.reading.values.certainty, Certainty::Chosen);
    }
    let flipped = ReadOptions { values: Some(Values::Plain), ..ReadOptions::default() };
    assert_eq!(read(b"400,5\n500,50\n", &flipped).unwrap().curves[0].values, [5.0, 50.0]);
    assert_eq!(ok("nm,QE R %,QE G %,QE B %\n400,5,6,7\n500,50,51,52\n").curves[0].values, [5.0, 50.0]);
}

#[test]
fn absorbances_decibels_wave_numbers_and_frequencies_on_request() {
    let with = |values, unit| ReadOptions { values, wavelength_unit: unit, ..ReadOptions::default() };
    let table = read(b"400,1\n500,2\n", &with(Some(Values::Absorbance), None)).unwrap();
    assert_eq!(table.curves[0].values, [0.1, 0.01]);
    let table = read(b"400,-10\n500,20\n", &with(Some(Values::Decibels), None)).unwrap();
    assert_eq!(table.curves[0].values, [0.1, 100.0]);
    let table = read(b"20000,1\n25000,2\n", &with(None, Some(WavelengthUnit::Wavenumber))).unwrap();
    assert_eq!((table.curves[0].wavelengths_nm.as_slice(), table.reading.descending), (&[400.0, 500.0][..], true));
    let table = read(b"500,1\n599.584916,2\n", &with(None, Some(WavelengthUnit::Terahertz))).unwrap();
    assert_eq!(table.curves[0].wavelengths_nm, [500.0, 599.584_916]);
}

#[test]
fn roles() {
    use {Certainty as Sure, Role as Is};
    let bells = |order: [f64; 3]| {
        let mut text = String::from("nm;p;q;s\n");
        for i in 0..=40 {
            let w = 380.0 + 10.0 * f64::from(i);
            let [a, b, c] = order.map(|center| (-((w - center) / 40.0).powi(2)).exp());
            text += &format!("{w};{a:.6};{b:.6};{c:.6}\n");
        }
        text
    };
    for (text, role, certainty) in [
        ("nm,R,G,B\n400,1,2,3\n500,2,3,4\n".to_owned(), Is::Camera, Sure::Guess),
        ("nm,red,green,blue\n400,1,2,3\n500,2,3,4\n".to_owned(), Is::Camera, Sure::Guess),
        ("nm,x,y,z\n400,1,2,3\n500,2,3,4\n".to_owned(), Is::Camera, Sure::Certain),
        (bells([600.0, 540.0, 450.0]), Is::Unknown, Sure::Open),
        ("# quantity: spectral irradiance\n400,0.1\n500,0.2\n".to_owned(), Is::Illuminant, Sure::Certain),
        ("CCT\t5198\n400\t0.1\n500\t0.2\n".to_owned(), Is::Illuminant, Sure::Guess),
        ("400,63\n560,105.3\n600,124\n".to_owned(), Is::Unknown, Sure::Open),
        ("nm,signal [counts]\n400,0.3\n500,0.4\n".to_owned(), Is::Unknown, Sure::Certain),
        ("nm,Transmittance (%)\n400,3\n500,4\n".to_owned(), Is::Transmittance, Sure::Certain),
        ("Y Units: T-Factor\n400 3\n500 4\n".to_owned(), Is::Transmittance, Sure::Certain),
        ("Technique\tTransmission\nWavelength\ta (%)\n400\t3\n500\t4\n".to_owned(), Is::Transmittance, Sure::Certain),
        ("400,49\n560,100\n600,97\n".to_owned(), Is::Illuminant, Sure::Guess),
        ("nm,leaf,bark\n400,0.1,0.2\n500,0.9,1.1\n".to_owned(), Is::Unknown, Sure::Open),
    ] {
        let table = ok(&text);
        assert_eq!((table.role.value, table.role.certainty), (role, certainty), "{text:?}");
    }
    let camera = ReadOptions { role: Some(Role::Camera), ..ReadOptions::default() };
    let by_peak = read(bells([450.0, 600.0, 540.0]).as_bytes(), &camera).unwrap();
    assert_eq!(by_peak.reading.camera_columns, Some([1, 2, 0]));
    assert_eq!(ok("nm,B,G,R,IR\n400,1,2,3,4\n500,2,3,4,5\n").reading.camera_columns, Some([2, 1, 0]));
}

#[test]
fn order_of_rows() {
    let ascending = ok("380,1\n390,2\n410,3\n");
    let descending = ok("410,3\n390,2\n380,1\n");
    assert_eq!(ascending.curves, descending.curves);
    assert!(descending.reading.descending && !ascending.reading.descending);
    assert!(descending.warnings.is_empty());
    let steps = ascending.reading.step_nm;
    assert_eq!((steps.min, steps.median, steps.max, ascending.reading.range_nm), (10.0, 20.0, 20.0, [380.0, 410.0]));
    let mixed = ok("nm,a\n380,1\n410,3\n390,2\n");
    assert_eq!(mixed.curves[0].values, ascending.curves[0].values);
    assert_eq!(mixed.warnings, [Warning::Sorted(4)]);
}

#[test]
fn exact_repeats_count_once() {
    let table = ok("380,1,\n390,2,7\n390,2,7\n400,300,8\n400,300,8\n");
    assert_eq!(samples(&table.curves[0]), [(380.0, 1.0), (390.0, 2.0), (400.0, 300.0)]);
    let dropped: Vec<(usize, Dropped)> = table.reading.dropped_rows.iter().map(|row| (row.line, row.why)).collect();
    assert_eq!(dropped, [(3, Dropped::Repeated), (5, Dropped::Repeated)]);
    assert_eq!(table.reading.rows, 5);
}

#[test]
fn gaps_are_left_out_and_counted() {
    for gap in [
        "", " ", "NaN", "nan", "---", "-", "N/A", "n/a", "-9999", "-9999.0", "-1.#IND", "1.#INF", "1.#QNAN", "#DIV/0!",
        "#N/A", "null", "inf",
    ] {
        let table = ok(&format!("nm,a,b\n380,1.5,{gap}\n390,{gap},6\n400,300,7\n410,4,8\n"));
        assert_eq!(samples(&table.curves[0]), [(380.0, 1.5), (400.0, 300.0), (410.0, 4.0)], "{gap}");
        assert_eq!(samples(&table.curves[1]), [(390.0, 6.0), (400.0, 7.0), (410.0, 8.0)], "{gap}");
        assert_eq!((table.curves[0].missing, table.curves[1].missing), (1, 1));
        assert_eq!(table.warnings.len(), 1);
        assert_eq!(table.warnings[0].to_string(), "2 missing values, lines 2, 3: left out");
    }
    let trailing = ok("nm,a,b,\n380,1.5,5,\n390,2,,\n400,3,7,\n");
    assert_eq!(names(&trailing), ["a", "b"]);
    let wavelength = ok("nm,a\n380,1.5\n,2\n400,3\n");
    assert_eq!(wavelength.reading.dropped_rows[0].why, Dropped::NoWavelength);
    assert_eq!(wavelength.warnings[0].to_string(), "line 3: no wavelength: left out");
    let empty = ok("nm,a,b\n380,1.5,\n390,2,\n");
    assert_eq!(empty.warnings, [Warning::EmptyCurves { count: 1, first: "“b” (column 3)".to_owned() }]);
    let blank_rows = ok("380,1.5\n,\n390,2\n,\n");
    assert_eq!((blank_rows.curves[0].missing, blank_rows.reading.rows), (0, 2));
}

#[test]
fn text_around_the_table() {
    let table = ok("Begin\nGain 3 4\n\n380\t1\n390\t2\n>>>>>End<<<<<\nPeak\t390\n");
    assert_eq!(samples(&table.curves[0]), [(380.0, 1.0), (390.0, 2.0)]);
    assert_eq!(table.warnings, [Warning::TextBelow(6)]);
    let above = ok("1023 4\nname\nx\n380 1\n390 2\n400 2\n");
    assert_eq!((above.reading.rows, above.warnings), (3, vec![Warning::NumbersAbove(1)]));
    let long = "key: some words\n".repeat(500);
    assert_eq!(ok(&format!("{long}380 1\n390 2\n")).reading.first_data_line, 501);
}

#[test]
fn wavelengths_in_another_column() {
    let table = ok("Pixel,Wavelength,Processed,Raw\n0,247.94,24.5,835\n1,248.45,54.5,850\n2,248.96,76.1,858\n");
    assert_eq!(names(&table), ["Processed"]);
    assert_eq!(table.reading.range_nm, [247.94, 248.96]);
    assert_eq!(table.warnings, [Warning::SkippedColumns(2), Warning::Invisible]);
    let indented = ok("\t380\t1\n\t390\t2\n");
    assert_eq!(samples(&indented.curves[0]), [(380.0, 1.0), (390.0, 2.0)]);
}

#[test]
fn wavelengths_across() {
    let named = "wavelength\t380\t385\t390\t395\t400\n1\t0.1\t0.2\t0.3\t0.4\t0.5\n2\t0.2\t0.3\t\t0.5\t0.6\n3\t0\t0\t0\t0\t0.1\n";
    let table = ok(named);
    assert_eq!(table.reading.orientation.value, Orientation::Across);
    assert_eq!(names(&table), ["1", "2", "3"]);
    assert_eq!(table.curves[0].wavelengths_nm, [380.0, 385.0, 390.0, 395.0, 400.0]);
    assert_eq!(samples(&table.curves[1]), [(380.0, 0.2), (385.0, 0.3), (395.0, 0.5), (400.0, 0.6)]);
    assert_eq!((table.curves[1].missing, table.reading.rows, table.reading.header_line), (1, 3, Some(1)));
    assert_eq!(table.warnings[0].to_string(), "1 missing value, line 3: left out");
    let texts = "Date,Mode,Sample name,Wavelengths(nm),400.5,401,402,403,404\n3/8/22,Reflectance,leaf 1,,5,6,7,8,9\n";
    let table = ok(texts);
    assert_eq!((names(&table), table.role.value), (vec!["leaf 1"], Role::Reflectance));
    assert_eq!(table.reading.wavelength_unit.certainty, Certainty::Certain);
    assert_eq!(table.curves[0].values, [0.05, 0.06, 0.07, 0.08, 0.09]);
    let matrix = ok("0,40;0,41;0,42;0,43;0,44\n0,1;0,2;0,3;0,4;0,5\n0,2;0,2;0,2;0,2;0,2\n");
    assert_eq!((names(&matrix), matrix.reading.range_nm), (vec!["Row 1", "Row 2"], [400.0, 440.0]));
    let labels = ok("name;440nm;430nm;420nm;410nm;400nm\na;5;4;3;2;1\n");
    assert_eq!(labels.curves[0].wavelengths_nm, [400.0, 410.0, 420.0, 430.0, 440.0]);
    assert!(labels.reading.descending);
}

#[test]
fn names_that_look_like_wavelengths_do_not_turn_a_table() {
    let text =
        "wavelength,400,500,600,700,800\n380,0.1,0.2,0.3,0.4,0.5\n390,0.1,0.2,0.3,0.4,0.5\n400,0.1,0.2,0.3,0.4,0.5\n";
    let table = ok(text);
    assert_eq!(table.reading.orientation.value, Orientation::Down);
    assert_eq!(table.reading.orientation.certainty, Certainty::Guess);
    assert_eq!((table.curves.len(), table.reading.rows), (5, 3));
    let options = ReadOptions { orientation: Some(Orientation::Across), ..ReadOptions::default() };
    let turned = read(text.as_bytes(), &options).unwrap();
    assert_eq!((names(&turned), turned.reading.range_nm), (vec!["380", "390", "400"], [400.0, 800.0]));
}

#[test]
fn choices_overrule_the_content() {
    let text = b"380,5 0,25\n390,5 0,5\n";
    let options = ReadOptions {
        delimiter: Some(Delimiter::Spaces),
        decimal_mark: Some(DecimalMark::Comma),
        ..ReadOptions::default()
    };
    let table = read(text, &options).unwrap();
    assert_eq!(samples(&table.curves[0]), [(380.5, 0.25), (390.5, 0.5)]);
    assert_eq!(table.reading.delimiter.certainty, Certainty::Chosen);
    let wrong = ReadOptions { delimiter: Some(Delimiter::Semicolon), ..ReadOptions::default() };
    assert!(matches!(read(text, &wrong), Err(ReadError::AsChosen { .. })));
    let commas = ok("380,1,2\n390,2,3\n");
    assert_eq!(commas.warnings, [Warning::CommasOnly]);
    assert_eq!(commas.reading.delimiter.certainty, Certainty::Guess);
}

#[test]
fn whole_files_that_are_no_tables() {
    for (start, kind) in [
        (&b"PK\x03\x04\x14"[..], BinaryKind::Zip),
        (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", BinaryKind::Ole2),
        (b"PK\x03\x04\x14\0ps_0.xmlPK\x01\x02OOISignatures.xml", BinaryKind::ProcSpec),
        (b"PK\x03\x04\x14\0xl/workbook.xml", BinaryKind::Xlsx),
        (b"PK\x03\x04\x14\0mimetypeapplication/vnd.oasis.opendocument.spreadsheet", BinaryKind::Ods),
        (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0W\0o\0r\0k\0b\0o\0o\0k\0", BinaryKind::Xls),
        (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0D\0a\0t\0a\0S\0t\0o\0r\0", BinaryKind::Shimadzu),
        (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0Y\0-\0D\0a\0t\0a\0", BinaryKind::Jasco),
        (&[0, 0xCA, 0x8F, 0x3E].repeat(20)[..], BinaryKind::Unknown),
        (b"\x89PNG\r\n", BinaryKind::Png),
        (b"\xFF\xD8\xFF\xE0", BinaryKind::Jpeg),
        (b"%PDF-1.4", BinaryKind::Pdf),
        (b"\x1F\x8B\x08", BinaryKind::Gzip),
        (b"AVS84\x01", BinaryKind::AvaSoft8),
        (b"as7\0x", BinaryKind::Asd),
        (b"\x89HDF\r\n\x1A\n", BinaryKind::Hdf5),
        (b"II*\0\x08", BinaryKind::Tiff),
        (b"\x76\x2F\x31\x01\x02", BinaryKind::Exr),
        (b"\x01\x02\x03\x04".repeat(10).as_slice(), BinaryKind::Unknown),
    ] {
        assert_eq!(read(start, &ReadOptions::default()), Err(ReadError::Binary(kind)));
    }
    for (text, family) in [
        ("<?xml version=\"1.0\"?>\n<a>380,1</a>", Family::Xml),
        ("{\"a\": [380, 1]}\n", Family::Json),
        ("// a comment\n{ \"bands\": [400, 700, 10] }", Family::Json),
    ] {
        assert_eq!(error(text), ReadError::Unsupported(family), "{text:?}");
    }
    let large = vec![b' '; MAX_BYTES + 1];
    assert_eq!(read(&large, &ReadOptions::default()), Err(ReadError::TooLarge { megabytes: 65, limit: 64 }));
    assert_eq!(error(" \r\n\t\0"), ReadError::Empty);
    assert_eq!(error("Dear reader,\nthere is nothing here.\n"), ReadError::NoNumbers);
    assert_eq!(error("19/5/1997\n 2.5E+02\n 0.0E+00\n 2.6E+02\n"), ReadError::OneColumn(2));
}

#[test]
fn broken_rows_are_named() {
    let not_a_number = |line, column, text: &str| ReadError::NotANumber { line, column, text: text.to_owned() };
    assert_eq!(error("nm,a\n380,1\n390,abc\n400,2\n410,3\n"), not_a_number(3, 2, "abc"));
    assert_eq!(error("nm,a\n380,abc\n390,1\n400,2\n410,3\n"), not_a_number(2, 2, "abc"));
    assert_eq!(error("nm,a\n380,1\n390,1\n400,2\n410,x\n"), not_a_number(5, 2, "x"));
    assert_eq!(error("nm,a\n380,1\n390,1\noops\n400,2\n410,3\n"), not_a_number(4, 1, "oops"));
    assert_eq!(error("380,1\n390,1e999\n400,2\n"), not_a_number(2, 2, "1e999"));
    assert_eq!(error("380,1\n390,12,5x\n400,2\n"), not_a_number(2, 3, "5x"));
    let across = "name,400,410,420,430,440\na,1,2,x,4,5\nb,1,2,3,4,5\n";
    assert_eq!(error(across), not_a_number(2, 4, "x"));
    assert_eq!(error("nm,a,b\n380,1,2\n390,1\n400,2,3\n"), ReadError::UnevenRow { line: 3, found: 2, expected: 3 });
    assert_eq!(error("380,1\n390,1\n400,2,3\n410,3\n"), ReadError::UnevenRow { line: 3, found: 3, expected: 2 });
    let across = "name,400,410,420,430,440\na,1,2,3,4,5\nb,1,2,3,4\nc,1,2,3,4,5\n";
    assert_eq!(error(across), ReadError::UnevenRow { line: 3, found: 5, expected: 6 });
    let message = error("nm,a\n380,1\n390,abc\n400,2\n").to_string();
    assert!(message.starts_with("line 3: no number in column 2"), "{message}");
}

#[test]
fn what_cannot_be_told_apart() {
    assert_eq!(error("380,0,0,05\n385,0,0,12\n390,0,0,2\n"), ReadError::AmbiguousCommas(1));
    assert_eq!(error("Binding energy (eV),a\n3.2,1\n3.1,2\n"), ReadError::NotWavelengths(1));
    let ambiguous = ReadError::AmbiguousUnit { line: 1, min: 4000.0, max: 5000.0 };
    assert_eq!(error("4000,1\n5000,2\n"), ambiguous);
    assert!(ambiguous.to_string().ends_with("choose the wavelength unit"));
}

#[test]
fn wavelengths_that_cannot_be() {
    assert_eq!(error("nm,a\n380,1\n"), ReadError::TooFewSamples(2));
    assert_eq!(error("nm,a\n380,\n390,\n400,1\n"), ReadError::TooFewSamples(2));
    let outside = |line, wavelength_nm| ReadError::WavelengthOutOfRange { line, wavelength_nm };
    assert_eq!(error("nm,a\n0,1\n1,2\n2,3\n"), outside(2, 0.0));
    assert_eq!(error("nm,a\n0.38,1\n0.39,2\n"), outside(2, 0.38));
    assert_eq!(error("nm,a\n380,1\n-390,2\n"), outside(3, -390.0));
    assert_eq!(error("nm,a\n380,1\n30000,2\n"), outside(3, 30000.0));
}

#[test]
fn limits() {
    let wide = format!("380{}\n390{}\n", ",1.5".repeat(100_001), ",1.5".repeat(100_001));
    assert_eq!(error(&wide), ReadError::TooManyCurves(1));
    let many = format!("name,400,410,420,430,440\n{}", "a,1,2,3,4,5\n".repeat(100_001));
    assert_eq!(error(&many), ReadError::TooManyCurves(100_002));
    let row = ",1".repeat(50_000);
    let tall: Vec<String> = (0..401).map(|i| format!("{}{row}\n", 380 + i)).collect();
    assert_eq!(error(&tall.concat()), ReadError::TooManySamples(401));
}

#[test]
fn errors_know_their_place() {
    for text in ["", "nothing", "380,1\n390,x\n400,1\n", "nm,a\n0,1\n1,2\n", "{}", "380,1\n", "2\n3\n"] {
        let error = error(text);
        let message = error.to_string();
        assert_eq!(error.line().is_some(), message.starts_with("line "), "{message}");
        if let Some(column) = error.column() {
            assert!(message.contains(&format!("column {column}")), "{message}");
        }
    }
}

#[test]
fn hostile_shapes_are_quick() {
    let many = 200_000;
    for bytes in [
        b"\"".repeat(many),
        b"\"a,".repeat(many),
        b"1,".repeat(many),
        b"\n".repeat(many),
        b"\r".repeat(many),
        b"#a:b\n".repeat(many),
        b"400,1\n".repeat(many),
        b"nm,%\n".repeat(many),
        b",,,\n".repeat(many),
        [b"\"\"\"x", "\"\"\",".as_bytes()].concat().repeat(many),
        b"1 2;3,4\t5\n".repeat(many),
    ] {
        let _ = read(&bytes, &ReadOptions::default());
    }
}
