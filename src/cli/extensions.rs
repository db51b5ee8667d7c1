//! Files are called what they are.

use super::CliError;
use std::path::Path;

/// Refuses a file whose name promises another kind of content than `option` writes; names without an extension promise
/// nothing, and neither do devices.
///
/// # Errors
/// [`CliError::Input`] with the extensions that would do.
pub(super) fn require_extension(option: &str, path: &Path, allowed: &[&str]) -> Result<(), CliError> {
    let is_allowed = path.extension().is_none_or(|found| allowed.iter().any(|extension| found == *extension));
    if is_allowed || path.starts_with("/dev") {
        return Ok(());
    }
    let endings: Vec<String> = allowed.iter().map(|extension| format!(".{extension}")).collect();
    Err(CliError::Input(format!(
        "{option}: found \"{}\"; expected a file that ends in {}",
        path.display(),
        endings.join(" or ")
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_promise_what_is_written() {
        let checked = |name: &str| require_extension("--output", Path::new(name), &["html", "htm"]);
        for name in ["out/page.html", "page.htm", "page", "/dev/stdout", "/dev/shm/x.y"] {
            assert!(checked(name).is_ok(), "{name}");
        }
        let error = checked("page.foo").unwrap_err().to_string();
        assert_eq!(error, "--output: found \"page.foo\"; expected a file that ends in .html or .htm");
    }
}
