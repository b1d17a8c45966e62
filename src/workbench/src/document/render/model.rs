//! Choices of the reflectance model that the paper leaves open or gets wrong.

use chromascope_core::reflectance::{IlluminatedArea, Specular};
use serde::{Deserialize, Serialize};

/// The reflectance factor of the coherent (specular) component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpecularChoice {
    /// No Fresnel factor, tinted by the material.
    Paper,
    /// Fresnel's reflectance, untinted.
    #[default]
    Fresnel,
}

impl SpecularChoice {
    /// All of them, in the order they are listed.
    pub const ALL: [Self; 2] = [Self::Fresnel, Self::Paper];

    /// That of sessions saved before there was a choice.
    pub const fn before() -> Self {
        Self::Paper
    }

    /// The core's.
    pub const fn specular(self) -> Specular {
        match self {
            Self::Paper => Specular::Paper,
            Self::Fresnel => Specular::Fresnel,
        }
    }

    /// The name in lists.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Paper => "As in the paper",
            Self::Fresnel => "Fresnel, untinted",
        }
    }

    /// The name on the command line and in files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Fresnel => "fresnel",
        }
    }

    /// Reason that one would choose it.
    pub const fn why(self) -> &'static str {
        match self {
            Self::Paper => {
                "Eq 1 has no Fresnel factor, and S(λ) multiplies the coherent component too: a specular reflection \
                 in the material's color, at n = 1.4 and normal incidence 36 times as bright as a dielectric's."
            }
            Self::Fresnel => {
                "The coherent component times Fresnel's reflectance at the half vector, without S(λ): the specular \
                 reflection of a dielectric has the color of the light."
            }
        }
    }
}

/// The area A of the coherently illuminated patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AreaChoice {
    /// A = 4XY.
    #[default]
    #[serde(rename = "4xy")]
    FourXy,
    /// A = XY.
    Xy,
}

impl AreaChoice {
    /// All of them, in the order they are listed.
    pub const ALL: [Self; 2] = [Self::FourXy, Self::Xy];

    /// The core's.
    pub const fn area(self) -> IlluminatedArea {
        match self {
            Self::FourXy => IlluminatedArea::FourXy,
            Self::Xy => IlluminatedArea::Xy,
        }
    }

    /// The name in lists.
    pub const fn label(self) -> &'static str {
        match self {
            Self::FourXy => "A = 4XY",
            Self::Xy => "A = XY",
        }
    }

    /// The name on the command line and in files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::FourXy => "4xy",
            Self::Xy => "xy",
        }
    }

    /// Reason that one would choose it.
    pub const fn why(self) -> &'static str {
        match self {
            Self::FourXy => {
                "With the paper's sinc(v_x X) sinc(v_y Y) the illuminated area is 2X by 2Y: only A = 4XY normalizes the \
                 coherent lobe, so that a smooth surface returns what its boundary reflects."
            }
            Self::Xy => {
                "As printed in the paper. Three quarters of the coherent component are lost; with the normalization \
                 Paper, Eq 1–12, the diffuse component is four times stronger instead."
            }
        }
    }
}
