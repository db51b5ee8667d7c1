//! Where output goes: through links, devices and pipes, never in place of them.
#![cfg(unix)]

use super::{check, compiled, names, shell};
use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use tempfile::TempDir;

/// F02: a link stays a link, a pipe a pipe, and what they lead to gets the output.
#[test]
fn output_goes_through_links_and_pipes() {
    let scratch = TempDir::new().unwrap();
    let at = |name: &str| scratch.path().join(name);
    let run = compiled(scratch.path(), "run");
    let run = run.to_str().unwrap();
    let expected = |file: &str| fs::read_to_string(at(file)).unwrap();
    assert_eq!(check(&["solve", run, "-q", "--values", at("plain").to_str().unwrap()]).code, Some(0));
    let plain = expected("plain");
    assert_eq!(plain.lines().count(), 34);

    // A link to a file, to a file that does not exist yet, to a link, in a linked directory.
    fs::create_dir(at("inner")).unwrap();
    fs::write(at("inner/file"), "old").unwrap();
    symlink("inner/file", at("link")).unwrap();
    symlink("inner/new", at("dangling")).unwrap();
    symlink("link", at("chain")).unwrap();
    symlink("inner", at("linked")).unwrap();
    for (name, file) in [
        ("link", "inner/file"),
        ("dangling", "inner/new"),
        ("chain", "inner/file"),
        ("linked/third", "inner/third"),
    ] {
        let ended = check(&["solve", run, "-q", "--values", at(name).to_str().unwrap()]);
        assert_eq!(ended.code, Some(0), "{name}: {}", ended.err);
        assert_eq!(expected(file), plain, "{name}");
        fs::write(at("inner/file"), "old").unwrap();
    }
    for name in ["link", "dangling", "chain", "linked"] {
        assert!(fs::symlink_metadata(at(name)).unwrap().is_symlink(), "{name}");
    }

    // A pipe with a reader.
    let ended = shell(
        scratch.path(),
        "mkfifo pipe; cat pipe > read & $check solve run -q --values pipe || exit; wait; exec cmp read plain",
    );
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(fs::symlink_metadata(at("pipe")).unwrap().file_type().is_fifo());
    assert_eq!(names(scratch.path()).iter().filter(|name| name.starts_with('.')).count(), 0);
}

/// Devices are written through. Only links to them are used here: a mistake must not cost the machine its devices.
#[cfg(target_os = "linux")]
#[test]
fn devices_are_written_through() {
    let scratch = TempDir::new().unwrap();
    let at = |name: &str| scratch.path().join(name);
    compiled(scratch.path(), "run");
    let null = fs::metadata("/dev/null").unwrap().file_type();
    for (name, device) in
        [("null", "/dev/null"), ("full", "/dev/full"), ("out", "/dev/stdout"), ("fd", "/dev/fd/5")]
    {
        symlink(device, at(name)).unwrap();
    }
    let solve = "$check solve run -q --values";
    for (line, code, out) in [
        (format!("{solve} null"), 0, ""),
        (format!("{solve} full"), 4, ""),
        (format!("{solve} plain && {solve} out | cmp - plain"), 0, ""),
        (format!("{solve} out > redirected && cmp redirected plain"), 0, ""),
        (format!("{solve} out | cmp - plain"), 0, ""),
        (
            format!(
                "echo first > redirected; {solve} out >> redirected; head -1 redirected; wc -l < redirected"
            ),
            0,
            "first\n35\n",
        ),
        (format!("{solve} fd 5> redirected && cmp redirected plain"), 0, ""),
        ("$check convert run/model.dynabs null --to prism --force".into(), 2, ""),
        (
            "$check convert run/model.dynabs out --to drn -q | tail -c 5; exit ${PIPESTATUS[0]}".into(),
            0,
            "125]\n",
        ),
    ] {
        let ended = shell(scratch.path(), &line);
        assert_eq!((ended.code, ended.out.as_str()), (Some(code), out), "{line}: {}", ended.err);
    }
    assert!(null.is_char_device() && fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    for name in ["null", "full", "out", "fd"] {
        assert!(fs::symlink_metadata(at(name)).unwrap().is_symlink(), "{name}");
    }
    assert_eq!(names(scratch.path()), ["fd", "full", "null", "out", "plain", "redirected", "run"]);
}

/// An output file keeps who may read it.
#[test]
fn permissions_stay() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = TempDir::new().unwrap();
    let run = compiled(scratch.path(), "run");
    let file = scratch.path().join("file");
    let mode = |path: &std::path::Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    fs::write(&file, "old").unwrap();
    for path in [&file, &run] {
        fs::set_permissions(path, fs::Permissions::from_mode(0o700)).unwrap();
    }
    assert_eq!(
        shell(scratch.path(), "$check solve run -q --values file && $compile $room -q -o run --force").code,
        Some(0)
    );
    assert_eq!((mode(&file), mode(&run)), (0o700, 0o700));
}
