//! Reading of files that arguments name, by the options that say what their values are.

use std::fmt::Display;
use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use clap::ValueEnum;
use spectral_file::{Certainty, MAX_BYTES, ReadError, SpectralFile, Values, Warning};

use super::error::{CliError, Result};
use super::outputs::is_descriptor;
use crate::catalog::import::{Origin, imported};
use crate::document::imported::{ImportOverrides, ImportedSet, Role};
use crate::format::{display_path, io_reason};
use crate::hosted;

/// Response basis of sensitivities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Per {
    /// Equal energy at each wavelength
    Energy,
    /// Equal numbers of photons at each wavelength
    Photon,
}

/// Options that hold for all files.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    pub(super) values: Option<Values>,
    pub(super) per: Option<Per>,
}

/// A file's set, and what had to be guessed.
pub(super) struct Read {
    pub(super) set: ImportedSet,
    pub(super) remarks: Vec<String>,
}

impl Reading {
    pub(super) fn file(self, path: &Path, role: Role) -> Result<Read> {
        let bytes = read(path).map_err(|error| in_file(path, io_reason(&error)))?;
        self.bytes(path, &bytes, role)
    }

    pub(super) fn bytes(self, path: &Path, bytes: &[u8], role: Role) -> Result<Read> {
        let file = display_path(path);
        let mut overrides = ImportOverrides::for_role(Some(role));
        overrides.options.values = self.values.filter(|_| role.is_fraction());
        let origin = Origin::on_disk(&file, path, bytes);
        let unread = |error: ReadError| CliError::unread(format!("{file}: {error}"), &error);
        let table = spectral_file::read(origin.source(bytes), &overrides.options).map_err(unread)?;
        let mut remarks: Vec<String> = check_quantity(&file, role, &table)?.into_iter().collect();
        let table = table.usable().map_err(unread)?;
        check_channels(&file, role, &table)?;
        overrides.taken = Some((0..table.curves.len()).collect());
        if role == Role::Camera {
            overrides.per_photon = self.per.map(|per| per == Per::Photon);
        }
        let imported = imported(&origin, &table, &overrides);
        if imported.guessed || !table.warnings.is_empty() {
            let words = imported.message.strip_prefix(&*file).and_then(|rest| rest.strip_prefix(": "));
            remarks.push(words.unwrap_or(&imported.message).to_owned());
        }
        let response = table.reading.per_photon.as_ref().filter(|_| role == Role::Camera && self.per.is_none());
        if let Some(response) = response.filter(|response| response.certainty == Certainty::Guess) {
            let what = if response.value { "photon" } else { "energy" };
            remarks.push(format!("assumed to be responses per {what}; set --per energy or --per photon"));
        }
        Ok(Read { set: imported.set, remarks })
    }
}

/// Reason that a file is of no use, after its path.
pub(super) fn in_file(path: &Path, why: impl Display) -> CliError {
    CliError::File(format!("{}: {why}", display_path(path)))
}

/// A file's bytes, truncated just beyond the limit if it is too large. Pipes, sockets and devices are rejected, as in a folder:
/// they may never end. File descriptors opened by the shell (`<(...)`) are read.
pub(super) fn read(path: &Path) -> io::Result<Vec<u8>> {
    if let Some(bytes) = hosted::bytes(path) {
        return Ok(bytes.to_vec());
    }
    let known = fs::metadata(path)?;
    if !(known.is_file() || known.is_dir() || is_shells(path, &known)) {
        let why = "named pipes, sockets and devices are not supported; redirect to standard input and use \
                   /dev/stdin, or `-` with inspect";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    if known.is_file() && known.len() > MAX_BYTES as u64 {
        let megabytes = known.len().div_ceil(1 << 20) as usize;
        return Err(io::Error::other(ReadError::TooLarge { megabytes, limit: MAX_BYTES >> 20 }));
    }
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// True if a path is a pipe that the shell holds open for this command.
#[cfg(unix)]
fn is_shells(path: &Path, known: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    (is_descriptor(path) || path == Path::new("/dev/stdin")) && known.file_type().is_fifo()
}

#[cfg(not(unix))]
fn is_shells(_: &Path, _: &fs::Metadata) -> bool {
    false
}

/// Rejects a file that states another quantity than its option takes, values of unknown scale, and values that no such quantity has;
/// reports the use of a file that states none.
fn check_quantity(path: &str, role: Role, table: &SpectralFile) -> Result<Option<String>> {
    let refuse = |why: String| Err(CliError::File(format!("{path}: {why}")));
    let content = &table.reading.content_role;
    let other = content.value != role && !(content.value.is_fraction() && role.is_fraction());
    if other && content.certainty == Certainty::Certain && content.value != Role::Unknown {
        let option = match content.value {
            Role::Camera => "--camera",
            Role::Reflectance => "--chart",
            Role::Transmittance => "--filter",
            Role::Illuminant | Role::Unknown => "--illuminant, or patches --radiance for measured radiances",
        };
        let quantity = table.warnings.iter().find_map(|warning| match warning {
            Warning::OtherQuantity { quantity, .. } => Some(quantity.to_string()),
            _ => None,
        });
        let stated = quantity.unwrap_or_else(|| content.value.to_string());
        let why = spectral_file::lowered(&content.why);
        return refuse(format!("the file states {stated}, not {role} ({why}); use {option}, or correct its header"));
    }
    let values = &table.reading.values;
    if role.is_fraction() && values.certainty == Certainty::Open {
        let remedy = if role == Role::Transmittance {
            "state it in the file, such as Transmittance (%)"
        } else {
            "add --values percent, or --values plain for fractions"
        };
        return refuse(format!("{}; {remedy}", values.why));
    }
    if other && content.certainty != Certainty::Certain {
        let why = match content.certainty {
            Certainty::Guess => format!("{}, which suggests {}", content.why, content.value),
            _ => "the file does not state its quantity".to_owned(),
        };
        return Ok(Some(format!("{why}; used as {role} because of the option")));
    }
    Ok(None)
}

/// Refuses sensitivities of which nothing says which are red, green and blue.
fn check_channels(path: &str, role: Role, table: &SpectralFile) -> Result<()> {
    let count = table.curves.len();
    if role != Role::Camera || count <= 3 || table.reading.camera_columns.is_some() {
        return Ok(());
    }
    let why = "red, green and blue are not identified; name the columns red, green and blue, or keep three";
    Err(CliError::File(format!("{path}: {count} curves; {why}")))
}

/// True if a file holds as many curves as its use takes.
pub(super) fn check_curves(set: &ImportedSet) -> Result<()> {
    let wanted = match set.role {
        Role::Camera if set.curves.len() < 3 => "expected three for a camera: red, green and blue",
        Role::Transmittance if set.curves.len() > 1 => "expected exactly one curve for a filter",
        Role::Illuminant if set.curves.len() > 1 => "expected exactly one curve for an illuminant",
        _ => return Ok(()),
    };
    let count = match set.curves.len() {
        1 => "1 curve".to_owned(),
        n => format!("{n} curves"),
    };
    Err(CliError::File(format!("{}: {count}; {wanted}", set.file)))
}
