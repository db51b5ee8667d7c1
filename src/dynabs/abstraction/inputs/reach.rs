//! Which intervals of the noise may matter on one coordinate of the lattice.

/// The intervals `lowest … highest`; those at the ends stand for everything beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Reach {
    pub(super) lowest: i64,
    pub(super) highest: i64,
    /// Whether whatever is at the ends or beyond leads out of the partition from every image.
    pub(super) leads_out: bool,
}

impl Reach {
    /// For images between two sub-cells and a partition of so many.
    pub(super) fn new((first, last): (i64, i64), sub_cells: i64, periodic: bool) -> Self {
        // Images that reach far beyond are as good as lost.
        let far = 4 * sub_cells + 16;
        if periodic {
            return Self { lowest: -far, highest: far, leads_out: false };
        }
        let leads_out = first >= -far && last <= far && first <= last;
        let (first, last) = (first.clamp(-far, far), last.clamp(-far, far));
        let (first, last) = (first.min(last), first.max(last));
        Self { lowest: -2 - last.max(0), highest: (sub_cells - first).max(0), leads_out }
    }

    /// Whether it is known what the interval `k` does.
    pub(super) fn is_known(&self, k: i64) -> bool {
        self.leads_out || (self.lowest < k && k < self.highest)
    }

    /// The first and the last of these.
    pub(super) fn known(&self) -> (i64, i64) {
        if self.leads_out { (self.lowest, self.highest) } else { (self.lowest + 1, self.highest - 1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_lead_out_of_the_partition() {
        let reach = Reach::new((-2, 7), 6, false);
        assert!(reach.leads_out && 7 + reach.lowest < -1 && -2 + reach.highest >= 6);
        assert!(!Reach::new((-2, 7), 6, true).leads_out);
        assert!(!Reach::new((-2, 1 << 50), 6, false).leads_out);
        assert!(!Reach::new((i64::MAX, i64::MIN), 6, false).is_known(1 << 40));
    }
}
