//! Tables: simulation, sizes, times, budget, other engines, files.

use super::input_material::InputMaterial;
use super::markup::{escape, table};
use super::material::{Material, MaterialOptions};
use super::numbers::{short, tuple};
use super::scene::Scene;
use crate::guarantee::Evidence;
use crate::run::Manifest;
use crate::task::Safety;
use imdp::engines::CrossCheckFile;
use imdp::numeric::{round_decimal_up, shortest_decimal};

/// A number with thin spaces between groups of three digits.
fn count(n: u64) -> String {
    let digits = n.to_string();
    let group = |(i, digit): (usize, char)| {
        let gap = i > 0 && (digits.len() - i).is_multiple_of(3);
        if gap { format!("\u{202f}{digit}") } else { digit.to_string() }
    };
    digits.chars().enumerate().map(group).collect()
}

fn row(cells: &[&str]) -> Vec<String> {
    cells.iter().map(|cell| (*cell).to_owned()).collect()
}

/// How often simulated runs did what.
pub(super) fn simulation(scene: &Scene<'_>) -> String {
    let tally = &scene.tally;
    if tally.runs == 0 {
        return "<p>Nothing was simulated.</p>\n".to_owned();
    }
    let frequency = tally.satisfaction(scene.safety, 0.01);
    let ends = [
        ("reached a goal cell", tally.reached),
        ("met the unsafe region (in a cell)", tally.r#unsafe),
        ("left the partition", tally.outside),
        ("came to a cell without actions", tally.no_action),
        ("ran out of time", tally.over),
        ("were given up", tally.unfinished),
    ];
    let share = |n: u64| short(n as f64 / tally.runs as f64);
    let (grouped, safety) = (scene.group_steps > 1, scene.safety);
    let mut rows = vec![];
    if grouped {
        let [every, instants] = [tally.satisfied, tally.satisfied_at_instants];
        rows.push(row(&["satisfied the task, safe at every step", &count(every), &share(every)]));
        rows.push(row(&["satisfied it at grouped instants", &count(instants), &share(instants)]));
    } else {
        rows.push(row(&["satisfied the task", &count(tally.satisfied), &share(tally.satisfied)]));
    }
    rows.extend(ends.iter().filter(|(_, n)| *n > 0).map(|(name, n)| row(&[name, &count(*n), &share(*n)])));
    if grouped {
        let covered = match safety {
            Safety::EveryStep => "met something unsafe between grouped instants",
            Safety::GroupedInstants => "met something unsafe between grouped instants (not covered)",
        };
        rows.push(row(&[covered, &count(tally.unsafe_between), &share(tally.unsafe_between)]));
    }
    rows.push(row(&["inputs outside U", &count(tally.violations), ""]));
    let caption = format!(
        "{} runs from x = {} under {}, seed {}",
        count(tally.runs),
        tuple(&scene.start),
        scene.noise,
        scene.seed
    );
    let bound = scene.bound;
    let word = if frequency.contradicts(bound) { "contradicts" } else { "does not contradict" };
    format!(
        "<p>The share of runs that satisfied the task is {:.4}, so that its probability lies in [{:.4}, {:.4}] with \
         confidence 0.99 (Clopper–Pearson). This {word} the computed lower bound, {}.</p>\n{}",
        frequency.frequency,
        frequency.lower,
        frequency.upper,
        crate::guarantee::lower_bound_text(bound),
        table(&caption, &["runs that", "number", "share"], &rows)
    )
}

/// What was built and how long it took here.
pub(super) fn sizes(material: &Material<'_>) -> String {
    let manifest = &material.run.manifest;
    let mut rows = vec![
        row(&["cells", &cells(&material.scene)]),
        row(&["targets", &count(material.run.abstraction.targets.len() as u64)]),
        row(&["states", &count(manifest.states)]),
        row(&["choices", &count(manifest.choices)]),
        row(&["transitions", &count(manifest.transitions)]),
        row(&["of distinct rows", &count(manifest.rows)]),
        row(&["with entries", &count(manifest.row_entries)]),
        row(&["noise samples", &count(manifest.samples)]),
        row(&[
            "solver",
            &format!(
                "{}, {} iterations",
                material.answer.solution.status, material.answer.solution.iterations
            ),
        ]),
    ];
    rows.extend(times(&material.options));
    asked(manifest) + &table("Sizes and times of this report", &[], &rows)
}

/// The same where actions are inputs.
pub(super) fn input_sizes(material: &InputMaterial<'_>) -> String {
    let InputMaterial { run, solution, .. } = material;
    let by_axis = |numbers: &[u32]| numbers.iter().map(u32::to_string).collect::<Vec<_>>().join(" × ");
    let mut rows = vec![
        row(&["cells", &cells(&material.scene)]),
        row(&["sub-cells of a cell", &by_axis(&run.abstraction.resolution)]),
        row(&["inputs", &count(run.problem.inputs().len() as u64)]),
        row(&["pairs of a cell and an input", &count(run.abstraction.num_choices() as u64)]),
        row(&["noise samples", &count(run.manifest.samples)]),
        row(&["solver", &format!("{}, {} steps", solution.status, solution.iterations)]),
    ];
    rows.extend(times(&material.options));
    let bounds = format!(
        "<p>At the start the value lies in [{}, {}]: no controller with these inputs is worth more.</p>\n",
        crate::guarantee::lower_bound_text(material.scene.bound),
        shortest_decimal(round_decimal_up(material.upper, 6))
    );
    bounds + &asked(&run.manifest) + &table("Sizes and times of this report", &[], &rows)
}

fn cells(scene: &Scene<'_>) -> String {
    let per_axis: Vec<_> = scene.grid.axes().iter().map(|axis| axis.cells().to_string()).collect();
    let factors = if per_axis.len() > 1 { per_axis.join(" × ") + " = " } else { String::new() };
    factors + &count(u64::from(scene.grid.num_cells()))
}

fn times(options: &MaterialOptions) -> impl Iterator<Item = Vec<String>> + '_ {
    options.times.iter().map(|(phase, time)| row(&[phase, &format!("{:.3} s", time.as_secs_f64())]))
}

fn asked(manifest: &Manifest) -> String {
    format!("<p>Asked: <code>{}</code></p>\n", escape(&manifest.property))
}

/// What the failure probability was spent on.
pub(super) fn budget(manifest: &Manifest) -> String {
    let samples = match &manifest.guarantee.evidence {
        Evidence::Samples(samples) => samples,
        Evidence::Known { .. } => {
            return "<p>Known noise needs no budget: its masses are certain.</p>\n".into();
        }
        Evidence::Published { beta_per_interval } => {
            return format!(
                "<p>Reference mode has no budget: every interval has the level {} for itself.</p>\n",
                short(*beta_per_interval)
            );
        }
    };
    let line = |a: &crate::statistics::Allocation| {
        let events = if a.events < 1e15 { count(a.events as u64) } else { short(a.events) };
        row(&[&escape(&a.family), &events, &short(a.beta)])
    };
    let rows: Vec<_> = samples.budget.iter().map(line).collect();
    let unseen = format!(
        "<p>At most {} of the noise's probability lies outside the window of cells that a row lists.</p>\n",
        short(samples.unseen_mass)
    );
    let part = match samples.sweep {
        1 => String::new(),
        settings => format!(", of which each of {settings} settings has its part,"),
    };
    let caption = format!(
        "How β = {}{part} was spent; by the union bound all events hold together",
        short(samples.beta)
    );
    table(&caption, &["family of events", "events", "β"], &rows) + &unseen
}

/// What other engines said; empty if nobody was asked.
pub(super) fn cross_checks(results: Option<&CrossCheckFile>) -> String {
    let Some(results) = results else { return String::new() };
    let or_dash = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
    let interval = |[lower, upper]: [f64; 2]| {
        if lower == upper { format!("{lower:.9}") } else { format!("[{lower:.9}, {upper:.9}]") }
    };
    let rows = results.findings.iter().map(|finding| {
        vec![
            escape(&format!("{} {}", finding.engine, finding.version.as_deref().unwrap_or(""))),
            format!("<code>{}</code>", escape(&finding.property)),
            or_dash(finding.value.map(interval)),
            interval(finding.ours),
            or_dash(finding.difference.map(|difference| format!("{difference:.1e}"))),
            or_dash(finding.seconds.map(|seconds| format!("{seconds:.2} s"))),
            finding.agreement.word().to_owned(),
        ]
    });
    let header = ["engine", "property", "its value", "ours", "largest difference", "time", "outcome"];
    let caption = "Other engines asked the same; the difference is the largest over all states";
    format!(
        "<section>\n<h2>Cross-check</h2>\n{}</section>\n",
        table(caption, &header, &rows.collect::<Vec<_>>())
    )
}

/// What was read, and where this page comes from.
pub(super) fn provenance(manifest: &Manifest) -> String {
    let inputs = manifest.inputs.iter().map(|file| ("read", &file.name, &file.sha256));
    let outputs = manifest.outputs.iter().map(|file| ("written", &file.name, &file.sha256));
    let rows: Vec<_> = inputs
        .chain(outputs)
        .map(|(how, name, hash)| row(&[&escape(name), how, &format!("<code>{}</code>", escape(hash))]))
        .collect();
    let set = match manifest.set.is_empty() {
        true => String::new(),
        false => {
            format!("<p>Changed in the model file: <code>{}</code></p>\n", escape(&manifest.set.join(" ")))
        }
    };
    let files = table("Files", &["file", "", "SHA-256"], &rows);
    format!("{set}<details><summary>{} files, and their SHA-256</summary>\n{files}</details>\n", rows.len())
}
