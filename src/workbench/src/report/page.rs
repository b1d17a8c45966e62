//! The page of a report: claims, figures, data, in one file without links to the network.

use std::fmt::Write as _;

use super::claim::{CANON, Finding, KODAK, NIKON, Subject, Value, Verdict};
use super::figures::FIGURES;
use super::html::{apart, escaped, head, origin, row};
use super::{FORMS, Judged, file_name};
use crate::document::render::{BALANCE, LEAF, SKIN, SUN};
use crate::document::{CHART, PAPER_REFERENCE, SetKind};
use crate::format::{capitalized, fixed};

/// Data of the paper with the data in their place, by kind and name.
const DATA: [(&str, SetKind, &str); 9] = [
    ("Canon EOS 10D", SetKind::Camera, CANON),
    ("Nikon D70", SetKind::Camera, NIKON),
    ("Kodak DCS420, of which no table could be obtained; the DCS200 is its sister model", SetKind::Camera, KODAK),
    ("Reference: Stiles & Burch, 2°", SetKind::Observer, PAPER_REFERENCE),
    ("Macbeth chart", SetKind::Chart, CHART),
    ("Skin", SetKind::Material, SKIN),
    ("Leaf of the fern", SetKind::Material, LEAF),
    ("Sunlight", SetKind::Illuminant, SUN),
    ("White balance for sunlight", SetKind::Illuminant, BALANCE),
];

/// Things that are no table of spectra.
const SHAPES: [(&str, &str); 3] = [
    ("Mesh of the head, scanned", "A head computed from the shape of the MakeHuman base mesh (CC0)"),
    ("Mesh of the fern", "A fern made by rules"),
    ("Roughness of skin and leaf, not stated", "The default surface; see Figure 8 and Figure 9"),
];

/// The page; `drawn` gives the figures as SVG, by place.
pub(super) fn page<'a>(subject: &Subject<'_>, judged: &[Judged], drawn: &dyn Fn(usize) -> Option<&'a str>) -> String {
    let mut out = head("Report on Huynh and Robles-Kelly 2007");
    let _ = write!(
        out,
        "<h1>What holds of the paper</h1>\n\
         <p>C. P. Huynh and A. Robles-Kelly, <cite>Comparative Colorimetric Simulation and Evaluation of Digital Cameras \
         Using Spectroscopy Data</cite> (2007), computed again with public data by Chromascope {}. {}</p>\n",
        env!("CARGO_PKG_VERSION"),
        escaped(&summary(judged))
    );
    conditions(&mut out, subject);
    claims(&mut out, subject, judged);
    figures(&mut out, drawn);
    data(&mut out, subject);
    out.push_str("</body>\n</html>\n");
    out
}

/// Numbers of verdicts on the paper's claims in words.
fn summary(judged: &[Judged]) -> String {
    let (claims, further): (Vec<&Judged>, Vec<&Judged>) = judged.iter().partition(|judged| judged.claim.is_of_paper());
    let counts = Verdict::ALL.map(|verdict| {
        let is_it = |judged: &&&Judged| judged.finding.as_ref().is_ok_and(|found| found.verdict == verdict);
        format!("{} {}", verdict.key(), claims.iter().filter(is_it).count())
    });
    let (count, checks) = (claims.len(), further.len());
    format!("Of {count} claims: {}. {checks} further checks are not claims of the paper.", counts.join(", "))
}

fn conditions(out: &mut String, subject: &Subject<'_>) {
    let scene = subject.scene(subject.document);
    let cells = scene.conditions().into_iter();
    let cells: Vec<String> =
        cells.map(|(column, value)| format!("{}: {value}", column.name.replace('_', " "))).collect();
    let cameras = subject.cameras().join(", ");
    let _ = writeln!(
        out,
        "<p class=\"note\">Cameras: {}. Experiments 1 and 2: {}; patches: {}. Experiment 3: {}, white balance {BALANCE}.</p>",
        escaped(&cameras),
        escaped(&cells.join("; ")),
        escaped(&subject.document.chart),
        escaped(&subject.scene(&subject.in_sun(SKIN)).light_name())
    );
}

fn claims(out: &mut String, subject: &Subject<'_>, judged: &[Judged]) {
    out.push_str(
        "<h2>Claims</h2>\n<p class=\"note\">Words between quotation marks are the paper's; all others are a paraphrase. \
         Numbers are rounded to the digits shown, which is not how well they are known: other tables of the same camera give \
         others.</p>\n\
         <table class=\"claims\">\n<thead><tr><th>The paper</th><th>Found</th><th></th><th>Why</th></tr></thead>\n<tbody>\n",
    );
    let mut part = "";
    for Judged { claim, finding } in judged {
        if claim.part != part {
            part = claim.part;
            let beyond = if claim.is_of_paper() { "" } else { ": not in the paper" };
            let _ = writeln!(out, "<tr class=\"part\"><th colspan=\"4\">{}{beyond}</th></tr>", escaped(part));
        }
        let (found, verdict, condition) = match finding {
            Ok(finding) => (found(subject, finding), finding.verdict.key(), claim.condition(finding.verdict)),
            Err(why) => (escaped(why), "cannot be computed", ""),
        };
        let condition =
            if condition.is_empty() { String::new() } else { format!("<p class=\"note\">{}</p>", escaped(condition)) };
        let _ = writeln!(
            out,
            "<tr id=\"{}\"><td>{}</td><td>{found}</td><td><span class=\"verdict\">{}</span>{condition}</td><td>{}</td></tr>",
            claim.key,
            escaped(claim.paper),
            capitalized(verdict),
            escaped(claim.why)
        );
    }
    out.push_str("</tbody>\n</table>\n");
}

/// Numbers below their quantity or, where there are many, with a row for each quantity and a column for each sensor.
fn found(subject: &Subject<'_>, finding: &Finding) -> String {
    let cameras = subject.cameras();
    let label = |sensor: &str| {
        let is_camera = cameras.iter().any(|camera| camera == sensor);
        let kind = if is_camera { SetKind::Camera } else { SetKind::Observer };
        let entry = subject.scene(subject.document).entry(kind, sensor);
        escaped(&entry.map_or_else(|_| sensor.to_owned(), |entry| entry.short))
    };
    let number = |value: &Value| format!("{} {}", fixed(value.number, value.decimals), value.unit);
    let values = &finding.values;
    let (sensors, quantities) = (unique(values, |value| &value.sensor), unique(values, |value| &value.quantity));
    let mut out = String::from("<table>");
    if quantities.len() > 2 && sensors.len() > 1 && !sensors.contains(&"") {
        let heads: Vec<String> = sensors.iter().map(|sensor| format!("<td>{}</td>", label(sensor))).collect();
        let _ = write!(out, "<tr><td></td>{}</tr>", heads.concat());
        for quantity in quantities {
            let of = |sensor: &&str| values.iter().find(|value| value.quantity == quantity && value.sensor == *sensor);
            let cells =
                sensors.iter().map(|sensor| format!("<td>{}</td>", of(sensor).map_or_else(String::new, number)));
            let _ = write!(out, "<tr><td>{}</td>{}</tr>", escaped(quantity), cells.collect::<String>());
        }
        return out + "</table>";
    }
    let mut quantity = "";
    for value in values {
        if !value.sensor.is_empty() && value.quantity != quantity {
            quantity = &value.quantity;
            let _ = write!(out, "<tr><th class=\"quantity\" colspan=\"2\">{}</th></tr>", escaped(quantity));
        }
        let name = if value.sensor.is_empty() { escaped(&value.quantity) } else { label(&value.sensor) };
        let _ = write!(out, "<tr><td>{name}</td><td>{}</td></tr>", number(value));
    }
    out + "</table>"
}

fn unique(values: &[Value], text: impl Fn(&Value) -> &String) -> Vec<&str> {
    let mut texts: Vec<&str> = Vec::new();
    for value in values {
        let text = text(value).as_str();
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    texts
}

fn figures<'a>(out: &mut String, drawn: &dyn Fn(usize) -> Option<&'a str>) {
    out.push_str(
        "<h2>Figures</h2>\n<p class=\"note\">Figures 2, 5, 8 and 9 have the paper's numbers; the others follow the order of its \
         experiments. Beside this page, where it was made, each is there for print and as numbers; a page that was \
         passed on alone leads to none of them, and <code>chromascope report</code> makes them again.</p>\n",
    );
    for (place, figure) in FIGURES.iter().enumerate() {
        let Some(svg) = drawn(place) else { continue };
        let links: Vec<String> = FORMS
            .map(|form| format!("<a href=\"{}\">{}</a>", file_name(figure, form), form.key().to_uppercase()))
            .into();
        let _ = writeln!(
            out,
            "<figure id=\"figure{number}\">\n{}\n<figcaption>Figure {number}: {}. {}</figcaption>\n</figure>",
            apart(svg, &format!("f{}", figure.number)).trim_end(),
            escaped(figure.title),
            links.join(" "),
            number = figure.number
        );
    }
}

fn data(out: &mut String, subject: &Subject<'_>) {
    out.push_str(
        "<h2>What stands in for what</h2>\n<table>\n<thead><tr><th>In the paper</th><th>Here</th><th>Source</th>\
         <th>Terms</th></tr></thead>\n<tbody>\n",
    );
    let own = subject.cameras();
    let is_used = |kind: SetKind, name: &str| match kind {
        SetKind::Camera => own.iter().any(|camera| camera == name),
        SetKind::Chart => subject.document.chart == name,
        SetKind::Illuminant => name == BALANCE || !subject.has_own_light,
        _ => true,
    };
    let mut rows: Vec<[String; 4]> = Vec::new();
    for (paper, kind, name) in DATA.into_iter().filter(|(_, kind, name)| is_used(*kind, name)) {
        rows.push(stand_in(subject, paper, kind, name));
    }
    for camera in own.iter().filter(|camera| ![CANON, NIKON, KODAK].contains(&camera.as_str())) {
        rows.push(stand_in(subject, "–", SetKind::Camera, camera));
    }
    rows.extend(SHAPES.map(|(paper, here)| [paper, here, "", ""].map(str::to_owned)));
    out.extend(rows.into_iter().map(row));
    out.push_str("</tbody>\n</table>\n");
}

fn stand_in(subject: &Subject<'_>, paper: &str, kind: SetKind, name: &str) -> [String; 4] {
    let [source, license] = origin(&subject.scene(subject.document), kind, name);
    [paper.to_owned(), name.to_owned(), source, license]
}
