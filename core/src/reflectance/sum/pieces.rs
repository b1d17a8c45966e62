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

/// Coefficients of four neighboring powers of y.
type Block = [f64; 4];

/// The coefficients of a piece: rows of five blocks, of four, and so on, by ascending powers of x.
#[derive(Clone, Debug)]
pub(super) struct Piece<const FIVE: usize, const FOUR: usize, const THREE: usize, const TWO: usize, const ONE: usize> {
    five: [[Block; 5]; FIVE],
    four: [[Block; 4]; FOUR],
    three: [[Block; 3]; THREE],
    two: [[Block; 2]; TWO],
    one: [[Block; 1]; ONE],
}

/// Within 3e-14 of ln S.
type Full = Piece<3, 4, 2, 4, 3>;
/// Within 4e-11.
type Fine = Piece<0, 3, 3, 3, 3>;
/// Within 4e-7.
type Coarse = Piece<0, 0, 0, 5, 3>;

/// The binary exponents of g from which and to below which there are pieces.
const FIRST: i32 = -10;
const LAST: i32 = 40;
const ROWS: usize = (LAST - FIRST) as usize;
/// The half octaves of t that a row has at most.
const COLUMNS: usize = 18;

type Pieces<P> = [OnceLock<Box<P>>; ROWS * COLUMNS];

static FULL: Pieces<Full> = [const { OnceLock::new() }; ROWS * COLUMNS];
static FINE: Pieces<Fine> = [const { OnceLock::new() }; ROWS * COLUMNS];
static COARSE: Pieces<Coarse> = [const { OnceLock::new() }; ROWS * COLUMNS];

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
        super::Precision::Coarse => read(&COARSE, place),
        super::Precision::Fine => read(&FINE, place),
        super::Precision::Full => read(&FULL, place),
    }
}

#[inline(always)]
fn read<const A: usize, const B: usize, const C: usize, const D: usize, const E: usize>(
    pieces: &Pieces<Piece<A, B, C, D, E>>,
    place: &Place,
) -> f64 {
    let slot = &pieces[place.piece];
    slot.get().map_or_else(|| made(slot, place.piece), |piece| piece).at(place.x, place.y)
}

#[cold]
#[inline(never)]
fn made<const A: usize, const B: usize, const C: usize, const D: usize, const E: usize>(
    slot: &OnceLock<Box<Piece<A, B, C, D, E>>>,
    piece: usize,
) -> &Piece<A, B, C, D, E> {
    slot.get_or_init(|| Box::new(Piece::new(FIRST + (piece / COLUMNS) as i32, piece % COLUMNS)))
}

impl<const A: usize, const B: usize, const C: usize, const D: usize, const E: usize> Piece<A, B, C, D, E> {
    #[inline(always)]
    fn at(&self, x: f64, y: f64) -> f64 {
        let [t, v] = [polynomials(x), polynomials(y)];
        let t = t.as_flattened();
        let mut sums = [[0.0; 4]; 5];
        // The large ones last.
        add(&self.one, &t[A + B + C + D..], &mut sums);
        add(&self.two, &t[A + B + C..], &mut sums);
        add(&self.three, &t[A + B..], &mut sums);
        add(&self.four, &t[A..], &mut sums);
        add(&self.five, t, &mut sums);
        let mut total = [0.0; 4];
        for q in (0..5).rev() {
            for lane in 0..4 {
                total[lane] += sums[q][lane] * v[q][lane];
            }
        }
        (total[3] + total[2]) + (total[1] + total[0])
    }
}

/// `Σ_j t_j c_jk`, for all k at once.
#[inline(always)]
fn add<const Q: usize, const N: usize>(rows: &[[Block; Q]; N], t: &[f64], sums: &mut [Block; 5]) {
    for (row, t) in rows.iter().zip(t).rev() {
        for q in 0..Q {
            for lane in 0..4 {
                sums[q][lane] += row[q][lane] * t;
            }
        }
    }
}

/// Chebyshev's polynomials T_0 … T_19.
#[inline(always)]
fn polynomials(x: f64) -> [Block; 5] {
    let two = 2.0 * x * x - 1.0;
    let three = x * (2.0 * two - 1.0);
    let four = 2.0 * two * two - 1.0;
    // T_{k+4} = 2 T_4 T_k − T_{k−4}
    let mut blocks = [[1.0, x, two, three]; 5];
    let mut before = [four, three, two, x];
    for q in 1..5 {
        for lane in 0..4 {
            blocks[q][lane] = 2.0 * four * blocks[q - 1][lane] - before[lane];
        }
        before = blocks[q - 1];
    }
    blocks
}
