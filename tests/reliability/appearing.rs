//! How output appears: whole or not at all, and with nothing left over.

use super::{check, compile, compiled, contents, names, room, shell};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const A: &str = "3 3 4\n0 0 1 [0.9,0.9]\n0 0 2 [0.1,0.1]\n1 0 1 [1,1]\n2 0 2 [1,1]\n";
const B: &str = "3 3 4\n0 0 1 [0.2,0.2]\n0 0 2 [0.8,0.8]\n1 0 1 [1,1]\n2 0 2 [1,1]\n";

/// Two models of three files; mixed, they give 0.1 or 0.2 instead of 0.9 or 0.8.
fn two_models(directory: &Path) {
    let labels = |goal: u32| format!("0=\"init\" 1=\"deadlock\" 2=\"goal\"\n0: 0\n{goal}: 2\n");
    for (name, transitions, goal) in [("a", A, 1), ("b", B, 2)] {
        fs::write(directory.join(format!("{name}.tra")), transitions).unwrap();
        fs::write(directory.join(format!("{name}.lab")), labels(goal)).unwrap();
    }
}

fn value(directory: &Path) -> f64 {
    let model = directory.join("m.tra");
    let ended = check(&["solve", model.to_str().unwrap(), "--json", "-q", "-p", "Pmaxmin=? [ F \"goal\" ]"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let object: serde_json::Value = serde_json::from_str(&ended.out).unwrap();
    object["results"][0]["lower"].as_f64().unwrap()
}

/// F05, at every point where the files are on their way: the state in which a process was killed is made here.
#[test]
fn several_files_appear_together() {
    let scratch = TempDir::new().unwrap();
    let at = |name: &str| scratch.path().join(name);
    two_models(scratch.path());
    for moved in 0..=3 {
        for name in ["a", "b"] {
            assert_eq!(
                shell(scratch.path(), &format!("$check convert {name}.tra {name}-new.tra --force -q")).code,
                Some(0)
            );
        }
        let journal = at(".dynabs-1f-2e-0.files");
        fs::create_dir(&journal).unwrap();
        for (i, extension) in ["tra", "sta", "lab"].iter().enumerate() {
            let target = at(&format!("m.{extension}"));
            let _ = fs::copy(at(&format!("a-new.{extension}")), &target);
            let new = at(&format!("b-new.{extension}"));
            let _ = fs::copy(new, if i < moved { target } else { journal.join(format!("m.{extension}")) });
        }
        assert!((value(scratch.path()) - 0.8).abs() < 1e-9, "{moved}");
        assert!(!journal.exists());
    }
    // What did not count yet goes with the next command that writes there.
    let part = at(".dynabs-1f-2e-0.part");
    fs::create_dir(&part).unwrap();
    fs::write(part.join("m.lab"), "half").unwrap();
    assert!((value(scratch.path()) - 0.8).abs() < 1e-9);
    assert_eq!(shell(scratch.path(), "$check convert a.tra m.tra --force -q").code, Some(0));
    assert!((value(scratch.path()) - 0.9).abs() < 1e-9);
    assert!(!part.exists());
}

/// F04: a run is exchanged at once, also while somebody reads it.
#[cfg(target_os = "linux")]
#[test]
fn a_run_is_exchanged_at_once() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    let writer = "for seed in 1 2 3 4 5 6 7 8 9 10; do $compile $room -q --no-tra -o run --force --seed $seed || exit 9; done";
    let reader = "while [ ! -e done ]; do $check solve run -q || exit 8; $check simulate run -q --runs 10 || exit 7; done";
    let line = format!("({writer}; code=$?; touch done; exit $code) & {reader}; wait $!");
    let ended = shell(scratch.path(), &line);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(names(scratch.path()), ["done", "run"]);
    assert!(!scratch.path().join("run/model.tra").exists(), "nothing of the earlier run stays");
}

/// Where a directory has to stay, its files are moved in; whatever was done of that, the next command does the rest.
#[test]
fn a_directory_that_has_to_stay_is_finished_by_the_next_command() {
    let scratch = TempDir::new().unwrap();
    let (old, new) = (compiled(scratch.path(), "old"), scratch.path().join("new"));
    let sets = ["--set", "/partition/cells=[24]", "--no-tra", "-q", "-o", new.to_str().unwrap()];
    assert_eq!(compile(&[&[room().to_str().unwrap()], &sets[..]].concat()).code, Some(0));
    let (before, after) = (contents(&old), contents(&new));
    // Stale files are removed, the manifest goes, the others move in, the manifest last.
    let stale: Vec<_> = before.keys().filter(|name| !after.contains_key(*name)).cloned().collect();
    let mut moved: Vec<_> = after.keys().filter(|name| *name != "manifest.json").cloned().collect();
    moved.push("manifest.json".into());
    for done in 0..=stale.len() + 1 + moved.len() {
        let run = scratch.path().join(format!("run{done}"));
        let journal = run.join(".dynabs-1f-2e-0.run");
        fs::create_dir_all(&journal).unwrap();
        fs::write(run.join("notes.txt"), "mine").unwrap();
        before.iter().for_each(|(name, bytes)| fs::write(run.join(name), bytes).unwrap());
        after.iter().for_each(|(name, bytes)| fs::write(journal.join(name), bytes).unwrap());
        stale.iter().take(done).for_each(|name| fs::remove_file(run.join(name)).unwrap());
        if done > stale.len() {
            fs::remove_file(run.join("manifest.json")).unwrap();
        }
        for name in moved.iter().take(done.saturating_sub(stale.len() + 1)) {
            fs::rename(journal.join(name), run.join(name)).unwrap();
        }
        let ended = check(&["solve", run.to_str().unwrap(), "-q"]);
        assert!(ended.code.is_some_and(|code| code <= 1), "{done}: {}", ended.err);
        let mut found = contents(&run);
        assert_eq!(found.remove("notes.txt").unwrap(), b"mine");
        assert_eq!(found, after, "{done}");
        assert!(!journal.exists());
    }
}

/// Such directories are the current one, and those with directories of the user's; both keep what is the user's.
#[test]
fn directories_that_have_to_stay_are_replaced_file_by_file() {
    let scratch = TempDir::new().unwrap();
    let lines = [
        (
            "mkdir here && cd here && $compile $room -q -o . && $compile $room -q -o . --force --no-tra && ls -A && pwd -P",
            true,
        ),
        (
            "$compile $room -q -o run && mkdir run/plots && echo mine > run/plots/a && $compile $room -q -o run --force --no-tra && cat run/plots/a && ls -A run",
            true,
        ),
        (
            "mkdir -p old && $compile $room -q -o old/run && ln -s old/run link && $compile $room -q -o link --force --no-tra && readlink link && ls -A link/",
            true,
        ),
    ];
    for (line, _) in lines {
        let ended = shell(scratch.path(), line);
        assert_eq!(ended.code, Some(0), "{line}: {}", ended.err);
        assert!(
            ended.out.contains("model.dynabs") && !ended.out.contains("model.tra"),
            "{line}: {}",
            ended.out
        );
        assert!(!ended.out.contains(".dynabs-"), "{line}: {}", ended.out);
    }
    assert_eq!(names(scratch.path()), ["here", "link", "old", "run"]);
}

/// Who loses a race for a directory says so, and nothing of either is mixed or left over.
#[test]
fn losers_of_a_race_say_so() {
    let scratch = TempDir::new().unwrap();
    for round in 0..6 {
        let force = if round % 2 == 0 { "" } else { "--force" };
        let line = format!(
            "rm -rf run; {}
             for seed in 1 2 3; do ($compile $room -q --no-tra -o run {force} --seed $seed 2> err$seed; echo $? > code$seed) & done; wait
             cat code1 code2 code3; $check simulate run -q --runs 10",
            if force.is_empty() { "" } else { "$compile $room -q -o run" }
        );
        let ended = shell(scratch.path(), &line);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        let codes: Vec<&str> = ended.out.lines().collect();
        assert!(codes.contains(&"0"), "{codes:?}");
        for (seed, code) in (1..).zip(&codes) {
            let error = fs::read_to_string(scratch.path().join(format!("err{seed}"))).unwrap();
            match *code {
                "0" => assert_eq!(error, ""),
                "2" => assert!(error.contains("found"), "{error}"),
                "4" => assert!(error.contains("another process wrote"), "{error}"),
                other => panic!("exit code {other}: {error}"),
            }
        }
        if force.is_empty() {
            assert_eq!(codes.iter().filter(|code| **code == "0").count(), 1, "{codes:?}");
        }
        assert!(names(scratch.path()).iter().all(|name| !name.starts_with('.')));
    }
}

/// F06: what cannot be renamed leaves nothing behind, and is refused before the work.
#[test]
fn a_name_that_is_too_long_leaves_nothing() {
    let scratch = TempDir::new().unwrap();
    let ended = shell(scratch.path(), "$compile $room -q -o $(printf 'a%.0s' $(seq 256))");
    assert_eq!(ended.code, Some(4), "{}", ended.err);
    assert!(ended.err.contains("name too long"), "{}", ended.err);
    let ended = shell(
        scratch.path(),
        "$compile $room -q -o run; $check solve run -q --values $(printf 'a%.0s' $(seq 256))",
    );
    assert_eq!(ended.code, Some(4), "{}", ended.err);
    assert_eq!(names(scratch.path()), ["run"]);
}

/// F18, with a limit on the size of files in place of a full disk: there is nothing, or the old file.
#[cfg(unix)]
#[test]
fn a_file_that_does_not_fit_leaves_the_old_one() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    fs::write(scratch.path().join("old"), "old").unwrap();
    for command in [
        "$compile --init m.json",
        "$check diff run --write-reference old",
        "$check solve run -q --values old --certificate certificate",
        "$check controller run -q -o c.json",
        "$check simulate run -q --runs 100 --trajectories old",
        "$check report run -q -o page.html --runs 100 --svg svg",
        "$check convert run m.tra -q",
        "$compile $room -q -o other",
        "$compile $room -q -o run --force",
    ] {
        let before = contents(&scratch.path().join("run"));
        let ended = shell(scratch.path(), &format!("ulimit -f 0; {command}"));
        assert_eq!(ended.code, Some(4), "{command}: {}", ended.err);
        assert!(ended.err.contains("File too large"), "{command}: {}", ended.err);
        assert_eq!(fs::read_to_string(scratch.path().join("old")).unwrap(), "old", "{command}");
        assert_eq!(contents(&scratch.path().join("run")), before, "{command}");
        let left: Vec<_> = names(scratch.path()).into_iter().filter(|name| name != "svg").collect();
        assert_eq!(left, ["old", "run"], "{command}");
    }
    let ended = shell(scratch.path(), "$compile --init m.json -q && $compile --init m.json");
    assert_eq!(ended.code, Some(2), "{}", ended.err);
}

/// A folder that cannot be written to. Root may write anywhere, so for root it is one that does not exist.
#[cfg(unix)]
#[test]
fn a_read_only_folder_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    let folder = scratch.path().join("folder");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).unwrap();
    let is_root = fs::write(folder.join("probe"), "").is_ok();
    let place = if is_root { "/proc/none" } else { "folder" };
    for command in [
        "$compile $room -q -o",
        "$check solve run -q --values",
        "$check convert run/model.dynabs --to umb -q",
    ] {
        let ended = shell(scratch.path(), &format!("{command} {place}/output"));
        assert_eq!(ended.code, Some(4), "{command}: {}", ended.err);
        assert!(ended.err.contains(place), "{command}: {}", ended.err);
    }
}
