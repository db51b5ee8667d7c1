//! The model that files have.

use super::InputAbstraction;
use crate::landing::{FlatModelError, LandingModel};
use crate::partition::CellId;
use crate::task::Aim;
use imdp::model::{IntervalMdp, StateId, require_memory};
use imdp::property::{PathFormula, Property, Resolution, StateFormula};

/// How choices lead to cells in the model that files have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InputEncoding {
    /// By the states of the lattice: the same values as the lattice itself.
    #[default]
    Landing,
    /// At once, each cell with an interval of its own: looser.
    Flat,
}

/// A model for files, and what is asked of it.
#[derive(Clone, Debug)]
pub struct InputModel {
    /// The model.
    pub model: IntervalMdp,
    /// By cell: the states in one of which nature begins; cells that lost or won share one.
    pub of_cell: Vec<Vec<StateId>>,
    /// How many steps of the model are one of the system.
    pub micro_steps: u64,
    /// How choices lead to cells.
    pub encoding: InputEncoding,
    /// The task, for the lower bound and for the upper one.
    pub properties: [Property; 2],
    /// What is asked about costs, in PRISM's syntax: an upper and a lower bound on the least expected one for each.
    pub costs: Vec<String>,
    /// The states in which the controller acts, and their cells.
    pub(super) acting: Vec<(StateId, u32)>,
}

impl InputAbstraction {
    /// The model for files, with the cell of the given initial state or all that are open.
    ///
    /// # Errors
    /// [`FlatModelError`] if it does not fit into memory.
    pub fn model(
        &self,
        initial: Option<CellId>,
        encoding: InputEncoding,
    ) -> Result<InputModel, FlatModelError> {
        let (question, initial) = (self.exported(), self.initial(initial));
        let LandingModel { model, of_cell, acting, micro_steps } = match encoding {
            InputEncoding::Landing => {
                require_memory("the model of the lattice", question.model_bytes())?;
                question.model(&initial)?
            }
            // Where an interval says less than a band does, intervals of cells may still say more.
            InputEncoding::Flat => self.question().flat_model(&initial)?,
        };
        let properties =
            [Resolution::Pmaxmin, Resolution::Pmaxmax].map(|resolution| self.task(resolution, micro_steps));
        Ok(InputModel { model, of_cell, micro_steps, encoding, properties, costs: vec![], acting })
    }

    /// The task as a property of the model with the states of the lattice; with `Pmaxmin` its value is the lower bound,
    /// with `Pmaxmax` the upper one.
    pub fn property(&self, resolution: Resolution) -> Property {
        self.task(resolution, self.micro_steps())
    }

    /// The task, where so many steps of the model are one of the system.
    fn task(&self, resolution: Resolution, micro_steps: u64) -> Property {
        let steps = self.steps.map(|steps| steps.saturating_mul(micro_steps));
        let safe = StateFormula::negation(StateFormula::label("failed"));
        let path = match self.task.aim() {
            Aim::Reach | Aim::End => {
                PathFormula::Until { left: safe, right: StateFormula::label("reached"), steps }
            }
            Aim::Stay => PathFormula::Globally { formula: safe, steps },
        };
        Property::value(resolution, path)
    }
}
