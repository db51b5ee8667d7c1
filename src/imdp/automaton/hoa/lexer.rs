//! A file as a list of tokens.

use super::{HoaError, HoaErrorKind};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    /// `States:` without its colon.
    Item(String),
    Word(String),
    /// `@name` without the `@`.
    Alias(String),
    Integer(u64),
    Text(String),
    Symbol(char),
    /// `--BODY--` and its like, without the dashes.
    Mark(String),
    End,
}

impl std::fmt::Display for Token {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Item(name) => write!(f, "`{name}:`"),
            Self::Word(word) => write!(f, "`{word}`"),
            Self::Alias(name) => write!(f, "`@{name}`"),
            Self::Integer(value) => write!(f, "`{value}`"),
            Self::Text(text) => write!(f, "`\"{}\"`", text.escape_debug()),
            Self::Symbol(symbol) => write!(f, "`{}`", symbol.escape_debug()),
            Self::Mark(mark) => write!(f, "`--{mark}--`"),
            Self::End => f.write_str("the end of the file"),
        }
    }
}

/// Goes through the tokens of a file.
pub(super) struct Tokens<'a> {
    rest: &'a str,
    line: usize,
    next: Token,
    next_line: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Result<Self, HoaError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut tokens = Self { rest: text, line: 1, next: Token::End, next_line: 1 };
        tokens.advance()?;
        Ok(tokens)
    }

    pub(super) fn peek(&self) -> &Token {
        &self.next
    }

    /// Hands out the next token.
    pub(super) fn advance(&mut self) -> Result<Token, HoaError> {
        self.skip_blanks()?;
        self.next_line = self.line;
        let token = self.token()?;
        Ok(std::mem::replace(&mut self.next, token))
    }

    pub(super) fn accept(&mut self, symbol: char) -> Result<bool, HoaError> {
        let accepted = self.next == Token::Symbol(symbol);
        if accepted {
            self.advance()?;
        }
        Ok(accepted)
    }

    pub(super) fn expect(&mut self, symbol: char) -> Result<(), HoaError> {
        match self.accept(symbol)? {
            true => Ok(()),
            false => Err(self.unexpected(&format!("`{symbol}`"))),
        }
    }

    /// A number below a limit.
    pub(super) fn integer(&mut self, what: &'static str, limit: u64) -> Result<u64, HoaError> {
        let Token::Integer(found) = self.next else {
            return Err(self.unexpected(&format!("{what}, a number")));
        };
        if found >= limit {
            return Err(self.error(HoaErrorKind::Range { what, found, limit }));
        }
        self.advance()?;
        Ok(found)
    }

    pub(super) fn unexpected(&self, expected: &str) -> HoaError {
        self.error(HoaErrorKind::Unexpected { found: self.next.to_string(), expected: expected.to_owned() })
    }

    /// An error about the next token.
    pub(super) fn error(&self, kind: HoaErrorKind) -> HoaError {
        HoaError { line: self.next_line, kind }
    }

    fn take(&mut self, length: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(length);
        self.line += taken.bytes().filter(|&byte| byte == b'\n').count();
        self.rest = rest;
        taken
    }

    fn wrong(&self, expected: &str) -> HoaError {
        let found = self
            .rest
            .chars()
            .next()
            .map_or("the end of the file".to_owned(), |c| format!("`{}`", c.escape_debug()));
        HoaError { line: self.line, kind: HoaErrorKind::Unexpected { found, expected: expected.to_owned() } }
    }

    /// Blanks and comments, which may stand inside of each other.
    fn skip_blanks(&mut self) -> Result<(), HoaError> {
        let mut depth = 0usize;
        loop {
            let blanks = self.rest.len()
                - self.rest.trim_start_matches([' ', '\t', '\r', '\n', '\u{c}', '\u{b}']).len();
            self.take(blanks);
            if self.rest.starts_with("/*") {
                depth += 1;
                self.take(2);
            } else if depth > 0 && self.rest.starts_with("*/") {
                depth -= 1;
                self.take(2);
            } else if depth == 0 {
                return Ok(());
            } else {
                let Some(first) = self.rest.chars().next() else {
                    return Err(self.wrong("`*/`, the end of the comment"));
                };
                self.take(first.len_utf8());
            }
        }
    }

    fn word(&mut self) -> &'a str {
        let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        let length = self.rest.find(|c| !is_part(c)).unwrap_or(self.rest.len());
        self.take(length)
    }

    fn token(&mut self) -> Result<Token, HoaError> {
        let Some(first) = self.rest.chars().next() else { return Ok(Token::End) };
        Ok(match first {
            '"' => Token::Text(self.quoted()?),
            '0'..='9' => {
                let length = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
                match self.rest[..length].parse() {
                    Ok(value) => {
                        self.take(length);
                        Token::Integer(value)
                    }
                    Err(_) => return Err(self.wrong("a smaller number")),
                }
            }
            '@' => {
                self.take(1);
                match self.word() {
                    "" => return Err(self.wrong("the name of an alias")),
                    name => Token::Alias(name.to_owned()),
                }
            }
            '-' if self.rest.starts_with("--") => match self.rest[2..].find("--") {
                Some(length) => {
                    let mark = self.take(length + 4);
                    Token::Mark(mark.trim_matches('-').to_owned())
                }
                None => return Err(self.wrong("--BODY-- or --END--")),
            },
            'a'..='z' | 'A'..='Z' | '_' => {
                let word = self.word();
                if self.rest.starts_with(':') {
                    self.take(1);
                    Token::Item(word.to_owned())
                } else {
                    Token::Word(word.to_owned())
                }
            }
            '!' | '&' | '|' | '(' | ')' | '{' | '}' | '[' | ']' => {
                self.take(1);
                Token::Symbol(first)
            }
            _ => return Err(self.wrong("a header item, a state or an edge")),
        })
    }

    /// A text in quotation marks; a backslash stands before what is meant literally.
    fn quoted(&mut self) -> Result<String, HoaError> {
        let mut text = String::new();
        let mut is_literal = false;
        let mut length = None;
        for (position, c) in self.rest.char_indices().skip(1) {
            match c {
                '\\' if !is_literal => is_literal = true,
                '"' if !is_literal => {
                    length = Some(position + 1);
                    break;
                }
                c => {
                    is_literal = false;
                    text.push(c);
                }
            }
        }
        match length {
            Some(length) => {
                self.take(length);
                Ok(text)
            }
            None => Err(self.wrong("the closing `\"` of this text")),
        }
    }
}
