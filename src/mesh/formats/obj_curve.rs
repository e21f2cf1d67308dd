//! Free-form curves of OBJ (`cstype`, `deg`, `curv`, `parm`, `end`) as polylines; Rhino writes lines this way.

use super::point;
use crate::mesh::Vector;
use crate::mesh::defects::diagonal;
use crate::splines::{BSplineCurve, KnotVector};

/// Chords per span of the knots, for curves of a degree above 1: a quarter circle given as one span is met to 2·10⁻³ of its radius.
const CHORDS: u32 = 8;

/// What has been said about the curve so far.
#[derive(Default)]
pub(super) struct Curve {
    pub degree: usize,
    /// Its control points' vertices; empty: no curve is begun.
    pub controls: Vec<u32>,
    /// The part of the parameter's range that is used.
    pub range: [f64; 2],
    knots: Vec<f64>,
    basis: Basis,
    rational: bool,
}

#[derive(Default, Clone, Copy, PartialEq, Eq)]
enum Basis {
    #[default]
    BSpline,
    Bezier,
    Other,
}

impl Curve {
    /// After `cstype`.
    pub fn of_type<'a>(words: impl Iterator<Item = &'a str>) -> Self {
        let mut curve = Curve { degree: 1, ..Default::default() };
        for word in words {
            match word {
                "rat" => curve.rational = true,
                "bspline" => curve.basis = Basis::BSpline,
                "bezier" => curve.basis = Basis::Bezier,
                _ => curve.basis = Basis::Other,
            }
        }
        curve
    }

    /// After `parm`: `u` and the knots.
    pub fn parameters<'a>(&mut self, mut words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        if words.next() == Some("u") {
            let number = |word: &str| word.parse().map_err(|_| format!("expected a knot, found '{word}'"));
            self.knots = words.map(number).collect::<Result<_, _>>()?;
        }
        Ok(())
    }

    /// The vertices of the polyline, new ones appended to `vertices`; `None` for a basis that is not read. A curve of degree 1
    /// runs over its control points; others are divided, and end in their first and last control point where they meet them.
    pub fn polyline(&self, vertices: &mut Vec<Vector>, weight: impl Fn(u32) -> f64) -> Result<Option<Vec<u32>>, String> {
        if self.controls.len() < 2 {
            return Err("a curve needs at least two control points".into());
        }
        if self.basis == Basis::Other {
            return Ok(None);
        }
        if self.degree >= self.controls.len() {
            return Err(format!("a curve of degree {} needs more than {} control points", self.degree, self.controls.len()));
        }
        if self.degree <= 1 {
            return Ok(Some(self.controls.clone()));
        }
        let knots = match self.basis {
            Basis::Bezier => self.bezier_knots(),
            _ => self.knots.clone(),
        };
        let weight = |v: u32| if self.rational { weight(v) } else { 1.0 };
        let controls = self.controls.iter().map(|&v| {
            let (p, w) = (vertices[v as usize], weight(v));
            [p.x * w, p.y * w, p.z * w, w]
        });
        let knots = KnotVector::new(self.degree, knots).map_err(|cause| cause.to_string())?;
        let curve = BSplineCurve::new(knots.clone(), controls.collect()).map_err(|cause| cause.to_string())?;
        let range = if self.basis == Basis::Bezier { knots.domain().into() } else { self.range };
        self.divide(&curve, range, vertices).map(Some)
    }

    /// Bézier pieces as one B-spline: inner knots stand `degree` times.
    fn bezier_knots(&self) -> Vec<f64> {
        let pieces = (self.controls.len() - 1) / self.degree;
        let inner = (0..=pieces).flat_map(|k| std::iter::repeat_n(k as f64, self.degree));
        std::iter::once(0.0).chain(inner).chain([pieces as f64]).collect()
    }

    fn divide(&self, curve: &BSplineCurve<4>, range: [f64; 2], vertices: &mut Vec<Vector>) -> Result<Vec<u32>, String> {
        let (low, high) = curve.knots().domain();
        let (low, high) = (low.max(range[0].min(range[1])), high.min(range[0].max(range[1])));
        if low.is_nan() || low >= high {
            return Err("the curve's parameters leave nothing of it".into());
        }
        let mut breaks: Vec<f64> = curve.knots().knots().iter().copied().filter(|&t| t > low && t < high).collect();
        breaks.insert(0, low);
        breaks.push(high);
        breaks.dedup();
        let mut at: Vec<f64> = breaks
            .windows(2)
            .flat_map(|pair| (0..CHORDS).map(move |k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / f64::from(CHORDS)))
            .collect();
        at.push(high);
        let place = |t: f64| {
            let [x, y, z, w] = curve.evaluate(t).map_err(|cause| cause.to_string())?;
            point(x / w, y / w, z / w)
        };
        let points = at.into_iter().map(place).collect::<Result<Vec<Vector>, String>>()?;
        let ends = [self.controls[0], self.controls[self.controls.len() - 1]];
        let (last, rounding) = (points.len() - 1, 1e-9 * diagonal(&points));
        let mut line = Vec::with_capacity(points.len());
        for (k, p) in points.into_iter().enumerate() {
            let end = ends[usize::from(k == last)];
            if (k == 0 || k == last) && (p - vertices[end as usize]).norm() <= rounding {
                line.push(end);
            } else {
                vertices.push(p);
                line.push(vertices.len() as u32 - 1);
            }
        }
        Ok(line)
    }
}
