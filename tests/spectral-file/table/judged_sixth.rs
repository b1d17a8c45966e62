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
