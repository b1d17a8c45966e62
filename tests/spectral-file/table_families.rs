//! Spectral files of families with a grammar of their own, each written here layout for layout with made-up numbers.

#![allow(clippy::format_push_string, reason = "files are written as they read")]

mod hostile;
mod instruments;
mod json;
mod layouts;
mod xml;

use spectral_file::{
    Certainty, DecimalMark, Delimiter, Encoding, Family, Orientation, ReadError, ReadOptions, Reader, Role,
    SpectralFile, Values, Warning, read,
};

use super::table::{error, names};

fn ok(text: &str) -> SpectralFile {
    read(text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn samples(table: &SpectralFile, curve: usize) -> Vec<(f64, f64)> {
    let curve = &table.curves[curve];
    curve.wavelengths_nm.iter().copied().zip(curve.values.iter().copied()).collect()
}

fn note<'a>(table: &'a SpectralFile, what: &str) -> Option<&'a str> {
    table.reading.notes.iter().find(|note| note.what == what).map(|note| note.value.as_str())
}

#[test]
fn argyll_spectrum() {
    let table = ok(layouts::ARGYLL_SP);
    assert_eq!(table.reading.reader.value, Reader::CGATS);
    assert_eq!(samples(&table, 0), [(300.0, 0.0), (305.0, 0.25), (310.0, 0.5782)]);
    assert_eq!((names(&table), table.curves[0].named), (vec!["Lamp spectral power, 0% U.V."], true));
    assert_eq!((table.role.value, table.role.certainty), (Role::Illuminant, Certainty::Guess));
    assert_eq!(note(&table, "Scale"), Some("divided by 100"));
    assert_eq!(note(&table, "Bands"), Some("3 from 300 to 310 nm"));
    assert_eq!(table.reading.comment("ORIGINATOR"), Some("Argyll CMS"));
}

#[test]
fn the_kind_of_measurement_is_the_role() {
    let kinds = [
        ("EMISSION", Role::Illuminant),
        ("AMBIENT_FLASH", Role::Illuminant),
        ("TRANSMISSIVE", Role::Transmittance),
        ("REFLECTIVE", Role::Reflectance),
        ("SENSITIVITY", Role::Camera),
    ];
    for (kind, role) in kinds {
        let keyword = format!("SPECT\n\nKEYWORD \"MEAS_TYPE\"\nMEAS_TYPE \"{kind}\"\n");
        let table = ok(&layouts::ARGYLL_SP.replacen("SPECT", &keyword, 1));
        assert_eq!((table.role.value, table.role.certainty), (role, Certainty::Certain), "{kind}");
    }
}

#[test]
fn bands_with_a_fractional_step_come_from_the_keywords() {
    let table = ok("CCSS\n\nSPECTRAL_BANDS \"4\"\nSPECTRAL_START_NM \"350.0\"\nSPECTRAL_END_NM \"360.0\"\n\
                    NUMBER_OF_FIELDS 5\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_350 SPEC_353 SPEC_357 SPEC_360\n\
                    END_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n1 0.1 0.2\n0.3 0.4\n2 1 2 3 4\nEND_DATA\n");
    assert_eq!(table.curves[0].wavelengths_nm, [350.0, 353.333_333_333, 356.666_666_667, 360.0]);
    assert_eq!(table.curves[0].values, [0.1, 0.2, 0.3, 0.4]);
    assert_eq!(names(&table), ["1", "2"]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Illuminant, Certainty::Certain));
}

#[test]
fn xrite_without_a_type_line() {
    let table = ok(layouts::XRITE);
    assert_eq!(names(&table), ["X1", "X 2"]);
    assert_eq!(samples(&table, 1), [(380.0, 0.9009), (390.0, 0.9024), (400.0, 0.9046)]);
    assert_eq!((table.role.value, table.reading.values.value), (Role::Reflectance, Values::Plain));
    let source = table.reading.comment("MEASUREMENT_SOURCE");
    assert_eq!(source, Some("Illumination=D65\tObserverAngle=10°\tFilter=No"));
    assert_eq!(table.reading.comment("CREATED"), Some("11/14/2014"));
    assert_eq!((table.reading.orientation.value, table.reading.first_data_line), (Orientation::Across, 10));
    let latin: Vec<u8> = layouts::XRITE.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    let other = read(&latin, &ReadOptions::default()).unwrap();
    assert_eq!((other.reading.encoding, &other.curves), (Encoding::Windows1252, &table.curves));
}

#[test]
fn cgats_in_pairs_and_its_errors() {
    let pairs = ok("CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_NAME SPECTRAL_NM SPECTRAL_PCT SPECTRAL_NM SPECTRAL_PCT\n\
                    END_DATA_FORMAT\nBEGIN_DATA\n\"a \"\"b\"\"\" 400 5 410 6 # note\nc 400 50 410 60\nEND_DATA\n");
    assert_eq!((names(&pairs), samples(&pairs, 0)), (vec!["a \"b\"", "c"], vec![(400.0, 0.05), (410.0, 0.06)]));
    assert_eq!(pairs.reading.values.certainty, Certainty::Certain);
    let start = "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID R_400 R_410\nEND_DATA_FORMAT\nBEGIN_DATA\n";
    assert_eq!(
        error(&format!("{start}1 5 6\n2 7\nEND_DATA\n")),
        ReadError::UnevenRow { line: 7, found: 2, expected: 3 }
    );
    let text = "x".to_owned();
    assert_eq!(error(&format!("{start}1 5 x\nEND_DATA\n")), ReadError::NotANumber { line: 6, column: 3, text });
    let bare = "CTI3\nBEGIN_DATA_FORMAT\nSAMPLE_ID RGB_R RGB_G\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2 3\nEND_DATA\n";
    assert_eq!(error(bare), ReadError::NoWavelengths(2));
    let gap = ok(&format!("{start}1 5 6\n2 -9999 7\n3 0,5 7\nEND_DATA\n"));
    assert_eq!((names(&gap), gap.curves[1].values[0]), (vec!["1", "3"], 0.5));
    let second = format!(
        "{start}1 5 6\nEND_DATA\nCAL\nBEGIN_DATA_FORMAT\nSPEC_400 SPEC_410\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\nEND_DATA\n"
    );
    let second = ok(&second);
    assert_eq!((second.curves.len(), &second.warnings[0]), (1, &Warning::MoreTables(13)));
}

#[test]
fn jcamp_of_linked_blocks() {
    let table = ok(layouts::JCAMP_LINK);
    assert_eq!(table.reading.reader.value, Reader::JCAMP);
    assert_eq!(samples(&table, 0), [(400.5, 0.25), (401.0, 0.3), (401.5, 0.35)]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Transmittance, Certainty::Certain));
    assert_eq!(table.reading.values.certainty, Certainty::Certain);
    assert!(note(&table, "Blocks").is_some_and(|note| note.contains("PROCESSED")));
    let options = ReadOptions { raw: Some(true), ..ReadOptions::default() };
    let all = read(layouts::JCAMP_LINK.as_bytes(), &options).unwrap();
    assert_eq!((all.curves.len(), all.curves[1].values[2]), (2, 0.12));
    let commas = layouts::JCAMP_LINK.replace(", ", ";").replace('.', ",").replace(';', ", ");
    let table = ok(&commas);
    assert_eq!(samples(&table, 0), [(400.5, 0.25), (401.0, 0.3), (401.5, 0.35)]);
    assert_eq!(table.reading.decimal_mark.value, DecimalMark::Comma);
}

#[test]
fn jcamp_with_squeezed_ordinates() {
    let head = "##TITLE= leaf\n##JCAMP-DX= 4.24\n##DATA TYPE= UV/VIS SPECTRUM\n##XUNITS= NANOMETERS\n\
                ##YUNITS= REFLECTANCE\n##XFACTOR= 1.0\n##YFACTOR= 0.001\n##FIRSTX= 400\n##LASTX= 440\n##NPOINTS= 5\n\
                ##XYDATA= (X++(Y..Y))\n";
    let wanted = [(400.0, 0.1), (410.0, 0.11), (420.0, 0.12), (430.0, 0.12), (440.0, 0.05)];
    for data in [
        "400 100 110 120\n430 120 50\n",
        "400+100+110+120\n430+120+50\n",
        "400A00A10A20\n430A20E0\n",
        "400A00J0T%\n430A20j0V\n".replace("j0V", "p0").as_str(),
        "400 1.00E+02 1.10E+02,120\n430 120 5E+1\n",
    ] {
        let table = ok(&format!("{head}{data}##END=\n"));
        assert_eq!(samples(&table, 0), wanted, "{data}");
        assert!(table.warnings.is_empty(), "{:?}", table.warnings);
    }
    let short = ok(&format!("{head}400 100 110 120 120\n##END=\n"));
    assert_eq!(short.warnings, [Warning::CountDiffers { line: 10, expected: 5, found: 4 }]);
    let waves = head.replace("NANOMETERS", "1/CM");
    let waves = waves.replace("FIRSTX= 400", "FIRSTX= 25000").replace("LASTX= 440", "LASTX= 15000");
    let table = ok(&format!("{waves}25000 100 110 120 120 50\n"));
    assert_eq!((table.reading.range_nm[0], table.reading.descending), (400.0, false));
    let text = "400 1!0".to_owned();
    assert!(matches!(error(&format!("{head}{text}\n")), ReadError::NotANumber { line: 12, .. }));
    let absorbance = head.replace("REFLECTANCE", "ABSORBANCE");
    let table = ok(&format!("{absorbance}400 100 110 120 120 50\n"));
    assert_eq!((table.reading.values.value, table.reading.values.certainty), (Values::Absorbance, Certainty::Certain));
    assert_eq!((table.role.value, table.role.certainty), (Role::Transmittance, Certainty::Guess));
    assert_eq!(table.curves[0].values[0], 10_f64.powf(-0.1));
}

#[test]
fn tm27() {
    let table = ok(layouts::TM27);
    assert_eq!(table.reading.reader.value, Reader::TM27);
    assert_eq!(samples(&table, 0), [(400.0, 0.034), (403.1, 0.037), (405.5, 0.069)]);
    assert_eq!((names(&table), table.curves[0].named), (vec!["Made-up lamp"], true));
    assert_eq!((table.role.value, table.role.certainty), (Role::Illuminant, Certainty::Guess));
    assert_eq!(table.reading.comment("Manufacturer"), Some("Nobody"));
    let radiance = ok(&layouts::TM27.replace("relative", "radiance").replace("iestm2714", "urn:any"));
    assert_eq!((radiance.role.value, radiance.role.certainty), (Role::Illuminant, Certainty::Certain));
    let factor = ok(&layouts::TM27.replace("relative", "R-Factor"));
    assert_eq!(factor.role.value, Role::Reflectance);
    let cut = &layouts::TM27[..layouts::TM27.len() - 40];
    assert!(matches!(error(cut), ReadError::Malformed { family: Family::Xml, .. }));
    let wrong = layouts::TM27.replace("0.037", "O.037");
    assert_eq!(error(&wrong), ReadError::NotANumber { line: 10, column: 1, text: "O.037".to_owned() });
}

#[test]
fn cxf() {
    let table = ok(layouts::CXF);
    assert_eq!(table.reading.reader.value, Reader::CXF);
    assert_eq!(names(&table), ["list", "points", "twice"]);
    assert_eq!(samples(&table, 0), [(380.0, 0.1), (383.3, 0.2), (386.6, 0.3)]);
    assert_eq!(samples(&table, 1), [(380.5, 0.45), (385.0, 0.5), (392.1, 0.48)]);
    assert_eq!(samples(&table, 2), [(400.0, 0.5), (450.0, 0.625)]);
    assert!(table.curves.iter().all(|curve| curve.missing == 0));
    assert_eq!(table.warnings.len(), 2, "{:?}", table.warnings);
    assert!(table.warnings[1].to_string().starts_with("line 23: “twice” has several values"));
    let nowhere = layouts::CXF.replace(" Increment=\"3.3\"", "");
    assert!(matches!(error(&nowhere), ReadError::NoWavelengths(..)));
}

#[test]
fn rawtoaces() {
    let camera = ok(layouts::RAWTOACES);
    assert_eq!(camera.reading.reader.value, Reader::RAWTOACES);
    assert_eq!((camera.role.value, camera.reading.camera_columns), (Role::Camera, Some([0, 1, 2])));
    assert_eq!(samples(&camera, 1), [(380.0, 0.03), (385.0, 0.02), (1000.0, 0.01)]);
    assert_eq!((names(&camera), camera.reading.comment("title")), (vec!["R", "G", "B"], Some("Nobody N1")));
    let light = ok(
        "{\"header\": {\"type\": \"L1\", \"laboratory\": null, \"list\": [1, {}]},\n\"spectral_data\": {\"units\": \"relative\",\n\
                    \"index\": {\"main\": [\"power\"]}, \"data\": {\"main\": {\"385\": [0.5], \"380\": [0.4]}}}}",
    );
    assert_eq!((names(&light), samples(&light, 0)), (vec!["L1"], vec![(380.0, 0.4), (385.0, 0.5)]));
    assert_eq!((light.role.value, light.role.certainty), (Role::Illuminant, Certainty::Certain));
    assert_eq!((camera.reading.rows, camera.reading.first_data_line), (3, 7));
    let uneven = layouts::RAWTOACES.replace("[0.04, 0.02, 0.01]", "[0.04, 0.02]");
    let wrong = ReadError::WrongCount { line: 7, name: "385".to_owned(), found: 2, expected: 3 };
    assert_eq!(error(&uneven), wrong);
    let cut = &layouts::RAWTOACES[..layouts::RAWTOACES.len() - 4];
    assert!(matches!(error(cut), ReadError::Malformed { family: Family::Json, line: 9, .. }));
    let text = layouts::RAWTOACES.replace("0.04,", "\"x\",");
    assert!(matches!(error(&text), ReadError::NotANumber { line: 7, column: 1, .. }));
}

#[test]
fn dcamprof() {
    let camera = ok(layouts::DCAMPROF);
    assert_eq!(camera.reading.reader.value, Reader::DCAMPROF);
    assert_eq!(samples(&camera, 0), [(400.0, 0.1), (410.0, 0.5), (420.0, 1.0)]);
    assert_eq!((camera.role.value, camera.reading.camera_columns), (Role::Camera, Some([0, 1, 2])));
    assert_eq!(camera.reading.comment("title"), Some("Made // up \"N1\""));
    assert_eq!(note(&camera, "Grid"), Some("400 to 420 nm in steps of 10"));
    let light = ok("{ /* two\nlines */ \"bands\": [400, 405, 420], \"scale\": 100, \"spectrum\": [50, 75, 100] }");
    assert_eq!(samples(&light, 0), [(400.0, 0.5), (405.0, 0.75), (420.0, 1.0)]);
    let short = layouts::DCAMPROF.replace("0.3, 0.2", "0.3");
    let wrong = ReadError::WrongCount { line: 11, name: "green_ssf".to_owned(), found: 2, expected: 3 };
    assert_eq!(error(&short), wrong);
    assert_eq!(error("[1, 2]"), ReadError::Unsupported(Family::Json));
    assert!(matches!(error("{ // cut\n \"ssf_bands\": [400"), ReadError::Malformed { line: 2, .. }));
}

#[test]
fn lamp_meter_with_two_samplings() {
    let table = ok(&layouts::sekonic("Spectral Data "));
    assert_eq!(table.reading.reader.value, Reader::LABELS);
    let curve = &table.curves[0];
    assert_eq!((curve.values.len(), table.reading.range_nm, table.reading.step_nm.max), (21, [380.0, 400.0], 1.0));
    assert_eq!((curve.values[0], curve.values[20]), (0.0, 0.020));
    assert_eq!((names(&table), table.role.value), (vec!["lamp_1°"], Role::Illuminant));
    assert_eq!(note(&table, "Block"), Some("the 21 samples from line 15 on"));
    let local = ok(&layouts::sekonic("分光データ").replace(',', "\t"));
    assert_eq!((&local.curves[0].values, local.reading.delimiter.value), (&curve.values, Delimiter::Tab));
}

#[test]
fn alternate_lines() {
    let table = ok(
        "@19/5/1997\r\n@17:44:58\r\n#No Title\r\n 2.5000000000E+02\r\n 0.0000000000E+00\r\n 2.5100000000E+02\r\n 1.5E-04\r\n",
    );
    assert_eq!(
        (table.reading.reader.value, samples(&table, 0)),
        (Reader::ALTERNATE, vec![(250.0, 0.0), (251.0, 1.5e-4)])
    );
    assert_eq!(table.reading.comment("date"), Some("19/5/1997"));
    let odd = error("@a\n#b\n250\n1\n251\n");
    assert_eq!(odd, ReadError::UnevenRow { line: 5, found: 1, expected: 2 });
}

#[test]
fn database_of_cameras() {
    let row = |peak: f64| {
        let cells = (0..33).map(|i| format!("{:.6}", (-((f64::from(i) - peak) / 5.0).powi(2)).exp()));
        cells.collect::<Vec<_>>().join("\t") + "\r\n"
    };
    let camera = |name: &str| format!("{name}\r\n{}{}{}", row(20.0), row(13.0), row(5.0));
    let one = ok(&camera("Made up 1D"));
    assert_eq!((names(&one), one.reading.comment("title")), (vec!["R", "G", "B"], Some("Made up 1D")));
    assert_eq!((one.reading.range_nm, one.reading.camera_columns), ([400.0, 720.0], Some([0, 1, 2])));
    assert_eq!((one.curves[1].values[13], one.reading.reader.certainty), (1.0, Certainty::Guess));
    let two = ok(&(camera("Made up 1D") + &camera("Made up 2D")));
    assert_eq!((two.curves.len(), two.curves[5].name.as_str()), (6, "Made up 2D B"));
    let cut = camera("Made up 1D") + "Made up 2D\r\n1\t2\r\n";
    assert_eq!(error(&cut), ReadError::UnevenRow { line: 6, found: 2, expected: 33 });
}

#[test]
fn the_reader_can_be_chosen() {
    let options = ReadOptions { reader: Some(Reader::TABLE), ..ReadOptions::default() };
    let table = read(b"##TITLE= a\n##XYPOINTS= (XY..XY)\n400,1\n500,2\n", &options).unwrap();
    assert_eq!((table.reading.reader.value, table.reading.reader.certainty), (Reader::TABLE, Certainty::Chosen));
    let said: Vec<_> = table.decisions().iter().map(|decision| decision.what).collect();
    assert_eq!(said[1], "Layout");
    let options = ReadOptions { reader: Some(Reader::CGATS), ..ReadOptions::default() };
    assert_eq!(read(b"400,1\n500,2\n", &options), Err(ReadError::OtherLayout(Reader::CGATS)));
}

#[test]
fn blocks_in_other_units_are_other_parts() {
    let block = |x: &str, y: &str, data: &str| {
        format!("##TITLE={y}\n##XUNITS={x}\n##YUNITS={y}\n##XYPOINTS=(XY..XY)\n{data}\n##END=\n")
    };
    let start = format!("##TITLE=L\n##DATA TYPE=LINK\n{}", block("NANOMETERS", "TRANSMITTANCE", "400,0.5\n500,0.6"));
    let second = |options: &ReadOptions, text: &str| read(text.as_bytes(), options).unwrap();
    let part = ReadOptions { part: Some(2), ..ReadOptions::default() };
    for (other, wanted) in [
        (block("NANOMETERS", "ABSORBANCE", "400,1\n500,2"), vec![(400.0, 0.1), (500.0, 0.01)]),
        (block("1/CM", "TRANSMITTANCE", "20000,0.2\n25000,0.1"), vec![(400.0, 0.1), (500.0, 0.2)]),
    ] {
        let text = format!("{start}{other}");
        let table = ok(&text);
        assert_eq!((table.curves.len(), samples(&table, 0)), (1, vec![(400.0, 0.5), (500.0, 0.6)]), "{other}");
        assert_eq!((table.reading.parts.len(), table.reading.part.value), (2, 1));
        assert_eq!(table.warnings, [Warning::MoreTables(14)]);
        assert_eq!(samples(&second(&part, &text), 0), wanted, "{other}");
    }
    let same = ok(&format!("{start}{}", block("nm", "Transmittance", "400,0.7\n500,0.8")));
    assert_eq!((same.curves.len(), same.reading.part.value, same.warnings.len()), (2, 0, 0));
}

#[test]
fn distributions_of_other_quantities_are_not_mixed() {
    let one = |quantity: &str, value: f64| {
        format!(
            "<SpectralDistribution><SpectralQuantity>{quantity}</SpectralQuantity>\n<SpectralData wavelength=\"400\">{value}\
             </SpectralData><SpectralData wavelength=\"500\">{value}</SpectralData></SpectralDistribution>\n"
        )
    };
    let file = |all: &[String]| ok(&format!("<IESTM2714><Header/>\n{}</IESTM2714>", all.concat()));
    let mixed = file(&[one("transmittance", 0.5), one("irradiance", 55.0)]);
    assert_eq!((mixed.curves.len(), samples(&mixed, 0)), (1, vec![(400.0, 0.5), (500.0, 0.5)]));
    assert_eq!((mixed.role.value, mixed.reading.values.value), (Role::Transmittance, Values::Plain));
    assert_eq!(mixed.warnings, [Warning::MoreTables(5)]);
    let same = file(&[one("irradiance", 55.0), one("Irradiance", 66.0)]);
    assert_eq!((same.curves.len(), same.warnings.len(), same.role.value), (2, 0, Role::Illuminant));
}

#[test]
fn warnings_of_one_kind_are_counted_where_there_are_many() {
    let object = |i: usize| {
        format!(
            "<Object Name=\"o{i}\"><CustomSpectrum><SpectralPoint WL=\"400\">0.1</SpectralPoint>\
             <SpectralPoint WL=\"400\">0.2</SpectralPoint><SpectralPoint WL=\"500\">3</SpectralPoint></CustomSpectrum></Object>\n"
        )
    };
    let table = ok(&format!("<CxF>{}</CxF>", (0..300).map(object).collect::<Vec<_>>().concat()));
    assert_eq!(table.curves.len(), 300);
    assert_eq!(table.warnings.last(), Some(&Warning::More(280)));
    assert!(table.warnings.len() <= 22, "{}", table.warnings.len());
}
