//! CIECAM02 with complete adaptation, and its uniform color space.

use super::adaptation::CAT02;
use super::tristimulus::Xyz;
use glam::{DMat3, DVec3};

/// Cone responses from tristimulus values (Hunt, Pointer and Estévez).
const CONES: DMat3 = DMat3::from_cols(
    DVec3::new(0.38971, -0.22981, 0.0),
    DVec3::new(0.68898, 1.18340, 0.0),
    DVec3::new(-0.07868, 0.04641, 1.0),
);

/// Luminance of the adapting field in cd/m², that of TM-30 and CIE 224.
const ADAPTING: f64 = 100.0;
/// Relative luminance of the background, in percent of the white's.
const BACKGROUND: f64 = 20.0;

/// Coordinates in CAM02-UCS.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cam02Ucs {
    /// J′, lightness.
    pub j: f64,
    /// a′, red against green.
    pub a: f64,
    /// b′, yellow against blue.
    pub b: f64,
    /// Hue angle h of CIECAM02 in degrees, 0 to 360.
    pub hue: f64,
}

impl Cam02Ucs {
    /// Euclidean distance ΔE′.
    pub fn distance(self, other: Self) -> f64 {
        (self.j - other.j).hypot(self.a - other.a).hypot(self.b - other.b)
    }
}

/// Appearance under one white with complete adaptation (D = 1), average surround, adapting luminance 100 cd/m² and a background of
/// 20 % (CIE 159:2004; conditions of CIE 224:2017).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ciecam02 {
    cones_from_xyz: DMat3,
    level: f64,
    induction: f64,
    exponent: f64,
    white: f64,
    scale: f64,
}

impl Ciecam02 {
    /// The model under a white; none where the white has a sharpened response or an achromatic response that is not positive.
    pub fn new(white: Xyz) -> Option<Self> {
        let sharpened = CAT02 * white.to_vector();
        let scale = 100.0 / white.y;
        if !(sharpened.min_element() > 0.0 && scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let k = 1.0 / (5.0 * ADAPTING + 1.0);
        let level = 0.2 * k.powi(4) * (5.0 * ADAPTING) + 0.1 * (1.0 - k.powi(4)).powi(2) * (5.0 * ADAPTING).cbrt();
        let n = BACKGROUND / 100.0;
        let induction = 0.725 * n.powf(-0.2);
        let gains = DMat3::from_diagonal(DVec3::splat(100.0) / (sharpened * scale));
        let cones_from_xyz = CONES * CAT02.inverse() * gains * CAT02;
        let mut model = Self { cones_from_xyz, level, induction, exponent: 1.48 + n.sqrt(), white: 0.0, scale };
        model.white = model.achromatic(model.compressed(white));
        (model.white > 0.0).then_some(model)
    }

    /// Coordinates in CAM02-UCS of a color in the white's units; none where lightness is undefined.
    ///
    /// ```text
    /// J′ = 1.7 J / (1 + 0.007 J),   M′ = ln(1 + 0.0228 M) / 0.0228,   a′ = M′ cos h,   b′ = M′ sin h
    /// ```
    /// Source: Luo, Cui and Li 2006.
    pub fn ucs(&self, color: Xyz) -> Option<Cam02Ucs> {
        let rgb = self.compressed(color);
        let (a, b) = (rgb.x - 12.0 * rgb.y / 11.0 + rgb.z / 11.0, (rgb.x + rgb.y - 2.0 * rgb.z) / 9.0);
        let hue = b.atan2(a);
        let eccentricity = 0.25 * ((hue + 2.0).cos() + 3.8);
        // c = 0.69 and N_c = 1 of an average surround.
        let j = 100.0 * (self.achromatic(rgb) / self.white).powf(0.69 * self.exponent);
        let sum = rgb.x + rgb.y + 21.0 * rgb.z / 20.0;
        let t = 50_000.0 / 13.0 * self.induction * eccentricity * a.hypot(b) / sum;
        let n: f64 = BACKGROUND / 100.0;
        let chroma = t.powf(0.9) * (j / 100.0).sqrt() * (1.64 - 0.29_f64.powf(n)).powf(0.73);
        let colorfulness = (0.0228 * chroma * self.level.powf(0.25)).ln_1p() / 0.0228;
        let (sin, cos) = hue.sin_cos();
        let ucs = Cam02Ucs {
            j: 1.7 * j / (1.0 + 0.007 * j),
            a: colorfulness * cos,
            b: colorfulness * sin,
            hue: hue.to_degrees().rem_euclid(360.0),
        };
        (ucs.j.is_finite() && ucs.a.is_finite() && ucs.b.is_finite()).then_some(ucs)
    }

    /// Adapted cone responses after compression; odd, so that negative responses stay negative.
    fn compressed(&self, color: Xyz) -> DVec3 {
        let cones = self.cones_from_xyz * (color.to_vector() * self.scale);
        DVec3::from_array(cones.to_array().map(|v| {
            let power = (self.level * v.abs() / 100.0).powf(0.42);
            400.0 * power.copysign(v) / (27.13 + power) + 0.1
        }))
    }

    fn achromatic(&self, rgb: DVec3) -> f64 {
        (2.0 * rgb.x + rgb.y + rgb.z / 20.0 - 0.305) * self.induction
    }
}
