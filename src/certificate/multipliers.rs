//! Multipliers of the right sign that make the Lagrangian as stationary as the point allows.

use rayon::prelude::*;

use super::candidates::{self, Candidate, Owner};
use super::point::Point;
use crate::certificate::parameters::multipliers::ROUNDINGS;
use crate::linear_algebra::signed_least_squares::{self, Column, NormalEquations};
use crate::model::components::Partition;

/// Groups of rows a thread takes at a time, at the least.
const BATCH: usize = 64;
/// From this many groups on it pays to leave out what bounds take up.
const MANY: usize = 1000;

/// Row multipliers y and bound multipliers z, in the user's units.
pub(super) struct Multipliers {
    pub(super) rows: Vec<f64>,
    pub(super) bounds: Vec<f64>,
}

/// Which limits a solver's multipliers are taken from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Taken {
    /// Those whose multiplier outweighs the distance, both relative: the active ones by strict complementarity. What a barrier leaves on all
    /// others is none of a minimum's.
    Active,
    /// All within reach.
    Near,
}

impl Taken {
    fn takes(self, candidate: &Candidate, multiplier: f64, unit: f64) -> bool {
        candidate.carries(multiplier)
            && (self == Taken::Near || candidate.sign == 0.0 || multiplier.abs() * unit >= candidate.distance)
    }
}

/// What a solver's row multipliers say at the point: those of limits taken and of the right sign are taken as they are,
/// bounds take up what is left. Evidence only in so far as the sums that prove stationarity are then computed anew.
pub(super) fn from_witness(point: &Point<'_>, witness: &[f64], taken: Taken) -> Option<Multipliers> {
    if witness.len() != point.rows.len() || !witness.iter().all(|y| y.is_finite()) {
        return None;
    }
    let usable = |i: usize| {
        let (y, unit) = (witness[i], point.slopes[i] / point.scale());
        let is_usable = y != 0.0 && unit > 0.0 && candidates::row(point, i).any(|candidate| taken.takes(&candidate, y, unit));
        if is_usable { y } else { 0.0 }
    };
    let rows: Vec<f64> = (0..witness.len()).map(usable).collect();
    let mut bounds = bound_multipliers(point, &point.row_gradient(&rows));
    for (j, z) in bounds.iter_mut().enumerate().filter(|(_, z)| **z != 0.0) {
        let unit = point.sizes[j] / point.scale();
        if !candidates::bounds(point, j).any(|candidate| taken.takes(&candidate, *z, unit)) {
            *z = 0.0;
        }
    }
    Some(Multipliers { rows, bounds })
}

/// The same multipliers, moved as little as makes the Lagrangian stationary to the last digits, no sign changed: least squares
/// over those that are not zero. `None` where there is no solution.
pub(super) fn refined(point: &Point<'_>, multipliers: &Multipliers) -> Option<Multipliers> {
    let mut system = System::default();
    let mut centre = Vec::new();
    let scale = point.scale();
    for (i, &y) in multipliers.rows.iter().enumerate().filter(|(_, y)| **y != 0.0) {
        let candidate = candidates::row(point, i).find(|candidate| candidate.carries(y))?;
        let entries = point.row_in_sizes(i).map(|(j, entry)| (j as u32, entry));
        system.push(candidate, entries.filter(|entry| entry.1 != 0.0));
        centre.push(y * point.slopes[i] / scale);
    }
    for (j, &z) in multipliers.bounds.iter().enumerate().filter(|(_, z)| **z != 0.0) {
        let candidate = candidates::bounds(point, j).find(|candidate| candidate.carries(z))?;
        system.push(candidate, std::iter::once((j as u32, 1.0)));
        centre.push(z * point.sizes[j] / scale);
    }
    let gradient: Vec<f64> = point.gradient.iter().zip(&point.sizes).map(|(g, d)| g * d / scale).collect();
    // What is none may come out of either sign: rounding of the largest.
    let found = signed_least_squares::nearest(&gradient, &system.columns(), &centre, ROUNDINGS).ok()?;
    let mut rows = vec![0.0; multipliers.rows.len()];
    for (candidate, value) in system.candidates.iter().zip(found) {
        if let Owner::Row(i) = candidate.owner {
            rows[i] = value * scale / point.slopes[i];
        }
    }
    let bounds = bound_multipliers(point, &point.row_gradient(&rows));
    Some(Multipliers { rows, bounds })
}

/// Minimises ‖D(∇f + Jᵀy + z)/σ‖² plus the squared complementarity terms. A `guess` only says which limits to try first.
///
/// Rows that share no variable with others are solved for by themselves, side by side: the work grows with their number alone.
pub(super) fn find(point: &Point<'_>, guess: Option<&[f64]>) -> Multipliers {
    let meta = point.meta();
    let mut rows = vec![0.0; meta.rows()];
    let near = if point.sigma > 0.0 { candidates::near_rows(point) } else { Vec::new() };
    let patterns = near.iter().map(|&i| meta.jacobian.row(i));
    // Rows with a slope have variables, so there always is a partition.
    if let Some(partition) = Partition::new(meta.variables(), patterns, std::iter::empty()) {
        let many = partition.len() >= MANY;
        let solved: Vec<Vec<(usize, f64)>> = (0..partition.len())
            .into_par_iter()
            .with_min_len(BATCH)
            .filter(|&group| !partition.rows(group).is_empty())
            .map_init(Room::default, |room, group| {
                Group { point, guess, partition: &partition, group, near: &near }.row_multipliers(many, room)
            })
            .collect();
        for (i, y) in solved.into_iter().flatten() {
            rows[i] += y;
        }
    }
    let bounds = bound_multipliers(point, &point.row_gradient(&rows));
    Multipliers { rows, bounds }
}

/// The best z for a given ∇f + Jᵀy, variable by variable: −q/(1 + t²) where a bound of the right side is near.
fn bound_multipliers(point: &Point<'_>, rest: &[f64]) -> Vec<f64> {
    let one = |j: usize| {
        let wanted = -rest[j];
        let fits = |c: &Candidate| c.sign * wanted > 0.0 || (c.sign == 0.0 && wanted != 0.0);
        candidates::bounds(point, j)
            .find(fits)
            .map_or(0.0, |c| if c.sign == 0.0 { wanted } else { wanted / (1.0 + c.distance * c.distance) })
    };
    (0..rest.len()).map(one).collect()
}

/// Rows within reach that share variables.
struct Group<'a> {
    point: &'a Point<'a>,
    guess: Option<&'a [f64]>,
    partition: &'a Partition,
    group: usize,
    /// All rows within reach.
    near: &'a [usize],
}

/// The least-squares problem of a group.
#[derive(Default)]
struct System {
    candidates: Vec<Candidate>,
    gradient: Vec<f64>,
    /// The candidates' columns one after the other, where each ends, and whether it starts out as free to move.
    entries: Vec<(u32, f64)>,
    columns: Vec<(usize, bool)>,
    /// Bounds left out.
    absorbing: Vec<Candidate>,
    /// Where each variable of the group stands in the gradient.
    places: Vec<u32>,
}

/// A thread's room.
#[derive(Default)]
struct Room {
    system: System,
    equations: NormalEquations,
}

impl System {
    fn clear(&mut self) {
        self.candidates.clear();
        self.gradient.clear();
        self.entries.clear();
        self.columns.clear();
        self.absorbing.clear();
        self.places.clear();
    }

    /// Adds a candidate with its column.
    fn push(&mut self, candidate: Candidate, entries: impl Iterator<Item = (u32, f64)>) {
        self.candidates.push(candidate);
        self.entries.extend(entries);
        self.columns.push((self.entries.len(), true));
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let mut first = 0;
        let column = |(candidate, &(last, basic)): (&Candidate, &(usize, bool))| {
            let entries = &self.entries[std::mem::replace(&mut first, last)..last];
            let weight = if candidate.sign == 0.0 { 0.0 } else { candidate.distance };
            Column { entries, sign: candidate.sign, weight, basic }
        };
        self.candidates.iter().zip(&self.columns).map(column).collect()
    }
}

/// The place of a variable that is left out.
const OUT: u32 = u32::MAX;

impl Group<'_> {
    /// Row by row what its multiplier gains. `many`: the groups are many and small.
    fn row_multipliers(&self, many: bool, room: &mut Room) -> Vec<(usize, f64)> {
        if many {
            self.fill(&mut room.system, true);
            let found = self.solved(many, room);
            if room.system.absorbing.is_empty() || self.bounds_push_back(&room.system, &found) {
                return found;
            }
        }
        self.fill(&mut room.system, false);
        self.solved(many, room)
    }

    /// The group's rows, and the bounds of the variables they touch; other variables need no solving. A variable exactly on
    /// its one bound can be left out with it: that bound's multiplier takes up whatever slope is left, if its sign is right.
    fn fill(&self, system: &mut System, absorb: bool) {
        system.clear();
        let point = self.point;
        system.candidates.extend(self.rows().flat_map(|i| candidates::row(point, i)));
        for &j in self.partition.variables(self.group) {
            let j = j as usize;
            let mut bounds = candidates::bounds(point, j);
            let (first, second) = (bounds.next(), bounds.next());
            match first {
                Some(bound) if absorb && second.is_none() && bound.distance == 0.0 => {
                    system.absorbing.push(bound);
                    system.places.push(OUT);
                    continue;
                }
                _ => system.candidates.extend(first.into_iter().chain(second)),
            }
            system.places.push(system.gradient.len() as u32);
            system.gradient.push(self.slope(j));
        }
        let System { candidates, entries, columns, places, .. } = system;
        for candidate in candidates {
            let basic = self.add_column(candidate, places, entries);
            columns.push((entries.len(), basic));
        }
    }

    fn rows(&self) -> impl Iterator<Item = usize> {
        self.partition.rows(self.group).iter().map(|&k| self.near[k as usize])
    }

    /// ∂f/∂x_j, scaled.
    fn slope(&self, j: usize) -> f64 {
        self.point.gradient[j] * self.point.sizes[j] / self.point.sigma
    }

    /// Adds a candidate's column; whether it starts out as free to move.
    fn add_column(&self, candidate: &Candidate, places: &[u32], entries: &mut Vec<(u32, f64)>) -> bool {
        let place = |j: usize| places[self.partition.place(j as u32) as usize];
        match candidate.owner {
            Owner::Bound(j) => {
                entries.push((place(j), 1.0));
                true
            }
            Owner::Row(i) => {
                let own = self.point.row_in_sizes(i).map(|(j, entry)| (place(j), entry));
                entries.extend(own.filter(|&(at, entry)| at != OUT && entry != 0.0));
                self.guess.and_then(|guess| guess.get(i)).is_none_or(|y| y * candidate.sign > 0.0)
            }
        }
    }

    fn solved(&self, many: bool, Room { system, equations }: &mut Room) -> Vec<(usize, f64)> {
        let columns = system.columns();
        if columns.is_empty() {
            return Vec::new();
        }
        let until = self.point.origin.until;
        let solved = match many {
            true => signed_least_squares::solve_one_of_many(&system.gradient, &columns, equations, until),
            false => signed_least_squares::solve(&system.gradient, &columns, until),
        };
        let scaled = solved.unwrap_or_default();
        let gain = |(candidate, value): (&Candidate, f64)| match candidate.owner {
            Owner::Row(i) => Some((i, value * self.point.sigma / self.point.slopes[i])),
            Owner::Bound(_) => None,
        };
        system.candidates.iter().zip(scaled).filter_map(gain).collect()
    }

    /// Whether every bound left out gets a multiplier of its sign.
    fn bounds_push_back(&self, system: &System, found: &[(usize, f64)]) -> bool {
        let variables = self.partition.variables(self.group);
        let mut rest: Vec<f64> = variables.iter().map(|&j| self.slope(j as usize)).collect();
        for &(i, y) in found {
            let y = y * self.point.slopes[i] / self.point.sigma;
            self.point.row_in_sizes(i).for_each(|(j, entry)| rest[self.partition.place(j as u32) as usize] += y * entry);
        }
        system.absorbing.iter().all(|bound| match bound.owner {
            Owner::Bound(j) => -rest[self.partition.place(j as u32) as usize] * bound.sign >= 0.0,
            Owner::Row(_) => true,
        })
    }
}
