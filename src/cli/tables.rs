//! The tables that the commands print.

use std::fmt::Write as _;

use chromascope_core::query::Temperatures;
use chromascope_core::units::Kelvin;
use clap::ArgMatches;

use super::CliError;
use super::arguments::{ListKind, LocusArguments, PatchesArguments};
use super::request::{FIVE, Request};
use crate::catalog::{Catalog, Kind};
use crate::document::LOCUS_RANGE_K;
use crate::results::Results;
use crate::scene::{LOCUS_POINTS, Scene};

/// Loci, a row for each source and temperature.
pub(super) fn locus(arguments: &LocusArguments, matches: &ArgMatches) -> Result<String, CliError> {
    let temperatures = temperatures(arguments)?;
    let request = Request::new(&arguments.common, matches)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let mut text = "source,temperature_k,x,y,u_prime,v_prime\n".to_owned();
    for (kind, name) in &request.sources {
        let locus = scene.locus_at(*kind, name, temperatures.clone())?;
        for point in &locus.points {
            let row = [point.xy.map(|p| p.x), point.xy.map(|p| p.y), point.uv.map(|p| p.u), point.uv.map(|p| p.v)];
            add_row(&mut text, &[field(name), point.temperature.get().to_string()], &row);
        }
    }
    Ok(text)
}

fn temperatures(arguments: &LocusArguments) -> Result<Temperatures, CliError> {
    let kelvin = |argument: &'static str, value: f64| {
        let reason = || format!("{value} is no temperature; give kelvins from 1 to 1e15");
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

/// Patches, a row for each source and patch.
pub(super) fn patches(arguments: &PatchesArguments, matches: &ArgMatches) -> Result<String, CliError> {
    let mut request = Request::new(&arguments.common, matches)?;
    request.set_chart(arguments.chart.as_deref())?;
    request.set_white(&arguments.white)?;
    let results = Results::default();
    let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
    let patches = scene.patches()?;
    let mut text = "source,patch,r,g,b,x_tristimulus,y_tristimulus,z_tristimulus,x,y\n".to_owned();
    for (kind, name) in &request.sources {
        for (patch, color) in patches.patches().iter().zip(scene.patch_colors(*kind, name)?) {
            let rgb = color.rgb.map_or([None; 3], |rgb| rgb.map(Some));
            let xyz = [color.xyz.x, color.xyz.y, color.xyz.z].map(Some);
            let xy = [color.xy.map(|p| p.x), color.xy.map(|p| p.y)];
            let row: Vec<Option<f64>> = rgb.into_iter().chain(xyz).chain(xy).collect();
            add_row(&mut text, &[field(name), field(&patch.name)], &row);
        }
    }
    Ok(text)
}

/// The names of the built-in sets.
pub(super) fn list(kind: Option<ListKind>) -> String {
    let catalog = Catalog::built_in();
    let names = |kind: Kind| -> String {
        let mut names: Vec<&str> = catalog.of_kind(kind).map(|entry| entry.name.as_str()).collect();
        if kind == Kind::Chart {
            names.push(FIVE);
        }
        names.push("");
        names.join("\n")
    };
    match kind {
        Some(ListKind::Cameras) => names(Kind::Camera),
        Some(ListKind::Observers) => names(Kind::Observer),
        Some(ListKind::Charts) => names(Kind::Chart),
        Some(ListKind::Illuminants) => names(Kind::Illuminant),
        Some(ListKind::Materials) => names(Kind::Material),
        None => Kind::ALL.map(names).concat(),
    }
}

fn add_row(text: &mut String, heads: &[String], numbers: &[Option<f64>]) {
    text.push_str(&heads.join(","));
    for value in numbers {
        text.push(',');
        if let Some(value) = value {
            // Writing to a string cannot fail.
            let _infallible = write!(text, "{}", significant(*value));
        }
    }
    text.push('\n');
}

/// Fifteen significant digits, without an exponent where that stays short.
fn significant(value: f64) -> String {
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

/// A text field, quoted where it must be.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
