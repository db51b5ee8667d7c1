//! The guarantee in words.

use super::markup::{Plot, escape};
use super::noise_plots::noise_plots;
use super::view::View;

use super::numbers::{short, tuple};
use super::scene::Scene;
use crate::guarantee::{Evidence, Guarantee, SampleEvidence, lower_bound_text};
use crate::run::Manifest;
use imdp::numeric::shortest_decimal;

/// What is said about a controller.
pub(super) struct Promise<'a> {
    pub(super) guarantee: &'a Guarantee,
    /// Its sentences.
    pub(super) sentences: Vec<String>,
    /// The bound that is promised.
    pub(super) bound: f64,
    /// The probability asked for, and whether it is met.
    pub(super) threshold: Option<(f64, Option<bool>)>,
    /// Whether there are upper bounds too.
    pub(super) has_upper: bool,
}

/// What is promised, and what it rests on.
pub(super) fn guarantee(promise: &Promise<'_>) -> String {
    let Promise { guarantee, sentences, .. } = promise;
    let paragraphs: String =
        sentences.iter().map(|sentence| format!("<p>{}</p>\n", escape(sentence))).collect();
    let bound = lower_bound_text(promise.bound);
    match &guarantee.evidence {
        Evidence::Samples(samples) => {
            let confidence = guarantee.confidence().map(shortest_decimal).unwrap_or_default();
            let caveat = guarantee
                .caveat()
                .map_or(String::new(), |caveat| format!("<p><strong>{}</strong></p>\n", escape(&caveat)));
            format!(
                "<div class=\"promise\"><p class=\"figures\"><strong>≥ {bound}</strong> success, with confidence \
                 <strong>{confidence}</strong></p>\n{caveat}{paragraphs}</div>\n{}",
                conditions(promise, samples)
            )
        }
        Evidence::Known { .. } => format!(
            "<div class=\"promise\"><p class=\"figures\"><strong>≥ {bound}</strong> success</p>\n{paragraphs}</div>\n"
        ),
        Evidence::Published { .. } => format!(
            "<div class=\"promise none\"><p class=\"figures\"><strong>No guarantee</strong></p>\n{paragraphs}<p>Every \
             interval by itself has a confidence level, but nothing makes them hold together; cells that no sample met \
             count as impossible. Compile with mode <code>pac</code> for a guarantee.</p></div>\n"
        ),
    }
}

/// The answer in a line: whether what was asked for is promised.
pub(super) fn verdict(promise: &Promise<'_>) -> String {
    let (class, word, asked) = match promise.threshold {
        None => ("open", "no threshold", "nothing was asked for; ".to_owned()),
        Some((threshold, satisfied)) => {
            let (class, word) = match satisfied {
                Some(true) => ("true", "true"),
                Some(false) => ("false", "false"),
                None => ("open", "undecided"),
            };
            (class, word, format!("asked for ≥ {}, ", short(threshold)))
        }
    };
    let bound = lower_bound_text(promise.bound);
    let found = match promise.guarantee.evidence {
        Evidence::Published { .. } => format!("computed {bound}, without any guarantee"),
        _ => format!("promised ≥ {bound}"),
    };
    format!("<p class=\"verdict is-{class}\"><strong>{word}</strong> {asked}{found}</p>\n")
}

fn conditions(promise: &Promise<'_>, samples: &SampleEvidence) -> String {
    let guarantee = promise.guarantee;
    let upper = if promise.has_upper {
        ""
    } else {
        "; in particular, there are no upper bounds for reaching the goal"
    };
    let assumes: String = guarantee
        .assumes()
        .iter()
        .map(|condition| format!("<li>It needs that {}.</li>\n", escape(condition)))
        .collect();
    format!(
        "<details><summary>What this rests on</summary>\n<ul>\n<li>One event of probability at least 1 − β, with β = {}, over the {} samples covers all cells, horizons \
         and policies at once: the policy was chosen on the same samples, and that is fine.</li>\n<li>Covered are {}. \
         Nothing else is{upper}.</li>\n{assumes}</ul></details>\n",
        short(samples.beta),
        samples.number,
        escape(guarantee.covers())
    )
}

/// What the user should know.
pub(super) fn warnings(manifest: &Manifest) -> String {
    if manifest.warnings.is_empty() {
        return String::new();
    }
    let items: String =
        manifest.warnings.iter().map(|warning| format!("<li>{}</li>\n", escape(warning))).collect();
    format!("<h3>To be aware of</h3>\n<ul>\n{items}</ul>\n")
}

/// What the plots show.
pub(super) fn about_runs(scene: &Scene<'_>) -> String {
    let chosen = match scene.start_is_given {
        true => "the initial state",
        false => "the model names no initial state, so the cell with the median promise was taken",
    };
    let between = match scene.group_steps {
        1 => String::new(),
        d => format!(" They join the grouped instants, every {d} steps."),
    };
    let memory = match scene.memories.is_empty() {
        true => "",
        false => {
            " Values and arrows are those at the start; above the map others can be chosen, by what a run remembers when it comes to a cell."
        }
    };
    format!(
        "Lines are the first {} simulated runs from x = {} ({chosen}), seed {}.{between}{memory}",
        scene.trajectories.len(),
        tuple(&scene.start),
        scene.seed
    )
}

/// States and inputs over time, and what the lines are.
pub(super) fn over_time(scene: &Scene<'_>) -> String {
    let runs = super::over_time::number_of_runs(scene);
    if runs == 0 {
        return "<p>No run is drawn.</p>\n".to_owned();
    }
    figure(
        &super::over_time::over_time(scene),
        &format!(
            "The first {runs} simulated runs, step by step; those that did not satisfy the task, and the limits of U, are dashed."
        ),
    )
}

/// The noise beside cells, and what is drawn.
pub(super) fn noise(scene: &Scene<'_>, view: &View) -> String {
    let plots = noise_plots(scene, view);
    if plots.is_empty() {
        return "<p>There is no noise.</p>\n".to_owned();
    }
    let of = if scene.group_steps > 1 { "grouped step" } else { "step" };
    figure(
        &plots,
        &format!(
            "{} samples or draws of the noise of a {of}. Lines and bars are cells, one of which has 0 in its middle; where cells are \
             too many for that there are no lines, and bars are wider.",
            scene.noise_draws.len()
        ),
    )
}

/// Small plots side by side.
fn figure(plots: &[Plot], caption: &str) -> String {
    let plots: String = plots.iter().map(Plot::inline).collect();
    format!(
        "<figure><div class=\"small\">\n{plots}</div>\n<figcaption><p>{caption}</p></figcaption></figure>\n"
    )
}
