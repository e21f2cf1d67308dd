//! Buckling factors and natural frequencies, by number.

use std::sync::Arc;

use super::super::Resolver;
use super::arguments::{Arguments, shape};
use crate::problem::Formula;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::modes::Pencil;
use crate::problem::structure::Structure;

/// Modes are asked for by number up to this one: beyond, shapes vary within a piece, and their numbers mean nothing.
const MOST: f64 = 1000.0;

impl<'a> Resolver<'a, '_> {
    /// `buckling(CASE)`, `buckling(CASE, k)`, `frequency(k)`.
    pub(super) fn eigenvalue(&mut self, structure: &Structure, pencil: Pencil, arguments: &mut Arguments) -> Option<Formula> {
        let name = if pencil == Pencil::Vibration { "frequency" } else { "buckling" };
        let number = match (arguments.list.pop_front(), pencil) {
            (None, Pencil::Buckling(_)) => 1.0,
            (None, Pencil::Vibration) => {
                return self.mistake(
                    MistakeCode::Response,
                    arguments.span,
                    "`frequency` needs the number of a mode",
                    Some(format!("as in {}", shape(name))),
                );
            }
            (Some(next), _) => match self.scalar(next.ast)? {
                Formula::Constant(number) if (1.0..=MOST).contains(&number) && number.fract() == 0.0 => number,
                _ => {
                    let help = "1 for the lowest, 2 for the next: a whole number".to_string();
                    return self.mistake(MistakeCode::Response, next.ast.span, "this is no number of a mode", Some(help));
                }
            },
        };
        let lacking = structure.members.iter().find(|member| structure.materials[member.material as usize].density.is_none());
        let some_weigh = structure.members.iter().any(|member| structure.materials[member.material as usize].density.is_some());
        if let (Pencil::Vibration, Some(lacking)) = (pencil, lacking)
            && (some_weigh || structure.masses.is_empty())
        {
            let material = &structure.materials[lacking.material as usize].name;
            let help = format!("give it: density, in material `{material}` (0 where its mass does not count)");
            return self.mistake(
                MistakeCode::Material,
                arguments.span,
                format!("`frequency` needs the density of `{material}`"),
                Some(help),
            );
        }
        Some(Formula::Response(Arc::new(pencil.response(number as u32))))
    }
}
