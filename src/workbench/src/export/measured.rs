//! A camera measured from a chart or from narrow bands in tables and sentences, for the window and the command line, and as a set.

use chromascope_core::glam::DVec3;
use chromascope_core::query::{ChartMeasurement, ErrorSummary};
use chromascope_core::recovery::{
    Cell as State, ChartRecovery, FitSource, NarrowBandRecovery, RecoveredCurves, Shot, ShotProfile,
};
use chromascope_figure::{Cell, Column, Table};

use crate::document::imported::{
    Covariance, ImportOverrides, ImportedCurve, ImportedSet, ReadAs, Role, Uncertainty, WavelengthUnit,
};
use crate::document::measurement::Measurement;
use crate::export::profile::shot;
use crate::format::fixed;
use crate::scene::measurement::RELATIVE;
use crate::scene::recorded::CHANNELS;

/// How the curves were made of a chart.
pub const REDUCTION: &str = "joint Gaussian estimate with the library's tables as prior; good for color, a guess where the uncertainty is large";
/// How they were made of narrow bands.
pub const BAND_REDUCTION: &str = "mean quotient of the passes, smoothed by the discrepancy principle; cells that were saturated or dark are filled from the library's tables";

fn column(name: &str, width: usize, decimals: usize) -> Column {
    Column { width, decimals: Some(decimals), ..Column::from(name) }
}

fn percents(values: [Option<f64>; 3]) -> impl Iterator<Item = Cell> {
    values.into_iter().map(|value| value.map(|value| 100.0 * value).into())
}

/// Curves with expanded uncertainties, and the shares of the data.
pub fn curves(recovery: &ChartRecovery) -> Table {
    let heads = ["nm", "red", "±", "green", "±", "blue", "±", "data R %", "data G %", "data B %"];
    let decimals = |name: &str| if name == "nm" || name.starts_with("data") { 0 } else { 3 };
    let mut table = Table::new(heads.map(|name| column(name, 6, decimals(name))));
    let (own, standard) = (&recovery.curves, recovery.curves.standard());
    for (k, nm) in own.wavelengths_nm.iter().enumerate().filter(|(_, nm)| (400.0..=700.0).contains(*nm)) {
        let pair = |c: usize| [own.values[c][k], 2.0 * standard[c][k]];
        let shares = [0, 1, 2].map(|c: usize| 100.0 * own.data_share[c][k]);
        let cells = [*nm].into_iter().chain([0, 1, 2].into_iter().flat_map(pair)).chain(shares);
        table.push(cells.map(Cell::from));
    }
    table
}

/// Curves of narrow bands with expanded uncertainties, and the quotients, or why they are not used.
pub fn bands(found: &NarrowBandRecovery) -> Table {
    let heads = ["nm", "red", "±", "green", "±", "blue", "±"];
    let heads = heads.map(|name| column(name, 6, if name == "nm" { 0 } else { 4 }));
    let quotients = ["quotient R", "quotient G", "quotient B"].map(Column::from);
    let mut table = Table::new(heads.into_iter().chain(quotients));
    let (own, standard) = (&found.curves, found.curves.standard());
    let peak = found.quotient.iter().flatten().copied().fold(f64::MIN_POSITIVE, f64::max);
    for (k, nm) in own.wavelengths_nm.iter().enumerate() {
        let pair = |c: usize| [own.values[c][k], 2.0 * standard[c][k]];
        let quotient = |c: usize| match found.cells[c][k] {
            State::Saturated => "saturated".to_owned(),
            State::Dark => "dark".to_owned(),
            State::Good => {
                format!("{} ± {}", fixed(found.quotient[c][k] / peak, 4), fixed(2.0 * found.deviation[c][k] / peak, 4))
            }
        };
        let cells = [*nm].into_iter().chain([0, 1, 2].into_iter().flat_map(pair)).map(Cell::from);
        table.push(cells.chain([0, 1, 2].map(quotient).map(Cell::from)));
    }
    table
}

/// Cells that are skipped, scatter of the passes, linearity, shift and leaks, in sentences.
pub fn band_conditions(found: &NarrowBandRecovery) -> Vec<String> {
    let nm = &found.curves.wavelengths_nm;
    let mut lines = vec!["± is expanded (k = 2)".to_owned()];
    for (state, what) in [(State::Saturated, "Saturated"), (State::Dark, "Dark")] {
        let of_channel = |(cells, channel): (&Vec<State>, &str)| {
            let own = (0..nm.len()).filter(|k| cells[*k] == state).map(|k| fixed(nm[k], 0));
            let own: Vec<String> = own.collect();
            (!own.is_empty()).then(|| format!("{channel} at {} nm", own.join(", ")))
        };
        let all: Vec<String> = found.cells.iter().zip(CHANNELS).filter_map(of_channel).collect();
        if !all.is_empty() {
            lines.push(format!("{what}, skipped and filled from the library's tables: {}", all.join("; ")));
        }
    }
    lines.push(found.scatter.map_or_else(
        || "One pass: its scatter is not known, 2 % is assumed".to_owned(),
        |scatter| {
            let scatter = scatter.map(|s| fixed(100.0 * s, 1)).join(", ");
            format!("Passes scatter by {scatter} % (one pass, standard deviation of red, green, blue)")
        },
    ));
    let doubt =
        |[value, deviation]: [f64; 2]| if value.abs() > 3.0 * deviation { ": check it" } else { ", not significant" };
    let [slope, by] = found.nonlinearity;
    let (exponent, band) = (fixed(1.0 + slope, 3), fixed(2.0 * by, 3));
    lines.push(format!("Exponent of the response {exponent} ± {band}{}", doubt([slope, by])));
    lines.extend(found.shift_nm.as_ref().map(|(shift, table)| {
        let [nm, band] = [shift[0], 2.0 * shift[1]].map(|value| fixed(value, 1));
        format!("Wavelengths are shifted by {nm} ± {band} nm from {table}{}", doubt(*shift))
    }));
    lines.extend(found.leak.iter().zip(CHANNELS).filter_map(|(leak, channel)| {
        let share = fixed(100.0 * (*leak)?, 2);
        let check = if (*leak)? > 0.01 { ": light outside the band, or an infrared leak" } else { "" };
        Some(format!("{channel}: {share} % of the peak where no table of the library exceeds 1 %{check}"))
    }));
    lines
}

/// Recorded values of a shot with residuals and brightnesses.
pub fn patches(shot: &Shot, recovery: &ChartRecovery, at: usize) -> Table {
    let residuals = ["red, %", "green, %", "blue, %"].map(|name| column(name, 8, 2));
    let heads = ["red", "green", "blue"].map(|name| column(name, 6, 4)).into_iter().chain(residuals);
    let mut table = Table::new(heads.chain([column("brightness", 10, 3)]));
    for (index, patch) in shot.patches.iter().enumerate() {
        let recorded = patch.rgb.map(|signal| Cell::from(signal.value().ok()));
        let residuals = recovery.residuals.get(at).and_then(|of| of.get(index)).copied().unwrap_or_default();
        let bright = recovery.brightness.get(at).and_then(|of| of.get(index)).copied();
        table.push(recorded.into_iter().chain(percents(residuals)).chain([Cell::from(bright)]));
    }
    table.insert(0, column("patch", 5, 0), shot.patches.iter().map(|patch| patch.name.as_str().into()));
    table
}

/// Meaning of the columns of [`corrections`].
pub const COLUMNS: &str = "ΔE*00, mean and largest over the patches. Predicted: of the curves' values; measured: of the recorded values; \
    excluded: of each patch's recorded values through a fit to all others (leave-one-out).";
/// Meaning of ± and of ranks.
pub const UNCERTAINTY: &str = "± is expanded (k = 2): the value is within it in about 95 of 100 cases. In Rank the ± of a metric is that of these \
    curves, and a rank is a range where cameras do not differ at 95 %.";
/// Description of [`matrix`].
pub const MATRIX: &str = "from raw RGB balanced to white = 1 to XYZ, fitted to the recorded patches. ICC (adapted to D50) and CLF (to ACES) are made of it; in the DCP \
    it is the ForwardMatrix (adapted to D50), and with the balance the ColorMatrix";
/// Tables that are named as the nearest.
const NEAREST: usize = 5;
/// Distances above which a camera is very unlike the library's: from their mean in standard deviations, and from the nearest table.
const UNLIKE: [f64; 2] = [1.2, 0.2];
/// Temperature in kelvins below which there is no daylight; doubtful from one standard deviation above it.
const WARMEST: f64 = 4000.0;
/// Excess of a mean measured ΔE\*00 over the predicted one that is no noise, and relative to it.
const EXCESS: [f64; 2] = [0.5, 0.4];

/// Charts, noise, glare, brightness, unlikeness and daylight in sentences.
pub fn conditions(measured: &ChartMeasurement) -> Vec<String> {
    let recovery = &measured.recovery;
    let glare = recovery.glare.map(|glare| fixed(100.0 * glare, 2)).join(", ");
    let [ratio, unlikeness] = [recovery.noise_ratio, recovery.unlikeness].map(|value| fixed(value, 2));
    let squares: Vec<f64> = recovery.residuals.iter().flatten().flatten().flatten().map(|r| r * r).collect();
    let residual = fixed(100.0 * (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt(), 2);
    let uneven = fixed(100.0 * recovery.unevenness, 1);
    let widened = "; its bands are widened by that factor, and may still be too narrow";
    let [what, widened] = if recovery.unlikeness > 1.0 { ["unlike", widened] } else { ["like", ""] };
    let mut lines = vec![
        format!("Chart: {}", measured.charts.join(", ")),
        format!(
            "Residuals: {residual} % (root mean square). Noise by them: {ratio} times what was assumed, {} % of a value unless stated \
             and that of the pixels; above 2 times nothing is made of a recording",
            fixed(100.0 * RELATIVE, 1)
        ),
        format!("Glare {glare} % of the brightest patch (red, green, blue); brightness varies by {uneven} %"),
        format!(
            "The camera is {what} those of the library: distance {unlikeness}, where 1 is expected at most{widened}"
        ),
    ];
    let better = |chart| {
        format!("\"{chart}\" fits clearly better than the chart that was named: choose it if it is that edition")
    };
    lines.extend(measured.better_chart.as_ref().map(better));
    let near: Vec<String> = nearest(measured).take(NEAREST).collect();
    lines.push(format!("Nearest tables by the difference of the curves: {}", near.join(", ")));
    lines.extend(measured.daylight.map(|[kelvin, deviation]| {
        format!("Daylight of {} K ± {} K (k = 2)", fixed(kelvin, 0), fixed(2.0 * deviation, 0))
    }));
    let is_daylight =
        |light: &str| light.starts_with("daylight") || light.starts_with('D') && light[1..].parse::<f64>().is_ok();
    if let [(light, _)] = &measured.profiles[..]
        && measured.daylight.is_none()
        && is_daylight(light)
    {
        lines.push(format!(
            "{light} alone is hardly told from another daylight: name daylight of unknown temperature unless it was measured, or add a shot under a lamp"
        ));
    }
    lines
}

/// Signs that light or chart are not those named: where there are any, nothing is made of a measurement without consent.
///
/// Over the library, each camera's model left out, photographs simulated: with the right light (D65, A or FL11) 8 of 174 are warned of or
/// refused, all of three cameras unlike all others; with a wrong one of these 334 of 348 are. See `tests/app/measured_doubts.rs`.
pub fn doubts(measured: &ChartMeasurement) -> Vec<String> {
    let mut doubts = Vec::new();
    if let Some([kelvin, deviation]) = measured.daylight.filter(|[kelvin, deviation]| kelvin - deviation < WARMEST) {
        let [kelvin, by] = [kelvin, 2.0 * deviation].map(|value| fixed(value, 0));
        doubts.push(format!(
            "Daylight of {kelvin} K ± {by} K: this is likely no daylight, which is above {WARMEST} K; name the light"
        ));
    }
    let nearest = measured.nearest.first().map_or(0.0, |(_, distance)| *distance);
    if measured.recovery.unlikeness > UNLIKE[0] || nearest > UNLIKE[1] {
        doubts.push(format!(
            "Very unlike every camera of the library (the nearest table differs by {} %): the light or the chart is likely another than named",
            fixed(100.0 * nearest, 0)
        ));
    }
    for (light, profile) in &measured.profiles {
        let mean = |of: &[Option<f64>]| ErrorSummary::new(of).map_or(0.0, |found| found.mean);
        let fit = &profile.fits[0][0];
        let [predicted, measured] = [mean(&fit.predicted), mean(&fit.measured)];
        if measured - predicted > EXCESS[0].max(EXCESS[1] * predicted) {
            let [predicted, measured] = [predicted, measured].map(|mean| fixed(mean, 2));
            doubts.push(format!("Under {light} the measured ΔE*00 ({measured}) is far above the predicted one ({predicted}): light, chart or linearity is likely wrong"));
        }
    }
    doubts
}

/// The matrix of profile files under a light, in rows.
pub fn matrix(profile: &ShotProfile) -> Option<String> {
    let row = |row: DVec3| row.to_array().map(|value| format!("{:>8}", fixed(value, 4))).join(" ");
    shot::matrix(profile).map(|matrix| [0, 1, 2].map(|at| row(matrix.row(at))).join("\n"))
}

/// The result in a line: ΔE\*00 of the patches of the first picture, each predicted from all others; width of the bands; nearest table.
pub fn headline(measured: &ChartMeasurement, picture: &str) -> Option<String> {
    let errors: Vec<Option<f64>> = measured.left_out.iter().map(|(_, error)| *error).collect();
    let found = ErrorSummary::new(&errors)?;
    let (mean, most, worst) = (fixed(found.mean, 2), fixed(found.max, 2), &measured.left_out[found.worst].0);
    let (nm, standard) = (&measured.recovery.curves.wavelengths_nm, measured.recovery.curves.standard());
    let pairs = standard.iter().flat_map(|of| of.iter().zip(nm));
    let visible: Vec<f64> = pairs.filter(|(_, nm)| (400.0..=700.0).contains(*nm)).map(|(sd, _)| *sd).collect();
    let band = fixed(200.0 * visible.iter().sum::<f64>() / visible.len().max(1) as f64, 1);
    Some(format!(
        "Each patch of {picture} by the curves of all others: ΔE*00 {mean}, largest {most} ({worst}). Curves ±{band} % of the peak (2 sd). \
         Nearest: {}.",
        nearest(measured).next()?
    ))
}

/// Tables that are nearest to the curves, with the root mean square of the difference.
fn nearest(measured: &ChartMeasurement) -> impl Iterator<Item = String> {
    measured.nearest.iter().map(|(name, distance)| format!("{name} ({} %)", fixed(100.0 * distance, 1)))
}

/// ΔE\*00 of the corrections under a light: mean and largest.
pub fn corrections(profile: &ShotProfile) -> Table {
    let heads = ["predicted", "largest", "measured", "largest", "excluded", "largest"];
    let mut table = Table::new(heads.map(|head| column(head, 9, 2)));
    let mut names = Vec::new();
    for fit in profile.fits.iter().flatten() {
        let source = if fit.source == FitSource::Patches { "patches" } else { "curves" };
        names.push(Cell::from(format!("{source}: {}", fit.correction.method.label())));
        let pair =
            |of: &[Option<f64>]| ErrorSummary::new(of).map_or([None; 2], |found| [Some(found.mean), Some(found.max)]);
        let cells = [&fit.predicted, &fit.measured, &fit.left_out].map(|of| pair(of)).concat();
        table.push(cells.into_iter().map(Cell::from));
    }
    table.insert(0, column("fitted to", 6, 0), names);
    table
}

/// The camera measured from pictures as a set of the user's.
pub fn set_of_chart(measurement: &Measurement, measured: &ChartMeasurement) -> ImportedSet {
    let lights: Vec<&str> = measured.profiles.iter().map(|(light, _)| light.as_str()).collect();
    let under = format!(" under {}, chart {}", lights.join(", "), measured.charts.join(", "));
    set(measurement, &measured.recovery.curves, ["the patches of ", &under], REDUCTION)
}

/// The camera measured from narrow bands as a set of the user's.
pub fn set_of_bands(measurement: &Measurement, found: &NarrowBandRecovery) -> ImportedSet {
    let count = found.curves.wavelengths_nm.len();
    set(measurement, &found.curves, [&format!("{count} narrow bands in "), ""], BAND_REDUCTION)
}

/// A measured camera with uncertainties, covariance and where it is from.
fn set(measurement: &Measurement, curves: &RecoveredCurves, [from, under]: [&str; 2], reduction: &str) -> ImportedSet {
    let standard = curves.standard();
    let curve = |(c, name): (usize, &str)| ImportedCurve {
        name: name.to_owned(),
        wavelengths: curves.wavelengths_nm.clone(),
        values: curves.values[c].clone(),
        unit: None,
        uncertainty: Some(Uncertainty { standard: standard[c].clone(), coverage: 2.0 }),
        unknown: serde_json::Map::new(),
    };
    let files = measurement.shots.iter().map(|shot| shot.file.as_str());
    let files: Vec<&str> = files.chain(measurement.passes.iter().map(|pass| pass.file.as_str())).collect();
    let files = files.join(", ");
    let size = 3 * curves.wavelengths_nm.len();
    ImportedSet {
        name: format!("{} (measured)", measurement.camera),
        decisions: vec![format!("Recovered from {from}{files}{under}"), format!("Method: {reduction}")],
        file: files,
        path: None,
        fingerprint: None,
        measured: measurement.origin(),
        model: measurement.model().map(str::to_owned),
        overrides: ImportOverrides::default(),
        role: Role::Camera,
        read_as: ReadAs { unit: WavelengthUnit::Nanometer, percent: false },
        unit: WavelengthUnit::Nanometer,
        percent: false,
        per_photon: false,
        channels: [0, 1, 2],
        curves: ["red", "green", "blue"].into_iter().enumerate().map(curve).collect(),
        covariance: Some(Covariance { size, values: curves.covariance.clone() }),
    }
}
