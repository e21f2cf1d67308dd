//! Affine functions of the variables.

/// An affine function: constant and coefficients, one per variable at the most.
#[derive(Debug, Clone, Default)]
pub(super) struct Affine {
    pub constant: f64,
    pub coefficients: Vec<(u32, f64)>,
}

impl Affine {
    /// Its value.
    pub fn value(&self, x: &[f64]) -> f64 {
        self.constant + self.coefficients.iter().map(|&(j, c)| c * x[j as usize]).sum::<f64>()
    }

    /// The derivatives by the variables from `first` on, overwritten.
    pub fn gradient(&self, first: usize, target: &mut [f64]) {
        target.fill(0.0);
        let begin = self.coefficients.partition_point(|&(j, _)| (j as usize) < first);
        for &(j, coefficient) in &self.coefficients[begin..] {
            let Some(derivative) = target.get_mut(j as usize - first) else { break };
            *derivative = coefficient;
        }
    }

    /// Adds up the coefficients of each variable, in ascending order of variables.
    pub fn merge(&mut self) {
        self.coefficients.sort_by_key(|&(j, _)| j);
        self.coefficients.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 += next.1;
            }
            same
        });
        self.coefficients.shrink_to_fit();
    }
}
