//! SplitMix64 (Steele, Lea, Flood 2014): the same seed gives the same numbers on every machine.

/// A repeatable stream of numbers.
#[derive(Debug, Clone)]
pub struct SplitMix(u64);

impl SplitMix {
    /// The stream of a seed.
    pub fn new(seed: u64) -> Self {
        SplitMix(seed)
    }

    /// A fixed number in [0, 1) for every k: without a pattern, the same on every machine.
    pub fn share(k: u64) -> f64 {
        SplitMix::new(k).uniform()
    }

    /// The same of either sign, and at least ½ in magnitude.
    pub fn signed(k: u64) -> f64 {
        let share = SplitMix::share(k);
        if share < 0.5 { -0.5 - share } else { share }
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_repeat_and_fill_the_unit_interval() {
        let (mut a, mut b) = (SplitMix::new(7), SplitMix::new(7));
        let all: Vec<f64> = (0..1000).map(|_| a.uniform()).collect();
        assert!(all.iter().all(|&u| (0.0..1.0).contains(&u) && u == b.uniform()));
        assert!((all.iter().sum::<f64>() / 1000.0 - 0.5).abs() < 0.05);
    }
}
