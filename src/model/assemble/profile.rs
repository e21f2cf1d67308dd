//! Profiles whose parameter follows from the item's data.

use super::expression_graph::{Context, Lowering};
use crate::expression::graph::NodeId;
use crate::problem::Formula;
use crate::problem::evaluate::Evaluation;

impl Lowering<'_> {
    /// A profile at the item's own parameter: a sum over few control variables.
    pub(super) fn profile(&mut self, profile: u32, at: &Formula, context: Context) -> NodeId {
        let s = Evaluation::constants(self.problem).value(at, context.item);
        // The reader only lets through parameters between 0 and 1.
        match s.and_then(|s| self.problem.profiles.get(profile as usize)?.at(s)) {
            Some(sum) => self.formula(&sum, context),
            None => self.graph.constant(f64::NAN),
        }
    }
}
