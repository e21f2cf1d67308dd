//! Exact derivatives against an independent method: Ridders' extrapolated central differences (Ridders 1982).

use std::collections::HashMap;

use super::{Components, EvaluationError, Model};

/// Variables looked at one by one; of a larger model an even selection of as many is.
const MOST_VARIABLES: usize = 400;

/// Variables times entries of everything: each variable costs some twenty evaluations, and a check is to take seconds at any size.
const WORK: usize = 8_000_000;
const FEWEST_VARIABLES: usize = 20;

/// Components looked at, of a model that decomposes.
const MOST_COMPONENTS: usize = 100;

/// Relative disagreement that counts as a wrong derivative.
const TOLERANCE: f64 = 1e-6;

/// One derivative, both ways.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Which derivative: `∂(volume)/∂(support.b)`.
    pub name: String,
    /// The model's value.
    pub exact: f64,
    /// The value by differences.
    pub numeric: f64,
    /// |exact − numeric| over the scale of the function's change, less what differences cannot resolve.
    pub error: f64,
}

/// The outcome.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DerivativeCheck {
    /// Derivatives compared.
    pub compared: usize,
    /// Derivatives that disagree.
    pub disagreements: usize,
    /// The worst one.
    pub worst: Option<Entry>,
    /// Variables looked at, of all.
    pub variables: (usize, usize),
}

impl DerivativeCheck {
    fn add(&mut self, entry: Entry) {
        self.compared += 1;
        // A NaN counts as a disagreement.
        self.disagreements += usize::from(entry.error.is_nan() || entry.error > TOLERANCE);
        if self.worst.as_ref().is_none_or(|worst| entry.error.is_nan() || entry.error > worst.error) {
            self.worst = Some(entry);
        }
    }
}

/// Compares gradient, Jacobian and the Hessian of a Lagrangian with fixed multipliers at `x`.
///
/// # Errors
/// Where the model has no value at `x` itself.
pub fn derivative_check(model: &dyn Model, x: &[f64]) -> Result<DerivativeCheck, EvaluationError> {
    match model.components().filter(|_| x.len() > MOST_VARIABLES) {
        Some(components) => check_components(components.as_ref(), x),
        None => check_whole(model, x),
    }
}

/// Of a large model that decomposes an even selection of components is looked at, each by itself: differences of the whole
/// would cost as much as its size for every variable.
fn check_components(components: &dyn Components, x: &[f64]) -> Result<DerivativeCheck, EvaluationError> {
    let partition = components.partition();
    let mut check = DerivativeCheck { variables: (0, x.len()), ..DerivativeCheck::default() };
    let step = (partition.len() / MOST_COMPONENTS).max(1);
    for component in (0..partition.len()).step_by(step) {
        if check.variables.0 >= MOST_VARIABLES {
            break;
        }
        let own: Vec<f64> = partition.variables(component).iter().map(|&j| x[j as usize]).collect();
        let found = check_whole(components.model(component).as_ref(), &own)?;
        check.variables.0 += found.variables.0;
        check.compared += found.compared;
        check.disagreements += found.disagreements;
        if let Some(worst) = found.worst {
            let beats = |known: &Entry| worst.error.is_nan() || worst.error > known.error;
            if check.worst.as_ref().is_none_or(beats) {
                check.worst = Some(worst);
            }
        }
    }
    Ok(check)
}

fn check_whole(model: &dyn Model, x: &[f64]) -> Result<DerivativeCheck, EvaluationError> {
    let exact = Exact::at(model, x)?;
    let (n, meta) = (x.len(), model.meta());
    let size = n + meta.rows() + meta.jacobian.len() + meta.hessian.len();
    let most = (WORK / size.max(1)).clamp(FEWEST_VARIABLES, MOST_VARIABLES);
    let step = n.div_ceil(most).max(1);
    let mut check = DerivativeCheck { variables: (n.div_ceil(step), n), ..DerivativeCheck::default() };
    for j in (0..n).step_by(step) {
        compare_column(model, x, j, &exact, &mut check);
    }
    Ok(check)
}

struct Exact {
    gradient: Vec<f64>,
    jacobian: Vec<f64>,
    hessian: Vec<f64>,
    y: Vec<f64>,
}

impl Exact {
    fn at(model: &dyn Model, x: &[f64]) -> Result<Exact, EvaluationError> {
        let meta = model.meta();
        let mut exact = Exact {
            gradient: vec![0.0; x.len()],
            jacobian: vec![0.0; meta.jacobian.len()],
            hessian: vec![0.0; meta.hessian.len()],
            // Any fixed multipliers will do; unequal ones, so that no two rows' errors cancel.
            y: (0..meta.rows()).map(|i| 0.5 + (i as f64 * 0.618_033_988_749_895).fract()).collect(),
        };
        let mut values = vec![0.0; meta.rows()];
        model.constraints(x, &mut values)?;
        model.gradient(x, &mut exact.gradient)?;
        model.jacobian(x, &mut exact.jacobian)?;
        model.hessian(x, 1.0, &exact.y, &mut exact.hessian)?;
        Ok(exact)
    }

    /// Column j of the Jacobian, dense.
    fn jacobian_column(&self, model: &dyn Model, j: usize) -> Vec<f64> {
        let pattern = &model.meta().jacobian;
        let value = |row| pattern.position(row, j as u32).map_or(0.0, |at| self.jacobian[at]);
        (0..pattern.rows()).map(value).collect()
    }

    /// Column j of the symmetric Hessian, dense.
    fn hessian_column(&self, model: &dyn Model, j: usize) -> Vec<f64> {
        let pattern = &model.meta().hessian;
        let value = |i: usize| pattern.position(i.max(j), i.min(j) as u32).map_or(0.0, |at| self.hessian[at]);
        (0..pattern.rows()).map(value).collect()
    }
}

fn compare_column(model: &dyn Model, x: &[f64], j: usize, exact: &Exact, check: &mut DerivativeCheck) {
    let variable = model.variable_name(j);
    let values = |x: &[f64]| {
        let mut all = vec![0.0; 1 + model.meta().rows()];
        all[0] = model.objective(x).ok()?;
        model.constraints(x, &mut all[1..]).ok()?;
        Some(all)
    };
    let name = |at: usize| match at {
        0 => format!("∂(objective)/∂({variable})"),
        at => format!("∂({})/∂({variable})", model.row_name(at - 1)),
    };
    let mut column = vec![exact.gradient[j]];
    column.extend(exact.jacobian_column(model, j));
    let families = families(model);
    compare(x, j, &column, values, name, &families, check);
    let gradient = |x: &[f64]| lagrangian_gradient(model, x, &exact.y);
    let second = |i: usize| format!("∂²L/∂({})∂({variable})", model.variable_name(i));
    compare(x, j, &exact.hessian_column(model, j), gradient, second, &[], check);
}

fn lagrangian_gradient(model: &dyn Model, x: &[f64], y: &[f64]) -> Option<Vec<f64>> {
    let mut gradient = vec![0.0; x.len()];
    let mut jacobian = vec![0.0; model.meta().jacobian.len()];
    model.gradient(x, &mut gradient).ok()?;
    model.jacobian(x, &mut jacobian).ok()?;
    model.meta().jacobian.add_transposed(&jacobian, y, &mut gradient);
    Some(gradient)
}

/// Compares one exact column with differences of `f` in variable j.
fn compare(
    x: &[f64],
    j: usize,
    exact: &[f64],
    f: impl Fn(&[f64]) -> Option<Vec<f64>>,
    name: impl Fn(usize) -> String,
    families: &[usize],
    check: &mut DerivativeCheck,
) {
    let Some((numeric, noise, mut size)) = ridders(x, j, f) else { return };
    share_sizes(families, &mut size);
    let reach = x[j].abs().max(1e-3);
    for (at, &exact) in exact.iter().enumerate() {
        if exact == 0.0 && numeric[at] == 0.0 {
            continue;
        }
        let scale = exact.abs().max(numeric[at].abs()).max(1e-6 * size[at] / reach);
        let excess = ((exact - numeric[at]).abs() - 4.0 * noise[at]).max(0.0);
        let error = if numeric[at].is_finite() { excess / scale } else { f64::NAN };
        check.add(Entry { name: name(at), exact, numeric: numeric[at], error });
    }
}

/// Which entries (the objective, then the rows) are of one constraint, by the first of them. Where rows are responses of a structure, what
/// rounding leaves in one is a share of its terms, and these are as large as the other rows of its constraint: a stress that is zero by statics
/// has its differences in units of the stresses elsewhere.
fn families(model: &dyn Model) -> Vec<usize> {
    let mut first: HashMap<String, usize> = HashMap::new();
    let rows = (0..model.meta().rows()).map(|row| {
        let name = model.row_name(row);
        let own = name.split('[').next().unwrap_or_default().to_owned();
        *first.entry(own).or_insert(row + 1)
    });
    std::iter::once(0).chain(rows).collect()
}

/// Gives all entries of a family the size of the largest.
fn share_sizes(families: &[usize], size: &mut [f64]) {
    let mut largest = vec![0.0_f64; size.len()];
    families.iter().zip(size.iter()).for_each(|(&family, &size)| largest[family] = largest[family].max(size));
    families.iter().zip(size.iter_mut()).for_each(|(&family, size)| *size = largest[family]);
}

/// The largest step of 0.02·|x| and its quarters that has values on both sides, and these values.
fn first_step(x: f64, shifted: &impl Fn(f64) -> Option<Vec<f64>>) -> Option<(f64, Vec<f64>, Vec<f64>)> {
    let largest = 0.02 * x.abs().max(1e-2);
    let steps = std::iter::successors(Some(largest), |step| Some(step / 4.0)).take(21);
    steps.into_iter().find_map(|step| Some((step, shifted(-step)?, shifted(step)?)))
}

/// Derivatives of all components in variable j, their estimated errors, and the components' sizes.
/// Steps shrink until the model has values on both sides; `None` where it never has.
fn ridders(x: &[f64], j: usize, f: impl Fn(&[f64]) -> Option<Vec<f64>>) -> Option<(Vec<f64>, Vec<f64>, Vec<f64>)> {
    const LEVELS: usize = 6;
    let shifted = |by: f64| {
        let mut point = x.to_vec();
        point[j] += by;
        f(&point)
    };
    let (mut step, mut left, mut right) = first_step(x[j], &shifted)?;
    let size: Vec<f64> = left.iter().zip(&right).map(|(l, r)| l.abs().max(r.abs())).collect();
    let mut best = vec![f64::NAN; left.len()];
    let mut noise = vec![f64::INFINITY; left.len()];
    let mut previous: Vec<Vec<f64>> = Vec::new();
    for level in 0..LEVELS {
        let mut row = vec![left.iter().zip(&right).map(|(l, r)| (r - l) / (2.0 * step)).collect::<Vec<f64>>()];
        let mut factor = 1.0;
        for order in 0..level {
            factor *= 4.0;
            let refined: Vec<f64> =
                row[order].iter().zip(&previous[order]).map(|(fine, coarse)| fine + (fine - coarse) / (factor - 1.0)).collect();
            for at in 0..refined.len() {
                let error = (refined[at] - row[order][at]).abs().max((refined[at] - previous[order][at]).abs());
                if error <= noise[at] {
                    (best[at], noise[at]) = (refined[at], error);
                }
            }
            row.push(refined);
        }
        previous = row;
        step /= 2.0;
        (left, right) = (shifted(-step)?, shifted(step)?);
    }
    // What cancellation in the differences can hide.
    for (noise, size) in noise.iter_mut().zip(&size) {
        *noise += 8.0 * f64::EPSILON * size / step;
    }
    Some((best, noise, size))
}
