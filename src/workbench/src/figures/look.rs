//! What a figure takes from whoever looks at it, as a plain value; without a window, the default.

use std::cmp::Ordering;
use std::sync::Arc;

use chromascope_core::query::RecordedSet;
use chromascope_figure::{CellValue, Table};
use chromascope_measure::Workload;
use chromascope_text::choices;
use serde::{Deserialize, Serialize};

use super::chromaticity::shown::{DiagramFit, DiagramView, Ranges};
use super::curves::import_selection::ImportSelection;
use crate::export::profile::CorrectionFile;
use crate::palette::Surround;
use crate::plot_item::{PlotItem, SensorId};
use crate::profiler::{Measured, Subject};
use crate::render_service::RenderedFrame;
use crate::scene::metrics::RankedCameras;
use crate::scene::recorded::RankedCamera;

/// Choices that the document does not hold, and answers that were made already.
#[derive(Clone, Debug, Default)]
pub struct FigureLook {
    pub hovered: Option<PlotItem>,
    pub selected: Option<PlotItem>,
    /// The reference replaces every camera.
    pub blink: bool,
    pub fit: DiagramFit,
    /// Shown part of the chromaticity diagram.
    pub diagram: DiagramView,
    /// Ranges that another plot is zoomed to, with the title of the figure that they are of.
    pub zoom: Option<(String, Ranges)>,
    /// True if a legend names the sensors: nothing does at their loci.
    pub has_legend: bool,
    /// Share of the loci that is drawn, while they draw in.
    pub locus_share: Option<f64>,
    pub pinned_pixel: Option<PixelPlace>,
    pub swatch_layout: SwatchLayout,
    pub swatch_style: SwatchStyle,
    pub without_bars: bool,
    pub difference_plane: DifferencePlane,
    pub spectra_layout: SpectraLayout,
    pub mode: RenderMode,
    /// The gray around pictures.
    pub surround: Surround,
    pub cameras: RankedCameras,
    pub sorting: Option<Sorting>,
    /// The two cameras of Head to head; `None` for the selected one and the first compared one.
    pub pair: [Option<SensorId>; 2],
    /// The camera whose residuals are shown; the best without one.
    pub residuals_of: Option<String>,
    pub shows: Shows,
    pub pictures: Option<Arc<RenderedFrame>>,
    pub measured: Measured,
    pub correction: Option<Arc<CorrectionFile>>,
    /// Recorded values, and the cameras ranked by them.
    pub recorded: Option<(RecordedSet, Arc<Vec<RankedCamera>>)>,
    /// The file or set whose curves are drawn.
    pub curves: Option<ImportSelection>,
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum SwatchLayout {
        #[default]
        Auto = "auto", "Automatic", "Five patches in rows, more as charts";
        Rows = "rows", "Rows", "A row for each sensor";
        Charts = "charts", "Charts", "A chart for each sensor";
    }
}

choices! {
    /// Arrangement of camera and reference within a swatch.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum SwatchStyle {
        #[default]
        Split = "split", "Split", "Left half: reference; right half: sensor";
        Inset = "inset", "Inset", "The reference inside";
        Whole = "whole", "Sensor only", "The sensor without the reference";
    }
}

choices! {
    /// Plane in which differences are arrows from the reference at its origin, or those of loci along temperature.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum DifferencePlane {
        #[default]
        UvPrime = "uv-prime", "Δu′v′", "Patches in the CIE 1976 diagram, perceptually more uniform than xy";
        Lab = "lab", "Δa*b*", "Patches in CIELAB, seen along L*";
        Xy = "xy", "Δxy", "Patches in the CIE 1931 diagram";
        Loci = "loci", "Loci", "Planckian loci: offset from the reference's, across and along, over the temperature";
    }
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum SpectraLayout {
        #[default]
        Overlay = "overlay", "Overlay", "All sensitivities in one plot";
        Each = "each", "Each", "A plot for each sensor, where there is room for them";
    }
}

choices! {
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum RenderMode {
        #[default]
        Grid = "grid", "Grid", "All sensors side by side";
        Split = "split", "Split", "The reference at the left, a sensor at the right, with a divider to drag";
        One = "one", "One", "One sensor, large (double-click a picture)";
        Difference = "difference", "Difference", "Difference of each sensor from the reference, pixel by pixel";
    }
}

/// A place in every picture, with the sensor that was pointed at.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelPlace {
    /// Right and down, from 0 to 1.
    pub at: [f64; 2],
    pub source: SensorId,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sorting {
    pub column: String,
    pub descending: bool,
}

impl Sorting {
    /// Sorts rows of a table, as they are where it has no such column; equal ones keep their order, empty cells come last.
    pub fn sort(&self, table: &Table, rows: &mut [usize]) {
        let Some(column) = table.columns.iter().position(|column| column.name == self.column) else { return };
        rows.sort_by(|&a, &b| compare(table.cell(a, column).value(), table.cell(b, column).value(), self.descending));
    }
}

/// Numbers by value, before texts by letters, before nothing.
fn compare(a: CellValue<'_>, b: CellValue<'_>, descending: bool) -> Ordering {
    let turned = |order: Ordering| if descending { order.reverse() } else { order };
    let rank = |cell: CellValue<'_>| match cell {
        CellValue::Number(value) if !value.is_nan() => 0,
        CellValue::Text(_) => 1,
        _ => 2,
    };
    match (a, b) {
        (CellValue::Number(a), CellValue::Number(b)) if !a.is_nan() && !b.is_nan() => turned(a.total_cmp(&b)),
        (CellValue::Text(a), CellValue::Text(b)) => turned(a.to_lowercase().cmp(&b.to_lowercase())),
        _ => rank(a).cmp(&rank(b)),
    }
}

/// Measurement whose methods are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shows {
    Scene(Subject),
    /// Those of the program, on a workload of the bench.
    Bench(Workload),
}

impl Default for Shows {
    fn default() -> Self {
        Self::Scene(Subject::default())
    }
}
