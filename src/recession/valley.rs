//! Following a valley outwards.

use super::floor::{Floor, back_to_rows, settle};
use super::height::{Fall, Height, is_endless, last_digits};
use super::parameters::height::ROUNDINGS;
use super::parameters::valley::{
    BACK, BESIDE, BISECTIONS, DECADE, DECADES, DOUBLINGS, ENOUGH, FIRST, HALVES, HALVINGS, LEFT_BEHIND,
};
use crate::model::{Meta, Model};

/// A stationary point and what is known about it.
pub struct Site<'a> {
    /// The model.
    pub model: &'a dyn Model,
    /// The point, length n.
    pub x: &'a [f64],
    /// The variables' sizes there, length n.
    pub sizes: &'a [f64],
    /// What is known of their sizes but for the point itself, infinite where nothing is.
    pub known: &'a [f64],
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

    /// The doublings that must go well before numbers may end: [`ENOUGH`] beyond what is known of the variable's size. A point that is out there
    /// already has only to be left behind.
    fn enough(&self, pivot: usize) -> i32 {
        let beyond = (self.x[pivot].abs() / self.known[pivot]).log2().max(0.0);
        (f64::from(ENOUGH) - beyond).max(f64::from(LEFT_BEHIND)) as i32
    }
}

/// The valley about a site.
pub struct Valley<'a> {
    site: Site<'a>,
    /// Rows that have a multiplier, with its limit: all of them, whether they are held or follow from others that are. A violation
    /// is paid for by the multipliers of all rows that have it.
    priced: Vec<(usize, f64)>,
}

/// Which variable is moved, its first step, and how the others go with it.
struct Lead {
    pivot: usize,
    step: f64,
    others: Vec<(usize, f64)>,
}

/// The variable that a direction moves most, in units of its size.
pub fn moves_most(direction: &[f64], sizes: &[f64]) -> Option<usize> {
    let share = |j: usize| (direction[j] / sizes[j]).abs();
    (0..direction.len()).max_by(|&a, &b| share(a).total_cmp(&share(b)))
}

impl Lead {
    /// `None` where nothing moves, or the variable that moves most has a bound ahead.
    fn new(site: &Site<'_>, direction: &[f64]) -> Option<Lead> {
        let pivot = moves_most(direction, site.sizes)?;
        let (way, meta) = (direction[pivot], site.meta());
        let open = if way > 0.0 { meta.upper[pivot] == f64::INFINITY } else { meta.lower[pivot] == f64::NEG_INFINITY };
        if !open || way == 0.0 || !way.is_finite() {
            return None;
        }
        let others = direction.iter().enumerate().filter(|&(j, v)| j != pivot && *v != 0.0).map(|(j, v)| (j, v / way));
        Some(Lead { pivot, step: way.signum() * FIRST * site.sizes[pivot], others: others.collect() })
    }
}

impl<'a> Valley<'a> {
    /// The valley about a site.
    pub fn new(site: Site<'a>) -> Self {
        let meta = site.meta();
        let limit = |(i, &y): (usize, &f64)| (i, if y > 0.0 { meta.row_upper[i] } else { meta.row_lower[i] });
        let priced = site.multipliers.iter().enumerate().filter(|(_, y)| **y != 0.0).map(limit);
        let priced = priced.filter(|(_, limit)| limit.is_finite()).collect();
        Valley { site, priced }
    }

    /// How the objective falls, going on for ever in this direction (length n; the variable that moves most is led, the others follow
    /// the floor): `None` unless it never rises, and falls: either on that way, or, where it is level to the last digit, on the way that leads here
    /// from the other side. (A function that is level along a half-line and rises on the other one is level for rounding alone: it
    /// nears an asymptote. One that is piecewise has its pieces as rows here, and is judged feasible or not.)
    pub fn runs_off(&self, direction: &[f64]) -> Option<Fall> {
        let lead = Lead::new(&self.site, direction)?;
        let start = Floor { x: self.site.x.to_vec(), multipliers: self.site.multipliers.to_vec() };
        let unmoved = self.height(&start)?;
        let (here, base) = self.place(&lead, self.site.x[lead.pivot], &start)?;
        if !self.is_beside(&here.x) && !self.leads_to(&here, base, unmoved) {
            return None;
        }
        let heights = self.outwards(&lead, here.clone(), base)?;
        let decades: Vec<Height> = heights.iter().rev().step_by(DECADE).rev().copied().collect();
        if is_endless(&decades) {
            return Some(Fall::Endless);
        }
        // Of the lowest place of all, far out, rounding may tell nothing.
        let falls = heights.iter().any(|height| base.value - height.value > base.noise + height.noise);
        (falls || self.rises_back(&lead, here, base)).then_some(Fall::Settling)
    }

    /// Whether the straight way from the point to a floor never rises, as far as it is feasible: Newton's steps may lead anywhere (from beside
    /// the tip of a cone, or where the objective does not bend up), and what falls from a floor beyond a rise says nothing of the point.
    fn leads_to(&self, floor: &Floor, height: Height, unmoved: Height) -> bool {
        let rises = |halving: i32| {
            let share = f64::from(-halving).exp2();
            let x: Vec<f64> = self.site.x.iter().zip(&floor.x).map(|(from, to)| from + share * (to - from)).collect();
            let there = Floor { x, multipliers: floor.multipliers.clone() };
            self.height(&there).is_none_or(|height| height.rises_above(unmoved)) && (self.site.is_feasible)(&there.x)
        };
        !height.rises_above(unmoved) && !HALVINGS.into_iter().any(rises)
    }

    /// Whether a place is where the point is, but for what its rows tolerate.
    fn is_beside(&self, x: &[f64]) -> bool {
        x.iter().zip(self.site.x).zip(self.site.sizes).all(|((there, here), size)| (there - here).abs() <= BESIDE * size)
    }

    /// The heights on the way outwards; `None` where the objective rises or a limit ends the way.
    fn outwards(&self, lead: &Lead, mut floor: Floor, base: Height) -> Option<Vec<Height>> {
        let (mut last, mut noise, origin) = (base, base.noise, floor.x[lead.pivot]);
        let (mut heights, enough) = (vec![base], self.site.enough(lead.pivot));
        for doubling in DOUBLINGS {
            let Some((settled, height)) = self.place(lead, origin + lead.step * f64::from(doubling).exp2(), &floor) else {
                if doubling >= enough { break } else { return None }
            };
            let drop = base.value - last.value;
            let level = |height: Height| last.noise.max(noise).max(height.noise) + noise.max(height.noise) + ROUNDINGS * drop;
            let rises = |height: Height| height.value > last.value + level(height);
            let (is_feasible, settled, height) = self.on_rows(lead, settled, height, &rises);
            // What is left of a fall of fifteen digits is rounding of the steps that lead there. Last digits may show none by chance
            // (√(x² + 1) − x is 0 or one last digit of x): farther out there is no less than has been seen.
            if !is_feasible || rises(height) {
                // So far from the start that what rounding makes of a value is more than all it has fallen by, a place tells nothing.
                let is_lost = height.noise > drop && doubling >= enough;
                if is_lost { break } else { return None }
            }
            noise = noise.max(height.noise);
            if height.value < last.value {
                last = height;
            }
            heights.push(height);
            floor = settled;
        }
        Some(heights)
    }

    /// Whether the objective rises, beyond rounding, on the way back: by growing steps, where numbers are large, in decades towards zero, or
    /// by halves towards where the variable comes from, and there. Where the model's values end on that way, the last place before is
    /// looked for.
    fn rises_back(&self, lead: &Lead, here: Floor, base: Height) -> bool {
        let (origin, start) = (here.x[lead.pivot], self.site.meta().start[lead.pivot]);
        let leads_from = |place: f64| (origin - place) * lead.step > 0.0;
        let steps = BACK.map(|doubling| origin - lead.step * f64::from(doubling).exp2());
        let decades = (1..DECADES).map(|decade| origin * 10f64.powi(-decade));
        let halves = (1..HALVES).map(|halving| start + (origin - start) * f64::from(-halving).exp2()).chain([start]);
        self.rises_along(lead, steps, &here, base)
            || (leads_from(0.0) && self.rises_along(lead, decades, &here, base))
            || (leads_from(start) && self.rises_along(lead, halves, &here, base))
    }

    fn rises_along(&self, lead: &Lead, ways: impl Iterator<Item = f64>, here: &Floor, base: Height) -> bool {
        let mut floor = here.clone();
        for target in ways {
            match self.place(lead, target, &floor) {
                Some((settled, height)) if height.rises_above(base) => return (self.site.is_feasible)(&settled.x),
                Some((settled, _)) => floor = settled,
                None => return self.rises_before(lead, target, floor, base),
            }
        }
        false
    }

    /// The same between a place that has a value and one that has none.
    fn rises_before(&self, lead: &Lead, mut without: f64, mut floor: Floor, base: Height) -> bool {
        for _ in 0..BISECTIONS {
            let target = 0.5 * (floor.x[lead.pivot] + without);
            match self.place(lead, target, &floor) {
                Some((settled, height)) if height.rises_above(base) => return (self.site.is_feasible)(&settled.x),
                Some((settled, _)) => floor = settled,
                None => without = target,
            }
        }
        false
    }

    /// The floor and its height where the pivot stands there, inside its bounds; the others begin where the direction leads them.
    fn place(&self, lead: &Lead, target: f64, from: &Floor) -> Option<(Floor, Height)> {
        let (meta, way) = (self.site.meta(), target - from.x[lead.pivot]);
        if target < meta.lower[lead.pivot] || target > meta.upper[lead.pivot] {
            return None;
        }
        let mut next = from.clone();
        for &(j, share) in &lead.others {
            next.x[j] = (next.x[j] + way * share).clamp(meta.lower[j], meta.upper[j]);
        }
        next.x[lead.pivot] = target;
        let floor = settle(&self.site, lead.pivot, next)?;
        let height = self.height(&floor)?;
        Some((floor, height))
    }

    /// Whether a place meets the limits; one that does not, or that is high because what the tolerance leaves of a row is paid for, is led
    /// back to the rows once more.
    fn on_rows(&self, lead: &Lead, place: Floor, height: Height, rises: &dyn Fn(Height) -> bool) -> (bool, Floor, Height) {
        let is_feasible = (self.site.is_feasible)(&place.x);
        if is_feasible && !rises(height) {
            return (true, place, height);
        }
        let back = back_to_rows(&self.site, lead.pivot, place.clone()).filter(|back| (self.site.is_feasible)(&back.x));
        match back.and_then(|back| self.height(&back).map(|height| (back, height))) {
            Some((back, lower)) if !is_feasible || lower.value < height.value => (true, back, lower),
            _ => (is_feasible, place, height),
        }
    }

    /// f + Σ|y_i|·violation_i over the rows with a multiplier, and what the last digits of x and of its terms make of it.
    fn height(&self, floor: &Floor) -> Option<Height> {
        let (objective, bought) = self.value(&floor.x)?;
        let change = |x: &[f64]| {
            let there = self.value(x)?;
            let rows: f64 = there.1.iter().zip(&bought).map(|(there, here)| (there - here).abs()).sum();
            Some((there.0 - objective).abs() + rows)
        };
        let noise = last_digits(self.site.model.meta(), &floor.x, change);
        let value = objective + bought.iter().map(|bought| bought.max(0.0)).sum::<f64>();
        Some(Height { value, noise: noise + ROUNDINGS * objective.abs() })
    }

    /// f, and y_i·(c_i − limit_i) row by row.
    fn value(&self, x: &[f64]) -> Option<(f64, Vec<f64>)> {
        let mut rows = vec![0.0; self.site.meta().rows()];
        self.site.model.constraints(x, &mut rows).ok()?;
        let bought = |&(i, limit): &(usize, f64)| self.site.multipliers[i] * (rows[i] - limit);
        Some((self.site.model.objective(x).ok()?, self.priced.iter().map(bought).collect()))
    }
}

#[cfg(test)]
mod tests;
