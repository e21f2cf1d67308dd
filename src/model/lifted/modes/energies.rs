//! The matrices of buckling and vibration as second derivatives of energies: of strain, of axial forces on inclined axes, of mass.
//!
//! Its variables are the design, the displacements of every case, and a mode w: displacements of the free directions of nodes, then of the
//! ends of inner pieces. Its rows are ½wᵀKw, ½wᵀGw of every case or combination asked for, and ½wᵀMw. So K, G and M are their Hessians
//! in w, and every derivative of the matrices along the design is exact.

use std::sync::Arc;

use super::super::maps::{Linear, settlements};
use super::super::{Numbering, with_inputs};
use crate::linear_algebra::pencil::Symmetric;
use crate::model::views::mapped::{Mapped, Maps};
use crate::model::{AssemblyError, EvaluationError, Meta, Model, RibModel, assemble};
use crate::problem::formula::{Energy, Response, Subject, What};
use crate::problem::modes::Pencil;
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};
use crate::structure::algebra::Numbers;
use crate::structure::deformation::{along, turning};

/// The energies of a structure in a mode.
pub(super) struct Energies {
    model: Mapped<RibModel>,
    /// Design and displacements: the variables before w.
    before: usize,
    /// Cases and combinations, in the order of their rows.
    sets: Vec<u32>,
    /// Springs and masses at nodes: what they add to the diagonals of K and M.
    springs: Vec<(usize, f64)>,
    masses: Vec<(usize, f64)>,
}

/// Derivatives of the energies at a mode.
pub(super) struct Derivatives {
    /// Of a weighted sum of the energies by design and displacements, twice: wᵀS_zw.
    pub slope: Vec<f64>,
    /// wᵀS_zz'w, by (z, z') with z' ≤ z.
    pub curvature: Vec<(usize, usize, f64)>,
    /// S_z·w, by z.
    pub mixed: Vec<Vec<f64>>,
}

impl Energies {
    /// The energies that these pencils are made of.
    pub fn of(
        problem: &Problem,
        structure: &Structure,
        statics: &Statics,
        numbering: &Numbering,
        pencils: &[Pencil],
    ) -> Result<Self, AssemblyError> {
        let mut sets: Vec<u32> =
            pencils.iter().filter_map(|pencil| if let Pencil::Buckling(set) = pencil { Some(*set) } else { None }).collect();
        sets.sort_unstable();
        sets.dedup();
        let mut inner =
            Problem { constraints: Vec::new(), objective: Formula::default(), auxiliaries: Vec::new(), ..problem.clone() };
        let inputs = structure.load_sets() * statics.inputs as usize + 12 * statics.pieces as usize;
        with_inputs(&mut inner, inputs);
        let kinds: Vec<(Energy, u32)> = std::iter::once((Energy::Strain, 0))
            .chain(sets.iter().map(|&set| (Energy::Prestress, set)))
            .chain(pencils.contains(&Pencil::Vibration).then_some((Energy::Inertia, 0)))
            .collect();
        let most = statics.members.iter().map(|member| member.pieces).max().unwrap_or(0);
        let mut row_of = Vec::new();
        for (row, &(energy, set)) in kinds.iter().enumerate() {
            for piece in 0..most {
                let weighs = |material: u32| structure.materials[material as usize].density.is_some();
                let has = structure.members.iter().zip(&statics.members).filter(|(declared, member)| {
                    member.pieces > piece && (energy != Energy::Inertia || weighs(declared.material))
                });
                let ribs: Vec<u32> = has.map(|(member, _)| member.rib).collect();
                row_of.extend(std::iter::repeat_n(row, ribs.len()));
                inner.constraints.push(energy_row(energy, set, piece, ribs));
            }
        }
        let inner = assemble(&Arc::new(inner))?;
        let mut maps = Maps::default();
        let directions = mode_directions(structure, statics, numbering);
        let before = numbering.states.first_variable + numbering.states.block * numbering.states.blocks;
        map_inputs(structure, statics, numbering, &sets, &directions, before, &mut maps);
        for row in 0..kinds.len() {
            let of_row = row_of.iter().enumerate().filter(|(_, of)| **of == row);
            maps.outputs.push(of_row.map(|(at, _)| (at as u32, 1.0)).collect::<Vec<_>>());
            maps.linear.push([]);
        }
        let variables = before + directions.count;
        let meta = Meta {
            lower: vec![f64::NEG_INFINITY; variables],
            upper: vec![f64::INFINITY; variables],
            start: vec![0.0; variables],
            row_lower: vec![f64::NEG_INFINITY; kinds.len()],
            row_upper: vec![f64::INFINITY; kinds.len()],
            ..Meta::default()
        };
        let model = Mapped::new(inner, maps, meta);
        let at_node = |node: u32, direction: usize| directions.of_node(node, direction);
        let springs = structure.supports.iter().flat_map(|support| {
            (0..6).filter_map(move |direction| Some((at_node(support.node, direction)?, support.springs[direction])))
        });
        let springs = springs.filter(|(_, stiffness)| *stiffness != 0.0).collect();
        let masses = structure.masses.iter();
        let masses = masses.flat_map(|&(node, mass)| (0..3).filter_map(move |axis| Some((at_node(node, axis)?, mass)))).collect();
        Ok(Energies { model, before, sets, springs, masses })
    }

    /// Number of displacements in a mode.
    pub fn order(&self) -> usize {
        self.model.meta().variables() - self.before
    }

    /// The variables among design and displacements that a pencil depends on.
    pub fn columns(&self, pencil: Pencil) -> Vec<u32> {
        let jacobian = &self.model.meta().jacobian;
        let rows = [0, self.row(pencil)];
        let mut columns: Vec<u32> =
            rows.iter().flat_map(|&row| jacobian.row(row)).copied().filter(|&j| (j as usize) < self.before).collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// The row of B, and its sign there.
    fn row(&self, pencil: Pencil) -> usize {
        match pencil {
            Pencil::Buckling(set) => 1 + self.sets.iter().position(|known| *known == set).unwrap_or(0),
            Pencil::Vibration => 1 + self.sets.len(),
        }
    }

    /// The weights of the rows in k·K + b·B.
    fn weights(&self, pencil: Pencil, k: f64, b: f64) -> Vec<f64> {
        let mut weights = vec![0.0; self.model.meta().rows()];
        weights[0] = k;
        weights[self.row(pencil)] = if pencil == Pencil::Vibration { b } else { -b };
        weights
    }

    fn point(&self, z: &[f64], w: &[f64]) -> Vec<f64> {
        z[..self.before].iter().chain(w).copied().collect()
    }

    /// k·K + b·B.
    pub fn matrix(&self, z: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Symmetric, EvaluationError> {
        let pattern = &self.model.meta().hessian;
        let mut values = vec![0.0; pattern.len()];
        let point = self.point(z, &vec![0.0; self.order()]);
        self.model.hessian(&point, 0.0, &self.weights(pencil, k, b), &mut values)?;
        let mut matrix = Symmetric::zeros(self.order());
        for ((row, column), value) in pattern.iter().zip(values) {
            if column >= self.before {
                matrix.add(row - self.before, column - self.before, value);
            }
        }
        self.springs.iter().for_each(|&(at, stiffness)| matrix.add(at, at, k * stiffness));
        if pencil == Pencil::Vibration {
            self.masses.iter().for_each(|&(at, mass)| matrix.add(at, at, b * mass));
        }
        Ok(matrix)
    }

    /// wᵀS_zw of S = k·K + b·B, by design and displacements.
    pub fn slope(&self, z: &[f64], w: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Vec<f64>, EvaluationError> {
        let pattern = &self.model.meta().jacobian;
        let mut values = vec![0.0; pattern.len()];
        self.model.jacobian(&self.point(z, w), &mut values)?;
        let mut whole = vec![0.0; self.model.meta().variables()];
        pattern.add_transposed(&values, &self.weights(pencil, k, b), &mut whole);
        whole.truncate(self.before);
        whole.iter_mut().for_each(|value| *value *= 2.0);
        Ok(whole)
    }

    /// What S = k·K + b·B changes by, along design and displacements, seen by w.
    pub fn derivatives(&self, z: &[f64], w: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Derivatives, EvaluationError> {
        let pattern = &self.model.meta().hessian;
        let mut values = vec![0.0; pattern.len()];
        self.model.hessian(&self.point(z, w), 0.0, &self.weights(pencil, k, b), &mut values)?;
        let (mut curvature, mut mixed) = (Vec::new(), vec![Vec::new(); self.before]);
        for ((row, column), value) in pattern.iter().zip(values).filter(|(_, value)| *value != 0.0) {
            if row < self.before {
                curvature.push((row, column, 2.0 * value));
            } else if column < self.before {
                if mixed[column].is_empty() {
                    mixed[column] = vec![0.0; self.order()];
                }
                mixed[column][row - self.before] = value;
            }
        }
        Ok(Derivatives { slope: self.slope(z, w, pencil, k, b)?, curvature, mixed })
    }
}

fn energy_row(energy: Energy, set: u32, piece: u32, ribs: Vec<u32>) -> Constraint {
    Constraint {
        name: "energy".into(),
        detail: Box::default(),
        place: String::new(),
        text: String::new(),
        scope: Scope::Ribs(ribs),
        left: Formula::Response(Arc::new(Response { set, subject: Subject::Own, what: What::Modal(energy, piece) })),
        right: Limit::AtMost(Formula::Constant(f64::INFINITY)),
    }
}

/// Where the directions of a mode stand in w.
struct Directions<'a> {
    numbering: &'a Numbering,
    /// The first of each member's inner nodes.
    inner: Vec<usize>,
    count: usize,
}

impl Directions<'_> {
    fn of_node(&self, node: u32, direction: usize) -> Option<usize> {
        self.numbering.of.get(&(node, direction as u8)).map(|&at| at as usize)
    }
}

fn mode_directions<'a>(structure: &Structure, statics: &Statics, numbering: &'a Numbering) -> Directions<'a> {
    let mut count = numbering.of.len();
    let mut inner = Vec::with_capacity(structure.members.len());
    for member in &statics.members {
        inner.push(count);
        let of_each = member.inner_directions().into_iter().filter(|&has| has).count();
        count += member.pieces.saturating_sub(1) as usize * of_each;
    }
    Directions { numbering, inner, count }
}

/// Design variables as they are, what members deform by in the cases asked for, and the ends of every piece in a mode.
fn map_inputs(
    structure: &Structure,
    statics: &Statics,
    numbering: &Numbering,
    sets: &[u32],
    directions: &Directions,
    before: usize,
    maps: &mut Maps,
) {
    for j in 0..numbering.states.first_variable as u32 {
        maps.inputs.push([(j, 1.0)]);
        maps.constants.push(0.0);
    }
    let linear = Linear { structure, statics, numbering, settled: settlements(structure) };
    for set in 0..structure.load_sets() as u32 {
        let factors = if sets.contains(&set) { structure.factors(set) } else { Vec::new() };
        for at in 0..statics.inputs {
            let (entries, constant) = linear.of(&factors, statics.input(at));
            maps.inputs.push(entries);
            maps.constants.push(constant);
        }
    }
    for member in 0..structure.members.len() {
        for piece in 0..statics.members[member].pieces {
            for at in 0..12 {
                let entries = piece_end(structure, statics, directions, member, piece, at);
                maps.inputs.push(entries.into_iter().map(|(state, factor)| ((before + state) as u32, factor)));
                maps.constants.push(0.0);
            }
        }
    }
}

/// What a displacement of a piece's end is in those of a mode: 0 to 5 at its start, then at its end.
fn piece_end(
    structure: &Structure,
    statics: &Statics,
    directions: &Directions,
    member: usize,
    piece: u32,
    at: usize,
) -> Vec<(usize, f64)> {
    let (declared, prepared) = (&structure.members[member], &statics.members[member]);
    let (end, direction) = (at / 6, at % 6);
    let number = piece + end as u32;
    if number > 0 && number < prepared.pieces {
        let has = prepared.inner_directions();
        let each = has.into_iter().filter(|&has| has).count();
        let place = has[..direction].iter().filter(|&&has| has).count();
        return if has[direction] {
            vec![(directions.inner[member] + (number as usize - 1) * each + place, 1.0)]
        } else {
            Vec::new()
        };
    }
    let node = if end == 0 { declared.start } else { declared.end };
    if !prepared.fixed {
        return directions.of_node(node, direction).map(|state| (state, 1.0)).into_iter().collect();
    }
    let axis = prepared.frame.axes[direction % 3];
    let row = match direction < 3 {
        true => along(&mut Numbers, end, axis, declared.offset[end]),
        false => turning(&mut Numbers, end, axis),
    };
    let global = row[6 * end..6 * end + 6].iter().enumerate().filter(|(_, factor)| **factor != 0.0);
    global.filter_map(|(direction, &factor)| Some((directions.of_node(node, direction)?, factor))).collect()
}
