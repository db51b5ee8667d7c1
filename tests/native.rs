//! The native format: what is written is read back, and no damage goes unnoticed.
use imdp::formats::native::{NativeError, read, read_from, write, write_file};
use imdp::model::{
    ActionNames, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, RowId, RowRange, Rows, StateId,
    StateSet, StateVariables, VariableValues,
};
use proptest::prelude::*;

fn set(states: usize, members: &[usize]) -> StateSet {
    let mut set = StateSet::with_capacity(states);
    members.iter().for_each(|&member| set.insert(member % states));
    set
}

prop_compose! {
    fn models()(
        states in 1usize..20,
        widths in prop::collection::vec((any::<u32>(), prop::collection::vec(0.0f64..1.0, 1..4)), 1..8),
        choices in prop::collection::vec(prop::collection::vec((0u32..8, 0u32..3), 0..4), 20),
        kinds in (0u8..3, any::<bool>()),
        members in prop::collection::vec(0usize..20, 1..10),
        values in prop::collection::vec(any::<i32>(), 20),
    ) -> IntervalMdp {
        let mut rows = Rows::new();
        for (first, uppers) in &widths {
            let len = uppers.len().min(states);
            let first = (*first as usize) % (states - len + 1);
            for (i, upper) in uppers[..len].iter().enumerate() {
                rows.push_entry(StateId((first + i) as u32), upper / 4.0, if i == 0 { 1.0 } else { *upper });
            }
            rows.finish_row();
        }
        let chain = kinds.1;
        let mut builder = ChoicesBuilder::with_capacity(states);
        for ranges in &choices[..states] {
            match ranges[..] {
                [(0, _), ..] => builder.push_absorbing(),
                _ => {
                    for &(first, len) in &ranges[..if chain { ranges.len().min(1) } else { ranges.len() }] {
                        let first = first % rows.len() as u32;
                        let last = if chain { first } else { (first + len).min(rows.len() as u32 - 1) };
                        builder.push_range(RowRange { first: RowId(first), last: RowId(last) });
                    }
                    builder.finish_state();
                }
            }
        }
        let choices = builder.finish();
        let actions = match kinds.0 {
            0 => ActionNames::None,
            1 => ActionNames::OfRow,
            _ => ActionNames::OfChoice {
                names: vec!["up".to_owned(), "döwn".to_owned()],
                ids: (0..choices.num_choices()).map(|i| [0, 1, ActionNames::UNNAMED][i as usize % 3]).collect(),
            },
        };
        let mut labels = Labels::default();
        labels.insert("goal", set(states, &members));
        labels.insert("none", set(states, &[]));
        let mut variables = StateVariables::default();
        variables.push("x", VariableValues::Int(values[..states].to_vec()));
        variables.push("b", VariableValues::Bool(set(states, &members[1..])));
        let kind = if chain { ModelKind::Idtmc } else { ModelKind::Imdp };
        let initial = set(states, &members[..1]);
        IntervalMdp::new(Parts { kind, rows, choices, actions, initial, labels, variables }).unwrap()
    }
}

fn bytes_of(model: &IntervalMdp) -> Vec<u8> {
    let mut bytes = vec![];
    write(model, &mut bytes).unwrap();
    bytes
}

proptest! {
    #[test]
    fn what_is_written_is_read(model in models()) {
        let bytes = bytes_of(&model);
        let again = read_from(&bytes[..], bytes.len() as u64).unwrap();
        prop_assert_eq!(&again, &model);
        prop_assert_eq!(bytes_of(&again), bytes);
    }

    #[test]
    fn damage_is_noticed(
        model in models(),
        at in any::<prop::sample::Index>(),
        flip in prop::option::of(1u8..=255),
    ) {
        let mut bytes = bytes_of(&model);
        let at = at.index(bytes.len());
        match flip {
            Some(flip) => bytes[at] ^= flip,
            None => bytes.truncate(at),
        }
        prop_assert!(read_from(&bytes[..], bytes.len() as u64).is_err());
        // A length that promises more than there is must not be believed either.
        prop_assert!(read_from(&bytes[..], 1 << 20).is_err());
    }
}

#[test]
fn files_are_written_and_read() {
    let mut rows = Rows::new();
    rows.push_entry(StateId(0), 0.25, 1.0);
    rows.finish_row();
    let mut builder = ChoicesBuilder::with_capacity(1);
    builder.push_range(RowRange { first: RowId(0), last: RowId(0) });
    builder.finish_state();
    let parts = Parts {
        kind: ModelKind::Imdp,
        rows,
        choices: builder.finish(),
        actions: ActionNames::None,
        initial: set(1, &[0]),
        labels: Labels::default(),
        variables: StateVariables::default(),
    };
    let model = IntervalMdp::new(parts).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.dynabs");
    write_file(&model, &path).unwrap();
    assert_eq!(read(&path).unwrap(), model);

    let message = |bytes: &[u8]| read_from(bytes, bytes.len() as u64).unwrap_err().to_string();
    let bytes = bytes_of(&model);
    assert!(message(b"").contains("not a dynabs model"));
    assert!(message(&[bytes.as_slice(), b"x"].concat()).contains("damaged"));
    let mut newer = bytes.clone();
    newer[8] = 2;
    assert!(matches!(read_from(&newer[..], newer.len() as u64), Err(NativeError::Version { found: 2, .. })));
    let mut bound = bytes;
    let quarter = bound.windows(8).position(|window| window == 0.25f64.to_le_bytes()).unwrap();
    bound[quarter] ^= 1;
    assert!(message(&bound).contains("checksum"));
}
