//! Dot products that the compiler can vectorize.

use crate::array::sum;
use multiversion::multiversion;

/// The sum of products of two slices of equal length; the longer one's rest is ignored.
///
/// Eight partial sums instead of one: a single running sum is a chain of dependent additions, which neither vectorizes
/// nor keeps more than one unit busy. Pairwise partial sums also round less: the error is below
/// `(n / 8 + 3) ε Σ|aᵢ bᵢ|`. The result does not depend on the machine's vector width: no operation is fused.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    dot_inline(a, b)
}

/// [`dot`] inside a caller that is compiled for several instruction sets itself: of short vectors the choice takes as long as the product.
#[inline(always)]
pub fn dot_inline(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, b) = (&a[..n], &b[..n]);
    let mut lanes = [0.0; 8];
    let (chunks_a, rest_a) = a.as_chunks::<8>();
    let (chunks_b, rest_b) = b.as_chunks::<8>();
    for i in 0..chunks_a.len().min(chunks_b.len()) {
        for k in 0..8 {
            lanes[k] += chunks_a[i][k] * chunks_b[i][k];
        }
    }
    total(lanes, sum(rest_a.len().min(rest_b.len()), |i| rest_a[i] * rest_b[i]))
}

/// Three dot products with one vector: the same to the last bit as [`dot`] of each, but the vector is read once.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
pub fn dot_each<const N: usize>(a: [&[f64; N]; 3], b: &[f64; N]) -> [f64; 3] {
    let [mut lanes_0, mut lanes_1, mut lanes_2] = [[0.0; 8]; 3];
    let (chunks_b, rest_b) = b.as_chunks::<8>();
    let (chunks_0, rest_0) = a[0].as_chunks::<8>();
    let (chunks_1, rest_1) = a[1].as_chunks::<8>();
    let (chunks_2, rest_2) = a[2].as_chunks::<8>();
    for i in 0..N / 8 {
        let (x0, x1, x2, y) = (&chunks_0[i], &chunks_1[i], &chunks_2[i], &chunks_b[i]);
        // One loop each, so that each fills whole registers.
        for k in 0..8 {
            lanes_0[k] += x0[k] * y[k];
        }
        for k in 0..8 {
            lanes_1[k] += x1[k] * y[k];
        }
        for k in 0..8 {
            lanes_2[k] += x2[k] * y[k];
        }
    }
    let tail = |rest: &[f64]| sum(N % 8, |i| rest[i] * rest_b[i]);
    [total(lanes_0, tail(rest_0)), total(lanes_1, tail(rest_1)), total(lanes_2, tail(rest_2))]
}

/// The partial sums, pairwise, and what did not fill them.
#[inline(always)]
fn total(lanes: [f64; 8], tail: f64) -> f64 {
    let even = (lanes[0] + lanes[4]) + (lanes[2] + lanes[6]);
    let odd = (lanes[1] + lanes[5]) + (lanes[3] + lanes[7]);
    even + odd + tail
}
