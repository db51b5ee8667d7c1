//! What properties mean for a kind of model.

use super::{Optimum, PathFormula, Property, PropertyError, Question, Resolution, Threshold};
use crate::model::ModelKind;

/// A property of a given kind of model: who maximises, who minimises, and what is asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objective {
    /// Who maximises and who minimises. An interval DTMC has one choice per state, and both players agree.
    pub resolution: Resolution,
    /// The event whose probability is meant.
    pub path: PathFormula,
    /// What the value is compared with, if a verdict is asked for: it must hold in all initial states.
    pub threshold: Option<Threshold>,
}

impl Property {
    /// What the property means for a kind of model.
    ///
    /// `P>=p` asks for all policies and natures, hence for `Pminmin ≥ p`; likewise `P<=p` for
    /// `Pmaxmax ≤ p`. An interval DTMC has no policy, and its `Pmin` and `Pmax` become `Pminmin` and
    /// `Pmaxmax`.
    ///
    /// # Errors
    /// [`PropertyError::PlainOptimum`] for `Pmin` and `Pmax` of an interval MDP, which are read differently
    /// by different tools; [`PropertyError::NoPolicy`] for the four-letter forms of an interval DTMC.
    pub fn resolve(&self, kind: ModelKind) -> Result<Objective, PropertyError> {
        let (resolution, threshold) = match &self.question {
            Question::Value(optimum) => (optimum.resolve(kind)?, None),
            Question::Verdict(optimum, threshold) => (optimum.resolve(kind)?, Some(threshold)),
            Question::ForAll(threshold) if threshold.comparison.is_lower_bound() => {
                (Resolution::Pminmin, Some(threshold))
            }
            Question::ForAll(threshold) => (Resolution::Pmaxmax, Some(threshold)),
        };
        Ok(Objective { resolution, path: self.path.clone(), threshold: threshold.cloned() })
    }
}

impl Optimum {
    /// Who maximises and who minimises in a kind of model.
    ///
    /// # Errors
    /// [`PropertyError`] if the optimum says less or more than such a model needs.
    pub fn resolve(self, kind: ModelKind) -> Result<Resolution, PropertyError> {
        match (self, kind) {
            (Self::Both(resolution), ModelKind::Imdp) => Ok(resolution),
            (Self::Only, _) => Err(PropertyError::NoDirection),
            (Self::Min, ModelKind::Idtmc) => Ok(Resolution::Pminmin),
            (Self::Max, ModelKind::Idtmc) => Ok(Resolution::Pmaxmax),
            (Self::Min, ModelKind::Imdp) => {
                Err(PropertyError::PlainOptimum { found: self, prism: "Pminmin", storm: "Pminmax" })
            }
            (Self::Max, ModelKind::Imdp) => {
                Err(PropertyError::PlainOptimum { found: self, prism: "Pmaxmax", storm: "Pmaxmin" })
            }
            (Self::Both(found), ModelKind::Idtmc) => Err(PropertyError::NoPolicy {
                found,
                instead: if found.nature_maximises() { "Pmax" } else { "Pmin" },
            }),
        }
    }
}
