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
use crate::problem::{Formula, Problem};

/// Whether the bounds of the design are finite and leave every member its stiffness. Only prismatic ribs are looked at: nothing is said of
/// what a section between two others might be.
pub(super) fn are_bounded(problem: &Problem, structure: &Structure, statics: &Statics) -> bool {
    let variables = &problem.variables;
    let finite = variables.lower.iter().chain(&variables.upper).all(|bound| bound.is_finite());
    let mut ranges = Ranges::default();
    finite && (0..structure.members.len()).all(|at| keeps_stiff(problem, (structure, statics), at, &mut ranges))
}

fn keeps_stiff(problem: &Problem, (structure, statics): (&Structure, &Statics), at: usize, ranges: &mut Ranges) -> bool {
    let (member, prepared) = (&structure.members[at], &statics.members[at]);
    let (rib, material, carried) = (member.rib as usize, member.material, &prepared.components);
    let section = problem.ribs.from[rib];
    if !prepared.fixed || section != problem.ribs.to[rib] || !structure.has_constant_moduli(material) {
        return false;
    }
    let modulus = |name: &str| structure.material_number(material, name).is_some_and(|value| value > 0.0);
    let mut is_positive = |name: &str| {
        let range = ranges.of(problem, &Formula::SectionProperty(section, Property(Arc::from(name))), Item::None);
        range.lower > 0.0 && range.upper.is_finite()
    };
    modulus("E")
        && (!member.needs_shear_modulus(carried) || modulus("G"))
        && (!carried[0] || is_positive("A"))
        && member.deforms_by(carried).all(is_positive)
}
