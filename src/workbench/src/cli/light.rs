//! `light`: temperature, rendition indices and consistency of cameras for illuminants.

pub(super) mod arguments;

use chromascope_core::light::{Cct, CctError};
use chromascope_core::query::{Consistency, Rendition};
use chromascope_core::rendition::RenditionError;
use clap::ArgMatches;
use serde_json::{Value, json};
use std::fmt::Write as _;

use arguments::{LightArguments, TableFormat};

use super::error::CliError;
use super::outputs;
use super::request::Request;
use super::tables::{field, significant};
use crate::document::SetKind;
use crate::format::fixed;
use crate::results::Results;
use crate::scene::light::NoConsistency;
use crate::scene::{Scene, SceneError};
use crate::terminal::{say, shown};

/// One light with all its answers.
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

/// Results for each light in the given order.
pub(super) fn run(arguments: &LightArguments, matches: &ArgMatches) -> Result<(), CliError> {
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
    outputs::check(arguments.out.as_deref(), &request.inputs(), arguments.force)?;
    answers
        .iter()
        .flat_map(|answer| reasons(answer).into_iter().chain(cautions(answer)))
        .for_each(|reason| say(&format!("chromascope: {reason}\n")));
    let text = match arguments.format {
        TableFormat::Table => table(&answers),
        TableFormat::Csv => csv(&answers),
        TableFormat::Json => format!("{:#}\n", Value::Array(answers.iter().map(object).collect())),
    };
    let people = arguments.format == TableFormat::Table && arguments.out.is_none();
    outputs::put(&if people { shown(&text).into_owned() } else { text }, arguments.out.as_deref())
}

fn answer(scene: &Scene<'_>, cameras: &[String], similar_to: Option<&str>) -> Result<Answer, CliError> {
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

/// Reasons for missing values of a light, each listed once.
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

/// Cautions with the light's name.
fn cautions(answer: &Answer) -> impl Iterator<Item = String> {
    answer.cautions.iter().map(|caution| format!("{}: {caution}", answer.name))
}

/// CCT, Duv, Ra, R1 to R14, Rf, Rg, SSI, Rf and Rcs of the first hue bin (reds), SSI to the light of choice.
fn numbers(answer: &Answer) -> Vec<Option<f64>> {
    let Rendition { rendering, fidelity, similarity, .. } = &answer.rendition;
    let temperature = answer.temperature.ok();
    let rendering = rendering.as_ref().ok();
    let fidelity = fidelity.as_ref().ok();
    let mut numbers = vec![temperature.map(|cct| cct.temperature.get()), temperature.map(|cct| cct.duv)];
    numbers.push(rendering.map(|indices| indices.general));
    numbers.extend((0..14).map(|index| rendering.map(|indices| indices.special[index])));
    numbers.extend([fidelity.map(|f| f.fidelity), fidelity.map(|f| f.gamut), similarity.as_ref().ok().copied()]);
    let reds = fidelity.and_then(|fidelity| fidelity.bins.first());
    numbers.extend([reds.map(|bin| bin.fidelity), reds.map(|bin| bin.chroma_shift)]);
    numbers.push(answer.similarity.as_ref().and_then(|(_, found)| found.ok()));
    numbers
}

fn heads() -> Vec<String> {
    let special = (1..=14).map(|index| format!("r{index}"));
    let first = ["cct_k", "duv", "ra"].map(str::to_owned);
    let last = ["rf", "rg", "ssi", "rf_h1", "rcs_h1", "ssi_to"].map(str::to_owned);
    first.into_iter().chain(special).chain(last).collect()
}

fn csv(answers: &[Answer]) -> String {
    let rest = "camera,consistency_mean,consistency_p95,consistency_max,worst_patch";
    let mut text = format!("light,{},ssi_reference,{rest},cautions\n", heads().join(","));
    for answer in answers {
        let cells = numbers(answer).into_iter().map(|value| value.map_or_else(String::new, significant));
        let to = answer.similarity.as_ref().map_or("", |(name, _)| name);
        let cautions = field(&reasons(answer).into_iter().chain(cautions(answer)).collect::<Vec<_>>().join("; "));
        let start = std::iter::once(field(&answer.name)).chain(cells).chain([field(to)]).collect::<Vec<_>>().join(",");
        if answer.cameras.is_empty() {
            let _ = writeln!(text, "{start},,,,,,{cautions}");
        }
        for (camera, consistency) in &answer.cameras {
            let values = consistency.as_ref().map_or_else(
                |_| ",,,".to_owned(),
                |c| {
                    let [mean, p95, max] = [c.mean, c.percentile_95, c.max].map(significant);
                    format!("{mean},{p95},{max},{}", field(&answer.patches[c.worst]))
                },
            );
            let _ = writeln!(text, "{start},{},{values},{cautions}", field(camera));
        }
    }
    text
}

fn object(answer: &Answer) -> Value {
    let indices: serde_json::Map<String, Value> =
        heads().into_iter().zip(numbers(answer)).map(|(head, value)| (head, json!(value))).collect();
    let bins = answer.rendition.fidelity.as_ref().map_or_else(
        |_| Value::Null,
        |fidelity| {
            let bin = |bin: &chromascope_core::rendition::HueBin| {
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
fn table(answers: &[Answer]) -> String {
    let cell = |value: Option<f64>, decimals| value.map_or_else(|| "\u{2013}".to_owned(), |v| fixed(v, decimals));
    let mut text = String::new();
    for answer in answers {
        let numbers = numbers(answer);
        let [cct, duv, ra] = [(0, 0), (1, 4), (2, 1)].map(|(place, decimals)| cell(numbers[place], decimals));
        let [rf, rg, ssi] = [(17, 1), (18, 1), (19, 0)].map(|(place, decimals)| cell(numbers[place], decimals));
        let _ = write!(text, "{}\n  CCT {cct} K   Duv {duv}   Ra {ra}   Rf {rf}   Rg {rg}   SSI {ssi}", answer.name);
        let [rf_h1, to] = [(20, 1), (22, 0)].map(|(place, decimals)| cell(numbers[place], decimals));
        if let Some((name, _)) = &answer.similarity {
            let _ = write!(text, "   SSI[{name}] {to}");
        }
        let rcs_h1 = cell(numbers[21].map(|shift| 100.0 * shift), 0);
        let _ = write!(text, "\n  Rf,h1 {rf_h1}   Rcs,h1 {rcs_h1} %\n ");
        for (index, value) in numbers[3..17].iter().enumerate() {
            let _ = write!(text, " R{} {}", index + 1, cell(*value, 0));
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
