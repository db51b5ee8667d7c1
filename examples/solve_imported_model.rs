//! Bounds on a property of anyone's interval MDP: a model in PRISM's explicit format, DRN, UMB or `.dynabs`.
//!
//! `cargo run --example solve_imported_model -- model.drn 'Pmaxmin=? [ F "goal" ]'`

use imdp::formats::Format;
use imdp::property::Property;
use imdp::solver::{Answer, SolverOptions};
use std::error::Error;
use std::path::PathBuf;

/// Two states; the one action reaches the goal with some probability between 0.3 and 0.6, or stays.
const MODEL: &str = "\
@type: MDP
@value_type: double-interval
@parameters

@reward_models

@nr_states
2
@nr_choices
2
@model
state 0 init
\taction go
\t\t0 : [0.4, 0.7]
\t\t1 : [0.3, 0.6]
state 1 goal
\taction stay
\t\t1 : [1, 1]
";

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let scratch = tempfile::tempdir()?;
    let path = match arguments.next() {
        Some(path) => PathBuf::from(path),
        None => {
            let path = scratch.path().join("model.drn");
            std::fs::write(&path, MODEL)?;
            path
        }
    };
    let property = arguments.next().unwrap_or_else(|| "Pmaxmin=? [ F<=3 \"goal\" ]".to_owned());
    let property: Property = property.parse()?;

    let format = Format::of_path(&path).ok_or("the extension tells no format")?;
    let imported = format.import(&path, &())?;
    let answer = Answer::new(&imported.model, &property, &SolverOptions::default())?;
    println!("{property}\n  in [{}, {}] at the initial state", answer.lower, answer.upper);
    Ok(())
}
