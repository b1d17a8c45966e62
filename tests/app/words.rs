//! The vocabulary of the glossary: words that mean something else to a color scientist, or nothing, appear neither in string
//! literals of the program nor in the help of the command line nor on the help pages.

use std::fs;
use std::path::{Path, PathBuf};

/// Banned words with their replacements.
const BANNED: &[(&str, &str)] = &[
    ("truth", "reference"),
    ("on show", "visible"),
    ("left out", "skipped"),
    ("remembered", "cached"),
    ("certified", "estimated error bound"),
    ("promised", "bound"),
    ("black body", "blackbody"),
    ("black bodies", "blackbodies"),
    ("glowing body", "blackbody"),
    ("mirror lobe", "specular lobe"),
    ("mirror term", "specular component"),
    ("mirror's direction", "specular direction"),
    ("way to the diagram", "color transform"),
    ("cheapest way", "fastest method"),
    ("in another way", "by another method"),
    ("the ways", "the methods"),
    ("no number", "not a number"),
    ("is no file", "is not a file"),
    ("at hand", "available"),
    ("put to use", "used"),
    ("take off", "remove"),
    ("takes it back", "undoes"),
    ("took it back", "undid"),
    ("kept document", "recovered document"),
    ("is kept in", "is saved in"),
    ("not kept", "not saved"),
    ("read otherwise", "read with other settings"),
    ("understood as", "interpretation"),
    ("was understood", "decisions"),
    ("out of sight", "out of range"),
    ("half sides", "half-widths"),
    ("half the side", "half-width"),
    ("sum to nothing", "undefined (X + Y + Z = 0)"),
    ("can mend", "can correct"),
    ("so manyth", "every n-th"),
    ("more so", "others renamed"),
    ("change places", "reciprocal (Helmholtz)"),
    ("sources on", "sensors"),
    ("all sources", "all sensors"),
    ("each source", "each sensor"),
    ("a source", "a sensor"),
    ("deviation of heights", "RMS roughness"),
    ("reading of", "normalization"),
];

/// A sentence and where it stands.
struct Sentence {
    file: PathBuf,
    line: usize,
    text: String,
}

fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, ending, found);
        } else if path.to_str().unwrap().ends_with(ending) {
            found.push(path);
        }
    }
}

/// String literals of a Rust source, continued lines joined, and its doc comments if requested.
fn sentences(file: &Path, source: &str, docs: bool) -> Vec<Sentence> {
    let mut found = Vec::new();
    let mut letters = source.char_indices().peekable();
    let line_of = |at: usize| source[..at].matches('\n').count() + 1;
    let mut add = |at: usize, text: String| {
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        found.push(Sentence { file: file.to_owned(), line: line_of(at), text });
    };
    while let Some((at, letter)) = letters.next() {
        let rest = &source[at..];
        if rest.starts_with("//") {
            let comment: &str = rest.lines().next().unwrap_or_default();
            if docs && let Some(words) = comment.strip_prefix("///") {
                add(at, words.to_owned());
            }
            while letters.next_if(|(_, letter)| *letter != '\n').is_some() {}
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\\"'") {
            letters.by_ref().take_while(|(_, letter)| *letter != '"').for_each(drop);
        } else if letter == '"' {
            let mut text = String::new();
            while let Some((_, letter)) = letters.next() {
                match letter {
                    '"' => break,
                    '\\' => text.extend(letters.next().filter(|(_, next)| *next == '"').map(|(_, next)| next)),
                    _ => text.push(letter),
                }
            }
            add(at, text);
        }
    }
    found
}

fn violations(sentences: &[Sentence]) -> Vec<String> {
    let mut found = Vec::new();
    for sentence in sentences {
        // A single word in lower case is a key or an id.
        if !sentence.text.contains(' ') {
            continue;
        }
        let folded = format!(" {} ", sentence.text.to_lowercase());
        for (banned, instead) in BANNED {
            let hit = folded.match_indices(banned).any(|(at, _)| {
                // The paper's words are its own.
                let is_quoted = folded[..at].matches('“').count() > folded[..at].matches('”').count();
                let outside = |letter: Option<char>| letter.is_none_or(|letter| !letter.is_alphanumeric());
                let mut after = folded[at + banned.len()..].chars();
                !is_quoted && outside(folded[..at].chars().next_back()) && outside(after.find(|letter| *letter != 's'))
            });
            if hit {
                let place = format!("{}:{}", sentence.file.display(), sentence.line);
                found.push(format!("{place}: say \"{instead}\", not \"{banned}\": {}", sentence.text));
            }
        }
    }
    found
}

#[test]
fn the_program_speaks_the_glossary() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = Vec::new();
    files(&root.join("src"), ".rs", &mut paths);
    let mut all = Vec::new();
    for path in paths {
        let source = fs::read_to_string(&path).unwrap();
        let code = source.split("#[cfg(test)]\nmod tests").next().unwrap();
        let is_command_line = path.components().any(|part| part.as_os_str() == "cli");
        if path.file_name().is_some_and(|name| name != "tests.rs") {
            all.extend(sentences(path.strip_prefix(root).unwrap(), code, is_command_line));
        }
    }
    let mut pages = Vec::new();
    files(&root.join("assets/help"), ".md", &mut pages);
    pages.push(root.join("README.md"));
    for path in pages {
        let text = fs::read_to_string(&path).unwrap();
        let file = path.strip_prefix(root).unwrap().to_owned();
        let lines = text.lines().enumerate();
        all.extend(lines.map(|(index, line)| Sentence { file: file.clone(), line: index + 1, text: line.to_owned() }));
    }
    assert!(all.len() > 3000, "{} sentences", all.len());
    let found = violations(&all);
    assert!(found.is_empty(), "{} sentences:\n{}", found.len(), found.join("\n"));
}

#[test]
fn a_banned_word_is_found_where_it_is_a_word() {
    let source =
        "// on show\n/// left out\nlet a = \"nothing is on \\\n   show\"; let q = '\"'; let b = \"untruthful words\";";
    let found = violations(&sentences(Path::new("a.rs"), source, false));
    assert_eq!(found, ["a.rs:3: say \"visible\", not \"on show\": nothing is on show"]);
    let docs = violations(&sentences(Path::new("a.rs"), source, true));
    assert_eq!(docs.len(), 2, "help of the command line is in doc comments: {docs:?}");
}
