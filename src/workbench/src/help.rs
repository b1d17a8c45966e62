//! The help pages: Markdown files of `assets/help`, and two pages made from the data files themselves.

pub mod formula;
pub mod markdown;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::catalog::{Catalog, licenses};
use crate::document::SetKind;
use markdown::{Block, Inline};

/// Pages in the order of the list: the file name without its ending, which is also the target of links.
const ORDER: &str = "getting-started window own-spectra photograph lights command-line keyboard model metrics correction accuracy \
                     measured paper glossary data";

/// Pages for developers.
const LAST: [&str; 2] = ["benchmark", "architecture"];

pub const FIRST: &str = "getting-started";

/// Characters of context on each side of a match.
const CONTEXT: usize = 40;

#[derive(Debug)]
pub struct Page {
    pub name: &'static str,
    pub title: String,
    pub blocks: Vec<Block>,
}

/// All pages in the order of the list. A page that cannot be parsed is absent; the tests parse each.
pub fn pages() -> &'static [Page] {
    static PAGES: LazyLock<Vec<Page>> = LazyLock::new(|| {
        let file = |name: &'static str| markdown::parse(source(name)?).ok().map(|blocks| page(name, blocks));
        let mut pages: Vec<Page> = ORDER.split(' ').filter_map(file).collect();
        pages.push(page("data-sets", data_sets(&Catalog::built_in())));
        pages.extend(LAST.into_iter().filter_map(file));
        pages.push(page("licenses", license_texts()));
        pages
    });
    &PAGES
}

pub fn source(name: &str) -> Option<&'static str> {
    chromascope_data::text(&format!("help/{name}.md"))
}

pub fn find(name: &str) -> Option<&'static Page> {
    pages().iter().find(|page| page.name == name)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target<'a> {
    /// A page, and a heading's anchor on it.
    Page(&'static str, Option<&'a str>),
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
            blocks.push(heading(2, &crate::format::capitalized(kind.key())));
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

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hit {
    pub page: &'static str,
    pub block: usize,
    pub heading: String,
    pub excerpt: String,
}

pub fn terms(query: &str) -> Vec<String> {
    query.split_whitespace().map(str::to_lowercase).collect()
}

/// Blocks that contain every word of the query: headings first, then text in the order of the pages.
pub fn search(pages: &[Page], query: &str) -> Vec<Hit> {
    let terms = terms(query);
    if terms.is_empty() {
        return Vec::new();
    }
    let mut hits: Vec<(bool, Hit)> = pages.iter().flat_map(|page| on_page(page, &terms)).collect();
    hits.sort_by_key(|(heading, _)| !heading);
    hits.into_iter().map(|(_, hit)| hit).collect()
}

fn on_page(page: &Page, terms: &[String]) -> Vec<(bool, Hit)> {
    let mut hits = Vec::new();
    let mut heading = page.title.clone();
    for (block, content) in page.blocks.iter().enumerate() {
        let words = content.words();
        let is_heading = matches!(content, Block::Heading { .. });
        if is_heading {
            heading.clone_from(&words);
        }
        let folded = words.to_lowercase();
        if terms.iter().all(|term| folded.contains(term)) {
            let excerpt = excerpt(&words, &terms[0]);
            hits.push((is_heading, Hit { page: page.name, block, heading: heading.clone(), excerpt }));
        }
    }
    hits
}

fn excerpt(words: &str, term: &str) -> String {
    let letters: Vec<char> = words.chars().map(|c| if c == '\n' { ' ' } else { c }).collect();
    let term: Vec<char> = term.chars().collect();
    let same = |part: &[char]| part.iter().zip(&term).all(|(a, b)| a.to_lowercase().eq(b.to_lowercase()));
    let at = letters.windows(term.len()).position(same).unwrap_or(0);
    let mut start = at.saturating_sub(CONTEXT);
    // From a word's beginning on.
    while start > 0 && start < at && letters[start - 1] != ' ' {
        start += 1;
    }
    let end = (at + term.len() + CONTEXT).min(letters.len());
    let text: String = letters[start..end].iter().collect();
    format!("{}{}{}", if start > 0 { "…" } else { "" }, text.trim(), if end < letters.len() { "…" } else { "" })
}
