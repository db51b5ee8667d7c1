//! What an edge asks of a letter.

/// More cubes than this are given up.
pub(super) const MAX_CUBES: usize = 4096;

/// A Boolean combination of propositions, as a disjunction of cubes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Guard(Vec<Cube>);

/// A conjunction of literals, by bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cube {
    positive: u64,
    negative: u64,
}

impl Guard {
    pub(super) fn constant(value: bool) -> Self {
        Self(if value { vec![Cube { positive: 0, negative: 0 }] } else { vec![] })
    }

    pub(super) fn literal(index: u64, value: bool) -> Self {
        let bit = 1 << index;
        Self(vec![if value {
            Cube { positive: bit, negative: 0 }
        } else {
            Cube { positive: 0, negative: bit }
        }])
    }

    /// The guard that a letter alone satisfies.
    pub(super) fn of_letter(letter: u64, propositions: usize) -> Self {
        let all = if propositions == 64 { u64::MAX } else { (1 << propositions) - 1 };
        Self(vec![Cube { positive: letter, negative: all & !letter }])
    }

    /// The number of cubes.
    pub(super) fn num_cubes(&self) -> usize {
        self.0.len()
    }

    /// Whether a letter, the set of the propositions that hold, satisfies it.
    pub(super) fn allows(&self, letter: u64) -> bool {
        self.0.iter().any(|cube| cube.positive & !letter == 0 && cube.negative & letter == 0)
    }

    /// Whether no letter satisfies it.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What no guard of an edge allows; none if it has too many cubes.
    pub(super) fn gap<'g>(guards: impl Iterator<Item = &'g Self>) -> Option<Self> {
        let mut left = vec![Cube { positive: 0, negative: 0 }];
        for cube in guards.flat_map(|guard| &guard.0) {
            left = left.into_iter().flat_map(|part| part.without(*cube)).collect();
            if left.len() > MAX_CUBES {
                return None;
            }
        }
        Some(Self(left))
    }

    /// Whether some letter satisfies both.
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.0.iter().any(|a| other.0.iter().any(|b| a.and(*b).is_some()))
    }

    pub(super) fn or(mut self, other: Self) -> Self {
        for cube in other.0 {
            if !self.0.contains(&cube) {
                self.0.push(cube);
            }
        }
        self
    }

    pub(super) fn and(&self, other: &Self) -> Option<Self> {
        let mut cubes = vec![];
        for a in &self.0 {
            for cube in other.0.iter().filter_map(|b| a.and(*b)) {
                if !cubes.contains(&cube) {
                    cubes.push(cube);
                }
            }
            if cubes.len() > MAX_CUBES {
                return None;
            }
        }
        Some(Self(cubes))
    }
}

impl Cube {
    fn and(self, other: Self) -> Option<Self> {
        let both =
            Self { positive: self.positive | other.positive, negative: self.negative | other.negative };
        (both.positive & both.negative == 0).then_some(both)
    }

    /// The parts of this cube that the other leaves: for each of its literals, what violates it and no earlier one.
    fn without(self, other: Self) -> Vec<Self> {
        if self.and(other).is_none() {
            return vec![self];
        }
        let (mut rest, mut parts) = (self, vec![]);
        let open = (other.positive | other.negative) & !(self.positive | self.negative);
        for bit in (0..64).map(|index| 1u64 << index).filter(|bit| open & bit != 0) {
            let (holds, fails) = (
                Self { positive: rest.positive | bit, ..rest },
                Self { negative: rest.negative | bit, ..rest },
            );
            let (kept, cut) = if other.positive & bit != 0 { (holds, fails) } else { (fails, holds) };
            parts.push(cut);
            rest = kept;
        }
        parts
    }
}
