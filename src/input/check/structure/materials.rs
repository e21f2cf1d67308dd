//! `[materials]`.

use super::super::Assembly;
use crate::input::declaration::Name;
use crate::input::declaration::structure::{MaterialEntry, StructureEntries};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::Dimension;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::{Material, Shear};

impl Assembly<'_> {
    pub(super) fn materials(&mut self, entries: &StructureEntries) {
        for entry in &entries.materials {
            let number = self.building.structure.materials.len() as u32;
            let material = self.material(entry);
            self.building.structure.materials.push(material);
            self.building.material_places.push(entry.name.place);
            self.building.materials.insert(entry.name.text.as_str().into(), number);
        }
    }

    fn material(&mut self, entry: &MaterialEntry) -> Material {
        let name: Box<str> = entry.name.text.as_str().into();
        let mut material =
            Material { name, young: Dimension::Constant(1.0), shear: None, density: None, expansion: None, data: Vec::new() };
        let find = |key: &str| entry.numbers.iter().find(|(name, _)| name.text == key);
        match find("E") {
            Some((_, scalar)) => {
                material.young = self.modulus(scalar, "E").unwrap_or(Dimension::Constant(1.0));
            }
            None => {
                let message = format!("material `{}` lacks `E`", entry.name.text);
                self.findings.mistake(
                    MistakeCode::Material,
                    entry.name.place,
                    message,
                    "add E = …, Young's modulus in the file's units",
                );
            }
        }
        if let (Some(_), Some((nu, _))) = (find("G"), find("nu")) {
            let message = format!("material `{}` has `G` and `nu`", entry.name.text);
            self.findings.mistake(MistakeCode::BothGiven, nu.place, message, "keep one of the two: G = E/(2·(1 + nu))");
        }
        for (key, scalar) in &entry.numbers {
            match key.text.as_str() {
                "E" => {}
                "G" => material.shear = self.modulus(scalar, "G").map(Shear::Modulus),
                "nu" => material.shear = material.shear.or(self.poisson(scalar).map(Shear::Poisson)),
                "density" => material.density = self.finite(scalar).filter(|value| self.not_negative(*value, key)),
                "alpha" => material.expansion = self.finite(scalar),
                _ => material.data.extend(self.finite(scalar).map(|value| (key.text.as_str().into(), value))),
            }
        }
        material
    }

    fn modulus(&mut self, scalar: &Scalar, what: &str) -> Option<Dimension> {
        let modulus = self.quantity(scalar)?;
        match modulus {
            Dimension::Constant(value) => self.is_positive(value, scalar.place(), what).then_some(modulus),
            _ => Some(modulus),
        }
    }

    fn poisson(&mut self, scalar: &Scalar) -> Option<f64> {
        let value = self.finite(scalar)?;
        if value > -1.0 && value <= 0.5 {
            return Some(value);
        }
        self.findings.mistake(
            MistakeCode::OutOfRange,
            scalar.place(),
            format!("`nu` cannot be {value}"),
            "Poisson's ratio lies between -1 and 0.5",
        );
        None
    }

    pub(super) fn not_negative(&mut self, value: f64, key: &Name) -> bool {
        if value < 0.0 {
            self.findings.mistake(
                MistakeCode::OutOfRange,
                key.place,
                format!("`{}` cannot be {value}", key.text),
                "expected 0 or more",
            );
        }
        value >= 0.0
    }

    /// The material of this name; the only one where nothing is said.
    pub(super) fn material_of(&mut self, written: Option<&Written>, what: &Name) -> Option<u32> {
        let count = self.building.structure.materials.len();
        match written {
            Some(written) => match self.building.materials.get(written.text.as_str()) {
                Some(&number) => Some(number),
                None => self.unknown_material(&written.text, written.place),
            },
            None if count == 1 => Some(0),
            None => {
                let help = match count {
                    0 => "declare one: [materials] steel = { E = 210e6, nu = 0.3 }".to_owned(),
                    _ => format!("say which of the {count}: material = \"{}\"", self.building.structure.materials[0].name),
                };
                self.findings.mistake(MistakeCode::Material, what.place, format!("rib `{}` has no material", what.text), help);
                None
            }
        }
    }

    fn unknown_material<T>(&mut self, name: &str, place: Place) -> Option<T> {
        let known = self.building.structure.materials.iter().map(|material| &*material.name);
        let help = did_you_mean(name, known).unwrap_or_else(|| "declare it under [materials]".into());
        self.findings.mistake(MistakeCode::UnknownItem, place, format!("there is no material `{name}`"), help);
        None
    }
}
