//! Color corrections out of the program: text, DNG values, DCP, ICC, CLF.

mod json;
mod query;
pub mod shot;

use std::fmt::Write as _;

use chromascope_core::camera::ChannelRatio;
use chromascope_core::colorimetry::{Xy, Xyz};
use chromascope_core::correction::RgbTransform;
use chromascope_core::correction::aces::{Idt, IdtError};
use chromascope_core::correction::dng::{DngMatrices, ProfileMatrix};
use chromascope_core::correction::neutral::Neutral;
use chromascope_core::correction::root_polynomial::RootPolynomial;
use chromascope_core::glam::{DMat3, DVec3};
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::ErrorSummary;
use chromascope_core::query::correction::{CorrectionSheet, CorrectionUnder, StimulusCheck};
use chromascope_core::units::Kelvin;
use chromascope_profile::clf::Clf;
use chromascope_profile::dcp::{Calibration, CalibrationIlluminant, Dcp};
use chromascope_profile::icc::{D50, IccProfile, IccVersion};
use chromascope_profile::{Matrix, ProfileError};

pub use query::{CorrectionFileQuery, CorrectionRequest, stated_model, unique_camera_model};

use crate::format::slug;
use crate::scene::correction::exif_light;

/// A file that a correction is saved as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CorrectionForm {
    Dcp,
    Icc(IccVersion),
    Clf,
    Dng,
    Text,
}

impl CorrectionForm {
    /// All forms, in the order of their buttons.
    pub const ALL: [Self; 6] =
        [Self::Dcp, Self::Icc(IccVersion::V4), Self::Icc(IccVersion::V2), Self::Clf, Self::Dng, Self::Text];

    /// Ending of such files; what stands before it, so that no two forms of a correction share a name; label of the button; and what
    /// it saves.
    const fn all_words(self) -> [&'static str; 4] {
        match self {
            Self::Dcp => ["dcp", "", "DCP…", "DNG camera profile for raw developers: matrices of one light or two"],
            Self::Icc(IccVersion::V4) => {
                ["icc", "", "ICC v4…", "ICC matrix profile, version 4, for linear RGB balanced for the light"]
            }
            Self::Icc(IccVersion::V2) => {
                let why = "ICC matrix profile, version 2, for programs that read no version 4, as ArgyllCMS";
                ["icc", "-v2", "ICC v2…", why]
            }
            Self::Clf => ["clf", "", "ACES CLF…", "ACES input transform as rawtoaces defines it, in Common LUT Format"],
            Self::Dng => ["txt", "-dng", "DNG text…", "DNG's matrices and AsShotNeutral as lines of text"],
            Self::Text => ["txt", "", "Text…", "All matrices and errors as text"],
        }
    }

    pub const fn ending(self) -> &'static str {
        self.all_words()[0]
    }

    /// Label of the button, and the object it saves.
    pub const fn words(self) -> (&'static str, &'static str) {
        let [.., label, why] = self.all_words();
        (label, why)
    }
}

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CorrectionFileError {
    #[error(
        "{0} files hold a 3×3 matrix, which a root polynomial or a singular matrix is not; choose a matrix that is fitted"
    )]
    NoMatrix(&'static str),
    #[error(transparent)]
    Idt(#[from] IdtError),
    #[error(transparent)]
    Profile(#[from] ProfileError),
    #[error(
        "{camera}: its channel ratio is {ratio}. DCP, DNG and CLF files hold that ratio: give AsShotNeutral of a raw file under \
         {light} (--neutral R,G,B; in the window the field Neutral). ICC files do without"
    )]
    Ratio { camera: String, light: String, ratio: ChannelRatio },
}

/// Color correction of a camera, with the question that has the names that files need.
#[derive(Clone, Debug)]
pub struct CorrectionFile {
    pub of: CorrectionFileQuery,
    pub sheet: CorrectionSheet,
    /// ACES input transform under the first light.
    pub idt: Result<Idt, IdtError>,
    pub ratio: ChannelRatio,
}

impl CorrectionFile {
    /// Lights with the correction under each.
    pub fn unders(&self) -> impl Iterator<Item = (&String, &CorrectionUnder)> {
        let second = self.sheet.second.as_ref().and_then(|second| second.as_ref().ok());
        self.of.lights.iter().zip(std::iter::once(&self.sheet.first).chain(second))
    }

    fn name(&self) -> String {
        let lights: Vec<&str> = self.unders().map(|(name, _)| name.as_str()).collect();
        format!("Chromascope {}", lights.join(" + "))
    }

    /// Lights by color temperature, as DNG numbers them.
    fn warmer_first(&self) -> Vec<(&String, &CorrectionUnder)> {
        let mut unders: Vec<_> = self.unders().collect();
        let mired = |under: &CorrectionUnder| under.temperature.map_or(0.0, Kelvin::mired);
        unders.sort_by(|(_, a), (_, b)| mired(b).total_cmp(&mired(a)));
        unders
    }

    pub fn written(&self, form: CorrectionForm) -> Result<Vec<u8>, CorrectionFileError> {
        match form {
            CorrectionForm::Dcp => self.dcp(),
            CorrectionForm::Icc(version) => self.icc(version),
            CorrectionForm::Clf => self.clf().map(String::into_bytes),
            CorrectionForm::Dng => self.dng().map(String::into_bytes),
            CorrectionForm::Text => Ok(self.text().into_bytes()),
        }
    }

    /// Checks that the ratio between the channels is credible, or a neutral is given in its place.
    pub fn has_ratio(&self) -> Result<(), CorrectionFileError> {
        let light = self.of.lights.first().map_or("", String::as_str);
        has_ratio(&self.of.camera, light, self.ratio, self.of.idt.neutral)
    }

    /// DNG matrices of a light; with a given neutral, the camera's channels are scaled to it under the first light.
    pub fn dng_matrices(&self, under: &CorrectionUnder) -> Option<DngMatrices> {
        let dng = under.report.dng?;
        let Some(neutral) = self.of.idt.neutral else { return Some(dng) };
        dng.with_gains(neutral.to_vector() / self.sheet.first.report.dng?.neutral())
    }

    /// DNG camera profile; of two lights, the warmer first.
    fn dcp(&self) -> Result<Vec<u8>, CorrectionFileError> {
        let calibration =
            |(light, under): &(&String, &CorrectionUnder)| calibration(light, under.xy, self.dng_matrices(under)?);
        let calibrations: Option<Vec<Calibration>> = self.warmer_first().iter().map(calibration).collect();
        let calibrations = calibrations.ok_or(CorrectionFileError::NoMatrix("DCP"))?;
        self.has_ratio()?;
        let dcp =
            Dcp { camera: self.of.model.clone(), name: self.name(), copyright: self.of.terms.clone(), calibrations };
        Ok(dcp.to_bytes()?)
    }

    /// ICC matrix profile of the first light. It takes balanced RGB, so that the channel ratio is not in it.
    fn icc(&self, version: IccVersion) -> Result<Vec<u8>, CorrectionFileError> {
        let report = &self.sheet.first.report;
        let RgbTransform::Matrix(matrix) = &report.transform else { return Err(CorrectionFileError::NoMatrix("ICC")) };
        let to = Xyz::from_vector(DVec3::from_array(D50));
        let profile = ProfileMatrix::new(*matrix, report.adopted_white, to);
        let profile = profile.ok_or(CorrectionFileError::NoMatrix("ICC"))?;
        let icc = IccProfile {
            description: format!("{}, {}", self.of.camera, self.name()),
            copyright: self.of.terms.clone(),
            xyz_from_rgb: rows(profile.xyz_from_rgb),
            adaptation: rows(profile.adaptation),
        };
        Ok(icc.to_bytes(version)?)
    }

    /// DNG's matrices as `Tag: values` lines; of two lights, the warmer first.
    pub fn dng(&self) -> Result<String, CorrectionFileError> {
        let mut text = format!("UniqueCameraModel: {}\n", self.of.model);
        for (index, (name, under)) in self.warmer_first().into_iter().enumerate() {
            let number = index + 1;
            let dng = self.dng_matrices(under).ok_or(CorrectionFileError::NoMatrix("DNG"))?;
            let neutral = dng.neutral();
            let _ = writeln!(text, "CalibrationIlluminant{number}: {}", exif_light(name).unwrap_or(255));
            if let Some(xy) = under.xy.filter(|_| exif_light(name).is_none()) {
                let _ = writeln!(text, "IlluminantData{number}: {:.6} {:.6}", xy.x, xy.y);
            }
            let _ = writeln!(text, "ColorMatrix{number}: {}", on_a_line(dng.color));
            let _ = writeln!(text, "ForwardMatrix{number}: {}", on_a_line(dng.forward));
            let _ = writeln!(text, "AsShotNeutral ({name}): {:.6} {:.6} {:.6}", neutral.x, neutral.y, neutral.z);
        }
        self.has_ratio().map(|()| text)
    }

    /// ACES input transform in Common LUT Format. Its description states balance multipliers, which are the channel ratio.
    fn clf(&self) -> Result<String, CorrectionFileError> {
        let light = self.of.lights.first().map_or("", String::as_str);
        let idt = self.idt.as_ref().map_err(|error| *error)?;
        self.has_ratio()?;
        clf(&self.of.camera, light, idt, RAWTOACES)
    }

    /// Everything in words and aligned numbers.
    pub fn text(&self) -> String {
        let mut text = format!("{}\n{}\nChannel ratio {}\n", self.of.camera, self.of.correction, self.ratio);
        if let Some(DVec3 { x, y, z }) = self.of.idt.neutral.map(Neutral::to_vector) {
            let _ = writeln!(text, "Given neutral under {}: {x:.6} {y:.6} {z:.6}", self.of.lights[0]);
        }
        for (name, under) in self.unders() {
            let kelvin = under.temperature.map_or(String::new(), |kelvin| format!(", {:.0} K", kelvin.get()));
            let _ = writeln!(text, "\nUnder {name}{kelvin}");
            self.under(&mut text, under);
        }
        if let Some(Err(error)) = &self.sheet.second {
            let _ = writeln!(text, "\nSecond light: {error}");
        }
        if let Some(points) = &self.sheet.between {
            text += "\nBetween the two lights: mean ΔE*00 of blackbodies by ForwardMatrix\n       K     mixed     first    second       own\n";
            for point in points {
                let kelvin = point.temperature.get();
                let (mixed, first, second, own) = (point.mixed, point.first, point.second, point.own);
                let _ = writeln!(text, "{kelvin:8.0}{mixed:10.3}{first:10.3}{second:10.3}{own:10.3}");
            }
        }
        if let Ok(idt) = &self.idt {
            let _ = writeln!(text, "\nACES IDT (rawtoaces)\n{}", self.idt_text(idt));
        }
        if let Err(error) = self.has_ratio() {
            let _ = writeln!(text, "\n{error}");
        }
        text
    }

    /// Balance, matrix and errors of the ACES input transform; no balance without a credible channel ratio.
    pub fn idt_text(&self, idt: &Idt) -> String {
        let [r, g, b] = idt.balance;
        let balance = self.has_ratio().map_or(String::new(), |()| format!("balance {r:.7} {g:.7} {b:.7}\n"));
        let errors: Vec<Option<f64>> = idt.errors.iter().copied().map(Some).collect();
        let summary = ErrorSummary::new(&errors);
        let rows = [("training", summary)];
        let table = error_table(&format!("\u{394}E*00 of {}", errors.len()), &rows, &self.of.idt.training);
        let note = idt_note(idt).map_or(String::new(), |note| format!("\n{note}"));
        format!("{balance}{}\n\n{IDT_FIT}\n{table}{note}", aligned(idt.matrix, 7))
    }

    fn under(&self, text: &mut String, under: &CorrectionUnder) {
        let report = &under.report;
        let _ = writeln!(text, "XYZ from balanced RGB\n{}\n", self.transform_text(under));
        let _ = writeln!(text, "{}\n", self.errors_text(under));
        for check in std::iter::once(&report.white).chain(&report.blue) {
            let _ = writeln!(text, "{}", check_lines(check, self.of.metric).join("  "));
        }
        if let Some(dng) = self.dng_matrices(under) {
            let [r, g, b] = dng.balance;
            if self.has_ratio().is_ok() {
                let _ = writeln!(text, "\nbalance {r:.6} {g:.6} {b:.6}\nDNG ColorMatrix\n{}", aligned(dng.color, 7));
            }
            let _ = writeln!(text, "DNG ForwardMatrix\n{}", aligned(dng.forward, 7));
        }
    }

    pub fn transform_text(&self, under: &CorrectionUnder) -> String {
        match &under.report.transform {
            RgbTransform::Matrix(matrix) => aligned(*matrix, 7),
            RgbTransform::RootPolynomial(polynomial) => polynomial_table(polynomial),
        }
    }

    /// Training and leave-one-out errors before and after, as aligned lines.
    pub fn errors_text(&self, under: &CorrectionUnder) -> String {
        let report = &under.report;
        let rows = [("uncorrected", report.before), ("training", report.training), ("leave-one-out", report.left_out)];
        error_table(&format!("{} of {}", self.of.metric, report.count), &rows, &self.of.training)
    }
}

/// The fit of the ACES input transform in words, where its errors stand beside those of the other matrices.
const IDT_FIT: &str = "Another fit than of DCP and ICC, to ACES:\nleast squares in L*a*b*, CAT02,\n190 reflectances";

/// Checks that a channel ratio is credible, or a neutral is given in its place.
pub fn has_ratio(
    camera: &str,
    light: &str,
    ratio: ChannelRatio,
    neutral: Option<Neutral>,
) -> Result<(), CorrectionFileError> {
    if ratio.is_credible() || neutral.is_some() {
        return Ok(());
    }
    Err(CorrectionFileError::Ratio { camera: camera.to_owned(), light: light.to_owned(), ratio })
}

/// Summaries of errors as aligned lines; `of` are the reflectances.
fn error_table(head: &str, rows: &[(&str, Option<ErrorSummary>)], of: &PatchSet) -> String {
    let line = |(label, summary): &(&str, Option<ErrorSummary>)| match summary {
        None => format!("{label:<16}undefined"),
        Some(ErrorSummary { mean, p95, max, worst }) => {
            let worst = of.patches().get(*worst).map_or("", |patch| &patch.name);
            format!("{label:<16}{mean:8.3}{p95:8.3}{max:8.3}  {worst}")
        }
    };
    std::iter::once(format!("{head:<16}    mean    95 %     max  at"))
        .chain(rows.iter().map(line))
        .collect::<Vec<_>>()
        .join("\n")
}

/// Calibration of a DCP file; none for a light that is neither one of EXIF's nor has a chromaticity.
fn calibration(light: &str, xy: Option<Xy>, dng: DngMatrices) -> Option<Calibration> {
    let illuminant = match exif_light(light) {
        Some(code) => CalibrationIlluminant::Exif(code),
        None => xy.map(|xy| CalibrationIlluminant::Other([xy.x, xy.y]))?,
    };
    Some(Calibration { illuminant, color: rows(dng.color), forward: rows(dng.forward) })
}

/// Method of ACES input transforms, in words.
pub const RAWTOACES: &str = "as rawtoaces defines it";

/// ACES input transform in Common LUT Format; `method` in words.
pub fn clf(camera: &str, light: &str, idt: &Idt, method: &str) -> Result<String, CorrectionFileError> {
    let [r, g, b] = idt.balance;
    let mut descriptions = vec![
        format!("ACES input device transform of {camera} for {light}, {method}"),
        format!("White balance multipliers before this matrix: {r:.7} {g:.7} {b:.7}"),
    ];
    descriptions.extend(idt_note(idt));
    let clf = Clf {
        id: format!("chromascope-idt-{}", slug(&format!("{camera} {light}"))),
        name: format!("{camera}, {light}: camera RGB to ACES2065-1"),
        descriptions,
        input: format!("Linear {camera} RGB, white balanced for {light}"),
        output: "ACES2065-1".to_owned(),
        matrix: rows(idt.matrix),
    };
    Ok(clf.to_xml()?)
}

/// Caution where rawtoaces' two scalings of the samples differ.
pub fn idt_note(idt: &Idt) -> Option<String> {
    let signal = idt.white_signal;
    let mean = idt.errors.iter().sum::<f64>() / idt.errors.len().max(1) as f64;
    ((signal - 1.0).abs() > 1e-6).then(|| {
        format!(
            "As rawtoaces scales it, white was {signal:.4} and not 1 in this fit; mean \u{394}E*00 at white 1: {mean:.2}"
        )
    })
}

/// A matrix as rows of aligned numbers with so many decimals.
pub fn aligned(matrix: DMat3, decimals: usize) -> String {
    let width = decimals + 5;
    let row = |row: usize| {
        let DVec3 { x, y, z } = matrix.row(row);
        format!("{x:width$.decimals$}{y:width$.decimals$}{z:width$.decimals$}")
    };
    [row(0), row(1), row(2)].join("\n")
}

/// Lines of text on a corrected stimulus: the values and their interpretation.
pub fn check_lines(check: &StimulusCheck, metric: &str) -> [String; 2] {
    let Xyz { x, y, z } = check.xyz;
    let what = check.peak_nm.map_or_else(|| "white".to_owned(), |nm| format!("{nm:.0} nm"));
    let remark = match (check.difference, check.is_negative(), check.clips()) {
        (Some(difference), ..) => format!("{metric} {difference:.3} from the reference's white"),
        (None, true, _) => "a negative tristimulus value: no light has this color; sRGB clips it".to_owned(),
        (None, false, true) => "outside sRGB, clipped".to_owned(),
        (None, false, false) => "inside sRGB".to_owned(),
    };
    [format!("{what:<8}XYZ {x:9.4}{y:9.4}{z:9.4}"), remark]
}

pub fn file_name(file: &CorrectionFile, form: CorrectionForm) -> String {
    let (camera, lights) = (slug(&file.of.camera), slug(&file.of.lights.join(" ")));
    let [ending, suffix, ..] = form.all_words();
    format!("{camera}-{lights}{suffix}.{ending}")
}

fn polynomial_table(polynomial: &RootPolynomial) -> String {
    let line = |(index, c): (usize, &DVec3)| {
        format!("{:<10}{:11.6}{:11.6}{:11.6}", RootPolynomial::term_name(index), c.x, c.y, c.z)
    };
    polynomial.coefficients().iter().enumerate().map(line).collect::<Vec<_>>().join("\n")
}

fn rows(matrix: DMat3) -> Matrix {
    [0, 1, 2].map(|row| matrix.row(row).to_array())
}

fn on_a_line(matrix: DMat3) -> String {
    rows(matrix).iter().flatten().map(|value| format!("{value:.6}")).collect::<Vec<_>>().join(" ")
}
