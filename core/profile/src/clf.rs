//! Matrices in Common LUT Format (Academy S-2014-006, version 3.0; SMPTE ST 2136-1).

use crate::{Matrix, ProfileError, numbers, text};
use std::fmt::Write as _;

/// CLF file with one matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Clf {
    /// Identifier of the transform.
    pub id: String,
    /// Name that programs list.
    pub name: String,
    /// Sentences about it.
    pub descriptions: Vec<String>,
    /// Color space of the input, in words.
    pub input: String,
    /// Color space of the output, in words.
    pub output: String,
    /// Output RGB from input RGB.
    pub matrix: Matrix,
}

/// The largest magnitude of a number: that of a half float, in which readers may hold it.
const LIMIT: u32 = 65_504;

impl Clf {
    /// XML of the file.
    ///
    /// # Errors
    /// [`ProfileError`] for a text or number that the format cannot hold.
    pub fn to_xml(&self) -> Result<String, ProfileError> {
        text("id", &self.id, false)?;
        text("name", &self.name, false)?;
        text("InputDescriptor", &self.input, false)?;
        text("OutputDescriptor", &self.output, false)?;
        for description in &self.descriptions {
            text("Description", description, false)?;
        }
        numbers("Matrix", self.matrix.iter().flatten(), LIMIT)?;
        let [id, name] = [&self.id, &self.name].map(|value| escaped(value));
        let mut xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        let _ = writeln!(
            xml,
            "<ProcessList xmlns=\"urn:AMPAS:CLF:v3.0\" id=\"{id}\" name=\"{name}\" compCLFversion=\"3.0\">"
        );
        for description in &self.descriptions {
            let _ = writeln!(xml, "  <Description>{}</Description>", escaped(description));
        }
        let _ = writeln!(xml, "  <InputDescriptor>{}</InputDescriptor>", escaped(&self.input));
        let _ = writeln!(xml, "  <OutputDescriptor>{}</OutputDescriptor>", escaped(&self.output));
        xml += "  <Matrix inBitDepth=\"32f\" outBitDepth=\"32f\">\n    <Array dim=\"3 3\">\n";
        for row in &self.matrix {
            let cells: Vec<String> = row.iter().map(|value| format!("{value:.10}")).collect();
            let _ = writeln!(xml, "      {}", cells.join(" "));
        }
        xml += "    </Array>\n  </Matrix>\n</ProcessList>\n";
        Ok(xml)
    }
}

fn escaped(value: &str) -> String {
    value.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
