//! Steps of certificates judged by the definitions, slowly and in rationals throughout.

use imdp::certificate::Step;
use imdp::model::{IntervalMdp, RowBuffer, RowId, StateId, StateSet};
use imdp::numeric::{Rational, from_decimal, from_dyadic};
use imdp::property::{Property, QueryKind};
use num_traits::{One, Zero};

pub struct Oracle<'a> {
    pub model: &'a IntervalMdp,
    pub moving: Vec<usize>,
    goal: StateSet,
    pub steps: Option<u64>,
    pub policy_max: bool,
    nature_max: bool,
    pub complement: bool,
}

/// Choices, lower and upper bounds by state.
pub type Table = (Vec<Option<u32>>, Vec<f64>, Vec<f64>);

pub fn rational(x: f64) -> Rational {
    from_dyadic(x).unwrap()
}

impl<'a> Oracle<'a> {
    pub fn new(model: &'a IntervalMdp, property: &Property) -> Self {
        let query = property.resolve(model.kind()).unwrap().query(model).unwrap();
        let has_rows = |s: &usize| model.choices().rows(StateId(*s as u32)).next().is_some();
        let all = (0..model.num_states()).filter(has_rows);
        let (moving, goal, steps) = match query.kind {
            QueryKind::Next { goal } => (all.collect(), goal, Some(1)),
            QueryKind::Until { safe, goal, steps } => {
                (all.filter(|&s| safe.contains(s) && !goal.contains(s)).collect(), goal, steps)
            }
        };
        let (policy_max, nature_max) =
            (query.resolution.policy_maximises(), query.resolution.nature_maximises());
        Self { model, moving, goal, steps, policy_max, nature_max, complement: query.complement }
    }

    /// 1 in the goal, 0 elsewhere.
    pub fn start(&self) -> Vec<f64> {
        (0..self.model.num_states()).map(|s| f64::from(u8::from(self.goal.contains(s)))).collect()
    }

    /// `opt_p p·V` by the definition: every bound a rational, mass poured in the order of the values.
    pub fn row(&self, id: u32, values: &[f64]) -> Rational {
        let buffer = &mut RowBuffer::default();
        let row = self.model.rows().row(RowId(id), buffer);
        let value = |i: usize| rational(values[row.successors[i].index()]);
        let mut order: Vec<usize> = (0..row.len()).collect();
        order.sort_by_key(|&i| value(i));
        if self.nature_max {
            order.reverse();
        }
        let bound = |x: f64| from_decimal(x).unwrap();
        let mut left = Rational::one() - row.lower.iter().map(|&l| bound(l)).sum::<Rational>();
        let mut sum = Rational::zero();
        for i in order {
            let share = (bound(row.upper[i]) - bound(row.lower[i])).min(left.clone());
            left -= &share;
            sum += (bound(row.lower[i]) + share) * value(i);
        }
        sum
    }

    /// What a bound of a state must not go beyond: the worst of the rows that it has to hold for.
    ///
    /// `None` if the policy has to have a choice here and has none.
    pub fn limit(&self, lower: bool, s: usize, choice: Option<u32>, values: &[f64]) -> Option<Rational> {
        let rows = || self.model.choices().rows(StateId(s as u32));
        if lower == self.policy_max {
            return Some(self.row(rows().nth(choice? as usize)?.0, values));
        }
        let expectations = rows().map(|row| self.row(row.0, values));
        if lower { expectations.min() } else { expectations.max() }
    }

    fn follows(&self, lower: bool, next: &[f64], choices: &[Option<u32>], values: &[f64]) -> bool {
        self.moving.iter().all(|&s| {
            let trivial = next[s] == if lower { 0.0 } else { 1.0 };
            let limit = self.limit(lower, s, choices[s], values);
            trivial
                || limit.is_some_and(|limit| {
                    if lower { rational(next[s]) <= limit } else { rational(next[s]) >= limit }
                })
        })
    }

    /// The tables before the first step and after each one.
    pub fn tables(&self, steps: &[Step]) -> Vec<Table> {
        let mut table = (vec![None; self.model.num_states()], self.start(), self.start());
        let mut all = vec![table.clone()];
        for step in steps {
            step.choices.iter().for_each(|&(s, choice)| table.0[s.index()] = Some(choice));
            step.lower.iter().for_each(|&(s, value)| table.1[s.index()] = value);
            step.upper.iter().for_each(|&(s, value)| table.2[s.index()] = value);
            all.push(table.clone());
        }
        all
    }

    /// Whether every step follows from the one before it, and the last one from itself.
    pub fn justifies(&self, steps: &[Step]) -> bool {
        let mut tables = self.tables(steps);
        let horizon = self.steps.unwrap() as usize;
        if steps.len() > horizon {
            return false;
        }
        if steps.len() < horizon {
            tables.extend(tables.last().cloned());
        }
        tables.windows(2).all(|pair| {
            self.follows(true, &pair[1].1, &pair[1].0, &pair[0].1)
                && self.follows(false, &pair[1].2, &pair[1].0, &pair[0].2)
        })
    }
}
