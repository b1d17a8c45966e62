//! What judges of real files found, a ninth time: tidy tables with gaps, bands with a word behind them, words in the names of files,
//! columns beside spectra, and files of CRAIC, GER, `SCiO`, Spextool, `StellarNet` and Texas Instruments.

use spectral_file::{Certainty, Orientation, Quantity, ReadError, Role, Values, Warning, WavelengthUnit};

use super::{error, lines, names, of_file, ok, rows};

#[test]
fn tidy_tables_may_repeat_a_wavelength_and_have_empty_rows() {
    let row = |nm| format!("dye,Excitation,{nm},0.{nm}\ndye,Emission,{},0.5\n", nm + 100);
    let table = ok(&format!("Dye,Type,Wavelength,Value\ndye,Excitation,400,0\n{}dye,Excitation,NA,NA\n", lines(row)));
    assert_eq!(names(&table), ["Excitation", "Emission"]);
    assert_eq!((table.curves[0].values[0], table.curves[1].wavelengths_nm[0]), (0.2, 500.0));
    assert!(table.warnings.iter().any(|warning| matches!(warning, Warning::Gaps { cells: 1, .. })));
    // One sample, in which the general reader finds no order.
    let table = ok(&format!("nm,R,source\n400,0.2,a\n{}", lines(|nm| format!("{nm},0.{nm},a\n"))));
    assert_eq!((names(&table), table.curves[0].values.len()), (vec!["a"], 40));
}

#[test]
fn words_behind_bands_tell_groups() {
    let heads = |word: &str| lines(|nm| format!(",{nm}.5_{word}"));
    let row = |name: &str| format!("{name}{}\n", ",0.5".repeat(80));
    let text = format!("fish{}{}\n{}{}", heads("SP1"), heads("SP2"), row("a"), row("b"));
    let table = ok(&text);
    assert_eq!((names(&table), table.curves[0].wavelengths_nm[1]), (vec!["a", "b"], 401.5));
    assert_eq!((table.reading.parts[1].name.as_str(), table.curves[0].unit.as_deref()), ("SP2", None));
    // Few may be samples: `400_a` to `404_a`.
    assert!(matches!(
        error("id,400_a,401_a,402_a,403_a,404_a\nx,1,2,3,4,5\n"),
        ReadError::NoNumbers | ReadError::NearlyRow { .. }
    ));
}

#[test]
fn one_number_behind_groups_is_none_of_them() {
    let heads = lines(|nm| format!(",{nm}"));
    let row = |time: &str| format!("{time}{},0.02\n", ",0.5".repeat(80));
    let text = format!("wl{heads}{heads},410\n{}{}{}", row("10:01"), row("10:02"), row("10:03"));
    assert_eq!((ok(&text).curves.len(), ok(&text).curves[0].values.len()), (3, 40));
}

#[test]
fn rows_behind_an_index_and_a_class_are_spectra() {
    let row = |index: usize| format!("{index},1{}\n", ",0.5".repeat(40));
    let text = format!(",Condition{}\n{}{}{}", lines(|nm| format!(",{nm}.25")), row(103), row(104), row(107));
    let orientation = ok(&text).reading.orientation;
    assert_eq!((orientation.value, orientation.certainty), (Orientation::Across, Certainty::Guess));
}

#[test]
fn absorbances_are_told_by_names_of_files() {
    let text = rows(",");
    for path in ["run/leaf_absorbance.csv", "Absorbances/run 1.csv"] {
        let table = of_file(path, &text);
        assert_eq!((table.role.value, table.reading.values.value), (Role::Transmittance, Values::Absorbance));
        assert_eq!(table.reading.values.certainty, Certainty::Guess);
    }
    // The name of the file comes before that of its folder.
    let table = of_file("absorbance/filter.csv", &text);
    assert_eq!((table.role.value, table.reading.values.value), (Role::Transmittance, Values::Plain));
}

#[test]
fn properties_of_materials_are_called_so() {
    let why = |head: &str| ok(&format!("nm,{head}\n{}", rows(","))).role.why;
    assert!(why("absorption coefficient (/cm)").contains("property of a material") && why("n").contains("property"));
    assert!(!why("Absorption").contains("property"));
}

#[test]
fn comments_behind_semicolons_name_columns() {
    let table = ok(&format!("; made by IDL\n; Wavelength leaf soil\n{}", lines(|nm| format!("{nm} 0.1 0.2\n"))));
    assert_eq!(names(&table), ["leaf", "soil"]);
}

#[test]
fn numbers_beside_spectra_are_none() {
    let left = |heads: &str, cells: &str| ok(&format!("{heads}\n{}", lines(|nm| format!("{nm}{cells}\n"))));
    assert_eq!(names(&left("nm,power,luminance", ",0.1,2.5")), ["power"]);
    assert_eq!(names(&left("nm,R,IntegrationTime,bias", ",0.1,2.5,3")), ["R"]);
    let flux = "nm,Spectral irradiance (W m-2 nm-1),Cumulative photon flux (cm-2 s-1)";
    assert_eq!(names(&left(flux, ",0.1,2.5")), ["Spectral irradiance"]);
    assert_eq!(
        names(&left("nm,Absorbance (AU),Reference Signal (unitless),Sample Signal (unitless)", ",0.1,25,21")).len(),
        1
    );
    let shifts = |nm: usize| format!("{nm},{},0.{nm}\n", nm as f64 - 420.5);
    for heads in ["Wavelength,Raman Shift,Raw", "Wavelength (nm),Raman Shift (cm-1),Raw"] {
        assert_eq!(names(&ok(&format!("{heads}\n{}", lines(shifts)))), ["Raw"]);
    }
    let spextool = format!("# Xspextool History\n{}", lines(|nm| format!("0.{nm} 0.9 0.01 2\n")));
    let table = ok(&spextool);
    assert_eq!((names(&table), table.curves[0].uncertainty.is_some()), (vec!["flux"], true));
}

#[test]
fn what_may_be_an_uncertainty_is_said() {
    let text = |heads: &str| format!("nm,{heads}\n{}", lines(|nm| format!("{nm},0.5,0.01,0.7,0.02\n")));
    let table = ok(&text("62 Avg,avg std,62 scaled avg,sc avg std"));
    assert_eq!(names(&table), ["62 Avg", "62 scaled avg"]);
    assert!(table.curves.iter().all(|curve| curve.uncertainty.is_some()));
    let table = ok(&text("leaf,soil,rock,moss err"));
    let said = |warning: &Warning| matches!(warning, Warning::MaybeUncertainty { count: 1, .. });
    assert!(table.curves.len() == 4 && table.warnings.iter().any(said), "{:?}", table.warnings);
    assert!(ok(&text("dye,dye_error_lower_M-1,soil,moss")).warnings.iter().any(said));
}

#[test]
fn programs_name_their_samples_and_modes() {
    let craic = format!("Gorget_5\nReflectance\nSciMode:IT1=448.99ms:NS1=10:(9/28/2012 3:47:08 PM)\n{}", rows("\t"));
    assert_eq!(names(&ok(&craic)), ["Gorget_5"]);
    let ger = format!("///GER SIGNATUR FILE///\nname= a.sig\ndata= \n{}", lines(|nm| format!("{nm}.5  6.36  6.42\n")));
    assert_eq!(names(&ok(&ger)), ["Reference", "Target"]);
    let heads = (0..8).map(|band| format!(",spectrum_{band} + 740")).collect::<Vec<_>>().concat();
    let types = format!("unicode,int{}\n", ",float".repeat(8));
    let scio = format!("num_wavelengths, 8\nname,id{heads}\n{types}leaf,1{0}\nsoil,2{0}\n", ",0.5".repeat(8));
    assert_eq!((names(&ok(&scio)), ok(&scio).curves[0].wavelengths_nm[7]), (vec!["leaf", "soil"], 747.0));
    let stellar = format!("\" File: a\n\" RAD->  Wave:643.77nm  Pix:1050\n{}", rows("  "));
    let table = ok(&stellar);
    assert_eq!((table.role.certainty, table.reading.quantity.certainty), (Certainty::Certain, Certainty::Guess));
    let asd = "Text conversion of header file a.asd\nThere was not a white reference\n\nWavelength\treflec_panel.asd\n";
    let counts = ok(&format!("{asd}{}", lines(|nm| format!("{nm}\t23{nm}\n"))));
    assert_ne!(
        (counts.reading.quantity.value, counts.reading.quantity.certainty),
        (Quantity::Reflectance, Certainty::Certain)
    );
}

#[test]
fn points_read_off_plots_may_go_back() {
    let table =
        ok(&format!("X,Y,X,Y\n400,0.1,410,0.2\n{}403,0.3,405,0.4\n", lines(|nm| format!("{nm},0.1,{},0.2\n", nm + 9))));
    assert_eq!((table.curves.len(), table.curves[1].wavelengths_nm[0]), (2, 405.0));
}

#[test]
fn a_unit_may_stand_alone() {
    let table = ok(&format!("Gold: 207-1823nm\nANGSTROMS\nNK\n{}", lines(|nm| format!("  {nm}0.  1.4  1.3\n"))));
    assert_eq!((table.reading.wavelength_unit.value, table.reading.range_nm[0]), (WavelengthUnit::Angstrom, 400.0));
    let silica = ok("SiO2\neV\nNK\n6.6 1.5 0\n6.5 1.5 0\n6.4 1.5 0\n");
    assert_eq!(silica.reading.wavelength_unit.value, WavelengthUnit::Electronvolt);
}

#[test]
fn a_matrix_is_named_by_its_first_row() {
    let table = ok(&format!("0.0\t-1.5\t0\t2\n{}", lines(|nm| format!("{nm}\t0.1\t0.2\t0.3\n"))));
    assert_eq!(names(&table), ["-1.5", "0", "2"]);
}

#[test]
fn one_name_of_many_says_nothing_of_the_others() {
    let heads = (0..9).map(|at| format!(",Mueller{at}")).collect::<Vec<_>>().concat();
    let table =
        ok(&format!("nm,Reflectance,Transmission{heads}\n{}", lines(|nm| format!("{nm}{}\n", ",0.5".repeat(11)))));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
    let numbered = (1..=12).map(|at| format!("Array_{at} ")).collect::<Vec<_>>().concat();
    let rows = (400..460).map(|nm| format!("{nm}{}\n", " 0.5".repeat(11))).collect::<Vec<_>>().concat();
    assert_eq!(ok(&format!("{numbered}\n{rows}")).curves.len(), 11);
    // A folder of Raman spectra holds wavelengths that are named so.
    assert_eq!(
        of_file("raman/a.csv", &format!("Wavelength,Raw\n{}", lines(|nm| format!("{nm},0.5\n")))).curves.len(),
        1
    );
}

#[test]
fn fields_of_charts_are_no_uncertainties() {
    let fields = ["A", "R", "S", "T", "U"].map(|row| format!(",{row}1,{row}2,{row}3")).concat();
    let table = ok(&format!("nm{fields}\n{}", lines(|nm| format!("{nm}{}\n", ",0.25".repeat(15)))));
    assert_eq!(table.curves.len(), 15);
}

#[test]
fn parts_of_one_spectrum_from_several_sources_are_one() {
    let row = |nm: usize| format!("{nm},0.{nm},{}\n", if nm < 420 { "Morel" } else { "Kou" });
    let table = ok(&format!("wavelength,aw,reference\n{}", lines(row)));
    assert_eq!((names(&table), table.curves[0].values.len()), (vec!["aw"], 40));
}

#[test]
fn columns_of_one_number_are_said() {
    let table = ok(&lines(|nm| format!("0.{nm} 1.5 0.{nm} 1\n")));
    assert!(
        table.warnings.iter().any(|warning| matches!(warning, Warning::Constant { count: 2, .. })),
        "{:?}",
        table.warnings
    );
}

#[test]
fn warnings_are_of_what_the_file_has() {
    // Even steps of wave numbers, and a filter for what is not seen.
    let even = format!("cm-1,R\n{}", lines(|nm| format!("{},0.5\n", 10 * nm)));
    assert!(!ok(&even).warnings.iter().any(|warning| matches!(warning, Warning::Hole { .. })));
    assert_eq!(error("Frequency (THz),R\n700,0.5\n700,0.5\n"), ReadError::TooFewSamples(2));
    let filter = |nm: usize| format!("{},{}\n", nm - 50, if nm < 430 { 50 } else { 0 });
    let table = ok(&format!("nm,%T\n{}", lines(filter)));
    assert!(!table.warnings.iter().any(|warning| matches!(warning, Warning::SmallPercent(_))), "{:?}", table.warnings);
}

#[test]
fn words_for_lights_and_axes() {
    let of = |heads: &str| ok(&format!("{heads}\n{}", lines(|nm| format!("{nm},0.5,0.6\n"))));
    let photons = of("Wavelength,Red_PhotonFlux,Blue_PhotonFlux");
    assert_eq!((photons.role.value, names(&photons)), (Role::Illuminant, vec!["Red", "Blue"]));
    assert_eq!(of("nm,Geranium_G_W_1,a_w").role.value, Role::Unknown);
    assert_eq!(of("nm,absorption,emission").role.certainty, Certainty::Open);
    let dutch = ok(&format!("Golfgetal;R\n{}", lines(|nm| format!("{nm}0;0.5\n"))));
    assert_eq!(dutch.reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
    let lamp = format!("Illuminant_index;3\nirradiance_unit;0\nnm;Raw\n{}", lines(|nm| format!("{nm};0.5\n")));
    assert_eq!(ok(&lamp).role.value, Role::Unknown);
    let energies = of_file("Au-eV.txt", "0.6 1.5\n0.8 1.6\n1.1 1.7\n").reading.wavelength_unit;
    assert_eq!((energies.value, energies.certainty), (WavelengthUnit::Electronvolt, Certainty::Guess));
    let energies = ok("% Hbar Omega (eV) Decay rate\n1.0 0.2\n1.5 0.3\n2.1 0.4\n");
    assert_eq!(energies.reading.wavelength_unit.value, WavelengthUnit::Electronvolt);
    assert_eq!(of_file("sky_angstroms.txt", "2500 1\n2600 2\n2700 3\n").reading.range_nm, [250.0, 270.0]);
    assert_eq!(names(&ok(&format!("Lambda\tH2O\nnm\tcm-1*mM-1\n{}", rows("\t")))), ["H2O"]);
    let named = format!("## Type: detector\n## Name: Orca\nwavelength,qe\n{}", lines(|nm| format!("{nm},0.5\n")));
    assert_eq!(names(&ok(&named)), ["Orca"]);
}

#[test]
fn yaml_is_named() {
    assert!(error("wavelengths: [400, 410, 420]\nleaf: [0.1, 0.2, 0.3]\n").to_string().contains("YAML"));
}
