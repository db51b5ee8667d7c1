//! `index.json`.

use super::super::member;
use super::archive::Archive;
use crate::formats::import::{ImportError, Position, Warning};
use crate::model::{ModelKind, StateId};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::io::Read;

/// No index is as long.
const LONGEST: u64 = 64 << 20;

/// What the index says, as far as it is about interval models.
#[derive(Debug)]
pub(super) struct Index {
    pub kind: ModelKind,
    pub counts: Counts,
    /// Branches have intervals, not plain probabilities.
    pub intervals: bool,
    /// Per label, its identifier and its name.
    pub labels: Vec<(String, String)>,
    /// The reward structures.
    pub rewards: Vec<RewardEntry>,
    /// The variables of states, if they are of a kind that can be read.
    pub variables: Option<ValuationClass>,
    /// There is an annotation of ours about states without choices.
    pub without_choices: bool,
    /// What lower bounds of 0 are written as.
    pub zero_lower_bound: Option<f64>,
    pub warnings: Vec<Warning>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct Counts {
    #[serde(rename = "#players")]
    players: u64,
    #[serde(rename = "#states")]
    pub states: u64,
    #[serde(rename = "#initial-states")]
    pub initial: u64,
    #[serde(rename = "#choices")]
    pub choices: u64,
    #[serde(rename = "#choice-actions")]
    pub choice_actions: u64,
    #[serde(rename = "#branches")]
    pub branches: u64,
    #[serde(rename = "#branch-actions")]
    pub branch_actions: u64,
    #[serde(rename = "#observations", default)]
    observations: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct IndexFile {
    format_version: u64,
    #[serde(default)]
    file_data: FileData,
    transition_system: TransitionSystem,
    #[serde(default)]
    annotations: Map<String, Value>,
    #[serde(default)]
    valuations: Map<String, Value>,
}

#[derive(Debug, Default, Deserialize)]
struct FileData {
    tool: Option<String>,
    #[serde(default)]
    parameters: Value,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct TransitionSystem {
    time: String,
    #[serde(flatten)]
    counts: Counts,
    branch_probability_type: Option<SizedType>,
}

/// A type and how many bits its values take.
#[derive(Debug, Deserialize)]
pub(super) struct SizedType {
    #[serde(rename = "type")]
    pub name: String,
    pub size: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Annotation {
    alias: Option<String>,
    #[serde(default)]
    applies_to: Vec<String>,
    #[serde(rename = "type")]
    kind: SizedType,
}

#[derive(Debug, Deserialize)]
struct Valuation {
    classes: Vec<ValuationClass>,
}

/// How the variables of a state are packed.
#[derive(Debug, Deserialize)]
pub(super) struct ValuationClass {
    pub variables: Vec<Field>,
}

/// Some bits of a state's variables.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Field {
    /// Bits without a meaning.
    Padding {
        /// How many.
        padding: u64,
    },
    /// A variable.
    #[serde(rename_all = "kebab-case")]
    Variable {
        name: String,
        #[serde(rename = "type")]
        kind: SizedType,
        #[serde(default)]
        is_optional: bool,
        #[serde(default)]
        offset: Option<i64>,
    },
}

/// A reward structure: what earns something.
#[derive(Debug)]
pub(super) struct RewardEntry {
    /// Where it is in the archive.
    pub id: String,
    /// What it is called.
    pub name: String,
    /// States, choices, branches.
    pub applies_to: Vec<String>,
}

impl Index {
    /// Reads the index of an archive.
    ///
    /// # Errors
    /// [`ImportError`] if it is missing or malformed, or says that this is no interval MDP or interval DTMC.
    pub(super) fn read(archive: &Archive) -> Result<Self, ImportError> {
        let at = || Position::member(archive.path(), member::INDEX, None);
        let refuse = |expected: &str, found: &str| Err(at().refuse(expected, found));
        let Some(source) = archive.read(member::INDEX)? else {
            return refuse("an index", "no such member");
        };
        let mut text = vec![];
        let read = source.take(LONGEST).read_to_end(&mut text);
        read.map_err(|error| at().refuse("an index", error.to_string()))?;
        let file: IndexFile = parse(&text).map_err(|found| at().refuse("an index of UMB", found))?;
        let TransitionSystem { time, counts, branch_probability_type } = file.transition_system;
        if file.format_version != 1 {
            return refuse("format-version 1", &file.format_version.to_string());
        }
        if time != "discrete" {
            return refuse("discrete time: other models are not supported", &time);
        }
        if counts.observations > 0 {
            return refuse("no observations: they are not supported", &counts.observations.to_string());
        }
        let kind = match counts.players {
            0 => ModelKind::Idtmc,
            1 => ModelKind::Imdp,
            players => return refuse("at most 1 player: games are not supported", &players.to_string()),
        };
        if counts.states == 0 || counts.states > u64::from(StateId::MAX) {
            return refuse(&format!("between 1 and {} states", StateId::MAX), &counts.states.to_string());
        }
        let intervals = match branch_probability_type {
            Some(SizedType { name, size })
                if name == "double-interval" && size.is_none_or(|size| size == 128) =>
            {
                true
            }
            Some(SizedType { name, size }) if name == "double" && size.is_none_or(|size| size == 64) => false,
            Some(other) => return refuse("probabilities of type double-interval or double", &other.name),
            None => return refuse("a type of probabilities", "none"),
        };
        let mut index = Self {
            kind,
            counts,
            intervals,
            labels: vec![],
            rewards: vec![],
            variables: None,
            without_choices: false,
            zero_lower_bound: None,
            warnings: vec![],
        };
        if file.file_data.tool.as_deref() == Some("dynabs") {
            let bound = file.file_data.parameters.get(member::ZERO_LOWER_BOUND).and_then(Value::as_f64);
            index.zero_lower_bound = bound;
        }
        index.read_annotations(file.annotations, archive)?;
        index.read_valuations(file.valuations, archive)?;
        Ok(index)
    }

    fn read_annotations(&mut self, groups: Map<String, Value>, archive: &Archive) -> Result<(), ImportError> {
        let at = || Position::member(archive.path(), member::INDEX, None);
        for (group, annotations) in groups {
            let Value::Object(annotations) = annotations else {
                return Err(at().refuse(
                    format!("a group of annotations /annotations/{group}"),
                    annotations.to_string(),
                ));
            };
            for (id, annotation) in annotations {
                let what = format!("the annotation {group}/{id}");
                let annotation: Annotation = serde_json::from_value(annotation)
                    .map_err(|error| at().refuse(format!("{what} of UMB"), error.to_string()))?;
                if group == member::REWARDS && annotation.is_number() {
                    let name = annotation.alias.unwrap_or_else(|| id.clone());
                    self.rewards.push(RewardEntry { id, name, applies_to: annotation.applies_to });
                    continue;
                }
                let of_states = annotation.applies_to == ["states"] && annotation.kind.name == "bool";
                match group.as_str() {
                    member::APS if of_states => {
                        self.labels.push((id.clone(), annotation.alias.unwrap_or(id)))
                    }
                    member::OWN if of_states && id == member::WITHOUT_CHOICES => self.without_choices = true,
                    _ => self.ignore(archive, what),
                }
            }
        }
        let mut names: Vec<_> = self.labels.iter().map(|(_, name)| name).collect();
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(at().refuse("every label once", format!("\"{}\" twice", pair[0]))),
            None => Ok(()),
        }
    }

    fn read_valuations(
        &mut self,
        valuations: Map<String, Value>,
        archive: &Archive,
    ) -> Result<(), ImportError> {
        for (entity, valuation) in valuations {
            if entity != "states" {
                self.ignore(archive, format!("variables of {entity}"));
                continue;
            }
            let mut valuation: Valuation = serde_json::from_value(valuation).map_err(|error| {
                let at = Position::member(archive.path(), member::INDEX, None);
                at.refuse("a description of variables", error.to_string())
            })?;
            let class = valuation.classes.pop().filter(|_| valuation.classes.is_empty());
            match class.filter(ValuationClass::is_supported) {
                Some(class) => self.variables = Some(class),
                None => self
                    .ignore(archive, "variables of states, which are not all integers and Booleans".into()),
            }
        }
        Ok(())
    }

    /// Notes that something is not read.
    pub(super) fn ignore(&mut self, archive: &Archive, what: String) {
        self.warnings.push(Warning::Ignored { path: archive.path().to_owned(), what });
    }
}

impl Annotation {
    fn is_number(&self) -> bool {
        self.kind.name == "double" && self.kind.size.is_none_or(|size| size == 64)
    }
}

impl ValuationClass {
    fn is_supported(&self) -> bool {
        self.variables.iter().all(|field| match field {
            Field::Padding { .. } => true,
            Field::Variable { kind, is_optional, .. } => {
                let fits = match kind.name.as_str() {
                    "bool" => kind.size.is_none_or(|size| size == 1),
                    "int" | "uint" => kind.size.is_none_or(|size| (1..=64).contains(&size)),
                    _ => false,
                };
                fits && !is_optional
            }
        })
    }
}

fn parse(text: &[u8]) -> Result<IndexFile, String> {
    let mut source = serde_json::Deserializer::from_slice(text);
    let index = serde_path_to_error::deserialize(&mut source);
    index.map_err(|error| format!("{} at {}", error.inner(), error.path()))
}
