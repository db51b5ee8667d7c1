//! What the memory of a task becomes in each cell.

mod worst;

use super::labels::{Label, labels};
use super::{Aim, AutomatonTask, Memory, Standing};
use crate::partition::{CellId, CellKind, Grid};
use std::collections::HashMap;
pub use worst::Straddling;

/// A task on the cells of a partition.
///
/// Only memories that runs can come to, given the letters that cells have, are there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellTask {
    aim: Aim,
    /// By memory: whether the task is fulfilled if it ends there.
    accepting: Vec<bool>,
    /// By cell.
    class_of: Vec<u32>,
    /// Cells that mean the same.
    classes: Vec<Class>,
    /// Where the standing depends on the letter.
    letters: Option<Letters>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Class {
    /// By the memory before, the last one being the start: what nature picks from, ascending.
    standings: Vec<Vec<Standing>>,
    /// The memories that a run may have in such a cell, ascending.
    open: Vec<Memory>,
}

/// The automaton, in terms of memories.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Letters {
    /// By the memory before, the last one being the start, and the letter.
    pub next: Vec<Vec<Standing>>,
    /// By class of cells: what is known of their letters.
    pub labels: Vec<Label>,
}

impl CellTask {
    /// A task with a single memory: it is done in goal cells and has failed in unsafe ones.
    ///
    /// A cell that a region's face cuts has two kinds, for its worst state and for its best one: nature picks from what
    /// lies between.
    pub fn of_kinds(aim: Aim, worst: &[CellKind], best: &[CellKind]) -> Self {
        let all = [Standing::Failed, Standing::Open(0), Standing::Reached];
        let place = |kind: CellKind| match kind {
            CellKind::Unsafe => 0,
            CellKind::Ordinary => 1,
            CellKind::Goal => 2,
        };
        let mut ends = vec![(1, 1), (2, 2), (0, 0)];
        let mut number = |(&worst, &best): (&CellKind, &CellKind)| {
            let of_cell = (place(worst), place(best));
            ends.iter().position(|&other| other == of_cell).unwrap_or_else(|| {
                ends.push(of_cell);
                ends.len() - 1
            }) as u32
        };
        let class_of = worst.iter().zip(best).map(&mut number).collect();
        let between =
            |&(worst, best): &(usize, usize)| Class::new(vec![all[worst..=best.max(worst)].to_vec(); 2]);
        Self {
            aim,
            accepting: vec![aim != Aim::Reach],
            class_of,
            classes: ends.iter().map(between).collect(),
            letters: None,
        }
    }

    /// An automaton's task on a grid.
    pub fn of_automaton(task: &AutomatonTask, grid: &Grid) -> Self {
        let of_cells = labels(grid, task.regions());
        let (mut kinds, mut numbers, mut class_of) = (vec![], HashMap::new(), vec![]);
        for label in of_cells {
            let fresh = kinds.len() as u32;
            let class = *numbers.entry(label).or_insert(fresh);
            if class == fresh {
                kinds.push(label);
            }
            class_of.push(class);
        }
        let mut explorer = Explorer { task, states: vec![], memories: HashMap::new() };
        let start = task.dfa().start();
        let of_start: Vec<_> = kinds.iter().map(|&label| explorer.after(start, label)).collect();
        let mut by_memory: Vec<Vec<Vec<Standing>>> = vec![];
        while let Some(&state) = explorer.states.get(by_memory.len()) {
            by_memory.push(kinds.iter().map(|&label| explorer.after(state, label)).collect());
        }
        by_memory.push(of_start);
        let classes = (0..kinds.len())
            .map(|class| Class::new(by_memory.iter().map(|of_classes| of_classes[class].clone()).collect()));
        let rows = explorer.states.iter().chain([&start]);
        let next = rows.map(|&state| {
            (0..task.dfa().letters()).map(|letter| explorer.known(task.dfa().step(state, letter))).collect()
        });
        Self {
            aim: task.aim(),
            accepting: explorer.states.iter().map(|&state| task.dfa().accepts(state)).collect(),
            classes: classes.collect(),
            letters: Some(Letters { next: next.collect(), labels: kinds }),
            class_of,
        }
    }

    /// How memories decide a run.
    pub fn aim(&self) -> Aim {
        self.aim
    }

    /// The number of memories.
    pub fn memories(&self) -> u32 {
        self.accepting.len() as u32
    }

    /// The number of cells.
    pub fn num_cells(&self) -> usize {
        self.class_of.len()
    }

    /// Whether the task is fulfilled if it ends with a memory.
    pub fn accepts(&self, memory: Memory) -> bool {
        self.accepting[memory as usize]
    }

    /// Where a run may stand on arrival in a cell, with a memory before or at the start: what nature picks from, ascending.
    pub fn standings(&self, before: Option<Memory>, cell: usize) -> &[Standing] {
        let class = &self.classes[self.class_of[cell] as usize];
        &class.standings[before.map_or(self.accepting.len(), |memory| memory as usize)]
    }

    /// The memories that a run may have in a cell, ascending: those with which something is left to do there.
    pub fn open(&self, cell: usize) -> &[Memory] {
        &self.classes[self.class_of[cell] as usize].open
    }

    /// Whether a run may be done.
    pub fn can_be_done(&self) -> bool {
        let mut standings = self.classes.iter().flat_map(|class| class.standings.iter().flatten());
        standings.any(|&standing| standing == Standing::Reached)
    }

    /// Whether nature picks the standing anywhere.
    pub fn is_ambiguous(&self) -> bool {
        self.classes.iter().flat_map(|class| &class.standings).any(|standings| standings.len() > 1)
    }

    /// The same task, to be reached: its memories count the steps, up to `steps`, and the last one decides.
    ///
    /// Memory `q` after `t` steps is `t · memories + q`.
    #[must_use]
    pub fn clocked(&self, steps: u64) -> Self {
        let memories = self.accepting.len();
        let at = |standings: &[Standing], time: u64| -> Vec<Standing> {
            let mut timed: Vec<_> = (standings.iter())
                .map(|standing| match *standing {
                    Standing::Open(memory) if time < steps => {
                        Standing::Open(time as Memory * memories as Memory + memory)
                    }
                    Standing::Open(memory) if self.accepts(memory) => Standing::Reached,
                    Standing::Open(_) => Standing::Failed,
                    decided => decided,
                })
                .collect();
            timed.sort_unstable();
            timed.dedup();
            timed
        };
        let of_class = |class: &Class| {
            let before = |time: u64| class.standings[..memories].iter().map(move |s| at(s, time + 1));
            let standings = (0..steps).flat_map(before);
            Class::new(standings.chain(class.standings[memories..].iter().map(|s| at(s, 0))).collect())
        };
        Self {
            aim: Aim::Reach,
            accepting: vec![false; memories * steps as usize],
            class_of: self.class_of.clone(),
            classes: self.classes.iter().map(of_class).collect(),
            letters: None,
        }
    }

    /// Where a run stands on arrival at a state in a cell; `letter` names the regions that contain the state.
    pub fn arrive(&self, before: Option<Memory>, cell: CellId, letter: impl FnOnce() -> u64) -> Standing {
        let row = before.map_or(self.accepting.len(), |memory| memory as usize);
        match (self.standings(before, cell.index()), &self.letters) {
            ([one], _) => *one,
            (_, Some(Letters { next, labels })) => {
                // What is known of the cell is known better than what doubles say.
                let Label { certain, possible } = labels[self.class_of[cell.index()] as usize];
                next[row][(letter() & possible | certain) as usize]
            }
            (several, None) => several.first().copied().unwrap_or(Standing::Failed),
        }
    }

    /// How letters change memories, where cells do not say everything.
    pub fn letters(&self) -> Option<&Letters> {
        self.letters.as_ref()
    }

    /// The class of a cell, which has its label.
    pub fn class(&self, cell: CellId) -> u32 {
        self.class_of[cell.index()]
    }

    /// What a cell means to a run that arrives there, whatever the memory: where no letter says more, the worst.
    pub fn kind(&self, cell: CellId) -> CellKind {
        let class = &self.classes[self.class_of[cell.index()] as usize];
        let seen = if self.letters.is_some() { usize::MAX } else { 1 };
        let all =
            |standing| class.standings.iter().all(|of| of.iter().take(seen).all(|&found| found == standing));
        if all(Standing::Reached) {
            CellKind::Goal
        } else if all(Standing::Failed) {
            CellKind::Unsafe
        } else {
            CellKind::Ordinary
        }
    }
}

impl Class {
    fn new(standings: Vec<Vec<Standing>>) -> Self {
        let memory = |standing: &Standing| match standing {
            Standing::Open(memory) => Some(*memory),
            Standing::Failed | Standing::Reached => None,
        };
        let mut open: Vec<Memory> = standings.iter().flatten().filter_map(memory).collect();
        open.sort_unstable();
        open.dedup();
        Self { standings, open }
    }
}

/// Numbers the states of an automaton that are memories, in the order in which they are met.
struct Explorer<'a> {
    task: &'a AutomatonTask,
    states: Vec<u32>,
    memories: HashMap<u32, Memory>,
}

impl Explorer<'_> {
    fn after(&mut self, state: u32, label: Label) -> Vec<Standing> {
        let mut standings: Vec<_> = label
            .letters()
            .map(|letter| {
                let next = self.task.dfa().step(state, letter);
                self.task.outcome(next).unwrap_or_else(|| Standing::Open(self.number(next)))
            })
            .collect();
        standings.sort_unstable();
        standings.dedup();
        standings
    }

    fn number(&mut self, state: u32) -> Memory {
        let fresh = self.states.len() as Memory;
        let number = *self.memories.entry(state).or_insert(fresh);
        if number == fresh {
            self.states.push(state);
        }
        number
    }

    /// A state that no letter of any cell leads to has failed for all that matters.
    fn known(&self, state: u32) -> Standing {
        let open = || self.memories.get(&state).map_or(Standing::Failed, |&memory| Standing::Open(memory));
        self.task.outcome(state).unwrap_or_else(open)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::partition::Region;
    use crate::task::{LetterLookup, NamedRegion, Shape};
    use imdp::automaton::{Dfa, Ltl};
    use imdp::numeric::{Rational, from_decimal};

    fn exact(values: &[f64]) -> Vec<Rational> {
        values.iter().map(|&x| from_decimal(x).unwrap()).collect()
    }

    fn interval(name: &str, lower: f64, upper: f64) -> NamedRegion {
        let side = |x| vec![from_decimal(x)];
        NamedRegion {
            name: name.into(),
            shapes: vec![Shape::Box(Region { lower: side(lower), upper: side(upper) })],
        }
    }

    /// `a` in cells 0 and perhaps 1, `b` in cell 3, on five cells.
    pub(super) fn task(formula: &str) -> (AutomatonTask, CellTask) {
        let grid = Grid::new(&exact(&[0.0]), &exact(&[5.0]), &[5]).unwrap();
        let regions = vec![interval("a", 0.0, 1.5), interval("b", 3.0, 4.0)];
        let formula =
            Ltl::parse(formula, |name| ["a", "b"].iter().position(|n| *n == name).map(|i| i as u32));
        let (dfa, aim) = Dfa::of_ltl(&formula.unwrap()).unwrap();
        let task = AutomatonTask::new(&dfa, aim, regions, "does as told");
        let cells = CellTask::of_automaton(&task, &grid);
        (task, cells)
    }

    #[test]
    fn nature_picks_the_letter_where_a_cell_straddles() {
        use Standing::{Open, Reached};
        let (_, cells) = task("F (a & F b)");
        assert_eq!(cells.memories(), 2);
        let start = |cell| cells.standings(None, cell);
        // Memory 0 is met first: from cell 0, where a holds.
        assert_eq!([start(0), start(2), start(3)], [&[Open(0)][..], &[Open(1)], &[Open(1)]]);
        assert_eq!(start(1), [Open(0), Open(1)]);
        assert_eq!(cells.standings(Some(0), 3), [Reached]);
        assert_eq!(cells.standings(Some(1), 3), [Open(1)]);
        assert_eq!([cells.open(0), cells.open(1), cells.open(3)], [&[0][..], &[0, 1], &[1]]);
        assert!(cells.is_ambiguous() && cells.can_be_done());
        assert_eq!(cells.kind(CellId(3)), CellKind::Ordinary);
    }

    #[test]
    fn nature_picks_between_the_worst_and_the_best_kind() {
        use CellKind::{Goal, Ordinary, Unsafe};
        use Standing::{Failed, Open, Reached};
        let (worst, best) = (
            [Ordinary, Goal, Unsafe, Ordinary, Unsafe, Unsafe],
            [Ordinary, Goal, Unsafe, Goal, Ordinary, Goal],
        );
        let cells = CellTask::of_kinds(Aim::Reach, &worst, &best);
        let between = |cell| cells.standings(Some(0), cell);
        assert_eq!([between(0), between(1), between(2)], [&[Open(0)], &[Reached], &[Failed]]);
        assert_eq!(between(3), [Open(0), Reached]);
        assert_eq!(between(4), [Failed, Open(0)]);
        assert_eq!(between(5), [Failed, Open(0), Reached]);
        assert!(cells.is_ambiguous() && cells.open(4) == [0]);
        // A controller takes the worst for true.
        assert_eq!([0, 1, 2, 3, 4, 5].map(|cell| cells.kind(CellId(cell))), worst);
        assert_eq!(cells.arrive(Some(0), CellId(3), || panic!("no letter says it")), Open(0));
        assert!(!CellTask::of_kinds(Aim::Stay, &worst, &worst).is_ambiguous());
    }

    #[test]
    fn arrivals_read_the_state_only_where_they_must() {
        let (task, cells) = task("F (a & F b)");
        let lookup = LetterLookup::new(task.regions());
        let at = |before, x: f64| cells.arrive(before, CellId(x as u32), || lookup.letter(&[x]));
        assert_eq!(at(None, 1.25), Standing::Open(0));
        assert_eq!(at(None, 1.5), Standing::Open(1));
        assert_eq!(at(Some(0), 1.75), Standing::Open(0));
        let unasked = |_: ()| -> u64 { panic!("the cell says it") };
        assert_eq!(cells.arrive(Some(0), CellId(3), || unasked(())), Standing::Reached);
    }

    #[test]
    fn safe_tasks_have_no_end() {
        let (_, cells) = task("G !b");
        assert_eq!((cells.memories(), cells.aim()), (1, Aim::Stay));
        assert!(!cells.can_be_done() && !cells.is_ambiguous() && cells.accepts(0));
        assert_eq!(cells.kind(CellId(3)), CellKind::Unsafe);
        assert_eq!(cells.standings(Some(0), 3), [Standing::Failed]);
    }
}
