//! What curves are, and what their values stand for.
//!
//! `role` decides what the curves are: what the file says, else what its settings suggest, else what the numbers look like.
//! `values` decides for each curve what its numbers stand for, by the header, else by `evidence` of its own. `convert` makes plain
//! numbers of what is written, and `check` warns of what cannot be. Where nothing decides between scales that differ by a factor,
//! the decision is [`Certainty::Open`] and the numbers stay as written.

mod camera;
mod check;
mod convert;
mod evidence;
mod role;
mod values;

use std::fmt;

use serde::{Deserialize, Serialize};

use super::grid::Grid;
use super::watch::Log;
use super::{Certainty, Decided, ReadOptions};

pub(super) use camera::camera_columns;
pub(super) use check::warn;
pub(super) use convert::convert;

/// What the curves of a table are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Sensitivities of a camera, or color matching functions.
    Camera,
    /// Reflectances: fractions of one.
    Reflectance,
    /// Transmittances of filters: fractions of one.
    Transmittance,
    /// Spectral power of lights, in any unit.
    Illuminant,
    /// Nothing says what they are, and their values suggest nothing.
    Unknown,
}

impl Role {
    /// Whether the curves are fractions of the light that falls on something.
    pub fn is_fraction(self) -> bool {
        matches!(self, Self::Reflectance | Self::Transmittance)
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Camera => "camera sensitivities",
            Self::Reflectance => "reflectances",
            Self::Transmittance => "transmittances",
            Self::Illuminant => "illuminants",
            Self::Unknown => "spectra of an unknown kind",
        })
    }
}

/// What the values stand for as written, and so what is done to them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Values {
    /// Taken as they are: fractions of one where the curves are reflectances or transmittances.
    Plain,
    /// Percent: divided by 100.
    Percent,
    /// Decadic absorbances A: taken as the fraction 10^−A.
    Absorbance,
    /// Decibels L of power: taken as the power 10^(L/10).
    Decibels,
}

impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Plain => "plain numbers, not percent",
            Self::Percent => "percent",
            Self::Absorbance => "absorbances, of which fractions are made",
            Self::Decibels => "decibels, of which powers are made",
        })
    }
}

/// The role, and the scale of each curve.
#[derive(Debug)]
pub(super) struct Scale {
    pub(super) role: Decided<Role>,
    /// What the values of most curves stand for.
    pub(super) values: Decided<Values>,
    /// What those of each curve stand for.
    columns: Vec<Values>,
}

impl Scale {
    /// Whether values above a thousand are out of question: percent, and fractions of light.
    pub(super) fn denies_thousands(&self) -> bool {
        let sure = |certainty| matches!(certainty, Certainty::Certain | Certainty::Chosen);
        (self.values.value == Values::Percent && sure(self.values.certainty))
            || (self.role.value.is_fraction() && sure(self.role.certainty))
    }
}

/// Decides what the curves are and what the values of each stand for.
pub(super) fn decide(grid: &Grid, options: &ReadOptions, log: &mut Log<'_>) -> Scale {
    let evidence = evidence::Evidence::of(grid);
    let said = role::said(grid, options);
    let from_file = said.is_some();
    let found = said.unwrap_or_else(|| role::suggested(grid, &evidence));
    let role = Decided::or_chosen(options.role, || found);
    let (values, columns) = values::decide(grid, options, &role, from_file, &evidence, log);
    Scale { role, values, columns }
}
