//! Masses of which only intervals are known: the least or greatest expectation over all of them.

use super::side::{Side, Slack};

/// Masses `p_k ∈ [l_k, u_k]` that sum to 1 together with the mass of what is not listed, at most `elsewhere`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Masses {
    /// `l_k`.
    lower: Vec<f64>,
    /// `u_k − l_k`, rounded up.
    room: Vec<f64>,
    elsewhere: f64,
    /// `1 − Σ l_k`, rounded down and up.
    slack: Slack,
}

impl Masses {
    pub(super) fn new(lower: Vec<f64>, upper: &[f64], elsewhere: f64) -> Self {
        let room = lower.iter().zip(upper).map(|(l, u)| (u - l).next_up().max(0.0)).collect();
        let slack = Slack::beside(&lower);
        Self { lower, room, elsewhere, slack }
    }

    pub(super) fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// What the lower bounds leave at most, if all of it may be of what is not listed: then it is, whatever the values.
    pub(super) fn unlisted(&self) -> Option<f64> {
        (self.slack.most <= self.elsewhere).then_some(self.slack.most)
    }

    /// The extremum of `Σ p_k v_k`, where what is not listed is worth [`Side::UNLISTED`].
    ///
    /// O-maximization: what the lower bounds leave is poured from the worst value on (Givan, Leach, Dean, *Artif. Intell.*
    /// 122, 2000). The value up to which it lasts is found by halving, not by sorting. No mass is poured that exact
    /// arithmetic would not pour there or somewhere worse.
    pub(super) fn extremum<S: Side>(&self, values: &[f64], scratch: &mut Vec<(f64, f64)>) -> f64 {
        let mut rest = S::slack(self.slack);
        let unlisted = rest.min(self.elsewhere);
        rest = S::less(rest, self.elsewhere);
        let mut sum: f64 = self.lower.iter().zip(values).map(|(l, v)| l * v).sum();
        sum += unlisted * S::UNLISTED;
        if rest > 0.0 {
            scratch.clear();
            scratch.extend(values.iter().copied().zip(self.room.iter().copied()));
            let (poured, left) = pour::<S>(scratch, rest);
            // What fits nowhere is there by rounding only, or contradicts the bounds.
            sum += poured + left * S::UNLISTED;
        }
        (sum * S::outward(2 * values.len() + 2)).clamp(0.0, 1.0)
    }
}

/// Pours `rest` over `(value, room)`, the worst values first: what that is worth, and what is left.
fn pour<S: Side>(mut all: &mut [(f64, f64)], mut rest: f64) -> (f64, f64) {
    let mut worth = 0.0;
    while rest > 0.0 && !all.is_empty() {
        let half = (all.len() / 2).max(1);
        let order = |a: &(f64, f64), b: &(f64, f64)| S::worst_first(a.0, b.0).then(b.1.total_cmp(&a.1));
        all.select_nth_unstable_by(half - 1, order);
        let (worse, better) = all.split_at_mut(half);
        let room = S::room(worse.iter().map(|(_, room)| room).sum(), worse.len());
        if room <= rest {
            worth += worse.iter().map(|(value, room)| value * room).sum::<f64>();
            rest = S::less(rest, room);
            all = better;
        } else if half == 1 {
            return (worth + worse[0].0 * rest, 0.0);
        } else {
            all = worse;
        }
    }
    (worth, rest)
}

#[cfg(test)]
mod tests {
    use super::super::side::{Lower, Upper};
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha12Rng;

    /// By sorting, in doubles.
    fn sorted(lower: &[f64], upper: &[f64], elsewhere: f64, values: &[f64], least: bool) -> f64 {
        let mut all: Vec<(f64, f64, f64)> =
            lower.iter().zip(upper).zip(values).map(|((l, u), v)| (*v, *l, u - l)).collect();
        all.push((if least { 0.0 } else { 1.0 }, 0.0, elsewhere));
        all.sort_by(|a, b| if least { a.0.total_cmp(&b.0) } else { b.0.total_cmp(&a.0) });
        let mut rest = 1.0 - lower.iter().sum::<f64>();
        all.iter().fold(0.0, |sum, (v, l, room)| {
            let more = room.min(rest).max(0.0);
            rest -= more;
            sum + v * (l + more)
        })
    }

    #[test]
    fn halving_gives_what_sorting_gives() {
        let mut rng = ChaCha12Rng::seed_from_u64(3);
        for case in 0..300 {
            let count = rng.random_range(1..40);
            let number = |rng: &mut ChaCha12Rng| f64::from(rng.random_range(0..50u32));
            let weights: Vec<f64> = (0..count).map(|_| number(&mut rng) + 0.1).collect();
            let sum: f64 = weights.iter().sum::<f64>() * 1.05;
            let lower: Vec<f64> = weights.iter().map(|w| 0.9 * w / sum).collect();
            let upper: Vec<f64> = weights.iter().map(|w| (1.2 * w / sum + 0.01).min(1.0)).collect();
            let values: Vec<f64> = (0..count).map(|_| number(&mut rng) / 50.0).collect();
            let masses = Masses::new(lower.clone(), &upper, 0.02);
            assert_eq!(masses.unlisted(), None);
            let mut scratch = vec![];
            let least = masses.extremum::<Lower>(&values, &mut scratch);
            let most = masses.extremum::<Upper>(&values, &mut scratch);
            let (below, above) =
                (sorted(&lower, &upper, 0.02, &values, true), sorted(&lower, &upper, 0.02, &values, false));
            assert!(least <= below + 1e-16 && least > below - 1e-13, "{case}: {least} {below}");
            assert!(most >= above - 1e-16 && most < above + 1e-13, "{case}: {most} {above}");
        }
    }
}
