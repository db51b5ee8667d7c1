//! The tables of a law.

use super::table::Table;
use crate::controller::Controller;
use crate::controller::law::Law;
use std::collections::BTreeSet;

/// The actions that the schedule takes, ascending: only these are in the tables.
pub(super) fn used(controller: &Controller) -> Vec<u32> {
    let actions: BTreeSet<u32> = controller.schedule.entries.iter().map(|entry| entry.action).collect();
    actions.into_iter().collect()
}

/// The tables with which an action and a state give inputs.
pub(super) fn law_tables(controller: &Controller, used: &[u32]) -> Vec<Table> {
    let (n, inputs) = (controller.state_dimension(), controller.inputs());
    let of_actions = |width| {
        let numbers = used.iter().flat_map(|&action| controller.action(action)).copied().collect();
        ([used.len(), width], numbers)
    };
    match &controller.law {
        Law::Steering(law) => {
            let (shape, points) = of_actions(n);
            vec![
                Table::matrix("target", shape, points),
                Table::doubles("constant", law.constant.clone()),
                Table::matrix("target_gain", [inputs, n], law.target_gain.clone()),
                Table::matrix("state_gain", [inputs, n], law.state_gain.clone()),
            ]
        }
        Law::Centered(law) => {
            let (shape, nominal) = of_actions(inputs);
            vec![
                Table::doubles("period", controller.periods.lengths.clone()),
                Table::doubles("centers", law.centers.concat()),
                Table::matrix("nominal", shape, nominal),
                Table::matrix("gain", [inputs, n], law.feedback.nearest_gain().to_vec()),
            ]
        }
    }
}
