//! Which answers about the model are claims about the system.
//!
//! **What the model is.** A run of the closed loop goes from cell to cell until it is in a goal cell (`reached`) or has
//! failed, and is over then. Each row contains the distribution of the next cell after moving some of its mass to
//! `failed`. So for every policy some nature makes the model do what the run does up to some random time, and `failed` for ever
//! after, if that time comes at all; in `reached` the model stays although the run is over.
//!
//! **Lower bounds**, with minimising nature, are below the probability that the system satisfies a formula if a path of
//! the model satisfies it only when the run does, whatever the system does after `reached`, and after a time from which
//! the model is in `failed`. **Upper bounds**, with maximising nature, are above it if the path satisfies it whenever the
//! run may.
//!
//! For an event `A U B` (`X B` alike, `F` with `A` true; `G` is the complement of an `F` and changes the side):
//! - in `failed` (cells in which nothing is enabled included: a run that starts there is over), a lower bound needs `B`
//!   false, an upper bound `B` true: nothing else counts once the path stays.
//! - in `reached`, a lower bound needs that `B`, if it is true there in the model, is true by its meaning. An upper bound
//!   needs `B` true there in the model, or both `A` and `B` false by their meaning: then the event is decided on arrival.
//!
//! By its *meaning* in `reached`, the label `reached` is true and `failed` is false; variables and all other labels have none.
//! If the task is to keep something, `reached` means that it is kept for ever, whatever comes: both labels stay as they are, and
//! an event that is false on arrival by its meaning is decided.

use super::{Evidence, Gap, Guarantee};
use crate::task::Aim;
use imdp::model::{IntervalMdp, StateSet};
use imdp::property::{PathFormula, Property, PropertyError, QueryKind, StateFormula};

/// Whether the guarantee covers the number that answers a property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// The lower bound of the answer is one for the system.
    Lower,
    /// The upper bound of the answer is one for the system.
    Upper,
    /// It does not, for these reasons.
    None(Vec<Gap>),
}

impl Guarantee {
    /// Whether the answer to `property` on the compiled `model` is a claim about the system.
    ///
    /// # Errors
    /// [`PropertyError`] if the property makes no sense for the model.
    pub fn coverage(&self, property: &Property, model: &IntervalMdp) -> Result<Coverage, PropertyError> {
        let objective = property.resolve(model.kind())?;
        let query = objective.query(model)?;
        if matches!(self.evidence, Evidence::Published { .. }) {
            return Ok(Coverage::None(vec![Gap::Published]));
        }
        let event = Event::new(&objective.path, model, self.event.aim == Aim::Stay);
        let (QueryKind::Until { goal, .. } | QueryKind::Next { goal }) = &query.kind;
        let gaps = match query.resolution.nature_maximises() {
            false => event.gaps_below(goal),
            true => event.gaps_above(goal),
        };
        let is_upper = objective.resolution.nature_maximises();
        let in_failed = |gap| match gap {
            // Of the event; a complement is true where its event is false.
            Gap::TrueInFailed | Gap::FalseInFailed if is_upper => Gap::FalseInFailed,
            Gap::TrueInFailed | Gap::FalseInFailed => Gap::TrueInFailed,
            other => other,
        };
        Ok(match (gaps.is_empty(), is_upper) {
            (true, false) => Coverage::Lower,
            (true, true) => Coverage::Upper,
            (false, _) => Coverage::None(gaps.into_iter().map(in_failed).collect()),
        })
    }
}

/// An event `A U B` or `X B`, as seen from where the model stays for ever.
struct Event<'a> {
    failed: Option<&'a StateSet>,
    reached: Option<&'a StateSet>,
    /// Whether `A` is true on arrival in `reached`, by its meaning; nothing matters after the one step of `X`.
    on_the_way: Option<bool>,
    /// Whether `B` is.
    at_the_end: Option<bool>,
    /// Whether the run is over at the start, but the event looks one step ahead.
    starts_over: bool,
    /// Whether nothing changes any more in `reached`.
    lasts: bool,
}

impl<'a> Event<'a> {
    fn new(path: &PathFormula, model: &'a IntervalMdp, lasts: bool) -> Self {
        let labelled = |name| model.labels().get(name).filter(|states| !states.is_clear());
        let (failed, reached) = (labelled("failed"), labelled("reached"));
        let is_next = matches!(path, PathFormula::Next(_));
        let (on_the_way, at_the_end) = match path {
            PathFormula::Next(formula) => (Some(false), meaning(formula)),
            PathFormula::Finally { formula, .. } => (Some(true), meaning(formula)),
            PathFormula::Globally { formula, .. } => (Some(true), meaning(formula).map(|holds| !holds)),
            PathFormula::Until { left, right, .. } => (meaning(left), meaning(right)),
        };
        let starts_over = is_next && reached.is_some_and(|states| !states.is_disjoint(model.initial()));
        Self { failed, reached, on_the_way, at_the_end, starts_over, lasts }
    }

    /// Why a lower bound of the event's probability is none for the system.
    fn gaps_below(&self, goal: &StateSet) -> Vec<Gap> {
        let mut gaps = vec![];
        if self.failed.is_some_and(|failed| !goal.is_disjoint(failed)) {
            gaps.push(Gap::TrueInFailed);
        }
        if self.reached.is_some_and(|reached| !goal.is_disjoint(reached)) {
            if self.starts_over {
                gaps.push(Gap::AfterReached);
            }
            if self.at_the_end != Some(true) {
                gaps.push(Gap::ReadsReached);
            }
        }
        gaps
    }

    /// Why an upper bound of the event's probability is none for the system.
    fn gaps_above(&self, goal: &StateSet) -> Vec<Gap> {
        let mut gaps = vec![];
        if self.failed.is_some_and(|failed| !failed.is_subset(goal)) {
            gaps.push(Gap::FalseInFailed);
        }
        if self.reached.is_some_and(|reached| !reached.is_subset(goal)) {
            if self.starts_over || self.on_the_way == Some(true) && !self.lasts {
                gaps.push(Gap::AfterReached);
            }
            if self.on_the_way.is_none() || self.at_the_end != Some(false) {
                gaps.push(Gap::ReadsReached);
            }
        }
        gaps
    }
}

/// Whether a formula is true on arrival in `reached`, by its meaning; none if it has no meaning there.
fn meaning(formula: &StateFormula) -> Option<bool> {
    let any = |operands: &[StateFormula], decisive: bool| {
        let found: Vec<_> = operands.iter().map(meaning).collect();
        if found.contains(&Some(decisive)) {
            Some(decisive)
        } else if found.contains(&None) {
            None
        } else {
            Some(!decisive)
        }
    };
    match formula {
        StateFormula::True => Some(true),
        StateFormula::False => Some(false),
        StateFormula::Label(name) => match name.as_str() {
            "reached" => Some(true),
            "failed" => Some(false),
            _ => None,
        },
        StateFormula::Variable(_) | StateFormula::Compare(..) => None,
        StateFormula::Not(operand) => meaning(operand).map(|holds| !holds),
        StateFormula::And(operands) => any(operands, false),
        StateFormula::Or(operands) => any(operands, true),
        StateFormula::Implies(left, right) => match (meaning(left), meaning(right)) {
            (Some(false), _) | (_, Some(true)) => Some(true),
            (left, right) => Some(!left? || right?),
        },
        StateFormula::Iff(left, right) => Some(meaning(left)? == meaning(right)?),
        StateFormula::Differ(left, right) => Some(meaning(left)? != meaning(right)?),
    }
}
