//! Words, numbers and labels.

use super::HoaError;
use super::header::Header;

/// Deeper nesting than this is a mistake.
const MAX_DEPTH: u32 = 200;

/// A word of the format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    /// `States:`, without the colon.
    Key(String),
    /// `--BODY--`.
    Mark(&'static str),
    Word(String),
    Text(String),
    Number(u32),
    Symbol(char),
    End,
}

fn tokens(text: &str) -> Result<Vec<(usize, Token)>, HoaError> {
    let (mut found, mut rest, mut line) = (vec![], text, 1);
    let fail = |line, found: &str, expected: &str| {
        Err(HoaError { line, found: found.to_owned(), expected: expected.to_owned() })
    };
    while let Some(first) = rest.chars().next() {
        let (token, length) = if first.is_whitespace() {
            (None, first.len_utf8())
        } else if rest.starts_with("/*") {
            let Some(end) = rest.find("*/") else { return fail(line, "a comment without an end", "*/") };
            (None, end + 2)
        } else if let Some(mark) =
            ["--BODY--", "--END--", "--ABORT--"].into_iter().find(|&mark| rest.starts_with(mark))
        {
            (Some(Token::Mark(mark)), mark.len())
        } else if first == '"' {
            let mut escaped = false;
            let end = rest[1..].find(|c: char| {
                let closes = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                closes
            });
            let Some(end) = end else { return fail(line, "a text without an end", "a quotation mark") };
            (Some(Token::Text(rest[1..=end].replace("\\\"", "\"").replace("\\\\", "\\"))), end + 2)
        } else if first.is_ascii_digit() {
            let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            match rest[..end].parse() {
                Ok(number) => (Some(Token::Number(number)), end),
                Err(_) => return fail(line, &rest[..end], "a smaller number"),
            }
        } else if first.is_alphabetic() || first == '_' || first == '@' {
            let is_word = |c: char| c.is_alphanumeric() || "_-@".contains(c);
            let end = rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
            let word = rest[..end].to_owned();
            match rest[end..].starts_with(':') {
                true => (Some(Token::Key(word)), end + 1),
                false => (Some(Token::Word(word)), end),
            }
        } else if "!&|()[]{}".contains(first) {
            (Some(Token::Symbol(first)), 1)
        } else {
            return fail(
                line,
                &format!("\"{first}\""),
                "a word, a number, a text or one of ! & | ( ) [ ] { }",
            );
        };
        found.extend(token.map(|token| (line, token)));
        line += rest[..length].matches('\n').count();
        rest = &rest[length..];
    }
    Ok(found)
}

/// The words of a text, one after the other.
pub(super) struct Reader {
    tokens: Vec<(usize, Token)>,
    at: usize,
    last_line: usize,
}

impl Reader {
    pub(super) fn new(text: &str) -> Result<Self, HoaError> {
        Ok(Self { tokens: tokens(text)?, at: 0, last_line: text.lines().count().max(1) })
    }

    pub(super) fn peek(&self) -> &Token {
        self.tokens.get(self.at).map_or(&Token::End, |(_, token)| token)
    }

    pub(super) fn next(&mut self) -> Token {
        let token = self.peek().clone();
        self.at += 1;
        token
    }

    pub(super) fn take(&mut self, token: &Token) -> bool {
        let found = self.peek() == token;
        self.at += usize::from(found);
        found
    }

    /// That the token before the current one is not what was expected.
    pub(super) fn fail<T>(&self, expected: impl Into<String>) -> Result<T, HoaError> {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        let line = before.map_or(self.last_line, |(line, _)| *line);
        let found = match before.map_or(&Token::End, |(_, token)| token) {
            Token::Key(key) => format!("\"{key}:\""),
            Token::Mark(mark) => format!("\"{mark}\""),
            Token::Word(text) | Token::Text(text) => format!("\"{text}\""),
            Token::Number(number) => number.to_string(),
            Token::Symbol(symbol) => format!("\"{symbol}\""),
            Token::End => "the end".to_owned(),
        };
        Err(HoaError { line, found, expected: expected.into() })
    }

    pub(super) fn number(&mut self, what: &str) -> Result<u32, HoaError> {
        match self.next() {
            Token::Number(number) => Ok(number),
            _ => self.fail(what),
        }
    }

    pub(super) fn symbol(&mut self, symbol: char) -> Result<(), HoaError> {
        if self.next() == Token::Symbol(symbol) { Ok(()) } else { self.fail(format!("\"{symbol}\"")) }
    }

    /// The letters that satisfy a label, as one bit each.
    pub(super) fn label(&mut self, header: &Header, depth: u32) -> Result<Vec<bool>, HoaError> {
        if depth > MAX_DEPTH {
            return self.fail("a label that is nested less deeply");
        }
        let mut any = self.conjunction(header, depth)?;
        while self.take(&Token::Symbol('|')) {
            let other = self.conjunction(header, depth)?;
            any.iter_mut().zip(other).for_each(|(a, b)| *a |= b);
        }
        Ok(any)
    }

    fn conjunction(&mut self, header: &Header, depth: u32) -> Result<Vec<bool>, HoaError> {
        let mut all = self.atom(header, depth)?;
        while self.take(&Token::Symbol('&')) {
            let other = self.atom(header, depth)?;
            all.iter_mut().zip(other).for_each(|(a, b)| *a &= b);
        }
        Ok(all)
    }

    fn atom(&mut self, header: &Header, depth: u32) -> Result<Vec<bool>, HoaError> {
        let letters = || 0..1usize << header.propositions.len();
        let mut negated = false;
        while self.take(&Token::Symbol('!')) {
            negated = !negated;
        }
        let mut of = match self.next() {
            Token::Word(word) if word == "t" || word == "f" => letters().map(|_| word == "t").collect(),
            Token::Word(word) => match header.aliases.get(&word) {
                Some(alias) => alias.clone(),
                None => return self.fail("the number of a proposition, t, f or an alias"),
            },
            Token::Number(number) if (number as usize) < header.propositions.len() => {
                letters().map(|letter| letter >> number & 1 == 1).collect()
            }
            Token::Symbol('(') => {
                let inner = self.label(header, depth + 1)?;
                self.symbol(')')?;
                inner
            }
            _ => {
                let most = header.propositions.len();
                return self
                    .fail(format!("the number of a proposition below {most}, t, f, an alias or \"(\""));
            }
        };
        if negated {
            of.iter_mut().for_each(|letter| *letter = !*letter);
        }
        Ok(of)
    }
}
