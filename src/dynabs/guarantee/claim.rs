//! What the answer to a property claims of the system.

use super::{Coverage, Gap, Guarantee, lower_bound_text};
use imdp::model::IntervalMdp;
use imdp::numeric::{round_decimal_up, shortest_decimal};
use imdp::property::{Property, PropertyError};
use serde::{Deserialize, Serialize};

/// What the bounds on the value of a property say of the system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// Whether the guarantee covers the number.
    pub covered: bool,
    /// The probability with which the claim holds, over the samples; none if nothing is claimed.
    pub confidence: Option<f64>,
    /// What is claimed, or why nothing is.
    pub text: String,
    /// What a reader may expect and is not promised.
    pub caveat: Option<String>,
}

impl Guarantee {
    /// What bounds on the value of `property` on the compiled `model` claim.
    ///
    /// # Errors
    /// [`PropertyError`] if the property makes no sense for the model.
    pub fn claim(
        &self,
        property: &Property,
        model: &IntervalMdp,
        [lower, upper]: [f64; 2],
    ) -> Result<Claim, PropertyError> {
        let maximises = property.resolve(model.kind())?.resolution.policy_maximises();
        let upper = shortest_decimal(round_decimal_up(upper, 6).min(1.0));
        let claimed = match (self.coverage(property, model)?, maximises) {
            (Coverage::None(gaps), _) => return Ok(self.no_claim(&gaps)),
            (Coverage::Lower, true) => format!("a controller attains at least {}", lower_bound_text(lower)),
            (Coverage::Lower, false) => {
                format!(
                    "every controller with actions of the model attains at least {}",
                    lower_bound_text(lower)
                )
            }
            (Coverage::Upper, false) => format!("a controller keeps it at or below {upper}"),
            (Coverage::Upper, true) => format!("no controller with actions of the model exceeds {upper}"),
        };
        Ok(self.claimed(&claimed))
    }

    /// What bounds on the answer to a question about costs claim, as the files of a run ask it: the least expected cost, with
    /// minimising nature or with maximising one.
    pub fn cost_claim(&self, question: &str, [lower, upper]: [f64; 2]) -> Claim {
        let claimed = match question.contains("}minmin=") {
            true => {
                format!("no controller with actions of the model falls below {}", lower_bound_text(lower))
            }
            false => {
                let upper = shortest_decimal(round_decimal_up(upper, 6));
                format!("a controller keeps the expected cost at or below {upper}")
            }
        };
        self.claimed(&claimed)
    }

    fn claimed(&self, claimed: &str) -> Claim {
        let confidence = self.confidence();
        let sure = confidence.map(shortest_decimal).unwrap_or_default();
        Claim {
            covered: true,
            confidence,
            text: format!("{claimed} on the system, with confidence {sure}"),
            caveat: self.caveat(),
        }
    }

    /// Says why nothing is claimed.
    pub fn no_claim(&self, gaps: &[Gap]) -> Claim {
        let reasons: Vec<_> = gaps.iter().map(Gap::to_string).collect();
        Claim { covered: false, confidence: None, text: reasons.join("; "), caveat: None }
    }
}
