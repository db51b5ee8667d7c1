//! Writing DRN: streamed from shared rows, whose text is rendered once.

use super::UNNAMED;
use crate::files::interruption;
use crate::formats::names::{NameError, NameRule, is_identifier};
use crate::model::{ActionNames, End, IntervalMdp, ModelKind, RewardStructure, RowId, StateId, StateSet};
use crate::numeric::shortest_decimal;
use crate::progress::Progress;
use std::convert::Infallible;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Text is handed on in pieces of about this many bytes.
const PIECE: usize = 1 << 20;

const LABELS: NameRule = NameRule {
    format: "DRN",
    expected: "a name without quotation marks and control characters",
    accepts: |name| !name.is_empty() && !name.contains(|c: char| c == '"' || c.is_control()),
};

const ACTIONS: NameRule = NameRule {
    format: "DRN",
    expected: "a name without blanks and control characters other than __NOLABEL__",
    accepts: |name| {
        let unfit = |c: char| c.is_whitespace() || c.is_control();
        !name.is_empty() && name != UNNAMED && !name.contains(unfit)
    },
};

const VARIABLES: NameRule = NameRule {
    format: "DRN",
    expected: "a name without blanks and control characters that does not begin with a quotation mark",
    accepts: |name| !name.is_empty() && stands_between_blanks(name),
};

/// Whether a name is read as it is from a line of names: what begins with a quotation mark would be one up to the next.
fn stands_between_blanks(name: &str) -> bool {
    !name.starts_with('"') && !name.contains(|c: char| c.is_whitespace() || c.is_control())
}

/// Writes a model in Storm's DRN format.
#[derive(Debug)]
pub struct DrnWriter<'a> {
    model: &'a IntervalMdp,
    /// The initial states, then the labels with states, as they are printed.
    labels: Vec<(String, &'a StateSet)>,
    rewards: Vec<(String, &'a RewardStructure)>,
    rows: RowTexts,
    bytes: u64,
}

/// Per row, the lines of its transitions.
#[derive(Debug)]
struct RowTexts {
    text: Vec<u8>,
    ends: Vec<usize>,
}

impl RowTexts {
    fn render(model: &IntervalMdp) -> Self {
        let mut texts = Self { text: vec![], ends: vec![] };
        model.rows().for_each(|_, row| {
            for (i, successor) in row.successors.iter().enumerate() {
                let (lower, upper) = (row.text(End::Lower, i), row.text(End::Upper, i));
                let line = format!("\t\t{successor} : [{lower}, {upper}]\n");
                texts.text.extend_from_slice(line.as_bytes());
            }
            texts.ends.push(texts.text.len());
        });
        texts
    }

    fn row(&self, row: RowId) -> &[u8] {
        let row = row.index();
        &self.text[row.checked_sub(1).map_or(0, |before| self.ends[before])..self.ends[row]]
    }
}

impl<'a> DrnWriter<'a> {
    /// Prepares to write `model`: renders its rows and computes the exact size of the file.
    ///
    /// # Errors
    /// [`NameError`] if a label, an action or a variable has a name that DRN cannot express.
    pub fn new(model: &'a IntervalMdp) -> Result<Self, NameError> {
        LABELS.check_labels(model)?;
        ACTIONS.check_actions(model)?;
        VARIABLES.check_variables(model)?;
        let declared = model.labels().iter().filter(|(name, _)| *name != "init");
        let labels = std::iter::once(("init", model.initial())).chain(declared);
        let labels = labels.map(|(name, states)| (quoted(name), states)).collect();
        let rewards = reward_names(model);
        let mut writer = Self { model, labels, rewards, rows: RowTexts::render(model), bytes: 0 };
        let mut bytes = 0;
        let Ok(()) = writer.pieces(|piece| {
            bytes += piece.len() as u64;
            Ok::<(), Infallible>(())
        });
        writer.bytes = bytes;
        Ok(writer)
    }

    /// Whether a reward structure can be written: branches of a choice all earn the same in DRN.
    pub fn holds(structure: &RewardStructure) -> bool {
        structure.branches.is_empty() && stands_between_blanks(&structure.name)
    }

    /// The size of the file in bytes.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut impl Write, progress: &dyn Progress) -> io::Result<()> {
        let mut text = Vec::with_capacity(2 * PIECE);
        self.pieces(|piece| {
            text.extend_from_slice(piece);
            if text.len() < PIECE {
                return Ok(());
            }
            if progress.is_interrupted() {
                return Err(interruption());
            }
            out.write_all(&text)?;
            progress.advance(text.len() as u64);
            text.clear();
            Ok(())
        })?;
        out.write_all(&text)?;
        progress.advance(text.len() as u64);
        Ok(())
    }

    /// Hands on the file piece by piece.
    fn pieces<E>(&self, mut take: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        take(self.header().as_bytes())?;
        let choices = self.model.choices();
        let mut choice = 0;
        let mut text = String::new();
        for state in StateId::first(self.model.num_states()) {
            text.clear();
            self.state_lines(state, &mut text);
            take(text.as_bytes())?;
            if choices.ranges(state).is_empty() {
                let name =
                    if choices.is_absorbing(state) { self.action(choice, 0, None) } else { UNNAMED.into() };
                text.clear();
                let _ = write!(text, "\taction {name}");
                let is_choice = choices.is_absorbing(state);
                self.earned(&mut text, |rewards| if is_choice { rewards.of_choice(choice) } else { 0.0 });
                let _ = write!(text, "\n\t\t{state} : [1, 1]\n");
                take(text.as_bytes())?;
                choice += u64::from(choices.is_absorbing(state));
            }
            for (index, row) in choices.rows(state).enumerate() {
                text.clear();
                // Writing to a string cannot fail.
                let _ = write!(text, "\taction {}", self.action(choice, index, Some(row)));
                self.earned(&mut text, |rewards| rewards.of_choice(choice));
                text.push('\n');
                take(text.as_bytes())?;
                take(self.rows.row(row))?;
                choice += 1;
            }
        }
        Ok(())
    }

    fn header(&self) -> String {
        let model = self.model;
        let mut text = "// Written by dynabs\n".to_owned();
        if self.labels.len() > 1 {
            let names: Vec<_> = self.labels[1..].iter().map(|(name, _)| name.as_str()).collect();
            let _ = writeln!(text, "//! labels {}", names.join(" "));
        }
        if !model.variables().is_empty() {
            let names: Vec<_> = model.variables().iter().map(|variable| variable.name.as_str()).collect();
            let _ = writeln!(text, "//! variables {}", names.join(" "));
        }
        let kind = match model.kind() {
            ModelKind::Imdp => "MDP",
            ModelKind::Idtmc => "DTMC",
        };
        let states = model.num_states();
        let deadlocks = StateId::first(states).filter(|&state| model.choices().is_deadlock(state)).count();
        let choices = model.size().choices + deadlocks as u64;
        let rewards: Vec<&str> = self.rewards.iter().map(|(name, _)| name.as_str()).collect();
        let rewards = rewards.join(" ");
        let _ = write!(
            text,
            "@type: {kind}\n@value_type: double-interval\n@parameters\n\n@reward_models\n{rewards}\n@nr_states\n{states}\n\
             @nr_choices\n{choices}\n@model\n"
        );
        text
    }

    /// Appends what stands before the choices of a state.
    fn state_lines(&self, state: StateId, text: &mut String) {
        // Writing to a string cannot fail.
        let _ = write!(text, "state {state}");
        self.earned(text, |rewards| rewards.of_state(state.index()));
        for (name, states) in &self.labels {
            if states.contains(state.index()) {
                let _ = write!(text, " {name}");
            }
        }
        text.push('\n');
        if !self.model.variables().is_empty() {
            text.push_str("//! values");
            for variable in self.model.variables().iter() {
                text.push(' ');
                let _ = variable.write_value(state, text);
            }
            text.push('\n');
        }
        if self.model.choices().is_deadlock(state) {
            text.push_str("//! deadlock\n");
        }
    }

    /// Appends one value for each reward structure, as in ` [1, 0.5]`.
    fn earned(&self, text: &mut String, value: impl Fn(&RewardStructure) -> f64) {
        if !self.rewards.is_empty() {
            let values: Vec<_> =
                self.rewards.iter().map(|(_, structure)| shortest_decimal(value(structure))).collect();
            // Writing to a string cannot fail.
            let _ = write!(text, " [{}]", values.join(", "));
        }
    }

    fn action(&self, choice: u64, index: usize, row: Option<RowId>) -> String {
        match self.model.actions() {
            ActionNames::None => index.to_string(),
            names => names.name(choice, row).map_or_else(|| UNNAMED.to_owned(), Into::into),
        }
    }
}

/// The structures that are written, by names that DRN can express: one without a name gets one.
fn reward_names<'m>(model: &'m IntervalMdp) -> Vec<(String, &'m RewardStructure)> {
    let kept = || model.rewards().iter().filter(|structure| DrnWriter::holds(structure));
    let named = |structure: &'m RewardStructure| {
        let RewardStructure { name, .. } = structure;
        let mut name = if name.is_empty() { "unnamed".to_owned() } else { name.clone() };
        while structure.name.is_empty() && kept().any(|other| other.name == name) {
            name.push('_');
        }
        (name, structure)
    };
    kept().map(named).collect()
}

/// A label as it is printed: in quotation marks unless it is an identifier.
fn quoted(name: &str) -> String {
    if is_identifier(name) { name.to_owned() } else { format!("\"{name}\"") }
}
