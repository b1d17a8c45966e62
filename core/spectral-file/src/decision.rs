//! What is decided on reading a file: the alternatives of each question, and decisions with their certainty, reason and effect.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};
use std::fmt;

/// Enums of named alternatives. Each has its words in a sentence and, where it can be chosen, its label in a list.
macro_rules! choices {
    ($(
        $(#[$about:meta])*
        $name:ident { $($(#[$doc:meta])* $variant:ident = $words:literal $(, $label:literal)?;)+ }
    )+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum $name { $(#[doc = concat!("In a sentence, “", $words, "”.")] $(#[$doc])* $variant,)+ }

        impl $name {
            /// Those that can be chosen, each with its label.
            pub const CHOICES: &'static [(Self, &'static str)] = &[$($((Self::$variant, $label),)?)+];
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self { $(Self::$variant => $words,)+ })
            }
        }
    )+};
}

choices! {
    /// Role of the curves of a file.
    Role {
        /// Sensitivities of a camera, or color matching functions.
        Camera = "camera sensitivities", "Camera sensitivities";
        /// Reflectances: fractions of one.
        Reflectance = "reflectances", "Reflectance";
        /// Transmittances of filters: fractions of one.
        Transmittance = "transmittances", "Transmittance";
        /// Spectral power of lights, in any unit.
        Illuminant = "illuminants", "Illuminant";
        /// Neither stated nor suggested by their values.
        Unknown = "spectra of an unknown kind", "Unknown";
    }

    /// Scale of the values as written, which decides their conversion.
    Values {
        /// Taken as they are: fractions of one where the curves are reflectances or transmittances.
        Plain = "plain numbers, not percent", "Plain numbers";
        /// Percent: divided by 100.
        Percent = "percent", "Percent";
        /// Decadic absorbances A: taken as the fraction 10^−A.
        Absorbance = "absorbances, of which fractions are made", "Absorbance";
        /// Decibels L of power: taken as the power 10^(L/10).
        Decibels = "decibels, of which powers are made", "Decibels";
    }

    /// The unit in which wavelengths are written.
    WavelengthUnit {
        #[serde(alias = "nanometers")]
        Nanometer = "nanometers", "nm";
        /// µm: 1000 nm.
        #[serde(alias = "micrometers")]
        Micrometer = "micrometers", "µm";
        /// As computed in SI units: 10⁹ nm.
        Meter = "meters", "m";
        /// Å: 0.1 nm.
        #[serde(alias = "angstroms")]
        Angstrom = "ångströms", "Å";
        /// Wave numbers σ in 1/cm, taken as the vacuum wavelength 10⁷ nm/σ.
        Wavenumber = "wave numbers in 1/cm", "1/cm";
        /// Frequencies ν in THz, taken as the vacuum wavelength c/ν with c = 299 792.458 nm THz.
        Terahertz = "frequencies in terahertz", "THz";
        /// Frequencies in Hz, taken likewise.
        Hertz = "frequencies in hertz", "Hz";
        /// Energies E of photons in eV, taken as the vacuum wavelength h c/(e E) with h c/e = 1239.841 984 eV nm.
        Electronvolt = "photon energies in electronvolts", "eV";
    }

    /// Separator of cells.
    Delimiter {
        /// `380,0.05`
        Comma = "comma separated", "Comma";
        /// `380,5, 0,05`: a comma with a space after it, where commas alone mark fractions.
        CommaSpace = "separated by comma and space", "Comma, space";
        /// `380;0.05`
        Semicolon = "semicolon separated", "Semicolon";
        Tab = "tab separated", "Tab";
        /// `380|0.05`, also with a bar at both ends of the line.
        Bar = "separated by vertical bars", "Vertical bar";
        /// Any run of spaces and tabs.
        Spaces = "separated by spaces", "Spaces";
        /// None: each value stands in an element of its own, as in XML.
        Elements = "one value in each element";
    }

    /// Decimal mark.
    DecimalMark {
        /// `0.05`
        Point = "decimal points", "Point";
        /// `0,05`
        Comma = "decimal commas", "Comma";
    }

    /// Direction of the wavelengths: down a column or across a row.
    Orientation {
        /// Down a column; every other column is a curve.
        Down = "wavelengths down a column", "Down a column";
        /// Across a header row; every row is a curve.
        Across = "wavelengths across a row", "Across a row";
    }

    /// The physical quantity of values.
    #[non_exhaustive]
    Quantity {
        Reflectance = "reflectance";
        Transmittance = "transmittance";
        /// Absorptance: the fraction that is neither reflected nor transmitted. (Absorbances are read as transmittances.)
        Absorptance = "absorptance";
        /// Response to energy or to photons, usually relative.
        Sensitivity = "spectral sensitivity";
        /// Electrons for each photon.
        QuantumEfficiency = "quantum efficiency";
        /// Power on an area, `W/m²/nm`.
        Irradiance = "irradiance";
        /// Power from an area into a solid angle, `W/sr/m²/nm`.
        Radiance = "radiance";
        /// Power, `W/nm`.
        RadiantFlux = "radiant flux";
        /// Power into a solid angle, `W/sr/nm`.
        RadiantIntensity = "radiant intensity";
        /// Spectral power of a light, without a word on its geometry.
        SpectralPower = "spectral power";
        /// Counts of a detector: its own sensitivity is still in it.
        Counts = "counts of a detector";
        /// A relative scale, without a word on what is compared.
        Relative = "a relative scale";
        Unknown = "a quantity that the file does not name";
    }

    /// The encoding of the bytes.
    Encoding {
        /// UTF-8, of which ASCII is a part.
        Utf8 = "UTF-8";
        /// UTF-16, low byte first.
        Utf16Le = "UTF-16 LE";
        /// UTF-16, high byte first.
        Utf16Be = "UTF-16 BE";
        /// Windows-1252, which holds Latin-1: taken for all that is none of the others.
        Windows1252 = "Windows-1252";
        /// A code page of DOS, by its signs of units, which alone are read.
        Dos = "a DOS code page";
        /// None of those here, such as Big5, EUC-KR or Windows-1251.
        Unknown = "an unknown encoding, read as Windows-1252";
        /// Shift-JIS, as Windows writes it.
        ShiftJis = "Shift-JIS";
        /// GBK, which holds GB 2312: simplified Chinese.
        Gbk = "GBK";
    }

    /// A family of text files with a grammar of its own.
    Family {
        /// XML, such as TM-27 or `CxF`.
        Xml = "XML";
        /// JSON, with or without comments.
        Json = "JSON";
        /// Named, but not read.
        Yaml = "YAML";
        Jcamp = "JCAMP-DX";
        /// CGATS and its relatives, as Argyll and X-Rite write them.
        Cgats = "CGATS";
    }

    /// In what the wavelengths of a file are measured. They are taken as they are: the difference is 0.03 %.
    Medium {
        Air = "wavelengths in air, taken as they are";
        Vacuum = "wavelengths in vacuum, taken as they are";
    }

    /// Reason that a row is in no curve.
    Dropped {
        NoWavelength = "no wavelength";
        OutOfRange = "beyond the wavelengths that are read";
        Repeated = "the same as an earlier row";
        Averaged = "merged with rows of the same wavelength, of which the mean was taken";
    }

    /// Certainty of a decision.
    Certainty {
        /// Stated in the file, or the only possible interpretation.
        Certain = "certain";
        /// Suggested by the content; the user should check it.
        Guess = "a guess";
        /// Decided by neither the file nor its numbers: the numbers stay as written until the user chooses.
        Open = "open";
        /// Requested by the caller.
        Chosen = "chosen";
    }
}

impl Role {
    /// Returns whether the curves are fractions of the light that falls on something.
    pub fn is_fraction(self) -> bool {
        matches!(self, Self::Reflectance | Self::Transmittance)
    }
}

impl Quantity {
    /// Role of curves of this quantity, if they have only one.
    pub fn role(self) -> Option<Role> {
        match self {
            Self::Reflectance => Some(Role::Reflectance),
            Self::Transmittance => Some(Role::Transmittance),
            Self::Sensitivity | Self::QuantumEfficiency => Some(Role::Camera),
            Self::Irradiance | Self::Radiance | Self::RadiantFlux | Self::RadiantIntensity | Self::SpectralPower => {
                Some(Role::Illuminant)
            }
            // Neither a light nor a fraction of one that a picture needs.
            Self::Absorptance | Self::Counts => Some(Role::Unknown),
            Self::Relative | Self::Unknown => None,
        }
    }
}

impl Certainty {
    /// Returns whether the user should check it: a guess, or an open decision.
    pub fn is_doubtful(self) -> bool {
        matches!(self, Self::Guess | Self::Open)
    }
}

/// Reader of a file format. Each stands, with its words, in the file of its format; `Reader::ALL` has them all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Reader {
    /// The word for it in sessions.
    pub key: &'static str,
    /// Its label in a list of choices.
    pub label: &'static str,
    name: &'static str,
}

impl Reader {
    pub(super) const fn new(key: &'static str, name: &'static str, label: &'static str) -> Self {
        Self { key, label, name }
    }
}

impl fmt::Display for Reader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl Serialize for Reader {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.key)
    }
}

impl<'de> Deserialize<'de> for Reader {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let key = String::deserialize(deserializer)?;
        let found = Self::ALL.iter().copied().find(|reader| reader.key == key);
        found.ok_or_else(|| D::Error::custom(format!("no reader is called {key}")))
    }
}

/// One of several tables, blocks or groups in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The line where its numbers begin, from 1.
    pub line: usize,
    /// Its name in the file, or an empty text.
    pub name: String,
    /// Curves in it.
    pub curves: usize,
    /// Rows of numbers in it (samples, where wavelengths run down).
    pub rows: usize,
}

/// A value with how sure it is and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Decided<T> {
    /// The decided value.
    pub value: T,
    /// Its certainty.
    pub certainty: Certainty,
    /// The evidence, as the first half of a sentence: "Values reach 98".
    pub why: String,
}

impl<T> Decided<T> {
    pub(super) fn certain(value: T, why: impl Into<String>) -> Self {
        Self { value, certainty: Certainty::Certain, why: why.into() }
    }

    pub(super) fn guess(value: T, why: impl Into<String>) -> Self {
        Self { value, certainty: Certainty::Guess, why: why.into() }
    }

    pub(super) fn open(value: T, why: impl Into<String>) -> Self {
        Self { value, certainty: Certainty::Open, why: why.into() }
    }

    pub(super) fn chosen(value: T) -> Self {
        Self { value, certainty: Certainty::Chosen, why: "Chosen by hand".to_owned() }
    }

    /// This decision with its value in words.
    pub(super) fn described(&self, value: &str) -> Decided<String> {
        Decided { value: value.to_owned(), certainty: self.certainty, why: self.why.clone() }
    }

    /// The caller's choice if there is one, else what `decide` finds.
    pub(super) fn or_chosen(choice: Option<T>, decide: impl FnOnce() -> Self) -> Self {
        choice.map_or_else(decide, Self::chosen)
    }
}

/// One decision as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decision {
    /// Subject: "Decimal mark".
    pub what: &'static str,
    /// Value: "decimal commas".
    pub value: String,
    /// Its certainty.
    pub certainty: Certainty,
    /// The evidence: "Cells such as 0,05".
    pub why: String,
    /// Effect of a wrong decision.
    pub effect: Effect,
}

/// Quantity that a wrong decision makes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// The report alone.
    Report,
    /// Numbers, or their use.
    Data,
    /// The scale of all values.
    Scale,
}

impl Decision {
    pub(super) fn new<T: fmt::Display>(what: &'static str, decided: &Decided<T>) -> Self {
        let Decided { value, certainty, why } = decided;
        Self { what, value: value.to_string(), certainty: *certainty, why: why.clone(), effect: Effect::Report }
    }

    /// A decision that the file leaves no doubt about.
    pub(super) fn certain(what: &'static str, value: impl fmt::Display, why: impl Into<String>) -> Self {
        Self::new(what, &Decided::certain(value, why))
    }

    pub(super) fn affecting(self, effect: Effect) -> Self {
        Self { effect, ..self }
    }
}

impl fmt::Display for Decision {
    /// One sentence: "Values reach 98: read as percent."
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.certainty == Certainty::Open {
            return write!(f, "{}: not decided.", self.why);
        }
        write!(f, "{}: read as {}.", self.why, self.value)
    }
}
