//! Symmetric positive definite systems of some hundred unknowns, and their minima between bounds.

use multiversion::multiversion;

/// Square matrix by rows.
pub type Matrix = Vec<f64>;

/// Rows that are subtracted together.
const PANEL: usize = 4;

/// Cholesky factor: `A = Uᵀ U` with U upper triangular (Golub and Van Loan 2013, 4.2).
#[derive(Clone, Debug)]
pub struct Cholesky {
    size: usize,
    upper: Matrix,
}

impl Cholesky {
    /// Factor of a symmetric matrix, of which the upper triangle is read; none unless it is positive definite.
    pub fn new(mut matrix: Matrix, size: usize) -> Option<Self> {
        for start in (0..size).step_by(PANEL) {
            let end = (start + PANEL).min(size);
            let (panel, rest) = matrix.split_at_mut(end * size);
            let panel = &mut panel[start * size..];
            for k in start..end {
                let (done, later) = panel.split_at_mut((k + 1 - start) * size);
                let row = &mut done[(k - start) * size..];
                let root = Some(row[k]).filter(|pivot| *pivot > 0.0 && pivot.is_finite())?.sqrt();
                row[k..].iter_mut().for_each(|value| *value /= root);
                for (row_i, i) in later.chunks_mut(size).zip(k + 1..) {
                    subtract(row[i], &row[i..], &mut row_i[i..]);
                }
            }
            for (row, i) in rest.chunks_mut(size).zip(end..) {
                subtract_all(panel.chunks(size).map(|of| (of[i], &of[i..])), &mut row[i..]);
            }
        }
        Some(Self { size, upper: matrix })
    }

    fn row(&self, k: usize) -> &[f64] {
        &self.upper[k * self.size..][..self.size]
    }

    /// `A⁻¹ B` for the columns of B, which has as many rows as A.
    #[must_use]
    pub fn solve(&self, mut right: Vec<f64>) -> Vec<f64> {
        let width = right.len() / self.size.max(1);
        if width == 0 {
            return right;
        }
        self.forward(0, &mut right);
        for k in (0..self.size).rev() {
            let (own, done) = right.split_at_mut((k + 1) * width);
            let (row, own) = (self.row(k), &mut own[k * width..]);
            subtract_all(row[k + 1..].iter().copied().zip(done.chunks(width)), own);
            for value in own {
                *value /= row[k];
            }
        }
        right
    }

    /// `U⁻ᵀ B` from the first row on of which B has anything: products of its columns are those of B with `A⁻¹`. B is those rows alone.
    #[must_use]
    pub fn half_solve(&self, first: usize, mut right: Vec<f64>) -> Vec<f64> {
        self.forward(first, &mut right);
        right
    }

    fn forward(&self, first: usize, right: &mut [f64]) {
        let width = right.len() / self.size.saturating_sub(first).max(1);
        for k in first..self.size {
            let (done, own) = right.split_at_mut((k - first) * width);
            let own = &mut own[..width];
            subtract_all(done.chunks(width.max(1)).zip(first..).map(|(of, j)| (self.row(j)[k], of)), own);
            for value in own {
                *value /= self.row(k)[k];
            }
        }
    }

    /// `A⁻¹`.
    #[must_use]
    pub fn inverse(&self) -> Matrix {
        let mut identity = vec![0.0; self.size * self.size];
        identity.iter_mut().step_by(self.size + 1).for_each(|value| *value = 1.0);
        self.solve(identity)
    }
}

/// `to −= by · of`.
fn subtract(by: f64, of: &[f64], to: &mut [f64]) {
    if by != 0.0 {
        to.iter_mut().zip(of).for_each(|(to, of)| *to -= by * of);
    }
}

/// `to −= Σ by · of` in order: [`PANEL`] at a time, so that `to` is read and written less often.
fn subtract_all<'a>(mut all: impl Iterator<Item = (f64, &'a [f64])>, to: &mut [f64]) {
    while let Some(first) = all.next() {
        match (all.next(), all.next(), all.next()) {
            (Some(second), Some(third), Some(fourth)) => subtract_four([first, second, third, fourth], to),
            others => {
                let others = [Some(first), others.0, others.1, others.2];
                others.into_iter().flatten().for_each(|(by, of)| subtract(by, of, to));
            }
        }
    }
}

#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn subtract_four(all: [(f64, &[f64]); PANEL], to: &mut [f64]) {
    let [(a, of_a), (b, of_b), (c, of_c), (d, of_d)] = all;
    for ((((to, w), x), y), z) in to.iter_mut().zip(of_a).zip(of_b).zip(of_c).zip(of_d) {
        *to = *to - a * w - b * x - c * y - d * z;
    }
}

/// `A x`.
pub fn times(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    matrix.chunks(vector.len().max(1)).map(|row| row.iter().zip(vector).map(|(a, x)| a * x).sum()).collect()
}

/// Sub-matrix of some rows and columns.
pub fn among(matrix: &[f64], size: usize, rows: &[usize], columns: &[usize]) -> Matrix {
    rows.iter().flat_map(|row| columns.iter().map(move |column| matrix[row * size + column])).collect()
}

/// The x between bounds that minimizes `½ xᵀ A x − gᵀ x`, by an active set that exchanges all violators at once
/// (Júdice and Pires 1994), and only the last of them where that does not settle. The search begins with those held that are at a bound
/// in `near`, a point nearby, if any.
///
/// The single exchanges end where fewer violate than ever before. None unless A is positive definite, or after 1000 exchanges.
pub fn bounded_minimum(a: &[f64], g: &[f64], bounds: &[[f64; 2]], near: Option<&[f64]>) -> Option<Vec<f64>> {
    const ALL_AT_ONCE: usize = 20;
    const MOST: usize = 1000;
    let size = g.len();
    let at_bound =
        |x: &[f64]| x.iter().zip(bounds).map(|(x, bounds)| bounds.iter().copied().find(|at| at == x)).collect();
    let mut held: Vec<Option<f64>> = near.map_or_else(|| vec![None; size], at_bound);
    let (mut fewest, mut tries) = (usize::MAX, ALL_AT_ONCE);
    for _ in 0..MOST {
        let free: Vec<usize> = (0..size).filter(|at| held[*at].is_none()).collect();
        let mut x: Vec<f64> = held.iter().map(|at| at.unwrap_or(0.0)).collect();
        let pull = times(a, &x);
        let right = free.iter().map(|at| g[*at] - pull[*at]).collect();
        let found = Cholesky::new(among(a, size, &free, &free), free.len())?.solve(right);
        free.iter().zip(found).for_each(|(at, value)| x[*at] = value);
        let slope: Vec<f64> = times(a, &x).iter().zip(g).map(|(ax, g)| ax - g).collect();
        let change = |at: usize| {
            let ([low, high], rounding) = (bounds[at], 1e-9 * a[at * (size + 1)] * x[at].abs().max(1e-9));
            match held[at] {
                None if x[at] < low => Some(Some(low)),
                None if x[at] > high => Some(Some(high)),
                Some(bound) if bound == low && slope[at] < -rounding => Some(None),
                Some(bound) if bound == high && slope[at] > rounding => Some(None),
                _ => None,
            }
        };
        let changes: Vec<(usize, Option<f64>)> = (0..size).filter_map(|at| Some((at, change(at)?))).collect();
        if changes.is_empty() {
            return Some(x);
        }
        if changes.len() < fewest {
            (fewest, tries) = (changes.len(), ALL_AT_ONCE);
        }
        let from = if tries > 0 { 0 } else { changes.len() - 1 };
        tries = tries.saturating_sub(1);
        changes[from..].iter().for_each(|(at, to)| held[*at] = *to);
    }
    None
}
