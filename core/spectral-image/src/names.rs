//! Names of spectral channels in `OpenEXR` (Fichet, Pacanowski and Wilkie 2021, JCGT 10(3)).

use crate::image::ImageQuantity;

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

/// Power of ten of an SI prefix.
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
