//! Saving: the forms something can be written in, and which of them a path requests by its ending.

use std::ffi::OsStr;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::document::SessionFile;
use crate::document::imported::Fingerprint;

/// Makes the text of a session; the error is a message.
pub type MakeText = Arc<dyn Fn() -> Result<String, String> + Send + Sync>;

/// A form in which something can be written. Its bytes are made only when it is.
#[derive(Clone)]
pub struct FileForm {
    /// The ending of such files.
    pub extension: &'static str,
    pub(super) make: Arc<dyn Fn() -> Result<Vec<u8>, String> + Send + Sync>,
}

impl FileForm {
    /// A format whose bytes are computed on demand, in the background; the error is a message.
    pub fn new(extension: &'static str, make: impl Fn() -> Result<Vec<u8>, String> + Send + Sync + 'static) -> Self {
        Self { extension, make: Arc::new(make) }
    }

    /// A form whose bytes are there.
    pub fn of_bytes(extension: &'static str, bytes: Vec<u8>) -> Self {
        Self::new(extension, move || Ok(bytes.clone()))
    }
}

impl fmt::Debug for FileForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FileForm").field(&self.extension).finish()
    }
}

/// Something to save where the user says.
#[derive(Clone, Debug)]
pub struct SaveRequest {
    /// Its description, for the save prompt: `Nikon D70 as CSV, as measured`.
    pub what: String,
    /// The name offered.
    pub name: String,
    /// The forms it can be written in, the offered one first. The ending of the path decides.
    pub forms: Vec<FileForm>,
    /// Remark after saving: how the contents differ from the program's. May be empty.
    pub note: String,
}

impl SaveRequest {
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

    /// The supported extensions, in words.
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

    /// The ending offered.
    pub(super) fn extension(&self) -> &'static str {
        self.forms.first().map_or("", |form| form.extension)
    }
}

/// A file by its absolute path, as it was just written.
pub(super) fn written(path: &Path, bytes: &[u8]) -> SessionFile {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    SessionFile { path, fingerprint: Fingerprint::of(bytes) }
}

/// The ending that names a kind of file. A number (`figure 2.1`) and words (`Dr. Smith`) are part of the name.
fn ending(path: &Path) -> Option<&str> {
    let ending = path.extension().and_then(OsStr::to_str)?;
    let is_kind = ending.chars().all(|c| c.is_ascii_alphanumeric()) && ending.chars().any(|c| c.is_ascii_alphabetic());
    (is_kind && ending.len() <= 8).then_some(ending)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request() -> SaveRequest {
        let forms = ["svg", "png", "csv"].map(|ending| FileForm::of_bytes(ending, Vec::new())).to_vec();
        SaveRequest { what: String::new(), name: "x.svg".to_owned(), forms, note: String::new() }
    }

    #[test]
    fn the_ending_decides_and_its_lack_takes_the_offered_one() {
        for (typed, path, ending) in [
            ("a.png", "a.png", "png"),
            ("/b/c.CSV", "/b/c.CSV", "csv"),
            ("plain", "plain.svg", "svg"),
            ("figure 2.1", "figure 2.1.svg", "svg"),
            ("Dr. Smith", "Dr. Smith.svg", "svg"),
            ("in.folder/x", "in.folder/x.svg", "svg"),
            ("two.pdf.png", "two.pdf.png", "png"),
        ] {
            let (to, form) = request().target(Path::new(typed)).expect("it can be written");
            assert_eq!((to, form.extension), (PathBuf::from(path), ending), "{typed}");
        }
        for typed in ["a.pdf", "b.TIFF", "c.xyz"] {
            let refused = request().target(Path::new(typed)).expect_err("it cannot be written");
            assert!(refused.contains(".svg, .png or .csv") && refused.contains(&typed[1..]), "{refused}");
        }
    }
}
