//! The help pages and their window: every page is shown completely, every link leads somewhere, search finds.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use chromascope::command::{Command, key_bindings};
use chromascope::document::Document;
use chromascope::help::formula::{Formula, FormulaError};
use chromascope::help::markdown::{Block, Inline, MarkdownError, parse};
use chromascope::help::search;
use chromascope::help::{FIRST, Page, Target, find, pages, resolve, source};
use chromascope::workspaces::PaneKind;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use crate::screenshots::open_with;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files() -> BTreeSet<String> {
    let names = fs::read_dir(root().join("assets/help")).unwrap();
    names.map(|file| file.unwrap().file_name().into_string().unwrap()).collect()
}

/// All text parts of a block with their links.
fn inlines(block: &Block) -> Vec<&Inline> {
    match block {
        Block::Heading { content, .. } | Block::Paragraph(content) => content.iter().collect(),
        Block::List { items, .. } => items.iter().flatten().flat_map(inlines).collect(),
        Block::Table(rows) => rows.iter().flatten().flatten().collect(),
        Block::Code(_) | Block::Formula(_) => Vec::new(),
    }
}

fn links(page: &Page) -> impl Iterator<Item = &str> {
    page.blocks.iter().flat_map(inlines).filter_map(|part| match part {
        Inline::Text { link, .. } => link.as_deref(),
        Inline::Formula(_) => None,
    })
}

#[test]
fn every_page_parses_and_is_listed() {
    for file in files() {
        let name = file.strip_suffix(".md").expect("help pages are Markdown");
        let blocks = parse(source(name).unwrap()).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(matches!(blocks[0], Block::Heading { level: 1, .. }), "{file} begins with its title");
        let listed = find(name).unwrap_or_else(|| panic!("{file} is not in the list of pages"));
        assert_eq!(listed.blocks, blocks);
        let titles = blocks.iter().filter(|block| matches!(block, Block::Heading { level: 1, .. })).count();
        assert_eq!(titles, 1, "{file} has one title");
    }
    assert_eq!(pages().len(), files().len() + 2, "two pages are made from the data files");
}

#[test]
fn every_link_resolves() {
    for page in pages() {
        for link in links(page) {
            assert!(resolve(page.name, link).is_some(), "{}: {link} leads nowhere", page.name);
        }
    }
    assert_eq!(resolve(FIRST, "no-such-page.md"), None);
    assert_eq!(resolve(FIRST, "glossary.md#no-such-heading"), None);
    assert_eq!(resolve(FIRST, "glossary.md"), Some(Target::Page("glossary", None)));
}

#[test]
fn files_that_the_readme_names_exist() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let targets: Vec<&str> = readme.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(targets.len() > 10);
    for target in targets.iter().filter(|target| !target.starts_with("https://")) {
        assert!(root().join(target.split('#').next().unwrap()).exists(), "README.md: {target}");
    }
}

#[test]
fn constructs_that_the_viewer_does_not_draw_are_errors() {
    for text in ["> quote", "![picture](x.png)", "<b>html</b>", "---", "#### four", "a <i>b</i>"] {
        assert!(matches!(parse(text), Err(MarkdownError::Unknown(_))), "{text}");
    }
    assert!(matches!(parse("$\\nonsense$"), Err(MarkdownError::Formula(..))));
}

#[test]
fn formulas_have_words_for_search_and_screen_readers() {
    let words = |tex| Formula::parse(tex, false).unwrap().words;
    assert_eq!(words(r"\frac{a}{b+1}"), "a/(b + 1)");
    assert_eq!(words(r"x_i^2 = \sqrt{y}"), "x_i^2 = √y");
    assert_eq!(words(r"\int_0^\infty f\,d\lambda"), "∫_0^∞f dλ");
    assert_eq!(words(r"\begin{pmatrix} 1 & 0 \\ 0 & 1 \end{pmatrix}"), "(1 0; 0 1)");
    for (tex, error) in [
        (r"\foo", FormulaError::Command("foo".to_owned())),
        ("{a", FormulaError::Missing("end of a group")),
        ("a}", FormulaError::Missing("opening brace")),
        ("^2", FormulaError::Missing("base of a script")),
        (r"\frac{a}", FormulaError::Missing("argument")),
    ] {
        assert_eq!(Formula::parse(tex, false), Err(error), "{tex}");
    }
}

#[test]
fn search_finds_words_with_their_heading_and_context() {
    let hits = search(pages(), "correlation length");
    assert!(hits.iter().any(|hit| hit.page == "glossary" && hit.excerpt.to_lowercase().contains("correlation length")));
    let hits = search(pages(), "GLOSSARY");
    assert_eq!((hits[0].page, hits[0].block), ("glossary", 0), "headings come first, whatever the case");
    assert!(search(pages(), "nikon nowhere-to-be-found").is_empty());
    assert!(search(pages(), "  ").is_empty());
}

#[test]
fn the_keyboard_page_lists_every_key() {
    let page = find("keyboard").unwrap();
    let words: String = page.blocks.iter().map(Block::words).collect();
    for binding in key_bindings(PaneKind::CHROMATICITY) {
        let keys = binding.shortcut.format(&egui::ModifierNames::NAMES, false);
        match binding.command {
            Command::Show(_) | Command::ToggleSource(_) => {}
            _ => assert!(words.contains(&keys), "{keys}: {}", binding.words),
        }
    }
}

/// Every page in both themes and sizes: kittest panics at a missing glyph or an unnamed control.
#[test]
fn every_page_is_laid_out() {
    let mut window = open_with(Document::colorimetry(), [900.0, 600.0], egui::Theme::Light);
    for page in pages() {
        window.state_mut().view.help.open(page.name, 0);
        window.run();
        let mut titles = window.query_all_by_role_and_label(Role::Label, &page.title);
        assert!(titles.next().is_some(), "{} stands above its text", page.title);
    }
}

#[test]
fn help_opens_searches_follows_links_and_closes_by_keyboard() {
    let mut window = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    window.key_press(egui::Key::F1);
    window.run();
    assert_eq!(window.state_mut().view.help.page, Some(FIRST));
    window.key_press(egui::Key::Slash);
    window.run();
    window.get_by_role_and_label(Role::TextInput, "Search help").type_text("pairs that a camera confuses");
    window.run();
    window.key_press(egui::Key::Enter);
    window.run();
    assert_eq!(window.state_mut().view.help.page, Some("metrics"));
    window.key_press(egui::Key::Escape);
    window.run();
    assert_eq!(window.state_mut().view.help.query, "");
    window.get_by_label("← Back").click();
    window.run();
    assert_eq!(window.state_mut().view.help.page, Some(FIRST));
    window.get_by_role_and_label(Role::Link, "Glossary").click_accesskit();
    window.run();
    assert_eq!(window.state_mut().view.help.page, Some("glossary"));
    window.key_press(egui::Key::Escape);
    window.run();
    assert_eq!(window.state_mut().view.help.page, None);
}

#[test]
fn a_hit_on_another_page_is_scrolled_to() {
    let mut window = open_with(Document::colorimetry(), [1280.0, 800.0], egui::Theme::Dark);
    let query = "Spectral images";
    let hit = search(pages(), query).into_iter().next().expect("found");
    window.state_mut().push(Command::Help(FIRST, 0));
    window.run();
    window.get_by_role_and_label(Role::TextInput, "Search help").focus();
    window.run();
    window.state_mut().view.help.query = query.to_owned();
    window.run();
    window.key_press(egui::Key::Enter);
    window.run();
    assert_eq!(window.state().view.help.page, Some(hit.page));
    assert!(hit.block > 0 && hit.page != FIRST, "elsewhere than at the top of the page that is open");
    let place = window.query_all_by_role_and_label(Role::Label, query).map(|node| node.rect()).next_back();
    let top = place.expect("drawn").top();
    assert!((50.0..200.0).contains(&top), "{top}");
}
