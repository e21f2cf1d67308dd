//! Dimensions of names: properties of sections and ribs are known, those of the user's own names are looked for.

use super::walk::{Scope, Walk};
use crate::expression::ast::{Ast, AstKind, Collection};
use crate::input::source::Written;
use crate::problem::names::Entity;
use crate::problem::sections_form;
use crate::sections;
use crate::units::inference::Form;
use crate::units::{Dimension, Ratio};

/// Exponent of length of a section's property by its name; `None` where that depends on the kind or on the user's points.
fn property(name: &str, kind: Option<&str>) -> Option<i64> {
    match name {
        "A" | "Asx" | "Asy" => Some(2),
        "Ix" | "Iy" | "Ixy" | "Imin" | "J" => Some(4),
        "Iw" => Some(6),
        "r" => match kind? {
            // The exponent of a superellipse; the radius of an H beam's root.
            "superellipse" => Some(0),
            _ => Some(1),
        },
        _ if name.starts_with("scale") => None,
        _ if name.starts_with('W') => Some(3),
        _ => Some(1),
    }
}

/// The word for it in keys.
fn word(holder: Collection) -> &'static str {
    match holder {
        Collection::Sections => "sections",
        Collection::Ribs => "ribs",
        Collection::Nodes => "nodes",
    }
}

impl Walk<'_, '_> {
    /// A datum; all elements of an array of data have one dimension.
    pub fn datum(&mut self, holder: Collection, name: &str) -> Form {
        let base = name.split('[').next().unwrap_or(name);
        if holder == Collection::Nodes && ["x", "y", "z"].contains(&base) {
            return Dimension::LENGTH.into();
        }
        self.unknown(format!("data of {}: {base}", word(holder)))
    }

    /// A dimension or property of a section of some kind, else its datum.
    pub fn of_section(&mut self, kind: Option<&str>, name: &str) -> Form {
        let base = name.split('[').next().unwrap_or(name);
        let offers = |kind: &&dyn sections::Kind| kind.properties().iter().any(|known| *known == name || *known == base);
        let offered = match kind.and_then(sections::kind) {
            Some(kind) => offers(&kind),
            None => self.kinds.iter().any(offers),
        };
        if !offered {
            return self.datum(Collection::Sections, name);
        }
        let only = self.kinds.first().filter(|_| kind.is_none()).map(|kind| kind.name());
        match property(base, kind.or(only)) {
            Some(power) => Dimension::whole([power, 0, 0, 0]).into(),
            None => self.unknown(format!("property: {base}")),
        }
    }

    /// Whether items of this collection have a number of this name of their own.
    fn is_own(&self, holder: Collection, name: &str) -> bool {
        let columns = self.assembly.problem.columns(holder);
        let is_datum = columns.iter().any(|column| column.name.split('[').next() == Some(name));
        let is_property = match holder {
            Collection::Sections => self.kinds.iter().any(|kind| kind.properties().contains(&name)),
            Collection::Ribs => ["length", "volume"].contains(&name),
            Collection::Nodes => false,
        };
        is_datum || is_property
    }

    /// A name, the item's own first.
    pub fn named(&mut self, parts: &[String], scope: Scope) -> Form {
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        match (scope.holder, &parts[..]) {
            (_, [name]) if self.indices.iter().any(|index| index == name) => Dimension::NONE.into(),
            (Some(holder), [name]) if scope.itself != Some(name) && self.is_own(holder, name) => match (holder, *name) {
                (Collection::Sections, name) => self.of_section(None, name),
                (Collection::Ribs, "length") => Dimension::LENGTH.into(),
                (Collection::Ribs, "volume") => Dimension::whole([3, 0, 0, 0]).into(),
                (holder, name) => self.datum(holder, name),
            },
            (Some(Collection::Ribs), ["from" | "to" | "at", name]) => self.of_section(None, name),
            (Some(Collection::Ribs), ["material", name]) => self.of_material(name),
            (_, ["outer", ..]) => self.inference.unknown(),
            (_, [name]) => self.global(name),
            (_, [item, name]) => self.of_item(item, name),
            (_, [rib, end @ ("from" | "to"), name]) => self.at_end(rib, end, name),
            _ => self.inference.unknown(),
        }
    }

    fn global(&mut self, name: &str) -> Form {
        match self.assembly.names.find(&self.assembly.problem, name) {
            Some(_) => self.unknown(format!("name: {name}")),
            None => match name {
                "pi" => Dimension::NONE.into(),
                "volume" | "volume_frustum" | "volume_prismatoid" => Dimension::whole([3, 0, 0, 0]).into(),
                "weight" => Dimension::FORCE.into(),
                "mass" => {
                    // Densities may be of mass or of weight: as gravity goes with them.
                    let density = self.of_material("density");
                    let volume = Form::from(Dimension::whole([3, 0, 0, 0]));
                    volume.times(&density, crate::units::Ratio::ONE).unwrap_or_else(|| self.inference.unknown())
                }
                _ => self.inference.unknown(),
            },
        }
    }

    fn of_item(&mut self, item: &str, name: &str) -> Form {
        match self.assembly.names.find(&self.assembly.problem, item) {
            Some(Entity::Section(s)) => {
                let kind = sections_form(&self.assembly.problem, s as usize).map(|form| form.kind);
                self.of_section(kind, name)
            }
            Some(Entity::Rib(_)) if name == "length" => Dimension::LENGTH.into(),
            Some(Entity::Rib(_)) if name == "volume" => Dimension::whole([3, 0, 0, 0]).into(),
            Some(Entity::Rib(_)) => self.datum(Collection::Ribs, name),
            _ => self.inference.unknown(),
        }
    }

    fn at_end(&mut self, rib: &str, end: &str, name: &str) -> Form {
        let Some(Entity::Rib(r)) = self.assembly.names.find(&self.assembly.problem, rib) else { return self.inference.unknown() };
        let ribs = &self.assembly.problem.ribs;
        let s = if end == "from" { ribs.from[r as usize] } else { ribs.to[r as usize] };
        let kind = sections_form(&self.assembly.problem, s as usize).map(|form| form.kind);
        self.of_section(kind, name)
    }

    /// A number of a material.
    pub fn of_material(&mut self, name: &str) -> Form {
        match name {
            "E" | "G" => Dimension::STRESS.into(),
            "nu" => Dimension::NONE.into(),
            "alpha" => Dimension::whole([0, 0, 0, -1]).into(),
            _ => self.unknown(format!("material: {name}")),
        }
    }

    /// A response, or a profile.
    pub fn call(&mut self, name: &str, arguments: &[Ast], written: &Written, scope: Scope) -> Form {
        let said = |word: &str| arguments.iter().any(|argument| is_word(argument, word));
        let turns = ["rx", "ry", "rz"].into_iter().any(&said);
        let dimension = match name {
            "disp" if turns => Dimension::NONE,
            "disp" | "deflection" | "sag" => Dimension::LENGTH,
            "reaction" if turns => Dimension::MOMENT,
            "reaction" => Dimension::FORCE,
            "force" if ["T", "My", "Mz"].into_iter().any(said) => Dimension::MOMENT,
            "force" => Dimension::FORCE,
            "stress" | "vonmises" => Dimension::STRESS,
            "compliance" => Dimension::MOMENT,
            "buckling" => Dimension::NONE,
            "frequency" => Dimension::whole([0, 0, -1, 0]),
            "profile" => {
                if let [_, at] = arguments {
                    let form = self.expression(at, written, scope);
                    self.needed(written, at.span, &form, &Dimension::NONE.into(), "a place along a profile");
                }
                let controls = arguments.first().and_then(|first| match &first.kind {
                    AstKind::Name(parts) => parts.first().cloned(),
                    _ => None,
                });
                return self.unknown(format!("name: {}", controls.unwrap_or_default()));
            }
            "quadratic" => {
                let forms: Vec<Form> = arguments.iter().map(|part| self.expression(part, written, scope)).collect();
                let [matrix, vector] = &forms[..] else { return self.inference.unknown() };
                return matrix.times(vector, Ratio::from_integer(2)).unwrap_or_else(|| self.inference.unknown());
            }
            _ => return self.inference.unknown(),
        };
        dimension.into()
    }
}

fn is_word(argument: &Ast, word: &str) -> bool {
    match &argument.kind {
        AstKind::Name(parts) => parts[..] == [word],
        AstKind::Text(text) => text == word,
        _ => false,
    }
}
