//! The base units of a file: one length, one force, one time; mass follows from them.

use num_traits::Zero;

use super::dimension::Dimension;
use super::ratio::Ratio;
use super::unit::{Unit, scan};

/// What a file's numbers are in. A quantity needs only those base units that its dimension has.
#[derive(Debug, Clone, Default)]
pub struct System {
    /// Units of length, force, time and temperature, with the words they were given in.
    base: [Option<(String, Unit)>; 4],
    /// The unit of mass, where one is given.
    mass: Option<(String, Unit)>,
    /// Labels of base units that are no units known here, by their keys.
    strange: Vec<(&'static str, String)>,
}

/// The base units by their keys in `units`, with what each measures.
const BASE: [(&str, Dimension); 4] = [
    ("length", Dimension::LENGTH),
    ("force", Dimension::FORCE),
    ("time", Dimension::TIME),
    ("temperature", Dimension::TEMPERATURE),
];

impl System {
    /// By `units = { length = "m", force = "kN" }`. Labels that are no units are labels alone. Time is in seconds and temperature in kelvins
    /// where nothing is said; without a unit of force, one of mass gives it.
    pub fn of(labels: &[(String, String)]) -> System {
        let labelled = |key: &str| labels.iter().find(|(known, _)| known == key).map(|(_, label)| label.as_str());
        let unit = |key: &str, dimension: Dimension| {
            let label = labelled(key)?;
            // As a force, lb is the pound-force.
            let symbol = if key == "force" && label == "lb" { "lbf" } else { label };
            let unit = Unit::parse(symbol).ok().filter(|unit| unit.dimension() == dimension)?;
            Some((label.to_owned(), unit))
        };
        let mut base = BASE.map(|(key, dimension)| unit(key, dimension));
        for (at, symbol) in [(2, "s"), (3, "K")] {
            if labelled(BASE[at].0).is_none() {
                base[at] = Unit::parse(symbol).ok().map(|unit| (symbol.to_owned(), unit));
            }
        }
        let mass = unit("mass", Dimension::MASS);
        let strange = (0..BASE.len()).filter(|&at| base[at].is_none());
        let strange = strange.filter_map(|at| Some((BASE[at].0, labelled(BASE[at].0)?.to_owned()))).collect();
        let mut system = System { base, mass, strange };
        if labelled("force").is_none() {
            system.base[1] = system.force_of_mass();
        }
        system
    }

    /// mass·length/time²
    fn force_of_mass(&self) -> Option<(String, Unit)> {
        let (mass, length, time) = (self.mass.as_ref()?, self.base[0].as_ref()?, self.base[2].as_ref()?);
        let unit = mass.1.times(length.1)?.times(time.1.power(Ratio::from_integer(-2))?)?;
        Some((format!("{}·{}/{}²", mass.0, length.0, time.0), unit))
    }

    /// The unit that numbers of this dimension are in; `Err` names a base unit that is not given.
    ///
    /// # Errors
    /// The key in `units` that is missing.
    pub fn unit(&self, dimension: Dimension) -> Result<Unit, &'static str> {
        let mut unit = Unit::NONE;
        for ((key, _), (base, power)) in BASE.iter().zip(self.base.iter().zip(dimension.powers())) {
            if power.is_zero() {
                continue;
            }
            let (_, base) = base.as_ref().ok_or(*key)?;
            unit = base.power(power).and_then(|factor| unit.times(factor)).ok_or(*key)?;
        }
        Ok(unit)
    }

    /// What is wrong where the unit of a key is not known, and the remedy.
    pub fn missing(&self, key: &str) -> (String, String) {
        let example =
            BASE.iter().zip(["m", "kN", "s", "K"]).find(|((known, _), _)| *known == key).map_or("m", |(_, symbol)| symbol);
        match self.strange.iter().find(|(known, _)| *known == key) {
            Some((_, label)) => {
                (format!("`{label}` is no unit of {key} known here"), format!("write {key} = \"{example}\" in `units`"))
            }
            None => {
                let message = format!("the file does not say in which unit of {key} its numbers are");
                (message, format!("add {key} = \"{example}\" to `units`"))
            }
        }
    }

    /// So many of a unit, in the file's own.
    ///
    /// # Errors
    /// The key in `units` that is missing.
    ///
    /// ```
    /// use ribopt::units::{System, Unit};
    /// let system = System::of(&[("length".into(), "m".into()), ("force".into(), "kN".into())]);
    /// assert_eq!(system.own(235.0, Unit::parse("MPa").unwrap()), Ok(235e3));
    /// assert_eq!(system.own(7.85, Unit::parse("g/cm^3").unwrap()), Ok(7.85));
    /// ```
    pub fn own(&self, value: f64, unit: Unit) -> Result<f64, &'static str> {
        let own = self.unit(unit.dimension())?.power(Ratio::from_integer(-1));
        Ok(own.and_then(|own| unit.times(own)).map_or(f64::NAN, |factor| factor.of(value)))
    }

    /// A number of the file's, in another unit of the same dimension.
    ///
    /// # Errors
    /// The key in `units` that is missing.
    pub fn shown(&self, value: f64, unit: Unit) -> Result<f64, &'static str> {
        let own = self.unit(unit.dimension())?;
        let factor = unit.power(Ratio::from_integer(-1)).and_then(|under| own.times(under));
        Ok(factor.map_or(f64::NAN, |factor| factor.of(value)))
    }

    /// A text that is a number and a unit and nothing else, as a number of the file's; `None` for any other text, or without the base units
    /// it takes.
    ///
    /// ```
    /// use ribopt::units::{Dimension, System};
    /// let system = System::of(&[("length".into(), "m".into())]);
    /// assert_eq!(system.quantity("-300 mm"), Some((-0.3, Dimension::LENGTH)));
    /// assert_eq!(system.quantity("line 3 m"), None);
    /// ```
    pub fn quantity(&self, text: &str) -> Option<(f64, Dimension)> {
        let text = text.trim();
        let length = text.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)))?;
        let (value, rest) = (text[..length].parse::<f64>().ok()?, text[length..].trim_start());
        let (taken, unit) = scan(rest)?.ok()?;
        let own = self.own(value, unit).ok().filter(|own| taken == rest.len() && own.is_finite())?;
        Some((own, unit.dimension()))
    }

    /// A number of the file's in the unit that people would say it in, where its lengths are metric: 210 GPa for 210e6 kN/m²; else in
    /// the file's own.
    pub fn spoken(&self, value: f64, dimension: Dimension) -> Option<(f64, String)> {
        /// What is usual, from small to large.
        const USUAL: [(Dimension, &[&str]); 4] = [
            (Dimension::LENGTH, &["mm", "m"]),
            (Dimension::FORCE, &["N", "kN", "MN"]),
            (Dimension::STRESS, &["kPa", "MPa", "GPa"]),
            (Dimension::MASS, &["kg", "t"]),
        ];
        let own = || self.label(dimension).map(|label| (value, label));
        let metric = self.base[0].as_ref().is_some_and(|(label, _)| ["m", "mm", "cm", "dm"].contains(&label.as_str()));
        let usual = USUAL.iter().find(|(known, _)| *known == dimension).filter(|_| metric);
        let Some((_, symbols)) = usual else { return own() };
        let candidates = symbols.iter().filter_map(|symbol| {
            let shown = self.shown(value, Unit::parse(symbol).ok()?).ok()?;
            Some((shown, (*symbol).to_owned()))
        });
        let readable = |(shown, _): &(f64, String)| (1.0..1000.0).contains(&shown.abs());
        candidates.into_iter().find(readable).or_else(own)
    }

    /// What numbers of this dimension are in, in words: `kN/m²`; `None` where a base unit is not given.
    pub fn label(&self, dimension: Dimension) -> Option<String> {
        self.unit(dimension).ok()?;
        let base = |name: &'static str| {
            let at = BASE.iter().position(|(key, _)| *key == name);
            at.and_then(|at| self.base[at].as_ref()).map_or_else(|| name.to_owned(), |(label, _)| label.clone())
        };
        let mass = self.mass.as_ref().map(|(label, _)| label.clone()).or_else(|| self.mass_label());
        let without_mass = |name: &'static str| if name == "mass" { mass.clone().unwrap_or_default() } else { base(name) };
        Some(dimension.written(without_mass))
    }

    /// The name of the unit of mass that follows from the others, where it has one.
    fn mass_label(&self) -> Option<String> {
        let own = self.unit(Dimension::MASS).ok()?.of(1.0);
        let named = ["kg", "t", "g", "lb"].into_iter().find(|symbol| {
            let of = Unit::parse(symbol).map_or(f64::NAN, |unit| unit.of(1.0));
            (of - own).abs() <= 1e-12 * own
        });
        let base = |at: usize| self.base[at].as_ref().map_or("", |(label, _)| label.as_str());
        Some(named.map_or_else(|| format!("({}·{}²/{})", base(1), base(2), base(0)), str::to_owned))
    }

    /// A unit of mass that does not follow from the others, which numbers of the file would not agree with: what is given, and what follows.
    pub fn mass_differs(&self) -> Option<(String, String)> {
        let (label, mass) = self.mass.as_ref()?;
        let own = self.unit(Dimension::MASS).ok()?;
        let (given, follows) = (mass.of(1.0), own.of(1.0));
        ((given - follows).abs() > 1e-12 * follows).then(|| (label.clone(), self.mass_label().unwrap_or_default()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn system(labels: &[(&str, &str)]) -> System {
        System::of(&labels.iter().map(|(key, label)| ((*key).to_owned(), (*label).to_owned())).collect::<Vec<_>>())
    }

    #[test]
    fn mass_follows() {
        let metres = system(&[("length", "m"), ("force", "kN")]);
        assert_eq!(metres.label(Dimension::whole([-4, 1, 2, 0])).unwrap(), "t/m³");
        assert_eq!(metres.label(Dimension::STRESS).unwrap(), "kN/m²");
        assert_eq!(system(&[("length", "mm"), ("force", "N")]).own(7850.0, Unit::parse("kg/m^3").unwrap()), Ok(7.85e-9));
        assert_eq!(system(&[("length", "m"), ("mass", "kg")]).own(2.0, Unit::parse("kN").unwrap()), Ok(2000.0));
        assert!(system(&[("length", "m"), ("force", "kN"), ("mass", "kg")]).mass_differs().is_some());
        assert!(system(&[("length", "m"), ("force", "kN"), ("mass", "t")]).mass_differs().is_none());
    }

    #[test]
    fn a_base_unit_that_is_not_given_is_named() {
        assert_eq!(system(&[("length", "m")]).own(1.0, Unit::parse("MPa").unwrap()), Err("force"));
        assert_eq!(system(&[("force", "kN"), ("length", "ells")]).own(1.0, Unit::parse("m").unwrap()), Err("length"));
    }
}
