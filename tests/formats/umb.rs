//! UMB: reproducible bytes, what is refused and where, and that damage never panics.

use super::*;
use imdp::formats::umb::{Compression, UmbWriter, import};
use imdp::formats::{ImportError, Imported};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{Read, Write};

fn bytes(model: &IntervalMdp, compression: Compression) -> Vec<u8> {
    let mut out = vec![];
    UmbWriter::new(model).unwrap().write(&mut out, compression, &()).unwrap();
    out
}

fn import_bytes(bytes: &[u8]) -> Result<Imported, ImportError> {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("m.umb");
    std::fs::write(&path, bytes).unwrap();
    import(&path)
}

/// The members of an archive by name.
type Members = BTreeMap<String, Vec<u8>>;

fn members(archive: &[u8]) -> Members {
    let mut tar = tar::Archive::new(archive);
    let entries = tar.entries().unwrap().map(|entry| {
        let mut entry = entry.unwrap();
        let mut content = vec![];
        entry.read_to_end(&mut content).unwrap();
        (entry.path().unwrap().to_str().unwrap().to_owned(), content)
    });
    entries.collect()
}

fn archive(members: &Members) -> Vec<u8> {
    let mut tar = tar::Builder::new(vec![]);
    for (name, content) in members {
        let mut header = tar::Header::new_gnu();
        header.set_size(content.len() as u64);
        header.set_mode(0o644);
        header.set_cksum();
        tar.append_data(&mut header, name, content.as_slice()).unwrap();
    }
    tar.into_inner().unwrap()
}

#[test]
fn bytes_depend_on_the_model_alone() {
    let model = tiny::model();
    let plain = bytes(&model, Compression::None);
    assert_eq!(plain, bytes(&model, Compression::None));
    assert_eq!(plain.len() as u64, UmbWriter::new(&model).unwrap().bytes());
    let packed = bytes(&model, Compression::Gzip);
    assert_eq!(packed, bytes(&model, Compression::Gzip));
    assert!(packed.len() < plain.len() / 4, "{} of {}", packed.len(), plain.len());
    // No name, no time, no system.
    assert_eq!(packed[..10], [0x1f, 0x8b, 8, 0, 0, 0, 0, 0, packed[8], 255]);
    assert_eq!(import_bytes(&plain).unwrap().model, import_bytes(&packed).unwrap().model);
}

#[test]
fn lower_bounds_of_zero_are_raised_in_the_file_only() {
    let model = tiny::model();
    let members = members(&bytes(&model, Compression::None));
    let bounds: Vec<f64> = members["branch-to-probability.bin"]
        .chunks_exact(8)
        .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
        .collect();
    assert!(bounds.iter().all(|&bound| bound > 0.0));
    // 1e-300 is a bound of this model, so that zeros are written as another number.
    let index: Value = serde_json::from_slice(&members["index.json"]).unwrap();
    assert_eq!(index["file-data"]["parameters"]["zero-lower-bound"], 1e-300f64.next_down());
    let again = import_bytes(&bytes(&model, Compression::Gzip)).unwrap().model;
    assert_eq!(again.rows().to_stored().row(RowId(0)).lower, [0.2, 0.0]);
    assert!(again.rows().to_stored().iter().any(|row| row.lower.contains(&1e-300)));
}

#[test]
fn mistakes_are_refused_with_their_place() {
    fn put(members: &mut Members, name: &str, at: usize, bytes: &[u8]) {
        members.get_mut(name).unwrap()[at..at + bytes.len()].copy_from_slice(bytes);
    }
    fn index(members: &mut Members, change: impl Fn(&mut Value)) {
        let mut value: Value = serde_json::from_slice(&members["index.json"]).unwrap();
        change(&mut value);
        members.insert("index.json".into(), serde_json::to_vec(&value).unwrap());
    }
    type Change = fn(&mut Members);
    let cases: &[(Change, &str, &[&str])] = &[
        (|m| drop(m.remove("index.json")), "index.json", &["no such member"]),
        (|m| drop(m.insert("index.json".into(), b"{".to_vec())), "index.json", &["an index of UMB"]),
        (|m| index(m, |i| i["format-version"] = json!(2)), "index.json", &["format-version 1", "found 2"]),
        (
            |m| index(m, |i| i["transition-system"]["time"] = json!("stochastic")),
            "index.json",
            &["discrete time"],
        ),
        (
            |m| index(m, |i| i["transition-system"]["#players"] = json!(2)),
            "index.json",
            &["at most 1 player"],
        ),
        (|m| index(m, |i| i["transition-system"]["#states"] = json!(-1)), "index.json", &["an index of UMB"]),
        (|m| index(m, |i| i["transition-system"]["#states"] = json!(0)), "index.json", &["between 1 and"]),
        (
            |m| index(m, |i| i["transition-system"]["#states"] = json!(4_000_000_000u64)),
            "state-is-initial.bin",
            &["bytes"],
        ),
        (
            |m| index(m, |i| i["transition-system"]["#observations"] = json!(1)),
            "index.json",
            &["no observations"],
        ),
        (
            |m| index(m, |i| i["transition-system"]["branch-probability-type"]["type"] = json!("rational")),
            "index.json",
            &["double-interval or double", "rational"],
        ),
        (
            |m| {
                index(m, |i| {
                    i["annotations"]["rewards"] =
                        json!({ "cost": { "applies-to": ["states"], "type": { "type": "double" } } })
                })
            },
            "annotations/rewards/cost/states/values.bin",
            &["rewards", "no such member"],
        ),
        (
            |m| index(m, |i| i["annotations"]["aps"]["bad"]["alias"] = json!("goal")),
            "index.json",
            &["every label once"],
        ),
        (
            |m| index(m, |i| i["annotations"]["aps"]["bad"]["alias"] = json!("init")),
            "annotations/aps/bad/states/values.bin",
            &["init"],
        ),
        (
            |m| index(m, |i| i["transition-system"]["#choices"] = json!(8)),
            "choice-to-branches.bin",
            &["9 entries of 8 bytes"],
        ),
        (
            |m| index(m, |i| i["transition-system"]["#branches"] = json!(9)),
            "branch-to-target.bin",
            &["9 entries of 8 bytes"],
        ),
        (
            |m| index(m, |i| i["transition-system"]["#initial-states"] = json!(1)),
            "state-is-initial.bin",
            &["1 initial states"],
        ),
        (
            |m| put(m, "state-is-initial.bin", 0, &[0]),
            "state-is-initial.bin",
            &["2 initial states", "found 0"],
        ),
        (|m| put(m, "state-is-initial.bin", 0, &[64]), "state-is-initial.bin[6]", &["no state from 5 on"]),
        (|m| put(m, "state-to-choices.bin", 0, &[1]), "state-to-choices.bin[0]", &["expected 0"]),
        (|m| put(m, "state-to-choices.bin", 8, &[9]), "state-to-choices.bin[1]", &["between 0 and 7"]),
        (
            |m| put(m, "choice-to-branches.bin", 8, &[0]),
            "choice-to-branches.bin[0]",
            &["a choice with branches"],
        ),
        (|m| put(m, "choice-to-branches.bin", 24, &[1]), "choice-to-branches.bin[3]", &["between 3 and 10"]),
        (
            |m| put(m, "branch-to-target.bin", 8, &[5]),
            "branch-to-target.bin[1]",
            &["destination below 5", "found 5"],
        ),
        (
            |m| put(m, "branch-to-target.bin", 8, &[1]),
            "branch-to-target.bin[1]",
            &["every destination of a choice once"],
        ),
        (
            |m| put(m, "branch-to-probability.bin", 24, &0.1f64.to_le_bytes()),
            "branch-to-probability.bin[0]",
            &["sum to at least 1", "found 0.6"],
        ),
        (
            |m| put(m, "branch-to-probability.bin", 16, &0.9f64.to_le_bytes()),
            "branch-to-probability.bin[1]",
            &["at least 0.9", "found 0.8"],
        ),
        (
            |m| put(m, "branch-to-probability.bin", 24, &1.5f64.to_le_bytes()),
            "branch-to-probability.bin[1]",
            &["between 0 and 1", "1.5"],
        ),
        (
            |m| put(m, "branch-to-probability.bin", 16, &f64::NAN.to_le_bytes()),
            "branch-to-probability.bin[1]",
            &["NaN"],
        ),
        (
            |m| put(m, "branch-to-probability.bin", 16, &(-0.5f64).to_le_bytes()),
            "branch-to-probability.bin[1]",
            &["-0.5"],
        ),
        (|m| drop(m.remove("branch-to-target.bin")), "branch-to-target.bin", &["no such member"]),
        (|m| drop(m.remove("state-to-choices.bin")), "state-to-choices.bin", &["no such member"]),
        (
            |m| drop(m.remove("annotations/aps/goal/states/values.bin")),
            "annotations/aps/goal/states/values.bin",
            &["no such member"],
        ),
        (
            |m| drop(m.remove("valuations/states/valuations.bin")),
            "valuations/states/valuations.bin",
            &["no such member"],
        ),
        (
            |m| put(m, "actions/choices/values.bin", 4, &[9]),
            "actions/choices/values.bin[1]",
            &["a name below 4", "found 9"],
        ),
        (|m| put(m, "actions/choices/strings.bin", 0, &[0xff]), "actions/choices/strings.bin[0]", &["UTF-8"]),
        (
            |m| put(m, "actions/choices/string-mapping.bin", 8, &[200]),
            "actions/choices/string-mapping.bin[1]",
            &["between 0 and 5"],
        ),
        (
            |m| {
                index(m, |i| {
                    i["valuations"]["states"]["classes"][0]["variables"][0]["type"] =
                        json!({ "type": "uint", "size": 32 });
                })
            },
            "valuations/states/valuations.bin[1]",
            &["x1", "one beyond"],
        ),
        (
            |m| {
                index(m, |i| {
                    drop(i["valuations"]["states"]["classes"][0]["variables"].as_array_mut().unwrap().pop())
                })
            },
            "index.json",
            &["whole bytes", "33 bits"],
        ),
    ];
    let original = members(&bytes(&tiny::model(), Compression::None));
    assert!(import_bytes(&archive(&original)).is_ok());
    for (number, (change, place, words)) in cases.iter().enumerate() {
        let mut members = original.clone();
        change(&mut members);
        let Err(error) = import_bytes(&archive(&members)) else {
            panic!("case {number}, {place}, is accepted")
        };
        let message = error.to_string();
        assert!(
            message.contains(&format!("m.umb:{place}: found")),
            "case {number}: {message}, not at {place}"
        );
        for word in *words {
            assert!(message.contains(word), "case {number}: {message}, without {word}");
        }
    }
}

#[test]
fn what_may_be_left_out_may_be_left_out() {
    let mut parts = parts(&tiny::model());
    let mut choices = ChoicesBuilder::with_capacity(5);
    (0..5).for_each(|_| choices.push_absorbing());
    (parts.choices, parts.rows, parts.kind) = (choices.finish(), Rows::new().into(), ModelKind::Idtmc);
    parts.actions = ActionNames::None;
    let model = IntervalMdp::new(parts).unwrap();
    let mut all = members(&bytes(&model, Compression::None));
    for name in ["state-to-choices.bin", "choice-to-branches.bin", "branch-to-probability.bin"] {
        all.remove(name).unwrap();
    }
    assert_eq!(import_bytes(&archive(&all)).unwrap().model, model);
}

#[test]
fn what_no_property_asks_about_is_noted() {
    let mut all = members(&bytes(&tiny::model(), Compression::None));
    let mut index: Value = serde_json::from_slice(&all["index.json"]).unwrap();
    index["annotations"]["aps"]["bad"]["applies-to"] = json!(["choices"]);
    index["valuations"]["states"]["classes"][0]["variables"][0]["type"] =
        json!({ "type": "double", "size": 32 });
    all.insert("index.json".into(), serde_json::to_vec(&index).unwrap());
    all.insert("other/file.bin".into(), vec![1]);
    let imported = import_bytes(&archive(&all)).unwrap();
    let warnings: Vec<_> = imported.warnings.iter().map(ToString::to_string).collect();
    for word in ["aps/bad", "variables of states", "other/file.bin"] {
        assert!(warnings.iter().any(|warning| warning.contains(word)), "{word}: {warnings:?}");
    }
    assert!(imported.model.labels().get("bad").is_none() && imported.model.variables().is_empty());
}

#[test]
fn damaged_archives_never_panic() {
    let model = tiny::model();
    // One place for thousands of files.
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("m.umb");
    let import_bytes = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        import(&path)
    };
    let again = import_bytes(&bytes(&model, Compression::None)).unwrap().model;
    let plain = bytes(&model, Compression::None);
    let packed = bytes(&model, Compression::Gzip);
    // Cut short: the end of a tar archive is empty blocks, of which nothing is needed.
    for cut in (0..plain.len()).step_by(37) {
        assert!(
            import_bytes(&plain[..cut]).map_or(true, |i| cut > plain.len() - 1024 && i.model == again),
            "{cut}"
        );
    }
    for cut in 0..packed.len() {
        assert!(import_bytes(&packed[..cut]).is_err(), "{cut}");
    }
    // Compressed archives have a checksum: any change of the content is noticed.
    for at in 10..packed.len() {
        let mut damaged = packed.clone();
        damaged[at] ^= 0x15;
        assert!(import_bytes(&damaged).map_or(true, |imported| imported.model == again), "byte {at}");
    }
    let headers = (0..plain.len()).step_by(512).filter(|&at| plain[at] != 0);
    for at in headers.flat_map(|at| at..at + 512).step_by(5).chain((0..plain.len()).step_by(23)) {
        for flip in [0x01, 0xff] {
            let mut damaged = plain.clone();
            damaged[at] ^= flip;
            let _ = import_bytes(&damaged);
        }
    }
    // Sizes that lie, with a checksum that does not.
    for size in [1u64, 513, 1 << 40, u64::MAX >> 1, u64::MAX] {
        let mut header = tar::Header::new_gnu();
        header.set_path("index.json").unwrap();
        header.set_size(size);
        header.set_cksum();
        let mut damaged = header.as_bytes().to_vec();
        damaged.write_all(&plain[512..]).unwrap();
        assert!(import_bytes(&damaged).is_err());
    }
}
