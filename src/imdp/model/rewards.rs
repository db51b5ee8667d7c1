//! What a run earns (or costs) on its way.

use std::collections::BTreeMap;

/// A reward structure: what is earned in a state, by a choice and on a branch, all of it at least 0.
///
/// A visit to state `s` that leaves it by choice `c` towards `t` earns `states[s] + choices[c] + branches[c][t]`.
/// Rewards are the shortest decimals that give the doubles, as bounds of rows are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RewardStructure {
    /// The name; empty if it has none.
    pub name: String,
    /// By state; empty if nothing is earned in any state.
    pub states: Vec<f64>,
    /// By choice, counted over all states (self-loops of absorbing states included); empty if no choice earns anything.
    pub choices: Vec<f64>,
    /// By choice, then by position in its row; only choices whose branches differ.
    pub branches: BTreeMap<u64, Vec<f64>>,
}

/// The reward structures of a model, in the order in which they were declared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rewards {
    structures: Vec<RewardStructure>,
}

/// What makes a reward structure not one of a model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RewardError {
    /// There is not one value for each.
    #[error(
        "the rewards \"{name}\": found {found} values for {what}; expected {expected}, as many as the model has"
    )]
    Length {
        /// The structure.
        name: String,
        /// States or choices.
        what: &'static str,
        /// How many values there are.
        found: u64,
        /// How many there should be.
        expected: u64,
    },
    /// A reward is negative or not finite.
    #[error("the rewards \"{name}\": found {value}; expected finite numbers of at least 0")]
    Value {
        /// The structure.
        name: String,
        /// The value.
        value: f64,
    },
    /// Two structures have the same name.
    #[error("found two reward structures \"{name}\"; expected one of each name")]
    Twice {
        /// The name.
        name: String,
    },
}

impl RewardStructure {
    /// No rewards yet.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    /// What is earned in a state, whatever it does there.
    pub fn of_state(&self, state: usize) -> f64 {
        self.states.get(state).copied().unwrap_or(0.0)
    }

    /// What a choice earns, whatever comes of it.
    pub fn of_choice(&self, choice: u64) -> f64 {
        usize::try_from(choice).ok().and_then(|choice| self.choices.get(choice)).copied().unwrap_or(0.0)
    }

    /// What a branch of a choice earns besides, by its position in the row.
    pub fn of_branch(&self, choice: u64, position: usize) -> f64 {
        self.branches.get(&choice).and_then(|branches| branches.get(position)).copied().unwrap_or(0.0)
    }

    /// Sets what branches earn, by choice and position in its row; choices that earn nothing else and whose branches all
    /// earn the same are as well those that earn it.
    pub fn set_branches(&mut self, branches: BTreeMap<u64, Vec<f64>>, choices: u64) {
        for (choice, of_branches) in branches {
            let same = of_branches.windows(2).all(|pair| pair[0] == pair[1]) && self.of_choice(choice) == 0.0;
            match of_branches.first() {
                Some(&reward) if same => {
                    self.choices.resize(choices as usize, 0.0);
                    self.choices[choice as usize] = reward;
                }
                _ => {
                    self.branches.insert(choice, of_branches);
                }
            }
        }
    }

    fn values(&self) -> impl Iterator<Item = f64> {
        self.states.iter().chain(&self.choices).chain(self.branches.values().flatten()).copied()
    }
}

impl Rewards {
    /// No structures yet, but those given.
    ///
    /// # Errors
    /// [`RewardError`] if one does not fit a model of this size.
    pub fn new(structures: Vec<RewardStructure>, states: u64, choices: u64) -> Result<Self, RewardError> {
        for (i, structure) in structures.iter().enumerate() {
            let name = || structure.name.clone();
            if structures[..i]
                .iter()
                .any(|earlier| !earlier.name.is_empty() && earlier.name == structure.name)
            {
                return Err(RewardError::Twice { name: name() });
            }
            let sizes =
                [("states", structure.states.len(), states), ("choices", structure.choices.len(), choices)];
            for (what, found, expected) in sizes {
                if found > 0 && found as u64 != expected {
                    return Err(RewardError::Length { name: name(), what, found: found as u64, expected });
                }
            }
            // Written so that NaN fails.
            if let Some(value) = structure.values().find(|value| !(0.0..f64::INFINITY).contains(value)) {
                return Err(RewardError::Value { name: name(), value });
            }
        }
        Ok(Self { structures })
    }

    /// All structures.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &RewardStructure> {
        self.structures.iter()
    }

    /// The structure of this name.
    pub fn get(&self, name: &str) -> Option<&RewardStructure> {
        self.structures.iter().find(|structure| structure.name == name)
    }

    /// The structure of this number, counted from 0.
    pub fn nth(&self, index: usize) -> Option<&RewardStructure> {
        self.structures.get(index)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.structures.is_empty()
    }
}
