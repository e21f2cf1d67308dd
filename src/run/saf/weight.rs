//! Self-weight: the format knows it as a case of its own, of the whole structure and downwards.

use super::super::RunError;
use super::converter::Converter;
use super::sections::Shapes;
use crate::problem::structure::{Action, Structure};

/// The acceleration by which readers of the format make weights of masses, in m/s².
const GRAVITY: f64 = 9.81;

/// The mass per volume whose weight is the file's, in kg/m³: its own where the file's gravity is the Earth's, whose measured values lie from
/// 9.76 to 9.84 m/s²; else the weight per volume over the reader's gravity. None where the file's unit of mass is not that of its forces
/// and nothing tells the weight.
///
/// # Errors
/// A base unit that is not given.
pub(super) fn unit_mass(density: f64, structure: &Structure, units: &Converter<'_>) -> Result<f64, RunError> {
    let gravity = structure.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let alone = units.0.mass_differs().is_some();
    let earthly = !alone && units.to(gravity, "m/s^2").is_ok_and(|gravity| (9.76..=9.84).contains(&gravity));
    match gravity == 0.0 {
        true if alone => Ok(f64::NAN),
        false if !earthly => Ok(units.to(density * gravity, "N/m^3")? / GRAVITY),
        _ => units.to(density, "kg/m^3"),
    }
}

/// By which name the weight of each case goes; none where the case has no weight, or not that of the whole structure.
pub(super) struct Weights(Vec<Option<String>>);

impl Weights {
    pub fn of(structure: &Structure) -> Weights {
        let downwards = matches!(structure.gravity, [0.0, 0.0, g] if g < 0.0);
        let case = |case: usize| {
            let name = &structure.cases[case];
            let mut weights = vec![0; structure.members.len()];
            let mut others = false;
            for load in structure.loads.iter().filter(|load| load.case as usize == case) {
                match load.action {
                    Action::SelfWeight { member } => weights[member as usize] += 1,
                    _ => others = true,
                }
            }
            if !(downwards && weights.iter().all(|count| *count == 1)) {
                return None;
            }
            let free = |name: &String| structure.cases.iter().all(|known| **known != **name);
            let apart =
                || (1..).map(|n| format!("{name} self-weight{}", if n > 1 { format!(" {n}") } else { String::new() })).find(free);
            if others { apart() } else { Some(name.to_string()) }
        };
        Weights((0..structure.cases.len()).map(case).collect())
    }

    /// The case that is the weight of this one.
    pub fn case_of(&self, case: usize) -> Option<&str> {
        self.0[case].as_deref()
    }

    /// Whether the weight of a case is another case.
    pub fn stands_apart(&self, structure: &Structure, case: usize) -> bool {
        self.case_of(case).is_some_and(|name| name != &*structure.cases[case])
    }

    /// Cases beside the file's.
    pub fn further<'a>(&'a self, structure: &'a Structure) -> impl Iterator<Item = &'a str> {
        (0..self.0.len()).filter(|case| self.stands_apart(structure, *case)).filter_map(|case| self.case_of(case))
    }

    /// A case with its weight, both with one factor.
    pub fn with(&self, structure: &Structure, case: u32, factor: f64) -> Vec<(String, f64)> {
        let case = case as usize;
        let mut all = vec![(structure.cases[case].to_string(), factor)];
        if self.stands_apart(structure, case) {
            all.extend(self.case_of(case).map(|name| (name.to_owned(), factor)));
        }
        all
    }

    /// The weight of a member per length, in the file's units, where no case of the format's holds it.
    ///
    /// # Errors
    /// The weight of a taper, which is not linear along it.
    pub fn line_load(
        &self,
        structure: &Structure,
        case: u32,
        member: u32,
        shapes: &Shapes<'_>,
        names: &dyn Fn(u32) -> String,
    ) -> Result<Option<[f64; 3]>, RunError> {
        let of = &structure.members[member as usize];
        let density = structure.materials[of.material as usize].density.unwrap_or(0.0);
        if self.case_of(case as usize).is_some() || density == 0.0 {
            return Ok(None);
        }
        let Some(area) = shapes.area_throughout(of) else {
            return Err(RunError::Choice(format!(
                "no SAF file: load case `{}` has the weight of rib `{}`, which tapers; the format has self-weight of the whole structure, \
                 downwards: give the case `self_weight = true` without `ribs` and gravity along -z",
                structure.cases[case as usize],
                names(member)
            )));
        };
        Ok(Some(structure.gravity.map(|g| density * area * g)))
    }
}
