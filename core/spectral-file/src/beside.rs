//! Evidence beside a file: its metadata, and the names of the file and its folders.

use crate::decimal::extent;
use crate::decision::{Decided, Role, WavelengthUnit};
use crate::grid::Grid;
use crate::header_terms::XUnit;
use crate::text::{excerpt, is_one};
use crate::{header_terms, uncertainty_terms};

/// Endings, after the whole name of a table, of files with its metadata: of the CIE, and of the W3C's CSV on the Web.
pub const METADATA: [&str; 2] = ["_metadata.json", "-metadata.json"];

/// Bytes of a file, and what stands beside them, for where the file itself does not say what its curves are.
#[derive(Debug, Clone, Copy, Default)]
pub struct Source<'a> {
    /// The file's bytes.
    pub bytes: &'a [u8],
    /// The file's path; the name of the file, else that of its folder, is the reason for a guess. May be empty.
    pub path: &'a str,
    /// Contents of the file's metadata: its own name with an ending of [`METADATA`]. May be empty.
    pub metadata: &'a [u8],
    /// Contents of the file with its covariance, whose name ends in [`COVARIANCE`](crate::COVARIANCE). May be empty.
    pub covariance: &'a [u8],
}

impl<'a, T: AsRef<[u8]> + ?Sized> From<&'a T> for Source<'a> {
    fn from(bytes: &'a T) -> Self {
        Self { bytes: bytes.as_ref(), ..Self::default() }
    }
}

/// Takes what stands beside a file: names and units that its table lacks, and the role of its curves.
pub(super) fn take(source: Source<'_>, grid: &mut Grid) {
    #[cfg(feature = "json")]
    metadata::take(source.metadata, grid);
    let names: Vec<&str> = source.path.rsplit(['/', '\\']).take(LEVELS).collect();
    let stem = file_stem(source.path).map(words).unwrap_or_default();
    take_role(source.path, &stem, grid);
    let folder = names.get(1).map(|name| words(name)).unwrap_or_default();
    take_clues(&stem, &folder, grid);
    take_axis(source.path, &stem, &names, grid);
}

fn take_role(path: &str, stem: &[String], grid: &mut Grid) {
    let constants = grid.curves.iter().all(|curve| is_one(&curve.name, "n|k"));
    let names_other = grid.header.clues.material || constants;
    let fluorescence = grid.header.clues.fluorescence;
    let fits = |beside: &Decided<Role>| {
        (!constants || beside.value == Role::Unknown) && (!fluorescence || beside.value == Role::Illuminant)
    };
    // Filters and displays are of such makers too, but have not three curves.
    let is_camera = || (3..=4).contains(&grid.curves.len()) && stem.iter().any(|word| is_one(word, CAMERA_MAKERS));
    let of_maker = || {
        let why = format!("The file is named after a maker of cameras, “{}”", excerpt(file_stem(path)?));
        is_camera().then(|| Decided::guess(Role::Camera, why))
    };
    grid.beside = grid.beside.take().or_else(|| of_path(path, names_other).filter(fits)).or_else(of_maker);
}

/// Takes what the names say of the values: absorbances, uncertainties, logarithms, quantum efficiencies.
fn take_clues(stem: &[String], folder: &[String], grid: &mut Grid) {
    let role = grid.beside.as_ref().map(|beside| beside.value);
    let title = stem.join(" ");
    let says_absorbance = |words: &[String]| {
        let joined = words.concat();
        words.iter().any(|word| word.starts_with("absorban") || word == "od")
            || DENSITIES.iter().any(|density| joined.contains(density))
    };
    let is_absorbance =
        says_absorbance(stem) || says_absorbance(folder) && stem.iter().all(|word| role_of_word(word).is_none());
    let is_absorbance = is_absorbance && role == Some(Role::Transmittance);
    let other = header_terms::not_converted(&title).filter(|_| role != Some(Role::Unknown));
    let clues = &mut grid.header.clues;
    clues.absorbance = clues.absorbance.or(is_absorbance.then_some(0));
    clues.other = clues.other.or(other.map(|why| (0, why)));
    clues.uncertainties = clues.uncertainties.or(uncertainty_terms::is_title(&title).then_some(0));
    clues.quantum = role == Some(Role::Camera) && stem.iter().any(|word| is_one(word, "qe|eqe|quantum"));
}

/// Takes what the names of the file and of its folders, the nearest first, say of the axis.
fn take_axis(path: &str, stem: &[String], names: &[&str], grid: &mut Grid) {
    // Raman is a person's name, too.
    let is_user = |at: usize| names.get(at + 1).is_some_and(|above| is_one(&above.to_lowercase(), "home|users"));
    let has = |at: usize, list: &str| words(names[at]).iter().any(|word| is_one(word, list));
    let names_raman = |at: usize| !is_user(at) && has(at, "raman") && !has(at, "nir|ir|ftir|uv|vis");
    let is_raman = (0..names.len().min(LEVELS - 1)).any(names_raman);
    let header = &mut grid.header;
    let column = grid.wavelength_column.unwrap_or(1).saturating_sub(1);
    // Renishaw heads shifts as Wave.
    let is_wavelength = |name: &str| {
        let name = name.to_lowercase();
        header_terms::begins_with_wavelengths(&name) && !name.contains("number") && name.trim_matches('#') != "wave"
    };
    // Axes of Raman spectra are shifts, which number no wavelengths.
    if is_raman
        && !header.name(column).is_some_and(is_wavelength)
        && grid.unit.is_none()
        && matches!(header.x_unit, None | Some((_, XUnit::Wavelength(WavelengthUnit::Wavenumber))))
    {
        let line = header.x_unit.map_or(header.line, |(line, _)| Some(line));
        (header.x_unit, grid.label_unit) = (Some((line.unwrap_or(1), XUnit::Other)), None);
    }
    // `Au-Ovidio-eV`, `flux_angstroms`
    let infrared = || (0..names.len().min(2)).any(|at| has(at, "mir|ftir|ftirs|atr"));
    let parts = || file_stem(path).into_iter().flat_map(|stem| stem.split(|c: char| !c.is_alphanumeric()));
    if grid.unit.is_none() && header.x_unit.is_none() && grid.label_unit.is_none() {
        let angstroms = stem.iter().any(|word| is_one(word, "angstrom|angstroms")).then_some(WavelengthUnit::Angstrom);
        let unit = angstroms.or(parts().any(|part| part == "eV").then_some(WavelengthUnit::Electronvolt));
        let (low, high) = extent(grid.wavelengths.iter().copied());
        // Where nothing but infrared is measured in nanometers, they are larger.
        let numbers = low >= 390.0 && (1200.0..=5000.0).contains(&high) && infrared();
        let unit = unit.or(numbers.then_some(WavelengthUnit::Wavenumber));
        grid.unit = unit.map(|unit| Decided::guess(unit, "The file is named so"));
    }
}

/// Names of densities, joined.
const DENSITIES: [&str; 2] = ["dyedensity", "opticaldensity"];

/// Names at the end of a path that are looked at.
const LEVELS: usize = 5;

const CAMERA_MAKERS: &str =
    "canon|nikon|sony|fuji|fujifilm|olympus|pentax|leica|panasonic|hasselblad|ricoh|iphone|gopro";

fn file_stem(path: &str) -> Option<&str> {
    let file = path.rsplit(['/', '\\']).next()?;
    Some(file.rsplit_once('.').map_or(file, |(stem, _)| stem))
}

/// The role that the name of a file suggests, else that of the folder it is in, unless the file itself names something else.
fn of_path(path: &str, names_other: bool) -> Option<Decided<Role>> {
    let stem = file_stem(path)?;
    // Folders further up are of a whole project: the glass of a camera's lens is below its name, too.
    let folder = path.rsplit(['/', '\\']).skip(1).find(|name| !name.is_empty());
    let mut names = std::iter::once(("file", stem)).chain(folder.map(|name| ("folder", name)));
    let (what, name, (role, agree)) = names.find_map(|(what, name)| Some((what, name, of_name(name)?)))?;
    if what == "folder" && names_other && role != Role::Unknown {
        return None;
    }
    let name = excerpt(name);
    Some(if role == Role::Unknown {
        Decided::open(
            role,
            format!("The {what} is named “{name}”, as what has none of these roles is: optical constants, gratings"),
        )
    } else if agree {
        Decided::guess(role, format!("The {what} is named “{name}”"))
    } else {
        Decided::open(Role::Unknown, format!("The name of the {what}, “{name}”, may mean several things"))
    })
}

/// The role that the words of a name suggest; and whether they agree.
fn of_name(name: &str) -> Option<(Role, bool)> {
    const LONGEST: usize = 200;
    if name.len() > LONGEST {
        return None;
    }
    if [".n", ".k", "_k"].iter().any(|constant| name.ends_with(constant)) {
        return Some((Role::Unknown, true));
    }
    let mut words = words(name);
    // The pigment is no lamp, and the dots have no efficiency.
    for pair in [["lamp", "black"], ["quantum", "dot"], ["quantum", "dots"]] {
        if let Some(at) = words.windows(2).position(|words| words == pair) {
            words.remove(at);
        }
    }
    let joined = |name: &str| name.to_lowercase().replace(['_', '-', '.', ' '], "");
    let short = joined(name);
    // AM012 is a number of a sample.
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_ascii_digit());
    let starts = std::iter::once(name).chain(name.match_indices(['_', '-', '.', ' ']).map(|(at, _)| &name[at + 1..]));
    let starts: Vec<String> = starts.map(joined).collect();
    let is_sun = |sun: &&str| starts.iter().any(|start| start.strip_prefix(*sun).is_some_and(ends));
    let is_solar = ["am0", "am15", "astmg173"].iter().any(is_sun);
    let is_solar = is_solar || ["solarspectr", "sunspectr", "spectrumofthesun"].iter().any(|sun| short.contains(sun));
    let told = is_solar.then_some(Role::Illuminant);
    let is_observer = [
        "ciexyz",
        "xyz2e",
        "xyz10e",
        "linss",
        "colormatching",
        "colourmatching",
        "cie1931",
        "actionspectr",
        "stilesburch",
        "cie31",
        "ss2deg",
        "ss10deg",
    ]
    .iter()
    .any(|observer| short.contains(observer));
    let told = told.or(is_observer.then_some(Role::Camera));
    let is_chart = ["colorchart", "colourchart", "colorchecker", "macbeth"].iter().any(|chart| short.contains(chart));
    let told = told.or(is_chart.then_some(Role::Reflectance));
    let is_density = DENSITIES.iter().any(|density| short.contains(density));
    let told = told.or(is_density.then_some(Role::Transmittance));
    let is_lamp = ["pressuresodium", "pressuremercury", "sodiumlamp"].iter().any(|lamp| short.contains(lamp));
    let told = told.or(is_lamp.then_some(Role::Illuminant));
    let mut roles = told.into_iter().chain(words.iter().filter_map(|word| role_of_word(word)));
    let first = roles.next()?;
    Some((first, roles.all(|role| role == first)))
}

/// The words of a name in lower case, those joined by capitals or digits apart: `CanonSSF_2` is canon and ssf. Letters between
/// digits are of a code, `SG01DA18SPD07`, and no words.
fn words(name: &str) -> Vec<String> {
    let (mut words, mut word, mut last, mut begun) = (Vec::new(), String::new(), ' ', ' ');
    for c in name.chars().chain(Some(' ')) {
        if !c.is_alphabetic() || (last.is_lowercase() && c.is_uppercase()) {
            let coded = begun.is_ascii_digit() && c.is_ascii_digit();
            words.extend(Some(std::mem::take(&mut word)).filter(|word| !word.is_empty() && !coded));
        }
        begun = if word.is_empty() { last } else { begun };
        word.extend(c.to_lowercase().filter(|c| c.is_alphabetic()));
        last = c;
    }
    words
}

/// The role that a word in the name of a file or a folder suggests: a quantity, or a thing that has only one spectrum.
fn role_of_word(word: &str) -> Option<Role> {
    /// How words begin, and whole words.
    const WORDS: [(Role, &str, &str); 5] = [
        (Role::Unknown, "refractive|grating|diffract", "eta|nk|ior"),
        (
            Role::Illuminant,
            "illumin|irradian|radian|luminaire|phosphor",
            "display|displays|monitor|monitors|projector|projectors|primaries|illum|irrad|spd|spds|lamp|lamps|led|leds|lights|bulb|bulbs|daylight|sunlight|skylight|halogen|xenon|tungsten|\
             incandescent|fluorescent|emission",
        ),
        (Role::Reflectance, "reflec|remission|albedo", "refl|rfl|colorchecker|colourchecker|munsell"),
        (Role::Transmittance, "transmi|absorban", "od|filter|filters|trans|gel|gels|wratten"),
        (
            Role::Camera,
            "sensitiv|specsens|responsiv|quantum|efficien|camera",
            "ssf|ssfs|srf|srfs|rsr|rsrs|camspec|qe|eqe|iqe|cmf|cmfs|cmos|response|responses|photopic|scotopic|melanopic|observer|observers|\
             receptor|receptors|photoreceptor|photoreceptors|cones|fundamentals",
        ),
    ];
    let starts = |starts: &str| starts.split('|').any(|start| word.starts_with(start));
    WORDS.iter().find(|(_, begin, whole)| starts(begin) || is_one(word, whole)).map(|(role, ..)| *role)
}

#[cfg(feature = "json")]
mod metadata {
    //! Metadata of a table in JSON, as the CIE delivers them (`datatableInfo.columnHeaders`) and as CSV on the Web has them.

    use chromascope_text::on_one_line;
    use serde_json::Value;

    use crate::decision::{Decided, Quantity, WavelengthUnit};
    use crate::grid::Grid;
    use crate::header::Header;
    use crate::header_terms;
    use crate::text::excerpt;

    /// Takes names, units, quantity and title that the table itself lacks.
    pub(super) fn take(json: &[u8], grid: &mut Grid) {
        let Ok(found) = serde_json::from_slice::<Value>(json) else { return };
        let text = |value: &Value, keys: &[&str]| {
            let found = keys.iter().find_map(|key| value.get(key)?.as_str()).map(str::trim);
            found.filter(|text| !text.is_empty()).map(str::to_owned)
        };
        let title = text(&found["titles"][0], &["title"]).or_else(|| text(&found, &["dc:title", "title"]));
        if let Some(title) = title.as_ref().filter(|_| grid.header.comment("title").is_none()) {
            grid.header.note(0, "title", title);
        }
        let columns = [&found["datatableInfo"]["columnHeaders"], &found["tableSchema"]["columns"]];
        let columns = columns.into_iter().find_map(Value::as_array).map_or(&[][..], Vec::as_slice);
        let mut said = None;
        if let Some((axis, columns)) = columns.split_first().filter(|(_, rest)| rest.len() == grid.curves.len()) {
            let unit = text(axis, &["unit"]).and_then(|unit| WavelengthUnit::from_symbol(&unit));
            if let Some(unit) = unit.filter(|_| grid.unit.is_none() && grid.header.x_unit.is_none()) {
                grid.unit = Some(Decided::certain(unit, "The metadata beside the file say so"));
            }
            for (curve, column) in grid.curves.iter_mut().zip(columns) {
                if let Some(name) = text(column, &["title", "titles", "name"]).filter(|_| !curve.named) {
                    name.trim_end_matches("(lambda)").trim_end().clone_into(&mut curve.name);
                    curve.named = true;
                }
                let unit = text(column, &["unit"]).filter(|unit| unit != "dimensionless" && unit != "1");
                curve.unit = curve.unit.take().or(unit);
            }
            let words = columns.iter().filter_map(|column| text(column, &["quantity", "description"]));
            said = words.into_iter().find(|words| header_terms::quantity(words).is_some());
        }
        let noted = note(&found, &mut grid.header);
        let noted = |key: &str| Some(noted.iter().find(|(noted, _)| noted == key)?.1.clone());
        if let Some(unit) = noted("unit").filter(|unit| unit != "1") {
            let lacking = grid.curves.iter_mut().filter(|curve| curve.unit.is_none());
            lacking.for_each(|curve| curve.unit = Some(unit.clone()));
        }
        let said = said.or_else(|| noted("quantity").filter(|_| grid.header.quantity.is_none()));
        let Some(words) = said.or_else(|| title.filter(|title| header_terms::role(title).is_some())) else { return };
        let why = format!("The metadata beside the file say “{}”", excerpt(&words));
        grid.beside = header_terms::role(&words).map(|role| Decided::certain(role, &*why));
        let quantity = header_terms::quantity(&words).filter(|quantity| *quantity != Quantity::Relative);
        grid.quantity = grid.quantity.take().or_else(|| Some(Decided::certain(quantity?, why)));
    }

    /// Takes the notes and the Dublin Core terms, such as `dc:license`, whose keys the table has no comments of; returns them.
    fn note(found: &Value, header: &mut Header) -> Vec<(String, String)> {
        let notes = found["notes"].as_array().into_iter().flatten().filter_map(Value::as_object).flatten();
        let notes = notes.map(|(key, value)| (key.as_str(), value));
        let terms = found.as_object().into_iter().flatten();
        let terms = terms.filter_map(|(key, value)| Some((key.strip_prefix("dc:")?, value)));
        let texts = notes.chain(terms).filter_map(|(key, value)| Some((key, value.as_str()?)));
        let lacking = texts.filter(|(key, _)| *key != "title" && header.comment(key).is_none());
        let noted: Vec<_> = lacking.map(|(key, text)| (key.to_owned(), on_one_line(text).into_owned())).collect();
        for (key, text) in &noted {
            header.note(0, key, text);
        }
        noted
    }
}
