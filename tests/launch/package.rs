//! Writes what a package holds beside the program, from what the program knows: manual pages, completions of shells, and the copyright
//! file of Debian with the terms of all built-in data.
//!
//! `cargo run -p chromascope-workbench --example package -- FOLDER`

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

use chromascope_workbench::cli;
use clap_complete::Shell;

fn main() -> io::Result<()> {
    let folder = std::env::args_os().nth(1).unwrap_or_else(|| "target/package".into());
    let folder = Path::new(&folder);
    for name in ["chromascope", "chromascope-cli"] {
        let manual = folder.join(name).join("man");
        std::fs::create_dir_all(&manual)?;
        let command = cli::command().name(name).bin_name(name);
        clap_mangen::generate_to(command.clone().disable_help_subcommand(true), &manual)?;
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish] {
            clap_complete::generate_to(shell, &mut command.clone(), name, folder.join(name))?;
        }
    }
    std::fs::write(folder.join("copyright"), copyright())
}

/// <https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/>
fn copyright() -> String {
    let mut files: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (path, table) in chromascope_data::folders().flat_map(chromascope_data::files) {
        if let Some(terms) = table.lines().find_map(|line| line.strip_prefix("# license: ")) {
            files.entry(terms.to_owned()).or_default().push(path.to_owned());
        }
    }
    for (fonts, terms) in [("DejaVu*", "dejavu-fonts"), ("[AT]*", "croscore-fonts")] {
        files.insert(format!("{terms} (licenses/{terms}.txt)"), vec![format!("fonts/{fonts}")]);
    }
    let mut text =
        "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: Chromascope\n\n\
                    Files: *\nCopyright: 2026 the Chromascope developers\nLicense: Expat or Apache-2.0\n"
            .to_owned();
    let mut paragraph = |fields: &str, body: &str| {
        text.push_str(fields);
        for line in body.lines().map(str::trim_end) {
            let _ = writeln!(text, " {}", if line.is_empty() { "." } else { line });
        }
    };
    for (at, (terms, paths)) in files.iter().enumerate() {
        let file = terms.split_once(" (").map_or("", |(_, file)| file.trim_end_matches(')'));
        let body = chromascope_data::text(file).unwrap_or(terms);
        // Its full text comes with Debian.
        let body = body.split_once("Apache License\n").map_or(body, |(own, _)| own).trim_end();
        let holder = body.lines().find(|line| line.starts_with("Copyright")).unwrap_or("none stated");
        let holder = holder.trim_start_matches("Copyright").trim_start_matches(" (c)").trim();
        let paths = paths.join("\n assets/");
        paragraph(&format!("\nFiles: assets/{paths}\nCopyright: {holder}\nLicense: data-{}\n", at + 1), body);
    }
    paragraph("\nLicense: Expat\n", include_str!("../../LICENSE-MIT"));
    paragraph("\nLicense: Apache-2.0\n", "On Debian systems the text is in /usr/share/common-licenses/Apache-2.0.");
    text
}
