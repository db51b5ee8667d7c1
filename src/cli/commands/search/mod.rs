//! `dynabs-compile --search`: the cheapest of many settings of a model with a wanted bound.

mod choice;
mod cost;
mod picture;
mod seek;
mod spec;
mod split;
mod table;

use super::sweep::job::Job;
use super::sweep::program::Program;
use super::sweep::spec::Sweep;
use crate::{CliError, print, print_json, warn};
use choice::Choice;
use seek::Seeker;
use spec::{Samples, Spec};
use split::halves;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use table::Found;

/// What is asked for.
pub(super) struct Request<'a> {
    /// The model file, if it is not in the spec.
    pub(super) model: Option<&'a Path>,
    /// The file that says what to look for.
    pub(super) spec: &'a Path,
    /// The directory of all that is tried and found.
    pub(super) output: &'a Path,
    /// The name of `compile` among the commands of this program; none if it has no others.
    pub(super) subcommand: Option<&'static str>,
    pub(super) json: bool,
    pub(super) quiet: bool,
}

/// Searches: exit code 0 if a setting with the wanted bound is found, or if none was asked for; else 1.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub(super) fn search(request: &Request<'_>) -> Result<ExitCode, CliError> {
    let (spec, below) = (Spec::read(request.spec)?, request.output);
    let model = spec.model(request.model, request.spec)?;
    let settings = spec.settings().map_err(|error| error.in_file(&request.spec.display().to_string()))?;
    let is_together = spec.samples == Samples::Divided;
    let mut sweep = Sweep::of_model(&model, settings, is_together)?;
    let (mut fresh, mut own) = (None, vec![]);
    if spec.samples == Samples::Split {
        let first = sweep.settings.first().cloned().unwrap_or_default();
        let document = sweep.document(&first)?;
        fs::create_dir_all(below).map_err(|error| CliError::writing(below, &error))?;
        let [look, promise] = halves(&document, &sweep.settings, below)?;
        sweep.settings.iter_mut().for_each(|setting| setting.extend(look.clone()));
        (fresh, own) = (Some(promise), look.into_iter().map(|(pointer, _)| pointer).collect());
    }
    fs::create_dir_all(below).map_err(|error| CliError::writing(below, &error))?;
    let jobs = Job::write_all(&sweep, below)?;
    let tell = |text: &str| {
        if !request.quiet {
            warn(text);
        }
    };
    let program = Program::this(request.subcommand, rayon::current_num_threads())?;
    let seeker = Seeker {
        program: &program,
        cost: spec.cost,
        wanted: spec.wanted,
        together: is_together,
        tell: &tell,
    };
    let candidates = seeker.seek(&sweep, jobs)?;
    let choice = Choice::make(&seeker, &sweep, &candidates, fresh, below)?;
    let found = Found {
        name: sweep.name()?,
        own,
        sweep: &sweep,
        cost: spec.cost,
        wanted: spec.wanted,
        candidates: &candidates,
        choice: choice.as_ref(),
    };
    found.write(below)?;
    match request.json {
        true => print_json(&found.to_json())?,
        false if request.quiet => {}
        false => print(&(found.to_markdown() + &found.words(below)))?,
    }
    Ok(if found.is_success() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
