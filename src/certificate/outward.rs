//! Curves that lead outwards without end where no straight ray does: along x·y = 1, or down a valley about it, one variable grows
//! as another shrinks. In the logarithms of the variables such a curve nears a line, whose direction is flat in the sense of the
//! second-order test.

use super::Tolerances;
use super::feasibility::step_back;
use super::higher_order::Trial;
use super::multipliers::Multipliers;
use super::point::Point;
use super::second_order::{Active, Choice, Hessian, Kkt};

/// A variable has gone far enough for its growth to show a power law.
const FAR: f64 = 1e3;
/// Directions bending less than this are followed, in units of σ or of the sharpest bend.
const FLAT: f64 = 1e-3;
const DIRECTIONS: usize = 12;
/// Variables and rows at the most.
const LARGEST: usize = 2_000;
/// By which factors the far variable grows.
const GROWTH: [f64; 7] = [1.1, 2.0, 10.0, 100.0, 1e3, 1e4, 1e6];
/// Variables that would change by more than this power of the growth are held: theirs is no power law.
const STEEPEST: f64 = 50.0;
/// Newton steps back to the rows.
const CORRECTIONS: usize = 3;

/// The far variables that grow along a curve on which the objective falls for six decades; `far` is (way, variable), the
/// farthest first.
pub(super) fn variables(point: &Point<'_>, active: &Active<'_>, far: &[(f64, usize)], tolerances: &Tolerances) -> Vec<usize> {
    let far: Vec<usize> = far.iter().filter(|(way, _)| *way > FAR).map(|f| f.1).collect();
    if far.is_empty() {
        return Vec::new();
    }
    let choice = Choice::all(point, active);
    let free = choice.loose_variables();
    if free.len() + choice.held.len() > LARGEST {
        return Vec::new();
    }
    // Steps in proportion: a variable that has become tiny is measured by itself.
    let own = point.in_own_sizes();
    let Ok(hessian) = Hessian::of(&own, active.multipliers) else { return Vec::new() };
    let noise = noise(point, &hessian);
    // Far out, multipliers may be too small to tell which rows push, and all bends small beside σ.
    let shapes = [hessian.normalised(), hessian];
    let ways = [choice.held.clone(), choice.strict_rows()]
        .into_iter()
        .flat_map(|held| shapes.iter().map(move |shape| (held.clone(), shape)));
    let powers = ways.into_iter().find_map(|(held, shape)| {
        let directions = Kkt::new(&own, shape, &free, &held).and_then(|mut kkt| kkt.flat_directions(DIRECTIONS, FLAT));
        let curve = Curve { point, multipliers: active.multipliers, held: &held, noise, tolerances };
        let falling = |direction: &Vec<f64>| powers(point, direction, &far).filter(|powers| curve.falls(powers));
        directions.unwrap_or_default().iter().find_map(falling)
    });
    powers.map_or_else(Vec::new, |powers| far.into_iter().filter(|&j| powers[j] > 0.1).collect())
}

/// By which power of the growth each variable changes: v_j/x_j, that of a far variable being 1; `None` where none grows.
fn powers(point: &Point<'_>, direction: &[f64], far: &[usize]) -> Option<Vec<f64>> {
    let rate = |j: usize| if point.x[j] == 0.0 { 0.0 } else { direction[j] / point.x[j] };
    let fastest = far.iter().copied().max_by(|&a, &b| rate(a).abs().total_cmp(&rate(b).abs()))?;
    let unit = rate(fastest);
    let power = |j: usize| {
        let power = rate(j) / unit;
        if power.abs() <= STEEPEST { power } else { 0.0 }
    };
    (unit.abs() > 1e-3).then(|| (0..direction.len()).map(power).collect())
}

/// Where a curve is followed, and what counts.
struct Curve<'c, 'p> {
    point: &'c Point<'p>,
    multipliers: &'c Multipliers,
    held: &'c [usize],
    noise: f64,
    tolerances: &'c Tolerances,
}

impl Curve<'_, '_> {
    /// Whether the objective falls along the curve, at every step and beyond rounding, and all rows stay met.
    fn falls(&self, powers: &[f64]) -> bool {
        // What a violation within the tolerance has bought does not count.
        let Some(base) = self.on_rows(self.point.x.to_vec()) else { return false };
        let Some(first) = self.value(&base) else { return false };
        let mut last = first;
        for growth in GROWTH {
            let grown = base.iter().zip(powers).map(|(x, power)| x * growth.powf(*power)).collect();
            match self.on_rows(grown).and_then(|x| self.value(&x)) {
                Some(next) if next <= last => last = next,
                _ => return false,
            }
        }
        first - last > self.noise
    }

    /// The objective, where all rows are met.
    fn value(&self, x: &[f64]) -> Option<f64> {
        let trial = Trial::at(self.point, x).filter(|trial| trial.is_feasible(self.point, self.tolerances.constraint))?;
        Some(trial.penalised(self.point, self.multipliers))
    }

    /// Back onto the rows that push, by Newton steps in proportion.
    fn on_rows(&self, mut x: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..if self.held.is_empty() { 0 } else { CORRECTIONS } {
            let at = Point::new(self.point.origin, &x).ok()?.in_own_sizes();
            x = step_back(&at, &|_, i| self.held.contains(&i))?;
        }
        Some(x)
    }
}

/// What the last digits of f, and of x through the second derivatives, make of f.
fn noise(point: &Point<'_>, hessian: &Hessian) -> f64 {
    let bend: f64 = hessian.size.iter().sum();
    64.0 * f64::EPSILON * point.objective.abs() + (64.0 * f64::EPSILON).powi(2) * bend * point.scale()
}
