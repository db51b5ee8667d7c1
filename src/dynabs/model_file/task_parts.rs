//! From the fields of a task to its parts.

use super::given::given;
use super::named::Named;
use super::task_fields::{
    AutomatonSpec, LogicSpec, PlaceSpec, RegionSpec, SafetyCheck, ShapeSpec, ShapesSpec, TaskKind, TaskSpec,
    UnsafeSpec,
};
use crate::Diagnostic;
use crate::problem::{Hazard, Leg, Logic, RegionBox, RegionParts, ShapeParts, Task, Wanted};
use crate::task::Safety;
use imdp::files;
use std::path::Path;

/// The task, with automata read from files relative to `directory`.
pub(super) fn task(spec: TaskSpec, regions: Named<ShapesSpec>, directory: &Path) -> Result<Task, Diagnostic> {
    let regions =
        regions.0.into_iter().map(|(name, shapes)| region(name, shapes)).collect::<Result<Vec<_>, _>>()?;
    let check = spec.check.map(|check| match check {
        SafetyCheck::EveryStep => Safety::EveryStep,
        SafetyCheck::Grouped => Safety::GroupedInstants,
    });
    let (horizon, threshold) = (spec.horizon, spec.threshold);
    let mut unsafe_ = vec![];
    for (i, hazard) in spec.unsafe_.iter().enumerate() {
        match hazard {
            UnsafeSpec::Outside => unsafe_.push(Hazard::Outside),
            UnsafeSpec::Region(place) => {
                let place = boxes(&format!("/task/unsafe/{i}"), std::slice::from_ref(place), &regions)?;
                unsafe_.extend(place.into_iter().map(Hazard::Box));
            }
        }
    }
    let aim = aim(spec, &regions, directory)?;
    Ok(Task { aim, unsafe_, horizon, threshold, regions, check })
}

/// What is wanted: the field that the type needs, and no field of another type.
fn aim(spec: TaskSpec, regions: &[RegionParts], directory: &Path) -> Result<Wanted, Diagnostic> {
    use TaskKind::{Automaton, Formula, Reach, ReachAt, Sequence, Stay};
    let kind = spec.kind;
    for (field, found, of) in [
        ("goal", spec.goal.is_some(), &[Reach, ReachAt][..]),
        ("safe", spec.safe.is_some(), &[Stay]),
        ("sequence", spec.sequence.is_some(), &[Sequence]),
        ("formula", spec.formula.is_some(), &[Formula]),
        ("logic", spec.logic.is_some(), &[Formula]),
        ("automaton", spec.automaton.is_some(), &[Automaton]),
    ] {
        if found && !of.contains(&kind) {
            let expected = format!("only fields of a task of type \"{}\"", name(kind));
            return Err(Diagnostic::at(format!("/task/{field}"), "a field of another type", expected));
        }
    }
    let missing =
        |field: &str| Diagnostic::at("/task", format!("no field `{field}`"), format!("the field `{field}`"));
    let goal =
        |goal: Option<Vec<PlaceSpec>>| boxes("/task/goal", &goal.ok_or_else(|| missing("goal"))?, regions);
    Ok(match kind {
        Reach => Wanted::Reach { goal: goal(spec.goal)? },
        ReachAt => Wanted::ReachAt { goal: goal(spec.goal)? },
        Stay => Wanted::Stay { safe: boxes("/task/safe", &spec.safe.unwrap_or_default(), regions)? },
        Sequence => {
            let legs = spec.sequence.ok_or_else(|| missing("sequence"))?;
            Wanted::Sequence {
                legs: legs.into_iter().map(|leg| Leg { reach: leg.reach, avoid: leg.avoid }).collect(),
            }
        }
        Formula => Wanted::Formula {
            text: spec.formula.ok_or_else(|| missing("formula"))?,
            logic: match spec.logic {
                None | Some(LogicSpec::Ltl) => Logic::Ltl,
                Some(LogicSpec::Ltlf) => Logic::Ltlf,
            },
        },
        Automaton => automaton(spec.automaton.ok_or_else(|| missing("automaton"))?, directory)?,
    })
}

fn name(kind: TaskKind) -> &'static str {
    match kind {
        TaskKind::Reach => "reach",
        TaskKind::Stay => "stay",
        TaskKind::ReachAt => "reach_at",
        TaskKind::Sequence => "sequence",
        TaskKind::Formula => "formula",
        TaskKind::Automaton => "automaton",
    }
}

fn automaton(spec: AutomatonSpec, directory: &Path) -> Result<Wanted, Diagnostic> {
    match spec {
        AutomatonSpec { file: Some(file), hoa: None } => {
            let hoa = files::read_text(&directory.join(&file)).map_err(|error| {
                let found = format!("{file}, which cannot be read: {error}");
                Diagnostic::at("/task/automaton/file", found, "a text file in the HOA format")
            })?;
            Ok(Wanted::Automaton { file, hoa })
        }
        AutomatonSpec { file: None, hoa: Some(hoa) } => {
            Ok(Wanted::Automaton { file: "in the model file".to_owned(), hoa })
        }
        AutomatonSpec { file, hoa } => {
            let given = given(&[("file", file.is_some()), ("hoa", hoa.is_some())]);
            let found = if given.is_empty() { "neither".to_owned() } else { given };
            Err(Diagnostic::at("/task/automaton", found, "exactly one of file and hoa"))
        }
    }
}

/// The boxes of places; a name stands for all boxes of its region.
fn boxes(place: &str, specs: &[PlaceSpec], regions: &[RegionParts]) -> Result<Vec<RegionBox>, Diagnostic> {
    let mut found = vec![];
    for spec in specs {
        let name = match spec {
            PlaceSpec::Region(spec) => {
                found.push(region_box(spec));
                continue;
            }
            PlaceSpec::Name(name) => name,
        };
        let Some(region) = regions.iter().find(|region| region.name == *name) else {
            let known: Vec<_> = regions.iter().map(|region| region.name.as_str()).collect();
            let expected = match known.is_empty() {
                true => "a box: the model has no regions with names".to_owned(),
                false => format!("a box or the name of a region: one of {}", known.join(", ")),
            };
            return Err(Diagnostic::at(place, format!("\"{name}\""), expected));
        };
        for shape in &region.shapes {
            let ShapeParts::Box(sides) = shape else {
                return Err(Diagnostic::at(place, format!("the region {name}, which has polytopes"), "boxes")
                    .remedy("A task of type \"formula\" can speak of polytopes: \"F goal\", \"!bad U goal\", \"G safe\"."));
            };
            found.push(sides.clone());
        }
    }
    Ok(found)
}

fn region(name: String, shapes: ShapesSpec) -> Result<RegionParts, Diagnostic> {
    let shape = |shape: ShapeSpec| match shape {
        ShapeSpec { lower: Some(lower), upper: Some(upper), normals: None, offsets: None } => {
            Ok(ShapeParts::Box(region_box(&RegionSpec { lower, upper })))
        }
        ShapeSpec { lower: None, upper: None, normals: Some(normals), offsets: Some(offsets) } => {
            Ok(ShapeParts::Polytope { normals, offsets })
        }
        ShapeSpec { lower, upper, normals, offsets } => {
            let given = given(&[
                ("lower", lower.is_some()),
                ("upper", upper.is_some()),
                ("G", normals.is_some()),
                ("g", offsets.is_some()),
            ]);
            let found = if given.is_empty() { "neither".to_owned() } else { format!("only {given}") };
            let expected = "a box {lower, upper} or a polytope {G, g}";
            Err(Diagnostic::at(format!("/regions/{name}"), found, expected))
        }
    };
    let shapes = shapes.0.into_iter().map(shape).collect::<Result<_, _>>()?;
    Ok(RegionParts { name, shapes })
}

fn region_box(spec: &RegionSpec) -> RegionBox {
    let side = |values: &[Option<f64>], unbounded| values.iter().map(|x| x.unwrap_or(unbounded)).collect();
    RegionBox { lower: side(&spec.lower, f64::NEG_INFINITY), upper: side(&spec.upper, f64::INFINITY) }
}
