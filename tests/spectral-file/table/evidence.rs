//! What the curves of a table are, by the file's own words, by its metadata, by the names of file and folders; else it is asked.

use spectral_file::{Certainty, Quantity, ReadError, ReadOptions, Role, Source, SpectralFile, Values, read};

use super::{names, ok};

const BARE: &str = "400,0.12\n500,0.55\n600,0.91\n700,0.30\n";

fn at(path: &str, text: &str) -> SpectralFile {
    read(Source { bytes: text.as_bytes(), path, ..Source::default() }, &ReadOptions::default()).unwrap()
}

fn with(metadata: &str, text: &str) -> SpectralFile {
    let source = Source { bytes: text.as_bytes(), metadata: metadata.as_bytes(), ..Source::default() };
    read(source, &ReadOptions::default()).unwrap()
}

#[test]
fn numbers_alone_are_asked_about_whatever_their_size() {
    for factor in [1e-9, 0.02, 1.0, 1.3, 90.0, 1e5] {
        let row = |nm: u32, value: f64| format!("{nm},{}\n", value * factor);
        let table = ok(&[row(400, 0.12), row(500, 0.55), row(600, 0.91)].concat());
        assert_eq!((table.role.value, table.role.certainty), (Role::Unknown, Certainty::Open), "{factor}");
        assert_eq!(table.reading.values.certainty, Certainty::Open, "{factor}");
    }
}

#[test]
fn names_of_files_and_folders_are_a_reason_for_a_guess() {
    use Role as Is;
    for (path, role) in [
        ("filters/Lee_239.csv", Is::Transmittance),
        ("filters/239.csv", Is::Transmittance),
        ("lamps/albedo.dat", Is::Reflectance),
        ("SoT/Lamp_Black_reflectance.txt", Is::Reflectance),
        ("CCD efficiency.txt", Is::Camera),
        (r"C:\data\illum\brendel.csv", Is::Illuminant),
        ("CIE_illum_FLs.csv", Is::Illuminant),
        ("x/warmLED5000.csv", Is::Illuminant),
        ("imx219_qe.csv", Is::Camera),
        ("CanonSSF.txt", Is::Camera),
        ("filters/lamp.csv", Is::Illuminant),
        ("Zomei Transmission.csv", Is::Transmittance),
        ("reflectances/oak.csv", Is::Reflectance),
    ] {
        let table = at(path, BARE);
        assert_eq!((table.role.value, table.role.certainty), (role, Certainty::Guess), "{path}");
        assert!(table.role.why.contains("is named “"), "{path}: {}", table.role.why);
    }
    for path in [
        "leaf.csv",
        "filtered/../oak.csv",
        "filters/a/c.csv",
        "spds/Ag.k.spd",
        "spds/Ag.eta.spd",
        "compiled.csv",
        "led_filter.csv",
        "",
        "/",
        ".",
    ] {
        assert_eq!(at(path, BARE).role.certainty, Certainty::Open, "{path}");
    }
    let said = at("filters/lamp.csv", "nm,Reflectance\n400,0.1\n500,0.2\n").role;
    assert_eq!((said.value, said.certainty), (Role::Reflectance, Certainty::Certain), "words outweigh names");
    let percent = at("filters/x.csv", "nm,glass (%)\n400,10\n500,20\n");
    assert_eq!((percent.role.value, percent.curves[0].values[0]), (Role::Transmittance, 0.1));
}

#[test]
fn metadata_of_the_cie_name_columns_and_quantity() {
    let column = |title: &str, quantity: &str| {
        format!(r#"{{"title": "{title}", "unit": "dimensionless", "quantity": "{quantity}"}}"#)
    };
    let cie = |quantity: &str, titles: [&str; 2]| {
        format!(
            r#"{{"titles": [{{"title": "Made up"}}], "datatableInfo": {{"columnHeaders":
               [{{"title": "lambda", "unit": "nm", "quantity": "wavelength"}}, {}, {}]}}}}"#,
            column(titles[0], quantity),
            column(titles[1], quantity)
        )
    };
    let rows = "400,0.1,0.2\n500,0.3,0.4\n600,0.5,0.6\n";
    for (quantity, role, is) in [
        ("spectral distribution", Role::Illuminant, Quantity::SpectralPower),
        ("spectral luminous efficiency", Role::Camera, Quantity::Sensitivity),
        ("colour-matching function", Role::Camera, Quantity::Sensitivity),
        ("spectral tristimulus values", Role::Camera, Quantity::Sensitivity),
        ("chromaticity coordinates", Role::Unknown, Quantity::Unknown),
    ] {
        let table = with(&cie(quantity, ["FL1", "V(lambda)"]), rows);
        assert_eq!((table.role.value, table.role.certainty), (role, Certainty::Certain), "{quantity}");
        assert_eq!((table.reading.quantity.value, names(&table)), (is, vec!["FL1", "V"]), "{quantity}");
        assert_eq!(table.reading.wavelength_unit.certainty, Certainty::Certain);
        assert_eq!(table.reading.comment("title"), Some("Made up"));
    }
    let named = with(&cie("spectral distribution", ["FL1", "FL2"]), &format!("nm,Reflectance a,Reflectance b\n{rows}"));
    assert_eq!((named.role.value, names(&named)), (Role::Reflectance, vec!["Reflectance a", "Reflectance b"]));
    let other = with(&cie("spectral distribution", ["FL1", "FL2"]), BARE);
    assert_eq!(other.role.certainty, Certainty::Open, "metadata of another number of columns");
    for broken in ["", "{", "[]", "{\"titles\": 3}", "{\"datatableInfo\": {\"columnHeaders\": [1, 2]}}"] {
        assert_eq!(with(broken, BARE).role.certainty, Certainty::Open, "{broken}");
    }
    let csvw = r#"{"dc:title": "x", "tableSchema": {"columns": [{"titles": "nm"}, {"titles": "glass", "description": "transmittance"}]}}"#;
    assert_eq!((with(csvw, BARE).role.value, names(&with(csvw, BARE))), (Role::Transmittance, vec!["glass"]));
}

#[test]
fn weak_words_suggest_and_a_sample_named_after_a_quantity_states_nothing() {
    for (head, role) in [
        ("s.e.irrad", Role::Illuminant),
        ("Intensity", Role::Illuminant),
        ("Relative power", Role::Illuminant),
        ("s.e.response", Role::Camera),
        ("Response", Role::Camera),
        ("Tfr", Role::Transmittance),
        ("Rfr", Role::Reflectance),
    ] {
        let table = ok(&format!("nm,{head}\n400,0.1\n500,0.2\n"));
        assert_eq!((table.role.value, table.role.certainty == Certainty::Open), (role, false), "{head}");
    }
    assert_eq!(ok("nm,Intensity\n400,1500\n500,2200\n").role.certainty, Certainty::Open, "counts, perhaps");
    let chart = ok("# Reflectance\nnm,radiance paint,bark\n400,0.1,0.2\n500,0.3,0.4\n");
    assert_eq!((chart.role.value, chart.role.certainty), (Role::Reflectance, Certainty::Guess));
}

#[test]
fn field_spectrometers_give_the_ratio_alone() {
    let svc = ok("/*** Spectra Vista SIG Data ***/\nname= leaf.sig\nunits= Radiance, Radiance\ndata=\n\
                  400.1  1000.0  120.0  12.0\n401.2  1000.0  150.0  15.0\n402.3  1000.0  200.0  20.0\n");
    assert_eq!((svc.role.value, svc.curves.len()), (Role::Reflectance, 1));
    assert_eq!(
        (svc.reading.quantity.value, svc.curves[0].values.as_slice()),
        (Quantity::Reflectance, &[0.12, 0.15, 0.2][..])
    );
    let sed = ok(
        "Wvl\tNorm. DN (Ref.)\tNorm. DN (Target)\tReflect. %\n400\t1.1\t0.2\t18.2\n401\t1.1\t0.3\t27.3\n402\t1.1\t0.3\t27.3\n",
    );
    assert_eq!((names(&sed).len(), sed.curves[0].values[0], sed.role.value), (1, 0.182, Role::Reflectance));
}

#[test]
fn values_that_no_quantity_has_are_not_usable() {
    let leaf = |value: &str| format!("nm,Reflectance\n400,0.1\n500,{value}\n600,0.2\n");
    for value in ["-7.2", "-0.06", "12.3", "1e308"] {
        let error = ok(&leaf(value)).usable().unwrap_err();
        assert!(matches!(error, ReadError::ImpossibleValues { .. }), "{value}: {error}");
    }
    assert_eq!(ok(&leaf("-7.2")).usable().unwrap_err().line(), Some(3));
    for value in ["-0.004", "1.3", "0"] {
        assert!(ok(&leaf(value)).usable().is_ok(), "{value}: noise, fluorescence");
    }
    let plain = ReadOptions { values: Some(Values::Plain), ..ReadOptions::default() };
    assert!(read(leaf("12.3").as_bytes(), &plain).unwrap().usable().is_ok(), "as chosen");
    assert!(ok("nm,Irradiance\n400,1e308\n500,2\n").usable().is_err());
    assert!(ok("nm,a\n400,-7.2\n500,2\n").usable().is_ok(), "what they are is asked first");
    let jcamp = "##TITLE=x\n##JCAMP-DX=4.24\n##DATA TYPE=UV/VIS SPECTRUM\n##XUNITS=NANOMETERS\n##YUNITS=REFLECTANCE\n\
                 ##XFACTOR=1\n##YFACTOR=1e308\n##FIRSTX=400\n##LASTX=420\n##NPOINTS=3\n##XYDATA=(X++(Y..Y))\n400 1210 1342 1500\n##END=\n";
    assert!(matches!(read(jcamp.as_bytes(), &ReadOptions::default()), Err(ReadError::TooGreat(_))));
}
