//! What the template engine leaves to us.

/// A rendered text with the newline at its end that the engine takes from the template's.
pub(crate) fn ended(text: String) -> String {
    text + "\n"
}
