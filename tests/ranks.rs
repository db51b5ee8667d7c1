//! Work that several processes share: here they are threads, so that every test run sees them. What they make together is what one makes.

use crate::common::{abstraction, problem};
use crate::solver::models::{labelled, model, set};
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::landing::LandingSolution;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::run::solution_options;
use imdp::property::Property;
use imdp::ranks::{Notice, Ranks, join, leave, require_same};
use imdp::solver::{Answer, SolverOptions};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;
use std::rc::Rc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};

/// Where the threads of a crew put what they send.
#[derive(Debug)]
struct Table {
    meeting: Mutex<Meeting>,
    moved: Condvar,
    words: Vec<Mutex<Vec<u64>>>,
    /// How many numbers of loops were exchanged.
    numbers: AtomicUsize,
}

/// A barrier that nobody waits at for a thread that has panicked.
#[derive(Debug, Default)]
struct Meeting {
    here: usize,
    rounds: usize,
    broken: bool,
}

impl Table {
    fn wait(&self) {
        let mut meeting = self.meeting.lock().unwrap();
        meeting.here += 1;
        if meeting.here == self.words.len() {
            (meeting.here, meeting.rounds) = (0, meeting.rounds + 1);
            self.moved.notify_all();
            return;
        }
        let round = meeting.rounds;
        let apart = |meeting: &mut Meeting| meeting.rounds == round && !meeting.broken;
        let broken = self.moved.wait_while(meeting, apart).unwrap().rounds == round;
        assert!(!broken, "another thread has panicked");
    }
}

#[derive(Debug)]
struct ThreadRank {
    rank: usize,
    table: Arc<Table>,
}

impl Drop for ThreadRank {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.table.meeting.lock().unwrap().broken = true;
            self.table.moved.notify_all();
        }
    }
}

impl ThreadRank {
    /// What every thread sent.
    fn exchange(&self, own: Vec<u64>) -> Vec<Vec<u64>> {
        *self.table.words[self.rank].lock().unwrap() = own;
        self.table.wait();
        let all = self.table.words.iter().map(|words| words.lock().unwrap().clone()).collect();
        self.table.wait();
        all
    }

    fn complete<T: Copy>(&self, array: &mut [T], ends: &[usize], word: fn(T) -> u64, number: fn(u64) -> T) {
        let begin = if self.rank == 0 { 0 } else { ends[self.rank - 1] };
        let own: Vec<u64> = array[begin..ends[self.rank]].iter().map(|&number| word(number)).collect();
        self.table.numbers.fetch_add(own.len(), Ordering::Relaxed);
        let all = self.exchange(own);
        assert_eq!(all.iter().map(Vec::len).sum::<usize>(), array.len());
        array.iter_mut().zip(all.into_iter().flatten()).for_each(|(place, word)| *place = number(word));
    }
}

impl Ranks for ThreadRank {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.table.words.len()
    }

    fn notices(&self, own: Notice) -> Vec<Notice> {
        self.exchange(vec![own.word()]).into_iter().map(|word| Notice::of_word(word[0])).collect()
    }

    fn complete_doubles(&self, array: &mut [f64], ends: &[usize]) {
        self.complete(array, ends, f64::to_bits, f64::from_bits);
    }

    fn complete_integers(&self, array: &mut [u32], ends: &[usize]) {
        self.complete(array, ends, u64::from, |word| word as u32);
    }

    fn disband(&self, notices: &[Notice]) -> ! {
        panic!("they do not do the same: {notices:?}")
    }
}

/// Does the same in so many threads that share their work; each is told its number.
fn together<T: Send>(size: usize, work: impl Fn(usize) -> T + Sync) -> Vec<std::thread::Result<T>> {
    let table = Arc::new(Table {
        meeting: Mutex::default(),
        moved: Condvar::new(),
        words: (0..size).map(|_| Mutex::default()).collect(),
        numbers: AtomicUsize::new(0),
    });
    let results = std::thread::scope(|scope| {
        let start = |rank| {
            let (table, work) = (Arc::clone(&table), &work);
            scope.spawn(move || {
                join(Rc::new(ThreadRank { rank, table }));
                let result = work(rank);
                leave();
                result
            })
        };
        let threads: Vec<_> = (0..size).map(start).collect();
        threads.into_iter().map(|thread| thread.join()).collect::<Vec<_>>()
    });
    let failed = results.iter().any(Result::is_err);
    assert!(failed || table.numbers.load(Ordering::Relaxed) > 0, "nothing was shared");
    results
}

/// Checks that crews of different sizes make what one thread makes.
fn same<T: PartialEq + std::fmt::Debug + Send + Sync>(work: impl Fn() -> T + Sync) {
    let alone = work();
    for size in [2, 3] {
        for (rank, shared) in together(size, |_| work()).into_iter().enumerate() {
            // Values are long: no use in printing them.
            assert!(shared.unwrap() == alone, "rank {rank} of {size}");
        }
    }
}

/// Known or sampled noise on 36,100 cells.
fn inputs(noise: &Value, resolution: u32) -> LandingSolution {
    let model = json!({
        "name": "ranks",
        "dynamics": {"A": [[0.9, 0.1], [0, 0.9]], "B": [[0.5, 0], [0, 0.5]]},
        "noise": noise,
        "actions": "inputs",
        "input": {"lower": [-1, -1], "upper": [1, 1], "points": [2, 2]},
        "partition": {"lower": [-3, -3], "upper": [3, 3], "cells": [190, 190], "resolution": [resolution, 1]},
        "task": {"goal": [{"lower": [-3, -3], "upper": [-1, -1]}], "unsafe": [], "horizon": 2}
    });
    let document = Document::parse(Path::new("m.json"), &model.to_string()).unwrap();
    let StatedProblem::Inputs(problem) = document.stated().unwrap() else { panic!("actions are inputs") };
    InputAbstraction::new(&problem).unwrap().question().solve(&SolverOptions::default())
}

#[test]
fn inputs_are_shared() {
    let known = json!({"gaussian": {"deviation": 0.04}});
    let sampled = json!({"gaussian": {"covariance": [[1e-4, 0], [0, 1e-4]]}, "count": 500, "seed": 5});
    for (noise, resolution) in [(json!({"components": [known, known]}), 2), (sampled, 1)] {
        same(|| {
            let solution = inputs(&noise, resolution);
            (solution.values, solution.policy, solution.status)
        });
    }
}

#[test]
fn targets_are_shared() {
    same(|| {
        let abstraction = abstraction("double_integrator", &[]);
        let problem = problem("double_integrator", &[]).unwrap();
        let options = solution_options(&problem, &SolverOptions::default());
        let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
        (abstraction.model.size().transitions, answer.solution)
    });
}

#[test]
fn stored_rows_are_shared() {
    // States with two rows each, that reach each other; the last one is the goal.
    let (states, successors) = (1500, 16);
    let mut state = 1u64;
    let mut random = |below: u64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 33) % below) as f64
    };
    let mut rows = vec![];
    for row in 0..2 * states {
        let s = row / 2;
        let mut reached = BTreeSet::from([(s + 1) as u32, ((s + 7) % states) as u32]);
        while reached.len() < successors {
            reached.insert(random(states as u64) as u32);
        }
        let mut low = || (1.0 + random(9)) * 0.09 / successors as f64;
        rows.push(reached.into_iter().map(|s| (s, low())).map(|(s, low)| (s, low, low + 0.2)).collect());
    }
    let choices = (0..states as u32).map(|s| Some(vec![(2 * s, 2 * s + 1)])).chain([None]);
    let model = model(&rows, &choices.collect::<Vec<_>>());
    let model = labelled(&model, &set(states + 1, &[]), &set(states + 1, &[states]));
    let properties = ["Pmaxmin=? [ F<=5 \"goal\" ]", "Pminmax=? [ F \"goal\" ]"];
    same(|| {
        let answer = |text: &str| {
            let property: Property = text.parse().unwrap();
            let options = SolverOptions { policy: true, evidence: true, ..SolverOptions::default() };
            Answer::new(&model, &property, &options).unwrap().solution
        };
        properties.map(answer)
    });
}

/// Files may differ from machine to machine: nothing is computed then.
#[test]
fn all_have_the_same_input() {
    let word = |result: std::thread::Result<()>| *result.unwrap_err().downcast::<String>().unwrap();
    let refusals: Vec<String> =
        together(3, |rank| require_same(&("noise.csv", rank / 2))).into_iter().map(word).collect();
    assert!(refusals.iter().any(|text| text.contains("they do not do the same: [Input")), "{refusals:?}");
}
