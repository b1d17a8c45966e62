//! Instrument settings above the numbers that indicate the measured quantity and its scale.

use crate::header_terms;
use crate::role::{Role, Values};

/// Longer lines are no settings.
const LONGEST: usize = 400;

/// Statements of the settings, each with its line.
#[derive(Debug, Default)]
pub(super) struct Clues {
    /// True if the values are ratios to a reference measurement.
    pub(super) ratio: Option<(usize, bool)>,
    /// A cosine receptor was attached: the values are irradiances.
    pub(super) cosine_receptor: Option<usize>,
    /// The program writes ratios in percent.
    pub(super) ratios_in_percent: Option<(usize, &'static str)>,
    /// Role that a setting such as `Technique` gives.
    pub(super) role: Option<(usize, Role)>,
    /// Scale of the values that a setting gives.
    pub(super) values: Option<(usize, Values)>,
    /// A title or a name of data mentions absorbances.
    pub(super) absorbance: Option<usize>,
}

/// Keys of settings that name what is measured.
pub(super) const MEASURED: [&str; 16] = [
    "quantity",
    "spectral quantity",
    "measured quantity",
    "technique",
    "mode",
    "data mode",
    "photometric mode",
    "measuring mode",
    "measurement",
    "measurement mode",
    "measurement type",
    "ordinate",
    "ordinate mode",
    "y axis",
    "yaxis",
    "y label",
];

/// Programs that write reflectances and transmittances in percent whatever their values: what a line starts with.
const IN_PERCENT: [(&str, &str); 8] = [
    ("SpectraSuite Data File", "Ocean SpectraSuite"),
    ("OOIBase32 Version", "Ocean OOIBase32"),
    ("Jaz Data File", "Ocean Jaz"),
    ("Data from ", "Ocean OceanView"),
    (">>>>>", "an Ocean program"),
    ("Data measured with spectrometer", "Avantes AvaSoft"),
    ("ENLIGHTEN Version", "Wasatch ENLIGHTEN"),
    ("Date,Mode,IntegrationTime(ms)", "CID SpectraVue"),
];

impl Clues {
    /// Takes what a title or a line of prose mentions.
    pub(super) fn mention(&mut self, line: usize, text: &str) {
        // The name of a file may join its words.
        let spaced = text.replace('_', " ");
        self.absorbance = self.absorbance.or_else(|| header_terms::mentions_absorbance(&spaced).then_some(line));
    }

    /// Takes a setting from a line above the numbers.
    pub(super) fn take(&mut self, line: usize, text: &str) {
        if text.len() > LONGEST && !text.starts_with("Date,Mode,") {
            return;
        }
        let mark = IN_PERCENT.iter().find(|(start, _)| text.starts_with(start));
        let mark = mark.filter(|(start, _)| *start != "Data from " || text.trim_end().ends_with(" Node"));
        self.ratios_in_percent = self.ratios_in_percent.or(mark.map(|(_, program)| (line, *program)));
        if text.len() > LONGEST {
            return;
        }
        self.mention(line, text);
        let lower = text.trim().to_lowercase();
        if lower.contains("not compared to a white reference") {
            self.ratio = Some((line, false));
        } else if lower.contains("compared to a white reference") {
            self.ratio = Some((line, true));
        }
        if lower.contains("cosine receptor") && lower.contains("attached") && !lower.contains("no remote") {
            self.cosine_receptor = Some(line);
        }
        let Some((key, value)) = lower.split_once([':', ',', ';', '=', '\t']) else { return };
        let (key, value) = (key.trim().trim_matches('"'), value.trim().trim_matches('"'));
        if key == "reference spectrum present" {
            let present = |answers: [&str; 3]| answers.contains(&value);
            let said = if present(["no", "false", "0"]) {
                Some(false)
            } else {
                Some(true).filter(|_| present(["yes", "true", "1"]))
            };
            self.ratio = said.map(|said| (line, said)).or(self.ratio);
        }
        if MEASURED.contains(&key) {
            self.role = header_terms::role(value).map(|role| (line, role)).or(self.role);
            let values = header_terms::values(value).filter(|values| *values != Values::Plain);
            self.values = values.map(|values| (line, values)).or(self.values);
        }
    }
}
