//! `list`: names of the built-in data sets, and the sets as files.

use std::path::PathBuf;

use clap::{ArgMatches, Args};

use super::error::{CliError, Result};
use super::outputs::{self, show, write_to};
use super::render::make_folder;
use crate::catalog::Catalog;
use crate::document::{FIVE, SetKind};
use crate::export::package::package;
use crate::results::Results;

/// The names of the built-in data sets, one per line; or the sets as files
#[derive(Debug, Args)]
pub(super) struct ListArguments {
    /// Kind of data sets [default: all]
    #[arg(value_parser = super::settings::choice_of(&SetKind::ALL[..6]))]
    kind: Option<SetKind>,
    /// Writes all sets to a folder instead, to be used and cited elsewhere: CSV and rawtoaces JSON, with license texts, and
    /// datapackage.json (Frictionless Data Package) with checksum, source and terms of each
    #[arg(long, value_name = "FOLDER", conflicts_with = "kind")]
    out: Option<PathBuf>,
    /// Overwrites the files of an earlier --out
    #[arg(long, requires = "out")]
    force: bool,
}

pub(super) fn run(arguments: &ListArguments, _: &ArgMatches) -> Result<()> {
    if let Some(folder) = &arguments.out {
        let files = package(&Catalog::built_in(), &Results::default());
        let files = files.map_err(|error| CliError::File(error.to_string()))?;
        let paths: Vec<PathBuf> = files.iter().map(|(path, _)| folder.join(path)).collect();
        outputs::check(paths.iter().map(PathBuf::as_path), &[], arguments.force)?;
        for (path, (_, bytes)) in paths.iter().zip(&files) {
            make_folder(path.parent().unwrap_or(folder))?;
            write_to(path, bytes)?;
        }
        return show(&format!("{}: {} files\n", folder.display(), files.len()));
    }
    show(&list(&Catalog::built_in(), arguments.kind))
}

/// Names of a catalog's sets of a kind, one a line; of all kinds for none.
pub fn list(catalog: &Catalog, kind: Option<SetKind>) -> String {
    let names = |kind: SetKind| {
        let five = (kind == SetKind::Chart).then_some(FIVE);
        let names = catalog.of_kind(kind).map(|entry| entry.name.as_str()).chain(five);
        names.flat_map(|name| [name, "\n"]).collect::<String>()
    };
    kind.map_or_else(|| SetKind::ALL.map(names).concat(), names)
}
