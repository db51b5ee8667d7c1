//! A disk of a few MiB, which only root can make: without it, there is a limit on the size of files in `reliability`.

use super::{files, left_over};
use crate::reliability::shell;
use std::path::Path;
use tempfile::TempDir;

#[test]
fn a_full_disk_loses_nothing() {
    let scratch = TempDir::new().unwrap();
    // The disk goes with the last process that sees it.
    let mount = "mkdir disk && mount -t tmpfs -o size=256k tmpfs disk";
    if shell(scratch.path(), &format!("unshare -m bash -c '{mount}'; code=$?; rmdir disk; exit $code")).code
        != Some(0)
    {
        return;
    }
    let prepared = shell(scratch.path(), "$compile $room -q -o run");
    assert_eq!(prepared.code, Some(0), "{}", prepared.err);
    for command in [
        "$compile $room -q -o disk/run --force",
        "$compile --init disk/m.json -q",
        "$check solve run -q --values disk/values --policy disk/policy --certificate disk/certificate",
        "$check convert run disk/m.tra -q --force",
        "$check convert run disk/m.umb -q --force",
        "$check controller run -q -o disk/c.json",
        "$check simulate run -q --runs 1000 --keep 1000 --trajectories disk/runs.csv",
        "$check report run -q --runs 10 -o disk/page.html",
        "$check diff run --write-reference disk/reference.json",
    ] {
        // First it fits, then nothing does; what is there is copied to where it can be seen.
        let keep = if command.contains("--init") { "rm disk/m.json" } else { "cp -r disk/. before" };
        let line = format!(
            "set -e; mkdir disk before after; mount -t tmpfs -o size=8m tmpfs disk; {command}; {keep}
             head -c 64m /dev/zero > disk/filler 2> /dev/null || true
             code=0; {command} 2> message || code=$?; rm disk/filler; cp -r disk/. after; exit $code"
        );
        let script = scratch.path().join("script.sh");
        std::fs::write(&script, line).unwrap();
        let ended = shell(scratch.path(), "exec unshare -m bash script.sh");
        let message = std::fs::read_to_string(scratch.path().join("message")).unwrap_or_default();
        assert!(matches!(ended.code, Some(2 | 4)), "{command}: {:?} {} {message}", ended.code, ended.err);
        assert!(message.contains("No space left") || message.contains("MiB free"), "{command}: {message}");
        let at = |name: &str| scratch.path().join(name);
        assert_eq!(files(&at("after")), files(&at("before")), "{command}");
        assert_eq!(all_left_over(&at("after")), [""; 0], "{command}");
        for name in ["disk", "before", "after"] {
            std::fs::remove_dir_all(at(name)).unwrap();
        }
    }
}

fn all_left_over(directory: &Path) -> Vec<String> {
    [left_over(directory), left_over(&directory.join("run"))].concat()
}
