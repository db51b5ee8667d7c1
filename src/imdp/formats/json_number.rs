//! Numbers in JSON, which has no infinity: it is written as PRISM does, in quotation marks.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number that may be infinite.
#[derive(Clone, Copy)]
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            f64::INFINITY => serializer.serialize_str("Infinity"),
            f64::NEG_INFINITY => serializer.serialize_str("-Infinity"),
            number => number.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        enum Infinite {
            Infinity,
            #[serde(rename = "-Infinity")]
            Negative,
        }
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "a number, \"Infinity\" or \"-Infinity\"")]
        enum Either {
            Finite(f64),
            Infinite(Infinite),
        }
        Either::deserialize(deserializer).map(|either| match either {
            Either::Finite(number) => Self(number),
            Either::Infinite(Infinite::Infinity) => Self(f64::INFINITY),
            Either::Infinite(Infinite::Negative) => Self(f64::NEG_INFINITY),
        })
    }
}

/// For a number that may be missing.
pub(crate) mod option {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(number: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        number.map(Number).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
        Ok(Option::<Number>::deserialize(deserializer)?.map(|number| number.0))
    }
}

/// For two numbers.
pub(crate) mod pair {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(pair: &[f64; 2], serializer: S) -> Result<S::Ok, S::Error> {
        pair.map(Number).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
        Ok(<[Number; 2]>::deserialize(deserializer)?.map(|number| number.0))
    }
}

/// For two numbers that may be missing.
pub(crate) mod option_pair {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(
        pair: &Option<[f64; 2]>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        pair.map(|pair| pair.map(Number)).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<[f64; 2]>, D::Error> {
        Ok(Option::<[Number; 2]>::deserialize(deserializer)?.map(|pair| pair.map(|number| number.0)))
    }
}
