//! The kinds of data sets.

use serde::{Deserialize, Serialize};

use super::imported::{ImportedSet, Role};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SetKind {
    /// A camera's spectral sensitivities.
    Camera,
    /// An observer's color matching functions or cone fundamentals.
    Observer,
    Chart,
    Illuminant,
    /// Transmittance of a filter in front of the light.
    Filter,
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

    pub const fn of_own(set: &ImportedSet) -> Self {
        match set.role {
            Role::Camera => Self::Camera,
            Role::Reflectance => Self::Chart,
            Role::Transmittance => Self::Filter,
            Role::Illuminant => Self::Illuminant,
            Role::Unknown => Self::Unsorted,
        }
    }

    /// True if no two sets of these kinds have one name: patches are chosen from charts and materials alike.
    pub fn shares_names_with(self, other: Self) -> bool {
        let of_patches = |kind| matches!(kind, Self::Chart | Self::Material);
        self == other || (of_patches(self) && of_patches(other))
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
