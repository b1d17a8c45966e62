//! What a fourth judge found misread in public files, on small files of the same make.

use spectral_file::{ReadError, Role, Values};

use super::{error, names, ok, samples};

#[test]
fn a_date_above_two_columns_names_no_curve() {
    let table = ok("2019,3,14,10,6,0\n400.5,1500.2\n401.0,1502.4\n401.5,1503.1\n402.0,1501.9\n");
    assert_eq!(names(&table), ["Column 2"]);
    assert_eq!(samples(&table.curves[0])[0], (400.5, 1500.2));
    // Numbers that are as many as the columns name curves.
    assert_eq!(names(&ok("nm,10,20\n400,0.1,0.2\n410,0.2,0.3\n420,0.3,0.4\n")), ["10", "20"]);
}

#[test]
fn units_with_exponents_stand_below_the_names() {
    let table = ok("wavelength,Spectral Irradiance\nnm,W*m-2*nm-1\n400,1.1\n410,1.2\n420,1.3\n");
    assert_eq!(names(&table), ["Spectral Irradiance"]);
    assert_eq!(table.curves[0].unit.as_deref(), Some("W*m-2*nm-1"));
    assert_eq!(table.role.value, Role::Illuminant);
}

#[test]
fn currents_beside_an_efficiency_are_no_curves() {
    let rows = "400\t0.41\t1.4E-11\t0.001\t0.9\n410\t0.42\t1.2E-11\t0.001\t0.8\n420\t0.43\t1.6E-11\t0.001\t0.7\n";
    let head = "Wavelength (nm)\tEQE\tDevice Current (A)\tPhotodiode Current (A)\tCalibration\n";
    assert_eq!(names(&ok(&format!("{head}{rows}"))), ["EQE"]);
    // Alone, they are what was measured.
    let only = ok("Wavelength (nm)\tPhotocurrent (A)\n400\t1.4E-11\n410\t1.2E-11\n420\t1.6E-11\n");
    assert_eq!(only.curves.len(), 1);
}

#[test]
fn the_logarithm_of_a_reflectance_is_left_out_beside_it() {
    let head = "Columns [5]:\nData:\nWvl\tRad. (Ref.)\tRad. (Target)\t-log Reflect.\tReflect. [1.0]\n";
    let rows =
        "400.5\t0.2\t0.1\t0.30103\t0.50000\n402.1\t0.2\t0.05\t0.60206\t0.25000\n403.7\t0.2\t0.02\t1.00000\t0.10000\n";
    let table = ok(&format!("{head}{rows}"));
    assert_eq!(names(&table), ["Reflect. [1.0]"]);
    assert_eq!(table.reading.values.value, Values::Plain);
    assert_eq!(samples(&table.curves[0])[0], (400.5, 0.5));
}

#[test]
fn a_log_below_the_table_may_go_on_with_numbers() {
    let log = ",,\n,, Old:0.0125\n,, Old:0\n,,352\n,, Old:0.0125\n,,350\n";
    let table = ok(&format!("Wavelength (nm),30 s,60 s\n400,0.12,0.22\n401,0.13,0.23\n402,0.14,0.24\n{log}"));
    assert_eq!(names(&table), ["30 s", "60 s"]);
    assert_eq!(samples(&table.curves[1]), [(400.0, 0.22), (401.0, 0.23), (402.0, 0.24)]);
    // A row below it is one of this table or another, which only the user knows.
    let torn = "Wavelength (nm),a,b\n400,0.12,0.22\n401,0.13,0.23\n402,0.14,0.24\n,, Old:0\n,,352\n403,0.15,0.25\n";
    assert!(matches!(error(torn), ReadError::NotANumber { line: 5, .. }));
}

#[test]
fn cells_in_quotes_may_go_on_over_many_lines() {
    let head: Vec<String> = (1..=12).map(|number| format!("\"\t\nleaf {number}\"")).collect();
    let row = |nm: u32| format!("{nm},{}", (1..=12).map(|n| format!("0.{}", 10 + n)).collect::<Vec<_>>().join(","));
    let table = ok(&format!("Wavelength,{}\n{}\n{}\n{}\n", head.join(","), row(400), row(410), row(420)));
    assert_eq!(names(&table)[..2], ["leaf 1", "leaf 2"]);
    assert_eq!(names(&table).len(), 12);
}
