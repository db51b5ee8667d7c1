//! From text to tokens.

use super::ExpressionError;
use imdp::numeric::Rational;
use num_bigint::BigInt;
use num_traits::{Pow, Zero};

/// The longest text of one expression, in bytes.
pub(super) const MAX_LENGTH: usize = 65_536;
/// The most digits and the largest power of ten of a number: beyond both, no double is meant.
const MAX_DIGITS: usize = 400;
const MAX_EXPONENT: i32 = 400;

/// A piece of an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    Number(Rational),
    Name(String),
    Symbol(char),
    End,
}

/// A token and the column (from 1) at which it starts.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub(super) token: Token,
    pub(super) column: usize,
}

impl Token {
    /// How it is called in an error.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Number(_) => "a number".into(),
            Self::Name(name) => format!("\"{name}\""),
            Self::Symbol(symbol) => format!("\"{symbol}\""),
            Self::End => "the end of the expression".into(),
        }
    }
}

/// The tokens of a text, with [`Token::End`] last.
pub(super) fn tokens(text: &str) -> Result<Vec<Placed>, ExpressionError> {
    if text.len() > MAX_LENGTH {
        let found = format!("an expression of {} bytes", text.len());
        return Err(ExpressionError::new(1, found, format!("at most {MAX_LENGTH}"))
            .remedy("Name common parts under \"definitions\"."));
    }
    let characters: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(&c) = characters.get(at) {
        let column = at + 1;
        let token = match c {
            _ if c.is_whitespace() => {
                at += 1;
                continue;
            }
            '0'..='9' | '.' => number(&characters, &mut at)?,
            _ if c.is_alphabetic() || c == '_' => {
                let length =
                    characters[at..].iter().take_while(|c| c.is_alphanumeric() || **c == '_').count();
                at += length;
                Token::Name(characters[at - length..at].iter().collect())
            }
            '*' if characters.get(at + 1) == Some(&'*') => {
                return Err(ExpressionError::new(column, "\"**\"", "an operator + - * / ^")
                    .remedy("Powers are written with ^."));
            }
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => {
                at += 1;
                Token::Symbol(c)
            }
            '−' => {
                at += 1;
                Token::Symbol('-')
            }
            _ => {
                let expected = "a number, a name, an operator + - * / ^, a parenthesis or a comma";
                return Err(ExpressionError::new(column, format!("\"{c}\""), expected));
            }
        };
        tokens.push(Placed { token, column });
    }
    tokens.push(Placed { token: Token::End, column: characters.len() + 1 });
    Ok(tokens)
}

/// The decimal at `at`, exactly.
fn number(characters: &[char], at: &mut usize) -> Result<Token, ExpressionError> {
    let column = *at + 1;
    let mut digits = String::new();
    let mut after_point = 0;
    let mut point = false;
    while let Some(&c) = characters.get(*at) {
        match c {
            '0'..='9' => {
                digits.push(c);
                after_point += usize::from(point);
            }
            '.' if !point => point = true,
            _ => break,
        }
        *at += 1;
    }
    let error = |found: &str| {
        let expected = format!(
            "a number of at most {MAX_DIGITS} digits with an exponent of at most {MAX_EXPONENT}, such as 2.5e-3"
        );
        ExpressionError::new(column, found, expected)
    };
    if digits.is_empty() {
        return Err(error("\".\""));
    }
    if digits.len() > MAX_DIGITS {
        return Err(error(&format!("a number of {} digits", digits.len())));
    }
    let exponent = exponent(characters, at).map_err(|text| error(&format!("the exponent \"{text}\"")))?;
    let mantissa: BigInt = digits.parse().unwrap_or_default();
    let power = exponent - after_point as i32;
    let scale = Rational::from_integer(BigInt::from(10).pow(power.unsigned_abs()));
    let value = Rational::from_integer(mantissa);
    let value = if power >= 0 { value * scale } else { value / scale };
    // A number that no double is near would make every evaluation infinite.
    if value > Rational::from_integer(BigInt::from(10).pow(308u32)) {
        return Err(error("a number beyond 1e308"));
    }
    Ok(Token::Number(if value.is_zero() { Rational::zero() } else { value }))
}

/// The exponent after a mantissa, 0 if there is none. A name may follow a number only after an operator, so
/// an `e` here can mean nothing else.
fn exponent(characters: &[char], at: &mut usize) -> Result<i32, String> {
    if !matches!(characters.get(*at), Some('e' | 'E')) {
        return Ok(0);
    }
    let start = *at;
    *at += 1;
    if matches!(characters.get(*at), Some('+' | '-')) {
        *at += 1;
    }
    while characters.get(*at).is_some_and(char::is_ascii_digit) {
        *at += 1;
    }
    let text: String = characters[start..*at].iter().collect();
    match text[1..].parse::<i32>() {
        Ok(exponent) if exponent.abs() <= MAX_EXPONENT => Ok(exponent),
        _ => Err(text),
    }
}
