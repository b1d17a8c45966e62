//! `OpenEXR` images with spectral channels, by the names of channels of Fichet, Pacanowski and Wilkie 2021, JCGT 10(3).

use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;

use exr::block::chunk::TileCoordinates;
use exr::block::reader::ChunksReader as _;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::meta::MetaData;
use exr::meta::attribute::{ChannelList, SampleType};
use exr::meta::header::Header;
use exr::prelude::f16;

use crate::error::ImageError;
use crate::image::{ImageInfo, ImageQuantity, MAX_ROW_BYTES, Note, ascending};

/// `OpenEXR` image whose rows are read when requested.
#[derive(Debug)]
pub struct ExrImage<R> {
    info: ImageInfo,
    data: R,
    layer: usize,
    channels: ChannelList,
    /// Place in a pixel of each channel of the layer; none for one that is not part of the spectrum.
    places: Vec<Option<usize>>,
}

impl<R: Read + Seek> ExrImage<R> {
    /// Reads the header; `wanted` chooses between radiance and reflectance where a file has both.
    ///
    /// # Errors
    ///
    /// [`ImageError`] where the header cannot be read or has no spectral channels.
    pub fn new(mut data: R, wanted: Option<ImageQuantity>) -> Result<Self, ImageError> {
        let length = data.seek(SeekFrom::End(0))?;
        data.seek(SeekFrom::Start(0))?;
        let meta = MetaData::read_from_buffered(std::io::BufReader::new(&mut data), false)?;
        let mut spectra = meta.headers.iter().map(|header| spectrum(header, wanted)).enumerate();
        let found = spectra.find_map(|(layer, found)| found.transpose().map(|found| (layer, found)));
        let (layer, found) = found.ok_or(ImageError::NoSpectrum)?;
        let (quantity, found) = found?;
        let header = &meta.headers[layer];
        check(header, length)?;
        let (width, height) = (header.layer_size.width(), header.layer_size.height());
        ImageInfo::check_size([width, height, found.len()], ["width", "height", "spectral channels"])?;
        let nm: Vec<f64> = found.iter().map(|(_, nm)| *nm).collect();
        let order = ascending(&nm, "channels")?;
        let mut places = vec![None; header.channels.list.len()];
        for (place, &at) in order.iter().enumerate() {
            places[found[at].0] = Some(place);
        }
        let others = places.iter().filter(|place| place.is_none()).count();
        let notes = (others > 0).then_some(Note::OtherChannels(others)).into_iter().collect();
        let wavelengths_nm = order.iter().map(|&at| nm[at]).collect();
        let info = ImageInfo { width, height, wavelengths_nm, quantity: Some(quantity), notes };
        Ok(Self { info, layer, channels: header.channels.clone(), places, data })
    }

    /// Size, bands and quantity.
    pub fn info(&self) -> &ImageInfo {
        &self.info
    }

    /// Reads rows, as [`crate::SpectralImage::read_rows`].
    ///
    /// # Errors
    ///
    /// [`ImageError`] where the data cannot be decoded, or there are no such rows.
    pub fn read_rows(&mut self, rows: Range<usize>, samples: &mut Vec<f32>) -> Result<(), ImageError> {
        self.info.check_rows(&rows)?;
        samples.clear();
        samples.resize(rows.len() * self.info.row_samples(), f32::NAN);
        if rows.is_empty() {
            return Ok(());
        }
        self.data.seek(SeekFrom::Start(0))?;
        let layer = self.layer;
        let within = |_: &MetaData, _: TileCoordinates, block: BlockIndex| {
            let top = block.pixel_position.y();
            let touches = top < rows.end && top + block.pixel_size.height() > rows.start;
            block.layer == layer && block.level.x() == 0 && block.level.y() == 0 && touches
        };
        let reader = exr::block::read(std::io::BufReader::new(&mut self.data), false)?;
        let mut blocks = reader.filter_chunks(false, within)?.sequential_decompressor(false);
        let into = Filled { info: &self.info, channels: &self.channels, places: &self.places, rows: &rows };
        while let Some(block) = blocks.decompress_next_block() {
            into.take(&block?, samples)?;
        }
        Ok(())
    }
}

struct Filled<'a> {
    info: &'a ImageInfo,
    channels: &'a ChannelList,
    places: &'a [Option<usize>],
    rows: &'a Range<usize>,
}

impl Filled<'_> {
    /// Takes the lines of a block that lie within the rows.
    fn take(&self, block: &UncompressedBlock, samples: &mut [f32]) -> Result<(), ImageError> {
        let bands = self.info.wavelengths_nm.len();
        if block.data.len() != block.index.pixel_size.area() * self.channels.bytes_per_pixel {
            return Err(ImageError::Exr("a block has another size than its channels take".to_owned()));
        }
        for line in block.lines(self.channels) {
            let at = line.location;
            let Some(place) = self.places.get(at.channel).copied().flatten() else { continue };
            let row = at.position.y();
            if !self.rows.contains(&row) || at.position.x() + at.sample_count > self.info.width {
                continue;
            }
            let first = ((row - self.rows.start) * self.info.width + at.position.x()) * bands;
            let pixels = samples[first..first + at.sample_count * bands].chunks_exact_mut(bands);
            let finite = |value: f32| if value.is_finite() { value } else { f32::NAN };
            macro_rules! each {
                ($type:ty, $value:expr) => {
                    for (pixel, sample) in pixels.zip(line.read_samples::<$type>()) {
                        pixel[place] = $value(sample?);
                    }
                };
            }
            match self.channels.list[at.channel].sample_type {
                SampleType::F32 => each!(f32, finite),
                SampleType::F16 => each!(f16, |value: f16| finite(value.to_f32())),
                SampleType::U32 => each!(u32, |value: u32| value as f32),
            }
        }
        Ok(())
    }
}

/// Channels of a spectrum by their place in the layer, with their wavelengths.
type Spectrum = (ImageQuantity, Vec<(usize, f64)>);

fn spectrum(header: &Header, wanted: Option<ImageQuantity>) -> Result<Option<Spectrum>, ImageError> {
    let name = |channel: &exr::meta::attribute::ChannelDescription| SpectralChannel::parse(&channel.name.to_string());
    let all: Vec<(usize, SpectralChannel)> =
        header.channels.list.iter().enumerate().filter_map(|(at, channel)| Some((at, name(channel)?))).collect();
    let has = |quantity| all.iter().any(|(_, channel)| channel.quantity == quantity);
    let quantity = match (has(ImageQuantity::Radiance), has(ImageQuantity::Reflectance), wanted) {
        (true, true, None) => return Err(ImageError::Both),
        (true, true, Some(wanted)) => wanted,
        (true, false, _) => ImageQuantity::Radiance,
        (false, true, _) => ImageQuantity::Reflectance,
        (false, false, _) => return Ok(None),
    };
    let of_quantity = all.iter().filter(|(_, channel)| channel.quantity == quantity);
    Ok(Some((quantity, of_quantity.map(|(at, channel)| (*at, channel.nm)).collect())))
}

/// Refuses what cannot be read, and blocks larger than a row may be, before anything is allocated by them.
fn check(header: &Header, length: u64) -> Result<(), ImageError> {
    if header.deep {
        return Err(ImageError::Unsupported("deep OpenEXR is not supported; flatten the image"));
    }
    if header.channels.list.iter().any(|channel| channel.sampling.x() != 1 || channel.sampling.y() != 1) {
        return Err(ImageError::Unsupported("subsampled channels are not supported; save all channels at full size"));
    }
    if header.max_block_byte_size() > MAX_ROW_BYTES {
        return Err(ImageError::Unsupported("blocks of more than 256 MB are not supported; save with smaller tiles"));
    }
    // Each chunk has 8 bytes in the table of offsets.
    let expected = (header.chunk_count as u64).saturating_mul(8);
    if expected > length { Err(ImageError::Short { expected, found: length }) } else { Ok(()) }
}

/// Spectral channel: quantity and wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralChannel {
    /// Radiance for `S0`, reflectance for `T`.
    pub quantity: ImageQuantity,
    /// Wavelength in nanometers.
    pub nm: f64,
}

/// Speed of light in nanometers per second.
const LIGHT_NM_PER_S: f64 = 299_792_458e9;

impl SpectralChannel {
    /// Channel of a name such as `S0.550,5nm`, `T.5,5E2nm` or `S0.545THz`; none for any other name, such as those of the Stokes
    /// components S1 to S3 and of reradiation.
    ///
    /// A comma is the decimal mark. Units are m or Hz with an SI prefix.
    pub fn parse(name: &str) -> Option<Self> {
        let (head, rest) = name.split_once('.')?;
        let quantity = match head {
            "S0" => ImageQuantity::Radiance,
            "T" => ImageQuantity::Reflectance,
            _ => return None,
        };
        let (rest, per_second) = match rest.strip_suffix("Hz") {
            Some(rest) => (rest, true),
            None => (rest.strip_suffix('m')?, false),
        };
        let end = rest.rfind(|c: char| c.is_ascii_digit() || c == ',')? + 1;
        let number = &rest[..end];
        if !number.chars().all(|c| c.is_ascii_digit() || matches!(c, ',' | '+' | '-' | 'e' | 'E')) {
            return None;
        }
        let number: f64 = number.replacen(',', ".", 1).parse().ok()?;
        let exponent = prefix(&rest[end..])?;
        // Powers above zero are exact, so 550 nm is 550.
        let scaled = |power: i32| if power < 0 { number / 10_f64.powi(-power) } else { number * 10_f64.powi(power) };
        let nm = if per_second { LIGHT_NM_PER_S / scaled(exponent) } else { scaled(exponent + 9) };
        (nm.is_finite() && nm > 0.0).then_some(Self { quantity, nm })
    }
}

fn prefix(text: &str) -> Option<i32> {
    Some(match text {
        "" => 0,
        "Y" => 24,
        "Z" => 21,
        "E" => 18,
        "P" => 15,
        "T" => 12,
        "G" => 9,
        "M" => 6,
        "k" => 3,
        "h" => 2,
        "da" => 1,
        "d" => -1,
        "c" => -2,
        "m" => -3,
        "u" => -6,
        "n" => -9,
        "p" => -12,
        _ => return None,
    })
}
