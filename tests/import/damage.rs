//! Truncated and altered files are refused, or mean what a slow and simple reading says.

use std::collections::BTreeMap;

use imdp::formats::{Imported, Warning};
use imdp::model::{IntervalMdp, RowBuffer, StateId, StateVariable};
use proptest::prelude::*;

use super::{Files, LAB, STA, TRA};

type Transitions = BTreeMap<(u32, u64, u32), (f64, f64)>;

/// Fields between blanks, as many as there are; none of a comment or a blank line.
fn fields(line: &str) -> Vec<&str> {
    if line.trim_start().starts_with('#') { vec![] } else { line.split_whitespace().collect() }
}

/// Reads transitions the obvious way, without checks.
fn slow_transitions(text: &str) -> Transitions {
    let lines = text.lines().map(fields).filter(|fields| !fields.is_empty()).skip(1);
    let parse = |fields: Vec<&str>| {
        let mut fields = fields.into_iter();
        let mut field = || fields.next().unwrap();
        let (source, choice, destination) = (field(), field(), field());
        // Blanks may surround the bounds.
        let mut interval = field().to_owned();
        while interval.starts_with('[') && !interval.ends_with(']') {
            interval += field();
        }
        let interval = interval.trim_matches(['[', ']']);
        let (lower, upper) = interval.split_once(',').unwrap_or((interval, interval));
        let key = (source.parse().unwrap(), choice.parse().unwrap(), destination.parse().unwrap());
        (key, (lower.parse().unwrap(), upper.parse().unwrap()))
    };
    lines.map(parse).collect()
}

fn transitions_of(model: &IntervalMdp) -> Transitions {
    let mut transitions = Transitions::new();
    for state in 0..model.num_states() as u32 {
        if model.choices().is_absorbing(StateId(state)) {
            transitions.insert((state, 0, state), (1.0, 1.0));
        }
        for (choice, row) in (0..).zip(model.choices().rows(StateId(state))) {
            let buffer = &mut RowBuffer::default();
            let row = model.rows().row(row, buffer);
            for (i, &successor) in row.successors.iter().enumerate() {
                transitions.insert((state, choice, successor.0), (row.lower[i], row.upper[i]));
            }
        }
    }
    transitions
}

/// Reads the labels of every state the obvious way, `init` among them.
fn slow_labels(text: &str) -> BTreeMap<usize, Vec<String>> {
    let mut lines = text.lines().filter(|line| !fields(line).is_empty());
    // Every other piece between quotation marks is a name.
    let names: Vec<&str> = lines.next().unwrap().split('"').skip(1).step_by(2).collect();
    let mut all: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for line in lines {
        let (state, labels) = line.split_once(':').unwrap();
        for label in labels.split_whitespace() {
            let name = names[label.parse::<usize>().unwrap()].to_owned();
            let of_state = all.entry(state.trim().parse().unwrap()).or_default();
            if !of_state.contains(&name) {
                of_state.push(name);
            }
        }
    }
    all.values_mut().for_each(|names| names.sort());
    all
}

fn labels_of(model: &IntervalMdp) -> BTreeMap<usize, Vec<String>> {
    let mut labels: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    let initial = model.initial();
    for (name, set) in model.labels().iter().chain([("init", initial)]) {
        set.ones().for_each(|state| labels.entry(state).or_default().push(name.to_owned()));
    }
    labels.values_mut().for_each(|names| names.sort());
    labels
}

/// Writes the variables back as a state file.
fn states_of(model: &IntervalMdp) -> String {
    let variables = model.variables();
    let names: Vec<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
    let mut text = format!("({})\n", names.join(","));
    for state in 0..model.num_states() as u32 {
        let value = |variable: &StateVariable| {
            let mut text = String::new();
            variable.write_value(StateId(state), &mut text).unwrap();
            text
        };
        text += &format!("{state}:({})\n", variables.iter().map(value).collect::<Vec<_>>().join(","));
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damage_is_refused_or_harmless(
        file in 0usize..3,
        at in any::<prop::sample::Index>(),
        damage in prop_oneof![
            any::<u8>().prop_map(Some),
            "[-0-9 .,\\[\\]e\n\r:()a#\"=]".prop_map(|text: String| Some(text.as_bytes()[0])),
            Just(None),
        ],
    ) {
        let mut texts = [TRA, STA, LAB].map(|text| text.as_bytes().to_vec());
        let at = at.index(texts[file].len());
        match damage {
            Some(byte) => texts[file][at] = byte,
            None => texts[file].truncate(at),
        }
        let outcome = Files::new(&texts[0], Some(&texts[1]), &texts[2]).import();
        if let Ok(Imported { model, warnings, .. }) = outcome
            && !warnings.iter().any(|warning| matches!(warning, Warning::Widened { .. } | Warning::Ignored { .. }))
        {
            let [tra, sta, lab] = texts.map(|text| String::from_utf8(text).unwrap());
            prop_assert_eq!(transitions_of(&model), slow_transitions(&tra));
            let plain = |text: &str| {
                let kept: String = text.lines().filter(|line| !fields(line).is_empty()).collect();
                kept.replace("True", "true").replace("False", "false").replace([' ', '\t', '\r'], "").replace(",)", ")").replace("-0", "0")
            };
            prop_assert_eq!(plain(&states_of(&model)), plain(&sta));
            prop_assert_eq!(labels_of(&model), slow_labels(&lab));
        }
    }
}
