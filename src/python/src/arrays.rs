//! Array-likes as numbers, and numbers as arrays.

use std::panic::{AssertUnwindSafe, catch_unwind};

use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods as _, PyReadonlyArrayDyn, PyUntypedArrayMethods as _};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// A refusal of an argument.
pub(crate) fn refused(argument: &str, reason: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(format!("{argument}: {reason}"))
}

/// Runs work without the interpreter's lock. A panic, which would be a defect, becomes an exception.
pub(crate) fn apart<T: Send>(py: Python<'_>, work: impl Send + FnOnce() -> T) -> PyResult<T> {
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    done.map_err(|_| PyRuntimeError::new_err("a defect of the program: please report it with the arguments"))
}

/// Numbers of an array-like in C order, read in place where they lie so already.
pub(crate) fn numbers<'py, T: Element>(
    argument: &str,
    given: &Bound<'py, PyAny>,
) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let py = given.py();
    let wrong = || refused(argument, "expected an array of real numbers");
    let numpy = py.import("numpy")?;
    let kind = || numpy.call_method1("asarray", (given,))?.getattr("dtype")?.getattr("kind")?.extract::<char>();
    if !kind().is_ok_and(|kind| "fiu".contains(kind)) {
        return Err(wrong());
    }
    let array = numpy.call_method1("require", (given, T::get_dtype(py), ["C", "A", "E"])).map_err(|_| wrong())?;
    let array = array.cast_into::<PyArrayDyn<T>>().map_err(|_| wrong())?;
    array.try_readonly().map_err(|error| refused(argument, error))
}

/// Refuses numbers that are not finite.
pub(crate) fn all_finite(argument: &str, values: &[f64]) -> PyResult<()> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(refused(argument, format!("{value} is not a finite number"))),
        None => Ok(()),
    }
}

/// Numbers with a last axis of a length, and the shape of what stands before it.
pub(crate) fn coordinates<'py>(
    argument: &str,
    given: &Bound<'py, PyAny>,
    length: usize,
) -> PyResult<(PyReadonlyArrayDyn<'py, f64>, Vec<usize>)> {
    let array = numbers::<f64>(argument, given)?;
    match array.shape().split_last() {
        Some((&last, before)) if last == length => {
            let before = before.to_vec();
            all_finite(argument, slice(&array))?;
            Ok((array, before))
        }
        _ => Err(refused(argument, format!("expected shape (…, {length}), found {}", shape_text(array.shape())))),
    }
}

/// The numbers of an array that [`numbers`] made.
pub(crate) fn slice<'a, T: Element>(array: &'a PyReadonlyArrayDyn<'_, T>) -> &'a [T] {
    array.as_slice().expect("the array is contiguous")
}

/// A shape as Python writes it.
pub(crate) fn shape_text(shape: &[usize]) -> String {
    match shape {
        [only] => format!("({only},)"),
        _ => format!("({})", shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// An array of a shape from its numbers in C order.
pub(crate) fn array<T: Element>(py: Python<'_>, numbers: Vec<T>, shape: Vec<usize>) -> PyResult<Bound<'_, PyAny>> {
    Ok(PyArray1::from_vec(py, numbers).reshape(shape)?.into_any())
}

/// An array to be written, in pages as large as the system has them.
pub(crate) fn empty<T: Element>(py: Python<'_>, shape: Vec<usize>) -> PyResult<Bound<'_, PyArrayDyn<T>>> {
    let made = py.import("numpy")?.call_method1("empty", (shape, T::get_dtype(py)))?;
    Ok(made.cast_into::<PyArrayDyn<T>>()?)
}
