//! What came of a search: a table, a picture and words.

use super::choice::{CHOSEN, Choice};
use super::cost::Cost;
use super::picture::picture;
use super::seek::{Candidate, State};
use crate::commands::sweep::spec::Sweep;
use crate::commands::sweep::table::{comma_separated, markdown};
use crate::{CliError, thousands};
use dynabs::guarantee::lower_bound_text;
use imdp::files::Outputs;
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use std::path::Path;

/// All that was found.
pub(super) struct Found<'a> {
    pub(super) name: String,
    pub(super) sweep: &'a Sweep,
    pub(super) cost: Cost,
    pub(super) wanted: Option<f64>,
    pub(super) candidates: &'a [Candidate],
    pub(super) choice: Option<&'a Choice>,
    /// What the search itself set, which the spec does not speak of.
    pub(super) own: Vec<String>,
}

impl Found<'_> {
    /// Whether what was wanted is promised, or nothing was.
    pub(super) fn is_success(&self) -> bool {
        self.wanted.is_none_or(|wanted| self.choice.is_some_and(|choice| choice.lower >= wanted))
    }

    /// Writes the table, the object and the picture.
    ///
    /// # Errors
    /// [`CliError`] if that fails.
    pub(super) fn write(&self, below: &Path) -> Result<(), CliError> {
        let table = comma_separated(&self.header(), &self.lines());
        let object = format!("{:#}\n", self.to_json());
        let drawn = picture(self);
        let write = || -> io::Result<()> {
            let mut files = Outputs::default();
            for (name, text) in [("table.csv", &table), ("search.json", &object), ("trade-off.svg", &drawn)] {
                files.write(&below.join(name), |out| out.write_all(text.as_bytes()))?;
            }
            files.commit()
        };
        write().map_err(|error| CliError::writing(below, &error))
    }

    /// The JSON pointers that some setting of the spec sets.
    fn pointers(&self) -> Vec<&String> {
        let mut pointers: Vec<&String> = vec![];
        for pointer in self.candidates.iter().flat_map(|candidate| candidate.job.setting.keys()) {
            if !pointers.contains(&pointer) && !self.own.contains(pointer) {
                pointers.push(pointer);
            }
        }
        pointers
    }

    /// Whether actions are inputs in all settings, which then have choices to count.
    pub(super) fn takes_inputs(&self) -> bool {
        self.candidates.iter().all(|candidate| candidate.extent.takes_inputs)
    }

    fn header(&self) -> Vec<String> {
        let pointers = self.pointers().into_iter().cloned();
        let size = self.cost.column(self.takes_inputs());
        let figures = ["cells", "samples", size, "lower", "state"].map(str::to_owned);
        std::iter::once("job".to_owned()).chain(pointers).chain(figures).collect()
    }

    fn lines(&self) -> Vec<Vec<String>> {
        let pointers = self.pointers();
        self.candidates
            .iter()
            .enumerate()
            .map(|(place, candidate)| self.line(&pointers, place, candidate))
            .collect()
    }

    fn line(&self, pointers: &[&String], place: usize, candidate: &Candidate) -> Vec<String> {
        let text = |value: Option<&Value>| value.map_or(String::new(), Value::to_string);
        let settings = pointers.iter().map(|&pointer| text(candidate.job.setting.get(pointer)));
        let extent = candidate.extent;
        let samples = extent.samples.map_or(String::new(), |samples| samples.to_string());
        let lower = candidate.bound().map_or(String::new(), |bound| bound.lower.to_string());
        let size = candidate.size.map_or(String::new(), |size| size.to_string());
        let figures = [extent.cells.to_string(), samples, size, lower, self.state(place, candidate)];
        std::iter::once(candidate.job.name()).chain(settings).chain(figures).collect()
    }

    fn state(&self, place: usize, candidate: &Candidate) -> String {
        match &candidate.state {
            State::Tried(_) if self.choice.is_some_and(|choice| choice.place == place) => CHOSEN.to_owned(),
            State::Tried(_) => "tried".to_owned(),
            State::NotNeeded => "not needed".to_owned(),
            State::Excluded { by, upper } => format!("excluded: no controller exceeds {upper} ({by})"),
            State::Failed(error) => format!("failed: {error}"),
        }
    }

    /// The table in Markdown.
    pub(super) fn to_markdown(&self) -> String {
        markdown(&self.header(), &self.lines())
    }

    /// All of it as one object.
    pub(super) fn to_json(&self) -> Value {
        let pointers = self.pointers();
        let object = |(place, candidate): (usize, &Candidate)| {
            let setting =
                |&pointer: &&String| Some((pointer.clone(), candidate.job.setting.get(pointer)?.clone()));
            json!({
                "job": candidate.job.name(),
                "settings": pointers.iter().filter_map(setting).collect::<Map<String, Value>>(),
                "cells": candidate.extent.cells,
                "samples": candidate.extent.samples,
                self.cost.column(candidate.extent.takes_inputs): candidate.size,
                "lower": candidate.bound().map(|bound| bound.lower),
                "state": self.state(place, candidate),
            })
        };
        json!({
            "name": self.name,
            "model": self.sweep.model,
            "wanted": self.wanted,
            "cost": self.cost,
            "settings": self.candidates.iter().enumerate().map(object).collect::<Vec<_>>(),
            "chosen": self.choice.map(|choice| json!({
                "job": self.candidates[choice.place].job.name(),
                "directory": format!("{CHOSEN}/run"),
                "lower": choice.lower,
                "confidence": choice.confidence,
                "fresh_samples": choice.is_fresh,
            })),
        })
    }

    /// What was found, in words; `below` is where the choice is.
    pub(super) fn words(&self, below: &Path) -> String {
        let count = |is: fn(&State) -> bool| self.candidates.iter().filter(|one| is(&one.state)).count();
        let tried = count(|state| matches!(state, State::Tried(_)));
        let mut text = format!("{tried} of {} settings tried, the cheapest first", self.candidates.len());
        for (number, what) in [
            (count(|state| matches!(state, State::NotNeeded)), "cost no less than the choice"),
            (count(|state| matches!(state, State::Excluded { .. })), "excluded"),
            (count(|state| matches!(state, State::Failed(_))), "failed"),
        ] {
            if number > 0 {
                text += &format!("; {number} {what}");
            }
        }
        text += "\n";
        let Some(wanted) = self.wanted else { return text };
        let Some(choice) = self.choice else {
            let best = self.candidates.iter().filter_map(|one| Some((one.bound()?.lower, one.job.name())));
            let best = best.max_by(|(one, _), (other, _)| one.total_cmp(other));
            let best =
                best.map_or(String::new(), |(lower, name)| format!("; the best has {lower:.6} ({name})"));
            return text + &format!("none of these settings has at least {wanted}{best}\n");
        };
        let chosen = &self.candidates[choice.place];
        let (name, words) = (chosen.job.name(), self.cost.words(chosen.extent.takes_inputs));
        let cost = chosen.bound().map_or(0, |bound| bound.cost);
        text += &format!(
            "chosen: {name}, {} {words}: at least {}",
            thousands(cost),
            lower_bound_text(choice.lower)
        );
        if let Some(confidence) = choice.confidence {
            text += &format!(", with confidence {confidence}");
        }
        if choice.is_fresh {
            let looked = chosen.bound().map_or(0.0, |bound| bound.lower);
            text += &format!(" by samples that had not been looked at ({looked:.6} by those that had)");
            if choice.lower < wanted {
                text += ": less than was wanted";
            }
        }
        text + &format!("\n  {}\n", below.join(CHOSEN).join("run").display())
    }
}
