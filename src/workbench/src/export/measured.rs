//! A camera measured from a chart in tables and sentences, for the window and the command line, and as a set.

use chromascope_core::query::{ChartMeasurement, ErrorSummary};
use chromascope_core::recovery::{ChartRecovery, FitSource, Shot, ShotProfile};
use chromascope_figure::{Cell, Column, Table};

use crate::document::imported::{
    Covariance, ImportOverrides, ImportedCurve, ImportedSet, ReadAs, Role, Uncertainty, WavelengthUnit,
};
use crate::document::measurement::Measurement;
use crate::format::fixed;

/// How the curves were made.
pub const REDUCTION: &str = "joint Gaussian estimate with the library's tables as prior; good for color, a guess where the uncertainty is large";

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

/// Recorded values of a shot with residuals and brightnesses.
pub fn patches(shot: &Shot, recovery: &ChartRecovery, at: usize) -> Table {
    let heads = ["red", "green", "blue"].map(|name| column(name, 6, 4)).into_iter();
    let heads = heads.chain(["R %", "G %", "B %"].map(|name| column(name, 6, 2))).chain([column("brightness", 10, 3)]);
    let mut table = Table::new(heads);
    for (index, patch) in shot.patches.iter().enumerate() {
        let recorded = patch.rgb.map(|signal| Cell::from(signal.value().ok()));
        let residuals = recovery.residuals.get(at).and_then(|of| of.get(index)).copied().unwrap_or_default();
        let bright = recovery.brightness.get(at).and_then(|of| of.get(index)).copied();
        table.push(recorded.into_iter().chain(percents(residuals)).chain([Cell::from(bright)]));
    }
    table.insert(0, column("patch", 5, 0), shot.patches.iter().map(|patch| patch.name.as_str().into()));
    table
}

/// Noise, glare, brightness, unlikeness and daylight in sentences.
pub fn conditions(measured: &ChartMeasurement) -> Vec<String> {
    let recovery = &measured.recovery;
    let glare = recovery.glare.map(|glare| fixed(100.0 * glare, 2)).join(", ");
    let unlikeness = fixed(recovery.unlikeness, 2);
    let mut lines = vec![format!(
        "Residuals are {} times the noise; glare {glare} % of the brightest patch; brightness varies by {} %",
        fixed(recovery.noise_ratio, 2),
        fixed(100.0 * recovery.unevenness, 1)
    )];
    lines.push(if recovery.unlikeness > 1.0 {
        format!(
            "This camera is unlike those of the library (distance {unlikeness}, where 1 is expected at most): its bands are widened by that factor, and may still be too narrow"
        )
    } else {
        format!("The camera is like those of the library: distance {unlikeness}, where 1 is expected at most")
    });
    lines.extend(measured.daylight.map(|[kelvin, deviation]| {
        format!("Daylight of {} K ± {} K (k = 2)", fixed(kelvin, 0), fixed(2.0 * deviation, 0))
    }));
    lines
}

/// ΔE\*00 of patches that were predicted from all others, in a sentence.
pub fn left_out(measured: &ChartMeasurement) -> Option<String> {
    let errors: Vec<Option<f64>> = measured.left_out.iter().map(|(_, error)| *error).collect();
    let found = ErrorSummary::new(&errors)?;
    let (mean, most, worst) = (fixed(found.mean, 2), fixed(found.max, 2), &measured.left_out[found.worst].0);
    Some(format!("Patches recovered without, recorded against predicted: ΔE*00 mean {mean}, largest {most} ({worst})"))
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

/// The measured camera as a set of the user's, with uncertainties, covariance and where it is from.
pub fn set(measurement: &Measurement, measured: &ChartMeasurement) -> ImportedSet {
    let curves = &measured.recovery.curves;
    let standard = curves.standard();
    let curve = |(c, name): (usize, &str)| ImportedCurve {
        name: name.to_owned(),
        wavelengths: curves.wavelengths_nm.clone(),
        values: curves.values[c].clone(),
        unit: None,
        uncertainty: Some(Uncertainty { standard: standard[c].clone(), coverage: 2.0 }),
        unknown: serde_json::Map::new(),
    };
    let files: Vec<&str> = measurement.shots.iter().map(|shot| shot.file.as_str()).collect();
    let lights: Vec<&str> = measured.profiles.iter().map(|(light, _)| light.as_str()).collect();
    let source = format!("{} under {}", files.join(", "), lights.join(", "));
    let size = 3 * curves.wavelengths_nm.len();
    ImportedSet {
        name: format!("{} (measured)", measurement.camera),
        file: files.join(", "),
        path: None,
        fingerprint: None,
        overrides: ImportOverrides::default(),
        role: Role::Camera,
        read_as: ReadAs { unit: WavelengthUnit::Nanometer, percent: false },
        unit: WavelengthUnit::Nanometer,
        percent: false,
        per_photon: false,
        channels: [0, 1, 2],
        curves: ["red", "green", "blue"].into_iter().enumerate().map(curve).collect(),
        covariance: Some(Covariance { size, values: curves.covariance.clone() }),
        decisions: vec![format!("Recovered from the patches of {source}"), format!("Method: {REDUCTION}")],
    }
}
