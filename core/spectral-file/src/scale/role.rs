//! Role of the curves: as stated in the file, as suggested by its settings, or by its numbers; the channels of a camera.

use crate::decimal::extent;
use crate::decision::{Certainty, Decided, Quantity, Role, Values, WavelengthUnit};
use crate::grid::{Grid, RawCurve};
use crate::header_terms::{self, Channel, XUnit};
use crate::report::Curve;
use crate::scale::values::{Evidence, LARGEST_PERCENT, Looks};
use crate::text::{excerpt, has_part, has_word, is_one};
use crate::uncertainty_terms::{self, Sense};
use crate::{no_curve, quantity, unit_text};

/// Counts of detectors are larger, irradiances and radiances in the usual units smaller.
const COUNTS: f64 = 1000.0;

/// Logarithms of relative values fall below it, noise does not.
const LOGARITHM: f64 = -0.5;

/// Role that words in the file state or mention, or that suits the scale that was chosen.
pub(super) fn said(grid: &Grid, chosen: Option<Values>) -> Option<Decided<Role>> {
    let said = stated(grid).or_else(|| hinted(grid, chosen))?;
    if said.value != Role::Camera || said.certainty == Certainty::Certain {
        return Some(said);
    }
    let Some(light) = grid.curves.iter().find(|curve| header_terms::names_illuminant(&curve.name)) else {
        return Some(said);
    };
    let (light, why) = (excerpt(&light.name), chromascope_text::lowered(&said.why));
    Some(Decided::open(Role::Unknown, format!("“{light}” is a light, others are sensitivities: {why}")))
}

/// Role that the format, the header, the names of columns or a setting state.
fn stated(grid: &Grid) -> Option<Decided<Role>> {
    if let Some(why) = none_of_the_roles(grid) {
        return Some(Decided::open(Role::Unknown, why));
    }
    let of_format = || grid.role.clone().filter(|role| role.certainty == Certainty::Certain);
    if let Some(role) = several(grid).or_else(of_format) {
        return Some(role);
    }
    if let Some((line, role)) = grid.header.role {
        return Some(Decided::certain(role, format!("Line {line} says so")));
    }
    if let Some(beside) = grid.beside.as_ref().filter(|beside| beside.certainty == Certainty::Certain) {
        return named(grid).or_else(|| of_settings(grid)).or_else(|| Some(beside.clone()));
    }
    let any = |word: &str| grid.curves.iter().any(|curve| has_word(&curve.name.to_lowercase(), word));
    if any("excitation") && !grid.curves.iter().all(|curve| has_word(&curve.name.to_lowercase(), "excitation"))
        || any("absorption") && any("emission")
    {
        return Some(Decided::open(
            Role::Unknown,
            "Excitation, or absorption, and what is emitted are of a dye, neither a light nor a filter",
        ));
    }
    let names: Vec<&str> = grid.curves.iter().take(MOST_CHANNELS + 1).map(|curve| curve.name.as_str()).collect();
    let is_light = |curve: &&RawCurve| {
        header_terms::names_illuminant(&curve.name)
            || header_terms::channel(&curve.name).is_none() && header_terms::is_power(&curve.label)
    };
    if let Some(light) = grid.curves.iter().find(is_light).filter(|_| channels(&names).is_some()) {
        let light = if light.named { &light.name } else { &light.label };
        let why = format!("The curves are named {}, of which {light} is a light", names.join(", "));
        return Some(Decided::open(Role::Unknown, why));
    }
    let channels = channels(&names).map(|(_, letters)| {
        let why = format!("The curves are named {}", names.join(", "));
        // Primaries of displays are called R, G and B too.
        let named = |wanted: &str| names.iter().any(|name| name.eq_ignore_ascii_case(wanted));
        let said = letters && !named("r");
        // Of pictures; sensitivities are called by another name.
        let intensities = grid.curves.iter().all(|curve| curve.label.to_lowercase().contains("intensity"));
        if intensities {
            Decided::open(Role::Unknown, format!("{why}: values of pictures are called so too"))
        } else if named("w") || named("white") {
            Decided::guess(Role::Illuminant, format!("{why}, as a display's white and its primaries are"))
        } else if said {
            Decided::certain(Role::Camera, why)
        } else {
            Decided::guess(Role::Camera, why)
        }
    });
    if let Some(mixed) = mixed(grid) {
        return Some(mixed);
    }
    if let Some(other) = channels.as_ref().and_then(|_| other_than_camera(grid)) {
        return Some(other);
    }
    if let Some(letters) = channels.clone().filter(|channels| channels.certainty == Certainty::Certain) {
        return Some(letters);
    }
    named(grid)
        .or_else(|| of_settings(grid))
        .or(channels)
        .or_else(|| of_quantity(grid))
        .or_else(|| of_illuminants(grid))
}

/// Reason why the curves have none of the roles: their heads, a line above them or the file's name say that they are something else.
fn none_of_the_roles(grid: &Grid) -> Option<String> {
    if let Some(why) = grid.curves.iter().find_map(|curve| header_terms::not_converted(&curve.label)) {
        return Some(why.to_owned());
    }
    if no_curve::is_only_beside(grid) {
        return Some(format!("“{}” stands beside spectra, and is none", excerpt(&grid.curves[0].name)));
    }
    let clues = &grid.header.clues;
    if let Some((line, why)) = clues.other.filter(|_| grid.header.role.is_none()) {
        let said = if line == 0 { "the file's name".to_owned() } else { format!("line {line}") };
        return Some(format!("By {said}: {}", chromascope_text::lowered(why)));
    }
    let is_term = |curve: &RawCurve| {
        uncertainty_terms::term(unit_text::without_unit(&curve.label), &curve.label)
            .is_some_and(|term| term.sense == Sense::Clear)
    };
    let alone = grid.curves.iter().all(|curve| curve.uncertainty.is_none()) && grid.header.own.is_empty();
    let who = match clues.uncertainties {
        _ if !alone => return None,
        _ if grid
            .curves
            .iter()
            .all(|curve| is_term(curve) || has_word(&curve.label.to_lowercase(), "uncertainty|uncertainties")) =>
        {
            "The header".to_owned()
        }
        Some(0) => "The name of the file".to_owned(),
        Some(line) => format!("Line {line}"),
        None => return None,
    };
    Some(format!("{who} says that these are uncertainties: put them into a column behind that of their values"))
}

/// A quantity, unit or mode that outweighs the names of channels: of lights, or of fractions of light.
fn other_than_camera(grid: &Grid) -> Option<Decided<Role>> {
    let other = |role: Role| role == Role::Illuminant || role.is_fraction();
    let found = named(grid).or_else(|| of_settings(grid)).or_else(|| of_quantity(grid));
    if let Some(found) = found {
        return Some(found).filter(|found| other(found.value));
    }
    if let Some((line, role)) = grid.header.mentioned.filter(|(_, role)| other(*role)) {
        return Some(Decided::guess(role, format!("Line {line} mentions it, whatever the names of the columns")));
    }
    grid.beside.clone().filter(|beside| beside.value == Role::Illuminant)
}

/// Columns that each name a quantity, of lights beside sensitivities or fractions of light: only the user knows which are meant.
fn several(grid: &Grid) -> Option<Decided<Role>> {
    if grid.header.role.is_some() {
        return None;
    }
    let role = |curve: &RawCurve| {
        let unit = || quantity::of_unit(curve.unit.as_deref()?)?.role();
        header_terms::role(&curve.label).or_else(unit)
    };
    let roles: Vec<Role> = grid.curves.iter().filter_map(role).collect();
    let kind = |role: Role| if role.is_fraction() { Role::Reflectance } else { role };
    let other = roles.iter().position(|other| kind(*other) != kind(roles[0]))?;
    let why = format!("The columns hold several quantities, {} beside {}", roles[0], roles[other]);
    (roles.len() > 2 && 2 * roles.len() > grid.curves.len()).then(|| Decided::open(Role::Unknown, why))
}

/// Columns named A beside R or T: absorbances or absorptances beside reflectances and transmittances.
fn mixed(grid: &Grid) -> Option<Decided<Role>> {
    const MOST: usize = 4;
    if grid.header.mentioned.is_some() || grid.curves.len() > MOST {
        return None;
    }
    let named = |letter: &str| {
        grid.curves.iter().any(|curve| {
            let name = unit_text::without_unit(&curve.label).trim_start_matches('%').trim().to_lowercase();
            name == letter
        })
    };
    let why = "Columns named A, T or R are different quantities: A is absorbance or absorptance";
    (named("a") && (named("r") || named("t"))).then(|| Decided::open(Role::Unknown, why))
}

/// Curves for each that says what it is, up to which it speaks for all.
const MOST_OTHERS: usize = 4;

/// The role that the columns name. What only a sample is called, such as `radiance paint` among others or against a line
/// above, decides nothing.
fn named(grid: &Grid) -> Option<Decided<Role>> {
    // ASD names the column by the file, and the file by what was meant to be measured.
    if grid.curves.iter().all(|curve| curve.label.contains(".asd")) {
        return None;
    }
    let all = grid.curves.len() > 1 && grid.curves.iter().all(|curve| header_terms::role(&curve.label).is_some());
    let mut named = grid.curves.iter().filter_map(|curve| Some((header_terms::role(&curve.label)?, &curve.label)));
    let (role, name) = named.next()?;
    let why = format!("A column is named “{}”", excerpt(name));
    let agree = named.all(|(other, _)| other == role);
    let is_head = |curve: &&RawCurve| {
        let unit = curve.unit.as_ref().is_some_and(|unit| role.is_fraction() || !header_terms::says_percent(unit));
        unit || header_terms::is_quantity(unit_text::without_unit(&curve.label))
    };
    if !all && !grid.curves.iter().filter(is_head).any(|curve| header_terms::role(&curve.label) == Some(role)) {
        let denied = grid.header.mentioned.is_some_and(|(_, mentioned)| mentioned != role);
        let only = grid.curves.len() == 1;
        // `Lamp radiance` states it; `radiance paint` may be the name of a sample.
        let last = name.rsplit([' ', '_']).next().unwrap_or(name);
        let ends =
            || header_terms::role(last) == Some(role) || header_terms::quantity(name) == Some(Quantity::SpectralPower);
        let stated = only && (role != Role::Illuminant || ends());
        let said = if stated { Decided::certain(role, why) } else { Decided::guess(role, why) };
        return Some(said).filter(|_| !denied && (only || role.is_fraction()));
    }
    // One quantity beside many others, as a detector's efficiency beside the lamps it sees, says nothing of these.
    let count = grid.curves.iter().filter(|curve| header_terms::role(&curve.label).is_some()).count();
    if count * MOST_OTHERS < grid.curves.len() {
        let few = if count == 1 { "alone of".to_owned() } else { format!("{count} of") };
        return Some(Decided::open(Role::Unknown, format!("{why}, {few} {}", grid.curves.len())));
    }
    // Of those that say nothing it is a guess.
    let why = if all || count == grid.curves.len() { why } else { format!("{why}, {count} of {}", grid.curves.len()) };
    Some(if agree && count == grid.curves.len() { Decided::certain(role, why) } else { Decided::guess(role, why) })
}

/// The role that settings and comments with a key of their own name.
fn of_settings(grid: &Grid) -> Option<Decided<Role>> {
    let header = &grid.header;
    if let Some((line, role)) = header.clues.role {
        return Some(Decided::certain(role, format!("Line {line} says so")));
    }
    let quantity = header.comment("quantity").or_else(|| header.comment("measurement"));
    if let Some(role) = quantity.and_then(header_terms::role) {
        return Some(Decided::certain(role, "The comment on the quantity says so"));
    }
    let camera = ["camera", "camera_name", "camera model"].iter().find(|key| header.comment(key).is_some())?;
    let why = format!("There is a comment “{camera}”");
    let channels = (3..=MOST_CHANNELS).contains(&grid.curves.len());
    channels.then(|| Decided::certain(Role::Camera, why))
}

/// The role that a quantity leaves, such as none for counts: the sensitivity of the detector is still in them.
fn of_quantity(grid: &Grid) -> Option<Decided<Role>> {
    if let Some((line, quantity)) = grid.header.quantity
        && let Some(role) = quantity.role()
    {
        return Some(Decided::certain(role, format!("Line {line} says {quantity}")));
    }
    let unit = grid.curves.iter().find_map(|curve| curve.unit.as_deref());
    if let Some((unit, role)) = unit.and_then(|unit| Some((unit, quantity::of_unit(unit)?.role()?)))
        && role != Role::Unknown
    {
        let all = grid.curves.iter().all(|curve| curve.unit.is_some());
        let decide = if all { Decided::certain } else { Decided::guess };
        return Some(decide(role, format!("The unit is {unit}")));
    }
    let says_counts = |curve: &RawCurve| {
        header_terms::says_counts(&curve.label)
            || curve.unit.as_ref().is_some_and(|unit| header_terms::says_counts(unit))
    };
    let counts = !grid.curves.is_empty() && grid.curves.iter().all(says_counts);
    counts.then(|| {
        Decided::certain(Role::Unknown, "The columns are headed counts, which a detector's own sensitivity shapes")
    })
}

/// The name of the first curve if such are all, or a title that is such a name.
fn name_of_light(grid: &Grid, titles: &[&str], is_light: fn(&str) -> bool) -> Option<String> {
    let all = grid.curves.iter().all(|curve| is_light(&curve.name));
    let first = grid.curves.first().filter(|_| all).map(|curve| curve.name.as_str());
    let mut titles = titles.iter().filter_map(|key| grid.header.comment(key));
    first.or_else(|| titles.find(|title| is_light(title))).map(excerpt)
}

fn of_illuminants(grid: &Grid) -> Option<Decided<Role>> {
    // Beside others, A is no field of a chart.
    let is_letter = |curve: &&RawCurve| is_one(&curve.name, "A|B|C|E");
    let (letters, others): (Vec<_>, Vec<_>) = grid.curves.iter().partition(is_letter);
    let all = others.iter().all(|curve| header_terms::names_illuminant(&curve.name));
    if let [first, _, ..] = others[..]
        && !letters.is_empty()
        && all
    {
        let why = format!("“{}” is the name of a standard illuminant, as all are", excerpt(&first.name));
        return Some(Decided::guess(Role::Illuminant, why));
    }
    let name = name_of_light(grid, &["title", "name"], header_terms::names_illuminant)?;
    Some(Decided::certain(Role::Illuminant, format!("“{name}” is the name of a standard illuminant")))
}

/// Role that is mentioned, that settings imply, or that suits a scale that the file states.
fn hinted(grid: &Grid, chosen: Option<Values>) -> Option<Decided<Role>> {
    let (values, why) = match (chosen, grid.header.values.or(grid.header.clues.values)) {
        (Some(values), _) => (Some(values), "It was chosen what the values stand for".to_owned()),
        (None, Some((line, values))) => (Some(values), format!("Line {line} says {values}")),
        (None, None) => {
            let headed = grid.curves.iter().find_map(|curve| header_terms::values(&curve.label));
            (headed.filter(|values| *values != Values::Plain), "The header says what the values stand for".to_owned())
        }
    };
    if let [Some((first, role)), Some((second, other))] = grid.header.measured
        && chosen.is_none()
    {
        let why = format!("Line {first} mentions {role}, but line {second} {other}");
        return Some(Decided::open(Role::Unknown, why));
    }
    // Other information on the content outweighs its scale.
    if let Some((line, role)) = grid.header.mentioned.filter(|(_, role)| suits(*role, values)) {
        return Some(Decided::guess(role, format!("Line {line} mentions it")));
    }
    if let Some(role) = grid.role.as_ref().filter(|role| suits(role.value, values)) {
        return Some(role.clone());
    }
    let label = |is: fn(&str) -> bool| grid.curves.iter().map(|curve| &*curve.label).find(|label| is(label));
    if chosen.is_none() && values == Some(Values::Percent) {
        if let Some(label) = label(header_terms::names_response) {
            return Some(Decided::open(Role::Unknown, format!("“{}” is of a sensor or of a light", excerpt(label))));
        }
        if let Some(label) = label(header_terms::names_light_scale).or_else(|| label(header_terms::names_lamp)) {
            return Some(Decided::guess(Role::Illuminant, format!("“{}” names light", excerpt(label))));
        }
    }
    let absorbance = grid.header.clues.absorbance.filter(|line| values.is_none() && *line > 0);
    if let Some(line) = absorbance {
        return Some(Decided::guess(Role::Transmittance, format!("Line {line} mentions absorbances")));
    }
    match values {
        Some(Values::Percent) if grid.beside.is_none() || chosen.is_some() => {
            Some(lamp(grid).filter(|_| chosen.is_none()).unwrap_or_else(|| Decided::guess(Role::Reflectance, why)))
        }
        // Most spectrometers derive absorbances from what passes a sample.
        Some(Values::Absorbance) => Some(Decided::guess(Role::Transmittance, why)),
        Some(Values::Decibels) if label(|label| has_word(&label.to_lowercase(), "db")).is_some() => {
            Some(Decided::open(Role::Unknown, "Decibels may be of light or of a ratio, such as a transmittance"))
        }
        Some(Values::Decibels) => Some(Decided::guess(Role::Illuminant, why)),
        Some(Values::Percent | Values::Plain) | None => lamp(grid),
    }
}

/// Returns whether curves of a role may be written so. A mere mention of percent does not distinguish lights from
/// reflectances.
fn suits(role: Role, values: Option<Values>) -> bool {
    match values {
        Some(Values::Percent | Values::Absorbance) => role.is_fraction(),
        _ => true,
    }
}

fn lamp(grid: &Grid) -> Option<Decided<Role>> {
    let name = name_of_light(grid, &["title"], header_terms::names_lamp)?;
    Some(Decided::guess(Role::Illuminant, format!("“{name}” is the name of a light")))
}

/// Role that settings, a weaker word or the names of file and folders suggest where no word states one. Numbers alone say nothing:
/// a lamp, a filter and a reflectance may all stay below one, and it stays open which they are.
pub(super) fn suggested(grid: &Grid, evidence: &Evidence) -> Decided<Role> {
    // Lights scaled the usual way are exactly 100 at 560 nm.
    const ANCHOR: (f64, f64) = (560.0, 100.0);
    let labels = || grid.curves.iter().map(|curve| &*curve.label);
    if let Some(role) = by_reference(grid, evidence) {
        return role;
    }
    let at = grid.wavelengths.iter().position(|&w| w == ANCHOR.0);
    if at.is_some_and(|i| grid.curves.iter().all(|curve| curve.values[i] == ANCHOR.1)) {
        return Decided::guess(Role::Illuminant, "Values are 100 at 560 nm");
    }
    if let Some(label) = labels().find(|label| header_terms::names_light_scale(label)) {
        // Shifts of a Raman spectrum are written as wave numbers too.
        const SHIFTS_NM: f64 = 2500.0;
        let wave_numbers = matches!(grid.header.x_unit, Some((_, XUnit::Wavelength(WavelengthUnit::Wavenumber))));
        return if wave_numbers && grid.wavelengths.iter().all(|nm| *nm >= SHIFTS_NM) {
            Decided::open(Role::Unknown, format!("“{}” over such wave numbers may be of Raman shifts", excerpt(label)))
        } else if evidence.high() > COUNTS {
            Decided::open(Role::Unknown, format!("“{}” may be of light or of counts", excerpt(label)))
        } else {
            let power = header_terms::is_power(label);
            let why = format!("“{}” names light", excerpt(label));
            let count = labels().count();
            let named = labels().filter(|label| header_terms::names_light_scale(label)).count();
            if count > MOST_OTHERS && 2 * named < count {
                return Decided::open(Role::Unknown, format!("{why}, {named} of {count}"));
            }
            if power { Decided::certain(Role::Illuminant, why) } else { Decided::guess(Role::Illuminant, why) }
        };
    }
    if labels().any(header_terms::says_au) {
        return Decided::open(Role::Unknown, "AU may be absorbance units or arbitrary units");
    }
    if let Some(label) = labels().find(|label| header_terms::names_response(label)) {
        return Decided::guess(Role::Camera, format!("“{}” names a response", excerpt(label)));
    }
    if let Some(beside) = &grid.beside {
        return beside.clone();
    }
    // Absorption alone may be absorbance.
    let is_coefficient = |label: &str| has_part(&label.to_lowercase(), "coef|scatter|refractive|1/|/cm|cm-1");
    let is_material =
        |label: &str| header_terms::names_material(label) && is_coefficient(label) || is_one(label, "n|k");
    if let Some(label) = labels().next().filter(|_| labels().all(is_material)) {
        let why = format!("“{}” is a property of a material, not of a surface or a filter", excerpt(label));
        return Decided::open(Role::Unknown, why);
    }
    if grid.header.clues.fluorescence {
        return Decided::open(Role::Unknown, "The file says that it is of fluorescence, neither a light nor a filter");
    }
    let (min, max) = evidence.range();
    let reflectances = if min >= -0.2 && max <= 1.2 { "reflectances" } else { "reflectances in percent" };
    let why =
        format!("{}, and nothing says whether they are {reflectances}, a light or something else", evidence.words());
    Decided::open(Role::Unknown, why)
}

/// Role that follows from a measured reference, or from its absence.
fn by_reference(grid: &Grid, evidence: &Evidence) -> Option<Decided<Role>> {
    let clues = &grid.header.clues;
    let (line, ratio) = clues.ratio.or(clues.cosine_receptor.map(|line| (line, false)))?;
    if !ratio {
        if evidence.high() > COUNTS {
            let why = format!(
                "Line {line} says that there was no reference, and {} like counts",
                chromascope_text::lowered(&evidence.words())
            );
            return Some(Decided::guess(Role::Unknown, why));
        }
        return Some(match clues.cosine_receptor {
            Some(line) => {
                Decided::certain(Role::Illuminant, format!("Line {line} says that a cosine receptor was attached"))
            }
            None => Decided::guess(Role::Illuminant, format!("Line {line} says that there was no reference")),
        });
    }
    let looks = |wanted: Looks| evidence.curves.iter().flatten().any(|span| span.looks(LARGEST_PERCENT.1) == wanted);
    // A program that writes percent writes values below two for dark samples, but for absorbances too.
    let doubtful = clues.ratios_in_percent.is_some() && !looks(Looks::Percent);
    let why = format!("Line {line} says that there was a reference");
    (!doubtful).then(|| Decided::guess(Role::Reflectance, why))
}

/// The doubt whether values of a role are logarithms, as none is above zero. Losses in decibels are none either.
pub(super) fn of_logarithms(grid: &Grid) -> Option<Decided<Role>> {
    let decibels = |values: Option<Values>| values == Some(Values::Decibels);
    let said = grid.header.values.map(|(_, values)| values);
    let losses = || decibels(said) || grid.curves.iter().any(|curve| decibels(header_terms::values(&curve.label)));
    let values = || grid.curves.iter().flat_map(|curve| curve.values.iter().copied());
    if values().any(|value| value > 0.0) || extent(values()).0 >= LOGARITHM || losses() {
        return None;
    }
    let why = "No value is above zero, as of logarithms: raise ten to their power first";
    Some(Decided::open(Role::Unknown, why))
}

pub(super) const MOST_CHANNELS: usize = 4;

/// Indices of red, green and blue among three or four names, and true if all are letters. A fourth curve may be beside
/// them, such as an infrared or a clear channel; of the two greens of a Bayer pattern the first is taken.
pub(super) fn channels(names: &[&str]) -> Option<([usize; 3], bool)> {
    if !(3..=MOST_CHANNELS).contains(&names.len()) {
        return None;
    }
    let mut found: [Option<usize>; 3] = [None; 3];
    let mut letters = true;
    let green = |wanted: [&str; 2]| names.iter().position(|name| wanted.iter().any(|w| name.eq_ignore_ascii_case(w)));
    let greens = green(["g1", "gr"]).zip(green(["g2", "gb"]));
    for (index, name) in names.iter().enumerate() {
        if let Some((first, second)) = greens.filter(|(first, second)| index == *first || index == *second) {
            found[1] = Some(first.min(second));
            continue;
        }
        let channel = match header_terms::channel(name) {
            Some(Channel::Letter(channel)) => channel,
            Some(Channel::Word(channel)) => {
                letters = false;
                channel
            }
            None => continue,
        };
        if found[channel].replace(index).is_some() {
            return None;
        }
    }
    Some(([found[0]?, found[1]?, found[2]?], letters))
}

/// Indices of a camera's red, green and blue curves: by name, or by the peaks of three curves.
pub(crate) fn camera_columns(role: Role, curves: &[Curve]) -> Option<[usize; 3]> {
    if role != Role::Camera {
        return None;
    }
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).take(MOST_CHANNELS + 1).collect();
    channels(&names).map(|(columns, _)| columns).or_else(|| by_peak(curves))
}

fn by_peak(curves: &[Curve]) -> Option<[usize; 3]> {
    if curves.len() != 3 {
        return None;
    }
    let mut order: Vec<(f64, usize)> =
        curves.iter().enumerate().map(|(i, curve)| (peak(&curve.wavelengths_nm, &curve.values).0, i)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    Some([order[0].1, order[1].1, order[2].1])
}

fn peak(wavelengths: &[f64], values: &[f64]) -> (f64, f64) {
    let start = (f64::NAN, f64::NEG_INFINITY);
    wavelengths.iter().zip(values).fold(start, |best, (&w, &value)| if value > best.1 { (w, value) } else { best })
}
