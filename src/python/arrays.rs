//! Arrays of NumPy.

use crate::errors::refused;
use numpy::ndarray::{Array, Dimension, IntoDimension};
use numpy::{AllowTypeChange, Element, IntoPyArray, PyArray, PyArrayLikeDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// Numbers of any shape, as an array or as lists.
pub(crate) type Doubles<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// A whole number, or one for each of several states.
#[derive(FromPyObject)]
pub(crate) enum Whole {
    One(u64),
    Many(Vec<u64>),
}

impl Whole {
    /// The numbers of so many states.
    ///
    /// # Errors
    /// If there are others.
    pub(crate) fn of(self, name: &str, count: usize) -> PyResult<Vec<u64>> {
        match self {
            Self::One(number) => Ok(vec![number; count]),
            Self::Many(numbers) if numbers.len() == count => Ok(numbers),
            Self::Many(numbers) => Err(refused(format!(
                "{name}: found {} numbers; expected one, or {count}, one for each state",
                numbers.len()
            ))),
        }
    }
}

/// States: `(n,)` for one, `(m, n)` for several; whether there is one alone, and the numbers one after the other.
///
/// # Errors
/// If it has another shape.
pub(crate) fn states(name: &str, x: &Doubles<'_>, n: usize) -> PyResult<(bool, Vec<f64>)> {
    let shape = x.shape();
    if !matches!(shape.len(), 1 | 2) || shape.last() != Some(&n) {
        return Err(refused(format!(
            "{name}: found an array of shape {shape:?}; expected [{n}], or [m, {n}] for m states"
        )));
    }
    Ok((shape.len() == 1, x.as_array().iter().copied().collect()))
}

/// An array of a shape, row by row.
///
/// # Errors
/// If there are not as many numbers: a mistake in this program.
pub(crate) fn array<'py, T: Element, D: IntoDimension>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: D,
) -> PyResult<Bound<'py, PyArray<T, D::Dim>>>
where
    D::Dim: Dimension,
{
    let array = Array::from_shape_vec(shape.into_dimension(), numbers);
    array.map(|array| array.into_pyarray(py)).map_err(refused)
}

/// A list of numbers.
///
/// # Errors
/// If it has another shape.
pub(crate) fn list(name: &str, numbers: &Doubles<'_>) -> PyResult<Vec<f64>> {
    if numbers.shape().len() != 1 {
        let shape = numbers.shape();
        return Err(refused(format!("{name}: found an array of shape {shape:?}; expected one dimension")));
    }
    Ok(numbers.as_array().iter().copied().collect())
}

/// A list of whole numbers of 32 bits.
///
/// # Errors
/// If there are others.
pub(crate) fn whole(name: &str, numbers: &Doubles<'_>) -> PyResult<Vec<u32>> {
    let whole = |x: f64| {
        let number = x as u32;
        if f64::from(number) == x {
            return Ok(number);
        }
        Err(refused(format!("{name}: found {x}; expected whole numbers from 0 to {}", u32::MAX)))
    };
    list(name, numbers)?.into_iter().map(whole).collect()
}
