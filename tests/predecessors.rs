//! The benchmarks of the paper's predecessors.
use crate::common::root;
use assert_cmd::Command;
use dynabs::model_file::Document;
use std::fs;
use tempfile::TempDir;

#[test]
fn all_of_them_are_valid() {
    let mut cells = vec![];
    for entry in fs::read_dir(root().join("models/predecessors")).unwrap() {
        let path = entry.unwrap().path();
        let document = Document::parse(&path, &fs::read_to_string(&path).unwrap()).unwrap();
        let problem = document.problem().unwrap();
        assert_eq!(Some(problem.name()), path.file_stem().unwrap().to_str());
        cells.push(problem.grid().num_cells());
    }
    cells.sort_unstable();
    assert_eq!(cells, [380, 784, 12_325, 25_515, 35_721, 158_125]);
}

#[test]
fn small_ones_keep_their_promises() {
    for model in ["uav_2d", "building_1_zone"] {
        let directory = TempDir::new().unwrap();
        let out = directory.path().join("out");
        let file = root().join(format!("models/predecessors/{model}.json"));
        let mut compile = Command::cargo_bin("dynabs-compile").unwrap();
        compile.arg(file).args(["--no-tra", "--quiet", "-o"]).arg(&out).assert().success();
        // Exit code 1 would be a contradiction, 4 an input outside U.
        let mut simulate = Command::cargo_bin("dynabs-check").unwrap();
        simulate.arg("simulate").arg(&out).args(["--runs", "4000", "--seed", "1"]).assert().success();
    }
}
