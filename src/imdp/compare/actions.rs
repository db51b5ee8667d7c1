//! What choices are called, and which choice a name means.

use crate::model::{ActionNames, IntervalMdp, RowId, StateId};

/// The names of a model's choices.
pub(super) struct Actions<'a> {
    model: &'a IntervalMdp,
    /// Per state, the number of choices of the states before it.
    first_choice: Vec<u64>,
}

/// The name of a choice; `a_<row>` is kept as a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Name<'a> {
    Row(RowId),
    Text(&'a str),
    Unnamed,
}

impl<'a> Name<'a> {
    fn of(text: &'a str) -> Self {
        let digits =
            text.strip_prefix("a_").filter(|digits| *digits == "0" || !digits.starts_with(['0', '+']));
        digits.and_then(|digits| digits.parse().ok()).map_or(Self::Text(text), Self::Row)
    }
}

impl<'a> Actions<'a> {
    pub(super) fn new(model: &'a IntervalMdp) -> Self {
        let choices = model.choices();
        let mut total = 0;
        let first_choice = StateId::first(model.num_states()).map(|state| {
            let first = total;
            total += choices.ranges(state).iter().map(|range| range.len() as u64).sum::<u64>();
            total += u64::from(choices.is_absorbing(state));
            first
        });
        let first_choice = first_choice.collect();
        Self { model, first_choice }
    }

    /// The choices of a state: name and row.
    pub(super) fn of_state(&self, state: StateId) -> impl Iterator<Item = (Name<'a>, RowId)> + '_ {
        let first = self.first_choice[state.index()] as usize;
        self.model.choices().rows(state).enumerate().map(move |(choice, row)| {
            let name = match self.model.actions() {
                ActionNames::None => Name::Unnamed,
                ActionNames::OfRow => Name::Row(row),
                ActionNames::OfChoice { names, ids } => {
                    let name = ids.get(first + choice).and_then(|&id| names.get(id as usize));
                    name.map_or(Name::Unnamed, |name| Name::of(name))
                }
            };
            (name, row)
        })
    }

    /// The row of the choice that a policy names; a choice without a name is named by its index.
    pub(super) fn row(&self, state: StateId, action: &str) -> Option<RowId> {
        let wanted = Name::of(action);
        let index = action.parse::<usize>().ok();
        // Rows of compiled models are found without looking at each.
        if let (ActionNames::OfRow, Name::Row(row)) = (self.model.actions(), wanted) {
            let ranges = self.model.choices().ranges(state);
            return ranges.iter().any(|range| (range.first..=range.last).contains(&row)).then_some(row);
        }
        let mut choices = self.of_state(state).enumerate();
        let means = |choice: usize, name| name == wanted || (name == Name::Unnamed && Some(choice) == index);
        choices.find(|(choice, (name, _))| means(*choice, *name)).map(|(_, (_, row))| row)
    }
}

impl std::fmt::Display for Name<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Row(row) => write!(f, "a_{row}"),
            Self::Text(text) => f.write_str(text),
            Self::Unnamed => f.write_str("no name"),
        }
    }
}
