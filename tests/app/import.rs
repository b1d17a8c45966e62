//! From the bytes of a user's file to a set: names, roles, units and percent that can be flipped, channels, decisions.

use chromascope::catalog::import::import;
use chromascope::document::imported::{ImportedSet, Role, WavelengthUnit};

fn set(file: &str, text: &str, role: Option<Role>) -> ImportedSet {
    import(file, text.as_bytes(), role).unwrap().set
}

/// The first curve as it is computed with.
fn first(set: &ImportedSet) -> (Vec<f64>, Vec<f64>) {
    let (_, curve) = set.curves_in_nm().unwrap().remove(0);
    (curve.wavelengths_nm().to_vec(), curve.values().to_vec())
}

#[test]
fn a_title_names_a_set_and_else_its_file_does() {
    let rows = "nm,leaf\n400,0.1\n500,0.2\n600,0.3\n";
    assert_eq!(set("folder/oak leaf.csv", rows, None).name, "oak leaf");
    assert_eq!(set("oak.csv", &format!("# title: An oak's\n{rows}"), None).name, "An oak's");
    assert_eq!(set("oak.csv", &format!("# title: \n{rows}"), None).name, "oak");
    assert_eq!(set("clipboard", rows, None).file, "clipboard");
}

#[test]
fn an_only_curve_without_a_name_takes_the_sets() {
    assert_eq!(set("oak.txt", "400 0.1\n500 0.2\n600 0.3\n", None).curves[0].name, "oak");
    assert_eq!(set("oak.csv", "nm,leaf\n400,0.1\n500,0.2\n600,0.3\n", None).curves[0].name, "leaf");
    let two = set("oak.txt", "400 0.1 0.2\n500 0.2 0.3\n600 0.3 0.4\n", None);
    assert_ne!(two.curves[0].name, two.curves[1].name);
}

#[test]
fn a_role_given_is_kept_and_else_decided() {
    let rgb = "nm,red,green,blue\n400,0.1,0.2,0.9\n500,0.2,0.9,0.4\n600,0.9,0.3,0.1\n";
    assert_eq!(set("x.csv", rgb, None).role, Role::Camera);
    for role in [Role::Camera, Role::Reflectance, Role::Illuminant] {
        assert_eq!(set("x.csv", rgb, Some(role)).role, role);
    }
}

#[test]
fn percent_can_be_flipped_back_to_the_figures_written() {
    let text = "nm,leaf (%)\n400,5.5\n500,10\n600,99\n";
    let mut leaf = set("leaf.csv", text, Some(Role::Reflectance));
    assert!(leaf.percent);
    assert_eq!(first(&leaf).1, [0.055, 0.1, 0.99]);
    leaf.percent = false;
    let written = first(&leaf).1;
    assert!(written.iter().zip([5.5, 10.0, 99.0]).all(|(a, b)| (a - b).abs() <= 1e-14 * b), "{written:?}");
    leaf.percent = true;
    assert_eq!(first(&leaf).1, [0.055, 0.1, 0.99]);
}

#[test]
fn units_can_be_flipped_back_to_the_figures_written() {
    let text = "wavelength (µm),leaf\n0.38,0.1\n0.5,0.2\n0.78,0.3\n";
    let mut leaf = set("leaf.csv", text, Some(Role::Reflectance));
    assert_eq!(leaf.unit, WavelengthUnit::Micrometer);
    assert_eq!(first(&leaf).0, [380.0, 500.0, 780.0]);
    leaf.unit = WavelengthUnit::Nanometer;
    assert_eq!(first(&leaf).0, [0.38, 0.5, 0.78]);
    leaf.unit = WavelengthUnit::Angstrom;
    assert_eq!(first(&leaf).0, [0.038, 0.05, 0.078]);
}

#[test]
fn channels_are_found_by_name_and_else_are_the_first_three() {
    let of = |header: &str| {
        let columns = header.split(',').count() - 1;
        let row = |nm: u32| format!("{nm}{}\n", ",0.5".repeat(columns));
        let text = format!("{header}\n{}{}{}", row(400), row(500), row(600));
        set("camera.csv", &text, Some(Role::Camera)).channels
    };
    assert_eq!(of("nm,blue,green,red"), [2, 1, 0]);
    assert_eq!(of("nm,B,G,R,IR"), [2, 1, 0]);
    assert_eq!(of("nm,r_ssf,g_ssf,b_ssf"), [0, 1, 2]);
    assert_eq!(of("nm,one,two,three,four"), [0, 1, 2]);
}

#[test]
fn sensitivities_per_photon_are_known_by_their_header() {
    let rows = "nm,r,g,b\n400,0.1,0.2,0.9\n500,0.2,0.9,0.4\n600,0.9,0.3,0.1\n";
    assert!(!set("x.csv", rows, Some(Role::Camera)).per_photon);
    assert!(set("x.csv", &format!("# response: per photon\n{rows}"), Some(Role::Camera)).per_photon);
}

#[test]
fn every_decision_and_warning_is_kept() {
    let text = "600;50,5\n500;10,0\n500;10,0\n400;5,5\n";
    let imported = import("leaf.txt", text.as_bytes(), None).unwrap();
    let warnings = spectral_file::read(text.as_bytes(), &spectral_file::ReadOptions::default()).unwrap().warnings;
    let all = imported.set.decisions.join("\n");
    for said in ["decimal commas", "semicolon separated", "nanometers", "percent"] {
        assert!(all.contains(said), "{said} is not in:\n{all}");
    }
    for warning in &warnings {
        assert!(all.contains(&warning.to_string()), "{warning} is not in:\n{all}");
    }
    assert!(imported.guessed && imported.message.starts_with("leaf.txt: 1 curve"), "{}", imported.message);
    assert_eq!(imported.set.curves[0].wavelengths, [400.0, 500.0, 600.0]);
}

#[test]
fn what_cannot_be_read_says_the_line() {
    let error = import("x.csv", b"nm,a\n400,0.1\n500,oops\n600,0.3\n", None).unwrap_err();
    assert_eq!(error.line(), Some(3));
    assert!(import("x.csv", b"", None).is_err());
}

#[test]
fn percent_that_was_chosen_holds_for_every_role() {
    use chromascope::catalog::import::{Origin, import_as};
    use chromascope::document::imported::{ImportOverrides, ReadOptions};
    use spectral_file::{Values, Watch};
    let text = b"nm,r,g,b\n400,5,6,7\n500,50,60,70\n600,10,11,12\n";
    for role in [Role::Camera, Role::Illuminant, Role::Unknown, Role::Transmittance] {
        let options = ReadOptions { role: Some(role), values: Some(Values::Percent), ..ReadOptions::default() };
        let overrides = ImportOverrides { options, ..ImportOverrides::default() };
        let origin = Origin::named("x.csv", text);
        let mut set = import_as(&origin, text, &overrides, Watch::none()).unwrap().set;
        assert_eq!(first(&set).1, [0.05, 0.5, 0.1], "{role:?}");
        set.percent = false;
        assert_eq!(first(&set).1, [5.0, 50.0, 10.0], "{role:?}");
    }
}

#[test]
fn values_that_no_reflectance_has_are_refused_with_the_line() {
    let text = "nm,Reflectance\n400,0.1\n500,-7.2\n600,0.3\n";
    let error = import("x.csv", text.as_bytes(), None).unwrap_err().to_string();
    assert!(error.starts_with("line 3: ") && error.contains("-7.2") && error.contains("correct it"), "{error}");
    assert!(import("x.csv", text.as_bytes(), Some(Role::Camera)).is_ok(), "sensitivities may be negative");
}

#[test]
fn metadata_and_names_beside_a_file_say_what_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let lights = folder.path().join("illuminants");
    std::fs::create_dir(&lights).expect("made");
    let (bare, told) = (lights.join("a.csv"), folder.path().join("b.csv"));
    let rows = b"400,0.1\n500,0.2\n600,0.3\n";
    let cie = r#"{"datatableInfo": {"columnHeaders": [{"title": "lambda", "unit": "nm"}, {"title": "V(lambda)", "quantity": "spectral luminous efficiency"}]}}"#;
    std::fs::write(folder.path().join("b.csv_metadata.json"), cie).expect("written");
    for (path, role) in [(bare, Role::Illuminant), (told, Role::Camera)] {
        let origin = chromascope::catalog::import::Origin::on_disk("x", &path, rows);
        let overrides = chromascope::document::imported::ImportOverrides::default();
        let read =
            chromascope::catalog::import::import_as(&origin, rows, &overrides, spectral_file::Watch::none()).unwrap();
        assert_eq!(read.set.role, role, "{}", read.message);
        assert!(role == Role::Camera || read.guessed, "a name suggests: {}", read.message);
    }
}
