//! Choices among samples that must not depend on what they are: fixed pseudo-random ones.
//!
//! Not the first samples: those of a warm-up phase would mislead. And nothing that a user can choose.

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::collections::BTreeSet;

/// The seed, for nothing else.
const SEED: [u8; 32] = *b"dynabs: shape samples, and ties.";

/// At most this many samples decide about the proportions: enough for their order of magnitude.
const SHAPE_SAMPLES: usize = 48;

/// And at most this part of all samples.
const SHAPE_PART: usize = 16;

/// How many of `samples` samples decide about the proportions.
pub(in super::super) fn shape_samples(samples: usize) -> usize {
    SHAPE_SAMPLES.min(samples / SHAPE_PART)
}

/// Which of `samples` samples decide about the proportions, ascending: any set of their number with the same chance.
///
/// R. Floyd's algorithm (Bentley, *Comm. ACM* 30, 1987).
pub(super) fn shape_members(samples: usize) -> Vec<usize> {
    let mut random = stream(0);
    let mut members = BTreeSet::new();
    for last in samples - shape_samples(samples)..samples {
        let any = (random.next_u64() % (last as u64 + 1)) as usize;
        members.insert(if members.contains(&any) { last } else { any });
    }
    members.into_iter().collect()
}

/// A number for every sample, to tell equal distances apart.
pub(super) fn ties(samples: usize) -> Vec<u64> {
    let mut random = stream(1);
    (0..samples).map(|_| random.next_u64()).collect()
}

fn stream(number: u64) -> ChaCha12Rng {
    let mut random = ChaCha12Rng::from_seed(SEED);
    random.set_stream(number);
    random
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_spread_over_the_samples() {
        for samples in [0, 15, 16, 100, 1600, 1_000_000] {
            let members = shape_members(samples);
            assert_eq!(members.len(), shape_samples(samples));
            assert!(members.iter().all(|&i| i < samples) && members.is_sorted());
        }
        let members = shape_members(1600);
        let early = members.iter().filter(|&&i| i < 800).count();
        assert!((12..=36).contains(&early), "{early}");
    }
}
