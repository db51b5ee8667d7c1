//! What integration tests share.
#![allow(dead_code)]

pub mod cases;
pub mod certified;
pub mod controllers;
pub mod tasks;

use dynabs::Diagnostic;
use dynabs::abstraction::{Abstraction, compile};
use dynabs::model_file::Document;
use dynabs::problem::Problem;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The root of the repository.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// A shipped model after some `--set` arguments.
pub fn document(model: &str, sets: &[String]) -> Document {
    let path = root().join("models").join(format!("{model}.json"));
    let text = fs::read_to_string(&path).unwrap();
    let mut document = Document::parse(&path, &text).unwrap();
    for set in sets {
        document.set(&set.parse().unwrap()).unwrap();
    }
    document
}

/// A shipped model, validated.
pub fn problem(model: &str, sets: &[String]) -> Result<Problem, Diagnostic> {
    document(model, sets).problem()
}

/// A shipped model, abstracted.
pub fn abstraction(model: &str, sets: &[String]) -> Abstraction {
    compile(&problem(model, sets).unwrap(), &()).unwrap()
}

/// A file of numbers to reproduce.
pub fn data(name: &str) -> Value {
    let path = root().join("tests/data").join(name);
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// `--set` for `reference` mode.
pub fn reference_mode() -> String {
    r#"/probabilities={"mode":"reference","beta_per_interval":0.01}"#.into()
}

/// Every shipped model, by name.
pub fn shipped_models() -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(root().join("models"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| is_model(path))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    names
}

fn is_model(path: &Path) -> bool {
    let name = path.file_name().unwrap().to_str().unwrap();
    name.ends_with(".json") && !name.ends_with(".schema.json")
}

/// The `--set` arguments that make row `row` of Table I out of a double integrator model.
pub fn table_one_row(row: &Value) -> (&'static str, Vec<String>) {
    let half_width =
        |text: &str| -> f64 { text.trim_start_matches("[-").split(',').next().unwrap().parse().unwrap() };
    let input = half_width(row["input"].as_str().unwrap());
    let mut sets = vec![format!(r#"/input={{"lower":[-{input}],"upper":[{input}]}}"#)];
    match row["abstract_input"].as_str() {
        None => ("double_integrator", sets),
        Some(text) => {
            let u = half_width(text);
            sets.push(format!(r#"/stabilizer/abstract_input={{"lower":[-{u},-{u}],"upper":[{u},{u}]}}"#));
            ("double_integrator_two_layer", sets)
        }
    }
}

/// The system's C compiler; without one the test can only say so (but not where CI runs).
pub fn c_compiler() -> Option<&'static str> {
    let works = |name: &&str| {
        Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|s| s.success())
    };
    let found = ["cc", "gcc", "clang"].into_iter().find(works);
    assert!(found.is_some() || std::env::var_os("CI").is_none(), "CI has no C compiler");
    found
}

/// Compiles generated code and what calls it without a warning; the program is `main` in the directory.
pub fn compile_c(compiler: &str, directory: &Path, source: &str, harness: &str) {
    fs::write(directory.join("controller.c"), source).unwrap();
    fs::write(directory.join("main.c"), harness).unwrap();
    let flags = "-std=c99 -Wall -Wextra -Werror -pedantic -O2 -ffp-contract=off main.c -o main -lm";
    let compiled = Command::new(compiler).args(flags.split(' ')).current_dir(directory).output().unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
}
