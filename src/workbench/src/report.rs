//! Reports: on the paper, its figures made with public data and its claims with what is found; on a comparison of one's own.
//!
//! Steps are made one by one, each figure in every form, then the page with the claims. Nothing here touches the disk.

mod claim;
mod comparison;
mod figures;
mod geometry;
mod html;
mod loci;
mod model;
mod page;
mod patches;
mod pictures;

use std::path::PathBuf;
use std::sync::{Arc, LazyLock, OnceLock};

use chromascope_core::query::Ask as _;
use chromascope_figure::number::significant;
use chromascope_figure::{Field, Table};
use spectral_file::write::Metadata;

pub use claim::{Claim, FURTHER, Find, Finding, Subject, Value, Verdict};
pub use comparison::OwnMesh;
pub use figures::{FIGURES, PaperFigure};

use crate::atomic::write_below;
use crate::catalog::Catalog;
use crate::document::start::Start;
use crate::document::{Document, SetKind};
use crate::export::{FigureForm, Paper, package};
use crate::format::io_reason;
use crate::jobs::Job;
use crate::results::Results;
use crate::scene::Scene;

pub const PAGE: &str = "report.html";
pub const NUMBERS: &str = "claims.csv";
pub const RANKING: &str = "ranking.csv";
/// What is known about the table of claims.
const KNOWN: [(&str, &str); 3] = [
    ("title", "Claims of Huynh and Robles-Kelly 2007, with what is found"),
    ("license", "MIT OR Apache-2.0, as the program"),
    (
        "source",
        concat!(
            "computed by Chromascope ",
            env!("CARGO_PKG_VERSION"),
            " from its public data; claims are paraphrased but for words in quotation marks"
        ),
    ),
];
/// Side of a rendered picture in pixels unless the user says otherwise.
pub const PIXELS: u32 = 480;

const FORMS: [FigureForm; 4] = [FigureForm::Pdf, FigureForm::Svg, FigureForm::Png, FigureForm::Csv];

/// Judges of the claims by their names in `assets/report/claims.md`.
const FIND: [(&str, Find); 17] = [
    ("locus-length", loci::lengths),
    ("daylight-minimum", loci::minima),
    ("canon-and-nikon-nearer", loci::means),
    ("white-alike", patches::white),
    ("red-nearer-xy", patches::in_diagram),
    ("kodak-farthest", patches::farthest),
    ("kodak-head-brighter", pictures::brighter),
    ("kodak-head-saturated", pictures::saturated),
    ("kodak-fern-white", pictures::fern_white),
    ("fern-greener", pictures::greener),
    ("match-skin-differ-leaf", pictures::skin_and_leaf),
    ("balance", model::balance),
    ("falloff", model::falloff),
    ("daylight-is-the-cameras", loci::minima_under_a),
    ("red-nearer-delta-e", patches::by_eye),
    ("match-skin-differ-leaf-fitted", pictures::skin_and_leaf_fitted),
    ("white-stays-white", model::tint),
];

/// All claims, in the paper's order, then the checks beyond it.
pub fn claims() -> &'static [Claim] {
    static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| {
        let text: &'static str = include_str!("../../../assets/report/claims.md");
        let parts = text.split("\n## ").skip(1).filter_map(|part| part.split_once('\n'));
        let claims = parts.flat_map(|(part, claims)| claims.split("\n### ").skip(1).map(move |claim| (part, claim)));
        let claim = |(part, claim): (&'static str, &'static str)| {
            let mut paragraphs = claim.split("\n\n").map(str::trim);
            let [key, paper, why] = std::array::from_fn(|_| paragraphs.next().unwrap_or_default());
            let find = FIND.iter().find(|(known, _)| *known == key)?.1;
            Some(Claim { key, part, paper, why, find })
        };
        claims.filter_map(claim).collect()
    });
    &CLAIMS
}

pub struct Judged {
    pub claim: &'static Claim,
    /// Finding, or the reason that there is none.
    pub finding: Result<Finding, String>,
}

pub struct ReportFile {
    pub name: String,
    pub bytes: Vec<u8>,
}

/// A report: its subject, and the figures made so far, which stand in its page.
pub struct Report {
    document: Document,
    on: On,
    pixels: u32,
    paper: Paper,
    catalog: Catalog,
    figures: Vec<OnceLock<String>>,
}

enum On {
    Paper {
        has_own_light: bool,
    },
    /// The document as it is. Sentences on what it names and nobody has.
    Comparison {
        mesh: OwnMesh,
        missing: Vec<String>,
    },
    /// The built-in data sets.
    Library,
}

impl Report {
    /// Name of the work that makes it.
    pub const NAME: &'static str = "report";

    /// A report on a document of the start [`Start::Paper`]; with a light of its own, that takes the place of the paper's lights.
    pub fn new(document: Document, has_own_light: bool, pixels: u32) -> Self {
        Self::on(document, On::Paper { has_own_light }, FIGURES.len(), pixels)
    }

    fn on(document: Document, on: On, figures: usize, pixels: u32) -> Self {
        let paper = Paper { width_mm: Some(Paper::TWO_COLUMNS_MM), ..Paper::default() };
        let figures = (0..figures).map(|_| OnceLock::new()).collect();
        Self { document, on, pixels, paper, catalog: Catalog::built_in(), figures }
    }

    /// A report on what a document compares and shows, under its conditions; with its mesh, where that is a file.
    pub fn on_comparison(document: &Document, mesh: OwnMesh, pixels: u32) -> Self {
        let (mut document, catalog, results) = (document.clone(), Catalog::built_in(), Results::default());
        document.compared.retain(|compared| compared.visible);
        let scene = Scene { document: &document, catalog: &catalog, results: &results };
        let missing = comparison::missing(&scene);
        let there: Vec<bool> = document.compared.iter().map(|of| scene.sensor(of.kind, &of.name).is_ok()).collect();
        let mut there = there.into_iter();
        document.compared.retain(|_| there.next() == Some(true));
        Self::on(document, On::Comparison { mesh, missing }, comparison::kinds().len(), pixels)
    }

    /// The built-in data sets as files, with checksum, source and terms of each.
    pub fn of_library() -> Self {
        Self::on(Start::Paper.document(), On::Library, 0, PIXELS)
    }

    /// The file that shows or describes all others.
    pub fn page(&self) -> &'static str {
        if matches!(self.on, On::Library) { package::DESCRIPTOR } else { PAGE }
    }

    pub fn steps(&self) -> usize {
        self.figures.len() + 1
    }

    /// A report on the cameras and patches of another document, and on its imported sets.
    pub fn of_document(other: &Document) -> Self {
        let mut document = Document { compared: Vec::new(), own: other.own.clone(), ..Start::Paper.document() };
        document.compare(&document.reference.clone(), SetKind::Observer);
        for camera in other.compared.iter().filter(|compared| compared.kind == SetKind::Camera && compared.visible) {
            document.compare(&camera.name, SetKind::Camera);
        }
        (document.chart, document.subset) = (other.chart.clone(), other.subset);
        Self::new(document, false, PIXELS)
    }

    fn subject<'a>(&'a self, results: &'a Results) -> Subject<'a> {
        let Self { document, on, catalog, .. } = self;
        Subject { document, has_own_light: matches!(on, On::Paper { has_own_light: true }), catalog, results }
    }

    /// Name of a step, for progress.
    pub fn name(&self, step: usize) -> String {
        match self.on {
            On::Paper { .. } if step < FIGURES.len() => format!("Figure {}", FIGURES[step].number),
            On::Paper { .. } => "claims".to_owned(),
            On::Comparison { .. } => comparison::kinds().get(step).map_or("ranking", |kind| kind.key).to_owned(),
            On::Library => "data sets".to_owned(),
        }
    }

    pub fn names(&self) -> Vec<String> {
        if matches!(self.on, On::Comparison { .. }) {
            return vec![RANKING.to_owned(), PAGE.to_owned()];
        }
        let figures = FIGURES.iter().flat_map(|figure| FORMS.map(|form| file_name(figure, form)));
        figures.chain([NUMBERS, PAGE].map(str::to_owned)).chain([format!("{NUMBERS}{}", Metadata::ENDING)]).collect()
    }

    /// The files of a step; the error is a message.
    pub fn make(&self, step: usize, results: &Results) -> Result<Vec<ReportFile>, String> {
        let subject = self.subject(results);
        if let On::Comparison { mesh, missing } = &self.on {
            return Ok(self.of_comparison(step, &subject.scene(&self.document), mesh, missing));
        }
        if matches!(self.on, On::Library) {
            let files = package::package(&self.catalog, results).map_err(|error| error.to_string())?;
            return Ok(files.into_iter().map(|(name, bytes)| ReportFile { name, bytes }).collect());
        }
        let Some(figure) = FIGURES.get(step) else { return Ok(self.claims_and_page(&subject)) };
        let made = figure.laid_out(&subject, &self.paper, self.pixels).ok_or_else(|| {
            format!("Figure {} cannot be drawn: no camera can be compared, or it was stopped.", figure.number)
        })?;
        let file = |form: FigureForm| {
            let bytes = form.bytes(&made, &made.table, &self.paper).map_err(|error| error.to_string())?;
            if form == FigureForm::Svg {
                let _first = self.figures[step].set(String::from_utf8_lossy(&bytes).into_owned());
            }
            Ok(ReportFile { name: file_name(figure, form), bytes })
        };
        FORMS.into_iter().map(file).collect()
    }

    fn of_comparison(&self, step: usize, scene: &Scene<'_>, mesh: &OwnMesh, missing: &[String]) -> Vec<ReportFile> {
        if let Some(place) = self.figures.get(step) {
            let _made = place.set(comparison::figure(step, scene, &self.paper, (mesh, self.pixels)));
            return Vec::new();
        }
        let figures: String = self.figures.iter().filter_map(OnceLock::get).map(String::as_str).collect();
        let file = |name: &str, text: String| ReportFile { name: name.to_owned(), bytes: text.into_bytes() };
        let ranking = comparison::numbers(scene).csv(significant);
        vec![file(RANKING, ranking), file(PAGE, comparison::page(scene, missing, &figures))]
    }

    pub fn judged(&self, results: &Results) -> Vec<Judged> {
        let subject = self.subject(results);
        claims()
            .iter()
            .map(|claim| Judged { claim, finding: (claim.find)(&subject).map_err(|error| error.to_string()) })
            .collect()
    }

    fn claims_and_page(&self, subject: &Subject<'_>) -> Vec<ReportFile> {
        let judged = self.judged(subject.results);
        let drawn = |step: usize| self.figures[step].get().map(String::as_str);
        let page = page::page(subject, &judged, &drawn);
        let known = KNOWN.map(|(key, value)| (key.to_owned(), value.to_owned())).to_vec();
        let file = |name: &str, text: String| ReportFile { name: name.to_owned(), bytes: text.into_bytes() };
        vec![
            file(NUMBERS, numbers(&judged).to_csv()),
            file(&format!("{NUMBERS}{}", Metadata::ENDING), Metadata::from(known).text(NUMBERS)),
            file(PAGE, page),
        ]
    }
}

fn file_name(figure: &PaperFigure, form: FigureForm) -> String {
    format!("figure{}.{}", figure.number, form.key())
}

/// A number found for a claim.
type Found<'a> = (&'static Claim, Verdict, &'a Value);

fn step(value: &Value) -> f64 {
    10_f64.powi(i32::try_from(value.decimals).unwrap_or(0))
}

/// Findings as a table: a row for each number, rounded to the decimals that are stated, with half of the last one; that is the rounding, and
/// no accuracy of what the number is about.
pub fn numbers(judged: &[Judged]) -> Table {
    fn columns<'a>() -> [Field<Found<'a>>; 10] {
        [
            Field::new("claim", |(claim, ..)| claim.key.into()),
            Field::new("part", |(claim, ..)| claim.part.into()),
            Field::new("paper", |(claim, ..)| claim.paper.into()),
            Field::new("verdict", |(_, verdict, _)| verdict.key().into()),
            Field::new("condition", |(claim, verdict, _)| claim.condition(*verdict).into()),
            Field::new("quantity", |(.., value)| value.quantity.as_str().into()),
            Field::new("sensor", |(.., value)| value.sensor.as_str().into()),
            Field::new("value", |(.., value)| ((value.number * step(value)).round() / step(value)).into()),
            Field::new("unit", |(.., value)| value.unit.into()),
            Field::new("rounding", |(.., value)| (0.5 / step(value)).into()),
        ]
    }
    let found = judged.iter().filter_map(|Judged { claim, finding }| Some((*claim, finding.as_ref().ok()?)));
    let values = found.flat_map(|(claim, found)| found.values.iter().map(move |value| (claim, found.verdict, value)));
    Table::of(&columns(), values)
}

/// A step of a report that is written to a folder.
#[derive(Clone)]
pub struct ReportJob {
    pub report: Arc<Report>,
    pub folder: PathBuf,
    pub step: usize,
}

impl ReportJob {
    pub fn all(report: &Arc<Report>, folder: &std::path::Path) -> Vec<Self> {
        let job = |step| Self { report: Arc::clone(report), folder: folder.to_owned(), step };
        (0..report.steps()).map(job).collect()
    }
}

impl PartialEq for ReportJob {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.report, &other.report) && (&self.folder, self.step) == (&other.folder, other.step)
    }
}

impl Job for ReportJob {
    type Answer = Result<(), String>;
    const NAME: &'static str = Report::NAME;

    fn run(&self, results: &Results) -> Arc<Self::Answer> {
        let written = self.report.make(self.step, results).and_then(|files| {
            files.into_iter().take_while(|_| !results.stop().is_set()).try_for_each(|file| {
                let fail =
                    |error| format!("Cannot write {}: {}.", self.folder.join(&file.name).display(), io_reason(&error));
                write_below(&self.folder, &file.name, &file.bytes).map_err(fail)
            })
        });
        Arc::new(written)
    }
}
