//! Which plane is shown first, and on paper.

use super::scene::Scene;
use super::sides::sides;
use super::view::{Axis, View};
use crate::partition::Region;
use crate::task::HalfSpace;
use std::cmp::Reverse;

/// Which plane is shown first; what is not said is chosen by what the task speaks of.
///
/// Coordinates have their names, or numbers from 1 (`x3` or `3`).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewChoice {
    /// The coordinate across, or `time`.
    pub across: Option<String>,
    /// The coordinate up.
    pub up: Option<String>,
    /// Where the plane lies in other coordinates; elsewhere it goes through the start.
    pub at: Vec<(String, f64)>,
}

/// Why a plane cannot be shown.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ViewError {
    /// There is no such coordinate.
    #[error("{part}: found {found:?}; expected a coordinate of the state: {expected}")]
    Unknown {
        /// Which part of the choice: `across`, `up` or `at`.
        part: &'static str,
        /// What was asked for.
        found: String,
        /// What there is.
        expected: String,
    },
    /// Both axes are the same.
    #[error("up: found {found:?} on both axes; expected two different ones{remedy}")]
    Same {
        /// What was asked for.
        found: String,
        /// What else there is.
        remedy: &'static str,
    },
    /// The plane lies outside of the partition.
    #[error("at: found {name} = {found}; expected a number in [{lower}, {upper}), where the partition is")]
    Outside {
        /// The coordinate.
        name: String,
        /// What was asked for.
        found: f64,
        /// The least that it may be.
        lower: f64,
        /// What it must be less than.
        upper: f64,
    },
}

impl View {
    /// What is shown if nothing is chosen.
    pub(super) fn first(scene: &Scene<'_>) -> Self {
        let order = by_importance(scene);
        let slice = match scene.start_cell {
            Some(cell) => scene.grid.coordinates(cell),
            None => vec![0; scene.dimension()],
        };
        match order[..] {
            [one, other, ..] => {
                Self { across: Axis::State(one.min(other)), up: one.max(other), slice, step: 0 }
            }
            _ => Self { across: Axis::Time, up: 0, slice, step: 0 },
        }
    }

    /// What was chosen.
    ///
    /// # Errors
    /// [`ViewError`] if there is no such plane.
    pub(super) fn chosen(scene: &Scene<'_>, choice: &ViewChoice) -> Result<Self, ViewError> {
        let mut view = Self::first(scene);
        let across = choice.across.as_deref().map(|name| axis(scene, name)).transpose()?;
        let up = choice.up.as_deref().map(|name| coordinate(scene, "up", name)).transpose()?;
        let other = |taken: usize| by_importance(scene).into_iter().find(|&j| j != taken);
        (view.across, view.up) = match (across, up) {
            (None, None) => (view.across, view.up),
            (None, Some(up)) => (other(up).map_or(Axis::Time, Axis::State), up),
            (Some(Axis::Time), None) => (Axis::Time, by_importance(scene)[0]),
            (Some(Axis::State(across)), None) => (Axis::State(across), other(across).unwrap_or(across)),
            (Some(across), Some(up)) => (across, up),
        };
        if view.across == Axis::State(view.up) {
            let remedy = if scene.dimension() > 1 { "" } else { ", such as time across" };
            return Err(ViewError::Same { found: plain(scene, view.up), remedy });
        }
        for (name, value) in &choice.at {
            let j = coordinate(scene, "at", name)?;
            let (lower, upper) = scene.range(j);
            let faces = &scene.faces()[j];
            let cell = faces[1..].iter().position(|face| value < face).filter(|_| *value >= lower);
            let outside = || ViewError::Outside { name: plain(scene, j), found: *value, lower, upper };
            view.slice[j] = cell.ok_or_else(outside)? as u32;
        }
        Ok(view)
    }
}

/// The dimensions, first those that most of goal (or safe region), unsafe region and named regions depend on.
fn by_importance(scene: &Scene<'_>) -> Vec<usize> {
    let matters = |j: usize| {
        let inside = |x: f64| scene.range(j).0 < x && x < scene.range(j).1;
        let sided = |region: &Region| inside(sides(region, j).0) || inside(sides(region, j).1);
        let cuts = |side: &HalfSpace| {
            let slanted = side.normal.iter().filter(|x| **x != 0.0).count() > 1;
            side.normal[j] != 0.0 && (slanted || inside(side.offset / side.normal[j]))
        };
        let named = scene.named.iter().any(|region| region.shapes.iter().flatten().any(cuts));
        [scene.wanted.iter().any(sided), scene.unsafe_.iter().any(sided), named]
            .iter()
            .filter(|on| **on)
            .count()
    };
    let mut dimensions: Vec<usize> = (0..scene.dimension()).collect();
    dimensions.sort_by_key(|&j| Reverse(matters(j)));
    dimensions
}

fn axis(scene: &Scene<'_>, name: &str) -> Result<Axis, ViewError> {
    let is_time = name == "time" && !scene.names.iter().any(|one| one == name);
    if is_time { Ok(Axis::Time) } else { coordinate(scene, "across", name).map(Axis::State) }
}

/// The dimension that a name or a number stands for.
fn coordinate(scene: &Scene<'_>, part: &'static str, name: &str) -> Result<usize, ViewError> {
    let named = scene.names.iter().position(|one| one == name);
    let numbered = || {
        name.strip_prefix('x').unwrap_or(name).parse().ok().filter(|j| (1..=scene.dimension()).contains(j))
    };
    named.or_else(|| numbered().map(|j: usize| j - 1)).ok_or_else(|| {
        let names: Vec<_> = (0..scene.dimension()).map(|j| plain(scene, j)).collect();
        let time = if part == "across" { ", or time" } else { "" };
        let expected = format!("{}{time}", names.join(", "));
        ViewError::Unknown { part, found: name.to_owned(), expected }
    })
}

/// A name that can be typed.
pub(super) fn plain(scene: &Scene<'_>, dimension: usize) -> String {
    let name = &scene.names[dimension];
    if name.is_ascii() { name.clone() } else { format!("x{}", dimension + 1) }
}
