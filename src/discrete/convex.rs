//! Bounds for linear, geometric and convex problems: the certificate's rigorous bound of the problem within the extents of ranges, and
//! contradictions of its rows by Farkas' lemma.
//!
//! A size in logarithms is rounded as every number is: what is proved holds for sizes up to their last digit.

use std::sync::Arc;

use super::hull::Facet;
use super::{Bounded, Design, List, Range, Relaxation, Relaxed, Rest};
use crate::certificate::{Certifier, contradiction, lower_bound};
use crate::model::views::{Elastic, WithBounds};
use crate::model::{Model, Substitution};

/// Digits that the way back from logarithms may cost, in roundings.
const WAY_BACK: f64 = 8.0;

/// A problem of a class whose stationary points are global minima, with lists.
pub struct Convex<'a> {
    /// The user's problem: designs are judged in it.
    pub rest: Rest<'a>,
    /// The problem with all numbers between rows allowed: the user's variables first, perhaps with more rows.
    pub relaxed: &'a dyn Model,
    /// The variables in which it is convex, where these are not its own.
    pub substitution: Option<&'a dyn Substitution>,
    /// What the relaxed problem says of catalogues: within ranges these rows hold more closely.
    pub facets: Vec<FacetRow>,
}

/// A row of the convex model that is a facet of a list's rows.
pub struct FacetRow {
    /// The list.
    pub list: usize,
    /// The row's number.
    pub row: usize,
    /// The facet.
    pub facet: Facet,
    /// The list's rows in the numbers in which they have this facet: logarithms, or their own.
    pub points: Arc<Vec<Vec<f64>>>,
}

impl Convex<'_> {
    fn lists(&self) -> &[List] {
        self.rest.lists
    }

    /// The model that is convex.
    fn model(&self) -> &dyn Model {
        self.substitution.map_or(self.relaxed, |other| other.model())
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        self.substitution.map_or_else(|| x.to_vec(), |other| other.inward(x))
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        self.substitution.map_or_else(|| z.to_vec(), |other| other.outward(z))
    }

    /// The model within the extents of ranges.
    fn within(&self, ranges: &[Range]) -> WithBounds<'_> {
        let (mut lower, mut upper) = (self.relaxed.meta().lower.clone(), self.relaxed.meta().upper.clone());
        for (list, &range) in self.lists().iter().zip(ranges) {
            for (k, &j) in list.variables.iter().enumerate() {
                let (low, high) = list.extent(range, k);
                (lower[j], upper[j]) = (lower[j].max(low), upper[j].min(high));
            }
        }
        let mut inside = WithBounds::new(self.model(), self.inward(&lower), self.inward(&upper));
        for FacetRow { list, row, facet, points } in &self.facets {
            let range = ranges[*list];
            inside.limit(*row, facet.reach(points[range.first..=range.last].iter()));
        }
        inside
    }

    /// The best rigorous bound that multipliers at `z` give, in the user's objective.
    fn bound(&self, model: &dyn Model, judge: &Certifier<'_>, z: &[f64], multipliers: Option<&[f64]>) -> Option<f64> {
        let found = judge.row_multipliers(z).ok();
        let offers = found.as_deref().into_iter().chain(multipliers);
        let bound = offers.filter_map(|y| lower_bound(model, z, y).ok()?).reduce(f64::max)?;
        let Some(other) = self.substitution else { return Some(bound) };
        let outward = other.outward_objective(bound);
        Some(if outward == bound { bound } else { outward - WAY_BACK * f64::EPSILON * outward.abs() })
    }

    /// Whether the rows are proved to contradict one another: by the multipliers of their least violation.
    fn is_empty(&self, model: &dyn Model, z: &[f64]) -> bool {
        let tolerance = self.rest.settings.constraint_tolerance;
        let rows: Vec<usize> = (0..model.meta().rows()).collect();
        let Ok(elastic) = Elastic::new(model, rows, z, z) else { return false };
        let solution = self.rest.solve(&elastic, &elastic.meta().start);
        let judge = Certifier::new(&elastic, self.rest.class, self.rest.tolerances());
        let Ok(y) = judge.row_multipliers(&solution.x) else { return false };
        let at = elastic.original(&solution.x);
        let offers = [Some(y), solution.multipliers.clone()].into_iter().flatten();
        offers.into_iter().any(|y| contradiction(model, at, &y, true, tolerance).is_ok_and(|found| found.is_some()))
    }
}

impl Relaxation for Convex<'_> {
    fn relax(&self, ranges: &[Range], near: &[f64]) -> Bounded {
        if ranges.iter().all(|range| range.is_single()) && self.rest.is_nothing() {
            // Nothing is left to be chosen: the design is its own bound.
            let rows: Vec<usize> = ranges.iter().map(|range| range.first).collect();
            return match self.rest.design(&rows, near) {
                Some(design) => {
                    Bounded::Below(Relaxed { bound: design.objective, slopes: vec![0.0; design.x.len()], x: design.x })
                }
                None => Bounded::Empty,
            };
        }
        let model = self.within(ranges);
        let judge = Certifier::new(&model, self.rest.class, self.rest.tolerances());
        let solution = self.rest.solve(&model, &self.inward(near));
        let mut z = solution.x;
        model.meta().clamp(&mut z);
        let tolerance = self.rest.settings.constraint_tolerance;
        let meets = judge.primal_infeasibility(&z).is_some_and(|worst| worst <= tolerance);
        if !meets && self.is_empty(&model, &z) {
            return Bounded::Empty;
        }
        let Some(bound) = self.bound(&model, &judge, &z, solution.multipliers.as_deref()) else { return Bounded::Unknown };
        let x = self.outward(&z);
        let mut slopes = vec![0.0; x.len()];
        if self.relaxed.gradient(&x, &mut slopes).is_err() {
            slopes.fill(1.0);
        }
        Bounded::Below(Relaxed { bound, x, slopes })
    }

    fn design(&self, rows: &[usize], near: &[f64]) -> Option<Design> {
        // The relaxed problem may have more variables at its end.
        let mut x = near.to_vec();
        x.truncate(self.rest.model.meta().variables());
        self.rest.design(rows, &x)
    }
}
