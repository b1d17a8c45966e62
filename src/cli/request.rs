//! From arguments to a document: names and files become what is compared, under what.

use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use chromascope_core::query::Shared;
use chromascope_core::table::MAX_BYTES;
use chromascope_core::units::Kelvin;
use clap::ArgMatches;

use super::arguments::{CommonArguments, SourceArguments, Transform};
use super::{CliError, say};
use crate::catalog::import::import_warned;
use crate::catalog::names::find;
use crate::catalog::{Catalog, Entry, Kind};
use crate::document::own::{OwnSet, Role};
use crate::document::render::{LEAF, SKIN};
use crate::document::start::Start;
use crate::document::{CHART, Document, Light, REFERENCE, Subset, WayChoice, WhiteChoice};
use crate::files::reason;

/// The name of the paper's five patches as a chart of their own.
pub(super) const FIVE: &str = "ColorChecker five";

/// A document made of arguments, and the sources in the order they were named.
pub(super) struct Request {
    /// What is compared, under what.
    pub(super) document: Document,
    /// The built-in sets.
    pub(super) catalog: Catalog,
    /// The sources asked for.
    pub(super) sources: Vec<(Kind, String)>,
}

impl Request {
    /// From what both tables take. `matches` knows in which order sources were named.
    pub(super) fn new(arguments: &CommonArguments, matches: &ArgMatches) -> Result<Self, CliError> {
        let mut request = Self::of_sources(&arguments.sources, matches, Start::Paper.sensors())?;
        if let Some(illuminant) = &arguments.illuminant {
            request.set_light(illuminant)?;
        }
        Ok(request)
    }

    /// From sources and their way to the diagram; `first` are those looked through where none is named.
    pub(super) fn of_sources(
        arguments: &SourceArguments,
        matches: &ArgMatches,
        first: &[(&str, Kind)],
    ) -> Result<Self, CliError> {
        let document = Document { compared: Vec::new(), ..Document::paper() };
        let mut request = Self { document, catalog: Catalog::built_in(), sources: Vec::new() };
        request.sources = request.named_sources(arguments, matches)?;
        if request.sources.is_empty() {
            request.sources = first.iter().map(|&(name, kind)| (kind, name.to_owned())).collect();
        }
        request.set_way(arguments)?;
        Ok(request)
    }

    fn named_sources(
        &mut self,
        arguments: &SourceArguments,
        matches: &ArgMatches,
    ) -> Result<Vec<(Kind, String)>, CliError> {
        let places = |id: &str| matches.indices_of(id).into_iter().flatten().collect::<Vec<usize>>();
        let observers =
            places("observer").into_iter().zip(&arguments.observer).map(|(at, name)| (at, Kind::Observer, name));
        let cameras = places("camera").into_iter().zip(&arguments.camera).map(|(at, name)| (at, Kind::Camera, name));
        let mut named: Vec<_> = observers.chain(cameras).collect();
        named.sort_by_key(|(at, ..)| *at);
        named
            .into_iter()
            .map(|(_, kind, name)| {
                let found = if kind == Kind::Camera && is_file(name) {
                    self.open(name, Role::Camera)?.name.clone()
                } else {
                    self.name(kind, name)?
                };
                Ok((kind, found))
            })
            .collect()
    }

    fn set_way(&mut self, arguments: &SourceArguments) -> Result<(), CliError> {
        self.document.way = match (arguments.transform, &arguments.reference) {
            (Transform::Paper, None) => WayChoice::Paper,
            (Transform::Paper, Some(_)) => {
                let reason = "only a fit has a reference; add --transform observer".to_owned();
                return Err(CliError::Argument { argument: "--reference", reason });
            }
            (Transform::Observer, None) => WayChoice::Observer(REFERENCE.to_owned()),
            (Transform::Observer, Some(name)) => WayChoice::Observer(self.name(Kind::Observer, name)?),
        };
        Ok(())
    }

    /// Chooses the light.
    pub(super) fn set_light(&mut self, illuminant: &str) -> Result<(), CliError> {
        if let Some((light, kelvin)) = radiator("--illuminant", illuminant)? {
            self.document.light = if light == Radiator::Daylight { Light::Daylight } else { Light::BlackBody };
            self.document.temperature_k = kelvin;
            return Ok(());
        }
        let name = if is_file(illuminant) {
            self.open(illuminant, Role::Illuminant)?.name.clone()
        } else {
            self.name(Kind::Illuminant, illuminant)?
        };
        self.document.light = Light::Set(name);
        Ok(())
    }

    /// Chooses the patches.
    pub(super) fn set_chart(&mut self, chart: Option<&str>) -> Result<(), CliError> {
        self.document.subset = Subset::All;
        let Some(chart) = chart else { return Ok(()) };
        if is_file(chart) {
            let set = self.open(chart, Role::Reflectance)?;
            self.document.chart.clone_from(&set.name);
            return Ok(());
        }
        let found = self.chart_name(chart)?;
        if found == FIVE {
            self.document.subset = Subset::Five;
        } else {
            self.document.chart = found;
        }
        Ok(())
    }

    /// Chooses the reflectance of what is rendered.
    pub(super) fn set_material(&mut self, material: &str) -> Result<(), CliError> {
        self.document.render.material = match material.to_ascii_lowercase().as_str() {
            "skin" => SKIN.to_owned(),
            "leaf" => LEAF.to_owned(),
            _ if is_file(material) => {
                let set = self.open(material, Role::Reflectance)?;
                if let [first, _, ..] = set.curves.as_slice() {
                    let count = set.curves.len();
                    say(&format!("chromascope: {material}: {count} reflectances; taking the first, {}\n", first.name));
                }
                set.name.clone()
            }
            _ => self.name(Kind::Material, material)?,
        };
        Ok(())
    }

    /// The name of a chart or a material, or [`FIVE`].
    fn chart_name(&self, typed: &str) -> Result<String, CliError> {
        let five = self.catalog.get(Kind::Chart, CHART).map(|chart| Entry {
            name: FIVE.to_owned(),
            short: FIVE.to_owned(),
            ..chart.clone()
        });
        let sets = [Kind::Chart, Kind::Material].into_iter().flat_map(|kind| self.catalog.of_kind(kind));
        Ok(find(sets.chain(&five), "chart", typed)?.name.clone())
    }

    /// Chooses the white.
    pub(super) fn set_white(&mut self, white: &str) -> Result<(), CliError> {
        self.document.white = match radiator("--white", white)? {
            Some((Radiator::Daylight, kelvin)) => WhiteChoice::Daylight(kelvin),
            Some((Radiator::BlackBody, kelvin)) => WhiteChoice::BlackBody(kelvin),
            None if white.eq_ignore_ascii_case("unity") => WhiteChoice::Unity,
            None => WhiteChoice::Light(self.name(Kind::Illuminant, white)?),
        };
        Ok(())
    }

    /// The catalog's name for what was typed.
    fn name(&self, kind: Kind, typed: &str) -> Result<String, CliError> {
        Ok(find(self.catalog.of_kind(kind), kind.singular(), typed)?.name.clone())
    }

    /// Reads a file as a set of the document's own, under a name that no other set has; says what had to be guessed.
    fn open(&mut self, path: &str, role: Role) -> Result<Shared<OwnSet>, CliError> {
        let known = self.document.own.iter().find(|own| own.file == path && own.role == role);
        if let Some(known) = known {
            return Ok(known.clone());
        }
        let bytes = read(path).map_err(|error| CliError::File(format!("{path}: {}", reason(&error))))?;
        let (imported, warnings) =
            import_warned(path, &bytes, Some(role)).map_err(|error| CliError::File(format!("{path}: {error}")))?;
        let mut set = imported.set;
        check_curves(&set)?;
        if imported.guessed || !warnings.is_empty() {
            say(&format!("chromascope: {}\n", imported.message));
        }
        let kind = Entry::from_own(&Shared::new(set.clone())).kind;
        let taken =
            |name: &str| self.catalog.get(kind, name).is_some() || self.document.own.iter().any(|own| own.name == name);
        if taken(&set.name) {
            set.name = format!("{} ({path})", set.name);
        }
        let set = Shared::new(set);
        self.document.own.push(set.clone());
        Ok(set)
    }
}

/// A file's bytes, or of an endless one as many as show that it is too large. A named pipe would wait for somebody to write.
pub(super) fn read(path: &str) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if is_named_pipe(Path::new(path)) {
        let why = "this is a pipe, in which nothing may ever come; lead it to standard input and write - in its place";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    fs::File::open(path)?.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether a path is a pipe with a name. Those that a shell opens for a command (`<(...)`) are written by somebody.
#[cfg(unix)]
fn is_named_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    let opened = ["/dev/", "/proc/"].iter().any(|folder| path.starts_with(folder));
    !opened && fs::metadata(path).is_ok_and(|known| known.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_named_pipe(_: &Path) -> bool {
    false
}

/// Whether a file holds as many curves as its use takes.
fn check_curves(set: &OwnSet) -> Result<(), CliError> {
    let wanted = match set.role {
        Role::Camera if set.curves.len() < 3 => "a camera takes three: red, green and blue",
        Role::Illuminant if set.curves.len() > 1 => "a light is one; keep the one meant",
        _ => return Ok(()),
    };
    let count = match set.curves.len() {
        1 => "1 curve".to_owned(),
        n => format!("{n} curves"),
    };
    Err(CliError::File(format!("{}: {count}, but {wanted}", set.file)))
}

/// A light that is a formula of temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Radiator {
    Daylight,
    BlackBody,
}

/// `daylight:K` and `blackbody:K`.
fn radiator(argument: &'static str, text: &str) -> Result<Option<(Radiator, f64)>, CliError> {
    let Some((name, kelvin)) = text.split_once(':') else { return Ok(None) };
    let radiator = match name.trim().to_ascii_lowercase().as_str() {
        "daylight" => Radiator::Daylight,
        "blackbody" | "black-body" => Radiator::BlackBody,
        _ => return Ok(None),
    };
    let number = kelvin.trim().trim_end_matches(['K', 'k']).trim();
    match number.parse::<f64>().ok().and_then(|kelvin| Kelvin::new(kelvin).ok()) {
        Some(kelvin) => Ok(Some((radiator, kelvin.get()))),
        None => {
            Err(CliError::Argument { argument, reason: format!("\"{kelvin}\" is no temperature; write {name}:5500") })
        }
    }
}

/// Whether an argument means a file and not a name.
fn is_file(argument: &str) -> bool {
    let path = Path::new(argument);
    let ends_as_file = path
        .extension()
        .is_some_and(|ending| ["csv", "txt", "tsv", "dat"].iter().any(|known| ending.eq_ignore_ascii_case(known)));
    path.is_file() || ends_as_file || argument.contains(['/', '\\'])
}
