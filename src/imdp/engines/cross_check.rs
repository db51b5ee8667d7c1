//! Asking engines what we know, and comparing.

use super::judge::{Judgement, hull, judge, tolerance};
use super::{
    Agreement, Engine, EngineAnswer, EngineQuestion, Finding, QuestionKind, Reply, RunLimits,
    StrategyFinding, Subject,
};
use crate::compare::backup::Backup;
use crate::compare::record::answer_within;
use crate::compare::{CompareError, Tolerance};
use crate::evaluation::Evaluation;
use crate::formats::prism::RAISED_LOWER_BOUND;
use crate::model::IntervalMdp;
use crate::property::Inquiry;
use crate::solver::{Solution, SolverOptions, Status, ValueBounds};

/// How to ask.
#[derive(Clone, Copy)]
pub struct CrossCheckOptions<'a> {
    /// How we solve.
    pub solver: SolverOptions<'a>,
    /// What an engine may use.
    pub limits: RunLimits<'a>,
}

/// What we know about a question.
struct Ours {
    question: EngineQuestion,
    known: Known,
    /// The bounds of the model with raised lower bounds, where they may be others.
    raised: Option<ValueBounds>,
}

/// Bounds on the value of every state.
struct Known {
    values: ValueBounds,
    /// Bounds on the probability of the event that the value is about, if it is about one.
    event: ValueBounds,
    status: Status,
}

/// Asks every engine everything, and compares the values of all states and the strategies with ours.
///
/// # Errors
/// [`CompareError`] if a question does not fit the model; what happens to an engine is a [`Finding`].
pub fn cross_check(
    subject: &Subject<'_>,
    inquiries: &[Inquiry],
    engines: &[&dyn Engine],
    options: &CrossCheckOptions<'_>,
) -> Result<Vec<Finding>, CompareError> {
    let ours = |inquiry| Ours::new(subject, inquiry, &options.solver);
    let ours: Vec<Ours> = inquiries.iter().map(ours).collect::<Result<_, _>>()?;
    let questions: Vec<EngineQuestion> = ours.iter().map(|ours| ours.question.clone()).collect();
    let mut findings = vec![];
    for engine in engines {
        let replies = engine.ask(subject, &questions, &options.limits);
        for (ours, reply) in ours.iter().zip(replies) {
            findings.push(ours.compare(subject, *engine, reply, &options.solver)?);
        }
    }
    Ok(findings)
}

impl Ours {
    fn new(
        subject: &Subject<'_>,
        inquiry: &Inquiry,
        options: &SolverOptions<'_>,
    ) -> Result<Self, CompareError> {
        let question = match inquiry {
            Inquiry::Probability(property) => EngineQuestion::new(property, subject.model)?,
            Inquiry::Compound(compound) => EngineQuestion::expression(compound),
        };
        let known = Known::new(subject.model, &question, options)?;
        let raised = match subject.raised {
            // Within a bounded number of steps it makes no difference in doubles.
            Some(raised) if question.steps().is_none() => {
                Some(Known::new(raised, &question, options)?.values)
            }
            _ => None,
        };
        Ok(Self { question, known, raised })
    }

    fn compare(
        &self,
        subject: &Subject<'_>,
        engine: &dyn Engine,
        Reply { version, outcome }: Reply,
        options: &SolverOptions<'_>,
    ) -> Result<Finding, CompareError> {
        let initial = || subject.model.initial().ones();
        let (allowed, why) = tolerance(&self.question, subject.model, &engine.stopping());
        let mut finding = Finding {
            engine: engine.name().to_owned(),
            version,
            property: self.question.property.clone(),
            value: None,
            ours: [
                initial().map(|s| self.known.values.lower[s]).fold(f64::INFINITY, f64::min),
                initial().map(|s| self.known.values.upper[s]).fold(f64::NEG_INFINITY, f64::max),
            ],
            difference: None,
            state: None,
            tolerance: why,
            strategy: None,
            seconds: None,
            peak_mib: None,
            agreement: Agreement::Failed,
            notes: vec![],
        };
        let reply = match outcome {
            Ok(reply) => reply,
            Err(failure) => {
                finding.notes.push(failure.to_string());
                return Ok(finding);
            }
        };
        let values = || initial().map(|state| reply.values[state]);
        finding.value =
            Some([values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]);
        finding.seconds = Some(reply.time.as_secs_f64());
        finding.peak_mib = reply.peak_mib;
        let mut judgement = self.judge(&reply, allowed, &mut finding.notes);
        if judgement.agreement == Agreement::Disagrees && self.stopped_early(subject, engine, &reply) {
            judgement.agreement = Agreement::Undecided;
            finding.notes.push(format!(
                "it stopped early: its values still rise, by so little in one step that its rule says stop (it {})",
                engine.stopping()
            ));
        }
        (finding.difference, finding.state) = (Some(judgement.difference), Some(judgement.state));
        finding.agreement = judgement.agreement;
        self.weigh_strategy(subject, &reply, allowed, options, &mut finding)?;
        Ok(finding)
    }

    /// Compares with the values of the model as it is or, as a whole, with those of what the engine was given.
    fn judge(&self, reply: &EngineAnswer, allowed: Tolerance, notes: &mut Vec<String>) -> Judgement {
        let plain = judge(&reply.values, &self.known.values, allowed);
        let Some(raised) = &self.raised else {
            if plain.agreement == Agreement::Undecided {
                notes.push(format!("our own bounds are not closer: {}", self.known.status));
            }
            return plain;
        };
        let changed =
            (0..raised.lower.len()).filter(|&s| apart(&self.known.values, raised, s) > allowed.relative);
        let changed = changed.count();
        if changed > 0 {
            notes.push(format!(
                "it refuses lower bounds of 0 and was given {RAISED_LOWER_BOUND:e} instead, which changes the value of \
                 {changed} states; ours are compared with and without"
            ));
        }
        if plain.agreement == Agreement::Agrees {
            return plain;
        }
        let given = judge(&reply.values, raised, allowed);
        if given.agreement == Agreement::Agrees {
            return given;
        }
        // The iterations of the engine lie between the two.
        judge(&reply.values, &hull(&self.known.values, raised), allowed)
    }

    /// Whether the values are those of an iteration from below that the engine's rule lets end here.
    fn stopped_early(&self, subject: &Subject<'_>, engine: &dyn Engine, reply: &EngineAnswer) -> bool {
        let Some(query) = self.question.query().filter(|_| self.question.steps().is_none()) else {
            return false;
        };
        let event = |value: f64| if query.complement { 1.0 - value } else { value };
        let values: Vec<f64> = reply.values.iter().map(|&value| event(value)).collect();
        let model = subject.raised.unwrap_or(subject.model);
        let next = Backup::new(model, query).step(&values);
        let upper = &self.known.event.upper;
        (0..values.len()).all(|s| {
            let rounding = 1e-14;
            (next[s] - values[s]).abs() <= engine.settled(next[s]) + rounding && values[s] <= upper[s] + 1e-9
        })
    }

    /// Checks that the engine's strategy attains the values it claims.
    fn weigh_strategy(
        &self,
        subject: &Subject<'_>,
        reply: &EngineAnswer,
        allowed: Tolerance,
        options: &SolverOptions<'_>,
        finding: &mut Finding,
    ) -> Result<(), CompareError> {
        let (Some(strategy), Some(query)) = (&reply.strategy, self.question.query()) else { return Ok(()) };
        let model = subject.raised.unwrap_or(subject.model);
        let attained = strategy.attained(model, query, options)?;
        let short = |s: usize| {
            let event = |value: f64| if query.complement { 1.0 - value } else { value };
            let by = event(reply.values[s]) - attained[s];
            if query.resolution.policy_maximises() { by } else { -by }
        };
        let states = 0..attained.len();
        let Some(worst) = states.max_by(|&a, &b| short(a).total_cmp(&short(b))) else { return Ok(()) };
        let shortfall = short(worst).max(0.0);
        finding.strategy = Some(StrategyFinding { decisions: strategy.len(), shortfall });
        if shortfall <= allowed.absolute.max(allowed.relative) {
            return Ok(());
        }
        let mut note =
            format!("its strategy is worse than its values say, by {shortfall:.1e} in state {worst}");
        if self.question.steps().is_none() && query.resolution.policy_maximises() {
            note += ": it takes choices that look best for the final values, which may go round in circles without \
                     ever reaching what they promise; that does not make the values wrong";
        } else {
            finding.agreement = Agreement::Disagrees;
        }
        finding.notes.push(note);
        Ok(())
    }
}

impl Known {
    fn new(
        model: &IntervalMdp,
        question: &EngineQuestion,
        options: &SolverOptions<'_>,
    ) -> Result<Self, CompareError> {
        match &question.kind {
            QuestionKind::Event { value, .. } => {
                let answer = answer_within(model, value, options)?;
                let Solution { values: event, status, .. } = answer.solution;
                Ok(Self { values: answer.values, event, status })
            }
            QuestionKind::Expression(compound) => {
                let failure = |error| CompareError::Expression { property: compound.to_string(), error };
                let evaluation = Evaluation::new(model, compound, None, options).map_err(failure)?;
                let values = evaluation.value_bounds(model.num_states());
                Ok(Self { event: values.clone(), values, status: evaluation.status })
            }
        }
    }
}

/// How far apart the bounds of two models certainly are.
fn apart(a: &ValueBounds, b: &ValueBounds, state: usize) -> f64 {
    let above = |a: f64, b: f64| if a == b { 0.0 } else { a - b };
    above(a.lower[state], b.upper[state]).max(above(b.lower[state], a.upper[state]))
}
