//! What a sixth judge found misread in public files, on small files of the same make.

use spectral_file::{Certainty, Quantity, ReadOptions, Role, Source, read};

use super::{names, ok};

#[test]
fn a_unit_behind_a_name_is_not_its_name() {
    let rows = "400\t0.5\t0.25\n401\t0.75\t0.5\n402\t0.5\t0.25\n";
    let table = ok(&format!("Wvlgth nm\tEtr W*m-2*nm-1\tGlobal tilt  W*m-2*nm-1\n{rows}"));
    assert_eq!(names(&table), ["Etr", "Global tilt"]);
    assert!(table.curves.iter().all(|curve| curve.unit.as_deref() == Some("W*m-2*nm-1")));
    assert_eq!((table.role.value, table.reading.quantity.value), (Role::Illuminant, Quantity::Irradiance));
    let table = ok("Wavelength (nm),Tilted mW*cm-2*nm-1 (1 sun)\n400,0.5\n401,0.75\n402,0.5\n");
    assert_eq!(table.curves[0].unit.as_deref(), Some("mW*cm-2*nm-1"));
}

#[test]
fn the_name_of_a_baseline_is_not_what_was_measured() {
    let rows = "400,95,400,12\n410,95,410,13\n420,96,420,14\n";
    let table = ok(&format!("Baseline 100%T,,Leaf one,\nWavelength (nm),%R,Wavelength (nm),%R\n{rows}"));
    assert_eq!(names(&table), ["Baseline 100%T", "Leaf one"]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Reflectance, Certainty::Certain));
    assert_eq!(table.reading.quantity.value, Quantity::Reflectance);
}

#[test]
fn fluorescence_is_no_camera_whatever_its_file_is_called() {
    let text = "TITLE,dye\nDATA TYPE,FLUORESCENCE SPECTRUM\nXUNITS,NANOMETERS\nYUNITS,INTENSITY\nXYDATA\n\
        400,8.5\n401,9.5\n402,7.5\n";
    let source = Source { bytes: text.as_bytes(), path: "dye-Response-0.5sec.csv", ..Source::default() };
    let table = read(source, &ReadOptions::default()).unwrap();
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn an_empty_column_says_nothing_of_those_beside_it() {
    let rows = "400\t1e-9\tNaN\n410\t2e-9\tNaN\n420\t3e-9\tNaN\n";
    let table = ok(&format!("Wavelength (nm)\tCell Current (A)\tCell EQE\n{rows}"));
    assert_eq!(names(&table), ["Cell Current (A)"]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn either_of_two_quantities_is_asked_for() {
    let table = ok("wavelength (nm),EQE (or reflectance)\n400,0.5\n410,0.75\n420,0.5\n");
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
    let table = ok("wavelength (nm),absolute or relative EQE\n400,0.5\n410,0.75\n420,0.5\n");
    assert_ne!(table.role.value, Role::Unknown);
}

/// As digitizers of plots write: names above their x, and x and y below.
#[test]
fn names_stand_above_x_and_y() {
    let rows = "400,0.1,401,0.2,402,0.7\n450,0.2,451,0.6,452,0.9\n500,0.5,501,0.9,502,0.3\n600,0.9,601,0.3,,\n";
    let table = ok(&format!("Red,,Green,,Blue,\nX,Y,X,Y,X,Y\n{rows}"));
    assert_eq!(names(&table), ["Red", "Green", "Blue"]);
    assert_eq!((table.role.value, table.role.certainty), (Role::Camera, Certainty::Guess));
    assert!(table.curves.iter().all(|curve| curve.unit.is_none()));
    let samples: Vec<usize> = table.curves.iter().map(|curve| curve.wavelengths_nm.len() - curve.missing).collect();
    assert_eq!(samples, [4, 4, 3]);
}

#[test]
fn numbered_x_and_y_are_pairs() {
    let table = ok("x1,y1,x2,y2\n400,0.1,401,0.2\n450,0.2,451,0.6\n500,0.5,501,0.9\n550,0.4,551,0.8\n");
    assert_eq!(names(&table), ["y1", "y2"]);
}

#[test]
fn intensities_of_red_green_and_blue_are_asked_for() {
    let rows = "1,400,0.5,1.5,2.5\n2,450,1.5,0.5,0.5\n3,500,1.5,2.5,0.5\n";
    let table = ok(&format!("Pixel,Wavelength,Red Intensity,Green Intensity,Blue Intensity\n{rows}"));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn the_phase_of_an_amplifier_is_no_spectrum() {
    let rows = "400\t0.5\t117.8\n410\t0.6\t-149.7\n420\t0.7\t12.5\n";
    let table = ok(&format!("Wavelength (nm)\tSignal\tTheta Device (lock-in)\n{rows}"));
    assert_eq!(names(&table), ["Signal"]);
}

#[test]
fn minerals_of_rruff_are_over_no_wavelengths() {
    let text = "##NAMES=Quartz\n##URL=rruff.info/R040031\n150.5, 10.5\n151.5, 12.5\n152.5, 11.5\n##END=\n";
    let error = read(text.as_bytes(), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().starts_with("line 2: the header gives neither wavelengths"), "{error}");
}

#[test]
fn wavelengths_in_meters() {
    let table = ok("% lam[m] S\n380e-9 0.50\n390e-9 0.55\n400e-9 0.83\n");
    assert_eq!(table.curves[0].wavelengths_nm, [380.0, 390.0, 400.0]);
    assert_eq!(table.reading.wavelength_unit.certainty, Certainty::Guess);
    let table = ok("wavelength (m),reflectance\n3.8e-07,0.50\n3.9e-07,0.55\n4.0e-07,0.83\n");
    assert_eq!(table.curves[0].wavelengths_nm, [380.0, 390.0, 400.0]);
    assert_eq!(table.reading.wavelength_unit.certainty, Certainty::Certain);
}

#[test]
fn wavelengths_in_brackets_behind_what_was_measured() {
    let heads = ["400", "410", "420", "430", "440", "450"].map(|nm| format!("R({nm})")).join(",");
    let table = ok(&format!("name,{heads}\nfirst,0.5,0.5,0.5,0.5,0.6,0.6\nsecond,0.52,0.54,0.55,0.56,0.6,0.6\n"));
    assert_eq!(names(&table), ["first", "second"]);
    assert!(table.curves.iter().all(|curve| curve.unit.is_none()));
    let table = ok(&format!("name,{}\nfirst,53.5,55.5,56,57,58,59\n", heads.replace('R', "Ed")));
    assert_eq!((names(&table), table.curves[0].wavelengths_nm[5]), (vec!["first"], 450.0));
}

#[test]
fn signs_of_units_in_a_code_page_of_dos() {
    let text = b"Mode/Unit-->,Irradiance[\xe6Watt/cm\xfd]\nWavelength[nm],lamp\n400.1,9.2\n401.2,9.9\n402.3,11.5\n";
    let table = read(text.as_slice(), &ReadOptions::default()).unwrap();
    assert_eq!(table.curves[0].unit.as_deref(), Some("µWatt/cm²"));
}

#[test]
fn the_gain_behind_each_value_is_no_spectrum() {
    let head =
        "[Header]\nMeasurement Type\tIrradiance\nUnits\t(W/m^2nm)\n[Designation]\nLine0\tlamp, 1 m\n[Start Data]\n";
    let table = ok(&format!("{head}400.0\t1.1e-3\t-6\n410.0\t1.3e-3\t-6\n420.0\t1.7e-3\t-5\n"));
    assert_eq!(names(&table), ["lamp, 1 m"]);
}

#[test]
fn the_path_of_a_file_does_not_say_what_was_measured() {
    let head = "Text conversion of header file C:\\d\\reflec_00125.asd\nData is not compared to a white reference\n\n";
    let table = ok(&format!("{head}Wavelength\treflec_00125.asd\n400\t2310.5\n401\t2322.5\n402\t2333.1\n"));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Guess));
}

#[test]
fn an_index_names_each_of_its_columns() {
    let values = r#""400":[0.0143,0.0004,0.0679],"410":[0.0435,0.0012,0.2074]"#;
    let data = format!(r#"{{"units":"relative","index":{{"main":["X","Y","Z"]}},"data":{{"main":{{{values}}}}}}}"#);
    let table = ok(&format!(r#"{{"header":{{"schema_version":"1.0.0","type":"cie-1931"}},"spectral_data":{data}}}"#));
    assert_eq!(names(&table), ["X", "Y", "Z"]);
}

#[test]
fn a_last_few_rows_in_the_far_infrared_are_no_other_unit() {
    let rows: Vec<String> = (0..20).map(|at| format!("{} 0.05", 320 + 1200 * at)).collect();
    let table = ok(&format!("{}\n25050.2 0.16\n", rows.join("\n")));
    assert_eq!(table.curves[0].wavelengths_nm.len(), 20);
}

#[test]
fn a_correction_is_no_light() {
    let rows = "400,29.0\n410,25.8\n420,22.7\n";
    let table = ok(&format!("My emission correction curve,\nWavelength (nm),Intensity (a.u.)\n{rows}"));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn names_of_ocean_view_enlighten_and_spectra_pen() {
    let table =
        ok("Data from leaf_top.txt Node\n\n>>>>>Begin Spectral Data<<<<<\n400.1\t8.1\n400.6\t8.2\n401.1\t8.3\n");
    assert_eq!(names(&table), ["leaf_top"]);
    let rows = "400.33,1196.00,1133.00\n400.61,1196.00,1141.00\n400.89,1184.00,1148.00\n";
    let table = ok(&format!("Label,one,two\n\nWP-00413,one,two\nWavelength,Processed,Processed\n{rows}"));
    assert_eq!(names(&table), ["one", "two"]);
    let rows = "400.1,3.73,3.71\n402,3.55,3.25\n403.8,3.25,2.98\n";
    let table = ok(&format!("Irradiance [W/m2/nm],\n\nIndex,13,14,\nName,leafA,leafB,\nGPS,,,\n[nm],\n{rows}"));
    assert_eq!(names(&table), ["leafA", "leafB"]);
}

#[test]
fn humidity_is_no_id() {
    let rows = "2012-01-01T01:00,17.7,75.2,1,2,3,4,5,6\n2012-01-01T02:00,16.1,75.2,2,3,4,5,6,7\n";
    let table = ok(&format!("datetime,temp,relativehumidity,400,450,500,550,600,650\n{rows}"));
    assert_eq!(names(&table), ["2012-01-01T01:00", "2012-01-01T02:00"]);
}
