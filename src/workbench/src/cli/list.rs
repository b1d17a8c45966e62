//! `list`: names of the built-in data sets.

use clap::{ArgMatches, Args};

use super::error::Result;
use super::outputs::show;
use crate::catalog::Catalog;
use crate::document::{FIVE, SetKind};

/// The names of the built-in data sets, one per line
#[derive(Debug, Args)]
pub(super) struct ListArguments {
    /// Kind of data sets [default: all]
    #[arg(value_parser = super::settings::choice_of(&SetKind::ALL[..6]))]
    kind: Option<SetKind>,
}

pub(super) fn run(arguments: &ListArguments, _: &ArgMatches) -> Result<()> {
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
