//! What a compilation was, for people.

use super::thousands;
use dynabs::abstraction::Footprint;
use dynabs::guarantee::{Guarantee, SampleEvidence};
use dynabs::run::Manifest;
use imdp::model::available_memory;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Bytes in MiB, rounded up.
pub(super) fn thousands_of_mib(bytes: u64) -> String {
    thousands(bytes.div_ceil(1 << 20))
}

/// How much memory a compilation was expected to take, part by part, and what there is.
pub(super) fn memory(footprint: &Footprint) -> String {
    let parts: Vec<_> = footprint
        .needs()
        .iter()
        .map(|need| format!("{} {}", need.what, thousands_of_mib(need.bytes)))
        .collect();
    let available = available_memory()
        .map_or(String::new(), |(bytes, limit)| format!("; {} available ({limit})", thousands(bytes >> 20)));
    let name = "memory";
    format!(
        "  {name:<13}about {} MiB: {}{available}\n",
        thousands_of_mib(footprint.bytes()),
        parts.join(", ")
    )
}

/// The same for programs.
pub(super) fn memory_json(footprint: &Footprint) -> Value {
    let available = available_memory().map(|(bytes, _)| bytes);
    json!({"needs": footprint.needs(), "bytes": footprint.bytes(), "available": available})
}

/// What must not have been chosen by looking at the samples, on a line of its own.
pub(super) fn fixed_beforehand(guarantee: &Guarantee) -> String {
    let list = guarantee.fixed_beforehand();
    if list.is_empty() { String::new() } else { format!("whatever the samples: {}", list.join(", ")) }
}

/// The property that was not solved, on a line of its own.
pub(super) fn property(property: &str) -> String {
    let name = "property";
    format!("  {name:<13}{property}\n")
}

/// How the confidence is spent.
pub(super) fn budget(samples: &SampleEvidence) -> String {
    let spent =
        samples.budget.iter().map(|a| format!("{} {:.2e} over {} events", a.family, a.beta, a.events));
    spent.collect::<Vec<_>>().join(", ")
}

/// The summary of a run; `directory` is where it was written, if it was. Whoever wants to know everything gets how the confidence
/// is spent and the numbers of the lower layer, too.
pub(super) fn summary(manifest: &Manifest, directory: Option<&str>, verbose: bool) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<13}{value}");
    };
    line("states", thousands(manifest.states));
    line("choices", thousands(manifest.choices));
    line(
        "transitions",
        format!(
            "{} ({} stored, in {} shared rows)",
            thousands(manifest.transitions),
            thousands(manifest.row_entries),
            thousands(manifest.rows)
        ),
    );
    if let Some(layers) = manifest.stabilizer.as_ref().filter(|_| verbose) {
        let gain: Vec<_> = layers.gain.iter().map(|row| format!("{row:?}")).collect();
        line("gain K", gain.join(" "));
        let eigenvalues: Vec<_> =
            layers.closed_loop_eigenvalues.iter().map(|[re, im]| format!("{re:.5}{im:+.5}i")).collect();
        line("eigenvalues", eigenvalues.join("  "));
        if let Some(residual) = layers.riccati_residual {
            line("Riccati", format!("relative residual {residual:.1e}"));
        }
    }
    if let Some(plan) = manifest.plan.as_ref().filter(|_| verbose) {
        let (cells, targets) = (thousands(plan.cells), thousands(plan.targets));
        line("plan", format!("from {cells} cells to {targets} targets; enabled is what U' allows around it"));
    }
    match (manifest.guarantee.samples(), manifest.guarantee.confidence()) {
        (Some(samples), Some(confidence)) => {
            let number = thousands(samples.number);
            let sweep = match samples.sweep {
                1 => String::new(),
                settings => format!(", of {settings} settings together"),
            };
            line(
                "intervals",
                format!("hold together with confidence {confidence}{sweep}, from {number} samples"),
            );
            if verbose {
                line("budget", budget(samples));
                line("unseen mass", format!("at most {:.6}", samples.unseen_mass));
            }
            line("fixed", fixed_beforehand(&manifest.guarantee));
        }
        (None, Some(_)) => line("intervals", "enclose the masses of the known distribution".into()),
        _ => line("intervals", "those of the published tool: for comparison, not a guarantee".into()),
    }
    if manifest.group_steps > 1 {
        line("one step", format!("stands for {} of the original system", manifest.group_steps));
    }
    if let Some(directory) = directory {
        let bytes: u64 = manifest.outputs.iter().map(|file| file.bytes).sum();
        line("written", format!("{directory} ({:.1} MB)", bytes as f64 / 1e6));
    }
    let mode = &manifest.mode;
    let caveat = manifest.guarantee.caveat().map_or(String::new(), |caveat| format!(": {caveat}"));
    format!("{} ({mode} mode){caveat}\n{text}", manifest.name)
}
