//! Exact values by brute force: every policy against every vertex of every row, in rationals.

use imdp::model::{IntervalMdp, RowBuffer, RowId, StateId, StateSet};
use imdp::numeric::from_decimal;
use num_rational::{BigRational, Ratio};
use num_traits::{One, ToPrimitive, Zero};

pub type Exact = Ratio<i128>;

pub fn exact(x: f64) -> Exact {
    let x = from_decimal(x).unwrap();
    Ratio::new(x.numer().to_i128().unwrap(), x.denom().to_i128().unwrap())
}

fn permutations(n: usize) -> Vec<Vec<usize>> {
    if n == 0 {
        return vec![vec![]];
    }
    let shorter = permutations(n - 1);
    shorter
        .iter()
        .flat_map(|p| {
            (0..n).map(move |at| {
                let mut p = p.clone();
                p.insert(at, n - 1);
                p
            })
        })
        .collect()
}

/// Pours the slack in the given order.
pub fn pour(lower: &[Exact], upper: &[Exact], order: &[usize]) -> Vec<Exact> {
    let mut p = lower.to_vec();
    let mut left = Exact::one() - lower.iter().sum::<Exact>();
    for &i in order {
        let share = (upper[i] - lower[i]).min(left);
        p[i] += share;
        left -= share;
    }
    assert!(left.is_zero());
    p
}

/// The vertices of every row, as distributions over all states.
fn vertices(model: &IntervalMdp) -> Vec<Vec<Vec<Exact>>> {
    let of_row = |row: imdp::model::Row<'_>| {
        let lower: Vec<_> = row.lower.iter().map(|&x| exact(x)).collect();
        let upper: Vec<_> = row.upper.iter().map(|&x| exact(x)).collect();
        let mut all: Vec<Vec<Exact>> = vec![];
        for order in permutations(row.len()) {
            let p = pour(&lower, &upper, &order);
            let mut wide = vec![Exact::zero(); model.num_states()];
            row.successors.iter().zip(p).for_each(|(&s, p)| wide[s.index()] = p);
            if !all.contains(&wide) {
                all.push(wide);
            }
        }
        all
    };
    let rows = model.rows().to_stored();
    rows.iter().map(of_row).collect()
}

/// The probability to reach the goal in a Markov chain; `None` rows stay.
fn chain(goal: &StateSet, rows: &[Option<&Vec<Exact>>]) -> Vec<Exact> {
    let n = rows.len();
    let mut can: Vec<bool> = (0..n).map(|s| goal.contains(s)).collect();
    for _ in 0..n {
        for s in 0..n {
            if let Some(p) = rows[s] {
                can[s] |= (0..n).any(|t| can[t] && !p[t].is_zero());
            }
        }
    }
    let open: Vec<usize> = (0..n).filter(|&s| can[s] && !goal.contains(s)).collect();
    let k = open.len();
    // (I − P) x = b, Gauss–Jordan.
    let mut a: Vec<Vec<Exact>> = open
        .iter()
        .map(|&s| {
            let p = rows[s].unwrap();
            let mut line: Vec<Exact> =
                open.iter().map(|&t| if s == t { Exact::one() - p[t] } else { -p[t] }).collect();
            line.push((0..n).filter(|&t| goal.contains(t)).map(|t| p[t]).sum());
            line
        })
        .collect();
    for c in 0..k {
        let pivot = (c..k).find(|&r| !a[r][c].is_zero()).unwrap();
        a.swap(c, pivot);
        let scale = a[c][c].recip();
        a[c].iter_mut().for_each(|x| *x *= scale);
        let line = a[c].clone();
        for (r, other) in a.iter_mut().enumerate() {
            if r != c && !other[c].is_zero() {
                let factor = other[c];
                other.iter_mut().zip(&line).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let mut values: Vec<Exact> =
        (0..n).map(|s| if goal.contains(s) { Exact::one() } else { Exact::zero() }).collect();
    open.iter().zip(&a).for_each(|(&s, line)| values[s] = line[k]);
    values
}

/// `[Pmaxmin, Pmaxmax, Pminmin, Pminmax]` of `safe U goal` in every state.
pub fn unbounded(model: &IntervalMdp, safe: &StateSet, goal: &StateSet) -> [Vec<Exact>; 4] {
    unbounded_with(model, safe, goal, None)
}

/// The same against one stationary policy (row per state), if given.
pub fn unbounded_with(
    model: &IntervalMdp,
    safe: &StateSet,
    goal: &StateSet,
    policy: Option<&[Option<RowId>]>,
) -> [Vec<Exact>; 4] {
    let n = model.num_states();
    let vertices = vertices(model);
    let moving: Vec<usize> = (0..n)
        .filter(|&s| {
            safe.contains(s)
                && !goal.contains(s)
                && !model.choices().ranges(StateId::from_index(s)).is_empty()
        })
        .collect();
    let options: Vec<Vec<RowId>> = moving
        .iter()
        .map(|&s| match policy {
            Some(policy) => vec![policy[s].unwrap()],
            None => model.choices().rows(StateId::from_index(s)).collect(),
        })
        .collect();
    let mut result: Option<[Vec<Exact>; 4]> = None;
    for rows in product(&options) {
        let natures: Vec<Vec<&Vec<Exact>>> =
            rows.iter().map(|&row| vertices[row.index()].iter().collect()).collect();
        let (mut low, mut high): (Option<Vec<Exact>>, Option<Vec<Exact>>) = (None, None);
        for picks in product(&natures) {
            let mut chain_rows = vec![None; n];
            moving.iter().zip(picks).for_each(|(&s, p)| chain_rows[s] = Some(p));
            let values = chain(goal, &chain_rows);
            combine(&mut low, &values, Ord::min);
            combine(&mut high, &values, Ord::max);
        }
        let (low, high) = (low.unwrap(), high.unwrap());
        match &mut result {
            None => result = Some([low.clone(), high.clone(), low, high]),
            Some([maxmin, maxmax, minmin, minmax]) => {
                for s in 0..n {
                    maxmin[s] = maxmin[s].max(low[s]);
                    maxmax[s] = maxmax[s].max(high[s]);
                    minmin[s] = minmin[s].min(low[s]);
                    minmax[s] = minmax[s].min(high[s]);
                }
            }
        }
    }
    result.unwrap()
}

fn combine(best: &mut Option<Vec<Exact>>, values: &[Exact], pick: fn(Exact, Exact) -> Exact) {
    match best {
        None => *best = Some(values.to_vec()),
        Some(best) => best.iter_mut().zip(values).for_each(|(b, &v)| *b = pick(*b, v)),
    }
}

fn product<T: Copy>(options: &[Vec<T>]) -> Vec<Vec<T>> {
    options.iter().fold(vec![vec![]], |lists, options| {
        lists
            .iter()
            .flat_map(|list| {
                options.iter().map(move |&option| {
                    let mut list = list.clone();
                    list.push(option);
                    list
                })
            })
            .collect()
    })
}

/// `safe U<=steps goal` (or one step from every state) by exact O-maximization; `max` for policy, nature.
pub fn bounded(
    model: &IntervalMdp,
    safe: &StateSet,
    goal: &StateSet,
    steps: u64,
    (policy_max, nature_max): (bool, bool),
    next: bool,
) -> Vec<BigRational> {
    let n = model.num_states();
    let mut values: Vec<BigRational> =
        (0..n).map(|s| BigRational::from_integer(i64::from(goal.contains(s)).into())).collect();
    for _ in 0..steps {
        let row_value = |id: RowId| {
            let buffer = &mut RowBuffer::default();
            let row = model.rows().row(RowId(id.0), buffer);
            let mut order: Vec<usize> = (0..row.len()).collect();
            order.sort_by_key(|&i| values[row.successors[i].index()].clone());
            if nature_max {
                order.reverse();
            }
            let bound = |x: f64| from_decimal(x).unwrap();
            let mut left = BigRational::one() - row.lower.iter().map(|&l| bound(l)).sum::<BigRational>();
            let mut sum = BigRational::zero();
            for i in order {
                let share = (bound(row.upper[i]) - bound(row.lower[i])).min(left.clone());
                left -= &share;
                sum += (bound(row.lower[i]) + share) * &values[row.successors[i].index()];
            }
            sum
        };
        let state_value = |s: usize| {
            let ws = model.choices().rows(StateId::from_index(s)).map(row_value);
            if policy_max { ws.max() } else { ws.min() }
        };
        let moves = |s: usize| next || (safe.contains(s) && !goal.contains(s));
        values = (0..n)
            .map(|s| moves(s).then(|| state_value(s)).flatten().unwrap_or_else(|| values[s].clone()))
            .collect();
    }
    values
}
