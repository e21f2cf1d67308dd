//! The native half of the Python package `ribopt`: it hands over numbers as buffers and everything else as the JSON that the
//! command line prints. What these mean is said once, there; the Python half gives them names.
//!
//! | file | subject |
//! |---|---|
//! | `problem` | a problem read, solved, verified, analysed |
//! | `study` | many runs of one problem |
//! | `model` | values and derivatives over buffers |
//! | `mesh` | meshes over buffers |
//! | `watch` | Ctrl-C and iterations of a run that goes on without the interpreter's lock |
//! | `failure` | what goes wrong, as Python's exceptions |
//! | `numbers` | buffers in, bytes out |

mod failure;
mod mesh;
mod model;
mod numbers;
mod problem;
mod study;
mod watch;

use pyo3::pymodule;

#[pymodule]
mod _native {
    use std::ffi::OsString;

    use pyo3::prelude::*;

    #[pymodule_export]
    use super::mesh::{
        mesh_check, mesh_closest, mesh_hausdorff, mesh_new, mesh_read, mesh_reconstruct, mesh_section, mesh_slice, mesh_smooth,
        mesh_trace, mesh_weld, mesh_write,
    };
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::study::sweep;

    /// Runs the command line with these arguments, the program's name first; its exit code.
    #[pyfunction]
    fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
        py.detach(|| ribopt::cli::run(arguments))
    }

    /// What a kind of mistake means, by the code told with it; all kinds without one.
    #[pyfunction]
    #[pyo3(signature = (code = None))]
    fn explain(code: Option<&str>) -> PyResult<String> {
        ribopt::input::explain(code).map_err(pyo3::exceptions::PyKeyError::new_err)
    }

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
