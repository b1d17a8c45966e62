//! Splines on evenly spaced knots: for a read through as many places as a polynomial's, a hundredth of its error.
//!
//! ```text
//! f(x) = Σ_k c_{j+k} w_k(x − j),   j = ⌊x⌋,   w_k(t) = 1/p! Σ_{i ≤ p−k} (−1)^i (p+1 over i) (t + p − k − i)^p
//! ```
//! Next to the interpolation of degree p = 3, 5, 7, 9 by the polynomial through the p + 1 places around, the error is 9, 75, 650,
//! 5700 times smaller, at the same cost of reading (Schoenberg 1946).

/// Samples that a quick method serves together.
pub(super) const BLOCK: usize = 16;

/// The coefficients of `w_k` in powers of 2t − 1, for t from 0 to 1.
const fn curves<const N: usize>() -> [[f64; N]; N] {
    let mut curves = [[0.0; N]; N];
    let mut scale = 1_i128;
    let mut i = 1;
    while i < N {
        scale *= 2 * i as i128;
        i += 1;
    }
    let mut k = 0;
    while k < N {
        let mut power = 0;
        while power < N {
            // Of (s + odd)^(N − 1) the coefficient of s^power, s = 2t − 1.
            let (mut sum, mut sign_binomial, mut i) = (0_i128, 1_i128, 0);
            while i < N - k {
                let odd = 2 * (N - 1 - k - i) as i128 + 1;
                let (mut term, mut j) = (sign_binomial, 0);
                while j < N - 1 - power {
                    term = term * odd * (N - 1 - j) as i128 / (j + 1) as i128;
                    j += 1;
                }
                sum += term;
                sign_binomial = -sign_binomial * (N - i) as i128 / (i + 1) as i128;
                i += 1;
            }
            curves[k][power] = sum as f64 / scale as f64;
            power += 1;
        }
        k += 1;
    }
    curves
}

struct Basis<const N: usize>;

impl<const N: usize> Basis<N> {
    const CURVES: [[f64; N]; N] = curves::<N>();
}

/// The weights of N coefficients at s = 2t − 1, for many together.
#[inline(always)]
pub(super) fn weights<const N: usize>(s: &[f64; BLOCK], weights: &mut [[f64; BLOCK]; N]) {
    // The last is the first mirrored: even and odd powers apart serve both.
    for k in 0..N / 2 {
        let curve = &Basis::<N>::CURVES[k];
        for i in 0..BLOCK {
            let z = s[i] * s[i];
            let (mut even, mut odd) = (curve[N - 2], curve[N - 1]);
            for power in (0..N / 2 - 1).rev() {
                even = even * z + curve[2 * power];
                odd = odd * z + curve[2 * power + 1];
            }
            odd *= s[i];
            weights[k][i] = even + odd;
            weights[N - 1 - k][i] = even - odd;
        }
    }
}

/// The most coefficients that are read along an axis.
pub(super) const MOST: usize = 10;

/// The spline of a degree through as many points as it has coefficients, on an axis from 0 to 1 with the given number
/// of intervals.
pub(super) struct Axis {
    degree: usize,
    intervals: usize,
    sites: Vec<f64>,
    /// The weights at each site and the first coefficient they belong to, by Gauss's elimination made triangular. Left of the
    /// diagonal stands what was subtracted how often.
    band: Vec<(usize, [f64; MOST])>,
}

impl Axis {
    pub(super) fn new(degree: usize, intervals: usize) -> Self {
        let sites = sites(degree, intervals);
        let mut axis = Self { degree, intervals, band: Vec::with_capacity(sites.len()), sites };
        axis.band = axis.sites.iter().map(|&site| axis.weights(site)).collect();
        axis.eliminate();
        axis
    }

    pub(super) fn sites(&self) -> &[f64] {
        &self.sites
    }

    /// The first coefficient that a place is made of, and the weights.
    pub(super) fn weights(&self, place: f64) -> (usize, [f64; MOST]) {
        let x = place * self.intervals as f64;
        let cell = x.floor().clamp(0.0, (self.intervals - 1) as f64);
        (cell as usize, at_place(self.degree, 2.0 * (x - cell) - 1.0))
    }

    /// All minors of such a matrix are positive (Karlin 1968), so that no row need change its place.
    fn eliminate(&mut self) {
        for k in 0..self.band.len() {
            let (upper, lower) = self.band.split_at_mut(k + 1);
            let (from, pivot) = upper[k];
            for row in lower.iter_mut().take_while(|row| row.0 <= k) {
                let share = row.1[k - row.0] / pivot[k - from];
                for column in k + 1..=from + self.degree {
                    row.1[column - row.0] -= share * pivot[column - from];
                }
                row.1[k - row.0] = share;
            }
        }
    }

    /// Converts the values at the sites to coefficients. Each site has several numbers side by side.
    pub(super) fn solve(&self, values: &mut [f64], side_by_side: usize) {
        let mut rows: Vec<&mut [f64]> = values.chunks_mut(side_by_side).collect();
        for (i, (from, row)) in self.band.iter().enumerate() {
            let (above, rest) = rows.split_at_mut(i);
            for (share, other) in row.iter().zip(&above[*from..]) {
                subtract(rest[0], *share, other);
            }
        }
        for (k, (from, row)) in self.band.iter().enumerate().rev() {
            let (upper, below) = rows.split_at_mut(k + 1);
            for (share, other) in row[k + 1 - from..=self.degree].iter().zip(below) {
                subtract(upper[k], *share, other);
            }
            let pivot = row[k - from];
            upper[k].iter_mut().for_each(|value| *value /= pivot);
        }
    }
}

fn subtract(from: &mut [f64], share: f64, other: &[f64]) {
    from.iter_mut().zip(other).for_each(|(a, b)| *a -= share * b);
}

/// The weights of one place.
fn at_place(degree: usize, s: f64) -> [f64; MOST] {
    fn of<const N: usize>(s: f64) -> [f64; MOST] {
        let mut all = [0.0; MOST];
        for (weight, curve) in all.iter_mut().zip(&Basis::<N>::CURVES) {
            *weight = curve.iter().rev().fold(0.0, |sum, c| sum * s + c);
        }
        all
    }
    match degree {
        3 => of::<4>(s),
        5 => of::<6>(s),
        7 => of::<8>(s),
        _ => of::<10>(s),
    }
}

/// All knots, and in the first and last interval Chebyshev's extremes too, as many as the degree leaves free. Errors are then no
/// larger at the ends than elsewhere.
fn sites(degree: usize, intervals: usize) -> Vec<f64> {
    let extra = (degree - 1) / 2;
    let inner = (1..=extra).map(|j| 0.5 - 0.5 * (std::f64::consts::PI * j as f64 / (extra + 1) as f64).cos());
    let length = intervals as f64;
    let mut sites: Vec<f64> = (0..=intervals).map(|i| i as f64 / length).collect();
    for x in inner {
        sites.extend([x / length, (length - x) / length]);
    }
    sites.sort_by(f64::total_cmp);
    sites
}
