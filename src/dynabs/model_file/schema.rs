//! What helps to write a model file: its JSON Schema and a starter.

use super::fields::ModelFile;

/// The JSON Schema of the model file, as pretty-printed JSON with a final newline.
pub fn json_schema() -> String {
    let schema = schemars::schema_for!(ModelFile);
    format!("{schema:#}\n", schema = schema.as_value())
}

/// A small complete model whose descriptions explain its fields.
pub fn starter_model() -> &'static str {
    include_str!("../templates/model.json")
}
