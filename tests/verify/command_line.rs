//! `solve --certificate` and `verify`, from the outside.

use crate::common::root;
use assert_cmd::Command;
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

fn run(tool: &str, arguments: &[&str]) -> Output {
    Command::cargo_bin(tool).unwrap().args(arguments).output().unwrap()
}

fn compile(scratch: &Path, name: &str, sets: &[&str]) -> String {
    let out = scratch.join(name).to_str().unwrap().to_owned();
    let model = root().join("models/room_temperature.json");
    let arguments = [&[model.to_str().unwrap(), "-o", &out, "-q"], sets].concat();
    assert!(run("dynabs-compile", &arguments).status.success());
    out
}

/// The exit code, stdout and stderr of `verify`.
fn verify(certificate: &str, path: &str) -> (i32, String) {
    let output = run("dynabs-check", &["verify", certificate, path]);
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap(), String::from_utf8(text).unwrap())
}

#[test]
fn certificates_are_written_and_verified() {
    let scratch = TempDir::new().unwrap();
    let directory = compile(scratch.path(), "room", &[]);
    let other = compile(scratch.path(), "other", &["--set", "/task/horizon=5"]);
    let warmer = compile(scratch.path(), "warmer", &["--set", "/input/upper=[9]"]);
    let tra = format!("{directory}/model.tra");
    let certificate = scratch.path().join("room.cert").to_str().unwrap().to_owned();
    for (path, extra) in [
        (&directory, vec![]),
        (&directory, vec!["--explicit"]),
        (&tra, vec!["-p", "Pmaxmax=? [ F \"reached\" ]"]),
        (&directory, vec!["-p", "Pminmin=? [ G !\"failed\" ]"]),
        (&directory, vec!["-p", "Pmaxmin=? [ X \"reached\" ]"]),
    ] {
        let arguments = [&["solve", path, "--certificate", &certificate], &extra[..]].concat();
        assert!(run("dynabs-check", &arguments).status.success());
        let (code, text) = verify(&certificate, path);
        assert!(code == 0 && text.contains("accepted"), "{extra:?}: {text}");
        let (code, text) = verify(&certificate, &warmer);
        assert!(code == 1 && text.contains("another model was solved"), "{text}");
    }
    // A bounded property of the same model file.
    assert!(run("dynabs-check", &["solve", &directory, "--certificate", &certificate]).status.success());
    assert_eq!(verify(&certificate, &other).0, 0, "the horizon is no part of the model");
    let text = fs::read_to_string(&certificate).unwrap();

    let forged = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        let text = text.replacen(from, to, 1);
        let content = &text[..text.rfind("end ").unwrap()];
        let digest = imdp::formats::sha256_hex(content.as_bytes());
        fs::write(&certificate, format!("{content}end {digest}\n")).unwrap();
        verify(&certificate, &directory)
    };
    let (code, text) = forged("claim 0.99", "claim 0.9999");
    assert!(code == 1 && text.contains("a lower bound 0.9999"), "{text}");
    let (code, text) = forged("U<=6", "U<=1");
    assert!(code == 1 && text.contains("steps; expected 1,"), "{text}");
    let (code, text) = forged("\nlower ", "\nlower 9 ");
    assert!(code == 2 && text.contains("line 8"), "{text}");
    let (code, text) = forged("states 34", "states 33");
    assert!(code == 1 && text.contains("34 states"), "{text}");
    fs::write(&certificate, &text[..text.len() / 2]).unwrap();
    let (code, text) = verify(&certificate, &directory);
    assert!(code == 2, "{text}");
}

#[test]
fn bad_input_is_refused() {
    let scratch = TempDir::new().unwrap();
    let directory = compile(scratch.path(), "room", &[]);
    let certificate = scratch.path().join("room.cert").to_str().unwrap().to_owned();
    let two = ["-p", "Pmaxmin=? [ F \"reached\" ]", "-p", "Pminmin=? [ F \"reached\" ]"];
    let output =
        run("dynabs-check", &[&["solve", &directory, "--certificate", &certificate], &two[..]].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("found 2 properties"));
    let (code, text) = verify(&certificate, &directory);
    assert!(code == 2 && text.contains("room.cert"), "{text}");
    let (code, text) = verify(&format!("{directory}/manifest.json"), &directory);
    assert!(code == 2 && text.contains("not a certificate"), "{text}");
}
