//! Going through a text token by token, and saying what is wrong with the next one.

use super::lexer::{Token, TokenKind, tokens};
use super::parse_error::Span;
use super::tree::{Node, NodeKind};
use super::{ParseError, ParseErrorKind};

/// The outcome of a step of parsing.
pub(super) type Result<T> = std::result::Result<T, ParseError>;

/// Trees are printed and evaluated recursively; this keeps them within the smallest stacks.
const MAX_DEPTH: usize = 48;

/// The same for parsing: a level of the tree is at most an operator, a negation and its parentheses.
const MAX_NESTING: usize = 3 * MAX_DEPTH;

/// A position in a list of tokens.
pub(super) struct Parser<'a> {
    source: &'a str,
    tokens: Vec<Token<'a>>,
    next: usize,
    /// How many calls of [`Parser::nested`] are active.
    nesting: usize,
}

impl<'a> Parser<'a> {
    pub(super) fn new(source: &'a str) -> Self {
        Self { source, tokens: tokens(source), next: 0, nesting: 0 }
    }

    /// The token after `ahead` others.
    pub(super) fn token(&self, ahead: usize) -> Token<'a> {
        // The last token is the end, and nothing comes after it.
        self.tokens[(self.next + ahead).min(self.tokens.len() - 1)]
    }

    pub(super) fn peek(&self) -> TokenKind<'a> {
        self.token(0).kind
    }

    pub(super) fn span(&self) -> Span {
        self.token(0).span
    }

    pub(super) fn text(&self, span: Span) -> &'a str {
        &self.source[span.start..span.end]
    }

    /// The text from `start` to the end of the last token that was read.
    pub(super) fn text_from(&self, start: usize) -> &'a str {
        &self.source[start..self.previous_end().max(start)]
    }

    /// Where the last token that was read ends.
    pub(super) fn previous_end(&self) -> usize {
        self.next.checked_sub(1).map_or(0, |last| self.tokens[last.min(self.tokens.len() - 1)].span.end)
    }

    /// The whole text.
    pub(super) fn whole(&self) -> Span {
        Span { start: 0, end: self.source.len() }
    }

    pub(super) fn at_end(&self) -> bool {
        self.peek() == TokenKind::End
    }

    /// An error about what starts at `start`.
    pub(super) fn error_from(&self, start: usize, kind: ParseErrorKind) -> ParseError {
        self.error_at(Span { start, end: self.previous_end().max(start) }, kind)
    }

    pub(super) fn advance(&mut self) {
        self.next += 1;
    }

    /// Skips the symbol if it comes next.
    pub(super) fn accept(&mut self, symbol: &'static str) -> bool {
        let accepted = self.peek() == TokenKind::Symbol(symbol);
        self.next += usize::from(accepted);
        accepted
    }

    pub(super) fn expect(&mut self, symbol: &'static str, expected: &str) -> Result<()> {
        if self.accept(symbol) { Ok(()) } else { Err(self.unexpected(expected)) }
    }

    pub(super) fn error(&self, kind: ParseErrorKind) -> ParseError {
        self.error_at(self.span(), kind)
    }

    pub(super) fn error_at(&self, span: Span, kind: ParseErrorKind) -> ParseError {
        ParseError::new(self.source, span, kind)
    }

    pub(super) fn unexpected(&self, expected: &str) -> ParseError {
        let found = self.peek().to_string();
        self.error(ParseErrorKind::Unexpected { expected: expected.to_owned(), found })
    }

    /// Parses something inside of something else.
    pub(super) fn nested<T>(&mut self, parse: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        if self.nesting == MAX_NESTING {
            return Err(self.error(ParseErrorKind::TooDeep { limit: MAX_DEPTH }));
        }
        self.nesting += 1;
        let outcome = parse(self);
        self.nesting -= 1;
        outcome
    }

    /// A node that is not too deep.
    pub(super) fn node(&self, kind: NodeKind, span: Span) -> Result<Node> {
        let node = Node::new(kind, span);
        if node.depth > MAX_DEPTH {
            return Err(self.error_at(span, ParseErrorKind::TooDeep { limit: MAX_DEPTH }));
        }
        Ok(node)
    }

    /// The inside of a name in quotes, if one comes next, whatever it is made of.
    pub(super) fn quoted(&mut self) -> Option<Span> {
        let quote = TokenKind::Symbol("\"");
        if self.peek() != quote {
            return None;
        }
        let start = self.span().end;
        let length = self.source[start..].find(['"', '\n', '\r'])?;
        let end = start + length;
        if length == 0 || !self.source[end..].starts_with('"') {
            return None;
        }
        // Tokens may reach over the closing quote only if they are one: it is a symbol of its own.
        let closing = self.tokens[self.next + 1..].iter().position(|token| token.span.start >= end)?;
        let closing = self.next + 1 + closing;
        if self.tokens[closing].kind != quote || self.tokens[closing].span.start != end {
            return None;
        }
        self.next = closing + 1;
        Some(Span { start, end })
    }

    /// `"name":`, if it comes next.
    pub(super) fn property_name(&mut self) -> Option<&'a str> {
        let start = self.next;
        let name = self.quoted();
        if self.accept(":")
            && let Some(name) = name
        {
            return Some(self.text(name));
        }
        self.next = start;
        None
    }

    /// The number of the next token.
    pub(super) fn position(&self) -> usize {
        self.next
    }

    /// Skips what is left of a broken item that began at token `first`: up to behind the next `;`, or to what looks like
    /// the next item at the beginning of a line.
    pub(super) fn recover(&mut self, first: usize) {
        self.nesting = 0;
        while self.next == first || !self.begins_item() {
            match self.peek() {
                TokenKind::End => return,
                TokenKind::Symbol(";") => {
                    self.advance();
                    return;
                }
                _ => self.advance(),
            }
        }
    }

    /// Whether the next token is the first of its line and looks like the beginning of a definition or a property.
    fn begins_item(&self) -> bool {
        let before = &self.source[..self.span().start];
        let line = before.rsplit('\n').next().unwrap_or_default();
        let fits = match self.peek() {
            TokenKind::Word("const" | "label" | "formula" | "filter") => true,
            TokenKind::Word(word) => {
                word.starts_with(['P', 'R']) && (word.len() == 1 || word[1..].starts_with('m'))
            }
            TokenKind::Symbol(symbol) => symbol == "\"" || symbol == "(",
            _ => false,
        };
        fits && line.trim().is_empty() && before.contains('\n')
    }

    /// An error about an expression of the wrong kind.
    pub(super) fn wrong_kind(&self, node: &Node, expected: &str) -> ParseError {
        let found = format!("`{}`", shortened(self.text(node.span)));
        self.error_at(node.span, ParseErrorKind::Unexpected { expected: expected.to_owned(), found })
    }
}

/// The start of a long text.
fn shortened(text: &str) -> String {
    const SHOWN: usize = 40;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
