//! Whether samples are fresh.

use super::NoiseSamples;
use std::collections::HashSet;

/// How many of `samples` are, number for number, among `used`, and how many one would expect of samples as coarse as
/// `used` are themselves: those of `used` that repeat an earlier one, in proportion.
///
/// Measured with many digits two samples hardly ever agree; rounded to few they often do.
pub fn overlap(samples: &NoiseSamples, used: &NoiseSamples) -> (usize, f64) {
    let key = |sample: &[f64]| sample.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
    let mut known = HashSet::with_capacity(used.len());
    let repeated = used.iter().filter(|sample| !known.insert(key(sample))).count();
    let common = samples.iter().filter(|sample| known.contains(&key(sample))).count();
    (common, repeated as f64 / used.len().max(1) as f64 * samples.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_noticed_and_coincidences_are_expected() {
        let used = NoiseSamples::new(1, vec![0.1, 0.2, 0.3, 0.1]);
        assert_eq!(overlap(&NoiseSamples::new(1, vec![0.3, 0.4]), &used), (1, 0.5));
        assert_eq!(overlap(&NoiseSamples::new(1, vec![0.5]), &used), (0, 0.25));
        let pairs = NoiseSamples::new(2, vec![1.0, 2.0]);
        assert_eq!(overlap(&NoiseSamples::new(2, vec![2.0, 1.0]), &pairs).0, 0);
    }
}
