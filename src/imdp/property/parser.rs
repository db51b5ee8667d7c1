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

    /// `"name":`, if it comes next.
    pub(super) fn property_name(&mut self) -> Option<&'a str> {
        let quote = TokenKind::Symbol("\"");
        let TokenKind::Word(name) = self.token(1).kind else { return None };
        let kinds = [0, 2, 3].map(|ahead| self.token(ahead).kind);
        if kinds != [quote, quote, TokenKind::Symbol(":")] {
            return None;
        }
        self.next += 4;
        Some(name)
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
