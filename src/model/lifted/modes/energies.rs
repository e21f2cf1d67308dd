//! The matrices of buckling and vibration as second derivatives of energies: of strain, of axial forces on inclined axes, of mass.
//!
//! The variables of each are the design, the displacements of every case, and a mode w: displacements of the free directions of nodes, then of
//! the ends of inner pieces. They are ½wᵀKw, ½wᵀGw of every case or combination asked for, and ½wᵀMw. So K, G and M are their Hessians
//! in w, and every derivative of the matrices along the design is exact.

use std::sync::Arc;

use super::super::{Numbering, with_inputs};
use super::directions::{Directions, map_inputs, mode_directions};
use super::smooth::Curvature;
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
    /// Of strain, of the axial forces of every case and combination in `sets`, and of mass where that is asked for.
    kinds: Vec<OneKind>,
    /// Design and displacements: the variables before w.
    before: usize,
    /// Cases and combinations, in the order of their energies.
    sets: Vec<u32>,
    /// Springs and masses at nodes: what they add to the diagonals of K and M.
    springs: Diagonal,
    masses: Diagonal,
    /// Where the entries of K, G and M stand.
    pattern: Arc<Pattern>,
}

/// One of the energies, as the one row of a model.
struct OneKind {
    model: Mapped<RibModel>,
    /// Which of its second derivatives are entries of the matrices, and which.
    places: Vec<(usize, usize)>,
}

/// Entries on a diagonal.
type Diagonal = Vec<(usize, f64)>;

/// Derivatives of the energies at a mode.
pub(super) struct Derivatives {
    /// wᵀS_zw, by design and displacements.
    pub slope: Vec<f64>,
    /// wᵀS_zz'w, by (z, z') with z' ≤ z; repeats add up.
    pub curvature: Curvature,
    /// S_z·w, by z: its entries that are not zero; repeats add up.
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
        let directions = mode_directions(structure, statics, numbering);
        let before = numbering.states.first_variable + numbering.states.block * numbering.states.blocks;
        let model = |&kind: &(Energy, u32)| {
            let inner = assemble(&Arc::new(energy_problem(problem, structure, statics, kind)))?;
            let mut maps = Maps::default();
            map_inputs(structure, statics, numbering, &sets, &directions, before, &mut maps);
            maps.outputs.push((0..inner.meta().rows()).map(|at| (at as u32, 1.0)).collect::<Vec<_>>());
            maps.linear.push([]);
            Ok(Mapped::new(inner, maps, one_row(before + directions.count)))
        };
        let models: Vec<Mapped<RibModel>> = kinds.iter().map(model).collect::<Result<_, AssemblyError>>()?;
        let pattern = Arc::new(in_mode(&models, before, directions.count));
        let placed = |model: Mapped<RibModel>| OneKind { places: places(&model.meta().hessian, &pattern, before), model };
        let kinds = models.into_iter().map(placed).collect();
        let (springs, masses) = at_nodes(structure, &directions);
        Ok(Energies { kinds, before, sets, springs, masses, pattern })
    }

    /// Number of displacements in a mode.
    pub fn order(&self) -> usize {
        self.pattern.rows()
    }

    /// The variables among design and displacements that a pencil depends on.
    pub fn columns(&self, pencil: Pencil) -> Vec<u32> {
        let parts = self.parts(pencil, 1.0, 1.0);
        let of_parts = parts.flat_map(|(kind, _)| kind.model.meta().jacobian.columns.iter().copied());
        let mut columns: Vec<u32> = of_parts.filter(|&j| (j as usize) < self.before).collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// What k·K + b·B is made of, and each one's share.
    fn parts(&self, pencil: Pencil, k: f64, b: f64) -> impl Iterator<Item = (&OneKind, f64)> {
        let (at, share) = match pencil {
            Pencil::Buckling(set) => (1 + self.sets.iter().position(|known| *known == set).unwrap_or(0), -b),
            Pencil::Vibration => (1 + self.sets.len(), b),
        };
        [(&self.kinds[0], k), (&self.kinds[at], share)].into_iter().filter(|(_, share)| *share != 0.0)
    }

    fn point(&self, z: &[f64], w: &[f64]) -> Vec<f64> {
        z[..self.before].iter().chain(w).copied().collect()
    }

    /// k·K + b·B.
    pub fn matrix(&self, z: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Matrix, EvaluationError> {
        let point = self.point(z, &vec![0.0; self.order()]);
        let mut matrix = Matrix::zeros(Arc::clone(&self.pattern));
        for (kind, share) in self.parts(pencil, k, b) {
            let mut values = vec![0.0; kind.model.meta().hessian.len()];
            kind.model.hessian(&point, 0.0, &[share], &mut values)?;
            kind.places.iter().for_each(|&(from, to)| matrix.values[to] += values[from]);
        }
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
        let point = self.point(z, w);
        let mut both = [0.0; 2];
        for (energy, (kind, sign)) in both.iter_mut().zip(self.parts(pencil, 1.0, 1.0)) {
            let mut row = [0.0];
            kind.model.constraints(&point, &mut row)?;
            *energy = 2.0 * sign * row[0];
        }
        let of_diagonal = |diagonal: &Diagonal| diagonal.iter().map(|&(at, value)| value * w[at] * w[at]).sum::<f64>();
        both[0] += of_diagonal(&self.springs);
        if pencil == Pencil::Vibration {
            both[1] += of_diagonal(&self.masses);
        }
        Ok(both)
    }

    /// S·w of S = k·K + b·B, from the forces of the pieces: as exact as [`Energies::energies`].
    pub fn times(&self, z: &[f64], w: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Vec<f64>, EvaluationError> {
        let mut whole = self.gradient(z, w, pencil, k, b)?;
        let mut product = whole.split_off(self.before);
        self.springs.iter().for_each(|&(at, value)| product[at] += k * value * w[at]);
        if pencil == Pencil::Vibration {
            self.masses.iter().for_each(|&(at, value)| product[at] += b * value * w[at]);
        }
        Ok(product)
    }

    /// wᵀS_zw of S = k·K + b·B, by design and displacements.
    pub fn slope(&self, z: &[f64], w: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Vec<f64>, EvaluationError> {
        let mut whole = self.gradient(z, w, pencil, k, b)?;
        whole.truncate(self.before);
        whole.iter_mut().for_each(|value| *value *= 2.0);
        Ok(whole)
    }

    /// That of the pieces' ½·wᵀSw, by design, displacements and w.
    fn gradient(&self, z: &[f64], w: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Vec<f64>, EvaluationError> {
        let point = self.point(z, w);
        let mut whole = vec![0.0; point.len()];
        for (kind, share) in self.parts(pencil, k, b) {
            let pattern = &kind.model.meta().jacobian;
            let mut values = vec![0.0; pattern.len()];
            kind.model.jacobian(&point, &mut values)?;
            pattern.add_transposed(&values, &[share], &mut whole);
        }
        Ok(whole)
    }

    /// What S = k·K + b·B changes by, along design and displacements, seen by w.
    pub fn derivatives(&self, z: &[f64], w: &[f64], pencil: Pencil, k: f64, b: f64) -> Result<Derivatives, EvaluationError> {
        let point = self.point(z, w);
        let (mut curvature, mut mixed) = (Vec::new(), vec![Vec::new(); self.before]);
        for (kind, share) in self.parts(pencil, k, b) {
            let pattern = &kind.model.meta().hessian;
            let mut values = vec![0.0; pattern.len()];
            kind.model.hessian(&point, 0.0, &[share], &mut values)?;
            for ((row, column), value) in pattern.iter().zip(values).filter(|(_, value)| *value != 0.0) {
                if row < self.before {
                    curvature.push((row, column, 2.0 * value));
                } else if column < self.before {
                    mixed[column].push((row - self.before, value));
                }
            }
        }
        Ok(Derivatives { slope: self.slope(z, w, pencil, k, b)?, curvature, mixed })
    }
}

fn one_row(variables: usize) -> Meta {
    Meta {
        lower: vec![f64::NEG_INFINITY; variables],
        upper: vec![f64::INFINITY; variables],
        start: vec![0.0; variables],
        row_lower: vec![f64::NEG_INFINITY],
        row_upper: vec![f64::INFINITY],
        ..Meta::default()
    }
}

/// The pattern of all second derivatives by the mode, with the whole diagonal.
fn in_mode(models: &[Mapped<RibModel>], before: usize, order: usize) -> Pattern {
    let own = models.iter().flat_map(|model| model.meta().hessian.iter());
    let own = own.filter(|(_, column)| *column >= before);
    let mut positions: Vec<(u32, u32)> = own.map(|(row, column)| ((row - before) as u32, (column - before) as u32)).collect();
    positions.extend((0..order as u32).map(|at| (at, at)));
    Pattern::from_positions(order, &mut positions)
}

/// Which second derivatives are entries of this pattern, and which.
fn places(hessian: &Pattern, pattern: &Pattern, before: usize) -> Vec<(usize, usize)> {
    // Every position looked up was announced above.
    let to = |row: usize, column: usize| pattern.position(row - before, (column - before) as u32).unwrap_or_default();
    let own = hessian.iter().enumerate().filter(|(_, (_, column))| *column >= before);
    own.map(|(from, (row, column))| (from, to(row, column))).collect()
}

/// The cases and combinations whose axial forces count.
fn buckling_sets(pencils: &[Pencil]) -> Vec<u32> {
    let set = |pencil: &Pencil| if let Pencil::Buckling(set) = pencil { Some(*set) } else { None };
    let mut sets: Vec<u32> = pencils.iter().filter_map(set).collect();
    sets.sort_unstable();
    sets.dedup();
    sets
}

/// One row per piece.
fn energy_problem(problem: &Problem, structure: &Structure, statics: &Statics, (energy, set): (Energy, u32)) -> Problem {
    let mut inner =
        Problem { constraints: Vec::new(), objective: Formula::default(), auxiliaries: Vec::new(), ..problem.clone() };
    with_inputs(&mut inner, structure.load_sets() * statics.inputs as usize + 12 * statics.pieces as usize);
    let most = statics.members.iter().map(|member| member.pieces).max().unwrap_or(0);
    let weighs = |material: u32| structure.materials[material as usize].density.is_some();
    for piece in 0..most {
        let has = structure
            .members
            .iter()
            .zip(&statics.members)
            .filter(|(declared, member)| member.pieces > piece && (energy != Energy::Inertia || weighs(declared.material)));
        inner.constraints.push(energy_row(energy, set, piece, has.map(|(member, _)| member.rib).collect()));
    }
    inner
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
