//! What is asked, as IntervalMDP.jl writes it.

use super::{AVOID, REACH};
use crate::formats::import::{ImportError, Position};
use crate::model::{Labels, RewardStructure, StateSet};
use serde::Deserialize;
use std::path::Path;

#[derive(Debug, Deserialize)]
struct File {
    property: PropertyEntry,
    satisfaction_mode: SatisfactionMode,
    strategy_mode: StrategyMode,
}

#[derive(Debug, Deserialize)]
struct PropertyEntry {
    #[serde(rename = "type")]
    kind: Kind,
    infinite_time: bool,
    time_horizon: Option<u64>,
    #[serde(default)]
    reach: Vec<Index>,
    #[serde(default)]
    avoid: Vec<Index>,
    #[serde(default)]
    reward: Vec<f64>,
    discount: Option<f64>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    Reachability,
    ReachAvoid,
    Reward,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SatisfactionMode {
    Pessimistic,
    Optimistic,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum StrategyMode {
    Maximize,
    Minimize,
}

/// A state, counted from 1, alone or as a tuple of one.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Index {
    Number(u64),
    Tuple([u64; 1]),
}

/// What a specification says about the states, and what it asks in PRISM's syntax.
#[derive(Debug, Default)]
pub(super) struct Specification {
    pub labels: Labels,
    pub rewards: Vec<RewardStructure>,
    pub property: String,
}

impl Specification {
    /// Reads the specification of a model with so many states; nothing if there is no such file.
    pub(super) fn read(path: &Path, states: u64) -> Result<Self, ImportError> {
        let text = match crate::files::read(path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Self::default()),
            Err(error) => return Err(ImportError::io(path, error)),
        };
        let mut source = serde_json::Deserializer::from_slice(&text);
        let file: File = serde_path_to_error::deserialize(&mut source).map_err(|error| {
            let (line, column) = (error.inner().line() as u64, error.inner().column() as u32);
            let found = format!("{} at {}", error.inner(), error.path());
            Position::text(path, line, column).refuse("a specification of IntervalMDP.jl", found)
        })?;
        file.interpret(path, states)
    }
}

impl File {
    fn interpret(self, path: &Path, states: u64) -> Result<Specification, ImportError> {
        let refuse = |expected: &str, found: String| Position::text(path, 1, 1).refuse(expected, found);
        let set = |indices: &[Index]| {
            let mut set = StateSet::with_capacity(states as usize);
            for index in indices {
                let (Index::Number(state) | Index::Tuple([state])) = *index;
                if !(1..=states).contains(&state) {
                    return Err(refuse(&format!("states from 1 to {states}"), state.to_string()));
                }
                set.insert(state as usize - 1);
            }
            Ok(set)
        };
        let PropertyEntry { kind, infinite_time, time_horizon, reach, avoid, reward, discount } =
            self.property;
        let steps = match (infinite_time, time_horizon) {
            (true, _) => String::new(),
            (false, Some(steps)) => format!("<={steps}"),
            (false, None) => return Err(refuse("a time_horizon, for infinite_time is false", "none".into())),
        };
        let optimum = match (self.strategy_mode, self.satisfaction_mode) {
            (StrategyMode::Maximize, SatisfactionMode::Pessimistic) => "maxmin",
            (StrategyMode::Maximize, SatisfactionMode::Optimistic) => "maxmax",
            (StrategyMode::Minimize, SatisfactionMode::Optimistic) => "minmin",
            (StrategyMode::Minimize, SatisfactionMode::Pessimistic) => "minmax",
        };
        let mut specification = Specification::default();
        match kind {
            Kind::Reachability | Kind::ReachAvoid => {
                specification.labels.insert(REACH, set(&reach)?);
                let mut path = format!("F{steps} \"{REACH}\"");
                if kind == Kind::ReachAvoid {
                    specification.labels.insert(AVOID, set(&avoid)?);
                    path = format!("!\"{AVOID}\" U{steps} \"{REACH}\"");
                }
                specification.property = format!("P{optimum}=? [ {path} ]");
            }
            Kind::Reward => {
                if reward.len() as u64 != states {
                    return Err(refuse(
                        &format!("{states} rewards, one for each state"),
                        reward.len().to_string(),
                    ));
                }
                specification
                    .rewards
                    .push(RewardStructure { states: reward, ..RewardStructure::new("reward") });
                let discount = match discount {
                    Some(discount) if discount != 1.0 => format!(", discount={discount}"),
                    _ => String::new(),
                };
                specification.property = format!("R{{\"reward\"}}{optimum}=? [ C{steps}{discount} ]");
            }
        }
        Ok(specification)
    }
}
