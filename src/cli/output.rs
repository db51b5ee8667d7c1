//! Printing that does not panic when nobody listens.

use super::CliError;
use std::io::{self, Write};

/// Writes text to stdout.
///
/// # Errors
/// [`CliError::OutputClosed`] if the reader is gone, [`CliError::Failure`] if writing fails otherwise.
pub fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => CliError::OutputClosed,
        _ => CliError::Failure(format!("stdout: {error}")),
    })
}

/// A number with commas between groups of three digits.
pub fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::thousands;

    #[test]
    fn groups_of_three() {
        let numbers = [(0, "0"), (999, "999"), (1_000, "1,000"), (39_773_745, "39,773,745")];
        for (n, text) in numbers {
            assert_eq!(thousands(n), text);
        }
    }
}
