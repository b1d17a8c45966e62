//! The kinds of data sets, and how a sensor and a light are named.

use chromascope_text::choices;
use serde::{Deserialize, Serialize};

use super::imported::{ImportedSet, Role};

choices! {
    /// The key is the plural, as shown and as the command line takes it; the label is one of them.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum SetKind {
        Camera = "cameras", "camera", "Camera sensitivities";
        Observer = "observers", "observer", "Color matching functions";
        Chart = "charts", "chart", "Sets of patches";
        Illuminant = "illuminants", "illuminant", "Lights";
        Filter = "filters", "filter", "Transmittances of filters";
        Material = "materials", "material", "Single reflectances";
        Unsorted = "unsorted spectra", "unsorted spectrum", "Spectra of unknown quantity";
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Light {
    Set(String),
    BlackBody,
    Daylight,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SensorId {
    pub kind: SetKind,
    pub name: String,
}

impl SetKind {
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
}
