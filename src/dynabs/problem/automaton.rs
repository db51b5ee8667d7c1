//! Tasks over named regions: from text to an automaton.

use super::regions::{RegionParts, ShapeParts, region};
use super::values::{matrix, vector};
use super::{Horizon, Leg, Logic, Wanted};
use crate::Diagnostic;
use crate::geometry::Polytope;
use crate::partition::Region;
use crate::task::{self, AutomatonTask, NamedRegion, Shape};
use imdp::automaton::{Dfa, Ltl, LtlError, read_hoa};
use std::cell::RefCell;

/// All regions, checked.
pub(super) fn named_regions(parts: &[RegionParts], n: usize) -> Result<Vec<NamedRegion>, Diagnostic> {
    let mut regions: Vec<NamedRegion> = vec![];
    for RegionParts { name, shapes } in parts {
        let place = format!("/regions/{name}");
        let starts_well = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        let is_name = starts_well && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !is_name
            || ["X", "F", "G", "U", "W", "R", "true", "false", "unsafe", "outside"].contains(&name.as_str())
        {
            let expected = "a name of letters, digits and _ that is no operator, nor unsafe or outside";
            return Err(Diagnostic::at(place, format!("the name \"{name}\""), expected));
        }
        if shapes.is_empty() {
            return Err(Diagnostic::at(place, "no shape", "at least one box or polytope"));
        }
        let shape = |(i, shape): (usize, &ShapeParts)| {
            let place = if shapes.len() == 1 { place.clone() } else { format!("{place}/{i}") };
            match shape {
                ShapeParts::Box(sides) => region(&place, sides, n).map(Shape::Box),
                ShapeParts::Polytope { normals, offsets } => {
                    let what = "one per dimension of the state";
                    let g = matrix(&format!("{place}/G"), normals, None, Some(n), what)?;
                    let offsets = vector(&format!("{place}/g"), offsets, g.rows(), "one per row of G")?;
                    let polytope = Polytope::new(g, offsets);
                    if polytope.is_empty() {
                        let found = "half-spaces that have no point in common";
                        return Err(Diagnostic::at(place, found, "a region with at least one point")
                            .remedy("Check the signs: every row means G x ≤ g."));
                    }
                    Ok(Shape::Polytope(polytope))
                }
            }
        };
        let shapes = shapes.iter().enumerate().map(shape).collect::<Result<_, _>>()?;
        regions.push(NamedRegion { name: name.clone(), shapes });
    }
    Ok(regions)
}

/// The automaton of a task over named regions.
pub(super) fn automaton(
    aim: &Wanted,
    horizon: Horizon,
    regions: &[NamedRegion],
    unsafe_: &[Region],
) -> Result<AutomatonTask, Diagnostic> {
    let names = Names { regions, used: RefCell::default() };
    let (dfa, aim, statement, source) = match aim {
        Wanted::Reach { .. } | Wanted::Stay { .. } | Wanted::ReachAt { .. } => {
            return Err(Diagnostic::at("/task/type", "a task over boxes", "one over named regions"));
        }
        Wanted::Sequence { legs } => {
            let formula = names.sequence(legs)?;
            let (dfa, aim) = Dfa::of_ltl(&formula).map_err(|error| too_large("/task/sequence", &error))?;
            (dfa, aim, sequence_words(legs), None)
        }
        Wanted::Formula { text, logic } => {
            let formula = Ltl::parse(text, |name| names.number(name)).map_err(|error| {
                let place = format!("/task/formula (character {})", error.column);
                let known: Vec<_> = regions.iter().map(|region| region.name.as_str()).collect();
                let expected = match error.expected.contains("region") {
                    true => format!("{}: one of {}", error.expected, known.join(", ")),
                    false => error.expected,
                };
                Diagnostic::at(place, error.found, expected)
            })?;
            let (dfa, aim) = match (logic, horizon) {
                (Logic::Ltl, _) => Dfa::of_ltl(&formula),
                (Logic::Ltlf, Horizon::Steps(_)) => Dfa::of_ltlf(&formula).map(|dfa| (dfa, task::Aim::End)),
                (Logic::Ltlf, Horizon::Infinite) => Dfa::of_ltlf(&formula).map(|dfa| (dfa, task::Aim::Reach)),
            }
            .map_err(|error| too_large("/task/formula", &error))?;
            (dfa, aim, format!("the run satisfies {text}"), None)
        }
        Wanted::Automaton { file, hoa } => {
            let automaton = read_hoa(hoa).map_err(|error| {
                Diagnostic::at(
                    "/task/automaton",
                    format!("{file}, {error}"),
                    "a deterministic automaton in the HOA format",
                )
            })?;
            for name in automaton.propositions() {
                if names.number(name).is_none() {
                    let known: Vec<_> = regions.iter().map(|region| region.name.as_str()).collect();
                    let found = format!("the proposition \"{name}\" in {file}");
                    let expected = format!("the name of a region: one of {}", known.join(", "));
                    return Err(Diagnostic::at("/task/automaton", found, expected));
                }
            }
            let (dfa, aim) = automaton.on_prefixes().map_err(|error| too_large("/task/automaton", &error))?;
            (dfa, aim, format!("the run is accepted by the automaton {file}"), Some(hoa.clone()))
        }
    };
    let mut used = names.regions();
    let dfa = if unsafe_.is_empty() {
        dfa
    } else {
        let shapes = unsafe_.iter().cloned().map(Shape::Box).collect();
        used.push(NamedRegion { name: "unsafe".to_owned(), shapes });
        dfa.guarded()
    };
    Ok(AutomatonTask::new(&dfa, aim, used, statement).with_source(source))
}

/// What no automaton for prefixes can be made of, and why.
fn too_large(place: &str, error: &LtlError) -> Diagnostic {
    match error {
        LtlError::Undecided => Diagnostic::at(
            place,
            "liveness: something must hold for ever or again and again, and something else must come",
            "what a finite part of a run decides: a safe or a co-safe formula",
        )
        .remedy(
            "Unbounded noise leaves every bounded partition sooner or later, so the value of this task is 0. Say until when it \
             must hold, as in a U b, or ask for so many steps: \"logic\": \"ltlf\" and a finite horizon.",
        ),
        _ => Diagnostic::at(place, error.to_string(), "a task that a small automaton decides"),
    }
}

/// The regions that a task speaks of, numbered as it does.
struct Names<'a> {
    regions: &'a [NamedRegion],
    used: RefCell<Vec<usize>>,
}

impl Names<'_> {
    fn number(&self, name: &str) -> Option<u32> {
        let region = self.regions.iter().position(|region| region.name == name)?;
        let mut used = self.used.borrow_mut();
        let number = used.iter().position(|&other| other == region).unwrap_or_else(|| {
            used.push(region);
            used.len() - 1
        });
        Some(number as u32)
    }

    fn regions(&self) -> Vec<NamedRegion> {
        self.used.borrow().iter().map(|&region| self.regions[region].clone()).collect()
    }

    /// `!a₁ U (r₁ & (!a₂ U (r₂ & …)))`.
    fn sequence(&self, legs: &[Leg]) -> Result<Ltl, Diagnostic> {
        let place = "/task/sequence";
        if legs.is_empty() {
            return Err(Diagnostic::at(place, "an empty list", "at least one region to come to"));
        }
        let proposition = |place: String, name: &str| {
            self.number(name).map(Ltl::Proposition).ok_or_else(|| {
                let known: Vec<_> = self.regions.iter().map(|region| region.name.as_str()).collect();
                let expected = format!("the name of a region: one of {}", known.join(", "));
                Diagnostic::at(place, format!("\"{name}\""), expected)
            })
        };
        let mut formula = Ltl::True;
        for (i, leg) in legs.iter().enumerate().rev() {
            let here = proposition(format!("{place}/{i}/reach"), &leg.reach)?;
            let avoid = leg.avoid.iter().enumerate().map(|(j, name)| {
                proposition(format!("{place}/{i}/avoid/{j}"), name).map(|region| Ltl::Not(Box::new(region)))
            });
            let clear = Ltl::And(avoid.collect::<Result<_, _>>()?);
            formula = Ltl::Until(Box::new(clear), Box::new(Ltl::And(vec![here, formula])));
        }
        Ok(formula)
    }
}

fn sequence_words(legs: &[Leg]) -> String {
    let leg = |leg: &Leg| match leg.avoid.is_empty() {
        true => leg.reach.clone(),
        false => format!("{} (not meeting {} before)", leg.reach, leg.avoid.join(", ")),
    };
    let legs: Vec<_> = legs.iter().map(leg).collect();
    format!("the run comes to {}", legs.join(", then to "))
}
