//! Every data file under `assets` says what it holds, in what unit, where it is from and under
//! what terms, and holds clean figures.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use chromascope::catalog::Catalog;
use chromascope::document::SetKind;
use chromascope_core::spectral::Dataset;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets");
const FOLDERS: [&str; 8] =
    ["observers", "cameras", "charts", "illuminants", "materials", "filters", "test-samples", "uncertainty"];
const RESPONSES: [&str; 5] =
    ["per energy (stated)", "per energy (inferred)", "per photon (stated)", "per photon (inferred)", "unknown"];
/// Header keys in the required order; the flag marks optional keys.
const KEYS: [(&str, bool); 11] = [
    ("title", false),
    ("also", true),
    ("found by", true),
    ("short", true),
    ("quantity", false),
    ("unit", false),
    ("response", true),
    ("origin", true),
    ("source", false),
    ("license", false),
    ("note", false),
];

/// A data file split into header, column heads and rows of fields, each with its line number.
struct DataFile {
    path: PathBuf,
    folder: &'static str,
    header: Vec<(usize, String, String)>,
    heads: Vec<String>,
    rows: Vec<(usize, Vec<String>)>,
}

impl DataFile {
    fn at(&self, line: usize) -> String {
        let name = self.path.strip_prefix(ROOT).unwrap_or(&self.path);
        format!("assets/{}:{line}", name.display())
    }

    fn value(&self, key: &str) -> Option<&str> {
        self.header.iter().find(|(_, k, _)| k == key).map(|(_, _, v)| v.as_str())
    }

    fn notes_mention(&self, words: &str) -> bool {
        self.header.iter().any(|(_, key, value)| key == "note" && value.contains(words))
    }

    fn is_sensitivity(&self) -> bool {
        matches!(self.folder, "observers" | "cameras")
    }

    /// Names under which the file's sets are found: the title, or the column heads where a file
    /// holds several sets.
    fn set_names(&self) -> Vec<String> {
        let several = matches!(self.folder, "illuminants" | "materials" | "filters") && self.heads.len() > 2;
        if several { self.heads[1..].to_vec() } else { self.value("title").map(str::to_owned).into_iter().collect() }
    }
}

fn data_files() -> Vec<DataFile> {
    FOLDERS.into_iter().flat_map(files_in).collect()
}

fn files_in(folder: &'static str) -> Vec<DataFile> {
    let directory = Path::new(ROOT).join(folder);
    let entries = fs::read_dir(&directory).unwrap_or_else(|error| panic!("{}: {error}", directory.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    paths.sort();
    paths.into_iter().map(|path| read(path, folder)).collect()
}

fn read(path: PathBuf, folder: &'static str) -> DataFile {
    assert_eq!(
        path.extension().and_then(|e| e.to_str()),
        Some("csv"),
        "{}: only CSV files belong here",
        path.display()
    );
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(!text.contains('\r'), "{}: line ends must be LF", path.display());
    let mut file = DataFile { path, folder, header: Vec::new(), heads: Vec::new(), rows: Vec::new() };
    for (index, line) in text.lines().enumerate() {
        let number = index + 1;
        if let Some(comment) = line.strip_prefix('#') {
            assert!(file.heads.is_empty(), "{}: a comment after the column heads", file.at(number));
            let entry = comment.strip_prefix(' ').and_then(|entry| entry.split_once(": "));
            let (key, value) = entry.unwrap_or_else(|| panic!("{}: not `# key: value`", file.at(number)));
            file.header.push((number, key.to_owned(), value.to_owned()));
        } else {
            let fields: Vec<String> = line.split(',').map(str::to_owned).collect();
            if file.heads.is_empty() {
                file.heads = fields;
            } else {
                file.rows.push((number, fields));
            }
        }
    }
    file
}

fn number(file: &DataFile, line: usize, field: &str) -> f64 {
    let value: f64 = field.parse().unwrap_or_else(|_| panic!("{}: `{field}` is not a number", file.at(line)));
    assert!(value.is_finite(), "{}: `{field}` is not finite", file.at(line));
    value
}

#[test]
fn headers_hold_the_required_keys_in_order() {
    for file in data_files() {
        for (key, optional) in KEYS {
            let required = if key == "response" { file.is_sensitivity() } else { !optional };
            assert!(!required || file.value(key).is_some(), "{}: no `# {key}:`", file.at(1));
        }
        let mut last = 0;
        for (line, key, value) in &file.header {
            let place = KEYS.iter().position(|(known, _)| known == key);
            let place = place.unwrap_or_else(|| panic!("{}: unknown key `{key}`", file.at(*line)));
            let repeated = place == last && *line > 1 && key != "note";
            assert!(place >= last && !repeated, "{}: `{key}` out of order or repeated", file.at(*line));
            assert!(
                !value.trim().is_empty() && value.trim() == value,
                "{}: `{key}` is empty or padded",
                file.at(*line)
            );
            last = place;
        }
    }
}

/// Names that raw files give to the cameras of the library, each once, without a parenthesis that no raw file has.
#[test]
fn models_of_raw_files_are_those_of_the_library() {
    let file = read(Path::new(ROOT).join("models/unique_camera_model.csv"), "models");
    let keys: Vec<&str> = file.header.iter().map(|(_, key, _)| key.as_str()).collect();
    assert!(keys.starts_with(&["title", "quantity", "unit", "source", "license", "note"]), "{keys:?}");
    assert_eq!(file.heads, ["name", "unique_camera_model"]);
    let mut listed = BTreeSet::new();
    for (line, row) in &file.rows {
        let [name, model] = row.as_slice() else { panic!("{}: two fields", file.at(*line)) };
        assert!(listed.insert(name.clone()), "{}: {name} twice", file.at(*line));
        assert!(model.is_ascii() && !model.contains('('), "{}: {model}", file.at(*line));
    }
    let catalog = Catalog::built_in();
    let names = catalog.of_kind(SetKind::Camera).map(|entry| entry.name.split(" (").next().unwrap().to_owned());
    let models: BTreeSet<String> = names.collect();
    let unlisted: Vec<&String> = models.difference(&listed).collect();
    assert_eq!(unlisted, ["ARRI D21", "Kodak DCS200"], "they write no raw file with such a name");
    assert!(listed.is_subset(&models), "{:?}", listed.difference(&models));
}

/// Meshes are OBJ files, in which a header is a comment too.
#[test]
fn meshes_have_headers_too() {
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("core/mesh/src")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "obj") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.len() <= 1_000_000 && !text.contains('\r'), "{}", path.display());
        let keys: Vec<&str> = text.lines().map_while(|line| line.strip_prefix("# ")?.split(": ").next()).collect();
        assert!(keys.starts_with(&["title", "quantity", "unit", "source", "license", "note"]), "{keys:?}");
        let license = text.lines().find_map(|line| line.strip_prefix("# license: ")).unwrap();
        assert!(license.starts_with("public domain"), "{license}");
    }
}

#[test]
fn sensitivities_say_per_energy_or_per_photon() {
    for file in data_files() {
        match file.value("response") {
            Some(response) => {
                assert!(file.is_sensitivity(), "{}: only observers and cameras have a response", file.at(1));
                assert!(
                    RESPONSES.contains(&response),
                    "{}: response `{response}` is none of {RESPONSES:?}",
                    file.at(1)
                );
            }
            None => assert!(!file.is_sensitivity(), "{}: no `# response:`", file.at(1)),
        }
    }
}

#[test]
fn licenses_name_an_existing_text_or_say_that_there_is_none() {
    for file in data_files() {
        let license = file.value("license").unwrap_or_else(|| panic!("{}: no `# license:`", file.at(1)));
        let named = license.split_once("(licenses/").and_then(|(_, rest)| rest.split_once(')')).map(|(name, _)| name);
        match named {
            Some(name) => {
                let text = Path::new(ROOT).join("licenses").join(name);
                assert!(text.is_file(), "{}: assets/licenses/{name} does not exist", file.at(1));
            }
            None => assert!(
                license.starts_with("no terms stated") || license.starts_with("public domain"),
                "{}: license `{license}` names no text under assets/licenses",
                file.at(1)
            ),
        }
    }
}

#[test]
fn tables_are_rectangular_finite_and_ascending() {
    for file in data_files() {
        let head_line = file.header.len() + 1;
        assert_eq!(
            file.heads.first().map(String::as_str),
            Some("wavelength_nm"),
            "{}: first column",
            file.at(head_line)
        );
        let distinct: BTreeSet<&String> = file.heads.iter().collect();
        assert_eq!(distinct.len(), file.heads.len(), "{}: two columns of one name", file.at(head_line));
        assert!(file.heads.len() > 1 && file.rows.len() > 1, "{}: no table", file.at(head_line));
        let mut previous = 0.0;
        for (line, fields) in &file.rows {
            assert_eq!(fields.len(), file.heads.len(), "{}: as many fields as column heads", file.at(*line));
            let values: Vec<f64> = fields.iter().map(|field| number(&file, *line, field)).collect();
            assert!(values[0] > previous, "{}: wavelength {} after {previous}", file.at(*line), values[0]);
            previous = values[0];
        }
    }
}

#[test]
fn sensitivities_have_the_columns_of_their_kind() {
    let observers = [["r_bar", "g_bar", "b_bar"], ["x_bar", "y_bar", "z_bar"], ["l_bar", "m_bar", "s_bar"]];
    for file in data_files().into_iter().filter(DataFile::is_sensitivity) {
        let heads: Vec<&str> = file.heads[1..].iter().map(String::as_str).collect();
        let fits = if file.folder == "cameras" {
            heads == ["red", "green", "blue"]
        } else {
            observers.iter().any(|kind| heads == kind)
        };
        assert!(fits, "{}: columns {heads:?}", file.at(file.header.len() + 1));
    }
}

#[test]
fn reflectances_are_plausible() {
    for file in data_files()
        .into_iter()
        .filter(|file| matches!(file.folder, "charts" | "materials" | "test-samples" | "filters"))
        .filter(|file| file.folder != "test-samples" || file.value("quantity") == Some("spectral radiance factor"))
    {
        // One fluorescent sample is higher; its file has to say so.
        let limit = if file.notes_mention("above 1.2") { 1.5 } else { 1.2 };
        let limit = if file.folder == "filters" { 1.0 } else { limit };
        for (line, fields) in &file.rows {
            for field in &fields[1..] {
                let value = number(&file, *line, field);
                assert!((0.0..=limit).contains(&value), "{}: reflectance {value} outside 0..{limit}", file.at(*line));
            }
        }
    }
}

#[test]
fn names_are_unique() {
    let mut titles = BTreeMap::new();
    let mut names = BTreeMap::new();
    for file in data_files() {
        let title = file.value("title").unwrap_or_default().to_owned();
        if let Some(other) = titles.insert((file.folder, title.clone()), file.at(1)) {
            panic!("{}: title `{title}` is also that of {other}", file.at(1));
        }
        // Lights and materials are picked from one list each, the other kinds by their titles.
        for name in file.set_names() {
            let list = if matches!(file.folder, "illuminants" | "materials") { "spectra" } else { file.folder };
            if let Some(other) = names.insert((list, name.clone()), file.at(1)) {
                panic!("{}: set `{name}` is also in {other}", file.at(1));
            }
        }
    }
}

#[test]
fn each_file_of_an_observer_or_camera_is_a_set() {
    let catalog = Catalog::built_in();
    for (folder, kind) in [("observers", SetKind::Observer), ("cameras", SetKind::Camera)] {
        let files = files_in(folder).len();
        assert!(files > 0 && catalog.of_kind(kind).count() == files, "{folder}: {files} files");
    }
}

/// The response's state is the one that the file's own notes give.
#[test]
fn what_a_note_infers_the_header_calls_inferred() {
    let mut counts = BTreeMap::new();
    for file in data_files().into_iter().filter(DataFile::is_sensitivity) {
        let response = file.value("response").unwrap_or_default();
        let inferred = file.notes_mention("Taken as per energy") || file.notes_mention("only if both are per energy");
        let silent = file.notes_mention("does not say per energy or per photon") && !inferred;
        let expected = match (inferred, silent) {
            (true, _) => "per energy (inferred)",
            (_, true) => "unknown",
            _ => "per energy (stated)",
        };
        assert_eq!(response, expected, "{}", file.at(1));
        if file.folder == "cameras" {
            *counts.entry(response.to_owned()).or_insert(0) += 1;
        }
        // Each state has its grounds in a note, which the window shows beside it.
        let header = Dataset::read_header(&fs::read_to_string(&file.path).unwrap()).unwrap();
        assert!(header.response_note().is_some(), "{}: no note gives the grounds", file.at(1));
    }
    let expected = [("per energy (inferred)", 54), ("per energy (stated)", 2), ("unknown", 2)];
    assert_eq!(counts, expected.map(|(response, count)| (response.to_owned(), count)).into());
}

#[test]
fn digitized_tables_say_so_and_come_after_measured_ones() {
    let digitized: Vec<String> =
        data_files().iter().filter(|file| file.value("origin").is_some()).map(|file| file.at(1)).collect();
    assert_eq!(
        digitized,
        ["assets/cameras/canon_eos_10d_2007_figure.csv:1", "assets/cameras/nikon_d70_2007_figure.csv:1"]
    );
    for file in data_files() {
        assert_eq!(file.value("origin").is_some(), file.notes_mention("Digitized from"), "{}", file.at(1));
        assert!(file.value("origin").is_none_or(|origin| origin == "digitized figure"), "{}", file.at(1));
    }
    let catalog = Catalog::built_in();
    let d70s: Vec<&str> = catalog
        .of_kind(SetKind::Camera)
        .map(|entry| entry.name.as_str())
        .filter(|name| name.starts_with("Nikon D70 "))
        .collect();
    assert_eq!(d70s, ["Nikon D70 (A.M.P.A.S.)", "Nikon D70 (UPenn 2011)", "Nikon D70 (2007 figure)"]);
}

/// Notes name other sets by the names that the catalog has.
#[test]
fn notes_name_sets_that_there_are() {
    let titles: BTreeSet<String> =
        data_files().iter().filter_map(|file| file.value("title").map(str::to_owned)).collect();
    for file in data_files() {
        for (line, key, value) in &file.header {
            for (before, after) in [("Differs from ", " by "), ("Close to ", ":"), ("same measurement as ", ":")] {
                let Some((_, rest)) = value.split_once(before).filter(|_| key == "note") else { continue };
                let Some((name, _)) = rest.split_once(after) else { continue };
                let name = name.split_once(", ").map_or(name, |(name, _)| name);
                assert!(titles.contains(name), "{}: no set is named `{name}`", file.at(*line));
            }
        }
    }
}

#[test]
fn nobody_says_that_the_dcs420_has_no_table() {
    let kodak = fs::read_to_string(Path::new(ROOT).join("cameras/kodak_dcs200.csv")).unwrap();
    assert!(kodak.contains("Zenodo 4297288") && !kodak.contains("No public table"));
}
