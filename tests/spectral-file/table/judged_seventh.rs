//! What a seventh judge found misread in public files, on small files of the same make.

use spectral_file::{Certainty, Quantity, ReadError, ReadOptions, Role, Source, Warning, WavelengthUnit, read};

use super::{error, names, ok};

/// Rows of a wavelength and a value, with a head or none.
fn rows(head: &str, numbers: &[f64]) -> String {
    let row = |number: &f64| format!("{number},{}\n", 0.001 * number);
    head.to_owned() + &numbers.iter().map(row).collect::<String>()
}

#[test]
fn numbers_beyond_nanometers_may_be_angstroms() {
    let asked = |numbers: &[f64]| matches!(error(&rows("", numbers)), ReadError::AmbiguousUnit { .. });
    assert!(asked(&[91.0, 5000.0, 10_000.0, 30_000.0, 1_600_000.0]));
    assert!(asked(&[316.5, 9000.0, 25_500.0, 199_000.5]));
    assert!(asked(&[1150.0, 5000.0, 10_620.0]), "no nanometers of light that is measured at once");
    // Days are no wavelengths in any unit.
    let days = error(&rows("", &[2_456_082.5, 2_456_083.5, 2_456_084.5]));
    assert!(matches!(days, ReadError::WavelengthOutOfRange { .. }), "{days}");
}

#[test]
fn numbers_that_fall_may_be_energies_or_wave_numbers() {
    let falling = error(&rows("", &[4.13, 3.1, 2.07, 1.55]));
    assert!(matches!(falling, ReadError::AmbiguousEnergies { .. }), "{falling}");
    assert!(falling.to_string().contains("from 4.13 down to 1.55"));
    assert_eq!(ok(&rows("", &[1.55, 2.07, 3.1, 4.13])).reading.wavelength_unit.value, WavelengthUnit::Micrometer);
    let unit = ok(&rows("x,y\n", &[7497.5, 5000.5, 2000.5, 598.5])).reading.wavelength_unit;
    assert_eq!((unit.value, unit.certainty), (WavelengthUnit::Wavenumber, Certainty::Guess));
}

#[test]
fn an_empty_row_of_zeros_before_a_table_is_left_out() {
    let numbers: Vec<f64> = std::iter::once(0.0).chain((0..20).map(|at| 400.0 + 10.0 * f64::from(at))).collect();
    let table = ok(&rows("w, %\n", &numbers));
    let is_said = |warning: &Warning| matches!(warning, Warning::OutOfRange { count: 1, .. });
    assert!(table.curves[0].wavelengths_nm[0] == 400.0 && table.warnings.iter().any(is_said));
}

#[test]
fn shifts_of_raman_scattering_are_no_wavelengths() {
    let text = rows("Wavenumber,Intensity\n", &[200.0, 500.0, 900.0, 1800.0]);
    let at = |path| read(Source { path, ..Source::from(&text) }, &ReadOptions::default());
    assert!(at("ir/leaf.csv").is_ok() && at("/home/raman/ir/leaf.csv").is_ok() && at("ramanujan/leaf.csv").is_ok());
    assert!(matches!(at("RamanSpectroscopy/data/leaf.csv"), Err(ReadError::NotWavelengths(1))));
    let options = ReadOptions { wavelength_unit: Some(WavelengthUnit::Wavenumber), ..ReadOptions::default() };
    assert!(read(Source { path: "raman.csv", ..Source::from(&text) }, &options).is_ok(), "the user's word");
}

#[test]
fn heads_with_exponents_are_wavelengths() {
    let heads: Vec<String> = (0..6).map(|at| format!("{}.00100e+03cm-1", at + 1)).collect();
    let table = ok(&format!("name,{}\none,1,2,3,4,5,6\ntwo,2,3,4,5,6,7\n", heads.join(",")));
    assert_eq!((table.curves.len(), table.curves[0].values.len(), table.warnings.len()), (2, 6, 1), "not seen");
    assert!((table.curves[0].wavelengths_nm[5] - 1e7 / 1001.0).abs() < 1e-6, "{:?}", table.curves[0].wavelengths_nm);
}

#[test]
fn radiances_beside_counts_are_what_was_computed() {
    let table = ok("Wvl\tRaw Counts (Target)\tRad. (Target)\n400\t900\t0.5\n410\t910\t0.6\n420\t920\t0.7\n");
    assert_eq!(names(&table), ["Rad. (Target)"]);
    assert_eq!((table.role.value, table.reading.quantity.value), (Role::Illuminant, Quantity::Radiance));
}

#[test]
fn codes_and_notes_are_no_spectra() {
    let table = ok("wavelength nm\tflux\tSource (0 = model, 1 = measured)\n400\t0.5\t0\n410\t0.6\t1\n420\t0.7\t2\n");
    assert_eq!((names(&table), table.warnings.len()), (vec!["flux"], 1));
    let table = ok("wavelength_nm,a,b,feature\n400,1,2,\n410,2,3,\n420,3,4,\n430,4,5,Ca II K\n440,5,6,\n");
    let is_said = |warning: &Warning| matches!(warning, Warning::TextColumns { .. });
    assert_eq!((names(&table), table.curves[0].values.len()), (vec!["a", "b"], 5));
    assert!(table.warnings.iter().any(is_said), "{:?}", table.warnings);
    let torn = error("wavelength_nm,a,b,c\n400,1,2,\n410,2,3,\n420,3,4,\n430,4,5,oops\n440,5,6,\n");
    assert!(matches!(torn, ReadError::NotANumber { line: 5, .. }), "{torn}");
}

#[test]
fn a_title_with_numbers_stands_above_another_table() {
    let table = |title: &str| format!("{title}\nWavelength (nm),%R\n500,1.5\n490,2.5\n480,3.5\n\n");
    let found = ok(&(table("Blank") + &table("1,1' ethyl") + &table("2,2' ethyl")));
    assert_eq!((found.reading.parts.len(), found.curves[0].values.len()), (3, 3));
    let torn = "Wavelength (nm),%R\n500,1\n490,2\n480,x\nWavelength (nm),%R\n500,1\n490,2\n480,3\n";
    assert!(matches!(error(torn), ReadError::NotANumber { line: 4, .. }));
}

#[test]
fn comments_name_a_single_curve() {
    assert_eq!(names(&ok("# Name: Olivine Fo91\n# Origin: Hawaii\n0.5\t0.1\n0.6\t0.2\n0.7\t0.3\n")), ["Olivine Fo91"]);
    assert_eq!(names(&ok("SH0385\nnm,R\n500,0.1\n600,0.2\n700,0.3\n")), ["SH0385"]);
    assert_eq!(names(&ok("2024-05-01\nnm,R\n500,0.1\n600,0.2\n700,0.3\n")), ["R"]);
    let nameless = "Created as New Dataset,\nnm,A\n500,0.1\n600,0.2\n700,0.3\n";
    assert_eq!(names(&ok(nameless)), ["A"]);
    let card = "#XUNITS  = 'um      '           / wavelengths\n#YUNITS  = 'W/m2/um'\n";
    let table = ok(&format!("{card}0.09\t1e-17\n0.5\t0.1\n0.6\t0.2\n0.7\t0.3\n"));
    assert_eq!((table.curves[0].wavelengths_nm[0], table.role.value), (500.0, Role::Illuminant));
}

#[test]
fn remarks_in_first_rows_name_no_samples() {
    let rows: Vec<String> = (301..320).map(|nm| format!("{nm},1.{nm},{nm},0.{nm},2{nm},,\n")).collect();
    let head =
        "\"λ,n (nm)\",n,\"λ,k (nm)\",k,α (cm⁻¹),Reference,Details\n300,1.5,300,0.5,2300,\"A. Author\",sputtered\n";
    let table = ok(&(head.to_owned() + &rows.concat()));
    assert_eq!(names(&table), ["n", "k", "α (cm⁻¹)"]);
    assert!(table.curves.iter().all(|curve| curve.values.len() == 20));
}

#[test]
fn coefficients_of_absorption_are_no_absorbances() {
    let table = ok("Wavelength (nm)\tabs\n400\t3782.2\n410\t17831\n420\t25300\n");
    assert_eq!((names(&table)[0], table.role.value, table.curves[0].values[1]), ("abs", Role::Unknown, 17_831.0));
    let table = ok("Wavelength (nm)\tabs\n400\t0.5\n410\t1\n420\t2\n");
    assert_eq!((table.role.value, table.curves[0].values[1]), (Role::Transmittance, 0.1));
}

#[test]
fn excitation_beside_emission_is_of_a_dye() {
    let table = ok("wavelength,excitation,emission\n400,0.5,0.1\n410,0.6,0.2\n420,0.7,0.3\n");
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn rows_of_rasters_and_numbered_columns_are_no_spectra() {
    let table = ok("Row\tColumn\tWavelength nm\tO1A\n0\t0\t400\t0.5\n0\t0\t410\t0.6\n0\t0\t420\t0.7\n");
    assert_eq!(names(&table), ["O1A"]);
    let heads: Vec<String> = (1..=12).map(|at| format!("abs{at}")).collect();
    let row = |by: f64| (0..12).map(|at| (by + 0.01 * f64::from(at)).to_string()).collect::<Vec<_>>().join(",");
    let numbered = error(&[heads.join(","), row(0.5), row(0.625), row(0.75)].join("\n"));
    assert!(matches!(numbered, ReadError::NoWavelengths(1)), "{numbered}");
}

#[test]
fn a_sign_tells_what_an_error_is_of() {
    let table = ok("wavelength (nm),radius_ratio (rr),error of rr\n400,0.5,0.01\n410,0.6,0.02\n420,0.7,0.03\n");
    assert_eq!(table.curves.len(), 1);
    assert!(table.curves[0].uncertainty.is_some());
}

#[test]
fn the_sun_in_the_name_of_a_file_is_a_light() {
    let text = rows("", &[400.0, 410.0, 420.0]);
    let role = |path| read(Source { path, ..Source::from(&text) }, &ReadOptions::default()).unwrap().role;
    assert_eq!((role("solar-cell/AM1.5G.txt").value, role("AM0.csv").certainty), (Role::Illuminant, Certainty::Guess));
    assert_eq!((role("cam01.txt").value, role("AM012.csv").value), (Role::Unknown, Role::Unknown));
}
