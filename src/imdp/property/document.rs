//! Files of properties: definitions and questions, one broken line not keeping the others from being answered.

use super::lexer::TokenKind;
use super::parser::{Parser, Result};
use super::tree::Node;
use super::{Compound, Definitions, ParseError, ParseErrorKind, Property};

/// Something that a properties file asks.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The name in front of it, if it has one.
    pub name: Option<String>,
    /// What was written, on one line.
    pub text: String,
    /// What it asks, or why it asks nothing.
    pub inquiry: std::result::Result<Inquiry, ParseError>,
}

/// A question that can be asked of a model.
#[derive(Clone, Debug)]
pub enum Inquiry {
    /// One probability, perhaps compared with a threshold: all there is to a question can be had, policy and proof.
    Probability(Property),
    /// Anything else that PRISM's language can express: rewards, filters, several probabilities.
    Compound(Compound),
}

/// Reads a properties file, as [`parse_properties`](super::parse_properties) does, with all that PRISM's files may hold:
/// `const`, `label` and `formula` definitions, and any expressions.
///
/// `definitions` has values for constants; what the file defines is added to it. A definition or a property that is wrong
/// is an entry with an error, and the others are read all the same.
pub fn parse_document(text: &str, definitions: &mut Definitions) -> Vec<Entry> {
    let mut parser = Parser::new(text);
    let mut entries: Vec<Entry> = vec![];
    loop {
        while parser.accept(";") {}
        if parser.peek() == TokenKind::End {
            return entries;
        }
        let (start, position) = (parser.span().start, parser.position());
        let outcome = parser.item(definitions);
        let end = parser.previous_end().max(start);
        let written = || text[start..end].split_whitespace().collect::<Vec<_>>().join(" ");
        match outcome {
            Ok(None) => {}
            Ok(Some((name, inquiry))) => {
                let is_taken = name.is_some() && entries.iter().any(|entry| entry.name == name);
                let inquiry = match (is_taken, &name) {
                    (true, Some(name)) => {
                        let kind = ParseErrorKind::DuplicateName { name: name.clone() };
                        Err(parser.error_from(start, kind))
                    }
                    _ => Ok(inquiry),
                };
                entries.push(Entry { name, text: written(), inquiry });
            }
            Err(error) => {
                parser.recover(position);
                let end = parser.previous_end().max(start);
                let text = text[start..end].split_whitespace().collect::<Vec<_>>().join(" ");
                let text = text.trim_end_matches(';').trim_end().to_owned();
                entries.push(Entry { name: None, text, inquiry: Err(error) });
            }
        }
    }
}

impl Parser<'_> {
    /// A definition, or a property and its name.
    fn item(&mut self, definitions: &mut Definitions) -> Result<Option<(Option<String>, Inquiry)>> {
        match self.peek() {
            TokenKind::Word("const") => {
                self.advance();
                if let TokenKind::Word("int" | "double" | "bool") = self.peek() {
                    self.advance();
                }
                let name = self.name("the name of a constant")?;
                let value = if self.accept("=") { Some(self.defined(definitions)?) } else { None };
                definitions.constant(name, value);
            }
            TokenKind::Word("formula") => {
                self.advance();
                let name = self.name("the name of a formula")?;
                self.expect("=", "`=` and an expression")?;
                let formula = self.defined(definitions)?;
                definitions.formula(name, formula);
            }
            TokenKind::Word("label") => {
                self.advance();
                let Some(span) = self.quoted() else {
                    return Err(self.unexpected("the name of a label in quotes"));
                };
                let name = self.text(span).to_owned();
                self.expect("=", "`=` and a formula")?;
                let formula = self.defined(definitions)?;
                definitions.label(name, formula);
            }
            _ => {
                let name = self.property_name().map(str::to_owned);
                if self.peek() == TokenKind::End {
                    return Err(self.unexpected("a property, such as Pmaxmin=? [ F \"goal\" ]"));
                }
                let start = self.span().start;
                let node = self.expression()?;
                let node = self.substitute(node, definitions)?;
                let text = self.text_from(start).to_owned();
                let inquiry = self.inquiry(name.clone(), &text, node)?;
                return Ok(Some((name, inquiry)));
            }
        }
        if self.peek() != TokenKind::End {
            self.expect(";", "`;` after a definition")?;
        }
        Ok(None)
    }

    fn defined(&mut self, definitions: &Definitions) -> Result<Node> {
        let node = self.expression()?;
        self.substitute(node, definitions)
    }

    /// An identifier that is no keyword.
    pub(super) fn name(&mut self, expected: &str) -> Result<String> {
        match self.peek() {
            TokenKind::Word(word) if !super::unsupported::KEYWORDS.contains(&word) => {
                self.advance();
                Ok(word.to_owned())
            }
            _ => Err(self.unexpected(expected)),
        }
    }

    /// Checks that nothing follows.
    pub(super) fn expect_end(&self, expected: &str) -> Result<()> {
        match self.peek() {
            TokenKind::End => Ok(()),
            _ => Err(self.unexpected(expected)),
        }
    }
}
