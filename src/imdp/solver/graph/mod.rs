//! Where values are exactly 0 or 1, and how the rest hangs together.

mod choice_tree;
mod decide;
mod end_components;
mod ranking;
mod tarjan;
mod within;
mod zero_one;

pub(super) use choice_tree::ChoiceTree;
pub(super) use decide::possible_within;
pub(super) use end_components::{Candidates, can_stay, end_components};
pub(super) use ranking::ranks;
pub(crate) use tarjan::strong_components;
pub(super) use within::within;
pub(super) use zero_one::{hits, stays, zero_one};
