//! Whether a series of samples looks independent and identically distributed: no proof, but a reason to warn.

/// How many standard deviations a statistic must be away from what it should be: by chance, once in some 10⁷ of them.
const CLEARLY: f64 = 5.5;

/// Samples are compared with those that come up to so many later.
const LAGS: usize = 8;

/// The series is cut into so many blocks, each compared with all.
const BLOCKS: usize = 16;

/// How many samples decide what is small and large.
const SCALE_SAMPLES: usize = 1000;

/// A way in which samples do not look independent and identically distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// In which dimension.
    pub dimension: usize,
    /// Whether it shows in their distances from the median rather than in themselves.
    pub of_size: bool,
    /// What they do.
    pub trend: Trend,
    /// How many standard deviations the statistic is away from what it should be.
    pub deviations: f64,
}

/// What dependent samples do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trend {
    /// Rise or fall with time.
    Drift,
    /// Differ in one part of the series, given by its first and its last sample, counted from 1.
    Block {
        /// The first sample.
        first: usize,
        /// The last sample.
        last: usize,
    },
    /// Are correlated with those so many samples before.
    Lag(usize),
}

/// The clearest departure in each dimension of a series of `n`-dimensional samples, in which it is clear.
///
/// Every number is replaced by a bounded score, its distance from the median in units of the median distance, cut off
/// at ±3, and by the size of that, so that heavy tails do no harm. For independent samples the correlation of scores with
/// time, the mean of every block and the correlation with earlier scores are nearly normal with known variance.
pub fn departures(dimension: usize, values: &[f64]) -> Vec<Departure> {
    let clearest = |j: usize| {
        let column: Vec<f64> = values.iter().skip(j).step_by(dimension).copied().collect();
        let found = [false, true].into_iter().flat_map(|of_size| {
            let statistics = statistics(&scores(&column, of_size));
            statistics.into_iter().map(move |(trend, deviations)| Departure {
                dimension: j,
                of_size,
                trend,
                deviations: deviations.abs(),
            })
        });
        found.filter(|found| found.deviations > CLEARLY).max_by(|a, b| a.deviations.total_cmp(&b.deviations))
    };
    (0..dimension).filter_map(clearest).collect()
}

/// The centerd scores of a column.
fn scores(column: &[f64], of_size: bool) -> Vec<f64> {
    let step = column.len().div_ceil(SCALE_SAMPLES).max(1);
    let median_of = |values: &mut dyn Iterator<Item = f64>| {
        let mut values: Vec<f64> = values.collect();
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or_default()
    };
    let middle = median_of(&mut column.iter().step_by(step).copied());
    let spread = median_of(&mut column.iter().step_by(step).map(|x| (x - middle).abs()));
    let scale = spread.max(f64::MIN_POSITIVE);
    let score = |x: &f64| {
        let score = ((x - middle) / scale).clamp(-3.0, 3.0);
        if of_size { score.abs() } else { score }
    };
    let mut scores: Vec<f64> = column.iter().map(score).collect();
    let mean = scores.iter().sum::<f64>() / scores.len() as f64;
    scores.iter_mut().for_each(|score| *score -= mean);
    scores
}

/// All statistics of centerd scores, each divided by its standard deviation for independent samples.
fn statistics(scores: &[f64]) -> Vec<(Trend, f64)> {
    let number = scores.len() as f64;
    let squares: f64 = scores.iter().map(|score| score * score).sum();
    if squares <= 0.0 {
        return vec![];
    }
    let variance = squares / number;
    let middle = 0.5 * (number - 1.0);
    let times = || (0..scores.len()).map(|i| i as f64 - middle);
    let with_time: f64 = scores.iter().zip(times()).map(|(score, time)| score * time).sum();
    let time_squares: f64 = times().map(|time| time * time).sum();
    let mut all = vec![(Trend::Drift, with_time / (variance * time_squares).sqrt())];
    let length = scores.len() / BLOCKS;
    for block in (0..BLOCKS).filter(|_| length > 0) {
        let first = block * length;
        let sum: f64 = scores[first..first + length].iter().sum();
        let deviation = (variance * length as f64 * (1.0 - length as f64 / number)).sqrt();
        all.push((Trend::Block { first: first + 1, last: first + length }, sum / deviation));
    }
    for lag in (1..=LAGS).filter(|&lag| lag < scores.len()) {
        let products: f64 = scores.iter().zip(&scores[lag..]).map(|(early, late)| early * late).sum();
        all.push((Trend::Lag(lag), products / (variance * number.sqrt())));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha12Rng;
    use rand_distr::{Distribution, StandardNormal, StudentT};

    fn normal(number: usize, seed: u64) -> Vec<f64> {
        let rng = ChaCha12Rng::seed_from_u64(seed);
        StandardNormal.sample_iter(rng).take(number).collect()
    }

    #[test]
    fn independent_samples_are_left_in_peace() {
        for seed in 0..300 {
            for number in [1, 2, 17, 100, 1600] {
                assert_eq!(departures(1, &normal(number, seed)), []);
            }
            let heavy: Vec<f64> = StudentT::new(1.0)
                .unwrap()
                .sample_iter(ChaCha12Rng::seed_from_u64(seed))
                .take(1600)
                .collect();
            assert_eq!(departures(2, &heavy), []);
        }
        assert_eq!(departures(1, &[2.0; 500]), []);
        let mut outlier = vec![2.0; 500];
        outlier[3] = 1e155;
        assert_eq!(departures(1, &outlier), []);
    }

    #[test]
    fn a_slow_autoregression_is_noticed() {
        let mut x = 0.0;
        let series: Vec<f64> = (normal(1600, 1).into_iter())
            .map(|noise| {
                x = 0.98 * x + noise;
                x
            })
            .collect();
        let found = departures(1, &series);
        assert!(found[0].deviations > 30.0 && found[0].dimension == 0, "{found:?}");
    }

    #[test]
    fn warm_up_drift_and_changing_size_are_noticed() {
        let mut warm_up = normal(1600, 2);
        warm_up.iter_mut().take(60).for_each(|x| *x += 6.0);
        let found = departures(1, &warm_up);
        assert!(matches!(found[0].trend, Trend::Block { first: 1, last: 100 }), "{found:?}");

        let drift: Vec<f64> = normal(1600, 3).iter().enumerate().map(|(i, x)| x + 0.001 * i as f64).collect();
        assert_eq!(departures(1, &drift)[0].trend, Trend::Drift);

        let size: Vec<f64> = (normal(1600, 4).iter().enumerate())
            .map(|(i, x)| x * (1.0 + 2.0 * (i as f64 / 1600.0)))
            .collect();
        let found = departures(1, &size)[0];
        assert!(found.of_size && found.trend == Trend::Drift, "{found:?}");
    }
}
