//! A model made of Rust closures, for functions that are no formulas of a problem file.

use super::{EvaluationError, Meta, Model, NameTable, Names, Pattern};

type Value = Box<dyn Fn(&[f64]) -> f64 + Send + Sync>;
type Derivatives = Box<dyn Fn(&[f64], &mut [f64]) + Send + Sync>;

/// A function with its first and second derivatives, each along a fixed list of positions.
pub struct Function {
    value: Value,
    /// The variables it depends on, ascending.
    variables: Vec<u32>,
    gradient: Derivatives,
    /// Positions (i, j), i ≥ j, of its second derivatives.
    pairs: Vec<(u32, u32)>,
    hessian: Derivatives,
    is_affine: bool,
}

impl Function {
    /// c + Σ aⱼ·xⱼ
    pub fn affine(constant: f64, coefficients: &[(usize, f64)]) -> Function {
        let mut terms = coefficients.to_vec();
        terms.sort_by_key(|&(j, _)| j);
        let (variables, factors): (Vec<usize>, Vec<f64>) = terms.iter().copied().unzip();
        let value = move |x: &[f64]| constant + terms.iter().map(|&(j, a)| a * x[j]).sum::<f64>();
        let function = Function::sparse(value, &variables, move |_, out| out.copy_from_slice(&factors), &[], |_, _| {});
        Function { is_affine: true, ..function }
    }

    /// A function of all n variables: its value, its gradient (length n), and the lower triangle of its Hessian, row by row (length
    /// n(n+1)/2: ∂₁₁, ∂₂₁, ∂₂₂, ∂₃₁, …). The slices are zero before each call.
    pub fn dense(
        n: usize,
        value: impl Fn(&[f64]) -> f64 + Send + Sync + 'static,
        gradient: impl Fn(&[f64], &mut [f64]) + Send + Sync + 'static,
        hessian: impl Fn(&[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Function {
        let variables: Vec<usize> = (0..n).collect();
        let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
        Function::sparse(value, &variables, gradient, &pairs, hessian)
    }

    /// A function of some variables (ascending): its value, its derivatives by them in that order, and its second derivatives at the
    /// pairs (i, j) with i ≥ j, in that order. The closures see all of x; the slices are zero before each call.
    pub fn sparse(
        value: impl Fn(&[f64]) -> f64 + Send + Sync + 'static,
        variables: &[usize],
        gradient: impl Fn(&[f64], &mut [f64]) + Send + Sync + 'static,
        pairs: &[(usize, usize)],
        hessian: impl Fn(&[f64], &mut [f64]) + Send + Sync + 'static,
    ) -> Function {
        Function {
            value: Box::new(value),
            variables: variables.iter().map(|&j| j as u32).collect(),
            gradient: Box::new(gradient),
            pairs: pairs.iter().map(|&(i, j)| (i.max(j) as u32, i.min(j) as u32)).collect(),
            hessian: Box::new(hessian),
            is_affine: false,
        }
    }

    fn derivatives(&self, x: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.variables.len()];
        (self.gradient)(x, &mut values);
        values
    }
}

/// Minimise a function subject to bounds and rows, all given as closures.
///
/// ```
/// use ribopt::model::closures::{Closures, Function};
/// use ribopt::model::derivative_check::derivative_check;
///
/// // minimise x² + y² subject to x·y ≥ 1, 0 ≤ x, y ≤ 10
/// let model = Closures::new(&["x", "y"], &[2.0, 2.0], &[0.0, 0.0], &[10.0, 10.0])
///     .minimise(Function::dense(
///         2,
///         |x| x[0] * x[0] + x[1] * x[1],
///         |x, g| g.copy_from_slice(&[2.0 * x[0], 2.0 * x[1]]),
///         |_, h| h.copy_from_slice(&[2.0, 0.0, 2.0]),
///     ))
///     .row("product", 1.0, f64::INFINITY, Function::sparse(
///         |x| x[0] * x[1],
///         &[0, 1],
///         |x, g| g.copy_from_slice(&[x[1], x[0]]),
///         &[(1, 0)],
///         |_, h| h[0] = 1.0,
///     ));
/// assert_eq!(derivative_check(&model, &[1.5, 0.8])?.disagreements, 0);
/// # Ok::<(), ribopt::model::EvaluationError>(())
/// ```
pub struct Closures {
    meta: Meta,
    variables: Vec<String>,
    rows: Vec<(String, Function)>,
    objective: Function,
    /// Where each function's second derivatives stand in the Lagrangian's: of the objective, then of the rows.
    places: Vec<Vec<usize>>,
}

/// The names given.
struct Given {
    variables: Vec<String>,
    rows: Vec<String>,
}

impl Names for Given {
    fn variable(&self, j: usize) -> String {
        self.variables[j].clone()
    }

    fn row(&self, i: usize) -> String {
        self.rows[i].clone()
    }
}

impl Closures {
    /// Variables with their names, starts and bounds (±∞ where open), no rows, and an objective of zero. All slices have one length;
    /// what is missing at the end of a shorter one is open, or starts at zero.
    pub fn new(names: &[&str], start: &[f64], lower: &[f64], upper: &[f64]) -> Closures {
        let n = names.len();
        let padded = |values: &[f64], open: f64| (0..n).map(|j| values.get(j).copied().unwrap_or(open)).collect::<Vec<_>>();
        let meta = Meta {
            lower: padded(lower, f64::NEG_INFINITY),
            upper: padded(upper, f64::INFINITY),
            start: padded(start, 0.0),
            typical: padded(start, 0.0).into_iter().map(f64::abs).collect(),
            ..Meta::default()
        };
        let variables = names.iter().map(ToString::to_string).collect();
        let mut model = Closures { meta, variables, rows: Vec::new(), objective: Function::affine(0.0, &[]), places: Vec::new() };
        model.connect();
        model
    }

    /// The objective.
    #[must_use]
    pub fn minimise(mut self, objective: Function) -> Self {
        self.objective = objective;
        self.connect();
        self
    }

    /// One more row: lower ≤ function ≤ upper.
    #[must_use]
    pub fn row(mut self, name: &str, lower: f64, upper: f64, function: Function) -> Self {
        self.meta.row_lower.push(lower);
        self.meta.row_upper.push(upper);
        self.meta.row_is_linear.push(function.is_affine);
        self.rows.push((name.to_owned(), function));
        self.connect();
        self
    }

    fn functions(&self) -> impl Iterator<Item = &Function> {
        std::iter::once(&self.objective).chain(self.rows.iter().map(|(_, function)| function))
    }

    /// Patterns and names of what is there now.
    fn connect(&mut self) {
        let n = self.meta.lower.len();
        let mut rows: Vec<(u32, u32)> = Vec::new();
        for (i, (_, function)) in self.rows.iter().enumerate() {
            rows.extend(function.variables.iter().map(|&j| (i as u32, j)));
        }
        let jacobian = Pattern::from_positions(self.rows.len(), &mut rows);
        let mut pairs: Vec<(u32, u32)> = self.functions().flat_map(|function| function.pairs.iter().copied()).collect();
        let hessian = Pattern::from_positions(n, &mut pairs);
        // Every pair asked for was put in above.
        let place = |&(i, j): &(u32, u32)| hessian.position(i as usize, j).unwrap_or_default();
        let places = self.functions().map(|function| function.pairs.iter().map(place).collect()).collect();
        let rows = self.rows.iter().map(|(name, _)| name.clone()).collect();
        self.meta.names = NameTable::new(Given { variables: self.variables.clone(), rows });
        self.meta.objective_is_linear = self.objective.is_affine;
        (self.meta.jacobian, self.meta.hessian, self.places) = (jacobian, hessian, places);
    }

    fn finite(&self, term: impl Fn() -> String, values: &[f64]) -> Result<(), EvaluationError> {
        match values.iter().find(|value| !value.is_finite()) {
            None => Ok(()),
            Some(value) => Err(EvaluationError::Invalid { term: term(), cause: format!("the value is {value}") }),
        }
    }
}

impl Model for Closures {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        let value = (self.objective.value)(x);
        self.finite(|| "objective".into(), &[value])?;
        Ok(value)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        gradient.fill(0.0);
        for (&j, value) in self.objective.variables.iter().zip(self.objective.derivatives(x)) {
            gradient[j as usize] = value;
        }
        self.finite(|| "gradient of the objective".into(), gradient)?;
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, (name, function)) in values.iter_mut().zip(&self.rows) {
            *value = (function.value)(x);
            self.finite(|| format!("row {name}"), &[*value])?;
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (i, (name, function)) in self.rows.iter().enumerate() {
            let own = &mut values[self.meta.jacobian.range(i)];
            own.copy_from_slice(&function.derivatives(x));
            self.finite(|| format!("derivatives of row {name}"), own)?;
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.fill(0.0);
        let weights = std::iter::once(weight).chain(y.iter().copied());
        for ((function, places), weight) in self.functions().zip(&self.places).zip(weights).filter(|(_, weight)| *weight != 0.0) {
            let mut second = vec![0.0; places.len()];
            (function.hessian)(x, &mut second);
            places.iter().zip(second).for_each(|(&place, second)| values[place] += weight * second);
        }
        self.finite(|| "second derivatives".into(), values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn affine_functions_need_no_closures() {
        let model = Closures::new(&["a", "b"], &[1.0], &[0.0; 2], &[]).minimise(Function::affine(2.0, &[(1, 3.0)])).row(
            "sum",
            1.0,
            2.0,
            Function::affine(0.0, &[(1, 1.0), (0, -1.0)]),
        );
        let (mut gradient, mut row, mut jacobian) = ([9.0; 2], [0.0], [0.0; 2]);
        assert_eq!(model.gradient(&[1.0, 2.0], &mut gradient), Ok(8.0));
        model.constraints(&[1.0, 2.0], &mut row).unwrap();
        model.jacobian(&[1.0, 2.0], &mut jacobian).unwrap();
        assert_eq!((gradient, row, jacobian), ([0.0, 3.0], [1.0], [-1.0, 1.0]));
        assert_eq!((model.meta().hessian.len(), model.meta().start[1], model.meta().upper[0]), (0, 0.0, f64::INFINITY));
        assert_eq!((model.meta().names.variable(1), model.meta().names.row(0)), ("b".into(), "sum".into()));
    }

    #[test]
    fn a_value_that_is_no_number_names_its_row() {
        let root = Function::sparse(
            |x| x[0].sqrt(),
            &[0],
            |x, g| g[0] = 0.5 / x[0].sqrt(),
            &[(0, 0)],
            |x, h| h[0] = -0.25 / x[0].powf(1.5),
        );
        let model = Closures::new(&["x"], &[1.0], &[], &[]).row("root", 0.0, 1.0, root);
        let error = model.constraints(&[-1.0], &mut [0.0]).unwrap_err();
        assert!(error.to_string().contains("row root"), "{error}");
    }

    /// Products with the Hessian are those of its entries.
    #[test]
    fn hessian_products_follow_from_entries() {
        let cubic = |x: &[f64]| x[0].powi(3) + x[0] * x[1];
        let model = Closures::new(&["x", "y"], &[1.0, 1.0], &[], &[]).minimise(Function::dense(
            2,
            cubic,
            |x, g| g.copy_from_slice(&[3.0 * x[0] * x[0] + x[1], x[0]]),
            |x, h| h.copy_from_slice(&[6.0 * x[0], 1.0, 0.0]),
        ));
        let mut product = [0.0; 2];
        model.hessian_product(&[2.0, 5.0], 0.5, &[], &[1.0, 10.0], &mut product).unwrap();
        assert_eq!(product, [0.5 * (12.0 + 10.0), 0.5]);
    }
}
