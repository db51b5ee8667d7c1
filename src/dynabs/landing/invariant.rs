//! Where one can stay for ever, whatever nature does.

use super::images::Images;
use super::side::Lower;
use super::step::Landing;
use super::taps::Taps;

impl Landing {
    /// 1 in the cells that some inputs never leave, 0 elsewhere; `note` is told an input for each.
    ///
    /// The greatest set `Z` of open cells such that for each there is an input under which all listed noise leads to
    /// `Z`, whatever its masses: nothing is certain unless the lists are complete. Masses do not matter, so they are
    /// taken as equal; a sum of them is 1 only if nothing is missing.
    pub(super) fn invariant(
        &self,
        images: &Images,
        open: &[u32],
        mut note: impl FnMut(u32, u32),
    ) -> Vec<f64> {
        let mut values = vec![0.0; self.num_cells()];
        let possible = self.axes().iter().map(|axis| axis.noise.as_ref().map(Taps::possible));
        let Some((equal, share)) = self.with_noise(possible) else { return values };
        open.iter().for_each(|&cell| values[cell as usize] = 1.0);
        // Half of what the loss of the rarest outcome would cost.
        let enough = 1.0 - 0.5 * share;
        loop {
            let best = equal.best::<Lower>(images, &values);
            let left: Vec<u32> = open
                .iter()
                .copied()
                .filter(|&cell| values[cell as usize] == 1.0 && best.values[cell as usize] < enough)
                .collect();
            if left.is_empty() {
                open.iter()
                    .filter(|&&c| values[c as usize] == 1.0)
                    .for_each(|&c| note(c, best.inputs[c as usize]));
                return values;
            }
            left.iter().for_each(|&cell| values[cell as usize] = 0.0);
        }
    }
}
