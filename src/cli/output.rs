//! What goes to the terminal: nothing in it moves the cursor, and nothing panics when nobody listens.

use super::CliError;
use super::colour::for_stream;
use serde::Serialize;
use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether another process of the crew speaks for this one.
static MUTED: AtomicBool = AtomicBool::new(false);

/// Says nothing from now on, or speaks again.
#[cfg(feature = "mpi")]
pub(super) fn mute(muted: bool) {
    MUTED.store(muted, Ordering::Relaxed);
}

/// Whether nothing is to be said.
pub(super) fn is_muted() -> bool {
    MUTED.load(Ordering::Relaxed)
}

/// Writes text to stdout, in which control characters are spelled out as in JSON.
///
/// A reader that has gone away is no error: what the exit code says stays true.
///
/// # Errors
/// [`CliError::Failure`] if writing fails.
pub fn print(text: &str) -> Result<(), CliError> {
    if is_muted() {
        return Ok(());
    }
    let mut out = io::stdout().lock();
    match out.write_all(for_stream(harmless(text), &out).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(CliError::Failure(format!("stdout: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes an object to stdout as JSON that people can read too.
///
/// # Errors
/// [`CliError::Failure`] if writing fails, or if the object has no JSON form.
pub fn print_json(object: &impl Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string_pretty(object)
        .map_err(|error| CliError::Failure(format!("found something without a JSON form: {error}")))?;
    print(&(text + "\n"))
}

/// Writes text to stderr in the same way; if that is closed there is nobody to tell.
pub fn warn(text: &str) {
    if !is_muted() {
        let _ = io::stderr().write_all(for_stream(harmless(text), &io::stderr()).as_bytes());
    }
}

/// The text with control characters, and those that turn the direction of writing, spelled out.
fn harmless(text: &str) -> Cow<'_, str> {
    let is_harmless = |c: char| match c {
        '\n' | '\t' => true,
        '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => false,
        _ => !c.is_control(),
    };
    if text.chars().all(is_harmless) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_harmless(c) {
            shown.push(c);
        } else {
            // Writing to a string cannot fail.
            let _ = write!(shown, "\\u{:04x}", u32::from(c));
        }
    }
    shown.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_moves_the_cursor() {
        let texts = [
            ("α ≥ 0\n\tplain", "α ≥ 0\n\tplain"),
            ("\u{1b}[31mred\r", "\\u001b[31mred\\u000d"),
            ("\u{7f}\u{9b}31m\u{202e}txt", "\\u007f\\u009b31m\\u202etxt"),
        ];
        for (text, shown) in texts {
            assert_eq!(harmless(text), shown);
        }
    }
}
