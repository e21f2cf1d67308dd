//! What an infeasible problem is told: the conflict, and the single moves that end it.

use super::super::Conflict;
use super::filter::{self, Core, Member};
use super::relaxed::{NOISE, Relaxed};
use super::{Elasticity, Proof, Work, moves};

impl<'a> Work<'a> {
    /// The violated rows, a small set that conflicts, and single moves that are enough; or the feasible point the search for
    /// these came upon.
    pub(super) fn infeasible(&self, best: &Relaxed, proof: Proof) -> Elasticity {
        let x = self.outward(&best.x);
        self.refill();
        let Core { members, complete } = filter::filter(self, best);
        self.refill();
        let (alternatives, feasible) = moves::enough(self, best, &members, proof.is_global());
        if let Some(x) = feasible {
            return Elasticity::Feasible(x);
        }
        // Rows beyond the user's own belong to the substitution.
        let own = self.session.task.model.meta().rows();
        let rows = members.iter().filter_map(|member| member.row()).filter(|&row| row < own).collect();
        let bounds = members.iter().filter_map(|member| member.bound()).collect();
        let minimal = complete && self.is_global();
        let conflict = Conflict { violated_rows: self.violations(&x), rows, bounds, alternatives, minimal };
        Elasticity::Infeasible { x, conflict, proof }
    }

    /// Violation in all below which a set of rows counts as compatible.
    pub(super) fn least(&self) -> f64 {
        self.session.tolerances.constraint
    }

    /// Bounds that push against the violation at an elastic minimum: (variable, upper side).
    pub(super) fn bounds(&self, relaxed: &Relaxed) -> Vec<(usize, bool)> {
        let certificate = &relaxed.certificate;
        let weight = |j: usize| certificate.bound_multipliers[j] * certificate.variable_scales[j];
        (0..relaxed.x.len()).filter(|&j| weight(j).abs() > NOISE * certificate.sigma).map(|j| (j, weight(j) > 0.0)).collect()
    }

    /// Members of the conflict at an elastic minimum: rows and bounds with multipliers.
    pub(super) fn members(&self, relaxed: &Relaxed) -> Vec<Member> {
        let rows = relaxed.carriers.iter().map(|&(row, _)| Member::Row(row));
        rows.chain(self.bounds(relaxed).into_iter().map(|(j, upper)| Member::Bound(j, upper))).collect()
    }

    /// Rows of the user's model not met at x, with the amount their limit would have to move.
    pub(super) fn violations(&self, x: &[f64]) -> Vec<(usize, f64)> {
        let Ok(judged) = self.session.judge.certify(x, None) else { return Vec::new() };
        let meta = self.session.task.model.meta();
        let amount = |i: usize| {
            let value = judged.row_values[i];
            if value > meta.row_upper[i] { value - meta.row_upper[i] } else { (value - meta.row_lower[i]).min(0.0) }
        };
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        if self.session.task.model.jacobian(x, &mut jacobian).is_err() {
            return Vec::new();
        }
        let slope = |at: usize| (jacobian[at] * judged.variable_scales[meta.jacobian.columns[at] as usize]).abs();
        let scale =
            |i: usize| meta.jacobian.range(i).map(slope).fold(meta.row_upper[i].abs().min(meta.row_lower[i].abs()), f64::max);
        let slack = |i: usize| 1e-9 * scale(i);
        (0..meta.rows()).map(|i| (i, amount(i))).filter(|&(i, amount)| amount.abs() > slack(i)).collect()
    }
}
