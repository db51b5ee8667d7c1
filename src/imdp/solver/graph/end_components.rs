//! End components: where the maximising side can stay for ever while the minimising one is fixed.

use super::tarjan::strong_components;
use crate::model::{IntervalMdp, Row, RowBuffer, RowId, StateId};

/// What the players can do in a part of the model, the minimising side being fixed.
pub(in crate::solver) struct Candidates<'a> {
    pub model: &'a IntervalMdp,
    pub states: &'a [StateId],
    /// The rows that each of the states may choose, as positions in `rows`.
    pub choices: Vec<Vec<u32>>,
    pub rows: Vec<RowId>,
    /// For a fixed nature: which successors of each row have positive probability.
    pub supports: Option<Vec<Vec<bool>>>,
}

/// The maximal end components, as positions in `states`.
///
/// Whether the upper bounds cover a component is decided in doubles: the result only suggests where upper
/// bounds should be level, which is verified afterwards.
pub(in crate::solver) fn end_components(part: &Candidates<'_>) -> Vec<Vec<u32>> {
    let mut label = vec![0u32; part.model.num_states()];
    let mut open: Vec<Vec<u32>> = vec![(0..part.states.len() as u32).collect()];
    let (mut next, mut closed) = (0, vec![]);
    while let Some(class) = open.pop() {
        next += 1;
        for &position in &class {
            label[part.states[position as usize].index()] = next;
        }
        let refined = part.refine(&class, &label, next);
        if refined.len() == 1 && refined[0].len() == class.len() {
            closed.extend(refined);
        } else {
            // Whatever is not in a refined class has left for good.
            class.iter().for_each(|&position| label[part.states[position as usize].index()] = 0);
            open.extend(refined);
        }
    }
    closed
}

impl Candidates<'_> {
    /// The strong components of a class under the rows that can stay in it, less states without such rows.
    fn refine(&self, class: &[u32], label: &[u32], own: u32) -> Vec<Vec<u32>> {
        let inside = |s: StateId| label[s.index()] == own;
        let mut stays: Vec<Option<bool>> = vec![None; self.rows.len()];
        let mut position_of = std::collections::HashMap::new();
        class.iter().for_each(|&position| {
            position_of.insert(self.states[position as usize], position);
        });
        let states = self.states.len();
        let mut has_choice = vec![false; states];
        let components = strong_components(
            states + self.rows.len(),
            class.iter().map(|&position| position as usize),
            |node, out| {
                if node < states {
                    for &row in &self.choices[node] {
                        let stay =
                            *stays[row as usize].get_or_insert_with(|| self.can_stay(row as usize, &inside));
                        if stay {
                            has_choice[node] = true;
                            out.push(states as u32 + row);
                        }
                    }
                } else {
                    let buffer = &mut RowBuffer::default();
                    let row = self.model.rows().row(self.rows[node - states], buffer);
                    let possible = (0..row.len()).filter(|&i| self.possible(node - states, row, i));
                    out.extend(possible.filter_map(|i| position_of.get(&row.successors[i])));
                }
            },
        );
        let only_states = components.into_iter().map(|component| {
            let keep = |v: &u32| (*v as usize) < states && has_choice[*v as usize];
            component.into_iter().filter(keep).collect::<Vec<u32>>()
        });
        only_states.filter(|component| !component.is_empty()).collect()
    }

    fn possible(&self, position: usize, row: Row<'_>, i: usize) -> bool {
        match &self.supports {
            Some(supports) => supports[position][i],
            None => row.upper[i] > 0.0,
        }
    }

    fn can_stay(&self, position: usize, inside: &impl Fn(StateId) -> bool) -> bool {
        let buffer = &mut RowBuffer::default();
        let row = self.model.rows().row(self.rows[position], buffer);
        match &self.supports {
            Some(supports) => {
                row.successors.iter().zip(&supports[position]).all(|(s, possible)| !possible || inside(*s))
            }
            None => can_stay(row, inside),
        }
    }
}

/// Whether some distribution of a row stays in a set; in doubt, yes.
pub(in crate::solver) fn can_stay(row: Row<'_>, inside: &impl Fn(StateId) -> bool) -> bool {
    let outside = row.successors.iter().zip(row.lower).any(|(s, l)| !inside(*s) && *l > 0.0);
    let room: f64 = row.successors.iter().zip(row.upper).filter(|(s, _)| inside(**s)).map(|(_, u)| u).sum();
    !outside && room >= 1.0 - crate::numeric::rounding_factor(row.len() + 4)
}
