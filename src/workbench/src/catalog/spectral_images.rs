//! Spectral images on disk: a header and its data file, or one OpenEXR file.

use std::fs::{self, File};
use std::hash::{Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use chromascope_core::render::{BandWeights, LitSamples, SpectralImageError, SpectralImageSignals, Stop};
use spectral_image::{EnviHeader, EnviImage, ExrImage, ImageError, ImageInfo, ImageQuantity, SpectralImage};

use super::file_store::{FileState, FileStore, FromFile, Stamp};
use crate::document::render::MeshChoice;
use crate::format::{file_name, io_reason};

/// Endings in the dialog that opens files.
pub const ENDINGS: [&str; 6] = ["hdr", "img", "bil", "bip", "bsq", "exr"];
/// Maximum bytes of samples in memory.
const TILE_BYTES: usize = 16 << 20;
/// Most pixels of an image: the signals of each sensor take 12 bytes a pixel.
const MOST_PIXELS: usize = 40_000_000;

const MAX_HEADER: u64 = 16 << 20;
/// Extensions of a header's data file.
const DATA: [&str; 9] = ["img", "dat", "raw", "bil", "bip", "bsq", "bin", "cube", "sli"];

#[derive(Debug, thiserror::Error)]
pub enum OpenImageError {
    #[error("{}: {}", path.display(), crate::format::io_reason(error))]
    Io { path: PathBuf, error: io::Error },
    #[error("{}: no data beside this header; expected {} or that name with .img, .dat, .bil, .bip or .bsq", header.display(), data.display())]
    NoData { header: PathBuf, data: PathBuf },
    #[error("{}: no header beside these data; expected {}", data.display(), header.display())]
    NoHeader { data: PathBuf, header: PathBuf },
    #[error("{}: {error}", path.display())]
    Image { path: PathBuf, error: ImageError },
}

/// A spectral image whose rows are read from disk when requested.
pub type ImageOnDisk = SpectralImage<File>;

/// Opens an ENVI header (or its data) or an OpenEXR file. `wanted` chooses where an OpenEXR has both radiance and reflectance.
pub fn open(path: &Path, wanted: Option<ImageQuantity>) -> Result<ImageOnDisk, OpenImageError> {
    if has_ending(path, "exr") {
        let image = ExrImage::new(opened(path)?, wanted);
        return image.map(SpectralImage::Exr).map_err(|error| OpenImageError::Image { path: path.to_owned(), error });
    }
    let header = if has_ending(path, "hdr") { path.to_owned() } else { header_of(path)? };
    if length_of(&header)? > MAX_HEADER {
        return Err(OpenImageError::Image { path: header, error: ImageError::NotEnvi });
    }
    let bytes = fs::read(&header).map_err(io_error(&header))?;
    let parsed = EnviHeader::parse(&bytes).map_err(|error| OpenImageError::Image { path: header.clone(), error })?;
    let data = if has_ending(path, "hdr") { data_of(&header)? } else { path.to_owned() };
    let image = EnviImage::new(parsed, opened(&data)?);
    image.map(SpectralImage::Envi).map_err(|error| OpenImageError::Image { path: data, error })
}

/// True if a path names a spectral image: by its ending, or by the header beside it.
pub fn is_spectral_image(path: &Path) -> bool {
    let is_data = || DATA.iter().any(|ending| has_ending(path, ending));
    has_ending(path, "hdr") || has_ending(path, "exr") || (is_data() && header_of(path).is_ok())
}

/// True for an OpenEXR, unless its header says that it has no spectral channels: a picture.
pub fn is_spectral_exr(path: &Path) -> bool {
    let is_plain = || matches!(open(path, None), Err(OpenImageError::Image { error: ImageError::NoSpectrum, .. }));
    has_ending(path, "exr") && !is_plain()
}

pub fn has_image_ending(path: &Path) -> bool {
    ENDINGS.iter().any(|ending| has_ending(path, ending))
}

/// True if two paths name one image: its header and its data.
pub fn is_same_image(a: &Path, b: &Path) -> bool {
    let header = |path: &Path| if has_ending(path, "hdr") { Some(path.to_owned()) } else { header_of(path).ok() };
    a == b || (!has_ending(a, "exr") && header(a).is_some() && header(a) == header(b))
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

fn opened(path: &Path) -> Result<File, OpenImageError> {
    length_of(path)?;
    File::open(path).map_err(io_error(path))
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> OpenImageError {
    move |error| OpenImageError::Io { path: path.to_owned(), error }
}

/// Length of a file; an error for pipes, sockets and devices, which may never end.
fn length_of(path: &Path) -> Result<u64, OpenImageError> {
    let other = || io::Error::new(io::ErrorKind::InvalidInput, "not a file; copy what it delivers to one first");
    let length = fs::metadata(path).and_then(|known| if known.is_file() { Ok(known.len()) } else { Err(other()) });
    length.map_err(io_error(path))
}

/// Header of some data: `cube.img.hdr` or `cube.hdr`.
fn header_of(data: &Path) -> Result<PathBuf, OpenImageError> {
    let mut appended = data.as_os_str().to_owned();
    appended.push(".hdr");
    let names = [data.with_extension("hdr"), PathBuf::from(appended)];
    let found = names.iter().find(|name| name.is_file());
    let [header, _] = &names;
    found.cloned().ok_or_else(|| OpenImageError::NoHeader { data: data.to_owned(), header: header.clone() })
}

/// Data of a header: its name without `.hdr`, as it is or with a usual ending, small or capital.
fn data_of(header: &Path) -> Result<PathBuf, OpenImageError> {
    let stem = header.with_extension("");
    let mut names = vec![stem.clone()];
    for ending in DATA {
        names.extend([header.with_extension(ending), header.with_extension(ending.to_uppercase())]);
    }
    let found = names.into_iter().find(|name| name.is_file());
    found.ok_or(OpenImageError::NoData { header: header.to_owned(), data: stem })
}

/// Share of an image's rows that were read, shared with the reading thread.
#[derive(Clone, Debug, Default)]
pub struct RowsRead(Arc<AtomicU32>);

impl RowsRead {
    pub fn share(&self) -> f32 {
        f32::from_bits(self.0.load(Ordering::Relaxed))
    }

    fn set(&self, share: f32) {
        self.0.store(share.to_bits(), Ordering::Relaxed);
    }
}

/// Progress is no part of what is asked.
impl PartialEq for RowsRead {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for RowsRead {}

impl Hash for RowsRead {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}

/// A spectral image on disk as a part of questions: equal while its files are as they were.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ImageSource {
    /// Header, data or OpenEXR file.
    pub path: PathBuf,
    pub version: [Stamp; 2],
    pub rows: RowsRead,
}

/// Header of a spectral image; its samples stay on disk.
#[derive(Clone, Debug)]
pub struct LoadedImage {
    pub source: ImageSource,
    pub info: ImageInfo,
    /// The file's name, size and bands.
    pub summary: String,
}

impl LoadedImage {
    /// The summary with what was decided on reading, in full sentences.
    pub fn message(&self) -> String {
        let notes = self.info.notes.iter().map(|note| format!(" {}.", crate::format::capitalized(&note.to_string())));
        format!("{}.{}", self.summary, notes.collect::<String>())
    }
}

pub type ImageStore = FileStore<LoadedImage>;
pub type ImageState = FileState<LoadedImage>;

pub fn load(path: &Path) -> Result<LoadedImage, OpenImageError> {
    let version = version(path)?;
    let image = open(path, None)?;
    let info = image.info().clone();
    let nm = &info.wavelengths_nm;
    let summary = format!(
        "{}: {} × {} pixels, {} bands, {} to {} nm",
        file_name(path),
        info.width,
        info.height,
        nm.len(),
        crate::format::number(nm.first().copied().unwrap_or_default()),
        crate::format::number(nm.last().copied().unwrap_or_default()),
    );
    Ok(LoadedImage { source: ImageSource { path: path.to_owned(), version, rows: RowsRead::default() }, info, summary })
}

fn version(path: &Path) -> Result<[Stamp; 2], OpenImageError> {
    let stamp = |path: &Path| Ok(Stamp::of(&fs::metadata(path).map_err(io_error(path))?));
    if has_ending(path, "exr") {
        return Ok([stamp(path)?; 2]);
    }
    if has_ending(path, "hdr") {
        let header = stamp(path)?;
        return Ok([header, stamp(&data_of(path)?)?]);
    }
    let data = stamp(path)?;
    Ok([stamp(&header_of(path)?)?, data])
}

impl ImageStore {
    /// Returns the image of a document, once its header was read.
    pub fn chosen(&self, choice: &MeshChoice) -> Option<Arc<LoadedImage>> {
        let MeshChoice::Image(path) = choice else { return None };
        match self.get(path) {
            FileState::Ready(image) => Some(image),
            FileState::Loading | FileState::Failed(_) => None,
        }
    }
}

impl FromFile for LoadedImage {
    type Failure = String;
    type Version = [Stamp; 2];
    const THREAD: &'static str = "spectral images";

    fn read_unless(
        path: &Path,
        unless: Option<[Stamp; 2]>,
        _: &dyn Fn() -> bool,
    ) -> Result<Option<(Self, [Stamp; 2])>, String> {
        let failed = |error| failure(path, &error);
        let version = version(path).map_err(failed)?;
        if unless == Some(version) {
            return Ok(None);
        }
        let image = load(path).map_err(failed)?;
        Ok(Some((image, version)))
    }

    fn bytes(&self) -> usize {
        self.info.wavelengths_nm.len() * size_of::<f64>()
    }

    fn summary(&self) -> &str {
        &self.summary
    }

    fn on_opening(failure: &String) -> String {
        format!("{failure}. Nothing was changed.")
    }

    fn picture_message(failure: &String) -> String {
        format!("{failure}. Open it from where it is now, or choose a mesh.")
    }
}

/// Reason that a spectral image cannot be shown, as the beginning of a sentence.
fn failure(path: &Path, error: &OpenImageError) -> String {
    match error {
        OpenImageError::Io { path, error } if error.kind() == io::ErrorKind::NotFound => {
            let folder = path.parent().map_or_else(String::new, |folder| folder.display().to_string());
            format!("{} is not in {folder}", file_name(path))
        }
        OpenImageError::Io { path, error } => format!("{}: {}", file_name(path), io_reason(error)),
        OpenImageError::Image { error, .. } => format!("{}: {error}", file_name(path)),
        other => other.to_string(),
    }
}

#[derive(Debug, thiserror::Error)]
pub enum ReadSignalsError {
    #[error(transparent)]
    Open(#[from] OpenImageError),
    #[error(transparent)]
    Read(#[from] ImageError),
    #[error(transparent)]
    Image(#[from] SpectralImageError),
    #[error("{0} million pixels; the limit is {limit} million, so cut or bin the image", limit = MOST_PIXELS / 1_000_000)]
    Pixels(usize),
    #[error("no pixel has a value in every band")]
    Empty,
    #[error("the file changed while it was visible; open it again")]
    Changed,
    #[error("stopped")]
    Stopped,
}

/// Signals of sensors at the pixels of an image that have values.
#[derive(Clone, Debug)]
pub struct ReadSignals {
    pub placed: Arc<LitSamples>,
    pub signals: Vec<Vec<[f32; 3]>>,
    /// Maximum bytes of samples in memory.
    pub tile_bytes: usize,
}

/// Reads an image a few rows at a time, every `step`-th row and pixel of it, divided by `scale`.
pub fn read_signals(
    image: &mut ImageOnDisk,
    weights: BandWeights,
    (step, scale): (usize, f64),
    rows_read: &RowsRead,
    stop: &Stop,
) -> Result<ReadSignals, ReadSignalsError> {
    let info = image.info().clone();
    let [width, height] = [info.width, info.height].map(|side| side.div_ceil(step));
    if width * height > MOST_PIXELS {
        return Err(ReadSignalsError::Pixels((width * height).div_ceil(1_000_000)));
    }
    let mut signals = SpectralImageSignals::new(weights, width, height)?;
    // Between rows that are skipped there is only one to be read at a time.
    let rows = if step == 1 { info.rows_within(TILE_BYTES) } else { 1 };
    let factor = scale.recip() as f32;
    let mut tile = Vec::new();
    rows_read.set(0.0);
    for first in (0..info.height).step_by(rows.max(step)) {
        if stop.is_set() {
            return Err(ReadSignalsError::Stopped);
        }
        image.read_rows(first..(first + rows).min(info.height), &mut tile)?;
        if step > 1 {
            keep_every(step, info.wavelengths_nm.len(), &mut tile);
        }
        if scale != 1.0 {
            for sample in &mut tile {
                *sample *= factor;
            }
        }
        signals.push(&tile);
        rows_read.set((first + rows) as f32 / info.height as f32);
    }
    rows_read.set(1.0);
    let (placed, signals) = signals.finish();
    if placed.samples().is_empty() {
        return Err(ReadSignalsError::Empty);
    }
    Ok(ReadSignals { placed, signals, tile_bytes: tile.capacity() * size_of::<f32>() })
}

/// Keeps every `step`-th pixel of a row.
fn keep_every(step: usize, bands: usize, row: &mut Vec<f32>) {
    let kept = (row.len() / bands).div_ceil(step);
    for pixel in 1..kept {
        let from = pixel * step * bands;
        row.copy_within(from..from + bands, pixel * bands);
    }
    row.truncate(kept * bands);
}

impl ImageSource {
    /// Opens the image, if its files are as they were.
    pub fn open(&self, wanted: Option<ImageQuantity>) -> Result<ImageOnDisk, ReadSignalsError> {
        if version(&self.path)? != self.version {
            return Err(ReadSignalsError::Changed);
        }
        Ok(open(&self.path, wanted)?)
    }

    /// Wavelengths in nanometers and samples of a pixel, right and down.
    pub fn spectrum(
        &self,
        wanted: Option<ImageQuantity>,
        [x, y]: [usize; 2],
    ) -> Result<Vec<[f64; 2]>, ReadSignalsError> {
        let mut image = self.open(wanted)?;
        let mut row = Vec::new();
        image.read_rows(y..y + 1, &mut row)?;
        let nm = &image.info().wavelengths_nm;
        let samples = row.chunks_exact(nm.len()).nth(x).unwrap_or_default();
        Ok(nm.iter().zip(samples).map(|(nm, sample)| [*nm, f64::from(*sample)]).collect())
    }
}
