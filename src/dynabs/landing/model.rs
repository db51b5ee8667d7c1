//! The lattice game as an interval MDP, for everyone who reads such models.
//!
//! There is a state for every memory of the task in every cell in which it may be open. Its choice leads to the *range* state of its image, where nature picks a sub-cell; from there *landing* and *pair*
//! states follow, one of each per coordinate with noise (see the module's page). All are shared. What noise is not
//! listed goes to the state `lost`, which nature may count as won or lost, so that the model has both bounds:
//! `Pmaxmin` and `Pmaxmax`.

use super::arrivals::{Arrivals, FAILED, LOST, REACHED};
use super::images::Images;
use super::layers::{Layers, Outcomes};
use super::picks::push_any;
use super::solve::Question;
use super::step::Landing;
use crate::task::Aim;
use imdp::model::{
    ActionNames, ChoicesBuilder, ImdpError, IntervalMdp, Labels, ModelKind, Parts, RowId, RowRange, Rows,
    StateId, StateSet, StateVariables,
};
use std::collections::{BTreeSet, HashMap};

/// An interval MDP whose cells come before everything else that there is for the encoding.
#[derive(Clone, Debug)]
pub struct LandingModel {
    /// The model.
    pub model: IntervalMdp,
    /// By cell: the states in one of which nature begins; cells that lost or won share one.
    pub of_cell: Vec<Vec<StateId>>,
    /// The states in which the controller acts, and their cells.
    pub acting: Vec<(StateId, u32)>,
    /// How many steps of the model are one of the system.
    pub micro_steps: u64,
}

impl Question<'_> {
    /// The model, with `initial` cells.
    ///
    /// A task that is decided at its last step only gets memories that count the steps.
    ///
    /// # Errors
    /// [`ImdpError`] if the parts do not make a model: a mistake in this program.
    pub fn model(&self, initial: &[u32]) -> Result<LandingModel, ImdpError> {
        self.with_clock(|question| question.model_of_memories(initial))
    }

    /// The same question with memories that count the steps, if the task is decided at its last one only.
    pub(super) fn with_clock<T>(&self, use_it: impl FnOnce(&Question<'_>) -> T) -> T {
        match (self.task.aim(), self.steps) {
            (Aim::End, Some(steps)) => {
                let task = self.task.clocked(steps);
                use_it(&Question { task: &task, ..*self })
            }
            _ => use_it(self),
        }
    }

    /// How many steps of the model are one of the system.
    pub fn micro_steps(&self) -> u64 {
        self.landing.micro_steps() + u64::from(self.task.is_ambiguous())
    }

    fn model_of_memories(&self, initial: &[u32]) -> Result<LandingModel, ImdpError> {
        let skeleton = Skeleton::new(self);
        let Skeleton { arrivals, ranges, .. } = &skeleton;
        let mut start = arrivals.end;
        let mut layers = vec![];
        for of_cell in &arrivals.of_cell {
            let first = start + ranges.places.len();
            let outcomes = Outcomes { failed: FAILED, lost: LOST, of_cell };
            layers.push((start, Layers::new(self.landing, first, outcomes)));
            start = layers.last().map_or(first, |(_, layers)| layers.end());
        }
        let mut rows = skeleton.first_row();
        for (start, _) in &layers {
            (0..ranges.places.len())
                .for_each(|range| push_any(&mut rows, vec![StateId::from_index(start + range)]));
        }
        arrivals.push_picks(&mut rows);
        for (_, layers) in &layers {
            ranges.places.iter().for_each(|place| push_any(&mut rows, self.sub_cells(layers, place)));
            layers.push_rows(&mut rows);
        }
        skeleton.finish(rows, start, initial, self.micro_steps())
    }

    /// The states of the sub-cells of a box.
    fn sub_cells(&self, layers: &Layers<'_>, sides: &[(u32, u32)]) -> Vec<StateId> {
        let lens: Vec<usize> = self.landing.axes().iter().map(|axis| axis.len).collect();
        let count: usize = sides.iter().map(|&(_, size)| size as usize).product();
        let place = |mut index: usize| {
            let mut place = vec![0; lens.len()];
            for (j, &(first, size)) in sides.iter().enumerate().rev() {
                place[j] = (first as usize + index % size as usize) % lens[j];
                index /= size as usize;
            }
            layers.of_sub_cell(&place)
        };
        (0..count).map(place).collect()
    }
}

/// What models of a task have in common: who decides what, in which states.
pub(super) struct Skeleton {
    /// Whether there is a state `reached`.
    pub(super) can_be_done: bool,
    inputs: usize,
    /// By memory, the cells in which something can be done with it, ascending.
    pairs: Vec<Vec<u32>>,
    pub(super) arrivals: Arrivals,
    pub(super) ranges: Ranges,
}

impl Skeleton {
    pub(super) fn new(question: &Question<'_>) -> Self {
        let can_be_done = question.task.aim() == Aim::Reach || question.task.can_be_done();
        let pairs = question.pairs();
        Self {
            can_be_done,
            inputs: question.images.inputs(),
            arrivals: Arrivals::new(question.task, &pairs, if can_be_done { 3 } else { 2 }),
            ranges: Ranges::new(question.images),
            pairs,
        }
    }

    /// The first row of all: that of noise which is not listed.
    pub(super) fn first_row(&self) -> Rows {
        let mut rows = Rows::new();
        push_any(&mut rows, vec![FAILED, if self.can_be_done { REACHED } else { LOST }]);
        rows
    }

    /// The model whose rows are the first one, those of the ranges of every memory, and those of all states after the
    /// pairs.
    pub(super) fn finish(
        &self,
        rows: Rows,
        states: usize,
        initial: &[u32],
        micro_steps: u64,
    ) -> Result<LandingModel, ImdpError> {
        let Self { can_be_done, inputs, pairs, arrivals, ranges } = self;
        let heads = if *can_be_done { 3 } else { 2 };
        let mut choices = ChoicesBuilder::with_capacity(states);
        let mut ids = vec![];
        let one = |row: usize| RowRange { first: RowId::from_index(row), last: RowId::from_index(row) };
        for head in StateId::first(heads) {
            if head == LOST {
                choices.push_range(one(0));
                choices.finish_state();
            } else {
                choices.push_absorbing();
            }
            ids.push(ActionNames::UNNAMED);
        }
        for (memory, open) in pairs.iter().enumerate() {
            let mut enabled = ranges.of_pairs.iter().peekable();
            for &cell in open {
                while enabled.next_if(|(of, ..)| *of < cell).is_some() {}
                while let Some(&(_, input, range)) = enabled.next_if(|(of, ..)| *of == cell) {
                    choices.push_range(one(1 + memory * ranges.places.len() + range as usize));
                    ids.push(input);
                }
                choices.finish_state();
            }
        }
        let others = 1 + pairs.len() * ranges.places.len();
        for state in arrivals.pairs_end..states {
            choices.push_range(one(others + state - arrivals.pairs_end));
            choices.finish_state();
            ids.push(ActionNames::UNNAMED);
        }
        let mut labels = Labels::default();
        labels.insert("deadlock", set(states, None));
        labels.insert("reached", set(states, can_be_done.then_some(REACHED)));
        labels.insert("failed", set(states, Some(FAILED)));
        if pairs.len() > 1 {
            for (memory, first) in arrivals.first.iter().enumerate() {
                let last = first + pairs[memory].len() as u32;
                labels.insert(format!("memory_{memory}"), set(states, (*first..last).map(StateId)));
            }
        }
        let starts = initial.iter().flat_map(|&cell| &arrivals.at_start[cell as usize]).copied();
        let model = IntervalMdp::new(Parts {
            kind: ModelKind::Imdp,
            rows,
            choices: choices.finish(),
            actions: ActionNames::OfChoice {
                names: (0..*inputs).map(|input| format!("u_{input}")).collect(),
                ids,
            },
            initial: set(states, starts),
            labels,
            variables: StateVariables::default(),
        })?;
        let acting =
            StateId::first(arrivals.pairs_end).skip(heads).zip(pairs.iter().flatten().copied()).collect();
        Ok(LandingModel { model, of_cell: arrivals.at_start.clone(), acting, micro_steps })
    }
}

fn set(states: usize, members: impl IntoIterator<Item = StateId>) -> StateSet {
    let mut set = StateSet::with_capacity(states);
    set.extend(members.into_iter().map(StateId::index));
    set
}

/// The distinct images.
pub(super) struct Ranges {
    /// By coordinate, where the box begins and how many sub-cells it has; ordered by sizes, then by beginnings.
    places: Vec<Vec<(u32, u32)>>,
    /// What [`Images`] calls them.
    pub(super) images: Vec<(u32, u16)>,
    /// `(cell, input, range)`, ascending.
    of_pairs: Vec<(u32, u32, u32)>,
}

impl Ranges {
    fn new(images: &Images) -> Self {
        let distinct: BTreeSet<(u32, u16)> = images.all().map(|(.., image)| image).collect();
        let sizes_first = |sides: &[(u32, u32)]| -> (Vec<u32>, Vec<u32>) {
            (sides.iter().map(|side| side.1).collect(), sides.iter().map(|side| side.0).collect())
        };
        let mut boxes: Vec<_> = distinct.iter().map(|&image| (images.sub_cells(image), image)).collect();
        boxes.sort_by_cached_key(|(sides, _)| sizes_first(sides));
        let numbers: HashMap<(u32, u16), u32> =
            (0..).zip(&boxes).map(|(range, (_, image))| (*image, range)).collect();
        let of_pairs = images
            .all()
            .map(|(cell, input, image)| (cell, input, numbers.get(&image).copied().unwrap_or_default()));
        let of_pairs = of_pairs.collect();
        let (places, images) = boxes.into_iter().unzip();
        Self { of_pairs, places, images }
    }
}

impl Landing {
    /// How many steps of the model are one of the system: to a range, to a sub-cell, and two for each noise.
    pub fn micro_steps(&self) -> u64 {
        let stages = self.axes().iter().filter(|axis| axis.noise.is_some()).count();
        2 + 2 * (stages + self.moves().len()) as u64
    }

    /// The axes in the order of their stages.
    pub(super) fn order(&self) -> impl Iterator<Item = usize> + '_ {
        self.stages().iter().map(|(j, _)| *j)
    }
}
