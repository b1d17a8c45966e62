//! `list`: names of the built-in data sets.

use clap::{ArgMatches, Args, ValueEnum};

use super::error::CliError;
use super::outputs::show;
use crate::catalog::Catalog;
use crate::document::{FIVE, SetKind};

/// The names of the built-in data sets, one per line
#[derive(Debug, Args)]
pub(super) struct ListArguments {
    /// Kind of data sets [default: all]
    kind: Option<ListKind>,
}

/// A kind of data sets to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ListKind {
    /// Camera sensitivities
    Cameras,
    /// Color matching functions
    Observers,
    /// Sets of patches
    Charts,
    /// Lights
    Illuminants,
    /// Transmittances of filters
    Filters,
    /// Single reflectances
    Materials,
}

impl ListKind {
    const fn of_sets(self) -> SetKind {
        match self {
            Self::Cameras => SetKind::Camera,
            Self::Observers => SetKind::Observer,
            Self::Charts => SetKind::Chart,
            Self::Illuminants => SetKind::Illuminant,
            Self::Filters => SetKind::Filter,
            Self::Materials => SetKind::Material,
        }
    }
}

pub(super) fn run(arguments: &ListArguments, _: &ArgMatches) -> Result<(), CliError> {
    show(&list(&Catalog::built_in(), arguments.kind.map(ListKind::of_sets)))
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
