//! What is asked of an engine, about which model, and what it replies.

use super::{EngineFailure, Strategy};
use crate::compare::CompareError;
use crate::model::{IntervalMdp, ModelKind};
use crate::property::Question as Asked;
use crate::property::{Objective, Optimum, Property, Query, QueryKind, Resolution};
use std::path::PathBuf;
use std::time::Duration;

/// A value that an engine is asked for.
#[derive(Clone, Debug)]
pub struct EngineQuestion {
    /// The property as it was given.
    pub property: Property,
    /// The same without its threshold: what the engine computes.
    pub value: Property,
    /// The value in terms of sets of states.
    pub query: Query,
}

/// A model as engines get it.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The model.
    pub model: &'a IntervalMdp,
    /// The model as engines get it: with lower bounds of 0, which they refuse, raised; `None` if there are none.
    pub raised: Option<&'a IntervalMdp>,
    /// Its explicit files, `.tra`, `.sta` and `.lab`, if they can be read as they are.
    pub files: Option<&'a PathBuf>,
}

/// What an engine computed.
#[derive(Clone, Debug)]
pub struct EngineAnswer {
    /// The value of every state.
    pub values: Vec<f64>,
    /// The strategy, if the engine gives one for this question.
    pub strategy: Option<Strategy>,
    /// How long it took, reading the model included.
    pub time: Duration,
    /// The most memory it had, in MiB, where the system tells.
    pub peak_mib: Option<u64>,
}

/// What came of asking an engine.
#[derive(Debug)]
pub struct Reply {
    /// The version of the engine, as far as it said.
    pub version: Option<String>,
    /// The answer, or why there is none.
    pub outcome: Result<EngineAnswer, EngineFailure>,
}

impl EngineQuestion {
    /// What a property asks about a model.
    ///
    /// # Errors
    /// [`CompareError::Property`] if it does not fit the model.
    pub fn new(property: &Property, model: &IntervalMdp) -> Result<Self, CompareError> {
        let failure = |error| CompareError::Property { property: property.to_string(), error };
        let objective: Objective = property.resolve(model.kind()).map_err(failure)?;
        let query = objective.query(model).map_err(failure)?;
        let optimum = match (model.kind(), objective.resolution) {
            (ModelKind::Imdp, resolution) => Optimum::Both(resolution),
            (ModelKind::Idtmc, Resolution::Pminmin | Resolution::Pmaxmin) => Optimum::Min,
            (ModelKind::Idtmc, Resolution::Pmaxmax | Resolution::Pminmax) => Optimum::Max,
        };
        let value = Property { name: None, question: Asked::Value(optimum), path: objective.path };
        Ok(Self { property: property.clone(), value, query })
    }

    /// The number of steps, if bounded.
    pub fn steps(&self) -> Option<u64> {
        match self.query.kind {
            QueryKind::Until { steps, .. } => steps,
            QueryKind::Next { .. } => Some(1),
        }
    }
}
