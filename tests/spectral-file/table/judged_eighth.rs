//! What judges of real files found, an eighth time: heads beside their columns, settings that name samples, and files of LabSpec,
//! Thorlabs, Orange and spectrophotometers of colors.

use spectral_file::{Certainty, ReadError, ReadOptions, Role, Source, Values, WavelengthUnit, read};

use super::{error, names, ok};

/// Rows of a wavelength and a value.
fn rows(separator: &str) -> String {
    (40..60).map(|nm| format!("{nm}0{separator}0.{nm}\n")).collect()
}

#[test]
fn a_head_may_begin_with_an_empty_cell_too_many() {
    let head = ">>>>>Begin Spectral Data<<<<<\n\t\t400\t410\t420\t430\t440\t450\n";
    let row = |at: usize| format!("2025-03-18 10:29:1{at}.226426\t-1{at}\t1.5\t2.5\t3.5\t4.5\t5.5\n");
    let table = ok(&(head.to_owned() + &row(1) + &row(2) + &row(3)));
    assert_eq!(names(&table)[0], "2025-03-18 10:29:11.226426");
    assert_eq!((table.curves[0].wavelengths_nm[0], table.curves[0].values[0]), (400.0, -11.0));
    assert_eq!(table.curves[2].values.len(), 6);
    // A time behind each date fills both.
    let row = |at: usize| format!("2025-03-18\t10{at}\t-1{at}\t1.5\t2.5\t3.5\t4.5\t5.5\n");
    let table = ok(&(head.to_owned() + &row(1) + &row(2) + &row(3)));
    assert_eq!((table.curves[0].values[0], table.curves[0].values.len()), (-11.0, 6));
}

#[test]
fn values_with_commas_stand_below_wavelengths_with_points() {
    let table =
        ok("name;point;344.3;345.9;347.4;349.0;350.6\nA;1;10,393;9,822;9,9;9,99;9,5\nB;1;6,349;6,33;6,1;6,0;6,2\n");
    assert_eq!(names(&table), ["A", "B"]);
    assert_eq!((table.curves[0].wavelengths_nm[1], table.curves[0].values[0]), (345.9, 10.393));
}

#[test]
fn rows_of_types_below_a_head_are_no_spectra() {
    let head = "type,450.5,460.5,470.5,480.5,490.5\nd,c,c,c,c,c\nclass,,,,,\n";
    let table = ok(&(head.to_owned() + "leaf,0.1,0.2,0.3,0.4,0.5\nsoil,0.2,0.3,0.4,0.5,0.6\n"));
    assert_eq!(names(&table), ["leaf", "soil"]);
}

#[test]
fn units_of_later_columns_are_none_of_wavelengths() {
    let table = ok(&format!("%Wavelength\ta (m-1)\n{}", rows("\t")));
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Nanometer);
    let refused = error(&format!("Wavenumber (1/m)\tR\n{}", rows("\t")));
    assert!(matches!(refused, ReadError::NotWavelengths(1)), "{refused}");
}

#[test]
fn settings_name_a_single_curve() {
    let named = |above: &str| names(&ok(&format!("{above}\nnm\t%R\n{}", rows("\t"))))[0].to_owned();
    assert_eq!(named("TITLE\tleaf 3"), "leaf 3");
    assert_eq!(named("Sample:\tleaf 3"), "leaf 3");
    assert_eq!(named("Data name,lamp 1"), "lamp 1");
    assert_eq!(named("Sample name: Reflectance"), "Column 2");
    let unit = "Data name,lamp 1\nSpectral data[nm],[W/(sr*m^2*nm)]\n";
    assert_eq!(names(&ok(&format!("{unit}{}", rows(",")))), ["lamp 1"]);
    // A wavelength of a peak names none.
    assert_eq!(names(&ok(&format!("λp\t450 nm\n{}", rows("nm\t")))), ["Column 2"]);
}

#[test]
fn keys_of_lab_spec_name_no_columns() {
    let head = |unit: &str| format!("#AxisType[0]=\tIntens\n#AxisType[1]=\tSpectr\n#AxisUnit[1]=\t{unit}\n");
    let table = ok(&(head("nm") + &rows("\t")));
    assert_eq!(
        (table.curves[0].wavelengths_nm[0], table.reading.wavelength_unit.certainty),
        (400.0, Certainty::Certain)
    );
    // Those in 1/cm are shifts.
    assert!(matches!(error(&(head("1/cm") + &rows("\t"))), ReadError::NotWavelengths(_)));
}

#[test]
fn sections_in_brackets_are_no_json() {
    let table = ok(&format!("[SpectrumHeader]\n#Date,20190512\n#XAxisUnit,nm_air\n[Data]\n{}[EndOfFile]\n", rows(";")));
    assert_eq!((table.curves[0].values.len(), table.reading.wavelength_unit.certainty), (20, Certainty::Certain));
}

#[test]
fn specular_reflection_is_of_reflectances() {
    let wavelengths: Vec<String> = (40..60).map(|nm| format!("{nm}0[nm]")).collect();
    let row = |mode: &str| format!("paint,{mode},{}\n", ["50.1"; 20].join(","));
    let table = ok(&format!("Name,Mode,{}\n{}{}", wavelengths.join(","), row("SCI"), row("SCE")));
    assert_eq!((table.role.value, table.reading.values.value), (Role::Reflectance, Values::Percent));
    assert_eq!(names(&table), ["paint (SCI)", "paint (SCE)"]);
}

#[test]
fn names_of_files_say_camera_and_sun() {
    let text = rows(",");
    let role = |path| read(Source { path, ..Source::from(&text) }, &ReadOptions::default()).unwrap().role.value;
    assert_eq!((role("camspec.csv"), role("Solar_spectrum_2018.txt")), (Role::Camera, Role::Illuminant));
    assert_eq!(role("solar_cell.csv"), Role::Unknown);
}
