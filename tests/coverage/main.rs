//! The guarantee itself: over many sample sets from known distributions, the claims hold as often as promised.
#![allow(missing_docs, clippy::unwrap_used)]

mod families;
mod models;

use dynabs::abstraction::{Abstraction, compile};
use dynabs::spec::Problem;
use dynabs::statistics::unseen_mass;
use families::Failures;
use models::{BETA, Case, Truth};

const REPLICATIONS: u64 = 300;
/// Allowance for the rounding of distribution functions.
const ROUNDING: f64 = 1e-12;

/// Four standard deviations of the observed frequency of an event with this probability.
fn noise(probability: f64, replications: u64) -> f64 {
    4.0 * (probability * (1.0 - probability) / replications as f64).sqrt()
}

/// Whether some row excludes the true distribution, if `failed` gets this much less than the row says.
fn is_violated(problem: &Problem, abstraction: &Abstraction, truths: &[Truth], less: f64) -> bool {
    abstraction.model.rows().iter().zip(truths).any(|(row, truth)| {
        let probabilities = truth.over(&row, problem, abstraction);
        (0..row.len()).any(|i| {
            let upper = if row.successors[i] == 0 { row.upper[i] - less } else { row.upper[i] };
            probabilities[i] < row.lower[i] - ROUNDING || probabilities[i] > upper + ROUNDING
        })
    })
}

#[test]
fn all_rows_hold_together_as_often_as_promised() {
    let directory = tempfile::tempdir().unwrap();
    for case in Case::all() {
        let (mut violated, mut without_unseen) = (0, 0);
        let (mut families, mut one_by_one) = (Failures::default(), Failures::default());
        for seed in 0..REPLICATIONS {
            let problem = case.problem(directory.path(), seed);
            let abstraction = compile(&problem, &()).unwrap();
            let targets: Vec<Vec<f64>> = (0..abstraction.targets.len())
                .map(|target| {
                    let mut point = vec![0.0; problem.grid.dimension()];
                    abstraction.targets.point(target, &mut point);
                    point
                })
                .collect();
            let truths: Vec<Truth> = targets.iter().map(|d| case.truth(&problem, d)).collect();
            let guarantee = abstraction.guarantee.as_ref().unwrap();
            violated += u64::from(is_violated(&problem, &abstraction, &truths, 0.0));
            without_unseen += u64::from(is_violated(&problem, &abstraction, &truths, guarantee.unseen_mass));
            let levels = [0, 1, 2].map(|family| guarantee.budget[family].level);
            families.add(&problem, &targets, &truths, levels);
            // Two-sided events at level β each, without the union bound.
            one_by_one.add(&problem, &targets, &truths, [BETA / 2.0, BETA / 2.0, BETA]);
        }
        let rate = |count: u64| count as f64 / REPLICATIONS as f64;
        println!(
            "{}: {violated} of {REPLICATIONS} violated, families {families:?}; without union bound \
             {one_by_one:?}, without unseen mass {without_unseen}",
            case.name
        );
        assert!(rate(violated) <= BETA, "{}: {violated} violated", case.name);
        let budgets = [0.45, 0.2, 0.1].map(|share| share * BETA);
        for (count, budget) in families.counts().into_iter().zip(budgets) {
            assert!(rate(count) <= budget + noise(budget, REPLICATIONS), "{}: {families:?}", case.name);
        }
        // Controls: the test does notice broken promises.
        assert!(rate(one_by_one.any) > 2.0 * BETA, "{}: {one_by_one:?}", case.name);
        assert!(rate(without_unseen) > 0.95, "{}: {without_unseen} without unseen mass", case.name);
    }
}

#[test]
fn unseen_mass_fails_as_often_as_its_level_in_one_dimension() {
    // For a continuous distribution on the line, P(W) ~ Beta(N − 1, 2) exactly.
    let (case, level, replications) = (&Case::all()[0], 0.25 * BETA, 4000u64);
    let bound = unseen_mass(1, case.draw(0).len() as u64, level);
    let failures = (0..replications).filter(|&seed| case.unseen(&case.draw(seed)) > bound).count();
    let rate = failures as f64 / replications as f64;
    println!("unseen mass above its bound in {failures} of {replications}, level {level}");
    assert!((rate - level).abs() <= noise(level, replications), "{rate}");
}

#[test]
fn unseen_mass_fails_at_most_as_often_as_its_level_in_the_plane() {
    let (case, level, replications) = (&Case::all()[2], 0.25 * BETA, 2000u64);
    let bound = unseen_mass(2, case.draw(0).len() as u64, level);
    let failures = (0..replications).filter(|&seed| case.unseen(&case.draw(seed)) > bound).count();
    println!("unseen mass above its bound in {failures} of {replications}, level {level}");
    let rate = failures as f64 / replications as f64;
    assert!(rate <= level + noise(level, replications) && rate > 0.0, "{rate}");
}
