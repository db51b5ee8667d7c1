//! Linear equations `x = r + P x` for a process that is left almost surely, without a subtraction.
//!
//! States are eliminated one after the other (Grassmann, Taksar and Heyman): when `k` goes, whoever came to it
//! goes on at once to where it leads,
//!
//! `p_ij += p_ik p_kj / d_k`, `r_i += p_ik r_k / d_k`, `d_k = 1 − p_kk = Σ_{j≠k} p_kj`,
//!
//! the sum including the probability to leave. Nothing is subtracted, so every entry keeps its relative accuracy
//! however slowly the process is left. Whoever has the fewest ways in and out goes first, which keeps rows short.

use crate::numeric::Rational;
use num_traits::Num;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Numbers, and what it takes to multiply them.
pub(in crate::solver) trait Number: Clone + Num {
    /// In multiplications of 64 binary digits.
    fn cost(&self) -> u64;
}

impl Number for f64 {
    fn cost(&self) -> u64 {
        1
    }
}

impl Number for Rational {
    fn cost(&self) -> u64 {
        // Fractions are brought to lowest terms, a binary digit at a time.
        let digits = (self.numer().bits() + self.denom().bits()) / 64 + 1;
        64 * digits * digits
    }
}

/// The factors of `I − P`.
#[derive(Debug)]
pub(in crate::solver) struct Elimination<T> {
    steps: Vec<Step<T>>,
}

#[derive(Debug)]
struct Step<T> {
    state: u32,
    /// `1 − p_kk`.
    rate: T,
    /// Where `k` leads, among the states that go later.
    onward: Vec<(u32, T)>,
    /// Who came to `k`, as multiples of its row.
    into: Vec<(u32, T)>,
}

/// `P` as lists of `(successor, probability)` in ascending order, and the probability to leave.
#[derive(Debug)]
pub(in crate::solver) struct Process<T> {
    pub rows: Vec<Vec<(u32, T)>>,
    pub exits: Vec<T>,
}

impl<T: Number> Elimination<T> {
    /// `None` if some state is never left, or it would cost more than what is left of the budget, which is used up.
    pub(in crate::solver) fn new(process: Process<T>, budget: &mut u64) -> Option<Self> {
        let Process { mut rows, mut exits } = process;
        let states = rows.len();
        let mut arrivals: Vec<Vec<u32>> = vec![vec![]; states];
        for (i, row) in (0..).zip(&mut rows) {
            row.retain(|(j, p)| *j != i && !p.is_zero());
            row.iter().for_each(|&(j, _)| arrivals[j as usize].push(i));
        }
        let cost = |row: &[(u32, T)], arrivals: &[u32]| row.len() as u64 * arrivals.len() as u64;
        let mut queue: BinaryHeap<_> =
            (0..states).map(|k| Reverse((cost(&rows[k], &arrivals[k]), k))).collect();
        let (mut gone, mut steps) = (vec![false; states], Vec::with_capacity(states));
        while let Some(Reverse((believed, k))) = queue.pop() {
            if gone[k] {
                continue;
            }
            arrivals[k].retain(|&i| !gone[i as usize]);
            let now = cost(&rows[k], &arrivals[k]);
            if now > believed {
                queue.push(Reverse((now, k)));
                continue;
            }
            gone[k] = true;
            let onward = std::mem::take(&mut rows[k]);
            let rate = onward.iter().fold(exits[k].clone(), |sum, (_, p)| sum + p.clone());
            if rate.is_zero() {
                return None;
            }
            let mut into = vec![];
            for i in std::mem::take(&mut arrivals[k]) {
                let row = &mut rows[i as usize];
                let Ok(at) = row.binary_search_by_key(&(k as u32), |entry| entry.0) else { continue };
                let factor = row.remove(at).1 / rate.clone();
                let cost = (row.len() + onward.len() + 1) as u64 * factor.cost();
                *budget = budget.saturating_sub(cost);
                (*budget > 0).then_some(())?;
                exits[i as usize] = exits[i as usize].clone() + factor.clone() * exits[k].clone();
                add(row, &onward, i, &factor, |j| arrivals[j as usize].push(i));
                into.push((i, factor));
            }
            onward.iter().for_each(|&(j, _)| {
                let j = j as usize;
                queue.push(Reverse((cost(&rows[j], &arrivals[j]), j)));
            });
            into.iter().for_each(|&(i, _)| {
                let i = i as usize;
                queue.push(Reverse((cost(&rows[i], &arrivals[i]), i)));
            });
            steps.push(Step { state: k as u32, rate, onward, into });
        }
        Some(Self { steps })
    }

    /// The solution of `x = r + P x`.
    pub(in crate::solver) fn solve(&self, mut right: Vec<T>) -> Vec<T> {
        for step in &self.steps {
            let own = right[step.state as usize].clone();
            for (i, factor) in &step.into {
                right[*i as usize] = right[*i as usize].clone() + factor.clone() * own.clone();
            }
        }
        for step in self.steps.iter().rev() {
            let own = right[step.state as usize].clone();
            let sum =
                step.onward.iter().fold(own, |sum, (j, p)| sum + p.clone() * right[*j as usize].clone());
            right[step.state as usize] = sum / step.rate.clone();
        }
        right
    }
}

/// `row += factor · other`, without an entry for `own`; `new` is told where there was none before.
fn add<T: Number>(
    row: &mut Vec<(u32, T)>,
    other: &[(u32, T)],
    own: u32,
    factor: &T,
    mut new: impl FnMut(u32),
) {
    let mut merged = Vec::with_capacity(row.len() + other.len());
    let mut rest = std::mem::take(row).into_iter().peekable();
    for (j, p) in other.iter().filter(|(j, _)| *j != own) {
        while let Some(entry) = rest.next_if(|entry| entry.0 < *j) {
            merged.push(entry);
        }
        let more = factor.clone() * p.clone();
        match rest.next_if(|entry| entry.0 == *j) {
            Some((_, old)) => merged.push((*j, old + more)),
            None => {
                new(*j);
                merged.push((*j, more));
            }
        }
    }
    merged.extend(rest);
    *row = merged;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Rational;
    use proptest::prelude::*;

    #[test]
    fn slow_exits_keep_their_accuracy() {
        // Two states that change places and leave with 1e-15 each: 1e15 steps are expected.
        let rows = vec![vec![(1, 1.0 - 1e-15)], vec![(0, 1.0 - 1e-15)]];
        let process = Process { rows, exits: vec![1e-15, 1e-15] };
        let steps = Elimination::new(process, &mut 100).unwrap().solve(vec![1.0, 1.0]);
        assert!(steps.iter().all(|x| (x / 1e15 - 1.0_f64).abs() < 1e-12), "{steps:?}");
    }

    #[test]
    fn a_closed_set_is_no_process_that_is_left() {
        let rows = vec![vec![(1, 1.0)], vec![(0, 1.0)], vec![(0, 0.5)]];
        assert!(Elimination::new(Process { rows, exits: vec![0.0, 0.0, 0.5] }, &mut 100).is_none());
    }

    proptest! {
        #[test]
        fn solutions_solve(weights in prop::collection::vec(prop::collection::vec(0i64..4, 6), 5)) {
            let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
            // Always some way out, in the last column.
            let total = |row: &[i64]| row.iter().sum::<i64>() + 1;
            let probability = |i: usize, j: usize| ratio(weights[i][j], total(&weights[i]));
            let rows = (0..5).map(|i| (0..5).map(|j| (j as u32, probability(i, j))).collect()).collect();
            let exits = (0..5).map(|i| ratio(weights[i][5] + 1, total(&weights[i]))).collect();
            let right: Vec<Rational> = (0..5).map(|i| ratio(i, 3)).collect();
            let x = Elimination::new(Process { rows, exits }, &mut 1_000_000).unwrap().solve(right.clone());
            for i in 0..5 {
                let sum = (0..5).fold(right[i].clone(), |sum, j| sum + probability(i, j) * &x[j]);
                prop_assert_eq!(&sum, &x[i]);
            }
        }
    }
}
