//! Headers of ENVI images: `field = value` lines, lists in braces.

use crate::error::ImageError;
use crate::image::{ImageInfo, ImageQuantity, MAX_BANDS, Note, ascending};

/// Type of the samples, by ENVI's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names are the types")]
pub enum DataType {
    U8,
    I16,
    I32,
    F32,
    F64,
    U16,
    U32,
    I64,
    U64,
}

impl DataType {
    fn from_number(number: &str) -> Option<Self> {
        Some(match number {
            "1" => Self::U8,
            "2" => Self::I16,
            "3" => Self::I32,
            "4" => Self::F32,
            "5" => Self::F64,
            "12" => Self::U16,
            "13" => Self::U32,
            "14" => Self::I64,
            "15" => Self::U64,
            _ => return None,
        })
    }

    /// Bytes of a sample.
    pub fn bytes(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

/// Order of the samples in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interleave {
    /// Line by line, in each band by band.
    Bil,
    /// Pixel by pixel.
    Bip,
    /// Band by band.
    Bsq,
}

/// Contents of an ENVI header, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct EnviHeader {
    /// Size, wavelengths of the usable bands, quantity and notes.
    pub info: ImageInfo,
    /// Type of the samples.
    pub data_type: DataType,
    /// Order of the samples.
    pub interleave: Interleave,
    /// True if the most significant byte comes first.
    pub big_endian: bool,
    /// Bytes before the first sample.
    pub offset: u64,
    /// Number of bands in the file, the bad ones among them.
    pub file_bands: usize,
    /// Bands of the file in the order of [`ImageInfo::wavelengths_nm`].
    pub bands: Vec<usize>,
    /// Factor on the samples of each of those bands.
    pub gains: Vec<f64>,
    /// Term added after the factor.
    pub offsets: Vec<f64>,
    /// Value that stands for none.
    pub ignore: Option<f64>,
}

struct Field<'a> {
    line: usize,
    name: String,
    value: &'a str,
}

impl Field<'_> {
    fn refuse(&self, field: &'static str, remedy: &'static str) -> ImageError {
        let value = self.value.chars().filter(|c| !c.is_control()).take(40).collect();
        ImageError::Value { line: self.line, field, value, remedy }
    }
}

struct Fields<'a>(Vec<Field<'a>>);

/// Most fields that are looked at; real headers have below a hundred.
const MAX_FIELDS: usize = 10_000;

impl<'a> Fields<'a> {
    fn read(text: &'a str) -> Result<Self, ImageError> {
        let mut rest = text.trim_start_matches('\u{feff}');
        let mut line = 1;
        let first = rest.lines().next().unwrap_or_default();
        if first.trim() != "ENVI" {
            return Err(ImageError::NotEnvi);
        }
        rest = &rest[first.len()..];
        let mut fields = Vec::new();
        while !rest.is_empty() && fields.len() < MAX_FIELDS {
            let line_end = |from: usize| rest[from..].find('\n').map_or(rest.len(), |at| from + at + 1);
            let mut end = line_end(0);
            let row = rest[..end].trim();
            if !(row.is_empty() || row.starts_with(';')) {
                let (name, mut value) = rest[..end].split_once('=').ok_or(ImageError::Line { line })?;
                let name = name.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
                if value.trim_start().starts_with('{') {
                    let open = rest.find('{').unwrap_or(0);
                    let close = rest[open..].find('}').ok_or(ImageError::Open { line, field: name.clone() })? + open;
                    (value, end) = (&rest[open + 1..close], line_end(close));
                }
                fields.push(Field { line, name, value: value.trim() });
            }
            line += rest[..end].matches('\n').count();
            rest = &rest[end..];
        }
        Ok(Self(fields))
    }

    fn get(&self, name: &str) -> Option<&Field<'a>> {
        self.0.iter().find(|field| field.name == name)
    }

    fn integer(&self, name: &'static str, example: &'static str) -> Result<usize, ImageError> {
        let field = self.get(name).ok_or(ImageError::Missing { field: name, example })?;
        field.value.parse().map_err(|_| field.refuse(name, "expected a whole number"))
    }

    fn number(&self, name: &'static str) -> Result<Option<f64>, ImageError> {
        let Some(field) = self.get(name) else { return Ok(None) };
        field.value.parse().map(Some).map_err(|_| field.refuse(name, "expected a number"))
    }

    fn list(&self, name: &'static str, bands: usize) -> Result<Option<Vec<f64>>, ImageError> {
        let Some(field) = self.get(name) else { return Ok(None) };
        let parts = field.value.split(',').map(str::trim).filter(|part| !part.is_empty()).take(MAX_BANDS + 1);
        let numbers = parts.map(|part| part.parse::<f64>().ok().filter(|value| value.is_finite()));
        let numbers: Option<Vec<f64>> = numbers.collect();
        let numbers = numbers.ok_or_else(|| field.refuse(name, "expected numbers separated by commas"))?;
        if numbers.len() == bands {
            Ok(Some(numbers))
        } else {
            Err(ImageError::Length { line: field.line, field: name, found: numbers.len(), bands })
        }
    }
}

impl EnviHeader {
    /// Reads a header. Text that is not UTF-8 is taken with replacement characters.
    ///
    /// # Errors
    ///
    /// [`ImageError`] with line, field and remedy.
    pub fn parse(bytes: &[u8]) -> Result<Self, ImageError> {
        let text = String::from_utf8_lossy(bytes);
        let fields = Fields::read(&text)?;
        let [width, height] = [fields.integer("samples", "640")?, fields.integer("lines", "480")?];
        let file_bands = fields.integer("bands", "31")?;
        ImageInfo::check_size([width, height, file_bands], ["samples", "lines", "bands"])?;
        refuse_unread(&fields)?;
        let data_type = data_type(&fields)?;
        let mut notes = Vec::new();
        let wavelengths = wavelengths(&fields, file_bands, &mut notes)?;
        let good = good_bands(&fields, file_bands, &mut notes)?;
        let kept: Vec<f64> = good.iter().map(|&band| wavelengths[band]).collect();
        let order = ascending(&kept, "wavelength")?;
        if order.windows(2).any(|pair| pair[0] > pair[1]) {
            notes.push(Note::Sorted);
        }
        let bands: Vec<usize> = order.iter().map(|&at| good[at]).collect();
        let scale = fields.number("reflectance scale factor")?;
        if let (Some(value), Some(field)) = (scale, fields.get("reflectance scale factor"))
            && !(value > 0.0 && value.is_finite() && value.recip().is_finite())
        {
            return Err(
                field.refuse("reflectance scale factor", "expected the number that stands for a reflectance of 1")
            );
        }
        notes.extend(scale.filter(|scale| *scale != 1.0).map(Note::Scale));
        let factor = scale.map_or(1.0, f64::recip);
        let by_band = |list: Option<Vec<f64>>, default: f64| -> Vec<f64> {
            bands.iter().map(|&band| list.as_ref().map_or(default, |list| list[band]) * factor).collect()
        };
        let gains = by_band(fields.list("data gain values", file_bands)?, 1.0);
        let offsets = by_band(fields.list("data offset values", file_bands)?, 0.0);
        let wavelengths_nm = bands.iter().map(|&band| wavelengths[band]).collect();
        let quantity = if scale.is_some() { Some(ImageQuantity::Reflectance) } else { stated_quantity(&fields) };
        Ok(Self {
            info: ImageInfo { width, height, wavelengths_nm, quantity, notes },
            data_type,
            interleave: interleave(&fields)?,
            big_endian: big_endian(&fields, data_type)?,
            offset: if fields.get("header offset").is_some() {
                fields.integer("header offset", "0")? as u64
            } else {
                0
            },
            file_bands,
            bands,
            gains,
            offsets,
            // A sample of NaN is none anyway.
            ignore: fields.number("data ignore value")?.filter(|value| value.is_finite()),
        })
    }

    /// Bytes that the data file has at least; none beyond 2⁶⁴.
    pub fn data_bytes(&self) -> Option<u64> {
        let samples = (self.info.width as u64).checked_mul(self.info.height as u64)?;
        samples
            .checked_mul(self.file_bands as u64)?
            .checked_mul(self.data_type.bytes() as u64)?
            .checked_add(self.offset)
    }
}

/// Refuses what would be read as something else than it is.
fn refuse_unread(fields: &Fields<'_>) -> Result<(), ImageError> {
    if let Some(field) = fields.get("file compression").filter(|field| field.value != "0") {
        return Err(field.refuse("file compression", "save the image without compression"));
    }
    for name in ["major frame offsets", "minor frame offsets"] {
        let nonzero = |field: &&Field<'_>| field.value.chars().any(|c| ('1'..='9').contains(&c));
        if let Some(field) = fields.get(name).filter(nonzero) {
            return Err(field.refuse(name, "frame offsets are not supported; save the image without them"));
        }
    }
    Ok(())
}

fn data_type(fields: &Fields<'_>) -> Result<DataType, ImageError> {
    let field = fields.get("data type").ok_or(ImageError::Missing { field: "data type", example: "4" })?;
    DataType::from_number(field.value).ok_or_else(|| {
        field.refuse("data type", "expected 1, 2, 3, 4, 5, 12, 13, 14 or 15; complex samples are not supported")
    })
}

fn interleave(fields: &Fields<'_>) -> Result<Interleave, ImageError> {
    let field = fields.get("interleave").ok_or(ImageError::Missing { field: "interleave", example: "bil" })?;
    match field.value.to_ascii_lowercase().as_str() {
        "bil" => Ok(Interleave::Bil),
        "bip" => Ok(Interleave::Bip),
        "bsq" => Ok(Interleave::Bsq),
        _ => Err(field.refuse("interleave", "expected bil, bip or bsq")),
    }
}

fn big_endian(fields: &Fields<'_>, data_type: DataType) -> Result<bool, ImageError> {
    let Some(field) = fields.get("byte order") else {
        let missing = ImageError::Missing { field: "byte order", example: "0" };
        return if data_type.bytes() == 1 { Ok(false) } else { Err(missing) };
    };
    match field.value {
        "0" => Ok(false),
        "1" => Ok(true),
        _ => Err(field.refuse("byte order", "expected 0 (least significant byte first) or 1 (most significant first)")),
    }
}

fn wavelengths(fields: &Fields<'_>, bands: usize, notes: &mut Vec<Note>) -> Result<Vec<f64>, ImageError> {
    let list = fields.list("wavelength", bands)?;
    let list = list.ok_or(ImageError::Missing { field: "wavelength", example: "{400, 410, 420}" })?;
    let (first, last) = (list.iter().copied().fold(f64::MAX, f64::min), list.iter().copied().fold(f64::MIN, f64::max));
    let unit = fields.get("wavelength units");
    let name = unit.map(|field| field.value.trim_matches(['(', ')', ' ']).to_lowercase()).unwrap_or_default();
    let factor = match name.as_str() {
        "nanometers" | "nanometer" | "nanometres" | "nm" => 1.0,
        "micrometers" | "micrometer" | "micrometres" | "microns" | "um" | "µm" | "μm" => 1e3,
        "angstroms" | "angstrom" => 0.1,
        "" | "unknown" if first >= 150.0 && last <= 20_000.0 => {
            notes.push(Note::Unit { first, last, unit: "nanometers" });
            1.0
        }
        "" | "unknown" if first >= 0.15 && last <= 20.0 => {
            notes.push(Note::Unit { first, last, unit: "micrometers" });
            1e3
        }
        _ => {
            let missing = ImageError::Missing { field: "wavelength units", example: "Nanometers" };
            let remedy = "expected Nanometers, Micrometers or Angstroms";
            return Err(unit.map_or(missing, |field| field.refuse("wavelength units", remedy)));
        }
    };
    // Tenths of a nanometer stay decimal: 0.4005 µm is 400.5 nm.
    let nm = |value: f64| if factor == 1.0 { value } else { (value * factor * 1e9).round() / 1e9 };
    let list: Vec<f64> = list.into_iter().map(nm).collect();
    match fields.get("wavelength") {
        Some(field) if list.iter().any(|nm| !(*nm > 0.0 && *nm < 1e7)) => {
            Err(field.refuse("wavelength", "expected positive wavelengths"))
        }
        _ => Ok(list),
    }
}

fn good_bands(fields: &Fields<'_>, bands: usize, notes: &mut Vec<Note>) -> Result<Vec<usize>, ImageError> {
    let Some(list) = fields.list("bbl", bands)? else { return Ok((0..bands).collect()) };
    let good: Vec<usize> = (0..bands).filter(|&band| list[band] != 0.0).collect();
    if good.is_empty() {
        return Err(ImageError::NoBands);
    }
    if good.len() < bands {
        notes.push(Note::BadBands(bands - good.len()));
    }
    Ok(good)
}

/// Quantity that a field of units or titles names.
fn stated_quantity(fields: &Fields<'_>) -> Option<ImageQuantity> {
    let said = ["data units", "z plot titles"].map(|name| fields.get(name).map_or("", |field| field.value));
    let said = said.join(" ").to_lowercase();
    match (said.contains("reflectance"), said.contains("radiance") && !said.contains("irradiance")) {
        (true, false) => Some(ImageQuantity::Reflectance),
        (false, true) => Some(ImageQuantity::Radiance),
        _ => None,
    }
}
