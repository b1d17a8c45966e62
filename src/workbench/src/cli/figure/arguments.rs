//! Arguments of `figure`.

use std::ffi::OsString;
use std::path::PathBuf;

use chromascope_figure::AxisRanges;
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::cli::arguments::{CommonArguments, PixelArguments};
use crate::cli::render::arguments::ViewpointArguments;
use crate::cli::settings::{Given, choice};
use crate::document::Exaggeration;
use crate::export::Paper;
use crate::figures::FIGURES;
use crate::figures::chromaticity::shown::Ranges;
use crate::figures::kind::FigureKind;
use crate::figures::look::DifferencePlane;

const EXAMPLES: &str = "Examples:
  chromascope figure chromaticity --preset paper --width 85mm --font-size 8 --out figure3.pdf
  chromascope figure spectra --camera \"Nikon D70\" --width 174mm --style print --out spectra.svg
  chromascope figure swatches --session work.chromascope --width 3.35in --dpi 600 --out swatches.png
  chromascope figure render --mesh fern --width 174mm --out figure8.pdf
  chromascope figure head-to-head --camera \"Nikon D70\" --camera \"Nikon D200\" --temperature 3200 --out pair.pdf
  chromascope figure head-to-head --camera \"Nikon D70\" --camera \"Nikon D200\" --out pair.tex
  chromascope figure chromaticity --range 0.3,0.5,0.3,0.42 --numbers visible --out points.csv

The ending of the file decides its form: .pdf, .svg, .png, .tif, or .csv, .json and .tex (LaTeX with booktabs), the \
numbers behind the figure. Text keeps its size whatever the width: the figure is laid out for it. In a PDF text can be searched, and its fonts are embedded.";

/// Figures for paper, laid out for a width: PDF, SVG, PNG, or the numbers behind them as CSV
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct FigureArguments {
    /// The figure
    #[arg(value_parser = kind())]
    pub(super) kind: Kind,
    /// A file with curves for `curves`, or with raw values of patches for `recorded`
    pub(super) file: Option<PathBuf>,
    #[command(flatten)]
    pub(super) common: CommonArguments,
    /// A saved document, in place of sensors, reference, illuminant and patches
    #[arg(long, value_name = "FILE", conflicts_with_all = ["observer", "camera", "per", "reference", "transform", "fit_to",
          "correction", "training", "illuminant", "filter", "white", "chart",
          "second_light"])]
    pub(super) session: Option<PathBuf>,
    /// A chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) chart: Option<OsString>,
    /// The second light of `correction`: a name or a file with one curve
    #[arg(long, value_name = "NAME|FILE")]
    pub(super) second_light: Option<OsString>,
    /// Temperature in kelvins that marks the loci, and of the locus metrics [default: that of a blackbody or daylight as the
    /// illuminant, a session's own, otherwise as in `compare` 2856 for metrics, head-to-head and report-card, 5500 for others]
    #[arg(long, value_name = "K")]
    pub(super) temperature: Option<f64>,
    #[command(flatten)]
    pub(super) pixel: PixelArguments,
    /// Factor on the differences that are drawn; numbers stay [default: 1, or the session's]
    #[arg(long, value_name = "K", value_parser = choice::<Exaggeration>())]
    pub(super) exaggerate: Option<Exaggeration>,
    /// What `differences` shows
    #[arg(long, value_parser = choice::<DifferencePlane>(), default_value = DifferencePlane::default().key())]
    pub(super) plane: DifferencePlane,
    /// What is rendered: head, fern, sphere, plane, or an OBJ, PLY or STL file [default: the head, or the session's]
    #[arg(long, value_name = "MESH")]
    pub(super) mesh: Option<OsString>,
    #[command(flatten)]
    pub(super) viewpoint: ViewpointArguments,
    #[command(flatten)]
    pub(super) paper: PaperArguments,
}

/// A kind of figure; none for skipped work, which is a table: `render --stats`.
#[derive(Clone, Debug)]
pub(super) struct Kind(pub(super) Option<&'static FigureKind>);

/// The word of skipped work.
const WORK_SAVED: &str = "work-saved";

fn kind() -> impl TypedValueParser<Value = Kind> {
    let words = FIGURES.iter().map(|kind| PossibleValue::new(kind.key).help(kind.help));
    PossibleValuesParser::new(words.chain([PossibleValue::new(WORK_SAVED).hide(true)]))
        .map(|key| Kind(FIGURES.iter().copied().find(|kind| kind.key == key)))
}

/// Arguments that lay a figure out.
#[derive(Debug, Args)]
pub(super) struct PaperArguments {
    #[command(flatten)]
    settings: Given<Paper>,
    /// Ranges of the chromaticity diagram: `data`, `full`, or X0,X1,Y0,Y1
    #[arg(long, value_name = "RANGE", default_value = "data", value_parser = range, help_heading = "Paper")]
    pub(super) range: Range,
}

impl PaperArguments {
    pub(super) fn paper(&self) -> Paper {
        let ranges = if self.range == Range::Full { AxisRanges::Full } else { AxisRanges::Screen };
        let usual = Paper { width_mm: Some(Paper::ONE_COLUMN_MM), ranges, ..Paper::default() };
        self.settings.applied_to(usual)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    Data,
    Full,
    Of(Ranges),
}

fn range(text: &str) -> Result<Range, String> {
    match text.trim() {
        "data" => return Ok(Range::Data),
        "full" => return Ok(Range::Full),
        _ => {}
    }
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok(&[x0, x1, y0, y1]) if x1 - x0 > 1e-6 && y1 - y0 > 1e-6 && x1 - x0 < 10.0 && y1 - y0 < 10.0 => {
            Ok(Range::Of([[x0, x1], [y0, y1]]))
        }
        _ => Err("expected data, full, or the ends of x and y in ascending order, such as 0.3,0.5,0.3,0.4".to_owned()),
    }
}
