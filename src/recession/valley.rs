//! Following a valley outwards.

use super::floor::{Floor, settle};
use crate::model::{Meta, Model};

/// Doublings of the distance: 2^100 sizes are beyond anything a model means.
const DOUBLINGS: i32 = 100;
/// Doublings that must go well before the model may end in an overflow.
const ENOUGH: i32 = 24;
/// The first step, in sizes of the variable.
const FIRST: f64 = 0.25;
/// Halvings and doublings of the first step in which an asymptote must have risen on the other side.
const BACK: std::ops::Range<i32> = -6..40;
/// Roundings a value may hold, in units of its own size.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
/// Last digits by which a place is moved to see what rounding makes of a value.
const DIGITS: [f64; 4] = [-5.0, -2.0, 3.0, 7.0];

/// A stationary point and what is known about it.
pub struct Site<'a> {
    /// The model.
    pub model: &'a dyn Model,
    /// The point, length n.
    pub x: &'a [f64],
    /// The variables' sizes there, length n.
    pub sizes: &'a [f64],
    /// Variables that may move.
    pub free: &'a [usize],
    /// Rows that hold, with the limit they are held to.
    pub held: &'a [(usize, f64)],
    /// Row multipliers, length m.
    pub multipliers: &'a [f64],
    /// Whether a place meets bounds and rows.
    pub is_feasible: &'a dyn Fn(&[f64]) -> bool,
}

impl Site<'_> {
    pub(super) fn meta(&self) -> &Meta {
        self.model.meta()
    }
}

/// The valley about a site.
pub struct Valley<'a> {
    site: Site<'a>,
}

/// A value with what rounding may make of it.
#[derive(Clone, Copy)]
struct Height {
    value: f64,
    noise: f64,
}

impl<'a> Valley<'a> {
    /// The valley about a site.
    pub fn new(site: Site<'a>) -> Self {
        Valley { site }
    }

    /// Whether, as variable `pivot` goes on for ever in this direction (±1), the others following the floor, the objective never
    /// rises, and falls: either on that way, or, where it is level to the last digit, on the way that leads here from the other
    /// side. (A function that is level along a half-line and rises on the other one is level for rounding alone: it nears an
    /// asymptote. One that is piecewise has its pieces as rows here, and is judged feasible or not.)
    pub fn runs_off(&self, pivot: usize, direction: f64) -> bool {
        let meta = self.site.meta();
        let open = if direction > 0.0 { meta.upper[pivot] == f64::INFINITY } else { meta.lower[pivot] == f64::NEG_INFINITY };
        if !open {
            return false;
        }
        let start = Floor { x: self.site.x.to_vec(), multipliers: self.site.multipliers.to_vec() };
        let Some((here, base)) =
            settle(&self.site, pivot, start).and_then(|floor| self.height(&floor).map(|height| (floor, height)))
        else {
            return false;
        };
        match self.outwards(pivot, direction, here.clone(), base) {
            Some(fall) if fall > 0.0 => true,
            Some(_) => self.rises_back(pivot, -direction, here, base),
            None => false,
        }
    }

    /// By how much the objective falls on the way outwards, beyond rounding; `None` where it rises or ends at a limit.
    fn outwards(&self, pivot: usize, direction: f64, mut floor: Floor, base: Height) -> Option<f64> {
        let (mut last, origin) = (base, floor.x[pivot]);
        for doubling in 0..DOUBLINGS {
            let step = FIRST * self.site.sizes[pivot] * f64::from(doubling).exp2();
            let mut next = floor.clone();
            next.x[pivot] = origin + direction * step;
            let found = settle(&self.site, pivot, next).and_then(|floor| self.height(&floor).map(|height| (floor, height)));
            let Some((settled, height)) = found else { if doubling >= ENOUGH { break } else { return None } };
            if !(self.site.is_feasible)(&settled.x) || height.value > last.value + last.noise + height.noise {
                return None;
            }
            if height.value < last.value {
                last = height;
            }
            floor = settled;
        }
        Some((base.value - last.value - base.noise - last.noise).max(0.0))
    }

    /// Whether the objective rises, beyond rounding, on the way back.
    fn rises_back(&self, pivot: usize, direction: f64, here: Floor, base: Height) -> bool {
        let (mut floor, origin) = (here.clone(), here.x[pivot]);
        for doubling in BACK {
            let step = FIRST * self.site.sizes[pivot] * f64::from(doubling).exp2();
            let mut next = floor.clone();
            next.x[pivot] = origin + direction * step;
            let found = settle(&self.site, pivot, next).and_then(|floor| self.height(&floor).map(|height| (floor, height)));
            match found {
                Some((settled, height)) if (self.site.is_feasible)(&settled.x) => {
                    if height.value > base.value + 4.0 * (base.noise + height.noise) {
                        return true;
                    }
                    floor = settled;
                }
                _ => return false,
            }
        }
        false
    }

    /// f + Σ|y_i|·violation_i over the rows that hold, and what the last digits of x and of its terms make of it.
    fn height(&self, floor: &Floor) -> Option<Height> {
        let value = self.value(&floor.x)?;
        let beside = |digits: f64| {
            let x: Vec<f64> = floor.x.iter().map(|x| x * (1.0 + digits * f64::EPSILON)).collect();
            self.site.model.objective(&x).map_or(0.0, |value| value.abs())
        };
        let objective = self.site.model.objective(&floor.x).ok()?.abs();
        let noise = DIGITS.into_iter().map(|digits| (beside(digits) - objective).abs()).fold(0.0, f64::max);
        Some(Height { value, noise: noise + ROUNDINGS * objective })
    }

    fn value(&self, x: &[f64]) -> Option<f64> {
        let mut rows = vec![0.0; self.site.meta().rows()];
        self.site.model.constraints(x, &mut rows).ok()?;
        let bought = |&(i, limit): &(usize, f64)| (self.site.multipliers[i] * (rows[i] - limit)).max(0.0);
        let objective = self.site.model.objective(x).ok()?;
        Some(objective + self.site.held.iter().map(bought).sum::<f64>())
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::sample::Sample;

    /// Every row held to its lower limit.
    fn runs_off(model: &Sample, x: &[f64], multipliers: &[f64], pivot: usize, direction: f64) -> bool {
        let meta = model.meta();
        let sizes: Vec<f64> = x.iter().map(|x| x.abs().max(1.0)).collect();
        let free: Vec<usize> = (0..x.len()).collect();
        let held: Vec<(usize, f64)> = meta.row_lower.iter().copied().enumerate().collect();
        let is_feasible = |_: &[f64]| true;
        let site = Site { model, x, sizes: &sizes, free: &free, held: &held, multipliers, is_feasible: &is_feasible };
        Valley::new(site).runs_off(pivot, direction)
    }

    #[test]
    fn tails_run_off_wherever_the_origin_lies() {
        for shift in [0.0, 4.0, -1e3] {
            let bell = Sample::new(&[1.0, 1.0], move |x| (-(x[0] - shift) * (x[0] - shift)).exp() + x[1] * x[1] - 1.0);
            assert!(runs_off(&bell, &[shift + 6.2, 0.0], &[], 0, 1.0), "{shift}");
            assert!(!runs_off(&bell, &[shift + 6.2, 0.0], &[], 0, -1.0), "{shift}: over the top");
            let asymptote = Sample::new(&[1.0], move |x| ((x[0] - shift) * (x[0] - shift) + 1.0).sqrt() - (x[0] - shift));
            assert!(runs_off(&asymptote, &[shift + 7.06e7], &[], 0, 1.0), "{shift}");
        }
    }

    #[test]
    fn bent_valleys_are_followed() {
        for (shift, unit) in [(0.0, 1.0), (3.0, 1.0), (0.0, 1e-6), (-2.0, 1e6)] {
            let f = move |x: &[crate::model::sample::Value]| {
                let (a, b) = (x[0] - shift, x[1] * unit + shift);
                a * a + (a * b - 1.0).powi(2)
            };
            let valley = Sample::new(&[1.0, 1.0], f);
            let x = [1e-3 + shift, (1e3 - shift) / unit];
            assert!(runs_off(&valley, &x, &[], 1, 1.0), "{shift} {unit}");
        }
        // x² with x·y = 1: y = 1e9, multiplier −2x²·x.
        let row = Sample::new(&[1.0, 1.0], |x| x[0] * x[0]).row(1.0, f64::INFINITY, |x| x[0] * x[1]);
        assert!(runs_off(&row, &[1e-3, 1e3], &[-2e-6], 1, 1.0));
    }

    #[test]
    fn what_is_attained_stays() {
        let level = Sample::new(&[1.0, 1.0], |x| x[1] * x[1]);
        assert!(!runs_off(&level, &[1e6, 0.0], &[], 0, 1.0));
        let far = Sample::new(&[1.0], |x| (-x[0]).exp() + x[0] * x[0] * 1e-20);
        assert!(!runs_off(&far, &[45.0], &[], 0, 1.0));
        let line = Sample::new(&[1.0, 1.0], |x| (x[0] - x[1]).powi(2));
        assert!(!runs_off(&line, &[5.0, 5.0], &[], 0, 1.0));
    }
}
