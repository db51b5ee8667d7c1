//! `dynabs-compile` for actions that are inputs.

use crate::input_summary::{InputResult, summary};
use crate::{Bars, CliError, print};
use dynabs::abstraction::inputs::{InputAbstraction, InputsError};
use dynabs::model_file::Document;
use dynabs::problem::InputProblem;
use imdp::solver::SolverOptions;
use serde_json::json;
use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Instant;

/// What is wanted.
pub(super) struct Wanted {
    pub(super) solve: bool,
    pub(super) json: bool,
    pub(super) quiet: bool,
}

/// Abstracts, solves and reports.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub(super) fn compile_inputs(
    document: &Document,
    problem: &InputProblem,
    wanted: &Wanted,
    notes: &[String],
    start: Instant,
    bars: &Bars,
) -> Result<ExitCode, CliError> {
    let read = start.elapsed();
    let abstraction = InputAbstraction::new(problem).map_err(|error| of_inputs(&error, &document.name))?;
    bars.catch_interrupts()?;
    let mut phases = vec![("model file", read)];
    phases.extend(&abstraction.phases);
    let solving = Instant::now();
    let result = if wanted.solve {
        let progress =
            |step, change: f64| bars.note(|| format!("step {step}, values change by {change:.1e}"));
        let options = SolverOptions {
            interrupt: Some(bars.interrupt()),
            progress: Some(&progress),
            ..SolverOptions::default()
        };
        let solution = abstraction.question().solve(&options);
        bars.finish();
        phases.push(("solving", solving.elapsed()));
        Some(InputResult::new(problem, &abstraction, &solution, solving.elapsed()))
    } else {
        None
    };
    if !wanted.quiet {
        let mut text: String =
            problem.warnings().iter().chain(notes).map(|warning| format!("warning: {warning}\n")).collect();
        let times: Vec<_> = phases.iter().map(|(name, time)| format!("{name} {time:.1?}")).collect();
        text += &format!("times: {}\n", times.join(", "));
        // If stderr is closed there is nobody to warn.
        let _ = io::stderr().write_all(text.as_bytes());
    }
    if wanted.json {
        let object = json!({
            "name": problem.name(),
            "actions": "inputs",
            "cells": problem.grid().num_cells(),
            "inputs": problem.inputs().len(),
            "choices": abstraction.num_choices(),
            "resolution": abstraction.resolution,
            "result": result,
        });
        print(&format!("{object:#}\n"))?;
    } else if !wanted.quiet {
        let initial =
            if problem.initial_state().is_some() { "at the initial state" } else { "over all cells" };
        print(
            &(summary(problem, &abstraction)
                + &result.as_ref().map_or(String::new(), |result| result.text(initial))),
        )?;
    }
    Ok(result.map_or(ExitCode::SUCCESS, |result| result.exit_code()))
}

/// A mistake in the file, or a machine too small.
fn of_inputs(error: &InputsError, file: &str) -> CliError {
    CliError::Input(format!("{file}: {error}"))
}
