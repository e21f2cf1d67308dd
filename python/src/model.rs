//! Values and derivatives of a problem, over buffers.

use std::sync::Arc;

use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use ribopt::model::{Curvature, EvaluationError, Meta, Pattern};
use ribopt::run::Subject;

use super::failure::no_value;
use super::numbers::{floats, integers, taken};

/// Row and column of every entry, as bytes of `int64`.
type Places<'py> = (Bound<'py, PyBytes>, Bound<'py, PyBytes>);

/// Lower and upper limits of variables and of rows, and the start.
type Limits<'py> = [Bound<'py, PyBytes>; 5];

/// A problem as functions of a point, to be minimised.
#[pyclass(frozen, module = "ribopt._native")]
pub struct Model {
    subject: Arc<Subject>,
    /// With auxiliary variables in the place of kinks, and states beside the design of large structures.
    restated: bool,
    /// Where the Hessian's lower triangle can be non-zero.
    hessian: Pattern,
}

impl Model {
    pub fn new(subject: Arc<Subject>, restated: bool) -> Model {
        let mut model = Model { subject, restated, hessian: Pattern::default() };
        let meta = model.inner().meta();
        model.hessian = match meta.curvature {
            Curvature::Exact => meta.hessian.clone(),
            // Any entry may be: they are had as products with the axes.
            Curvature::Product => lower_triangle(meta.variables()),
            Curvature::None => Pattern::default(),
        };
        model
    }

    fn inner(&self) -> &dyn ribopt::model::Model {
        if self.restated { self.subject.model() } else { self.subject.shown() }
    }

    fn meta(&self) -> &Meta {
        self.inner().meta()
    }

    /// Computes `length` numbers at x without the interpreter's lock and copies them to `out`.
    fn fill(
        &self,
        py: Python<'_>,
        (x, out): (&PyBuffer<f64>, &PyBuffer<f64>),
        length: usize,
        compute: impl FnOnce(&[f64], &mut [f64]) -> Result<(), EvaluationError> + Send,
    ) -> PyResult<()> {
        let x = taken(py, "x", x, self.meta().variables())?;
        let mut values = vec![0.0; length];
        py.detach(|| compute(&x, &mut values)).map_err(|error| no_value(py, &error))?;
        out.copy_from_slice(py, &values)
    }

    fn check_curvature(&self) -> PyResult<()> {
        match self.meta().curvature {
            Curvature::None => Err(PyValueError::new_err("this model has no second derivatives")),
            _ => Ok(()),
        }
    }

    fn hessian_entries(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        if self.meta().curvature == Curvature::Exact {
            return self.inner().hessian(x, weight, y, values);
        }
        let (mut at, mut axis, mut product) = (self.inner().at(x)?, vec![0.0; x.len()], vec![0.0; x.len()]);
        for j in 0..x.len() {
            axis[j] = 1.0;
            at.hessian_product(weight, y, &axis, &mut product)?;
            axis[j] = 0.0;
            for i in j..x.len() {
                values[i * (i + 1) / 2 + j] = product[i];
            }
        }
        Ok(())
    }
}

fn lower_triangle(n: usize) -> Pattern {
    let mut positions: Vec<(u32, u32)> = (0..n as u32).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
    Pattern::from_positions(n, &mut positions)
}

#[pymethods]
impl Model {
    fn names(&self) -> (Vec<String>, Vec<String>) {
        let (model, meta) = (self.inner(), self.meta());
        ((0..meta.variables()).map(|j| model.variable_name(j)).collect(), (0..meta.rows()).map(|i| model.row_name(i)).collect())
    }

    fn limits<'py>(&self, py: Python<'py>) -> Limits<'py> {
        let Meta { lower, upper, row_lower, row_upper, start, .. } = self.meta();
        [lower, upper, row_lower, row_upper, start].map(|numbers| floats(py, numbers))
    }

    fn linear(&self) -> (bool, Vec<bool>) {
        let meta = self.meta();
        (meta.objective_is_linear, (0..meta.rows()).map(|i| meta.is_row_linear(i)).collect())
    }

    fn jacobian_structure<'py>(&self, py: Python<'py>) -> Places<'py> {
        places(py, &self.meta().jacobian)
    }

    fn hessian_structure<'py>(&self, py: Python<'py>) -> PyResult<Places<'py>> {
        self.check_curvature()?;
        Ok(places(py, &self.hessian))
    }

    fn objective(&self, py: Python<'_>, x: PyBuffer<f64>) -> PyResult<f64> {
        let x = taken(py, "x", &x, self.meta().variables())?;
        py.detach(|| self.inner().objective(&x)).map_err(|error| no_value(py, &error))
    }

    fn gradient(&self, py: Python<'_>, x: PyBuffer<f64>, out: PyBuffer<f64>) -> PyResult<()> {
        self.fill(py, (&x, &out), self.meta().variables(), |x, out| self.inner().gradient(x, out).map(drop))
    }

    fn constraints(&self, py: Python<'_>, x: PyBuffer<f64>, out: PyBuffer<f64>) -> PyResult<()> {
        self.fill(py, (&x, &out), self.meta().rows(), |x, out| self.inner().constraints(x, out))
    }

    fn jacobian(&self, py: Python<'_>, x: PyBuffer<f64>, out: PyBuffer<f64>) -> PyResult<()> {
        self.fill(py, (&x, &out), self.meta().jacobian.len(), |x, out| self.inner().jacobian(x, out))
    }

    fn hessian(
        &self,
        py: Python<'_>,
        x: PyBuffer<f64>,
        multipliers: PyBuffer<f64>,
        weight: f64,
        out: PyBuffer<f64>,
    ) -> PyResult<()> {
        self.check_curvature()?;
        let y = taken(py, "the multipliers", &multipliers, self.meta().rows())?;
        self.fill(py, (&x, &out), self.hessian.len(), |x, out| self.hessian_entries(x, weight, &y, out))
    }

    fn hessian_product(
        &self,
        py: Python<'_>,
        x: PyBuffer<f64>,
        multipliers: PyBuffer<f64>,
        weight: f64,
        direction: PyBuffer<f64>,
        out: PyBuffer<f64>,
    ) -> PyResult<()> {
        self.check_curvature()?;
        let n = self.meta().variables();
        let y = taken(py, "the multipliers", &multipliers, self.meta().rows())?;
        let direction = taken(py, "the direction", &direction, n)?;
        self.fill(py, (&x, &out), n, |x, out| self.inner().hessian_product(x, weight, &y, &direction, out))
    }
}

fn places<'py>(py: Python<'py>, pattern: &Pattern) -> Places<'py> {
    (integers(py, pattern.iter().map(|(row, _)| row)), integers(py, pattern.iter().map(|(_, column)| column)))
}
