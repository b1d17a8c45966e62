//! What judges of real files found, an eighth time: heads beside their columns, settings that name samples, and files of `LabSpec`,
//! Thorlabs, Orange and spectrophotometers of colors.

use spectral_file::{Certainty, ReadError, ReadOptions, Role, Source, Values, WavelengthUnit, read};

use super::{error, names, ok, rows};

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

#[test]
fn units_below_an_amount_are_none_of_light() {
    let head = "Label 1:\tWavelength\t[nm]\nLabel 2:\tsrel\t[mA W^-1 m²]\nLabel 3:\tU\t[mAW^-1m²]\n**Data**\n";
    let rows = (40..60).map(|nm| format!("{nm}0\t0.{nm}\t0.00{nm}\n")).collect::<Vec<_>>().concat();
    let table = ok(&(head.to_owned() + &rows));
    assert_eq!((table.role.value, table.curves.len()), (Role::Unknown, 1));
    assert!(table.curves[0].uncertainty.is_some());
    let rows = (40..60).map(|nm| format!("{nm}0 1.{nm} 0.{nm} 7\n")).collect::<Vec<_>>().concat();
    let table = ok(&format!("# wavelength(nm) ergs/cm2/s/A*10**-16 milli-Jy bandpass\n{rows}"));
    // 10^-16 erg/s/cm²/Å are 10^-22 W/cm²/nm.
    assert!((table.curves[0].values[0] / 1.4e-22 - 1.0).abs() < 1e-12, "{}", table.curves[0].values[0]);
    assert_eq!((table.curves.len(), table.role.certainty), (2, Certainty::Guess));
}

#[test]
fn one_column_does_not_speak_for_all() {
    let rows = (40..60).map(|nm| format!("{nm}0 0.{nm} 0.{nm}\n")).collect::<Vec<_>>().concat();
    let table = ok(&format!("Wavelength(nm) Reflectioncoefficient Absorbptioncoefficient\n{rows}"));
    assert_eq!((table.role.value, table.role.certainty), (Role::Reflectance, Certainty::Guess));
    assert_eq!(table.reading.quantity.certainty, Certainty::Guess);
}

#[test]
fn wave_numbers_in_nanometers_contradict_themselves() {
    let refused = error("Sample/Wavenumber (nm);14730.8;14403.5;12000.5;10000.5;8000.5\nA;0.1;0.2;0.3;0.4;0.5\n");
    assert!(matches!(refused, ReadError::AmbiguousUnit { .. }), "{refused}");
}

#[test]
fn errors_to_one_side_are_no_curves() {
    let rows = (40..60).map(|nm| format!("{nm}0,0.{nm},0.01,0.02\n")).collect::<Vec<_>>().concat();
    let table = ok(&format!("#wavelength (nm), ratio (rr), error of rr (+), error of rr (-)\n{rows}"));
    assert_eq!(names(&table), ["ratio (rr)"]);
    assert_eq!(table.warnings.len(), 2);
}

#[test]
fn heads_as_r_and_pandas_write_them() {
    let row = |name: &str| format!("{name},0.1,0.2,0.3,0.4,0.5\n");
    let x: String = "\"Wavelength\",\"X350\",\"X351\",\"X352\",\"X353\",\"X600\"\n".into();
    let table = ok(&(x + &row("\"A.asd\"") + &row("\"B.asd\"")));
    assert_eq!((names(&table)[0], table.curves[0].wavelengths_nm[0]), ("A.asd", 350.0));
    let short: String =
        "\"octane\",\"NIR.900 nm\",\"NIR.902 nm\",\"NIR.904 nm\",\"NIR.906 nm\",\"NIR.908 nm\"\n".into();
    let table = ok(&(short + &row("\"1\",85.3") + &row("\"2\",85.25")));
    assert_eq!((table.curves.len(), table.curves[1].values[0]), (2, 0.1));
    let counted =
        (0..20).map(|at| format!("{at},{}.5,1{at},2{at},3{at},4{at},5{at}\n", 901 + at)).collect::<Vec<_>>().concat();
    let table = ok(&format!(",Wavelength (nm),0,1,2,3,4\n{counted}"));
    assert_eq!((names(&table), table.curves[0].wavelengths_nm[0]), (vec!["0", "1", "2", "3", "4"], 901.5));
}

#[test]
fn units_in_brackets_head_a_table() {
    let rows = (40..60)
        .map(|nm| format!("{nm}00.5 1.{nm}e-15 {}\n", 2.997_924_58e18 / f64::from(nm * 100)))
        .collect::<Vec<_>>()
        .concat();
    let table = ok(&format!("# [Angstrom] [erg/cm^2/s/A] | [Hz]\n{rows}"));
    assert_eq!((table.curves.len(), table.curves[0].wavelengths_nm[0]), (1, 400.05));
}

#[test]
fn numbers_of_settings_are_no_rows() {
    let rows = (60..80).map(|nm| format!("{nm}0\t0.00\t1.{nm}\t2.49\n")).collect::<Vec<_>>().concat();
    let head = "[VERSION]\n0.1\n[CALDATE]\n2022\n# wavelength (nm)\tbandwidth (nm)\tirradiance (mW/m2/nm)\tuncertainty (%, k=2)\n";
    let table = ok(&format!("{head}[LAMPDATA]\n{rows}[END_OF_LAMPDATA]\n"));
    assert_eq!((table.curves.len(), table.curves[0].values.len()), (1, 20));
    assert!(table.curves[0].uncertainty.is_some());
}

#[test]
fn names_too_many_for_all_rows_name_none() {
    let rows = (28..48).map(|nm| format!("{nm}0.0,8.2E-02,4.7E-{nm}\n")).collect::<Vec<_>>().concat();
    let table = ok(&format!("Wavelength nm,Photon,Energy,Etr,Global\n{rows}"));
    assert_eq!(names(&table), ["Column 2", "Column 3"]);
}

#[test]
fn groups_complete_names_that_repeat() {
    let rows = (40..60).map(|nm| format!("{nm}0,0.1,0.2,0.3,0.{nm}\n")).collect::<Vec<_>>().concat();
    let table = ok(&format!("skin,2017,,,\n,Subject 1,,Subject 2,\nWavelength (nm),R1,R2,R1,R2\n{rows}"));
    assert_eq!(names(&table), ["Subject 1 R1", "Subject 1 R2", "Subject 2 R1", "Subject 2 R2"]);
}

#[test]
fn a_sparse_curve_may_stand_beside_a_remark() {
    let rows = (31..51).map(|nm| format!(",,{nm}0,1.{nm}e-6,0.{nm},,\n")).collect::<Vec<_>>().concat();
    let head =
        "\"λ,n (nm)\",n,\"λ,k (nm)\",k,α (cm⁻¹),Reference,Details\n300,1.5,300,2.4e-6,0.99,'unpublished',glass\n";
    let table = ok(&format!("{head}2000,1.5,305,1.7e-6,0.69,,\n{rows}"));
    assert_eq!(names(&table), ["n", "k", "α (cm⁻¹)"]);
    assert_eq!((table.curves[0].values.len(), table.curves[1].values.len()), (2, 22));
}

#[test]
fn decibels_alone_are_no_light() {
    let table = ok(&format!("Wavelength (nm),Rx (dB)\n{}", rows(",").replace(",0.", ",-1.")));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn what_a_tenth_judge_found() {
    let table = ok(&format!("lambda,abs_bg\n{}", rows(",")));
    assert_eq!((table.reading.values.value, table.reading.values.certainty), (Values::Absorbance, Certainty::Guess));
    assert_eq!(names(&ok(&format!(",X,Y,Z\n{}", rows(",").replace('\n', ",0.1,0.2\n")))), ["X", "Y", "Z"]);
    let tidy = (40..60).map(|nm| format!("1,dorsal,{nm}0,4.{nm}\n")).collect::<Vec<_>>().concat();
    assert_eq!(ok(&format!("Sample,Color,wl,spectra\n{tidy}")).curves[0].values.len(), 20);
    assert!(matches!(error("Concentracion,Absorbancia\n0.1,0.05\n0.2,0.1\n0.3,0.15\n"), ReadError::NoWavelengths(1)));
    let text = "octane,900,902,904,906,908\n85.3,0.1,0.2,0.3,0.4,0.5\n";
    let in_folder = |path| read(Source { path, ..Source::from(text) }, &ReadOptions::default());
    assert!(in_folder("NIR-and-Raman/gasoline.csv").is_ok() && in_folder("Raman/gasoline.csv").is_err());
}

#[test]
fn noise_and_energies_and_even_wave_numbers() {
    let rows =
        |number: &dyn Fn(i32) -> f64| (0..40).map(|at| format!("{},1.5\n", number(at))).collect::<Vec<_>>().concat();
    let energies = error(&rows(&|at| 1240.0 / f64::from(700 - 10 * at)));
    assert!(matches!(energies, ReadError::AmbiguousEnergies { .. }), "{energies}");
    let even = ok(&format!("a,b\n{}", rows(&|at| 400.25 + 96.43 * f64::from(at))));
    assert_eq!(even.reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
    let noise = (40..60).map(|nm| format!("{nm}0,0.{nm},0.01\n")).collect::<Vec<_>>().concat();
    assert_eq!(names(&ok(&format!("wavelength,flux,noise\n{noise}"))).len(), 1);
    let times =
        "Date,2023/10/06,2023/10/06\nTime,09:00,09:02\nWavelength(nm),Irradiance(W/m2/um),Irradiance(W/m2/um)\n";
    assert_eq!(names(&ok(&format!("{times}{noise}"))), ["2023/10/06 09:00", "2023/10/06 09:02"]);
}
