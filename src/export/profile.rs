//! Color corrections out of the program: text, DNG values, DCP, ICC, CLF.

use std::fmt::Write as _;
use std::sync::Arc;

use chromascope_core::colorimetry::Xyz;
use chromascope_core::correction::RgbTransform;
use chromascope_core::correction::aces::{Idt, IdtError, IdtExposure};
use chromascope_core::correction::dng::ProfileMatrix;
use chromascope_core::correction::root_polynomial::RootPolynomial;
use chromascope_core::glam::{DMat3, DVec3};
use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::correction::{
    CorrectionSheet, CorrectionSheetQuery, CorrectionUnder, IdtQuery, StimulusCheck,
};
use chromascope_core::query::{Ask, ErrorSummary, Query, Shared};
use chromascope_core::units::Kelvin;
use chromascope_profile::clf::Clf;
use chromascope_profile::dcp::{Calibration, CalibrationIlluminant, Dcp};
use chromascope_profile::icc::{D50, IccProfile};
use chromascope_profile::{Matrix, ProfileError};

use crate::document::SetKind;
use crate::format::slug;
use crate::scene::correction::exif_light;
use crate::scene::{Scene, SceneError};

/// Reason that a correction has no file of a kind.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CorrectionFileError {
    /// Files hold matrices.
    #[error(
        "{0} files hold a 3×3 matrix, which a root polynomial or a singular matrix is not; choose a matrix that is fitted"
    )]
    NoMatrix(&'static str),
    /// The camera has no ACES input transform under the light.
    #[error(transparent)]
    Idt(#[from] IdtError),
    /// The format cannot hold it.
    #[error(transparent)]
    Profile(#[from] ProfileError),
}

/// Color correction of a camera with the names that files need.
#[derive(Clone, Debug)]
pub struct CorrectionFile {
    /// The camera in the catalog.
    pub camera: String,
    /// Camera model as raw files call it.
    pub model: String,
    /// Correction in words.
    pub correction: String,
    /// Names of the lights.
    pub lights: Vec<String>,
    /// Symbol of the metric of the errors.
    pub metric: &'static str,
    /// Names of the training reflectances.
    pub training: Vec<String>,
    /// The correction.
    pub sheet: CorrectionSheet,
    /// ACES input transform under the first light.
    pub idt: Result<Idt, IdtError>,
}

/// Query for the color correction of a camera of the scene, with its ACES input transform.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CorrectionFileQuery {
    camera: String,
    model: String,
    correction: String,
    lights: Vec<String>,
    metric: &'static str,
    training: Shared<PatchSet>,
    sheet: CorrectionSheetQuery,
    idt: IdtQuery,
}

impl CorrectionFileQuery {
    /// Query for a camera. `model` is the camera's name in raw files, if that is another.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where the camera, a light or the training reflectances are not available.
    pub fn new(
        scene: &Scene<'_>,
        (kind, camera): (SetKind, &str),
        model: Option<&str>,
        exposure: IdtExposure,
    ) -> Result<Self, SceneError> {
        let choice = &scene.document.correction;
        Ok(Self {
            camera: camera.to_owned(),
            model: model.unwrap_or(camera).to_owned(),
            correction: choice.describe(scene.fit_target()),
            lights: std::iter::once(scene.light_name())
                .chain(choice.second_light.clone().map(|light| scene.with_filters(light)))
                .collect(),
            metric: scene.correction_metric().symbol,
            training: scene.patch_set(&choice.training, None)?,
            sheet: scene.correction_sheet(kind, camera)?,
            idt: scene.input_device_transform(kind, camera, exposure)?,
        })
    }
}

impl Query for CorrectionFileQuery {
    type Answer = Result<Arc<CorrectionFile>, SceneError>;
    const NAME: &'static str = "color correction with its names";

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let sheet = (*ask.ask(&self.sheet)).clone();
        Ok(Arc::new(CorrectionFile {
            camera: self.camera.clone(),
            model: self.model.clone(),
            correction: self.correction.clone(),
            lights: self.lights.clone(),
            metric: self.metric,
            training: self.training.patches().iter().map(|patch| patch.name.clone()).collect(),
            sheet: sheet.map_err(|error| SceneError::Rendering { name: self.camera.clone(), error })?,
            idt: (*ask.ask(&self.idt)).clone(),
        }))
    }
}

impl CorrectionFile {
    /// Lights with the correction under each.
    pub fn unders(&self) -> impl Iterator<Item = (&String, &CorrectionUnder)> {
        let second = self.sheet.second.as_ref().and_then(|second| second.as_ref().ok());
        self.lights.iter().zip(std::iter::once(&self.sheet.first).chain(second))
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

    /// DNG camera profile; of two lights, the warmer first.
    ///
    /// # Errors
    ///
    /// [`CorrectionFileError`] for a root polynomial, a singular matrix, or a name that the format cannot hold.
    pub fn dcp(&self) -> Result<Vec<u8>, CorrectionFileError> {
        let unders = self.warmer_first();
        let calibrations: Option<Vec<Calibration>> =
            unders.iter().map(|(name, under)| calibration(name, under)).collect();
        let dcp = Dcp {
            camera: self.model.clone(),
            name: self.name(),
            copyright: String::new(),
            calibrations: calibrations.ok_or(CorrectionFileError::NoMatrix("DCP"))?,
        };
        Ok(dcp.to_bytes()?)
    }

    /// ICC matrix profile of the first light.
    ///
    /// # Errors
    ///
    /// [`CorrectionFileError`] as [`Self::dcp`].
    pub fn icc(&self) -> Result<Vec<u8>, CorrectionFileError> {
        let report = &self.sheet.first.report;
        let RgbTransform::Matrix(matrix) = &report.transform else { return Err(CorrectionFileError::NoMatrix("ICC")) };
        let to = Xyz::from_vector(DVec3::from_array(D50));
        let profile = ProfileMatrix::new(*matrix, report.adopted_white, to);
        let profile = profile.ok_or(CorrectionFileError::NoMatrix("ICC"))?;
        let icc = IccProfile {
            description: format!("{}, {}", self.camera, self.name()),
            copyright: String::new(),
            xyz_from_rgb: rows(profile.xyz_from_rgb),
            adaptation: rows(profile.adaptation),
        };
        Ok(icc.to_bytes()?)
    }

    /// DNG's matrices as `Tag: values` lines; of two lights, the warmer first.
    ///
    /// # Errors
    ///
    /// [`CorrectionFileError::NoMatrix`] for a root polynomial or a singular matrix.
    pub fn dng(&self) -> Result<String, CorrectionFileError> {
        let mut text = format!("UniqueCameraModel: {}\n", self.model);
        for (index, (name, under)) in self.warmer_first().into_iter().enumerate() {
            let number = index + 1;
            let dng = under.report.dng.ok_or(CorrectionFileError::NoMatrix("DNG"))?;
            let neutral = DVec3::from_array(dng.balance).recip();
            let _ = writeln!(text, "CalibrationIlluminant{number}: {}", exif_light(name).unwrap_or(255));
            if let Some(xy) = under.xy.filter(|_| exif_light(name).is_none()) {
                let _ = writeln!(text, "IlluminantData{number}: {:.6} {:.6}", xy.x, xy.y);
            }
            let _ = writeln!(text, "ColorMatrix{number}: {}", on_a_line(dng.color));
            let _ = writeln!(text, "ForwardMatrix{number}: {}", on_a_line(dng.forward));
            let _ = writeln!(text, "AsShotNeutral ({name}): {:.6} {:.6} {:.6}", neutral.x, neutral.y, neutral.z);
        }
        Ok(text)
    }

    /// ACES input transform in Common LUT Format.
    ///
    /// # Errors
    ///
    /// [`CorrectionFileError`] without a transform, or for a name that the format cannot hold.
    pub fn clf(&self) -> Result<String, CorrectionFileError> {
        let light = self.lights.first().map_or("", String::as_str);
        clf(&self.camera, light, self.idt.as_ref().map_err(|error| *error)?)
    }

    /// Everything in words and aligned numbers.
    pub fn text(&self) -> String {
        let mut text = format!("{}\n{}\n", self.camera, self.correction);
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
            let [r, g, b] = idt.balance;
            let _ =
                writeln!(text, "\nACES IDT (rawtoaces), after balance {r:.7} {g:.7} {b:.7}\n{}", aligned(idt.matrix));
            if let Some(note) = idt_note(idt) {
                let _ = writeln!(text, "{note}");
            }
        }
        text
    }

    fn under(&self, text: &mut String, under: &CorrectionUnder) {
        let report = &under.report;
        let _ = writeln!(text, "XYZ from balanced RGB\n{}\n", self.transform_text(under));
        let _ = writeln!(text, "{}\n", self.errors_text(under));
        for check in std::iter::once(&report.white).chain(&report.blue) {
            let _ = writeln!(text, "{}", check_lines(check, self.metric).join("  "));
        }
        if let Some(dng) = &report.dng {
            let [r, g, b] = dng.balance;
            let _ = writeln!(text, "\nbalance {r:.6} {g:.6} {b:.6}\nDNG ColorMatrix\n{}", aligned(dng.color));
            let _ = writeln!(text, "DNG ForwardMatrix\n{}", aligned(dng.forward));
        }
    }

    /// The transform as aligned numbers.
    pub fn transform_text(&self, under: &CorrectionUnder) -> String {
        match &under.report.transform {
            RgbTransform::Matrix(matrix) => aligned(*matrix),
            RgbTransform::RootPolynomial(polynomial) => polynomial_table(polynomial),
        }
    }

    /// Training and leave-one-out errors before and after, as aligned lines.
    pub fn errors_text(&self, under: &CorrectionUnder) -> String {
        let report = &under.report;
        let mut lines =
            vec![format!("{:<16}    mean    95 %     max  at", format!("{} of {}", self.metric, report.count))];
        let rows = [("uncorrected", report.before), ("training", report.training), ("leave-one-out", report.left_out)];
        lines.extend(rows.map(|(label, summary)| format!("{label:<16}{}", self.summary(summary))));
        lines.join("\n")
    }

    fn summary(&self, summary: Option<ErrorSummary>) -> String {
        let Some(ErrorSummary { mean, p95, max, worst }) = summary else { return "undefined".to_owned() };
        let worst = self.training.get(worst).map_or("", String::as_str);
        format!("{mean:8.3}{p95:8.3}{max:8.3}  {worst}")
    }
}

/// ACES input transform in Common LUT Format.
///
/// # Errors
///
/// [`CorrectionFileError`] for a name that the format cannot hold.
pub fn clf(camera: &str, light: &str, idt: &Idt) -> Result<String, CorrectionFileError> {
    let [r, g, b] = idt.balance;
    let mut descriptions = vec![
        format!("ACES input device transform of {camera} for {light}, as rawtoaces defines it"),
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

/// A matrix as rows of aligned numbers.
pub fn aligned(matrix: DMat3) -> String {
    let row = |row: usize| {
        let DVec3 { x, y, z } = matrix.row(row);
        format!("{x:12.7}{y:12.7}{z:12.7}")
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

/// Name of a correction's file.
pub fn file_name(file: &CorrectionFile, ending: &str) -> String {
    format!("{}-{}.{ending}", slug(&file.camera), slug(&file.lights.join(" ")))
}

fn polynomial_table(polynomial: &RootPolynomial) -> String {
    let line = |(index, c): (usize, &DVec3)| {
        format!("{:<10}{:14.6}{:14.6}{:14.6}", RootPolynomial::term_name(index), c.x, c.y, c.z)
    };
    polynomial.coefficients().iter().enumerate().map(line).collect::<Vec<_>>().join("\n")
}

fn calibration(light: &str, under: &CorrectionUnder) -> Option<Calibration> {
    let dng = under.report.dng?;
    let illuminant = match (exif_light(light), under.xy) {
        (Some(code), _) => CalibrationIlluminant::Exif(code),
        (None, xy) => xy.map(|xy| CalibrationIlluminant::Other([xy.x, xy.y]))?,
    };
    Some(Calibration { illuminant, color: rows(dng.color), forward: rows(dng.forward) })
}

fn rows(matrix: DMat3) -> Matrix {
    [0, 1, 2].map(|row| matrix.row(row).to_array())
}

fn on_a_line(matrix: DMat3) -> String {
    rows(matrix).iter().flatten().map(|value| format!("{value:.6}")).collect::<Vec<_>>().join(" ")
}
