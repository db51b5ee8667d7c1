//! Reading PRISM's explicit files: what is refused and where, what is accepted, and that nothing panics.
mod accepted;
mod damage;
mod refused;

use std::path::PathBuf;

use imdp::formats::prism::import;
use imdp::formats::{ImportError, Imported};

const TRA: &str = "3 3 4\n0 0 1 [0.2,0.8] a\n0 0 2 [0.2,0.8] a\n1 0 1 [1,1] b\n2 0 2 [1,1]\n";
const STA: &str = "(x,b)\n0:(3,true)\n1:(-1,false)\n2:(0,true)\n";
const LAB: &str = "0=\"init\" 1=\"deadlock\" 2=\"goal\"\n0: 0\n1: 2\n";

struct Files {
    directory: tempfile::TempDir,
}

impl Files {
    fn new(tra: &[u8], sta: Option<&[u8]>, lab: &[u8]) -> Self {
        let files = Self { directory: tempfile::tempdir().unwrap() };
        std::fs::write(files.tra(), tra).unwrap();
        std::fs::write(files.tra().with_extension("lab"), lab).unwrap();
        if let Some(sta) = sta {
            std::fs::write(files.tra().with_extension("sta"), sta).unwrap();
        }
        files
    }

    fn tra(&self) -> PathBuf {
        self.directory.path().join("m.tra")
    }

    fn import(&self) -> Result<Imported, ImportError> {
        import(&self.tra(), None, None)
    }
}

fn import_texts(tra: &str, sta: Option<&str>, lab: &str) -> Result<Imported, ImportError> {
    Files::new(tra.as_bytes(), sta.map(str::as_bytes), lab.as_bytes()).import()
}

/// Checks the position and the words of a refusal.
fn assert_refused(what: &str, outcome: Result<Imported, ImportError>, place: &str, words: &[&str]) {
    let Err(error) = outcome else { panic!("{what:?} is accepted") };
    let message = error.to_string();
    assert!(message.contains(&format!("{place}: found")), "{what:?}: {message}, not at {place}");
    for word in words {
        assert!(message.contains(word), "{what:?}: {message}, without {word}");
    }
}
