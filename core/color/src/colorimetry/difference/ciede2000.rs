//! CIEDE2000 without branches, so that several pairs go side by side.
//!
//! Hues are represented as directions, not as angles: the mean hue bisects two of them, and the cosines of its multiples
//! are polynomials. Differences are formed before anything is squared, so that small ones keep their digits.

use super::{Lab, bounded};
use crate::math::exp::exp;
use multiversion::multiversion;

/// Pairs that are worked on side by side: whole registers of any width, and as many as the usual chart has.
const LANES: usize = 24;

/// sin and cos of 6°, 30° and 63°, which the weighting of hues turns by.
const SIN_6: f64 = 0.104_528_463_267_653_47;
const COS_6: f64 = 0.994_521_895_368_273_3;
const COS_30: f64 = 0.866_025_403_784_438_6;
const SIN_63: f64 = 0.891_006_524_188_367_9;
const COS_63: f64 = 0.453_990_499_739_546_8;
/// sin and cos of 275°, where the ellipses of blue are turned most.
const SIN_275: f64 = -0.996_194_698_091_745_5;
const COS_275: f64 = 0.087_155_742_747_658_18;

/// The cosine of the angle from 275° beyond which nothing is turned: e^-(160/25)² is below the last bit.
const UNTURNED: f64 = -0.94;

/// The differences of pairs; the slices are of one length. Compiled for several instruction sets, the best chosen at run
/// time; no operation is fused, so all of them give the same bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub(super) fn fill(firsts: &[Lab], seconds: &[Lab], answers: &mut [f64]) {
    let mut lanes = [[0.0; LANES]; 6];
    for ((firsts, seconds), answers) in firsts.chunks(LANES).zip(seconds.chunks(LANES)).zip(answers.chunks_mut(LANES)) {
        for (lane, (first, second)) in firsts.iter().zip(seconds).enumerate().take(LANES) {
            let (first, second) = (bounded(*first), bounded(*second));
            let pair = [first.l, first.a, first.b, second.l, second.a, second.b];
            for row in 0..6 {
                lanes[row][lane] = pair[row];
            }
        }
        let mut found = [0.0; LANES];
        for lane in 0..LANES {
            let at = |row: usize| lanes[row][lane];
            found[lane] = difference([at(0), at(1), at(2)], [at(3), at(4), at(5)]);
        }
        answers.copy_from_slice(&found[..answers.len()]);
    }
}

/// The difference of two colors whose coordinates are bounded.
#[inline(always)]
pub(super) fn difference(first: [f64; 3], second: [f64; 3]) -> f64 {
    let [l, c, h, turn] = components(first, second);
    (l * l + c * c + h * h + turn * c * h).max(0.0).sqrt()
}

/// Weighted differences of lightness, chroma and hue, and the factor of the rotation term `R_T c h`.
#[inline(always)]
pub(super) fn components([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> [f64; 4] {
    let mean_chroma = 0.5 * (length(a1, b1) + length(a2, b2));
    let stretch = 1.5 - 0.5 * chroma_share(mean_chroma).sqrt();
    let turning = turning([a1, b1], [a2, b2]);
    let (da, db) = (stretch * (a2 - a1), b2 - b1);
    let (a1, a2) = (stretch * a1, stretch * a2);
    let (c1, c2) = (length(a1, b1), length(a2, b2));
    let dc = (da * (a1 + a2) + db * (b1 + b2)) / nonzero(c1 + c2);
    let hues = Hues::new([a1, b1, c1], [a2, b2, c2], a1 * db - b1 * da, turning);

    let c = 0.5 * (c1 + c2);
    let from_50 = 0.5 * (l1 + l2) - 50.0;
    let lift = from_50 * from_50;
    let l = (l2 - l1) / (1.0 + 0.015 * lift / (20.0 + lift).sqrt());
    let h = hues.difference / (1.0 + 0.015 * c * hue_weight(hues.mean));
    let turn = -2.0 * chroma_share(c).sqrt() * sine(std::f64::consts::FRAC_PI_3 * turned(hues.mean));
    let c = dc / (1.0 + 0.045 * c);
    [l, c, h, turn]
}

/// Mean and difference of two hues.
struct Hues {
    /// ΔH′.
    difference: f64,
    /// The direction of the mean hue, of length 1.
    mean: [f64; 2],
}

impl Hues {
    /// Of two colors a′, b′, C′, their vector product, and which way it turns if they are far from each other.
    #[inline(always)]
    fn new([a1, b1, c1]: [f64; 3], [a2, b2, c2]: [f64; 3], cross: f64, turning: f64) -> Self {
        let (dot, size) = (a1 * a2 + b1 * b2, c1 * c2);
        // Of two hues exactly opposite, the one below 180° is the smaller.
        let upwards = if b2 < 0.0 || (b2 == 0.0 && a2 < 0.0) { 1.0 } else { -1.0 };
        let sign = if turning == 0.0 { upwards } else { 1.0_f64.copysign(turning) };
        let acute = dot >= 0.0;
        let half = (0.5 * (size + dot.abs())).sqrt();
        let difference = if acute { cross / nonzero(half) } else { 2.0 * sign * half };
        let (x1, y1) = (a1 / nonzero(c1), b1 / nonzero(c1));
        let (x2, y2) = (a2 / nonzero(c2), b2 / nonzero(c2));
        let x = if acute { x1 + x2 } else { sign * (y2 - y1) };
        let y = if acute { y1 + y2 } else { sign * (x1 - x2) };
        let long = length(x, y);
        // Without any color, the hue is 0.
        let mean = [if long > 0.0 { x / nonzero(long) } else { 1.0 }, y / nonzero(long)];
        Self { difference, mean }
    }
}

/// a₁b₂ − a₂b₁ to the right side of zero, on which a leap of the difference depends: products with their rounding errors
/// (Dekker 1971).
#[inline(always)]
fn turning([a1, b1]: [f64; 2], [a2, b2]: [f64; 2]) -> f64 {
    let ((first, rest), (second, other)) = (product(a1, b2), product(a2, b1));
    (first - second) + (rest - other)
}

/// A product and what its rounding took away.
#[inline(always)]
fn product(a: f64, b: f64) -> (f64, f64) {
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let product = a * b;
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

/// The upper and the lower half of a mantissa (Veltkamp 1968).
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}

/// T, the weight of a mean hue.
#[inline(always)]
fn hue_weight([x, y]: [f64; 2]) -> f64 {
    let (x2, y2) = ((x - y) * (x + y), 2.0 * x * y);
    let (x3, y3) = (x2 * x - y2 * y, y2 * x + x2 * y);
    let (x4, y4) = ((x2 - y2) * (x2 + y2), 2.0 * x2 * y2);
    1.0 - 0.17 * (x * COS_30 + y * 0.5) + 0.24 * x2 + 0.32 * (x3 * COS_6 - y3 * SIN_6)
        - 0.20 * (x4 * COS_63 + y4 * SIN_63)
}

/// Δθ/30°: how far the ellipses of a mean hue are turned.
#[inline(always)]
fn turned([x, y]: [f64; 2]) -> f64 {
    let (cos, sin) = (x * COS_275 + y * SIN_275, y * COS_275 - x * SIN_275);
    // Hues count from 0° to 360°: from 0° on they are far below 275°, not near above it.
    let none = cos < UNTURNED || (y >= 0.0 && x > 0.0);
    // Tangents of a half, a quarter and an eighth of the angle, at most 0.37.
    let half = sin / (1.0 + cos.max(UNTURNED));
    let quarter = half / (1.0 + (1.0 + half * half).sqrt());
    let eighth = quarter / (1.0 + (1.0 + quarter * quarter).sqrt());
    let square = eighth * eighth;
    let mut sum = 0.0;
    for k in (0..18).rev() {
        sum = 1.0 / f64::from(2 * k + 1) - square * sum;
    }
    let share = (8.0 * 180.0 / std::f64::consts::PI / 25.0) * eighth * sum;
    if none { 0.0 } else { exp(-share * share) }
}

/// The sine of 0 to π/3, by Taylor's series.
#[inline(always)]
fn sine(x: f64) -> f64 {
    let square = x * x;
    let mut sum = 1.0;
    for k in (1..10).rev() {
        sum = 1.0 - square * (1.0 / f64::from(2 * k * (2 * k + 1))) * sum;
    }
    x * sum
}

/// c⁷ / (c⁷ + 25⁷), without overflow.
#[inline(always)]
fn chroma_share(c: f64) -> f64 {
    let r = c.min(1e9) / 25.0;
    let cube = r * r * r;
    let seventh = cube * cube * r;
    seventh / (seventh + 1.0)
}

#[inline(always)]
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// A divisor: what would be divided by zero is zero itself.
#[inline(always)]
fn nonzero(divisor: f64) -> f64 {
    if divisor == 0.0 { 1.0 } else { divisor }
}
