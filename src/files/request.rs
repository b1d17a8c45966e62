//! Requests to save, in the forms that something can be written in, and the path box: a path that is typed in the window,
//! with completion.

use std::ffi::OsStr;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use spectral_file::write::Beside;

use crate::format::io_failure;

/// Most completions that are listed.
const MOST: usize = 200;

/// A path prompt, used where there is no dialog or its result failed.
#[derive(Clone, Debug, Default)]
pub struct PathPrompt {
    pub text: String,
    /// The data to save; `None` for opening.
    pub save: Option<SaveRequest>,
    /// An existing file, which the user was warned about.
    pub replaces: Option<PathBuf>,
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
    pub(super) of: String,
    /// Text completed as far as all names agree.
    pub(super) text: String,
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

/// Makes the bytes of a file; the error is a message.
pub type MakeBytes = Arc<dyn Fn() -> Result<Vec<u8>, String> + Send + Sync>;

/// A form in which something can be written. Its bytes are made only when it is.
#[derive(Clone)]
pub struct FileForm {
    pub extension: &'static str,
    pub make: MakeBytes,
    /// What goes into files beside a table.
    pub beside: Option<Beside>,
}

impl FileForm {
    /// A format whose bytes are computed on demand, in the background; the error is a message.
    pub fn new(extension: &'static str, make: impl Fn() -> Result<Vec<u8>, String> + Send + Sync + 'static) -> Self {
        Self { extension, make: Arc::new(make), beside: None }
    }

    pub fn of_bytes(extension: &'static str, bytes: Vec<u8>) -> Self {
        Self::new(extension, move || Ok(bytes.clone()))
    }
}

impl fmt::Debug for FileForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FileForm").field(&self.extension).finish()
    }
}

#[derive(Clone, Debug)]
pub struct SaveRequest {
    /// Its description, for the save prompt: `Nikon D70 as CSV, as measured`.
    pub what: String,
    pub name: String,
    /// The forms it can be written in, the offered one first. The ending of the path decides.
    pub forms: Vec<FileForm>,
    /// Remark after saving: how the contents differ from the program's. May be empty.
    pub note: String,
}

impl SaveRequest {
    pub fn new(what: impl Into<String>, name: impl Into<String>, forms: Vec<FileForm>) -> Self {
        Self { what: what.into(), name: name.into(), forms, note: String::new() }
    }

    /// The path to write to and the form that its ending requests; without an ending, the offered form's is added. The error
    /// is a sentence.
    pub(super) fn target(&self, path: &Path) -> Result<(PathBuf, FileForm), String> {
        let offered = self.forms.first().ok_or_else(|| "There is nothing to save.".to_owned())?;
        let own = |typed: &&str| self.forms.iter().any(|form| form.extension.eq_ignore_ascii_case(typed));
        let Some(typed) = path.extension().and_then(OsStr::to_str).filter(own).or_else(|| ending(path)) else {
            let mut name = path.file_name().unwrap_or_default().to_owned();
            name.push(".");
            name.push(offered.extension);
            return Ok((path.with_file_name(name), offered.clone()));
        };
        let form = self.forms.iter().find(|form| form.extension.eq_ignore_ascii_case(typed));
        match form {
            Some(form) => Ok((path.to_owned(), form.clone())),
            None => Err(format!("Cannot write .{typed} files here; this can be saved as {}.", self.endings())),
        }
    }

    pub fn endings(&self) -> String {
        let endings: Vec<String> = self.forms.iter().map(|form| format!(".{}", form.extension)).collect();
        match endings.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, before)) => format!("{} or {last}", before.join(", ")),
            None => String::new(),
        }
    }

    /// A typed path that ends as this can be saved, without that ending.
    pub(super) fn stem_of<'a>(&self, path: &'a str) -> Option<&'a str> {
        let (stem, own) = path.trim_end().rsplit_once('.')?;
        self.forms.iter().any(|form| form.extension.eq_ignore_ascii_case(own)).then_some(stem)
    }

    pub(super) fn extension(&self) -> &'static str {
        self.forms.first().map_or("", |form| form.extension)
    }
}

/// The ending that names a kind of file. A number (`figure 2.1`) and words (`Dr. Smith`) are part of the name.
fn ending(path: &Path) -> Option<&str> {
    let ending = path.extension().and_then(OsStr::to_str)?;
    let is_kind = ending.chars().all(|c| c.is_ascii_alphanumeric()) && ending.chars().any(|c| c.is_ascii_alphabetic());
    (is_kind && ending.len() <= 8).then_some(ending)
}
