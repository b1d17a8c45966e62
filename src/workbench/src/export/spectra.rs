//! A set's curves as a file that other programs open.

use chromascope_core::query::Ask;
use chromascope_core::spectral::{Header, Response, SpectralDistribution};
use chromascope_figure::{Cell, Column, Table};
use spectral_file::write::{Beside, Content, Format, Grid, Note, Sheet, Trace, WriteError, write};

use crate::atomic::fitting;
use crate::catalog::load::{self, LoadError};
use crate::catalog::names::model_of;
use crate::catalog::{Entry, Place};
use crate::document::SetKind;
use crate::document::imported::{ImportedSet, Role, Uncertainty};

/// A format, and the wavelengths that curves are brought to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    pub format: Format,
    pub grid: Grid,
}

impl Form {
    /// All that are offered, in the order of a menu: each format, and CSV on other grids too.
    pub fn all() -> impl Iterator<Item = Self> {
        const GRIDS: [Grid; 6] =
            [Grid::Native, Grid::Step(1.0), Grid::Step(5.0), Grid::Step(10.0), Grid::Average(5.0), Grid::Average(10.0)];
        let grids = |format| &GRIDS[..if format == Format::Csv { GRIDS.len() } else { 1 }];
        Format::ALL.into_iter().flat_map(move |format| grids(format).iter().map(move |&grid| Self { format, grid }))
    }

    /// The words of a menu.
    pub fn name(self) -> String {
        match (self.format, self.grid) {
            (Format::Csv | Format::CommentedCsv, Grid::Native) => format!("{}, as measured", self.format.name()),
            (format, Grid::Native) => format.to_string(),
            (format, Grid::Step(step)) => format!("{}, every {step} nm", format.name()),
            (format, Grid::Average(step)) => format!("{}, averages over {step} nm", format.name()),
        }
    }
}

#[derive(Debug, thiserror::Error)]
pub enum SpectraError {
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    Write(#[from] WriteError),
}

#[derive(Clone, Debug, PartialEq)]
pub struct SpectraFile {
    /// The name offered for it.
    pub name: String,
    pub text: String,
    /// What is known about the set and is not in the text, for files beside it.
    pub beside: Beside,
    /// Differences from the set.
    pub notes: Vec<Note>,
}

/// True if a format suits such a set, by its kind and its number of curves.
pub fn fits(entry: &Entry, form: Form) -> Result<(), WriteError> {
    let count = match &entry.place {
        Place::BuiltIn { column: Some(_), .. } => 1,
        Place::BuiltIn { column: None, .. } => entry.header.as_ref().map_or(0, |header| header.columns.len()),
        Place::Own(set) => set.curves.len(),
    };
    // The sample values are irrelevant; a menu calls this in every frame.
    let curve = Trace { name: "", wavelengths_nm: &[400.0, 700.0], values: &[0.0, 0.0], uncertainty: None };
    let curves = vec![curve; count];
    form.format.fits(&Sheet { content: content(entry), curves: &curves, ..Sheet::default() })
}

/// Writes a set; `created` is the time of that, as in RFC 3339.
pub fn file(entry: &Entry, form: Form, ask: &impl Ask, created: Option<&str>) -> Result<SpectraFile, SpectraError> {
    let curves = curves(&entry.place, ask)?;
    let own = if let Place::Own(set) = &entry.place { Some(whole(set)) } else { None };
    let stated: Vec<Option<Uncertainty>> = own.as_ref().map_or_else(Vec::new, stated);
    let covariance = own.as_ref().and_then(ImportedSet::covariance_in_nm);
    let traces: Vec<Trace<'_>> = curves
        .iter()
        .enumerate()
        .map(|(index, (name, curve))| Trace {
            name,
            wavelengths_nm: curve.wavelengths_nm(),
            values: curve.values(),
            uncertainty: stated.get(index).and_then(Option::as_ref),
        })
        .collect();
    let (unit, comments) = match (&entry.header, &entry.place) {
        (Some(header), _) => (Some(header.unit.clone()), header_comments(entry.kind, header)),
        (None, Place::Own(set)) => (own_unit(set), own_comments(set)),
        (None, Place::BuiltIn { .. }) => (None, Vec::new()),
    };
    let (title, content, unit) = (entry.name.as_str(), content(entry), unit.as_deref());
    let covariance = covariance.as_ref();
    let sheet = Sheet { title, content, curves: &traces, covariance, unit, created, comments: &comments };
    let written = write(&sheet, form.format, form.grid)?;
    let name = fitting(&file_name(&entry.name), &format!(".{}", form.format.ending()));
    Ok(SpectraFile { name, text: written.text, beside: written.beside, notes: written.notes })
}

/// A set's curves as a table over all of their wavelengths, as measured: a cell is empty where a curve has no sample.
pub fn table(entry: &Entry, ask: &impl Ask) -> Result<Table, LoadError> {
    let curves = curves(&entry.place, ask)?;
    let mut wavelengths: Vec<f64> = curves.iter().flat_map(|(_, curve)| curve.wavelengths_nm()).copied().collect();
    wavelengths.sort_by(f64::total_cmp);
    wavelengths.dedup();
    let names = curves.iter().map(|(name, _)| name.as_str().into());
    let wavelength = Column::quantity("wavelength_nm", "wavelength", "nm");
    let mut table = Table::new(std::iter::once(wavelength).chain(names));
    for nm in wavelengths {
        let at = |curve: &SpectralDistribution| {
            let index = curve.wavelengths_nm().binary_search_by(|known| known.total_cmp(&nm)).ok()?;
            curve.values().get(index).copied()
        };
        let cells = curves.iter().map(|(_, curve)| at(curve).map_or(Cell::Empty, Cell::Number));
        table.push(std::iter::once(Cell::Number(nm)).chain(cells));
    }
    Ok(table)
}

/// All curves of a set, in nanometers and fractions, but else as measured.
fn curves(place: &Place, ask: &impl Ask) -> Result<Vec<(String, SpectralDistribution)>, LoadError> {
    match place {
        // A camera would give its red, green and blue alone.
        Place::Own(set) if set.role == Role::Camera => Ok(whole(set).curves_in_nm()?),
        place => load::curves(place, ask),
    }
}

/// A set that uses all of its curves.
fn whole(set: &ImportedSet) -> ImportedSet {
    ImportedSet { role: Role::Unknown, ..set.clone() }
}

/// Uncertainties of all curves of a set, in nanometers and fractions.
fn stated(set: &ImportedSet) -> Vec<Option<Uncertainty>> {
    let all = set.curves.iter().zip(set.uncertainties_in_nm());
    all.map(|(curve, standard)| Some(Uncertainty { standard: standard?, ..curve.uncertainty.clone()? })).collect()
}

fn content(entry: &Entry) -> Content<'_> {
    let response = match (&entry.header, &entry.place) {
        (Some(header), _) => header.response(),
        (None, Place::Own(set)) => set.response(),
        (None, Place::BuiltIn { .. }) => Response::Unknown,
    };
    match entry.kind {
        SetKind::Camera => {
            let (manufacturer, model) = maker_and_model(&entry.name);
            Content::Camera {
                channels: if let Place::Own(set) = &entry.place { set.channels } else { [0, 1, 2] },
                per_photon: match response {
                    Response::PerEnergy => Some(false),
                    Response::PerPhoton => Some(true),
                    Response::Unknown => None,
                },
                manufacturer,
                model,
            }
        }
        SetKind::Observer => Content::Observer,
        SetKind::Chart | SetKind::Material => Content::Reflectance,
        SetKind::Filter => Content::Transmittance,
        SetKind::Illuminant => Content::Illuminant,
        SetKind::Unsorted => Content::Other,
    }
}

fn header_comments(kind: SetKind, header: &Header) -> Vec<(String, String)> {
    let mut comments =
        vec![("source".to_owned(), header.source.clone()), ("license".to_owned(), header.license.clone())];
    if let Some(origin) = &header.origin {
        comments.push(("note".to_owned(), format!("Origin: {origin}.")));
    }
    comments.extend(header.notes.iter().map(|note| ("note".to_owned(), note.clone())));
    // The formats have a field for the response basis of a camera, but none for its evidence; for observers both are in
    // words.
    if let Some(response) = header.response.as_ref().filter(|_| matches!(kind, SetKind::Camera | SetKind::Observer)) {
        comments.push(("note".to_owned(), format!("Response: {response}.")));
    }
    comments
}

fn own_comments(set: &ImportedSet) -> Vec<(String, String)> {
    let mut comments = vec![("source".to_owned(), set.file.clone())];
    comments.extend(set.decisions.iter().map(|decision| ("reading".to_owned(), decision.clone())));
    comments
}

/// The unit that all curves of a set are in.
fn own_unit(set: &ImportedSet) -> Option<String> {
    let unit = set.curves.first()?.unit.as_ref()?;
    set.curves.iter().all(|curve| curve.unit.as_ref() == Some(unit)).then(|| unit.clone())
}

/// Maker and model of a camera, where its name begins with a maker. A final parenthesis distinguishes measurements, not
/// cameras.
pub(crate) fn maker_and_model(name: &str) -> (Option<&str>, Option<&str>) {
    const MAKERS: &str = "ARRI,Blackmagic,Canon,DJI,Fujifilm,Hasselblad,Kodak,Leica,Nikon,Olympus,Panasonic,Pentax,Phase One,RED,\
                          Sigma,Sony";
    let name = model_of(name).trim();
    let found = MAKERS.split(',').find_map(|maker| {
        let (start, rest) = name.split_at_checked(maker.len())?;
        (start.eq_ignore_ascii_case(maker) && rest.starts_with(' ')).then(|| (start, rest.trim()))
    });
    found.filter(|(_, model)| !model.is_empty()).unzip()
}

/// File name of a set: characters that some systems do not allow become hyphens.
fn file_name(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || ".()_ ".contains(c) { c } else { '-' };
    let name: String = name.chars().map(plain).collect();
    let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
    let name = name.trim_matches(['.', ' ', '-']);
    if name.is_empty() { "spectra".to_owned() } else { name.to_owned() }
}

/// Changes of the curves on writing, for the end of a sentence: empty if none.
pub fn notes_in_words(notes: &[Note]) -> String {
    notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}
