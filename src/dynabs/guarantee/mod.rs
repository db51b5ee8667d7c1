//! The one claim about a compiled model: what holds, with which confidence, from what, and what had to be fixed
//! before anybody looked at the samples.
//!
//! A [`Guarantee`] is made together with the intervals. The manifest holds it as JSON, and whatever the tools say about it,
//! they say in its words: summaries, reports, generated code, and the answers to properties ([`Coverage`]).

mod bound;
mod claim;
mod coverage;
mod event;
mod evidence;
mod gap;
mod words;

pub use bound::{Bound, lower_bound_text};
pub use claim::Claim;
pub use coverage::Coverage;
pub use event::Event;
pub use evidence::{Evidence, SampleEvidence};
pub use gap::Gap;

use crate::task::{Aim, Safety};
use imdp::numeric::{Rational, from_decimal, to_f64};
use num_traits::One;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Serialize, Serializer};

/// What a compiled model promises about the system, and what that rests on.
///
/// As JSON it is `event` and `evidence`, from which it can be read again, and what follows from them in words.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Guarantee {
    /// What is promised to happen.
    pub event: Event,
    /// What the probabilities rest on.
    pub evidence: Evidence,
}

impl Guarantee {
    /// A guarantee of nothing.
    pub fn none() -> Self {
        let event = Event {
            task: None,
            aim: Aim::Reach,
            horizon: None,
            group_steps: 1,
            safety: Safety::EveryStep,
            outside: Safety::EveryStep,
        };
        Self { event, evidence: Evidence::Published { beta_per_interval: 1.0 } }
    }

    /// The probability with which everything promised holds, over the samples: `1 − β`, or 1 if the noise is known; none if nothing is promised.
    pub fn confidence(&self) -> Option<f64> {
        if let Evidence::Known { .. } = self.evidence {
            return Some(1.0);
        }
        // Of the decimal `β`: 0.99 for 0.01.
        let beta = from_decimal(self.samples()?.beta)?;
        Some(to_f64(&(Rational::one() - beta)))
    }

    /// The samples that it rests on, if it does.
    pub fn samples(&self) -> Option<&SampleEvidence> {
        match &self.evidence {
            Evidence::Samples(samples) => Some(samples),
            Evidence::Known { .. } | Evidence::Published { .. } => None,
        }
    }

    /// The name of the mode that gives such a guarantee: `pac`, `known`, or `reference`, which promises nothing.
    pub fn mode(&self) -> &'static str {
        match self.evidence {
            Evidence::Samples(_) => "pac",
            Evidence::Known { .. } => "known",
            Evidence::Published { .. } => "reference",
        }
    }
}

impl Serialize for Guarantee {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Guarantee", 6)?;
        fields.serialize_field("confidence", &self.confidence())?;
        fields.serialize_field("event", &self.event)?;
        fields.serialize_field("evidence", &self.evidence)?;
        fields.serialize_field("covers", self.covers())?;
        fields.serialize_field("assumes", self.assumes())?;
        fields.serialize_field("fixed_beforehand", self.fixed_beforehand())?;
        fields.end()
    }
}
