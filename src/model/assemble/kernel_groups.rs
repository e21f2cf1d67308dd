//! Kernels, each kept once, and the groups of elements that share one.

use std::collections::HashMap;
use std::sync::Arc;

use crate::expression::kernel::Kernel;
use crate::expression::tape::{Program, Tape, TapeError};
use crate::model::elements::KernelGroup;
use crate::ribs::Part;
use crate::ribs::law::VolumeLaw;

/// Every kernel of a model, numbered.
#[derive(Default)]
pub(super) struct Kernels {
    all: Vec<Arc<dyn Kernel>>,
    tapes: HashMap<Program, usize>,
    parts: HashMap<(VolumeLaw, bool), usize>,
}

impl Kernels {
    /// The number of a program's tape; one of the same structure serves again.
    pub fn tape(&mut self, program: Program) -> Result<usize, TapeError> {
        if let Some(&known) = self.tapes.get(&program) {
            return Ok(known);
        }
        self.all.push(Arc::new(Tape::new(program.clone())?));
        self.tapes.insert(program, self.all.len() - 1);
        Ok(self.all.len() - 1)
    }

    /// The number of the closed form of a part's volume.
    pub fn part(&mut self, law: VolumeLaw, difference: bool) -> usize {
        let all = &mut self.all;
        *self.parts.entry((law, difference)).or_insert_with(|| {
            all.push(Arc::new(Part::new(law, difference)));
            all.len() - 1
        })
    }
}

/// The groups of the objective, or of the rows, in order of first use.
#[derive(Default)]
pub(super) struct Groups {
    list: Vec<KernelGroup>,
    by_kernel: HashMap<usize, usize>,
}

impl Groups {
    /// The group of a kernel.
    pub fn of(&mut self, kernel: usize, kernels: &Kernels) -> &mut KernelGroup {
        let list = &mut self.list;
        let at = *self.by_kernel.entry(kernel).or_insert_with(|| {
            list.push(KernelGroup::new(Arc::clone(&kernels.all[kernel])));
            list.len() - 1
        });
        &mut self.list[at]
    }

    /// The groups, done.
    pub fn into_list(self) -> Vec<KernelGroup> {
        self.list
    }
}
