//! A formula as a flat program over a few inputs: value, exact gradient, exact sparse Hessian, without allocation per call.
//!
//! Gradients by reverse accumulation. Hessians by edge pushing (R. M. Gower and M. P. Mello, *A new framework for the
//! computation of Hessians*, 2012), whose steps are worked out once, when the tape is made: an evaluation only runs a list of
//! multiply-adds, and zeros that are zeros by structure are never touched.

mod explain;
mod partials;
mod program;
#[cfg(test)]
mod random_tests;
mod schedule;
mod sweep;
#[cfg(test)]
mod tests;

use thiserror::Error;

use super::graph::{Graph, NodeId};
pub use explain::Invalid;
pub use program::{Binding, Literals, Program, Source};
use schedule::Schedule;

/// A program with everything its derivatives need. Terms of one shape share one tape; see [`Program::extract`].
#[derive(Debug, Clone)]
pub struct Tape {
    program: Program,
    schedule: Schedule,
}

/// Scratch memory for evaluations, grown when a tape needs more. One per thread; any tape may use any workspace.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    values: Vec<f64>,
    adjoints: Vec<f64>,
    weights: Vec<f64>,
    live: Vec<bool>,
}

/// Why no tape was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum TapeError {
    /// The second derivatives couple too many inputs with one another.
    #[error(
        "one term couples {inputs} inputs so densely that its second derivatives do not fit; split it into a sum of smaller terms"
    )]
    TooDense {
        /// Inputs of the term.
        inputs: usize,
    },
}

impl Tape {
    /// The tape of a node, numbers kept in it, and what its inputs and data are in the graph.
    ///
    /// # Errors
    /// [`TapeError::TooDense`] where second derivatives would fill the memory (thousands of inputs, all coupled).
    ///
    /// ```
    /// use ribopt::expression::{graph::Graph, tape::{Tape, Workspace}};
    /// let mut graph = Graph::new();
    /// let (x, y) = (graph.input(3), graph.input(7));
    /// let product = graph.multiply(x, y);
    /// let (tape, binding) = Tape::compile(&graph, product)?;
    /// assert_eq!((binding.inputs.as_slice(), tape.hessian_pattern()), ([3, 7].as_slice(), [(1, 0)].as_slice()));
    /// let mut gradient = [0.0; 2];
    /// assert_eq!(tape.gradient(&[2.0, 5.0], &[], &mut Workspace::default(), &mut gradient), 10.0);
    /// assert_eq!(gradient, [5.0, 2.0]);
    /// # Ok::<(), ribopt::expression::tape::TapeError>(())
    /// ```
    pub fn compile(graph: &Graph, root: NodeId) -> Result<(Tape, Binding), TapeError> {
        let (program, binding) = Program::extract(graph, root, Literals::Kept);
        Ok((Tape::new(program)?, binding))
    }

    /// The tape of an extracted program.
    ///
    /// # Errors
    /// As [`Tape::compile`].
    pub fn new(program: Program) -> Result<Tape, TapeError> {
        let schedule = Schedule::new(&program)?;
        Ok(Tape { program, schedule })
    }

    /// The program, by which equal shapes are told.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Number of inputs: the length of `x` and of a gradient.
    pub fn inputs(&self) -> usize {
        self.program.inputs()
    }

    /// Number of data: the length of `d`.
    pub fn data(&self) -> usize {
        self.program.data()
    }

    /// Where the Hessian can be non-zero: (row, column) with column ≤ row, ascending.
    pub fn hessian_pattern(&self) -> &[(u32, u32)] {
        self.schedule.pattern()
    }

    /// The value. NaN or an infinity outside the domain; [`Tape::explain`] says why.
    ///
    /// # Panics
    /// As every evaluation: where a slice has not the length the tape states.
    pub fn value(&self, x: &[f64], d: &[f64], workspace: &mut Workspace) -> f64 {
        workspace.fit(self);
        sweep::forward(self, x, d, &mut workspace.values)
    }

    /// The value; `g` is overwritten by the gradient. At a kink of `abs`, `min`, `max`: the derivative of one branch
    /// (of `abs` the positive one). An infinite derivative comes out as an infinity or NaN.
    pub fn gradient(&self, x: &[f64], d: &[f64], workspace: &mut Workspace, g: &mut [f64]) -> f64 {
        let value = self.value(x, d, workspace);
        sweep::gradient::<false>(self, workspace);
        g.copy_from_slice(&workspace.adjoints[..self.inputs()]);
        if value.is_finite() && !all_finite(g) {
            sweep::mark_live(self, workspace);
            sweep::gradient::<true>(self, workspace);
            g.copy_from_slice(&workspace.adjoints[..self.inputs()]);
        }
        value
    }

    /// The value; `h` is overwritten by the second derivatives along [`Tape::hessian_pattern`].
    pub fn hessian(&self, x: &[f64], d: &[f64], workspace: &mut Workspace, h: &mut [f64]) -> f64 {
        let value = self.value(x, d, workspace);
        sweep::hessian::<false>(self, workspace);
        h.copy_from_slice(&workspace.weights[..self.hessian_pattern().len()]);
        if value.is_finite() && !all_finite(h) {
            sweep::mark_live(self, workspace);
            sweep::hessian::<true>(self, workspace);
            h.copy_from_slice(&workspace.weights[..self.hessian_pattern().len()]);
        }
        value
    }
}

impl Workspace {
    fn fit(&mut self, tape: &Tape) {
        let slots = tape.program.slots();
        if self.values.len() < slots {
            self.values.resize(slots, 0.0);
            self.adjoints.resize(slots, 0.0);
            self.live.resize(slots, false);
        }
        if self.weights.len() < tape.schedule.weights() {
            self.weights.resize(tape.schedule.weights(), 0.0);
        }
    }
}

fn all_finite(values: &[f64]) -> bool {
    values.iter().all(|value| value.is_finite())
}
