//! Filling in a template.

/// Replaces every `{{key}}` of a template by its value.
///
/// # Errors
/// The first key that has no value.
pub(crate) fn render(template: &str, values: &[(&str, String)]) -> Result<String, String> {
    let mut text = String::with_capacity(template.len());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (key, after) = after.split_once("}}").ok_or("an opening {{ without }}")?;
        let value = values.iter().find(|(name, _)| *name == key).ok_or(key)?;
        text.push_str(before);
        text.push_str(&value.1);
        rest = after;
    }
    text.push_str(rest);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::render;

    #[test]
    fn keys_are_replaced_and_missed() {
        let values = [("a", "1".to_owned()), ("b", "{{a}}".to_owned())];
        assert_eq!(render("{{a}} + {{b}} {x}", &values).unwrap(), "1 + {{a}} {x}");
        assert_eq!(render("{{c}}", &values).unwrap_err(), "c");
        assert!(render("{{a", &values).is_err());
    }
}
