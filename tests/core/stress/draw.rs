//! Numbers drawn for a case: the same for the same seed, function and place, whatever the threads.

/// The numbers that a case is made of.
pub(super) type Case = [f64; 8];

/// A stream of its own for each case (`SplitMix64`: Steele, Lea and Flood 2014).
pub(super) struct Draw(u64);

impl Draw {
    pub(super) fn new(seed: u64, name: &str, index: u64) -> Self {
        let mut state = Self(seed);
        for part in name.bytes().map(u64::from).chain([index]) {
            state.0 = state.bits() ^ part;
        }
        state
    }

    pub(super) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 up to 1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of 0, 1, … count − 1, as a number.
    pub(super) fn pick(&mut self, count: u32) -> f64 {
        (self.unit() * f64::from(count)).floor()
    }

    /// An integer that another stream can be made from.
    pub(super) fn key(&mut self) -> f64 {
        self.pick(1 << 30)
    }

    /// Log-uniform.
    pub(super) fn log(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp().clamp(low, high)
    }

    /// Log-uniform of either sign.
    pub(super) fn signed(&mut self, low: f64, high: f64) -> f64 {
        let size = self.log(low, high);
        if self.bits() & 1 == 0 { size } else { -size }
    }

    /// Any number except NaN: zeros, limits, integers, huge, tiny, subnormal, infinite.
    pub(super) fn number(&mut self) -> f64 {
        let (sign, kind) = (if self.bits() & 1 == 0 { 1.0 } else { -1.0 }, self.pick(16) as u32);
        sign * match kind {
            0 => 0.0,
            1 => 1.0,
            2 => self.log(1e-323, 1e-308),
            3 => f64::INFINITY,
            4 => f64::MAX,
            5 => f64::MIN_POSITIVE,
            6 => self.pick(1000),
            7 | 8 => self.log(1e-300, 1e300),
            9..=11 => self.log(1e-12, 1e12),
            _ => self.unit(),
        }
    }

    /// Any number including NaN.
    pub(super) fn anything(&mut self) -> f64 {
        if self.pick(16) == 0.0 { f64::NAN } else { self.number() }
    }

    /// An angle in radians: anywhere, or to 1e-12 of normal, grazing or opposite.
    pub(super) fn angle(&mut self) -> f64 {
        use std::f64::consts::{FRAC_PI_2, PI};
        let near = self.signed(1e-12, 0.1);
        match self.pick(6) as u32 {
            0 => near,
            1 => FRAC_PI_2 - near.abs(),
            2 => PI + near,
            3 => self.number(),
            _ => self.within(0.0, FRAC_PI_2),
        }
    }
}

/// The numbers that a function draws, and zeros behind them.
pub(super) fn case<const N: usize>(numbers: [f64; N]) -> Case {
    let mut case = [0.0; 8];
    case[..N].copy_from_slice(&numbers);
    case
}
