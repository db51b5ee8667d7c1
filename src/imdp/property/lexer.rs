//! A text as a list of words, numbers and symbols.

use std::fmt;

use super::parse_error::Span;

/// A word, number or symbol and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) kind: TokenKind<'a>,
    pub(super) span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TokenKind<'a> {
    /// An identifier or a keyword.
    Word(&'a str),
    /// An unsigned decimal.
    Number(&'a str),
    Symbol(&'static str),
    /// A character that PRISM does not know.
    Unknown(char),
    End,
}

/// Longer symbols first: the longest match counts.
const SYMBOLS: [&str; 31] = [
    "<=>", "=>", "!=", "<=", ">=", "<<", ">>", "->", "!", "&", "|", "=", "<", ">", "+", "-", "*", "/", "^",
    "(", ")", "[", "]", "{", "}", ":", ";", ",", "?", "\"", "'",
];

/// The tokens of a text, ended by [`TokenKind::End`]. Blanks and `//` comments separate tokens.
pub(super) fn tokens(source: &str) -> Vec<Token<'_>> {
    let mut tokens = vec![];
    let mut start = skip_blanks(source, 0);
    while let Some(first) = source[start..].chars().next() {
        let rest = &source[start..];
        let (kind, len) = next_token(rest, first);
        tokens.push(Token { kind, span: Span { start, end: start + len } });
        start = skip_blanks(source, start + len);
    }
    tokens.push(Token { kind: TokenKind::End, span: Span { start, end: start } });
    tokens
}

fn skip_blanks(source: &str, start: usize) -> usize {
    let mut rest = &source[start..];
    loop {
        rest = rest.trim_start_matches([' ', '\t', '\r', '\n', '\u{c}']);
        if !rest.starts_with("//") {
            return source.len() - rest.len();
        }
        rest = rest.find('\n').map_or("", |newline| &rest[newline..]);
    }
}

fn next_token(rest: &str, first: char) -> (TokenKind<'_>, usize) {
    if first.is_ascii_alphabetic() || first == '_' {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let len = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        return (TokenKind::Word(&rest[..len]), len);
    }
    let len = number_length(rest);
    if len > 0 {
        return (TokenKind::Number(&rest[..len]), len);
    }
    match SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol)) {
        Some(symbol) => (TokenKind::Symbol(symbol), symbol.len()),
        None => (TokenKind::Unknown(first), first.len_utf8()),
    }
}

/// The length of `12`, `0.5`, `.5` or `5e-1` at the start, 0 if there is no number.
fn number_length(text: &str) -> usize {
    let digits =
        |from: usize| text.as_bytes()[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let whole = digits(0);
    let mut len = whole;
    if text[len..].starts_with('.') {
        let fraction = digits(len + 1);
        if fraction > 0 {
            len += 1 + fraction;
        }
    }
    if len > 0 && text[len..].starts_with(['e', 'E']) {
        let sign = usize::from(text[len + 1..].starts_with(['+', '-']));
        let exponent = digits(len + 1 + sign);
        if exponent > 0 {
            len += 1 + sign + exponent;
        }
    }
    len
}

impl fmt::Display for TokenKind<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(text) | Self::Number(text) => write!(f, "`{text}`"),
            Self::Symbol(symbol) => write!(f, "`{symbol}`"),
            Self::Unknown(c) => write!(f, "`{}`", c.escape_debug()),
            Self::End => f.write_str("the end"),
        }
    }
}
