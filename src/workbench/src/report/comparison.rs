//! Report on a comparison of one's own: conditions, ranking, worst patches, figures and data on one page to send.

use std::fmt::Write as _;
use std::sync::Arc;

use chromascope_core::mesh::Mesh;
use chromascope_core::query::{CameraMetric, Shared};
use chromascope_figure::Table;

use super::figures::frame;
use super::html::{self, apart, escaped};
use crate::document::{Light, SetKind};
use crate::export::{FigureForm, Paper};
use crate::figures::kind::{FigureKind, Need};
use crate::figures::look::FigureLook;
use crate::figures::{FIGURES, metrics, swatches};
use crate::format::{capitalized, fixed};
use crate::scene::metrics::RankedCameras;
use crate::scene::uncertainty::{in_words, rank_cell};
use crate::scene::{ComparedSensor, Scene, SceneError};

/// Mesh of the session's pictures: the user's own, or why it is not there.
pub type OwnMesh = Result<Option<Shared<Mesh>>, String>;

/// Worst patches of a camera that are listed.
const WORST: usize = 5;

/// Kinds of figures of the report.
pub(super) fn kinds() -> Vec<&'static FigureKind> {
    FIGURES.iter().copied().filter(|kind| kind.is_reported).collect()
}

/// Sentences on data sets that the document names and that are not here or cannot be read.
pub(super) fn missing(scene: &Scene<'_>) -> Vec<String> {
    let sensors = scene.document.compared.iter().map(|of| scene.sensor(of.kind, &of.name).err());
    let conditions = [scene.light().err(), scene.patches().err(), scene.transform().err(), scene.white().err()];
    sensors.chain(conditions).flatten().map(|error| format!("Missing: {error}.")).collect()
}

/// A figure with its caption as a part of the page, or why it is not there.
pub(super) fn figure(place: usize, scene: &Scene<'_>, paper: &Paper, (mesh, pixels): (&OwnMesh, u32)) -> String {
    let Some(kind) = kinds().get(place).copied() else { return String::new() };
    let made = look(kind, scene, mesh, pixels).and_then(|look| {
        let mut figure = kind.on_paper(paper, scene, &look).ok_or("there is nothing to draw")?;
        let caption = std::mem::take(&mut figure.caption);
        let svg = FigureForm::Svg.bytes(&figure, &figure.table, paper).map_err(|error| error.to_string())?;
        Ok((String::from_utf8_lossy(&svg).into_owned(), caption))
    });
    match made {
        Ok((svg, caption)) => format!(
            "<figure id=\"{}\">\n{}\n<figcaption><b>{}.</b> {}</figcaption>\n</figure>\n",
            kind.key,
            apart(&svg, kind.key).trim_end(),
            escaped(kind.help),
            escaped(&caption)
        ),
        Err(why) => format!("<p class=\"note\">{}: not drawn, because {}.</p>\n", escaped(kind.help), escaped(&why)),
    }
}

fn look(kind: &FigureKind, scene: &Scene<'_>, mesh: &OwnMesh, pixels: u32) -> Result<FigureLook, String> {
    let look = FigureLook { cameras: RankedCameras::Compared, ..FigureLook::default() };
    let Need::Pictures(mode) = kind.needs else { return Ok(look) };
    if scene.document.render.mesh.is_image() {
        return Err("spectral images are not part of a report".to_owned());
    }
    let frame = frame(scene, mesh.as_ref().map_err(Clone::clone)?.as_ref(), pixels)?;
    frame.pictures().map_err(|why| why.to_string())?;
    Ok(FigureLook { mode, pictures: Some(Arc::new(frame)), ..look })
}

/// The ranking of the cameras by all metrics, as a file.
pub(super) fn numbers(scene: &Scene<'_>) -> Table {
    let ranked = scene.ranked(RankedCameras::Compared);
    metrics::numbers(scene, &ranked).with_constants(scene.conditions())
}

/// The page; `figures` are its figures as HTML, `missing` what the session names and nobody has.
pub(super) fn page(scene: &Scene<'_>, missing: &[String], figures: &str) -> String {
    let cameras = scene.sources().iter().filter(|source| source.kind == SetKind::Camera).count();
    let noun = if cameras == 1 { "camera" } else { "cameras" };
    let title = format!("{cameras} {noun} under {}", scene.light_name());
    let mut out = html::head(&title);
    let _ = writeln!(out, "<h1>{}</h1>", escaped(&title));
    let worst = swatches::worst(scene).map_or_else(String::new, |(words, _)| format!("{words}. "));
    let version = env!("CARGO_PKG_VERSION");
    let _ = writeln!(out, "<p>{}Computed from spectra by Chromascope {version}.</p>", escaped(&worst));
    let cautions = scene.caution().map(|caution| caution.sentence()).into_iter();
    let cautions = cautions.chain(scene.light_caution().ok().flatten()).chain(missing.iter().cloned());
    for sentence in cautions {
        let _ = writeln!(out, "<p class=\"caution\">{}</p>", escaped(&capitalized(&sentence)));
    }
    conditions(&mut out, scene);
    ranking(&mut out, scene);
    worst_patches(&mut out, scene);
    let _ = write!(out, "<h2>Figures</h2>\n{figures}");
    data(&mut out, scene);
    out.push_str("</body>\n</html>\n");
    out
}

fn conditions(out: &mut String, scene: &Scene<'_>) {
    out.push_str("<h2>Conditions</h2>\n<table>\n");
    let all = scene.conditions().into_iter().chain(scene.metrics_constants(scene.document.temperature_k));
    for (column, value) in all.filter(|(column, _)| column != "preset") {
        let name = capitalized(&column.full_name().replace('_', " "));
        let name = if column == *"temperature_k" { "Locus metrics at (K)".to_owned() } else { name };
        *out += &html::row([name, value]);
    }
    out.push_str("</table>\n");
}

/// Cameras in order of the first metric, with the usual metrics that have a value.
fn ranking(out: &mut String, scene: &Scene<'_>) {
    let ranked = scene.ranked(RankedCameras::Compared);
    let Some(first) = metrics::first(scene).filter(|_| !ranked.cameras.is_empty()) else { return };
    let merit = |camera: usize| first.better.merit(metrics::value(&ranked, camera, first)?.value.ok()?);
    let mut rows: Vec<usize> = (0..ranked.cameras.len()).collect();
    rows.sort_by(|a, b| merit(*a).unwrap_or(f64::MAX).total_cmp(&merit(*b).unwrap_or(f64::MAX)));
    let all = metrics::table(&ranked);
    let usual = metrics::USUAL.split(' ').filter_map(CameraMetric::by_id);
    let usual = usual.filter(|metric| metric.id != first.id);
    let has_value = |column: &usize| rows.iter().any(|row| all.cell(*row, *column).number().is_some());
    let columns = std::iter::once(first).chain(usual).filter_map(|metric| all.place(metric.column)).filter(has_value);
    let mut table = all.part(&std::iter::once(0).chain(columns).collect::<Vec<_>>(), &rows);
    let ranks = metrics::ranks(&ranked, first);
    table.insert(0, "rank", rows.iter().map(|row| rank_cell(ranks[*row])));
    let known = metrics::uncertainties(&ranked, rows.iter().copied());
    let _ = writeln!(
        out,
        "<h2>Ranking</h2>\n{}<p class=\"note\">By {}. A rank is a range where values do not differ at 95 %. {}</p>",
        written(&table),
        escaped(first.label),
        escaped(&in_words(known))
    );
}

/// A table with its numbers as the window writes them.
fn written(table: &Table) -> String {
    let heads = table.columns.iter().map(|column| format!("<th>{}</th>", escaped(&capitalized(&column.full_name()))));
    let mut out = format!("<table class=\"numbers\">\n<tr>{}</tr>\n", heads.collect::<String>());
    for row in &table.rows {
        let cells =
            row.iter().map(|cell| format!("<td title=\"{}\">{}</td>", escaped(cell.hint()), escaped(&cell.in_words())));
        let _ = writeln!(out, "<tr>{}</tr>", cells.collect::<String>().replace(" title=\"\"", ""));
    }
    out + "</table>\n"
}

/// The patches that each sensor is off most, as pairs of colors with their differences.
fn worst_patches(out: &mut String, scene: &Scene<'_>) {
    let sources: Vec<ComparedSensor> = scene.sources().into_iter().filter(|source| !source.is_reference).collect();
    if sources.is_empty() || scene.patches().is_err() {
        return;
    }
    let measure = scene.difference_name();
    let _ = writeln!(
        out,
        "<h2>Worst patches</h2>\n<p class=\"note\">Left half: reference; right half: sensor; {measure}.</p>\n<table>"
    );
    for source in sources {
        let cells =
            worst_of(scene, &source).unwrap_or_else(|why| format!("<td colspan=\"{WORST}\">{}</td>", escaped(&why)));
        let _ = writeln!(out, "<tr><td>{}</td>{cells}</tr>", escaped(&source.name));
    }
    out.push_str("</table>\n");
}

fn worst_of(scene: &Scene<'_>, source: &ComparedSensor) -> Result<String, String> {
    let failed = |error: SceneError| error.to_string();
    let colors = |kind, name: &str| scene.patch_colors(kind, name).map_err(failed);
    let patches = scene.patches().map_err(failed)?;
    let (reference, own) = (colors(SetKind::Observer, &scene.document.reference)?, colors(source.kind, &source.name)?);
    let differences = scene.differences(source.kind, &source.name).map_err(failed)?;
    let mut found: Vec<(usize, f64)> =
        differences.iter().enumerate().filter_map(|(patch, difference)| Some((patch, difference.ok()?))).collect();
    if found.is_empty() {
        return Err(differences
            .iter()
            .find_map(|difference| difference.err())
            .map_or("–".to_owned(), |why| why.to_string()));
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    let cells = found.into_iter().take(WORST).map(|(patch, difference)| {
        let [left, right] = [&reference, &own].map(|colors| {
            let [r, g, b] = colors[patch].srgb.bytes;
            format!("rgb({r} {g} {b})")
        });
        let name = escaped(&patches.patches()[patch].name);
        let number = fixed(difference, scene.document.difference.decimals);
        format!(
            "<td><span class=\"swatch\" style=\"background:linear-gradient(90deg,{left} 50%,{right} 50%)\"></span>{name} {number}</td>"
        )
    });
    Ok(cells.collect())
}

/// Data sets of the comparison with their sources and terms.
fn data(out: &mut String, scene: &Scene<'_>) {
    out.push_str("<h2>Data</h2>\n<table>\n<tr><th>Data set</th><th>Source</th><th>Terms</th></tr>\n");
    let sensors = scene.sources().into_iter().map(|source| (source.kind, source.name));
    let light = match &scene.document.light {
        Light::Set(name) => Some((SetKind::Illuminant, name.clone())),
        _ => None,
    };
    let filters = scene.document.filters.iter().map(|name| (SetKind::Filter, name.clone()));
    let chart = (SetKind::Chart, scene.document.chart.clone());
    for (kind, name) in sensors.chain([chart]).chain(light).chain(filters) {
        let [source, license] = html::origin(scene, kind, &name);
        *out += &html::row([name, source, license]);
    }
    out.push_str("</table>\n");
}
