//! Where and why a text is not a property.

use std::fmt;

use super::ProbabilityError;

/// A text is not a property, or not one that is supported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError(Box<Inner>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Inner {
    position: TextPosition,
    excerpt: Excerpt,
    kind: ParseErrorKind,
}

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextPosition {
    /// Bytes before it.
    pub offset: usize,
    /// The line, from 1.
    pub line: usize,
    /// The character in its line, from 1.
    pub column: usize,
}

/// What is wrong at a place in a text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseErrorKind {
    /// Something else must stand here.
    #[error("found {found}; expected {expected}")]
    Unexpected {
        /// What can stand here.
        expected: String,
        /// What stands here.
        found: String,
    },
    /// PRISM knows this, but it is not supported here.
    #[error("found {what} (not supported); expected {instead}")]
    Unsupported {
        /// What it is called, with its verb.
        what: &'static str,
        /// What is supported.
        instead: &'static str,
    },
    /// The threshold is not a probability.
    #[error("found {found}; expected {error}")]
    Threshold {
        /// What is wrong with it.
        error: ProbabilityError,
        /// What was written.
        found: String,
    },
    /// A constant is declared, but has no value.
    #[error("found the constant {name}, which has no value; expected one, as in const {name} = VALUE;")]
    Undefined {
        /// The constant.
        name: String,
    },
    /// A function has too many or too few arguments.
    #[error(
        "found {found} arguments; expected two or more of min and max, two of mod and pow, one of floor, ceil and round"
    )]
    Arguments {
        /// How many there are.
        found: usize,
    },
    /// The last step comes before the first.
    #[error("found {found}, steps that end before they begin; expected the first before the last")]
    EmptyRange {
        /// First and last step.
        found: String,
    },
    /// The bound of an operator is not a number of steps.
    #[error("found {found}; expected a whole number of steps from {least} to 2147483647")]
    Steps {
        /// 0 for `<=`, 1 for `<`.
        least: u8,
        /// What was written.
        found: String,
    },
    /// An integer literal is too large for PRISM.
    #[error("found {found}; expected an integer of at most 2147483647")]
    Integer {
        /// What was written.
        found: String,
    },
    /// Operators or parentheses are nested too deeply.
    #[error(
        "found more than {limit} levels inside of each other; expected a simpler formula, or a label of the model for it"
    )]
    TooDeep {
        /// The number of levels allowed.
        limit: usize,
    },
    /// Two properties have the same name.
    #[error("found a second property named \"{name}\"; expected a name of its own for each")]
    DuplicateName {
        /// The name.
        name: String,
    },
}

/// The bytes `start..end` of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Span {
    /// From the start of this to the end of `last`.
    pub(super) fn to(self, last: Self) -> Self {
        Self { start: self.start, end: last.end }
    }
}

/// The line of an error, shortened, and what to underline in it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Excerpt {
    text: String,
    indent: usize,
    width: usize,
}

/// At most this many characters are shown on either side of an error.
const CONTEXT: usize = 60;

impl ParseError {
    pub(super) fn new(source: &str, span: Span, kind: ParseErrorKind) -> Self {
        let before = &source[..span.start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        let column = source[line_start..span.start].chars().count() + 1;
        let position = TextPosition { offset: span.start, line, column };
        Self(Box::new(Inner { position, excerpt: Excerpt::new(source, line_start, span), kind }))
    }

    /// Where it is.
    pub fn position(&self) -> TextPosition {
        self.0.position
    }

    /// What is wrong.
    pub fn kind(&self) -> &ParseErrorKind {
        &self.0.kind
    }
}

impl Excerpt {
    fn new(source: &str, line_start: usize, span: Span) -> Self {
        let line_end = source[span.start..].find(['\n', '\r']).map_or(source.len(), |end| span.start + end);
        let before: Vec<char> = source[line_start..span.start].chars().rev().take(CONTEXT).collect();
        let after = source[span.start..line_end].chars().take(CONTEXT);
        let width = source[span.start..span.end.min(line_end).max(span.start)].chars().count();
        // Control characters would move the caret, or worse.
        let text = before.iter().rev().copied().chain(after);
        let text = text.map(|c| if c.is_control() { ' ' } else { c }).collect();
        Self { text, indent: before.len(), width: width.clamp(1, CONTEXT) }
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Inner { position, excerpt, kind } = &*self.0;
        writeln!(f, "line {}, column {}: {kind}", position.line, position.column)?;
        writeln!(f, "  {}", excerpt.text)?;
        write!(f, "  {:indent$}{}", "", "^".repeat(excerpt.width), indent = excerpt.indent)
    }
}

impl std::error::Error for ParseError {}
