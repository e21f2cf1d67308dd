//! Repeatable choices.

use ribopt::math::split_mix::SplitMix;

/// A repeatable stream of choices.
pub struct Random(SplitMix);

impl Random {
    /// The stream of a file's runs in one round: its seed, name and round decide, so that other files have no part in it.
    pub fn of_run(seed: u64, name: &str, round: usize) -> Random {
        let file = name.bytes().fold(0u64, |hash, byte| hash.wrapping_mul(0x0000_0100_0000_01B3) ^ u64::from(byte));
        let mixed = seed.wrapping_mul(0xD134_2543_DE82_EF95) ^ (round as u64).wrapping_mul(0xA24B_AED4_963E_E407);
        let mut stream = SplitMix::new(mixed ^ file.rotate_left(17));
        stream.uniform();
        Random(stream)
    }

    /// Uniform in [from, to).
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.0.uniform()
    }

    /// One of 0 … n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.0.uniform() * n as f64) as usize).min(n.saturating_sub(1))
    }

    pub fn coin(&mut self) -> bool {
        self.below(2) == 0
    }

    /// 10^±3 or 10^±6.
    pub fn factor(&mut self) -> f64 {
        [1e-6, 1e-3, 1e3, 1e6][self.below(4)]
    }

    /// Of either sign, its magnitude spread evenly in logarithms over 10^from … 10^to.
    pub fn of_magnitude(&mut self, from: f64, to: f64) -> f64 {
        let sign = if self.coin() { 1.0 } else { -1.0 };
        sign * 10f64.powf(self.between(from, to))
    }

    /// Fisher and Yates.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}
