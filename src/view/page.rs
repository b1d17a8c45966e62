//! View of the Figure page: its paper and its zoom.

use chromascope_text::choices;
use serde::{Deserialize, Serialize};

use crate::export::Paper;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PageLook {
    pub paper: Paper,
    pub zoom: PageZoom,
    pub unit: LengthUnit,
}

impl Default for PageLook {
    fn default() -> Self {
        let paper = Paper { width_mm: Some(Paper::ONE_COLUMN_MM), ..Paper::default() };
        Self { paper, zoom: PageZoom::default(), unit: LengthUnit::default() }
    }
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum PageZoom {
        #[default]
        Fit = "fit", "Fit", "The whole page";
        TrueSize = "true", "True size", "As large as on paper, where a screen has 96 points per inch";
        Double = "double", "200 %", "Twice as large as on paper";
    }
}

impl PageZoom {
    /// Points on screen for each point on paper at true size: screens have 96 points per inch.
    pub const TRUE: f64 = 96.0 / 72.0;

    /// Points on screen for each point on paper, for a page that fits at `fit`.
    pub fn scale(self, fit: f64) -> f64 {
        match self {
            Self::Fit => fit,
            Self::TrueSize => Self::TRUE,
            Self::Double => 2.0 * Self::TRUE,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LengthUnit {
    #[default]
    Millimeter,
    Inch,
}

impl LengthUnit {
    pub const fn mm(self) -> f64 {
        match self {
            Self::Millimeter => 1.0,
            Self::Inch => 25.4,
        }
    }

    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Millimeter => "mm",
            Self::Inch => "in",
        }
    }
}
