//! What a third judge found misread in public files, on small files of the same make.

use spectral_file::{Certainty, ReadError, Role, WavelengthUnit};

use super::{error, names, ok, samples};

#[test]
fn wavelengths_beside_raman_shifts_are_in_their_own_unit() {
    let settings = "Technique,Raman\nWavenumber Correction,0\nLaser Wavelength,785.0\n\n";
    let rows = "0,799.8,235.7,1\n1,800.4,245.5,2\n2,801.0,254.0,3\n3,801.6,263.4,2\n";
    let table = ok(&format!("{settings}Pixel,Wavelength,Wavenumber,Processed\n{rows}"));
    assert_eq!(names(&table), ["Processed"]);
    assert_eq!(samples(&table.curves[0])[0], (799.8, 1.0));
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Nanometer);
}

#[test]
fn wave_numbers_of_a_raman_spectrum_are_shifts() {
    for (head, line) in
        [("DATA TYPE\tRAMAN SPECTRUM\nXUNITS\t1/CM\nXYDATA", 2), ("# Raman of quartz\nwavenumber (cm-1)\tI", 2)]
    {
        assert_eq!(
            error(&format!("{head}\n500.5\t10\n501.5\t20\n502.5\t30\n")),
            ReadError::NotWavelengths(line),
            "{head}"
        );
    }
    let infrared = ok("DATA TYPE\tINFRARED SPECTRUM\nXUNITS\t1/CM\nXYDATA\n500\t10\n501\t20\n502\t30\n");
    assert_eq!(infrared.reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
}

#[test]
fn one_power_among_many_columns_names_no_light() {
    let row = |nm: u32, value: f64| format!("{nm},{value},1,{value},1,{value},{value}\n");
    let rows = row(400, 0.5) + &row(410, 0.75) + &row(420, 0.25);
    let table = ok(&format!("wavelength,k a,s a,k b,s b,k c,power\n{rows}"));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn wavelengths_of_emission_are_those_of_the_column_behind_them() {
    let table = ok("Absorption wavelength (nm),dye absorption,emission wavelength (nm),dye signal\n\
                    300,1,600,0.25\n301,0.9,601,0.5\n302,0.8,602,0.75\n303,0.7,,\n");
    assert_eq!(names(&table), ["dye absorption", "dye signal"]);
    assert_eq!(samples(&table.curves[1]), [(600.0, 0.25), (601.0, 0.5), (602.0, 0.75)]);
}

#[test]
fn names_that_are_none_and_names_that_are_numbers() {
    let counted = ok("nm  mean  sd n=3\n400 8.5 0.25\n420 7.5 0.5\n440 3.5 0.25\n");
    assert_eq!((counted.curves.len(), counted.curves[0].uncertainty.is_some()), (1, true));
    let yaml = ok("  - type: tabulated k\n    data: |\n        0.31 0.5\n        0.32 0.25\n        0.33 0.125\n");
    assert!(!yaml.curves[0].named);
    let memo = ok(
        "Sample, leaf\nLamp, 255\nmemo, \nWL(nm), Abs, T%\n390.0, 0.30, 50.12\n391.0, 0.31, 48.98\n392.0, 0.32, 47.86\n",
    );
    assert!(!names(&memo).contains(&"memo"), "{:?}", names(&memo));
    let marked = ok("#Wave\t#leaf\t#bark\n483.5\t623.5\t1\n482.5\t619.5\t2\n481.5\t610.5\t3\n");
    assert_eq!(names(&marked), ["leaf", "bark"]);
    let excitation = ok(",230,235,240\n300,5,6,7\n304,6,7,8\n308,7,9,9\n312,8,6,2\n");
    assert_eq!(names(&excitation), ["230", "235", "240"]);
    let described =
        ok("# Made by hand\n# Column 1: Wavelength nm\n# Column 2: leaf reflectance\n400 0.5\n401 0.25\n402 0.75\n");
    assert_eq!((names(&described), described.role.value), (vec!["leaf reflectance"], Role::Reflectance));
    assert_eq!(described.reading.wavelength_unit.certainty, Certainty::Certain);
    let shifted =
        ok("# Column 1: Rest wavelength (Angstrom)\n# Column 2: flux\n# Column 3: Observed wavelength (Angstrom)\n\
                      4000 0.5 400000\n4010 0.25 401000\n4020 0.75 402000\n");
    assert_eq!((names(&shifted), shifted.curves[0].wavelengths_nm[0]), (vec!["flux"], 400.0));
}

#[test]
fn times_and_temperatures_are_no_wavelengths() {
    let rows = "0.5,10,20\n1.5,11,21\n2.5,12,22\n3.5,13,23\n";
    for head in
        ["# Time, GEG, RMSE\n# s,1,1", "seconds,oxygen,light", "Elapsed (min),a,b", "T(K),V (cm3),W\n,gypsum,ice"]
    {
        assert!(matches!(error(&format!("{head}\n{rows}")), ReadError::NoWavelengths(_)), "{head}");
    }
    assert!(matches!(error("T, K\t broad, cm3/s\n300\t2\n350\t3\n400\t4\n"), ReadError::NoWavelengths(_)));
}

#[test]
fn a_list_named_at_its_first_wavelength_keeps_it() {
    let head = "time ms lambda=400.5 404.8 409.1 413.4 417.7 422.0";
    let table = ok(&format!("{head}\n1 10 0.11 0.12 0.13 0.14 0.15 0.16\n2 20 0.21 0.22 0.23 0.24 0.25 0.26\n"));
    assert_eq!(samples(&table.curves[0])[0], (400.5, 0.11));
    assert_eq!(table.curves.len(), 2);
}

#[test]
fn a_range_that_is_infrared_in_nanometers_and_seen_in_angstroms_is_asked_for() {
    let rows: Vec<String> = (0..24).map(|i| format!("{} 0.{}", 1150 + 1000 * i, i + 10)).collect();
    assert!(matches!(error(&format!("#lk f\n{}\n", rows.join("\n"))), ReadError::AmbiguousUnit { .. }));
}
