//! The values of earlier steps.

use std::collections::VecDeque;

/// The bounds that the policy guarantees before each of the last steps taken.
pub(super) struct History {
    wanted: usize,
    /// The latest last.
    kept: VecDeque<Vec<f64>>,
}

impl History {
    /// Keeps those before so many steps.
    pub(super) fn new(wanted: usize) -> Self {
        Self { wanted, kept: VecDeque::new() }
    }

    /// Notes the values before another step.
    pub(super) fn keep(&mut self, values: &[f64]) {
        if self.wanted == 0 {
            return;
        }
        if self.kept.len() == self.wanted {
            self.kept.pop_front();
        }
        self.kept.push_back(values.to_vec());
    }

    /// The values with `horizon − 1`, `horizon − 2`, … steps, if after `taken` of them nothing changes any more.
    pub(super) fn finish(self, last: &[f64], horizon: u64, taken: u64) -> Vec<Vec<f64>> {
        let steps = (0..horizon).rev().take(self.wanted);
        let values = steps.map_while(|steps| match taken.checked_sub(steps) {
            None | Some(0) => Some(last.to_vec()),
            Some(ago) => {
                let index = self.kept.len().checked_sub(usize::try_from(ago).ok()?)?;
                self.kept.get(index).cloned()
            }
        });
        values.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::History;

    #[test]
    fn steps_are_counted_from_the_horizon() {
        let history = |wanted, taken: u64| {
            let mut history = History::new(wanted);
            (0..taken).for_each(|k| history.keep(&[k as f64]));
            history
        };
        assert_eq!(history(3, 5).finish(&[5.0], 5, 5), [[4.0], [3.0], [2.0]]);
        assert_eq!(history(3, 5).finish(&[5.0], 6, 5), [[5.0], [4.0], [3.0]]);
        assert_eq!(history(3, 5).finish(&[5.0], 100, 5), [[5.0], [5.0], [5.0]]);
        assert_eq!(history(9, 2).finish(&[2.0], 2, 2), [[1.0], [0.0]]);
        assert!(history(0, 2).finish(&[2.0], 2, 2).is_empty());
    }
}
