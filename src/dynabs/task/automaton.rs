//! A task that is an automaton over named regions.

use super::{Aim, NamedRegion, Standing};
use imdp::automaton::Dfa;

/// What is wanted, as a minimal automaton that reads at every step in which regions the state is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AutomatonTask {
    dfa: Dfa,
    aim: Aim,
    regions: Vec<NamedRegion>,
    statement: String,
    source: Option<String>,
}

impl AutomatonTask {
    /// A task over `regions`, which are the propositions of `dfa` in their order; `statement` says it in words: "the run …".
    pub fn new(dfa: &Dfa, aim: Aim, regions: Vec<NamedRegion>, statement: impl Into<String>) -> Self {
        debug_assert_eq!(dfa.propositions() as usize, regions.len());
        Self { dfa: dfa.minimal(aim), aim, regions, statement: statement.into(), source: None }
    }

    /// With the text of the file that it was read from.
    #[must_use]
    pub fn with_source(self, source: Option<String>) -> Self {
        Self { source, ..self }
    }

    /// The text of the file that it was read from, if it was.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// How states of the automaton decide a run.
    pub fn aim(&self) -> Aim {
        self.aim
    }

    /// The regions that are looked at.
    pub fn regions(&self) -> &[NamedRegion] {
        &self.regions
    }

    /// The task in words.
    pub fn statement(&self) -> &str {
        &self.statement
    }

    /// The automaton.
    pub fn dfa(&self) -> &Dfa {
        &self.dfa
    }

    /// Whether nothing that comes changes the outcome of a state of the automaton: it succeeds (`true`) or fails for good.
    pub(super) fn decided(&self, state: u32) -> Option<bool> {
        let accepts = self.dfa.accepts(state);
        match self.aim {
            Aim::Reach if accepts => Some(true),
            Aim::Stay if !accepts => Some(false),
            _ => self.dfa.is_sink(state).then_some(accepts),
        }
    }

    /// The state of the automaton as the standing of a run, if it is decided.
    pub(super) fn outcome(&self, state: u32) -> Option<Standing> {
        self.decided(state).map(|succeeds| if succeeds { Standing::Reached } else { Standing::Failed })
    }
}
