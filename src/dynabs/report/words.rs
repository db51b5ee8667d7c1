//! The guarantee in words.

use super::markup::escape;
use super::material::Material;
use super::numbers::{short, tuple};
use crate::guarantee::{Evidence, Guarantee, SampleEvidence, lower_bound_text};
use crate::run::Run;
use imdp::numeric::shortest_decimal;

/// What is promised, and what it rests on.
pub(super) fn guarantee(material: &Material<'_>) -> String {
    let guarantee = material.controller.guarantee();
    let paragraphs: String = material
        .controller
        .promise()
        .iter()
        .map(|sentence| format!("<p>{}</p>\n", escape(sentence)))
        .collect();
    match &guarantee.evidence {
        Evidence::Samples(samples) => {
            let bound = lower_bound_text(material.controller.promised().bound);
            let confidence = guarantee.confidence().map(shortest_decimal).unwrap_or_default();
            let caveat = guarantee
                .caveat()
                .map_or(String::new(), |caveat| format!("<p><strong>{}</strong></p>\n", escape(&caveat)));
            format!(
                "<div class=\"promise\"><p class=\"figures\"><strong>≥ {bound}</strong> success, with confidence \
                 <strong>{confidence}</strong></p>\n{caveat}{paragraphs}{}</div>\n{}",
                threshold(material),
                conditions(guarantee, samples)
            )
        }
        Evidence::Known { .. } => format!(
            "<div class=\"promise\"><p class=\"figures\"><strong>≥ {}</strong> success</p>\n{paragraphs}{}</div>\n",
            lower_bound_text(material.controller.promised().bound),
            threshold(material)
        ),
        Evidence::Published { .. } => format!(
            "<div class=\"promise none\"><p class=\"figures\"><strong>No guarantee</strong></p>\n{paragraphs}<p>Every \
             interval by itself has a confidence level, but nothing makes them hold together; cells that no sample met \
             count as impossible. Compile with mode <code>pac</code> for a guarantee.</p>{}</div>\n",
            threshold(material)
        ),
    }
}

fn threshold(material: &Material<'_>) -> String {
    let Some(threshold) = material.problem().threshold() else { return String::new() };
    let verdict = match material.answer.satisfied() {
        Some(true) => "it is met",
        Some(false) => "it is <strong>not</strong> met",
        None => "it is undecided",
    };
    format!("<p>Asked for was at least {}: {verdict}.</p>\n", short(threshold.to_f64()))
}

fn conditions(guarantee: &Guarantee, samples: &SampleEvidence) -> String {
    let assumes: String = guarantee
        .assumes()
        .iter()
        .map(|condition| format!("<li>It needs that {}.</li>\n", escape(condition)))
        .collect();
    format!(
        "<ul>\n<li>One event of probability at least 1 − β, with β = {}, over the {} samples covers all cells, horizons \
         and policies at once: the policy was chosen on the same samples, and that is fine.</li>\n<li>Covered are {}. \
         Nothing else is; in particular, there are no upper bounds for reaching the goal.</li>\n{assumes}</ul>\n",
        short(samples.beta),
        samples.number,
        escape(guarantee.covers())
    )
}

/// What the user should know.
pub(super) fn warnings(run: &Run) -> String {
    if run.manifest.warnings.is_empty() {
        return String::new();
    }
    let items: String =
        run.manifest.warnings.iter().map(|warning| format!("<li>{}</li>\n", escape(warning))).collect();
    format!("<h3>To be aware of</h3>\n<ul>\n{items}</ul>\n")
}

/// What the plots show.
pub(super) fn about_runs(material: &Material<'_>) -> String {
    let chosen = match material.problem().initial_state() {
        Some(_) => "the initial state",
        None => "the model names no initial state, so the cell with the median promise was taken",
    };
    let between = match material.problem().group_steps() {
        1 => String::new(),
        d => format!(" They join the grouped instants, every {d} steps."),
    };
    format!(
        "Lines are the first {} simulated runs from x = {} ({chosen}), seed {}; those that failed are dashed.{between}",
        material.trajectories.len(),
        tuple(&material.start),
        material.options.seed
    )
}
