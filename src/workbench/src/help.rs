//! The help pages: Markdown files of `assets/help`, and two pages made from the data files themselves.

pub mod formula;
pub mod markdown;
pub mod search;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::catalog::{Catalog, licenses};
use crate::document::SetKind;
use markdown::{Block, Inline};

/// Pages in the order of the list: the file name without its ending, which is also the target of links.
const ORDER: [&str; 14] = [
    "getting-started",
    "window",
    "own-spectra",
    "lights",
    "command-line",
    "keyboard",
    "model",
    "metrics",
    "correction",
    "accuracy",
    "measured",
    "paper",
    "glossary",
    "data",
];

/// Pages for developers.
const LAST: [&str; 2] = ["benchmark", "architecture"];

/// The page that opens first.
pub const FIRST: &str = ORDER[0];

/// One page.
#[derive(Debug)]
pub struct Page {
    /// File name without its ending.
    pub name: &'static str,
    /// The first heading.
    pub title: String,
    /// The content, the first heading included.
    pub blocks: Vec<Block>,
}

/// All pages in the order of the list. A page that cannot be parsed is absent; the tests parse each.
pub fn pages() -> &'static [Page] {
    static PAGES: LazyLock<Vec<Page>> = LazyLock::new(|| {
        let file = |name: &&'static str| markdown::parse(source(name)?).ok().map(|blocks| page(name, blocks));
        let mut pages: Vec<Page> = ORDER.iter().filter_map(file).collect();
        pages.push(page("data-sets", data_sets(&Catalog::built_in())));
        pages.extend(LAST.iter().filter_map(file));
        pages.push(page("licenses", license_texts()));
        pages
    });
    &PAGES
}

/// The Markdown text of a page that is a file.
pub fn source(name: &str) -> Option<&'static str> {
    chromascope_data::text(&format!("help/{name}.md"))
}

/// The page of this name.
pub fn find(name: &str) -> Option<&'static Page> {
    pages().iter().find(|page| page.name == name)
}

/// Target of a link on a help page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target<'a> {
    /// A page, and a heading's anchor on it.
    Page(&'static str, Option<&'a str>),
    /// An address for the browser.
    Web(&'a str),
}

/// Resolves a link as it is written on the page `from`: `page.md`, `page.md#anchor`, `#anchor` or a web address.
pub fn resolve<'a>(from: &'static str, link: &'a str) -> Option<Target<'a>> {
    if link.starts_with("https://") {
        return Some(Target::Web(link));
    }
    let (file, anchor) = link.split_once('#').map_or((link, None), |(file, anchor)| (file, Some(anchor)));
    let page = if file.is_empty() { find(from)? } else { find(file.strip_suffix(".md")?)? };
    let known = |anchor: &str| page.blocks.iter().any(|block| block.anchor().as_deref() == Some(anchor));
    anchor.is_none_or(known).then_some(Target::Page(page.name, anchor))
}

fn page(name: &'static str, blocks: Vec<Block>) -> Page {
    let title = match blocks.first() {
        Some(Block::Heading { content, .. }) => markdown::plain(content),
        _ => name.to_owned(),
    };
    Page { name, title, blocks }
}

fn heading(level: u8, words: &str) -> Block {
    Block::Heading { level, content: vec![Inline::text(words)] }
}

fn paragraph(words: impl Into<String>) -> Block {
    Block::Paragraph(vec![Inline::text(words)])
}

/// Every built-in table with its source and terms.
fn data_sets(catalog: &Catalog) -> Vec<Block> {
    let mut blocks = vec![
        heading(1, "Built-in data sets"),
        paragraph(
            "Title, source and terms of each built-in table, as its file states them. The Inspector shows a table's notes.",
        ),
    ];
    let mut listed = BTreeSet::new();
    for kind in SetKind::ALL {
        let headers = catalog.of_kind(kind).filter_map(|entry| entry.header.as_ref());
        let new: Vec<_> = headers.filter(|header| listed.insert((kind, header.title.clone()))).collect();
        if !new.is_empty() {
            blocks.push(heading(2, &crate::format::capitalized(kind.plural())));
        }
        for header in new {
            blocks.push(heading(3, &header.title));
            let origin = if header.is_digitized() { " Digitized from a published figure." } else { "" };
            blocks.push(paragraph(format!("{}{origin}", header.source)));
            blocks.push(paragraph(format!("Terms: {}", header.license)));
        }
    }
    blocks
}

fn license_texts() -> Vec<Block> {
    let mut blocks = vec![
        heading(1, "About and licenses"),
        paragraph(concat!("Chromascope ", env!("CARGO_PKG_VERSION"), ". ", env!("CARGO_PKG_DESCRIPTION"), ".")),
        paragraph(
            "Free software under the MIT or the Apache-2.0 license, at your option. Data and fonts have terms of their own:",
        ),
    ];
    for (name, text) in licenses() {
        blocks.extend([heading(2, name), Block::Code(text.to_owned())]);
    }
    blocks
}
