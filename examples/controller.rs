//! A shipped model, solved and refined to a feedback law, whose closed loop then runs a few steps.

use dynabs::abstraction::compile;
use dynabs::controller::{Controller, Decision, RunMemory};
use dynabs::model_file::Document;
use imdp::solver::{Answer, SolverOptions};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/models/room_temperature.json"));
    let problem = Document::parse(path, &std::fs::read_to_string(path)?)?.problem()?;
    let abstraction = compile(&problem, &())?;
    let options = SolverOptions { policy: true, ..SolverOptions::default() };
    let answer = Answer::new(&abstraction.model, &abstraction.property, &options)?;
    let controller = Controller::new(&problem, &abstraction, &answer)?;

    // Without noise, to see where it steers.
    let (a, b, q) =
        (problem.system().a().to_f64(), problem.system().b().to_f64(), problem.system().q().to_f64());
    let (mut x, mut u, mut memory) = ([2.0], [0.0], RunMemory::default());
    for k in 0..6 {
        match controller.control(&x, k, &mut memory, &mut u) {
            Decision::Act { action: target } => {
                println!("step {k}: x = {:.3}, u = {:.3}, towards target {target}", x[0], u[0]);
                x[0] = a[(0, 0)] * x[0] + b[(0, 0)] * u[0] + q[(0, 0)];
            }
            other => {
                println!("step {k}: x = {:.3}: {other:?}", x[0]);
                break;
            }
        }
    }
    Ok(())
}
