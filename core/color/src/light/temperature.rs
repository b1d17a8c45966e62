//! Correlated color temperature and Duv: which blackbody a color is nearest to, and how far it is off.
//!
//! The nearest point is sought in the CIE 1960 diagram (u = u′, v = 2v′/3 of 1976), as CIE 15:2004 has it; Duv is the
//! distance, positive above the locus (greener). CIE 15 wants no color temperature where it exceeds 0.05. The definition is
//! for the CIE 1931 2° observer; [`PlanckianLocus`] takes any observer that counts in XYZ.
//!
//! This lies with the blackbodies and not with the chromaticities, because it needs Planck's law; and it needs the observer's
//! curves, for the locus is the sum over them at 1 nm, not a published fit.

mod exact;
mod lanes;
mod nearest;
mod pieces;
pub mod published;
mod result;
pub mod single;
mod start;

use rayon::prelude::*;

use self::exact::ExactLocus;
use self::lanes::{LANES, Lanes};
use self::nearest::Vertices;
use self::pieces::Pieces;
pub use self::result::{COLDEST_K, Cct, CctError, HOTTEST_K, LocusError, MAX_DUV};
use self::result::{COLDEST_MIRED, HOTTEST_MIRED, SLACK, is_in_range};
use self::start::{Start, between};
use crate::colorimetry::{Uv60, Xy, Xyz};
use crate::light::planckian::RadiationConstants;
use crate::spectral::{Primaries, Sensor};
use crate::units::Kelvin;

/// Colors per piece of work: enough to outweigh handing it over.
const CHUNK: usize = 4096;

/// The Planckian locus of an observer, prepared to find the nearest blackbody of any color.
///
/// The nearest point is where the tangent is perpendicular to the line to the color:
///
/// ```text
/// (u(m) − u) u′(m) + (v(m) − v) v′(m) = 0,   m = 10⁶/T
/// ```
/// u and v are polynomials of degree 7 in m, in 256 pieces, made from the 1 nm sums and their exact derivatives; so the
/// condition is a polynomial too, whose coefficients are linear in the color. Newton's method solves it, from a table over the
/// diagram that is right to about a third of a mired.
/// Within [`COLDEST_K`]–[`HOTTEST_K`] and [`MAX_DUV`] of the locus the nearest point is unique: for the CIE 1931 observer the
/// locus nowhere bends with a radius below 0.100.
///
/// The sums go from 380 to 780 nm, as everywhere here. Over the whole table of the CIE, from 360 to 830 nm, temperatures are
/// about 2 K lower at 6500 K: that, and not the method, is the difference from other programs.
///
/// Error against 50 digits, held by tests for the CIE 1931 observer: below 2e-9 K and 1e-15, up to the very ends.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanckianLocus {
    pieces: Pieces,
    vertices: Vertices,
    start: Start,
}

impl PlanckianLocus {
    /// Tabulates the locus of an observer: some 2100 sums over its curves, then a search for each node of the table.
    ///
    /// # Errors
    /// [`LocusError`] unless the observer's matching functions are XYZ with a locus that has one nearest point for each color.
    pub fn new(observer: &Sensor, constants: RadiationConstants) -> Result<Self, LocusError> {
        if observer.primaries() != Primaries::Xyz {
            return Err(LocusError::NotXyz);
        }
        let exact = ExactLocus::new(observer, constants);
        let pieces = Pieces::new(&exact).ok_or(LocusError::NoChromaticity)?;
        let vertices = Vertices::new(&exact, &pieces).ok_or(LocusError::NoChromaticity)?;
        if !is_simple(&pieces) {
            return Err(LocusError::Crooked);
        }
        let start = Start::new(&pieces, &vertices);
        Ok(Self { pieces, vertices, start })
    }

    /// The correlated color temperature and Duv of a chromaticity.
    ///
    /// Nothing is clamped: what lies outside is refused, with the reason. A color further than [`MAX_DUV`] from blackbodies of
    /// all temperatures is [`CctError::TooFar`]; one that is not, but whose nearest is outside [`COLDEST_K`]–[`HOTTEST_K`], is too
    /// hot or too cold.
    ///
    /// # Errors
    /// [`CctError`] where the color is farther than [`MAX_DUV`] from the locus or outside its temperatures.
    #[inline]
    pub fn cct(&self, color: Uv60) -> Result<Cct, CctError> {
        self.cct_by_newton(color).map_or_else(|| self.cct_by_search(color), Ok)
    }

    /// Correlated color temperature and Duv of x and y.
    ///
    /// # Errors
    /// As [`Self::cct`].
    pub fn cct_of_xy(&self, color: Xy) -> Result<Cct, CctError> {
        self.cct(color.uv_prime().ok_or(CctError::NoChromaticity)?.uv60())
    }

    /// Correlated color temperature and Duv of tristimulus values.
    ///
    /// # Errors
    /// As [`Self::cct`].
    pub fn cct_of_xyz(&self, color: Xyz) -> Result<Cct, CctError> {
        self.cct(color.uv_prime().ok_or(CctError::NoChromaticity)?.uv60())
    }

    /// Correlated color temperatures of many colors, on all cores; the answers do not depend on their number.
    pub fn ccts(&self, colors: &[Uv60]) -> Vec<Result<Cct, CctError>> {
        let mut answers = vec![Err(CctError::NoChromaticity); colors.len()];
        self.ccts_into(colors, &mut answers);
        answers
    }

    /// Correlated color temperatures written into existing memory. Extra elements of the longer slice are ignored.
    pub fn ccts_into(&self, colors: &[Uv60], answers: &mut [Result<Cct, CctError>]) {
        let chunks = answers.par_chunks_mut(CHUNK).zip(colors.par_chunks(CHUNK));
        chunks.for_each(|(answers, colors)| {
            let mut lanes = Lanes::NOTHING;
            for (answers, colors) in answers.chunks_mut(LANES).zip(colors.chunks(LANES)) {
                lanes.solve(&self.start, &self.pieces, colors);
                for (lane, (answer, &color)) in answers.iter_mut().zip(colors).enumerate() {
                    // Stored separately in each branch: gathered first, an answer would pass through memory,
                    // misaligned.
                    match lanes.found(lane).and_then(|found| found.cct()) {
                        Some(cct) => *answer = Ok(cct),
                        None => *answer = self.cct_by_search(color),
                    }
                }
            }
        });
    }

    /// The chromaticity of a blackbody, or none outside [`COLDEST_K`]–[`HOTTEST_K`]. Within 2e-15 of the 1 nm sum.
    pub fn at(&self, temperature: Kelvin) -> Option<Uv60> {
        self.off(Cct { temperature, duv: 0.0 })
    }

    /// The color of this temperature and Duv: the inverse of [`Self::cct`]. None outside its domain.
    pub fn off(&self, cct: Cct) -> Option<Uv60> {
        let mired = cct.temperature.mired();
        if !(is_in_range(mired) && cct.duv.abs() <= MAX_DUV) {
            return None;
        }
        let piece = self.pieces.at(mired);
        let motion = piece.motion(piece.t(mired));
        let [du, dv] = motion.per_mired;
        let scale = cct.duv / (du * du + dv * dv).sqrt();
        Some(Uv60 { u: motion.at.u - scale * dv, v: motion.at.v + scale * du })
    }

    /// Newton's method from the table; none if it does not end in the domain.
    fn cct_by_newton(&self, color: Uv60) -> Option<Cct> {
        let place = self.start.place(color);
        let start = between(self.start.cell(place.column, place.row), place.right, place.up);
        let piece = self.pieces.at(start);
        let found = piece.seen(color).solve(piece.t(start), piece.mired);
        if found.good { found.cct() } else { None }
    }

    /// A search over the whole locus that always ends with an answer or the right refusal.
    #[cold]
    fn cct_by_search(&self, color: Uv60) -> Result<Cct, CctError> {
        if !(color.u.is_finite() && color.v.is_finite()) {
            return Err(CctError::NoChromaticity);
        }
        if color.u.abs().max(color.v.abs()) > 10.0 {
            return Err(CctError::TooFar);
        }
        let nearest = self.vertices.nearest(&self.pieces, color);
        if nearest.distance > MAX_DUV * (1.0 + SLACK) {
            return Err(CctError::TooFar);
        }
        if nearest.mired < HOTTEST_MIRED * (1.0 - SLACK) {
            return Err(CctError::TooHot);
        }
        if nearest.mired > COLDEST_MIRED * (1.0 + SLACK) {
            return Err(CctError::TooCold);
        }
        let piece = self.pieces.at(nearest.mired);
        let duv = piece.seen(color).above(piece.t(nearest.mired));
        let temperature = Kelvin::from_mired(nearest.mired).map_err(|_| CctError::TooHot)?;
        Ok(Cct { temperature, duv })
    }
}

/// True if the tangent never stops and turns gently enough for one nearest point within [`MAX_DUV`], with a margin.
fn is_simple(pieces: &Pieces) -> bool {
    let tangents: Vec<[f64; 2]> = pieces.iter().map(|piece| piece.motion(0.0).per_mired).collect();
    let spacing = pieces::WIDTH;
    tangents.windows(2).all(|pair| {
        let ([a, b], [c, d]) = (pair[0], pair[1]);
        let turn = (a * d - b * c).atan2(a * c + b * d).abs();
        let length = spacing * a.hypot(b).min(c.hypot(d));
        length > 1e-7 && turn * 1.2 * MAX_DUV < length
    })
}
