//! What variables and rows are called, and where rows are declared. Names travel in [`Meta`](super::Meta), so that no view of a
//! model can drop them.

use std::fmt;
use std::sync::Arc;

/// Where names come from.
pub trait Names: Send + Sync {
    /// The name of variable j, for messages.
    fn variable(&self, j: usize) -> String {
        format!("x[{}]", j + 1)
    }

    /// The name of row i, for messages.
    fn row(&self, i: usize) -> String {
        format!("c{}", i + 1)
    }

    /// What the objective is called.
    fn objective(&self) -> String {
        "objective".into()
    }

    /// What the volume of a rib is called, where the objective has such terms.
    fn rib_volume(&self, rib: usize) -> String {
        format!("volume of rib {}", rib + 1)
    }

    /// Where row i is declared, ready to print (`file.toml:12`), where that is known.
    fn row_place(&self, _i: usize) -> Option<String> {
        None
    }
}

/// `x[1]`, `x[2]`, …, `c1`, `c2`, …
struct Numbers;

impl Names for Numbers {}

/// The names of a model, shared by all its views.
#[derive(Clone)]
pub struct NameTable(Arc<dyn Names>);

impl NameTable {
    /// These names.
    pub fn new(names: impl Names + 'static) -> Self {
        NameTable(Arc::new(names))
    }

    /// The name of variable j.
    pub fn variable(&self, j: usize) -> String {
        self.0.variable(j)
    }

    /// The name of row i.
    pub fn row(&self, i: usize) -> String {
        self.0.row(i)
    }

    /// What the objective is called.
    pub fn objective(&self) -> String {
        self.0.objective()
    }

    /// What the volume of a rib is called.
    pub fn rib_volume(&self, rib: usize) -> String {
        self.0.rib_volume(rib)
    }

    /// Where row i is declared, where that is known.
    pub fn row_place(&self, i: usize) -> Option<String> {
        self.0.row_place(i)
    }

    /// Some of the names: of `variables` and `rows`, in this order.
    pub fn selected(&self, variables: Vec<u32>, rows: Vec<u32>) -> Self {
        NameTable::new(Selected { of: self.clone(), variables, rows })
    }
}

impl Default for NameTable {
    fn default() -> Self {
        NameTable::new(Numbers)
    }
}

impl fmt::Debug for NameTable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("NameTable")
    }
}

struct Selected {
    of: NameTable,
    variables: Vec<u32>,
    rows: Vec<u32>,
}

impl Names for Selected {
    fn variable(&self, j: usize) -> String {
        self.of.variable(self.variables[j] as usize)
    }

    fn row(&self, i: usize) -> String {
        self.of.row(self.rows[i] as usize)
    }

    fn objective(&self) -> String {
        self.of.objective()
    }

    fn rib_volume(&self, rib: usize) -> String {
        self.of.rib_volume(rib)
    }

    fn row_place(&self, i: usize) -> Option<String> {
        self.of.row_place(self.rows[i] as usize)
    }
}
