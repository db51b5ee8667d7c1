//! Where one can stay for ever, whatever nature does.

use super::side::Lower;
use super::solve::Question;
use super::taps::Taps;

impl Question<'_> {
    /// 1 for the memories and cells that some inputs keep for ever in what the task asks for, 0 elsewhere; `note` is told
    /// an input for each.
    ///
    /// The greatest set `Z` of open pairs such that for each there is an input under which all listed noise leads to
    /// `Z`, whatever its masses: nothing is certain unless the lists are complete. Masses do not matter, so they are
    /// taken as equal; a sum of them is 1 only if nothing is missing.
    pub(super) fn invariant(&self, pairs: &[Vec<u32>], mut note: impl FnMut(u32, u32)) -> Vec<f64> {
        let cells = self.task.num_cells();
        let mut values = vec![0.0; pairs.len() * cells];
        let possible = self.landing.axes().iter().map(|axis| axis.noise.as_ref().map(Taps::possible));
        let Some((equal, share)) = self.landing.with_noise(possible) else { return values };
        let open = || {
            (0..).zip(pairs).flat_map(|(memory, open)| open.iter().map(move |&cell| (memory, cell as usize)))
        };
        open().for_each(|(memory, cell)| values[memory * cells + cell] = 1.0);
        // Half of what the loss of the rarest outcome would cost.
        let enough = 1.0 - 0.5 * share;
        loop {
            let best = self.step::<Lower>(&equal, &values);
            let kept = |&(memory, cell): &(usize, usize)| values[memory * cells + cell] == 1.0;
            let left: Vec<_> =
                open().filter(kept).filter(|&(memory, cell)| best[memory].values[cell] < enough).collect();
            if left.is_empty() {
                open().filter(kept).for_each(|(memory, cell)| {
                    note((memory * cells + cell) as u32, best[memory].inputs[cell])
                });
                return values;
            }
            left.iter().for_each(|&(memory, cell)| values[memory * cells + cell] = 0.0);
        }
    }
}
