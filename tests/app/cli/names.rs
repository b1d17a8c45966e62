//! Names as people type them: exact ones, standard designations, whole words, parts.

use chromascope::catalog::Catalog;
use chromascope::catalog::names::{Found, NameError, find};
use chromascope::document::SetKind;

use super::{column, refused, run, table};

fn found(catalog: &Catalog, kind: SetKind, name: &str) -> Result<(String, bool), NameError> {
    let Found { entry, exact, .. } = find(catalog.of_kind(kind), kind.label(), name)?;
    Ok((entry.name.clone(), exact))
}

/// The name and what is said about it.
fn taken(kind: SetKind, name: &str) -> (String, Option<String>) {
    let catalog = Catalog::built_in();
    let found = find(catalog.of_kind(kind), kind.label(), name).unwrap_or_else(|error| panic!("{name}: {error}"));
    (found.entry.name.clone(), found.note())
}

#[test]
fn every_built_in_name_finds_exactly_itself() {
    let catalog = Catalog::built_in();
    for entry in catalog.entries() {
        let name = &entry.name;
        let spaced: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
        let bare: String = name.chars().filter(|c| c.is_alphanumeric()).collect();
        for typed in [name.clone(), name.to_lowercase(), name.to_uppercase(), spaced, bare] {
            assert_eq!(found(&catalog, entry.kind, &typed), Ok((name.clone(), true)), "{typed}");
        }
    }
}

#[test]
fn standard_designations_are_exact() {
    for (kind, typed, name) in [
        (SetKind::Illuminant, "CIE D65", "D65"),
        (SetKind::Illuminant, "CIE D50", "D50"),
        (SetKind::Illuminant, "CIE A", "A"),
        (SetKind::Illuminant, "illuminant A", "A"),
        (SetKind::Illuminant, "CIE standard illuminant D65", "D65"),
        (SetKind::Illuminant, "CIE Illuminant ID65", "ID65"),
        (SetKind::Illuminant, "ID50", "ID50"),
        (SetKind::Illuminant, "CIE FL3.1", "FL3.1"),
        (SetKind::Observer, "CIE 1931 2 degree standard observer", "CIE 1931 2°"),
        (SetKind::Observer, "1964 10deg", "CIE 1964 10°"),
        (SetKind::Observer, "CIE 1931 2º", "CIE 1931 2°"),
    ] {
        assert_eq!(taken(kind, typed), (name.to_owned(), None), "{typed}");
    }
}

#[test]
fn whole_words_win_over_parts_and_what_was_taken_is_known() {
    for (kind, typed, name) in [
        (SetKind::Observer, "CIE 1931 standard observer", "CIE 1931 2°"),
        (SetKind::Camera, "5D Mark II", "Canon EOS 5D Mark II"),
        (SetKind::Camera, "5D Mark III", "Canon EOS 5D Mark III"),
        (SetKind::Camera, "EOS R", "Canon EOS R"),
        (SetKind::Camera, "EOS R5", "Canon EOS R5"),
        (SetKind::Camera, "D200", "Nikon D200"),
        (SetKind::Camera, "10D", "Canon EOS 10D (2007 figure)"),
        (SetKind::Camera, "EOS 400D", "Canon Digital Rebel XTi"),
        (SetKind::Illuminant, "tungst", "ISO 7589 studio tungsten"),
        (SetKind::Illuminant, "tungsten", "ISO 7589 studio tungsten"),
    ] {
        assert_eq!(taken(kind, typed), (name.to_owned(), Some(format!("using {name}"))), "{typed}");
    }
    // Of several tables of one model the first that was measured, and the others are named.
    for typed in ["Nikon D70", "d70"] {
        let (name, note) = taken(SetKind::Camera, typed);
        let expected = "using Nikon D70 (A.M.P.A.S.); also there: Nikon D70 (2007 figure), Nikon D70 (UPenn 2011)";
        assert_eq!(name, "Nikon D70 (A.M.P.A.S.)");
        let mut parts: Vec<&str> = note.as_deref().unwrap().split([';', ',']).collect();
        parts[1] = parts[1].trim_start_matches(" also there:");
        parts[1..].sort_unstable();
        let mut wanted: Vec<&str> = expected.split([';', ',']).collect();
        wanted[1] = wanted[1].trim_start_matches(" also there:");
        wanted[1..].sort_unstable();
        assert_eq!(parts, wanted);
    }
}

#[test]
fn what_could_be_several_is_refused() {
    let catalog = Catalog::built_in();
    for (kind, typed) in [
        (SetKind::Camera, "Nikon"),
        (SetKind::Camera, "Mark II"),
        (SetKind::Camera, "EOS-1Ds"),
        (SetKind::Observer, "2°"),
        (SetKind::Observer, "Stiles & Burch"),
        (SetKind::Illuminant, "FL3.1x"),
        (SetKind::Illuminant, ""),
        (SetKind::Illuminant, "°"),
        (SetKind::Material, "skin"),
    ] {
        assert!(found(&catalog, kind, typed).is_err(), "{typed}");
    }
}

#[test]
fn the_command_line_says_what_was_taken() {
    let stderr = |arguments: &[&str]| {
        let output = run(&[&["patches", "--camera", "Kodak DCS200"], arguments].concat());
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(stderr(&["--illuminant", "CIE D65"]), "");
    let said = stderr(&["--illuminant", "tungst"]);
    assert_eq!(said, "chromascope: --illuminant \"tungst\": using ISO 7589 studio tungsten\n");
    assert!(stderr(&["--white", "tungsten"]).starts_with("chromascope: --white-balance \"tungsten\": using ISO"));
    for typed in ["daylight", "CIE daylight", "Daylight illuminant"] {
        refused(&["patches", "--illuminant", typed], &["daylight:5500", "Daylight (Stanford)"]);
        refused(&["patches", "--white", typed], &["daylight:5500"]);
    }
    refused(&["patches", "--illuminant", "blackbody"], &["blackbody:5500"]);
    assert!(run(&["patches", "--illuminant", "Daylight (Stanford)"]).status.success());
}

/// x and y of a perfect diffuser under D65 and D50 over 380 to 780 nm, not of ID65 and ID50.
#[test]
fn cie_d65_is_not_id65() {
    let chart = super::file("diffuser_for_names.csv", "wavelength_nm,white\n380,1\n780,1\n");
    let of = |light: &str| {
        let chart = chart.to_str().unwrap();
        let rows = table(&["patches", "--chart", chart, "--observer", "CIE 1931 2°", "--illuminant", light]);
        assert!(["D65", "D50"].contains(&column(&rows, "illuminant")[0]));
        ["x", "y"].map(|head| format!("{:.5}", super::number(column(&rows, head)[0])))
    };
    assert_eq!(of("CIE D65"), ["0.31274", "0.32905"]);
    assert_eq!(of("CIE D50"), of("D50"));
}

#[test]
fn a_built_in_sets_name_means_it_even_beside_a_file_that_is_called_so() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("shadow");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("D65"), "wavelength_nm,D65\n380,1\n780,9\n").unwrap();
    let patches = |illuminant: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_chromascope"));
        let arguments = ["patches", "--chart", "ColorChecker five", "--illuminant", illuminant];
        let output = command.args(arguments).current_dir(&folder).output().unwrap();
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let (built_in, said) = patches("D65");
    assert!(said.contains("using the built-in data set; for the file, write ./D65"), "{said}");
    assert!(built_in.contains("0.542363476"), "red under D65: {built_in}");
    assert_ne!(patches("./D65").0, built_in);
}

#[test]
fn a_mistyped_command_is_named() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_chromascope")).arg("lists").output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && said.contains("lists: no such command or file"), "{said}");
}

#[test]
fn help_of_a_command_that_does_not_exist_is_refused() {
    let of = |arguments: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_chromascope")).args(arguments).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, said) = of(&["rank", "--help"]);
    assert!(code == Some(2) && said.contains("rank: no such command or file"), "{said}");
    for known in [&["compare", "--help"][..], &["--help"], &["help"], &["help", "compare"]] {
        assert_eq!(of(known), (Some(0), String::new()), "{known:?}");
    }
}

#[test]
fn a_phone_is_said_to_be_none_of_the_cameras() {
    for phone in ["iPhone", "Nokia 808", "Pixel 8"] {
        refused(&["patches", "--camera", phone], &["no phone is among the built-in cameras", "name a file"]);
    }
}
