//! `light`: temperature, rendition indices and consistency of cameras for illuminants.

use std::ffi::OsString;
use std::fmt::Write as _;

use chromascope_core::light::{Cct, CctError};
use chromascope_core::query::{Consistency, Rendition};
use chromascope_core::rendition::{HueBin, RenditionError};
use chromascope_figure::number::significant;
use chromascope_figure::{Cell, Field, Table};
use clap::{ArgMatches, Args};
use serde_json::{Value, json};

use super::arguments::{Form, OutArguments, SourceArguments, form};
use super::error::Result;
use super::request::Request;
use crate::document::SetKind;
use crate::format::fixed;
use crate::results::Results;
use crate::scene::light::NoConsistency;
use crate::scene::{Scene, SceneError};
use crate::terminal::{say, shown};

const EXAMPLES: &str = "Examples:
  chromascope light FL2 LED-B3 D65
  chromascope light lamp.csv --camera \"Nikon D70\" --format csv --out lamp_indices.csv
  chromascope light blackbody:3200 --filter \"Cooling 131 mired\"
  chromascope light LED-B3 --ssi-reference blackbody:3200

CSV columns: light; cct_k, duv (CIE 1931 2\u{b0}, 380-780 nm); ra, r1 to r14 (CIE 13.3; none for lamps that are
mainly monochromatic, which it excludes); rf, rg (ANSI/IES TM-30, CIE 224); ssi, the spectral similarity of SMPTE ST 2122 to the
reference of the same temperature, unrounded; rf_h1, rcs_h1, fidelity and chroma shift of the first hue bin (reds); ssi_to, the similarity
to the light of --ssi-reference, and ssi_reference, its name; then, in a row for each camera: camera,
consistency_mean, consistency_p95, consistency_max, the \u{394}E*00 of the patches between this light and its reference illuminant
through the camera, balanced to each and corrected by the matrix of the reference; worst_patch; cautions, what
to know about the indices. Undefined values are empty; the
reason is reported on standard error.";

/// Lights: CCT and Duv, Ra, Rf and Rg, spectral similarity, and how consistent cameras are under them
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct LightArguments {
    /// Illuminants: names, files with one curve, `daylight:K` or `blackbody:K`
    #[arg(value_name = "NAME|FILE", required = true)]
    lights: Vec<OsString>,
    /// A filter in front of each light: a name of `chromascope list filters`, or a file with one transmittance; may be repeated
    #[arg(long, value_name = "NAME|FILE")]
    filter: Vec<OsString>,
    /// A light that the spectral similarity is taken to as well, such as `blackbody:3200` or D55: a name or a file with one curve
    #[arg(long, value_name = "NAME|FILE")]
    ssi_reference: Option<OsString>,
    #[command(flatten)]
    sources: SourceArguments,
    /// The patches that cameras are compared over: a chart, a material, or a file with reflectances [default: the preset's]
    #[arg(long, value_name = "NAME|FILE")]
    chart: Option<OsString>,
    /// Form of the output
    #[arg(long, value_parser = form(FORMS), default_value = "table")]
    format: Form,
    #[command(flatten)]
    out: OutArguments,
}

const FORMS: [&str; 3] = ["For people", "Comma-separated, 15 digits", "One object for each light"];

struct Answer {
    name: String,
    temperature: Result<Cct, CctError>,
    rendition: Rendition,
    /// Similarity to the light of the user's choice, by its name.
    similarity: Option<(String, Result<f64, RenditionError>)>,
    /// Conditions under which indices mean less than they seem.
    cautions: Vec<String>,
    cameras: Vec<(String, Result<Consistency, NoConsistency>)>,
    patches: Vec<String>,
}

impl Answer {
    fn consistency(&self, camera: usize) -> Option<&Consistency> {
        self.cameras.get(camera)?.1.as_ref().ok()
    }

    fn reds(&self) -> Option<&HueBin> {
        self.rendition.fidelity.as_ref().ok()?.bins.first()
    }
}

pub(super) fn run(arguments: &LightArguments, matches: &ArgMatches) -> Result<()> {
    let mut request = Request::of_sources(&arguments.sources, matches)?;
    request.set_chart(arguments.chart.as_deref())?;
    let results = Results::default();
    let similar_to = arguments.ssi_reference.as_deref().map(|given| request.light_named("--ssi-reference", given));
    let similar_to = similar_to.transpose()?;
    request.set_filters(&arguments.filter)?;
    let named = !arguments.sources.names_no_sensor();
    let cameras = request.sources.iter().filter(|(kind, _)| named && *kind == SetKind::Camera);
    let cameras: Vec<String> = cameras.map(|(_, name)| name.clone()).collect();
    let mut answers = Vec::new();
    for light in &arguments.lights {
        request.set_light(light)?;
        let scene = Scene { document: &request.document, catalog: &request.catalog, results: &results };
        answers.push(answer(&scene, &cameras, similar_to.as_deref())?);
    }
    arguments.out.check(&request)?;
    answers
        .iter()
        .flat_map(|answer| reasons(answer).into_iter().chain(cautions(answer)))
        .for_each(|reason| say(&format!("chromascope: {reason}\n")));
    let text = match arguments.format {
        Form::Table => text(&answers),
        Form::Csv => csv(&answers),
        Form::Json => format!("{:#}\n", Value::Array(answers.iter().map(object).collect())),
    };
    let people = arguments.format == Form::Table && arguments.out.path.is_none();
    arguments.out.put(&if people { shown(&text).into_owned() } else { text })
}

fn answer(scene: &Scene<'_>, cameras: &[String], similar_to: Option<&str>) -> Result<Answer> {
    let (patches, rendition) = (scene.patches()?, scene.rendition()?);
    let similarity = similar_to.map(|name| Ok::<_, SceneError>((name.to_owned(), scene.similarity_to(name)?)));
    Ok(Answer {
        name: scene.light_name(),
        temperature: scene.light_temperature()?,
        similarity: similarity.transpose()?,
        cautions: scene.rendition_cautions(&rendition)?,
        rendition: (*rendition).clone(),
        cameras: cameras.iter().map(|name| (name.clone(), scene.consistency(name))).collect(),
        patches: patches.patches().iter().map(|patch| patch.name.clone()).collect(),
    })
}

fn reasons(answer: &Answer) -> Vec<String> {
    let Rendition { rendering, fidelity, similarity, .. } = &answer.rendition;
    let mut reasons: Vec<String> = [
        answer.temperature.err().map(|error| format!("no CCT: {error}")),
        rendering.as_ref().err().map(|error| format!("no Ra: {error}")),
        fidelity.as_ref().err().map(|error| format!("no Rf, Rg: {error}")),
        similarity.as_ref().err().map(|error| format!("no SSI: {error}")),
        answer.similarity.as_ref().and_then(|(to, found)| Some(format!("no SSI to {to}: {}", found.err()?))),
    ]
    .into_iter()
    .flatten()
    .collect();
    let cameras = answer.cameras.iter();
    reasons.extend(cameras.filter_map(|(name, answer)| Some(format!("{name}: {}", answer.as_ref().err()?))));
    reasons.into_iter().map(|reason| format!("{}: {reason}", answer.name)).collect()
}

fn cautions(answer: &Answer) -> impl Iterator<Item = String> {
    answer.cautions.iter().map(|caution| format!("{}: {caution}", answer.name))
}

/// Columns of a light's numbers; `_h1` is the first hue bin (reds), `ssi_to` the similarity to the light of choice.
const COLUMNS: [Field<Answer>; 9] = [
    Field::new("cct_k", |answer| answer.temperature.ok().map(|cct| cct.temperature.get()).into()),
    Field::new("duv", |answer| answer.temperature.ok().map(|cct| cct.duv).into()),
    Field::new("ra", |answer| answer.rendition.rendering.as_ref().ok().map(|indices| indices.general).into()),
    Field::new("rf", |answer| answer.rendition.fidelity.as_ref().ok().map(|found| found.fidelity).into()),
    Field::new("rg", |answer| answer.rendition.fidelity.as_ref().ok().map(|found| found.gamut).into()),
    Field::new("ssi", |answer| answer.rendition.similarity.as_ref().ok().copied().into()),
    Field::new("rf_h1", |answer| answer.reds().map(|bin| bin.fidelity).into()),
    Field::new("rcs_h1", |answer| answer.reds().map(|bin| bin.chroma_shift).into()),
    Field::new("ssi_to", |answer| answer.similarity.as_ref().and_then(|(_, found)| found.ok()).into()),
];
/// Place of R1 to R14 among them.
const SPECIAL: usize = 3;

fn numbers<'a>(answers: &(impl IntoIterator<Item = &'a Answer> + Clone)) -> Table {
    let mut table = Table::of(&COLUMNS, answers.clone());
    for index in 0..14 {
        let special = |answer: &Answer| answer.rendition.rendering.as_ref().ok().map(|indices| indices.special[index]);
        let cells = answers.clone().into_iter().map(|answer| special(answer).into());
        table.insert(SPECIAL + index, format!("r{}", index + 1), cells);
    }
    table
}

fn csv(answers: &[Answer]) -> String {
    let cameras = |answer: &Answer| answer.cameras.len().max(1);
    let rows: Vec<(&Answer, usize)> =
        answers.iter().flat_map(|answer| (0..cameras(answer)).map(move |camera| (answer, camera))).collect();
    let mut table = numbers(&rows.iter().map(|(answer, _)| *answer));
    table.insert(0, "light", rows.iter().map(|(answer, _)| answer.name.as_str().into()));
    let mut push = |head: &str, cell: &dyn Fn(&Answer, usize) -> Cell| {
        let cells: Vec<Cell> = rows.iter().map(|(answer, camera)| cell(answer, *camera)).collect();
        table.insert(table.columns.len(), head, cells);
    };
    push("ssi_reference", &|answer, _| answer.similarity.as_ref().map_or("", |(name, _)| name).into());
    push("camera", &|answer, camera| answer.cameras.get(camera).map_or("", |(name, _)| name).into());
    push("consistency_mean", &|answer, camera| answer.consistency(camera).map(|c| c.mean).into());
    push("consistency_p95", &|answer, camera| answer.consistency(camera).map(|c| c.percentile_95).into());
    push("consistency_max", &|answer, camera| answer.consistency(camera).map(|c| c.max).into());
    push("worst_patch", &|answer, camera| answer.consistency(camera).map_or("", |c| &answer.patches[c.worst]).into());
    push("cautions", &|answer, _| {
        reasons(answer).into_iter().chain(cautions(answer)).collect::<Vec<_>>().join("; ").into()
    });
    table.csv(significant)
}

fn object(answer: &Answer) -> Value {
    let table = numbers(&[answer]);
    let indices: serde_json::Map<String, Value> =
        table.keys().zip(&table.rows[0]).map(|(head, cell)| (head.to_owned(), json!(cell.number()))).collect();
    let bins = answer.rendition.fidelity.as_ref().map_or_else(
        |_| Value::Null,
        |fidelity| {
            let bin = |bin: &HueBin| {
                json!({ "rf_h": bin.fidelity, "rcs_h": bin.chroma_shift, "rhs_h": bin.hue_shift,
                        "test": bin.test, "reference": bin.reference })
            };
            fidelity.bins.iter().map(bin).collect()
        },
    );
    let camera = |(name, answer_of): &(String, Result<Consistency, NoConsistency>)| match answer_of {
        Ok(c) => json!({ "camera": name, "mean": c.mean, "p95": c.percentile_95, "max": c.max,
                         "worst_patch": answer.patches[c.worst] }),
        Err(error) => json!({ "camera": name, "error": error.to_string() }),
    };
    let to = answer.similarity.as_ref().map(|(name, _)| name);
    json!({ "light": answer.name, "indices": indices, "ssi_reference": to, "cautions": answer.cautions, "hue_bins": bins,
            "consistency": answer.cameras.iter().map(camera).collect::<Vec<_>>(), "undefined": reasons(answer) })
}

/// Rows for people: a light's indices, then its cameras.
fn text(answers: &[Answer]) -> String {
    let mut text = String::new();
    for answer in answers {
        let table = numbers(&[answer]);
        let number = |key: &str| table.cell(0, table.place(key)?).number();
        let cell = |key: &str, decimals| number(key).map_or_else(|| "\u{2013}".to_owned(), |v| fixed(v, decimals));
        let [cct, ra, rf] = [("cct_k", 0), ("ra", 1), ("rf", 1)].map(|(key, decimals)| cell(key, decimals));
        let [duv, rg, ssi] = [("duv", 4), ("rg", 1), ("ssi", 0)].map(|(key, decimals)| cell(key, decimals));
        let _ = write!(text, "{}\n  CCT {cct} K   Duv {duv}   Ra {ra}   Rf {rf}   Rg {rg}   SSI {ssi}", answer.name);
        if let Some((name, _)) = &answer.similarity {
            let _ = write!(text, "   SSI[{name}] {}", cell("ssi_to", 0));
        }
        let rcs_h1 = number("rcs_h1").map_or_else(|| "\u{2013}".to_owned(), |shift| fixed(100.0 * shift, 0));
        let _ = write!(text, "\n  Rf,h1 {}   Rcs,h1 {rcs_h1} %\n ", cell("rf_h1", 1));
        for index in 1..=14 {
            let _ = write!(text, " R{index} {}", cell(&format!("r{index}"), 0));
        }
        text.push('\n');
        for caution in &answer.cautions {
            let _ = writeln!(text, "  Caution: {caution}");
        }
        for (camera, consistency) in &answer.cameras {
            let line = match consistency {
                Ok(c) => {
                    let [mean, p95, max] = [c.mean, c.percentile_95, c.max].map(|value| fixed(value, 2));
                    let worst = &answer.patches[c.worst];
                    format!("  {camera}: \u{394}E*00 to reference mean {mean}, 95 % {p95}, maximum {max} ({worst})\n")
                }
                Err(error) => format!("  {camera}: {error}\n"),
            };
            text.push_str(&line);
        }
    }
    text
}
