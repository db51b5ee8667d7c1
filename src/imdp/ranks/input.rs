//! Whether all processes have read the same: files may differ between machines.

use super::{Notice, agree, crew};
use sha2::{Digest, Sha256};
use std::fmt::{self, Debug, Write};

/// Makes sure that all processes of the crew are of the same version and have the same input, as far as what is written of it for
/// developers shows; ends them all if not.
pub fn require_same(input: &dyn Debug) {
    let Some(ranks) = crew() else { return };
    let mut text = Digested(Sha256::new());
    // A digest takes any text, and what is written for developers can be written.
    let _ = write!(text, "{} {input:?}", env!("CARGO_PKG_VERSION"));
    let [a, b, c, d, ..] = text.0.finalize().0;
    agree(&*ranks, Notice::Input { digest: u32::from_le_bytes([a, b, c, d]) });
}

/// A digest of text as it comes, which may be long.
struct Digested(Sha256);

impl Write for Digested {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}
