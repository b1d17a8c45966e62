//! Choices of the caller.

use serde::{Deserialize, Serialize};

use crate::decision::{DecimalMark, Delimiter, Orientation, Reader, Role, Values, WavelengthUnit};

/// Settings that the caller fixes before reading; `None` leaves the decision to the content.
///
/// The default decides everything from the content.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default)]
pub struct ReadOptions {
    /// Separator of cells.
    pub delimiter: Option<Delimiter>,
    /// Decimal mark.
    pub decimal_mark: Option<DecimalMark>,
    /// True if wavelengths run down a column or across a row.
    pub orientation: Option<Orientation>,
    /// The unit of the wavelengths as written.
    pub wavelength_unit: Option<WavelengthUnit>,
    /// The column of the wavelengths, from 1, where they run down one.
    pub wavelength_column: Option<usize>,
    /// Scale of the values. Left open, only reflectances and transmittances are scaled. [`Values::Plain`] keeps lights in
    /// photons or per frequency as they are written, too.
    pub values: Option<Values>,
    /// Number of the table, block or group to read of several in one file, from 1 in the order of the file.
    pub part: Option<usize>,
    /// Role of the curves.
    pub role: Option<Role>,
    /// Reader for the file; [`Reader::TABLE`] reads numbers in columns whatever stands around them.
    pub reader: Option<Reader>,
    /// True if raw curves (dark, reference and sample counts) and other records (temperatures, times) are included;
    /// together with a chosen wavelength column, every other column.
    pub raw: Option<bool>,
}

impl ReadOptions {
    /// Chosen settings that can cause an error, each in words, with the options without it.
    pub(super) fn switches(&self) -> impl Iterator<Item = (String, Self)> {
        macro_rules! each {
            ($($field:ident: $words:literal),+) => {
                [$(self.$field.map(|chosen| (format!($words, chosen), Self { $field: None, ..self.clone() }))),+]
            };
        }
        let found = each!(
            delimiter: "{}", decimal_mark: "{}", orientation: "{}", wavelength_unit: "{}",
            wavelength_column: "wavelengths in column {}", values: "values are {}", part: "part {}", role: "{}", reader: "read as {}"
        );
        found.into_iter().flatten()
    }
}
