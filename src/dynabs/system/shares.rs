//! How inputs share what is to be done, and the search for a better way.

/// Rounds in which every input is thought over; mostly a few change anything.
const ROUNDS: usize = 12;
/// What the weight of an input is multiplied by: 0 leaves it where it is.
const FACTORS: [f64; 7] = [0.0, 0.25, 0.5, 0.8, 1.25, 2.0, 4.0];
/// Where in its range, from −1 to 1, an input may be when nothing is demanded.
const SHIFTS: [f64; 17] = [
    -1.0, -0.875, -0.75, -0.625, -0.5, -0.375, -0.25, -0.125, 0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75,
    0.875, 1.0,
];
/// A smaller gain than this is not worth a law that is harder to read.
const WORTH_IT: f64 = 1.02;
/// What rounding may change; more than that is a difference.
const TOLERANCE: f64 = 1e-9;

/// How inputs share what is to be done: by the squares of their ranges, times weights, about a point in these ranges.
#[derive(Clone, Debug, PartialEq)]
pub struct Shares {
    /// Per input, its weight.
    pub(super) weights: Vec<f64>,
    /// Per input, where it is when nothing is demanded, from −1 at the lower to 1 at the upper end of its range.
    pub(super) shifts: Vec<f64>,
}

impl Shares {
    /// Equal weights, about the middle.
    pub(super) fn even(inputs: usize) -> Self {
        Self { weights: vec![1.0; inputs], shifts: vec![0.0; inputs] }
    }

    /// Others that are clearly worth more, if there are some: one input is changed at a time, as long as anybody says what that
    /// would be worth.
    pub(crate) fn improved(&self, mut worth: impl FnMut(&Self) -> Option<f64>) -> Self {
        let Some(first) = worth(self) else { return self.clone() };
        let (mut best, mut most) = (self.clone(), first);
        'rounds: for _ in 0..ROUNDS {
            let before = most;
            for i in 0..self.weights.len() {
                for other in best.neighbours(i) {
                    let Some(worth) = worth(&other) else { break 'rounds };
                    if worth > most + TOLERANCE {
                        (best, most) = (other, worth);
                    }
                }
            }
            if most <= before + TOLERANCE {
                break;
            }
        }
        if most > WORTH_IT * first.max(0.0) { best } else { self.clone() }
    }

    /// The same with another weight, or another shift, of one input.
    fn neighbours(&self, i: usize) -> Vec<Self> {
        let of_weights = FACTORS.iter().map(|factor| {
            let mut other = self.clone();
            other.weights[i] *= factor;
            other
        });
        let of_shifts = SHIFTS.iter().map(|&shift| {
            let mut other = self.clone();
            other.shifts[i] = shift;
            other
        });
        of_weights.chain(of_shifts).collect()
    }
}
