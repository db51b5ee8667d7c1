//! A guarantee in words: sentences and lists of plain ASCII.

use super::{Bound, Evidence, Guarantee, SampleEvidence, lower_bound_text};
use crate::task::{Aim, Safety};
use imdp::numeric::shortest_decimal;

/// What the samples must not have a say in.
const FIXED_BEFOREHAND: &[&str] = &[
    "the grid",
    "the targets",
    "the goal",
    "the unsafe region",
    "the inputs U",
    "the gain K, the point it stabilises about, and U'",
    "group_steps",
    "discard",
    "the confidence, its split over the families of events and the weights in them",
    "sweep, the number of settings that are compiled with these samples",
];

/// The same for tasks over named regions.
const FIXED_BEFOREHAND_TASK: &[&str] = &[
    FIXED_BEFOREHAND[0],
    FIXED_BEFOREHAND[1],
    "the task and its regions",
    FIXED_BEFOREHAND[3],
    FIXED_BEFOREHAND[4],
    FIXED_BEFOREHAND[5],
    FIXED_BEFOREHAND[6],
    FIXED_BEFOREHAND[7],
    FIXED_BEFOREHAND[8],
    FIXED_BEFOREHAND[9],
];

/// The same where a plan is followed: like a policy, it is free, and what it leaves.
const FIXED_BEFOREHAND_PLAN: &[&str] = &[
    FIXED_BEFOREHAND[0],
    FIXED_BEFOREHAND[1],
    FIXED_BEFOREHAND[2],
    FIXED_BEFOREHAND[3],
    FIXED_BEFOREHAND[4],
    FIXED_BEFOREHAND[6],
    FIXED_BEFOREHAND[7],
    FIXED_BEFOREHAND[8],
    "sweep, the number of settings that are compiled with these samples and differ in more than plan and U'",
];

/// What the promise presupposes of noise and samples.
const ASSUMES: &[&str] = &[
    "the samples are independent of each other and all have the distribution of the noise at run time",
    "the noise at run time is independent of the samples and has this distribution at every step, whatever happened before",
    "a seed that samples are drawn with was not chosen by its result",
];

/// The same where components are assumed to be independent.
const ASSUMES_INDEPENDENT: &[&str] = &[
    "the components of the noise are independent of each other",
    ASSUMES[0],
    ASSUMES[1],
    ASSUMES[2],
    "parameters stay in their intervals",
];

/// The same for actions that are inputs, without that.
const ASSUMES_JOINT: &[&str] = &[ASSUMES[0], ASSUMES[1], ASSUMES[2], "parameters stay in their intervals"];

/// What the samples must not have a say in where actions are inputs: bounds speak of noise and lattice alone.
const FIXED_BEFOREHAND_INPUTS: &[&str] = &[
    "the pitch of the lattice (the widths of cells and /partition/resolution)",
    "how far images are from the partition",
    "discard",
    "the confidence, its split over the families of events and the weights in them",
    "sweep, the number of settings with different lattices that are compiled with these samples",
];

/// What the promise presupposes of noise that is known.
const ASSUMES_KNOWN: &[&str] = &[
    "the noise has the stated distribution at every step, whatever happened before",
    "components that are stated one by one are independent of each other",
    "parameters stay in their intervals",
];

impl Guarantee {
    /// The claim for a bound, as sentences.
    pub fn sentences(&self, bound: &Bound) -> Vec<String> {
        let start = match &bound.initial_state {
            Some(x) => {
                let numbers: Vec<_> = x.iter().map(|&x| shortest_decimal(x)).collect();
                format!("From the cell of x = ({})", numbers.join(", "))
            }
            None => "From any cell that is not unsafe".to_owned(),
        };
        let within = self.event.horizon.map_or(String::new(), |steps| format!(" within {steps} steps"));
        let what = match (self.event.aim, self.event.horizon) {
            _ if self.event.task.is_some() => self.automaton_words(),
            (Aim::Reach, _) => format!(
                "the goal is reached{within}, avoiding the unsafe region and the outside of the partition,"
            ),
            (Aim::Stay | Aim::End, Some(steps)) => {
                format!("the state stays in the safe region for {steps} steps")
            }
            (Aim::Stay | Aim::End, None) => "the state stays in the safe region for ever".to_owned(),
        };
        let bound = lower_bound_text(bound.bound);
        let mut sentences = vec![match &self.evidence {
            Evidence::Samples(samples) => format!(
                "{start} {what} with probability at least {bound}. This holds with confidence {}{} over the {} noise \
                 samples, for noise that is independent of them and distributed like them{}.",
                self.confidence().map(shortest_decimal).unwrap_or_default(),
                match samples.sweep {
                    1 => String::new(),
                    settings => format!(", for all {settings} settings of the sweep together,"),
                },
                samples.number,
                if samples.are_independent() {
                    ", with components that are independent of each other"
                } else {
                    ""
                }
            ),
            Evidence::Known { .. } => format!(
                "{start} {what} with probability at least {bound}. This holds for noise with the stated \
                 distribution, independent from step to step."
            ),
            Evidence::Published { .. } => format!(
                "{start} the value is {bound}{within}. It was computed in reference mode, to compare with the \
                 published tool: nothing is guaranteed."
            ),
        }];
        let d = self.event.group_steps;
        if d > 1 && self.event.task.is_some() {
            sentences.push(format!("Of regions it counts where the state is at the end of every {d} steps."));
        }
        if d > 1 {
            sentences.push(match (self.event.safety, self.event.outside) {
                (Safety::EveryStep, Safety::EveryStep) => {
                    "The unsafe region and the outside of the partition are avoided at every step.".to_owned()
                }
                (Safety::EveryStep, Safety::GroupedInstants) => format!(
                    "The unsafe region is avoided at every step, the outside of the partition every {d} steps."
                ),
                (Safety::GroupedInstants, _) => format!(
                    "Safety is checked every {d} steps only: the unsafe region may be crossed in between."
                ),
            });
        }
        if !self.fixed_beforehand().is_empty() {
            sentences.push(format!(
                "Nothing of this may have been chosen by looking at the samples: {}.",
                self.fixed_beforehand().join(", ")
            ));
        }
        if self.samples().is_some_and(|samples| samples.follows_plan) {
            sentences.push(
                "The plan that is followed, and how far from it actions may be (U'), may be chosen with the samples known: \
                 as any policy, all of them are covered."
                    .to_owned(),
            );
        }
        sentences
    }

    /// What an automaton wants, and for how long.
    fn automaton_words(&self) -> String {
        let task = self.event.task.as_deref().unwrap_or_default();
        let time = match (self.event.aim, self.event.horizon) {
            (_, None) => String::new(),
            (Aim::Reach, Some(steps)) => format!(" within {steps} steps"),
            (Aim::Stay, Some(steps)) => format!(" for {steps} steps"),
            (Aim::End, Some(steps)) => format!(" as a word of {steps} steps"),
        };
        format!("{task}{time}, avoiding the unsafe region and the outside of the partition,")
    }

    /// What a reader may expect and is not promised, in a few words.
    pub fn caveat(&self) -> Option<String> {
        match (&self.evidence, self.event.safety) {
            (Evidence::Published { .. }, _) => None,
            (_, Safety::EveryStep) => None,
            (_, Safety::GroupedInstants) => Some(format!(
                "NOT promised: safety in between, it is checked every {} steps only",
                self.event.group_steps
            )),
        }
    }

    /// Which numbers about the model are claims about the system.
    pub fn covers(&self) -> &'static str {
        match self.evidence {
            Evidence::Samples(SampleEvidence { components: Some(_), .. })
            | Evidence::Known { both_sides: true, .. } => {
                "lower bounds (Pmaxmin) and upper bounds (Pmaxmax) of the task: what no controller with these inputs exceeds"
            }
            Evidence::Samples(_) | Evidence::Known { both_sides: false, .. } => {
                "lower bounds (Pmaxmin, Pminmin) of formulas that are false from \"failed\" on, and upper bounds (Pminmax, \
                 Pmaxmax) of formulas that are true from \"failed\" on; in both cases only if \"reached\" decides the formula \
                 by its meaning: a run ends there, and what the model does afterwards, or its variables there, mean nothing"
            }
            Evidence::Published { .. } => {
                "nothing: these intervals repeat the published tool's and are no guarantee"
            }
        }
    }

    /// What must not have been chosen by looking at the samples.
    pub fn fixed_beforehand(&self) -> &'static [&'static str] {
        match self.evidence {
            Evidence::Samples(SampleEvidence { components: Some(_), .. }) => FIXED_BEFOREHAND_INPUTS,
            Evidence::Samples(_) if self.event.task.is_some() => FIXED_BEFOREHAND_TASK,
            Evidence::Samples(SampleEvidence { follows_plan: true, .. }) => FIXED_BEFOREHAND_PLAN,
            Evidence::Samples(_) => FIXED_BEFOREHAND,
            Evidence::Known { .. } | Evidence::Published { .. } => &[],
        }
    }

    /// What the guarantee presupposes of noise and samples.
    pub fn assumes(&self) -> &'static [&'static str] {
        match &self.evidence {
            Evidence::Samples(samples) if samples.are_independent() => ASSUMES_INDEPENDENT,
            Evidence::Samples(SampleEvidence { components: Some(_), .. }) => ASSUMES_JOINT,
            Evidence::Samples(_) => ASSUMES,
            Evidence::Known { .. } => ASSUMES_KNOWN,
            Evidence::Published { .. } => &[],
        }
    }
}
