//! The tables that the commands print.

use std::io::Write;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::metrics::ReferenceLocusQuery;
use chromascope_core::query::{Ask as _, LocusPoint, PatchColor, Temperatures, compare};
use chromascope_core::spectral::Primaries;
use chromascope_core::units::Kelvin;
use clap::ArgMatches;
use spectral_file::cell;

use super::arguments::{CommonArguments, LocusArguments, PatchesArguments};
use super::error::CliError;
use super::outputs;
use super::outputs::Stop;
use super::radiance::Radiances;
use super::request::Request;
use crate::catalog::Catalog;
use crate::document::{FIVE, LOCUS_RANGE_K, SetKind, TransformChoice};
use crate::results::Results;
use crate::scene::conditions::CONDITIONS;
use crate::scene::{Caution, LOCUS_POINTS, Scene, SceneError};
use crate::terminal::say;

const LOCUS_HEAD: &str =
    "sensor,temperature_k,x,y,u_prime,v_prime,distance_xy,distance_uv_prime,cct_error_k,arc_length_xy,extrapolated";
const PATCHES_HEAD: &str = "sensor,patch,r,g,b,x_tristimulus,y_tristimulus,z_tristimulus,x,y,u_prime,v_prime,\
                            lab_l,lab_a,lab_b,cct_k,duv";

/// Number of temperatures computed together; a table of millions of them is written as it is computed.
const PART: usize = 1024;

/// Writes loci, one row for each sensor and temperature.
pub(super) fn locus(arguments: &LocusArguments, matches: &ArgMatches) -> Result<(), CliError> {
    let temperatures = temperatures(arguments)?;
    let request = Request::new(&arguments.common, matches)?;
    check_out(&arguments.common, &request)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    // Values that cannot be computed are reported before anything is written.
    for (kind, name) in &request.sources {
        scene.locus_at(*kind, name, Temperatures::List(temperatures.part(0..1)))?;
        let _comparable = scene.comparable(*kind, name)?;
    }
    outputs::stream(arguments.common.out.as_deref(), |out| {
        out.write_all(head(LOCUS_HEAD).as_bytes())?;
        for (kind, name) in &request.sources {
            locus_rows(out, &scene, (*kind, name), &temperatures)?;
        }
        Ok(())
    })?;
    Ok(say_caution(&scene, &request)?)
}

/// Writes the locus of a sensor.
fn locus_rows(
    out: &mut dyn Write,
    scene: &Scene<'_>,
    (kind, name): (SetKind, &str),
    temperatures: &Temperatures,
) -> Result<(), Stop> {
    let conditions = conditions(scene, &scene.light_name());
    let reference = ReferenceLocusQuery(scene.rendering_of(SetKind::Observer, &scene.document.reference)?);
    let own = scene.results.ask(&reference);
    let below = scene.extrapolated_below(kind, name).map(|(kelvin, _)| kelvin);
    let comparable = scene.comparable(kind, name)?;
    let mut before: Option<LocusPoint> = None;
    let mut length = 0.0;
    for start in (0..temperatures.count()).step_by(PART) {
        let part = Temperatures::List(temperatures.part(start..temperatures.count().min(start + PART)));
        let reference = scene.locus_at(SetKind::Observer, &scene.document.reference, part.clone())?;
        let locus = scene.locus_at(kind, name, part)?;
        for (point, reference) in locus.points.iter().zip(&reference.points) {
            let step = before.and_then(|before| Some(before.xy?.distance(point.xy?)));
            length += step.unwrap_or(0.0);
            // A point without chromaticity is a gap that the length bridges.
            before = if point.xy.is_some() { Some(*point) } else { before };
            let places = [point.xy.map(|p| p.x), point.xy.map(|p| p.y), point.uv.map(|p| p.u), point.uv.map(|p| p.v)];
            let distance = |metric| comparable.and_then(|()| compare::difference(metric, reference, point)).ok();
            let rest = [
                distance(Metric::XY),
                distance(Metric::UV_PRIME),
                comparable
                    .ok()
                    .and_then(|()| own.as_ref().as_ref().ok()?.deviation(point.temperature, point.uv?)?.cct_error_k),
                point.xy.map(|_| length),
            ];
            let row = [places, rest].concat();
            let kelvin = point.temperature.get();
            let is_beyond = if below.is_some_and(|below| kelvin < below) { ",true" } else { ",false" };
            let row = row_of(&[&field(name), &kelvin.to_string()], &row, &format!("{is_beyond}{conditions}"));
            out.write_all(row.as_bytes())?;
        }
        // Answers that were already written are dropped.
        scene.results.end_frame();
    }
    Ok(())
}

/// Refuses an output before anything is computed.
pub(super) fn check_out(arguments: &CommonArguments, request: &Request) -> Result<(), CliError> {
    outputs::check(arguments.out.as_deref(), &request.inputs(), arguments.force)
}

/// The last cells of each row: under what the table was made.
fn conditions(scene: &Scene<'_>, illuminant: &str) -> String {
    scene.conditions_under(illuminant).map(|cell| format!(",{}", field(&cell))).concat() + "\n"
}

/// The head of a table.
fn head(columns: &str) -> String {
    format!("{columns},{}\n", CONDITIONS.join(","))
}

/// Reports once the reason that differences from the reference are empty or not those of the color transform alone.
pub(super) fn say_caution(scene: &Scene<'_>, request: &Request) -> Result<(), SceneError> {
    say_light(scene)?;
    let Some(caution) = scene.caution() else { return Ok(()) };
    let remedy = match caution {
        Caution::FitDiffers { .. } => "",
        Caution::NotComparable { .. } => {
            let comparable = request.sources.iter().map(|(kind, name)| scene.comparable(*kind, name));
            if comparable.collect::<Result<Vec<_>, _>>()?.iter().all(Result::is_ok) {
                return Ok(());
            }
            " Their differences are left empty; add --transform fitted."
        }
    };
    say(&format!("chromascope: {}{remedy}\n", caution.sentence()));
    Ok(())
}

/// Reports that a light shows next to no colors.
pub(super) fn say_light(scene: &Scene<'_>) -> Result<(), SceneError> {
    if let Some(caution) = scene.light_caution()? {
        say(&format!("chromascope: {caution}\n"));
    }
    Ok(())
}

fn temperatures(arguments: &LocusArguments) -> Result<Temperatures, CliError> {
    let kelvin = |argument: &'static str, value: f64| {
        let reason = || format!("{value} is not a temperature; use kelvins from 1 to 1e15");
        let usable = Kelvin::new(value).ok().filter(|kelvin| (1.0..=1e15).contains(&kelvin.get()));
        usable.ok_or_else(|| CliError::Argument { argument, reason: reason() })
    };
    if !arguments.temperatures.is_empty() {
        let list = arguments.temperatures.iter().map(|value| kelvin("--temperatures", *value));
        return Ok(Temperatures::List(list.collect::<Result<_, _>>()?));
    }
    let [from, to] = LOCUS_RANGE_K;
    Ok(Temperatures::Range {
        from: kelvin("--from", arguments.from.unwrap_or(from))?,
        to: kelvin("--to", arguments.to.unwrap_or(to))?,
        count: arguments.count.map_or(LOCUS_POINTS, |count| count as usize),
    })
}

/// Writes patches or radiances, one row for each sensor and spectrum.
pub(super) fn patches(arguments: &PatchesArguments, matches: &ArgMatches) -> Result<String, CliError> {
    let mut request = Request::new(&arguments.common, matches)?;
    request.values = arguments.values;
    request.set_chart(arguments.chart.as_deref())?;
    let radiances = match &arguments.radiance {
        Some(file) => Some(Radiances::open(&mut request, file, arguments.radiance_white.as_deref())?),
        None => None,
    };
    check_out(&arguments.common, &request)?;
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
    let conditions = conditions(&scene, &illuminant);
    let reference = colors(SetKind::Observer, &request.document.reference)?;
    let metrics: String = Metric::ALL.iter().flat_map(|metric| [",", metric.column]).collect();
    let mut text = head(&format!("{PATCHES_HEAD}{metrics}"));
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
            let cct = cct.ok().filter(|_| !by_eq_13);
            let mut row = color_cells(&color, by_eq_13);
            row.extend([cct.map(|cct| cct.temperature.get()), cct.map(|cct| cct.duv)]);
            row.extend(Metric::ALL.iter().map(|&metric| {
                let defined = comparable.is_ok() && !(by_eq_13 && metric.needs_adopted_white());
                compare::difference(metric, reference, &color).ok().filter(|_| defined)
            }));
            text += &row_of(&[&field(name), &field(patch)], &row, &conditions);
        }
    }
    say_caution(&scene, &request)?;
    if is_any_by_eq_13 {
        say(
            "chromascope: Eq 13 takes RGB as sRGB: L*a*b*, CCT and \u{394}E* are left empty; add --transform fitted.\n",
        );
    }
    Ok(text)
}

/// RGB, XYZ, xy, u′v′ and L*a*b*; without the last for colors of Eq 13, which are no CIE XYZ.
fn color_cells(color: &PatchColor, by_eq_13: bool) -> Vec<Option<f64>> {
    let rgb = color.rgb.map_or([None; 3], |rgb| rgb.map(Some));
    let xyz = [color.xyz.x, color.xyz.y, color.xyz.z].map(Some);
    let xy = [color.xy.map(|p| p.x), color.xy.map(|p| p.y)];
    let uv = [color.uv.map(|p| p.u), color.uv.map(|p| p.v)];
    let lab = color.lab.filter(|_| !by_eq_13).map_or([None; 3], |lab| [lab.l, lab.a, lab.b].map(Some));
    [&rgb[..], &xyz, &xy, &uv, &lab].concat()
}

/// Names of a catalog's sets of a kind, one a line; of all kinds for none.
pub fn list(catalog: &Catalog, kind: Option<SetKind>) -> String {
    let names = |kind: SetKind| {
        let five = (kind == SetKind::Chart).then_some(FIVE);
        let names = catalog.of_kind(kind).map(|entry| entry.name.as_str()).chain(five);
        names.flat_map(|name| [name, "\n"]).collect::<String>()
    };
    kind.map_or_else(|| SetKind::ALL.map(names).concat(), names)
}

fn row_of(heads: &[&str], numbers: &[Option<f64>], conditions: &str) -> String {
    let mut text = heads.join(",");
    for value in numbers {
        text.push(',');
        if let Some(value) = value {
            text += &significant(*value);
        }
    }
    text + conditions
}

/// Fifteen significant digits, without an exponent where that stays short.
pub(super) fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if (-6..15).contains(&exponent) {
        let decimals = usize::try_from(14 - exponent).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        format!("{value:.14e}")
    }
}

/// A text field, quoted where it must be, that no spreadsheet takes for a formula.
pub(super) fn field(text: &str) -> String {
    cell(text, ',')
}
