//! Names of columns outside the head of a table: legends in comments, and what programs and databases have everywhere.

use crate::decision::WavelengthUnit;
use crate::dialect_trial::Layout;
use crate::header_terms::{self, XUnit};
use crate::text::{is_one, lower};

const SPEXTOOL: [&str; 4] = ["Wavelength", "flux", "error", "flag"];

/// Columns of the International Glazing Database: transmittance, and reflectances of the front and of the back.
pub(super) const GLAZING: [&str; 4] = ["Wavelength", "T", "Rf", "Rb"];

/// The name of the next column in a comment, by its number, or alone: `Column 1: wavelength nm`, `Column 2 = flux`, `Column flux`.
pub(super) fn described_column(body: &str, next: usize) -> Option<String> {
    if let Some(name) = byte_by_byte(body) {
        return Some(name);
    }
    let Some((key, name)) = body.split_once([':', '=']) else {
        let name = body.strip_prefix("Column ").map(str::trim);
        return name.filter(|name| name.chars().all(char::is_alphabetic)).map(str::to_owned);
    };
    let (word, number) = key.trim().split_once(' ').unwrap_or(("column", key.trim().trim_matches(['[', ']'])));
    let is_next = is_one(&lower(word), "column|col|col.|label") && number.trim().parse() == Ok(next);
    Some(name.trim()).filter(|name| is_next && !name.is_empty()).map(str::to_owned)
}

/// The names in a comment such as `columns: wavelength_Angstrom  flux (arbitrary)`, without a remark behind them.
pub(super) fn listed_names(key: &str, value: &str, layout: &Layout) -> Option<Vec<String>> {
    let list = value.split(" (").next().filter(|_| is_one(&lower(key.trim()), "columns|fields"))?;
    let words: Vec<String> = list.split([' ', ',', '\t']).filter(|word| !word.is_empty()).map(str::to_owned).collect();
    (words.len() == layout.width && header_terms::names_axis(words.first()?)).then_some(words)
}

/// Unit and label of a column in a table of the bytes of each, as journals of astronomy have them: ` 1-  6 F6.1   0.1nm Wave   …`.
fn byte_by_byte(body: &str) -> Option<String> {
    let (from, rest) = body.trim_start().split_once('-').unwrap_or(("1", body));
    let mut words = rest.split_whitespace();
    let (to, format, unit, label) = (words.next()?, words.next()?, words.next()?, words.next()?);
    let is_number = |text: &str| text.trim().parse::<u16>().is_ok();
    let is_format = format.strip_prefix(['F', 'I', 'E', 'A']).is_some_and(|size| size.parse::<f32>().is_ok());
    let unit = if unit == "0.1nm" { "Angstrom" } else { unit };
    let named = if unit.starts_with("--") { label.to_owned() } else { format!("{label} [{unit}]") };
    (is_number(from) && is_number(to) && is_format).then_some(named)
}

/// The names of columns as files of the ARIA database give them: `FORMAT = Wavn n k`, wave numbers or wavelengths in micrometers.
fn aria_columns(body: &str) -> Option<(XUnit, Vec<String>)> {
    let list = body.strip_prefix("FORMAT")?.trim_start().strip_prefix('=')?;
    let names: Vec<String> = list.split_whitespace().map(str::to_owned).collect();
    let unit = match &*lower(names.first()?) {
        "wavn" => WavelengthUnit::Wavenumber,
        "wavl" => WavelengthUnit::Micrometer,
        _ => return None,
    };
    Some((XUnit::Wavelength(unit), names))
}

/// Name and unit of a column in the head of an ECSV: `- {name: flux, unit: W / m2, datatype: float64}`.
pub(super) fn ecsv_column(body: &str) -> Option<(&str, &str)> {
    let (name, rest) = body.strip_prefix("- {name: ")?.split_once(", unit: ")?;
    Some((name, rest[..rest.find([',', '}'])?].trim()))
}

/// The columns below the settings of a Woollam ellipsometer, of angles and of reflectances or transmittances.
const WOOLLAM: [(&str, &[&str]); 2] = [
    ("VASEmethod[", &["Wavelength", "Angle of incidence", "Psi", "Delta", "SD of Psi", "SD of Delta"]),
    ("RTmethod[", &["Type", "Wavelength", "Angle of incidence", "Ratio", "SD of Ratio"]),
];

/// Names of the columns as only some programs and databases give them, and the unit that they say of the first.
pub(super) fn names_of_program(text: &str, layout: &Layout) -> Option<(Option<XUnit>, Vec<String>)> {
    // Spextool's spectra of NASA's Infrared Telescope Facility name no columns.
    if text.contains("Xspextool") && (3..=SPEXTOOL.len()).contains(&layout.width) {
        return Some((None, SPEXTOOL[..layout.width].iter().map(|&name| name.to_owned()).collect()));
    }
    // Woollam's ellipsometers: each row of what they measured is at an angle, with its errors.
    for (method, names) in WOOLLAM {
        if text.starts_with(method) && names.len() == layout.width {
            return Some((None, names.iter().map(|&name| name.to_owned()).collect()));
        }
    }
    let (unit, names) = aria_columns(text).filter(|(_, names)| names.len() == layout.width)?;
    Some((Some(unit), names))
}
