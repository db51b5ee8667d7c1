//! A distribution cut at the pitch of a lattice.

use super::Distribution;
use crate::landing::Taps;
use imdp::numeric::Rational;
use num_traits::{One, ToPrimitive};

/// How much mass is not listed, on either side: twice this is lost at every step.
const TAIL: f64 = 5e-13;

impl Distribution {
    /// Bounds on the masses of `[kδ, (k+1)δ)` for all `k` that matter, none of them outside `within`.
    ///
    /// Intervals outside lead out of the partition from everywhere; what is in the tails is too little to matter. Neither
    /// is listed.
    pub fn taps(&self, pitch: &Rational, within: (i64, i64)) -> Taps {
        let edge = |k: i64| pitch * Rational::from_integer(k.into());
        let first = self.first(pitch, within);
        let last = self.last(pitch, within).max(first);
        let masses = (first..=last).map(|k| self.mass(Some(&edge(k)), Some(&edge(k + 1))));
        let (lower, upper): (Vec<f64>, Vec<f64>) =
            masses.map(|mass| (mass.lower().max(0.0), mass.upper().min(1.0))).unzip();
        let below = self.mass(None, Some(&edge(first))).upper();
        let above = self.mass(Some(&edge(last + 1)), None).upper();
        let (least, greatest) = self.support();
        let beyond = |within: bool, mass: f64| if within { 0.0 } else { mass };
        let elsewhere = beyond(least.is_some_and(|x| edge(first) <= x), below)
            + beyond(greatest.is_some_and(|x| x < edge(last + 1)), above);
        Taps { first, lower, upper, elsewhere: elsewhere.next_up() * f64::from(u8::from(elsewhere > 0.0)) }
    }

    /// The first interval that is listed: what is below has less mass than the tail.
    fn first(&self, pitch: &Rational, (low, high): (i64, i64)) -> i64 {
        let edge = |k: i64| pitch * Rational::from_integer(k.into());
        if let (Some(least), _) = self.support() {
            let k = (least / pitch).floor().to_integer().to_i64().unwrap_or(low);
            return k.clamp(low, high);
        }
        first_where(low, high, |k| self.mass(None, Some(&edge(k + 1))).upper() > TAIL)
    }

    /// The last interval that is listed.
    fn last(&self, pitch: &Rational, (low, high): (i64, i64)) -> i64 {
        let edge = |k: i64| pitch * Rational::from_integer(k.into());
        if let (_, Some(greatest)) = self.support() {
            // Upper ends of intervals of continuous distributions have no mass, but atoms do.
            let k = match self {
                Self::Uniform { .. } | Self::Triangular { .. } | Self::Table(_) | Self::Truncated { .. } => {
                    (greatest / pitch).ceil() - Rational::one()
                }
                _ => (greatest / pitch).floor(),
            };
            return k.to_integer().to_i64().unwrap_or(high).clamp(low, high);
        }
        first_where(low, high, |k| self.mass(Some(&edge(k + 1)), None).upper() <= TAIL)
    }
}

/// The first number from `low` to `high` for which something holds that holds for all later ones; `high` if none.
fn first_where(mut low: i64, mut high: i64, holds: impl Fn(i64) -> bool) -> i64 {
    while low < high {
        let middle = low + (high - low) / 2;
        if holds(middle) { high = middle } else { low = middle + 1 }
    }
    low
}
