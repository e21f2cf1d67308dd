//! Models some of whose variables follow from the others through equations of their own.

/// Which variables are states, and which rows their equations: one block of both per load case, all after the design's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct States {
    /// The first of them; design variables stand before.
    pub first_variable: usize,
    /// The first of their equations.
    pub first_row: usize,
    /// States and equations per block.
    pub block: usize,
    /// Number of blocks. All have the same matrix ∂R/∂u.
    pub blocks: usize,
    /// Whether that matrix is regular wherever the design is within its bounds, which are finite: then the states are continuous in the
    /// design, and bounded.
    pub are_bounded: bool,
}

impl States {
    /// Whether variable j is one of them.
    pub fn has(self, j: usize) -> bool {
        (self.first_variable..self.first_variable + self.block * self.blocks).contains(&j)
    }
}
