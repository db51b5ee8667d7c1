//! Properties that ask for a single probability, read from a text.

use super::document::{Inquiry, parse_document};
use super::parser::{Parser, Result};
use super::{Definitions, ParseError, Property, unsupported};
use std::str::FromStr;

/// Reads one property that asks for a single probability.
///
/// # Errors
/// [`ParseError`] with the place and what is wrong there; see [`parse_properties`].
pub fn parse_property(text: &str) -> std::result::Result<Property, ParseError> {
    match parse_inquiry(text, &Definitions::default())? {
        Inquiry::Probability(property) => Ok(property),
        Inquiry::Compound(_) => Err(single(text)),
    }
}

/// Reads one property of any kind.
///
/// # Errors
/// [`ParseError`] with the place and what is wrong there.
pub fn parse_inquiry(text: &str, definitions: &Definitions) -> std::result::Result<Inquiry, ParseError> {
    let mut parser = Parser::new(text);
    let inquiry = parser.only_property(definitions)?;
    while parser.accept(";") {}
    parser.expect_end("the end, as this is one property")?;
    Ok(inquiry)
}

/// Reads a properties file all of whose properties ask for a single probability, each with an optional `"name":`.
///
/// As in PRISM, `;` may end a property, `//` starts a comment, and line breaks are blanks.
///
/// # Errors
/// [`ParseError`] with the place and what is wrong there: the text does not follow PRISM's grammar, asks for
/// something unsupported (called by its name), or repeats a property's name.
pub fn parse_properties(text: &str) -> std::result::Result<Vec<Property>, ParseError> {
    let entries = parse_document(text, &mut Definitions::default());
    let single = |entry: super::Entry| match entry.inquiry? {
        Inquiry::Probability(property) => Ok(property),
        Inquiry::Compound(compound) => Err(single(&compound.to_string())),
    };
    entries.into_iter().map(single).collect()
}

impl FromStr for Property {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        parse_property(text)
    }
}

fn single(text: &str) -> ParseError {
    let parser = Parser::new(text);
    parser.error_at(parser.whole(), unsupported::COMBINED)
}

impl Parser<'_> {
    fn only_property(&mut self, definitions: &Definitions) -> Result<Inquiry> {
        let name = self.property_name().map(str::to_owned);
        if self.at_end() {
            return Err(self.unexpected("a property, such as Pmaxmin=? [ F \"goal\" ]"));
        }
        let start = self.span().start;
        let node = self.expression()?;
        let node = self.substitute(node, definitions)?;
        let text = self.text_from(start).to_owned();
        self.inquiry(name, &text, node)
    }
}
