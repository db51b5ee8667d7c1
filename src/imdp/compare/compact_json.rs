//! JSON that is short and still has lines.

use serde_json::Value;

/// Lists are wrapped here.
const WIDTH: usize = 100;

/// Objects over several lines, lists wrapped.
pub(super) fn compact_json(value: &Value) -> String {
    let mut out = String::new();
    write(value, 0, &mut out);
    out.push('\n');
    out
}

fn write(value: &Value, indent: usize, out: &mut String) {
    match value {
        Value::Object(fields) if indent == 0 => {
            out.push_str("{\n");
            for (at, (name, field)) in fields.iter().enumerate() {
                *out += &format!("  {}: ", Value::from(name.as_str()));
                write(field, 2, out);
                out.push_str(if at + 1 < fields.len() { ",\n" } else { "\n" });
            }
            out.push('}');
        }
        Value::Object(fields) => {
            out.push('{');
            wrap(
                fields.iter().map(|(name, field)| format!("{}: {field}", Value::from(name.as_str()))),
                indent,
                out,
            );
            out.push('}');
        }
        Value::Array(items) => {
            out.push('[');
            wrap(items.iter().map(Value::to_string), indent, out);
            out.push(']');
        }
        _ => *out += &value.to_string(),
    }
}

fn wrap(items: impl Iterator<Item = String>, indent: usize, out: &mut String) {
    let mut column = WIDTH;
    for (at, item) in items.enumerate() {
        if at > 0 {
            out.push(',');
        }
        if column + item.len() > WIDTH {
            *out += &format!("\n{:1$}", "", indent + 2);
            column = 0;
        }
        *out += &item;
        column += item.len() + 1;
    }
}
