//! Ranks, names and messages of libraries as text for display; numbers are those of the figures.

use std::borrow::Cow;
use std::fmt;
use std::path::{Path, PathBuf};

pub use chromascope_figure::number::{aligned, behind, decimals_by, fixed, number, rounded, signed, whole};
use spectral_file::{Dropped, DroppedRow};

/// A rank as `3`, or as `1–3` where it is not certain.
pub fn rank_in_words(rank: Option<[usize; 2]>) -> String {
    match rank {
        Some([first, last]) if first == last => first.to_string(),
        Some([first, last]) => format!("{first}–{last}"),
        None => "–".to_owned(),
    }
}

pub fn capitalized(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A library's message as a sentence: with a capital at its start and a full stop.
pub fn sentence(words: &str) -> String {
    format!("{}.", capitalized(words))
}

/// The last part of a path; the whole path if it has none.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The shortest end of a path that none of the others has, folders before its name.
pub fn path_end(path: &Path, others: &[impl AsRef<Path>]) -> String {
    let shared = |other: &Path| path.iter().rev().zip(other.iter().rev()).take_while(|(a, b)| a == b).count();
    let shared = others.iter().map(AsRef::as_ref).filter(|other| *other != path).map(shared).max().unwrap_or(0);
    let end: PathBuf = path.iter().skip(path.iter().count().saturating_sub(shared + 1)).collect();
    end.to_string_lossy().into_owned()
}

/// A path for people, on one line.
pub fn display_path(path: &Path) -> String {
    spectral_file::on_one_line(&path.to_string_lossy()).into_owned()
}

/// The system's reason for a failure at a path, after the path.
pub fn io_failure(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {}", path.display(), io_reason(error))
}

/// The system's reason for a failure, without its error number.
pub fn io_reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    spectral_file::lowered(&text[..end])
}

/// Rows of a file that are in no curve: a sentence for the merged and one for the omitted ones, each with the line numbers of at
/// most `most` rows.
pub fn dropped_rows(rows: &[DroppedRow], most: usize) -> Vec<String> {
    let (merged, left): (Vec<&DroppedRow>, Vec<&DroppedRow>) =
        rows.iter().partition(|row| row.why == Dropped::Averaged);
    let mut sentences = Vec::new();
    if !merged.is_empty() {
        let lines = listed(&merged, most, |row| row.line.to_string());
        let plural = if merged.len() == 1 { "line" } else { "lines" };
        let with = "merged with others of the same wavelength (mean)";
        sentences.push(format!("{} {with}: {plural} {lines}", rows_of(merged.len())));
    }
    if !left.is_empty() {
        let lines = listed(&left, most, |row| format!("line {} ({})", row.line, row.why));
        sentences.push(format!("{} skipped: {lines}", rows_of(left.len())));
    }
    sentences
}

fn rows_of(count: usize) -> String {
    if count == 1 { "1 row".to_owned() } else { format!("{count} rows") }
}

/// The first of some things in words, at most so many, and the number of the others.
pub fn listed<T>(all: &[T], most: usize, one: impl Fn(&T) -> String) -> String {
    let words: Vec<String> = all.iter().take(most).map(one).collect();
    let more = all.len().saturating_sub(most);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    words.join(", ") + &rest
}

/// Files by what is said of them. What differs in numbers and quoted names alone is said once, in the words of the first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally(pub Vec<(String, Vec<String>)>);

impl Tally {
    pub fn add(&mut self, words: &str, file: String) {
        fn kind(words: &str) -> impl Iterator<Item = char> {
            let unquoted = words.split(['"', '“', '”']).step_by(2).flat_map(str::chars);
            unquoted.filter(|c| !c.is_ascii_digit() && *c != '.')
        }
        match self.0.iter_mut().find(|(known, _)| kind(known).eq(kind(words))) {
            Some((_, files)) => files.push(file),
            None => self.0.push((words.to_owned(), vec![file])),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("nothing");
        }
        let counted = |(words, files): &(String, Vec<String>)| {
            format!("{} {words} ({})", files.len(), listed(files, 3, String::clone))
        };
        f.write_str(&self.0.iter().map(counted).collect::<Vec<_>>().join(", "))
    }
}

/// A name as it fits, with an ellipsis behind two thirds of it if it is too long: makers and models stand first, and many names of
/// files differ only at their ends.
pub fn cut_in_middle(name: &str, fits: impl Fn(&str) -> bool) -> Cow<'_, str> {
    if fits(name) {
        return Cow::Borrowed(name);
    }
    let letters: Vec<char> = name.chars().collect();
    let cut = |kept: usize| {
        let ends = [&letters[..kept - kept / 3], &letters[letters.len() - kept / 3..]];
        let [head, tail] = ends.map(|end| end.iter().collect::<String>());
        format!("{}…{}", head.trim_end(), tail.trim_start())
    };
    let counts: Vec<usize> = (1..letters.len()).collect();
    Cow::Owned(cut(counts.partition_point(|kept| fits(&cut(*kept)))))
}

/// A name that any file system takes: letters and digits, small, other signs as single hyphens.
pub fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let slug = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    if slug.is_empty() { "unnamed".to_owned() } else { slug }
}
