//! Numbers of steps, or a word instead.

use crate::problem::GroupSteps;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::fmt;

/// Reads an unsigned integer or one keyword.
pub(super) struct IntegerOr {
    pub(super) keyword: &'static str,
}

impl<'de> Visitor<'de> for IntegerOr {
    type Value = Option<u64>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a positive integer or \"{}\"", self.keyword)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Option<u64>, E> {
        if value == 0 { Err(E::invalid_value(de::Unexpected::Unsigned(0), &self)) } else { Ok(Some(value)) }
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Option<u64>, E> {
        if value == self.keyword {
            Ok(None)
        } else {
            Err(E::invalid_value(de::Unexpected::Str(value), &self))
        }
    }
}

impl<'de> Deserialize<'de> for GroupSteps {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_any(IntegerOr { keyword: "auto" })? {
            None => Ok(Self::Auto),
            Some(steps) => u32::try_from(steps).map(Self::Steps).map_err(de::Error::custom),
        }
    }
}

impl JsonSchema for GroupSteps {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "GroupSteps".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"anyOf": [{"type": "integer", "minimum": 1}, {"const": "auto"}]})
    }
}
