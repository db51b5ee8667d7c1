//! The checks that the master theorem asks for, for every guess of what holds again and again and what for ever.

use super::formulas::{Dnf, Formulas};
use super::{Condition, LtlError};
use std::collections::{BTreeSet, HashMap};

/// So many formulas with `F G U W R` make as many guesses as there are sets of them.
const MAX_OPERATORS: usize = 10;

/// A check that starts anew when it is decided.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Check {
    /// The remainder of the formula itself as a safety formula, under a guess of what holds again and again.
    Remainder(BTreeSet<u32>),
    /// `G` of a safety formula: decided when it has failed.
    Safety(Dnf),
    /// `F` of a co-safety formula: decided when it has succeeded.
    CoSafety(Dnf),
}

/// All checks, each once, and what is asked of them.
#[derive(Debug)]
pub(super) struct Checks {
    pub(super) checks: Vec<Check>,
    pub(super) conditions: Vec<Condition>,
}

impl Checks {
    /// The checks for a formula.
    pub(super) fn new(formula: &Dnf, formulas: &mut Formulas) -> Result<Self, LtlError> {
        let below = formulas.below(formula);
        let least: Vec<u32> = below.iter().copied().filter(|&id| formulas.is_least(id)).collect();
        let greatest: Vec<u32> = below.iter().copied().filter(|&id| formulas.is_greatest(id)).collect();
        let found = least.len() + greatest.len();
        if found > MAX_OPERATORS {
            return Err(LtlError::Operators { found, limit: MAX_OPERATORS });
        }
        let mut checks = Self { checks: vec![], conditions: vec![] };
        let mut known = HashMap::new();
        for often in subsets(&least) {
            for always in subsets(&greatest) {
                checks.add_guess(&often, &always, formulas, &mut known)?;
            }
        }
        Ok(checks)
    }

    fn add_guess(
        &mut self,
        often: &BTreeSet<u32>,
        always: &BTreeSet<u32>,
        formulas: &mut Formulas,
        known: &mut HashMap<Check, usize>,
    ) -> Result<(), LtlError> {
        let mut condition = Condition { finitely: vec![], infinitely: vec![] };
        let (mut finitely, mut infinitely) = (vec![Check::Remainder(often.clone())], vec![]);
        for &id in often {
            let itself = formulas.modal(formulas.get(id).clone());
            let again = formulas.as_cosafety(&itself, always)?;
            if again.is_false() {
                return Ok(());
            }
            if !again.is_true() {
                infinitely.push(Check::CoSafety(formulas.finally(again)));
            }
        }
        for &id in always {
            let itself = formulas.modal(formulas.get(id).clone());
            let forever = formulas.as_safety(&itself, often)?;
            if forever.is_false() {
                return Ok(());
            }
            if !forever.is_true() {
                finitely.push(Check::Safety(formulas.globally(forever)));
            }
        }
        let mut number = |check: Check| {
            let next = self.checks.len();
            let index = *known.entry(check.clone()).or_insert(next);
            if index == next {
                self.checks.push(check);
            }
            index
        };
        condition.finitely.extend(finitely.into_iter().map(&mut number));
        condition.infinitely.extend(infinitely.into_iter().map(&mut number));
        condition.finitely.sort_unstable();
        condition.infinitely.sort_unstable();
        condition.infinitely.dedup();
        self.conditions.push(condition);
        Ok(())
    }
}

fn subsets(items: &[u32]) -> impl Iterator<Item = BTreeSet<u32>> + '_ {
    (0u32..1 << items.len()).map(|bits| {
        items.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, &item)| item).collect()
    })
}
