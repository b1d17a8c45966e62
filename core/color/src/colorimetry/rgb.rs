//! RGB spaces: Eq 13's matrix, sRGB encoding, gamut triangles.

use super::tristimulus::{Xy, Xyz};
use glam::{DMat3, DVec3};

/// XYZ from linear sRGB, the paper's M of Eq 13 (IEC 61966-2-1, four decimals).
///
/// ```text
///     | 0.4124 0.3576 0.1805 |
/// M = | 0.2126 0.7152 0.0722 |
///     | 0.0193 0.1192 0.9505 |
/// ```
pub const XYZ_FROM_SRGB: DMat3 = DMat3::from_cols(
    DVec3::new(0.4124, 0.2126, 0.0193),
    DVec3::new(0.3576, 0.7152, 0.1192),
    DVec3::new(0.1805, 0.0722, 0.9505),
);

/// Linear sRGB from XYZ as IEC 61966-2-1 prints it, to four decimals.
///
/// It is not quite the inverse of [`XYZ_FROM_SRGB`] (they differ by up to 5e-5), but the paper's balance for D55,
/// 1.1040 : 0.9870 : 0.8233, comes from this one. [`srgb_from_xyz`] is the exact inverse, used everywhere else.
pub const SRGB_FROM_XYZ_PUBLISHED: DMat3 = DMat3::from_cols(
    DVec3::new(3.2406, -0.9689, 0.0557),
    DVec3::new(-1.5372, 1.8758, -0.2040),
    DVec3::new(-0.4986, 0.0415, 1.0570),
);

/// The exact inverse of Eq 13's matrix: linear sRGB from XYZ.
pub fn srgb_from_xyz() -> DMat3 {
    XYZ_FROM_SRGB.inverse()
}

/// The white of Eq 13, M (1, 1, 1): D65 to four decimals.
pub fn srgb_white() -> Xyz {
    Xyz::from_vector(XYZ_FROM_SRGB * DVec3::ONE)
}

/// A color as a screen shows it, and whether it had to be moved into the screen's range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EncodedSrgb {
    /// Eight bits a channel.
    pub bytes: [u8; 3],
    /// True if a channel was below 0 or above 1 by more than half a step of the encoding.
    pub clipped: bool,
}

/// Encodes linear sRGB for a screen (IEC 61966-2-1), clipping last.
///
/// ```text
/// v′ = 12.92 v                    v ≤ 0.0031308
/// v′ = 1.055 v^(1/2.4) − 0.055    otherwise
/// ```
/// Components that are not finite become black and count as clipped.
///
/// ```
/// use chromascope_core::colorimetry::rgb::encode_srgb;
/// assert_eq!(encode_srgb([1.0, 0.5, 0.0]).bytes, [255, 188, 0]);
/// assert!(encode_srgb([1.2, 0.5, -0.1]).clipped);
/// ```
pub fn encode_srgb(linear: [f64; 3]) -> EncodedSrgb {
    let mut clipped = false;
    let bytes = linear.map(|v| {
        let encoded = 255.0 * srgb_transfer(if v.is_finite() { v } else { -1.0 });
        clipped |= !(-0.5..=255.5).contains(&encoded);
        // `as` saturates, which is the clipping.
        encoded.round() as u8
    });
    EncodedSrgb { bytes, clipped }
}

/// The transfer function of sRGB, continued as a straight line below zero.
pub fn srgb_transfer(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Linear from encoded sRGB: the inverse of [`srgb_transfer`].
pub fn srgb_inverse_transfer(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A display's range of colors in the diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gamut {
    /// Its name.
    pub name: &'static str,
    /// The primaries red, green and blue.
    pub primaries: [Xy; 3],
}

/// The outlines offered on the diagram: sRGB (IEC 61966-2-1), DCI-P3 (SMPTE RP 431-2), Rec. 2020 (ITU-R BT.2020).
pub const GAMUTS: [Gamut; 3] = [
    Gamut { name: "sRGB", primaries: [Xy { x: 0.64, y: 0.33 }, Xy { x: 0.30, y: 0.60 }, Xy { x: 0.15, y: 0.06 }] },
    Gamut { name: "DCI-P3", primaries: [Xy { x: 0.68, y: 0.32 }, Xy { x: 0.265, y: 0.69 }, Xy { x: 0.15, y: 0.06 }] },
    Gamut {
        name: "Rec. 2020",
        primaries: [Xy { x: 0.708, y: 0.292 }, Xy { x: 0.17, y: 0.797 }, Xy { x: 0.131, y: 0.046 }],
    },
];
