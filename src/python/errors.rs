//! Errors of the library as exceptions.

use dynabs::Diagnostic;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::Display;

pyo3::create_exception!(
    dynabs,
    Error,
    PyValueError,
    "A mistake in what was given.\n\nAttributes: file, path (a JSON pointer, a line, or an argument), found, expected, remedy: \
     texts, or None where there is nothing to say."
);

/// The exception of a mistake at a known place.
pub(crate) fn mistake(error: &Diagnostic) -> PyErr {
    let text = |text: &String| Some(text.clone()).filter(|text| !text.is_empty());
    let exception = Error::new_err(error.to_string());
    described(
        exception,
        [
            text(&error.file),
            text(&error.place),
            text(&error.found),
            text(&error.expected),
            error.remedy.clone(),
        ],
    )
}

/// The exception of any error: messages say `place: found …; expected …`, and what to do on the lines below.
pub(crate) fn refused(error: impl Display) -> PyErr {
    let message = error.to_string();
    let (first, remedy) = message.split_once('\n').unwrap_or((&message, ""));
    let (place, said) = first.split_once("found ").unwrap_or(("", ""));
    let (found, expected) = said.split_once("; expected ").unwrap_or((said, ""));
    let text = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
    let parts = [None, text(place.trim_end_matches(": ")), text(found), text(expected), text(remedy)];
    described(Error::new_err(message.clone()), parts)
}

fn described(exception: PyErr, parts: [Option<String>; 5]) -> PyErr {
    let set = |py: Python<'_>| {
        let names = ["file", "path", "found", "expected", "remedy"];
        names.iter().zip(parts).try_for_each(|(name, part)| exception.value(py).setattr(*name, part))
    };
    match Python::attach(set) {
        Ok(()) => exception,
        Err(error) => error,
    }
}
