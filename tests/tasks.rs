//! Tasks over named regions: values, what the closed loop does.

use crate::common::controllers::Loop;
use crate::common::root;
use crate::common::tasks::{DELIVERY, formula, room, sequence};
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::export::{write_csv, write_input_json};
use dynabs::controller::{Controller, Decision, Noise, ParameterChoice, RunMemory, Simulation};
use dynabs::landing::LandingSolution;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::problem::InputProblem;
use dynabs::task::{Aim, Safety};
use imdp::property::Resolution;
use imdp::solver::{Answer, SolverOptions};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

fn model(task: Value) -> Value {
    let mut model = room(&task, true);
    model["partition"]["resolution"] = json!([1, 1]);
    model
}

fn stated(task: Value) -> Result<InputProblem, String> {
    let document = Document::parse(Path::new("m.json"), &model(task).to_string()).unwrap();
    match document.stated().map_err(|error| error.to_string())? {
        StatedProblem::Inputs(problem) => Ok(*problem),
        StatedProblem::Targets(_) => panic!("known noise makes actions inputs"),
    }
}

fn solved(task: Value) -> (InputProblem, InputAbstraction, LandingSolution) {
    let problem = stated(task).unwrap();
    let abstraction = InputAbstraction::new(&problem).unwrap();
    let solution = abstraction.question().solve(&SolverOptions::default());
    (problem, abstraction, solution)
}

/// What is to be done in some ways, all with a memory or an end of its own.
fn tasks() -> Vec<Value> {
    let mut avoiding = sequence(json!(8));
    avoiding["unsafe"] = json!([{"lower": [-3, 0.25], "upper": [-2.5, 1]}]);
    vec![
        sequence(json!(8)),
        avoiding,
        formula("G !b", "ltl", 4),
        formula("(!b W a) & G !c", "ltl", 4),
        formula("(F a) & G !b", "ltlf", 4),
        json!({"type": "reach_at", "goal": ["a"], "horizon": 3}),
        json!({"type": "automaton", "automaton": {"hoa": DELIVERY}, "horizon": 8}),
    ]
}

#[test]
fn the_general_solver_gives_the_native_values() {
    for task in tasks() {
        let (problem, abstraction, solution) = solved(task.clone());
        let cell = problem.initial_cell().unwrap();
        let encoded = abstraction.question().model(&[cell.0]).unwrap();
        for (resolution, own) in [
            (Resolution::Pmaxmin, solution.values.lower[cell.index()]),
            (Resolution::Pmaxmax, solution.values.upper[cell.index()]),
        ] {
            let property = abstraction.property(resolution);
            let answer = Answer::new(&encoded.model, &property, &SolverOptions::default()).unwrap();
            assert!(answer.lower - 1e-9 <= own && own <= answer.upper + 1e-9, "{task}: {own} {answer:?}");
        }
    }
}

#[test]
fn runs_keep_what_is_promised() {
    let mut open = 0;
    for task in tasks() {
        let (problem, abstraction, solution) = solved(task.clone());
        let controller = Controller::of_inputs(&problem, &abstraction, &solution);
        let simulation = Simulation::of_inputs(&problem, &controller, ParameterChoice::Random, 1000);
        for start in [[-2.0, 2.0], [1.3, 0.7], [-2.2, 0.1]] {
            let tally = simulation.tally(&start, 1, 2000, &());
            let seen = tally.satisfaction(Safety::EveryStep, 1e-6);
            let bound = controller.bound_at(&start);
            let most = solution.values.upper[problem.grid().num_cells().min(cell(&problem, &start)) as usize];
            assert!(
                seen.upper >= bound && seen.lower <= most,
                "{task} from {start:?}: {bound} {seen:?} {most}"
            );
            assert_eq!(tally.violations, 0);
            open += usize::from(bound > 0.05);
        }
    }
    assert!(open > 10, "{open} of the bounds say something");
}

fn cell(problem: &InputProblem, x: &[f64]) -> u32 {
    dynabs::partition::CellLookup::new(problem.grid()).locate(x).unwrap().0
}

/// Equal tasks have equal values, however they are written.
#[test]
fn ways_of_saying_a_task_agree() {
    let values = |task: Value| solved(task).2.values;
    let by_sequence = values(sequence(json!(8)));
    for other in [
        formula("F (a & (!b U c))", "ltl", 8),
        formula("F (a & !(!c W (b & !c)))", "ltl", 8),
        json!({"type": "automaton", "automaton": {"hoa": DELIVERY}, "horizon": 8}),
    ] {
        let other = values(other);
        assert_eq!(by_sequence.lower, other.lower);
        assert_eq!(by_sequence.upper, other.upper);
    }
    let goal = json!([{"lower": [1, -1], "upper": [3, 1]}]);
    let wall = json!([{"lower": [-0.5, -2], "upper": [0, 0]}]);
    let reach = values(json!({"goal": goal, "unsafe": wall, "horizon": 5}));
    let mut aligned = model(formula("!wall U goal", "ltl", 5));
    aligned["regions"] = json!({"goal": goal, "wall": wall});
    let document = Document::parse(Path::new("m.json"), &aligned.to_string()).unwrap();
    let StatedProblem::Inputs(problem) = document.stated().unwrap() else { panic!("inputs") };
    let same = InputAbstraction::new(&problem).unwrap().question().solve(&SolverOptions::default()).values;
    assert_eq!((reach.lower, reach.upper), (same.lower, same.upper));
}

#[test]
fn more_time_is_worth_more() {
    let [short, long, endless] =
        [json!(8), json!(30), json!("infinite")].map(|horizon| solved(sequence(horizon)).2.values);
    for (cell, &endless) in endless.lower.iter().enumerate() {
        assert!(short.lower[cell] <= long.lower[cell] && long.lower[cell] <= endless + 1e-6, "cell {cell}");
    }
    let at = cell(&stated(sequence(json!(8))).unwrap(), &[-2.0, 2.0]) as usize;
    assert!(
        endless.lower[at] > long.lower[at] && long.lower[at] > 0.2,
        "{} {}",
        endless.lower[at],
        long.lower[at]
    );
}

#[test]
fn the_controller_remembers() {
    let (problem, abstraction, solution) = solved(sequence(json!(8)));
    let controller = Controller::of_inputs(&problem, &abstraction, &solution);
    let (mut memory, mut u) = (RunMemory::default(), [0.0; 2]);
    let mut look = |x: [f64; 2], k| (controller.control(&x, k, &mut memory, &mut u), memory.open());
    let (_, before) = look([1.19, 0.0], 0);
    // In the same cell, but behind the face of the region.
    let (_, after) = look([1.21, 0.0], 1);
    assert!(before.is_some() && after.is_some() && before != after);
    // The package is lost at b, picked up again, and delivered.
    assert_eq!(look([0.1, -1.0], 2).1, before);
    assert_eq!(look([2.0, 0.0], 3).1, after);
    assert_eq!(look([-2.0, -2.0], 4).0, Decision::Reached);
    assert_eq!(look([9.0, 0.0], 5).0, Decision::Outside);
}

#[test]
fn files_carry_the_memory() {
    let (problem, abstraction, solution) = solved(sequence(json!(8)));
    let controller = Controller::of_inputs(&problem, &abstraction, &solution);
    let (mut text, mut table) = (vec![], vec![]);
    write_input_json(&controller, "room", &mut text).unwrap();
    let value: Value = serde_json::from_slice(&text).unwrap();
    let memories = controller.task().memories() as usize;
    assert_eq!((memories, value["memory"]["memories"].as_u64()), (2, Some(2)));
    assert_eq!(value["memory"]["next"].as_array().unwrap().len(), memories + 1);
    assert_eq!(value["policy"]["entries"].as_array().unwrap().len(), memories);
    assert!(
        value["promise"]["text"]
            .as_str()
            .unwrap()
            .contains("the run comes to a, then to c (not meeting b before)")
    );
    write_csv(&controller, problem.grid(), &mut table).unwrap();
    let table = String::from_utf8(table).unwrap();
    assert!(table.starts_with("memory,from_step,") && table.contains("\n1,0,"), "{}", &table[..200]);
}

#[test]
fn mistakes_are_explained() {
    for (task, expected) in [
        (formula("G F a", "ltl", 5), "noise leaves every bounded partition"),
        (formula("(F a) & G !b", "ltl", 5), "the value of this task is 0"),
        (formula("F d", "ltl", 5), "one of a, b, c"),
        (formula("F a & b", "ltl", 5), "/task/formula (character 5)"),
        (json!({"type": "formula", "horizon": 5}), "the field `formula`"),
        (json!({"type": "sequence", "sequence": [], "horizon": 5}), "/task/sequence"),
        (json!({"type": "sequence", "sequence": [{"reach": "x"}], "horizon": 5}), "/task/sequence/0/reach"),
        (json!({"type": "reach", "formula": "F a", "goal": ["a"], "horizon": 5}), "/task/formula"),
        (json!({"goal": ["c"], "horizon": 5}), "\"F goal\""),
        (json!({"goal": ["d"], "horizon": 5}), "one of a, b, c"),
        (json!({"type": "reach_at", "goal": ["a"], "horizon": "infinite"}), "/task/horizon"),
        (json!({"type": "reach_at", "goal": ["a"], "horizon": 1_000_000_000}), "at most 7456540 steps"),
        (json!({"type": "automaton", "automaton": {}, "horizon": 5}), "exactly one of file and hoa"),
        (
            json!({"type": "automaton", "automaton": {"file": "none.hoa"}, "horizon": 5}),
            "/task/automaton/file",
        ),
        (
            json!({"type": "automaton", "automaton": {"hoa": DELIVERY.replace("\"c\"", "\"d\"")}, "horizon": 5}),
            "the proposition \"d\"",
        ),
        (
            json!({"type": "automaton", "automaton": {"hoa": DELIVERY.replace("[t] 2", "[t] 0")}, "horizon": 5}),
            "liveness",
        ),
        (formula("F (a & c)", "ltl", 5), "no run of cells fulfils"),
    ] {
        let error = stated(task.clone()).map(|_| task).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
    assert_eq!(stated(formula("(F a) & G !b", "ltlf", 5)).unwrap().cell_task().aim(), Aim::End);
}

#[test]
fn examples_are_what_the_tool_reads() {
    let folders =
        ["examples/tasks", "examples/systems"].map(|folder| fs::read_dir(root().join(folder)).unwrap());
    let mut found = 0;
    for file in folders.into_iter().flatten().map(|entry| entry.unwrap().path()) {
        if file.extension().is_some_and(|extension| extension == "json") {
            let document = Document::parse(&file, &fs::read_to_string(&file).unwrap()).unwrap();
            document.stated().unwrap();
            found += 1;
        }
    }
    assert_eq!(found, 7);
}

/// To stay is a task for targets and samples too: the model has no goal, and the closed loop keeps the promise.
#[test]
fn targets_can_be_asked_to_stay() {
    let sets = [
        r#"/task={"type":"stay","safe":[{"lower":[1],"upper":[9]}],"unsafe":[{"lower":[8.5],"upper":[null]}],"horizon":5}"#,
        "/initial_state=[3]",
    ];
    let Loop { problem, abstraction, answer, controller } = Loop::of("room_temperature", &sets);
    assert_eq!(abstraction.property.to_string(), "Pmaxmin=? [ G<=5 !\"failed\" ]");
    assert!(abstraction.model.labels().get("reached").unwrap().is_clear());
    let bounds = [answer.lower, answer.upper];
    let claim = abstraction.guarantee.claim(&abstraction.property, &abstraction.model, bounds);
    assert!(claim.unwrap().covered);
    let simulation = Simulation::new(&problem, &controller, Noise::of_plant(problem.noise()), 5);
    let seen = simulation.tally(&[3.0], 1, 4000, &()).satisfaction(Safety::EveryStep, 1e-6);
    assert!(answer.lower > 0.5 && seen.upper >= answer.lower, "{} {seen:?}", answer.lower);
    assert!(controller.promise()[0].contains("stays in the safe region for 5 steps"));
}
