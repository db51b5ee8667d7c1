//! Small models that once had a wrong answer, or none.

mod adverse;
mod long_decimals;

use crate::common::root;
use imdp::formats::{Imported, prism};
use std::path::PathBuf;

fn data(name: &str) -> PathBuf {
    root().join("tests/data/soundness").join(name)
}

fn model(name: &str) -> Imported {
    prism::import(&data(name), None, None).unwrap()
}
