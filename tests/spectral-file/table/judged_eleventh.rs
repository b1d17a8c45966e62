//! What an audit of files that nobody had judged found to be read in silence as what it is not; numbers of our own.

use spectral_file::{Certainty, ReadError, ReadOptions, Role, Values, Warning, WavelengthUnit, read};

use super::{error, lines, names, of_file, ok, samples};

fn warned(text: &str, is: fn(&Warning) -> bool) -> bool {
    ok(text).warnings.iter().any(is)
}

#[test]
fn numbers_in_no_order_are_no_wavelengths() {
    let scattered =
        |columns: &str| lines(|at| format!("{},{},{}{columns}\n", 400 + at * 37 % 101, at * 53 % 97, at * 29 % 89));
    assert!(matches!(error(&scattered("")), ReadError::NoWavelengths(_)));
    assert_eq!(ok(&format!("wavelength,a,b\n{}", scattered(""))).curves.len(), 2);
    // Points picked off a plot.
    let picked = lines(|at| {
        let nm = 400 + at * 37 % 101;
        format!("{nm}.5,0.{nm}\n")
    });
    assert_eq!(ok(&picked).curves.len(), 1);
    assert!(matches!(error("run\nt,x,y\n0.35,1,2\n0.45,2,3\n0.55,4,5\n"), ReadError::NoWavelengths(2)));
}

#[test]
fn integrals_steps_and_sizes_are_said() {
    let sum = lines(|nm| format!("{}.5,{}\n", nm, (nm - 400) * (nm - 400)));
    assert!(warned(&sum, |warning| matches!(warning, Warning::Integral { count: 1, .. })));
    let set = lines(|nm| format!("{nm}.5,{},0.{},0.{}\n", 64 + nm % 2, nm % 83, nm % 79));
    assert!(warned(&set, |warning| matches!(warning, Warning::Stepped { count: 1, .. })));
    let logs = lines(|nm| format!("{nm},-{}.5\n", nm % 7));
    assert!(warned(&logs, |warning| matches!(warning, Warning::BelowZero { .. })));
    let ends = lines(|nm| format!("{nm} {} 0.{}\n", nm + 1, nm % 83));
    assert!(warned(&ends, |warning| matches!(warning, Warning::UpperEnds([2, 1]))));
    let bias = lines(|nm| format!("{nm}.5,0.{},42.{}\n", nm % 83, nm % 3));
    assert!(warned(&format!("nm,cell,bias\n{bias}"), |warning| matches!(warning, Warning::NotSpectra { .. })));
    assert!(warned(&format!("nm,cell,lock\n{bias}"), |warning| matches!(warning, Warning::Stepped { .. })));
    let graded = (0..30).map(|at| format!("{},0.5\n", 400.0 * 1.1_f64.powi(at))).collect::<Vec<_>>().concat();
    assert!(!warned(&graded, |warning| matches!(warning, Warning::Hole { .. })));
}

#[test]
fn minus_one_again_and_again_is_no_value() {
    let text = lines(|nm| if nm % 8 == 0 { format!("{nm},-1\n") } else { format!("{nm},0.{nm}\n") });
    let table = ok(&format!("nm,reflectance\n{text}"));
    assert_eq!(table.curves[0].values.len(), 35);
    // Before the mean of rows at one wavelength.
    let table = ok("nm,reflectance\n400,0.5\n400,-999\n410,0.5\n420,0.6\n430,0.7\n");
    assert_eq!(samples(&table.curves[0])[0], (400.0, 0.5));
}

#[test]
fn tables_side_by_side_keep_their_wavelengths() {
    let text = "wavelength,a,,Wavelength_nm,b\n400,1,,400,5\n405,2,,401,6\n410,3,,402,7\n,,,403,8\n";
    let table = ok(text);
    assert_eq!(samples(&table.curves[0]), [(400.0, 1.0), (405.0, 2.0), (410.0, 3.0)]);
    assert_eq!(samples(&table.curves[1]).len(), 4);
    let paired = ok("wl_x r_x wl_y r_y\n400 1 350 5\n410 2 360 6\n420 3 370 7\n430 4 380 8\n");
    assert_eq!((names(&paired), samples(&paired.curves[1])[0]), (vec!["r_x", "r_y"], (350.0, 5.0)));
}

#[test]
fn bands_of_detectors_overlap() {
    let heads = (0..40).chain(38..80).map(|at| format!(",{}.5", 400 + 10 * at)).collect::<Vec<_>>().concat();
    let rows = format!("class{heads}\nsoil{}\nleaf{}\n", ",0.5".repeat(82), ",0.25".repeat(82));
    let table = ok(&rows);
    assert_eq!((names(&table), table.reading.range_nm), (vec!["soil", "leaf"], [400.5, 1190.5]));
    let second = (0..82).map(|at| format!(",{}.25", 400 + 9 * at)).collect::<Vec<_>>().concat();
    let two = rows.replacen('\n', &format!("\nclass{second}\n"), 1);
    assert!(ok(&two).warnings.iter().any(|warning| matches!(warning, Warning::OtherHeader(2))));
    let octane = format!("octane{heads}\n85.3{}\n88.45{}\n", ",0.5".repeat(82), ",0.25".repeat(82));
    assert_eq!(names(&ok(&octane)), ["octane 85.3", "octane 88.45"]);
}

#[test]
fn units_and_names_in_few_words() {
    let rows = lines(|nm| format!("{nm} 0.5\n"));
    let angstroms = lines(|at| format!("{}.5 0.5\n", 4000 + 10 * at));
    let filter = ok(&format!("# mean wavelength (A): 4200\n{angstroms}"));
    assert_eq!(filter.reading.wavelength_unit.value, WavelengthUnit::Angstrom);
    let energies = (0..40).map(|at| format!("{} 1.5\n", 1.5 + 0.05 * f64::from(at))).collect::<Vec<_>>().concat();
    let table = ok(&format!("# freq(eV) eps\n{energies}"));
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Electronvolt);
    let bands = (1..41).map(|at| format!(",{} ", 380 + 5 * at)).collect::<Vec<_>>().concat();
    let across = ok(&format!("name,380 [nm]{bands}\nleaf,0.5{}\nbark,0.25{}\n", ",0.5".repeat(40), ",0.25".repeat(40)));
    assert_eq!((across.reading.range_nm, across.curves[0].values.len()), ([380.0, 580.0], 41));
    let legend = ok(&format!("# [1] = wavelength (nm)\n# [2] = refractive index of a leaf\n{rows}"));
    assert_eq!(names(&legend), ["refractive index of a leaf"]);
    let bytes =
        " 1-  4 F6.1   0.1nm   Wave   Wavelength\n 6- 10 F5.3   ---  Flux  flux\n12- 16 F5.3  --- e_Flux  its error\n";
    let journal = ok(&format!("{bytes}{}", lines(|at| format!("{}.5 0.5 0.1\n", 4000 + 10 * at))));
    assert_eq!((names(&journal), journal.reading.wavelength_unit.value), (vec!["Flux"], WavelengthUnit::Angstrom));
    assert!(journal.curves[0].uncertainty.is_some());
    let columns = ok(&format!("# columns: wavelength_Angstrom  flam_erg_s_cm2_A (any scale)\n{angstroms}"));
    assert_eq!((names(&columns), columns.role.value), (vec!["flam"], Role::Illuminant));
}

#[test]
fn what_is_only_beside_spectra_is_asked_about() {
    let role = |text: &str| ok(text).role;
    let widths =
        role(&format!("number,center_wavelength,band_width\n{}", lines(|at| format!("{},{at},9.{at}\n", at - 399))));
    assert_eq!((widths.value, widths.certainty), (Role::Unknown, Certainty::Open));
    let logs = role(&format!("nm,L,M,S\n{}", lines(|nm| format!("{nm},-0.5,-1.{nm},-2.5\n"))));
    assert_eq!(logs.certainty, Certainty::Open);
    let model = ok(&format!("nm,Absorbance,model\n{}", lines(|nm| format!("{nm},0.{nm},0.{nm}\n"))));
    assert_eq!((model.reading.values.value, model.reading.values.certainty), (Values::Absorbance, Certainty::Guess));
    let years = (1960..2010).map(|year| format!(",{year}")).collect::<Vec<_>>().concat();
    assert!(
        read(format!("Country{years}\nAruba{}\n", ",500.5".repeat(50)).as_bytes(), &ReadOptions::default()).is_err()
    );
    let places =
        (0..200).map(|at| format!("{} {} {}\n", 2400 + at / 20, 2600 + at, at % 90)).collect::<Vec<_>>().concat();
    assert!(matches!(error(&places), ReadError::NoWavelengths(_)));
}

#[test]
fn rows_at_angles_of_an_ellipsometer() {
    let rows = lines(|nm| format!("{nm}\t65\t45.{nm}\t120.5\t0.01\t0.02\n"));
    let table = ok(&format!("wafer\nVASEmethod[EllipsometerType=4]\nnm\n{rows}"));
    assert_eq!((names(&table), table.role.certainty), (vec!["Psi", "Delta"], Certainty::Open));
    assert!(table.curves.iter().all(|curve| curve.uncertainty.is_some()));
}

#[test]
fn lights_beside_sensitivities_are_asked_about() {
    let rows = lines(|nm| format!("{nm},0.1,0.2,0.3,46\n"));
    assert_eq!(ok(&format!("nm,x_bar,y_bar,z_bar,power\n{rows}")).role.certainty, Certainty::Open);
    assert_eq!(
        ok(&format!("color matching functions\nnm,x bar,y bar,V,CIE D65\n{rows}")).role.certainty,
        Certainty::Open
    );
    let axis = |head: &str| {
        read(format!("{head},a\n{}", lines(|nm| format!("{nm},0.5\n"))).as_bytes(), &ReadOptions::default())
    };
    for head in ["particle_id", "nr", "Binding energy (eV)"] {
        assert!(axis(head).is_err(), "{head}");
    }
}

#[test]
fn words_that_tell_what_curves_are() {
    let rows = lines(|nm| format!("{nm},0.5\n"));
    let absorbance = ok(&format!("nm,A\n{rows}"));
    assert_eq!((absorbance.reading.values.value, absorbance.role.certainty), (Values::Absorbance, Certainty::Guess));
    assert_eq!(of_file("color_matching_functions.csv", &rows).role.value, Role::Camera);
    assert_eq!(ok(&format!("# converted to mW / (m2 nm)\n{}", rows.replace(',', " "))).role.value, Role::Illuminant);
    let ruled = ok(&format!("# lambda [nm]  transmission\n#------\n{}", rows.replace(',', " ")));
    assert_eq!((ruled.role.value, ruled.role.certainty), (Role::Transmittance, Certainty::Certain));
    let filter = lines(|at| format!("{}.5 0.5\n", 4000 + 10 * at));
    assert_eq!(ok(&format!("A normalised\n{filter}")).reading.wavelength_unit.value, WavelengthUnit::Angstrom);
    let sampled = format!("# Starting Wavelength: 4000.5 (Angstroms)\n{filter}");
    assert_eq!(ok(&sampled).reading.wavelength_unit.value, WavelengthUnit::Angstrom);
    let set = lines(|nm| format!("{nm}\t0.{nm}\t0.{}\n", nm % 83));
    assert_eq!(names(&ok(&format!("nm\tEQE\teta\tBias (V):\t0.5\tArea:\t2\n{set}"))), ["EQE", "eta"]);
    let many = read(format!("nm,a,b,c,d,e\n{rows}").as_bytes(), &ReadOptions::default()).unwrap();
    assert!(many.warnings.contains(&Warning::NamesDiffer { names: 6, columns: 2 }));
}
