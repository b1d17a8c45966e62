//! The path box: a path that is typed in the window, with completion.

use std::fs;
use std::path::{Path, PathBuf};

use super::save::SaveRequest;
use crate::format::io_failure;

const MOST: usize = 200;

/// A path prompt, used where there is no dialog or its result failed.
#[derive(Clone, Debug, Default)]
pub struct PathPrompt {
    /// The text typed.
    pub text: String,
    /// The data to save; `None` for opening.
    pub save: Option<SaveRequest>,
    /// An existing file, which the user was warned about.
    pub replaces: Option<PathBuf>,
    /// The reason why the path typed was not taken.
    pub failure: Option<String>,
    /// Names that the path typed could go on with.
    pub candidates: Vec<String>,
    /// True if the field takes the keyboard in this frame, with the cursor at the end.
    pub focus: bool,
    /// True if the cursor goes to the end of the text in this frame.
    pub to_end: bool,
    /// True if it replaces a dialog that is not available.
    pub no_dialog: bool,
    /// The dialog it replaces.
    pub(super) ticket: u64,
}

impl PathPrompt {
    pub(super) fn new(save: Option<SaveRequest>, ticket: u64) -> Self {
        let text = save.as_ref().map_or_else(String::new, |request| request.name.clone());
        Self { text, save, focus: true, no_dialog: true, ticket, ..Self::default() }
    }

    /// Clears the message about the path, because another one is typed.
    pub fn typed(&mut self) {
        self.replaces = None;
        self.failure = None;
        self.candidates.clear();
    }

    /// Prompt with a reason why the path was refused.
    pub(super) fn refused(self, why: impl Into<String>) -> Self {
        Self { failure: Some(why.into()), replaces: None, candidates: Vec::new(), focus: true, ..self }
    }
}

/// The path of a text, in which a leading `~` is the home folder.
pub(super) fn expanded(text: &str, home: Option<&Path>) -> PathBuf {
    let rest = text.strip_prefix('~').filter(|rest| rest.is_empty() || rest.starts_with(std::path::is_separator));
    match rest.zip(home) {
        Some((rest, home)) => home.join(rest.trim_start_matches(std::path::is_separator)),
        None => PathBuf::from(text),
    }
}

/// Reason that a path cannot be opened, if any.
pub(super) fn cannot_open(path: &Path) -> Option<String> {
    let facts = match fs::metadata(path) {
        Ok(facts) => facts,
        Err(error) => return Some(format!("{}.", io_failure(path, &error))),
    };
    // Only these are opened on trial: a pipe would wait for its other end.
    let tried = if facts.is_dir() {
        fs::read_dir(path).map(drop)
    } else if facts.is_file() {
        fs::File::open(path).map(drop)
    } else {
        Ok(())
    };
    tried.err().map(|error| format!("{}.", io_failure(path, &error)))
}

#[derive(Debug, PartialEq, Eq)]
pub(super) struct Completed {
    /// The typed text that was completed.
    pub(super) of: String,
    /// Text completed as far as all names agree.
    pub(super) text: String,
    /// Candidates, where there are several.
    pub(super) candidates: Vec<String>,
}

/// Completes a path as a shell does.
pub(super) fn complete(typed: &str, home: Option<&Path>) -> Completed {
    let as_it_is = |candidates| Completed { of: typed.to_owned(), text: typed.to_owned(), candidates };
    let separator = std::path::MAIN_SEPARATOR;
    if typed == "~" && home.is_some() {
        return Completed { text: format!("~{separator}"), ..as_it_is(Vec::new()) };
    }
    let (folder, start) = typed.split_at(typed.rfind(std::path::is_separator).map_or(0, |at| at + 1));
    let place = if folder.is_empty() { PathBuf::from(".") } else { expanded(folder, home) };
    let mut names: Vec<String> = fs::read_dir(place)
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|file| Some((file.file_name().into_string().ok()?, file.path().is_dir())))
        .filter(|(name, _)| name.starts_with(start) && (start.starts_with('.') || !name.starts_with('.')))
        .map(|(name, is_folder)| if is_folder { name + std::path::MAIN_SEPARATOR_STR } else { name })
        .collect();
    names.sort();
    match names.as_slice() {
        [] => as_it_is(Vec::new()),
        [one] => Completed { text: format!("{folder}{one}"), ..as_it_is(Vec::new()) },
        [first, .., last] => {
            // In sorted order, a prefix common to the first and the last is common to all.
            let shared: String = first.chars().zip(last.chars()).take_while(|(a, b)| a == b).map(|(a, _)| a).collect();
            let text = format!("{folder}{shared}");
            names.truncate(MOST);
            Completed { text, ..as_it_is(names) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_completed_as_far_as_names_agree() {
        let home = tempfile::tempdir().expect("a folder");
        let path = home.path();
        for folder in ["spectra", "spectra/deep"] {
            fs::create_dir(path.join(folder)).expect("made");
        }
        for file in ["leaf one.csv", "leaf two.csv", ".hidden", "spectra/Älg.csv"] {
            fs::write(path.join(file), "x").expect("written");
        }
        let complete = |text: &str| {
            let done = complete(text, Some(path));
            (done.text, done.candidates.join("|"))
        };
        let is = |text: &str, candidates: &str| (text.to_owned(), candidates.to_owned());
        assert_eq!(complete("~"), is("~/", ""));
        assert_eq!(complete("~/l"), is("~/leaf ", "leaf one.csv|leaf two.csv"));
        assert_eq!(complete("~/leaf t"), is("~/leaf two.csv", ""));
        assert_eq!(complete("~/s"), is("~/spectra/", ""));
        assert_eq!(complete("~/spectra/Ä"), is("~/spectra/Älg.csv", ""));
        assert_eq!(complete("~/spectra/"), is("~/spectra/", "deep/|Älg.csv"));
        assert_eq!(complete("~/."), is("~/.hidden", ""));
        assert_eq!(complete("~/none"), is("~/none", ""));
        let full = format!("{}/sp", path.display());
        assert_eq!(complete(&full), is(&format!("{}/spectra/", path.display()), ""));
    }

    #[test]
    fn the_home_folder_is_written_as_a_tilde() {
        let home = Path::new("/home/me");
        for (text, path) in
            [("~", "/home/me"), ("~/x y", "/home/me/x y"), ("~you/x", "~you/x"), ("/a/~", "/a/~"), ("b", "b")]
        {
            assert_eq!(expanded(text, Some(home)), Path::new(path), "{text}");
        }
        assert_eq!(expanded("~/x", None), Path::new("~/x"));
    }
}
