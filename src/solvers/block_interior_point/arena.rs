//! The iterates of all components, one after another in one block of memory.

use crate::model::Meta;
use crate::model::components::Partition;

/// Where a component stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// Not begun.
    New,
    /// Under way.
    Running,
    /// Too much for the small solver: the sparse interior point takes it.
    Hard,
    /// At a minimum of its own.
    Solved,
    /// The sparse interior point did not reach one either.
    Failed,
}

/// One component's numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Header {
    pub phase: Phase,
    /// Barrier parameter.
    pub mu: f64,
    /// Weight of the violation in the merit function.
    pub penalty: f64,
    /// The regularisation last needed.
    pub regularisation: f64,
    /// Whether the objective is taken by its logarithm.
    pub logarithmic: bool,
    /// What the objective, or its logarithm, is multiplied by.
    pub objective_scale: f64,
    /// f_k(x), unscaled.
    pub objective: f64,
    /// Largest absolute, and largest relative violation of its rows.
    pub violation: f64,
    pub relative_violation: f64,
    /// Scaled optimality error.
    pub error: f64,
    /// Squared norm of the last step.
    pub step: f64,
    pub iterations: u32,
    /// Points evaluated since the last iteration.
    pub evaluations: u32,
    /// The barrier parameter at which the active set was last tried.
    pub tried: f64,
}

impl Header {
    /// A value of the objective, scaled, and what its derivatives are multiplied by.
    pub fn scaled(&self, objective: f64) -> (f64, f64) {
        if self.logarithmic {
            (self.objective_scale * objective.ln(), self.objective_scale / objective)
        } else {
            (self.objective_scale * objective, self.objective_scale)
        }
    }
}

/// One component's iterate, scaled: n variables, then m slacks, with bounds' multipliers, and the rows' own.
pub(super) struct ComponentIterate<'a> {
    pub component: usize,
    pub header: &'a mut Header,
    /// Length n + m.
    pub w: &'a mut [f64],
    pub z_lower: &'a mut [f64],
    pub z_upper: &'a mut [f64],
    /// Length m.
    pub y: &'a mut [f64],
    pub row_scale: &'a mut [f64],
}

/// All components.
pub(super) struct Arena {
    headers: Vec<Header>,
    values: Vec<f64>,
}

fn sizes(partition: &Partition, k: usize) -> (usize, usize) {
    (partition.variables(k).len() + partition.rows(k).len(), partition.rows(k).len())
}

impl Arena {
    /// Nothing begun; components of more than `largest` variables or rows, or with equalities, are hard from the outset.
    pub fn new(partition: &Partition, meta: &Meta, largest: usize) -> Arena {
        let header = |k: usize| {
            let equality = |&i: &u32| meta.row_lower[i as usize] == meta.row_upper[i as usize];
            let (variables, rows) = (partition.variables(k), partition.rows(k));
            let hard = variables.len().max(rows.len()) > largest || rows.iter().any(equality);
            let phase = if hard { Phase::Hard } else { Phase::New };
            Header {
                phase,
                mu: 0.0,
                penalty: 0.0,
                regularisation: 0.0,
                logarithmic: false,
                objective_scale: 1.0,
                objective: 0.0,
                violation: 0.0,
                relative_violation: 0.0,
                error: f64::INFINITY,
                step: 0.0,
                iterations: 0,
                evaluations: 0,
                tried: f64::INFINITY,
            }
        };
        let length = |k: usize| {
            let (size, m) = sizes(partition, k);
            3 * size + 2 * m
        };
        let total = (0..partition.len()).map(length).sum();
        Arena { headers: (0..partition.len()).map(header).collect(), values: vec![0.0; total] }
    }

    /// What is known of the components.
    pub fn headers(&self) -> &[Header] {
        &self.headers
    }

    /// The components in one of the wanted phases, in order.
    pub fn iterates(&mut self, partition: &Partition, wanted: impl Fn(Phase) -> bool) -> Vec<ComponentIterate<'_>> {
        let mut iterates = Vec::new();
        let mut rest = self.values.as_mut_slice();
        for (component, header) in self.headers.iter_mut().enumerate() {
            let (size, m) = sizes(partition, component);
            let (w, after) = rest.split_at_mut(size);
            let (z_lower, after) = after.split_at_mut(size);
            let (z_upper, after) = after.split_at_mut(size);
            let (y, after) = after.split_at_mut(m);
            let (row_scale, after) = after.split_at_mut(m);
            rest = after;
            if wanted(header.phase) {
                iterates.push(ComponentIterate { component, header, w, z_lower, z_upper, y, row_scale });
            }
        }
        iterates
    }
}
