//! Separators of cells and of fractions.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Separator of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Delimiter {
    /// `380,0.05`
    Comma,
    /// `380,5, 0,05`: a comma with a space after it, where commas alone mark fractions.
    CommaSpace,
    /// `380;0.05`
    Semicolon,
    /// One tab character.
    Tab,
    /// Any run of spaces and tabs.
    Spaces,
    /// None: each value stands in an element of its own, as in XML.
    Elements,
}

impl fmt::Display for Delimiter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Comma => "comma separated",
            Self::CommaSpace => "separated by comma and space",
            Self::Semicolon => "semicolon separated",
            Self::Tab => "tab separated",
            Self::Spaces => "separated by spaces",
            Self::Elements => "one value in each element",
        })
    }
}

/// Decimal mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DecimalMark {
    /// `0.05`
    Point,
    /// `0,05`
    Comma,
}

impl fmt::Display for DecimalMark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Point => "decimal points",
            Self::Comma => "decimal commas",
        })
    }
}
