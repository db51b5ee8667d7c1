//! Reading certificates, trusting nothing.

use super::write::name_of;
use super::{
    Certificate, Claim, Derivation, Evidence, FileDigest, Inductive, RewardInductive, Statement, Step,
};
use super::{CertificateError, FIRST_LINE};
use crate::files;
use crate::formats::sha256_hex;
use crate::model::{StateId, require_memory};
use crate::numeric::Rational;
use crate::property::{Nature, Verdict};
use num_bigint::BigInt;
use num_traits::Zero;
use std::path::Path;
use std::str::FromStr;

/// Reads a certificate from a file.
///
/// # Errors
/// [`CertificateError`]; any truncation and any changed byte is noticed.
pub fn read_file(path: &Path) -> Result<Certificate, CertificateError> {
    // The text, and at most 16 bytes for a state and an item that take 4 or more in it.
    require_memory("the certificate", std::fs::metadata(path)?.len().saturating_mul(5))?;
    read(&files::read(path)?)
}

/// Reads a certificate of any kind from a file.
///
/// # Errors
/// Those of [`read_file`].
pub fn read_statement_file(path: &Path) -> Result<Statement, CertificateError> {
    require_memory("the certificate", std::fs::metadata(path)?.len().saturating_mul(5))?;
    read_statement(&files::read(path)?)
}

/// Reads a certificate that [`write`](super::write()) has written.
///
/// # Errors
/// Those of [`read_file`].
pub fn read(bytes: &[u8]) -> Result<Certificate, CertificateError> {
    lines(bytes)?.certificate()
}

/// Reads a certificate of any kind.
///
/// # Errors
/// Those of [`read_file`].
pub fn read_statement(bytes: &[u8]) -> Result<Statement, CertificateError> {
    let mut lines = lines(bytes)?;
    match lines.peek("expression").is_some() {
        true => lines.derivation().map(Statement::Expression),
        false => lines.certificate().map(|certificate| Statement::Probability(Box::new(certificate))),
    }
}

/// The lines of a certificate that is whole.
fn lines(bytes: &[u8]) -> Result<Lines<'_>, CertificateError> {
    let first = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    if first != FIRST_LINE.as_bytes() {
        let found = shortened(&String::from_utf8_lossy(&first[..first.len().min(SHOWN)]));
        // A file cut off in its first line starts like a certificate.
        return Err(match FIRST_LINE.as_bytes().starts_with(first) {
            true => CertificateError::Truncated,
            false => CertificateError::NotACertificate { found, expected: FIRST_LINE.to_owned() },
        });
    }
    let lines = bytes.strip_suffix(b"\n").ok_or(CertificateError::Truncated)?;
    let last = lines.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
    let (content, last) = (&bytes[..last], &lines[last..]);
    let digest = last.strip_prefix(b"end ").filter(|digest| digest.len() == 64);
    let digest = digest.ok_or(CertificateError::Truncated)?;
    let found = sha256_hex(content);
    if found.as_bytes() != digest {
        return Err(CertificateError::Digest);
    }
    let text = str::from_utf8(content).map_err(|_| CertificateError::Digest)?;
    Ok(Lines { rest: text.lines().collect(), at: 1 })
}

/// The lines between the first and the last.
struct Lines<'a> {
    rest: Vec<&'a str>,
    at: usize,
}

impl<'a> Lines<'a> {
    fn certificate(&mut self) -> Result<Certificate, CertificateError> {
        let property = self.item("property", "a property that can be read", |text| text.parse().ok())?;
        let (files, states) = self.model()?;
        let claim = |text: &str| {
            let (lower, upper) = text.split_once(' ')?;
            Some((probability(lower)?, probability(upper)?))
        };
        let (lower, upper) = self.item("claim", "two probabilities", claim)?;
        let evidence = self.evidence()?;
        self.end()?;
        Ok(Certificate { property, files, states, lower, upper, evidence })
    }

    fn derivation(&mut self) -> Result<Derivation, CertificateError> {
        let expression = self.item("expression", "an expression", |text| Some(text.to_owned()))?;
        let mut nature = None;
        if self.peek("nature").is_some() {
            let known = [Nature::Robust, Nature::Cooperative];
            let named = |text: &str| known.into_iter().find(|nature| name_of(*nature) == text);
            nature = Some(self.item("nature", "robust or cooperative", named)?);
        }
        let (files, states) = self.model()?;
        let claim = |text: &str| {
            Some(match text {
                "holds" => Claim::Verdict(Verdict::Holds),
                "fails" => Claim::Verdict(Verdict::Fails),
                "unknown" => Claim::Verdict(Verdict::Unknown),
                text => {
                    let (lower, upper) = text.split_once(' ')?;
                    let bounds: (f64, f64) = (number(lower)?, number(upper)?);
                    (!bounds.0.is_nan() && !bounds.1.is_nan())
                        .then_some(Claim::Between(bounds.0, bounds.1))?
                }
            })
        };
        let claim = self.item("claim", "two numbers, holds, fails or unknown", claim)?;
        let mut proofs = vec![];
        loop {
            if self.peek("probability").is_some() {
                self.at += 1;
                proofs.push(self.evidence()?);
            } else if self.peek("reward").is_some() {
                self.at += 1;
                proofs.push(self.reward_evidence()?);
            } else {
                self.end()?;
                return Ok(Derivation { expression, nature, files, states, claim, proofs });
            }
        }
    }

    /// What the certificate says about the model.
    fn model(&mut self) -> Result<(Vec<FileDigest>, u64), CertificateError> {
        let mut files = vec![];
        while let Some(text) = self.peek("model") {
            let (kind, sha256) = text.split_once(' ').unwrap_or((text, ""));
            files.push(FileDigest { kind: kind.to_owned(), sha256: sha256.to_owned() });
            self.at += 1;
        }
        Ok((files, self.item("states", "their number", number)?))
    }

    fn end(&self) -> Result<(), CertificateError> {
        if self.at < self.rest.len() { Err(self.broken("the end")) } else { Ok(()) }
    }

    fn evidence(&mut self) -> Result<Evidence, CertificateError> {
        if self.peek("inductive").is_some() {
            self.at += 1;
            return Ok(Evidence::Inductive(Inductive {
                choices: self.list("choices", number)?,
                lower: self.list("lower", probability)?,
                upper: self.list("upper", probability)?,
                exact_lower: self.list("exact-lower", fraction)?,
                exact_upper: self.list("exact-upper", fraction)?,
                ranks: self.list("ranks", number)?,
            }));
        }
        self.steps(probability).map(Evidence::Steps)
    }

    fn reward_evidence(&mut self) -> Result<Evidence, CertificateError> {
        if self.peek("inductive").is_some() {
            self.at += 1;
            return Ok(Evidence::RewardInductive(RewardInductive {
                choices: self.list("choices", number)?,
                lower: self.list("lower", reward)?,
                upper: self.list("upper", reward)?,
                missed: self.list("missed", probability)?,
            }));
        }
        self.steps(reward).map(Evidence::RewardSteps)
    }

    fn steps(&mut self, bound: fn(&str) -> Option<f64>) -> Result<Vec<Step>, CertificateError> {
        let mut steps = vec![];
        while self.peek("step").is_some() {
            let next = (steps.len() + 1).to_string();
            self.item("step", &next, |text| (text == next).then_some(()))?;
            steps.push(Step {
                choices: self.list("choices", number)?,
                lower: self.list("lower", bound)?,
                upper: self.list("upper", bound)?,
                exact_lower: self.list("exact-lower", fraction)?,
                exact_upper: self.list("exact-upper", fraction)?,
            });
        }
        Ok(steps)
    }

    /// The pairs of the line with this name, if it comes next.
    fn list<T>(
        &mut self,
        name: &str,
        item: impl Fn(&str) -> Option<T>,
    ) -> Result<Vec<(StateId, T)>, CertificateError> {
        if self.peek(name).is_none() {
            return Ok(vec![]);
        }
        self.item(name, "pairs of a state and a number in its range", |text| {
            let mut words = text.split_ascii_whitespace();
            let mut list = Vec::with_capacity(text.len() / 4);
            while let Some(state) = words.next() {
                list.push((number(state)?, item(words.next()?)?));
            }
            list.shrink_to_fit();
            Some(list)
        })
    }

    /// What follows this word in the next line, made something of.
    fn item<T>(
        &mut self,
        name: &str,
        content: &str,
        make: impl FnOnce(&str) -> Option<T>,
    ) -> Result<T, CertificateError> {
        let item = self.peek(name).and_then(make);
        let item = item.ok_or_else(|| self.broken(format!("`{name}` and {content}")))?;
        self.at += 1;
        Ok(item)
    }

    /// The rest of the next line, if it starts with this word.
    fn peek(&self, word: &str) -> Option<&'a str> {
        let rest = self.rest.get(self.at)?.strip_prefix(word)?;
        if rest.is_empty() { Some(rest) } else { rest.strip_prefix(' ') }
    }

    fn broken(&self, expected: impl Into<String>) -> CertificateError {
        let found = shortened(self.rest.get(self.at).unwrap_or(&"end"));
        CertificateError::Line { line: self.at + 1, found, expected: expected.into() }
    }
}

/// How many characters of a line a message shows.
const SHOWN: usize = 40;

fn shortened(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text.to_owned(),
    }
}

fn number<T: FromStr>(text: &str) -> Option<T> {
    text.parse().ok()
}

/// A double in `[0, 1]`.
fn probability(text: &str) -> Option<f64> {
    let value: f64 = text.parse().ok()?;
    ((0.0..=1.0).contains(&value) && value.is_sign_positive()).then_some(value)
}

/// A finite double of at least 0.
fn reward(text: &str) -> Option<f64> {
    let value: f64 = text.parse().ok()?;
    ((0.0..f64::INFINITY).contains(&value) && value.is_sign_positive()).then_some(value)
}

/// Longer numerators and denominators prove nothing that shorter ones would not.
const LONGEST_NUMBER: usize = 1 << 16;

/// A fraction in `[0, 1]`.
fn fraction(text: &str) -> Option<Rational> {
    let (over, under) = text.split_once('/')?;
    let natural = |text: &str| {
        let plain = text.len() <= LONGEST_NUMBER && text.bytes().all(|byte| byte.is_ascii_digit());
        plain.then(|| BigInt::parse_bytes(text.as_bytes(), 10)).flatten()
    };
    let (over, under) = (natural(over)?, natural(under)?);
    (!under.is_zero() && over <= under).then(|| Rational::new(over, under))
}
