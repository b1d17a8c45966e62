//! Names, files, ends of ranges, where tables go, and what a failure leaves behind.

use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{file, number, refused, run, table};

pub(super) fn asset(path: &str) -> String {
    format!("{}/assets/{path}", env!("CARGO_MANIFEST_DIR"))
}

/// The figures of a built-in set, without its facts.
fn figures(path: &str) -> String {
    let text = std::fs::read_to_string(asset(path)).unwrap();
    text.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect()
}

pub(super) fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn code(arguments: &[&str]) -> Option<i32> {
    run(arguments).status.code()
}

#[test]
fn ends_are_exact_whichever_way() {
    let of = |arguments: &[&str]| -> Vec<String> {
        let rows = table(&[&["locus", "--camera", "Nikon D70 (2007 figure)"], arguments].concat());
        rows[1..].iter().map(|row| row[1].clone()).collect()
    };
    assert_eq!(of(&["--from", "2856.5", "--to", "6504", "--count", "2"]), ["2856.5", "6504"]);
    assert_eq!(of(&["--from", "6000", "--to", "3000", "--count", "3"]), ["6000", "4000", "3000"]);
    assert_eq!(of(&["--count", "1"]), ["1000"]);
    assert_eq!(of(&["--from", "1", "--to", "1e15", "--count", "2"]), ["1", "1000000000000000"]);
}

#[test]
fn exact_names_win_over_parts() {
    let of = |name: &str| table(&["locus", "--camera", name, "--count", "1"])[1][0].clone();
    assert_eq!(of("NIKON-D70 2007 figure"), "Nikon D70 (2007 figure)");
    assert_eq!(of("d70 ampas"), "Nikon D70 (A.M.P.A.S.)");
    let chart = |name: &str| table(&["patches", "--chart", name, "--camera", "Nikon D70 (2007 figure)"]);
    assert_eq!(chart("five").len(), 1 + 5);
    assert_eq!(chart("colorchecker ohta 1997"), chart("ColorChecker 24 (Ohta 1997)"));
    assert_eq!(chart("fern")[1][1], "Fern-like bush leaf 024 (Vrhel)");
    refused(&["patches", "--chart", "ColorChecker fve"], &["did you mean ColorChecker five"]);
}

#[test]
fn the_default_reference_is_cie_1931() {
    let fitted = ["locus", "--camera", "Nikon D70 (2007 figure)", "--count", "5"];
    let named = |name: &'static str| table(&[&fitted[..], &["--reference", name]].concat());
    assert_eq!(table(&fitted), named("CIE 1931 2°"));
    assert_ne!(table(&fitted), named("CIE 1964 10°"));
}

#[test]
fn a_light_and_a_chart_from_files_are_as_built_in() {
    let light = file("lamp.csv", &figures("illuminants/d65.csv"));
    let chart = file("checker.csv", &figures("charts/colorchecker_24_ohta_1997.csv"));
    let of = |arguments: &[&str]| table(&[&["patches", "--camera", "Canon EOS 10D (2007 figure)"], arguments].concat());
    let built_in = of(&["--illuminant", "D65"]);
    let numbers = |rows: &[Vec<String>]| rows.iter().map(|row| row[..19].to_vec()).collect::<Vec<_>>();
    let from_file = of(&["--illuminant", text(&light)]);
    assert_eq!(numbers(&from_file), numbers(&built_in));
    assert_eq!(super::column(&from_file, "illuminant")[0], "lamp");
    assert_eq!(of(&["--illuminant", "D65", "--chart", text(&chart)]), built_in);
    // Its own title is that of the built-in set, so that its path distinguishes the two; the same file twice is one
    // sensor.
    let path = asset("cameras/nikon_d70_2007_figure.csv");
    let rows =
        table(&["locus", "--camera", &path, "--camera", "Nikon D70 (2007 figure)", "--camera", &path, "--count", "1"]);
    assert_eq!(rows[1][0], format!("Nikon D70 (2007 figure) ({path})"));
    assert_eq!(rows[1], rows[3]);
    assert_eq!(rows[1][1..], rows[2][1..]);
}

#[test]
fn what_was_guessed_is_said_beside_the_table() {
    let leaf = file("bare leaf.txt", "# quantity: reflectance\n400 5.5\n500 10\n600 99\n700 80\n");
    let output = run(&["patches", "--chart", text(&leaf), "--camera", "Nikon D70 (2007 figure)"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && said.contains("read as percent"), "{said}");
    let rows = String::from_utf8(output.stdout).unwrap();
    assert!(rows.lines().nth(1).unwrap().starts_with("Nikon D70 (2007 figure),bare leaf,0."), "{rows}");
    assert!(run(&["locus", "--camera", &asset("cameras/kodak_dcs200.csv")]).stderr.is_empty(), "nothing to guess");
}

#[test]
fn numbers_without_a_word_are_what_an_option_says_and_nothing_is_scaled_unasked() {
    let bare = file("bare.txt", "400 5.5\n500 10\n600 99\n700 80\n");
    let said = |output: &std::process::Output| String::from_utf8(output.stderr.clone()).unwrap();
    let refused = run(&["patches", "--chart", text(&bare)]);
    assert!(!refused.status.success() && refused.stdout.is_empty(), "{}", said(&refused));
    assert!(
        said(&refused).contains("Values reach 99, and nothing says whether they are percent; add --values percent")
    );
    let percent = run(&["patches", "--chart", text(&bare), "--values", "percent"]);
    assert!(percent.status.success(), "{}", said(&percent));
    assert!(said(&percent).contains("the file does not state its quantity; used as reflectances"));
    let light = run(&["locus", "--illuminant", text(&bare), "--count", "1"]);
    assert!(light.status.success() && said(&light).contains("used as illuminants"), "{}", said(&light));
    let inspected = run(&["inspect", text(&bare)]);
    assert!(inspected.status.success(), "{}", said(&inspected));
    assert!(said(&inspected).contains("add --role reflectance --values percent"), "{}", said(&inspected));
}

#[test]
fn radiances_are_no_chart() {
    let radiances = file("radiances.csv", "nm,Radiance a,Radiance b\n400,0.1,2\n500,0.2,3\n700,0.3,4\n");
    let output = run(&["patches", "--chart", text(&radiances)]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        !output.status.success() && said.contains("the file states radiance") && said.contains("--radiance"),
        "{said}"
    );
}

#[test]
fn a_file_of_another_quantity_is_refused_with_the_remedy() {
    let lamp = file("power_lamp.csv", "nm,Relative power\n400,0.1\n500,0.5\n700,0.9\n");
    let leaf = file("stated_leaf.csv", "nm,Reflectance\n400,0.1\n500,0.5\n700,0.9\n");
    refused(&["patches", "--chart", text(&lamp)], &["power_lamp.csv", "Relative power", "--illuminant"]);
    refused(&["compare", "--chart", text(&lamp)], &["power_lamp.csv", "--illuminant"]);
    refused(&["patches", "--illuminant", text(&leaf)], &["stated_leaf.csv", "reflectance", "--chart"]);
    refused(&["locus", "--camera", text(&leaf)], &["stated_leaf.csv", "reflectance", "--chart"]);
    let bad = file("negative_leaf.csv", "nm,Reflectance\n400,0.1\n500,-7.2\n700,0.9\n");
    refused(&["patches", "--chart", text(&bad)], &["negative_leaf.csv", "line 3", "-7.2", "correct it"]);
    let bare = file("bare_leaf.csv", "400,0.1\n500,0.5\n700,0.9\n");
    for (option, role) in [("--chart", "reflectances"), ("--illuminant", "illuminants")] {
        let output = run(&["patches", option, text(&bare)]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success() && said.contains(&format!("used as {role} because of the option")), "{said}");
    }
}

#[test]
fn fields_with_commas_are_quoted() {
    let camera = format!("# title: Mine, \"the old one\"\n{}", figures("cameras/nikon_d70_2007_figure.csv"));
    let camera = file("quoted.csv", &camera);
    let output = String::from_utf8(run(&["locus", "--camera", text(&camera), "--count", "1"]).stdout).unwrap();
    assert!(output.lines().nth(1).unwrap().starts_with("\"Mine, \"\"the old one\"\"\",1000,0."), "{output}");
}

#[test]
fn files_that_do_not_fit_say_which_and_why() {
    let one = file("one.csv", "nm,r\n400,1\n500,2\n600,1\n");
    refused(&["locus", "--camera", text(&one)], &["one.csv: 1 curve", "red, green and blue"]);
    refused(
        &["patches", "--illuminant", &asset("cameras/nikon_d70_2007_figure.csv")],
        &["nikon_d70_2007_figure.csv: the file states", "--camera"],
    );
    refused(&["locus", "--illuminant", env!("CARGO_TARGET_TMPDIR")], &[env!("CARGO_TARGET_TMPDIR"), "directory"]);
    refused(&["locus", "--camera", "missing.csv"], &["chromascope: missing.csv: no such file or directory\n"]);
    #[cfg(unix)]
    refused(&["locus", "--camera", "/dev/zero"], &["/dev/zero: named pipes, sockets and devices are not supported"]);
}

/// 2: the arguments themselves are wrong. 1: names, data or disk say no.
#[test]
fn exit_codes_tell_usage_from_failure() {
    for usage in [
        &["locus", "--bogus"][..],
        &["locus", "--count", "2.5"],
        &["locus", "--temperatures", "1000,warm"],
        &["locus", "--to", "3000", "--temperatures", "3000"],
        &["locus", "--transform", "paper", "--fit-to", "CIE 1931 2°"],
        &["locus", "--illuminant", "daylight"],
        &["patches", "--radiance", "lamp.csv", "--illuminant", "A"],
        &["patches", "--radiance-white", "tile"],
        &["patches", "--per", "photon"],
        &["locus", "--from", "0.5"],
        &["locus", "--to", "inf"],
        &["locus", "--temperatures", "nan"],
        &["patches", "--illuminant", "blackbody:"],
        &["patches", "--white", "daylight:-5"],
        &["list", "lenses"],
    ] {
        assert_eq!(code(usage), Some(2), "{usage:?}");
    }
    for failure in [
        &["locus", "--camera", "Nikn"][..],
        &["locus", "--camera", ""],
        &["locus", "--camera", "missing.csv"],
        &["locus", "--preset", "paper", "--observer", "CIE 2006 2° cone fundamentals"],
        &["locus", "--fit-to", "Stiles & Burch 1955 2°"],
        &["patches", "--illuminant", "daylight:30000"],
        &["patches", "--illuminant", "blackbody:1"],
        &["locus", "--out", env!("CARGO_TARGET_TMPDIR")],
    ] {
        assert_eq!(code(failure), Some(1), "{failure:?}");
    }
}

#[test]
fn a_partly_wrong_request_leaves_the_file_as_it_was() {
    let out = file("kept.csv", "as it was");
    let out_forced = ["--camera", "Nikon D70 (2007 figure)", "--out", text(&out), "--force"];
    refused(&[&["locus", "--camera", "Nikn"], &out_forced[..]].concat(), &["Nikn"]);
    refused(&[&["patches", "--chart", "missing.csv"], &out_forced[..]].concat(), &["missing.csv"]);
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "as it was");
    let new = out.with_file_name("never.csv");
    let cones = ["--preset", "paper", "--observer", "CIE 2006 2° cone fundamentals"];
    refused(&[&["locus", "--out", text(&new)], &cones[..]].concat(), &["Eq 13"]);
    assert!(!new.exists());
}

/// A folder of a test's own, empty.
pub(super) fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _absent = std::fs::remove_dir_all(&path);
    std::fs::create_dir(&path).unwrap();
    path
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_pipes_stay_pipes() {
    use std::os::unix::fs::{FileTypeExt as _, symlink};
    let folder = folder("links");
    let (file, link, pipe) = (folder.join("file.csv"), folder.join("link.csv"), folder.join("pipe"));
    std::fs::write(&file, "old").unwrap();
    symlink("file.csv", &link).unwrap();
    let arguments = ["locus", "--count", "2", "--camera", "Nikon D70 (2007 figure)", "--out"];
    let expected = run(&[&arguments[..], &["-"]].concat()).stdout;
    assert_eq!(code(&[&arguments[..], &[text(&link), "--force"]].concat()), Some(0));
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read(&file).unwrap(), expected);

    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // Open for both, so that neither end waits for the other.
    let mut both = std::fs::OpenOptions::new().read(true).write(true).open(&pipe).unwrap();
    assert_eq!(code(&[&arguments[..], &[text(&pipe)]].concat()), Some(0));
    assert!(std::fs::metadata(&pipe).unwrap().file_type().is_fifo(), "written into, not replaced");
    let mut read = vec![0; expected.len()];
    both.read_exact(&mut read).unwrap();
    assert_eq!(read, expected);

    let left = std::fs::read_dir(&folder).unwrap().count();
    assert_eq!(left, 3, "nothing temporary stays");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_chromascope"))
        .args(["locus", "--count", "3000"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    BufReader::with_capacity(64, child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    assert!(first.starts_with("sensor,temperature_k,x,y,u_prime,v_prime,"), "{first}");
    // The pipe holds far less than the table, and its reader is gone.
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

#[test]
fn lists_name_what_the_options_take() {
    let names = |arguments: &[&str]| String::from_utf8(run(arguments).stdout).unwrap();
    let kinds = ["cameras", "observers", "charts", "illuminants", "filters", "materials"];
    assert_eq!(names(&["list"]), kinds.map(|kind| names(&["list", kind])).concat());
    let option = |kind: &str, option: &str| -> Vec<String> {
        names(&["list", kind]).lines().flat_map(|name| [option.to_owned(), name.to_owned()]).collect()
    };
    // Every name is taken by the option that it is listed for, as itself.
    for (kind, argument) in [("cameras", "--camera"), ("observers", "--observer")] {
        let names = option(kind, argument);
        let fit = ["locus", "--transform", "fitted", "--temperatures", "5000"].map(str::to_owned);
        let arguments: Vec<&str> = fit.iter().chain(&names).map(String::as_str).collect();
        let rows = table(&arguments);
        assert!(rows[1..].iter().map(|row| &row[0]).eq(names.iter().skip(1).step_by(2)), "{kind}");
        assert!(rows[1..].iter().all(|row| row[2..8].iter().all(|cell| number(cell).is_finite())));
    }
    for name in option("illuminants", "").iter().skip(1).step_by(2) {
        assert_eq!(
            code(&["locus", "--count", "1", "--camera", "Nikon D70 (2007 figure)", "--illuminant", name]),
            Some(0),
            "{name}"
        );
    }
}
