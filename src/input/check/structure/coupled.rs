//! Members whose section has a product of inertia: bending in one plane would bend them in the other.

use super::super::Assembly;
use crate::problem::evaluate::Evaluation;
use crate::problem::mistake_code::MistakeCode;

/// |Ixy| up to this share of √(Ix·Iy) is rounding.
const PRINCIPAL: f64 = 1e-9;

impl Assembly<'_> {
    /// The mistakes of rigid members whose axes are not principal ones: bars alone take such sections.
    pub(super) fn coupled_sections(&mut self) {
        let Some(structure) = self.problem.structure.clone() else { return };
        let mut found = Vec::new();
        let evaluation = Evaluation::at_start(&self.problem);
        for member in structure.members.iter().filter(|member| !member.pinned) {
            let section = self.problem.ribs.from[member.rib as usize];
            let of = |name: &str| evaluation.property(section, name);
            if let (Some(product), Some(ix), Some(iy)) = (of("Ixy"), of("Ix"), of("Iy"))
                && product.abs() > PRINCIPAL * (ix * iy).abs().sqrt()
            {
                found.push((member.rib, section));
            }
        }
        for (rib, section) in found {
            let name = self.problem.ribs.names[rib as usize].to_owned();
            let message = format!(
                "rib `{name}` would bend sideways: section `{}` has Ixy other than 0, and planes of bending are not coupled",
                &self.problem.sections.names[section as usize]
            );
            let help = "turn the section to its principal axes, take a symmetric one, or make the rib a bar: joints = \"pinned\"";
            self.findings.mistake(MistakeCode::SkewBending, self.rib_places[rib as usize], message, help);
        }
    }
}
