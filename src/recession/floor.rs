//! Newton steps to the floor of a valley: the point that is stationary in all variables but one, on the active rows.

use super::parameters::floor::{CORRECTIONS, DAMPED, DUAL, LEAST, PROXIMAL, SETTLED};
use nalgebra::{DMatrix, DVector};

use super::valley::Site;

/// A place on the floor with the row multipliers there.
#[derive(Clone)]
pub(super) struct Floor {
    pub(super) x: Vec<f64>,
    pub(super) multipliers: Vec<f64>,
}

/// Leads the free variables but `pivot` to the floor; `None` where the model has no value on the way.
pub(super) fn settle(site: &Site<'_>, pivot: usize, mut place: Floor) -> Option<Floor> {
    let moving: Vec<usize> = site.free.iter().copied().filter(|&j| j != pivot).collect();
    if moving.is_empty() && site.held.is_empty() {
        return Some(place);
    }
    let mut was_short = false;
    for _ in 0..CORRECTIONS {
        let step = newton_step(site, &moving, &place, Towards::Floor(PROXIMAL))?;
        let longest = take(site, &moving, &step, &mut place.x);
        // While multipliers still change, their regularisation keeps the place off the rows: only the next step leads there.
        let mut holds = true;
        for (k, &(i, _)) in site.held.iter().enumerate() {
            let change = step[moving.len() + k];
            place.multipliers[i] += change;
            holds &= change.abs() <= SETTLED * place.multipliers[i].abs();
        }
        if !place.x.iter().chain(&place.multipliers).all(|value| value.is_finite()) {
            return None;
        }
        if longest <= SETTLED && (holds || was_short) {
            return Some(place);
        }
        was_short = longest <= SETTLED;
    }
    // A variable that goes to zero never settles by its own measure; the height judges the place.
    Some(place)
}

/// Takes a step within the bounds; the longest change, relative to the variables.
fn take(site: &Site<'_>, moving: &[usize], step: &[f64], x: &mut [f64]) -> f64 {
    let mut longest = 0.0f64;
    for (&j, step) in moving.iter().zip(step) {
        let before = x[j];
        x[j] = (before + step).clamp(site.meta().lower[j], site.meta().upper[j]);
        longest = longest.max((x[j] - before).abs() / (before.abs() + x[j].abs()).max(f64::MIN_POSITIVE));
    }
    longest
}

/// The place led back to the rows alone, without looking at the floor: what is solved for slopes and rows together is right to the last
/// digits of the larger of both only, which may be far more than variables far out have left.
pub(super) fn back_to_rows(site: &Site<'_>, pivot: usize, mut place: Floor) -> Option<Floor> {
    let moving: Vec<usize> = site.free.iter().copied().filter(|&j| j != pivot).collect();
    if moving.is_empty() {
        return Some(place);
    }
    for _ in 0..CORRECTIONS {
        let step = newton_step(site, &moving, &place, Towards::Rows)?;
        if take(site, &moving, &step, &mut place.x) <= SETTLED {
            break;
        }
    }
    place.x.iter().all(|x| x.is_finite()).then_some(place)
}

/// Newton's steps from a site, all free variables moving: where so many lead, and the longest change of each in units of the
/// variables' sizes. `None` where the model has no value on the way.
pub fn newton(site: &Site<'_>, count: usize) -> Option<(Vec<f64>, Vec<f64>)> {
    let mut place = Floor { x: site.x.to_vec(), multipliers: site.multipliers.to_vec() };
    let mut lengths = Vec::with_capacity(count);
    for _ in 0..count {
        let step = newton_step(site, site.free, &place, Towards::Floor(DAMPED))?;
        let mut longest = 0.0f64;
        for (&j, step) in site.free.iter().zip(&step) {
            let before = place.x[j];
            place.x[j] = (before + step).clamp(site.meta().lower[j], site.meta().upper[j]);
            longest = longest.max((place.x[j] - before).abs() / site.sizes[j]);
        }
        for (&(i, _), step) in site.held.iter().zip(&step[site.free.len()..]) {
            place.multipliers[i] += step;
        }
        if !place.x.iter().chain(&place.multipliers).all(|value| value.is_finite()) {
            return None;
        }
        lengths.push(longest);
    }
    Some((place.x, lengths))
}

/// Where a step leads.
#[derive(Clone, Copy)]
enum Towards {
    /// To the floor on the rows, the Hessian regularised by so much.
    Floor(f64),
    /// To the rows alone.
    Rows,
}

/// The step of [H Aᵀ; A −δ]·[dx; dy] = [−∇L; limit − c], every variable in the unit that makes the curvature of its row one: rows
/// are summed in units of the variables' sizes, so that units change nothing.
fn newton_step(site: &Site<'_>, moving: &[usize], place: &Floor, towards: Towards) -> Option<Vec<f64>> {
    let (meta, model) = (site.meta(), site.model);
    let (n, m) = (moving.len(), site.held.len());
    let mut slope = vec![0.0; meta.variables()];
    let (mut rows, mut jacobian, mut hessian) =
        (vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()], vec![0.0; meta.hessian.len()]);
    model.gradient(&place.x, &mut slope).ok()?;
    model.constraints(&place.x, &mut rows).ok()?;
    model.jacobian(&place.x, &mut jacobian).ok()?;
    model.hessian(&place.x, 1.0, &place.multipliers, &mut hessian).ok()?;
    meta.jacobian.add_transposed(&jacobian, &place.multipliers, &mut slope);
    let mut at = vec![usize::MAX; meta.variables()];
    moving.iter().enumerate().for_each(|(k, &j)| at[j] = k);
    let mut matrix = DMatrix::<f64>::zeros(n + m, n + m);
    for ((row, column), value) in meta.hessian.iter().zip(hessian) {
        if at[row] != usize::MAX && at[column] != usize::MAX {
            matrix[(at[row], at[column])] += value;
            if row != column {
                matrix[(at[column], at[row])] += value;
            }
        }
    }
    let d = |k: usize| site.sizes[moving[k]];
    let size = |k: usize| (0..n).map(|l| matrix[(k, l)].abs() * (d(l) / d(k))).sum();
    let size: Vec<f64> = (0..n).map(size).map(|size: f64| if size > LEAST { size } else { 0.0 }).collect();
    for (k, &(i, _)) in site.held.iter().enumerate() {
        for entry in meta.jacobian.range(i) {
            let j = at[meta.jacobian.columns[entry] as usize];
            if j != usize::MAX {
                matrix[(n + k, j)] = jacobian[entry];
                matrix[(j, n + k)] = jacobian[entry];
            }
        }
    }
    let mut right = DVector::<f64>::zeros(n + m);
    let proximal = match towards {
        Towards::Floor(proximal) => {
            moving.iter().enumerate().for_each(|(k, &j)| right[k] = -slope[j]);
            proximal
        }
        Towards::Rows => PROXIMAL,
    };
    site.held.iter().enumerate().for_each(|(k, &(i, limit))| right[n + k] = limit - rows[i]);
    let unit = balance(&mut matrix, &mut right, &size, proximal);
    let solution = matrix.full_piv_lu().solve(&right)?;
    Some(solution.iter().zip(&unit).map(|(value, unit)| value * unit).collect())
}

/// Scales rows and columns alike: variables by their curvature (by the rows where they have none), rows by their largest entry;
/// adds the regularisation. The scales.
fn balance(matrix: &mut DMatrix<f64>, right: &mut DVector<f64>, size: &[f64], proximal: f64) -> Vec<f64> {
    let (n, m) = (size.len(), right.len() - size.len());
    let mut unit: Vec<f64> = size.iter().map(|size| if *size > 0.0 { size.sqrt().recip() } else { 1.0 }).collect();
    for k in 0..m {
        let largest = (0..n).map(|j| (matrix[(n + k, j)] * unit[j]).abs()).fold(0.0, f64::max);
        unit.push(if largest > 0.0 && largest.is_finite() { largest.recip() } else { 1.0 });
    }
    for row in 0..n + m {
        right[row] *= unit[row];
        for column in 0..n + m {
            matrix[(row, column)] *= unit[row] * unit[column];
        }
    }
    for k in 0..n {
        matrix[(k, k)] += if size[k] > 0.0 { proximal } else { 1.0 };
    }
    for k in n..n + m {
        matrix[(k, k)] -= DUAL;
    }
    unit
}
