//! The kinds of data sets.

use serde::{Deserialize, Serialize};

use super::imported::{ImportedSet, Role};

/// Kind of a data set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SetKind {
    /// A camera's spectral sensitivities.
    Camera,
    /// An observer's color matching functions or cone fundamentals.
    Observer,
    /// A set of patches.
    Chart,
    Illuminant,
    /// Transmittance of a filter in front of the light.
    Filter,
    /// Single reflectances.
    Material,
    /// The user's spectra of unknown quantity.
    Unsorted,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SensorId {
    pub kind: SetKind,
    pub name: String,
}

impl SetKind {
    /// All kinds in the order they are listed.
    pub const ALL: [Self; 7] =
        [Self::Camera, Self::Observer, Self::Chart, Self::Illuminant, Self::Filter, Self::Material, Self::Unsorted];

    /// The plural, as shown and as the command line takes it.
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Camera => "cameras",
            Self::Observer => "observers",
            Self::Chart => "charts",
            Self::Illuminant => "illuminants",
            Self::Filter => "filters",
            Self::Material => "materials",
            Self::Unsorted => "unsorted spectra",
        }
    }

    /// Kind of one of the user's sets.
    pub const fn of_own(set: &ImportedSet) -> Self {
        match set.role {
            Role::Camera => Self::Camera,
            Role::Reflectance => Self::Chart,
            Role::Transmittance => Self::Filter,
            Role::Illuminant => Self::Illuminant,
            Role::Unknown => Self::Unsorted,
        }
    }

    /// Use of one of the user's sets under the conditions, as buttons name it; none for sensors, which are compared.
    pub const fn used_as(self) -> Option<&'static str> {
        match self {
            Self::Illuminant => Some("light"),
            Self::Chart | Self::Material => Some("chart"),
            Self::Filter => Some("filter"),
            Self::Camera | Self::Observer | Self::Unsorted => None,
        }
    }

    pub const fn singular(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Observer => "observer",
            Self::Chart => "chart",
            Self::Illuminant => "illuminant",
            Self::Filter => "filter",
            Self::Material => "material",
            Self::Unsorted => "unsorted spectrum",
        }
    }
}
