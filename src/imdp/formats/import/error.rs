//! What can be wrong with the files of a model, and where.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::files::is_fault_of_input;
use crate::formats::native::NativeError;
use crate::model::{ImdpError, MemoryError, RewardError, StateId};

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Position {
    /// The file.
    pub path: PathBuf,
    /// Where in it.
    pub place: Place,
}

/// Where something is in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a text; lines and columns count from 1, columns in bytes.
    Text {
        /// The line.
        line: u64,
        /// The column.
        column: u32,
    },
    /// In a member of an archive.
    Member {
        /// The name of the member.
        name: String,
        /// The entry, from 0; none if the member as a whole is meant.
        entry: Option<u64>,
    },
}

impl Position {
    /// A place in a text file.
    pub(crate) fn text(path: &Path, line: u64, column: u32) -> Self {
        Self { path: path.to_owned(), place: Place::Text { line, column } }
    }

    /// A place in an archive.
    pub(crate) fn member(path: &Path, name: &str, entry: Option<u64>) -> Self {
        Self { path: path.to_owned(), place: Place::Member { name: name.to_owned(), entry } }
    }

    /// Whether this is a later line of a text.
    pub(in crate::formats) fn is_after(&self, other: &Self) -> bool {
        match (&self.place, &other.place) {
            (Place::Text { line, .. }, Place::Text { line: earlier, .. }) => line > earlier,
            _ => false,
        }
    }

    /// The error of finding one thing here where another should be.
    pub(crate) fn refuse(self, expected: impl Into<String>, found: impl Into<String>) -> ImportError {
        ImportError::Refused { at: self, expected: expected.into(), found: found.into() }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.path.display())?;
        match &self.place {
            Place::Text { line, column } => write!(f, "{line}:{column}"),
            Place::Member { name, entry: None } => write!(f, "{name}"),
            Place::Member { name, entry: Some(entry) } => write!(f, "{name}[{entry}]"),
        }
    }
}

/// Why the files of a model were refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// A file cannot be opened or read.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A compressed file is damaged.
    #[error("{}: found what cannot be decompressed: {problem}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// The content is not what the format wants.
    #[error("{at}: found {found}; expected {expected}")]
    Refused {
        /// Where.
        at: Position,
        /// What should be there.
        expected: String,
        /// What is there.
        found: String,
    },
    /// A file of the native format is not as it should be.
    #[error("{}: {error}", path.display())]
    Native {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: NativeError,
    },
    /// The model does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The parts do not make an interval MDP.
    #[error("the files do not describe an interval MDP: {0}")]
    Model(#[from] ImdpError),
    /// The rewards are not those of the model.
    #[error("the files do not describe rewards of the model: {0}")]
    Rewards(#[from] RewardError),
}

impl ImportError {
    /// Whether the system failed, and not the file.
    pub fn is_io(&self) -> bool {
        match self {
            Self::Io { source, .. } | Self::Native { error: NativeError::Io(source), .. } => {
                !is_fault_of_input(source)
            }
            _ => false,
        }
    }

    /// Wraps an error of the system about a file.
    pub(crate) fn io(path: &Path, source: std::io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }
}

/// What was accepted although it deserves a look.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Warning {
    /// Lower bounds that sum to more than 1, or upper bounds that sum to less, by at most 1e-9.
    ///
    /// They were widened outwards until a distribution fits: every distribution that was meant is kept.
    Widened {
        /// How many choices.
        count: u64,
        /// The first of them.
        first: Position,
    },
    /// States without any choice, treated as absorbing.
    Deadlocks {
        /// How many states.
        count: u64,
        /// The first of them.
        first: StateId,
    },
    /// There is no label file: state 0 is the initial one, as it is for PRISM.
    NoLabelFile {
        /// Where it was looked for.
        path: PathBuf,
    },
    /// There is no specification: no state has a label.
    NoSpecification {
        /// Where it was looked for.
        path: PathBuf,
    },
    /// The format names no initial state: it is state 0.
    NoInitialState {
        /// The file.
        path: PathBuf,
    },
    /// The file is laid out in another way than PRISM lays out its own, which changes nothing.
    Layout {
        /// The first place where it is.
        first: Position,
    },
    /// Something that no property can ask about was passed over.
    Ignored {
        /// The file.
        path: PathBuf,
        /// What it was.
        what: String,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Widened { count, first } => write!(
                f,
                "{count} choice(s) admit no distribution by at most 1e-9 and were widened, the first at {first}"
            ),
            Self::Deadlocks { count, first } => {
                write!(
                    f,
                    "{count} state(s) have no choice and are treated as absorbing, the first is {first}"
                )
            }
            Self::NoLabelFile { path } => {
                write!(f, "there is no {}: the initial state is 0, and no state has a label", path.display())
            }
            Self::NoSpecification { path } => write!(
                f,
                "there is no {}: no state has a label; ask for states by their numbers from 0, as in F x=206",
                path.display()
            ),
            Self::NoInitialState { path } => {
                write!(f, "{}: the format names no initial state: it is 0", path.display())
            }
            Self::Layout { first } => {
                write!(
                    f,
                    "{first}: not laid out as PRISM does it (blanks, order, names or numbers), read all the same"
                )
            }
            Self::Ignored { path, what } => write!(f, "{}: {what} is not read", path.display()),
        }
    }
}

/// A refusal within one file, or within one chunk of it: lines count from the start of that part.
#[derive(Debug)]
pub(crate) struct Fault {
    /// The line, from 0.
    pub line: u64,
    /// The column, from 1.
    pub column: u32,
    /// What should be there.
    pub expected: String,
    /// What is there.
    pub found: String,
}

impl Fault {
    /// A boxed fault, so that results stay small.
    pub(crate) fn new(
        line: u64,
        column: usize,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> Box<Self> {
        Box::new(Self { line, column: column as u32, expected: expected.into(), found: found.into() })
    }

    /// The error, for a fault in a part of `path` that starts after `lines_before` lines.
    pub(crate) fn in_file(self, path: &Path, lines_before: u64) -> ImportError {
        Position::text(path, lines_before + self.line + 1, self.column).refuse(self.expected, self.found)
    }
}
