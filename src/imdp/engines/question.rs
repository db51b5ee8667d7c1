//! What is asked of an engine, about which model, and what it replies.

use super::{EngineFailure, Strategy};
use crate::compare::CompareError;
use crate::formats::Format;
use crate::model::{IntervalMdp, ModelKind};
use crate::property::{Compound, Objective, Optimum, Property, Query, QueryKind, Question, Resolution};
use std::path::Path;
use std::time::Duration;

/// A value that an engine is asked for.
#[derive(Clone, Debug)]
pub struct EngineQuestion {
    /// The question as it was given.
    pub property: String,
    /// What the engine computes.
    pub kind: QuestionKind,
}

/// What an engine computes.
#[derive(Clone, Debug)]
pub enum QuestionKind {
    /// The probability of one event.
    Event {
        /// The property without its threshold.
        value: Box<Property>,
        /// The value in terms of sets of states.
        query: Query,
    },
    /// A number or a formula of several operators, or with rewards.
    Expression(Compound),
}

/// A model as engines get it.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The model.
    pub model: &'a IntervalMdp,
    /// The model as engines get it: with lower bounds of 0, which they refuse, raised; `None` if there are none.
    pub raised: Option<&'a IntervalMdp>,
    /// What is handed to engines.
    pub handed: Handed<'a>,
}

/// What is handed to an engine.
#[derive(Clone, Copy, Debug, Default)]
pub enum Handed<'a> {
    /// The model, written in a format of the engine.
    #[default]
    Copy,
    /// PRISM's explicit files, this one and those beside it, to the engine that reads them; a copy to others.
    Explicit(&'a Path),
    /// This file and no other, as it is.
    AsIs(&'a Path, Format),
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
        let value = Property { name: None, question: Question::Value(optimum), path: objective.path };
        Ok(Self {
            property: property.to_string(),
            kind: QuestionKind::Event { value: Box::new(value), query },
        })
    }

    /// What an expression asks.
    pub fn expression(compound: &Compound) -> Self {
        Self { property: compound.to_string(), kind: QuestionKind::Expression(compound.clone()) }
    }

    /// The number of steps, if there is one event and it is bounded.
    pub fn steps(&self) -> Option<u64> {
        match &self.query()?.kind {
            QueryKind::Until { steps, .. } => *steps,
            QueryKind::Next { .. } => Some(1),
        }
    }

    /// The value in terms of sets of states, if it is about one event.
    pub fn query(&self) -> Option<&Query> {
        match &self.kind {
            QuestionKind::Event { query, .. } => Some(query),
            QuestionKind::Expression(_) => None,
        }
    }

    /// The question in PRISM's language, without a name.
    pub fn text(&self) -> String {
        match &self.kind {
            QuestionKind::Event { value, .. } => value.to_string(),
            QuestionKind::Expression(compound) => compound.resolved(),
        }
    }
}
