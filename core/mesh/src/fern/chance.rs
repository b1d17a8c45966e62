//! Natural variation without chance: numbers that only depend on a seed and on what they are for.

/// A source of numbers; each part of a plant takes its own by [`Chance::child`], so that no part's looks depend on how
/// many others there are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance(u32);

impl Chance {
    pub(super) fn new(seed: u32) -> Self {
        Self(stir(seed ^ 0x3c6e_f35f))
    }

    pub(super) fn child(self, index: u32) -> Self {
        Self(stir(self.0.rotate_left(9) ^ index.wrapping_add(1).wrapping_mul(0x9e37_79b1)))
    }

    /// A number of [0, 1), the same for the same `which`.
    pub(super) fn unit(self, which: u32) -> f32 {
        (self.child(which).0 >> 8) as f32 / 16_777_216.0
    }

    pub(super) fn spread(self, which: u32) -> f32 {
        2.0 * self.unit(which) - 1.0
    }
}

/// Every bit of the result depends on every bit of the input: three rounds of shift and odd product.
fn stir(mut bits: u32) -> u32 {
    for odd in [0x85a3_08d3, 0x1319_8a2f, 0x0370_7345] {
        bits = (bits ^ (bits >> 15)).wrapping_mul(odd);
    }
    bits ^ (bits >> 16)
}
