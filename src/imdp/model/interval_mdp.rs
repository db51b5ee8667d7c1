//! The interval MDP itself.

use rayon::prelude::*;
use std::borrow::Cow;

use super::{
    Choices, Labels, RewardError, RewardStructure, Rewards, RowBuffer, RowError, RowId, RowSet, StateId,
    StateSet, StateVariables,
};

/// Rows are checked in parallel, at least so many at a time.
const ROWS_PER_TASK: usize = 128;

/// An interval MDP that is known to be well-formed.
///
/// Every row admits a distribution, no id dangles, and there is an initial state.
#[derive(Clone, Debug, PartialEq)]
pub struct IntervalMdp {
    parts: Parts,
    size: Size,
    rewards: Rewards,
}

/// What an [`IntervalMdp`] is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts<R = RowSet> {
    /// Whether there is a policy at all.
    pub kind: ModelKind,
    /// The interval distributions.
    pub rows: R,
    /// The choices of every state.
    pub choices: Choices,
    /// What the choices are called.
    pub actions: ActionNames,
    /// The initial states, at least one.
    pub initial: StateSet,
    /// Further named sets of states.
    pub labels: Labels,
    /// The variables of the states.
    pub variables: StateVariables,
}

/// Who resolves the nondeterminism of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelKind {
    /// An interval MDP: a policy picks choices, nature picks distributions.
    Imdp,
    /// An interval DTMC: nature only. Every state has exactly one choice, or none if it is a deadlock.
    Idtmc,
}

/// The names of choices.
#[derive(Clone, Debug, PartialEq)]
pub enum ActionNames {
    /// Choices have no names.
    None,
    /// A choice is called `a_<row id>`: compiled models, where a row is an action. Self-loops have no name.
    OfRow,
    /// Every choice has its own name or none: imported models.
    OfChoice {
        /// The distinct names.
        names: Vec<String>,
        /// Per choice, in the order of states and their choices (self-loops of absorbing states included),
        /// an index into `names` or [`ActionNames::UNNAMED`].
        ids: Vec<u32>,
    },
}

impl ActionNames {
    /// The index that stands for "this choice has no name".
    pub const UNNAMED: u32 = u32::MAX;

    /// What a choice is called, if it has a name.
    ///
    /// `choice` counts over all states, self-loops of absorbing states included; `row` is the row it leads to,
    /// none for self-loops.
    pub fn name(&self, choice: u64, row: Option<RowId>) -> Option<Cow<'_, str>> {
        match self {
            Self::None => None,
            Self::OfRow => row.map(|row| format!("a_{row}").into()),
            Self::OfChoice { names, ids } => {
                let id = *ids.get(usize::try_from(choice).ok()?)?;
                names.get(id as usize).map(|name| name.as_str().into())
            }
        }
    }
}

/// How large an interval MDP is, counted as PRISM's headers count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// The number of states.
    pub states: u64,
    /// The number of choices, self-loops of absorbing states included.
    pub choices: u64,
    /// The number of transitions when every choice is written out.
    pub transitions: u64,
    /// The number of rows: distinct interval distributions, self-loops not counted.
    pub rows: u64,
    /// The number of entries of all rows: what is stored instead of the transitions.
    pub entries: u64,
}

/// What makes [`Parts`] not an interval MDP.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImdpError {
    /// A row admits no distribution.
    #[error("row {row}: {error}")]
    Row {
        /// The row.
        row: RowId,
        /// What is wrong with it.
        error: RowError,
    },
    /// A row leads to a state that does not exist.
    #[error(
        "row {row}: found the successor {successor}; expected one of the {states} states, numbered from 0"
    )]
    Successor {
        /// The row.
        row: RowId,
        /// The state that does not exist.
        successor: StateId,
        /// The number of states.
        states: usize,
    },
    /// A state has a choice whose row does not exist.
    #[error("state {state}: found a choice of row {row}; expected one of the {rows} rows, numbered from 0")]
    Choice {
        /// The state.
        state: StateId,
        /// The row that does not exist.
        row: RowId,
        /// The number of rows.
        rows: usize,
    },
    /// A set of states or a variable is not about the states of this model.
    #[error("{what}: found {found} states; expected {states}, as many as the model has")]
    Length {
        /// Which set or variable.
        what: String,
        /// How many states it covers.
        found: usize,
        /// The number of states.
        states: usize,
    },
    /// A state of an interval DTMC has a choice to make.
    #[error("state {state}: found {found} choices; expected one, as in all states of an interval DTMC")]
    Chain {
        /// The state.
        state: StateId,
        /// How many choices it has.
        found: usize,
    },
    /// The names of choices are not one for each choice.
    #[error("found {found} entries for the actions of choices; expected {choices}, one for each")]
    ActionCount {
        /// How many entries there are.
        found: usize,
        /// The number of choices.
        choices: u64,
    },
    /// A choice has an action that does not exist.
    #[error("choice {choice}: found the action {id}; expected one of the {names} names, numbered from 0")]
    Action {
        /// The choice, counted over all states.
        choice: usize,
        /// The index that dangles.
        id: u32,
        /// The number of names.
        names: usize,
    },
    /// There is no initial state.
    #[error("found no initial state; expected at least one")]
    NoInitialState,
}

impl IntervalMdp {
    /// Checks the parts and puts them together.
    ///
    /// # Errors
    /// The first [`ImdpError`] found.
    pub fn new<R: Into<RowSet>>(parts: Parts<R>) -> Result<Self, ImdpError> {
        let Parts { kind, rows, choices, actions, initial, labels, variables } = parts;
        let parts = Parts { kind, rows: rows.into(), choices, actions, initial, labels, variables };
        let states = parts.choices.num_states();
        validate_rows(&parts.rows, states)?;
        let rows = parts.rows.len();
        for state in StateId::first(states) {
            let found = parts.choices.ranges(state).iter().map(|range| range.len()).sum();
            if parts.kind == ModelKind::Idtmc && found > 1 {
                return Err(ImdpError::Chain { state, found });
            }
            if let Some(range) = parts.choices.ranges(state).iter().find(|range| range.last.index() >= rows) {
                return Err(ImdpError::Choice { state, row: range.last, rows });
            }
        }
        validate_actions(&parts.actions, parts.choices.num_choices())?;
        let sets = parts.labels.iter().map(|(name, set)| (format!("label \"{name}\""), set.len()));
        let variables = parts.variables.iter().map(|v| (format!("variable {}", v.name), v.num_states()));
        let initial = std::iter::once(("the initial states".to_owned(), parts.initial.len()));
        if let Some((what, found)) = initial.chain(sets).chain(variables).find(|(_, len)| *len != states) {
            return Err(ImdpError::Length { what, found, states });
        }
        if parts.initial.is_clear() {
            return Err(ImdpError::NoInitialState);
        }
        let size = measure(&parts);
        Ok(Self { parts, size, rewards: Rewards::default() })
    }

    /// The same model with other rows.
    ///
    /// # Errors
    /// Those of [`IntervalMdp::new`].
    pub fn with_rows(&self, rows: impl Into<RowSet>) -> Result<Self, ImdpError> {
        let Parts { kind, rows: _, choices, actions, initial, labels, variables } = &self.parts;
        Self::new(Parts {
            kind: *kind,
            rows,
            choices: choices.clone(),
            actions: actions.clone(),
            initial: initial.clone(),
            labels: labels.clone(),
            variables: variables.clone(),
        })
        .map(|model| Self { rewards: self.rewards.clone(), ..model })
    }

    /// The same model with other names: `change` gets the actions, labels and variables.
    ///
    /// # Errors
    /// Those of [`IntervalMdp::new`].
    pub fn renamed(
        mut self,
        change: impl FnOnce(&mut ActionNames, &mut Labels, &mut StateVariables),
    ) -> Result<Self, ImdpError> {
        change(&mut self.parts.actions, &mut self.parts.labels, &mut self.parts.variables);
        let rewards = self.rewards;
        Ok(Self { rewards, ..Self::new(self.parts)? })
    }

    /// The same model with these rewards.
    ///
    /// # Errors
    /// [`RewardError`] if they are not those of such a model.
    pub fn with_rewards(self, structures: Vec<RewardStructure>) -> Result<Self, RewardError> {
        let rewards = Rewards::new(structures, self.size.states, self.size.choices)?;
        Ok(Self { rewards, ..self })
    }

    /// What runs earn.
    pub fn rewards(&self) -> &Rewards {
        &self.rewards
    }

    /// Whether there is a policy at all.
    pub fn kind(&self) -> ModelKind {
        self.parts.kind
    }

    /// How large the model is.
    pub fn size(&self) -> Size {
        self.size
    }

    /// The number of states.
    pub fn num_states(&self) -> usize {
        self.parts.choices.num_states()
    }

    /// The interval distributions.
    pub fn rows(&self) -> &RowSet {
        &self.parts.rows
    }

    /// The choices of every state.
    pub fn choices(&self) -> &Choices {
        &self.parts.choices
    }

    /// What the choices are called.
    pub fn actions(&self) -> &ActionNames {
        &self.parts.actions
    }

    /// The initial states.
    pub fn initial(&self) -> &StateSet {
        &self.parts.initial
    }

    /// Named sets of states, other than `init`.
    pub fn labels(&self) -> &Labels {
        &self.parts.labels
    }

    /// The variables of the states.
    pub fn variables(&self) -> &StateVariables {
        &self.parts.variables
    }
}

/// Fails with the first row that is none, or leads nowhere.
fn validate_rows(rows: &RowSet, states: usize) -> Result<(), ImdpError> {
    let check = |buffer: &mut RowBuffer, index| {
        let row = RowId::from_index(index);
        let entries = rows.row(row, buffer);
        entries.validate().map_err(|error| ImdpError::Row { row, error })?;
        match entries.successors.last() {
            Some(&successor) if successor.index() >= states => {
                Err(ImdpError::Successor { row, successor, states })
            }
            _ => Ok(()),
        }
    };
    let checks = (0..rows.len()).into_par_iter().with_min_len(ROWS_PER_TASK);
    checks.map_init(RowBuffer::default, check).find_first(Result::is_err).unwrap_or(Ok(()))
}

fn validate_actions(actions: &ActionNames, choices: u64) -> Result<(), ImdpError> {
    let ActionNames::OfChoice { names, ids } = actions else {
        return Ok(());
    };
    if ids.len() as u64 != choices {
        return Err(ImdpError::ActionCount { found: ids.len(), choices });
    }
    let dangles = |id: u32| id != ActionNames::UNNAMED && id as usize >= names.len();
    match ids.iter().position(|&id| dangles(id)) {
        Some(choice) => Err(ImdpError::Action { choice, id: ids[choice], names: names.len() }),
        None => Ok(()),
    }
}

fn measure(parts: &Parts) -> Size {
    // Transitions of a range are a difference of prefix sums: no loop over choices.
    let mut before = Vec::with_capacity(parts.rows.len() + 1);
    before.push(0u64);
    let mut total = 0;
    for row in RowId::first(parts.rows.len()) {
        total += parts.rows.row_len(row) as u64;
        before.push(total);
    }
    let states = parts.choices.num_states();
    let of_ranges: u64 = StateId::first(states)
        .flat_map(|state| parts.choices.ranges(state))
        .map(|range| before[range.last.index() + 1] - before[range.first.index()])
        .sum();
    Size {
        states: states as u64,
        choices: parts.choices.num_choices(),
        transitions: of_ranges + parts.choices.absorbing().count_ones(..) as u64,
        rows: parts.rows.len() as u64,
        entries: parts.rows.num_entries() as u64,
    }
}
