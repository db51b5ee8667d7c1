//! What a task makes of true states, whatever cells say of them.

use super::End;
use crate::partition::{Region, RegionLookup};
use crate::problem::Objective;
use crate::task::{Aim, AutomatonTask, LetterLookup};

/// Watches runs for their task.
#[derive(Clone, Debug)]
pub(super) enum Witness<'a> {
    /// For regions to reach or to keep, and to avoid.
    Regions { aim: Aim, wanted: Vec<RegionLookup>, avoid: Vec<RegionLookup> },
    /// For an automaton.
    Automaton(&'a AutomatonTask, LetterLookup),
}

/// What has been seen of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The state of the automaton.
    state: u32,
    lost: bool,
    satisfied: bool,
}

impl Seen {
    /// Whether nothing that comes changes whether the task is satisfied.
    pub(super) fn is_decided(&self) -> bool {
        self.lost || self.satisfied
    }
}

impl<'a> Witness<'a> {
    pub(super) fn new(objective: &'a Objective, unsafe_: &[Region]) -> Self {
        let lookups = |regions: &[Region]| regions.iter().map(RegionLookup::new).collect();
        match objective {
            Objective::Reach { goal: wanted } | Objective::Stay { safe: wanted } => {
                Self::Regions { aim: objective.aim(), wanted: lookups(wanted), avoid: lookups(unsafe_) }
            }
            Objective::Automaton(task) => Self::Automaton(task, LetterLookup::new(task.regions())),
        }
    }

    pub(super) fn start(&self) -> Seen {
        let state = match self {
            Self::Regions { .. } => 0,
            Self::Automaton(task, _) => task.dfa().start(),
        };
        Seen { state, lost: false, satisfied: false }
    }

    /// Sees the next state.
    pub(super) fn see(&self, seen: &mut Seen, x: &[f64]) {
        match self {
            Self::Regions { aim, wanted, avoid } => {
                let is_wanted = contains(wanted, x) || wanted.is_empty() && *aim == Aim::Stay;
                seen.lost |= contains(avoid, x) || *aim == Aim::Stay && !is_wanted;
                seen.satisfied |= *aim == Aim::Reach && is_wanted && !seen.lost;
            }
            Self::Automaton(task, letters) => {
                seen.state = task.dfa().step(seen.state, letters.letter(x));
                seen.satisfied |= task.aim() == Aim::Reach && task.dfa().accepts(seen.state);
            }
        }
    }

    /// Whether a run that ended so has satisfied the task.
    pub(super) fn is_satisfied(&self, seen: &Seen, end: End) -> bool {
        match self {
            Self::Regions { aim, .. } => {
                seen.satisfied || *aim == Aim::Stay && end == End::Over && !seen.lost
            }
            Self::Automaton(task, _) => match task.aim() {
                Aim::Reach => seen.satisfied,
                Aim::Stay | Aim::End => {
                    matches!(end, End::Over | End::Reached) && task.dfa().accepts(seen.state)
                }
            },
        }
    }
}

fn contains(regions: &[RegionLookup], x: &[f64]) -> bool {
    regions.iter().any(|region| region.contains(x))
}
