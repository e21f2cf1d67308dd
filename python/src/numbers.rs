//! Numbers between the two halves: contiguous buffers in, bytes out. The Python half makes arrays of them.

use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// The numbers of a buffer of this length.
pub fn taken(py: Python<'_>, what: &str, buffer: &PyBuffer<f64>, length: usize) -> PyResult<Vec<f64>> {
    let numbers = buffer.to_vec(py)?;
    match numbers.len() == length {
        true => Ok(numbers),
        false => Err(PyValueError::new_err(format!("{what} has {} numbers, and must have {length}", numbers.len()))),
    }
}

/// Numbers as the bytes of `float64`.
pub fn floats<'py>(py: Python<'py>, numbers: &[f64]) -> Bound<'py, PyBytes> {
    PyBytes::new(py, &numbers.iter().flat_map(|number| number.to_ne_bytes()).collect::<Vec<u8>>())
}

/// Numbers as the bytes of `int64`.
pub fn integers<'py>(py: Python<'py>, numbers: impl Iterator<Item = usize>) -> Bound<'py, PyBytes> {
    PyBytes::new(py, &numbers.flat_map(|number| (number as i64).to_ne_bytes()).collect::<Vec<u8>>())
}
