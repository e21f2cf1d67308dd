//! What follows from a structure's declaration once and for all: axes, constant maps, which directions move, and the numbering of what
//! members deform by.
//!
//! The forces of a member are functions of few inputs: its dimensions and its deformations. Deformations are fixed combinations of
//! displacements, so the assembled model knows them as inputs of its own, and [`crate::model::lifted`] puts the displacements in.

mod loads;
mod pieces;

use super::structure::{Action, Plane, Structure};
use super::{Dimension, Problem};
use crate::structure::Components;
use crate::structure::algebra::Numbers;
use crate::structure::axes::{Frame, Rule, frame};
use crate::structure::deformation::{BASIC, Rows, rows};
use crate::structure::quadrature::graded;

/// The largest ratio of a dimension between a member's ends that its integrals are graded for.
const STEEPEST: f64 = 1e3;

/// The ratio they are graded for where bounds are open.
const UNBOUNDED: f64 = 9.0;

/// A structure, prepared.
#[derive(Debug, Clone)]
pub struct Statics {
    /// Members.
    pub members: Vec<Prepared>,
    /// Members at each node.
    pub members_at: Vec<Vec<u32>>,
    /// Loads on each node itself, by number, in any case.
    pub loads_at: Vec<Vec<u32>>,
    /// Directions of each node that something resists, loads or holds: they exist.
    pub exists: Vec<[bool; 6]>,
    /// Directions of each node that are held.
    pub fixed: Vec<[bool; 6]>,
    /// Inputs of one case or combination: the members', then six per node.
    pub inputs: u32,
    /// The first of the nodes' inputs.
    first_node: u32,
    /// Pieces that members are cut into for buckling and vibration, in all.
    pub pieces: u32,
}

/// A member, prepared.
#[derive(Debug, Clone)]
pub struct Prepared {
    /// Its axes' rule.
    pub rule: Rule,
    /// Axes and length at the starting coordinates.
    pub frame: Frame<f64>,
    /// Deformations by displacements, at the starting coordinates.
    pub rows: Rows<f64>,
    /// Which basic forces it carries.
    pub components: Components,
    /// Which it could carry without hinges: its inner pieces do.
    pub unhinged: Components,
    /// Pieces it is cut into for buckling and vibration, and the first of them.
    pub pieces: u32,
    /// The first of them among all.
    pub first_piece: u32,
    /// Where integrals over its length are cut.
    pub grading: Vec<f64>,
    /// Whether its nodes stay where they are: then its inputs are deformations, else the twelve displacements of its ends.
    pub fixed: bool,
    /// Whether its responses are formulas of its basic forces, which are computed once for all of them; of bars they are simpler by their
    /// deformations.
    pub by_forces: bool,
    /// Its loads, by number, in any case.
    pub loads: Vec<u32>,
    /// Its first input within a case.
    first_input: u32,
}

/// What one input of the assembled model is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// A deformation of a member.
    Deformation(u32, usize),
    /// A displacement of a node in a direction.
    Displacement(u32, usize),
}

impl Statics {
    /// Prepares the structure of a problem; `None` where it has none.
    pub fn of(problem: &Problem) -> Option<Statics> {
        let structure = problem.structure.as_deref()?;
        let mut members: Vec<Prepared> = structure.members.iter().map(|member| prepare(problem, structure, member)).collect();
        for (number, load) in structure.loads.iter().enumerate() {
            let present = |member: &u32| structure.members.get(*member as usize).is_some_and(|member| !member.absent);
            if let Some(member) = load.action.member().filter(present) {
                members[member as usize].loads.push(number as u32);
            }
        }
        let mut loads_at = vec![Vec::new(); structure.nodes.names.len()];
        for (number, load) in structure.loads.iter().enumerate() {
            if let Action::Nodal { node, .. } = load.action {
                loads_at[node as usize].push(number as u32);
            }
        }
        let (mut next, mut pieces) = (0, 0);
        for member in &mut members {
            (member.first_input, member.first_piece) = (next, pieces);
            next += member.width() as u32;
            pieces += member.pieces;
        }
        let nodes = structure.nodes.names.len();
        let mut members_at = vec![Vec::new(); nodes];
        for (number, member) in structure.members.iter().enumerate().filter(|(_, member)| !member.absent) {
            members_at[member.start as usize].push(number as u32);
            members_at[member.end as usize].push(number as u32);
        }
        let mut fixed = vec![[false; 6]; nodes];
        structure.supports.iter().for_each(|support| fixed[support.node as usize] = support.fixed);
        let exists = existing(structure, &members);
        Some(Statics { members, members_at, loads_at, exists, fixed, inputs: next + 6 * nodes as u32, first_node: next, pieces })
    }

    /// The input of a member's deformation in a case or combination, counted from the first input of all; `None` where it is released.
    pub fn deformation(&self, set: u32, member: u32, component: usize) -> Option<u32> {
        let prepared = &self.members[member as usize];
        let before = (0..component).filter(|&at| prepared.components[at]).count() as u32;
        (prepared.fixed && prepared.components[component]).then(|| set * self.inputs + prepared.first_input + before)
    }

    /// The input of a node's displacement in a case or combination.
    pub fn displacement(&self, set: u32, node: u32, direction: usize) -> u32 {
        set * self.inputs + self.first_node + 6 * node + direction as u32
    }

    /// What an input of one case is; the inverse of the two above.
    pub fn input(&self, at: u32) -> Input {
        match at.checked_sub(self.first_node) {
            Some(of_nodes) => Input::Displacement(of_nodes / 6, of_nodes as usize % 6),
            None => {
                let member = self.members.partition_point(|member| member.first_input <= at) - 1;
                let position = (at - self.members[member].first_input) as usize;
                let kept = |component: &usize| self.members[member].components[*component];
                Input::Deformation(member as u32, (0..BASIC).filter(kept).nth(position).unwrap_or(0))
            }
        }
    }

    /// The load that acts on a node itself in one direction, in a case or combination.
    pub fn nodal_load(&self, structure: &Structure, set: u32, node: u32, direction: usize) -> f64 {
        let factors = structure.factors(set);
        let value = |&load: &u32| {
            let load = &structure.loads[load as usize];
            let factor = factors.iter().find(|(case, _)| *case == load.case).map_or(0.0, |(_, factor)| *factor);
            match &load.action {
                Action::Nodal { force, moment, .. } if direction < 3 => factor * force[direction],
                Action::Nodal { moment, .. } => factor * moment[direction - 3],
                _ => 0.0,
            }
        };
        self.loads_at[node as usize].iter().map(value).sum()
    }

    /// Whether a node can move in a direction.
    pub fn is_free(&self, node: u32, direction: usize) -> bool {
        self.exists[node as usize][direction] && !self.fixed[node as usize][direction]
    }
}

impl Statics {
    /// Node and direction of every displacement that is free.
    pub fn free_directions(&self) -> impl Iterator<Item = (u32, usize)> + '_ {
        let all = (0..self.exists.len() as u32).flat_map(|node| (0..6).map(move |direction| (node, direction)));
        all.filter(|&(node, direction)| self.is_free(node, direction))
    }
}

impl Prepared {
    /// Inputs of its own: its deformations, none where it deforms by its nodes' displacements.
    fn width(&self) -> usize {
        if self.fixed { self.components.iter().filter(|&&kept| kept).count() } else { 0 }
    }
}

/// A node's coordinates at the start.
pub fn position(problem: &Problem, structure: &Structure, node: u32) -> [f64; 3] {
    let evaluation = super::evaluate::Evaluation::at_start(problem);
    structure.nodes.position[node as usize].map(|coordinate| match coordinate {
        Dimension::Constant(value) => value,
        other => evaluation.dimension(u32::MAX, other).unwrap_or(f64::NAN),
    })
}

/// The rule of a member's axes, by its direction at the start.
pub(super) fn rule_of(plane: Plane, member: &super::structure::Member, along: [f64; 3]) -> Rule {
    match (member.up, plane) {
        (Some(up), _) => Rule::Towards(up),
        (None, Plane::Xz) => Rule::LeftInXz,
        (None, Plane::Xy) => Rule::LeftInXy,
        (None, Plane::Space) => Rule::in_space(along),
    }
}

fn prepare(problem: &Problem, structure: &Structure, member: &super::structure::Member) -> Prepared {
    let ends = [member.start, member.end];
    let [start, end] = ends.map(|node| position(problem, structure, node));
    let along: [f64; 3] =
        std::array::from_fn(|axis| (end[axis] + member.offset[1][axis]) - (start[axis] + member.offset[0][axis]));
    let rule = rule_of(structure.plane, member, along);
    let frame = frame(&mut Numbers, along, rule, member.roll);
    let rows = rows(&mut Numbers, &frame, member.offset);
    let constant = |dimension: &Dimension| matches!(dimension, Dimension::Constant(_));
    let fixed = member.absent || ends.iter().all(|&node| structure.nodes.position[node as usize].iter().all(constant));
    let components = components(structure.plane, member, &rows);
    let unhinged = super::structure::Member { hinges: Default::default(), ..member.clone() };
    let unhinged = self::components(structure.plane, &unhinged, &rows);
    let pieces = match (member.absent, member.pinned) {
        (true, _) => 0,
        // Between its hinges a bar stays straight.
        (false, true) => 1,
        (false, false) => structure.buckling_pieces.max(1),
    };
    let by_forces = fixed && !member.pinned && structure.has_constant_moduli(member.material);
    let grading = graded(steepest(problem, member.rib));
    let (loads, first_input, first_piece) = (Vec::new(), 0, 0);
    Prepared { rule, frame, rows, components, unhinged, pieces, first_piece, grading, fixed, by_forces, loads, first_input }
}

/// Basic forces that neither a hinge releases nor a plane leaves without a displacement to work on.
pub(super) fn components(plane: Plane, member: &super::structure::Member, rows: &Rows<f64>) -> Components {
    let [start, end] = member.hinges;
    let released = match member.pinned {
        true => [false, true, true, true, true, true],
        false => [false, start.mz, end.mz, start.my, end.my, start.torque || end.torque],
    };
    let directions = plane.directions();
    std::array::from_fn(|component| {
        let works = (0..12).any(|at| directions[at % 6] && rows[component][at].abs() > 1e-12);
        works && !released[component] && !member.absent
    })
}

/// The largest ratio that the bounds allow a dimension to have between a rib's ends, either way.
fn steepest(problem: &Problem, rib: u32) -> f64 {
    let ends = [problem.ribs.from[rib as usize], problem.ribs.to[rib as usize]];
    if ends[0] == ends[1] {
        return 1.0;
    }
    let evaluation = super::evaluate::Evaluation::at_start(problem);
    let range = |section: u32, dimension: Dimension| match dimension {
        Dimension::Constant(value) => [value, value],
        Dimension::Variable(j) => [problem.variables.lower[j as usize], problem.variables.upper[j as usize]],
        other => evaluation.dimension(section, other).map_or([1.0, 1.0], |value| [value, value]),
    };
    let [from, to] = ends.map(|section| problem.dimensions(section as usize));
    let ratio = |(&left, &right): (&Dimension, &Dimension)| {
        if left == right {
            return 1.0;
        }
        let (left, right) = (range(ends[0], left), range(ends[1], right));
        let worst = (left[1] / right[0]).max(right[1] / left[0]);
        if worst.is_finite() { worst.min(STEEPEST) } else { UNBOUNDED }
    };
    from.iter().zip(to).map(ratio).fold(1.0, f64::max)
}

/// Directions that some member, spring, mass or support knows.
fn existing(structure: &Structure, members: &[Prepared]) -> Vec<[bool; 6]> {
    let mut exists = vec![[false; 6]; structure.nodes.names.len()];
    for (member, prepared) in structure.members.iter().zip(members) {
        for (end, node) in [member.start, member.end].into_iter().enumerate() {
            for (direction, known) in exists[node as usize].iter_mut().enumerate() {
                let touched =
                    (0..BASIC).any(|at| prepared.components[at] && prepared.rows[at][6 * end + direction].abs() > 1e-12);
                // A rotation of a variable shape may come to matter though it does not at the start.
                let bends = prepared.components[1..].iter().any(|&kept| kept);
                *known |= touched || (!prepared.fixed && (direction < 3 || bends));
            }
        }
    }
    for support in &structure.supports {
        for (direction, known) in exists[support.node as usize].iter_mut().enumerate() {
            *known |= support.fixed[direction] || support.springs[direction] != 0.0;
        }
    }
    let directions = structure.plane.directions();
    exists.iter_mut().for_each(|node| (0..6).for_each(|at| node[at] &= directions[at]));
    exists
}
