//! The Python module `dynabs._dynabs`: problems, solutions, controllers and interval MDPs as classes of Python.
//!
//! Nothing is decided here: documents are read, checked, abstracted and solved by the library; this translates arrays,
//! errors and Ctrl-C. What needs no library is in the Python sources below `dynabs/`. The doc comments of classes are their docstrings.

mod abstraction;
mod arrays;
mod controller;
mod errors;
mod imdp_model;
mod imdp_result;
mod problem;
mod run;
mod simulation;
mod solution;
mod work;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _dynabs {
    #[pymodule_export]
    use super::abstraction::Abstraction;
    #[pymodule_export]
    use super::controller::Controller;
    #[pymodule_export]
    use super::errors::Error;
    #[pymodule_export]
    use super::imdp_model::Model;
    #[pymodule_export]
    use super::imdp_result::{PropertyResult, verify};
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::run::open;
    #[pymodule_export]
    use super::solution::Solution;

    #[pymodule_init]
    fn init(module: &super::Bound<'_, super::PyModule>) -> super::PyResult<()> {
        use super::PyModuleMethods;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
