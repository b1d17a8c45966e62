//! Arrays and sums made element by element, whole inside the caller in any build.
//!
//! The standard library's `array::from_fn`, `map`, `zip` and `fold` go through functions that are inlined only within their
//! codegen unit: without link-time optimization, and in incremental builds, a kernel would call one for each element, and
//! never be compiled for the caller's instruction set.

/// The array of the values of 0 … N − 1.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "an iterator's adapters are functions of another codegen unit")]
pub fn array<T: Copy + Default, const N: usize>(mut of: impl FnMut(usize) -> T) -> [T; N] {
    let mut values = [T::default(); N];
    for k in 0..N {
        values[k] = of(k);
    }
    values
}

/// The array of the values of an array's elements.
#[inline(always)]
pub fn each<A: Copy, T: Copy + Default, const N: usize>(from: [A; N], mut of: impl FnMut(A) -> T) -> [T; N] {
    array(|k| of(from[k]))
}

/// The sum of the values of 0 … `count` − 1, from −0 on like the standard library's.
#[inline(always)]
pub fn sum(count: usize, of: impl Fn(usize) -> f64) -> f64 {
    let mut sum = -0.0;
    for k in 0..count {
        sum += of(k);
    }
    sum
}
