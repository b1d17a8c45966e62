//! `patches`: colors of a chart or of measured radiances as CSV.

use std::path::{Path, PathBuf};

use chromascope_core::colorimetry::{Lab, Metric};
use chromascope_core::light::Cct;
use chromascope_core::query::{PatchColor, RadianceColorsQuery, RenderingQuery, Shared, compare};
use chromascope_core::spectral::{GridSpectrum, Primaries};
use chromascope_figure::number::significant;
use chromascope_figure::{Field, Table};
use clap::{ArgMatches, Args};

use super::arguments::{ChartArguments, CommonArguments};
use super::error::Result;
use super::identify::file_spectra;
use super::request::Request;
use crate::catalog::names::{NameError, folded};
use crate::document::{SetKind, TransformChoice};
use crate::results::Results;
use crate::scene::{Scene, SceneError};
use crate::terminal::say;

const EXAMPLES: &str = "Examples:
  chromascope patches --preset paper
  chromascope patches --camera \"Canon EOS 10D\" --illuminant A --white-balance D55
  chromascope patches --camera mine.csv --per photon --chart leaves.csv --illuminant daylight:6504 --out leaves_seen.csv
  chromascope patches --radiance measured.csv --radiance-white \"white tile\"

Columns: sensor, patch; r, g, b after white balance (empty for CIE observers); x_tristimulus, y_tristimulus, z_tristimulus (Y = 1
for a perfect diffuser, under Eq 13 within 5e-5); x, y; u_prime, v_prime; lab_l, lab_a, lab_b, whose adopted white is a perfect diffuser;
cct_k, duv, the nearest blackbody for the CIE 1931 observer;
delta_…, the differences from the reference, a column for each metric; then the conditions: reference, illuminant,
white_balance, transform, preset. Undefined values are empty: with the paper's matrix, Eq 13 takes RGB as sRGB
whatever the sensor, so its colors have distances in the diagrams, but no L*a*b*, no color temperature and no \u{394}E*.

A file's reflectances are fractions or percent, its wavelengths nm or µm; guesses are reported on standard error. Numbers above one whose
scale the file does not state need --values percent or --values plain; a file of radiances is refused as a chart.";

/// Chart patches or measured radiances as CSV: RGB, XYZ, xy, u′v′, L*a*b* and differences from the reference
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct PatchesArguments {
    #[command(flatten)]
    common: CommonArguments,
    #[command(flatten)]
    chart: ChartArguments,
    /// A file with spectra of radiance, which are integrated as they are: no chart and no illuminant is named then. Without
    /// --radiance-white they are balanced to equal energy, X, Y, Z are relative, and there is no L*a*b*
    #[arg(long, value_name = "FILE", conflicts_with_all = ["chart", "illuminant"])]
    radiance: Option<PathBuf>,
    /// The radiance of a perfect diffuser among those of the file: it takes the white-balance target and Y = 1
    #[arg(long, value_name = "NAME", requires = "radiance")]
    radiance_white: Option<String>,
}

struct Row {
    sensor: String,
    patch: String,
    color: PatchColor,
    /// None for colors of Eq 13, which are no CIE XYZ; neither have they a CCT.
    lab: Option<Lab>,
    cct: Option<Cct>,
    /// Differences from the reference in the order of the metrics.
    differences: Vec<Option<f64>>,
}

const COLUMNS: [Field<Row>; 17] = [
    Field::new("sensor", |row| row.sensor.as_str().into()),
    Field::new("patch", |row| row.patch.as_str().into()),
    Field::new("r", |row| row.color.rgb.map(|rgb| rgb[0]).into()),
    Field::new("g", |row| row.color.rgb.map(|rgb| rgb[1]).into()),
    Field::new("b", |row| row.color.rgb.map(|rgb| rgb[2]).into()),
    Field::new("x_tristimulus", |row| row.color.xyz.x.into()),
    Field::new("y_tristimulus", |row| row.color.xyz.y.into()),
    Field::new("z_tristimulus", |row| row.color.xyz.z.into()),
    Field::new("x", |row| row.color.xy.map(|xy| xy.x).into()),
    Field::new("y", |row| row.color.xy.map(|xy| xy.y).into()),
    Field::new("u_prime", |row| row.color.uv.map(|uv| uv.u).into()),
    Field::new("v_prime", |row| row.color.uv.map(|uv| uv.v).into()),
    Field::new("lab_l", |row| row.lab.map(|lab| lab.l).into()),
    Field::new("lab_a", |row| row.lab.map(|lab| lab.a).into()),
    Field::new("lab_b", |row| row.lab.map(|lab| lab.b).into()),
    Field::new("cct_k", |row| row.cct.map(|cct| cct.temperature.get()).into()),
    Field::new("duv", |row| row.cct.map(|cct| cct.duv).into()),
];

pub(super) fn run(arguments: &PatchesArguments, matches: &ArgMatches) -> Result<()> {
    let mut request = Request::new(&arguments.common, matches)?;
    arguments.chart.set(&mut request)?;
    let radiances = match &arguments.radiance {
        Some(file) => Some(Radiances::open(&mut request, file, arguments.radiance_white.as_deref())?),
        None => None,
    };
    arguments.common.out.check(&request)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let (illuminant, names) = match &radiances {
        Some(radiances) => (radiances.illuminant(), radiances.names.clone()),
        None => (scene.light_name(), scene.patches()?.patches().iter().map(|patch| patch.name.clone()).collect()),
    };
    let colors = |kind: SetKind, name: &str| match &radiances {
        Some(radiances) => radiances.colors(&scene, kind, name),
        None => scene.patch_colors(kind, name),
    };
    let reference = colors(SetKind::Observer, &request.document.reference)?;
    let mut rows = Vec::new();
    let mut is_any_by_eq_13 = false;
    for (kind, name) in &request.sources {
        let comparable = scene.comparable(*kind, name)?;
        // Eq 13 takes RGB as sRGB whatever the sensor: its colors have no L*a*b* and no CCT, and distances between them are no ΔE*.
        let by_eq_13 = request.document.transform == TransformChoice::Paper
            && scene.sensor(*kind, name)?.primaries() != Primaries::Xyz;
        is_any_by_eq_13 |= by_eq_13;
        let colors = colors(*kind, name)?;
        let temperatures = scene.temperatures_of(&colors.iter().map(|color| Some(color.xyz)).collect::<Vec<_>>())?;
        for (((patch, color), reference), cct) in names.iter().zip(colors).zip(&reference).zip(temperatures) {
            let difference = |&metric: &Metric| {
                let defined = comparable.is_ok() && !(by_eq_13 && metric.needs_adopted_white());
                compare::difference(metric, reference, &color).ok().filter(|_| defined)
            };
            rows.push(Row {
                sensor: name.clone(),
                patch: patch.clone(),
                lab: color.lab.filter(|_| !by_eq_13),
                cct: cct.ok().filter(|_| !by_eq_13),
                differences: Metric::ALL.iter().map(difference).collect(),
                color,
            });
        }
    }
    let mut table = Table::of(&COLUMNS, &rows);
    for (place, metric) in Metric::ALL.iter().enumerate() {
        let cells = rows.iter().map(|row| row.differences[place].into());
        table.insert(table.columns.len(), metric.column, cells);
    }
    request.say_caution(&scene)?;
    if is_any_by_eq_13 {
        say(
            "chromascope: Eq 13 takes RGB as sRGB: L*a*b*, CCT and \u{394}E* are left empty; add --transform fitted.\n",
        );
    }
    arguments.common.out.put(&table.with_constants(scene.conditions_under(&illuminant)).csv(significant))
}

/// Radiances with their names, and which of them is that of a perfect diffuser.
struct Radiances {
    names: Vec<String>,
    spectra: Vec<Shared<GridSpectrum>>,
    white: Option<usize>,
}

impl Radiances {
    fn open(request: &mut Request, file: &Path, white: Option<&str>) -> Result<Self> {
        let curves = file_spectra(request, file, None, true)?.into_iter();
        let (names, spectra): (Vec<String>, _) = curves.map(|(name, curve)| (name, Shared::new(curve))).unzip();
        let white = white.map(|white| index_of(&names, white)).transpose()?;
        Ok(Self { names, spectra, white })
    }

    /// The conditions' name for what the radiances are balanced to.
    fn illuminant(&self) -> String {
        match self.white.and_then(|index| self.names.get(index)) {
            Some(name) => format!("radiance of {name}"),
            None => "radiance; white at equal energy".to_owned(),
        }
    }

    /// The colors through a sensor. Without a white among the radiances there is no L*a*b*.
    fn colors(&self, scene: &Scene<'_>, kind: SetKind, name: &str) -> Result<Vec<PatchColor>, SceneError> {
        let adopted = self.white.and_then(|index| self.spectra.get(index)).cloned();
        let light = adopted.clone().unwrap_or_else(|| Shared::new(GridSpectrum::constant(1.0)));
        let sensor = scene.sensor(kind, name)?;
        let rendering = RenderingQuery { sensor, light, white: scene.white()?, transform: scene.transform()? };
        let mut colors = scene.rendered(&RadianceColorsQuery { rendering, radiances: self.spectra.clone() }, name)?;
        if adopted.is_none() {
            for color in &mut colors {
                color.lab = None;
            }
        }
        Ok(colors)
    }
}

/// The index of the radiance of this name, case and punctuation aside.
fn index_of(names: &[String], typed: &str) -> Result<usize, NameError> {
    let wanted = folded(typed);
    let exact = names.iter().position(|name| name == typed);
    let unknown = || {
        let nearest = names.iter().take(5).cloned().collect();
        NameError::Unknown { kind: "radiance", name: typed.to_owned(), nearest }
    };
    exact.or_else(|| names.iter().position(|name| folded(name) == wanted)).ok_or_else(unknown)
}
