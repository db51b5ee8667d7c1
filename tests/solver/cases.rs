//! Models whose values are known by hand.

use super::models::{model, set};
use super::*;
use imdp::model::{RowId, StateId};

fn values(solution: &Solution, state: usize) -> (f64, f64) {
    (solution.values.lower[state], solution.values.upper[state])
}

#[test]
fn nature_may_refuse_to_move() {
    // 0 → goal 1 with [0, 1], itself with [0, 1].
    let m = model(&[vec![(0, 0.0, 1.0), (1, 0.0, 1.0)]], &[Some(vec![(0, 0)]), None]);
    let (safe, goal) = (set(2, &[0, 1]), set(2, &[1]));
    for (resolution, expected) in [
        (Resolution::Pmaxmin, 0.0),
        (Resolution::Pmaxmax, 1.0),
        (Resolution::Pminmin, 0.0),
        (Resolution::Pminmax, 1.0),
    ] {
        let solution = until(&m, &safe, &goal, None, resolution);
        assert_eq!(values(&solution, 0), (expected, expected), "{resolution}");
    }
}

#[test]
fn slow_chains_are_right_not_early() {
    // Leaves with 1e-6 per step, half of it to the goal.
    let m = model(
        &[vec![(0, 0.999999, 0.999999), (1, 5e-7, 5e-7), (2, 5e-7, 5e-7)]],
        &[Some(vec![(0, 0)]), None, None],
    );
    let (safe, goal) = (set(3, &[0, 1, 2]), set(3, &[1]));
    for (resolution, _) in RESOLUTIONS {
        let solution = until(&m, &safe, &goal, None, resolution);
        let (lower, upper) = values(&solution, 0);
        assert!(lower <= 0.5 && 0.5 <= upper && upper - lower <= 1e-6, "{lower} {upper}");
        assert_eq!(solution.status, Status::Converged);
        assert!(solution.iterations < 20_000, "{} iterations", solution.iterations);
    }
}

#[test]
fn slow_walks_converge() {
    // A symmetric walk over 60 states with a small chance to be lost: values from 1 down, slow mixing.
    let n = 60u32;
    let rows: Vec<_> = (0..n)
        .map(|i| {
            let (left, right) = (if i == 0 { 0 } else { i - 1 }, i + 1);
            let mut row = vec![(left, 0.4999, 0.49995), (right, 0.4999, 0.5), (n + 1, 0.0001, 0.0001)];
            if i == n - 1 {
                row[1].0 = n;
            }
            row.sort_by_key(|entry| entry.0);
            row
        })
        .collect();
    let mut states: Vec<_> = (0..n).map(|i| Some(vec![(i, i)])).collect();
    states.extend([None, None]);
    let m = model(&rows, &states);
    let all: Vec<usize> = (0..n as usize + 2).collect();
    let (safe, goal) = (set(all.len(), &all), set(all.len(), &[n as usize]));
    for (resolution, _) in RESOLUTIONS {
        let solution = until(&m, &safe, &goal, None, resolution);
        assert_eq!(solution.status, Status::Converged, "{resolution} {}", solution.iterations);
        println!("walk {resolution}: {} iterations", solution.iterations);
    }
}

#[test]
fn end_components_of_nature_are_levelled() {
    // 0 ⇄ 1 for ever if nature likes, or out with [0, 0.5]: goal 2 and fail 3 half and half.
    let m = model(
        &[
            vec![(1, 0.5, 1.0), (2, 0.0, 0.2), (3, 0.1, 0.3)],
            vec![(0, 0.0, 1.0), (1, 0.0, 1.0), (3, 0.0, 0.1)],
        ],
        &[Some(vec![(0, 0)]), Some(vec![(1, 1)]), None, None],
    );
    let (safe, goal) = (set(4, &[0, 1, 2, 3]), set(4, &[2]));
    let exact = reference::unbounded(&m, &safe, &goal);
    for ((resolution, _), exact) in RESOLUTIONS.into_iter().zip(exact) {
        let solution = until(&m, &safe, &goal, None, resolution);
        assert_bracketed(&solution.values, &exact.into_iter().map(big).collect::<Vec<_>>(), "level");
        assert_eq!(solution.status, Status::Converged, "{resolution} {solution:?}");
    }
}

#[test]
fn sums_are_decided_on_decimals() {
    // Upper bounds outside the goal are 0.1 + 0.2 + 0.7 = 1: nature can avoid it, though the doubles
    // leave 1e-16.
    let m = model(
        &[vec![(0, 0.0, 0.1), (1, 0.0, 0.2), (2, 0.0, 0.7), (3, 0.0, 1.0)]],
        &[Some(vec![(0, 0)]), Some(vec![(0, 0)]), Some(vec![(0, 0)]), None],
    );
    let (safe, goal) = (set(4, &[0, 1, 2, 3]), set(4, &[3]));
    let solution = until(&m, &safe, &goal, None, Resolution::Pmaxmin);
    assert_eq!(values(&solution, 0), (0.0, 0.0));
    let solution = until(&m, &safe, &goal, None, Resolution::Pmaxmax);
    assert_eq!(values(&solution, 0), (1.0, 1.0));
}

#[test]
fn long_chains_take_one_pass() {
    let n = 50_000u32;
    let rows: Vec<_> = (0..n).map(|i| vec![(i + 1, 0.9999, 1.0), (n + 1, 0.0, 0.0001)]).collect();
    let mut states: Vec<_> = (0..n).map(|i| Some(vec![(i, i)])).collect();
    states.extend([None, None]);
    let m = model(&rows, &states);
    let all: Vec<usize> = (0..n as usize + 2).collect();
    let solution =
        until(&m, &set(all.len(), &all), &set(all.len(), &[n as usize]), None, Resolution::Pmaxmin);
    assert_eq!(solution.status, Status::Converged);
    assert_eq!(solution.iterations, 0);
    assert!((solution.values.lower[0] - 0.9999f64.powi(n as i32)).abs() < 1e-9);
}

#[test]
fn limits_leave_sound_bounds() {
    let m =
        model(&[vec![(0, 0.9, 0.9), (1, 0.05, 0.05), (2, 0.05, 0.05)]], &[Some(vec![(0, 0)]), None, None]);
    let (safe, goal) = (set(3, &[0, 1, 2]), set(3, &[1]));
    for steps in [None, Some(100)] {
        let options = SolverOptions { max_iterations: 3, ..Default::default() };
        let query = Event::Until { safe: &safe, goal: &goal, steps };
        let solution = solve(&m, &query, Resolution::Pmaxmin, &options).unwrap();
        assert_eq!(solution.status, Status::IterationLimit);
        let (lower, upper) = values(&solution, 0);
        assert!(lower < 0.5 && (0.5..=1.0).contains(&upper));
        let flag = std::sync::atomic::AtomicBool::new(true);
        let options = SolverOptions { progress: &flag, ..Default::default() };
        let solution = solve(&m, &query, Resolution::Pmaxmin, &options).unwrap();
        assert_eq!(solution.status, Status::Interrupted);
    }
    let query = Event::Until { safe: &safe, goal: &set(2, &[1]), steps: None };
    assert!(solve(&m, &query, Resolution::Pmaxmin, &SolverOptions::default()).is_err());
}

#[test]
fn a_policy_says_what_to_do_after_so_many_steps() {
    // Choice 0 reaches the goal with 0.5 at once; choice 1 leads to 1, from where it is 0.9.
    let m = model(
        &[vec![(2, 0.5, 0.6), (3, 0.4, 0.5)], vec![(1, 1.0, 1.0)], vec![(2, 0.9, 1.0), (3, 0.0, 0.1)]],
        &[Some(vec![(0, 1)]), Some(vec![(2, 2)]), None, None],
    );
    let (safe, goal) = (set(4, &[0, 1, 2, 3]), set(4, &[2]));
    let solution = until(&m, &safe, &goal, Some(5), Resolution::Pmaxmin);
    let policy = solution.policy.unwrap();
    assert_eq!(
        (0..6).map(|k| policy.choice(StateId(0), k)).collect::<Vec<_>>(),
        [Some(1), Some(1), Some(1), Some(1), Some(0), None]
    );
    assert_eq!(policy.row(m.choices(), StateId(0), 0), Some(RowId(1)));
    assert_eq!(policy.choice(StateId(2), 0), None);
    assert_eq!(solution.iterations, 3);
}

#[test]
fn rows_that_only_rounding_makes_impossible_are_bracketed_like_their_neighbours() {
    // As decimals the lower bounds exceed 1 by 1e-16, the upper bounds miss it by 1e-16.
    let m = model(
        &[
            vec![(1, 0.3333333333333334, 0.5), (2, 0.3333333333333333, 0.5), (3, 0.3333333333333334, 0.5)],
            vec![(0, 0.0, 0.3333333333333333), (1, 0.1, 0.3333333333333333), (2, 0.0, 0.3333333333333333)],
        ],
        &[Some(vec![(0, 0)]), Some(vec![(1, 1)]), None, None],
    );
    let (safe, goal) = (set(4, &[0, 1, 2, 3]), set(4, &[2]));
    for (resolution, _) in RESOLUTIONS {
        for steps in [Some(0), Some(3), None] {
            let solution = until_uncertified(&m, &safe, &goal, steps, resolution);
            assert!(
                solution.values.gap() <= 1e-6
                    && solution.values.lower.iter().all(|v| (0.0..=1.0).contains(v))
            );
        }
    }
}

#[test]
fn several_slow_parts_share_epsilon() {
    // Twenty slow loops in a row, each losing a little: the bounds of all must meet.
    let n = 20u32;
    let rows: Vec<_> =
        (0..n).map(|i| vec![(i, 0.99, 0.999), (i + 1, 0.0009, 0.01), (n + 1, 0.0, 0.0001)]).collect();
    let mut states: Vec<_> = (0..n).map(|i| Some(vec![(i, i)])).collect();
    states.extend([None, None]);
    let m = model(&rows, &states);
    let all: Vec<usize> = (0..n as usize + 2).collect();
    let (safe, goal) = (set(all.len(), &all), set(all.len(), &[n as usize]));
    for (resolution, (_, nature_max)) in RESOLUTIONS {
        let solution = until(&m, &safe, &goal, None, resolution);
        assert_eq!(solution.status, Status::Converged, "{resolution}");
        let exact = if nature_max { 1.0 } else { 0.9f64.powi(n as i32) };
        let (lower, upper) = values(&solution, 0);
        assert!(lower <= exact + 1e-12 && exact - 1e-12 <= upper, "{resolution} {lower} {exact} {upper}");
    }
}

#[test]
fn loops_without_a_local_leak_converge() {
    // State 0 only hands on to 2, which leaves with one half: no single step shrinks the distance.
    let m = model(
        &[
            vec![(0, 0.5, 0.5), (1, 0.5, 0.5)],
            vec![(3, 0.0, 0.002), (4, 0.999, 0.9999)],
            vec![(0, 0.0, 0.002), (3, 0.999, 0.9999)],
            vec![(2, 0.0, 1.0)],
        ],
        &[Some(vec![(2, 3)]), Some(vec![(1, 2)]), Some(vec![(2, 2), (0, 0)]), None, None],
    );
    let (safe, goal) = (set(5, &[0, 1, 2, 3, 4]), set(5, &[3]));
    for (resolution, _) in RESOLUTIONS {
        let solution = until(&m, &safe, &goal, None, resolution);
        assert_eq!(solution.status, Status::Converged, "{resolution} {solution:?}");
    }
}
