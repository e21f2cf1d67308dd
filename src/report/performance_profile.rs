//! Performance profiles: the share of problems each solver solves within a factor of the fastest one.
//!
//! E. D. Dolan and J. J. Moré, Benchmarking optimization software with performance profiles, Math. Program. 91 (2002).

use std::io::{self, Write};

use super::number::exact;

/// Costs by solver and problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// What is counted, for the axis: `evaluations`, `seconds`.
    pub measure: String,
    /// One curve per solver.
    pub curves: Vec<Curve>,
}

/// One solver's curve: a staircase.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The solver.
    pub solver: String,
    /// Ratios to the fastest, ascending, one per problem solved. The share solved within `ratios[k]` is at least (k+1)/problems.
    pub ratios: Vec<f64>,
    /// Problems in all.
    pub problems: usize,
}

impl Curve {
    /// The share of problems solved within `factor` times the fastest solver's cost.
    pub fn share(&self, factor: f64) -> f64 {
        let solved = self.ratios.partition_point(|&ratio| ratio <= factor);
        solved as f64 / self.problems.max(1) as f64
    }
}

impl Profile {
    /// `costs[solver][problem]`, `None` where the solver did not solve it. Costs below `smallest` count as that much, so
    /// that the resolution of a clock decides nothing.
    ///
    /// ```
    /// use ribopt::report::performance_profile::Profile;
    /// let costs = [vec![Some(1.0), Some(4.0)], vec![Some(2.0), None]];
    /// let profile = Profile::new("evaluations", &["a".into(), "b".into()], &costs, 1.0);
    /// assert_eq!(profile.curves[0].share(1.0), 1.0);
    /// assert_eq!(profile.curves[1].share(1.9), 0.0);
    /// assert_eq!(profile.curves[1].share(2.0), 0.5);
    /// ```
    pub fn new(measure: &str, solvers: &[String], costs: &[Vec<Option<f64>>], smallest: f64) -> Profile {
        let problems = costs.iter().map(Vec::len).max().unwrap_or(0);
        let cost = |of: &[Option<f64>], problem: usize| of.get(problem).copied().flatten().map(|cost| cost.max(smallest));
        let best: Vec<Option<f64>> =
            (0..problems).map(|problem| costs.iter().filter_map(|of| cost(of, problem)).min_by(f64::total_cmp)).collect();
        let curves = solvers.iter().zip(costs).map(|(solver, of)| {
            let ratio = |(problem, best): (usize, &Option<f64>)| Some(cost(of, problem)? / (*best)?);
            let mut ratios: Vec<f64> = best.iter().enumerate().filter_map(ratio).collect();
            ratios.sort_by(f64::total_cmp);
            Curve { solver: solver.clone(), ratios, problems }
        });
        Profile { measure: measure.into(), curves: curves.collect() }
    }

    /// The largest ratio of any solver, at least 1.
    pub fn largest_ratio(&self) -> f64 {
        self.curves.iter().filter_map(|curve| curve.ratios.last()).fold(1.0, |most: f64, &ratio| most.max(ratio))
    }

    /// Writes `factor,<solver>…`: the shares at every factor where one of them steps up.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(["factor"].into_iter().chain(self.curves.iter().map(|curve| curve.solver.as_str())))?;
        let mut factors: Vec<f64> = self.curves.iter().flat_map(|curve| curve.ratios.iter().copied()).chain([1.0]).collect();
        factors.sort_by(f64::total_cmp);
        factors.dedup();
        for factor in factors {
            table.write_record([factor].into_iter().chain(self.curves.iter().map(|curve| curve.share(factor))).map(exact))?;
        }
        table.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_nobody_solves_lowers_every_curve() {
        let profile = Profile::new("seconds", &["a".into()], &[vec![Some(3.0), None]], 0.0);
        assert_eq!(profile.curves[0].share(f64::MAX), 0.5);
    }

    #[test]
    fn the_table_steps_where_the_curves_do() {
        let costs = [vec![Some(1.0), Some(6.0)], vec![Some(3.0), Some(2.0)]];
        let mut csv = Vec::new();
        Profile::new("evaluations", &["a".into(), "b".into()], &costs, 1.0).write_csv(&mut csv).unwrap();
        assert_eq!(String::from_utf8(csv).unwrap(), "factor,a,b\n1.0,0.5,0.5\n3.0,1.0,1.0\n");
    }
}
