//! A formula compiled once for all items of one shape: constant, affine terms, and terms with a kernel.

use super::kernel_groups::{Groups, Kernels};
use crate::expression::degree::Degrees;
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::tape::{Literals, Program, Source, Tape, TapeError, Workspace};
use crate::expression::terms;
use crate::model::affine::Affine;
use crate::model::elements::Label;

/// The additive terms of a formula over local slots.
pub(super) struct Template {
    constant: Coefficient,
    /// coefficient · input slot
    linear: Vec<(u32, Coefficient)>,
    terms: Vec<Term>,
}

/// coefficient · kernel(inputs; data)
struct Term {
    coefficient: Coefficient,
    kernel: usize,
    inputs: Vec<u32>,
    data: Vec<Source>,
}

/// A number, or one that follows from the item's data.
enum Coefficient {
    Number(f64),
    Computed { tape: Box<Tape>, data: Vec<Source> },
}

impl Coefficient {
    fn compile(graph: &Graph, node: NodeId) -> Result<Coefficient, TapeError> {
        if let Some(value) = graph.as_constant(node) {
            return Ok(Coefficient::Number(value));
        }
        let (tape, binding) = Tape::compile(graph, node)?;
        Ok(Coefficient::Computed { tape: Box::new(tape), data: binding.data })
    }

    fn value(&self, numbers: &[f64]) -> f64 {
        match self {
            Coefficient::Number(value) => *value,
            Coefficient::Computed { tape, data } => {
                let data: Vec<f64> = data.iter().map(|&source| number(source, numbers)).collect();
                tape.value(&[], &data, &mut Workspace::default())
            }
        }
    }
}

/// The number behind a local datum.
fn number(source: Source, numbers: &[f64]) -> f64 {
    match source {
        Source::Data(slot) => numbers[slot as usize],
        Source::Literal(value) => value,
    }
}

/// What a template's terms are added to.
pub(super) struct Target<'a> {
    pub affine: &'a mut Affine,
    pub groups: &'a mut Groups,
    pub row: Option<u32>,
    pub label: Label,
}

impl Template {
    /// Splits and compiles the formula at `root`.
    pub fn compile(graph: &mut Graph, root: NodeId, kernels: &mut Kernels) -> Result<Template, TapeError> {
        let split = terms::split(graph, &mut Degrees::new(graph), root);
        let constant = Coefficient::compile(graph, split.constant)?;
        let mut template = Template { constant, linear: Vec::new(), terms: Vec::new() };
        for (coefficient, node) in split.terms {
            let coefficient = Coefficient::compile(graph, coefficient)?;
            if let Node::Input(slot) = graph.node(node) {
                template.linear.push((slot, coefficient));
                continue;
            }
            let (program, binding) = Program::extract(graph, node, Literals::AsData);
            let kernel = kernels.tape(program)?;
            template.terms.push(Term { coefficient, kernel, inputs: binding.inputs, data: binding.data });
        }
        Ok(template)
    }

    /// Number of terms with a kernel.
    pub fn elements(&self) -> usize {
        self.terms.len()
    }

    /// Adds one item: `variables` and `numbers` by slot, everything times `weight`.
    pub fn add(&self, variables: &[u32], numbers: &[f64], weight: f64, kernels: &Kernels, target: &mut Target) {
        target.affine.constant += weight * self.constant.value(numbers);
        for (slot, coefficient) in &self.linear {
            target.affine.coefficients.push((variables[*slot as usize], weight * coefficient.value(numbers)));
        }
        for term in &self.terms {
            let inputs: Vec<u32> = term.inputs.iter().map(|&slot| variables[slot as usize]).collect();
            let data: Vec<f64> = term.data.iter().map(|&source| number(source, numbers)).collect();
            let weight = weight * term.coefficient.value(numbers);
            target.groups.of(term.kernel, kernels).push(&inputs, &data, weight, target.label, target.row);
        }
    }
}
