//! A model and a deterministic automaton, step by step together.

use super::EvaluationError;
use crate::automaton::{Acceptor, Condition};
use crate::model::{
    ActionNames, ChoicesBuilder, IntervalMdp, Labels, Parts, RewardStructure, RowBuffer, RowId, RowRange,
    Rows, StateId, StateSet, StateVariables, require_memory,
};
use crate::solver::{Acceptance, accepting_states};
use std::collections::HashMap;

/// What a state of the product takes in memory.
const BYTES: u64 = 160;

/// How many states are made between two looks at the memory.
const STRIDE: usize = 1 << 18;

/// A model and an automaton that reads the labels of its states.
pub(super) struct Product {
    pub(super) model: IntervalMdp,
    /// For every state of the original, where a run that starts in it begins.
    pub(super) starts: Vec<StateId>,
    /// States from which the formula is satisfied whatever comes.
    pub(super) satisfied: StateSet,
    pub(super) conditions: Vec<Acceptance>,
    /// The states of the model and of the automaton that its states are.
    pairs: Vec<(StateId, u32)>,
    /// For every choice, the one of the model that it is, if it is one.
    origins: Vec<Option<u64>>,
}

/// Puts states of the model and of the automaton together, as they are met.
struct Pairs<'a> {
    automaton: &'a mut dyn Acceptor,
    letters: &'a [u64],
    ids: HashMap<(StateId, u32), StateId>,
    pairs: Vec<(StateId, u32)>,
}

impl Pairs<'_> {
    /// The pair that is met when the model moves to `state` while the automaton is in `memory`.
    fn enter(&mut self, state: StateId, memory: u32) -> Result<StateId, EvaluationError> {
        let memory = self.automaton.step(memory, self.letters[state.index()])?;
        let next = StateId::from_index(self.pairs.len());
        let id = *self.ids.entry((state, memory)).or_insert(next);
        if id == next {
            self.pairs.push((state, memory));
            if self.pairs.len().is_multiple_of(STRIDE) {
                require_memory("the product of model and automaton", BYTES * STRIDE as u64)?;
            }
        }
        Ok(id)
    }
}

impl Product {
    pub(super) fn new(
        model: &IntervalMdp,
        automaton: &mut dyn Acceptor,
        letters: &[u64],
    ) -> Result<Self, EvaluationError> {
        let mut pairs = Pairs { automaton, letters, ids: HashMap::new(), pairs: vec![] };
        let starts = StateId::first(model.num_states())
            .map(|state| pairs.enter(state, 0))
            .collect::<Result<Vec<_>, _>>()?;
        let (mut rows, mut buffer) = (Rows::new(), RowBuffer::default());
        let mut known: HashMap<(Option<RowId>, StateId, u32), RowId> = HashMap::new();
        let mut choices = ChoicesBuilder::with_capacity(starts.len());
        let (mut satisfied, mut origins) = (vec![], vec![]);
        let first_choices = model.choices().first_choices();
        let mut next = 0;
        while let Some(&(state, memory)) = pairs.pairs.get(next) {
            next += 1;
            if let Some(outcome) = pairs.automaton.decided(memory) {
                satisfied.push(outcome);
                choices.push_absorbing();
                origins.push(None);
                continue;
            }
            satisfied.push(false);
            // A state that stays where it is goes on reading its letter.
            let own: Vec<Option<RowId>> = match model.choices().ranges(state).is_empty() {
                true => vec![None],
                false => model.choices().rows(state).map(Some).collect(),
            };
            for (row, number) in own.into_iter().zip(0u64..) {
                origins.push(row.map(|_| first_choices[state.index()] + number));
                let key = (row, if row.is_none() { state } else { StateId(0) }, memory);
                let id = match known.get(&key) {
                    Some(&id) => id,
                    None => {
                        match row.map(|row| model.rows().row(row, &mut buffer)) {
                            None => rows.push_entry(pairs.enter(state, memory)?, 1.0, 1.0),
                            Some(row) => {
                                let mut entries = vec![];
                                for (position, &successor) in row.successors.iter().enumerate() {
                                    entries.push((pairs.enter(successor, memory)?, position));
                                }
                                entries.sort_unstable();
                                entries
                                    .into_iter()
                                    .for_each(|(s, position)| rows.push_entry_of(s, row, position));
                            }
                        }
                        let id = rows.finish_row();
                        known.insert(key, id);
                        id
                    }
                };
                choices.push_range(RowRange { first: id, last: id });
            }
            choices.finish_state();
        }
        let states = pairs.pairs.len();
        let mut initial = StateSet::with_capacity(states);
        starts.iter().for_each(|&state| initial.insert(state.index()));
        let conditions = pairs.automaton.conditions().to_vec();
        let met = |check: usize| {
            let mut set = StateSet::with_capacity(states);
            let decides =
                |(_, (_, memory)): &(usize, &(StateId, u32))| pairs.automaton.decides(*memory, check);
            pairs.pairs.iter().enumerate().filter(decides).for_each(|(state, _)| set.insert(state));
            set
        };
        let acceptance = |Condition { finitely, infinitely }: Condition| {
            let mut none = StateSet::with_capacity(states);
            finitely.into_iter().for_each(|check| none.union_with(&met(check)));
            // Where it is decided, nothing is left to be checked.
            pairs.pairs.iter().enumerate().for_each(|(state, &(_, memory))| {
                if pairs.automaton.decided(memory).is_some() {
                    none.insert(state);
                }
            });
            Acceptance { finitely: none, infinitely: infinitely.into_iter().map(met).collect() }
        };
        let conditions = conditions.into_iter().map(acceptance).collect();
        let mut set = StateSet::with_capacity(states);
        satisfied.into_iter().enumerate().for_each(|(state, outcome)| set.set(state, outcome));
        let parts = Parts {
            kind: model.kind(),
            rows,
            choices: choices.finish(),
            actions: ActionNames::None,
            initial,
            labels: Labels::default(),
            variables: StateVariables::default(),
        };
        let model = IntervalMdp::new(parts).map_err(|error| EvaluationError::Product(error.to_string()))?;
        let Pairs { pairs, .. } = pairs;
        Ok(Self { model, starts, satisfied: set, conditions, pairs, origins })
    }

    /// What is earned in the product, where nothing is decided yet; `model` is the one that it was made of.
    pub(super) fn rewards(&self, model: &IntervalMdp, rewards: &RewardStructure) -> RewardStructure {
        let mut own = RewardStructure::new(&rewards.name);
        own.states = self.pairs.iter().map(|&(state, _)| rewards.of_state(state.index())).collect();
        let of_choice = |origin: &Option<u64>| origin.map_or(0.0, |choice| rewards.of_choice(choice));
        own.choices = self.origins.iter().map(of_choice).collect();
        let mut choice = 0u64;
        for (product, &(state, _)) in (0..).zip(&self.pairs) {
            if self.model.choices().is_absorbing(StateId(product)) {
                choice += 1;
                continue;
            }
            let (mut of_model_row, mut of_product_row) = (RowBuffer::default(), RowBuffer::default());
            let of_model: Vec<RowId> = model.choices().rows(state).collect();
            for (number, row) in self.model.choices().rows(StateId(product)).enumerate() {
                let of_branches =
                    self.origins[choice as usize].and_then(|origin| rewards.branches.get(&origin));
                if let (Some(of_branches), Some(&original)) = (of_branches, of_model.get(number)) {
                    let original = model.rows().row(original, &mut of_model_row);
                    let earned = |successor: &StateId| {
                        let (state, _) = self.pairs[successor.index()];
                        original
                            .successors
                            .binary_search(&state)
                            .map_or(0.0, |position| of_branches[position])
                    };
                    let row = self.model.rows().row(row, &mut of_product_row);
                    own.branches.insert(choice, row.successors.iter().map(earned).collect());
                }
                choice += 1;
            }
        }
        own
    }

    /// Where the formula is satisfied almost surely by a policy that stays; `helpful` says whether nature helps.
    pub(super) fn goal(&self, helpful: bool) -> StateSet {
        let mut goal = accepting_states(&self.model, &self.conditions, helpful);
        goal.union_with(&self.satisfied);
        goal
    }
}
