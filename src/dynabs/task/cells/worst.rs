//! What nature picks, where one of the standings is the worst whatever comes.
//!
//! A memory is *no better* than another if every letter leads to a standing that is no better, and if a task that ends there is
//! fulfilled in the other too: then every word that fulfils the task from it does so from the other. A controller can go on from
//! the other as it would from this one, so its value is at least as large, in every cell, with as many steps left, on every
//! model. To have failed is the worst and to be done the best. So a lower bound with nature picking the worst of all standings
//! is one with nature picking any.

use super::{CellTask, Class, Letters, Memory, Standing};
use crate::partition::CellId;
use crate::task::{Aim, Letter};

/// A cell in which no standing is the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Straddling {
    /// The cell.
    pub cell: CellId,
    /// The regions whose faces cut it, as bits.
    pub regions: Letter,
}

/// Which memories are no better than which.
struct Order {
    memories: usize,
    /// By memory, then by the other.
    no_better: Vec<bool>,
}

impl CellTask {
    /// The task with one standing for every memory and cell, the worst; with memories that count `steps` if its end decides.
    ///
    /// The memories that are open in cells stay what they are, for states may be better than the worst of their cell.
    ///
    /// # Errors
    /// [`Straddling`] names a cell in which which standing is the worst depends on what comes.
    pub fn at_worst(&self, steps: Option<u64>) -> Result<Self, Straddling> {
        let order = Order::new(self);
        let mut task = match (self.aim, steps) {
            (Aim::End, Some(steps)) => self.clocked(steps),
            _ => self.clone(),
        };
        for (number, class) in task.classes.iter_mut().enumerate() {
            for standings in &mut class.standings {
                *standings = vec![order.worst(standings).ok_or_else(|| self.straddling(number))?];
            }
            if self.letters.is_none() {
                // Without letters a controller takes the worst for true.
                *class = Class::new(std::mem::take(&mut class.standings));
            }
        }
        Ok(task)
    }

    /// Whether a run may be done on arrival in some cell.
    pub fn is_done_somewhere(&self) -> bool {
        let mut occurs = vec![false; self.classes.len()];
        self.class_of.iter().for_each(|&class| occurs[class as usize] = true);
        let occurring = self.classes.iter().zip(occurs).filter(|(_, occurs)| *occurs);
        occurring.flat_map(|(class, _)| class.standings.iter().flatten()).any(|s| *s == Standing::Reached)
    }

    fn straddling(&self, class: usize) -> Straddling {
        let cell = self.class_of.iter().position(|&of_cell| of_cell as usize == class).unwrap_or_default();
        let label = self.letters.as_ref().and_then(|letters| letters.labels.get(class)).copied();
        let regions = label.map_or(0, |label| label.possible & !label.certain);
        Straddling { cell: CellId(cell as u32), regions }
    }
}

impl Order {
    /// The greatest relation with what is asked of it.
    fn new(task: &CellTask) -> Self {
        let memories = task.accepting.len();
        let pair = |at: usize| (at / memories, at % memories);
        let ends_no_better = |at| {
            let (a, b) = pair(at);
            !task.accepting[a] || task.accepting[b]
        };
        let mut order = Self { memories, no_better: (0..memories * memories).map(ends_no_better).collect() };
        let Some(letters) = &task.letters else { return order };
        let read = letters.read();
        loop {
            let holds = |at: usize| {
                let (a, b) = pair(at);
                let after = |letter: &Letter| {
                    let [a, b] = [a, b].map(|memory| letters.next[memory][*letter as usize]);
                    order.is_no_better(a, b)
                };
                order.no_better[at] && read.iter().all(after)
            };
            let smaller: Vec<bool> = (0..order.no_better.len()).map(holds).collect();
            if smaller == order.no_better {
                return order;
            }
            order.no_better = smaller;
        }
    }

    /// Whether one standing is no better than another, at the same time if memories count steps.
    fn is_no_better(&self, a: Standing, b: Standing) -> bool {
        match (a, b) {
            (Standing::Failed, _) | (_, Standing::Reached) => true,
            (_, Standing::Failed) | (Standing::Reached, _) => false,
            (Standing::Open(a), Standing::Open(b)) => {
                let number = |memory: Memory| memory as usize % self.memories;
                self.no_better[number(a) * self.memories + number(b)]
            }
        }
    }

    /// The one that is no better than any.
    fn worst(&self, standings: &[Standing]) -> Option<Standing> {
        let is_worst = |a: &&Standing| standings.iter().all(|&b| self.is_no_better(**a, b));
        standings.iter().find(is_worst).copied()
    }
}

impl Letters {
    /// The letters that some cell may have.
    fn read(&self) -> Vec<Letter> {
        let mut read: Vec<Letter> = self.labels.iter().flat_map(|label| label.letters()).collect();
        read.sort_unstable();
        read.dedup();
        read
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::task;
    use super::*;
    use Standing::{Failed, Open, Reached};

    #[test]
    fn to_have_done_less_is_worse() {
        let (_, cells) = task("F (a & F b)");
        let worst = cells.at_worst(None).unwrap();
        // Cell 1 may be in a or not; memory 0 is to have been there.
        assert_eq!(worst.standings(None, 1), [Open(1)]);
        assert_eq!(worst.standings(Some(1), 1), [Open(1)]);
        assert_eq!(worst.standings(Some(0), 1), [Open(0)]);
        assert_eq!(worst.standings(Some(0), 3), [Reached]);
        assert!(!worst.is_ambiguous() && worst.open(1) == cells.open(1));
    }

    #[test]
    fn to_be_lost_is_worse_and_to_be_done_is_better() {
        let (_, cells) = task("!a U b");
        assert_eq!(cells.at_worst(None).unwrap().standings(None, 1), [Failed]);
        let (_, cells) = task("F (a & (b | !b))");
        assert_eq!(cells.at_worst(None).unwrap().standings(None, 1), [Open(0)]);
    }

    #[test]
    fn what_is_wanted_both_ways_has_no_worst() {
        // To be in b after a, or not to be in b after not being in a.
        let (_, cells) = task("F ((a & X b) | (!a & X !b))");
        let straddling = cells.at_worst(None).unwrap_err();
        assert_eq!(straddling, Straddling { cell: CellId(1), regions: 0b01 });
        // It does not matter where no cell is cut.
        let (_, cells) = task("F ((b & (X a)) | (!b & (X !a) & (X (X b))))");
        assert!(cells.at_worst(None).is_ok());
    }
}
