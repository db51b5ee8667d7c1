//! What a user should know although nothing is wrong for certain.

use crate::partition::NearMiss;
use crate::statistics::{Departure, Trend};
use crate::system::GroupingTrial;
use imdp::numeric::{shortest_decimal, to_f64};
use std::fmt;

/// Something to be aware of.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// A face of a region is next to a face of the grid.
    NearMiss {
        /// The place of the list of regions in the model file.
        list: String,
        /// Which face.
        miss: NearMiss,
    },
    /// The horizon is no whole number of groups.
    CutHorizon {
        /// The horizon in original steps.
        steps: u64,
        /// How many of them the guarantee is for.
        used: u64,
        /// How many steps are grouped.
        group_steps: usize,
    },
    /// More steps are grouped than it takes to reach every direction.
    Grouped {
        /// How many.
        steps: usize,
        /// What fewer could do.
        fewest: GroupingTrial,
    },
    /// The lower layer does not stabilise.
    Unstable {
        /// The spectral radius of the closed loop.
        radius: f64,
    },
    /// `−K(x − x̄)` leaves `U` on the partition.
    GainLeavesInput {
        /// The worst left-hand side of a half-space of `U`.
        worst: f64,
        /// Its offset.
        offset: f64,
    },
    /// Some inputs leave no room for the local feedback.
    UnusedInputs {
        /// How many.
        unused: usize,
        /// Of how many.
        inputs: usize,
    },
    /// Samples at the end of a file do not fill a group.
    LeftOverSamples {
        /// The file, or the place in the problem.
        source: String,
        /// How many.
        left_over: usize,
        /// Of how many.
        samples: usize,
        /// How many steps are grouped.
        group_steps: usize,
    },
    /// The samples of a file do not look independent and identically distributed.
    NotIndependent {
        /// The file, or the place in the problem.
        source: String,
        /// How they depart from it.
        departure: Departure,
    },
    /// Samples that decided about the proportions of windows lie outside them more often than the bound allows.
    ContradictedWindows {
        /// How many of these samples lie outside.
        outside: u64,
        /// How many there are.
        number: u64,
        /// The bound on the mass outside.
        unseen: f64,
    },
    /// No action is enabled in some ordinary cells.
    NothingEnabled {
        /// In how many.
        cells: usize,
        /// How many ordinary cells there are.
        ordinary: usize,
    },
    /// The initial state is in an unsafe cell.
    UnsafeStart,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NearMiss { list, miss } => write!(
                f,
                "{list}/{}: the face at {} in dimension {} is {:.1e} cell widths from the grid face {} but not on \
                 it; if they are meant to coincide, write the same number",
                miss.region,
                shortest_decimal(miss.face),
                miss.dimension + 1,
                miss.distance,
                shortest_decimal(to_f64(&miss.grid_face)),
            ),
            Self::CutHorizon { steps, used, group_steps } => write!(
                f,
                "/task/horizon: {steps} steps are {} groups of {group_steps}; the guarantee is for the first {used}",
                used / *group_steps as u64
            ),
            Self::Grouped { steps, fewest } => {
                let GroupingTrial { steps: fewer, input, share, .. } = fewest;
                let why = match share {
                    share if *share > 1.0 => format!(
                        "the states of one cell would take {share:.3} times the range of input {} and nothing would be enabled",
                        input + 1
                    ),
                    _ if fewest.leaves_start == Some(false) => {
                        "nothing would be enabled at the start".to_owned()
                    }
                    _ => "nothing near the goal would be enabled that steers into it".to_owned(),
                };
                write!(
                    f,
                    "/dynamics/group_steps: \"auto\" groups {steps} steps into one, for with {fewer} {why}"
                )
            }
            Self::Unstable { radius } => write!(
                f,
                "/stabilizer: the closed loop has spectral radius {radius:.6}: this gain does not stabilise"
            ),
            Self::GainLeavesInput { worst, offset } => write!(
                f,
                "/stabilizer: −K(x − x̄) leaves U on the partition (a half-space with offset {offset} reaches \
                 {worst:.4}); cells where no action is left are reported as deadlocks"
            ),
            Self::UnusedInputs { unused, inputs } => write!(
                f,
                "/input: {unused} of {inputs} inputs leave no room for the feedback and are not used"
            ),
            Self::LeftOverSamples { source, left_over, samples, group_steps } => write!(
                f,
                "{source}: the last {left_over} of {samples} samples do not fill a group of {group_steps} and are not used"
            ),
            Self::NotIndependent { source, departure } => {
                let Departure { dimension, of_size, trend, deviations } = departure;
                let what = if *of_size { "how far they are from their middle" } else { "they" };
                let trend = match trend {
                    Trend::Drift => "drift from the first to the last",
                    Trend::Block { first, last } => {
                        &format!("differ in samples {first} to {last} from the others")
                    }
                    Trend::Lag(lag) => &format!("depend on what they were {lag} samples before"),
                };
                write!(
                    f,
                    "{source}: the samples do not look independent: in dimension {}, {what} {trend} ({deviations:.0} standard \
                     deviations); the promise holds only for samples that are independent and distributed like the noise \
                     at run time. Leave out what was measured before the system settled, or take every k-th sample",
                    dimension + 1
                )
            }
            Self::ContradictedWindows { outside, number, unseen } => write!(
                f,
                "{outside} of {number} samples lie where at most {unseen:.4} of the noise should: they are no independent \
                 samples of one distribution, or there are very few"
            ),
            Self::NothingEnabled { cells, ordinary } => write!(
                f,
                "in {cells} of {ordinary} ordinary cells no action is enabled (label \"deadlock\"): their value is 0"
            ),
            Self::UnsafeStart => f.write_str("/initial_state: the cell of the initial state is unsafe"),
        }
    }
}
