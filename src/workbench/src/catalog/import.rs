//! Import of a file's bytes as an own set, with the decisions made.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use spectral_file::{COVARIANCE, Certainty, Effect, METADATA, ReadError, Role, Source, SpectralFile, Values, Watch};

use crate::document::imported::{Fingerprint, ImportOverrides, ImportedCurve, ImportedSet, ReadAs};
use crate::hosted;

/// Key under which a file states the model of its camera as raw files call it.
pub const UNIQUE_CAMERA_MODEL: &str = "unique_camera_model";
/// Default maximum number of curves taken from a file.
pub const TAKEN_AT_FIRST: usize = 200;

#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    pub set: ImportedSet,
    /// Summary of the import in one sentence, with what the user should know first.
    pub message: String,
    /// True if something that changes numbers was guessed.
    pub guessed: bool,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    pub name: String,
    pub path: Option<PathBuf>,
    pub fingerprint: Fingerprint,
    /// Contents of the metadata file beside it; may be empty.
    pub metadata: Arc<[u8]>,
    /// Contents of the file with the covariance beside it; may be empty.
    pub covariance: Arc<[u8]>,
}

impl Origin {
    pub fn named(name: &str, bytes: &[u8]) -> Self {
        let (metadata, covariance) = (Arc::default(), Arc::default());
        Self { name: name.to_owned(), path: None, fingerprint: Fingerprint::of(bytes), metadata, covariance }
    }

    pub fn on_disk(name: &str, path: &Path, bytes: &[u8]) -> Self {
        /// Room for the most samples that are read, with 24 characters for each number.
        const MOST_OF_COVARIANCE: u64 = 64 << 20;
        const MOST_OF_METADATA: u64 = 1 << 20;
        let [covariance, metadata @ ..] = companions(path);
        let covariance = contents(&covariance, MOST_OF_COVARIANCE).unwrap_or_default().into();
        let metadata = metadata.iter().find_map(|path| contents(path, MOST_OF_METADATA)).unwrap_or_default().into();
        Self { path: Some(path.to_owned()), metadata, covariance, ..Self::named(name, bytes) }
    }

    /// The bytes with what stands beside them, for the reader.
    pub fn source<'a>(&'a self, bytes: &'a [u8]) -> Source<'a> {
        let path = self.path.as_deref().and_then(Path::to_str).unwrap_or(&self.name);
        Source { bytes, path, metadata: &self.metadata, covariance: &self.covariance }
    }
}

/// Places of the files beside a table: its covariance, then its metadata.
pub fn companions(table: &Path) -> [PathBuf; 3] {
    let [first, second] = METADATA.map(|ending| {
        let mut name = table.as_os_str().to_owned();
        name.push(ending);
        PathBuf::from(name)
    });
    [table.with_extension(COVARIANCE), first, second]
}

fn contents(path: &Path, most_bytes: u64) -> Option<Vec<u8>> {
    if let Some(bytes) = hosted::bytes(path) {
        return Some(bytes.to_vec());
    }
    let known = fs::metadata(path).ok()?;
    if known.is_file() && known.len() <= most_bytes { fs::read(path).ok() } else { None }
}

/// Reads a file's bytes; `file` names it. A role that is given is not guessed.
pub fn import(file: &str, bytes: &[u8], role: Option<Role>) -> Result<Imported, ReadError> {
    import_as(&Origin::named(file, bytes), bytes, &ImportOverrides::for_role(role), Watch::none())
}

/// Reads bytes with the user's overrides; the watch may stop it.
pub fn import_as(
    origin: &Origin,
    bytes: &[u8],
    overrides: &ImportOverrides,
    watch: Watch<'_>,
) -> Result<Imported, ReadError> {
    let table = spectral_file::read_watched(origin.source(bytes), &overrides.options, watch)?.usable()?;
    Ok(imported(origin, &table, overrides))
}

/// Import of a table that was read with the options of these overrides.
pub fn imported(origin: &Origin, table: &SpectralFile, overrides: &ImportOverrides) -> Imported {
    let guesses: Vec<_> = weighty_guesses(table);
    let file = &origin.name;
    let mut message = format!("{file}: {}", summary(table));
    let taken = taken(table, overrides);
    if taken.len() < table.curves.len() {
        message = format!("{message} {} of them are imported; choose in Data.", taken.len());
    }
    if let Some(guess) = guesses.iter().find(|guess| guess.effect == Effect::Scale).or_else(|| guesses.first()) {
        let choose = if guess.certainty == Certainty::Open { " Choose in Data." } else { "" };
        message = format!("{message} {guess}{choose}");
    }
    if table.role.value == Role::Camera && table.reading.camera_columns.is_none() && table.curves.len() > 3 {
        message = format!("{message} Its first three curves are used as red, green and blue; choose in Data.");
    }
    if let Some(warning) = table.warnings.first() {
        message = format!("{message} {warning}");
    }
    Imported { message, guessed: !guesses.is_empty(), set: own_set(origin, table, overrides, &taken) }
}

/// Guesses and open decisions that change values or the use of a set.
pub fn weighty_guesses(table: &SpectralFile) -> Vec<spectral_file::Decision> {
    let decisions = table.decisions().into_iter();
    decisions.filter(|decision| decision.certainty.is_doubtful() && decision.effect != Effect::Report).collect()
}

/// Indices of the curves to import: those chosen, which may be none, else the first of the table.
pub fn taken(table: &SpectralFile, overrides: &ImportOverrides) -> Vec<usize> {
    let count = table.curves.len();
    if let Some(chosen) = &overrides.taken {
        let taken: Vec<usize> = chosen.iter().copied().filter(|index| *index < count).collect();
        // If none of the chosen curves exists any more, the choice is void.
        if !taken.is_empty() || chosen.is_empty() {
            return taken;
        }
    }
    (0..count.min(TAKEN_AT_FIRST)).collect()
}

/// Number of curves of what, over which range.
fn summary(table: &SpectralFile) -> String {
    let [first, last] = table.reading.range_nm;
    let count = table.curves.len();
    let curves = if count == 1 { "1 curve".to_owned() } else { format!("{count} curves") };
    format!("{curves}, {}, {first}–{last} nm.", table.role.value)
}

fn own_set(origin: &Origin, table: &SpectralFile, overrides: &ImportOverrides, taken: &[usize]) -> ImportedSet {
    let title = table.reading.comment("title").map(str::trim).filter(|title| !title.is_empty());
    let stem = || Path::new(&origin.name).file_stem().map_or(origin.name.clone(), |s| s.to_string_lossy().into_owned());
    let mut name = spectral_file::on_one_line(&title.map_or_else(stem, str::to_owned)).into_owned();
    if let Some(part) = part_name(table, overrides) {
        name = format!("{name}, {part}");
    }
    let alone = table.curves.len() == 1;
    let curves = taken.iter().filter_map(|&index| table.curves.get(index)).map(|curve| ImportedCurve {
        // The file's name says more about its only curve than "Column 2" does.
        name: if alone && !curve.named { name.clone() } else { curve.name.clone() },
        wavelengths: curve.wavelengths_nm.clone(),
        values: curve.values.clone(),
        unit: curve.unit.clone(),
        uncertainty: curve.uncertainty.clone(),
        unknown: serde_json::Map::new(),
    });
    let unit = table.reading.wavelength_unit.value;
    let percent = table.reading.values.value == Values::Percent;
    let mut decisions: Vec<String> =
        table.decisions().iter().map(|decision| format!("{} ({})", decision, decision.certainty)).collect();
    decisions.extend(table.warnings.iter().map(ToString::to_string));
    let per_photon = || table.reading.per_photon.as_ref().is_some_and(|decided| decided.value);
    ImportedSet {
        curves: curves.collect(),
        covariance: table.covariance.as_ref().and_then(|all| all.among(&samples(table, taken))),
        name,
        file: origin.name.clone(),
        path: origin.path.clone(),
        measured: None,
        model: table.reading.comment(UNIQUE_CAMERA_MODEL).map(str::to_owned),
        fingerprint: Some(origin.fingerprint),
        overrides: overrides.clone(),
        role: table.role.value,
        read_as: ReadAs { unit, percent },
        unit,
        percent,
        per_photon: overrides.per_photon.unwrap_or_else(per_photon),
        channels: channels(table, overrides, taken),
        decisions,
    }
}

/// Indices of the samples of the curves that are taken, among those of all curves.
fn samples(table: &SpectralFile, taken: &[usize]) -> Vec<usize> {
    let of = |index: &usize| {
        let from = table.curves[..*index].iter().map(|curve| curve.values.len()).sum::<usize>();
        from..from + table.curves[*index].values.len()
    };
    taken.iter().flat_map(of).collect()
}

/// Name of the part of a file that the user chose of several.
fn part_name(table: &SpectralFile, overrides: &ImportOverrides) -> Option<String> {
    let part = overrides.options.part.filter(|_| table.reading.parts.len() > 1)?;
    let known = table.reading.parts.get(part.checked_sub(1)?)?;
    Some(if known.name.is_empty() { format!("part {part}") } else { known.name.clone() })
}

/// Indices of red, green and blue among the chosen curves.
fn channels(table: &SpectralFile, overrides: &ImportOverrides, taken: &[usize]) -> [usize; 3] {
    let wanted = overrides.channels.or(table.reading.camera_columns).unwrap_or([0, 1, 2]);
    let place = |index: usize| taken.iter().position(|taken| *taken == index);
    match wanted.map(place) {
        [Some(red), Some(green), Some(blue)] => [red, green, blue],
        _ => [0, 1, 2],
    }
}
