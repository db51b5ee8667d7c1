//! Formulas of linear temporal logic as text.
//!
//! `! & | -> <-> X F G U W R`, `true`, `false`, parentheses, names with or without quotation marks. Tools disagree on what
//! `F a & b` and `a & b U c` mean, so these are refused: parentheses say it.

use super::Ltl;

/// Why a text is no formula.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("found {found} at character {column}; expected {expected}")]
pub struct FormulaError {
    /// Where, counted from 1.
    pub column: usize,
    /// What is there.
    pub found: String,
    /// What should be.
    pub expected: String,
}

impl Ltl {
    /// The formula that a text is, in names that `number` knows.
    ///
    /// # Errors
    /// [`FormulaError`] if it is none.
    pub fn parse(text: &str, number: impl Fn(&str) -> Option<u32>) -> Result<Self, FormulaError> {
        let tokens = tokens(text)?;
        let mut parser = Parser { tokens, at: 0, depth: 0, number: &number };
        let Parsed { formula, .. } = parser.implication()?;
        match parser.peek() {
            Token::End => Ok(formula),
            _ => parser.fail("an operator or the end"),
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Token {
    Name(String),
    Symbol(&'static str),
    End,
}

/// Deeper nesting than this is a mistake.
const MAX_DEPTH: u32 = 200;

const SYMBOLS: [(&str, &str); 17] = [
    ("<->", "<->"),
    ("<=>", "<->"),
    ("->", "->"),
    ("=>", "->"),
    ("&&", "&"),
    ("||", "|"),
    ("/\\", "&"),
    ("\\/", "|"),
    ("&", "&"),
    ("|", "|"),
    ("!", "!"),
    ("~", "!"),
    ("(", "("),
    (")", ")"),
    ("<>", "F"),
    ("[]", "G"),
    ("¬", "!"),
];

fn tokens(text: &str) -> Result<Vec<(usize, Token)>, FormulaError> {
    let mut tokens = vec![];
    let mut rest = text;
    loop {
        rest = rest.trim_start();
        let column = text[..text.len() - rest.len()].chars().count() + 1;
        let Some(first) = rest.chars().next() else {
            tokens.push((column, Token::End));
            return Ok(tokens);
        };
        let (token, length) =
            if let Some(&(written, symbol)) = SYMBOLS.iter().find(|(written, _)| rest.starts_with(written)) {
                (Token::Symbol(symbol), written.len())
            } else if first == '"' {
                let Some(end) = rest[1..].find('"') else {
                    let expected = "a name and a closing quotation mark".to_owned();
                    return Err(FormulaError { column, found: rest.to_owned(), expected });
                };
                (Token::Name(rest[1..=end].to_owned()), end + 2)
            } else if first.is_alphabetic() || first == '_' {
                let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
                let token = match &rest[..end] {
                    "X" => Token::Symbol("X"),
                    "F" => Token::Symbol("F"),
                    "G" => Token::Symbol("G"),
                    "U" => Token::Symbol("U"),
                    "W" => Token::Symbol("W"),
                    "R" => Token::Symbol("R"),
                    "true" => Token::Symbol("true"),
                    "false" => Token::Symbol("false"),
                    name => Token::Name(name.to_owned()),
                };
                (token, end)
            } else {
                let expected = "a name or one of ! & | -> <-> X F G U W R ( )".to_owned();
                return Err(FormulaError { column, found: format!("\"{first}\""), expected });
            };
        tokens.push((column, token));
        rest = &rest[length..];
    }
}

/// A formula, and whether it is a temporal one without parentheses around it.
struct Parsed {
    formula: Ltl,
    bare: Bare,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Bare {
    No,
    /// `F a`.
    Unary,
    /// `a U b`.
    Binary,
    /// `a & b`.
    Boolean,
}

struct Parser<'a, N> {
    tokens: Vec<(usize, Token)>,
    at: usize,
    depth: u32,
    number: &'a N,
}

impl<N: Fn(&str) -> Option<u32>> Parser<'_, N> {
    fn peek(&self) -> &Token {
        self.tokens.get(self.at).map_or(&Token::End, |(_, token)| token)
    }

    fn take(&mut self, symbol: &'static str) -> bool {
        let found = *self.peek() == Token::Symbol(symbol);
        self.at += usize::from(found);
        found
    }

    fn fail<T>(&self, expected: &str) -> Result<T, FormulaError> {
        let column = self.tokens.get(self.at).map_or(0, |(column, _)| *column);
        let found = match self.peek() {
            Token::Name(name) => format!("\"{name}\""),
            Token::Symbol(symbol) => format!("\"{symbol}\""),
            Token::End => "the end".to_owned(),
        };
        Err(FormulaError { column, found, expected: expected.to_owned() })
    }

    /// An operator between Boolean operands, of which the left one must not be a bare temporal formula.
    fn joins(&mut self, left: Bare, symbol: &'static str) -> Result<bool, FormulaError> {
        if *self.peek() == Token::Symbol(symbol) && matches!(left, Bare::Unary | Bare::Binary) {
            return self.fail(
                "parentheses around one side: tools disagree on whether F a & b is F (a & b) or (F a) & b",
            );
        }
        Ok(self.take(symbol))
    }

    fn operand(&mut self, parsed: Parsed) -> Result<Ltl, FormulaError> {
        if parsed.bare == Bare::Binary {
            self.at -= 1;
            return self
                .fail("parentheses: tools disagree on whether a & b U c is (a & b) U c or a & (b U c)");
        }
        Ok(parsed.formula)
    }

    fn implication(&mut self) -> Result<Parsed, FormulaError> {
        let left = self.any_of()?;
        if self.joins(left.bare, "->")? {
            let right = self.implication()?;
            let bare = right.bare;
            let right = self.operand(right)?;
            let formula = Ltl::Or(vec![Ltl::Not(Box::new(left.formula)), right]);
            return Ok(Parsed { formula, bare: spread(bare) });
        }
        if self.joins(left.bare, "<->")? {
            let right = self.implication()?;
            let bare = right.bare;
            let right = self.operand(right)?;
            let not = |formula: &Ltl| Ltl::Not(Box::new(formula.clone()));
            let neither = Ltl::And(vec![not(&left.formula), not(&right)]);
            let formula = Ltl::Or(vec![Ltl::And(vec![left.formula, right]), neither]);
            return Ok(Parsed { formula, bare: spread(bare) });
        }
        Ok(left)
    }

    fn any_of(&mut self) -> Result<Parsed, FormulaError> {
        let mut left = self.all_of()?;
        while self.joins(left.bare, "|")? {
            let right = self.all_of()?;
            let bare = spread(right.bare);
            left = Parsed { formula: Ltl::Or(vec![left.formula, self.operand(right)?]), bare };
        }
        Ok(left)
    }

    fn all_of(&mut self) -> Result<Parsed, FormulaError> {
        let mut left = self.until()?;
        while self.joins(left.bare, "&")? {
            let right = self.until()?;
            let bare = spread(right.bare);
            left = Parsed { formula: Ltl::And(vec![left.formula, self.operand(right)?]), bare };
        }
        Ok(left)
    }

    fn until(&mut self) -> Result<Parsed, FormulaError> {
        let left = self.unary()?;
        let Some(&symbol) = ["U", "W", "R"].iter().find(|&&s| *self.peek() == Token::Symbol(s)) else {
            return Ok(left);
        };
        if left.bare == Bare::Unary {
            return self.fail("parentheses: (F a) U b or F (a U b)");
        }
        self.at += 1;
        let right = self.until()?;
        let (left, right) = (Box::new(left.formula), Box::new(right.formula));
        let formula = match symbol {
            "U" => Ltl::Until(left, right),
            "W" => Ltl::Weak(left, right),
            _ => Ltl::Release(left, right),
        };
        Ok(Parsed { formula, bare: Bare::Binary })
    }

    fn unary(&mut self) -> Result<Parsed, FormulaError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return self.fail("a formula that is nested less deeply");
        }
        let parsed = self.unary_within()?;
        self.depth -= 1;
        Ok(parsed)
    }

    fn unary_within(&mut self) -> Result<Parsed, FormulaError> {
        if self.take("!") {
            let Parsed { formula, bare } = self.unary()?;
            return Ok(Parsed { formula: Ltl::Not(Box::new(formula)), bare });
        }
        for (symbol, make) in
            [("X", Ltl::Next as fn(Box<Ltl>) -> Ltl), ("F", Ltl::Finally), ("G", Ltl::Globally)]
        {
            if self.take(symbol) {
                let operand = self.unary()?.formula;
                return Ok(Parsed { formula: make(Box::new(operand)), bare: Bare::Unary });
            }
        }
        let closed = |formula| Ok(Parsed { formula, bare: Bare::No });
        if self.take("(") {
            let inner = self.implication()?.formula;
            return if self.take(")") { closed(inner) } else { self.fail("an operator or \")\"") };
        }
        if self.take("true") {
            return closed(Ltl::True);
        }
        if self.take("false") {
            return closed(Ltl::Not(Box::new(Ltl::True)));
        }
        let Token::Name(name) = self.peek() else { return self.fail("a name or a formula") };
        match (self.number)(name) {
            Some(number) => {
                self.at += 1;
                closed(Ltl::Proposition(number))
            }
            None => self.fail("the name of a region"),
        }
    }
}

/// What a Boolean combination is whose last operand is `right`.
fn spread(right: Bare) -> Bare {
    match right {
        Bare::Unary | Bare::Binary => Bare::Unary,
        Bare::No | Bare::Boolean => Bare::Boolean,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Ltl, FormulaError> {
        Ltl::parse(text, |name| ["a", "b", "c 1"].iter().position(|&known| known == name).map(|i| i as u32))
    }

    #[test]
    fn formulas_are_read() {
        let p = |i| Box::new(Ltl::Proposition(i));
        let not = |formula| Ltl::Not(Box::new(formula));
        assert_eq!(parse("F (a & (!b U \"c 1\"))").unwrap(), {
            let until = Ltl::Until(Box::new(not(*p(1))), p(2));
            Ltl::Finally(Box::new(Ltl::And(vec![*p(0), until])))
        });
        assert_eq!(
            parse("a -> X F b").unwrap(),
            Ltl::Or(vec![not(*p(0)), Ltl::Next(Box::new(Ltl::Finally(p(1))))])
        );
        assert_eq!(parse("a U b U a").unwrap(), Ltl::Until(p(0), Box::new(Ltl::Until(p(1), p(0)))));
        assert_eq!(parse("[] ~a || false").unwrap_err().column, 7);
        assert_eq!(
            parse("(G !a) | false").unwrap(),
            Ltl::Or(vec![Ltl::Globally(Box::new(not(*p(0)))), not(Ltl::True)])
        );
    }

    #[test]
    fn what_tools_disagree_on_is_refused() {
        for (text, column) in
            [("F a & b", 5), ("a & b U a", 9), ("F a U b", 5), ("a U b | a", 7), ("a & F b & a", 9)]
        {
            let error = parse(text).unwrap_err();
            assert!(error.expected.contains("parentheses") && error.column == column, "{text}: {error}");
        }
        assert!(parse("a & F b").is_ok() && parse("(F a) & b").is_ok() && parse("a & (b U a)").is_ok());
    }

    #[test]
    fn mistakes_have_a_place() {
        for (text, column, expected) in [
            ("F (a & d)", 8, "region"),
            ("(a", 3, ")"),
            ("a b", 3, "operator"),
            ("F", 2, "name"),
            ("a ? b", 3, "!"),
            ("\"a", 1, "closing"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.column == column && error.expected.contains(expected), "{text}: {error}");
        }
        assert!(parse(&"(".repeat(100_000)).unwrap_err().expected.contains("deeply"));
        assert!(parse(&"!".repeat(100_000)).unwrap_err().expected.contains("deeply"));
    }
}
