//! The `.sta` file: the variables of every state.

use crate::model::{IntervalMdp, StateId};
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes `(x1,x2)` and then one line `state:(value,value)` per state.
///
/// PRISM wants at least one variable; a model without any gets its state number as `s`.
///
/// # Errors
/// Those of `out`.
pub fn write_sta(model: &IntervalMdp, out: &mut impl Write) -> io::Result<()> {
    let variables: Vec<_> = model.variables().iter().collect();
    let names: Vec<_> = variables.iter().map(|variable| variable.name.as_str()).collect();
    writeln!(out, "({})", if names.is_empty() { "s".to_owned() } else { names.join(",") })?;
    let mut line = String::new();
    for state in StateId::first(model.num_states()) {
        line.clear();
        // Writing to a string cannot fail.
        let _ = write!(line, "{state}:(");
        if variables.is_empty() {
            let _ = write!(line, "{state}");
        }
        for (i, variable) in variables.iter().enumerate() {
            if i > 0 {
                line.push(',');
            }
            let _ = variable.write_value(state, &mut line);
        }
        line.push_str(")\n");
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}
