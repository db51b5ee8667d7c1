//! One error for all bad input: where, what was found, what is expected, what to do.

use std::fmt;

/// A mistake in what the user gave.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, as the user named it; empty if it is about none.
    pub file: String,
    /// Where in the file: a JSON pointer such as `/dynamics/A/0`, or a line and column.
    pub place: String,
    /// What was found there.
    pub found: String,
    /// What is expected there.
    pub expected: String,
    /// What the user can do about it, if that is not obvious.
    pub remedy: Option<String>,
}

impl Diagnostic {
    /// A mistake at `place`, in a file that is filled in by [`in_file`](Self::in_file).
    pub fn at(place: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            file: String::new(),
            place: place.into(),
            found: found.into(),
            expected: expected.into(),
            remedy: None,
        }
    }

    /// Adds what to do.
    pub fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }

    /// Says which file it is about, unless that is known already.
    pub fn in_file(mut self, file: &str) -> Self {
        if self.file.is_empty() {
            file.clone_into(&mut self.file);
        }
        self
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.file.is_empty() {
            write!(f, "{}: ", self.file)?;
        }
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        write!(f, "found {}; expected {}", self.found, self.expected)?;
        match &self.remedy {
            Some(remedy) => write!(f, "\n  {remedy}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Diagnostic {}
