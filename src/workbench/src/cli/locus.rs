//! `locus`: Planckian loci as CSV.

use std::io::Write;

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::metrics::ReferenceLocusQuery;
use chromascope_core::query::{Ask as _, LocusPoint, Temperatures, compare};
use chromascope_core::units::Kelvin;
use chromascope_figure::number::significant;
use chromascope_figure::{Field, Table};
use clap::{ArgMatches, Args};

use super::arguments::CommonArguments;
use super::error::{CliError, Result};
use super::outputs::{self, Stop};
use super::request::Request;
use crate::document::{LOCUS_RANGE_K, SetKind};
use crate::results::Results;
use crate::scene::{LOCUS_POINTS, Scene};

const EXAMPLES: &str = "\
Examples:
  chromascope locus > loci.csv
  chromascope locus --preset paper --from 2000 --to 10000 --count 50
  chromascope locus --camera \"Nikon D70\" --camera mine.csv --reference \"CIE 1964 10°\" --illuminant A --white-balance D55

Columns: sensor, temperature_k, x, y, u_prime, v_prime; distance_xy and distance_uv_prime, the distances to the reference at the same
temperature, in x, y and in u\u{2032}, v\u{2032}; cct_error_k, the correlated color temperature by CIE 15 read on
the reference's own locus (nearest in CIE 1960 u, v, within 0.05) minus the true temperature, the metric of `compare`; arc_length_xy,
the length in x, y of the straight steps from row to row since the sensor's first (more rows, nearer to the locus's own length);
extrapolated, true below the temperature from which the end of the sensor's table matters (drawn dotted in figures); then the
conditions: reference, illuminant, white_balance, transform, preset.

Temperatures are in kelvins, from 1 to 1e15. Rows are ordered by sensor, as named, then by temperature. Undefined values
are empty.";

/// Planckian loci as CSV: chromaticity, distances to the reference, CCT error and arc length of blackbodies by temperature
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct LocusArguments {
    #[command(flatten)]
    common: CommonArguments,
    /// The first temperature in kelvins [default: 1000]
    #[arg(long, value_name = "K", conflicts_with = "temperatures")]
    from: Option<f64>,
    /// The last temperature in kelvins [default: 20000]
    #[arg(long, value_name = "K", conflicts_with = "temperatures")]
    to: Option<f64>,
    /// Number of temperatures, evenly in 1/T [default: 200]
    #[arg(long, value_name = "N", conflicts_with = "temperatures", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    count: Option<u32>,
    /// These temperatures in kelvins, in this order
    #[arg(long, value_name = "a,b,c", value_delimiter = ',')]
    temperatures: Vec<f64>,
}

/// Number of temperatures computed together; a table of millions of them is written as it is computed.
const PART: usize = 1024;

struct Row {
    sensor: String,
    point: LocusPoint,
    /// Distances to the reference.
    xy: Option<f64>,
    uv_prime: Option<f64>,
    cct_error: Option<f64>,
    arc_length: Option<f64>,
    extrapolated: bool,
}

const COLUMNS: [Field<Row>; 11] = [
    Field::new("sensor", |row| row.sensor.as_str().into()),
    Field::new("temperature_k", |row| row.point.temperature.get().to_string().into()),
    Field::new("x", |row| row.point.xy.map(|xy| xy.x).into()),
    Field::new("y", |row| row.point.xy.map(|xy| xy.y).into()),
    Field::new("u_prime", |row| row.point.uv.map(|uv| uv.u).into()),
    Field::new("v_prime", |row| row.point.uv.map(|uv| uv.v).into()),
    Field::new("distance_xy", |row| row.xy.into()),
    Field::new("distance_uv_prime", |row| row.uv_prime.into()),
    Field::new("cct_error_k", |row| row.cct_error.into()),
    Field::new("arc_length_xy", |row| row.arc_length.into()),
    Field::new("extrapolated", |row| row.extrapolated.to_string().into()),
];

fn table(scene: &Scene<'_>, rows: Vec<Row>) -> Table {
    Table::of(&COLUMNS, rows).with_constants(scene.conditions())
}

pub(super) fn run(arguments: &LocusArguments, matches: &ArgMatches) -> Result<()> {
    let temperatures = temperatures(arguments)?;
    let request = Request::new(&arguments.common, matches)?;
    arguments.common.out.check(&request)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    // Values that cannot be computed are reported before anything is written.
    for (kind, name) in &request.sources {
        scene.locus_at(*kind, name, Temperatures::List(temperatures.part(0..1)))?;
        let _comparable = scene.comparable(*kind, name)?;
    }
    outputs::stream(arguments.common.out.path.as_deref(), |out| {
        out.write_all(table(&scene, Vec::new()).head(',').as_bytes())?;
        for (kind, name) in &request.sources {
            locus_rows(out, &scene, (*kind, name), &temperatures)?;
        }
        Ok(())
    })?;
    Ok(request.say_caution(&scene)?)
}

fn locus_rows(
    out: &mut dyn Write,
    scene: &Scene<'_>,
    (kind, name): (SetKind, &str),
    temperatures: &Temperatures,
) -> Result<(), Stop> {
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
        let pairs = locus.points.iter().zip(&reference.points).map(|(point, reference)| {
            let step = before.and_then(|before| Some(before.xy?.distance(point.xy?)));
            length += step.unwrap_or(0.0);
            // A point without chromaticity is a gap that the length bridges.
            before = if point.xy.is_some() { Some(*point) } else { before };
            let distance = |metric| comparable.and_then(|()| compare::difference(metric, reference, point)).ok();
            let deviation = |uv| own.as_ref().as_ref().ok()?.deviation(point.temperature, uv)?.cct_error_k;
            Row {
                sensor: name.to_owned(),
                point: *point,
                xy: distance(Metric::XY),
                uv_prime: distance(Metric::UV_PRIME),
                cct_error: point.uv.filter(|_| comparable.is_ok()).and_then(deviation),
                arc_length: point.xy.map(|_| length),
                extrapolated: below.is_some_and(|below| point.temperature.get() < below),
            }
        });
        out.write_all(table(scene, pairs.collect()).body(',', significant).as_bytes())?;
        // Answers that were already written are dropped.
        scene.results.end_frame();
    }
    Ok(())
}

fn temperatures(arguments: &LocusArguments) -> Result<Temperatures> {
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
