//! DRN: what is written.

use crate::tiny;
use dynabs::formats::drn::DrnWriter;

#[test]
fn the_text_is_that_of_storm() {
    let model = tiny::model();
    let writer = DrnWriter::new(&model).unwrap();
    let mut text = Vec::new();
    writer.write(&mut text, &()).unwrap();
    assert_eq!(text.len() as u64, writer.bytes());
    assert_eq!(String::from_utf8(text).unwrap(), include_str!("data/tiny.drn"));
}
