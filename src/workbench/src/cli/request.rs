//! Conversion of arguments to a document: names and files become sensors and conditions.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use chromascope_core::correction::CorrectionMethod;
use chromascope_core::query::Shared;
use chromascope_core::units::Kelvin;
use clap::ArgMatches;
use rayon::prelude::*;
use spectral_file::Values;

use super::arguments::{CommonArguments, FitArguments, SourceArguments, Transform};
use super::error::{CliError, Result, refused};
use super::reading::{Per, Read, Reading, check_curves, in_file, read};
use crate::catalog::folders::{FolderFiles, NO_SPECTRA, leave_companions_out};
use crate::catalog::names::{Found, find, telling_words};
use crate::catalog::{Catalog, Entry};
use crate::document::correction::CorrectionChoice;
use crate::document::imported::{ImportedSet, Role};
use crate::document::render::{LEAF, MeshChoice, SKIN};
use crate::document::start::Start;
use crate::document::{CHART, CIE_1931, Document, FIVE, Light, SetKind, Subset, TransformChoice, WhiteBalanceChoice};
use crate::format::{Tally, display_path, io_reason};
use crate::scene::{Caution, Scene, SceneError};
use crate::terminal::{Remarks, say};

const REFLECTANCES: [SetKind; 2] = [SetKind::Chart, SetKind::Material];

/// Document made from arguments, and the sensors in the order they were named.
pub(super) struct Request {
    pub(super) document: Document,
    pub(super) catalog: Catalog,
    pub(super) sources: Vec<(SetKind, String)>,
    pub(super) preset: Start,
    /// Quantity of the values in reflectance files, if given.
    pub(super) values: Option<Values>,
    per: Option<Per>,
    read: Vec<PathBuf>,
    remarks: Remarks,
}

impl Request {
    /// Reads the arguments that both tables take. `matches` knows in which order sensors were named.
    pub(super) fn new(arguments: &CommonArguments, matches: &ArgMatches) -> Result<Self> {
        let mut request = Self::of_sources(&arguments.sources, matches)?;
        if let Some(illuminant) = &arguments.illuminant {
            request.set_light(illuminant)?;
        }
        request.set_filters(&arguments.filter)?;
        if let Some(white) = &arguments.white {
            request.set_white(white)?;
        }
        Ok(request)
    }

    /// Reads sensors, reference and color transform; the rest is the preset's.
    pub(super) fn of_sources(arguments: &SourceArguments, matches: &ArgMatches) -> Result<Self> {
        let mut request = Self::of_preset(arguments.preset, arguments.per);
        request.sources = request.named_sources(arguments, matches)?;
        request.check_per("--camera")?;
        request.set_transform(arguments)?;
        if arguments.names_no_sensor() {
            request.sources = request.presets_sources();
        }
        Ok(request)
    }

    /// Cameras alone, under a preset.
    pub(super) fn of_cameras(
        preset: Start,
        argument: &'static str,
        cameras: &[OsString],
        per: Option<Per>,
    ) -> Result<Self> {
        let mut request = Self::of_preset(preset, per);
        let mut cameras: Vec<&OsString> = cameras.iter().collect();
        leave_companions_out(&mut cameras, |camera| Some(camera.into()), &mut Tally::default());
        for given in cameras {
            let named = request.cameras(argument, given)?.into_iter();
            request.sources.extend(named.map(|name| (SetKind::Camera, name)));
        }
        request.check_per(argument)?;
        Ok(request)
    }

    /// A preset's conditions, with nothing to compare.
    fn of_preset(preset: Start, per: Option<Per>) -> Self {
        let document = Document { compared: Vec::new(), ..preset.document() };
        let (catalog, sources, read) = (Catalog::built_in(), Vec::new(), Vec::new());
        Self { document, catalog, sources, preset, values: None, per, read, remarks: Remarks::default() }
    }

    /// Refuses a unit of sensitivities where none are from a file.
    fn check_per(&self, cameras: &str) -> Result<()> {
        if self.per.is_none() || !self.document.own.is_empty() {
            return Ok(());
        }
        refused("--per", format!("only sensitivities from a file can be taken otherwise; give {cameras} a file"))
    }

    /// The preset's sensors, with the reference that was named in the place of the preset's.
    fn presets_sources(&self) -> Vec<(SetKind, String)> {
        let mut sources = vec![(SetKind::Observer, self.document.reference.clone())];
        for (name, kind) in self.preset.sensors().iter().skip(1) {
            let sensor = (*kind, (*name).to_owned());
            if !sources.contains(&sensor) {
                sources.push(sensor);
            }
        }
        sources
    }

    /// Files that were read or are going to be: none of them may be written over.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        let mesh = match &self.document.render.mesh {
            MeshChoice::File(path) => Some(path.clone()),
            _ => None,
        };
        self.read.iter().cloned().chain(mesh).collect()
    }

    /// Reports once the reason that differences from the reference are empty or not those of the color transform alone.
    pub(super) fn say_caution(&self, scene: &Scene<'_>) -> Result<(), SceneError> {
        say_light(scene)?;
        let Some(caution) = scene.caution() else { return Ok(()) };
        let remedy = match caution {
            Caution::FitDiffers { .. } => "",
            Caution::NotComparable { .. } => {
                let comparable = self.sources.iter().map(|(kind, name)| scene.comparable(*kind, name));
                if comparable.collect::<Result<Vec<_>, _>>()?.iter().all(Result::is_ok) {
                    return Ok(());
                }
                " Their differences are left empty; add --transform fitted."
            }
        };
        say(&format!("chromascope: {}{remedy}\n", caution.sentence()));
        Ok(())
    }

    fn named_sources(&mut self, arguments: &SourceArguments, matches: &ArgMatches) -> Result<Vec<(SetKind, String)>> {
        let places = |id: &str| matches.indices_of(id).into_iter().flatten().collect::<Vec<usize>>();
        let observers = arguments.observer.iter().map(OsStr::new);
        let observers = places("observer").into_iter().zip(observers).map(|(at, name)| (at, SetKind::Observer, name));
        let cameras = arguments.camera.iter().map(OsString::as_os_str);
        let cameras = places("camera").into_iter().zip(cameras).map(|(at, name)| (at, SetKind::Camera, name));
        let mut named: Vec<_> = observers.chain(cameras).collect();
        named.sort_by_key(|(at, ..)| *at);
        // A list that the shell made of a pattern has them too.
        leave_companions_out(&mut named, |(.., name)| Some(name.into()), &mut Tally::default());
        let mut sources = Vec::new();
        for (_, kind, name) in named {
            let found = match kind {
                SetKind::Camera => self.cameras("--camera", name)?,
                _ => vec![self.name("--observer", &[kind], &name.to_string_lossy())?],
            };
            sources.extend(found.into_iter().map(|name| (kind, name)));
        }
        Ok(sources)
    }

    fn set_transform(&mut self, arguments: &SourceArguments) -> Result<()> {
        if let Some(reference) = &arguments.reference {
            self.document.reference = self.name("--reference", &[SetKind::Observer], reference)?;
        }
        let names_fit = arguments.names_fit();
        let fitted = match (arguments.transform, names_fit) {
            (Some(Transform::Paper), Some(argument)) => {
                return refused(argument, "the paper's matrix is not fitted; add --transform fitted");
            }
            (Some(transform), _) => transform == Transform::Fitted,
            (None, Some(_)) => true,
            (None, None) => self.document.transform != TransformChoice::Paper,
        };
        self.set_correction(arguments.correction.unwrap_or_default(), &arguments.fit)?;
        let reference = self.catalog.get(SetKind::Observer, &self.document.reference);
        let transform = match &arguments.fit_to {
            _ if !fitted => TransformChoice::Paper,
            Some(target) => TransformChoice::Observer(self.name("--fit-to", &[SetKind::Observer], target)?),
            None if reference.is_some_and(Entry::counts_in_xyz) => {
                TransformChoice::Observer(self.document.reference.clone())
            }
            None => TransformChoice::Observer(CIE_1931.to_owned()),
        };
        self.document.set_transform(transform);
        Ok(())
    }

    /// The name of a camera, or of the file of one; those of all files of cameras in a folder.
    fn cameras(&mut self, argument: &'static str, given: &OsStr) -> Result<Vec<String>> {
        let folder = Path::new(given);
        if !folder.is_dir() || self.catalog.get(SetKind::Camera, &given.to_string_lossy()).is_some() {
            return Ok(vec![self.set_or_file(argument, &[SetKind::Camera], Role::Camera, given)?]);
        }
        let found = FolderFiles::new(folder, &|| true);
        let FolderFiles { files, mut skipped, .. } = found.map_err(|error| in_file(folder, io_reason(&error)))?;
        let (mut names, reading) = (Vec::new(), self.reading());
        let all: Vec<Result<Read>> = files.par_iter().map(|file| reading.file(file, Role::Camera)).collect();
        for (file, read) in files.iter().zip(all) {
            self.read.push(file.clone());
            let set = match self.known(file, Role::Camera) {
                Some(known) => Ok(known),
                None => read.map(|read| self.remark(read)).and_then(|set| self.add(file, set)),
            };
            match set {
                Ok(set) => names.push(set.name.clone()),
                Err(CliError::NoSpectra(_)) => skipped.add(NO_SPECTRA, display_path(file)),
                Err(error) => skipped.add("refused", error.to_string()),
            }
        }
        let told = format!("{} of {} files used; skipped: {skipped}", names.len(), files.len());
        if names.is_empty() {
            return Err(in_file(folder, told));
        }
        if !skipped.is_empty() {
            say(&format!("chromascope: {}: {told}\n", display_path(folder)));
        }
        Ok(names)
    }

    /// The name of a set of these kinds, or of the file of one.
    fn set_or_file(&mut self, argument: &'static str, kinds: &[SetKind], role: Role, given: &OsStr) -> Result<String> {
        if self.means_file(argument, kinds, given) {
            return Ok(self.open(Path::new(given), role)?.name.clone());
        }
        match kinds {
            [SetKind::Illuminant] => self.illuminant(argument, &given.to_string_lossy()),
            _ => self.name(argument, kinds, &given.to_string_lossy()),
        }
    }

    pub(super) fn set_fit_target(&mut self, target: &str) -> Result<()> {
        let target = self.name("--fit-to", &[SetKind::Observer], target)?;
        self.document.set_transform(TransformChoice::Observer(target));
        Ok(())
    }

    pub(super) fn set_correction(&mut self, method: CorrectionMethod, fit: &FitArguments) -> Result<()> {
        let mut choice = CorrectionChoice { method, keeps_white: !fit.free_white, ..CorrectionChoice::default() };
        for (class, weight) in &fit.weights {
            choice.weights[*class as usize] = *weight;
        }
        if let Some(training) = &fit.training {
            choice.training = self.set_or_file("--training", &REFLECTANCES, Role::Reflectance, training)?;
        }
        self.document.correction = choice;
        Ok(())
    }

    pub(super) fn set_second_light(&mut self, given: &OsStr) -> Result<()> {
        self.document.correction.second_light = Some(self.light_named("--second-illuminant", given)?);
        Ok(())
    }

    /// The name of an illuminant, of the file of one, or of a formula with its temperature.
    pub(super) fn light_named(&mut self, argument: &'static str, given: &OsStr) -> Result<String> {
        match radiator(argument, &given.to_string_lossy())? {
            Some((light, kelvin)) => Ok(format!("{light} {kelvin} K")),
            None => self.set_or_file(argument, &[SetKind::Illuminant], Role::Illuminant, given),
        }
    }

    /// True if an argument is a file path. A built-in set's name refers to that set even if a file of that name exists.
    fn means_file(&self, argument: &str, kinds: &[SetKind], given: &OsStr) -> bool {
        let typed = given.to_string_lossy();
        let built_in = kinds.iter().any(|kind| self.catalog.get(*kind, &typed).is_some());
        if built_in && Path::new(given).is_file() {
            say(&format!(
                "chromascope: {argument} \"{typed}\": using the built-in data set; for the file, write ./{typed}\n"
            ));
        }
        !built_in && is_file(given)
    }

    pub(super) fn set_light(&mut self, given: &OsStr) -> Result<()> {
        if let Some((light, kelvin)) = radiator("--illuminant", &given.to_string_lossy())? {
            self.document.light = if light == "daylight" { Light::Daylight } else { Light::BlackBody };
            self.document.temperature_k = kelvin;
            return Ok(());
        }
        let name = self.set_or_file("--illuminant", &[SetKind::Illuminant], Role::Illuminant, given)?;
        self.document.light = Light::Set(name);
        Ok(())
    }

    pub(super) fn set_filters(&mut self, filters: &[OsString]) -> Result<()> {
        for given in filters {
            let name = self.set_or_file("--filter", &[SetKind::Filter], Role::Transmittance, given)?;
            if self.document.filters.contains(&name) {
                return refused("--filter", format!("{name} is there already; a filter can be used once"));
            }
            self.document.filters.push(name);
        }
        Ok(())
    }

    pub(super) fn set_chart(&mut self, chart: Option<&OsStr>) -> Result<()> {
        let Some(chart) = chart else { return Ok(()) };
        if self.means_file("--chart", &REFLECTANCES, chart) {
            self.document.subset = Subset::All;
            let set = self.open(Path::new(chart), Role::Reflectance)?;
            self.document.chart.clone_from(&set.name);
            return Ok(());
        }
        let found = self.chart_name(&chart.to_string_lossy())?;
        if found == FIVE {
            self.document.subset = Subset::Five;
            CHART.clone_into(&mut self.document.chart);
        } else {
            self.document.subset = Subset::All;
            self.document.chart = found;
        }
        Ok(())
    }

    /// The name of a reflectance of what is rendered.
    pub(super) fn material(&mut self, argument: &'static str, given: &OsStr) -> Result<String> {
        let material = &*given.to_string_lossy();
        Ok(match material.to_ascii_lowercase().as_str() {
            "skin" => SKIN.to_owned(),
            "leaf" => LEAF.to_owned(),
            _ if self.means_file(argument, &[SetKind::Material, SetKind::Chart], given) => {
                let set = self.open(Path::new(given), Role::Reflectance)?;
                if let [first, _, ..] = set.curves.as_slice() {
                    let count = set.curves.len();
                    say(&format!("chromascope: {material}: {count} reflectances; using the first, {}\n", first.name));
                }
                set.name.clone()
            }
            _ => self.name(argument, &[SetKind::Material], material)?,
        })
    }

    /// The name of a chart or a material, or [`FIVE`].
    fn chart_name(&self, typed: &str) -> Result<String> {
        let five = self.catalog.get(SetKind::Chart, CHART).map(|chart| Entry {
            name: FIVE.to_owned(),
            short: FIVE.to_owned(),
            ..chart.clone()
        });
        let sets = REFLECTANCES.into_iter().flat_map(|kind| self.catalog.of_kind(kind));
        let found = find(sets.chain(&five), "chart", typed)?;
        tell("--chart", typed, &found);
        Ok(found.entry.name.clone())
    }

    pub(super) fn set_white(&mut self, white: &str) -> Result<()> {
        self.document.white = match radiator("--white-balance", white)? {
            Some(("daylight", kelvin)) => WhiteBalanceChoice::Daylight(kelvin),
            Some((_, kelvin)) => WhiteBalanceChoice::BlackBody(kelvin),
            None if white.trim().eq_ignore_ascii_case("unity") => WhiteBalanceChoice::Unity,
            None => WhiteBalanceChoice::Light(self.illuminant("--white-balance", white)?),
        };
        Ok(())
    }

    /// The catalog's name for an illuminant. A formula without its temperature is no name for a measured set.
    fn illuminant(&self, argument: &'static str, typed: &str) -> Result<String> {
        let number = typed.trim().trim_end_matches(['K', 'k']).trim_end();
        if let Some(kelvin) = number.parse::<f64>().ok().filter(|kelvin| *kelvin >= 500.0) {
            let reason = format!(
                "\"{typed}\" is a temperature, which many lights have; write daylight:{kelvin} or blackbody:{kelvin}"
            );
            return refused(argument, reason);
        }
        let formula = match telling_words(typed).concat().as_str() {
            "daylight" => "daylight",
            "blackbody" | "planckian" | "planckianradiator" => "blackbody",
            _ => return self.name(argument, &[SetKind::Illuminant], typed),
        };
        let sets = self.catalog.of_kind(SetKind::Illuminant).map(|entry| entry.name.as_str());
        let sets: Vec<&str> = sets.filter(|name| name.to_lowercase().starts_with(formula)).collect();
        let or =
            if sets.is_empty() { String::new() } else { format!(", or the full name of a set: {}", sets.join(", ")) };
        refused(argument, format!("\"{typed}\" needs a temperature; write {formula}:5500{or}"))
    }

    /// The catalog's name for the typed one; a difference is reported.
    fn name(&self, argument: &str, kinds: &[SetKind], typed: &str) -> Result<String> {
        let sets = kinds.iter().flat_map(|kind| self.catalog.of_kind(*kind));
        let found = find(sets, kinds.first().map_or("", |kind| kind.label()), typed)?;
        tell(argument, typed, &found);
        Ok(found.entry.name.clone())
    }

    /// Reads a file as a set of the document's own, under a name that no other set has; says what had to be guessed.
    fn open(&mut self, path: &Path, role: Role) -> Result<Shared<ImportedSet>> {
        if let Some(known) = self.known(path, role) {
            return Ok(known);
        }
        let set = self.read(path, role)?;
        self.add(path, set)
    }

    /// The set of a file that was read already.
    fn known(&self, path: &Path, role: Role) -> Option<Shared<ImportedSet>> {
        let is_path = |own: &ImportedSet| own.path.as_deref().is_some_and(|own| own.as_os_str() == path.as_os_str());
        self.document.own.iter().find(|own| own.role == role && is_path(own)).cloned()
    }

    fn add(&mut self, path: &Path, mut set: ImportedSet) -> Result<Shared<ImportedSet>> {
        check_curves(&set)?;
        let kind = SetKind::of_own(&set);
        if self.document.holder_of(kind, &set.name, None, self.catalog.names()).is_some() {
            set.name = format!("{} ({})", set.name, display_path(path));
        }
        let set = Shared::new(set);
        self.document.own.push(set.clone());
        Ok(set)
    }

    pub(super) fn read(&mut self, path: &Path, role: Role) -> Result<ImportedSet> {
        self.read.push(path.to_owned());
        let read = self.reading().file(path, role)?;
        Ok(self.remark(read))
    }

    /// Reads bytes of a file with all its curves; says what had to be guessed.
    pub(super) fn read_bytes(&mut self, path: &Path, bytes: &[u8], role: Role) -> Result<ImportedSet> {
        let read = self.reading().bytes(path, bytes, role)?;
        Ok(self.remark(read))
    }

    fn reading(&self) -> Reading {
        Reading { values: self.values, per: self.per }
    }

    fn remark(&mut self, Read { set, remarks }: Read) -> ImportedSet {
        for words in &remarks {
            self.remarks.0.add(words, set.file.clone());
        }
        set
    }

    /// The bytes of a file that is then an input.
    pub(super) fn bytes(&mut self, path: &Path) -> Result<Vec<u8>> {
        self.read.push(path.to_owned());
        read(path).map_err(|error| in_file(path, io_reason(&error)))
    }
}

fn tell(argument: &str, typed: &str, found: &Found<'_>) {
    if let Some(note) = found.note() {
        say(&format!("chromascope: {argument} \"{typed}\": {note}\n"));
    }
}

/// The name of a formula for light and its temperature in kelvins, as `daylight:6504`.
fn radiator(argument: &'static str, text: &str) -> Result<Option<(&'static str, f64)>> {
    by_formula(text).map_err(|reason| CliError::Argument { argument, reason })
}

/// A light by formula, `daylight:K` or `blackbody:K`: its name and temperature in kelvins.
pub fn by_formula(text: &str) -> std::result::Result<Option<(&'static str, f64)>, String> {
    let Some((name, kelvin)) = text.split_once(':') else { return Ok(None) };
    let radiator = match name.trim().to_ascii_lowercase().as_str() {
        "daylight" => "daylight",
        "blackbody" | "black-body" => "blackbody",
        _ => return Ok(None),
    };
    let number = kelvin.trim().trim_end_matches(['K', 'k']).trim();
    match number.parse::<f64>().ok().and_then(|kelvin| Kelvin::new(kelvin).ok()) {
        Some(kelvin) => Ok(Some((radiator, kelvin.get()))),
        None => Err(format!("\"{kelvin}\" is not a temperature; write {name}:5500")),
    }
}

/// True if an argument means a file and not a name.
fn is_file(argument: &OsStr) -> bool {
    let path = Path::new(argument);
    let ends_as_file = path
        .extension()
        .is_some_and(|ending| ["csv", "txt", "tsv", "dat"].iter().any(|known| ending.eq_ignore_ascii_case(known)));
    // A name is text, so that other arguments are file paths.
    path.is_file() || ends_as_file || argument.to_str().is_none_or(|typed| typed.contains(['/', '\\']))
}

pub(super) fn say_light(scene: &Scene<'_>) -> Result<(), SceneError> {
    if let Some(caution) = scene.light_caution()? {
        say(&format!("chromascope: {caution}\n"));
    }
    Ok(())
}
