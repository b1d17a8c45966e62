//! What an independent judge found misread in public files in a second round, on small files of the same make.

use spectral_file::{Certainty, ReadError, ReadOptions, Reader, Role, Source, Values, Warning, WavelengthUnit, read};

use super::{error, names, ok, samples};

#[test]
fn a_d_before_a_name_is_its_uncertainty() {
    let numbered = ok("Wavelength,QE183,dQE,QE294\n400,0.5,0.03,0.4\n410,0.6,0.03,0.5\n420,0.7,0.03,0.6\n");
    assert_eq!(names(&numbered), ["QE183", "QE294"]);
    assert_eq!(numbered.curves[0].uncertainty.as_ref().map(|stated| stated.standard[0]), Some(0.03));
    for name in ["dR", "d_R", "d R"] {
        let table = ok(&format!("nm,R,{name}\n400,0.5,0.01\n410,0.6,0.02\n420,0.7,0.01\n"));
        assert!(table.curves.len() == 1 && table.curves[0].uncertainty.is_some(), "{name}");
    }
    // Derivatives have signs or are large, and a name may begin with the letter.
    for rows in ["400,0.5,0.01\n410,0.6,-0.02\n420,0.7,0.01\n", "400,0.5,0.4\n410,0.6,0.5\n420,0.7,0.6\n"] {
        assert_eq!(names(&ok(&format!("nm,R,dR\n{rows}"))), ["R", "dR"]);
    }
    assert_eq!(names(&ok("nm,light,dark\n400,0.5,0.01\n410,0.6,0.02\n420,0.7,0.01\n")), ["light", "dark"]);
}

#[test]
fn a_quantity_glued_to_a_name_leaves_the_name() {
    let table = ok("Wavelength,w2Absorbance,w0Absorbance\n400,0,1\n410,1,0\n420,0.3,0.2\n");
    assert_eq!(
        (names(&table), table.reading.values.value),
        (vec!["w2 Transmittance", "w0 Transmittance"], Values::Absorbance)
    );
}

#[test]
fn lists_of_json_belong_to_the_wavelengths_with_their_prefix() {
    let json = r#"{"a_wavelengths": [400, 410, 420], "a_gain": [1, 2, 3], "c_wavelengths": [401, 411, 421, 431], "c_gain": [4, 5, 6, 7]}"#;
    let table = ok(json);
    assert_eq!(names(&table), ["a_gain", "c_gain"]);
    assert_eq!(samples(&table.curves[0])[0], (400.0, 1.0));
    assert_eq!(samples(&table.curves[1]), [(401.0, 4.0), (411.0, 5.0), (421.0, 6.0), (431.0, 7.0)]);
    let same = ok(r#"{"wavelengths": [400, 410, 420], "R": [1, 2, 3], "wavelengths_air": [401, 411, 421]}"#);
    assert_eq!(names(&same), ["R"]);
    assert!(same.reading.notes.iter().any(|note| note.value.contains("wavelengths_air")), "{:?}", same.reading.notes);
}

#[test]
fn what_is_no_wavelength_is_refused() {
    // Shifts from the light of a laser.
    for head in ["rel. 1/cm", "Raman shift", "Raman Shift (cm-1)", "rel. cm-1"] {
        let text = format!("{head}\tleaf\n200.5\t10\n400.5\t20\n600.5\t30\n");
        assert_eq!(error(&text), ReadError::NotWavelengths(1), "{head}");
    }
    assert_eq!(names(&ok("nm\tRaman signal\n200\t10\n400\t20\n600\t30\n")), ["Raman signal"]);
    // Reflectances of which no wavelengths are known.
    let row = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join("\t");
    let first = [0.4, 0.41, 0.43, 0.45, 0.5, 0.55, 0.6, 0.62, 0.61, 0.7, 0.75, 0.8];
    let rows: Vec<String> = [1.0, 0.9, 1.2].iter().map(|by| row(&first.map(|value| value * by))).collect();
    assert!(matches!(error(&rows.join("\n")), ReadError::WavelengthOutOfRange { line: 1, .. }));
    // In order they may be micrometers, but that is a guess.
    let sorted = [0.4, 0.41, 0.43, 0.45, 0.5, 0.55, 0.6];
    let rows: Vec<String> = [1.0, 0.9, 1.2].iter().map(|by| row(&sorted.map(|value| value * by))).collect();
    let guessed = ok(&rows.join("\n")).reading.orientation;
    assert_eq!(guessed.certainty, Certainty::Guess, "{guessed:?}");
    // Settings, most of one wavelength.
    let settings = "power\twavelengthNm\tsize\n1\t580\t2\n3\t580\t2\n4\t580\t5\n9\t580\t6\n2\t400\t1\n5\t700\t3\n";
    let found = error(settings);
    assert!(matches!(found, ReadError::OneWavelength { nm: 580.0, count: 4, rows: 6, .. }), "{found:?}");
    assert_eq!(error("energy,a\n0.2,1\n0.4,2\n0.6,3\n"), ReadError::NotWavelengths(1));
    assert_eq!(error("Year,Month,Day,GHI\n2015,1,1,3\n2015,2,1,4\n2016,3,1,5\n"), ReadError::NoWavelengths(1));
    // The values stand before the wavelengths.
    let turned = "0.1,400\n0.2,410\n0.3,420\n0.2,430\n0.1,440\n";
    let found = ok(turned);
    assert_eq!((samples(&found.curves[0])[0], &found.warnings[0]), ((400.0, 0.1), &Warning::UnnamedWavelengths(2)));
    let chosen = ReadOptions { wavelength_column: Some(2), ..ReadOptions::default() };
    assert_eq!(samples(&read(turned.as_bytes(), &chosen).unwrap().curves[0])[0], (400.0, 0.1));
}

#[test]
fn tables_by_angle_have_a_curve_for_each() {
    let rows = |angle| (0..9).map(move |at| format!("{angle},{},0.{at}{angle}\n", 400 + 10 * at));
    let text: String = rows(8).chain(rows(30)).collect();
    let table = ok(&format!("degree,wavelength,reflectance\n{text}"));
    assert_eq!((names(&table), table.reading.reader.value), (vec!["8", "30"], Reader::TIDY));
    assert_eq!(samples(&table.curves[1])[1], (410.0, 0.13));
}

#[test]
fn the_glazing_database_and_other_remarks_in_braces_are_no_json() {
    let glass = ok("{ Units, Wavelength Units } SI Microns\n{ Thickness } 3.0\n{ IR Transmittance } TIR=0\n\
                    { Emissivity, front back } Emis= 0.8 0.8\n{ Acceptance: # }\n{ Structure: X }\n\
                    0.300 0.0020 0.0470 0.0480\n0.305 0.0030 0.0470 0.0480\n0.310 0.0090 0.0470 0.0480\n");
    assert_eq!(names(&glass), ["T", "Rf", "Rb"]);
    assert_eq!((samples(&glass.curves[0])[0], glass.curves[2].values[0]), ((300.0, 0.002), 0.048));
    assert_eq!(glass.reading.wavelength_unit.certainty, Certainty::Certain);
    for text in ["{ a remark }\nno numbers = here;\n", "{{a, b}, {c, d}}\n"] {
        assert_eq!(error(text), ReadError::NoNumbers, "{text}");
    }
    assert!(matches!(error("{\"a\": 1,, }\n"), ReadError::Malformed { .. }));
}

#[test]
fn frequencies_in_hertz_are_converted_with_what_is_per_hertz() {
    let table =
        ok("# Frequency (Hz), Power (W m^-2 Hz^-1)\n# A note on it in prose\n5e14,2e-12\n6e14,3e-12\n7.5e14,4e-12\n");
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Hertz);
    let [(violet, value), ..] = samples(&table.curves[0])[..] else { panic!("no samples") };
    // c/ν, and E_ν c/λ² in nanometers.
    assert!((violet - 399.723_277_333).abs() < 1e-6, "{violet}");
    assert!((value / (4e-12 * 299_792_458e9 / (violet * violet)) - 1.0).abs() < 1e-12, "{value}");
    assert_eq!((table.role.value, table.curves[0].unit.as_deref()), (Role::Illuminant, Some("W/m²/nm")));
}

#[test]
fn heads_of_wave_numbers_are_none_of_nanometers() {
    let table = ok("wn_1200.5,wn_1202.5,wn_1204.5,wn_1206.5,wn_1208.5\n0.1,0.2,0.3,0.4,0.5\n0.2,0.3,0.4,0.5,0.6\n");
    assert_eq!(table.reading.wavelength_unit.value, WavelengthUnit::Wavenumber);
    let (nm, value) = samples(&table.curves[0])[4];
    assert!((nm - 1e7 / 1200.5).abs() < 1e-6 && value == 0.1, "{nm} {value}");
}

#[test]
fn the_file_itself_outweighs_the_name_of_its_folder() {
    let role = |text: &str| {
        let source = Source { bytes: text.as_bytes(), path: "glass-transmittance/a.txt", ..Source::default() };
        read(source, &ReadOptions::default()).unwrap().role
    };
    let rows = "400,0.5,0.1\n410,0.6,0.1\n420,0.7,0.1\n";
    assert_eq!(role(&format!("nm,a,b\n{rows}")).value, Role::Transmittance);
    for head in ["nm,n,k\n", "Col 1 = absorption (m2 particle-1)\n"] {
        assert_eq!(role(&format!("{head}{rows}")).certainty, Certainty::Open, "{head}");
    }
}

#[test]
fn abscissas_summed_up_by_a_program_are_placed_by_the_ends() {
    // Each head is as far off as single precision made it, less than a twentieth of a step.
    let heads = [400.0, 408.030, 416.060];
    let lines = heads.map(|head| format!("{head:.3} 1 2 3 4\n")).concat();
    let text = format!(
        "##TITLE=x\n##JCAMP-DX=4.24\n##DATA TYPE=UV/VIS SPECTRUM\n##XUNITS=NANOMETERS\n##YUNITS=TRANSMITTANCE\n\
         ##FIRSTX=400.000\n##LASTX=422.000\n##NPOINTS=12\n##DELTAX=2.0\n##XFACTOR=1\n##YFACTOR=0.1\n##XYDATA=(X++(Y..Y))\n{lines}##END=\n"
    );
    let table = ok(&text);
    assert_eq!((table.curves[0].values.len(), samples(&table.curves[0])[11]), (12, (422.0, 0.4)));
    assert!(
        table.warnings.iter().any(|warning| warning.to_string().contains("placed by FIRSTX")),
        "{:?}",
        table.warnings
    );
    assert!(read(text.replace("408.030", "408.530").as_bytes(), &ReadOptions::default()).is_err());
}
