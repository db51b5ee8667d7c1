//! Strategies by which the maximising sides surely lead out of a part.

use super::super::query::Direction;
use std::collections::VecDeque;

/// A row, as far as it matters where it may lead.
pub(in crate::solver) trait Leads {
    /// Where: positions of states, then of what is outside.
    fn targets(&self) -> &[u32];

    /// Whether every distribution (`Min`) or some (`Max`) gives the targets in a set positive mass.
    fn hits(&self, nature: Direction, inside: impl Fn(u32) -> bool) -> bool;
}

/// How to get out.
pub(in crate::solver) struct WaysOut {
    /// By state: a row; what minimising states choose has no meaning.
    pub choices: Vec<u32>,
    /// By state, then by what is outside: the larger, the closer to where there is something to be had. A maximising
    /// nature goes there, a minimising one the other way.
    pub closeness: Vec<u32>,
}

/// How the maximising sides get out to something promising with positive probability, whatever the minimising ones do;
/// `None` if there is a state where they cannot.
///
/// `states` are the rows of every state, by position, and who chooses; `promising` says so of what is outside.
pub(in crate::solver) fn ways_out<R: Leads>(
    states: &[(&[u32], Direction)],
    rows: &[R],
    promising: &[bool],
    nature: Direction,
) -> Option<WaysOut> {
    let count = states.len();
    let mut users: Vec<Vec<u32>> = vec![vec![]; rows.len()];
    let mut needed: Vec<usize> = vec![1; count];
    for (i, (options, optimum)) in (0..).zip(states) {
        options.iter().for_each(|&row| users[row as usize].push(i));
        if *optimum == Direction::Min {
            needed[i as usize] = options.len();
        }
    }
    let mut predecessors: Vec<Vec<u32>> = vec![vec![]; count + promising.len()];
    for (id, row) in (0..).zip(rows) {
        row.targets().iter().for_each(|&target| predecessors[target as usize].push(id));
    }
    let mut closeness: Vec<u32> = vec![0; count + promising.len()];
    let mut choices: Vec<u32> =
        states.iter().map(|(options, _)| options.first().copied()).collect::<Option<_>>()?;
    let mut done = vec![false; rows.len()];
    let mut next = u32::MAX;
    let mut work: VecDeque<u32> =
        (0..).zip(promising).filter(|(_, promising)| **promising).map(|(i, _)| count as u32 + i).collect();
    work.iter().for_each(|&i| closeness[i as usize] = u32::MAX);
    while let Some(target) = work.pop_front() {
        for &id in &predecessors[target as usize] {
            let row = id as usize;
            if done[row] || !rows[row].hits(nature, |t| closeness[t as usize] > 0) {
                continue;
            }
            done[row] = true;
            for &state in &users[row] {
                let i = state as usize;
                if closeness[i] > 0 {
                    continue;
                }
                needed[i] -= 1;
                if needed[i] == 0 {
                    next -= 1;
                    closeness[i] = next;
                    choices[i] = if states[i].1 == Direction::Max { id } else { choices[i] };
                    work.push_back(state);
                }
            }
        }
    }
    closeness[..count].iter().all(|&c| c > 0).then_some(WaysOut { choices, closeness })
}
