//! The project's own data files: a header with the meaning and source of the values, then columns.
//!
//! ```text
//! # title: Canon EOS 10D
//! # quantity: relative spectral sensitivity
//! # unit: 1
//! # response: per energy (inferred)
//! # origin: digitized figure
//! # source: …
//! # license: …
//! # note: …
//! wavelength_nm,red,green,blue
//! 400,0.01,0.02,0.3
//! ```
//!
//! This reader is strict, for files we write ourselves; files of instruments go through the crate `spectral-file`.

use super::distribution::{DistributionError, SpectralDistribution};
use super::sensor::{Evidence, Response};

/// The facts at the top of a data file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Header {
    /// The name shown and matched.
    pub title: String,
    /// A short gloss shown after the name.
    pub also: Option<String>,
    /// Words by which it is searched, beside name and gloss.
    pub found_by: Option<String>,
    /// A shorter name, for narrow places.
    pub short: Option<String>,
    /// Quantity of the figures.
    pub quantity: String,
    /// Their unit; `1` for ratios.
    pub unit: String,
    /// For sensitivities, what they are a response to, and on which evidence.
    pub response: Option<String>,
    /// Origin of the figures, where they are not a published table of a measurement.
    pub origin: Option<String>,
    /// Who measured and published them, and where they were read.
    pub source: String,
    /// Under what terms.
    pub license: String,
    /// Notes on their use.
    pub notes: Vec<String>,
    /// The names of the value columns.
    pub columns: Vec<String>,
}

impl Header {
    /// Response basis of the sensitivities; unknown unless given in the header.
    pub fn response(&self) -> Response {
        match self.said_of_response().0 {
            "per energy" => Response::PerEnergy,
            "per photon" => Response::PerPhoton,
            _ => Response::Unknown,
        }
    }

    /// Evidence for [`Header::response`]: stated unless the header declares it inferred.
    pub fn response_evidence(&self) -> Evidence {
        match (self.response(), self.said_of_response().1) {
            (Response::Unknown, _) => Evidence::Unknown,
            (_, "inferred") => Evidence::Inferred,
            _ => Evidence::Stated,
        }
    }

    /// The note that gives the grounds for [`Header::response`], if one does.
    pub fn response_note(&self) -> Option<&str> {
        let grounds = |note: &&String| note.to_lowercase().contains("per energy");
        self.notes.iter().find(grounds).map(String::as_str)
    }

    /// True if the figures were read off a published figure, not taken from a table of a measurement.
    pub fn is_digitized(&self) -> bool {
        self.origin.as_deref() == Some("digitized figure")
    }

    /// The value of `response` without and within its parentheses.
    fn said_of_response(&self) -> (&str, &str) {
        let said = self.response.as_deref().unwrap_or_default();
        let (response, evidence) = said.split_once('(').unwrap_or((said, ""));
        (response.trim(), evidence.trim_end_matches(')').trim())
    }
}

/// Reason that a data file cannot be read. Lines count from one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "each variant says in its message what is wrong")]
pub enum DatasetError {
    /// A header line without `key: value`, or with a key the format does not have.
    #[error("line {line}: expected `# key: value` with a known key")]
    Key { line: usize },
    /// The column heads do not begin with `wavelength_nm`, or there are none.
    #[error("line {line}: expected column heads beginning with wavelength_nm")]
    Columns { line: usize },
    #[error("line {line}: expected {expected} fields")]
    Fields { line: usize, expected: usize },
    #[error("line {line}: no number in column {column}")]
    Number { line: usize, column: usize },
    #[error(transparent)]
    Spectrum(#[from] DistributionError),
}

/// A data file's header and curves, one for each value column.
#[derive(Clone, Debug, PartialEq)]
pub struct Dataset {
    /// The facts at the top.
    pub header: Header,
    /// The curves, in the order of the columns.
    pub curves: Vec<SpectralDistribution>,
}

impl Dataset {
    /// Reads only the header and the column heads; the figures are not looked at.
    ///
    /// # Errors
    /// [`DatasetError`] with the line.
    pub fn read_header(text: &str) -> Result<Header, DatasetError> {
        read_header(text).map(|(header, _)| header)
    }

    /// Reads the whole file.
    ///
    /// # Errors
    /// [`DatasetError`] with the line, and the column if a field is not a number.
    pub fn read(text: &str) -> Result<Self, DatasetError> {
        let (header, first) = read_header(text)?;
        let width = header.columns.len() + 1;
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); width];
        for (index, row) in text.lines().enumerate().skip(first).filter(|(_, row)| !row.is_empty()) {
            let line = index + 1;
            let mut fields = row.split(',');
            for (column, values) in columns.iter_mut().enumerate() {
                let field = fields.next().ok_or(DatasetError::Fields { line, expected: width })?;
                values.push(field.parse().map_err(|_| DatasetError::Number { line, column: column + 1 })?);
            }
            if fields.next().is_some() {
                return Err(DatasetError::Fields { line, expected: width });
            }
        }
        let mut columns = columns.into_iter();
        let wavelengths = columns.next().unwrap_or_default();
        let curves =
            columns.map(|values| SpectralDistribution::new(wavelengths.clone(), values)).collect::<Result<_, _>>()?;
        Ok(Self { header, curves })
    }
}

/// The header, and how many lines it and the column heads take.
fn read_header(text: &str) -> Result<(Header, usize), DatasetError> {
    let mut header = Header::default();
    for (index, row) in text.lines().enumerate() {
        let line = index + 1;
        let Some(comment) = row.strip_prefix('#') else {
            let mut heads = row.split(',').map(|head| head.trim().to_owned());
            if heads.next().as_deref() != Some("wavelength_nm") {
                return Err(DatasetError::Columns { line });
            }
            header.columns = heads.collect();
            return if header.columns.is_empty() { Err(DatasetError::Columns { line }) } else { Ok((header, line)) };
        };
        let (key, value) = comment.split_once(':').ok_or(DatasetError::Key { line })?;
        let value = value.trim().to_owned();
        match key.trim() {
            "title" => header.title = value,
            "also" => header.also = Some(value),
            "found by" => header.found_by = Some(value),
            "short" => header.short = Some(value),
            "quantity" => header.quantity = value,
            "unit" => header.unit = value,
            "response" => header.response = Some(value),
            "origin" => header.origin = Some(value),
            "source" => header.source = value,
            "license" => header.license = value,
            "note" => header.notes.push(value),
            _ => return Err(DatasetError::Key { line }),
        }
    }
    Err(DatasetError::Columns { line: text.lines().count() + 1 })
}
