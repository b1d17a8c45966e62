//! Tests of files that are never overwritten.

use super::files::folder;
use super::{refused, run};

const CHART: &str = "wavelength_nm,gray\n380,0.2\n780,0.2\n";

#[test]
fn a_command_inside_another_program_touches_nothing() {
    use chromascope_workbench::cli::{self, Outcome};
    use chromascope_workbench::hosted::{MemoryFolder, with_streams};

    let files = MemoryFolder::new();
    let chart = files.add("a.csv", CHART.replace("gray", "reflectance of gray").into());
    let chart = chart.to_str().unwrap();
    let hosted =
        |arguments: &[&str]| with_streams(|| cli::run(["chromascope"].iter().chain(arguments).map(Into::into)));
    let (outcome, streams) = hosted(&["list", "cameras"]);
    assert!(matches!(outcome, Outcome::Done(0)) && streams.remarks.is_empty());
    assert_eq!(streams.output, run(&["list", "cameras"]).stdout);
    let out = files.path().join("b.csv");
    let (outcome, streams) = hosted(&["patches", "--chart", chart, "--out", out.to_str().unwrap()]);
    assert!(matches!(outcome, Outcome::Done(0)) && streams.output.is_empty(), "{streams:?}");
    assert!(files.files().iter().any(|(name, bytes)| name == "b.csv" && bytes.starts_with(b"sensor,patch,")));
    let (outcome, streams) = hosted(&["patches", "--chart", "missing.csv"]);
    assert!(!matches!(outcome, Outcome::Done(0)) && streams.output.is_empty());
    assert_eq!(streams.remarks.len(), 1, "{streams:?}");
    drop(files);
    assert!(chromascope_workbench::hosted::bytes(&out).is_none());
}

#[test]
fn no_input_is_written_over() {
    let folder = folder("inputs");
    let chart = folder.join("a.csv");
    std::fs::write(&chart, CHART).unwrap();
    std::fs::create_dir(folder.join("sub")).unwrap();
    let mut spellings = vec![chart.clone(), folder.join("sub/../a.csv"), folder.join("./a.csv")];
    #[cfg(unix)]
    {
        let (link, hard) = (folder.join("link.csv"), folder.join("hard.csv"));
        std::os::unix::fs::symlink("a.csv", &link).unwrap();
        std::fs::hard_link(&chart, &hard).unwrap();
        spellings.extend([link, hard]);
    }
    let chart = chart.to_str().unwrap();
    for out in &spellings {
        let out = out.to_str().unwrap();
        for force in [&[][..], &["--force"]] {
            let patches = ["patches", "--camera", "Kodak DCS200", "--chart", chart, "--out", out];
            refused(&[&patches[..], force].concat(), &[out, "this command reads it", "name another file"]);
            let radiance = ["patches", "--radiance", chart, "--out", out];
            refused(&[&radiance[..], force].concat(), &[out, "this command reads it"]);
            let inspect = ["inspect", chart, "--csv", out];
            refused(&[&inspect[..], force].concat(), &[out, "this command reads it"]);
        }
        assert_eq!(std::fs::read_to_string(out).unwrap(), CHART);
    }
    let lamp = ["locus", "--illuminant", chart, "--out", chart, "--force"];
    refused(&lamp, &["this command reads it"]);
}

#[test]
fn no_existing_file_is_written_over_without_force() {
    let folder = folder("existing");
    let (old, new) = (folder.join("old.csv"), folder.join("new.csv"));
    std::fs::write(&old, "mine").unwrap();
    let old = old.to_str().unwrap();
    let locus = ["locus", "--camera", "Kodak DCS200", "--count", "2", "--out"];
    refused(&[&locus[..], &[old]].concat(), &[old, "exists", "--force"]);
    refused(&["patches", "--camera", "Kodak DCS200", "--out", old], &[old, "exists", "--force"]);
    assert_eq!(run(&[&locus[..], &[old]].concat()).status.code(), Some(1));
    assert_eq!(std::fs::read_to_string(old).unwrap(), "mine");
    assert!(run(&[&locus[..], &[old, "--force"]].concat()).status.success());
    assert!(std::fs::read_to_string(old).unwrap().starts_with("sensor,"));
    assert!(run(&[&locus[..], &[new.to_str().unwrap()]].concat()).status.success());
    #[cfg(unix)]
    {
        let dangling = folder.join("dangling.csv");
        std::os::unix::fs::symlink("nowhere.csv", &dangling).unwrap();
        refused(&[&locus[..], &[dangling.to_str().unwrap()]].concat(), &["exists"]);
        assert!(run(&[&locus[..], &["/dev/null"]].concat()).status.success());
        let output = run(&[&locus[..], &["/dev/stdout"]].concat());
        assert!(output.status.success() && output.stdout.starts_with(b"sensor,"));
    }
}

/// One of several tables may not be written, so that none is, nor their folder made.
#[test]
fn tables_of_several_files_are_written_all_or_none() {
    let folder = folder("several_tables");
    for name in ["a.txt", "b.txt"] {
        std::fs::write(folder.join(name), "400 0.5\n500 0.6\n").unwrap();
    }
    let out = folder.join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("b.csv"), "mine").unwrap();
    let [a, b, out_text] = [folder.join("a.txt"), folder.join("b.txt"), out.clone()].map(|p| p.display().to_string());
    refused(&["inspect", &a, &b, "--csv", &out_text], &["b.csv", "exists", "--force"]);
    assert!(!out.join("a.csv").exists());
    assert_eq!(std::fs::read_to_string(out.join("b.csv")).unwrap(), "mine");
    assert!(run(&["inspect", &a, &b, "--csv", &out_text, "--force"]).status.success());
    assert!(out.join("a.csv").exists());
    // Standard input led from the file that would be written.
    #[cfg(unix)]
    {
        let measured = folder.join("measured.csv");
        std::fs::write(&measured, CHART).unwrap();
        let status = std::process::Command::new(env!("CARGO_BIN_EXE_chromascope"))
            .args(["inspect", "-", "--force", "--csv", measured.to_str().unwrap()])
            .stdin(std::fs::File::open(&measured).unwrap())
            .output()
            .unwrap();
        assert_eq!(status.status.code(), Some(1));
        assert_eq!(std::fs::read_to_string(&measured).unwrap(), CHART);
    }
}
