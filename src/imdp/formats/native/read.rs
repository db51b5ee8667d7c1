//! Reading a model back, trusting nothing.

use std::io::{BufReader, Read};
use std::path::Path;

use super::sections::Sections;
use super::{NativeError, Section};
use crate::files;
use crate::model::{
    ActionNames, Choices, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, RewardError,
    RewardStructure, RowId, RowRange, Rows, StateId, StateSet, StateVariables, VariableValues,
    require_memory,
};

/// Reads a model from a file that [`super::write_file`] has written.
///
/// # Errors
/// [`NativeError`]; any truncation and any changed byte is noticed.
pub fn read(path: &Path) -> Result<IntervalMdp, NativeError> {
    let (file, length) = files::open(path)?;
    read_from(BufReader::with_capacity(1 << 18, file), length)
}

/// Reads a model of `length` bytes.
///
/// # Errors
/// Those of [`read`].
pub fn read_from(source: impl Read, length: u64) -> Result<IntervalMdp, NativeError> {
    let mut sections = Sections::open(source, length)?;
    // Offsets are wider in memory than lengths are in the file, nothing grows more than twofold.
    require_memory("the model", length.saturating_mul(2))?;
    sections.start(Section::Kind)?;
    let kind = match sections.bytes()? {
        [0] => ModelKind::Imdp,
        [1] => ModelKind::Idtmc,
        [other] => return Err(sections.broken(format!("there is no kind {other}"))),
    };
    let rows = read_rows(&mut sections)?;
    let choices = read_choices(&mut sections)?;
    let states = choices.num_states();
    sections.start(Section::Initial)?;
    let initial = sections.set(states)?;
    let actions = read_actions(&mut sections)?;
    let labels = read_labels(&mut sections, states)?;
    let variables = read_variables(&mut sections, states)?;
    let rewards = match sections.has_more() {
        true => read_rewards(&mut sections, states as u64, choices.num_choices())?,
        false => vec![],
    };
    let is_damaged = |error: RewardError, sections: &Sections<_>| sections.broken(error.to_string());
    let model = IntervalMdp::new(Parts { kind, rows, choices, actions, initial, labels, variables });
    // A file that is damaged is no other model.
    let model = model.map(|model| {
        let fits = |structure: &RewardStructure| branches_fit(&model, structure);
        match rewards.iter().all(fits) {
            true => model.with_rewards(rewards).map_err(|error| is_damaged(error, &sections)),
            false => Err(sections.broken("a choice has not as many branches as earn something")),
        }
    });
    sections.finish()?;
    model?
}

fn read_rewards(
    sections: &mut Sections<impl Read>,
    states: u64,
    choices: u64,
) -> Result<Vec<RewardStructure>, NativeError> {
    sections.start(Section::Rewards)?;
    let mut structures = vec![];
    for _ in 0..sections.u32()? {
        let mut structure = RewardStructure::new(sections.name()?);
        for (count, values) in [(states, &mut structure.states), (choices, &mut structure.choices)] {
            match sections.bytes()? {
                [0] => {}
                [1] => *values = sections.array(count, f64::from_le_bytes)?,
                [other] => return Err(sections.broken(format!("there are no rewards of kind {other}"))),
            }
        }
        for _ in 0..sections.u32()? {
            let choice = u64::from_le_bytes(sections.bytes()?);
            let count = sections.u32()?;
            let of_branches = sections.array(u64::from(count), f64::from_le_bytes)?;
            if structure.branches.insert(choice, of_branches).is_some() {
                return Err(sections.broken(format!("branches of choice {choice} come twice")));
            }
        }
        structures.push(structure);
    }
    Ok(structures)
}

/// Whether every choice has as many branches as earn something.
fn branches_fit(model: &IntervalMdp, structure: &RewardStructure) -> bool {
    if structure.branches.is_empty() {
        return true;
    }
    let first = model.choices().first_choices();
    let lengths = StateId::first(model.num_states()).flat_map(|state| {
        let rows = model.choices().rows(state).map(|row| model.rows().row_len(row));
        (first[state.index()]..).zip(rows)
    });
    let lengths: std::collections::BTreeMap<u64, usize> = lengths.collect();
    structure.branches.iter().all(|(choice, of_branches)| lengths.get(choice) == Some(&of_branches.len()))
}

fn read_rows(sections: &mut Sections<impl Read>) -> Result<Rows, NativeError> {
    sections.start(Section::RowLengths)?;
    let lengths = sections.rest(u32::from_le_bytes)?;
    if lengths.len() > RowId::MAX.index() {
        return Err(sections.broken("there are more rows than can be numbered"));
    }
    sections.start(Section::Successors)?;
    let successors = sections.rest(|bytes| StateId(u32::from_le_bytes(bytes)))?;
    sections.start(Section::Lower)?;
    let lower = sections.rest(f64::from_le_bytes)?;
    sections.start(Section::Upper)?;
    let upper = sections.rest(f64::from_le_bytes)?;
    let rows = Rows::from_columns(lengths.into_iter(), successors, lower, upper);
    rows.ok_or_else(|| sections.broken("the rows do not have as many entries as their lengths say"))
}

fn read_choices(sections: &mut Sections<impl Read>) -> Result<Choices, NativeError> {
    sections.start(Section::RangeCounts)?;
    let counts = sections.rest(u32::from_le_bytes)?;
    if counts.len() > StateId::MAX.index() {
        return Err(sections.broken("there are more states than can be numbered"));
    }
    sections.start(Section::Ranges)?;
    let ranges = sections.rest(|bytes: [u8; 8]| {
        let [a, b, c, d, e, f, g, h] = bytes;
        RowRange {
            first: RowId(u32::from_le_bytes([a, b, c, d])),
            last: RowId(u32::from_le_bytes([e, f, g, h])),
        }
    })?;
    if ranges.iter().any(|range| range.first > range.last) {
        return Err(sections.broken("a range ends before it starts"));
    }
    if ranges.len() as u64 != counts.iter().map(|&count| u64::from(count)).sum::<u64>() {
        return Err(sections.broken("there are not as many ranges as the states have"));
    }
    sections.start(Section::Absorbing)?;
    let absorbing: StateSet = sections.set(counts.len())?;
    let mut builder = ChoicesBuilder::with_capacity(counts.len());
    let mut ranges = ranges.into_iter();
    for (state, &count) in counts.iter().enumerate() {
        match (absorbing.contains(state), count) {
            (true, 0) => builder.push_absorbing(),
            (true, _) => return Err(sections.broken(format!("state {state} has choices and is absorbing"))),
            (false, count) => {
                ranges.by_ref().take(count as usize).for_each(|range| builder.push_range(range));
                builder.finish_state();
            }
        }
    }
    Ok(builder.finish())
}

fn read_actions(sections: &mut Sections<impl Read>) -> Result<ActionNames, NativeError> {
    sections.start(Section::Actions)?;
    match sections.bytes()? {
        [0] => Ok(ActionNames::None),
        [1] => Ok(ActionNames::OfRow),
        [2] => {
            let count = sections.u32()?;
            let mut names = vec![];
            for _ in 0..count {
                names.push(sections.name()?);
            }
            Ok(ActionNames::OfChoice { names, ids: sections.rest(u32::from_le_bytes)? })
        }
        [other] => Err(sections.broken(format!("there are no actions of kind {other}"))),
    }
}

fn read_labels(sections: &mut Sections<impl Read>, states: usize) -> Result<Labels, NativeError> {
    sections.start(Section::Labels)?;
    let mut labels = Labels::default();
    for _ in 0..sections.u32()? {
        let name = sections.name()?;
        if labels.get(&name).is_some() {
            return Err(sections.broken(format!("label \"{name}\" comes twice")));
        }
        labels.insert(name, sections.set(states)?);
    }
    Ok(labels)
}

fn read_variables(sections: &mut Sections<impl Read>, states: usize) -> Result<StateVariables, NativeError> {
    sections.start(Section::Variables)?;
    let mut variables = StateVariables::default();
    for _ in 0..sections.u32()? {
        let name = sections.name()?;
        let values = match sections.bytes()? {
            [0] => VariableValues::Int(sections.array(states as u64, i32::from_le_bytes)?),
            [1] => VariableValues::Bool(sections.set(states)?),
            [other] => return Err(sections.broken(format!("there are no variables of type {other}"))),
        };
        if variables.get(&name).is_some() {
            return Err(sections.broken(format!("variable {name} comes twice")));
        }
        variables.push(name, values);
    }
    Ok(variables)
}
