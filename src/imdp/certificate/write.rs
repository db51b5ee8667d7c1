//! Writing certificates.

use super::FIRST_LINE;
use super::{Certificate, Claim, Derivation, Evidence, FileDigest};
use crate::model::StateId;
use crate::numeric::{Rational, shortest_decimal};
use crate::property::{Nature, Verdict};
use data_encoding::HEXLOWER;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes a certificate in the format of [`super`]; equal certificates give equal bytes.
///
/// # Errors
/// Those of the writer.
pub fn write(certificate: &Certificate, out: &mut impl Write) -> io::Result<()> {
    let mut out = Lines::new(out)?;
    out.line(&format!("property {}", certificate.property))?;
    out.model(&certificate.files, certificate.states)?;
    out.bounds(certificate.lower, certificate.upper)?;
    out.evidence(&certificate.evidence)?;
    out.finish()
}

/// Writes the certificate of an expression.
///
/// # Errors
/// Those of the writer.
pub fn write_derivation(derivation: &Derivation, out: &mut impl Write) -> io::Result<()> {
    let mut out = Lines::new(out)?;
    out.line(&format!("expression {}", derivation.expression))?;
    if let Some(nature) = derivation.nature {
        out.line(&format!("nature {}", name_of(nature)))?;
    }
    out.model(&derivation.files, derivation.states)?;
    match derivation.claim {
        Claim::Between(lower, upper) => out.bounds(lower, upper)?,
        Claim::Verdict(Verdict::Holds) => out.line("claim holds")?,
        Claim::Verdict(Verdict::Fails) => out.line("claim fails")?,
        Claim::Verdict(Verdict::Unknown) => out.line("claim unknown")?,
    }
    for proof in &derivation.proofs {
        let is_reward = matches!(proof, Evidence::RewardSteps(_) | Evidence::RewardInductive(_));
        out.line(if is_reward { "reward" } else { "probability" })?;
        out.evidence(proof)?;
    }
    out.finish()
}

/// What nature is called in the file.
pub(super) fn name_of(nature: Nature) -> &'static str {
    match nature {
        Nature::Robust => "robust",
        Nature::Cooperative => "cooperative",
    }
}

/// The shortest decimal, or an infinity.
fn number(x: &f64) -> String {
    if x.is_finite() { shortest_decimal(*x) } else { x.to_string() }
}

fn fraction(number: &Rational) -> String {
    format!("{}/{}", number.numer(), number.denom())
}

/// A writer of lines that hashes what passes.
struct Lines<'a, W> {
    out: &'a mut W,
    hash: Sha256,
}

impl<'a, W: Write> Lines<'a, W> {
    fn new(out: &'a mut W) -> io::Result<Self> {
        let mut lines = Self { out, hash: Sha256::new() };
        lines.line(FIRST_LINE)?;
        Ok(lines)
    }

    fn model(&mut self, files: &[FileDigest], states: u64) -> io::Result<()> {
        for file in files {
            self.line(&format!("model {} {}", file.kind, file.sha256))?;
        }
        self.line(&format!("states {states}"))
    }

    fn bounds(&mut self, lower: f64, upper: f64) -> io::Result<()> {
        self.line(&format!("claim {} {}", number(&lower), number(&upper)))
    }

    fn evidence(&mut self, evidence: &Evidence) -> io::Result<()> {
        match evidence {
            Evidence::Steps(steps) | Evidence::RewardSteps(steps) => {
                for (k, step) in (1..).zip(steps) {
                    self.line(&format!("step {k}"))?;
                    self.list("choices", &step.choices, u32::to_string)?;
                    self.list("lower", &step.lower, number)?;
                    self.list("upper", &step.upper, number)?;
                    self.list("exact-lower", &step.exact_lower, fraction)?;
                    self.list("exact-upper", &step.exact_upper, fraction)?;
                }
            }
            Evidence::Inductive(inductive) => {
                self.line("inductive")?;
                self.list("choices", &inductive.choices, u32::to_string)?;
                self.list("lower", &inductive.lower, number)?;
                self.list("upper", &inductive.upper, number)?;
                self.list("exact-lower", &inductive.exact_lower, fraction)?;
                self.list("exact-upper", &inductive.exact_upper, fraction)?;
                self.list("ranks", &inductive.ranks, u32::to_string)?;
            }
            Evidence::RewardInductive(inductive) => {
                self.line("inductive")?;
                self.list("choices", &inductive.choices, u32::to_string)?;
                self.list("lower", &inductive.lower, number)?;
                self.list("upper", &inductive.upper, number)?;
                self.list("missed", &inductive.missed, number)?;
            }
        }
        Ok(())
    }

    /// The last line.
    fn finish(self) -> io::Result<()> {
        let digest = HEXLOWER.encode(&self.hash.finalize());
        writeln!(self.out, "end {digest}")
    }

    fn line(&mut self, text: &str) -> io::Result<()> {
        self.put(text)?;
        self.put("\n")
    }

    fn put(&mut self, text: &str) -> io::Result<()> {
        self.hash.update(text.as_bytes());
        self.out.write_all(text.as_bytes())
    }

    fn list<T>(&mut self, name: &str, items: &[(StateId, T)], show: impl Fn(&T) -> String) -> io::Result<()> {
        if items.is_empty() {
            return Ok(());
        }
        let mut text = name.to_owned();
        for (state, item) in items {
            // Writing to a string cannot fail.
            let _ = write!(text, " {state} {}", show(item));
            if text.len() >= PIECE {
                self.put(&text)?;
                text.clear();
            }
        }
        self.line(&text)
    }
}

/// How much is handed to the hash and the writer at once.
const PIECE: usize = 1 << 16;
