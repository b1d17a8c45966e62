//! What an independent judge found misread in public files, on small files of the same make.

use spectral_file::{Certainty, ReadError, ReadOptions, Role, Source, Warning, read};

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

#[test]
fn what_has_none_of_the_roles_is_asked() {
    let bare = "400,0.1\n500,0.2\n600,0.3\n";
    let asked = [
        ("", "nm,Internal transmittance\n", "Internal transmittances lack"),
        ("", "# internal transmittance of BG40 at 1 mm\n", "By line 1: internal"),
        ("", "nm,Grating quantum efficiency\n", "The efficiency of a grating"),
        ("", "nm,Diffraction efficiency (%)\n", "The efficiency of a grating"),
        ("grating_efficiency_300.csv", "nm,Order 1\n", "The file is named"),
        ("", "nm,Expanded uncertainty (k=2)\n", "The header says that these are uncertainties"),
        ("", "# title: Expanded uncertainty\nnm,Reflectance\n", "Line 1 says that these are uncertainties"),
        ("", "# Standard uncertainties of the reflectances\nnm,leaf\n", "Line 1 says that these are uncertainties"),
        ("lamp_k2uncertainty.csv", "nm,Lamp 1\n", "The name of the file says that these are uncertainties"),
        (
            "",
            "# Transmission of the air\n# computed from sky radiances\n",
            "Line 1 mentions transmittances, but line 2",
        ),
        ("SG01DA18SPD07.csv", "nm,REF(A)\n", "Values reach"),
    ];
    for (path, head, why) in asked {
        let text = format!("{head}{bare}");
        let source = Source { bytes: text.as_bytes(), path, ..Source::default() };
        let table = read(source, &ReadOptions::default()).unwrap();
        assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open), "{path} {head}");
        assert!(table.role.why.starts_with(why), "{}", table.role.why);
    }
    // Remarks on uncertainties, conditions of measurement and settings change nothing.
    for head in [
        "# Reflectances with uncertainties below 1 percent\nnm,Reflectance\n",
        "# Uncertainty: 2 %\nnm,Reflectance\n",
        "# Grating: 600 lines\nnm,Reflectance\n",
        "# Reflectance\n# Light source: halogen\nnm,leaf\n",
    ] {
        assert_eq!(ok(&format!("{head}{bare}")).role.value, Role::Reflectance, "{head}");
    }
    let named = Source { bytes: bare.as_bytes(), path: "e2v_QE.csv", ..Source::default() };
    assert!(read(named, &ReadOptions::default()).unwrap().reading.per_photon.unwrap().value);
}

#[test]
fn comments_give_units_to_columns_by_their_names() {
    /// The energy of a photon of 500 nm, h c/λ by the constants of the SI.
    const PHOTON_J: f64 = 3.972_891_714_297_857e-19;
    let per_um =
        "# lam_unit : um\n# emission_unit : ph s-1 m-2 um-1 arcsec-2\nlam emission\n0.4 1000\n0.5 1000\n0.6 1000\n";
    let table = ok(per_um);
    let (nm, value) = samples(&table.curves[0])[1];
    assert_eq!((nm, table.curves[0].unit.as_deref()), (500.0, Some("W/m²/arcsec²/nm")));
    assert!((value / PHOTON_J - 1.0).abs() < 1e-12, "{value}");
    let ecsv = "# %ECSV 0.9\n# ---\n# datatype:\n# - {name: wavelength, unit: Angstrom, datatype: float64}\n\
                # - {name: flux, unit: erg / (Angstrom cm2 s), datatype: float64}\nwavelength flux\n1000 1\n5000 2\n20000 3\n";
    let object =
        ok(&ecsv.replace("# - {name: flux, unit: erg / (Angstrom cm2 s)", "# unit: !unit {unit: nm}\n# - {name: flux"));
    assert_eq!(object.curves[0].unit, None);
    let table = ok(ecsv);
    // An erg is 1e-7 J, and ten ångströms are a nanometer.
    assert_eq!(samples(&table.curves[0])[1], (500.0, 2e-6));
    assert_eq!((table.role.value, table.role.certainty), (Role::Illuminant, Certainty::Certain));
    let sky = ok("# Columns: wavelength (micron) and equivalent sky radiance (MJy/SR)\n0.5,1\n20,2\n31,3\n");
    // A jansky is 1e-26 W/m²/Hz, of which c/λ² are in a nanometer; what is beyond 25 µm is left out.
    let expected = 1e6 * 1e-26 * 299_792_458.0 / (500e-9 * 500e-9) * 1e-9;
    assert!((sky.curves[0].values[0] / expected - 1.0).abs() < 1e-12 && sky.curves[0].values.len() == 2);
    let one = ok("# wavelength_unit: nm\n# y_unit: percent\n# transmission_unit: percent\n400 10\n500 0.5\n600 0.4\n");
    assert_eq!(samples(&one.curves[0])[0], (400.0, 0.1));
    assert_eq!(ok("# Spectral photon flux\n500 1\n550 1\n").curves[0].values, [1.1, 1.0]);
}

#[test]
fn names_and_axes_of_libraries_and_models() {
    let usgs = "USGS Digital Spectral Library\n3-columns of data:\n     wavelength    reflectance    standard deviation\n\n\
                (standard deviation of 0.000000 means not measured)\n-----\nAcmite W1R1Bb AREF\ncopy of splib05a r 58\nx\ny\nz\n\
                \u{20}  0.4051    -1.23e+34    -1.23e+34\n   0.5131    0.0551    0.00012\n   0.6131    0.0561    0.00013\n";
    let table = ok(usgs);
    assert_eq!((names(&table), table.role.value), (vec!["reflectance"], Role::Reflectance));
    let uncertainty = table.curves[0].uncertainty.as_ref().unwrap();
    assert_eq!((samples(&table.curves[0])[0], uncertainty.standard[0]), ((513.1, 0.0551), 0.00012));
    let modtran = ok("   FREQ TOT_TRANS TOTAL_RAD\n 12500. 0.5 1E-8\n 20000. 0.6 2E-8\n 25000. 0.7 3E-8\n");
    assert_eq!((modtran.reading.range_nm, modtran.role.certainty), ([400.0, 800.0], Certainty::Open));
    assert_eq!(error("frequency,a\n400,1\n500,2\n"), ReadError::NotWavelengths(1));
    assert_eq!(error("Bandgap (eV),PCE (%)\n0.32,5.9\n0.33,6.1\n0.34,6.2\n"), ReadError::NotWavelengths(1));
    for head in ["Patch,X,Y,Z", "Sample,L*,a*,b*"] {
        assert_eq!(error(&format!("{head}\n401,10,9,7\n402,20,19,17\n403,30,29,27\n")), ReadError::NoWavelengths(1));
    }
    let wide =
        |heads: &str| format!("sample,{heads}\na,0.1,0.2,0.3,0.4,0.5\nb,0.2,0.3,0.4,0.5,0.6\nc,0.3,0.4,0.5,0.6,0.7\n");
    let table = ok(&wide("400_refl,410_refl,420_refl,430_refl,440_refl"));
    assert_eq!((names(&table), table.role.value), (vec!["a", "b", "c"], Role::Reflectance));
    assert_eq!(samples(&table.curves[0])[0], (400.0, 0.1));
    let intervals = wide("400-410nm,410-420nm,420-430nm,430-440nm,440-450nm");
    assert_eq!(error(&intervals), ReadError::NoWavelengths(1));
    for (number, text) in [("NaN", "NaN"), ("-Infinity", "Infinity")] {
        let json = format!("{{\n\"wavelengths\": [400, 410, 420],\n\"values\": [0.1, {number}, 0.3]\n}}\n");
        assert_eq!(error(&json), ReadError::NoJsonNumber { line: 3, text });
    }
}
