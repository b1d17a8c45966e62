//! What judges of real files found, a tenth time: glass catalogs, logarithms, zeros that were not computed, units in lists, columns
//! described in comments, and wavelengths beyond the range.

use spectral_file::{
    Certainty, Quantity, ReadError, ReadOptions, Reader, Role, Source, Values, Warning, WavelengthUnit, read,
};

use super::{error, lines, names, of_file, ok};

#[test]
fn glass_catalogs_have_internal_transmittances() {
    let glass = |name: &str, thickness: &str| {
        format!(
            "NM {name} 2 1 1.5 60 0\nED 1 0 1\nCD 1 2 3\nIT 4.0E-001 9.0E-001 {thickness}\nIT 5.0E-001 8.0E-001 {thickness}\n"
        )
    };
    let text = format!("CC a catalog\n{}{}NM NONE 2 1 1 1 0\nIT 0.4 1 5\n", glass("G1", "2.5E+001"), glass("G2", "10"));
    let table = ok(&text);
    assert_eq!(table.reading.reader.value, Reader::AGF);
    // One sample is no spectrum.
    assert_eq!(names(&table), ["G1 (25 mm)", "G2 (10 mm)"]);
    assert_eq!((&*table.curves[0].wavelengths_nm, &*table.curves[1].values), (&[400.0, 500.0][..], &[0.9, 0.8][..]));
    assert!(table.role.certainty == Certainty::Open && table.role.why.contains("Internal"), "{}", table.role.why);
    let broken = text.replace("IT 4.0E-001 9.0E-001 10", "IT 4.0E-001 x 10");
    assert_eq!(error(&broken), ReadError::NotANumber { line: 10, column: 3, text: "x".to_owned() });
    assert_eq!(error(&text.replace(" 9.0E-001 10", "")), ReadError::UnevenRow { line: 10, found: 2, expected: 4 });
}

#[test]
fn logarithms_are_no_values() {
    let of = |heads: &str| ok(&format!("{heads}\n{}", lines(|nm| format!("{nm},1.5,1.6,1.7\n"))));
    for heads in ["nm,log sensitivity,b,c", "nm,log10(R),log10(G),log10(B)", "nm,a,b,Log_irradiance"] {
        let role = of(heads).role;
        assert!(role.certainty == Certainty::Open && role.why.contains("Logarithms"), "{heads}: {}", role.why);
    }
    assert_eq!(of("nm,catalog reflectance,b,c").role.value, Role::Reflectance);
    assert_eq!(
        ok(&format!("nm,log(1/R)\n{}", lines(|nm| format!("{nm},0.5\n")))).reading.values.value,
        Values::Absorbance
    );
    let film = of_file("film_log_sensitivity.csv", &format!("nm,R,G,B\n{}", lines(|nm| format!("{nm},1.5,1.6,1.7\n"))));
    assert!(film.role.why.contains("file's name"), "{}", film.role.why);
}

#[test]
fn zeros_that_were_not_computed_are_left_out() {
    let heads =
        "Pixel;Wavelength;Dark;Reference;Raw data #1;Dark Subtracted #1;%TR #1;Absorbance #1;Irradiance (lumen) #1";
    let table = ok(&format!("{heads}\n{}", lines(|nm| format!("{nm};{nm},5;1;2;{nm};7,5;0;0;0\n"))));
    assert_eq!((names(&table), table.role.value), (vec!["Dark Subtracted #1"], Role::Unknown));
    assert!(table.warnings.iter().any(|warning| matches!(warning, Warning::Uncomputed { count: 3, .. })));
    // Beside what was measured of the same, they may have been measured too.
    let dark = ok(&format!("nm,irradiance on,irradiance off\n{}", lines(|nm| format!("{nm},0.5,0\n"))));
    assert_eq!(dark.curves.len(), 2);
}

#[test]
fn units_and_columns_in_comments() {
    let solar = "# Units: μm, W/m2/μm\nwavelength, spectral irradiance, integrated irradiance\n";
    let table = ok(&format!("{solar}{}30.0, 0.1, 9\n", lines(|nm| format!("0.{nm}, 2.5, {nm}\n"))));
    assert_eq!((names(&table), table.reading.range_nm), (vec!["spectral irradiance"], [400.0, 439.0]));
    assert_eq!(table.curves[0].unit.as_deref(), Some("W/m²/nm"));
    let star = "# from www.example.org/stars\n# Units: Angstroms(A) and erg s-1 cm-2 A-1\n";
    let table = ok(&format!("{star}{}", lines(|nm| format!("{nm}0 1e-9\n"))));
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Angstrom);
    assert_eq!((names(&table), table.reading.quantity.value), (vec!["Column 2"], Quantity::Irradiance));
    let extinction = "# Column wavelength\n# Column extinction\n";
    assert_eq!(names(&ok(&format!("{extinction}{}", lines(|nm| format!("{nm} 0.5\n"))))), ["extinction"]);
    let ash = ok(&format!("#FORMAT = Wavn n k\n{}", lines(|nm| format!("{nm}0 1.5 0.1\n"))));
    assert_eq!((names(&ash), ash.reading.wavelength_unit.value), (vec!["n", "k"], WavelengthUnit::Wavenumber));
    let types = "!TYPE=1  # 0=Reflectance, 1=Optical-Constants\n";
    assert_eq!(ok(&format!("{types}{}", lines(|nm| format!("{nm} 1.5 0.1\n")))).role.certainty, Certainty::Open);
    let lamp = ok(&format!("X-Unit=nm,\nY-Unit=W/nm,\nData,\n{}", lines(|nm| format!("{nm},0.5\n"))));
    assert_eq!((lamp.curves[0].unit.as_deref(), lamp.role.value), (Some("W/nm"), Role::Illuminant));
}

#[test]
fn axes_across() {
    let heads = (375..425).map(|nm| format!(",{}", 2 * nm)).collect::<Vec<_>>().concat();
    let row = |nm: usize| format!(",\"17{nm}\"{}\n", ",0.5".repeat(50));
    let table = ok(&format!("\"Axisscale\",{heads}\n{}", lines(row)));
    assert_eq!((table.curves.len(), table.reading.range_nm), (40, [750.0, 848.0]));
    assert!(table.warnings.is_empty(), "{:?}", table.warnings);
    let [fields, units] = ["Es", "uW/cm^2/nm"].map(|cell| {
        (400..420)
            .map(|at| if cell == "Es" { format!(",Es{}.5", 2 * at) } else { format!(",{cell}") })
            .collect::<String>()
    });
    let row = format!("20240505{}\n", ",57.5".repeat(20));
    let sea = format!("/begin_header\n/fields=date{fields}\n/units=yyyymmdd{units}\n/end_header\n{row}{row}");
    let table = ok(&sea);
    assert_eq!((table.reading.quantity.value, table.reading.range_nm), (Quantity::Irradiance, [800.5, 838.5]));
}

#[test]
fn wavelengths_beyond_the_range_and_back() {
    // Optical constants from the far ultraviolet to the far infrared.
    let table = ok(&format!("lambda n k\n0.0175 0.8 0.1\n{}50.5 1.5 0.2\n", lines(|nm| format!("0.{nm} 1.5 0.1\n"))));
    assert_eq!(
        (table.reading.wavelength_unit.value, table.reading.range_nm),
        (WavelengthUnit::Micrometer, [400.0, 439.0])
    );
    // Points read off a plot, behind the name of the lamp.
    let row = |nm: usize| format!("Hydra,{}.5,0.{nm}\n", if nm == 420 { 419 } else { nm });
    let table = ok(&format!("Light.source,Wavelength,Relative.Intensity\n{}", lines(row)));
    assert_eq!((table.curves.len(), table.curves[0].values.len()), (1, 39));
}

#[test]
fn names_of_files_and_folders() {
    let role = |path: &str, curves: usize| {
        let table = of_file(path, &lines(|nm| format!("{nm}{}\n", " 0.5".repeat(curves))));
        (table.role.value, table.role.certainty)
    };
    let guess = |role| (role, Certainty::Guess);
    assert_eq!(role("Canon_EOS_5D.txt", 3), guess(Role::Camera));
    assert_eq!(role("Canon_EOS_5D.txt", 1).1, Certainty::Open);
    assert_eq!(role("SRF/dove.txt", 4), guess(Role::Camera));
    assert_eq!(role("NREL_AM1_5g_tilt.txt", 1), guess(Role::Illuminant));
    assert_eq!(role("team_1_5.txt", 1).1, Certainty::Open);
    let raman = |heads: &str| of_file("Raman/gold.txt", &format!("{heads}\n{}", lines(|nm| format!("{nm} 0.5 0.1\n"))));
    assert_eq!(raman("lambda n k").reading.range_nm, [400.0, 439.0]);
    let shifts = read(
        Source { path: "Raman/gold.txt", ..Source::from("#Wave #Intensity\n400 1\n410 2\n420 3\n") },
        &ReadOptions::default(),
    );
    assert_eq!(shifts.map(|_| ()), Err(ReadError::NotWavelengths(1)));
}

#[test]
fn columns_of_wavelengths_by_their_numbers() {
    let row = |nm: usize| format!("{nm},0.{nm},{}.5,0.5,{}.7,0.6\n", if nm == 420 { 418 } else { nm }, nm);
    let table = ok(&format!("\"lambs, usual\",usual,\"lambs, sky\",sky,\"lambs, clouds\",clouds\n{}", lines(row)));
    assert_eq!(names(&table), ["usual", "sky", "clouds"]);
    assert_eq!(table.curves[2].wavelengths_nm[0], 400.7);
    let sizes = error(&format!("Size (d.nm)\tIntensity (%)\n{}", lines(|nm| format!("{nm}\t0.5\n"))));
    assert_eq!(sizes, ReadError::NotWavelengths(1));
}

#[test]
fn names_above_heads_that_are_alike() {
    let rows = lines(|nm| format!("{nm};0.5;0.6\n"));
    for (heads, named) in [
        ("Name;lamp 1;lamp 2\nDate;1;2\n\nWavelength [nm];Ee [W/(sqm*nm)];Ee [W/(sqm*nm)]\n", ["lamp 1", "lamp 2"]),
        ("Channel;C10;C12\nnm;650;705\n", ["C10", "C12"]),
        ("#lambda;Ext;kR\n#nm;mag;mag\n#---\n", ["Ext", "kR"]),
    ] {
        assert_eq!(names(&ok(&format!("{heads}{rows}"))), named, "{heads}");
    }
    let pairs = lines(|nm| format!("{nm},0.5,{}.5,0.6\n", nm + 9));
    assert_eq!(names(&ok(&format!("Red,Red,Green,Green\nX,Y,X,Y\n{pairs}"))), ["Red", "Green"]);
    let named = ok(&format!("Wavelength, nm, S0,S1\n{}", lines(|nm| format!("{nm},0.5,0.6\n"))));
    assert_eq!(names(&named), ["S0", "S1"]);
    // More words than columns name none.
    let words = format!("#,wavelength,[nm],,refractive,index,n,,k\n{}", lines(|nm| format!("{nm},1.5,0.5,\n")));
    assert_eq!(ok(&words).reading.range_nm, [400.0, 439.0]);
}

#[test]
fn photon_energies_are_read() {
    for head in ["Energy_eV", "E (eV)", "Photon energy [eV]", "hν (eV)", "energy(eV)"] {
        let table = ok(&format!("{head},a\n{}", lines(|at| format!("{}.{at},0.5\n", at / 200))));
        assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Electronvolt, "{head}");
    }
    // From zero on, and far beyond.
    let table = ok(&format!("# energy(eV) alpha\n0.0 0\n{}30 1\n", lines(|at| format!("2.{at} 0.5\n"))));
    assert_eq!((table.curves[0].values.len(), table.reading.range_nm[0].round()), (40, 508.0));
    for head in ["Binding energy (eV)", "Energy loss (eV)", "Bandgap (eV)", "Energy (keV)"] {
        assert_eq!(error(&format!("{head},a\n2.1,1\n2.2,2\n2.3,3\n")), ReadError::NotWavelengths(1), "{head}");
    }
}

#[test]
fn what_may_be_otherwise_is_said() {
    let index = ok(&lines(|at| format!("{at}\t{}.5\t0.5\n", at - 382)));
    assert!(index.warnings.contains(&Warning::MayCount([1, 2])), "{:?}", index.warnings);
    let mixed = ok(&format!("nm,X_bar,Y_bar,Z_bar,D65\n{}", lines(|nm| format!("{nm},1,1,1,90\n"))));
    assert_eq!(mixed.role.certainty, Certainty::Open);
    let heads =
        (0..40).map(|at| format!(",{:.3}", 3.857f64.mul_add(-f64::from(at), 1801.264))).collect::<Vec<_>>().concat();
    let infrared = ok(&format!("type{heads}\ncollagen{}\n", ",0.5".repeat(40)));
    assert_eq!(infrared.reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
    // One scale: dark in what is seen, and far above one beyond.
    let of = |at: usize| format!("{},{},{}\n", 10 * at - 3600, if at % 8 < 3 { 3.1 } else { 0.2 }, 20);
    let table = of_file("b_Transmittance.csv", &format!("wl,a,b\n{}", lines(of)));
    assert_eq!((table.reading.values.value, table.curves[0].values[0]), (Values::Percent, 0.031));
}

#[test]
fn headers_of_wavelengths_below_one_another_begin_tables() {
    let table = |name: &str, from: usize| {
        let heads = (0..40).map(|at| format!(",{}.5", from + 3 * at)).collect::<Vec<_>>().concat();
        format!("{name}{heads}\n{name}1{}\n{name}2{}\n\n", ",0.5".repeat(40), ",0.25".repeat(40))
    };
    let text = format!("{}{}{}", table("leek", 400), table("apple", 430), table("pear", 410));
    let first = ok(&text);
    assert_eq!((names(&first), first.reading.parts.len()), (vec!["leek1", "leek2"], 3));
    assert!(first.warnings.iter().any(|warning| matches!(warning, Warning::MoreTables(_))));
    let options = ReadOptions { part: Some(2), ..ReadOptions::default() };
    let second = read(text.as_bytes(), &options).unwrap();
    assert_eq!((names(&second), second.reading.range_nm), (vec!["apple1", "apple2"], [430.5, 547.5]));
}

#[test]
fn columns_beside_spectra_by_their_words() {
    let table = ok(&format!("wl_um flx eflx rms_renorm\n{}", lines(|nm| format!("0.{nm} 12.5 0.5 0.9\n"))));
    assert_eq!(names(&table), ["flx", "rms_renorm"]);
    let other = ok(&format!("nm,depth,shift\n{}", lines(|nm| format!("{nm},12.{nm},0.001\n"))));
    assert!(other.warnings.iter().any(|warning| matches!(warning, Warning::OtherSize { count: 1, .. })));
    let steps = |text: &str| {
        ok(&format!("nm,depth,turns\n{text}"))
            .warnings
            .iter()
            .any(|warning| matches!(warning, Warning::Stepped { count: 1, .. }))
    };
    assert!(steps(&lines(|nm| format!("{nm},{}.5,0.{}\n", nm % 83, 2 + nm % 2))));
    assert!(steps(&lines(|nm| format!("{nm},{}.5,{}\n", nm % 83, nm % 7))));
    assert!(!steps(&lines(|nm| format!("{nm},{}.5,{}.25\n", nm % 83, nm % 7))));
    assert!(table.curves[0].uncertainty.is_some());
    assert!(table.warnings.iter().any(|warning| matches!(warning, Warning::MaybeUncertainty { count: 1, .. })));
    let table = ok(&format!("wl_center depth wv_wdth Repeat\n{}", lines(|nm| format!("{nm} 0.{nm} 0.03 2\n"))));
    assert_eq!(names(&table), ["depth"]);
    let mean = ok(&format!("wave,flux,std,n_contrib\n0.08,1,1,5\n{}", lines(|nm| format!("0.{nm},12.5,0.5,{nm}\n"))));
    assert_eq!((names(&mean), mean.reading.range_nm), (vec!["flux"], [400.0, 439.0]));
    let heads = "Species;SIZE (um);CODE";
    let bands = (40..80).map(|nm| format!(";{nm}0")).collect::<Vec<_>>().concat();
    assert_eq!(ok(&format!("{heads}{bands}\nalga;0.5;A1{}\n", ";0.5".repeat(40))).curves.len(), 1);
    let amplifier = ok(&format!("Sensitivity: 500 nV\nnm,R [V]\n{}", lines(|nm| format!("{nm},0.5\n"))));
    assert_eq!(amplifier.role.certainty, Certainty::Open);
}

#[test]
fn labels_of_jcamp_above_plain_rows() {
    let labels = "##TITLE=tablet\n##DATA TYPE=INFRARED SPECTRUM\n##XUNITS=1/CM\n##YUNITS=%T\n";
    let table = ok(&format!("{labels}{}", lines(|cm| format!("{cm}.5\t33.6\n"))));
    assert_eq!((names(&table), table.reading.values.value), (vec!["tablet"], Values::Percent));
    assert_eq!(table.reading.reader.value, Reader::TABLE);
}

#[test]
fn names_of_files_tell_scales_and_units() {
    let rows = lines(|nm| format!("{nm},0.5\n"));
    assert_eq!(of_file("OD_algae_2022.csv", &rows).reading.values.value, Values::Absorbance);
    let infrared = lines(|cm| format!("{}.5,0.5\n", cm * 10 - 3000));
    assert_eq!(of_file("MIR_purees.csv", &infrared).reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
    let lights = ok(&format!("nm,A,B,D50,ID65\n{}", lines(|nm| format!("{nm},90,90,90,90\n"))));
    assert_eq!((lights.role.value, lights.role.certainty), (Role::Illuminant, Certainty::Guess));
    let fields = ok(&format!("nm,A,B,C\n{}", lines(|nm| format!("{nm},0.5,0.5,0.5\n"))));
    assert_eq!(fields.role.certainty, Certainty::Open);
}
