//! A lower layer that follows a plan.

use super::values::vector;
use super::{InputSet, Objective};
use crate::Diagnostic;
use crate::geometry::Polytope;
use crate::partition::{CellId, Grid};
use imdp::numeric::{Rational, to_f64};

/// A lower layer `u = u_plan(x) + u′` on the grouped system (`d·p` inputs).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrackingLayer {
    /// Where to steer to from some cells; from all others where a plan made by the abstraction says.
    pub given: Vec<Heading>,
    /// `U′`, what is left to the abstraction; contains 0. If absent, [`AUTOMATIC_SHARE`] of the width of `U`, about 0.
    pub abstract_input: Option<InputSet>,
}

/// Where to steer to from a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    /// A state in the cell.
    pub from: Vec<f64>,
    /// A point in the partition: the nearest target is meant.
    pub to: Vec<f64>,
}

/// Which part of the width of `U` is left to the abstraction if nothing is said about it, as a fraction.
pub const AUTOMATIC_SHARE: (u32, u32) = (3, 10);

/// A plan to follow, as far as it is given, and what is left to the abstraction.
#[derive(Clone, Debug)]
pub struct Tracking {
    given: Vec<(CellId, Vec<f64>)>,
    abstract_input: Polytope,
}

impl Tracking {
    /// The layer for the grouped inputs `input`.
    pub(super) fn new(layer: &TrackingLayer, input: &Polytope, grid: &Grid) -> Result<Self, Diagnostic> {
        let abstract_input = match &layer.abstract_input {
            Some(set) => {
                let remedy = "Shift U′: what the plan says is u′ = 0.";
                set.around_zero("/stabilizer/abstract_input", input.dimension(), remedy)?
            }
            None => automatic(input)?,
        };
        let mut given: Vec<(CellId, Vec<f64>)> = Vec::with_capacity(layer.given.len());
        for (i, Heading { from, to }) in layer.given.iter().enumerate() {
            let place = |field: &str| format!("/stabilizer/track/{i}/{field}");
            let cell = cell(&place("from"), from, grid)?;
            self::cell(&place("to"), to, grid)?;
            if given.iter().any(|(other, _)| *other == cell) {
                let found = "a state in the cell of one before";
                return Err(Diagnostic::at(place("from"), found, "one heading for every cell"));
            }
            given.push((cell, to.clone()));
        }
        Ok(Self { given, abstract_input })
    }

    /// `U′`, the inputs left to the abstraction.
    pub fn abstract_input(&self) -> &Polytope {
        &self.abstract_input
    }

    /// The cells whose headings are given, and the points they are.
    pub fn given(&self) -> &[(CellId, Vec<f64>)] {
        &self.given
    }
}

/// That a plan says all there is to say: where to go does not depend on what was done before.
pub(super) fn require_no_memory(objective: &Objective) -> Result<(), Diagnostic> {
    match objective {
        Objective::Reach { .. } | Objective::Stay { .. } => Ok(()),
        Objective::Automaton(_) => {
            let found = "a plan for a task with a memory, which goes different ways from the same cell";
            Err(Diagnostic::at("/stabilizer/track", found, "a task to \"reach\" or to \"stay\""))
        }
    }
}

fn cell(place: &str, x: &[f64], grid: &Grid) -> Result<CellId, Diagnostic> {
    let exact = vector(place, x, grid.dimension(), "one per dimension of the state")?;
    grid.locate(&exact).ok_or_else(|| {
        let sides =
            grid.axes().iter().map(|axis| format!("[{}, {})", to_f64(axis.lower()), to_f64(axis.upper())));
        let expected = format!("a state in the partition, {}", sides.collect::<Vec<_>>().join(" × "));
        Diagnostic::at(place, format!("{x:?}"), expected)
    })
}

/// The share of the width of the bounding box of `U`, about 0.
fn automatic(input: &Polytope) -> Result<Polytope, Diagnostic> {
    let bounds = input.bounding_box().ok_or_else(|| {
        Diagnostic::at(
            "/stabilizer",
            "no field `abstract_input`",
            "the field `abstract_input`: U has no width",
        )
    })?;
    let share = Rational::new(AUTOMATIC_SHARE.0.into(), (2 * AUTOMATIC_SHARE.1).into());
    let upper: Vec<Rational> = bounds.iter().map(|(lower, upper)| (upper - lower) * &share).collect();
    let lower: Vec<Rational> = upper.iter().map(|upper| -upper).collect();
    Ok(Polytope::from_box(&lower, &upper))
}
