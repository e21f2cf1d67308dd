//! Dimensions as products of powers of length, force, time and temperature.

use std::fmt;

use num_traits::{CheckedAdd, CheckedMul, Zero};

use super::ratio::Ratio;

/// length^a · force^b · time^c · temperature^d. Mass is force·time²/length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension([Ratio; 4]);

const NAMES: [&str; 4] = ["length", "force", "time", "temperature"];

impl Dimension {
    /// A plain number.
    pub const NONE: Dimension = Dimension::whole([0, 0, 0, 0]);
    /// A length.
    pub const LENGTH: Dimension = Dimension::whole([1, 0, 0, 0]);
    /// A force.
    pub const FORCE: Dimension = Dimension::whole([0, 1, 0, 0]);
    /// A time.
    pub const TIME: Dimension = Dimension::whole([0, 0, 1, 0]);
    /// A difference of temperature.
    pub const TEMPERATURE: Dimension = Dimension::whole([0, 0, 0, 1]);
    /// A mass.
    pub const MASS: Dimension = Dimension::whole([-1, 1, 2, 0]);
    /// A stress.
    pub const STRESS: Dimension = Dimension::whole([-2, 1, 0, 0]);
    /// A moment.
    pub const MOMENT: Dimension = Dimension::whole([1, 1, 0, 0]);

    /// By whole exponents of length, force, time and temperature.
    pub const fn whole(powers: [i64; 4]) -> Dimension {
        let [a, b, c, d] = powers;
        Dimension([Ratio::new_raw(a, 1), Ratio::new_raw(b, 1), Ratio::new_raw(c, 1), Ratio::new_raw(d, 1)])
    }

    /// The exponents of length, force, time and temperature.
    pub fn powers(self) -> [Ratio; 4] {
        self.0
    }

    /// Whether it is that of a plain number.
    pub fn is_none(self) -> bool {
        self.0.iter().all(|power| power.is_zero())
    }

    /// That of a product; `None` where exponents do not fit.
    pub fn times(self, other: Dimension) -> Option<Dimension> {
        if other.is_none() {
            return Some(self);
        }
        let mut powers = self.0;
        for (power, other) in powers.iter_mut().zip(other.0) {
            *power = power.checked_add(&other)?;
        }
        Some(Dimension(powers))
    }

    /// That of a power; `None` where exponents do not fit.
    pub fn power(self, exponent: Ratio) -> Option<Dimension> {
        if self.is_none() {
            return Some(self);
        }
        let mut powers = self.0;
        for power in &mut powers {
            *power = power.checked_mul(&exponent)?;
        }
        Some(Dimension(powers))
    }

    /// As factors: the given names with exponents, mass in the place of force·time²/length where that is shorter.
    fn factors(self) -> Vec<(&'static str, Ratio)> {
        let [length, force, time, temperature] = self.0;
        let is_mass = !force.is_zero() && force.checked_mul(&Ratio::from_integer(2)) == Some(time);
        match length.checked_add(&force).filter(|_| is_mass) {
            Some(length) => vec![("mass", force), ("length", length), ("temperature", temperature)],
            None => NAMES.into_iter().zip([length, force, time, temperature]).collect(),
        }
    }

    /// With a word, or a unit, for every factor that is left.
    pub fn written(self, word: impl Fn(&'static str) -> String) -> String {
        let factors: Vec<_> = self.factors().into_iter().filter(|(_, power)| !power.is_zero()).collect();
        let part = |(name, power): &(&'static str, Ratio)| {
            let (top, bottom) = (*power.numer(), *power.denom());
            let raised = match (top.abs(), bottom) {
                (1, 1) => String::new(),
                (2, 1) => "²".to_owned(),
                (3, 1) => "³".to_owned(),
                (4, 1) => "⁴".to_owned(),
                (top, 1) => format!("^{top}"),
                (top, bottom) => format!("^({top}/{bottom})"),
            };
            format!("{}{raised}", word(name))
        };
        let over: Vec<String> = factors.iter().filter(|(_, power)| *power.numer() > 0).map(part).collect();
        let under: Vec<String> = factors.iter().filter(|(_, power)| *power.numer() < 0).map(part).collect();
        let over = if over.is_empty() && !under.is_empty() { "1".to_owned() } else { over.join("·") };
        match under.len() {
            0 => over,
            1 => format!("{over}/{}", under[0]),
            _ => format!("{over}/({})", under.join("·")),
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.is_none() {
            true => formatter.write_str("a plain number"),
            false => formatter.write_str(&self.written(str::to_owned)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dimensions_are_written_as_products() {
        assert_eq!(Dimension::STRESS.to_string(), "force/length²");
        assert_eq!(Dimension::MOMENT.to_string(), "length·force");
        assert_eq!(Dimension::MASS.to_string(), "mass");
        assert_eq!(Dimension::whole([-4, 1, 2, 0]).to_string(), "mass/length³");
        assert_eq!(Dimension::whole([0, 0, -1, 0]).to_string(), "1/time");
        assert_eq!(Dimension::NONE.to_string(), "a plain number");
        let root = Dimension::LENGTH.power(Ratio::new(1, 2)).unwrap();
        assert_eq!(root.to_string(), "length^(1/2)");
        assert_eq!(root.times(root), Some(Dimension::LENGTH));
    }
}
