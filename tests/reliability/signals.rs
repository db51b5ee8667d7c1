//! Closed outputs and signals: the exit code says what was found, and nothing is left behind.
#![cfg(unix)]

use super::{compiled, names, program, shell};
use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// F03: the reader of a pipe goes away, or stdout is closed from the start.
#[test]
fn a_closed_output_keeps_the_exit_code() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    let prepared = shell(
        scratch.path(),
        "$compile $room -q -o other --set '/partition/cells=[24]' && $check solve run -q --certificate good &&
         sed '/^claim/s/.*/claim 0.9999 1/; /^end/d' good > bad && echo end $(sha256sum < bad | cut -c1-64) >> bad",
    );
    assert_eq!(prepared.code, Some(0), "{}", prepared.err);
    for (line, code) in [
        ("$check solve run -p '(Pmaxmin=? [ !\"failed\" U<=6 \"reached\" ])>=0.999'", 1),
        ("$check solve run -p 'Pmaxmin=? [ F \"reached\" ]'", 0),
        ("$check solve run --max-iterations 1 -p 'Pmaxmin=? [ F \"reached\" ]'", 3),
        ("$check verify bad run", 1),
        ("$check verify good run", 0),
        ("$check diff run other", 1),
        ("$check simulate run --covariance '[[100]]' --runs 1000", 1),
        ("$compile $room --dry-run --solve --set /task/threshold=0.9999", 1),
        ("$compile --schema", 0),
    ] {
        for closed in ["| true; exit ${PIPESTATUS[0]}", ">&-", ">&- 2>&-"] {
            // The pipe's reader is gone before the first byte.
            let line = if closed.starts_with('|') {
                format!("(sleep 0.05; {line}) {closed}")
            } else {
                format!("{line} {closed}")
            };
            let ended = shell(scratch.path(), &line);
            assert_eq!(ended.code, Some(code), "{line}: {}", ended.err);
            assert_eq!(ended.err.matches("panicked").count(), 0, "{line}: {}", ended.err);
        }
    }
    let ended = shell(scratch.path(), "$check solve run > /dev/full");
    assert_eq!(ended.code, Some(4));
    assert!(ended.err.contains("stdout"), "{}", ended.err);
}

/// F06, F20: a signal while a large output is written ends with code 3 and leaves nothing.
#[test]
fn signals_clean_up() {
    let scratch = TempDir::new().unwrap();
    let model = crate::common::root().join("models/double_integrator.json");
    for signal in ["INT", "TERM", "HUP", "QUIT", "XCPU"] {
        let mut child = program("dynabs-compile")
            .arg(&model)
            .args(["-q", "--format", "prism", "-o"])
            .arg(scratch.path().join("run"))
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let start = Instant::now();
        // Wait until there is something to clean up.
        while names(scratch.path()).is_empty() {
            assert!(
                start.elapsed() < Duration::from_secs(60) && child.try_wait().unwrap().is_none(),
                "{signal}"
            );
            std::thread::sleep(Duration::from_millis(1));
        }
        let pid = child.id().to_string();
        assert!(Command::new("kill").args(["-s", signal, &pid]).status().unwrap().success());
        let ended: super::Ended = child.wait_with_output().unwrap().into();
        assert_eq!(ended.code, Some(3), "{signal}: {}", ended.err);
        assert!(ended.err.contains("interrupted"), "{signal}: {}", ended.err);
        assert!(start.elapsed() < Duration::from_secs(60), "{signal}");
        assert_eq!(names(scratch.path()), [""; 0], "{signal}");
    }
    fs::remove_dir_all(scratch.path()).unwrap();
}

/// A pipe that nobody reads is waited for, but not for ever once the program is asked to end: at the keyboard the second time.
#[test]
fn what_waits_for_a_reader_can_be_ended() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    assert!(Command::new("mkfifo").arg(scratch.path().join("pipe")).status().unwrap().success());
    for (signals, patience) in [(&["INT", "INT"][..], 60), (&["TERM"], 60)] {
        let mut child = program("dynabs-check")
            .current_dir(scratch.path())
            .args(["solve", "run", "-q", "--values", "pipe"])
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_secs(2));
        let start = Instant::now();
        for signal in signals {
            let pid = child.id().to_string();
            assert!(Command::new("kill").args(["-s", signal, &pid]).status().unwrap().success());
            std::thread::sleep(Duration::from_millis(300));
        }
        while child.try_wait().unwrap().is_none() && start.elapsed() < Duration::from_secs(patience) {
            std::thread::sleep(Duration::from_millis(100));
        }
        // What has not ended by now would wait for ever.
        let _ = child.kill();
        let ended: super::Ended = child.wait_with_output().unwrap().into();
        assert_eq!(ended.code, Some(3), "{signals:?}: {}", ended.err);
    }
}
