//! Tests of the command line with names that are not plain text, files that are none, and endless output.

use std::io::Read as _;
use std::path::Path;
use std::process::{Command, Stdio};

use super::files::folder;
use super::{refused, run};

const LEAF: &str = "nm,leaf,stem\n400,0.05,0.1\n500,0.1,0.2\n600,0.2,0.3\n";
const CAMERA: &str = "nm,R,G,B\n400,0.1,0.2,0.9\n500,0.2,0.9,0.3\n600,0.9,0.4,0.1\n700,0.3,0.1,0.05\n";

/// Nothing that a terminal would take for an order.
fn is_plain(text: &str) -> bool {
    let turns = |c: char| ('\u{202a}'..='\u{202e}').contains(&c) || ('\u{2066}'..='\u{2069}').contains(&c);
    text.chars().all(|c| c == '\n' || c == '\t' || !(c.is_control() || turns(c)))
}

fn put(folder: &Path, name: impl AsRef<Path>, text: &str) -> std::path::PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[cfg(unix)]
#[test]
fn no_name_gives_orders_to_a_terminal() {
    let folder = folder("orders");
    let orders = "\u{1b}]0;pwned\u{7}\u{1b}[31m\u{9b}2J\u{202e}";
    let names = put(
        &folder,
        "names.csv",
        &format!("# title: {orders}title\nnm,{orders}R,b\n400,0.1,1\n500,0.2,2\n600,0.3,3\n"),
    );
    let broken = put(&folder, format!("a\n{orders}.csv"), "nm,leaf\n400,oops\n");
    let sound = put(&folder, format!("b\n{orders}.csv"), LEAF);
    let mesh = put(&folder, format!("c{orders}.obj"), "v 0 0 0\n");
    let all = [&names, &broken, &sound, &mesh].map(|path| path.to_str().unwrap().to_owned());
    let [names, broken, sound, mesh] = &all;
    for arguments in [
        &["inspect", names][..],
        &["inspect", broken],
        &["inspect", names, broken, sound],
        &["inspect", names, "--csv", "-"],
        &["inspect", "--json", names, broken, sound],
        &["compare", "--camera", names, "--format", "json"],
        &["patches", "--chart", names],
        &["patches", "--chart", broken],
        &["patches", "--camera", sound],
        &["render", "--mesh", mesh],
        &["locus", "--camera", orders],
        &["inspect", names, &format!("--{orders}")],
        &[orders],
    ] {
        let output = run(arguments);
        let (out, err) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
        assert!(is_plain(&out) && is_plain(&err), "{arguments:?}: {out:?} {err:?}");
    }
    let output = run(&["inspect", sound]);
    let first = String::from_utf8(output.stdout).unwrap().lines().next().unwrap().to_owned();
    assert!(first.contains(".csv"), "a name is one line: {first:?}");
}

#[test]
fn json_says_what_no_terminal_may_be_told() {
    let folder = folder("json_orders");
    let names = put(&folder, "c1.csv", "# note: a\u{9b}2Jb\nnm,\u{e9}\n400,0.1\n500,0.2\n600,0.3\n");
    let output = run(&["inspect", "--json", names.to_str().unwrap()]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(is_plain(&text) && text.contains("a\\u009b2Jb") && text.contains('\u{e9}'), "{text}");
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["reading"]["comments"][0]["value"], "a\u{9b}2Jb");
}

#[test]
fn a_file_too_large_states_its_true_size_and_is_not_read() {
    let path = folder("sizes").join("large.csv");
    std::fs::File::create(&path).unwrap().set_len(300 << 20).unwrap();
    refused(&["inspect", path.to_str().unwrap()], &["large.csv", "300 MB, the limit is 64 MB"]);
}

#[test]
fn no_cell_of_a_table_runs_in_a_spreadsheet() {
    let folder = folder("formulas");
    let chart = put(
        &folder,
        "chart.csv",
        "nm,=cmd|calc!A1,@SUM(A1),+1+1,-5\n400,0.1,0.2,0.3,0.4\n500,0.2,0.3,0.4,0.5\n600,0.3,0.4,0.5,0.6\n",
    );
    let camera = put(&folder, "=HYPERLINK(1).csv", CAMERA);
    let [chart, camera] = [&chart, &camera].map(|path| path.to_str().unwrap());
    for arguments in [
        &["inspect", chart, "--csv", "-"][..],
        &["patches", "--chart", chart, "--camera", camera],
        &["locus", "--camera", camera, "--count", "3"],
    ] {
        let output = run(arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        let cells = text.lines().flat_map(|line| line.split(',')).map(|cell| cell.trim_matches('"'));
        let running: Vec<&str> =
            cells.filter(|cell| cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err()).collect();
        assert!(running.is_empty(), "{arguments:?}: {running:?}");
    }
}

#[cfg(unix)]
#[test]
fn pipes_sockets_and_devices_are_refused_wherever_a_file_is_named() {
    let folder = folder("no_files");
    let pipe = folder.join("pipe.csv");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let socket = folder.join("socket.csv");
    let _listening = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    for place in [pipe.to_str().unwrap(), socket.to_str().unwrap(), "/dev/zero", "/dev/tty", "/dev/null"] {
        if !Path::new(place).exists() {
            continue;
        }
        for arguments in [
            &["inspect", place][..],
            &["locus", "--camera", place],
            &["locus", "--illuminant", place],
            &["patches", "--chart", place],
            &["patches", "--radiance", place],
            &["render", "--material", place],
        ] {
            refused(arguments, &[place, "not supported"]);
        }
        refused(&["render", "--mesh", place], &["not a file"]);
    }
    for name in ["pipe.hdr", "pipe.exr"] {
        let pipe = folder.join(name);
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        refused(&["render", "--image", pipe.to_str().unwrap()], &[name, "not a file"]);
    }
    // What a shell opens for a command is read.
    let script = format!(
        "printf '{}' | {} patches --chart /dev/stdin --camera 'Kodak DCS200'",
        LEAF.replace('\n', "\\n"),
        env!("CARGO_BIN_EXE_chromascope")
    );
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[cfg(unix)]
#[test]
fn files_whose_names_are_no_unicode_are_read() {
    use std::os::unix::ffi::OsStrExt as _;
    let folder = folder("no_unicode");
    let named = |bytes: &[u8], text: &str| put(&folder, std::ffi::OsStr::from_bytes(bytes), text).into_os_string();
    let (leaf, camera) = (named(b"caf\xe9.csv", LEAF), named(b"cam\xff.csv", CAMERA));
    let lamp = named(b"lamp\xfe", "nm,lamp\n400,1\n500,2\n600,3\n");
    let command = |arguments: &[&std::ffi::OsStr]| {
        let output = Command::new(env!("CARGO_BIN_EXE_chromascope")).args(arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let os = std::ffi::OsStr::new;
    assert!(command(&[os("inspect"), &leaf]).contains("caf\u{fffd}.csv\n"));
    assert!(command(&[os("inspect"), &leaf, os("--json")]).contains("caf\u{fffd}.csv"));
    let out = folder.join("tables");
    command(&[os("inspect"), folder.as_os_str(), os("--csv"), out.as_os_str()]);
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 3);
    let patches = command(&[os("patches"), os("--chart"), &leaf, os("--camera"), &camera, os("--illuminant"), &lamp]);
    assert!(patches.lines().nth(1).is_some_and(|row| row.starts_with("cam\u{fffd},leaf,")), "{patches}");
}

#[cfg(unix)]
#[test]
fn tables_of_files_with_the_longest_names_have_names() {
    let folder = folder("long_names");
    let files: Vec<String> = ["a", "b"]
        .iter()
        .map(|end| put(&folder, format!("{}{end}", "é".repeat(127)), LEAF).to_str().unwrap().to_owned())
        .collect();
    let out = folder.join("tables");
    let output = run(&["inspect", &files[0], &files[1], "--csv", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 2);
}

#[cfg(unix)]
#[test]
fn what_is_written_is_as_private_as_the_mask_says() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder("mask");
    let leaf = put(&folder, "leaf.csv", LEAF);
    for (mask, mode) in [("022", 0o644), ("077", 0o600), ("002", 0o664), ("027", 0o640)] {
        let out = folder.join(mask);
        let script = format!(
            "umask {mask}; {} inspect {} --csv {}",
            env!("CARGO_BIN_EXE_chromascope"),
            leaf.display(),
            out.display()
        );
        assert!(Command::new("sh").args(["-c", &script]).stdout(Stdio::null()).status().unwrap().success());
        let written = || std::fs::metadata(&out).unwrap().permissions().mode() & 0o777;
        assert_eq!(written(), mode, "umask {mask}");
        // What takes a file's place is as readable as that was.
        std::fs::set_permissions(&out, std::fs::Permissions::from_mode(0o640)).unwrap();
        assert!(
            Command::new("sh")
                .args(["-c", &format!("{script} --force")])
                .stdout(Stdio::null())
                .status()
                .unwrap()
                .success()
        );
        assert_eq!(written(), 0o640, "umask {mask}");
    }
}

/// A table that takes minutes and gigabytes as a whole begins at once, and ends when its reader has enough.
#[test]
fn tables_begin_before_they_are_known() {
    let folder = folder("streams");
    let wide =
        put(&folder, "wide.csv", "nm,a,b,c,d\n300,0.1,0.2,0.3,0.4\n1300,0.2,0.3,0.4,0.5\n2300,0.3,0.4,0.5,0.6\n");
    let wide = wide.to_str().unwrap();
    for arguments in [
        &["locus", "--camera", "Kodak DCS200", "--count", "10000000"][..],
        &["inspect", wide, "--step", "0.001", "--json"],
        &["inspect", wide, "--step", "0.001", "--csv", "-"],
    ] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_chromascope"))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut begun = vec![0; 200_000];
        child.stdout.take().unwrap().read_exact(&mut begun).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{arguments:?}");
    }
}

#[test]
fn a_long_locus_is_that_of_its_parts() {
    let rows = super::table(&["locus", "--camera", "Kodak DCS200", "--count", "3000"]);
    assert_eq!(rows.len(), 3001);
    let few = super::table(&[
        "locus",
        "--camera",
        "Kodak DCS200",
        "--temperatures",
        &format!("{},{}", rows[1024][1], rows[1025][1]),
    ]);
    assert_eq!([&few[1][2..9], &few[2][2..9]], [&rows[1024][2..9], &rows[1025][2..9]]);
    let arc: Vec<f64> = super::column(&rows, "arc_length_xy").into_iter().map(super::number).collect();
    assert!(arc.windows(2).all(|pair| pair[0] < pair[1]), "the length goes on from part to part");
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_display_all_commands_that_work_are_named() {
    let help = String::from_utf8(run(&["--help"]).stdout).unwrap();
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let names: Vec<&str> = commands
        .lines()
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert!(names.len() > 10, "{names:?}");
    let said = String::from_utf8(run(&[]).stderr).unwrap();
    for name in names {
        assert!(
            said.contains(&format!("`{name}`")) || said.contains(&format!("`chromascope {name}`")),
            "{name}: {said}"
        );
    }
}
