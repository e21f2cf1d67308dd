//! Whether displacements are bounded where the design is.
//!
//! K = Σ BᵀDB: of members that stay where they are, whose D is positive definite whatever their sizes are, the null space of K is that of
//! all B, the same for every design. A structure that is no mechanism at its start is none within the bounds, and as D is continuous on them
//! so is K⁻¹.

use std::sync::Arc;

use crate::problem::evaluate::Item;
use crate::problem::formula::Property;
use crate::problem::range::Ranges;
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use crate::problem::{Dimension, Formula, Problem};

/// Whether the bounds of the design are finite and leave every member its stiffness. Only prismatic ribs are looked at: nothing is said of
/// what a section between two others might be.
pub(super) fn are_bounded(problem: &Problem, structure: &Structure, statics: &Statics) -> bool {
    let variables = &problem.variables;
    let finite = variables.lower.iter().chain(&variables.upper).all(|bound| bound.is_finite());
    let fixed = |position: &[Dimension; 3]| position.iter().all(|at| matches!(at, Dimension::Constant(_)));
    let mut ranges = Ranges::default();
    finite
        && structure.nodes.position.iter().all(fixed)
        && (0..structure.members.len()).all(|at| keeps_stiff(problem, (structure, statics), at, &mut ranges))
}

fn keeps_stiff(problem: &Problem, (structure, statics): (&Structure, &Statics), at: usize, ranges: &mut Ranges) -> bool {
    let (member, carried) = (&structure.members[at], &statics.members[at].components);
    let (rib, material) = (member.rib as usize, member.material);
    let section = problem.ribs.from[rib];
    if section != problem.ribs.to[rib] || !structure.has_constant_moduli(material) {
        return false;
    }
    let (about_z, about_y) = (carried[1] || carried[2], carried[3] || carried[4]);
    let needed = [
        (carried[0], "A"),
        (about_y, "Ix"),
        (about_z, "Iy"),
        (carried[5], "J"),
        (member.shear && about_y, "Asy"),
        (member.shear && about_z, "Asx"),
    ];
    let modulus = |name: &str| structure.material_number(material, name).is_some_and(|value| value > 0.0);
    let twists = carried[5] || (member.shear && (about_y || about_z));
    let mut is_positive = |name: &str| {
        let range = ranges.of(problem, &Formula::SectionProperty(section, Property(Arc::from(name))), Item::None);
        range.lower > 0.0 && range.upper.is_finite()
    };
    modulus("E") && (!twists || modulus("G")) && needed.iter().all(|&(needed, name)| !needed || is_positive(name))
}
