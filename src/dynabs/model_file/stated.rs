//! From a model file to the problem that it states.

use super::Document;
use super::fields::{ActionsSpec, ModelFile};
use super::input_parts::input_parts;
use super::parts::builder;
use crate::Diagnostic;
use crate::problem::{InputProblem, Problem};

/// What a model file states: a problem of the kind that its actions need.
#[derive(Clone, Debug)]
pub enum StatedProblem {
    /// Actions steer to targets.
    Targets(Box<Problem>),
    /// Actions are inputs.
    Inputs(Box<InputProblem>),
}

impl Document {
    /// The problem that the model file states, whatever its actions.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub fn stated(&self) -> Result<StatedProblem, Diagnostic> {
        let stated = self.model().and_then(|file| match actions(&file) {
            ActionsSpec::Inputs => InputProblem::new(input_parts(file, &self.directory)?)
                .map(|problem| StatedProblem::Inputs(Box::new(problem))),
            ActionsSpec::Targets => {
                let problem = builder(file, &self.directory)?.build();
                problem.map(|problem| StatedProblem::Targets(Box::new(problem)))
            }
        });
        stated.map_err(|error| error.in_file(&self.name))
    }

    /// The problem that the model file states: field names, types and values are checked, samples read.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found, or if actions are inputs.
    pub fn problem(&self) -> Result<Problem, Diagnostic> {
        match self.stated()? {
            StatedProblem::Targets(problem) => Ok(*problem),
            StatedProblem::Inputs(_) => {
                Err(Diagnostic::at("/actions", "actions that are inputs", "targets to steer to")
                    .in_file(&self.name))
            }
        }
    }
}

/// The kind of actions: as stated, or what the other fields ask for.
fn actions(file: &ModelFile) -> ActionsSpec {
    let is_known = file.noise.gaussian.is_some() && file.noise.count.is_none();
    let steered = file.noise.components.is_none() && !is_known && file.noise.independent.is_none();
    let steered = steered && file.dynamics.beyond_matrices().is_none();
    let default = if steered { ActionsSpec::Targets } else { ActionsSpec::Inputs };
    file.actions.unwrap_or(default)
}
