//! Writing certificates.

use super::FIRST_LINE;
use super::{Certificate, Evidence};
use crate::model::StateId;
use crate::numeric::{Rational, shortest_decimal};
use data_encoding::HEXLOWER;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes a certificate in the format of [`super`]; equal certificates give equal bytes.
///
/// # Errors
/// Those of the writer.
pub fn write(certificate: &Certificate, out: &mut impl Write) -> io::Result<()> {
    let mut out = Lines { out, hash: Sha256::new() };
    out.line(FIRST_LINE)?;
    out.line(&format!("property {}", certificate.property))?;
    for file in &certificate.files {
        out.line(&format!("model {} {}", file.kind, file.sha256))?;
    }
    out.line(&format!("states {}", certificate.states))?;
    let [lower, upper] = [certificate.lower, certificate.upper].map(shortest_decimal);
    out.line(&format!("claim {lower} {upper}"))?;
    match &certificate.evidence {
        Evidence::Steps(steps) => {
            for (k, step) in (1..).zip(steps) {
                out.line(&format!("step {k}"))?;
                out.list("choices", &step.choices, u32::to_string)?;
                out.list("lower", &step.lower, |&x| shortest_decimal(x))?;
                out.list("upper", &step.upper, |&x| shortest_decimal(x))?;
                out.list("exact-lower", &step.exact_lower, fraction)?;
                out.list("exact-upper", &step.exact_upper, fraction)?;
            }
        }
        Evidence::Inductive(inductive) => {
            out.line("inductive")?;
            out.list("choices", &inductive.choices, u32::to_string)?;
            out.list("lower", &inductive.lower, |&x| shortest_decimal(x))?;
            out.list("upper", &inductive.upper, |&x| shortest_decimal(x))?;
            out.list("exact-lower", &inductive.exact_lower, fraction)?;
            out.list("exact-upper", &inductive.exact_upper, fraction)?;
            out.list("ranks", &inductive.ranks, u32::to_string)?;
        }
    }
    let digest = HEXLOWER.encode(&out.hash.finalize());
    writeln!(out.out, "end {digest}")
}

fn fraction(number: &Rational) -> String {
    format!("{}/{}", number.numer(), number.denom())
}

/// A writer of lines that hashes what passes.
struct Lines<'a, W> {
    out: &'a mut W,
    hash: Sha256,
}

impl<W: Write> Lines<'_, W> {
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
