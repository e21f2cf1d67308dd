//! Ribs at a point: the outlines of their sections, numbers to tag them with, the volume the model gives them.

use super::Subject;
use super::courses::courses;
use super::network::{NetworkFailure, Sized};
use super::sizes::rib_volumes;
use super::utilisation::loads;
use crate::mesh::network::RibGeometry;
use crate::mesh::solids::{Ring, SizedRib};
use crate::problem::evaluate::Evaluation;
use crate::problem::{Problem, VolumeLaw};
use crate::sections;

/// Tags of every rib: the dimensions at its two ends, its length and the volume the model gives it as a prismatoid.
pub(super) fn size(subject: &Subject, x: &[f64], places: &[RibGeometry]) -> Result<Sized, NetworkFailure> {
    let problem = at(subject.problem(), x);
    let shapes = (0..problem.sections.names.len()).map(|s| Shape::of(&problem, s)).collect::<Result<Vec<_>, _>>()?;
    let loads = loads(subject, x)?;
    // Where the structure cannot be analysed, the limits' values have told so.
    let responses = courses(subject, x).ok().flatten().map(|courses| courses.extremes()).unwrap_or_default();
    let volumes = rib_volumes(subject.problem(), x, Some(VolumeLaw::Prismatoid))?;
    let dimensions = dimension_names(&problem);
    let rib = |(r, place): (usize, &RibGeometry)| {
        let ends = [problem.ribs.from[r], problem.ribs.to[r]].map(|s| &shapes[s as usize]);
        let of_ends = dimensions.iter().flat_map(|name| ends.map(|shape| shape.dimension(name)));
        SizedRib {
            rings: ends.map(|shape| shape.rings.clone()),
            tags: of_ends.chain([place.length(), volumes[r]]).chain(responses.iter().map(|(_, all)| all[r])).collect(),
            utilisation: loads[r].share,
            model_volume: Some(volumes[r]),
            geometry: place.clone(),
        }
    };
    let ribs = places.iter().enumerate().map(rib).collect();
    let of_ends = dimensions.iter().flat_map(|name| ["from", "to"].map(|end| format!("{end}.{name}")));
    let tag_names =
        of_ends.chain(["length".into(), "volume".into()]).chain(responses.iter().map(|(name, _)| name.clone())).collect();
    let name = |s: u32| &problem.sections.names[s as usize];
    let of_rib =
        |(&from, &to): (&u32, &u32)| if from == to { name(from).to_owned() } else { format!("{} – {}", name(from), name(to)) };
    let sections = problem.ribs.from.iter().zip(&problem.ribs.to).map(of_rib).collect();
    Ok(Sized { ribs, loads, sections, tag_names })
}

/// The problem with its variables' starts at x, where [`Evaluation`] looks.
fn at(problem: &Problem, x: &[f64]) -> Problem {
    let mut problem = problem.clone();
    problem.variables.start = x.to_vec();
    problem
}

/// A section in numbers.
struct Shape {
    names: &'static [&'static str],
    values: Vec<f64>,
    rings: Vec<Ring>,
}

impl Shape {
    fn of(problem: &Problem, s: usize) -> Result<Shape, NetworkFailure> {
        let failure = |cause| NetworkFailure::Section { section: problem.sections.names[s].to_string(), cause };
        let number = problem.sections.form[s];
        let (kind, form) = (sections::kind_of(number), sections::form(number));
        let evaluation = Evaluation::at_start(problem);
        let values = form.dimensions.iter().zip(problem.dimensions(s)).map(|(name, &dimension)| {
            let value = evaluation.dimension(s as u32, dimension);
            value.ok_or_else(|| failure(format!("{name} depends on volumes, which have no place in an outline")))
        });
        let values = values.collect::<Result<Vec<f64>, _>>()?;
        let outline = problem.outline(s as u32);
        if let Some(defect) = kind.defect(form, &values, outline) {
            return Err(failure(defect));
        }
        if !kind.has_rings() {
            let area = form.dimensions.iter().position(|name| *name == "A").and_then(|at| values.get(at)).copied();
            let rings = vec![round(area.filter(|area| *area > 0.0).ok_or_else(|| failure("its area is not positive".into()))?)];
            return Ok(Shape { names: form.dimensions, values, rings });
        }
        let rings = kind.matching_rings(form, &values, outline);
        Ok(Shape { names: form.dimensions, values, rings })
    }

    /// NaN where the section has no dimension of this name.
    fn dimension(&self, name: &str) -> f64 {
        let at = self.names.iter().position(|known| *known == name);
        at.and_then(|at| self.values.get(at)).copied().unwrap_or(f64::NAN)
    }
}

/// What numbers alone are drawn as: a round bar of the same area.
fn round(area: f64) -> Ring {
    const CORNERS: usize = 24;
    let angle = std::f64::consts::TAU / CORNERS as f64;
    let radius = (2.0 * area / (CORNERS as f64 * angle.sin())).sqrt();
    (0..CORNERS).map(|at| (angle * at as f64).sin_cos()).map(|(sin, cos)| [radius * cos, radius * sin]).collect()
}

/// The names of all dimensions given, each once, in the order of the sections.
fn dimension_names(problem: &Problem) -> Vec<&'static str> {
    let mut forms: Vec<u16> = problem.sections.form.clone();
    forms.sort_unstable();
    forms.dedup();
    let mut names = Vec::new();
    for name in forms.iter().flat_map(|&number| sections::form(number).dimensions) {
        if !names.contains(name) {
            names.push(*name);
        }
    }
    names
}
