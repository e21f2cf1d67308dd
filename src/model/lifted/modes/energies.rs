//! The matrices of buckling and vibration as second derivatives of energies: of strain, of axial forces on inclined axes, of mass.
//!
//! Its variables are the design, the displacements of every case, and a mode w: displacements of the free directions of nodes, then of the
//! ends of inner pieces. Its rows are ½wᵀKw, ½wᵀGw of every case or combination asked for, and ½wᵀMw. So K, G and M are their Hessians
//! in w, and every derivative of the matrices along the design is exact.

use std::sync::Arc;

use super::super::{Numbering, with_inputs};
use super::directions::{Directions, map_inputs, mode_directions};
use crate::linear_algebra::Pattern;
use crate::linear_algebra::pencil::Matrix;
use crate::model::views::mapped::{Mapped, Maps};
use crate::model::{AssemblyError, EvaluationError, Meta, Model, RibModel, assemble};
use crate::problem::formula::{Energy, Response, Subject, What};
use crate::problem::modes::Pencil;
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use crate::problem::{Constraint, Formula, Problem, Scope};

/// The energies of a structure in a mode.
pub(super) struct Energies {
    model: Mapped<RibModel>,
    /// Design and displacements: the variables before w.
    before: usize,
    /// Cases and combinations, in the order of their rows.
    sets: Vec<u32>,
    /// Springs and masses at nodes: what they add to the diagonals of K and M.
    springs: Diagonal,
    masses: Diagonal,
    /// Where the entries of K, G and M stand, and which of the energies' second derivatives they are.
    pattern: Arc<Pattern>,
    places: Vec<(usize, usize)>,
}

/// Entries on a diagonal.
type Diagonal = Vec<(usize, f64)>;

/// Derivatives of the energies at a mode.
pub(super) struct Derivatives {
    /// Of a weighted sum of the energies by design and displacements, twice: wᵀS_zw.
    pub slope: Vec<f64>,
    /// wᵀS_zz'w, by (z, z') with z' ≤ z.
    pub curvature: Vec<(usize, usize, f64)>,
    /// S_z·w, by z: its entries that are not zero.
    pub mixed: Vec<Vec<(usize, f64)>>,
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
        let sets = buckling_sets(pencils);
        let kinds: Vec<(Energy, u32)> = std::iter::once((Energy::Strain, 0))
            .chain(sets.iter().map(|&set| (Energy::Prestress, set)))
            .chain(pencils.contains(&Pencil::Vibration).then_some((Energy::Inertia, 0)))
            .collect();
        let (inner, row_of) = energies_problem(problem, structure, statics, &kinds);
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
        let (springs, masses) = at_nodes(structure, &directions);
        let (pattern, places) = in_mode(&model.meta().hessian, before);
        Ok(Energies { model, before, sets, springs, masses, pattern, places })
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
    pub fn matrix(&self, z: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Matrix, EvaluationError> {
        let mut values = vec![0.0; self.model.meta().hessian.len()];
        let point = self.point(z, &vec![0.0; self.order()]);
        self.model.hessian(&point, 0.0, &self.weights(pencil, k, b), &mut values)?;
        let mut matrix = Matrix::zeros(Arc::clone(&self.pattern));
        self.places.iter().for_each(|&(from, to)| matrix.values[to] = values[from]);
        self.add(&mut matrix, &self.springs, k);
        if pencil == Pencil::Vibration {
            self.add(&mut matrix, &self.masses, b);
        }
        Ok(matrix)
    }

    fn add(&self, matrix: &mut Matrix, diagonal: &Diagonal, share: f64) {
        for &(at, value) in diagonal {
            // The whole diagonal is in the pattern.
            let place = self.pattern.position(at, at as u32).unwrap_or_default();
            matrix.values[place] += share * value;
        }
    }

    /// wᵀKw and wᵀBw, from the deformations of the pieces: exact to a few roundings, where the matrices' entries are large and their products with w
    /// nearly cancel.
    pub fn energies(&self, z: &[f64], w: &[f64], pencil: Pencil) -> Result<[f64; 2], EvaluationError> {
        let mut rows = vec![0.0; self.model.meta().rows()];
        self.model.constraints(&self.point(z, w), &mut rows)?;
        let of_diagonal = |diagonal: &Diagonal| diagonal.iter().map(|&(at, value)| value * w[at] * w[at]).sum::<f64>();
        let stiffness = 2.0 * rows[0] + of_diagonal(&self.springs);
        let other = 2.0 * rows[self.row(pencil)];
        Ok([stiffness, if pencil == Pencil::Vibration { other + of_diagonal(&self.masses) } else { -other }])
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
                mixed[column].push((row - self.before, value));
            }
        }
        Ok(Derivatives { slope: self.slope(z, w, pencil, k, b)?, curvature, mixed })
    }
}

/// The pattern of second derivatives by the mode, with the whole diagonal, and which of all they are.
fn in_mode(hessian: &Pattern, before: usize) -> (Arc<Pattern>, Vec<(usize, usize)>) {
    let own = || hessian.iter().enumerate().filter(|(_, (_, column))| *column >= before);
    let place = |row: usize, column: usize| ((row - before) as u32, (column - before) as u32);
    let order = hessian.rows() - before;
    let mut positions: Vec<(u32, u32)> = own().map(|(_, (row, column))| place(row, column)).collect();
    positions.extend((0..order as u32).map(|at| (at, at)));
    let pattern = Pattern::from_positions(order, &mut positions);
    let to = |row, column| {
        let (row, column) = place(row, column);
        // Every position was announced above.
        pattern.position(row as usize, column).unwrap_or_default()
    };
    let places = own().map(|(from, (row, column))| (from, to(row, column))).collect();
    (Arc::new(pattern), places)
}

/// The cases and combinations whose axial forces count.
fn buckling_sets(pencils: &[Pencil]) -> Vec<u32> {
    let set = |pencil: &Pencil| if let Pencil::Buckling(set) = pencil { Some(*set) } else { None };
    let mut sets: Vec<u32> = pencils.iter().filter_map(set).collect();
    sets.sort_unstable();
    sets.dedup();
    sets
}

/// One row per piece and kind of energy, and which kind each is.
fn energies_problem(
    problem: &Problem,
    structure: &Structure,
    statics: &Statics,
    kinds: &[(Energy, u32)],
) -> (Problem, Vec<usize>) {
    let mut inner =
        Problem { constraints: Vec::new(), objective: Formula::default(), auxiliaries: Vec::new(), ..problem.clone() };
    with_inputs(&mut inner, structure.load_sets() * statics.inputs as usize + 12 * statics.pieces as usize);
    let most = statics.members.iter().map(|member| member.pieces).max().unwrap_or(0);
    let weighs = |material: u32| structure.materials[material as usize].density.is_some();
    let mut row_of = Vec::new();
    for (row, &(energy, set)) in kinds.iter().enumerate() {
        for piece in 0..most {
            let has =
                structure.members.iter().zip(&statics.members).filter(|(declared, member)| {
                    member.pieces > piece && (energy != Energy::Inertia || weighs(declared.material))
                });
            let ribs: Vec<u32> = has.map(|(member, _)| member.rib).collect();
            row_of.extend(std::iter::repeat_n(row, ribs.len()));
            inner.constraints.push(energy_row(energy, set, piece, ribs));
        }
    }
    (inner, row_of)
}

/// What springs and masses at nodes add to the diagonals of K and M, by direction of a mode.
fn at_nodes(structure: &Structure, directions: &Directions) -> (Diagonal, Diagonal) {
    let at_node = |node: u32, direction: usize| directions.of_node(node, direction);
    let springs = structure.supports.iter().flat_map(|support| {
        (0..6).filter_map(move |direction| Some((at_node(support.node, direction)?, support.springs[direction])))
    });
    let masses = structure.masses.iter();
    let masses = masses.flat_map(|&(node, mass)| (0..3).filter_map(move |axis| Some((at_node(node, axis)?, mass))));
    (springs.filter(|(_, stiffness)| *stiffness != 0.0).collect(), masses.collect())
}

fn energy_row(energy: Energy, set: u32, piece: u32, ribs: Vec<u32>) -> Constraint {
    let left = Formula::Response(Arc::new(Response { set, subject: Subject::Own, what: What::Modal(energy, piece) }));
    Constraint::unlimited("energy", Scope::Ribs(ribs), left)
}
