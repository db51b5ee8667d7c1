//! Names that PRISM reads.

use crate::formats::names::{NameError, NameRule, is_identifier};
use crate::model::IntervalMdp;

/// Checks that every label, action and variable is called by an identifier, as PRISM's files want it.
///
/// # Errors
/// [`NameError`] with the first name that is none.
pub fn check_names(model: &IntervalMdp) -> Result<(), NameError> {
    let rule = NameRule {
        format: "PRISM's explicit files",
        expected: "an identifier: letters, digits and _, no digit first",
        accepts: is_identifier,
    };
    rule.check_labels(model)?;
    rule.check_actions(model)?;
    rule.check_variables(model)
}
