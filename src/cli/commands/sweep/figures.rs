//! What is read from the object that `compile --json` prints.

use serde_json::Value;

/// A figure of a compilation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::commands) enum Figure {
    /// The lower bound: what is promised.
    Lower,
    /// The upper bound.
    Upper,
    /// Whether the threshold is met.
    Satisfied,
    /// The states of the model; the cells, where actions are inputs.
    States,
    /// Its choices.
    Choices,
    /// Its transitions; none where actions are inputs, which need no model in files.
    Transitions,
    /// How long solving took.
    Seconds,
    /// The probability with which the lower bound holds.
    Confidence,
    /// The bytes of the tables that the exported controller looks up.
    ControllerBytes,
}

impl Figure {
    /// The name of its column.
    pub(in crate::commands) fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
            Self::Satisfied => "satisfied",
            Self::States => "states",
            Self::Choices => "choices",
            Self::Transitions => "transitions",
            Self::Seconds => "seconds",
            Self::Confidence => "confidence",
            Self::ControllerBytes => "controller_bytes",
        }
    }

    /// Where it stands if actions are targets, and if they are inputs.
    fn places(self) -> [&'static str; 2] {
        match self {
            Self::Lower => ["/results/0/lower", "/result/lower"],
            Self::Upper => ["/results/0/upper", "/result/upper"],
            Self::Satisfied => ["/results/0/satisfied", "/result/satisfied"],
            Self::States => ["/states", "/cells"],
            Self::Choices => ["/choices", "/choices"],
            Self::Transitions => ["/transitions", "/transitions"],
            Self::Seconds => ["/results/0/seconds", "/result/seconds"],
            Self::Confidence => ["/guarantee/confidence", "/manifest/guarantee/confidence"],
            Self::ControllerBytes => ["/controller_bytes", "/controller_bytes"],
        }
    }
}

/// The figure, if the object has it.
pub(in crate::commands) fn figure(result: &Value, of: Figure) -> Option<&Value> {
    let found = of.places().into_iter().find_map(|place| result.pointer(place));
    found.filter(|value| !value.is_null())
}
