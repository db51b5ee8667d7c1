//! What the controller is to achieve, as parts that are not yet checked.

use super::regions::{RegionBox, RegionParts};
use crate::task::Safety;

/// What is wanted, where, within how many steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// What is wanted.
    pub aim: Wanted,
    /// What must be avoided.
    pub unsafe_: Vec<Hazard>,
    /// The number of original steps.
    pub horizon: Horizon,
    /// The probability that is wanted, if any.
    pub threshold: Option<f64>,
    /// The regions that the task may speak of.
    pub regions: Vec<RegionParts>,
    /// When, with grouped steps, the unsafe region must be avoided: by default at every step, if the samples are of steps.
    pub check: Option<Safety>,
}

/// Something that must be avoided.
#[derive(Clone, Debug, PartialEq)]
pub enum Hazard {
    /// A box; a cell counts if it meets one.
    Box(RegionBox),
    /// Everything outside the partition: between grouped steps too.
    Outside,
}

/// What is wanted besides safety.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// To reach a union of boxes; a cell counts if the union contains it.
    Reach {
        /// The boxes.
        goal: Vec<RegionBox>,
    },
    /// To be in a union of boxes at every step up to the horizon; a cell counts if the union contains it.
    Stay {
        /// The boxes; empty for the whole partition.
        safe: Vec<RegionBox>,
    },
    /// To be in a union of boxes after the last step.
    ReachAt {
        /// The boxes.
        goal: Vec<RegionBox>,
    },
    /// To come to named regions one after the other.
    Sequence {
        /// What to come to and what to avoid on the way, in order.
        legs: Vec<Leg>,
    },
    /// What a formula over named regions says.
    Formula {
        /// The formula.
        text: String,
        /// What its words are.
        logic: Logic,
    },
    /// What a deterministic automaton over named regions accepts.
    Automaton {
        /// The name of the file.
        file: String,
        /// Its text, in the HOA format.
        hoa: String,
    },
}

/// One part of a sequence: to come to some regions without meeting others before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leg {
    /// The name of the region to come to.
    pub reach: String,
    /// The names of those to avoid on the way.
    pub avoid: Vec<String>,
}

/// What the words of a formula are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Logic {
    /// All that ever happens; what happens within the horizon must decide.
    #[default]
    Ltl,
    /// What happens up to the horizon, or up to some time if there is none (LTLf).
    Ltlf,
}

/// A number of original steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizon {
    /// No limit.
    Infinite,
    /// This many.
    Steps(u64),
}

impl Horizon {
    /// No more steps than this count.
    pub(super) fn most(self) -> u64 {
        match self {
            Self::Infinite => u64::MAX,
            Self::Steps(steps) => steps,
        }
    }
}

impl Task {
    /// To reach a union of boxes some time.
    pub fn reach(goal: Vec<RegionBox>) -> Self {
        Self {
            aim: Wanted::Reach { goal },
            unsafe_: vec![],
            horizon: Horizon::Infinite,
            threshold: None,
            regions: vec![],
            check: None,
        }
    }

    /// To stay in a union of boxes for ever; in the whole partition if there are none.
    pub fn stay(safe: Vec<RegionBox>) -> Self {
        Self { aim: Wanted::Stay { safe }, ..Self::reach(vec![]) }
    }

    /// To satisfy a formula of linear temporal logic over these regions.
    pub fn formula(text: impl Into<String>, logic: Logic, regions: Vec<RegionParts>) -> Self {
        Self { aim: Wanted::Formula { text: text.into(), logic }, regions, ..Self::reach(vec![]) }
    }

    /// Avoiding these boxes too.
    #[must_use]
    pub fn avoiding(mut self, boxes: Vec<RegionBox>) -> Self {
        self.unsafe_.extend(boxes.into_iter().map(Hazard::Box));
        self
    }

    /// Avoiding everything outside the partition too.
    #[must_use]
    pub fn avoiding_outside(mut self) -> Self {
        self.unsafe_.push(Hazard::Outside);
        self
    }

    /// With safety meant like this where steps are grouped.
    #[must_use]
    pub fn checked(mut self, safety: Safety) -> Self {
        self.check = Some(safety);
        self
    }

    /// Within this many original steps.
    #[must_use]
    pub fn within(mut self, steps: u64) -> Self {
        self.horizon = Horizon::Steps(steps);
        self
    }

    /// With at least this probability.
    #[must_use]
    pub fn at_least(mut self, threshold: f64) -> Self {
        self.threshold = Some(threshold);
        self
    }
}
