//! Which fields are there.

/// The names of the fields that are there.
pub(super) fn given(fields: &[(&str, bool)]) -> String {
    let given: Vec<_> = fields.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
    given.join(", ")
}
