//! Exact derivatives against an independent method: Ridders' extrapolated central differences (Ridders 1982). Of a large model variables that
//! no row and no second derivative has in common are moved at once (Curtis, Powell and Reid, *On the estimation of sparse Jacobian
//! matrices*, Journal of the Institute of Mathematics and its Applications 13, 1974).

mod along;
mod apart;
#[cfg(test)]
mod tests;

use std::collections::HashMap;

use super::{Around, Components, EvaluationError, Meta, Model};
use along::Along;
use apart::{apart, even};

/// Variables looked at one by one; of a larger model an even selection of as many is, many at once.
const MOST_VARIABLES: usize = 400;

/// Directions times entries of everything: each direction costs some forty evaluations, and a check is to take seconds at any size.
const WORK: usize = 8_000_000;

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
    fn add(&mut self, exact: f64, numeric: f64, error: f64, name: impl FnOnce() -> String) {
        self.compared += 1;
        // A NaN counts as a disagreement.
        self.disagreements += usize::from(error.is_nan() || error > TOLERANCE);
        if self.worst.as_ref().is_none_or(|worst| error.is_nan() || error > worst.error) {
            self.worst = Some(Entry { name: name(), exact, numeric, error });
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
    let (n, selected) = (x.len(), even(x.len(), MOST_VARIABLES));
    if n <= MOST_VARIABLES {
        let one_by_one = selected.into_iter().map(|j| vec![j]).collect();
        return Ok(Differences { model, x, exact: &exact }.check(one_by_one, n));
    }
    // The derivatives are those of the whole, the differences of what the variables reach.
    let Some(near) = model.around(&selected) else {
        let groups = apart(model.meta(), &selected, groups_at_most(model.meta()));
        return Ok(Differences { model, x, exact: &exact }.check(groups, n));
    };
    let place = |j: &u32| near.variables.binary_search(j).ok().map(|place| place as u32);
    let selected: Vec<u32> = selected.iter().filter_map(place).collect();
    let groups = apart(near.model.meta(), &selected, groups_at_most(near.model.meta()));
    let x: Vec<f64> = near.variables.iter().map(|&j| x[j as usize]).collect();
    Ok(Differences { model: near.model.as_ref(), x: &x, exact: &exact.of(&near) }.check(groups, n))
}

/// Directions that are worth their evaluations.
fn groups_at_most(meta: &Meta) -> usize {
    let size = meta.variables() + meta.rows() + meta.jacobian.len() + meta.hessian.len();
    (WORK / size).max(1)
}

/// A model at a point, and derivatives to compare its differences with.
struct Differences<'a> {
    model: &'a dyn Model,
    x: &'a [f64],
    exact: &'a Exact,
}

impl Differences<'_> {
    /// Moves groups of variables, of `all` there are.
    fn check(&self, groups: Vec<Vec<u32>>, all: usize) -> DerivativeCheck {
        let looked_at = groups.iter().map(Vec::len).sum();
        let mut check = DerivativeCheck { variables: (looked_at, all), ..DerivativeCheck::default() };
        let families = families(self.model);
        for group in groups {
            compare_columns(self.model, &Along::new(self.x, group), self.exact, &families, &mut check);
        }
        check
    }
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

    /// Those of an excerpt.
    fn of(&self, near: &Around<'_>) -> Exact {
        let pick = |values: &[f64], places: &[u32]| places.iter().map(|&at| values[at as usize]).collect();
        Exact {
            gradient: pick(&self.gradient, &near.variables),
            jacobian: near.jacobian.iter().map(|&at| self.jacobian[at]).collect(),
            hessian: near.hessian.iter().map(|&at| self.hessian[at]).collect(),
            y: pick(&self.y, &near.rows),
        }
    }

    /// Derivatives of the objective and the rows along a direction, and the variable of the group each depends on.
    fn first(&self, model: &dyn Model, along: &Along<'_>) -> (Vec<f64>, Vec<Option<u32>>) {
        let pattern = &model.meta().jacobian;
        let mut first = vec![0.0; 1 + pattern.rows()];
        let mut owners = vec![None; first.len()];
        first[0] = along.variables().map(|j| self.gradient[j as usize] * along.direction(j as usize)).sum();
        owners[0] = along.only();
        for (at, (row, column)) in pattern.iter().enumerate() {
            let way = along.direction(column);
            if way != 0.0 {
                first[1 + row] += self.jacobian[at] * way;
                owners[1 + row] = Some(column as u32);
            }
        }
        (first, owners)
    }

    /// The same of the Lagrangian's gradient.
    fn second(&self, model: &dyn Model, along: &Along<'_>) -> (Vec<f64>, Vec<Option<u32>>) {
        let pattern = &model.meta().hessian;
        let mut second = vec![0.0; pattern.rows()];
        let mut owners = vec![None; second.len()];
        for (at, (row, column)) in pattern.iter().enumerate() {
            let both = [(row, column), (column, row)];
            for (i, j) in both.into_iter().take(if row == column { 1 } else { 2 }) {
                let way = along.direction(j);
                if way != 0.0 {
                    second[i] += self.hessian[at] * way;
                    owners[i] = Some(j as u32);
                }
            }
        }
        (second, owners)
    }
}

fn compare_columns(model: &dyn Model, along: &Along<'_>, exact: &Exact, families: &[usize], check: &mut DerivativeCheck) {
    let values = |x: &[f64]| {
        let mut all = vec![0.0; 1 + model.meta().rows()];
        all[0] = model.objective(x).ok()?;
        model.constraints(x, &mut all[1..]).ok()?;
        Some(all)
    };
    let variable = |owner: Option<u32>| match owner.or(along.only()) {
        Some(j) => model.variable_name(j as usize),
        None => "variables apart from one another".into(),
    };
    let name = |at: usize, owner| match at {
        0 => format!("∂(objective)/∂({})", variable(owner)),
        at => format!("∂({})/∂({})", model.row_name(at - 1), variable(owner)),
    };
    compare(along, exact.first(model, along), values, name, families, check);
    let gradient = |x: &[f64]| lagrangian_gradient(model, x, &exact.y);
    let second = |i: usize, owner| format!("∂²L/∂({})∂({})", model.variable_name(i), variable(owner));
    compare(along, exact.second(model, along), gradient, second, &[], check);
}

fn lagrangian_gradient(model: &dyn Model, x: &[f64], y: &[f64]) -> Option<Vec<f64>> {
    let mut gradient = vec![0.0; x.len()];
    let mut jacobian = vec![0.0; model.meta().jacobian.len()];
    model.gradient(x, &mut gradient).ok()?;
    model.jacobian(x, &mut jacobian).ok()?;
    model.meta().jacobian.add_transposed(&jacobian, y, &mut gradient);
    Some(gradient)
}

/// Compares exact derivatives along a direction, each with the variable of the group it is one by, with differences of `f`.
fn compare(
    along: &Along<'_>,
    (exact, owners): (Vec<f64>, Vec<Option<u32>>),
    f: impl Fn(&[f64]) -> Option<Vec<f64>> + Sync,
    name: impl Fn(usize, Option<u32>) -> String,
    families: &[usize],
    check: &mut DerivativeCheck,
) {
    let Some((numeric, noise, mut size)) = along.ridders(f) else { return };
    share_sizes(families, &mut size);
    for (at, (&exact, &owner)) in exact.iter().zip(&owners).enumerate() {
        if exact == 0.0 && numeric[at] == 0.0 {
            continue;
        }
        let owner = owner.or(along.only());
        let (way, reach) = owner.map_or((1.0, 1.0), |j| (along.direction(j as usize), along.reach(j as usize)));
        let (exact, numeric, noise) = (exact / way, numeric[at] / way, noise[at] / way);
        let scale = exact.abs().max(numeric.abs()).max(1e-6 * size[at] / reach);
        let excess = ((exact - numeric).abs() - 4.0 * noise).max(0.0);
        let error = if numeric.is_finite() { excess / scale } else { f64::NAN };
        check.add(exact, numeric, error, || name(at, owner));
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
