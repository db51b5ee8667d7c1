//! Tasks over named regions for actions that are targets: values, what the closed loop does.

use crate::common::controllers::Loop;
use crate::common::tasks::{DELIVERY, formula, room, sequence};
use dynabs::controller::export::{write_csv, write_json};
use dynabs::controller::{Noise, Simulation};
use dynabs::guarantee::Coverage;
use dynabs::model_file::Document;
use dynabs::problem::Problem;
use dynabs::task::{Aim, Safety};
use serde_json::{Value, json};
use std::path::Path;

fn model(task: &Value) -> Value {
    room(task, false)
}

fn stated(model: &Value) -> Result<Problem, String> {
    let document = Document::parse(Path::new("m.json"), &model.to_string()).unwrap();
    document.problem().map_err(|error| error.to_string())
}

fn solved(task: &Value) -> Loop {
    Loop::new(stated(&model(task)).unwrap())
}

/// What is to be done in some ways, all with a memory or an end of its own.
fn tasks() -> Vec<Value> {
    let mut avoiding = sequence(9);
    avoiding["unsafe"] = json!([{"lower": [-3, 0.25], "upper": [-2.5, 1]}]);
    vec![
        sequence(9),
        avoiding,
        formula("G !b", "ltl", 5),
        formula("(!b W a) & G !c", "ltl", 5),
        formula("!b W a", "ltl", 5),
        formula("(F a) & G !b", "ltlf", 6),
        json!({"type": "reach_at", "goal": ["a"], "horizon": 7}),
        json!({"type": "automaton", "automaton": {"hoa": DELIVERY}, "horizon": 9}),
    ]
}

#[test]
fn runs_keep_what_is_promised() {
    let mut open = 0;
    for task in tasks() {
        let Loop { problem, abstraction, answer, controller } = solved(&task);
        let coverage = abstraction.guarantee.coverage(&abstraction.property, &abstraction.model);
        assert_eq!(coverage.unwrap(), Coverage::Lower, "{task}");
        assert_eq!(controller.promised().bound, answer.lower);
        let simulation = Simulation::new(&problem, &controller, Noise::of_plant(problem.noise()), 1000);
        for start in [[-2.0, 2.0], [1.3, 0.7], [-2.2, 0.1]] {
            let tally = simulation.tally(&start, 1, 2000, &());
            let seen = tally.satisfaction(Safety::EveryStep, 1e-6);
            let bound = controller.bound_at(&start);
            assert!(seen.upper >= bound, "{task} from {start:?}: {bound} {seen:?}");
            assert_eq!(tally.violations, 0);
            open += usize::from(bound > 0.3);
        }
    }
    assert!(open > 12, "{open} of the bounds say something");
}

/// Known noise instead of samples: the same models with tighter rows.
#[test]
fn known_noise_promises_more() {
    let mut known = model(&sequence(14));
    known["actions"] = json!("targets");
    known["noise"] =
        json!({"components": [{"gaussian": {"deviation": 0.1}}, {"gaussian": {"deviation": 0.1}}]});
    let Loop { problem, abstraction, answer, controller } = Loop::new(stated(&known).unwrap());
    let sampled = solved(&sequence(14)).answer.lower;
    assert!(answer.lower > sampled && sampled > 0.1, "{} {sampled}", answer.lower);
    assert_eq!(abstraction.model.rows().len(), 2 * abstraction.targets.len());
    let simulation = Simulation::new(&problem, &controller, Noise::of_plant(problem.noise()), 1000);
    let seen = simulation.tally(&[-2.0, 2.0], 1, 2000, &()).satisfaction(Safety::EveryStep, 1e-6);
    assert!(seen.upper >= answer.lower, "{} {seen:?}", answer.lower);
}

/// Equal tasks have equal values, however they are written.
#[test]
fn ways_of_saying_a_task_agree() {
    let values = |task: &Value| {
        let Loop { abstraction, answer, .. } = solved(task);
        let lower = |state: &imdp::model::StateId| answer.values.lower[state.index()];
        abstraction.state_of_cell.iter().map(lower).collect::<Vec<f64>>()
    };
    let by_sequence = values(&sequence(9));
    for other in [
        formula("F (a & (!b U c))", "ltl", 9),
        json!({"type": "automaton", "automaton": {"hoa": DELIVERY}, "horizon": 9}),
    ] {
        assert_eq!(by_sequence, values(&other));
    }
    assert!(by_sequence.iter().any(|&value| value > 0.5));

    let mut aligned = model(&formula("!wall U goal", "ltl", 5));
    let goal = json!([{"lower": [1, -1], "upper": [3, 1]}]);
    let wall = json!([{"lower": [-0.5, -2], "upper": [0, 0]}]);
    aligned["regions"] = json!({"goal": goal, "wall": wall});
    let by_formula = Loop::new(stated(&aligned).unwrap());
    let reach = solved(&json!({"goal": goal, "unsafe": wall, "horizon": 5}));
    assert_eq!(by_formula.answer.values.lower, reach.answer.values.lower);
    assert_eq!(by_formula.abstraction.model.rows(), reach.abstraction.model.rows());
}

/// The rows of a model belong to memories; those who end alike share their events.
#[test]
fn the_product_is_as_large_as_what_can_be_open() {
    let Loop { problem, abstraction, .. } = solved(&sequence(9));
    let (model, targets) = (&abstraction.model, abstraction.targets.len());
    assert_eq!((problem.worst_task().memories(), model.rows().len()), (2, 2 * targets));
    let cells = problem.grid().num_cells() as usize;
    assert!(model.num_states() < 2 * cells && model.num_states() > cells, "{}", model.num_states());
    let budget = &abstraction.guarantee.samples().unwrap().budget;
    let events = |family: &str| budget.iter().find(|one| one.family == family).unwrap().events.to_string();
    // Nothing can be done before `a` was met.
    assert_eq!([events("goal"), events("lost")], [targets.to_string(), (2 * targets).to_string()]);

    let Loop { problem, abstraction, .. } = solved(&json!({"type": "reach_at", "goal": ["a"], "horizon": 7}));
    assert_eq!((problem.cell_task().aim(), problem.worst_task().aim()), (Aim::End, Aim::Reach));
    let budget = &abstraction.guarantee.samples().unwrap().budget;
    assert_eq!(
        budget.iter().find(|one| one.family == "lost").unwrap().events.to_string(),
        (2 * targets).to_string()
    );
}

#[test]
fn what_cannot_be_asked_is_explained() {
    let grouped = |task: &Value, d: u64| {
        let mut model = model(task);
        model["dynamics"]["group_steps"] = json!(d);
        stated(&model)
    };
    for (problem, expected) in [
        (grouped(&sequence(8), 2), "\"check\": \"grouped\""),
        (grouped(&formula("G !b", "ltl", 4), 2), "which look at every step"),
        (grouped(&json!({"type": "reach_at", "goal": ["a"], "horizon": 5}), 2), "a multiple of 2"),
        (stated(&model(&formula("F ((a & X b) | (!a & X !b))", "ltl", 5))), "Align the faces"),
    ] {
        let error = problem.map(|problem| problem.name().to_owned()).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
    let to_come = json!({"type": "sequence", "sequence": [{"reach": "a"}, {"reach": "c"}], "horizon": 8});
    assert!(grouped(&to_come, 2).is_ok());
    let mut reference = model(&sequence(8));
    reference["probabilities"] = json!({"mode": "reference"});
    assert!(stated(&reference).unwrap_err().contains("the published tool has no other"));
}

#[test]
fn files_carry_the_memory() {
    let Loop { problem, abstraction, controller, .. } = solved(&sequence(8));
    let (mut text, mut table) = (vec![], vec![]);
    write_json(&controller, &problem, &mut text).unwrap();
    let value: Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(value["memory"]["memories"], 2);
    assert_eq!(value["policy"]["by_memory"].as_array().unwrap().len(), 2);
    let first = &value["policy"]["by_memory"][1]["start"][0];
    assert!(value["targets"][first[1].to_string()].is_array(), "{first}");
    write_csv(&controller, problem.grid(), &mut table).unwrap();
    let table = String::from_utf8(table).unwrap();
    assert!(table.starts_with("memory,from_step,") && table.contains("\n1,0,"));
    let words = controller.promise().join(" ");
    assert!(words.contains("the run comes to a, then to c (not meeting b before)"), "{words}");
    assert!(words.contains("the task and its regions"), "{words}");
    assert!(abstraction.model.variables().iter().any(|variable| variable.name == "memory"));
}
