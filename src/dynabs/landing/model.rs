//! The lattice game as an interval MDP, for everyone who reads such models.
//!
//! A cell's choice leads to the *range* state of its image, where nature picks a sub-cell; from there *landing* and *pair*
//! states follow, one of each per coordinate with noise (see the module's page). All are shared. What noise is not
//! listed goes to the state `lost`, which nature may count as won or lost, so that the model has both bounds:
//! `Pmaxmin` and `Pmaxmax`.

use super::images::Images;
use super::layers::{Layers, Outcomes, push_any};
use super::solve::{Aim, Question};
use super::step::Landing;
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
    /// By cell: its state; cells that lost or won share one.
    pub of_cell: Vec<StateId>,
    /// How many steps of the model are one of the system.
    pub micro_steps: u64,
}

/// Everything that failed.
const FAILED: StateId = StateId(0);
/// Where unlisted noise goes.
const LOST: StateId = StateId(1);
/// All goal cells, if there is a goal.
const REACHED: StateId = StateId(2);

impl Question<'_> {
    /// The model, with `initial` cells.
    ///
    /// # Errors
    /// [`ImdpError`] if the parts do not make a model: a mistake in this program.
    pub fn model(&self, initial: &[u32]) -> Result<LandingModel, ImdpError> {
        let heads: u32 = if self.aim == Aim::Reach { 3 } else { 2 };
        let mut of_cell = vec![FAILED; self.goal.len()];
        for (state, goal) in of_cell.iter_mut().zip(self.goal) {
            *state = if *goal { REACHED } else { FAILED };
        }
        (heads..).zip(self.open).for_each(|(state, &cell)| of_cell[cell as usize] = StateId(state));
        let cells_end = heads as usize + self.open.len();
        let ranges = Ranges::new(self.images);
        let outcomes = Outcomes { failed: FAILED, lost: LOST, of_cell: &of_cell };
        let layers = Layers::new(self.landing, cells_end + ranges.places.len(), outcomes);
        let states = layers.end();

        let mut rows = Rows::new();
        push_any(&mut rows, vec![FAILED, if self.aim == Aim::Reach { REACHED } else { LOST }]);
        (0..ranges.places.len())
            .for_each(|range| push_any(&mut rows, vec![StateId::from_index(cells_end + range)]));
        ranges.places.iter().for_each(|place| push_any(&mut rows, self.sub_cells(&layers, place)));
        layers.push_rows(&mut rows);

        let mut choices = ChoicesBuilder::with_capacity(states);
        let mut ids = vec![];
        let one = |row: usize| RowRange { first: RowId::from_index(row), last: RowId::from_index(row) };
        for head in StateId::first(heads as usize) {
            if head == LOST {
                choices.push_range(one(0));
                choices.finish_state();
            } else {
                choices.push_absorbing();
            }
            ids.push(ActionNames::UNNAMED);
        }
        let inputs = self.images.inputs();
        let mut pairs = ranges.of_pairs.iter().peekable();
        for &cell in self.open {
            while let Some(&&(_, input, range)) = pairs.peek().filter(|(of, ..)| *of == cell) {
                choices.push_range(one(1 + range as usize));
                ids.push(input);
                pairs.next();
            }
            choices.finish_state();
        }
        for state in cells_end..states {
            choices.push_range(one(1 + ranges.places.len() + state - cells_end));
            choices.finish_state();
            ids.push(ActionNames::UNNAMED);
        }
        let mut labels = Labels::default();
        labels.insert("deadlock", set(states, None));
        labels.insert("reached", set(states, (self.aim == Aim::Reach).then_some(REACHED)));
        labels.insert("failed", set(states, Some(FAILED)));
        let model = IntervalMdp::new(Parts {
            kind: ModelKind::Imdp,
            rows,
            choices: choices.finish(),
            actions: ActionNames::OfChoice {
                names: (0..inputs).map(|input| format!("u_{input}")).collect(),
                ids,
            },
            initial: set(states, initial.iter().map(|&cell| of_cell[cell as usize])),
            labels,
            variables: StateVariables::default(),
        })?;
        Ok(LandingModel { model, of_cell, micro_steps: self.landing.micro_steps() })
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

fn set(states: usize, members: impl IntoIterator<Item = StateId>) -> StateSet {
    let mut set = StateSet::with_capacity(states);
    set.extend(members.into_iter().map(|state| state.index()));
    set
}

/// The distinct images.
struct Ranges {
    /// By coordinate, where the box begins and how many sub-cells it has; ordered by sizes, then by beginnings.
    places: Vec<Vec<(u32, u32)>>,
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
        Self { of_pairs: of_pairs.collect(), places: boxes.into_iter().map(|(sides, _)| sides).collect() }
    }
}

impl Landing {
    /// How many steps of the model are one of the system: to a range, to a sub-cell, and two for each noise.
    pub fn micro_steps(&self) -> u64 {
        2 + 2 * self.axes().iter().filter(|axis| axis.noise.is_some()).count() as u64
    }

    /// The axes in the order of their stages.
    pub(super) fn order(&self) -> impl Iterator<Item = usize> + '_ {
        self.stages().iter().map(|(j, _)| *j)
    }
}
