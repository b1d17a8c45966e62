//! Quantities, units and responses in headers, and the effect of each switch.

use proptest::prelude::*;
use spectral_file::write::{Format, Grid, Sheet, Trace, write};
use spectral_file::{
    Certainty, Delimiter, Medium, Orientation, Quantity, ReadOptions, Role, Values, WavelengthUnit, read,
};

use super::ok;

#[test]
fn quantities_and_units() {
    use {Certainty as Sure, Quantity as Is};
    for (text, unit, quantity, certainty) in [
        ("nm;Irradiance (W/m²/nm)\n400;3\n500;4\n", Some("W/m²/nm"), Is::Irradiance, Sure::Certain),
        ("nm;lamp (W/(m²·sr·nm))\n400;3\n500;4\n", Some("W/(m²·sr·nm)"), Is::Radiance, Sure::Certain),
        ("Wave;Lamp\n[nm];[µW/cm^2/nm]\n400;3\n500;4\n", Some("µW/cm^2/nm"), Is::Irradiance, Sure::Certain),
        ("Wave;Lamp\n[nm];[?W/cm?/nm]\n400;3\n500;4\n", Some("µW/cm²/nm"), Is::Irradiance, Sure::Certain),
        ("Wave;Lamp\n[nm];[ÂµW/cmÂ²/nm]\n400;3\n500;4\n", Some("µW/cm²/nm"), Is::Irradiance, Sure::Certain),
        ("Wave;Lamp\n[nm];[counts]\n400;3\n500;4\n", Some("counts"), Is::Counts, Sure::Certain),
        ("# unit: mW/nm\n400,300\n500,400\n", Some("mW/nm"), Is::RadiantFlux, Sure::Certain),
        ("Y Units: Reflectance (percent)\n400 30\n500 40\n", Some("percent"), Is::Reflectance, Sure::Certain),
        (
            "# quantity: quantum efficiency\nnm,R,G,B\n400,3,4,5\n500,4,5,6\n",
            None,
            Is::QuantumEfficiency,
            Sure::Certain,
        ),
        ("nm,Absorptance\n400,0.3\n500,0.4\n", None, Is::Absorptance, Sure::Certain),
        ("400,0.3\n500,0.4\n", None, Is::Unknown, Sure::Open),
        ("400,300\n500,400\n", None, Is::Unknown, Sure::Open),
    ] {
        let table = ok(text);
        assert_eq!(table.curves[0].unit.as_deref(), unit, "{text:?}");
        let decided = &table.reading.quantity;
        assert_eq!((decided.value, decided.certainty), (quantity, certainty), "{text:?}");
        assert!(table.decisions().iter().any(|decision| decision.what == "Quantity"));
    }
    let mangled = ok("Filename-->,x.IRR\nMode/Unit-->,Irradiance[?Watt/cm?]\nWavelength[nm],A1\n400.5,3\n401.5,4\n");
    assert_eq!((mangled.curves[0].unit.as_deref(), mangled.role.value), (Some("µWatt/cm²"), Role::Illuminant));
    assert_eq!(mangled.reading.quantity.value, Quantity::Irradiance);
}

#[test]
fn responses_per_photon() {
    let response = |text: &str| {
        let decided = ok(text).reading.per_photon?;
        Some((decided.value, decided.certainty))
    };
    let rows = "nm,R,G,B\n400,0.1,0.2,0.3\n500,0.2,0.3,0.4\n";
    assert_eq!(response(&format!("# response: per photon\n{rows}")), Some((true, Certainty::Certain)));
    assert_eq!(response(&format!("# response: per energy\n{rows}")), Some((false, Certainty::Certain)));
    // As in the program's own tables: what is stated is certain, what is inferred stays a guess.
    for (said, expected) in [
        ("per photon (stated)", (true, Certainty::Certain)),
        ("per energy (stated)", (false, Certainty::Certain)),
        ("per photon (inferred)", (true, Certainty::Guess)),
        ("per energy (inferred)", (false, Certainty::Guess)),
    ] {
        assert_eq!(response(&format!("# response: {said}\n{rows}")), Some(expected), "{said}");
    }
    assert_eq!(response(rows), Some((false, Certainty::Guess)));
    assert_eq!(response("nm,QE R,QE G,QE B\n400,5,6,7\n500,6,7,8\n"), Some((true, Certainty::Certain)));
    assert_eq!(response("nm,a\n400,0.1\n500,0.2\n"), None);
}

#[test]
fn absorbances_and_decibels() {
    let absorbed = ok("nm,Absorbance of leaf\n400,1\n500,2\n");
    assert_eq!(
        (absorbed.reading.values.value, absorbed.reading.values.certainty),
        (Values::Absorbance, Certainty::Certain)
    );
    assert_eq!((absorbed.role.value, absorbed.curves[0].values.as_slice()), (Role::Transmittance, &[0.1, 0.01][..]));
    let reflected = ok("nm,Absorbance (log 1/R reflectance)\n400,1\n500,2\n");
    assert_eq!((reflected.role.value, reflected.curves[0].values[0]), (Role::Reflectance, 0.1));
    let light = ok("nm,Power (dBm)\n400,-10\n500,-20\n");
    assert_eq!((light.role.value, light.curves[0].values.as_slice()), (Role::Illuminant, &[0.1, 0.01][..]));
    assert_eq!(ok("nm,a (A.U.)\n400,1\n500,1.1\n").reading.values.value, Values::Plain);
}

#[test]
fn converted_values_have_other_names_and_units() {
    for (head, name, unit) in [
        ("Absorbance of leaf", "Transmittance of leaf", Some("1")),
        ("Optical density", "Transmittance", Some("1")),
        ("Signal dBm", "Signal mW", Some("mW")),
        ("Power (dBm)", "Power", Some("mW")),
        ("gain dB", "gain", None),
        ("leaf (a.u.)", "leaf", Some("a.u.")),
    ] {
        let table = ok(&format!("wavelength;{head};\n400;1;\n500;2;\n").replace(";\n", "\n"));
        let [curve] = table.curves.as_slice() else { panic!("{head}") };
        assert_eq!((curve.name.as_str(), curve.unit.as_deref()), (name, unit), "{head}");
        let trace = Trace::from(curve);
        let sheet = Sheet { curves: &[trace], ..Sheet::default() };
        let again = ok(&write(&sheet, Format::Csv, Grid::Native).unwrap().text);
        assert_eq!(again.curves[0].values, curve.values, "{head}");
    }
    let plain = ReadOptions { values: Some(Values::Plain), ..ReadOptions::default() };
    let table = read(b"nm;Power (dBm)\n400;1\n500;2\n", &plain).unwrap();
    assert_eq!((table.curves[0].values[1], table.curves[0].unit.as_deref()), (2.0, None));
}

#[test]
fn evidence_names_columns_as_the_file_does() {
    let said = |text: &str| ok(text).decisions().iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(said("nm,Reflectance\n400,0.3\n500,0.4\n").contains("A column is named “Reflectance”"));
    let mixed = said("nm,Reflectance (%),Absorbance\n400,40,0.5\n500,50,0.5\n");
    assert!(mixed.contains("some percent, others absorbances") && !mixed.contains("only they"), "{mixed}");
}

#[test]
fn air_and_vacuum() {
    let table = ok("#XAxisUnit;nm_vac\n400;300\n500;400\n");
    let medium = table.reading.notes.iter().find(|note| note.what == "Medium").unwrap();
    assert_eq!((medium.value.as_str(), medium.why.as_str()), (Medium::Vacuum.to_string().as_str(), "Line 1 says so"));
}

#[test]
fn json_says_where_it_says_so() {
    let text = "{\"header\": {\n\"manufacturer\": \"Nobody\",\n\"model\": \"N1\"},\n\"spectral_data\": {\n\"units\": \"relative\",\n\"index\": {\"main\": [\"R\", \"G\", \"B\"]},\n\"data\": {\"main\": {\"400\": [1, 2, 3], \"410\": [2, 3, 4]}}}}";
    let said: Vec<String> = ok(text).decisions().iter().map(ToString::to_string).collect();
    assert!(said.contains(&"Line 3 has “model”: read as Nobody N1.".to_owned()), "{said:#?}");
    assert!(said.contains(&"Line 5 has “units”: read as relative.".to_owned()), "{said:#?}");
    let text = "// x\n{ \"bands\": [400, 420, 10],\n\"scale\": 100,\n\"spectrum\": [5, 6, 7] }";
    let said: Vec<String> = ok(text).decisions().iter().map(ToString::to_string).collect();
    assert!(said.contains(&"Line 3 has “scale”: read as divided by 100.".to_owned()), "{said:#?}");
}

proptest! {
    #[test]
    fn flipping_a_switch_back_gives_the_first_table(
        values in prop::collection::vec(0.001_f64..120.0, 2..20),
        header in prop::sample::select(vec!["", "nm;a\n", "nm;Reflectance (%)\n", "nm;Transmittance\n", "nm;Absorbance\n"]),
    ) {
        let rows = values.iter().enumerate().map(|(i, value)| format!("{};{value}\n", 400 + 10 * i));
        let text = header.to_owned() + &rows.collect::<Vec<_>>().concat();
        let first = ok(&text);
        let reading = &first.reading;
        let back = ReadOptions {
            values: Some(reading.values.value),
            role: Some(first.role.value),
            wavelength_unit: Some(WavelengthUnit::Nanometer),
            wavelength_column: reading.wavelength_column,
            part: Some(reading.part.value),
            delimiter: Some(Delimiter::Semicolon),
            orientation: Some(Orientation::Down),
            ..ReadOptions::default()
        };
        let again = read(text.as_bytes(), &back).unwrap();
        prop_assert_eq!(&again.curves, &first.curves);
        prop_assert_eq!(again.role.value, first.role.value);
        let plain = read(text.as_bytes(), &ReadOptions { values: Some(Values::Plain), ..ReadOptions::default() }).unwrap();
        prop_assert_eq!(&plain.curves[0].values, &values);
    }
}

#[test]
fn a_unit_alone_and_other_languages_name_the_column_of_wavelengths() {
    for head in ["Wellenlänge [nm]", "Longueur d'onde (nm)", "λ", "波長", "x (nm)"] {
        let table = ok(&format!("Pixel;{head};Blatt (%)\n1;500,5;10\n2;501,5;20\n3;502,5;30\n4;503,5;40\n"));
        assert_eq!(table.curves[0].wavelengths_nm[0], 500.5, "{head}");
        assert_eq!(table.reading.wavelength_column, Some(2), "{head}");
    }
}
