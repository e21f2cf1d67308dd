//! What a structure does along its ribs, in numbers: tables, and what pictures are drawn from.

mod vtu;

use std::io::{self, Write};

pub use vtu::write_vtu;

use super::number::exact;
use super::text::cell;
use crate::problem::structure::Plane;

/// Said once in every summary.
pub const AXES: &str =
    "z is up; ribs: x along, z height, y width; My bends about y and goes with Ix (Eurocode's Iy); N is positive in tension.";

/// How `displacements.csv` and `reactions.csv` begin.
pub const NODES_HEADER: &str = "node,case,x,y,z,rx,ry,rz";

/// How `forces.csv` begins.
pub const FORCES_HEADER: &str = "rib,case,station,N,Vy,Vz,T,My,Mz";

/// The six forces in the order of [`CaseCourses::forces`].
pub const FORCES: [&str; 6] = ["N", "Vy", "Vz", "T", "My", "Mz"];

/// A node where the design puts it.
#[derive(Debug, Clone, PartialEq)]
pub struct NodePlace {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub position: [f64; 3],
    /// Directions that are held, or resisted by a spring.
    pub held: [bool; 6],
}

/// A member where the design puts it.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberPlace {
    /// Its rib, and that one's name.
    pub rib: usize,
    /// The name.
    pub name: String,
    /// Its nodes.
    pub nodes: [u32; 2],
    /// Its ends: the nodes but for rigid offsets.
    pub ends: [[f64; 3]; 2],
    /// Unit vectors along it, along its sections' width and along their height.
    pub axes: [[f64; 3]; 3],
    /// Whether it carries axial force only.
    pub pinned: bool,
}

/// What a structure does in one case or combination.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CaseCourses {
    /// The case or combination.
    pub name: String,
    /// Displacements and rotations of every node.
    pub nodes: Vec<[f64; 6]>,
    /// What the ground exerts on nodes.
    pub reactions: Vec<(u32, [f64; 6])>,
    /// [`FORCES`] of every member at every station, member by member.
    pub forces: Vec<[f64; 6]>,
    /// Displacements of the same places, in global axes.
    pub moved: Vec<[f64; 3]>,
}

/// A structure at a design: where it is, and what it does in all cases and combinations.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Courses {
    /// The space it lives in.
    pub plane: Plane,
    /// Fractions of the members' lengths.
    pub stations: Vec<f64>,
    /// Nodes.
    pub nodes: Vec<NodePlace>,
    /// Members.
    pub members: Vec<MemberPlace>,
    /// Combinations follow cases.
    pub cases: Vec<CaseCourses>,
    /// How many of them are cases.
    pub simple_cases: usize,
}

impl Courses {
    /// What each rib does most, by case: `CASE displacement`, and of every force that is there the value of the largest size. NaN for ribs
    /// that are no members.
    pub fn extremes(&self) -> Vec<(String, Vec<f64>)> {
        let mut all = Vec::new();
        let ribs = self.members.iter().map(|member| member.rib + 1).max().unwrap_or(0);
        let mut add = |name: String, value: &dyn Fn(usize) -> f64| {
            let mut column = vec![f64::NAN; ribs];
            for (number, member) in self.members.iter().enumerate() {
                let values = (0..self.stations.len()).map(|station| value(self.at(number, station)));
                column[member.rib] = values.fold(0.0, |most: f64, value| if value.abs() > most.abs() { value } else { most });
            }
            if column.iter().any(|value| *value != 0.0 && !value.is_nan()) {
                all.push((name, column));
            }
        };
        for case in &self.cases {
            let size = |at: usize| case.moved[at].iter().map(|value| value * value).sum::<f64>().sqrt();
            add(format!("{} displacement", case.name), &size);
            for (at, force) in FORCES.iter().enumerate() {
                add(format!("{} {force}", case.name), &|place| case.forces[place][at]);
            }
        }
        all
    }

    /// Displacements, reactions and forces that are zero but for rounding are zero.
    pub fn without_rounding(&mut self) {
        for case in &mut self.cases {
            clean(case.forces.iter_mut().map(|all| &mut all[..3]));
            clean(case.forces.iter_mut().map(|all| &mut all[3..]));
            clean(case.nodes.iter_mut().map(|all| &mut all[..3]).chain(case.moved.iter_mut().map(|moved| &mut moved[..])));
            clean(case.nodes.iter_mut().map(|all| &mut all[3..]));
            clean(case.reactions.iter_mut().map(|(_, all)| &mut all[..3]));
            clean(case.reactions.iter_mut().map(|(_, all)| &mut all[3..]));
        }
    }

    /// A member's place at a station.
    pub fn point(&self, member: usize, station: usize) -> [f64; 3] {
        let [from, to] = self.members[member].ends;
        let s = self.stations[station];
        std::array::from_fn(|axis| from[axis] + s * (to[axis] - from[axis]))
    }

    /// The number of a member's place in the lists of a case.
    pub fn at(&self, member: usize, station: usize) -> usize {
        member * self.stations.len() + station
    }

    /// `displacements.csv`: one line per node and case.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_displacements(&self, out: &mut dyn Write) -> io::Result<()> {
        self.by_node(out, |case| Box::new(case.nodes.iter().enumerate().map(|(node, values)| (node as u32, *values))))
    }

    /// `reactions.csv`: one line per held node and case.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_reactions(&self, out: &mut dyn Write) -> io::Result<()> {
        self.by_node(out, |case| Box::new(case.reactions.iter().copied()))
    }

    fn by_node(&self, out: &mut dyn Write, list: impl Fn(&CaseCourses) -> NodeValues<'_>) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(NODES_HEADER.split(','))?;
        let directions = self.plane.directions();
        for case in &self.cases {
            for (node, values) in list(case) {
                let numbers: [String; 6] =
                    std::array::from_fn(|at| if directions[at] { exact(values[at]) } else { String::new() });
                table.write_field(&*cell(&self.nodes[node as usize].name))?;
                table.write_field(&*cell(&case.name))?;
                table.write_record(&numbers)?;
            }
        }
        table.flush()
    }

    /// `forces.csv`: one line per rib, case and station.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_forces(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(FORCES_HEADER.split(','))?;
        for (number, member) in self.members.iter().enumerate() {
            for case in &self.cases {
                for (station, s) in self.stations.iter().enumerate() {
                    table.write_field(&*cell(&member.name))?;
                    table.write_field(&*cell(&case.name))?;
                    table.write_field(exact(*s))?;
                    table.write_record(case.forces[self.at(number, station)].map(exact))?;
                }
            }
        }
        table.flush()
    }
}

/// What rounding leaves of a zero, relative to the largest value of its kind in a case.
const ROUNDING: f64 = 1e-12;

fn clean<'a>(lists: impl Iterator<Item = &'a mut [f64]>) {
    let mut values: Vec<&mut f64> = lists.flatten().collect();
    let largest = values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    values.iter_mut().filter(|value| value.abs() <= ROUNDING * largest).for_each(|value| **value = 0.0);
}

type NodeValues<'a> = Box<dyn Iterator<Item = (u32, [f64; 6])> + 'a>;
