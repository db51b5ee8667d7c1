//! Arguments and files that once made a panic, or something that could not be read again.

use super::{check, compile, compiled, data, program, room};
use std::fs;
use tempfile::TempDir;

/// F11: a time that no clock can hold.
#[test]
fn times_beyond_any_clock_are_refused() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(scratch.path(), "run");
    for time in ["1e20", "1e300", "inf", "nan", "-1", "0"] {
        let option = format!("--time-limit={time}");
        let ended = check(&["solve", run.to_str().unwrap(), &option]);
        assert_eq!(ended.code, Some(2), "{time}: {}", ended.err);
        assert!(ended.err.contains("--time-limit"), "{time}: {}", ended.err);
    }
}

/// F12: paths that are no text.
#[cfg(unix)]
#[test]
fn paths_that_are_no_text_are_shown() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let scratch = TempDir::new().unwrap();
    let path = scratch.path().join(OsStr::from_bytes(b"\xffx"));
    let run = |name: &str, arguments: &[&str]| -> super::Ended {
        let mut command = program(name);
        let paths = arguments
            .iter()
            .map(|argument| if *argument == "PATH" { path.as_os_str() } else { OsStr::new(argument) });
        command.current_dir(scratch.path()).args(paths).output().unwrap().into()
    };
    let room = room();
    let json = |text: &str| serde_json::from_str::<serde_json::Value>(text).map(|_| ());
    let ended = run("dynabs-compile", &[room.to_str().unwrap(), "-o", "PATH", "--json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    json(&ended.out).unwrap();
    for arguments in [
        &["crosscheck", "PATH", "--with", "prism", "--prism", "/bin/true", "--json"][..],
        &["solve", "PATH", "--json"],
        &["diff", "PATH", "PATH", "--json"],
        &["simulate", "PATH", "--json", "--runs", "10"],
    ] {
        let ended = run("dynabs-check", arguments);
        assert!(ended.code.is_some_and(|code| code <= 3), "{arguments:?}: {}", ended.err);
        json(&ended.out).unwrap();
    }
    for arguments in [
        &["controller", "PATH", "-o", "c.json"][..],
        &["report", "PATH", "-o", "r.html", "--runs", "10"],
        &["convert", "PATH", "m.drn"],
    ] {
        assert_eq!(run("dynabs-check", arguments).code, Some(0), "{arguments:?}");
    }
}

/// F13: a formula that is as deep as can be read is written as deep as can be read.
#[test]
fn properties_are_written_as_they_can_be_read() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(scratch.path(), "run");
    let certificate = scratch.path().join("certificate");
    let deep =
        |levels: usize| format!("Pmaxmin=? [ F {}true{} ]\n", "true!=(".repeat(levels), ")".repeat(levels));
    for levels in [1, 2, 23, 24, 40, 44] {
        let props = scratch.path().join("deep.props");
        fs::write(&props, deep(levels)).unwrap();
        let arguments = ["solve", run.to_str().unwrap(), "-q", "-p", props.to_str().unwrap()];
        let ended = check(&[&arguments[..], &["--certificate", certificate.to_str().unwrap()]].concat());
        assert_eq!(ended.code, Some(0), "{levels}: {}", ended.err);
        let ended = check(&["verify", certificate.to_str().unwrap(), run.to_str().unwrap()]);
        assert_eq!(ended.code, Some(0), "{levels}: {}", ended.err);
    }
    assert_eq!(fs::read_to_string(data("13.props")).unwrap(), deep(23));
    let property: imdp::property::Property = deep(2).parse().unwrap();
    assert_eq!(property.to_string(), "Pmaxmin=? [ F (true != (true != true)) ]");
}

/// F14: a horizon beyond what PRISM, and we, can read.
#[test]
fn horizons_that_no_property_can_have_are_refused() {
    for (model, horizon) in [("room_temperature", "2147483648"), ("double_integrator", "4294967296")] {
        let path = crate::common::root().join(format!("models/{model}.json"));
        let set = format!("/task/horizon={horizon}");
        let ended = compile(&[path.to_str().unwrap(), "--dry-run", "-q", "--set", &set]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains("/task/horizon") && ended.err.contains(horizon), "{}", ended.err);
    }
}

/// F15: rows that the reader accepts are rows to the checker.
#[test]
fn a_certificate_of_rounded_rows_is_accepted() {
    let scratch = TempDir::new().unwrap();
    let certificate = scratch.path().join("certificate");
    let model = data("15.dynabs");
    let model = model.to_str().unwrap();
    let solve = [
        "solve",
        model,
        "-q",
        "-p",
        "Pmaxmin=? [ F<=3 \"goal\" ]",
        "--certificate",
        certificate.to_str().unwrap(),
    ];
    let solved = check(&solve);
    match solved.code {
        Some(0) => assert_eq!(check(&["verify", certificate.to_str().unwrap(), model]).code, Some(0)),
        code => assert!(code == Some(2) && solved.err.contains("15.dynabs"), "{}", solved.err),
    }
}
