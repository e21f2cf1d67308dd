//! Ways to infinity, straight and bent, and to the domain's edge: followed with the model itself, place by place.

use super::height::{Fall, Height, is_endless, last_digits};
use super::parameters::height::ROUNDINGS;
use super::parameters::ways::{BACK, BEYOND, BISECTIONS, CHANGED, DECADES, EDGE_DECADES, ENOUGH, FAR, LOST, NOISE, TRIED};
use crate::model::{Meta, Model};

/// A feasible way along which the objective never stops falling.
#[derive(Debug, Clone)]
pub struct Ray {
    /// How it falls.
    pub fall: Fall,
    /// Length n; of a bent way, where it leads in the end.
    pub direction: Vec<f64>,
    /// Where it begins.
    pub from: Vec<f64>,
}

/// Where ways lead through.
pub struct Terrain<'a> {
    /// The model.
    pub model: &'a dyn Model,
    /// Where the variables come from, length n.
    pub start: &'a [f64],
    /// A place beside this one that meets every limit: itself, where it does.
    pub nearest: &'a dyn Fn(&[f64]) -> Option<Vec<f64>>,
    /// The objective cannot fall without end, whatever is seen (a posynomial is positive).
    pub is_bounded: bool,
}

/// A place on a way.
enum Place {
    At(Height),
    /// A limit is in the way.
    Barred,
    /// The model has no value, or numbers end.
    Void,
}

impl Terrain<'_> {
    fn meta(&self) -> &Meta {
        self.model.meta()
    }

    /// Follows `from + t·direction`.
    pub fn straight(&self, from: &[f64], direction: &[f64]) -> Option<Ray> {
        let direction = self.cleaned(direction, from)?;
        let place = |t: f64| from.iter().zip(&direction).map(|(x, v)| x + t * v).collect();
        let outward = (0..DECADES).map(|decade| place(10f64.powi(decade)));
        let inward = (1..=BACK).map(|decade| place(10f64.powi(-decade) - 1.0));
        Some(Ray { fall: self.fall(from, outward, inward)?, direction, from: from.to_vec() })
    }

    /// Follows the axes of the variables that are open.
    pub fn axes(&self, from: &[f64]) -> Option<Ray> {
        let meta = self.meta();
        let axis = |j: usize, sign: f64| {
            let mut direction = vec![0.0; meta.variables()];
            direction[j] = sign * self.start[j].abs().max(1.0);
            direction
        };
        let up = |j: usize| (meta.upper[j] == f64::INFINITY).then(|| axis(j, 1.0));
        let down = |j: usize| (meta.lower[j] == f64::NEG_INFINITY).then(|| axis(j, -1.0));
        let axes = (0..meta.variables().min(TRIED)).flat_map(|j| [up(j), down(j)]).flatten();
        axes.into_iter().find_map(|axis| self.straight(from, &axis))
    }

    /// Follows the power curve x_j·g^p_j through a far point, p_j from how far each variable has come from its own size. A minimum
    /// that is not attained because x·y ≥ 1 leads away, or a fall along y = x², lies on such a curve.
    pub fn power_curve(&self, x: &[f64]) -> Option<Ray> {
        let magnitude = |j: usize| (x[j].abs() / size(self.start[j])).ln();
        let power = |j: usize| if x[j] != 0.0 && magnitude(j).abs() > CHANGED.ln() { magnitude(j) } else { 0.0 };
        let powers: Vec<f64> = (0..x.len()).map(power).collect();
        let largest = powers.iter().fold(0.0, |most: f64, power| most.max(*power));
        if largest < FAR.ln() {
            return None;
        }
        let place =
            |decade: f64| x.iter().zip(&powers).map(|(x, power)| x * 10f64.powf(decade * power / largest)).collect::<Vec<f64>>();
        // Half the way back, where numbers end beyond the point.
        let decades = largest / std::f64::consts::LN_10;
        let fall = [0.0, -0.5 * decades].into_iter().find_map(|base| {
            let outward = (1..DECADES).map(|decade| place(base + f64::from(decade)));
            let inward = (1..=BACK).map(|at| place(base - (base + decades) * f64::from(at) / f64::from(BACK)));
            self.fall(&place(base), outward, inward)
        })?;
        let growing = |j: usize| if powers[j] > 0.0 { powers[j] / largest * x[j] } else { 0.0 };
        let longest = (0..x.len()).map(growing).fold(0.0, |most: f64, v| most.max(v.abs()));
        let direction = (0..x.len()).map(|j| growing(j) / longest).collect();
        Some(Ray { fall, direction, from: x.to_vec() })
    }

    /// Follows the way from the start to the point, lengthened to a place where the model has no value or a bound ends it: log(x) or
    /// −1/x at 0. What
    /// settles there may just as well be attained: that is no ray.
    pub fn towards_edge(&self, x: &[f64]) -> Option<Ray> {
        let at = |share: f64| -> Vec<f64> { self.start.iter().zip(x).map(|(s, x)| s + share * (x - s)).collect() };
        let is_inside = |share: f64| matches!(self.place(&at(share)), Place::At(_));
        let (mut inside, mut outside) = (1.0, 1.0 + BEYOND);
        if self.is_bounded || x == self.start || is_inside(outside) {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (inside + outside);
            if is_inside(middle) { inside = middle } else { outside = middle }
        }
        let mut heights = Vec::new();
        for decade in 0..EDGE_DECADES {
            match self.place(&at(inside * (1.0 - 10f64.powi(-decade)))) {
                Place::At(height) if heights.last().is_none_or(|&last| !height.rises_above(last)) => heights.push(height),
                _ => return None,
            }
        }
        let direction = self.start.iter().zip(x).map(|(s, x)| x - s).collect();
        is_endless(&heights).then(|| Ray { fall: Fall::Endless, direction, from: x.to_vec() })
    }

    /// How the objective falls along places that lead outwards from one point, ten times as far each; `inward` leads back from it.
    /// `None` where it rises, is level on both ways, or a limit ends the way.
    fn fall(
        &self,
        from: &[f64],
        outward: impl Iterator<Item = Vec<f64>>,
        inward: impl Iterator<Item = Vec<f64>>,
    ) -> Option<Fall> {
        let Place::At(base) = self.place(from) else { return None };
        let mut heights = vec![base];
        for x in outward {
            let last = heights[heights.len() - 1];
            match self.place(&x) {
                Place::At(height) if height.value <= last.value + last.noise + height.noise => heights.push(height),
                // What rounding makes of a value is more than all it has fallen by: such a place tells nothing.
                Place::At(height) if height.noise > base.value - last.value && heights.len() > ENOUGH => break,
                Place::Void if heights.len() > ENOUGH => break,
                _ => return None,
            }
        }
        if !self.is_bounded && is_endless(&heights) {
            return Some(Fall::Endless);
        }
        // Of the lowest place of all, far out, rounding may tell nothing.
        let falls = heights.iter().any(|height| base.value - height.value > base.noise + height.noise);
        // Level along a half-line and no constant: it nears an asymptote.
        let rises_back = || inward.map_while(|x| self.at(&x)).any(|height| height.rises_above(base));
        (falls || rises_back()).then_some(Fall::Settling)
    }

    /// Whether x is so far out that the rounding of a row's terms is more than a share of the limit it is held to: numbers end.
    fn has_lost_limits(&self, x: &[f64]) -> bool {
        let meta = self.meta();
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        if self.model.jacobian(x, &mut jacobian).is_err() {
            return true;
        }
        let terms =
            |i: usize| meta.jacobian.range(i).map(|at| (jacobian[at] * x[meta.jacobian.columns[at] as usize]).abs()).sum::<f64>();
        let limits = |i: usize| [meta.row_lower[i], meta.row_upper[i]].map(f64::abs);
        let is_lost =
            |i: usize| limits(i).iter().any(|&limit| limit > 0.0 && limit.is_finite() && ROUNDINGS * terms(i) > LOST * limit);
        (0..meta.rows()).any(is_lost)
    }

    fn at(&self, x: &[f64]) -> Option<Height> {
        match self.place(x) {
            Place::At(height) => Some(height),
            _ => None,
        }
    }

    /// The place itself, or the nearest that meets every limit.
    fn place(&self, x: &[f64]) -> Place {
        let meta = self.meta();
        let is_inside = x.iter().zip(meta.lower.iter().zip(&meta.upper)).all(|(x, (lower, upper))| x >= lower && x <= upper);
        let mut rows = vec![0.0; meta.rows()];
        let value = |x: &[f64]| self.model.objective(x).ok().filter(|value| value.is_finite());
        if x.iter().any(|x| !x.is_finite()) || value(x).is_none() || self.model.constraints(x, &mut rows).is_err() {
            return Place::Void;
        }
        if !is_inside {
            return Place::Barred;
        }
        let Some(x) = (self.nearest)(x) else {
            return if self.has_lost_limits(x) { Place::Void } else { Place::Barred };
        };
        let Some(here) = value(&x) else { return Place::Void };
        let noise = last_digits(self.model.meta(), &x, |there| Some((value(there)? - here).abs()));
        Place::At(Height { value: here, noise: noise + ROUNDINGS * here.abs() })
    }

    /// Without noise and without components towards a bound; `None` where nothing is left. Its largest entry, relative to the
    /// point it sets out from, is 1: shorter steps would show the tangent only.
    fn cleaned(&self, direction: &[f64], from: &[f64]) -> Option<Vec<f64>> {
        let meta = self.meta();
        let unit = |j: usize| size(self.start[j]).min(f64::MAX).max(from[j].abs());
        let open = |j: usize, v: f64| if v > 0.0 { meta.upper[j] == f64::INFINITY } else { meta.lower[j] == f64::NEG_INFINITY };
        let kept: Vec<f64> = direction.iter().enumerate().map(|(j, &v)| if open(j, v) { v } else { 0.0 }).collect();
        let largest = kept.iter().enumerate().fold(0.0, |most: f64, (j, v)| most.max(v.abs() / unit(j)));
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        let share = |(j, v): (usize, &f64)| if v.abs() / unit(j) >= NOISE * largest { v / largest } else { 0.0 };
        Some(kept.iter().enumerate().map(share).collect())
    }
}

/// Whether a variable has gone more than so many of its sizes from where it starts.
pub fn is_farther(x: f64, start: f64, sizes: f64) -> bool {
    (x - start).abs() > sizes * size(start)
}

/// The size of a variable that starts here.
pub fn size(start: f64) -> f64 {
    if start == 0.0 { 1.0 } else { start.abs() }
}
