//! Parts of the pages of reports.

use crate::catalog::Place;
use crate::document::SetKind;
use crate::scene::Scene;

const STYLE: &str = include_str!("../../../../assets/report/report.css");

/// Beginning of a page with a title.
pub(super) fn head(title: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n",
        escaped(title)
    )
}

/// A row of a table.
pub(super) fn row(cells: impl IntoIterator<Item = impl AsRef<str>>) -> String {
    let cells = cells.into_iter().map(|cell| format!("<td>{}</td>", escaped(cell.as_ref())));
    format!("<tr>{}</tr>\n", cells.collect::<String>())
}

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A figure whose names of parts no other figure of the page has.
pub(super) fn apart(svg: &str, name: &str) -> String {
    svg.replace("id=\"panel", &format!("id=\"{name}-panel")).replace("url(#panel", &format!("url(#{name}-panel"))
}

/// Source and terms of a data set; of an imported one, its file.
pub(super) fn origin(scene: &Scene<'_>, kind: SetKind, name: &str) -> [String; 2] {
    let Ok(entry) = scene.entry(kind, name).or_else(|_| scene.chart_entry(name)) else { return Default::default() };
    match (entry.header, entry.place) {
        (Some(header), _) => [header.source.clone(), header.license.clone()],
        (None, Place::Own(set)) => [format!("imported from {}", set.file), String::new()],
        (None, _) => Default::default(),
    }
}
