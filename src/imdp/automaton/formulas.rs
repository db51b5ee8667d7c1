//! What remains of a formula, letter by letter.

use super::LtlError;
use std::collections::{BTreeSet, HashMap};

/// A positive Boolean combination of formulas, as the set of its minimal disjuncts.
///
/// As all of its atoms are positive, this form is the same for equivalent combinations.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Dnf(BTreeSet<BTreeSet<u32>>);

/// More disjuncts than this are given up.
const MAX_DISJUNCTS: usize = 4096;

impl Dnf {
    pub(super) fn truth() -> Self {
        Self(BTreeSet::from([BTreeSet::new()]))
    }

    pub(super) fn falsity() -> Self {
        Self(BTreeSet::new())
    }

    pub(super) fn is_true(&self) -> bool {
        self.0.first().is_some_and(BTreeSet::is_empty)
    }

    pub(super) fn is_false(&self) -> bool {
        self.0.is_empty()
    }

    fn atom(id: u32) -> Self {
        Self(BTreeSet::from([BTreeSet::from([id])]))
    }

    fn minimal(disjuncts: BTreeSet<BTreeSet<u32>>) -> Self {
        let is_minimal = |disjunct: &&BTreeSet<u32>| {
            !disjuncts.iter().any(|other| other != *disjunct && other.is_subset(disjunct))
        };
        Self(disjuncts.iter().filter(is_minimal).cloned().collect())
    }

    pub(super) fn or(&self, other: &Self) -> Self {
        Self::minimal(self.0.union(&other.0).cloned().collect())
    }

    pub(super) fn and(&self, other: &Self) -> Result<Self, LtlError> {
        let mut disjuncts = BTreeSet::new();
        for left in &self.0 {
            for right in &other.0 {
                disjuncts.insert(left.union(right).copied().collect());
            }
        }
        if disjuncts.len() > MAX_DISJUNCTS {
            return Err(LtlError::Size);
        }
        Ok(Self::minimal(disjuncts))
    }

    /// The combination with every atom replaced.
    pub(super) fn replace(
        &self,
        mut meaning: impl FnMut(u32) -> Result<Self, LtlError>,
    ) -> Result<Self, LtlError> {
        let mut result = Self::falsity();
        for disjunct in &self.0 {
            let mut conjunction = Self::truth();
            for &atom in disjunct {
                conjunction = conjunction.and(&meaning(atom)?)?;
            }
            result = result.or(&conjunction);
        }
        Ok(result)
    }

    /// Whether the combination is true if these atoms are.
    pub(super) fn holds(&self, mut atom: impl FnMut(u32) -> bool) -> bool {
        self.0.iter().any(|disjunct| disjunct.iter().all(|&id| atom(id)))
    }

    /// The atoms.
    pub(super) fn atoms(&self) -> BTreeSet<u32> {
        self.0.iter().flatten().copied().collect()
    }
}

/// A formula that is no Boolean combination.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Modal {
    /// A proposition, or its negation.
    Literal(u32, bool),
    Next(Dnf),
    Finally(Dnf),
    Globally(Dnf),
    Until(Dnf, Dnf),
    Weak(Dnf, Dnf),
    Release(Dnf, Dnf),
    /// `a M b`: `b` up to and including the time of the first `a`, which comes.
    Strong(Dnf, Dnf),
}

/// All formulas that occur, by number.
#[derive(Debug, Default)]
pub(super) struct Formulas {
    modals: Vec<Modal>,
    ids: HashMap<Modal, u32>,
}

impl Formulas {
    /// A formula as a combination of one.
    pub(super) fn modal(&mut self, modal: Modal) -> Dnf {
        let next = self.modals.len() as u32;
        let id = *self.ids.entry(modal.clone()).or_insert(next);
        if id == next {
            self.modals.push(modal);
        }
        Dnf::atom(id)
    }

    pub(super) fn get(&self, id: u32) -> &Modal {
        &self.modals[id as usize]
    }

    pub(super) fn finally(&mut self, operand: Dnf) -> Dnf {
        if operand.is_true() || operand.is_false() { operand } else { self.modal(Modal::Finally(operand)) }
    }

    pub(super) fn globally(&mut self, operand: Dnf) -> Dnf {
        if operand.is_true() || operand.is_false() { operand } else { self.modal(Modal::Globally(operand)) }
    }

    pub(super) fn until(&mut self, left: Dnf, right: Dnf) -> Dnf {
        if right.is_true() || right.is_false() || left.is_false() {
            return right;
        }
        if left.is_true() { self.finally(right) } else { self.modal(Modal::Until(left, right)) }
    }

    pub(super) fn weak(&mut self, left: Dnf, right: Dnf) -> Dnf {
        if right.is_true() || left.is_true() {
            return Dnf::truth();
        }
        if left.is_false() {
            return right;
        }
        if right.is_false() { self.globally(left) } else { self.modal(Modal::Weak(left, right)) }
    }

    pub(super) fn release(&mut self, left: Dnf, right: Dnf) -> Dnf {
        if right.is_true() || right.is_false() || left.is_true() {
            return right;
        }
        if left.is_false() { self.globally(right) } else { self.modal(Modal::Release(left, right)) }
    }

    pub(super) fn strong(&mut self, left: Dnf, right: Dnf) -> Dnf {
        if right.is_false() || left.is_false() {
            return Dnf::falsity();
        }
        if left.is_true() {
            return right;
        }
        if right.is_true() { self.finally(left) } else { self.modal(Modal::Strong(left, right)) }
    }

    /// What remains of a combination after a letter, the set of the propositions that hold.
    pub(super) fn after(&self, formula: &Dnf, letter: u64) -> Result<Dnf, LtlError> {
        formula.replace(|id| self.after_modal(id, letter))
    }

    fn after_modal(&self, id: u32, letter: u64) -> Result<Dnf, LtlError> {
        let itself = || Dnf::atom(id);
        Ok(match self.get(id) {
            Modal::Literal(proposition, positive) => {
                if (letter >> proposition & 1 == 1) == *positive {
                    Dnf::truth()
                } else {
                    Dnf::falsity()
                }
            }
            Modal::Next(operand) => operand.clone(),
            Modal::Finally(operand) => self.after(operand, letter)?.or(&itself()),
            Modal::Globally(operand) => self.after(operand, letter)?.and(&itself())?,
            Modal::Until(left, right) | Modal::Weak(left, right) => {
                let goes_on = self.after(left, letter)?.and(&itself())?;
                self.after(right, letter)?.or(&goes_on)
            }
            Modal::Release(left, right) | Modal::Strong(left, right) => {
                let goes_on = self.after(left, letter)?.or(&itself());
                self.after(right, letter)?.and(&goes_on)?
            }
        })
    }

    /// All formulas below a combination, itself's atoms included.
    pub(super) fn below(&self, formula: &Dnf) -> BTreeSet<u32> {
        let mut found = BTreeSet::new();
        let mut open: Vec<u32> = formula.atoms().into_iter().collect();
        while let Some(id) = open.pop() {
            if !found.insert(id) {
                continue;
            }
            match self.get(id) {
                Modal::Literal(..) => {}
                Modal::Next(operand) | Modal::Finally(operand) | Modal::Globally(operand) => {
                    open.extend(operand.atoms())
                }
                Modal::Until(left, right)
                | Modal::Weak(left, right)
                | Modal::Release(left, right)
                | Modal::Strong(left, right) => open.extend(left.atoms().into_iter().chain(right.atoms())),
            }
        }
        found
    }

    /// `φ[X]_ν`: `F U M` become what `X` says, which leaves a safety formula.
    pub(super) fn as_safety(&mut self, formula: &Dnf, often: &BTreeSet<u32>) -> Result<Dnf, LtlError> {
        let mut meanings = HashMap::new();
        for id in formula.atoms() {
            let meaning = match self.get(id).clone() {
                Modal::Literal(..) => Dnf::atom(id),
                Modal::Next(operand) => {
                    let operand = self.as_safety(&operand, often)?;
                    if operand.is_true() || operand.is_false() {
                        operand
                    } else {
                        self.modal(Modal::Next(operand))
                    }
                }
                Modal::Globally(operand) => {
                    let operand = self.as_safety(&operand, often)?;
                    self.globally(operand)
                }
                Modal::Weak(left, right) => {
                    let (left, right) = (self.as_safety(&left, often)?, self.as_safety(&right, often)?);
                    self.weak(left, right)
                }
                Modal::Release(left, right) => {
                    let (left, right) = (self.as_safety(&left, often)?, self.as_safety(&right, often)?);
                    self.release(left, right)
                }
                Modal::Finally(_) => {
                    if often.contains(&id) {
                        Dnf::truth()
                    } else {
                        Dnf::falsity()
                    }
                }
                Modal::Until(left, right) if often.contains(&id) => {
                    let (left, right) = (self.as_safety(&left, often)?, self.as_safety(&right, often)?);
                    self.weak(left, right)
                }
                Modal::Strong(left, right) if often.contains(&id) => {
                    let (left, right) = (self.as_safety(&left, often)?, self.as_safety(&right, often)?);
                    self.release(left, right)
                }
                Modal::Until(..) | Modal::Strong(..) => Dnf::falsity(),
            };
            meanings.insert(id, meaning);
        }
        formula.replace(|id| Ok(meanings[&id].clone()))
    }

    /// `φ[Y]_μ`: `G W R` become what `Y` says, which leaves a co-safety formula.
    pub(super) fn as_cosafety(&mut self, formula: &Dnf, always: &BTreeSet<u32>) -> Result<Dnf, LtlError> {
        let mut meanings = HashMap::new();
        for id in formula.atoms() {
            let meaning = match self.get(id).clone() {
                Modal::Literal(..) => Dnf::atom(id),
                Modal::Next(operand) => {
                    let operand = self.as_cosafety(&operand, always)?;
                    if operand.is_true() || operand.is_false() {
                        operand
                    } else {
                        self.modal(Modal::Next(operand))
                    }
                }
                Modal::Finally(operand) => {
                    let operand = self.as_cosafety(&operand, always)?;
                    self.finally(operand)
                }
                Modal::Until(left, right) => {
                    let (left, right) = (self.as_cosafety(&left, always)?, self.as_cosafety(&right, always)?);
                    self.until(left, right)
                }
                Modal::Strong(left, right) => {
                    let (left, right) = (self.as_cosafety(&left, always)?, self.as_cosafety(&right, always)?);
                    self.strong(left, right)
                }
                Modal::Globally(_) | Modal::Weak(..) | Modal::Release(..) if always.contains(&id) => {
                    Dnf::truth()
                }
                Modal::Globally(_) => Dnf::falsity(),
                Modal::Weak(left, right) => {
                    let (left, right) = (self.as_cosafety(&left, always)?, self.as_cosafety(&right, always)?);
                    self.until(left, right)
                }
                Modal::Release(left, right) => {
                    let (left, right) = (self.as_cosafety(&left, always)?, self.as_cosafety(&right, always)?);
                    self.strong(left, right)
                }
            };
            meanings.insert(id, meaning);
        }
        formula.replace(|id| Ok(meanings[&id].clone()))
    }

    /// Whether a formula is one of `F U M`.
    pub(super) fn is_least(&self, id: u32) -> bool {
        matches!(self.get(id), Modal::Finally(_) | Modal::Until(..) | Modal::Strong(..))
    }

    /// Whether a formula is one of `G W R`.
    pub(super) fn is_greatest(&self, id: u32) -> bool {
        matches!(self.get(id), Modal::Globally(_) | Modal::Weak(..) | Modal::Release(..))
    }
}
