//! Input of the writers: borrowed curves and what is known about them; their numbers and names as text.

use std::borrow::Cow;
use std::fmt::{Arguments, Write};

use crate::decision::{Quantity, Values};
use crate::error::{MAX_CURVES, MAX_SAMPLES};
use crate::report::{Covariance, Curve, Uncertainty};
use crate::write::format::{Note, WriteError};
use crate::{header_terms, heads, quantity, unit_text};

/// A curve to be written: values over wavelength.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Trace<'a> {
    /// Its name. Line breaks become spaces, and a name that is blank, or that would be read as one of wavelengths, absorbances
    /// or decibels, becomes `Curve` and a number; signs of percent go where values are fractions.
    pub name: &'a str,
    /// Wavelengths in nanometers: finite, above zero, strictly ascending, at least two.
    pub wavelengths_nm: &'a [f64],
    /// Values, one for each wavelength: finite.
    pub values: &'a [f64],
    /// Uncertainty of the values, where it is known, with a coverage factor above zero.
    pub uncertainty: Option<&'a Uncertainty>,
}

impl<'a> From<&'a Curve> for Trace<'a> {
    fn from(curve: &'a Curve) -> Self {
        let uncertainty = curve.uncertainty.as_ref();
        Self { name: &curve.name, wavelengths_nm: &curve.wavelengths_nm, values: &curve.values, uncertainty }
    }
}

/// Role of the curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Content<'a> {
    /// Sensitivities of a camera.
    Camera {
        /// Red, green and blue curves; there may be others, which only CSV, `.sp` and CGATS can hold.
        channels: [usize; 3],
        /// True if they are a response to equal numbers of photons (else to equal power); `None` if unknown.
        per_photon: Option<bool>,
        /// Manufacturer of the camera, by which rawtoaces finds it.
        manufacturer: Option<&'a str>,
        /// Its model, by which rawtoaces finds it.
        model: Option<&'a str>,
    },
    /// Three color matching functions or cone fundamentals.
    Observer,
    /// Reflectances: fractions of one.
    Reflectance,
    /// Transmittances: fractions of one.
    Transmittance,
    /// Spectral power of lights.
    Illuminant,
    /// Anything else.
    #[default]
    Other,
}

impl Content<'_> {
    pub(super) fn unit(self) -> Option<&'static str> {
        (!matches!(self, Self::Illuminant | Self::Other)).then_some("1")
    }

    /// Returns whether values are fractions of one, regardless of other settings.
    pub(super) fn is_fraction(self) -> bool {
        matches!(self, Self::Reflectance | Self::Transmittance)
    }
}

/// Curves and what is known about them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sheet<'a> {
    /// A title for all; may be empty.
    pub title: &'a str,
    /// Role of the curves.
    pub content: Content<'a>,
    /// The curves, in the order in which they are written.
    pub curves: &'a [Trace<'a>],
    /// Covariance of the samples of all curves, curve after curve, where it is known.
    pub covariance: Option<&'a Covariance>,
    /// The unit of the values. Not looked at for reflectances and transmittances, which have none.
    pub unit: Option<&'a str>,
    /// Creation time of the file, as in RFC 3339, for the formats that have a field for it.
    pub created: Option<&'a str>,
    /// Further information, such as `("source", …)`, `("license", …)` and `("note", …)`. Information in other fields
    /// here (title, quantity, unit, response) is not taken from it.
    pub comments: &'a [(String, String)],
}

impl<'a> Sheet<'a> {
    pub(super) fn unit(&self) -> Option<&'a str> {
        let said = self.unit.filter(|unit| !unit.trim().is_empty() && !self.content.is_fraction());
        said.or(self.content.unit())
    }

    /// Quantity of the values, as the program's own files name it.
    pub(super) fn quantity(&self) -> &'static str {
        let relative = self.unit().is_none_or(|unit| unit.trim() == "1");
        match self.content {
            Content::Camera { .. } if relative => "relative spectral sensitivity",
            Content::Camera { .. } => "spectral sensitivity",
            Content::Observer => "color matching functions",
            Content::Reflectance => "reflectance factor",
            Content::Transmittance => "transmittance",
            Content::Illuminant if relative => "relative spectral power",
            Content::Illuminant => {
                let quantity = self.unit().and_then(quantity::of_unit).unwrap_or(Quantity::SpectralPower);
                heads::quantity_of_light(quantity)
            }
            Content::Other => header_terms::UNSPECIFIED,
        }
    }

    pub(super) fn head(&self) -> String {
        let per_photon = if let Content::Camera { per_photon, .. } = self.content { per_photon } else { None };
        heads::of_curve(self.quantity(), per_photon, self.unit_in_head().as_deref())
    }

    pub(super) fn head_of_uncertainty(&self, coverage: f64) -> String {
        heads::of_uncertainty(coverage, self.unit_in_head().as_deref())
    }

    /// The unit on a line, without the brackets that it stands in.
    fn unit_in_head(&self) -> Option<String> {
        self.unit().map(|unit| one_line(unit).replace('[', "(").replace(']', ")"))
    }

    /// What is known about the curves besides their title, as keys and values on a line each, none of them blank.
    pub(super) fn known(&self, response: Option<&str>, resampling: Option<&str>) -> Vec<(String, String)> {
        const SAID: [&str; 4] = ["title", "quantity", "unit", "response"];
        let (quantity, unit) = (Some(self.quantity()), self.unit());
        let own = [("quantity", quantity), ("unit", unit), ("response", response), ("resampling", resampling)];
        let own = own.into_iter().filter_map(|(key, value)| Some((one_line(key), one_line(value?))));
        let comments = self.comments.iter().map(|(key, value)| (one_line(key), one_line(value)));
        let comments = comments.filter(|(key, _)| !SAID.iter().any(|said| key.eq_ignore_ascii_case(said)));
        let lines = own.chain(comments).filter(|(key, value)| !key.is_empty() && !value.is_empty());
        lines.map(|(key, value)| (key.into_owned(), value.into_owned())).collect()
    }

    pub(super) fn title(&self) -> Cow<'a, str> {
        let title = one_line(self.title);
        match self.curves {
            [only] if title.is_empty() => one_line(only.name),
            _ => title,
        }
    }

    pub(super) fn check(&self) -> Result<(), WriteError> {
        if self.curves.is_empty() {
            return Err(WriteError::NoCurves);
        }
        if self.curves.len() > MAX_CURVES {
            return Err(WriteError::TooLarge);
        }
        for (index, trace) in self.curves.iter().enumerate() {
            check(trace, index + 1)?;
        }
        let samples = self.curves.iter().map(|trace| trace.values.len()).sum::<usize>();
        if self.covariance.is_some_and(|of| of.size != samples || of.values.len() != samples * samples) {
            return Err(WriteError::Covariance);
        }
        if let Content::Camera { channels, .. } = self.content {
            let [r, g, b] = channels;
            if channels.iter().any(|&channel| channel >= self.curves.len()) || r == g || g == b || r == b {
                return Err(WriteError::Channels);
            }
        }
        Ok(())
    }

    /// Every curve, with a name that fits on a line.
    pub(super) fn pieces(&self, notes: &mut Vec<Note>) -> Vec<Piece<'a>> {
        let mut renamed = 0;
        let pieces = self.curves.iter().enumerate().map(|(index, trace)| {
            let name = name(trace.name, index, self.content);
            renamed += usize::from(name != trace.name);
            let (wavelengths, values) = (Cow::Borrowed(trace.wavelengths_nm), Cow::Borrowed(trace.values));
            Piece { name, wavelengths, values, uncertainty: trace.uncertainty.map(Stated::of) }
        });
        let pieces = pieces.collect();
        if renamed > 0 {
            notes.push(Note::Renamed(renamed));
        }
        pieces
    }

    /// Every curve, sensitivities per energy.
    pub(super) fn energy_pieces(&self, notes: &mut Vec<Note>) -> Vec<Piece<'a>> {
        let mut pieces = self.pieces(notes);
        if let Content::Camera { per_photon: Some(true), .. } = self.content {
            notes.push(Note::PerEnergy);
            for piece in &mut pieces {
                let per_energy = |(w, v): (&f64, &f64)| (v * (w / PER_ENERGY_NM)).clamp(f64::MIN, f64::MAX);
                piece.values = piece.wavelengths.iter().zip(piece.values.iter()).map(per_energy).collect();
            }
        }
        pieces
    }

    /// The red, green and blue of a camera alone, per energy; every curve of anything else.
    pub(super) fn channel_pieces(&self, notes: &mut Vec<Note>) -> Vec<Piece<'a>> {
        let pieces = self.energy_pieces(notes);
        let Content::Camera { channels, .. } = self.content else { return pieces };
        if pieces.len() > channels.len() {
            notes.push(Note::LeftOut(pieces.len() - channels.len()));
        }
        channels.iter().filter_map(|&channel| pieces.get(channel).cloned()).collect()
    }
}

/// The wavelength in nanometers where sensitivities per photon and per energy have the same value.
const PER_ENERGY_NM: f64 = 550.0;

#[derive(Debug, Clone)]
pub(super) struct Piece<'a> {
    pub(super) name: Cow<'a, str>,
    pub(super) wavelengths: Cow<'a, [f64]>,
    pub(super) values: Cow<'a, [f64]>,
    pub(super) uncertainty: Option<Stated<'a>>,
}

/// Standard uncertainties of values, and the factor of the numbers that are written for them.
#[derive(Debug, Clone)]
pub(super) struct Stated<'a> {
    pub(super) coverage: f64,
    pub(super) standard: Cow<'a, [f64]>,
}

impl<'a> Stated<'a> {
    /// Those of a curve with its own factor, unless a number times it does not come back to the last bit.
    fn of(uncertainty: &'a Uncertainty) -> Self {
        let (standard, k) = (&uncertainty.standard, uncertainty.coverage);
        let exact = standard.iter().all(|u| expanded(*u, k) / k == *u);
        Self { coverage: if exact { k } else { 1.0 }, standard: standard.into() }
    }
}

/// The number that is written for a standard uncertainty: of those that come back as it, the one with the fewest digits.
pub(super) fn expanded(standard: f64, coverage: f64) -> f64 {
    let product = standard * coverage;
    let near = [product, product.next_up(), product.next_down()].into_iter();
    let exact = near.filter(|number| number / coverage == standard);
    exact.min_by_key(|number| number.to_string().len()).unwrap_or(product)
}

impl Piece<'_> {
    pub(super) fn range(&self) -> [f64; 2] {
        [self.wavelengths.first(), self.wavelengths.last()].map(|end| end.copied().unwrap_or(0.0))
    }
}

fn check(trace: &Trace<'_>, curve: usize) -> Result<(), WriteError> {
    let (wavelengths, values) = (trace.wavelengths_nm, trace.values);
    if wavelengths.len() != values.len() {
        return Err(WriteError::Lengths(curve));
    }
    if wavelengths.len() < 2 {
        return Err(WriteError::TooShort(curve));
    }
    if wavelengths.len() > MAX_SAMPLES {
        return Err(WriteError::TooLarge);
    }
    let ascending = wavelengths.windows(2).all(|pair| pair[0] < pair[1]);
    if !(ascending && wavelengths[0] > 0.0 && wavelengths.iter().all(|w| w.is_finite())) {
        return Err(WriteError::Wavelengths(curve));
    }
    if !values.iter().all(|value| value.is_finite()) {
        return Err(WriteError::NotFinite(curve));
    }
    let is_uncertainty = |of: &Uncertainty| {
        let known = of.standard.iter().all(|u| u.is_finite() && *u >= 0.0);
        known && of.standard.len() == values.len() && of.coverage.is_finite() && of.coverage > 0.0
    };
    if trace.uncertainty.is_none_or(is_uncertainty) { Ok(()) } else { Err(WriteError::Uncertainty(curve)) }
}

pub(super) use chromascope_text::on_one_line as one_line;

pub(super) fn push_comment(out: &mut String, key: &str, value: &str) {
    push(out, format_args!("# {key}: {value}\n"));
}

pub(super) fn push(out: &mut String, arguments: Arguments<'_>) {
    out.write_fmt(arguments).expect("a text takes whatever is written to it");
}

/// Appends the shortest decimal that reads back as the same double: `0.055`, `400`, `1e-7`, `1.5e300`.
pub(super) fn push_number(out: &mut String, value: f64) {
    const PLAIN: std::ops::Range<f64> = 1e-5..1e16;
    let plain = value == 0.0 || PLAIN.contains(&value.abs());
    if plain { push(out, format_args!("{value}")) } else { push(out, format_args!("{value:e}")) }
}

/// A number with a point in it: readers of CGATS take whole numbers for integers.
pub(super) fn push_real(out: &mut String, value: f64) {
    let start = out.len();
    push_number(out, value);
    if !out[start..].contains('.') {
        let end = out[start..].find('e').map_or(out.len(), |at| start + at);
        out.insert_str(end, ".0");
    }
}

/// The name of a curve: on one line, not blank, and not one that a reader takes for a unit which the values are not in.
fn name<'a>(text: &'a str, index: usize, content: Content<'_>) -> Cow<'a, str> {
    let mut name = one_line(text);
    if misleads(&name, content) {
        name = Cow::Owned(unit_text::without_percent_signs(&name));
    }
    let bad = header_terms::is_sign(&name) || heads_wavelengths(&name) || misleads(&name, content);
    if bad { Cow::Owned(format!("Curve {}", index + 1)) } else { name }
}

/// Returns whether a reader would convert the values under such a name. What responds to light is never scaled down from percent.
fn misleads(name: &str, content: Content<'_>) -> bool {
    match header_terms::values(name) {
        // Energies are not photons or powers per frequency.
        _ if matches!(content, Content::Illuminant | Content::Other) && quantity::converts(name) => true,
        None | Some(Values::Plain) => false,
        Some(Values::Decibels) => true,
        Some(Values::Percent | Values::Absorbance) => !matches!(content, Content::Camera { .. } | Content::Observer),
    }
}

/// Returns whether a reader would take a column of such a name for one of wavelengths.
fn heads_wavelengths(name: &str) -> bool {
    const LONGEST_UNIT: usize = 4;
    header_terms::names_wavelengths(name) || (name.len() <= LONGEST_UNIT && header_terms::x_unit(name).is_some())
}

/// Appends a text between quotation marks, those inside doubled, as CSV and CGATS have it.
pub(super) fn push_quoted(out: &mut String, text: &str) {
    out.push('"');
    for part in text.split_inclusive('"') {
        out.push_str(part);
        if part.ends_with('"') {
            out.push('"');
        }
    }
    out.push('"');
}
