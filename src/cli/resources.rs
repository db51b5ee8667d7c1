//! What a tool may use, and how much memory it did.

use crate::summary::thousands_of_mib;
use crate::together::exchanged;
use crate::{CliError, use_threads};
use clap::Args;
use imdp::model::{limit_memory, peak_memory};
use std::time::Duration;

/// Parses a number of bytes such as `500M` or `16G`.
///
/// # Errors
/// What was expected.
fn bytes(text: &str) -> Result<u64, String> {
    let (digits, unit) = match text.to_ascii_uppercase().strip_suffix(['K', 'M', 'G', 'T']) {
        Some(digits) => (digits.to_owned(), text[digits.len()..].to_ascii_uppercase()),
        None => (text.to_owned(), String::new()),
    };
    let shift = match unit.as_str() {
        "" => 0,
        "K" => 10,
        "M" => 20,
        "G" => 30,
        _ => 40,
    };
    let number = digits.parse::<u64>().ok().and_then(|number| number.checked_mul(1 << shift));
    number
        .filter(|&bytes| bytes > 0)
        .ok_or_else(|| "expected a number of bytes such as 500M or 16G".to_owned())
}

/// What every tool takes.
#[derive(Clone, Debug, Args)]
pub(crate) struct Resources {
    /// Use this many threads; no result depends on it.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,

    /// Refuse what needs more memory than this, such as 500M or 16G. Another engine may use as much; it gets three quarters of
    /// what is available otherwise.
    #[arg(long, global = true, value_name = "LIMIT", value_parser = bytes)]
    memory: Option<u64>,
}

impl Resources {
    /// Lets the tool use so much from now on.
    ///
    /// # Errors
    /// Those of [`use_threads`].
    pub(crate) fn apply(&self) -> Result<(), CliError> {
        self.memory.into_iter().for_each(limit_memory);
        use_threads(self.threads)
    }
}

/// How long phases took, with the most memory used so far.
pub(crate) fn times(phases: &[(&str, Duration)]) -> String {
    let times: Vec<_> = phases.iter().map(|(name, time)| format!("{name} {time:.1?}")).collect();
    format!("times: {}{}\n", times.join(", "), peak())
}

/// The time that went to other processes and the most memory used so far, for people; nothing where the system does not tell.
fn peak() -> String {
    let memory = peak_memory().map(|bytes| format!("; peak memory {} MiB", thousands_of_mib(bytes)));
    exchanged() + &memory.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::bytes;

    #[test]
    fn sizes_have_units() {
        assert_eq!(bytes("1024"), Ok(1024));
        assert_eq!(bytes("500M"), Ok(500 << 20));
        assert_eq!(bytes("16g"), Ok(16 << 30));
        for wrong in ["", "G", "-1", "1.5G", "0", "99999999999T", "1GB"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }
}
