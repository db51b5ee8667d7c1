//! The tables of a law, for C.

use super::c_text::{double, filled, list, rows};
use crate::controller::Controller;
use crate::controller::law::{CenteredLaw, Law, SteeringLaw};
use std::collections::BTreeMap;

/// The law of the actions.
pub(super) enum LawSource {
    /// Actions are targets.
    Steering(SteeringSource),
    /// Actions are inputs.
    Centered(CenteredSource),
}

/// The tables of targets, field by field as the template names them.
pub(super) struct SteeringSource {
    pub(super) constant: String,
    pub(super) target_gain: String,
    pub(super) state_gain: String,
    pub(super) num_targets: usize,
    pub(super) target: String,
}

/// The tables of inputs, field by field as the template names them.
pub(super) struct CenteredSource {
    pub(super) array_inputs: usize,
    pub(super) period: String,
    pub(super) num_centers: usize,
    pub(super) centers: String,
    pub(super) num_nominal: usize,
    pub(super) nominal: String,
    pub(super) gain: String,
}

impl LawSource {
    /// The tables of a controller's law, and its actions as they number them, entry after entry.
    pub(super) fn new(controller: &Controller) -> (Self, Vec<u32>) {
        let actions = controller.schedule.entries.iter().map(|entry| entry.action);
        match &controller.law {
            Law::Steering(law) => {
                // Only the targets that are used.
                let mut number: BTreeMap<u32, u32> = actions.clone().map(|action| (action, 0)).collect();
                number.values_mut().zip(0..).for_each(|(number, i)| *number = i);
                let used: Vec<&[f64]> = number.keys().map(|&target| controller.action(target)).collect();
                let source = SteeringSource::new(law, &used, controller.state_dimension());
                (Self::Steering(source), actions.map(|action| number[&action]).collect())
            }
            Law::Centered(law) => (Self::Centered(CenteredSource::new(law, controller)), actions.collect()),
        }
    }
}

impl SteeringSource {
    fn new(law: &SteeringLaw, targets: &[&[f64]], n: usize) -> Self {
        let none = vec![0.0; n];
        let targets = filled(targets.to_vec(), &none);
        Self {
            constant: list(law.constant.iter().map(double)),
            target_gain: rows(&law.target_gain, n),
            state_gain: rows(&law.state_gain, n),
            num_targets: targets.len(),
            target: rows(&targets.concat(), n),
        }
    }
}

impl CenteredSource {
    fn new(law: &CenteredLaw, controller: &Controller) -> Self {
        let (n, p) = (controller.state_dimension(), law.inputs);
        let padded = |table: &[f64], width: usize| rows(&filled(table.to_vec(), 0.0), width.max(1));
        Self {
            array_inputs: p.max(1),
            period: list(controller.periods.lengths.iter().map(double)),
            num_centers: law.centers.iter().map(Vec::len).sum(),
            centers: list(law.centers.iter().flatten().map(double)),
            num_nominal: (law.nominal.len() / p.max(1)).max(1),
            nominal: padded(&law.nominal, p),
            gain: padded(law.feedback.nearest_gain(), if p == 0 { 1 } else { n }),
        }
    }
}
