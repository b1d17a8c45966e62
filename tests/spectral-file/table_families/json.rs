//! JSON of wavelengths and values in every layout that people write: names, quantities and units as they say them, and nothing of
//! what holds no spectra.

use spectral_file::{
    Certainty, Family, Quantity, ReadError, Reader, Role, SpectralFile, Values, Warning, WavelengthUnit,
};

use super::super::table::{error, names};
use super::{note, ok, samples};

const THREE: [(f64, f64); 3] = [(400.0, 0.1), (500.0, 0.2), (600.0, 0.4)];

/// The three samples, read from a document with single quotes.
#[track_caller]
fn three(text: &str, wanted: &[&str]) -> SpectralFile {
    these(text, wanted, &THREE)
}

#[track_caller]
fn these(text: &str, wanted: &[&str], all: &[(f64, f64)]) -> SpectralFile {
    let table = ok(&text.replace('\'', "\""));
    assert_eq!(names(&table), wanted, "{text}");
    for curve in 0..wanted.len() {
        assert_eq!(samples(&table, curve), all, "{text}");
    }
    assert_eq!(table.reading.reader.value, Reader::JSON);
    table
}

const LISTS: &str = "'wavelengths': [400, 500, 600], 'reflectance': [0.1, 0.2, 0.4]";

/// Ten samples: fewer numbers are no wavelengths where no word says so.
fn ten() -> Vec<(f64, f64)> {
    (0..10).map(|at| (400.0 + 20.0 * f64::from(at), 0.5 + f64::from(at) / 64.0)).collect()
}

#[test]
fn lists_side_by_side() {
    let table = three(&format!("{{{LISTS}}}"), &["reflectance"]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Reflectance, Certainty::Certain));
    let why = &table.reading.reader.why;
    assert_eq!(why, "Line 1 has “wavelengths”");
    three(&format!("{{'title': 'leaf', {LISTS}}}"), &["leaf"]);
    let camera = three(
        "{'camera': 'N1', 'wavelength_nm': [400, 500, 600], 'red': [0.1, 0.2, 0.4], 'green': [0.1, 0.2, 0.4], 'blue': [0.1, 0.2, 0.4]}",
        &["red", "green", "blue"],
    );
    assert_eq!((camera.role.value, camera.reading.camera_columns), (Role::Camera, Some([0, 1, 2])));
    assert_eq!(camera.reading.wavelength_unit.certainty, Certainty::Certain);
    let gap = ok("{\"wl\": [400, 500, 600, 700], \"reflectance\": [0.1, 0.2, 0.4, null]}");
    assert_eq!(samples(&gap, 0), THREE);
}

#[test]
fn objects_in_lists_and_in_one_another() {
    three(&format!("[{{'name': 'leaf', {LISTS}}}, {{'name': 'bark', {LISTS}}}]"), &["leaf", "bark"]);
    three(&format!("{{'leaf': {{{LISTS}}}, 'bark': {{{LISTS}}}}}"), &["leaf", "bark"]);
    three(&format!("[{{{LISTS}}}, {{{LISTS}}}]"), &["reflectance", "reflectance"]);
    let shared = "{'wavelengths': [400, 500, 600], 'entries': [{'name': 'a', 'spectrum': [0.1, 0.2, 0.4]}]}";
    three(shared, &["a"]);
    let walls = three(
        "{'wall': {'wavelength_nm': [400, 500, 600], 'reflectance': [0.1, 0.2, 0.4], 'transmittance': [0.1, 0.2, 0.4]}}",
        &["wall reflectance", "wall transmittance"],
    );
    assert_eq!(walls.role.certainty, Certainty::Guess);
    let spectrum = three("{'spectrum': {'wavelengths': [400, 500, 600], 'values': [0.1, 0.2, 0.4]}}", &["Spectrum 1"]);
    assert_eq!((spectrum.role.value, spectrum.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn records_and_rows() {
    let record = |nm: u32, value: f64| format!("{{'wavelength': {nm}, 'red': {value}, 'green': {value}}}");
    let all: Vec<String> = THREE.iter().map(|(nm, value)| record(*nm as u32, *value)).collect();
    three(&format!("[{}]", all.join(",")), &["red", "green"]);
    let tidy = |sample: &str| {
        THREE
            .map(|(nm, value)| format!("{{'sample': '{sample}', 'wavelength': {nm}, 'reflectance': {value}}}"))
            .join(",")
    };
    three(&format!("[{},{}]", tidy("leaf"), tidy("bark")), &["leaf", "bark"]);
    let rows: Vec<String> = ten().iter().map(|(nm, value)| format!("[{nm}, {value}]")).collect();
    these(&format!("[{}]", rows.join(",")), &["Spectrum 1"], &ten());
    let band = |id: &str| format!("{{'band_id': '{id}', 'width': 20, 'definition': {{{LISTS}}}}}");
    three(&format!("{{'sensor_id': 'S', 'bands': [{}, {}]}}", band("blue"), band("red")), &["blue", "red"]);
    three(
        "{'columns': ['wavelength', 'R', 'G'], 'index': [0, 1, 2], 'data': [[400, 0.1, 0.1], [500, 0.2, 0.2], [600, 0.4, 0.4]]}",
        &["R", "G"],
    );
    three("{'wavelengths': [400, 500, 600], 'spectra': [[0.1, 0.2, 0.4], [0.1, 0.2, 0.4]]}", &["1", "2"]);
    three("{'wavelength': {'0': 400, '1': 500, '2': 600}, 'T': {'0': 0.1, '1': 0.2, '2': 0.4}}", &["T"]);
    let lost = "[{\"wavelength\": 400, \"R\": 0.1},\n{\"R\": 0.2}]";
    assert!(matches!(error(lost), ReadError::NotANumber { line: 2, .. }));
}

#[test]
fn wavelengths_as_keys() {
    let object = |value: fn(f64) -> String| {
        let members: Vec<String> = ten().iter().rev().map(|(nm, v)| format!("'{nm}': {}", value(*v))).collect();
        format!("{{{}}}", members.join(", "))
    };
    let keyed = object(|value| value.to_string());
    let channels = these(&format!("{{'R': {keyed}, 'G': {keyed}, 'B': {keyed}}}"), &["R", "G", "B"], &ten());
    assert_eq!(channels.role.value, Role::Camera);
    assert_eq!(channels.reading.reader.certainty, Certainty::Guess);
    these(&keyed, &["Spectrum 1"], &ten());
    these(&object(|value| format!("{{'R': {value}, 'G': {value}}}")), &["R", "G"], &ten());
    let lamp = these(&format!("{{'name': 'lamp 3', 'unit': 'W/m2/nm', 'spd': {keyed}}}"), &["lamp 3"], &ten());
    assert_eq!((lamp.role.value, lamp.curves[0].unit.as_deref()), (Role::Illuminant, Some("W/m2/nm")));
    // Numbers of people.
    assert_eq!(error("{\"101\": {\"age\": 5}, \"205\": {\"age\": 7}}"), ReadError::Unsupported(Family::Json));
}

#[test]
fn ranges() {
    let axes = [
        "'domain': [400, 600], 'interval': 100, ",
        "'start': 400, 'end': 600, 'step': 100, ",
        "'wavelengths': {'min': 400, 'max': 600, 'interval': 100}, ",
        "'wavelength_axis': {'range_nm': {'start': 400, 'end': 600, 'interval': 100}}, ",
        "'wavelength_axis': {'values_nm': [400, 500, 600]}, ",
    ];
    for axis in axes {
        let table = three(&format!("{{'name': 'D65', {axis}'samples': [0.1, 0.2, 0.4]}}"), &["D65"]);
        assert_eq!(note(&table, "Grid").is_some(), !axis.contains("values"), "{axis}");
        assert_eq!(note(&table, "Left out"), None);
    }
}

#[test]
fn names_and_units_of_spectral_io() {
    let one = |id: &str, kind: &str, scale: &str, values: &str| {
        format!(
            "{{'id': '{id}', 'metadata': {{'measurement_type': '{kind}', 'date': '2026-01-02', 'title': '{id} tile'}}, \
             'wavelength_axis': {{'range_nm': {{'start': 400.0, 'end': 600.0, 'interval': 100.0}}}}, \
             'spectral_data': {{'values': [{values}], 'uncertainty': [0.01, 0.01, 0.02]{scale}}}, \
             'color_science': {{'white_reference': {{'reference_values': [0.9, 0.9, 0.9]}}, 'results': {{'XYZ': [1, 2, 3]}}}}}}"
        )
    };
    let single = format!(
        "{{'schema_version': '1.0.0', 'file_type': 'single', 'spectrum': {}}}",
        one("red", "reflectance", "", "0.1, 0.2, 0.4")
    );
    let table = three(&single, &["red tile"]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Reflectance, Certainty::Certain));
    assert_eq!(table.curves[0].uncertainty.as_ref().unwrap().standard, [0.01, 0.01, 0.02]);
    let batch = format!(
        "{{'schema_version': '1.0.0', 'file_type': 'batch', 'batch_metadata': {{'title': 'survey'}}, 'spectra': [{}, {}]}}",
        one("red", "transmittance", ", 'scale': 'percent'", "10, 20, 40"),
        one("blue", "transmittance", ", 'scale': 'percent'", "10, 20, 40")
    );
    let table = three(&batch, &["red tile", "blue tile"]);
    assert_eq!((table.role.value, table.reading.values.value), (Role::Transmittance, Values::Percent));
    assert_eq!(table.reading.comment("title"), Some("survey"));
    assert_eq!(table.curves[1].uncertainty.as_ref().unwrap().standard, [0.0001, 0.0001, 0.0002]);
}

#[test]
fn units_beside() {
    let micrometers = three(
        "{'units': {'wavelength': 'um', 'reflectance': '%'}, 'wavelength': [0.4, 0.5, 0.6], 'reflectance': [10, 20, 40]}",
        &["reflectance"],
    );
    assert_eq!(micrometers.reading.wavelength_unit.value, WavelengthUnit::Micrometer);
    assert_eq!(micrometers.reading.values.certainty, Certainty::Certain);
    let lamp = three(
        "{'x_unit': 'nm', 'quantity': 'spectral irradiance', 'unit': 'W/m2/nm', 'wavelengths': [400, 500, 600], 'values': [0.1, 0.2, 0.4]}",
        &["Spectrum 1"],
    );
    assert_eq!((lamp.reading.quantity.value, lamp.role.value), (Quantity::Irradiance, Role::Illuminant));
}

#[test]
fn what_holds_no_spectrum_is_no_broken_json() {
    let others = [
        "{\"spectrum\": {\"metadata\": {\"title\": \"x\"}}}",
        "{\"spectrum\": 5}",
        "{\"spectral_data\": {\"units\": \"relative\"}}",
        "{\"spectral_data\": 1, \"ssf_bands\": {}, \"spectrum\": null}",
        "{\"ssf_bands\": [400, 410], \"red_ssf\": \"no\"}",
        "[{\"a\": 1}, 2, \"x\"]",
        "[]",
        "{}",
        "{\"wavelengths\": [400, 500, 600]}",
        "{\"bad_bands\": [[300, 400], [1320, 1430], [1800, 1960], [2450, 2600]]}",
        "{\"windows\": {\"400\": 1250, \"1450\": 1750, \"2050\": 2450}}",
        "{\"columnHeaders\": [{\"title\": \"lambda\", \"nm\": 1, \"decimals\": 0}, {\"title\": \"S\", \"nm\": 1, \"decimals\": 1}]}",
    ];
    for other in others {
        assert_eq!(error(other), ReadError::Unsupported(Family::Json), "{other}");
    }
    let deep = format!("{}{{{}}}{}", "[".repeat(100), LISTS.replace('\'', "\""), "]".repeat(100));
    assert_eq!(error(&deep), ReadError::Unsupported(Family::Json));
    assert!(matches!(error("{\"wavelengths\": [400, 500"), ReadError::Malformed { family: Family::Json, .. }));
    assert!(matches!(error("[{\"wavelength\": 400;}]"), ReadError::Malformed { family: Family::Json, .. }));
}

#[test]
fn a_list_cut_short_is_an_error_and_another_list_is_said() {
    let short = "{\"wavelengths\": [400, 500, 600],\n\"reflectance\": [0.1, 0.2]}";
    let wrong = ReadError::WrongCount { line: 2, name: "reflectance".to_owned(), found: 2, expected: 3 };
    assert_eq!(error(short), wrong);
    let beside = ok(&format!("{{{LISTS}, 'parameters': [1, 2, 3, 4, 5, 6, 7]}}").replace('\'', "\""));
    assert_eq!(note(&beside, "Left out"), Some("“parameters”"));
    let not = "{\"wavelengths\": [400, 500, 600],\n\"reflectance\": [0.1,\n1e999, 0.4]}";
    assert_eq!(error(not), ReadError::NotANumber { line: 3, column: 1, text: "1e999".to_owned() });
    let twice = ok(&format!("{{{LISTS}}}").replace('\'', "\"").replace("600", "500"));
    assert!(matches!(twice.warnings.as_slice(), [Warning::Averaged { .. }]), "{:?}", twice.warnings);
}

#[test]
fn entries_of_wavelengths_trailing_commas_and_fields_of_charts() {
    let list = "[{\"type\": \"wavelengths\", \"values\": [400, 410, 420,]}, // first\n {\"name\": \"red\", \"reflectance\": [1, 2, 3,],},\n]";
    let table = ok(list);
    assert_eq!((table.curves[0].name.as_str(), &*table.curves[0].values), ("red", &[1.0, 2.0, 3.0][..]));
    let text = "{\"name\": \"a,]\", \"wavelengths\": [400, 410, 420], \"reflectance\": [1, 2, 3,]}";
    assert_eq!(ok(text).curves[0].name, "a,]");
    let fields: Vec<String> = (38..50).map(|nm| format!("\"SPECTRAL_NM{nm}0\": \"0.{nm}\"")).collect();
    let chart = format!("[{{\"SAMPLE_ID\": \"A1\", \"XYZ_X\": \"3.7\", {}}}]", fields.join(", "));
    assert_eq!((ok(&chart).curves[0].values.len(), ok(&chart).reading.range_nm), (12, [380.0, 490.0]));
}
