//! Why an engine gave no answer.

use std::path::PathBuf;

/// Why an engine gave no answer to a question. None of this is ever counted as agreement.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineFailure {
    /// The program cannot be started.
    #[error("{}: {error}; expected a program that can be started", command.display())]
    Start {
        /// The program.
        command: PathBuf,
        /// What the system said.
        error: std::io::Error,
    },
    /// It ended with an exit code that means failure.
    #[error("found that it ended with exit code {code}{}; expected an answer", quoted(said))]
    Exit {
        /// The exit code.
        code: i32,
        /// What it said.
        said: String,
    },
    /// Something killed it.
    #[error("found that it was killed by signal {signal}{}{}; expected an answer", if *signal == 9 { ", as the system does when memory runs out" } else { "" }, quoted(said))]
    Signal {
        /// The signal.
        signal: i32,
        /// What it said.
        said: String,
    },
    /// It took longer than it was given, and was ended.
    #[error(
        "found that it did not answer within {seconds} s and was ended; expected an answer by then; give it more time or a smaller model"
    )]
    Timeout {
        /// The time it was given.
        seconds: f64,
    },
    /// It took more memory than it was given, and was ended.
    #[error(
        "found that it used {used_mib} MiB of memory and was ended; expected at most the {given_mib} MiB given; give it more, or a smaller model"
    )]
    Memory {
        /// What it used.
        used_mib: u64,
        /// What it was given.
        given_mib: u64,
    },
    /// The user does not want to wait for it.
    #[error("interrupted")]
    Interrupted,
    /// It ended as if all were well, without the values.
    #[error("found that it ended without an answer{}; expected values", quoted(said))]
    NoAnswer {
        /// What it said.
        said: String,
    },
    /// The engine itself reports an error about the question.
    #[error("found an error of its own: {said}")]
    Refused {
        /// What it said.
        said: String,
    },
    /// It wrote something that is not a number.
    #[error("line {line} of its values: found \"{found}\"; expected a number")]
    NotANumber {
        /// The line, counted from 1.
        line: usize,
        /// What is there.
        found: String,
    },
    /// It wrote a number that is no probability.
    #[error("its value of state {state}: found {value}; expected a probability")]
    NotAProbability {
        /// The state.
        state: usize,
        /// The value.
        value: f64,
    },
    /// It wrote values of a model with another number of states.
    #[error("its values: found {found}; expected one for each of the {expected} states")]
    Length {
        /// How many values it wrote.
        found: usize,
        /// The number of states.
        expected: usize,
    },
    /// It wrote a strategy that does not fit the model.
    #[error("line {line} of its strategy: found \"{found}\"; expected {expected}")]
    Strategy {
        /// The line, counted from 1.
        line: usize,
        /// What is there.
        found: String,
        /// What would fit.
        expected: String,
    },
    /// The model cannot be handed to it.
    #[error("{}: {error}", path.display())]
    Files {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        error: std::io::Error,
    },
    /// The model cannot be expressed in the engine's format.
    #[error("found a model that cannot be handed to it: {reason}")]
    Unsuitable {
        /// Why.
        reason: String,
    },
}

/// An engine that is not there.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{engine}: {found}; expected {expected}\n  {remedy}")]
pub struct EngineMissing {
    /// The engine.
    pub engine: &'static str,
    /// Where it was looked for, and what was found.
    pub found: String,
    /// What would do.
    pub expected: &'static str,
    /// How to get it.
    pub remedy: &'static str,
}

fn quoted(said: &str) -> String {
    if said.is_empty() { " and said nothing".to_owned() } else { format!(" and said: {said}") }
}
