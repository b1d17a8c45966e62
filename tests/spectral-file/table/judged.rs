//! What an independent judge found misread in public files, on small files of the same make.

use spectral_file::{Certainty, ReadError, ReadOptions, Role, Warning, read};

use super::{error, names, ok, samples};

#[test]
fn bands_below_one_another_are_parts() {
    let band = |name: &str, from: u32| {
        let row = |at: u32| format!("{} 0.{at}\n", from + 10 * at);
        format!("{name}\n#\n{}", (1..6).map(row).collect::<String>())
    };
    for (marks, heads) in [("#", ["Band 1", "Band 2", "Band 3"]), (";;", ["Band 8", "Band 8A", "Band 9"])] {
        // The second overlaps the first; the third goes on where the second ends.
        let all = [400, 430, 480].iter().zip(heads).map(|(from, head)| band(&format!("{marks} {head}"), *from));
        let text = all.collect::<String>().replace("\n#\n", &format!("\n{marks}\n"));
        let first = ok(&text);
        let parts: Vec<_> = first.reading.parts.iter().map(|part| (&*part.name, part.rows)).collect();
        assert_eq!(parts, heads.map(|head| (head, 5)), "{text}");
        assert!(matches!(first.warnings[0], Warning::MoreTables(_)));
        let third = read(text.as_bytes(), &ReadOptions { part: Some(3), ..ReadOptions::default() }).unwrap();
        assert_eq!(samples(&third.curves[0])[0], (490.0, 0.1));
    }
    let one = ok("# one\n400 1\n410 2\n420 3\n# the second grating\n430 4\n440 5\n");
    assert_eq!((one.reading.parts.len(), one.curves[0].values.len()), (1, 5));
}

#[test]
fn other_kinds_of_jcamp_are_refused_by_name() {
    let text = |kind: &str, units: &str| {
        format!(
            "##TITLE=x\n##JCAMP-DX=4.24\n##DATA TYPE={kind}\n##XUNITS={units}\n##YUNITS=COUNTS\n##FIRSTX=7\n##LASTX=9\n\
             ##NPOINTS=3\n##XYDATA=(X++(Y..Y))\n7 1 2 3\n##END=\n"
        )
    };
    for kind in ["CONTINUOUS MASS SPECTRUM", "NMR Spectrum", "RAMAN SPECTRUM", "X-RAY DIFFRACTION"] {
        let refused = error(&text(kind, "MICROMETERS"));
        assert_eq!(refused, ReadError::NotLight { line: 3, kind: kind.to_owned() });
        assert!(refused.to_string().contains(kind));
    }
    assert_eq!(error(&text("", "PPM")), ReadError::NotLight { line: 4, kind: "PPM".to_owned() });
    assert_eq!(ok(&text("UV/VIS SPECTRUM", "MICROMETERS")).curves[0].wavelengths_nm[0], 7000.0);
}

#[test]
fn heads_of_lines_one_step_off_leave_the_ends_of_the_header() {
    let text = "##TITLE=x\n##DATA TYPE=INFRARED SPECTRUM\n##XUNITS=1/CM\n##YUNITS=TRANSMITTANCE\n##FIRSTX=1000.0\n\
                ##LASTX=1005.5\n##NPOINTS=12\n##DELTAX=0.5\n##XYDATA=(X++(Y..Y))\n1000.0 .1 .2 .3 .4\n1001.5 .5 .6 .7 .8\n\
                1003.5 .9 .8 .7 .6\n##END=\n";
    let table = ok(text);
    assert!(matches!(table.warnings[0], Warning::PlacedByEnds(_)), "{:?}", table.warnings);
    let last = table.curves[0].wavelengths_nm[11];
    assert!((last - 1e7 / 1000.0).abs() < 1e-6 && table.curves[0].values[11] == 0.1);
    // Between two places nothing says which is meant.
    assert!(
        read(text.replace("1001.5", "1001.75").replace("1003.5", "1003.75").as_bytes(), &ReadOptions::default())
            .is_err()
    );
}

#[test]
fn notes_beside_rows_are_left_out() {
    let beside = "Wavelength (nm),Lamp,,run 1.sp,\n400,1.5,,2020-01-02 03:04,,Time,125 ms\n401,1.6,,Light,,,\n402,1.7\n\
                  403,1.8\n404,1.9\n405,2.0\n406,2.1\n407,2.2\n408,2.3\n";
    let table = ok(beside);
    assert_eq!((names(&table), table.curves[0].values.len()), (vec!["Lamp"], 9));
    assert!(table.warnings.iter().any(|warning| matches!(warning, Warning::TextColumns { column: 4, .. })));
    let row = |at: u32| format!("{},0.{at},9{at}.5\n", if at == 4 { ",Raw data" } else { "," });
    let before = format!(",,Wavelength (µm),Reflectance (%)\n{}", (1..10).map(row).collect::<String>());
    let table = ok(&before);
    assert_eq!((table.curves.len(), table.curves[0].values[0]), (1, 0.915));
    let late = beside.replace("406,2.1", "406,2.1,,late");
    assert!(matches!(error(&late), ReadError::NotANumber { line: 8, .. } | ReadError::UnevenRow { .. }), "{late}");
}

#[test]
fn columns_of_several_quantities_are_asked_about() {
    let rows = "400,1e17,.1,.9,.5\n410,2e17,.2,.8,.6\n420,3e17,.3,.7,.7\n";
    let table = ok(&format!("wavelength_nm,sun_photons_per_s_m2_nm,asteroid_reflectance,sky_transmission,qe\n{rows}"));
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
    let leaf = ok("nm,Reflectance,Transmittance\n400,.1,.2\n410,.2,.3\n420,.3,.4\n");
    assert!(leaf.role.value.is_fraction());
    let computed =
        ok("nm,Sample_Counts,Dark_Counts,Sample_Corrected,Absorbance\n400,9,1,8,.1\n410,9,1,8,.2\n420,9,1,8,.3\n");
    assert_eq!((computed.curves.len(), computed.role.value), (1, Role::Transmittance));
}

#[test]
fn displays_and_coefficients_are_no_cameras() {
    let rgb = b",R,G,B\n400,1,2,3\n410,2,3,4\n420,3,4,5\n";
    let at = |path: &str| {
        let source = spectral_file::Source { bytes: rgb, path, ..spectral_file::Source::default() };
        read(source, &ReadOptions::default()).unwrap().role
    };
    assert_eq!((at("Example Displays/01.csv").value, at("x/01.csv").value), (Role::Illuminant, Role::Camera));
    assert_eq!(at("x/01.csv").certainty, Certainty::Guess);
    let rows = "400,1.5,1\n410,1.6,2\n420,1.7,3\n";
    let text = format!("; Calibration File\n;  Ed = irradiance (W/m^2/nm)\n; Wavelength (nm), a0, b0\n{rows}");
    assert_eq!(ok(&text).role.certainty, Certainty::Open);
}

#[test]
fn the_head_stands_above_the_key_of_a_section() {
    let text = "# lamp data\n[CALLAB]\nInstitute\n\n# wavelength (nm)\tbandwidth (nm)\tirradiance (mW/m2/nm)\tuncertainty (%, k=2)\n\
                [LAMPDATA]\n300\t0\t1.36\t2\n310\t0\t1.93\t2\n320\t0\t2.65\t2\n";
    let lamp = ok(text);
    assert_eq!((lamp.curves.len(), lamp.curves[0].unit.as_deref()), (1, Some("mW/m2/nm")));
    let stated = lamp.curves[0].uncertainty.as_ref().unwrap();
    assert!(stated.coverage == 2.0 && (stated.standard[0] - 0.0136).abs() < 1e-9);
}

#[test]
fn small_numbers_that_count_or_turn_are_no_micrometers() {
    for text in ["1,2,3\n2,3,4\n3,4,5\n4,5,0\n", "0.3,0.2\n0.4,0.3\n0.5,0.4\n0.4,0.5\n0.3,0.4\n0.4,0.3\n"] {
        assert!(matches!(error(text), ReadError::WavelengthOutOfRange { .. }), "{text}");
    }
    assert_eq!(ok("0.4,0.2\n0.5,0.3\n0.6,0.4\n").curves[0].wavelengths_nm, [400.0, 500.0, 600.0]);
    assert_eq!(ok("nm,sc,rh\n400,.1,.2\n410,.2,.3\n420,.3,.4\n").curves.len(), 2);
}

#[test]
fn an_emissivity_is_neither_reflectance_nor_transmittance() {
    for head in ["wavelength reflection emissivity", "wavelength transmission emissivity"] {
        let table = ok(&format!("{head}\n400 0.9 0.1\n500 0.8 0.2\n600 0.7 0.3\n"));
        assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open), "{head}");
    }
}

#[test]
fn white_beside_red_green_and_blue_is_a_display_s() {
    let table = ok(
        "Wavelength,W,R,G,B\n400,358.5,181.4,157.3,202.1\n500,349.6,193.7,144.4,201.8\n600,374.4,206.4,161.6,218.4\n",
    );
    assert_eq!((table.role.value, table.role.certainty), (Role::Illuminant, Certainty::Guess));
}

#[test]
fn intensities_over_small_wave_numbers_may_be_of_raman_shifts() {
    let table = ok("wavenumber,intensity\n450.5,26\n454.1,50\n1200,48\n3150,45\n");
    assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open));
}

#[test]
fn small_numbers_of_a_program_that_writes_percent_are_asked() {
    let table = ok(
        "Data from black_Reflection_00001.txt Node\nXAxis mode: Wavelengths\n>>>>>Begin Spectral Data<<<<<\n400\t1.5\n500\t2.1\n600\t1.9\n",
    );
    assert_eq!((table.role.value, table.reading.values.certainty), (Role::Reflectance, Certainty::Open));
}
