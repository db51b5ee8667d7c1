//! From the fields of a lower layer to its parts.

use super::given::given;
use super::parts::input_set;
use super::stabilizer_fields::{HeadingSpec, StabilizerSpec, TrackSpec};
use crate::Diagnostic;
use crate::problem::{FeedbackLayer, Gain, Heading, LowerLayer, LqrWeights, TrackingLayer};

/// A lower layer, not yet checked.
pub(super) fn lower_layer(spec: StabilizerSpec) -> Result<LowerLayer, Diagnostic> {
    let abstract_input =
        spec.abstract_input.map(|set| input_set("/stabilizer/abstract_input", set)).transpose()?;
    let gain = match (spec.lqr, spec.gain, spec.track) {
        (Some(lqr), None, None) => Gain::Lqr(LqrWeights { q: lqr.q, r: lqr.r, decimals: lqr.decimals }),
        (None, Some(gain), None) => Gain::Given(gain),
        (None, None, Some(track)) if spec.about.is_none() => {
            let heading = |HeadingSpec { from, to }| Heading { from, to };
            let given = match track {
                TrackSpec::Auto => vec![],
                TrackSpec::From(headings) => headings.into_iter().map(heading).collect(),
            };
            return Ok(LowerLayer::Tracking(TrackingLayer { given, abstract_input }));
        }
        (None, None, Some(_)) => {
            return Err(Diagnostic::at(
                "/stabilizer/about",
                "a state to stabilise about, beside track",
                "no such state",
            )
            .remedy("What track stabilises about is where the plan goes."));
        }
        (lqr, gain, track) => {
            let found = match (&lqr, &gain, &track) {
                (Some(_), Some(_), None) => "both lqr and gain".to_owned(),
                (None, None, None) => "neither lqr nor gain nor track".to_owned(),
                _ => given(&[("lqr", lqr.is_some()), ("gain", gain.is_some()), ("track", track.is_some())]),
            };
            return Err(Diagnostic::at("/stabilizer", found, "exactly one of lqr, gain and track"));
        }
    };
    let abstract_input = abstract_input.ok_or_else(|| {
        Diagnostic::at("/stabilizer", "no field `abstract_input`", "the field `abstract_input`")
    })?;
    Ok(LowerLayer::Feedback(FeedbackLayer { gain, about: spec.about, abstract_input }))
}
