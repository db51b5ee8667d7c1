//! Which files belong to a model.

use std::path::{Path, PathBuf};

use crate::formats::import::without_packing;

/// The explicit files of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExplicitFiles {
    /// The transitions.
    pub tra: PathBuf,
    /// The variables of the states.
    pub sta: Option<PathBuf>,
    /// The labels.
    pub lab: Option<PathBuf>,
    /// State rewards, in the order of the structures.
    pub srew: Vec<PathBuf>,
    /// Transition rewards, in the order of the structures.
    pub trew: Vec<PathBuf>,
}

impl ExplicitFiles {
    /// The transitions at `tra` and whatever exists beside them under the same name, compressed or not.
    ///
    /// Several reward structures are `name1.srew`, `name2.srew`, … as PRISM calls them.
    pub fn beside(tra: &Path) -> Self {
        let stem = without_packing(tra).with_extension("");
        let rewards = |extension: &str| {
            let numbered = (1..)
                .map_while(|number: usize| existing(&with_suffix(&stem, &format!("{number}.{extension}"))));
            let only = existing(&with_suffix(&stem, &format!(".{extension}")));
            only.map_or_else(|| numbered.collect(), |only| vec![only])
        };
        let beside = |extension: &str| existing(&with_suffix(&stem, extension));
        Self {
            tra: tra.to_owned(),
            sta: beside(".sta"),
            lab: beside(".lab"),
            srew: rewards("srew"),
            trew: rewards("trew"),
        }
    }

    /// The files that `path` means: those of an argument of PRISM's, or those beside a `.tra` file.
    pub fn of(path: &Path) -> Self {
        Self::listed(path).unwrap_or_else(|| Self::beside(path))
    }

    /// The files that an argument of PRISM's `-importmodel` means: `m.tra,sta,lab` or `m.all`.
    ///
    /// `None` if it is no such argument, or if it names no file of transitions that exists.
    pub fn listed(argument: &Path) -> Option<Self> {
        let (stem, extensions) = argument.to_str()?.rsplit_once('.')?;
        let at = |extension: &str| PathBuf::from(format!("{stem}.{extension}"));
        if extensions == "all" {
            return existing(&at("tra")).map(|tra| Self::beside(&tra));
        }
        let mut listed = extensions.split(',').map(str::trim);
        let tra =
            existing(&at(listed.next().filter(|first| *first == "tra" && extensions.contains(','))?))?;
        let mut files = Self { tra, sta: None, lab: None, srew: vec![], trew: vec![] };
        for extension in listed {
            let all = Self::beside(&files.tra);
            match extension {
                "sta" => files.sta = Some(at("sta")),
                "lab" => files.lab = Some(at("lab")),
                "srew" => files.srew = all.srew,
                "trew" => files.trew = all.trew,
                "rew" => (files.srew, files.trew) = (all.srew, all.trew),
                _ => return None,
            }
        }
        Some(files)
    }

    /// All of them, transitions first.
    pub fn all(&self) -> Vec<PathBuf> {
        let one = [Some(&self.tra), self.sta.as_ref(), self.lab.as_ref()];
        one.into_iter().flatten().chain(&self.srew).chain(&self.trew).cloned().collect()
    }
}

fn with_suffix(stem: &Path, suffix: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(suffix);
    PathBuf::from(name)
}

/// The file, or the compressed one in its place.
fn existing(path: &Path) -> Option<PathBuf> {
    let packed = [".gz", ".xz"].map(|suffix| with_suffix(path, suffix));
    std::iter::once(path.to_owned()).chain(packed).find(|path| path.exists())
}
