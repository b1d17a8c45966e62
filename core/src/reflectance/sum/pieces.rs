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
//! as far off as there are octaves. Of the square of coefficients those that weigh are a staircase. A piece is made when it is
//! first asked for (`fit`), some 30 µs, and then costs a tenth of the exponentials of the sum.

#![expect(clippy::inline_always, reason = "every instruction set needs a copy of its own")]

mod fit;

use std::sync::OnceLock;

/// The coefficients of a piece in tiles of four by four, x before y, of which
/// ```text
/// ln S = Σ_pq T_4p(x) T_4q(y) Σ_rl tile_pq[r][l] T_r(x) T_l(y),  r, l < 4
/// ```
#[derive(Clone, Debug)]
pub(super) struct Piece<const TILES: usize> {
    tiles: [[[f64; LANES]; 4]; TILES],
    /// [`LANES`], which the compiler shall not know: loops of fixed length are unrolled before they could be vectorized.
    lanes: usize,
}

/// Powers of y side by side.
const LANES: usize = 4;

/// Which tiles there are: p and q, the large ones last.
type Shape<const TILES: usize> = [[usize; 2]; TILES];

/// Within 3e-14 of ln S.
const FULL_SHAPE: Shape<14> =
    [[3, 1], [2, 2], [1, 3], [0, 4], [3, 0], [2, 1], [1, 2], [0, 3], [2, 0], [1, 1], [0, 2], [1, 0], [0, 1], [0, 0]];
/// Within 4e-11.
const FINE_SHAPE: Shape<9> = [[2, 1], [1, 2], [0, 3], [2, 0], [1, 1], [0, 2], [1, 0], [0, 1], [0, 0]];
/// Within 4e-7.
const COARSE_SHAPE: Shape<4> = [[1, 1], [1, 0], [0, 1], [0, 0]];

/// The binary exponents of g from which and to below which there are pieces.
const FIRST: i32 = -10;
const LAST: i32 = 40;
const ROWS: usize = (LAST - FIRST) as usize;
/// The half octaves of t that a row has at most.
const COLUMNS: usize = 18;

type Pieces<const TILES: usize> = [OnceLock<Box<Piece<TILES>>>; ROWS * COLUMNS];

static FULL: Pieces<14> = [const { OnceLock::new() }; ROWS * COLUMNS];
static FINE: Pieces<9> = [const { OnceLock::new() }; ROWS * COLUMNS];
static COARSE: Pieces<4> = [const { OnceLock::new() }; ROWS * COLUMNS];

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
    let mut i = 0;
    while i < ROWS {
        let exponent = FIRST + i as i32;
        let (b0, columns) = match exponent {
            ..-4 => (2.0, 5),
            -4..0 => (2.0, 16),
            0..4 => (2.0, 18),
            4 => (8.0, 18),
            5 => (32.0, 16),
            _ => ((1_u64 << (exponent + 2)) as f64, 12),
        };
        rows[i] = Row { scale: 1.0 / b0, columns };
        i += 1;
    }
    rows
}

const MANTISSA: u64 = (1 << 52) - 1;
const BIAS: u64 = 1023;
/// The fourth root of 2 and its powers.
const ROOTS: [f64; 3] = [1.189_207_115_002_721, std::f64::consts::SQRT_2, 1.681_792_830_507_429_1];
/// What takes `(g − g1)/(g + g1)` over an octave to −1…1, and `(t − t1)/(t + t1)` over half of one.
const TO_X: f64 = (ROOTS[1] + 1.0) / (ROOTS[1] - 1.0);
const TO_Y: f64 = (ROOTS[0] + 1.0) / (ROOTS[0] - 1.0);

/// Where a pair of arguments lies.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    piece: usize,
    x: f64,
    y: f64,
}

impl Place {
    /// None where there is no piece: little or no g, no b, or so large a b that other ways are as good.
    #[inline(always)]
    pub(super) fn of(g: f64, b: f64) -> Option<Self> {
        let row = (g.to_bits() >> 52).wrapping_sub(BIAS.wrapping_add_signed(FIRST as i64)) as usize;
        let &Row { scale, columns } = GRID.get(row)?;
        let t = 1.0 + b * scale;
        // What is below 1, or no number, has a column beyond all.
        let column = column(t);
        (column < columns).then(|| Self { piece: row * COLUMNS + column, x: x(g), y: y(t) })
    }
}

/// The half octave of t.
#[inline(always)]
fn column(t: f64) -> usize {
    let bits = t.to_bits();
    let upper = u64::from(bits & MANTISSA >= ROOTS[1].to_bits() & MANTISSA);
    (2 * (bits >> 52).wrapping_sub(BIAS) + upper) as usize
}

/// The middle of an octave of g.
#[inline(always)]
fn middle_g(g: f64) -> f64 {
    f64::from_bits(g.to_bits() & !MANTISSA | ROOTS[1].to_bits() & MANTISSA)
}

/// The middle of half an octave of t.
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

/// ln S at a place, as exactly as is asked for.
#[inline(always)]
pub(super) fn ln(place: &Place, precision: super::Precision) -> f64 {
    match precision {
        super::Precision::Coarse => read(&COARSE, &COARSE_SHAPE, place),
        super::Precision::Fine => read(&FINE, &FINE_SHAPE, place),
        super::Precision::Full => read(&FULL, &FULL_SHAPE, place),
    }
}

#[inline(always)]
fn read<const TILES: usize>(pieces: &Pieces<TILES>, shape: &Shape<TILES>, place: &Place) -> f64 {
    let slot = &pieces[place.piece];
    slot.get().map_or_else(|| made(slot, shape, place.piece), |piece| piece).at(shape, place.x, place.y)
}

#[cold]
#[inline(never)]
fn made<'a, const TILES: usize>(
    slot: &'a OnceLock<Box<Piece<TILES>>>,
    shape: &Shape<TILES>,
    piece: usize,
) -> &'a Piece<TILES> {
    slot.get_or_init(|| Box::new(Piece::new(shape, FIRST + (piece / COLUMNS) as i32, piece % COLUMNS)))
}

impl<const TILES: usize> Piece<TILES> {
    #[inline(always)]
    fn at(&self, shape: &Shape<TILES>, x: f64, y: f64) -> f64 {
        let ((t, p), (v, q)) = (polynomials(x), polynomials(y));
        let mut weights = [0.0; TILES];
        for k in 0..TILES {
            weights[k] = p[shape[k][0]] * q[shape[k][1]];
        }
        let mut lanes = [0.0; LANES];
        for l in 0..self.lanes.min(LANES) {
            let mut sums = [0.0; 4];
            for k in 0..TILES {
                for r in 0..4 {
                    sums[r] += self.tiles[k][r][l] * weights[k];
                }
            }
            lanes[l] = ((sums[3] * t[3] + sums[2] * t[2]) + (sums[1] * t[1] + sums[0])) * v[l];
        }
        (lanes[3] + lanes[2]) + (lanes[1] + lanes[0])
    }
}

/// Chebyshev's T_0 … T_3, and T_0, T_4, … T_16.
#[inline(always)]
fn polynomials(x: f64) -> ([f64; 4], [f64; 5]) {
    let two = 2.0 * x * x - 1.0;
    let four = 2.0 * two * two - 1.0;
    let eight = 2.0 * four * four - 1.0;
    let near = [1.0, x, two, x * (2.0 * two - 1.0)];
    (near, [1.0, four, eight, four * (2.0 * eight - 1.0), 2.0 * eight * eight - 1.0])
}
