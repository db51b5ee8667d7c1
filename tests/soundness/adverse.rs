//! Models on which plain iteration hardly moves.

use super::model;
use crate::common::certified::certified;
use imdp::property::{Property, Resolution};
use imdp::solver::{Answer, SolverOptions, Status};

/// The probability to win from the middle of `n`, with `odds` against the player in every round.
fn ruin(n: i32, odds: f64) -> f64 {
    (1.0 - odds.powi(n / 2)) / (1.0 - odds.powi(n))
}

#[test]
fn bounds_meet_however_slow_the_model_is() {
    // With so many steps to be expected nothing is left of what a sweep gains: 10⁵, 2²¹, 2³¹, 10⁹, 10¹⁴.
    for (name, minimum, maximum) in [
        ("walk200", ruin(200, 0.55 / 0.45), ruin(200, 0.45 / 0.55)),
        ("walk700", 0.0, 1.0),
        ("reset20", 0.3, 0.3),
        ("reset30", 0.3, 0.3),
        ("leak", 1.0 / 1001.0, 1000.0 / 1001.0),
        ("exit1e-14", 1e-14, 1.0),
    ] {
        let model = model(&format!("adv/{name}.tra")).model;
        for resolution in Resolution::ALL {
            let property: Property = format!("{resolution}=? [ F \"g\" ]").parse().unwrap();
            let (answer, _) = certified(&model, &property, &SolverOptions::default());
            let expected = if resolution.nature_maximises() { maximum } else { minimum };
            let (lower, upper) = (answer.lower, answer.upper);
            assert!(upper - lower <= 1e-6, "{name} {property}: [{lower:?}, {upper:?}]");
            assert!(
                lower <= expected + 1e-12 && expected <= upper + 1e-12,
                "{name} {property}: {expected:?} is not in [{lower:?}, {upper:?}]"
            );
            assert_eq!(answer.solution.status, Status::Converged, "{name} {property}");
        }
    }
}

/// The value differs from 1 by 10⁻³⁰, and has more digits than exact arithmetic should be asked for.
#[test]
fn one_is_told_from_almost_one() {
    let model = model("adv/walk700.tra").model;
    let options = SolverOptions { exact_work: 1 << 20, ..SolverOptions::default() };
    for (text, holds) in [
        ("(Pmaxmax=? [ F \"g\" ])>=1", false),
        ("(Pmaxmax=? [ F \"g\" ])<1", true),
        ("(Pmaxmin=? [ F \"g\" ])>0", true),
        ("(Pmaxmin=? [ G !\"g\" ])>0", true),
        ("(Pmaxmax=? [ F<=349 \"g\" ])>0", false),
        ("(Pmaxmax=? [ F<=350 \"g\" ])<=0", false),
    ] {
        let property: Property = text.parse().unwrap();
        let answer = Answer::new(&model, &property, &options).unwrap();
        assert_eq!((answer.satisfied(), answer.inexact), (Some(holds), None), "{text}");
    }
}
