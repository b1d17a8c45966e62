//! Instrument settings above the numbers that indicate the measured quantity and its scale.

use crate::decision::{Role, Values};
use crate::text::is_one;
use crate::{header_terms, uncertainty_terms};

/// Longer lines are no settings.
pub(super) const LONGEST: usize = 400;

#[derive(Debug, Default)]
pub(super) struct Clues {
    /// True if the values are ratios to a reference measurement.
    pub(super) ratio: Option<(usize, bool)>,
    /// A cosine receptor was attached: the values are irradiances.
    pub(super) cosine_receptor: Option<usize>,
    pub(super) ratios_in_percent: Option<(usize, &'static str)>,
    pub(super) role: Option<(usize, Role)>,
    pub(super) values: Option<(usize, Values)>,
    /// A title or a name of data mentions absorbances; line 0 stands for the name of the file or its folder.
    pub(super) absorbance: Option<usize>,
    /// A title or a line says that the values are uncertainties; line 0 stands for the name of the file.
    pub(super) uncertainties: Option<usize>,
    /// The name of the file says quantum efficiency.
    pub(super) quantum: bool,
    /// A title or a line names what has none of the roles, and the reason.
    pub(super) other: Option<(usize, &'static str)>,
    /// True if a line names a property of a material that is none of the quantities read.
    pub(super) material: bool,
    /// True if a line says that this is a spectrum of fluorescence: what its file is named after is no camera and no fraction.
    pub(super) fluorescence: bool,
}

pub(super) const MEASURED: &str = "quantity|spectral quantity|measured quantity|technique|mode|data mode|photometric mode|\
    measuring mode|measurement|measurement mode|measurement type|ordinate|ordinate mode|y axis|yaxis|y label";

pub(super) struct Program {
    start: &'static str,
    end: &'static str,
    pub(super) name: &'static str,
    /// True if it writes reflectances and transmittances in percent, whatever their values.
    percent: bool,
}

const fn program_of(start: &'static str, name: &'static str, percent: bool) -> Program {
    Program { start, end: "", name, percent }
}

pub(super) const THORLABS: &str = "Thorlabs";

const PROGRAMS: [Program; 14] = [
    program_of("SpectraSuite Data File", "Ocean SpectraSuite", true),
    program_of("OOIBase32 Version", "Ocean OOIBase32", true),
    program_of("Jaz Data File", "Ocean Jaz", true),
    Program { end: " Node", ..program_of("Data from ", "Ocean OceanView", true) },
    program_of(">>>>>", "an Ocean program", true),
    program_of("Text conversion of header file", "ASD ViewSpec Pro", false),
    program_of("Data measured with spectrometer", "Avantes AvaSoft", true),
    program_of("Filename-->", "an Avantes program", false),
    program_of("ENLIGHTEN Version", "Wasatch ENLIGHTEN", true),
    program_of("Date,Mode,IntegrationTime(ms)", "CID SpectraVue", true),
    program_of("LambdaPValue\t", "a UPRtek meter", false),
    program_of("#Thorlabs", THORLABS, false),
    program_of("Thorlabs", THORLABS, false),
    program_of("X Units:", "the ECOSTRESS library", false),
];

pub(super) fn program(line: &str) -> Option<&'static Program> {
    PROGRAMS.iter().find(|program| line.starts_with(program.start) && line.trim_end().ends_with(program.end))
}

impl Clues {
    pub(super) fn mention(&mut self, line: usize, text: &str) {
        // The name of a file may join its words.
        let spaced = text.replace('_', " ");
        self.absorbance = self.absorbance.or_else(|| header_terms::mentions_absorbance(&spaced).then_some(line));
        // Wide gaps stand between the heads of columns.
        let title = !spaced.trim().contains("  ") && uncertainty_terms::is_title(&spaced);
        self.uncertainties = self.uncertainties.or(title.then_some(line));
        self.material = self.material || header_terms::names_material(&spaced);
        self.other = self.other.or_else(|| Some((line, header_terms::not_converted(&spaced)?)));
    }

    pub(super) fn take(&mut self, line: usize, text: &str) {
        if text.len() > LONGEST && !text.starts_with("Date,Mode,") {
            return;
        }
        let percent = program(text).filter(|program| program.percent).map(|program| (line, program.name));
        self.ratios_in_percent = self.ratios_in_percent.or(percent);
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
            let present = is_one(value, "yes|true|1").then_some(true);
            let said = if is_one(value, "no|false|0") { Some(false) } else { present };
            self.ratio = said.map(|said| (line, said)).or(self.ratio);
        }
        self.fluorescence |= key == "data type" && value.starts_with("fluorescence");
        if is_one(key, MEASURED) {
            self.role = header_terms::role(value).map(|role| (line, role)).or(self.role);
            let values = header_terms::values(value).filter(|values| *values != Values::Plain);
            self.values = values.map(|values| (line, values)).or(self.values);
        }
    }
}
