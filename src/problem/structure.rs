//! What a problem file says of the structure its ribs make up: nodes, supports, members, loads and cases, checked and by number.
//!
//! Global axes x, y, z are right-handed, z up. Six directions belong to a node: three displacements and three rotations.

mod loads;

use super::Dimension;
use crate::structure::Components;
pub use loads::{Action, Axes, Combination, Load};

/// The space a structure lives in, and so the directions in which its nodes can move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Plane {
    /// All six directions.
    #[default]
    Space,
    /// x, z and ry.
    Xz,
    /// x, y and rz.
    Xy,
}

impl Plane {
    /// Which of x, y, z, rx, ry, rz exist.
    pub fn directions(self) -> [bool; 6] {
        match self {
            Plane::Space => [true; 6],
            Plane::Xz => [true, false, true, false, true, false],
            Plane::Xy => [true, true, false, false, false, true],
        }
    }

    /// The axes of its coordinates: two in a plane, three in space.
    pub fn axes(self) -> &'static [usize] {
        match self {
            Plane::Space => &[0, 1, 2],
            Plane::Xz => &[0, 2],
            Plane::Xy => &[0, 1],
        }
    }

    /// Its name in files; none for space.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Plane::Space => None,
            Plane::Xz => Some("xz"),
            Plane::Xy => Some("xy"),
        }
    }
}

/// The names of a node's six directions, in order.
pub const DIRECTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A structure. Ribs without nodes are no part of it.
#[derive(Debug, Clone, Default)]
pub struct Structure {
    /// Where it lives.
    pub plane: Plane,
    /// What self-weight multiplies densities by.
    pub gravity: [f64; 3],
    /// Fractions of a rib's length at which a response without a station is required, ascending from 0 to 1.
    pub stations: Vec<f64>,
    /// Pieces a compressed member is cut into for buckling.
    pub buckling_pieces: u32,
    /// Materials.
    pub materials: Vec<Material>,
    /// Nodes.
    pub nodes: Nodes,
    /// Supports, at most one per node.
    pub supports: Vec<Support>,
    /// Masses at nodes besides the members' own.
    pub masses: Vec<(u32, f64)>,
    /// Ribs with nodes.
    pub members: Vec<Member>,
    /// The member each rib is; `None` for a rib without nodes.
    pub member_of_rib: Vec<Option<u32>>,
    /// Names of the load cases.
    pub cases: Vec<Box<str>>,
    /// Combinations of cases; their numbers follow those of the cases.
    pub combinations: Vec<Combination>,
    /// Loads, one target each.
    pub loads: Vec<Load>,
}

/// A material.
#[derive(Debug, Clone)]
pub struct Material {
    /// Its name.
    pub name: Box<str>,
    /// Young's modulus E.
    pub young: Dimension,
    /// What torsion and shear go by; `None` where neither G nor ν is given.
    pub shear: Option<Shear>,
    /// Density (mass or weight per volume, as `gravity` goes with it).
    pub density: Option<f64>,
    /// Coefficient of thermal expansion.
    pub expansion: Option<f64>,
    /// Further numbers: `material.fy`.
    pub data: Vec<(Box<str>, f64)>,
}

/// How the shear modulus is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shear {
    /// G itself.
    Modulus(Dimension),
    /// Poisson's ratio ν: G = E/(2(1 + ν)).
    Poisson(f64),
}

/// Nodes, column by column.
#[derive(Debug, Clone, Default)]
pub struct Nodes {
    /// Names.
    pub names: super::texts::Texts,
    /// Coordinates; 0 along an axis the plane has not.
    pub position: Vec<[Dimension; 3]>,
    /// Data columns.
    pub data: Vec<super::Column>,
}

/// What holds a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// The node.
    pub node: u32,
    /// Directions that cannot move.
    pub fixed: [bool; 6],
    /// Stiffness of springs to the ground, 0 where there is none.
    pub springs: [f64; 6],
}

/// A rib between two nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// The rib.
    pub rib: u32,
    /// The node where it starts.
    pub start: u32,
    /// The node where it ends.
    pub end: u32,
    /// Its material.
    pub material: u32,
    /// The direction of the section's height; `None` for the default: z up, x for vertical members, the left normal in a plane.
    pub up: Option<[f64; 3]>,
    /// Degrees by which the section is turned about the member.
    pub roll: f64,
    /// Axial force only.
    pub pinned: bool,
    /// Released end forces, at the start and at the end.
    pub hinges: [Hinges; 2],
    /// Rigid arms from the nodes to the member's ends, in global axes.
    pub offset: [[f64; 3]; 2],
    /// Whether shear deforms it (Timoshenko).
    pub shear: bool,
    /// Left out of the analysis: its area has vanished.
    pub absent: bool,
}

/// Forces released at an end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Hinges {
    /// The torque T.
    pub torque: bool,
    /// The moment My (about the section's width, with Ix).
    pub my: bool,
    /// The moment Mz.
    pub mz: bool,
}

impl Member {
    /// What of a row over the twelve displacements of its ends belongs to a direction of a node.
    pub fn at_node(&self, row: &[f64; 12], node: u32, direction: usize) -> f64 {
        let at = |end: usize, own: u32| if own == node { row[6 * end + direction] } else { 0.0 };
        at(0, self.start) + at(1, self.end)
    }

    /// The section's properties, beside the area, by which it deforms under the basic forces that it carries.
    pub fn deforms_by(&self, carried: &Components) -> impl Iterator<Item = &'static str> {
        let (about_z, about_y) = (carried[1] || carried[2], carried[3] || carried[4]);
        let named =
            [(about_y, "Ix"), (about_z, "Iy"), (carried[5], "J"), (self.shear && about_y, "Asy"), (self.shear && about_z, "Asx")];
        named.into_iter().filter(|(needed, _)| *needed).map(|(_, name)| name)
    }

    /// Whether it deforms by the shear modulus, too.
    pub fn needs_shear_modulus(&self, carried: &Components) -> bool {
        carried[5] || (self.shear && carried[1..5].contains(&true))
    }
}

impl Structure {
    /// A number of a material, where it is one: E, G, nu, density, alpha, or one of its own.
    pub fn material_number(&self, material: u32, name: &str) -> Option<f64> {
        let material = self.materials.get(material as usize)?;
        let constant = |dimension: Dimension| if let Dimension::Constant(value) = dimension { Some(value) } else { None };
        match name {
            "E" => constant(material.young),
            "G" => match material.shear? {
                Shear::Modulus(modulus) => constant(modulus),
                Shear::Poisson(ratio) => Some(constant(material.young)? / (2.0 * (1.0 + ratio))),
            },
            "nu" => match material.shear? {
                Shear::Poisson(ratio) => Some(ratio),
                Shear::Modulus(modulus) => Some(constant(material.young)? / (2.0 * constant(modulus)?) - 1.0),
            },
            "density" => material.density,
            "alpha" => material.expansion,
            _ => material.data.iter().find(|(known, _)| &**known == name).map(|(_, value)| *value),
        }
    }

    /// Whether E and G of a material are numbers.
    pub fn has_constant_moduli(&self, material: u32) -> bool {
        let constant = |dimension: &Dimension| matches!(dimension, Dimension::Constant(_));
        self.materials.get(material as usize).is_some_and(|material| {
            constant(&material.young) && !matches!(&material.shear, Some(Shear::Modulus(modulus)) if !constant(modulus))
        })
    }

    /// Whether the ground gives way by springs anywhere.
    pub fn has_springs(&self) -> bool {
        self.supports.iter().any(|support| support.springs.iter().any(|&spring| spring != 0.0))
    }

    /// Number of cases and combinations.
    pub fn load_sets(&self) -> usize {
        self.cases.len() + self.combinations.len()
    }

    /// The name of a case or combination.
    pub fn load_set_name(&self, set: u32) -> &str {
        let at = set as usize;
        self.cases.get(at).unwrap_or_else(|| &self.combinations[at - self.cases.len()].name)
    }

    /// The case or combination of this name.
    pub fn load_set(&self, name: &str) -> Option<u32> {
        (0..self.load_sets() as u32).find(|&set| self.load_set_name(set) == name)
    }

    /// The cases of a case or combination with their factors.
    pub fn factors(&self, set: u32) -> Vec<(u32, f64)> {
        match (set as usize).checked_sub(self.cases.len()) {
            None => vec![(set, 1.0)],
            Some(at) => self.combinations.get(at).map_or_else(Vec::new, |combination| combination.factors.clone()),
        }
    }

    /// Whether in a case or combination ribs deform for other reasons than forces: a settlement, a temperature, a pretension.
    pub fn is_strained(&self, set: u32) -> bool {
        let factors = self.factors(set);
        let acts = |load: &&Load| factors.iter().any(|(case, _)| *case == load.case);
        self.loads.iter().filter(acts).any(|load| load.action.strains())
    }

    /// The end nodes of the open line that some ribs make up; `None` where they are no such line.
    pub fn chord(&self, ribs: &[u32]) -> Option<[u32; 2]> {
        let mut visits: std::collections::BTreeMap<u32, usize> = std::collections::BTreeMap::new();
        for &rib in ribs {
            let member = self.members.get(self.member(rib)? as usize)?;
            [member.start, member.end].into_iter().for_each(|node| *visits.entry(node).or_default() += 1);
        }
        let ends: Vec<u32> = visits.iter().filter(|(_, visits)| **visits == 1).map(|(node, _)| *node).collect();
        let is_line = visits.values().all(|&visits| visits <= 2) && visits.len() == ribs.len() + 1;
        match ends[..] {
            [from, to] if is_line => Some([from, to]),
            _ => None,
        }
    }

    /// Whether a rib's ends move with the design.
    pub fn moves(&self, rib: u32) -> bool {
        let Some(member) = self.member(rib).and_then(|member| self.members.get(member as usize)) else { return false };
        let varies = |node: u32| self.nodes.position[node as usize].iter().any(|at| !matches!(at, Dimension::Constant(_)));
        varies(member.start) || varies(member.end)
    }

    /// The member a rib is.
    pub fn member(&self, rib: u32) -> Option<u32> {
        self.member_of_rib.get(rib as usize).copied().flatten()
    }
}
