//! What an independent judge found misread in public files of uncertainties, of wavelengths in several columns, and of units, on small files
//! of the same make.

use spectral_file::{Certainty, Quantity, Role, Values};

use super::{names, ok, samples};

/// Checks the names of a table, and the coverage factor and first standard uncertainty of its first curve.
#[track_caller]
fn uncertain(text: &str, curves: &[&str], k: f64, first: f64) {
    let table = ok(text);
    assert_eq!(names(&table), curves, "{text}");
    let stated = table.curves[0].uncertainty.as_ref().expect(text);
    assert_eq!(stated.coverage, k, "{text}");
    assert!((stated.standard[0] / first - 1.0).abs() < 1e-9, "{} of {text}", stated.standard[0]);
}

#[test]
fn calibrations_have_one_curve_with_its_uncertainty() {
    // Absolute and relative: the absolute one is kept, and the other said.
    let laboratory =
        "lambda(nm),E(W m^-2 nm^-1),Urel(%),U(W m^-2 nm^-1)\n250,0.0002,2,0.000004\n255,0.0003,1,0.000003\n";
    uncertain(laboratory, &["E"], 2.0, 0.000_002);
    assert!(ok(laboratory).warnings.iter().any(|warning| warning.to_string().contains("Urel")));
    uncertain("lambda(nm),E(W m^-2 nm^-1),Urel(%)\n250,0.0002,2\n255,0.0003,1\n", &["E"], 2.0, 0.000_002);
    // The head is a comment that other signs separate, with the key of a section below it.
    let lamp = "# wavelength (nm)\tbandwidth (nm)\tirradiane (mW/m2/nm)\tuncertainty (%, k=2)\n[LAMPDATA]\n\
                300.00 0.00 2.0 2.0\n310.00 0.00 3.0 1.0\n320.00 0.00 4.0 1.0\n";
    uncertain(lamp, &["irradiane"], 2.0, 0.02);
    let lamp =
        "# lamp\n# Wavelength, irradiance, one sigma uncertainty in percent\n300 2.0 1.0\n310 3.0 1.0\n320 4.0 1.0\n";
    uncertain(lamp, &["irradiance"], 1.0, 0.02);
    let panel =
        "# wavelength (nm), 8 degree reflectance, two sigma uncertainty\n300 0.9 0.004\n310 0.8 0.004\n320 0.7 0.004\n";
    uncertain(panel, &["8 degree reflectance"], 2.0, 0.002);
    // The error of one column of two, in percent, below names that wide gaps separate.
    let scan = "Wavelength (nm)    Photocurrent (nA)   Error (%)           Uncorrected (nA)\n\
                400.02 4.0 0.5 2.4\n409.97 5.1 0.1 3.2\n420 6.2 0.1 4.1\n";
    uncertain(scan, &["Photocurrent (nA)", "Uncorrected (nA)"], 1.0, 0.02);
    let counted = "microns reflec sigma imgs\n0.4350 0.7756 0.0116 1\n0.4375 0.7901 0.0103 1\n0.4400 0.7805 0.0092 2\n";
    uncertain(counted, &["reflec"], 1.0, 0.0116);
    // The wavelengths stand last, and the deviation is that of the mean.
    let summary = "mean,max,min,stdev,Wvl\n2.6,2.9,2.1,0.3,348\n2.4,2.8,2.0,0.3,353\n2.2,2.6,1.9,0.3,358\n";
    uncertain(summary, &["mean", "max", "min"], 1.0, 0.3);
}

#[test]
fn blocks_side_by_side_have_wavelengths_of_their_own() {
    let row = |nm: u32| format!("{nm}\t4.9\t1.3\t0.27\t{}\t1.0\t0.02\t0.02\n", nm + 100);
    let text = format!(
        "R780\tAVE\tstd\tstd/ave\tR780\tAVE\tstd\tstd/ave\n{}",
        (0..5).map(|at| row(650 + 10 * at)).collect::<String>()
    );
    uncertain(&text, &["AVE", "AVE"], 1.0, 1.3);
    assert_eq!(samples(&ok(&text).curves[1])[0], (750.0, 1.0));
    // Columns of wavelengths that begin with gaps, or repeat one, pair as the others do.
    let pairs = ok(
        "wl_22c,k_22c,wl_minus8c,k_minus8c,wl_20c,k_20c,Index\n660,1,,,650.5,7,0\n670,2,700,4,655.5,8,1\n680,3,710,5,655.5,8,2\n\
                    690,3,720,6,660.5,9,3\n",
    );
    assert_eq!(names(&pairs), ["k_22c", "k_minus8c", "k_20c"]);
    assert_eq!(samples(&pairs.curves[1]), [(700.0, 4.0), (710.0, 5.0), (720.0, 6.0)]);
}

#[test]
fn units_that_do_not_parse_convert_nothing() {
    let rows = "300 2.0\n310 3.0\n320 4.0\n";
    let misspelt = ok(&format!("# Wavelength(nm)  Flambda(ergs/cm^s/s/nm)\n{rows}"));
    assert_eq!((samples(&misspelt.curves[0])[0], misspelt.role.certainty), ((300.0, 2.0), Certainty::Open));
    let right = ok(&format!("# Wavelength(nm)  Flambda(ergs/cm^2/s/nm)\n{rows}"));
    assert_eq!((right.curves[0].values[0], right.curves[0].unit.as_deref()), (2e-7, Some("W/cm²/nm")));
    for (unit, quantity) in [("W/(sr*sqm*nm)", Quantity::Radiance), ("W/sm/nm", Quantity::Irradiance)] {
        assert_eq!(ok(&format!("nm,Le [{unit}]\n400,1\n410,2\n420,3\n")).reading.quantity.value, quantity, "{unit}");
    }
    let length = ok(&format!("Lambda(nm) \t Abs length (um)\n{}", rows.replace(' ', " \t ")));
    assert_eq!((names(&length), length.curves[0].values[0]), (vec!["Abs length (um)"], 2.0));
    assert_eq!(ok("nm,Abs leaf\n400,1\n410,2\n420,3\n").reading.values.value, Values::Absorbance);
    for said in ["#  \"lambda\" is in Angstroms", "# wavelength in AA"] {
        assert_eq!(samples(&ok(&format!("{said}\n1340 1\n1350 2\n1360 3\n")).curves[0])[0], (134.0, 1.0));
    }
}

#[test]
fn names_stand_in_heads_of_other_makes() {
    let marked = ok("%Wavelength, Tomato,  Leaf\n0.379 0.04 0.2\n0.380 0.05 0.3\n0.381 0.06 0.4\n");
    assert_eq!((names(&marked), marked.curves[0].values[0]), (vec!["Tomato", "Leaf"], 0.04));
    let ocean = ok("/begin_header\n/missing=-999\n/delimiter=space\n!\n/fields=wavelength,Es,Lt\n\
                    /units=nm,uW/cm^2/nm,uW/cm^2/nm/sr\n/end_header\n380 1.0 2.0\n381 1.1 2.1\n382 1.2 2.2\n");
    assert_eq!((names(&ocean), ocean.curves[0].unit.as_deref()), (vec!["Es", "Lt"], Some("uW/cm^2/nm")));
    assert_eq!(ocean.reading.wavelength_unit.certainty, Certainty::Certain);
    let above = ok(",S-,S+\nWavelength [nm],Ee [W/(sqm*nm)],Ee [W/(sqm*nm)]\n380,0.1,0.2\n390,0.2,0.3\n400,0.3,0.4\n");
    assert_eq!(names(&above), ["S-", "S+"]);
    let ruled = ok("# Wavelength [um]  Relative response\n# _________ __________\n0.35 0.1\n0.36 0.2\n0.37 0.3\n");
    assert_eq!(names(&ruled), ["Relative response"]);
    // Light that was recorded beside the reflectance.
    let beside = ok("Wavelength(nm)  Radiance(W/sr/m2/nm)  Reflectance\n350 1.2 0.05\n351 1.3 0.06\n352 1.4 0.07\n");
    assert_eq!((beside.curves.len(), beside.curves[0].values[0], beside.role.value), (1, 0.05, Role::Reflectance));
}

#[test]
fn units_right_behind_names_quantum_efficiencies_and_missing_values() {
    let rows = "400,10.1,0.1\n410,11.1,0.2\n420,12.1,0.3\n";
    uncertain(&format!("nm,mua[cm-1],mua_std[cm-1]\n{rows}"), &["mua[cm-1]"], 1.0, 0.1);
    for unit in ["A / W", "A/W"] {
        let table = ok(&format!("wavelength [nm],red [{unit}],blue [{unit}]\n{rows}"));
        assert_ne!(table.role.value, Role::Illuminant, "{unit}");
    }
    assert_eq!(ok("nm,EQE(%)\n400,10\n410,11\n420,12\n").reading.quantity.value, Quantity::QuantumEfficiency);
    let gaps = ok("nm,leaf reflectance\n400,0.1\n410,-9.999\n420,0.3\n430,0.4\n");
    assert_eq!(gaps.curves[0].values, [0.1, 0.3, 0.4]);
    let ends = "##TITLE=x\n##DATA TYPE=UV/VIS SPECTRUM\n##XUNITS=NANOMETERS\n##YUNITS=TRANSMITTANCE\n\
                ##XYDATA=(XY..XY)\n400 0.1\n410 0.2\n420 0.3\n##END\n";
    assert_eq!(ok(ends).curves[0].values.len(), 3);
}
