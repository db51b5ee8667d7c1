//! Small files that other tools wrote, beside what they mean. How they were made: scripts/check-formats.py.

use super::*;
use imdp::formats::drn::DrnWriter;

fn recorded(name: &str) -> PathBuf {
    crate::common::root().join("tests/formats/data").join(name)
}

fn as_drn(path: &Path) -> String {
    let model = read(path);
    let mut text = vec![];
    DrnWriter::new(&model).unwrap().write(&mut text, &()).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn files_of_other_tools_are_read() {
    for name in ["prism.umb", "storm.umb", "umbi.umb", "storm.drn", "prism-chain.umb"] {
        let expected = std::fs::read_to_string(recorded(&format!("{name}.expected"))).unwrap();
        assert_eq!(as_drn(&recorded(name)), expected, "{name}");
    }
}
