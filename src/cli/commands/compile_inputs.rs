//! `dynabs-compile` for actions that are inputs.

use crate::input_summary::{InputResult, summary};
use crate::phases::FILES;
use crate::progress::SOLVING;
use crate::pruning::pruned;
use crate::resources::times;
use crate::summary::{memory, memory_json};
use crate::unasked::Unasked;
use crate::{Bars, CliError, print, warn};
use dynabs::abstraction::CostError;
use dynabs::abstraction::inputs::{InputAbstraction, InputEncoding, InputModel, InputsError};
use dynabs::controller::Controller;
use dynabs::landing::FlatModelError;
use dynabs::model_file::Document;
use dynabs::problem::InputProblem;
use dynabs::run::{Manifest, PruningReport, WriteOptions, input_solution_options, write_input_run};
use imdp::progress::Progress;
use imdp::ranks;
use imdp::solver::SolverOptions;
use serde_json::{Map, Value, json};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What is wanted.
pub(super) struct Wanted<'a> {
    /// Where to write what.
    pub(super) output: Option<(&'a Path, WriteOptions<'a>)>,
    /// How choices lead to cells in files.
    pub(super) encoding: InputEncoding,
    /// What `--set` changed.
    pub(super) set: &'a [String],
    pub(super) solve: bool,
    /// Whether formats were not chosen.
    pub(super) unasked: bool,
    /// Whether files keep only what an optimal policy needs.
    pub(super) prune: bool,
    pub(super) json: bool,
    pub(super) quiet: bool,
    pub(super) verbose: bool,
    /// Whether nothing is written, so that what it would take is of interest.
    pub(super) dry_run: bool,
}

/// Abstracts, solves and reports.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub(super) fn compile_inputs(
    (document, source): (&Document, &str),
    problem: &InputProblem,
    wanted: &Wanted<'_>,
    notes: Vec<String>,
    start: Instant,
    bars: &Arc<Bars>,
) -> Result<ExitCode, CliError> {
    let read = start.elapsed();
    let abstraction = InputAbstraction::new(problem).map_err(|error| of_inputs(&error, &document.name))?;
    let written = wanted.output.is_some().then_some((FILES, 1.0));
    bars.expect([(SOLVING, 3.0)].into_iter().filter(|_| wanted.solve).chain(written).collect());
    bars.catch_interrupts();
    let mut phases = vec![("model file", read)];
    phases.extend(&abstraction.phases);
    let mut manifest = Manifest::of_inputs(document, source, problem, &abstraction);
    manifest.set = wanted.set.to_vec();
    manifest.warnings.extend(notes);
    let exported = export(problem, &abstraction, wanted, bars)?;
    if let Some(Exported { model, pruning, time }) = &exported {
        manifest = manifest.with_model(problem, model);
        if let Some(report) = pruning {
            manifest.warnings.push(format!("{}; {}", report.kept, report.scope));
            manifest.pruning = Some(report.clone());
        }
        phases.push(("model", *time));
    }
    let solving = Instant::now();
    let (mut kept, mut controller_bytes) = (None, None);
    let result = if wanted.solve {
        let options = SolverOptions { progress: &**bars, ..SolverOptions::default() };
        let solution = abstraction.question().solve(&input_solution_options(problem, &options));
        let result = InputResult::new(problem, &abstraction, &solution, solving.elapsed());
        let result = match &exported {
            Some(Exported { model, .. }) if model.encoding == InputEncoding::Flat => {
                result.with_flat(model, &options)?
            }
            _ => result.with_exported(problem, &abstraction, &options),
        };
        if wanted.json {
            controller_bytes = Controller::of_inputs(problem, &abstraction, &solution).table_bytes().ok();
        }
        kept = Some(solution.of_pairs());
        bars.finish();
        phases.push(("solving", solving.elapsed()));
        Some(result)
    } else {
        None
    };
    let mut unasked = Unasked::default();
    if let Some((output, options)) = &wanted.output {
        if !ranks::dismiss() {
            return Ok(ExitCode::SUCCESS);
        }
        let writing = Instant::now();
        let mut options = WriteOptions { solution: kept.as_ref(), ..options.clone() };
        let model = exported.as_ref().map(|exported| &exported.model);
        if let Some(model) = model.filter(|_| wanted.unasked) {
            unasked = Unasked::of(&model.model)?;
            options.formats.clone_from(&unasked.formats);
        }
        manifest = write_input_run(output, document, problem, model, manifest, &options, &**bars)?;
        phases.push(("files", writing.elapsed()));
    }
    if !wanted.quiet {
        manifest.warnings.iter().for_each(|warning| warn(&format!("warning: {warning}\n")));
        if wanted.verbose {
            warn(&times(&phases));
        }
    }
    if wanted.json {
        let seconds: Map<String, Value> =
            phases.iter().map(|(name, time)| ((*name).to_owned(), time.as_secs_f64().into())).collect();
        let mut object = json!({
            "cells": problem.grid().num_cells(),
            "inputs": problem.inputs().len(),
            "choices": abstraction.num_choices(),
            "resolution": abstraction.resolution,
            "manifest": manifest,
            "result": result,
            "seconds": seconds,
        });
        if let Some(bytes) = controller_bytes {
            object["controller_bytes"] = bytes.into();
        }
        if wanted.dry_run {
            object["memory"] = memory_json(&abstraction.footprint);
        }
        print(&format!("{object:#}\n"))?;
    } else if !wanted.quiet {
        let initial =
            if problem.initial_state().is_some() { "at the initial state" } else { "over all cells" };
        let mut text = summary(problem, &abstraction, wanted.verbose);
        if wanted.dry_run {
            text += &memory(&abstraction.footprint);
        }
        if let Some((output, _)) = &wanted.output {
            let bytes: u64 = manifest.outputs.iter().map(|file| file.bytes).sum();
            text += &format!("  {:<13}{} ({:.1} MB)\n", "written", output.display(), bytes as f64 / 1e6);
            text += unasked.left_out.as_deref().unwrap_or_default();
        }
        text += &result.as_ref().map_or(String::new(), |result| result.text(initial, wanted.verbose));
        print(&text)?;
    }
    Ok(result.map_or(ExitCode::SUCCESS, |result| result.exit_code()))
}

/// The model that files are to have.
struct Exported {
    model: InputModel,
    pruning: Option<PruningReport>,
    time: Duration,
}

/// Makes the model if something is to be done with it.
fn export(
    problem: &InputProblem,
    abstraction: &InputAbstraction,
    wanted: &Wanted<'_>,
    bars: &Bars,
) -> Result<Option<Exported>, CliError> {
    let is_written =
        wanted.output.as_ref().is_some_and(|(_, options)| wanted.unasked || !options.formats.is_empty());
    let is_looked_at = wanted.prune || wanted.solve && wanted.encoding == InputEncoding::Flat;
    if !is_written && !is_looked_at {
        return Ok(None);
    }
    let start = Instant::now();
    let model = abstraction.model(problem.initial_cell(), wanted.encoding);
    let mut model = model.map_err(|error| match error {
        FlatModelError::Memory(_) => CliError::Input(format!(
            "{error}\n  Use fewer /partition/cells, --encoding plain, or --no-tra for no model."
        )),
        FlatModelError::Model(_) => CliError::Failure(error.to_string()),
    })?;
    if wanted.prune && !problem.costs().is_empty() {
        warn(COSTS_LEFT_OUT);
    } else {
        model = abstraction.with_costs(problem, model)?;
    }
    let pruning = match wanted.prune {
        true => Some(pruned(&mut model.model, &model.properties[0], bars)?.1),
        false => None,
    };
    Ok(Some(Exported { model, pruning, time: start.elapsed() }))
}

/// What is said where a model is pruned that has costs.
pub(super) const COSTS_LEFT_OUT: &str = "warning: costs are left out: what --prune keeps is for the task\n";

impl From<CostError> for CliError {
    fn from(error: CostError) -> Self {
        match error {
            CostError::Reward(_) => Self::Failure(error.to_string()),
            CostError::MicroSteps { .. } => Self::Input(format!(
                "{error}\n  Use --encoding flat, and regions whose faces are faces of cells."
            )),
            _ => Self::Input(error.to_string()),
        }
    }
}

/// A mistake in the file, or a machine too small.
fn of_inputs(error: &InputsError, file: &str) -> CliError {
    CliError::Input(format!("{file}: {error}"))
}
