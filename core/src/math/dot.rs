//! Dot products that the compiler can vectorize.

/// The sum of products of two slices of equal length; the longer one's rest is ignored.
///
/// Eight partial sums instead of one: a single running sum is a chain of dependent additions, which neither vectorizes
/// nor keeps more than one unit busy. Pairwise partial sums also round less: the error is below
/// `(n / 8 + 3) ε Σ|aᵢ bᵢ|`. The result does not depend on the machine's vector width.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let (a, b) = (&a[..n], &b[..n]);
    let mut lanes = [0.0; 8];
    let (chunks_a, rest_a) = a.as_chunks::<8>();
    let (chunks_b, rest_b) = b.as_chunks::<8>();
    for (x, y) in chunks_a.iter().zip(chunks_b) {
        for k in 0..8 {
            lanes[k] += x[k] * y[k];
        }
    }
    let tail: f64 = rest_a.iter().zip(rest_b).map(|(x, y)| x * y).sum();
    let even = (lanes[0] + lanes[4]) + (lanes[2] + lanes[6]);
    let odd = (lanes[1] + lanes[5]) + (lanes[3] + lanes[7]);
    even + odd + tail
}
