//! Files that `inspect` writes: uncertainties and what stands beside them, names of files, and what is not written over.

use std::fs;
use std::path::Path;

use chromascope::catalog::import::{Origin, import_as};
use chromascope::document::imported::{ImportOverrides, ImportedCurve, ImportedSet};
use spectral_file::Watch;

use super::inspect::{folder, inspect, json, put, said};
use super::refused;

const LEAVES: &str = "nm;young (%);U (k=2);old (%);U (k=2)\n400;5,5;0,3;7;0,1\n410;6,0;0,7;8;0,9\n420;8,25;0,9;9;0,3\n";

fn read(path: &Path) -> ImportedSet {
    let bytes = fs::read(path).unwrap();
    let origin = Origin::on_disk(path.file_name().unwrap().to_str().unwrap(), path, &bytes);
    import_as(&origin, &bytes, &ImportOverrides::default(), Watch::none()).unwrap().set
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Names of the files in a folder.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    names.into_iter().map(|name| name.to_string_lossy().into_owned()).collect()
}

fn matrix(size: usize) -> String {
    let value = |row: usize, column: usize| if row == column { 0.25 } else { 0.01 / (1 + row.abs_diff(column)) as f64 };
    let row = |row: usize| (0..size).map(|column| value(row, column).to_string()).collect::<Vec<_>>().join(",") + "\n";
    (0..size).map(row).collect()
}

#[test]
fn uncertainties_are_written_and_read_back_in_every_way() {
    let folder = folder("uncertain");
    let leaves = put(&folder, "leaves.txt", LEAVES);
    put(&folder, "leaves.cov.csv", &matrix(6));
    let known = read(Path::new(&leaves));
    assert!(known.covariance.is_some() && known.curves.iter().all(|curve| curve.uncertainty.is_some()));
    for (at, arguments) in
        [&["--csv"][..], &["--notes", "--csv"], &["--notes", "--out"], &["--out"]].into_iter().enumerate()
    {
        let out = folder.join(format!("out{at}.csv"));
        let output = inspect(&[&[leaves.as_str()], arguments, &[text(&out)]].concat());
        assert!(output.status.success() && said(&output).1.is_empty(), "{arguments:?}: {}", said(&output).1);
        let again = read(&out);
        // Fractions are written, of percent.
        let of = |set: &ImportedSet| {
            set.curves.iter().map(|curve| ImportedCurve { unit: None, ..curve.clone() }).collect::<Vec<_>>()
        };
        assert_eq!((of(&again), &again.covariance), (of(&known), &known.covariance), "{arguments:?}");
        let described = folder.join(format!("out{at}.csv-metadata.json")).exists();
        assert_eq!(described, arguments == ["--out"], "{arguments:?}");
        let head = "young [reflectance factor in 1],young [expanded uncertainty (k=2) in 1],old [";
        assert!(fs::read_to_string(&out).unwrap().contains(head));
    }
    // A covariance has no place in a stream, and other formats none for uncertainties.
    let output = inspect(&[&leaves, "--csv", "-"]);
    assert!(said(&output).1.contains("written: the covariance of the samples is not written"), "{}", said(&output).1);
    let cgats = folder.join("leaves.cgats");
    let output = inspect(&[&leaves, "--format", "cgats", "--out", text(&cgats)]);
    assert!(
        said(&output).1.contains("written: uncertainties of the values are not in the file"),
        "{}",
        said(&output).1
    );
    for step in [&[][..], &["--step", "5"]] {
        let curve = &json(&[&[leaves.as_str()], step].concat())["curves"][1];
        let standard = curve["standard_uncertainty"].as_array().unwrap();
        assert_eq!((standard.len(), &curve["coverage_factor"]), (if step.is_empty() { 3 } else { 5 }, &2.0.into()));
        assert_eq!(standard.last().unwrap(), 0.003 / 2.0);
    }
    // Each table is described by its own files alone.
    let plain = put(&folder, "plain.csv", "nm,Reflectance\n400,0.5\n410,0.6\n");
    let out = folder.join("out3.csv");
    refused(&["inspect", &plain, "--csv", text(&out)], &["out3.csv-metadata.json", "exists", "--force"]);
    let output = inspect(&[&plain, "--csv", text(&out), "--force"]);
    let told = said(&output).1;
    assert!(told.contains("out3.csv-metadata.json of the former table is removed"), "{told}");
    assert!(told.contains("out3.cov.csv of the former table is removed"), "{told}");
    assert!(!folder.join("out3.csv-metadata.json").exists() && !folder.join("out3.cov.csv").exists());
    assert_eq!(read(&out).covariance, None);
}

#[test]
fn what_stands_beside_a_file_that_is_read_is_not_written_over_either() {
    let folder = folder("beside");
    let leaves = put(&folder, "leaves.txt", LEAVES);
    let beside = put(&folder, "leaves.cov.csv", &matrix(6));
    for arguments in [&["--csv"][..], &["--force", "--csv"], &["--force", "--out"]] {
        let out = folder.join("leaves.csv");
        let output = inspect(&[&[leaves.as_str()], arguments, &[text(&out)]].concat());
        let told = said(&output).1;
        assert!(!output.status.success() && told.contains("leaves.cov.csv") && told.contains("reads it"), "{told}");
        assert!(!out.exists() && fs::read_to_string(&beside).unwrap() == matrix(6));
    }
    let metadata = put(&folder, "mine.csv-metadata.json", "{\"dc:title\": \"Mine\"}");
    let mine = put(&folder, "mine.csv", "nm,Reflectance\n400,0.5\n410,0.6\n");
    refused(&["inspect", &mine, "--force", "--format", "dcamprof", "--out", &metadata], &["reads it"]);
    refused(&["inspect", &leaves, &mine, "--force", "--out", text(&folder)], &["reads it"]);
}

#[test]
fn names_of_files_do_not_collide_nor_grow_too_long() {
    let folder = folder("names");
    let rows = "400 0.5\n500 0.6\n";
    let long = "é".repeat(125);
    let hostile = [
        "A.txt",
        "a.dat",
        "a.cov.txt",
        "a",
        ".hidden",
        "-2.txt",
        "a b;c,\"d\".txt",
        &format!("{long}.dat"),
        &format!("{long}x"),
    ];
    let mut files: Vec<String> = hostile.iter().map(|name| put(&folder, name, rows)).collect();
    #[cfg(unix)]
    files.push(put(&folder, "two\nlines.txt", rows));
    let out = folder.join("out");
    for format in ["csv", "sp"] {
        let arguments = ["--role", "reflectance", "--format", format, "--out", text(&out)];
        let output = inspect(&[files.iter().map(String::as_str).collect::<Vec<_>>(), arguments.to_vec()].concat());
        assert!(output.status.success(), "{}", said(&output).1);
        let made =
            names(&out).into_iter().filter(|name| Path::new(name).extension().is_some_and(|known| known == format));
        let made: Vec<String> = made.collect();
        assert_eq!(made.len(), files.len(), "{made:?}");
        for name in &made {
            assert_eq!(read(&out.join(name)).curves[0].values, [0.5, 0.6], "{name}");
            assert_eq!(out.join(format!("{name}-metadata.json")).exists(), format == "csv", "{name}");
        }
    }
    // All at once or none: one that is there keeps the others back.
    let other = folder.join("other");
    fs::create_dir(&other).unwrap();
    let taken = put(&other, "a.csv-metadata.json", "mine");
    let (a, c) = (put(&folder, "a.txt", rows), put(&folder, "c.txt", rows));
    refused(&["inspect", &a, &c, "--role", "reflectance", "--out", text(&other)], &["a.csv-metadata.json", "exists"]);
    assert_eq!(
        (names(&other), fs::read_to_string(&taken).unwrap()),
        (vec!["a.csv-metadata.json".to_owned()], "mine".to_owned())
    );
    let output = inspect(&[&a, &c, "--role", "reflectance", "--out", text(&other), "--force"]);
    assert!(output.status.success(), "{}", said(&output).1);
    let wanted = ["a.csv", "a.csv-metadata.json", "c.csv", "c.csv-metadata.json"];
    assert_eq!(names(&other), wanted);
}

/// One part of a file, under the name of the file, with all that is known about it.
#[test]
fn one_part_goes_out_alone() {
    let folder = folder("part");
    let two = "SPECT\n\nDESCRIPTOR \"two\"\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSPEC_400 SPEC_500 SPEC_600\nEND_DATA_FORMAT\n\
               NUMBER_OF_SETS 1\nBEGIN_DATA\n1 2 3\nEND_DATA\n";
    let file = put(&folder, "two.sp", &format!("{two}{}", two.replace("1 2 3", "4 5 6")));
    let out = folder.join("second.csv");
    let output = inspect(&[&file, "--part", "2", "--role", "illuminant", "--out", text(&out)]);
    assert!(output.status.success(), "{}", said(&output).1);
    assert_eq!(read(&out).curves[0].values, [4.0, 5.0, 6.0]);
    let metadata = fs::read_to_string(folder.join("second.csv-metadata.json")).unwrap();
    for known in [
        "\"dc:title\": \"two\"",
        "{ \"source\": \"two.sp\" }",
        "{ \"quantity\": \"",
        "read as part 2 of 2, from line 21. (chosen)\" }",
    ] {
        assert!(metadata.contains(known), "{known}: {metadata}");
    }
}
