//! Shipped models: both modes, with and without a bound on the steps.

use crate::common::certified::certified;
use crate::common::{abstraction, reference_mode, shipped_models};
use imdp::property::{Property, Resolution};
use imdp::solver::{SolverOptions, Status};
use std::sync::atomic::AtomicBool;

#[test]
fn shipped_models_are_certified_in_both_modes() {
    for name in shipped_models() {
        for sets in [vec![], vec![reference_mode()]] {
            let compiled = abstraction(&name, &sets);
            certified(&compiled.model, &compiled.property, &SolverOptions::default());
        }
    }
}

#[test]
fn unbounded_properties_of_shipped_models_are_certified() {
    for name in ["room_temperature", "spacecraft_aligned_two_layer", "double_integrator_two_layer"] {
        let compiled = abstraction(name, &[]);
        for resolution in Resolution::ALL {
            for path in ["!\"failed\" U \"reached\"", "G !\"failed\""] {
                let property: Property = format!("{resolution}=? [ {path} ]").parse().unwrap();
                certified(&compiled.model, &property, &SolverOptions::default());
            }
        }
    }
}

#[test]
fn interrupted_computations_are_certified_as_far_as_they_went() {
    let compiled = abstraction("room_temperature", &[]);
    let flag = AtomicBool::new(true);
    for resolution in Resolution::ALL {
        for path in ["!\"failed\" U<=6 \"reached\"", "!\"failed\" U \"reached\"", "G<=5 x1<30"] {
            let property: Property = format!("{resolution}=? [ {path} ]").parse().unwrap();
            for max_iterations in [0, 1, 3] {
                let options = SolverOptions { max_iterations, ..Default::default() };
                certified(&compiled.model, &property, &options);
            }
            let options = SolverOptions { progress: &flag, ..Default::default() };
            let (answer, _) = certified(&compiled.model, &property, &options);
            assert_ne!(answer.solution.status, Status::HorizonReached);
        }
    }
}
