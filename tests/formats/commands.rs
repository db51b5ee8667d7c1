//! `dynabs-check convert` and `dynabs-compile --format`.

use super::*;
use assert_cmd::Command;
use std::fs;

fn run(tool: &str, arguments: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin(tool).unwrap().args(arguments).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap(), String::from_utf8(text).unwrap())
}

fn succeed(tool: &str, arguments: &[&str]) -> String {
    let (code, text) = run(tool, arguments);
    assert_eq!(code, 0, "{arguments:?}: {text}");
    text
}

#[test]
fn every_format_is_compiled_converted_and_solved() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    let model = crate::common::root().join("models/room_temperature.json");
    let model = model.to_str().unwrap();
    let (plain, rows) = (at("plain"), at("rows"));
    succeed("dynabs-compile", &[model, "-o", &plain, "--format", "prism,drn", "--format", "umb", "-q"]);
    succeed("dynabs-compile", &[model, "-o", &rows, "--format", "drn,umb", "--encoding", "rows", "-q"]);
    let names = |directory: &str| {
        let mut names: Vec<_> = fs::read_dir(directory)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names.join(" ")
    };
    assert_eq!(
        names(&plain),
        "manifest.json model.drn model.dynabs model.lab model.props model.sta model.tra model.umb noise.csv problem.json"
    );
    assert_eq!(
        names(&rows),
        "manifest.json model.dynabs model.props noise.csv problem.json rows.drn rows.props rows.umb"
    );
    assert_eq!(
        fs::read_to_string(format!("{rows}/rows.props")).unwrap(),
        "(Pmaxmin=? [ !\"failed\" U<=12 \"reached\" ])>=0.9\n"
    );
    // The same bytes, whichever way they came about.
    for name in ["model.umb", "model.drn", "model.tra", "model.sta", "model.lab"] {
        let other = at(name);
        if !name.ends_with("sta") && !name.ends_with("lab") {
            succeed("dynabs-check", &["convert", &plain, &other, "-q", "--force"]);
        }
        assert_eq!(fs::read(&other).unwrap(), fs::read(format!("{plain}/{name}")).unwrap(), "{name}");
    }
    succeed("dynabs-check", &["convert", &plain, &at("rows.umb"), "--encoding", "rows", "-q"]);
    assert_eq!(fs::read(at("rows.umb")).unwrap(), fs::read(format!("{rows}/rows.umb")).unwrap());
    let solved = |path: &str| {
        let text = succeed("dynabs-check", &["solve", path, "--json"]);
        let value: serde_json::Value = serde_json::from_str(&text[text.find('{').unwrap()..]).unwrap();
        value["results"][0]["lower"].as_f64().unwrap()
    };
    let expected = solved(&plain);
    for path in [
        format!("{plain}/model.tra"),
        format!("{plain}/model.drn"),
        format!("{plain}/model.umb"),
        format!("{rows}/rows.drn"),
        format!("{rows}/rows.umb"),
    ] {
        assert!((solved(&path) - expected).abs() <= 1e-14, "{path}");
    }
}

#[test]
fn nothing_is_replaced_by_accident_and_mistakes_are_named() {
    let scratch = tempfile::tempdir().unwrap();
    let input = write(&tiny::model(), Format::Native, scratch.path());
    let input = input.to_str().unwrap();
    let at = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    let refused = |arguments: &[&str], words: &[&str]| {
        let (code, text) = run("dynabs-check", &[&["convert"], arguments].concat());
        assert_eq!(code, 2, "{text}");
        words.iter().for_each(|word| assert!(text.contains(word), "{text}, without {word}"));
    };
    refused(&[input, &at("a.text")], &["a.text", ".umb", "--to"]);
    refused(&["nowhere.umb", &at("a.drn")], &["nowhere.umb", "found nothing"]);
    succeed("dynabs-check", &["convert", input, &at("a.txt"), "--to", "drn"]);
    succeed("dynabs-check", &["convert", input, &at("b.tra")]);
    refused(&[input, &at("b.tra")], &["b.tra", "--force"]);
    fs::remove_file(at("b.tra")).unwrap();
    refused(&[input, &at("b.tra")], &["b.sta", "--force"]);
    succeed("dynabs-check", &["convert", input, &at("b.tra"), "--force"]);
    // A name that PRISM does not read.
    let mut parts = parts(&tiny::model());
    parts.labels.insert("two words", StateSet::with_capacity(5));
    let odd = write(&IntervalMdp::new(parts).unwrap(), Format::Umb, scratch.path());
    let keep = [odd.to_str().unwrap(), &at("c.tra"), "--names", "keep"];
    refused(&keep, &["label `two words`", "identifier"]);
    assert!(!scratch.path().join("c.sta").exists());
    succeed("dynabs-check", &["convert", odd.to_str().unwrap(), &at("c.tra")]);
    assert!(fs::read_to_string(at("c.lab")).unwrap().contains("\"two_words\""));
    succeed("dynabs-check", &["convert", odd.to_str().unwrap(), &at("c.drn")]);
}
