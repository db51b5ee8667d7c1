//! F19: no name in a file moves the cursor of the terminal.

use super::{compile, compiled, room, shell};
use std::fs;
use tempfile::TempDir;

#[test]
fn control_characters_are_spelled_out() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    let ended = compile(&[room().to_str().unwrap(), "--dry-run", "--set", "/name=\u{1b}[31mX\u{202e}"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains("\\u001b[31mX\\u202e"), "{}", ended.out);
    fs::write(scratch.path().join("m.drn"), "@type: MDP\n@value_type: double-interval\n@nr_states\n1\n@nr_choices\n1\n@model\nstate 0 init \u{1b}[31mX\n\taction 0\n\t\t0 : [1, 1]\n").unwrap();
    for line in [
        "$compile $room --dry-run --set $'/\\e[31mX=1'",
        "$compile $room --dry-run --set $'/noise={\"samples\":{\"file\":\"x.csv\",\"of\":\"step\"}}' --set $'/noise/samples/file=\\e[31mX'",
        "printf '\\033[31mX\\n' > x.csv; $check simulate run --noise x.csv",
        "printf '{\"\\\\u001b[31mX\": 1}' > x.json; $compile x.json --dry-run",
        "$check solve m.drn -p $'Pmaxmin=? [ F \"\\e[31mX\" ]'",
        "$check convert m.drn m.tra",
        "$check solve $'\\e[31mX'",
        "$check $'\\e[31mX'",
        "$compile $'\\e[31mX' --dry-run",
    ] {
        let ended = shell(scratch.path(), line);
        // Any label can be asked for, and is renamed where a format has identifiers only.
        let code = if line.contains("m.drn") { 0 } else { 2 };
        assert_eq!(ended.code, Some(code), "{line}: {}", ended.err);
        let raw = |c: char| c.is_control() && c != '\n' && c != '\t';
        assert!(!ended.out.contains(raw) && !ended.err.contains(raw), "{line}: {:?}", ended.err);
        // The parser of arguments takes such sequences out itself.
        let shown = if line.starts_with("$check $'") { "X" } else { "31mX" };
        assert!((ended.out + &ended.err).contains(shown), "{line}");
    }
}
