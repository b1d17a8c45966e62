//! Help pages from Markdown: the constructs that the viewer draws, and an error for any other.

use pulldown_cmark::{CodeBlockKind, Event, HeadingLevel, Options, Parser, Tag, TagEnd};
use thiserror::Error;

use super::formula::{Formula, FormulaError};

/// A part of a page. Levels of headings are from 1, the page's title, to 3; a list with a start is numbered; the first row of a table
/// is its head.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    Heading { level: u8, content: Vec<Inline> },
    Paragraph(Vec<Inline>),
    List { start: Option<u64>, items: Vec<Vec<Block>> },
    Table(Vec<Vec<Vec<Inline>>>),
    Code(String),
    Formula(Formula),
}

#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    Text { text: String, style: Style, link: Option<String> },
    Formula(Formula),
}

impl Inline {
    pub fn text(words: impl Into<String>) -> Self {
        Self::Text { text: words.into(), style: Style::default(), link: None }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Style {
    pub strong: bool,
    pub emphasis: bool,
    pub code: bool,
}

#[derive(Clone, Debug, Error, PartialEq)]
pub enum MarkdownError {
    #[error("unknown construct: {0}")]
    Unknown(String),
    #[error("formula {0}: {1}")]
    Formula(String, FormulaError),
}

impl Block {
    /// Anchor of a heading, made from its words as GitHub makes it.
    pub fn anchor(&self) -> Option<String> {
        let Self::Heading { content, .. } = self else { return None };
        let kept = plain(content).to_lowercase().replace(' ', "-");
        Some(kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, '-' | '_')).collect())
    }

    pub fn words(&self) -> String {
        match self {
            Self::Heading { content, .. } | Self::Paragraph(content) => plain(content),
            Self::List { items, .. } => {
                let blocks: Vec<String> = items.iter().flatten().map(Self::words).collect();
                blocks.join("\n")
            }
            Self::Table(rows) => {
                let row = |row: &Vec<Vec<Inline>>| row.iter().map(|cell| plain(cell)).collect::<Vec<_>>().join("  ");
                rows.iter().map(row).collect::<Vec<_>>().join("\n")
            }
            Self::Code(text) => text.clone(),
            Self::Formula(formula) => formula.words.clone(),
        }
    }
}

pub fn plain(content: &[Inline]) -> String {
    let words = content.iter().map(|part| match part {
        Inline::Text { text, .. } => text.as_str(),
        Inline::Formula(formula) => &formula.words,
    });
    words.collect()
}

pub fn parse(text: &str) -> Result<Vec<Block>, MarkdownError> {
    let mut events = Parser::new_ext(text, Options::ENABLE_TABLES | Options::ENABLE_MATH);
    blocks(&mut events, None)
}

type Events<'a> = Parser<'a>;

/// Blocks up to the end of the enclosing one.
fn blocks(events: &mut Events<'_>, end: Option<TagEnd>) -> Result<Vec<Block>, MarkdownError> {
    let mut found = Vec::new();
    // Items of a tight list hold words without a paragraph.
    let mut loose = Content::default();
    while let Some(event) = events.next() {
        let block = match event {
            Event::End(tag) if Some(tag) == end => break,
            Event::Start(Tag::Paragraph) => Block::Paragraph(content(events, TagEnd::Paragraph)?),
            Event::Start(Tag::Heading { level, .. }) => {
                let content = content(events, TagEnd::Heading(level))?;
                let level = match level {
                    HeadingLevel::H1 => 1,
                    HeadingLevel::H2 => 2,
                    HeadingLevel::H3 => 3,
                    _ => return Err(MarkdownError::Unknown(format!("heading {level}"))),
                };
                Block::Heading { level, content }
            }
            Event::Start(Tag::List(start)) => list(events, start)?,
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language))) if &*language == "math" => {
                Block::Formula(formula(&lines(events)?, true)?)
            }
            Event::Start(Tag::CodeBlock(_)) => Block::Code(lines(events)?),
            Event::Start(Tag::Table(_)) => table(events)?,
            other if end == Some(TagEnd::Item) => {
                loose.add(other)?;
                continue;
            }
            other => return Err(MarkdownError::Unknown(format!("{other:?}"))),
        };
        found.extend(loose.take());
        found.push(block);
    }
    found.extend(loose.take());
    Ok(found)
}

fn list(events: &mut Events<'_>, start: Option<u64>) -> Result<Block, MarkdownError> {
    let mut items = Vec::new();
    while let Some(event) = events.next() {
        match event {
            Event::Start(Tag::Item) => items.push(blocks(events, Some(TagEnd::Item))?),
            Event::End(TagEnd::List(_)) => break,
            other => return Err(MarkdownError::Unknown(format!("{other:?}"))),
        }
    }
    Ok(Block::List { start, items })
}

fn lines(events: &mut Events<'_>) -> Result<String, MarkdownError> {
    let mut text = String::new();
    for event in events {
        match event {
            Event::Text(words) => text.push_str(&words),
            Event::End(TagEnd::CodeBlock) => break,
            other => return Err(MarkdownError::Unknown(format!("{other:?}"))),
        }
    }
    text.truncate(text.trim_end().len());
    Ok(text)
}

fn table(events: &mut Events<'_>) -> Result<Block, MarkdownError> {
    let mut rows: Vec<Vec<Vec<Inline>>> = Vec::new();
    while let Some(event) = events.next() {
        match event {
            Event::Start(Tag::TableHead | Tag::TableRow) => rows.push(Vec::new()),
            Event::Start(Tag::TableCell) => {
                let cell = content(events, TagEnd::TableCell)?;
                rows.last_mut().ok_or_else(|| MarkdownError::Unknown("cell outside a row".to_owned()))?.push(cell);
            }
            Event::End(TagEnd::TableHead | TagEnd::TableRow) => {}
            Event::End(TagEnd::Table) => break,
            other => return Err(MarkdownError::Unknown(format!("{other:?}"))),
        }
    }
    Ok(Block::Table(rows))
}

fn content(events: &mut Events<'_>, end: TagEnd) -> Result<Vec<Inline>, MarkdownError> {
    let mut content = Content::default();
    for event in events {
        if event == Event::End(end) {
            break;
        }
        content.add(event)?;
    }
    Ok(content.parts)
}

#[derive(Default)]
struct Content {
    parts: Vec<Inline>,
    style: Style,
    link: Option<String>,
}

impl Content {
    fn add(&mut self, event: Event<'_>) -> Result<(), MarkdownError> {
        match event {
            Event::Text(words) => self.push(words.into_string(), self.style),
            Event::Code(words) => self.push(words.into_string(), Style { code: true, ..self.style }),
            Event::SoftBreak | Event::HardBreak => self.push(" ".to_owned(), self.style),
            Event::InlineMath(tex) => self.parts.push(Inline::Formula(formula(&tex, false)?)),
            Event::Start(Tag::Strong) => self.style.strong = true,
            Event::End(TagEnd::Strong) => self.style.strong = false,
            Event::Start(Tag::Emphasis) => self.style.emphasis = true,
            Event::End(TagEnd::Emphasis) => self.style.emphasis = false,
            Event::Start(Tag::Link { dest_url, .. }) => self.link = Some(dest_url.into_string()),
            Event::End(TagEnd::Link) => self.link = None,
            other => return Err(MarkdownError::Unknown(format!("{other:?}"))),
        }
        Ok(())
    }

    /// Appends text to the last part if it has the same style and link.
    fn push(&mut self, words: String, style: Style) {
        if let Some(Inline::Text { text, style: last, link }) = self.parts.last_mut()
            && (*last, &*link) == (style, &self.link)
        {
            text.push_str(&words);
            return;
        }
        self.parts.push(Inline::Text { text: words, style, link: self.link.clone() });
    }

    fn take(&mut self) -> Option<Block> {
        let parts = std::mem::take(&mut self.parts);
        (!parts.is_empty()).then_some(Block::Paragraph(parts))
    }
}

fn formula(tex: &str, display: bool) -> Result<Formula, MarkdownError> {
    Formula::parse(tex, display).map_err(|error| MarkdownError::Formula(tex.to_owned(), error))
}
