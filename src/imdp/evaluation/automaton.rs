//! The probability of a run that an automaton from a file accepts.

use super::expression::Evaluator;
use super::{EvaluationError, Known, Truth};
use crate::automaton::{MarkedAutomaton, read_hoa};
use crate::files;
use crate::property::{AutomatonPath, Resolution};

impl Evaluator<'_> {
    /// Bounds on the probability that the automaton accepts.
    pub(super) fn automaton(
        &mut self,
        path: &AutomatonPath,
        resolution: Resolution,
    ) -> Result<Known, EvaluationError> {
        let file = &path.file;
        // A certificate cannot tell whether the file is still the same.
        self.is_unproved = true;
        let wrong = |problem: String| EvaluationError::Automaton { file: file.clone(), problem };
        let text = files::read_text(file).map_err(|error| wrong(error.to_string()))?;
        let automaton = read_hoa(&text).map_err(|error| wrong(error.to_string()))?;
        if let Some((name, _)) =
            path.propositions.iter().find(|(name, _)| !automaton.propositions().contains(name))
        {
            let known = automaton.propositions().join("\", \"");
            return Err(wrong(format!("found no proposition \"{name}\"; expected one of \"{known}\"")));
        }
        let mut propositions = vec![];
        for name in automaton.propositions() {
            let meaning = path.propositions.iter().find(|(other, _)| other == name);
            propositions.push(match meaning {
                Some((_, formula)) => self.truth(formula)?,
                None => match self.model.labels().get(name) {
                    Some(states) => Truth::exact(states.clone()),
                    None => {
                        return Err(EvaluationError::Proposition { file: file.clone(), name: name.clone() });
                    }
                },
            });
        }
        if resolution.policy_maximises() {
            return self.accepted(&mut MarkedAutomaton::new(&automaton, false), &propositions, resolution);
        }
        // A policy that minimises acceptance maximises that of the complement.
        let complement = &mut MarkedAutomaton::new(&automaton, true);
        Ok(self.accepted(complement, &propositions, resolution.flipped())?.complement())
    }
}
