//! Names that a structure gives to a rib's row: `at.h`, `mass`, `weight`, `material.fy`.

use super::super::Resolver;
use crate::expression::Span;
use crate::expression::ast::Collection;
use crate::expression::operators::{Binary, Fold};
use crate::problem::formula::{Members, Response, Subject, What};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::{Formula, Property};
use std::sync::Arc;

impl<'a> Resolver<'a, '_> {
    /// `at.h`: a dimension or property at the row's station.
    pub(in super::super) fn at_station(&mut self, name: &str, span: Span) -> Option<Formula> {
        let offered = self.scope.is_some_and(|scope| scope.offers(name));
        if !offered {
            let help = "a dimension or property of the sections at both ends, as at.h or at.A";
            return self.mistake(MistakeCode::Response, span, format!("the sections here have no `{name}`"), Some(help.into()));
        }
        let station = self.open_station(span)?;
        Some(Formula::AtProperty(station, Property(Arc::from(name))))
    }

    /// `mass` and `weight`: of all ribs with nodes, or of the rib whose row it is.
    pub(in super::super) fn mass(&mut self, name: &str, span: Span) -> Option<Formula> {
        let structure = self.world.problem.structure.as_deref()?;
        let own = self.scope.is_some_and(|scope| scope.collection == Collection::Ribs);
        let undefined = structure.members.iter().find(|member| structure.materials[member.material as usize].density.is_none());
        if let Some(member) = undefined {
            let material = &structure.materials[member.material as usize].name;
            let help = format!("give it: density, in material `{material}`");
            return self.mistake(MistakeCode::Material, span, format!("`{name}` needs the density of `{material}`"), Some(help));
        }
        let one = Formula::Response(Arc::new(Response { set: 0, subject: Subject::Own, what: What::Mass }));
        let mass = match own {
            true => one,
            false => Formula::Over {
                fold: Fold::Sum,
                collection: Collection::Ribs,
                members: Members::Listed(Arc::new({
                    let mut ribs: Vec<u32> = structure.members.iter().map(|member| member.rib).collect();
                    ribs.sort_unstable();
                    ribs
                })),
                body: Arc::new(one),
            },
        };
        let gravity = structure.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        Some(match name {
            "weight" => Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(gravity)), Box::new(mass)),
            _ => mass,
        })
    }

    /// `material.fy` in a rib's scope, or of a material by name.
    pub(in super::super) fn material(&mut self, word: &str, name: &str, span: Span) -> Option<Option<Formula>> {
        let structure = self.world.problem.structure.as_deref()?;
        let in_ribs = self.scope.is_some_and(|scope| scope.collection == Collection::Ribs);
        if !(word == "material" && in_ribs) {
            return None;
        }
        let known = |material: u32| structure.material_number(material, name);
        let materials = self.scope.map(|scope| scope.members.as_slice()).unwrap_or_default();
        let lacking = materials.iter().find_map(|&rib| {
            let material = structure.members[structure.member(rib)? as usize].material;
            known(material).is_none().then_some(material)
        });
        if let Some(material) = lacking {
            let material = &structure.materials[material as usize];
            let names = material.data.iter().map(|(name, _)| &**name).chain(["E", "G", "nu", "density", "alpha"]);
            let help = did_you_mean(name, names).unwrap_or_else(|| format!("add it: {name} = … in [materials]"));
            return Some(self.mistake(
                MistakeCode::UnknownName,
                span,
                format!("material `{}` has no number `{name}`", material.name),
                Some(help),
            ));
        }
        Some(Some(Formula::OwnMaterial(Arc::from(name))))
    }
}
