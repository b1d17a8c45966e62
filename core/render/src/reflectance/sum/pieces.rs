//! The sum by polynomials, where it is neither slight nor far down.
//!
//! ```text
//! ln S = Σ_jk c_jk T_j(x) T_k(y)
//! ```
//! on pieces of the plane: one octave of g by half an octave of `1 + b/b0`, in the variables
//! ```text
//! x ∝ (g − g1)/(g + g1),  y ∝ (t − t1)/(t + t1),  t = 1 + b/b0
//! ```
//! from −1 to 1, with g1 and t1 in the geometric middle: a logarithm to third order, which holds the logarithms' singularities
//! far off. Of the square of coefficients those that weigh are a staircase, of which lower precisions read less. A piece is made
//! when it is first requested, by what is slow and exact (`fit`): once, in 20 to 120 µs.

mod fit;

use super::Precision;
use chromascope_math::array::array;
use std::sync::OnceLock;

/// The coefficients of a piece in tiles of four by four, x before y, of which
/// ```text
/// ln S = Σ_pq T_4p(x) T_4q(y) Σ_rl tile_pq[r][l] T_r(x) T_l(y),  r, l < 4
/// ```
#[derive(Clone, Debug)]
struct Piece {
    tiles: [Tile; SHAPE.len()],
    /// [`LANES`], which the compiler shall not know: loops of fixed length are unrolled before they could be vectorized.
    lanes: usize,
}

type Tile = [[f64; LANES]; 4];

/// Powers of y side by side.
const LANES: usize = 4;

/// Tiles as p and q, the large ones last. The others would add less than 5e-14.
const SHAPE: [[usize; 2]; 12] =
    [[2, 2], [1, 3], [3, 0], [2, 1], [0, 3], [1, 2], [2, 0], [1, 1], [0, 2], [1, 0], [0, 1], [0, 0]];
/// Number of tiles that leave less than 9e-11, and less than 9e-7: the largest error where g and β are large.
const FINE: usize = 7;
const COARSE: usize = 3;

/// The binary exponents of g from which and to below which there are pieces.
const FIRST: i64 = -10;
const LAST: i64 = 40;
const ROWS: usize = (LAST - FIRST) as usize;
/// The half octaves of t that a row has at most.
const COLUMNS: usize = 18;

static PIECES: [OnceLock<Box<Piece>>; ROWS * COLUMNS] = [const { OnceLock::new() }; ROWS * COLUMNS];

/// An octave of g.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// 1/b0.
    scale: f64,
    columns: usize,
}

static GRID: [Row; ROWS] = grid();

/// b0 grows with g where the terms are many; beyond the columns S is e^-130 of itself at b = 0, or b ≫ g.
const fn grid() -> [Row; ROWS] {
    let mut rows = [Row { scale: 0.0, columns: 0 }; ROWS];
    let (mut i, mut exponent) = (0, FIRST);
    while i < ROWS {
        let (b0, columns) = match exponent {
            ..-4 => (2.0, 5),
            -4..-2 => (2.0, 12),
            -2..0 => (2.0, 16),
            0..4 => (2.0, 18),
            4 => (8.0, 16),
            5 => (32.0, 14),
            _ => ((1_u64 << (exponent + 2)) as f64, 8),
        };
        rows[i] = Row { scale: 1.0 / b0, columns };
        (i, exponent) = (i + 1, exponent + 1);
    }
    rows
}

const MANTISSA: u64 = (1 << 52) - 1;
const BIAS: u64 = 1023;
/// The fourth root of 2 and its powers.
const ROOTS: [f64; 3] = [1.189_207_115_002_721, std::f64::consts::SQRT_2, 1.681_792_830_507_429];
/// Scale that takes `(g − g1)/(g + g1)` over an octave to −1…1, and `(t − t1)/(t + t1)` over half of one.
const TO_X: f64 = (ROOTS[1] + 1.0) / (ROOTS[1] - 1.0);
const TO_Y: f64 = (ROOTS[0] + 1.0) / (ROOTS[0] - 1.0);

/// Place of a pair of arguments in the table.
#[derive(Clone, Copy, Debug)]
struct Place {
    piece: usize,
    x: f64,
    y: f64,
}

/// The piece of an argument outside the pieces: little or no g, no b, or so large a b that other methods are as good.
const NOWHERE: usize = ROWS * COLUMNS;

impl Place {
    /// Without branches.
    #[inline(always)]
    fn of(g: f64, b: f64) -> Self {
        let row = (g.to_bits() >> 52).wrapping_sub(BIAS.wrapping_add_signed(FIRST)) as usize;
        let Row { scale, columns } = GRID[if row < ROWS { row } else { 0 }];
        // NaN stays NaN, and has a column beyond all.
        let t = 1.0 + if b < 0.0 { 0.0 } else { b } * scale;
        let column = column(t);
        let piece = if row < ROWS && column < columns { row * COLUMNS + column } else { NOWHERE };
        Self { piece, x: x(g), y: y(t) }
    }
}

#[inline(always)]
fn column(t: f64) -> usize {
    let bits = t.to_bits();
    let upper = u64::from(bits & MANTISSA >= ROOTS[1].to_bits() & MANTISSA);
    (2 * (bits >> 52).wrapping_sub(BIAS) + upper) as usize
}

#[inline(always)]
fn middle_g(g: f64) -> f64 {
    f64::from_bits(g.to_bits() & !MANTISSA | ROOTS[1].to_bits() & MANTISSA)
}

#[inline(always)]
fn middle_t(t: f64) -> f64 {
    let bits = t.to_bits();
    let root = if bits & MANTISSA >= ROOTS[1].to_bits() & MANTISSA { ROOTS[2] } else { ROOTS[0] };
    f64::from_bits(bits & !MANTISSA | root.to_bits() & MANTISSA)
}

#[inline(always)]
fn x(g: f64) -> f64 {
    let middle = middle_g(g);
    (g - middle) / (g + middle) * TO_X
}

#[inline(always)]
fn y(t: f64) -> f64 {
    let middle = middle_t(t);
    (t - middle) / (t + middle) * TO_Y
}

/// ln S, as exactly as requested, where there is a piece.
#[inline(always)]
pub(super) fn ln(g: f64, b: f64, precision: Precision) -> Option<f64> {
    let place = Place::of(g, b);
    if place.piece == NOWHERE {
        return None;
    }
    let piece = piece(place.piece);
    Some(match precision {
        Precision::Coarse => piece.at::<COARSE>(place.x, place.y),
        Precision::Fine => piece.at::<FINE>(place.x, place.y),
        Precision::Full => piece.at::<{ SHAPE.len() }>(place.x, place.y),
    })
}

/// Arguments that are done together.
pub(super) const RUN: usize = 16;

/// ln S of a run; NaN where there is no piece.
#[inline(always)]
pub(super) fn ln_run(g: &[f64; RUN], b: &[f64; RUN], precision: Precision) -> [f64; RUN] {
    match precision {
        Precision::Coarse => run::<COARSE>(g, b),
        Precision::Fine => run::<FINE>(g, b),
        Precision::Full => run::<{ SHAPE.len() }>(g, b),
    }
}

/// Steps without coefficients run together, the rest one by one: each value has a piece of its own.
#[inline(always)]
fn run<const TILES: usize>(g: &[f64; RUN], b: &[f64; RUN]) -> [f64; RUN] {
    let mut found = [NOWHERE; RUN];
    let (mut t, mut v, mut weights) = ([[0.0; RUN]; 4], [[0.0; RUN]; 4], [[0.0; RUN]; TILES]);
    for i in 0..RUN {
        let place = Place::of(g[i], b[i]);
        found[i] = place.piece;
        let ((near_x, far_x), (near_y, far_y)) = (polynomials(place.x), polynomials(place.y));
        for k in 0..4 {
            (t[k][i], v[k][i]) = (near_x[k], near_y[k]);
        }
        for k in 0..TILES {
            let [p, q] = SHAPE[SHAPE.len() - TILES + k];
            weights[k][i] = far_x[p] * far_y[q];
        }
    }
    let mut lanes = [[f64::NAN; LANES]; RUN];
    for i in 0..RUN {
        if found[i] != NOWHERE {
            let t = [t[0][i], t[1][i], t[2][i], t[3][i]];
            lanes[i] = piece(found[i]).lanes::<TILES>(&array(|k| weights[k][i]), &t);
        }
    }
    let mut logs = [0.0; RUN];
    for i in 0..RUN {
        logs[i] = total(&lanes[i], &[v[0][i], v[1][i], v[2][i], v[3][i]]);
    }
    logs
}

#[inline(always)]
fn piece(index: usize) -> &'static Piece {
    let Some(piece) = PIECES[index].get() else { return made(index) };
    piece
}

#[cold]
#[inline(never)]
fn made(index: usize) -> &'static Piece {
    PIECES[index].get_or_init(|| Box::new(Piece::new(index / COLUMNS, index % COLUMNS)))
}

impl Piece {
    /// Evaluates the polynomial from its last `TILES` tiles of coefficients.
    #[inline(always)]
    fn at<const TILES: usize>(&self, x: f64, y: f64) -> f64 {
        let ((t, p), (v, q)) = (polynomials(x), polynomials(y));
        let mut weights = [0.0; TILES];
        for k in 0..TILES {
            let place = SHAPE[SHAPE.len() - TILES + k];
            weights[k] = p[place[0]] * q[place[1]];
        }
        total(&self.lanes(&weights, &t), &v)
    }

    /// The factors of `T_0(y) … T_3(y)`.
    #[inline(always)]
    fn lanes<const TILES: usize>(&self, weights: &[f64; TILES], t: &[f64; 4]) -> [f64; LANES] {
        let tiles = &self.tiles[SHAPE.len() - TILES..];
        let mut lanes = [0.0; LANES];
        for l in 0..self.lanes.min(LANES) {
            let mut sums = [0.0; 4];
            // In halves: all twelve are too many to be unrolled at opt-level 2, and what is not unrolled is not vectorized.
            for k in 0..TILES / 2 {
                for r in 0..4 {
                    sums[r] += tiles[k][r][l] * weights[k];
                }
            }
            for k in TILES / 2..TILES {
                for r in 0..4 {
                    sums[r] += tiles[k][r][l] * weights[k];
                }
            }
            lanes[l] = (sums[3] * t[3] + sums[2] * t[2]) + (sums[1] * t[1] + sums[0]);
        }
        lanes
    }
}

#[inline(always)]
fn total(lanes: &[f64; LANES], v: &[f64; 4]) -> f64 {
    (lanes[3] * v[3] + lanes[2] * v[2]) + (lanes[1] * v[1] + lanes[0])
}

/// Chebyshev's polynomials: the first four, and every fourth.
#[inline(always)]
fn polynomials(x: f64) -> ([f64; 4], [f64; 4]) {
    let two = 2.0 * x * x - 1.0;
    let four = 2.0 * two * two - 1.0;
    let eight = 2.0 * four * four - 1.0;
    let near = [1.0, x, two, x * (2.0 * two - 1.0)];
    (near, [1.0, four, eight, four * (2.0 * eight - 1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reflectance::ln_diffuse_sum;

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        for precision in Precision::ALL {
            for i in 0..200 {
                let g = 1e-3 * 1.2_f64.powi(i % 97);
                let b = g * 0.07 * f64::from(i);
                let (portable, chosen) = (ln(g, b, precision), ln_diffuse_sum(g, b, precision));
                assert_eq!(portable.map(f64::to_bits), Some(chosen.to_bits()), "g {g}, b {b}");
            }
        }
    }

    #[test]
    fn there_is_a_piece_down_to_e_to_the_minus_27() {
        for i in 0..300 {
            let g = 0.07 * 1.1_f64.powi(i);
            let dark = ln_diffuse_sum(g, 0.0, Precision::Full) - 27.0;
            let mut b = 0.1 * g;
            while ln_diffuse_sum(g, b, Precision::Full) > dark {
                assert!(ln(g, b, Precision::Fine).is_some(), "g {g}, b {b}");
                b *= 1.1;
            }
        }
    }
}
