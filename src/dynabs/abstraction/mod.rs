//! From a control problem and noise samples to an interval MDP (ECC 2024, Sections III–V).
//!
//! Action `a` steers to target `d_a`, so `x⁺ = d_a + η` from every cell where it is enabled: the
//! transition probabilities of an action are one *row*, shared by all these cells. On a lattice of targets
//! the rows are translations of each other, and all of them follow from how often each *offset* from a
//! target was hit by `d_a + δ_i`.

mod action_counts;
mod base;
mod between;
mod cell_box;
mod cell_counts;
mod compile;
mod costs;
mod count_table;
mod enabled;
mod enabling;
mod error;
mod footprint;
mod grounds;
mod hazards;
pub mod inputs;
mod known;
mod nominal;
mod pac;
mod placement;
mod plan;
mod reference;
mod room;
mod rooms;
mod row_tasks;
mod scan;
mod sharing;
mod states;
mod steering;
mod stencil;
mod target_costs;
mod targets;
mod tracking;
mod windows;

pub use cell_box::CellBox;
pub use cell_counts::{CellCounts, Count, RegionCounts};
pub use compile::{Abstraction, compile};
pub use costs::CostError;
pub use enabled::enabled_actions;
pub use error::AbstractionError;
pub use footprint::Footprint;
pub use placement::Placement;
pub use plan::Plan;
pub use steering::demands;
pub use targets::{Alignment, Targets};
