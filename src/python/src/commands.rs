//! Commands of the command line, with keywords for options and files by value.

use std::ffi::{CString, OsStr, OsString};
use std::path::PathBuf;
use std::sync::Arc;

use chromascope_workbench::cli::{self, Outcome};
use chromascope_workbench::hosted::{MemoryFolder, Streams, with_streams};
use clap::builder::Str;
use clap::{Arg, ArgAction, Command};
use numpy::PyUntypedArrayMethods as _;
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyString, PyTuple};
use spectral_file::write::Content;

use crate::arrays::{all_finite, apart, numbers, refused, slice};
use crate::spectra::Spectra;

/// A command with its arguments.
pub(crate) struct Call {
    command: Command,
    names: Vec<String>,
    options: Vec<OsString>,
    places: Vec<OsString>,
    folder: MemoryFolder,
    /// Number of files by value.
    count: usize,
}

/// Output and files of a command.
pub(crate) struct Answer {
    output: Vec<u8>,
    /// Files in memory, by name.
    pub(crate) files: Vec<(String, Arc<[u8]>)>,
    pub(crate) folder: MemoryFolder,
}

impl Answer {
    pub(crate) fn text(self) -> PyResult<String> {
        String::from_utf8(self.output).map_err(|_| PyValueError::new_err("the output is not text"))
    }

    pub(crate) fn bytes(self) -> Vec<u8> {
        self.output
    }
}

/// Contents of spectra that stand in the place of an option's file.
fn content(option: &str) -> Option<Content<'static>> {
    match option {
        "camera" => {
            Some(Content::Camera { channels: [0, 1, 2], per_photon: Some(false), manufacturer: None, model: None })
        }
        "illuminant" | "second-illuminant" | "second-light" | "ssi-reference" => Some(Content::Illuminant),
        "filter" => Some(Content::Transmittance),
        "curves" => Some(Content::Other),
        "chart" | "training" | "material" | "garment" => Some(Content::Reflectance),
        _ => None,
    }
}

impl Call {
    /// A command, or one below another, with the options that it knows.
    pub(crate) fn new(names: &[&str]) -> PyResult<Self> {
        let mut command = cli::command();
        for name in names {
            let below = command.find_subcommand(name).cloned();
            command = below.ok_or_else(|| refused("command", format!("no command is named \"{name}\"")))?;
        }
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        Ok(Self { command, names, options: Vec::new(), places: Vec::new(), folder: MemoryFolder::new(), count: 0 })
    }

    /// Adds an option without a value.
    pub(crate) fn switch(&mut self, long: &str) {
        self.options.push(format!("--{long}").into());
    }

    /// Adds an option with a value.
    pub(crate) fn option(&mut self, long: &str, value: impl Into<OsString>) {
        let mut option = OsString::from(format!("--{long}="));
        option.push(value.into());
        self.options.push(option);
    }

    /// Path of a file in memory that the command writes.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Adds an argument that stands by its place, in which spectra may be of a content.
    pub(crate) fn place(&mut self, value: &Bound<'_, PyAny>, option: Option<&str>) -> PyResult<()> {
        let place = self.value(option.unwrap_or("file"), value)?;
        self.places.push(place);
        Ok(())
    }

    /// Adds an option as a keyword of its name would.
    pub(crate) fn named(&mut self, long: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let value = self.value(long, value)?;
        self.option(long, value);
        Ok(())
    }

    /// Adds a table of raw values, (patches, 3), curves, or the path of a file.
    pub(crate) fn raw(&mut self, value: &Bound<'_, PyAny>) -> PyResult<()> {
        if is_path(value)? || Spectra::of("file", value)?.is_some() {
            return self.place(value, Some("curves"));
        }
        let raw = numbers::<f64>("raw values", value)?;
        let values = slice(&raw);
        all_finite("raw values", values)?;
        if raw.ndim() != 2 || raw.shape()[1] != 3 {
            return Err(refused("raw values", "expected shape (patches, 3): red, green, blue"));
        }
        let row = |[r, g, b]: &[f64; 3]| format!("{r},{g},{b}\n");
        let rows: String = values.as_chunks::<3>().0.iter().map(row).collect();
        let path = self.add("raw", format!("R,G,B\n{rows}"));
        self.places.push(path);
        Ok(())
    }

    /// Adds keywords as options: `white_balance` is `--white-balance`.
    pub(crate) fn keywords(&mut self, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
        for (key, value) in keywords.into_iter().flatten() {
            // A word of Python's own takes an underscore behind it: `from_`.
            let long = key.extract::<String>()?.trim_end_matches('_').replace('_', "-");
            if value.is_none() {
                continue;
            }
            let known = |arg: &&Arg| {
                arg.get_long() == Some(&long) || arg.get_all_aliases().is_some_and(|all| all.contains(&&*long))
            };
            let arg = self.command.get_arguments().find(known).cloned();
            let Some(arg) = arg else {
                // Refused as on the command line.
                self.option(&long, text(&value)?);
                continue;
            };
            self.keyword(&long, &arg, &value)?;
        }
        Ok(())
    }

    fn keyword(&mut self, long: &str, arg: &Arg, value: &Bound<'_, PyAny>) -> PyResult<()> {
        if let Ok(is_set) = value.cast::<PyBool>() {
            match (arg.get_action().takes_values(), is_set.is_true()) {
                (true, is_true) => self.option(long, is_true.to_string()),
                (false, true) => self.switch(long),
                (false, false) => {}
            }
            return Ok(());
        }
        let is_list = value.is_instance_of::<PyList>()
            || (value.is_instance_of::<PyTuple>() && Spectra::of(long, value)?.is_none())
            || (value.hasattr("__array__")? && !value.hasattr("wavelengths")? && value.len().is_ok());
        if !is_list {
            let value = self.value(long, value)?;
            self.option(long, value);
            return Ok(());
        }
        let parts = value.try_iter()?.map(|part| self.value(long, &part?)).collect::<PyResult<Vec<_>>>()?;
        // The corners of a chart are several values of one option.
        if arg.get_num_args().is_some_and(|count| count.min_values() > 1) {
            self.switch(long);
            self.options.extend(parts);
        } else if matches!(arg.get_action(), ArgAction::Append) && arg.get_value_delimiter().is_none() {
            for part in parts {
                self.option(long, part);
            }
        } else {
            // Sizes are written as 512x512.
            let is_size = |names: &[_]| names.iter().any(|name: &Str| ["WxH", "CxR"].contains(&name.as_str()));
            let is_size = arg.get_value_names().is_some_and(is_size);
            let parts: Vec<String> = parts.iter().map(|part| part.to_string_lossy().into_owned()).collect();
            self.option(long, parts.join(if is_size { "x" } else { "," }));
        }
        Ok(())
    }

    /// A value in the text of the command line; spectra become a file in memory.
    fn value(&mut self, long: &str, value: &Bound<'_, PyAny>) -> PyResult<OsString> {
        if is_path(value)? {
            return Ok(value.extract::<PathBuf>()?.into_os_string());
        }
        if let Some(spectra) = Spectra::of(long, value)? {
            let content = content(long).ok_or_else(|| refused(long, "spectra are not taken here; name a file"))?;
            let name = spectra.name.clone().unwrap_or_else(|| long.to_owned());
            let text = spectra.csv(&name, content)?;
            return Ok(self.add(&name, text));
        }
        if value.is_instance_of::<PyTuple>() || value.is_instance_of::<PyList>() {
            let parts = value.try_iter()?.map(|part| self.value(long, &part?)).collect::<PyResult<Vec<_>>>()?;
            return Ok(parts.join(OsStr::new(",")));
        }
        if value.extract::<f64>().is_err() {
            let expected = "expected a name, a file, a number, or an object with wavelengths and values";
            return Err(refused(long, expected));
        }
        Ok(text(value)?.into())
    }

    /// Adds a table to the files in memory.
    fn add(&mut self, name: &str, text: String) -> OsString {
        self.count += 1;
        let safe = |c: char| if c.is_alphanumeric() || " .-_()".contains(c) { c } else { '-' };
        let name: String = name.chars().take(100).map(safe).collect();
        // Two of one name are two files.
        let number = if self.count > 1 { format!(" {}", self.count) } else { String::new() };
        self.folder.add(&format!("{name}{number}.csv"), text.into_bytes()).into_os_string()
    }

    /// Runs the command without the interpreter's lock. Its remarks become warnings, its refusal an error.
    pub(crate) fn run(self, py: Python<'_>) -> PyResult<Answer> {
        let Self { names, options, places, folder, .. } = self;
        let end = (!places.is_empty()).then(|| OsString::from("--"));
        let names = std::iter::once("chromascope".to_owned()).chain(names).map(OsString::from);
        let arguments: Vec<OsString> = names.chain(options).chain(end).chain(places).collect();
        let (outcome, streams) = apart(py, || with_streams(|| cli::run(arguments)))?;
        let Streams { output, mut remarks } = streams;
        if !matches!(outcome, Outcome::Done(0)) {
            return Err(PyValueError::new_err(refusal(&folder.told(&remarks.pop().unwrap_or_default()))));
        }
        for remark in remarks {
            let words = sentence(&folder.told(&remark)).replace('\0', "");
            let words = CString::new(words).unwrap_or_default();
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &words, 1)?;
        }
        Ok(Answer { output, files: folder.files(), folder })
    }
}

/// True for a text, bytes or an object with a path.
fn is_path(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    Ok(value.is_instance_of::<PyString>() || value.hasattr("__fspath__")?)
}

fn text(value: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(value.str()?.to_str()?.to_owned())
}

/// A message without the program's name.
fn sentence(message: &str) -> String {
    message.trim().trim_start_matches("chromascope: ").to_owned()
}

/// A refusal without the usage that follows where arguments are wrong.
fn refusal(message: &str) -> String {
    let message = sentence(message);
    let message = message.strip_prefix("error: ").unwrap_or(&message);
    let end = ["\n\nUsage:", "\n\nFor more information"].iter().filter_map(|end| message.find(end)).min();
    message[..end.unwrap_or(message.len())].to_owned()
}

/// JSON as objects of Python.
pub(crate) fn loads<'py>(py: Python<'py>, json: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (json,))
}
